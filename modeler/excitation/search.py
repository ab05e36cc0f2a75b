"""The search for an exciting motion: random starts, descent within barriers."""

import dataclasses
import math
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.excitation.limits import (
    MotionBounds,
    PostureLimits,
    build_posture_limits,
    check_bounds,
    find_closest_approach,
)
from modeler.excitation.result import ExcitingMotion, LimitUsage, MotionQuality
from modeler.excitation.series import (
    CRITERIA,
    FAMILIES,
    Criterion,
    MotionColumns,
    MotionSeries,
    PriorInformation,
    build_motion_columns,
    build_series,
    compute_condition,
    compute_log_det,
)
from modeler.excitation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import ObjectiveFunction, minimise_bfgs, minimise_cma_es
from modeler.runtime import CompiledModel

Motion = tuple[np.ndarray, np.ndarray, np.ndarray]
"""(n, J) q, qd and qdd."""


@dataclass(frozen=True, eq=False)
class ExcitationTask:
    """A motion is (J, 2 K - 1) coefficients x; see `MotionSeries`.

    Attributes:
        columns: of the model.
        bounds: limits.
        series: the basis, over one period.
        criterion: of the rows of `column_indices` columns, weighted.
        weights: (J,) of the rows of each joint: one over the sigma of its torque.
        column_indices: (k,) columns that matter.
        posture: what positions alone must keep to, besides their ranges.
        beta: (c,) for torques; None where no parameters are known.
        share: (J,) of the torque limits that is used, as a margin between the samples.
    """

    columns: MotionColumns
    bounds: MotionBounds
    series: MotionSeries
    criterion: Criterion
    weights: np.ndarray
    column_indices: np.ndarray
    posture: PostureLimits
    beta: np.ndarray | None = None
    share: float = 0.98

    def compute_kinematic_shares(self, x: np.ndarray) -> np.ndarray:
        """Computes position, speed, acceleration as shares of limits, (3, n, J): |.| <= room."""
        b = self.bounds
        q, qd, qdd = self.series.evaluate_motion(x)
        return np.stack([(q - b.mid_range) / b.half_range, qd / b.speed, qdd / b.acceleration])

    def compute_reach(self, x: np.ndarray, direction: np.ndarray) -> float:
        """Computes how many lengths of `direction` are possible until a kinematic limit."""
        here = self.compute_kinematic_shares(x)
        turn = self.compute_kinematic_shares(x + direction) - here
        with np.errstate(divide="ignore", invalid="ignore"):
            left = (self.series.room - np.sign(turn) * here) / np.abs(turn)
            left = np.where(turn == 0.0, np.inf, left)
        return float(left.min())

    def compute_columns(self, motion: Motion) -> np.ndarray:
        """Computes the columns of the model, (n, J, c), with dry friction as it is."""
        s = self.columns.read_signals(motion, self.series.time)
        return self.columns.evaluate_exact(*motion, s)

    def weigh_columns(self, phi: np.ndarray) -> np.ndarray:
        """Weighs the rows of the selected columns, (n J, k)."""
        weighted = phi[:, :, self.column_indices] * self.weights[:, None]
        return weighted.reshape(-1, len(self.column_indices))

    def compute_rows(self, motion: Motion) -> np.ndarray:
        """Computes the weighted rows of a motion, (n J, k)."""
        return self.weigh_columns(self.compute_columns(motion))

    def compute_torque_shares(self, phi: np.ndarray) -> np.ndarray:
        """Computes torques as shares of limits, (n, J): |.| < share; (n, 0) without limits."""
        if self.beta is None or not np.isfinite(self.bounds.torque).any():
            return np.zeros((len(phi), 0))
        return phi @ self.beta / self.bounds.torque

    def is_feasible(self, x: np.ndarray) -> bool:
        """Returns whether no limit is broken at the samples."""
        motion = self.series.evaluate_motion(x)
        if np.abs(self.compute_kinematic_shares(x)).max() >= self.series.room:
            return False
        try:
            parts = [self.posture.compute_shares(motion[0])]
            if self.beta is not None and np.isfinite(self.bounds.torque).any():
                parts.append(self.compute_torque_shares(self.compute_columns(motion)))
        except LoopError:
            return False
        return all(np.abs(part).max(initial=0.0) < self.share for part in parts)

    @cached_property
    def rest_motion(self) -> np.ndarray:
        """Finds the rest motion, (J, 2 K - 1), with most room around it.

        Raises:
            DataError: they leave none anywhere.
        """
        b = self.bounds
        middle = b.mid_range if b.home is None else b.home
        most, load = THRESHOLDS.max_rest_offset, self._compute_rest_load
        place = np.clip((middle - b.mid_range) / b.half_range, -most, most)
        if self._compute_rest_load(place) > 0.0:
            rng = np.random.default_rng(0)
            postures = rng.uniform(-most, most, (THRESHOLDS.rest_postures, len(place)))
            place = min((place, *postures), key=self._compute_rest_load)
            count = THRESHOLDS.rest_generations
            place = minimise_cma_es(load, place, 0.1, count, rng, lambda generation: True)
        x = np.zeros((len(place), self.series.values.shape[1]))
        x[:, 0] = b.mid_range + b.half_range * place
        if not self._compute_rest_load(place) < self.share:
            posture = ", ".join(f"q{j} = {q:.3g}" for j, q in zip(b.joints, x[:, 0], strict=True))
            raise DataError(
                f"{self.columns.compiled.spec.robot}: no posture was found in which limits of "
                f"torques, boxes and clearance leave room to move, not even slowly; {posture} "
                "takes "
                f"{self._compute_rest_load(place):.3g} times what they allow; expected wider ones"
            )
        return x

    def _compute_rest_load(self, place: np.ndarray) -> float:
        """The largest share of a limit that ever smaller motions around a posture come to.

        What remains of their torques is gravity, and dry friction with all signs: that does not
        shrink with the speed.

        Args:
            place: (J,) the posture, in half ranges from their middle.
        """
        b, J = self.bounds, len(place)
        if np.abs(place).max() > THRESHOLDS.max_rest_offset:
            return np.inf
        q = np.tile(b.mid_range + b.half_range * place, (2 * J + 1, 1))
        qd = np.vstack([np.zeros(J), np.eye(J), -np.eye(J)]) * THRESHOLDS.rest_speed * b.speed
        # Effects of time grow one way.
        ends = (0.0, self.series.duration) if self.columns.compiled.spec.signals else (0.0,)
        try:
            share = float(np.abs(self.posture.compute_shares(q[:1])).max(initial=0.0))
            motion, count = (q, qd, 0.0 * q), len(q)
            read = [self.columns.read_signals(motion, np.full(count, time)) for time in ends]
            phis = [self.columns.evaluate_exact(*motion, s) for s in read]
            loads = [self.compute_torque_shares(phi) for phi in phis]
        except LoopError:
            return np.inf
        rest = np.hstack(loads)
        turned = (rest[1:] - rest[0]).reshape(2, J, -1)
        most = rest[0] + turned.max(axis=0).clip(min=0.0).sum(axis=0)
        least = rest[0] + turned.min(axis=0).clip(max=0.0).sum(axis=0)
        return float(np.abs([most, least]).max(initial=share))

    def shrink_to_limits(
        self, x: np.ndarray, checking_task: "ExcitationTask | None" = None
    ) -> np.ndarray:
        """Returns the motion x; where it is beyond limits, a smaller one that keeps them.

        The largest found between `rest_motion` and it that keeps them.

        It ends, since `rest_motion` leaves room for every motion that is small enough.

        Args:
            x: the motion.
            checking_task: the same task at other samples, which says whether limits are kept.
        """
        is_feasible, direction = (checking_task or self).is_feasible, x - self.rest_motion
        whole = size = min(1.0, 0.999 * self.compute_reach(self.rest_motion, direction))
        while not is_feasible(self.rest_motion + size * direction):
            size *= 0.5
        more = size
        for _ in range(THRESHOLDS.size_halvings if size < whole else 0):
            more *= 0.5
            size += more * is_feasible(self.rest_motion + (size + more) * direction)
        return self.rest_motion + size * direction


@dataclass(eq=False)
class BarrierProblem:
    """The criterion plus a barrier at every limit: value and slope, for `descend`.

    Attributes:
        task: the search.
        height: of the barrier, -log(1 - share^2) averaged over the samples.
    """

    task: ExcitationTask
    height: float
    _state: tuple = field(default=(), init=False, repr=False)

    def compute_value(self, flat: np.ndarray) -> float:
        """Computes the criterion with barriers; infinite where a limit is broken."""
        task = self.task
        x = flat.reshape(len(task.bounds.joints), -1)
        shares = task.compute_kinematic_shares(x) / task.series.room
        if not np.abs(shares).max() < 1.0:
            return np.inf
        motion = task.series.evaluate_motion(x)
        try:
            posture = task.posture.compute_shares(motion[0]) / task.share
            if not np.abs(posture).max(initial=0.0) < 1.0:
                return np.inf
            s = task.columns.read_signals(motion, task.series.time)
            phi = task.columns.evaluate_smooth(*motion, s)
        except LoopError:
            return np.inf
        loads = task.compute_torque_shares(phi) / task.share
        if not np.abs(loads).max(initial=0.0) < 1.0:
            return np.inf
        value, pull = task.criterion(task.weigh_columns(phi))
        if not np.isfinite(value):
            return np.inf
        self._state = (motion, s, phi, pull, shares, posture, loads)
        walls = sum(-np.sum(np.log1p(-(part**2))) for part in (shares, posture, loads))
        return float(value + self.height * walls / len(motion[0]))

    def compute_gradient(self) -> np.ndarray:
        """Computes the gradient at the point whose value was requested last."""
        task = self.task
        motion, s, phi, pull, shares, posture, loads = self._state
        n = len(motion[0])
        whole = np.zeros_like(phi)
        pull = pull.reshape(n, -1, len(task.column_indices))
        whole[:, :, task.column_indices] = pull * task.weights[:, None]
        if task.beta is not None and loads.size:
            push = self._compute_barrier_slope(loads, n) / (task.bounds.torque * task.share)
            whole += push[:, :, None] * task.beta
        slopes = task.columns.pull_back_gradient(motion, s, whole)
        b = task.bounds
        for k, unit in enumerate((b.half_range, b.speed, b.acceleration)):
            slopes[k] += self._compute_barrier_slope(shares[k], n) / (unit * task.series.room)
        push = self._compute_barrier_slope(posture, n) / task.share
        slopes[0] += task.posture.pull_back_gradient(motion[0], push)
        basis = (task.series.values, task.series.slopes, task.series.bends)
        total = sum(g.T @ V for g, V in zip(slopes, basis, strict=True))
        return np.ravel(total)

    def _compute_barrier_slope(self, shares: np.ndarray, n: int) -> np.ndarray:
        return self.height / n * 2.0 * shares / (1.0 - shares**2)


Item = TypeVar("Item")


@dataclass(frozen=True)
class MotionRequest:
    """What is requested of an exciting motion.

    Attributes:
        duration: of the motion, s.
        harmonics: K of the series; other families have as many coefficients, 2 K - 1.
        criterion: "both", "condition" or "information".
        starts: of the search.
        seed: another one gives another motion.
        time_limit: s, after which the best so far is taken; None: it ends by itself.
            What is begun is ended: one random motion at least, one slope, the last check.
        laps: times that the motion is driven, one after the other.
        family: "fourier", "bspline" or "trapezoid".
    """

    duration: float = 10.0
    harmonics: int = 6
    criterion: str = "both"
    starts: int = 6
    seed: int = 0
    time_limit: float | None = None
    laps: int = 1
    family: str = "fourier"


def design_motion(
    compiled: CompiledModel,
    bounds: MotionBounds,
    request: MotionRequest,
    sigma: np.ndarray | None = None,
    column_indices: np.ndarray | None = None,
    beta: np.ndarray | None = None,
    progress: Callable[[float], None] = lambda share: None,
    prior_information: PriorInformation | None = None,
) -> ExcitingMotion:
    """Designs a motion within limits along which parameters are identifiable.

    Minimises log cond(W) with columns of length one (Gautier and Khalil 1992), or the mean log
    sigma of the parameters, -log det(W^T W) / (2 c) (Swevers et al. 1997), or their sum, over
    motions of a family, all joints alike. The limits are barriers, which fall in three stages.

    Args:
        compiled: the robot.
        bounds: limits.
        request: duration, criterion, seed.
        sigma: (J,) standard deviation of the torque of each joint; None: all alike.
        column_indices: (k,) columns that matter; None: all.
        beta: (c,) base parameters, where torques are limited.
        progress: called with the share done.
        prior_information: what logs determine already; the motion adds to it.

    Raises:
        DataError: limits that no motion keeps to, a bad wish, too few rows.
    """
    deadline = Deadline(request.time_limit)
    task = build_task(compiled, bounds, request, sigma, column_indices, beta, prior_information)
    random_motions = draw_motions(task, np.random.default_rng([request.seed, 7]), deadline)

    def evaluate_motion(x: np.ndarray) -> float:  # dry friction as it is
        return task.criterion(task.compute_rows(task.series.evaluate_motion(x)))[0]

    values = [evaluate_motion(x) for x in deadline.iterate_in_time(x for x, _ in random_motions)]
    best = sorted(range(len(values)), key=lambda k: values[k])[: request.starts]
    candidates, parts = [], len(best) * len(THRESHOLDS.stages)
    for n, k in enumerate(best):
        x, _ = random_motions[k]
        for m, stage in enumerate(THRESHOLDS.stages):
            x = improve_motion(task, x, stage, deadline)
            progress((n * len(THRESHOLDS.stages) + m + 1) / parts)
        candidates.append(x)
    best_motion = min(candidates, key=evaluate_motion)
    return build_result(task, best_motion, request, random_motions, deadline)


class Deadline:
    """A time limit; called, it is True as long as there is time."""

    def __init__(self, limit: float | None) -> None:
        self._begun, self._limit = time.monotonic(), math.inf if limit is None else limit

    def __call__(self) -> bool:
        """Is there?"""
        return self.get_elapsed() < self._limit

    def get_elapsed(self) -> float:
        """Returns seconds since it was made."""
        return time.monotonic() - self._begun

    def iterate_in_time(self, items: Iterable[Item]) -> Iterator[Item]:
        """Yields the first of the items, and the others as long as there is time."""
        for k, item in enumerate(items):
            if k and not self():
                return
            yield item


def draw_motions(
    task: ExcitationTask, rng: np.random.Generator, deadline: Deadline
) -> list[tuple[np.ndarray, MotionQuality]]:
    """Draws random motions, 50 where there is time, with the quality of each."""
    random_motions = []
    for _ in deadline.iterate_in_time(range(THRESHOLDS.random_motions)):
        x = draw_random_motion(task, rng)
        random_motions.append((x, compute_quality(task, x)))
    return random_motions


def build_result(
    task: ExcitationTask,
    x: np.ndarray,
    request: MotionRequest,
    random_motions: list[tuple[np.ndarray, MotionQuality]],
    deadline: Deadline,
) -> ExcitingMotion:
    """Builds the result of a search, beside the random motions that it began with.

    Ranges, speeds and accelerations hold between the samples by `Series.room`; torques, boxes and
    loops are looked at ten times as densely, and the motion is drawn in until they hold there;
    distances of links hold at all times, by `find_closest_approach`.
    """
    early = not deadline()
    x = task.shrink_to_limits(x, refine_task(task))
    clearance, near = task.bounds.clearance, None
    while clearance is not None and len(clearance.solids.pairs):

        def compute_path(times: np.ndarray, x: np.ndarray = x) -> np.ndarray:
            return task.series.resample_at(times).evaluate_motion(x)[0]

        compiled, solids = task.columns.compiled, clearance.solids
        near = find_closest_approach(compiled, solids, compute_path, request.duration)
        if near.bound >= clearance.margin:
            break
        x = task.rest_motion + THRESHOLDS.clearance_shrinkage * (x - task.rest_motion)
    spec = task.columns.compiled.spec
    conditions = sorted(q.condition for _, q in random_motions)
    return ExcitingMotion(
        robot=spec.robot,
        bounds=task.bounds,
        request=dataclasses.asdict(request),
        series=task.series,
        x=x,
        quality=compute_quality(task, x),
        random_count=len(random_motions),
        random=(conditions[0], conditions[len(random_motions) // 2]),
        random_log_det=max(q.log_det for _, q in random_motions),
        usage=compute_usage(task, x),
        columns=tuple(spec.base[k].name for k in task.column_indices),
        beta=task.beta,
        has_ended_early=early,
        seconds=deadline.get_elapsed(),
        closest_approach=near,
    )


def build_task(
    compiled: CompiledModel,
    bounds: MotionBounds,
    request: MotionRequest,
    sigma: np.ndarray | None,
    column_indices: np.ndarray | None,
    beta: np.ndarray | None,
    prior_information: PriorInformation | None = None,
) -> ExcitationTask:
    """Builds the search of a request."""
    _check_request(request)
    check_bounds(bounds)
    columns = build_motion_columns(compiled, bounds.mid_range, bounds.half_range, bounds.speed)
    if column_indices is None:
        column_indices = np.arange(len(compiled.spec.base))
    if np.isfinite(bounds.torque).any() and beta is None:
        raise DataError(
            f"{compiled.spec.robot}: limits of torques need values of the parameters; expected a "
            "MODEL, or a robot file with all [parameters]"
        )
    dense = THRESHOLDS.samples_per_wave
    if compiled.spec.closure is not None:
        dense = THRESHOLDS.samples_per_wave_in_loops
    motion = build_series(request.duration, request.harmonics, None, dense, request.family)
    criterion = CRITERIA[request.criterion]
    if prior_information is not None:
        each = request.laps * request.duration * prior_information.rate / len(motion.time)
        criterion = prior_information.extend_criterion(criterion, each)
    weights = np.ones(len(bounds.joints)) if sigma is None else 1.0 / sigma
    known = weights, column_indices, build_posture_limits(compiled, bounds), beta
    return ExcitationTask(columns, bounds, motion, criterion, *known)


def _check_request(request: MotionRequest) -> None:
    if request.criterion not in CRITERIA:
        names = ", ".join(CRITERIA)
        raise DataError(f"criterion: got {request.criterion}; expected one of {names}")
    if request.family not in FAMILIES:
        raise DataError(f"family: got {request.family}; expected one of {', '.join(FAMILIES)}")
    if not (math.isfinite(request.duration) and 0.0 < request.duration <= 3600.0):
        raise DataError(f"duration: got {request.duration:g} s; expected more than 0, at most 3600")
    ranges = [("harmonics", 2, 40), ("starts", 1, THRESHOLDS.random_motions)]
    ranges += [("seed", 0, 2**63), ("laps", 1, 1000)]
    for name, least, most in ranges:
        value = getattr(request, name)
        if not least <= value <= most:
            raise DataError(f"{name}: got {value}; expected {least} to {most}")
    if request.time_limit is not None and not request.time_limit > 0.0:
        raise DataError(f"time limit: got {request.time_limit:g} s; expected more than 0")


def improve_motion(
    task: ExcitationTask,
    x: np.ndarray,
    stage: tuple[float, float, int],
    has_time: Callable[[], bool],
) -> np.ndarray:
    """Improves the motion by one stage of descent."""
    height, soft, steps = stage
    softer = dataclasses.replace(task, columns=dataclasses.replace(task.columns, softness=soft))
    walled = BarrierProblem(softer, height)
    # Variables in shares of what each joint may do: all are then about as large.
    unit = task.bounds.half_range[:, None] * np.ones(x.shape[1])

    def reshape_coefficients(flat: np.ndarray) -> np.ndarray:
        return flat.reshape(x.shape) * unit

    landscape = ObjectiveFunction(
        value=lambda flat: walled.compute_value(reshape_coefficients(flat)),
        gradient=lambda flat: walled.compute_gradient() * unit.ravel(),  # of the last value
        boundary_distance=lambda *pair: task.compute_reach(*map(reshape_coefficients, pair)),
    )
    for _ in range(THRESHOLDS.max_retreats):
        start = (x / unit).ravel()
        if not has_time():
            break
        if np.isfinite(landscape.value(start)):
            settings = steps, THRESHOLDS.criterion_tolerance, has_time
            return reshape_coefficients(minimise_bfgs(landscape, start, *settings))
        x = task.rest_motion + 0.9 * (x - task.rest_motion)
    return x


def choose_harmonics(bounds: MotionBounds, duration: float) -> int:
    """Chooses 5 to 10 harmonics: as many as the slowest joint can follow."""
    part = 0.25 * bounds.half_range
    swing = np.minimum(bounds.speed / part, np.sqrt(bounds.acceleration / part)) / (2.0 * np.pi)
    waves = duration * float(swing.min())
    return round(min(max(waves, 5.0), 10.0)) if math.isfinite(waves) else 5


def compute_quality(task: ExcitationTask, x: np.ndarray) -> MotionQuality:
    """Computes the quality of a motion."""
    W = task.compute_rows(task.series.evaluate_motion(x))
    scaled, raw = (compute_condition(W, scaled) for scaled in (True, False))
    return MotionQuality(scaled, raw, compute_log_det(W))


def refine_task(task: ExcitationTask) -> ExcitationTask:
    """Returns the task with ten times the samples, and nearly all of the limits."""
    series = task.series.refine_samples(THRESHOLDS.check_refinement)
    return dataclasses.replace(task, series=series, share=THRESHOLDS.checked_share)


def compute_usage(task: ExcitationTask, x: np.ndarray) -> LimitUsage:
    """Computes what of each limit a motion uses, ten times as densely as it was searched."""
    fine = refine_task(task)
    q, qd, qdd = fine.series.evaluate_motion(x)
    loads = None
    if task.beta is not None:
        s = fine.columns.read_signals((q, qd, qdd), fine.series.time)
        loads = np.abs(fine.columns.evaluate_exact(q, qd, qdd, s) @ task.beta).max(axis=0)
    posture = fine.posture.compute_shares(q)
    speed, acceleration = (np.abs(x).max(axis=0) for x in (qd, qdd))
    kinds, low, high = len(fine.posture.kinds), q.min(axis=0), q.max(axis=0)
    share = float(np.abs(posture).max()) if posture.size else None
    loops = float(posture[:, :kinds].max()) if kinds else None
    return LimitUsage(low, high, speed, acceleration, loads, share, loops)


def draw_random_motion(task: ExcitationTask, rng: np.random.Generator) -> np.ndarray:
    """Draws random coefficients, (J, 2 K - 1), as large as the limits allow.

    Each joint by itself is made as large as its range, speed and acceleration allow, around a
    random place; where a torque, a box or a loop is in the way, all shrink towards rest.

    Raises:
        DataError: no motion keeps to the limits, however small.
    """
    joints, wide = len(task.bounds.joints), task.series.values.shape[1]
    x = np.zeros((joints, wide))
    x[:, 1:] = rng.normal(size=(joints, wide - 1))
    b, s = task.bounds, task.series
    for j in range(joints):
        q = s.values[:, 1:] @ x[j, 1:]
        extent = 0.5 * np.ptp(q)
        shares = [extent / b.half_range[j], np.abs(s.slopes @ x[j]).max() / b.speed[j]]
        shares.append(np.abs(s.bends @ x[j]).max() / b.acceleration[j])
        x[j] *= THRESHOLDS.random_share * s.room / max(shares)
        q = s.values[:, 1:] @ x[j, 1:]
        room = THRESHOLDS.random_share * s.room * b.half_range[j]
        least, most = room * np.array([-1, 1]) + b.mid_range[j]
        x[j, 0] = rng.uniform(least - q.min(), max(most - q.max(), least - q.min()))
    return task.shrink_to_limits(x)
