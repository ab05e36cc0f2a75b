"""The direct model: a fitted robot that follows the motion of a log, without noise.

The controller of the log is not known. The one here is a cascade of position and speed loop as
drives have it, scheduled with the model's own inertia, so that its bandwidth does not depend on the
parameters (Gautier, Janot and Vandanjon 2013, IEEE Trans. Control Systems Technology 21(2)):

    M(q) qdd + h(q, qd) = M(q) (kv e + f qdd_r) + effort,  e = r kv (q_r - q) + f qd_r - qd,
    effort' = i kv^2/4 M(q) e.

Speed loop kv, ratio r of the position loop, integral action i and feedforward f (0 or 1) are those
that bring the simulated positions nearest to the logged ones. Without a logged command the
reference is the logged motion, smoothed, and only kv is chosen: the motion along which the torques
fit best.
"""

import dataclasses
import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.regression import (
    HIGHEST,
    Observation,
    Segment,
    apply_low_pass,
    compute_signals,
    differentiate_positions,
)
from modeler.runtime import CompiledModel

BANDWIDTHS = (2.0, 4.0, 8.0, 16.0, 32.0, 64.0)
"""Hz of the speed loops that are tried."""

KINDS = ((0.25, 1.0), (0.25, 0.0), (1.0, 0.0), (2.0, 0.0))
"""Ratio of the position loop and integral action that are tried: a drive's cascade, and PD."""

_FINER = (1.5, 1.2, 1.07)  # widest factors on speed and ratio, one search after the other

_LONGEST = 1e-3  # s, of a step
_STABLE = 0.4  # kv times the step at most
_INTEGRAL = 0.25  # of the speed loop
_SHARE = 0.5  # of the position cut-off: low-pass of a reference made of the logged motion
_WINDOW = 0.5  # s, of a piece that is simulated beside the others
_WARM = 1.0  # s, simulated before it and left out: by then the start is forgotten
_TRIED = 5  # pieces on which the loop is chosen
_LOST = 10.0  # ranges of motion from the reference at which the robot is lost
_FLOOR = 1e-2  # eigenvalues of the inertia matrix are raised to this, its median diagonal being 1

Motion = np.ndarray
"""(3, samples, joints) q, qd, qdd."""


@dataclass(frozen=True)
class ControlLoop:
    """A controller.

    Attributes:
        speed: kv, rad/s; infinite: the reference is carried out exactly.
        ratio: r.
        integral: i.
        forward: f, 1 if speed and acceleration of the reference are fed forward.
        distance: rms of simulated less logged position, as a share of that of reference less
            logged position; without commands, the criterion of the fit along its motion.
    """

    speed: float
    ratio: float
    integral: float
    forward: float
    distance: float = np.inf


@dataclass(frozen=True, eq=False)
class _Window:
    """Samples of a segment, simulated from `first`, kept from `start` to `stop`."""

    segment: int
    first: int
    start: int
    stop: int


class DirectModel:
    """A robot that follows the logs of an observation.

    Attributes:
        commanded: the reference is the commanded motion of all logs; else the logged one, smoothed.
    """

    def __init__(self, model: CompiledModel, observation: Observation) -> None:
        self.model, self.observation = model, observation
        self.segments = [part.segment for part in observation.stretches]
        self.commanded = all(segment.commanded is not None for segment in self.segments)
        self.cutoff = observation.report.processing.position_cutoff
        self.references = [self._build_reference(segment) for segment in self.segments]
        self.signals = [compute_signals(model, segment) for segment in self.segments]
        self.raised = 0.0  # share of samples whose inertia matrix was not positive definite
        self.lightest = 0  # the joint that moves most along its lowest eigenvalue

    def evaluate_columns(self, motions: list[Motion]) -> np.ndarray:
        """(rows, c) the columns of W along motions, filtered as those of the log."""
        places = {id(segment): i for i, segment in enumerate(self.segments)}

        def evaluate(segment: Segment, window: slice) -> np.ndarray:
            i = places[id(segment)]
            signals = (
                None if (segment_signals := self.signals[i]) is None else segment_signals[window]
            )
            q, qd, qdd = motions[i][:, window]
            return self.model.base_regressor(q, qd, qdd, signals)

        return self.observation.filter_columns(evaluate)[self.observation.used]

    def choose_loop(self, beta: np.ndarray) -> ControlLoop:
        """The controller that brings the robot nearest to the logged positions.

        Expects commanded positions. Without them the nearest is the fastest, see
        `choose_loop_by_misfit`.
        """
        pieces = self._cut_windows()
        pieces = [pieces[i] for i in sorted({*np.linspace(0, len(pieces) - 1, _TRIED).astype(int)})]
        step, speeds = self._propose_speeds()
        tried = itertools.product(speeds, KINDS, (0.0, 1.0))
        rough = self._select_nearest(
            beta, pieces, [ControlLoop(kv, *kind, f) for kv, kind, f in tried]
        )
        for width in _FINER if np.isfinite(rough.distance) else ():
            factors = width ** np.linspace(-1.0, 1.0, 5)
            finer = [
                dataclasses.replace(rough, speed=rough.speed * a, ratio=rough.ratio * b)
                for a, b in itertools.product(factors, repeat=2)
                if rough.speed * a * step < _STABLE
            ]
            rough = self._select_nearest(beta, pieces, finer)
        if not np.isfinite(rough.distance) or rough.distance > 1.0:
            return ControlLoop(np.inf, 0.0, 0.0, 1.0, 1.0)
        return rough

    def choose_loop_by_misfit(
        self, beta: np.ndarray, misfit: Callable[[list[Motion]], float]
    ) -> ControlLoop:
        """The controller along whose motion the torques fit best, where no command was logged.

        The reference is the logged motion itself. Its positions say nothing of the controller: the
        faster that is, the nearer it comes to them and to their noise. So the cascade with integral
        action, which holds friction and gravity from the first sample on, and feedforward is
        taken, and its speed by `misfit`, the criterion of the fit along a motion.
        """
        best = ControlLoop(np.inf, 0.0, 0.0, 1.0, np.inf)
        for speed in self._propose_speeds()[1]:
            loop = ControlLoop(speed, *KINDS[0], 1.0)
            try:
                far = misfit(self.simulate_motions(beta, loop))
            except DataError:
                continue
            if far < best.distance:
                best = dataclasses.replace(loop, distance=far)
        return best

    def _propose_speeds(self) -> tuple[float, list[float]]:
        """Step of the simulation, s, and speed loops to try, rad/s."""
        step = min(_LONGEST, min(segment.step for segment in self.segments))
        return step, [2 * np.pi * f for f in BANDWIDTHS if 2 * np.pi * f * step < _STABLE]

    def _select_nearest(
        self, beta: np.ndarray, pieces: list[_Window], loops: list[ControlLoop]
    ) -> ControlLoop:
        count = len(pieces)
        ways = self._simulate_windows(
            beta, pieces * len(loops), [loop for loop in loops for _ in pieces]
        )
        far = [
            self._compute_distance(pieces, ways[i : i + count]) for i in range(0, len(ways), count)
        ]
        best = int(np.argmin(far))
        return dataclasses.replace(loops[best], distance=far[best])

    def simulate_motions(self, beta: np.ndarray, loop: ControlLoop) -> list[Motion]:
        """The motion of the robot with these parameters, one per segment.

        Raises:
            DataError: the controller loses the robot.
        """
        if np.isinf(loop.speed):
            return self.references
        pieces = self._cut_windows()
        ways = self._simulate_windows(beta, pieces, [loop] * len(pieces))
        motions = [np.empty_like(reference) for reference in self.references]
        for piece, way in zip(pieces, ways, strict=True):
            if not np.isfinite(way).all():
                raise DataError(
                    f"{self.model.spec.robot}: the direct model with the fitted values does not "
                    f"follow the log at {self.segments[piece.segment].time[piece.start]:.4g} s; "
                    'expected a fit whose inertia matrix is one; use method "weighted"'
                )
            motions[piece.segment][:, piece.start : piece.stop] = way
        return [
            _smooth_motion(segment, motion, self.cutoff)
            for segment, motion in zip(self.segments, motions, strict=True)
        ]

    def compute_position_error(self, motions: list[Motion]) -> np.ndarray:
        """(joints,) rms of simulated less logged position, as a share of the range of motion."""
        whole = np.concatenate([segment.whole for segment in self.segments])
        logged = np.concatenate([segment.q for segment in self.segments])[whole]
        away = np.concatenate([motion[0] for motion in motions])[whole] - logged
        extent = np.ptp(logged, axis=0)
        return np.sqrt(np.mean(away**2, axis=0)) / np.where(extent > 0.0, extent, 1.0)

    def _build_reference(self, segment: Segment) -> Motion:
        """Commanded positions with their derivatives, or the motion of the fit smoothed further.

        Derivatives that the log brought along are kept: those of its positions are noisier.
        """
        if self.commanded:
            assert segment.commanded is not None
            return differentiate_positions(segment.commanded, segment.step)
        motion = np.stack([segment.q, segment.qd, segment.qdd])
        return _smooth_motion(segment, motion, _SHARE * self.cutoff)

    def _cut_windows(self) -> list[_Window]:
        pieces = []
        for i, segment in enumerate(self.segments):
            length = max(2, round(_WINDOW / segment.step))
            warm = round(_WARM / segment.step)
            for start in range(0, segment.samples, length):
                stop = min(start + length, segment.samples)
                pieces.append(_Window(i, max(0, start - warm), start, stop))
        return pieces

    def _compute_distance(self, pieces: list[_Window], ways: list[Motion]) -> float:
        """rms of simulated less logged position, each joint in units of its own tracking error."""
        error, scale = np.zeros((2, len(self.observation.joints)))
        for piece, way in zip(pieces, ways, strict=True):
            segment, samples = self.segments[piece.segment], slice(piece.start, piece.stop)
            logged, whole = segment.q[samples], segment.whole[samples]
            error += np.sum((way[0] - logged)[whole] ** 2, axis=0)
            reference = self.references[piece.segment][0, samples]
            scale += np.sum((reference - logged)[whole] ** 2, axis=0)
        moved = scale > 0.0
        total = float(np.mean(error[moved] / scale[moved])) if moved.any() else 0.0
        return float(np.sqrt(total)) if np.isfinite(total) else np.inf

    def _simulate_windows(
        self, beta: np.ndarray, pieces: list[_Window], loops: list[ControlLoop]
    ) -> list[Motion]:
        """The pieces, each with its loop, simulated side by side; NaN where the robot is lost."""
        steps = [float(f"{self.segments[piece.segment].step:.4g}") for piece in pieces]
        ways: dict[int, Motion] = {}
        for step in sorted(set(steps)):
            indices = [i for i, other in enumerate(steps) if other == step]
            reference, signals = self._combine_windows([pieces[i] for i in indices])
            robot = _Robot(self.model, beta, reference)
            if robot.raised > self.raised:
                self.raised, self.lightest = robot.raised, robot.lightest
            # What is simulated begins where the log was.
            logged = [(self.segments[pieces[i].segment], pieces[i].first) for i in indices]
            start = np.stack([np.stack([s.q[at], s.qd[at]]) for s, at in logged], axis=1)
            motion = robot.integrate_motion(
                start, reference, signals, step, [loops[i] for i in indices]
            )
            for place, i in enumerate(indices):
                first = pieces[i].first
                ways[i] = motion[:, pieces[i].start - first : pieces[i].stop - first, place]
        return [ways[i] for i in range(len(pieces))]

    def _combine_windows(self, pieces: list[_Window]) -> tuple[np.ndarray, np.ndarray | None]:
        """(3, samples, pieces, joints) references, ends held, and (samples, pieces, m) signals."""
        every = np.arange(max(piece.stop - piece.first for piece in pieces))
        rows = [(p.segment, np.minimum(p.first + every, p.stop - 1)) for p in pieces]

        def stacked(values: Sequence[np.ndarray]) -> np.ndarray:
            return np.stack(
                [values[segment][..., samples, :] for segment, samples in rows], axis=-2
            )

        signals = [
            array for array in self.signals if array is not None
        ]  # of all segments, or of none
        return stacked(self.references), stacked(signals) if signals else None


def _smooth_motion(segment: Segment, motion: Motion, cutoff: float) -> Motion:
    highest = min(cutoff, HIGHEST / segment.step)
    return np.stack([apply_low_pass(signal, segment.step, highest) for signal in motion])


def scale_inertia(M: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """How near inertia matrices M (s, n, n) come to none, in units of their median diagonal.

    Returns (n, n) these units, (s,) the least eigenvalue of M in them, and the joint that moves
    most along the least of all.
    """
    diagonal = np.abs(np.median(np.einsum("sjj->sj", M), axis=0))
    scale = np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    units = np.outer(scale, scale)
    values, vectors = np.linalg.eigh(M / units)
    return units, values[:, 0], int(np.argmax(np.abs(vectors[np.argmin(values[:, 0]), :, 0])))


class _Robot:
    """M and tau for many states at once; h = tau(q, qd, qdd_r) - M qdd_r."""

    def __init__(self, model: CompiledModel, beta: np.ndarray, reference: np.ndarray) -> None:
        self.model, self.beta = model, beta
        q = reference[0].reshape(-1, reference.shape[-1])
        M = model.inertia_matrix(q[:: max(1, len(q) // 500)], beta)
        self.units, least, self.lightest = scale_inertia(M)
        self.raised = float(np.mean(least < _FLOOR))

    def compute_inertia(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """M of the model, and one that is positive definite: the same if it is."""
        M = self.model.inertia_matrix(q, self.beta)
        if self.raised == 0.0:
            return M, M
        values, vectors = np.linalg.eigh(M / self.units)
        lifted = np.maximum(values, _FLOOR)[:, None, :] * vectors
        return M, np.asarray((lifted @ vectors.transpose(0, 2, 1)) * self.units)

    def integrate_motion(
        self,
        start: np.ndarray,
        reference: np.ndarray,
        signals: np.ndarray | None,
        step: float,
        loops: list[ControlLoop],
    ) -> np.ndarray:
        """(3, samples, pieces, joints) the motion, by Adams and Bashforth of order 2."""
        inner = max(1, int(np.ceil(step / _LONGEST)))
        h, motion = step / inner, np.full(reference.shape, np.nan)
        far = _LOST * (np.ptp(reference[0], axis=(0, 1)) + 1e-6)
        settings = [(o.speed, o.ratio, o.integral, o.forward) for o in loops]
        kv, ratio, integral, f = np.array(settings).T[:, :, None]
        torque = self.model.inverse_dynamics
        (q, qd), (_, speed, qdd) = start, reference[:, 0]
        tau = torque(q, qd, qdd, self.beta, None if signals is None else signals[0])
        asked = kv * (ratio * kv * (reference[0, 0] - q) + f * speed - qd) + f * qdd
        effort = integral * (tau - _multiply_rows(self.compute_inertia(q)[1], asked))
        lost = np.zeros(len(q), dtype=bool)
        for k in range(reference.shape[1]):
            s = None if signals is None else signals[k]
            for m in range(inner):
                wanted, speed, push = reference[:, k]
                wanted = wanted + m * h * speed + 0.5 * (m * h) ** 2 * push
                speed = speed + m * h * push
                raw, M = self.compute_inertia(q)
                error = ratio * kv * (wanted - q) + f * speed - qd
                effort = effort + h * integral * _INTEGRAL * kv**2 * _multiply_rows(M, error)
                rest = torque(q, qd, push, self.beta, s) - _multiply_rows(raw, push)
                moved = np.linalg.solve(M, (effort - rest)[:, :, None])[:, :, 0]
                before, qdd = qdd, kv * error + f * push + moved
                if m == 0:
                    motion[:, k] = q, qd, qdd
                    motion[:, k, lost] = np.nan
                q = q + h * qd + 0.5 * h**2 * qdd
                qd = qd + h * (1.5 * qdd - 0.5 * before)
                gone = ~np.all(np.abs(q - wanted) < far, axis=1) | ~np.isfinite(qd).all(axis=1)
                if gone.any():
                    lost |= gone
                    q[gone], qd[gone], effort[gone], qdd[gone] = wanted[gone], speed[gone], 0.0, 0.0
        return motion


def _multiply_rows(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum("bij,bj->bi", matrix, vector))
