"""Estimators along a motion that was not measured: commanded, or simulated by the direct model.

The direct model is a fitted robot that follows the motion of a log, without noise. The controller
of the log is not known. The one here is a cascade of position and speed loop as drives have it,
scheduled with the model's own inertia, so that its bandwidth does not depend on the parameters
(Gautier, Janot and Vandanjon 2013, IEEE Trans. Control Systems Technology 21(2)):

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

from modeler import regression
from modeler.core.errors import DataError
from modeler.core.table import format_percent
from modeler.estimation.least_squares import (
    Estimate,
    Problem,
    compute_least_sigma,
    estimate_robust,
    expand_columns,
    solve_least_squares,
)
from modeler.estimation.physical_consistency import estimate_consistent, make_consistent
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import (
    compress_rows,
    compute_column_norms,
    compute_triangle,
    find_independent_columns,
)
from modeler.runtime import CompiledModel

BANDWIDTHS = (2.0, 4.0, 8.0, 16.0, 32.0, 64.0)
"""Hz of the speed loops that are tried."""

KINDS = ((0.25, 1.0), (0.25, 0.0), (1.0, 0.0), (2.0, 0.0))
"""Ratio of the position loop and integral action that are tried: a drive's cascade, and PD."""

_FINER = (1.5, 1.2, 1.07)  # widest factors on speed and ratio, one search after the other

Motion = np.ndarray
"""(3, samples, joints) q, qd, qdd."""


@dataclass(frozen=True)
class ControlLoop:
    """Describes a controller.

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
    """Describes samples of a segment, simulated from `first`, kept from `start` to `stop`."""

    segment: int
    first: int
    start: int
    stop: int


class DirectModel:
    """Simulates a robot that follows the logs of an observation.

    Attributes:
        commanded: the reference is the commanded motion of all logs; else the logged one, smoothed.
        raised: share of samples whose inertia matrix was not positive definite.
        lightest: the joint that moves most along its lowest eigenvalue.
    """

    def __init__(self, model: CompiledModel, observation: regression.Observation) -> None:
        self.model, self.observation = model, observation
        self.segments = [part.segment for part in observation.stretches]
        self.commanded = all(segment.commanded is not None for segment in self.segments)
        self.cutoff = observation.report.processing.position_cutoff
        self.references = [self._build_reference(segment) for segment in self.segments]
        self.signals = [regression.compute_signals(model, segment) for segment in self.segments]
        self.raised, self.lightest = 0.0, 0

    def evaluate_columns(self, motions: list[Motion]) -> np.ndarray:
        """Returns (rows, c) the columns of W along motions, filtered as those of the log."""
        places = {id(segment): i for i, segment in enumerate(self.segments)}

        def evaluate(segment: regression.Segment, window: slice) -> np.ndarray:
            i = places[id(segment)]
            signals = self.signals[i]
            q, qd, qdd = motions[i][:, window]
            read = None if signals is None else signals[window]
            return self.model.base_regressor(q, qd, qdd, read)

        return self.observation.filter_columns(evaluate)[self.observation.used]

    def choose_loop(self, beta: np.ndarray) -> ControlLoop:
        """Returns the controller that brings the robot nearest to the logged positions.

        Expects commanded positions; without them the nearest is the fastest.
        """
        pieces = self._cut_windows()
        chosen = np.linspace(0, len(pieces) - 1, THRESHOLDS.loop_windows).astype(int)
        pieces = [pieces[i] for i in sorted({*chosen})]
        step, speeds = self._propose_speeds()
        tried = itertools.product(speeds, KINDS, (0.0, 1.0))
        loops = [ControlLoop(kv, *kind, f) for kv, kind, f in tried]
        best = self._select_nearest(beta, pieces, loops)
        for width in _FINER if np.isfinite(best.distance) else ():
            factors = width ** np.linspace(-1.0, 1.0, 5)
            loops = [
                dataclasses.replace(best, speed=best.speed * a, ratio=best.ratio * b)
                for a, b in itertools.product(factors, repeat=2)
                if best.speed * a * step < THRESHOLDS.max_loop_step
            ]
            best = self._select_nearest(beta, pieces, loops)
        if not np.isfinite(best.distance) or best.distance > 1.0:
            return ControlLoop(np.inf, 0.0, 0.0, 1.0, 1.0)
        return best

    def choose_loop_by_misfit(
        self, beta: np.ndarray, misfit: Callable[[list[Motion]], float]
    ) -> ControlLoop:
        """Returns the controller of best fit along its motion, where no command was logged.

        The reference is the logged motion itself. Its positions say nothing of the controller: the
        faster that is, the nearer it comes to them and to their noise. So the cascade with integral
        action, which holds friction and gravity from the first sample on, and feedforward is
        taken, and its speed by `misfit`, the criterion of the fit along a motion.
        """
        best = ControlLoop(np.inf, 0.0, 0.0, 1.0, np.inf)
        for speed in self._propose_speeds()[1]:
            loop = ControlLoop(speed, *KINDS[0], 1.0)
            try:
                distance = misfit(self.simulate_motions(beta, loop))
            except DataError:
                continue
            if distance < best.distance:
                best = dataclasses.replace(loop, distance=distance)
        return best

    def _propose_speeds(self) -> tuple[float, list[float]]:
        """Returns the step of the simulation, s, and speed loops to try, rad/s."""
        step = min(THRESHOLDS.max_step, min(segment.step for segment in self.segments))
        speeds = (2 * np.pi * f for f in BANDWIDTHS)
        return step, [speed for speed in speeds if speed * step < THRESHOLDS.max_loop_step]

    def _select_nearest(
        self, beta: np.ndarray, pieces: list[_Window], loops: list[ControlLoop]
    ) -> ControlLoop:
        count, every = len(pieces), [loop for loop in loops for _ in pieces]
        ways = self._simulate_windows(beta, pieces * len(loops), every)
        starts = range(0, len(ways), count)
        distances = [self._compute_distance(pieces, ways[i : i + count]) for i in starts]
        best = int(np.argmin(distances))
        return dataclasses.replace(loops[best], distance=distances[best])

    def simulate_motions(self, beta: np.ndarray, loop: ControlLoop) -> list[Motion]:
        """Returns the motion of the robot with these parameters, one per segment.

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
                    'expected a positive definite inertia matrix; use method "weighted"'
                )
            motions[piece.segment][:, piece.start : piece.stop] = way
        pairs = zip(self.segments, motions, strict=True)
        return [_smooth_motion(segment, motion, self.cutoff) for segment, motion in pairs]

    def compute_position_error(self, motions: list[Motion]) -> np.ndarray:
        """Returns (joints,) rms of simulated less logged position over the range of motion."""
        whole = np.concatenate([segment.whole for segment in self.segments])
        logged = np.concatenate([segment.q for segment in self.segments])[whole]
        away = np.concatenate([motion[0] for motion in motions])[whole] - logged
        extent = np.ptp(logged, axis=0)
        return np.sqrt(np.mean(away**2, axis=0)) / np.where(extent > 0.0, extent, 1.0)

    def _build_reference(self, segment: regression.Segment) -> Motion:
        """Returns commanded positions with derivatives, or the motion of the fit smoothed further.

        Derivatives that the log brought along are kept: those of its positions are noisier.
        """
        if self.commanded and segment.commanded is not None:
            return regression.differentiate_positions(segment.commanded, segment.step)
        motion = np.stack([segment.q, segment.qd, segment.qdd])
        return _smooth_motion(segment, motion, THRESHOLDS.reference_cutoff_share * self.cutoff)

    def _cut_windows(self) -> list[_Window]:
        pieces = []
        for i, segment in enumerate(self.segments):
            length = max(2, round(THRESHOLDS.window_seconds / segment.step))
            warm = round(THRESHOLDS.warm_up_seconds / segment.step)
            for start in range(0, segment.samples, length):
                stop = min(start + length, segment.samples)
                pieces.append(_Window(i, max(0, start - warm), start, stop))
        return pieces

    def _compute_distance(self, pieces: list[_Window], ways: list[Motion]) -> float:
        """Returns rms of simulated less logged position, joints in units of tracking error."""
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
        """Returns the pieces, each with its loop, simulated side by side; NaN where it is lost."""
        steps = [float(f"{self.segments[piece.segment].step:.4g}") for piece in pieces]
        ways: dict[int, Motion] = {}
        for step in sorted(set(steps)):
            indices = [i for i, other in enumerate(steps) if other == step]
            alike = [pieces[i] for i in indices]
            every = np.arange(max(piece.stop - piece.first for piece in alike))
            rows = [(p.segment, np.minimum(p.first + every, p.stop - 1)) for p in alike]

            def combine(values: Sequence[np.ndarray]) -> np.ndarray:
                """Returns (..., samples, pieces, m) values, ends held."""
                return np.stack([values[segment][..., at, :] for segment, at in rows], axis=-2)  # noqa: B023

            some = [signals for signals in self.signals if signals is not None]  # all, or none
            reference, signals = combine(self.references), combine(some) if some else None
            robot = _Robot(self.model, beta, reference)
            if robot.raised > self.raised:
                self.raised, self.lightest = robot.raised, robot.lightest
            # What is simulated begins where the log was.
            logged = [(self.segments[piece.segment], piece.first) for piece in alike]
            start = np.stack([np.stack([s.q[at], s.qd[at]]) for s, at in logged], axis=1)
            some_loops = [loops[i] for i in indices]
            motion = robot.integrate_motion(start, reference, signals, step, some_loops)
            for place, (i, piece) in enumerate(zip(indices, alike, strict=True)):
                samples = slice(piece.start - piece.first, piece.stop - piece.first)
                ways[i] = motion[:, samples, place]
        return [ways[i] for i in range(len(pieces))]


def _smooth_motion(segment: regression.Segment, motion: Motion, cutoff: float) -> Motion:
    highest = min(cutoff, regression.THRESHOLDS.max_cutoff_share / segment.step)
    return np.stack([regression.apply_low_pass(signal, segment.step, highest) for signal in motion])


def scale_inertia(M: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """Returns how near inertia matrices M (s, n, n) come to none, in their median diagonal.

    (n, n) these units, (s,) the least eigenvalue of M in them, and the joint that moves most along
    the least of all.
    """
    diagonal = np.abs(np.median(np.einsum("sjj->sj", M), axis=0))
    scale = np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    units = np.outer(scale, scale)
    values, vectors = np.linalg.eigh(M / units)
    return units, values[:, 0], int(np.argmax(np.abs(vectors[np.argmin(values[:, 0]), :, 0])))


class _Robot:
    """Evaluates M and tau for many states at once; h = tau(q, qd, qdd_r) - M qdd_r."""

    def __init__(self, model: CompiledModel, beta: np.ndarray, reference: np.ndarray) -> None:
        self.model, self.beta = model, beta
        q = reference[0].reshape(-1, reference.shape[-1])
        M = model.inertia_matrix(q[:: max(1, len(q) // 500)], beta)
        self.units, least, self.lightest = scale_inertia(M)
        self.raised = float(np.mean(least < THRESHOLDS.min_inertia_eigenvalue))

    def compute_inertia(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns M of the model, and one that is positive definite: the same if it is."""
        M = self.model.inertia_matrix(q, self.beta)
        if self.raised == 0.0:
            return M, M
        values, vectors = np.linalg.eigh(M / self.units)
        lifted = np.maximum(values, THRESHOLDS.min_inertia_eigenvalue)[:, None, :] * vectors
        return M, np.asarray((lifted @ vectors.transpose(0, 2, 1)) * self.units)

    def integrate_motion(
        self,
        start: np.ndarray,
        reference: np.ndarray,
        signals: np.ndarray | None,
        step: float,
        loops: list[ControlLoop],
    ) -> np.ndarray:
        """Returns (3, samples, pieces, joints) the motion, by Adams and Bashforth of order 2."""
        inner = max(1, int(np.ceil(step / THRESHOLDS.max_step)))
        h, motion = step / inner, np.full(reference.shape, np.nan)
        far = THRESHOLDS.divergence_ranges * (np.ptp(reference[0], axis=(0, 1)) + 1e-6)
        settings = [(o.speed, o.ratio, o.integral, o.forward) for o in loops]
        kv, ratio, integral, f = np.array(settings).T[:, :, None]
        torque, share = self.model.inverse_dynamics, THRESHOLDS.integral_share
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
                effort = effort + h * integral * share * kv**2 * _multiply_rows(M, error)
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


# Instrumental variables: what the noise of the measured motion cannot bias.


@dataclass(frozen=True, eq=False)
class _InstrumentalSolution:
    """Holds beta = P S^-1/2 y, k columns kept."""

    beta: np.ndarray
    P: np.ndarray  # (k, rows)
    cosine: float  # between the spaces of W and of the instruments, the smallest
    worst: int  # the column that they carry least of
    whole: np.ndarray  # (k, k + 1) projected equations


def estimate_with_instruments(problem: Problem, Z: np.ndarray, method: str) -> Estimate:
    """Returns beta = (Z^T S^-1 W)^-1 Z^T S^-1 y, S = diag sigma_j^2 of y - W beta, iterated.

    Consistent where the instruments Z are uncorrelated with the noise of y and of W; the covariance
    is (Z^T S^-1 W)^-1 Z^T S^-1 Z (W^T S^-1 Z)^-1 (Young 2011; Janot, Vandanjon and Gautier 2014,
    IEEE Trans. Control Systems Technology 22(1)).

    Args:
        problem: beta in the units of its columns, y N m or N.
        Z: (rows, c) the columns of W along a motion that the noise did not touch.
        method: for the error message.

    Raises:
        DataError: the instruments do not carry a parameter.
    """
    data, counted, joint = problem.data, problem.counted, problem.row_joint[problem.counted]
    start = solve_least_squares(problem.data, "weighted")
    columns = np.asarray(start.rank.kept_columns, dtype=int)
    W, Z, y = problem.W[counted][:, columns], Z[counted][:, columns], problem.y[counted]

    def refuse(name: str) -> DataError:
        return DataError(
            f'method "{method}": {name} is not identifiable by the instruments; expected a '
            'commanded motion that moves all joints as the log does; use method "weighted"'
        )

    # Instruments that depend on each other where the columns do not.
    names = [problem.names[i] for i in columns]
    dropped = find_independent_columns(compute_triangle(Z), names).dropped_columns
    if dropped:
        raise refuse(dropped[0].name)
    sigma, is_converged, iterations = start.sigma, False, 0
    while not is_converged and iterations < THRESHOLDS.max_reweightings:
        solution = _solve_instruments(W, Z, y, sigma[joint])
        if solution.cosine < THRESHOLDS.min_instrument_cosine:
            raise refuse(names[solution.worst])
        # sigma_j^2 = |r_j|^2 / (rows_j - h_j), h_j the trace of joint j's part of W P.
        hat = np.einsum("rk,kr->r", W / sigma[joint][:, None], solution.P)
        squares = np.bincount(joint, (y - W @ solution.beta) ** 2, len(data.rows))
        degrees = data.rows - np.bincount(joint, hat, len(data.rows))
        spread = np.sqrt(squares / np.maximum(degrees, 0.5))
        spread = np.where(data.free | (data.rows == 0), start.sigma, spread)
        before, sigma = sigma, np.maximum(spread, compute_least_sigma(data))
        change = np.abs(sigma / before - 1.0)
        is_converged = bool(np.all(change < THRESHOLDS.weight_tolerance))
        iterations += 1
    V = solution.P @ solution.P.T
    beta, covariance = expand_columns(len(start.beta), columns, solution.beta, V)
    # Qz^T S^-1/2 W beta = Qz^T S^-1/2 y, which beta satisfies, above what it leaves.
    whole = np.zeros((len(columns) + 1, len(beta) + 1))
    whole[:-1, [*columns, -1]] = solution.whole
    whole[-1, -1] = np.linalg.norm((y - W @ solution.beta) / sigma[joint])
    weak = (
        f"the instruments are weak: cosine {solution.cosine:.2g} with one combination of columns; "
        "noise then biases it as without instruments, and its sigma is too small",
    )
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        sigma=sigma,
        iterations=iterations,
        is_converged=is_converged,
        sentences=weak if solution.cosine <= THRESHOLDS.weak_instrument_cosine else (),
        influence=problem.expand_rows(columns, (solution.P / sigma[joint]).T),
        whole=whole,
    )


def _solve_instruments(
    W: np.ndarray, Z: np.ndarray, y: np.ndarray, sigma: np.ndarray
) -> _InstrumentalSolution:
    lengths = np.linalg.norm(W / sigma[:, None], axis=0)
    X, y = W / sigma[:, None] / lengths, y / sigma
    instruments = Z / sigma[:, None]
    Qz, _ = np.linalg.qr(instruments / compute_column_norms(instruments))
    Qw, Rw = np.linalg.qr(X)
    cosine = float(np.linalg.svd(Qz.T @ Qw, compute_uv=False).min(initial=1.0))
    across = Qz.T @ Qw @ Rw
    worst = int(np.argmin(np.linalg.norm(across, axis=0)))
    P = np.linalg.lstsq(across, Qz.T, rcond=None)[0] / lengths[:, None]
    whole = np.column_stack([across * lengths, Qz.T @ y])
    return _InstrumentalSolution(P @ y, P, cosine, worst, whole)


def estimate_iv(problem: Problem, method: str = "iv") -> Estimate:
    """Returns the estimate with the regressor along the commanded motion as instruments.

    Noise of the encoders is in W and not in what was commanded.

    Raises:
        DataError: a log without commanded positions.
    """
    observation = problem.observation
    robot = DirectModel(problem.require_robot(method), observation)
    for segment in robot.segments:
        if segment.commanded is None:
            raise DataError(
                f'{observation.logs[segment.run]}: method "{method}" needs commanded positions; '
                f"got no complete columns qc{observation.joints[0].name} ...; log those of all "
                'joints, or use method "weighted" or "iv-direct"'
            )
    return estimate_with_instruments(problem, robot.evaluate_columns(robot.references), method)


def estimate_iv_consistent(problem: Problem) -> Estimate:
    """Returns the consistent parameters nearest to `estimate_iv`, by its equations."""
    return make_consistent(problem, estimate_iv(problem, "iv-consistent"), "iv-consistent")


def estimate_iv_direct(problem: Problem) -> Estimate:
    """Returns the estimate with the regressor along the simulated motion as instruments, repeated.

    The robot with the values of the last estimate follows the log; the first estimate is the
    weighted fit (Janot, Vandanjon and Gautier 2014).

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    method = "iv-direct"
    return _iterate_simulation(
        problem, method, _fit_weighted, lambda Z: estimate_with_instruments(problem, Z, method)
    )


def estimate_iv_direct_consistent(problem: Problem) -> Estimate:
    """Returns the estimate of `estimate_iv_direct`, simulated with consistent parameters only."""
    method = "iv-direct-consistent"
    return _iterate_simulation(
        problem,
        method,
        estimate_consistent,
        lambda Z: make_consistent(problem, estimate_with_instruments(problem, Z, method), method),
    )


def _fit_weighted(problem: Problem) -> Estimate:
    return solve_least_squares(problem.data, "weighted")


def estimate_didim(
    problem: Problem, method: str = "didim", solve: Callable[[Problem], Estimate] = _fit_weighted
) -> Estimate:
    """Returns min sum_j |y_j - W_j(q_s(beta)) beta|^2 / sigma_j^2, q_s the simulated motion.

    Gauss-Newton: q_s hardly depends on beta, as the controller holds the motion, so each step is
    the fit of the measured torque to the columns along the last simulated motion (Gautier, Janot
    and Vandanjon 2013): the weighted one, or that of another law. The logged motion is used to
    choose the controller, and the rows, alone; and for the covariance: d d^T is added to it,
    d = P (W(q_s) - W(q)) beta with P the influence of the fit. By d the values move if the logged
    motion is right and the simulated one is not, as where the controller of the log is another one.

    Args:
        problem: beta in the units of its columns, y N m or N.
        method: for the error messages.
        solve: each step, and the fit along the logged motion from which they start.

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    return _iterate_simulation(problem, method, solve, lambda W: _fit_along(problem, W, solve))


def estimate_didim_robust(problem: Problem) -> Estimate:
    """Returns `estimate_didim` of robust steps: rows that do not fit lose weight in each of them.

    A push or a spike is in the torques and not in the simulated motion.
    """
    return estimate_didim(problem, "didim-robust", estimate_robust)


def estimate_didim_consistent(problem: Problem) -> Estimate:
    """Returns `estimate_didim` of physically consistent steps, inertia matrices included."""
    return estimate_didim(problem, "didim-consistent", estimate_consistent)


def _fit_along(problem: Problem, W: np.ndarray, solve: Callable[[Problem], Estimate]) -> Estimate:
    """Returns the fit of the torques to columns along another motion."""
    counted, free = problem.counted, np.flatnonzero(problem.data.free).tolist()
    y, joint = problem.y[counted], problem.row_joint[counted]
    data = compress_rows(W[counted], y, joint, len(problem.data.rows), problem.names, free)
    estimate = solve(dataclasses.replace(problem, matrix=W, data=data))
    influence = estimate.influence
    if influence is None:
        influence = np.where(counted[:, None], W @ estimate.covariance, 0.0)
        influence /= estimate.sigma[problem.row_joint][:, None] ** 2
    weight = 1.0 if estimate.weight is None else estimate.weight
    shift = influence.T @ (weight * ((W - problem.W) @ estimate.beta))
    residual, whole = estimate.residual, estimate.whole
    return dataclasses.replace(
        estimate,
        covariance=estimate.covariance + np.outer(shift, shift),
        influence=influence,
        residual=problem.y - W @ estimate.beta if residual is None else residual,
        whole=data.combine_joints(estimate.sigma) if whole is None else whole,
    )


def _iterate_simulation(
    problem: Problem,
    method: str,
    first: Callable[[Problem], Estimate],
    estimate: Callable[[np.ndarray], Estimate],
) -> Estimate:
    """Simulates and estimates, from the first on, until the step is small beside the sigmas."""
    model = problem.require_robot(method)
    idle = [joint.name for joint in model.spec.joints if not joint.actuated]
    if idle:
        raise DataError(
            f'method "{method}": joint {idle[0]} of {model.spec.robot} has no motor; expected one '
            "motor a joint, so that a controller can hold the robot; use another method"
        )
    robot, start = DirectModel(model, problem.observation), first(problem)
    beta, is_converged, rows = start.beta, False, problem.counted
    joint_sigma = start.sigma[problem.row_joint[rows]]

    def compute_misfit(W: np.ndarray, beta: np.ndarray) -> float:
        """Returns rms of (y_j - W_j beta) / sigma_j over the counted rows, sigma_j of `start`."""
        residual = (problem.y[rows] - W[rows] @ beta) / joint_sigma
        return float(np.sqrt(np.mean(residual**2)))

    def choose_loop() -> ControlLoop:
        if robot.commanded:
            return robot.choose_loop(beta)
        columns = robot.evaluate_columns
        return robot.choose_loop_by_misfit(beta, lambda way: compute_misfit(columns(way), beta))

    loop = choose_loop()
    for _ in range(THRESHOLDS.max_simulations):
        try:
            motions = robot.simulate_motions(beta, loop)
        except DataError:
            if robot.commanded:
                raise
            loop = choose_loop()  # this one was not in the log; another one holds the robot
            motions = robot.simulate_motions(beta, loop)
        current = estimate(robot.evaluate_columns(motions))
        sigma = np.sqrt(np.diag(current.covariance))
        step = np.abs(current.beta - beta) / np.where(sigma > 0.0, sigma, np.inf)
        largest = step.max(initial=0.0)
        beta = current.beta
        is_converged = bool(np.isinf(loop.speed) or largest < THRESHOLDS.settled_sigmas)
        if is_converged:
            break
    lines = []
    before, after = (compute_misfit(problem.W, values) for values in (start.beta, beta))
    if after > THRESHOLDS.max_misfit_ratio * before:
        lines.append(
            f"along the logged motion the values have {after / before:.3g} times the error of "
            f'"weighted", from which method "{method}" starts: the simulated motion differs from '
            'the log; take the values of method "weighted"'
        )
    lines += _describe_controller(problem, robot, loop, robot.compute_position_error(motions))
    if not is_converged:
        lines.append(
            f"the values still change by up to {largest:.2g} sigma after "
            f"{THRESHOLDS.max_simulations} simulations; add that to their uncertainty"
        )
    return dataclasses.replace(
        current,
        is_converged=current.is_converged and is_converged,
        sentences=(*lines, *current.sentences),
    )


def _describe_controller(
    problem: Problem, robot: DirectModel, loop: ControlLoop, error: np.ndarray
) -> list[str]:
    worst = int(np.argmax(error))
    joint = problem.observation.joints[worst].name
    near = f"within {format_percent(error[worst])} of the range of joint {joint}, the farthest"
    if np.isinf(loop.speed):
        how = (
            "the commanded motion is nearer to the log than any controller that was tried"
            if robot.commanded
            else "none that was tried holds the robot with the fitted values, and the logged "
            "motion, smoothed, stands for the simulated one"
        )
    else:
        parts = {"integral action": loop.integral, "feedforward": loop.forward}
        fed = " and ".join(f"{'with' if there else 'no'} {name}" for name, there in parts.items())
        best = "comes nearest to the log" if robot.commanded else "explains the torques best"
        how = (
            f"the simulated one that {best} has speed loops of "
            f"{loop.speed / 2 / np.pi:.3g} Hz, position loops of {loop.ratio:.2g} times that, {fed}"
        )
    lines = [f"the controller of the log is not known: {how}, {near}"]
    if not robot.commanded:
        lines.append(
            "no commanded positions in these logs: the simulated robot follows the logged motion, "
            'smoothed; noise below its band remains, as with method "weighted"'
        )
    if robot.raised > 0.0:
        light = problem.observation.joints[robot.lightest].name
        lines.append(
            "the fitted inertia matrix is nearly singular or not positive definite in "
            f"{format_percent(robot.raised)} of the postures, most at joint {light}: it was raised "
            "for the simulation; record more motion"
        )
    return lines
