"""What the equations of effects read: motion, loads and states of one segment at full rate."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import expm

from modeler import regression
from modeler.core.json import ShortRepr
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import InternalState
from modeler.numerics.filters import apply_biquad

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


EVERY = slice(None)
"""All samples of a segment."""


@dataclass(frozen=True, eq=False)
class SignalReference(ShortRepr):
    """The model about which effects that depend on torques are linearised.

    Attributes:
        compiled: the robot.
        beta: (c,) base parameters.
        time: s, where the time of effects is 0.
        temperature: K by joint, where the temperature of effects is 0.
    """

    compiled: "CompiledModel"
    beta: np.ndarray
    time: float
    temperature: Mapping[str, float]

    @cached_property
    def link_parameters(self) -> np.ndarray:
        """Returns beta of the links alone, (c,): no friction, rotors, offsets."""
        kinds = [base.kind for base in self.compiled.spec.base]
        return np.where([kind == "inertial" for kind in kinds], self.beta, 0.0)

    @cached_property
    def tilt_directions(self) -> list[tuple[np.ndarray, np.ndarray]] | None:
        """Returns the basis of a tilt about this model."""
        return compute_tilt_basis(self)

    @cached_property
    def drive_parameters(self) -> np.ndarray:
        """Returns viscous friction and rotor inertia of each joint, (2, J)."""
        spec = self.compiled.spec
        owner = {p.name: (p.effect, p.joint) for p in spec.standard}
        pairs = zip(spec.base, self.beta, strict=True)
        values = {owner[base.column_of]: float(value) for base, value in pairs}
        drives = ("viscous", "rotor_inertia")
        return np.array([[values.get((e, j.name), 0.0) for j in spec.joints] for e in drives])


@dataclass(frozen=True, eq=False)
class Signals(ShortRepr):
    """The motion of one segment, as effects read it; n samples, J joints.

    Attributes:
        segment: where it comes from.
        usable: (n, J) samples that count.
        q, v, a: (n, J) motion.
        reference: the model.
    """

    segment: regression.Segment
    usable: np.ndarray
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    reference: SignalReference

    @property
    def step(self) -> float:
        """Returns the time between samples, s."""
        return self.segment.step

    @cached_property
    def model_signals(self) -> np.ndarray | None:
        """Returns what effects of the model read besides the motion, (n, m)."""
        return regression.compute_signals(self.reference.compiled, self.segment)

    def compute_base_regressor(self, window: slice) -> np.ndarray:
        """Computes the base regressor (n, J, c) over a window of the samples."""
        return self.reference.compiled.base_regressor(*self._select_states(window))

    def compute_regressor(self, window: slice) -> np.ndarray:
        """Computes the regressor (n, J, p) by standard parameters."""
        return self.reference.compiled.regressor(*self._select_states(window))

    def _select_states(self, window: slice) -> tuple[np.ndarray | None, ...]:
        read = None if self.model_signals is None else self.model_signals[window]
        return self.q[window], self.v[window], self.a[window], read

    @cached_property
    def column_maxima(self) -> np.ndarray:
        """Returns the largest magnitude of each column of a standard parameter, (p,)."""
        size = THRESHOLDS.sample_window
        windows = [slice(k, k + size) for k in range(0, len(self.q), size)]
        largest = [np.abs(self.compute_regressor(w)).max(axis=(0, 1)) for w in windows]
        return np.asarray(np.max(largest, axis=0))

    @cached_property
    def load(self) -> np.ndarray:
        """Returns the torque (n, J) of the links, inertia and gravity."""
        return self._compute_torque(self.reference.link_parameters)

    @cached_property
    def static(self) -> np.ndarray:
        """Returns the torque (n, J) of gravity."""
        return self.reference.compiled.gravity(self.q, self.reference.link_parameters)

    @cached_property
    def torque(self) -> np.ndarray:
        """Returns the torque (n, J) of the whole model, friction by the measured speeds."""
        return self._compute_torque(self.reference.beta)

    def _compute_torque(self, beta: np.ndarray) -> np.ndarray:
        model = self.reference.compiled
        return model.inverse_dynamics(self.q, self.v, self.a, beta, self.model_signals)

    @cached_property
    def rate(self) -> np.ndarray:
        """Returns the time derivative of `torque`, (n, J)."""
        return np.gradient(self.torque, self.step, axis=0)

    def compute_reversal_time(self, j: int, back: float) -> np.ndarray:
        """Computes s (n,) since joint j last turned back, by more than `back`."""
        known, key = self._reversal_times, (j, back)
        if key not in known:
            _, known[key] = regression.compute_time_since_reversal(self.q[:, j], self.step, back)
        return known[key]

    @cached_property
    def _reversal_times(self) -> dict[tuple[int, float], np.ndarray]:
        return {}

    @cached_property
    def coupling(self) -> np.ndarray:
        """Returns G of ud = G qd, (n, variables, J); only for robots with loops."""
        return self.reference.compiled.coupling(self.q)

    @cached_property
    def time(self) -> np.ndarray:
        """Returns the time of effects, s, (n,)."""
        return self.segment.time - self.reference.time

    def select_other(self, name: str) -> np.ndarray:
        """Returns `v3`, (n,): position, speed or acceleration of a joint by its name."""
        names = [joint.name for joint in self.reference.compiled.spec.joints]
        return np.asarray(getattr(self, name[0])[:, names.index(name[1:])])

    def compute_temperature(self, joint: str) -> np.ndarray | None:
        """Computes K above the reference, (n,); None where training logs have no such column.

        0 where only another log lacks it: nobody knows better.
        """
        if joint not in self.reference.temperature:
            return None
        for name in (f"temperature{joint}", "temperature"):
            if name in self.segment.extra:
                return self.segment.extra[name] - self.reference.temperature[joint]
        return np.zeros(len(self.q))

    def compute_memory_state(
        self, memory: InternalState, j: int, shapes: Mapping[str, float], followed: np.ndarray
    ) -> np.ndarray:
        """Computes inner state z (n,) on joint j from parameters and what a lag follows (n,)."""
        if memory.kind == "lag":
            return apply_lag(followed, self.step, shapes[memory.parameter])
        if memory.kind in ("slip", "bouc_wen"):
            loop = shapes[memory.parameter], shapes.get(memory.share, 1.0)
            return regression.compute_bristle_state(self.q[:, j], *loop)
        frequency, damping = shapes[memory.parameter], shapes[memory.damping]
        return simulate_resonance(self.load[:, j], self.step, frequency, damping)

    def compute_slopes(self, j: int) -> tuple[np.ndarray, ...]:
        """Computes derivatives (n, J) of the links' torque by q, v and a of joint j.

        The torque is quadratic in v and linear in a: there differences are exact.
        """
        if j not in self._slope_cache:
            self._slope_cache.clear()  # those of one joint are cached
            self._slope_cache[j] = tuple(self._compute_slope(j, k) for k in range(3))
        return self._slope_cache[j]

    @cached_property
    def _slope_cache(self) -> dict[int, tuple[np.ndarray, ...]]:
        return {}

    def _compute_slope(self, j: int, kind: int) -> np.ndarray:
        model, beta = self.reference.compiled, self.reference.link_parameters
        size = (THRESHOLDS.position_step, 1.0, 1.0)[kind]
        step = np.zeros(self.q.shape[1])
        step[j] = size
        ahead, behind = [self.q, self.v, self.a], [self.q, self.v, self.a]
        ahead[kind] = ahead[kind] + step
        if kind == 2:
            signals = self.model_signals
            return model.inverse_dynamics(self.q, self.v, ahead[2], beta, signals) - self.load
        behind[kind] = behind[kind] - step
        if kind == 0:  # beside the last posture that closes the loops may be one that does not
            nearest = regression.find_nearest_closed(model, ahead[0], behind[0])
            if nearest is not None:
                ahead[0], behind[0] = ahead[0][nearest], behind[0][nearest]
        ends = ((*x, beta, self.model_signals) for x in (ahead, behind))
        forth, back = (model.inverse_dynamics(*x) for x in ends)
        return (forth - back) * (0.5 / size)

    def compute_displacement_torque(
        self, j: int, dq: np.ndarray, whole: bool = False, window: slice = EVERY
    ) -> np.ndarray:
        """Computes torques (m, J, k) that k small changes dq (n, k) of joint j cause.

        The derivative of the inverse dynamics of the links along (dq, dq', dq'').

        Args:
            j: index of the joint.
            dq: rad or m.
            whole: True if rotor and viscous friction are moved too.
            window: m of the samples.
        """
        start, stop, _ = window.indices(len(dq))
        first = max(0, start - THRESHOLDS.difference_reach)
        dq = dq[first : stop + THRESHOLDS.difference_reach]
        inside = slice(start - first, stop - first)
        torque = np.zeros((self.q.shape[1], stop - start, dq.shape[1]))
        if not dq.any():
            return torque.swapaxes(0, 1)
        dv = np.gradient(dq, self.step, axis=0)
        da = np.gradient(dv, self.step, axis=0)
        dq, dv, da = dq[inside], dv[inside], da[inside]
        slopes, part = [slope[start:stop] for slope in self.compute_slopes(j)], np.empty_like(dq)
        for k in range(self.q.shape[1]):
            place, speed, acceleration = (slope[:, k, None] for slope in slopes)
            np.multiply(place, dq, out=torque[k])
            torque[k] += np.multiply(speed, dv, out=part)
            torque[k] += np.multiply(acceleration, da, out=part)
        if whole:
            viscous, rotor = self.reference.drive_parameters[:, j]
            torque[j] += viscous * dv + rotor * da
        return torque.swapaxes(0, 1)


def apply_lag(x: np.ndarray, step: float, tau: float) -> np.ndarray:
    """Returns z (n,) of z' = (x - z)/tau, at rest under the first x; x is piecewise linear.

    With p = exp(-step/tau), r = (1 - p) tau/step: z_k = p z_(k-1) + (1 - r) x_k + (r - p) x_(k-1).
    """
    decay = np.exp(-step / tau)
    ramp = (1.0 - decay) * tau / step
    held = np.array([1.0 - ramp, ramp - decay, 0.0])
    return np.asarray(x[0] + apply_biquad(x - x[0], held, np.array([1.0, -decay, 0.0])))


def simulate_resonance(
    load: np.ndarray, step: float, frequency: float, damping: float
) -> np.ndarray:
    """Returns z (n,) of z'' = w^2 (load - z) - 2 zeta w z', at rest under the first load."""
    numerator, denominator = _discretise_oscillator(step, frequency, damping)
    return np.asarray(load[0] + apply_biquad(load - load[0], numerator, denominator))


@lru_cache(maxsize=1024)
def _discretise_oscillator(
    step: float, frequency: float, damping: float
) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of the resonance on a grid, loads straight between its points.

    With x' = A x + b u, z = c x, and u straight over a step h (Franklin, Powell and Workman 1997,
    Digital Control of Dynamic Systems, section 6.3.2):

        exp [[A h, b h, 0], [0, 0, 1], [0, 0, 0]] = [[F, g, k], ...],
        z = (c (s - F)^-1 (g - k + F k) + c k) u.
    """
    w = 2.0 * np.pi * min(frequency, 0.4 / step)
    system, c = np.array([[-2.0 * damping * w, -(w**2)], [1.0, 0.0]]), np.array([0.0, w**2])
    whole = np.zeros((4, 4))
    whole[:2, :2], whole[0, 2], whole[2, 3] = system * step, step, 1.0
    transition = expm(whole)
    F, g, k = transition[:2, :2], transition[:2, 2], transition[:2, 3]
    denominator, closed = (
        np.array([1.0, -np.trace(m), m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]])
        for m in (F, F - np.outer(g - k + F @ k, c))
    )
    return closed + (c @ k - 1.0) * denominator, denominator


# Gravity from another direction: torques for unit gravity across the one the model has.


def compute_tilt_columns(signals: Signals, window: slice = slice(None)) -> np.ndarray:
    """Computes torques (n, J, k) of unit gravity along two axes across gravity, then others.

    Of an arm that moves in a plane, along the one that acts on it.
    The others belong to first moments that the model's gravity hides (those of a vertical first
    axis): the tilt makes them observable. Empty without gravity, and for robots with loops.
    """
    basis, q = signals.reference.tilt_directions, signals.q[window]
    if not basis:  # a slide along gravity is subject to no other
        return np.zeros((*q.shape, 0))
    slopes = compute_frame_slopes(signals.reference.compiled, q)
    return np.stack([compute_gravity_torque(slopes, axis, chi) for axis, chi in basis], axis=-1)


def compute_frame_slopes(model: "CompiledModel", q: np.ndarray) -> np.ndarray:
    """Computes d/dq_j of [R | p] of every moving row, (n, J, rows, 3, 4), by differences."""
    slopes = [
        model.forward_kinematics(q + step) - model.forward_kinematics(q - step)
        for step in THRESHOLDS.tilt_step * np.eye(q.shape[1])
    ]
    return np.stack(slopes, axis=1) / (2.0 * THRESHOLDS.tilt_step)


def compute_gravity_torque(slopes: np.ndarray, axis: np.ndarray, chi: np.ndarray) -> np.ndarray:
    """Computes the torque (n, J) for gravity `axis`: -d/dq of axis . sum (M p + R MS).

    Args:
        slopes: (n, J, rows, 3, 4) of `compute_frame_slopes`.
        axis: (3,) m/s^2 in frame 0.
        chi: (rows, 4) M, MX, MY, MZ of every moving row.
    """
    moments = np.column_stack([chi[:, 1:], chi[:, 0]])
    weights = axis[None, :, None] * moments[:, None, :]
    return -slopes.reshape(*slopes.shape[:2], -1) @ weights.ravel()


def compute_tilt_basis(reference: SignalReference) -> list[tuple[np.ndarray, np.ndarray]] | None:
    """Computes axes and first moments of the columns of `compute_tilt_columns`."""
    model = reference.compiled
    if model.spec.closure is not None:
        return None
    rows = [p.joint for p in model.spec.standard if p.effect == "rigid_body" and p.name[0] == "M"]
    rows = list(dict.fromkeys(rows))
    if len(rows) != model.forward_kinematics(np.zeros((1, len(model.spec.joints)))).shape[1]:
        return None  # virtual rows: which frame is whose is not in the manifest
    # first moments and masses that give the model's torques: the base columns' own
    chi, moments = np.zeros((len(rows), 4)), ("M", "MX", "MY", "MZ")
    place = {f"{m}{row}": (r, k) for r, row in enumerate(rows) for k, m in enumerate(moments)}
    for base, value in zip(model.spec.base, reference.link_parameters, strict=True):
        if base.column_of in place:
            chi[place[base.column_of]] = value
    size, least = (THRESHOLDS.tilt_states, len(model.spec.joints)), THRESHOLDS.min_tilt_torque
    q = np.random.default_rng(3).uniform(-1.5, 1.5, size)
    unit = np.eye(3)
    slopes = compute_frame_slopes(model, q)
    along = np.column_stack([compute_gravity_torque(slopes, e, chi).ravel() for e in unit])
    target = model.gravity(q, reference.link_parameters).ravel()
    if np.linalg.norm(target) <= least or np.linalg.norm(along) <= least:
        return None
    gravity = np.linalg.lstsq(along, target, rcond=None)[0]
    down = gravity / np.linalg.norm(gravity)
    first = unit[int(np.argmin(np.abs(down)))]
    across = first - down * (down @ first)
    across = across / np.linalg.norm(across)
    axes = (across, np.cross(down, across))
    # an arm that moves in a plane is not subject to gravity across it
    torques = [(axis, compute_gravity_torque(slopes, axis, chi)) for axis in axes]
    basis = [(axis, chi) for axis, torque in torques if np.linalg.norm(torque) > least]
    return basis + _find_hidden_moments(slopes, axes, down, len(rows))


def compute_tilt_axes(reference: SignalReference) -> np.ndarray:
    """Computes the directions (k, 3) of the first of `compute_tilt_columns`.

    Those of the change of gravity itself.
    """
    basis = compute_tilt_basis(reference)
    assert basis is not None, "there is gravity"
    return np.array([axis for axis, chi in basis if chi is basis[0][1]])


def _find_hidden_moments(
    slopes: np.ndarray, axes: tuple[np.ndarray, np.ndarray], down: np.ndarray, rows: int
) -> list[tuple[np.ndarray, np.ndarray]]:
    """First moments without torque under the model's gravity that the others make observable."""
    moments: list[tuple[np.ndarray, np.ndarray]] = []
    known = np.zeros((slopes.shape[0] * slopes.shape[1], 0))
    for r in range(rows):
        for k in (1, 2, 3):
            chi = np.zeros((rows, 4))
            chi[r, k] = 1.0
            torque = compute_gravity_torque(slopes, down, chi)
            if np.linalg.norm(torque) > THRESHOLDS.min_tilt_torque:
                continue
            for axis in axes:
                column = compute_gravity_torque(slopes, axis, chi).ravel()
                rest = column - known @ (known.T @ column)
                if np.linalg.norm(rest) > 1e-3 * max(1.0, float(np.linalg.norm(column))):
                    known = np.column_stack([known, rest / np.linalg.norm(rest)])
                    moments.append((axis, chi))
    return moments
