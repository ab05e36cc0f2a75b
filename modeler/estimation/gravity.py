"""Hypotheses on channels of logs: turned, other units, other times, another gravity.

Gravity is a vector g of frame 0 that the torques of logs carry. Torques are linear in it beside
standard parameters, tau = (W_motion + sum_d g_d G_d) chi, where
G_d chi = -d/dq (e_d . sum_j (M_j p_j + R_j MS_j)) for the frames [R_j | p_j] of the links. A log
of drives that take gravity out has g = 0, a table with a wrong sign -g, a base that hangs another
direction. Where positions close loops, a factor of the stated gravity is all that is requested.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import block_diag, csr_array

from modeler import regression
from modeler.estimation.physical_consistency import PhysicalParameters, define_physical_parameters
from modeler.estimation.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel, average_rows

_CLOCKS = (2.0, 0.5, 0.2, 5.0, 10.0, 20.0, 50.0, 100.0, 0.1, 0.05, 0.02, 0.01)  # are off by


@dataclass(frozen=True, eq=False)
class ThinnedRows:
    """Holds some rows of an observation, and some of the samples that those reach.

    Attributes:
        W: (m, n, c).
        tau: (m, n).
        used: (m, n) that count.
        weights: (m, samples) of the samples in each row.
        usable: (samples, n) which samples count for a joint.
        samples: by segment, its segment and places in it.
        read: (samples, k) other inputs of the model; None without any.
    """

    W: np.ndarray
    tau: np.ndarray
    used: np.ndarray
    weights: csr_array
    usable: np.ndarray
    samples: tuple[tuple[regression.Segment, np.ndarray], ...]
    read: np.ndarray | None

    @cached_property
    def motion(self) -> np.ndarray:
        """Returns the motion q, qd, qdd of the samples, (3, samples, n)."""
        every = [np.stack([s.q[k], s.qd[k], s.qdd[k]]) for s, k in self.samples]
        return np.concatenate(every, axis=1)

    def filter_values(
        self, evaluate: Callable[[slice], np.ndarray], spans: Sequence[slice] | None = None
    ) -> np.ndarray:
        """Returns (m, n, k) rows of what the samples have.

        Args:
            evaluate: (samples of a window, n, k).
            spans: of each joint, the columns that are not 0; None: all.
        """
        rows = []
        for window, weights in self._blocks:
            usable, values = self.usable[window], evaluate(window)
            every = np.ones((len(weights[2]) - 1, usable.shape[1]), dtype=bool)
            none = np.zeros(len(values), dtype=bool)
            rows.append(average_rows(weights, values, usable, every, none, spans))
        return np.concatenate(rows)

    @cached_property
    def _blocks(self) -> list[tuple[slice, tuple[np.ndarray, np.ndarray, np.ndarray]]]:
        """Windows of samples, and the weights of the rows that reach into them."""
        blocks, count = [], THRESHOLDS.thinned_block_rows
        for first in range(0, len(self.used), count):
            part = self.weights[first : first + count]
            start, stop = (int(part.indices.min()), int(part.indices.max())) if part.nnz else (0, 0)
            weights = part.data, part.indices - start, part.indptr
            blocks.append((slice(start, stop + 1), weights))
        return blocks

    def transform_columns(
        self, compiled: CompiledModel, how: "MotionTransform", beta: np.ndarray | None = None
    ) -> np.ndarray:
        """Returns (m, n, c) columns of the motion with other positions, or by another clock.

        With parameters beta (c,) their torques, (m, n).
        """
        q, qd, qdd = self.motion @ how.motion
        moved = q + how.offset, how.speed * qd, how.speed**2 * qdd
        return self._evaluate_columns(compiled, moved, beta)

    def shift_columns(
        self, compiled: CompiledModel, shift: np.ndarray, beta: np.ndarray | None = None
    ) -> np.ndarray:
        """Returns (m, n, c) columns of the motion of each joint, shift (n,) s later.

        With parameters beta (c,) their torques, (m, n); of all joints alike they are made once.
        """
        key = shift.tobytes(), b"" if beta is None else beta.tobytes()
        if key in self._shifted_torques:
            return self._shifted_torques[key]
        motion, first = self.motion.copy(), 0
        for s, k in self.samples:
            part = motion[:, first : first + len(k)]
            first += len(k)
            for j in np.flatnonzero(shift):
                place = (s.time[k] + shift[j] - s.time[0]) / s.step
                below = np.clip(place.astype(int), 0, s.samples - 2)
                above = np.clip(place - below, 0.0, 1.0)
                for moved, x in zip(part, (s.q, s.qd, s.qdd), strict=True):
                    moved[:, j] = x[below, j] * (1.0 - above) + x[below + 1, j] * above
        columns = self._evaluate_columns(compiled, motion, beta)
        if beta is not None and np.ptp(shift) == 0.0:
            self._shifted_torques[key] = columns
        return columns

    @cached_property
    def _shifted_torques(self) -> dict[tuple[bytes, bytes], np.ndarray]:
        return {}

    def _evaluate_columns(
        self, compiled: CompiledModel, motion: Iterable[np.ndarray], beta: np.ndarray | None
    ) -> np.ndarray:
        """Returns (m, n, c) filtered columns of a motion of the samples; with beta (m, n)."""
        q, qd, qdd = motion
        nearest = regression.find_nearest_closed(compiled, q)  # a changed one may leave the loops
        if nearest is not None:
            q = np.ascontiguousarray(q[nearest])

        def evaluate(w: slice) -> np.ndarray:
            read = None if self.read is None else self.read[w]
            if beta is None:
                return compiled.base_regressor(q[w], qd[w], qdd[w], read)
            return compiled.inverse_dynamics(q[w], qd[w], qdd[w], beta, read)

        return self.filter_values(evaluate, compiled.pattern.spans if beta is None else None)


def thin_rows(compiled: CompiledModel, observation: regression.Observation) -> ThinnedRows:
    """Returns at most so many of the rows of the observation, evenly; fewer of many joints."""
    cells = THRESHOLDS.max_thinned_cells // len(observation.joints)
    most = max(1, min(THRESHOLDS.max_thinned_rows, cells))
    every = max(1, -(-len(observation.time) // most))
    kernels, usable = list[csr_array](), list[np.ndarray]()
    samples, read, chosen, at = [], [], [], 0
    for part in observation.stretches:
        rows = np.arange(-at % every, len(part.used), every)
        chosen.append(at + rows)
        at += len(part.used)
        if not rows.size:
            continue
        weights = part.rows.weights[rows]
        width = max(1, int(np.max(np.diff(weights.indptr))))
        reached = np.unique(weights.indices)
        reached = reached[reached % max(1, width // THRESHOLDS.filter_taps) == 0]
        kernels.append(weights[:, reached])
        usable.append(part.usable[reached])
        samples.append((part.segment, reached))
        signals = regression.compute_signals(compiled, part.segment)
        read += [] if signals is None else [signals[reached]]
    place = np.concatenate(chosen)
    return ThinnedRows(
        W=regression.evaluate_columns_at(observation, place),
        tau=observation.torque[place],
        used=observation.used[place],
        weights=block_diag(kernels, format="csr"),
        usable=np.concatenate(usable),
        samples=tuple(samples),
        read=np.concatenate(read) if read else None,
    )


@dataclass(frozen=True)
class MotionTransform:
    """Describes what may be wrong with positions, or with the clock, and what repairs it.

    Attributes:
        line: what, and what to do.
        motion: (J, J) q = measured q motion + offset, and its derivatives alike.
        offset: (J,) rad or m.
        torque: (J,) tau_j = measured tau[torque[j]].
        speed: times that of the log.
    """

    line: str
    motion: np.ndarray
    offset: np.ndarray
    torque: np.ndarray
    speed: float = 1.0


def propose_clocks(
    observation: regression.Observation, nearest_only: bool = False
) -> Iterator[MotionTransform]:
    """Yields all motion faster or slower than it is logged, or by small factors only."""
    same = np.eye(len(observation.joints))
    for speed in _CLOCKS[:3] if nearest_only else _CLOCKS:
        line = (
            f"the clock seems to be wrong: with all motion {speed:g} times as fast, torques are "
            "those of a machine; check the time column, its unit and rate"
        )
        yield MotionTransform(line, same, np.zeros(len(same)), np.arange(len(same)), speed)


def propose_zero(observation: regression.Observation, j: int, degrees: float) -> MotionTransform:
    """Returns positions of a joint that turns, counted from another zero."""
    line = (
        f"joint {observation.joints[j].name}: its zero seems to be off by {degrees} degrees, by "
        "gravity and the other joints; check the zero of that encoder against the table"
    )
    same = np.eye(len(observation.joints))
    return MotionTransform(line, same, -np.deg2rad(degrees) * same[j], np.arange(len(same)))


def propose_zeros(observation: regression.Observation) -> Iterator[MotionTransform]:
    """Yields positions of each joint that turns, from zeros a quarter or half a turn off."""
    for j, joint in enumerate(observation.joints):
        for degrees in (90, -90, 180) if joint.unit == "rad" else ():
            yield propose_zero(observation, j, degrees)


def propose_transforms(observation: regression.Observation) -> Iterator[MotionTransform]:
    """Yields positions in other units, reversed, exchanged, torques too."""
    joints, names = observation.joints, [joint.name for joint in observation.joints]
    same, none = np.arange(len(joints)), np.zeros(len(joints))
    expected = "expected rad and m; convert the position, and the speeds if they are logged"
    angles, lengths = {"degrees": np.pi / 180.0, "turns": 2.0 * np.pi}, {"mm": 1e-3, "cm": 1e-2}
    for rad, metre in zip(angles.items(), lengths.items(), strict=True):
        units = [rad if joint.unit == "rad" else metre for joint in joints]
        factors = np.array([factor for _, factor in units])
        text = " or ".join(dict.fromkeys(unit for unit, _ in units))
        line = f"the positions look like {text}; {expected}"
        yield MotionTransform(line, np.diag(factors), none, same)
        for j, (unit, factor) in enumerate(units):
            line = f"joint {names[j]}: its position looks like {unit}; {expected}"
            yield MotionTransform(line, np.diag(np.where(same == j, factor, 1.0)), none, same)
    for j in range(len(joints)):
        line = f"joint {names[j]}: its position seems to be counted the other way; check its sign"
        yield MotionTransform(line, np.diag(np.where(same == j, -1.0, 1.0)), none, same)
        for k in range(j):
            order = same.copy()
            order[[j, k]] = order[[k, j]]
            swap = np.eye(len(joints))[order]
            for what, torque in (("positions", same), ("columns, torques too,", order)):
                line = (
                    f"joints {names[k]} and {names[j]}: their {what} look exchanged; check the "
                    "order of the columns"
                )
                yield MotionTransform(line, swap, none, torque)


ABSENT = "the torques carry no gravity"
"""What a line says beside which no clock is to blame: at rest, none makes gravity vanish."""

_EARTH = 9.81  # m/s^2
_SCAN = (-2.0, -1.0, -0.5, 0.0, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 4.0)  # factors
_ROUND = (0.0, 0.5, 2.0, -1.0)  # preferred where they do as well

Score = Callable[[np.ndarray], float]
"""Sum of the logarithms of the errors with a gravity (k,)."""

Step = Callable[[np.ndarray], np.ndarray]
"""By Gauss and Newton, from a gravity to a better one."""


@dataclass(frozen=True, eq=False)
class GravityModel:
    """Describes how rows of logs depend on gravity.

    Attributes:
        machine: whose parameters the p columns belong to.
        motion: (m, n, p) columns without gravity.
        per_axis: (k, m, n, p) of 1 m/s^2 along the axes of frame 0, or of the stated gravity alone.
        stated: (k,) in the robot file.
    """

    machine: PhysicalParameters
    motion: np.ndarray
    per_axis: np.ndarray
    stated: np.ndarray

    def propose_candidates(self, score: Score, step: Step, turned: bool) -> list[np.ndarray]:
        """Returns gravities that may explain torques better than the stated one.

        Args:
            score: that is to be least.
            step: to a better gravity.
            turned: True if other directions are requested.
        """
        candidates: list[np.ndarray] = []
        equal = THRESHOLDS.equal_log_error
        if self.stated.any():
            scan = list(_SCAN)
            for _ in range(THRESHOLDS.gravity_scans):
                scores = [score(x * self.stated) for x in scan]
                best = int(np.argmin(scores))
                least, least_score = scan[best], scores[best]
                span = scan[max(0, best - 1)], scan[min(len(scan) - 1, best + 1)]
                scan = [float(x) for x in np.linspace(*span, 9)]
            rounded = [x for x in _ROUND if score(x * self.stated) <= least_score + equal]
            factor = rounded[0] if rounded else least
            change = min(abs(factor), abs(factor - 1.0))
            if factor == 0.0 or change > THRESHOLDS.min_gravity_change:
                candidates.append(factor * self.stated)
        if turned and len(self.stated) == 3:
            axes = [sign * _EARTH * axis for axis in np.eye(3) for sign in (1.0, -1.0)]
            starts = [self.stated, *sorted(axes, key=score)[: THRESHOLDS.gravity_starts]]
            g = min((_minimize_error(start, score, step) for start in starts), key=score)
            size = float(np.linalg.norm(self.stated)) or _EARTH
            as_large = g * size / max(float(np.linalg.norm(g)), THRESHOLDS.rounding_share)
            if not 0.5 < np.linalg.norm(g) / size < 2.0 or score(as_large) <= score(g) + equal:
                g = as_large
            if self._compare_stated(g)[1] > THRESHOLDS.min_tilt:
                candidates.append(g)
        return candidates

    def _compare_stated(self, g: np.ndarray) -> tuple[float, float]:
        """Returns the factor of the stated gravity, and rad between both; 0 and pi / 2 if none."""
        size, length = float(np.linalg.norm(self.stated)), float(np.linalg.norm(g))
        factor = float(g @ self.stated / max(size, 1e-9) ** 2)
        cosine = abs(g @ self.stated) / max(size * length, 1e-9) if length else 1.0
        return factor, float(np.arccos(min(1.0, cosine)))

    def format_line(self, g: np.ndarray) -> str:
        """Returns what is wrong, and what to do."""
        factor, angle = self._compare_stated(g)
        if angle > THRESHOLDS.min_tilt:
            stated, asked = (str((v.round(1) + 0.0).tolist()) for v in (self.stated, g))
            return (
                f"gravity of the robot file, {stated} m/s2, does not fit the torques: they need "
                f"about {asked} in frame 0; check gravity there and how the base is mounted"
            )
        if factor == 0.0:
            return (
                f"{ABSENT}: the drives compensate it or the log leaves it out; "
                "log the whole torque, or fit with gravity = [0, 0, 0]"
            )
        if factor < 0.0:
            return (
                f"gravity acts against its direction in the robot file, {-factor:.2g} times as "
                "large. Its sign there, the sign of an alpha and a zero off by 180 degrees are "
                "equal in the equations; check all three"
            )
        cause = "the drives compensate the rest, or" if factor < 1.0 else "check whether"
        return (
            f"the torques carry {factor:.2g} times the gravity of the robot file: {cause} gravity "
            "there is not in m/s2 or not that of the logs; check both"
        )


def _minimize_error(g: np.ndarray, score: Score, step: Step) -> np.ndarray:
    least = score(g)
    for _ in range(THRESHOLDS.gravity_steps):
        further = g + step(g)
        if (reached := score(further)) >= least:
            break
        g, least = further, reached
    return g


def extract_gravity(compiled: CompiledModel, rows: ThinnedRows, free: bool) -> GravityModel | None:
    """Returns how rows depend on gravity; None where they do not.

    Args:
        compiled: the robot.
        rows: of logs.
        free: True if parameters are to be fitted; else a factor of gravity alone is requested.
    """
    motion, still = _split_gravity(compiled, rows)
    machine, count = define_physical_parameters(compiled.spec), THRESHOLDS.max_gravity_columns
    if free and compiled.spec.closure is None and len(machine.names) <= count:
        per_axis = _evaluate_axes(compiled, rows, machine, rows.motion[0])
        if per_axis is not None:
            weight, flat = (still @ machine.K).ravel(), per_axis.reshape(3, -1)
            stated = np.linalg.lstsq(flat @ flat.T, flat @ weight, rcond=1e-9)[0]
            if np.linalg.norm(stated @ flat - weight) <= 1e-4 * np.linalg.norm(weight):
                standard = replace(machine, K=np.eye(len(machine.names)))
                rounded = np.asarray(np.round(stated, 6) + 0.0)
                return GravityModel(standard, motion @ machine.K, per_axis, rounded)
    return GravityModel(machine, motion, still[None], np.ones(1)) if still.any() else None


def _split_gravity(compiled: CompiledModel, rows: ThinnedRows) -> tuple[np.ndarray, np.ndarray]:
    """Returns columns (m, n, c) of the motion, without what is rounding, and of gravity."""
    q, qd, qdd = rows.motion
    is_inertial = np.array([base.kind == "inertial" for base in compiled.spec.base])
    largest = np.zeros((2, len(is_inertial)))

    def evaluate(w: slice) -> np.ndarray:
        read, none = None if rows.read is None else rows.read[w], np.zeros_like(q[w])
        whole = compiled.base_regressor(q[w], qd[w], qdd[w], read)
        at_rest = compiled.base_regressor(q[w], none, none, read) * is_inertial
        both = np.stack([whole - at_rest, whole], axis=2)
        np.maximum(largest, np.abs(both).max(axis=(0, 1)), out=largest)
        both[:, :, 1] = at_rest
        return both

    both = rows.filter_values(evaluate)
    moves = largest[0] > THRESHOLDS.rounding_share * largest[1]
    return both[:, :, 0] * moves, both[:, :, 1]


def _evaluate_axes(
    compiled: CompiledModel, rows: ThinnedRows, machine: PhysicalParameters, q: np.ndarray
) -> np.ndarray | None:
    """Returns (3, m, n, p) of 1 m/s^2 along each axis of frame 0; None without named frames."""
    difference, shape = THRESHOLDS.gravity_step, (q.shape[1], len(machine.links), 3, 4)
    if compiled.forward_kinematics(q[:1]).shape[1] != len(machine.links):
        return None

    def evaluate(w: slice) -> np.ndarray:
        slopes = np.empty((len(q[w]), *shape))
        for j, step in enumerate(difference * np.eye(q.shape[1])):
            slopes[:, j] = compiled.forward_kinematics(q[w] - step)
            slopes[:, j] -= compiled.forward_kinematics(q[w] + step)
        slopes /= 2.0 * difference
        slopes[np.abs(slopes) < THRESHOLDS.rounding_share] = 0.0
        return slopes.reshape(*slopes.shape[:2], -1)

    weight = rows.filter_values(evaluate).reshape(-1, *shape)
    per_axis = np.zeros((3, *weight.shape[:2], len(machine.names)))
    for link, places in enumerate(machine.links.values()):
        per_axis[..., places[6:]] = np.moveaxis(weight[:, :, link], 2, 0)  # MX, MY, MZ, M
    return per_axis
