"""The search for an exciting motion: many random starts, descent from the best of them.

The random motions are also what the result is compared with.
"""

import dataclasses
import math
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from modeler.core.errors import DataError
from modeler.excitation.clearance import find_closest_approach
from modeler.excitation.criterion import (
    CRITERIA,
    PriorInformation,
    build_motion_columns,
    compute_condition,
    compute_log_det,
)
from modeler.excitation.families import FAMILIES, build_series
from modeler.excitation.motion import MotionBounds, build_posture_limits, check_bounds
from modeler.excitation.result import ExcitingMotion, LimitUsage, MotionQuality
from modeler.excitation.task import BarrierProblem, ExcitationTask
from modeler.excitation.thresholds import THRESHOLDS
from modeler.numerics.optimize import ObjectiveFunction, minimise_bfgs
from modeler.runtime import CompiledModel

Item = TypeVar("Item")


@dataclass(frozen=True)
class MotionRequest:
    """What is asked for.

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
    """A motion within limits along which parameters are well told apart.

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
        prior_information: what logs tell already; the motion adds to it.

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
    return build_result(
        task, min(candidates, key=evaluate_motion), request, random_motions, deadline
    )


class Deadline:
    """True as long as there is time."""

    def __init__(self, limit: float | None) -> None:
        self._begun, self._limit = time.monotonic(), math.inf if limit is None else limit

    def __call__(self) -> bool:
        """Is there?"""
        return self.get_elapsed() < self._limit

    def get_elapsed(self) -> float:
        """Seconds since it was made."""
        return time.monotonic() - self._begun

    def iterate_in_time(self, items: Iterable[Item]) -> Iterator[Item]:
        """The first of the items, and the others as long as there is time."""
        for k, item in enumerate(items):
            if k and not self():
                return
            yield item


def draw_motions(
    task: ExcitationTask, rng: np.random.Generator, deadline: Deadline
) -> list[tuple[np.ndarray, MotionQuality]]:
    """Random motions, 50 where there is time, and how good each is."""
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
    """The result of a search, beside the random motions that it began with.

    Ranges, speeds and accelerations hold between the samples by `Series.room`; torques, boxes and
    loops are looked at ten times as densely, and the motion is drawn in until they hold there;
    distances of links hold at all times, by `find_closest_approach`.
    """
    early = not deadline()
    x = task.shrink_to_limits(x, refine_task(task))
    clearance, near = task.bounds.clearance, None
    while clearance is not None and len(clearance.solids.pairs):
        near = find_closest_approach(
            task.columns.compiled,
            clearance.solids,
            lambda t, x=x: task.series.resample_at(t).evaluate_motion(x)[0],
            request.duration,  # type: ignore[misc]
        )
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
        ended_early=early,
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
    """The search of a wish."""
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
    dense = (
        THRESHOLDS.samples_per_wave
        if compiled.spec.closure is None
        else THRESHOLDS.samples_per_wave_in_loops
    )
    motion = build_series(request.duration, request.harmonics, None, dense, request.family)
    criterion = CRITERIA[request.criterion]
    if prior_information is not None:
        each = request.laps * request.duration * prior_information.rate / len(motion.time)
        criterion = prior_information.extend_criterion(criterion, each)
    return ExcitationTask(
        columns,
        bounds,
        motion,
        criterion,
        np.ones(len(bounds.joints)) if sigma is None else 1.0 / sigma,
        column_indices,
        build_posture_limits(compiled, bounds),
        beta,
    )


def _check_request(request: MotionRequest) -> None:
    if request.criterion not in CRITERIA:
        raise DataError(
            f"criterion: got {request.criterion}; expected one of {', '.join(CRITERIA)}"
        )
    if request.family not in FAMILIES:
        raise DataError(f"family: got {request.family}; expected one of {', '.join(FAMILIES)}")
    if not (math.isfinite(request.duration) and 0.0 < request.duration <= 3600.0):
        raise DataError(f"duration: got {request.duration:g} s; expected more than 0, at most 3600")
    ranges = (
        ("harmonics", 2, 40),
        ("starts", 1, THRESHOLDS.random_motions),
        ("seed", 0, 2**63),
        ("laps", 1, 1000),
    )
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
    """The motion after one stage of descent."""
    height, soft, steps = stage
    softer = dataclasses.replace(task, columns=dataclasses.replace(task.columns, softness=soft))
    walled = BarrierProblem(softer, height)
    # Variables in shares of what each joint may do: all are then about as large.
    unit = task.bounds.half_range[:, None] * np.ones(x.shape[1])

    def reshape_coefficients(flat: np.ndarray) -> np.ndarray:
        return flat.reshape(x.shape) * unit

    landscape = ObjectiveFunction(
        value=lambda flat: walled.compute_value(reshape_coefficients(flat)),
        gradient=lambda flat: (
            walled.compute_gradient() * unit.ravel()
        ),  # where the value was asked for last
        boundary_distance=lambda flat, way: task.compute_reach(
            reshape_coefficients(flat), reshape_coefficients(way)
        ),
    )
    for _ in range(THRESHOLDS.max_retreats):
        start = (x / unit).ravel()
        if not has_time():
            break
        if np.isfinite(landscape.value(start)):
            return reshape_coefficients(
                minimise_bfgs(landscape, start, steps, THRESHOLDS.criterion_tolerance, has_time)
            )
        x = task.rest_motion + 0.9 * (x - task.rest_motion)
    return x


def choose_harmonics(bounds: MotionBounds, duration: float) -> int:
    """As many as reach what the slowest joint can swing by an eighth of its range, 5 to 10."""
    part = 0.25 * bounds.half_range
    swing = np.minimum(bounds.speed / part, np.sqrt(bounds.acceleration / part)) / (2.0 * np.pi)
    waves = duration * float(swing.min())
    return round(min(max(waves, 5.0), 10.0)) if math.isfinite(waves) else 5


def compute_quality(task: ExcitationTask, x: np.ndarray) -> MotionQuality:
    """How good a motion is."""
    W = task.compute_rows(task.series.evaluate_motion(x))
    return MotionQuality(
        compute_condition(W), compute_condition(W, scaled=False), compute_log_det(W)
    )


def refine_task(task: ExcitationTask) -> ExcitationTask:
    """The same with ten times the samples, and nearly all of the limits."""
    return dataclasses.replace(
        task,
        series=task.series.refine_samples(THRESHOLDS.check_refinement),
        share=THRESHOLDS.checked_share,
    )


def compute_usage(task: ExcitationTask, x: np.ndarray) -> LimitUsage:
    """What of each limit a motion uses, ten times as densely as it was searched."""
    fine = refine_task(task)
    q, qd, qdd = fine.series.evaluate_motion(x)
    loads = None
    if task.beta is not None:
        s = fine.columns.read_signals((q, qd, qdd), fine.series.time)
        loads = np.abs(fine.columns.evaluate_exact(q, qd, qdd, s) @ task.beta).max(axis=0)
    posture = fine.posture.compute_shares(q)
    return LimitUsage(
        q.min(axis=0),
        q.max(axis=0),
        np.abs(qd).max(axis=0),
        np.abs(qdd).max(axis=0),
        loads,
        float(np.abs(posture).max()) if posture.size else None,
        float(posture[:, : len(fine.posture.kinds)].max()) if fine.posture.kinds else None,
    )


def draw_random_motion(task: ExcitationTask, rng: np.random.Generator) -> np.ndarray:
    """(J, 2 K - 1) a series with random coefficients, as large as the limits let it be.

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
        shares = (
            extent / b.half_range[j],
            np.abs(s.slopes @ x[j]).max() / b.speed[j],
            np.abs(s.bends @ x[j]).max() / b.acceleration[j],
        )
        x[j] *= THRESHOLDS.random_share * s.room / max(shares)
        q = s.values[:, 1:] @ x[j, 1:]
        least, most = (
            THRESHOLDS.random_share * s.room * b.half_range[j] * np.array([-1, 1]) + b.mid_range[j]
        )
        x[j, 0] = rng.uniform(least - q.min(), max(most - q.max(), least - q.min()))
    return task.shrink_to_limits(x)
