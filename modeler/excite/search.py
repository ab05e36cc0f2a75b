"""The search for an exciting motion: many random starts, descent from the best of them."""

import dataclasses
import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.compiled import CompiledModel
from modeler.core.errors import DataError, LoopError
from modeler.excite.bounds import Bounds, check_bounds
from modeler.excite.columns import columns_of
from modeler.excite.criterion import CRITERIA, condition, log_det
from modeler.excite.descent import Landscape, descend
from modeler.excite.posture import posture_of
from modeler.excite.result import Exciting, Quality, Used
from modeler.excite.series import DENSE, Series, series
from modeler.excite.starts import random_motion, rest_place
from modeler.excite.task import Task, Walled

RANDOM = 50
"""Random motions that the result is compared with; the best of them are improved."""

_STAGES = ((0.1, 0.1, 80), (0.01, 0.03, 120), (0.001, 0.01, 80))
"""Height of the barrier, softness of dry friction, steps at most."""

_SETTLED = 2e-3  # of the criterion, in ten steps
_DENSE_LOOPS = 16  # samples per period of the highest harmonic, where loops are closed for each
_FINER = 10  # times as many samples for the last check
_CORRECTIONS = 6


@dataclass(frozen=True)
class Wish:
    """What is asked for.

    Attributes:
        duration: of the motion, s.
        harmonics: of the series.
        criterion: "both", "condition" or "information".
        starts: of the search.
        seed: another one gives another motion.
        time_limit: s, after which the best so far is taken; None: it ends by itself.
        laps: times that the motion is driven, one after the other.
    """

    duration: float = 10.0
    harmonics: int = 6
    criterion: str = "both"
    starts: int = 3
    seed: int = 0
    time_limit: float | None = None
    laps: int = 1


def excite(
    compiled: CompiledModel,
    bounds: Bounds,
    wish: Wish,
    sigma: np.ndarray | None = None,
    kept: np.ndarray | None = None,
    beta: np.ndarray | None = None,
    progress: Callable[[float], None] = lambda share: None,
) -> Exciting:
    """A motion within limits along which parameters are well told apart.

    Minimises log cond(W) with columns of length one (Gautier and Khalil 1992), or the mean log
    sigma of the parameters, -log det(W^T W) / (2 c) (Swevers et al. 1997), or their sum, over
    Fourier series of all joints. The limits are barriers, which fall in three stages.

    Args:
        compiled: the robot.
        bounds: limits.
        wish: duration, criterion, seed.
        sigma: (J,) standard deviation of the torque of each joint; None: all alike.
        kept: (k,) columns that matter; None: all.
        beta: (c,) base parameters, where torques are limited.
        progress: called with the share done.

    Raises:
        DataError: limits that no motion keeps to, a bad wish, too few rows.
    """
    task = task_of(compiled, bounds, wish, sigma, kept, beta)
    begun = time.monotonic()

    def on() -> bool:
        return wish.time_limit is None or time.monotonic() - begun < wish.time_limit

    rng = np.random.default_rng([wish.seed, 7])
    drawn = [random_motion(task, rng) for _ in range(RANDOM)]
    found = _improved_best(task, wish.starts, drawn, on, progress)
    x = min(found, key=lambda y: value_of(task, y))
    task, x = kept_between(task, x, on)
    return finished(task, x, wish, drawn, not on(), begun)


def _improved_best(
    task: Task,
    starts: int,
    drawn: list[np.ndarray],
    on: Callable[[], bool],
    progress: Callable[[float], None],
) -> list[np.ndarray]:
    """The best of the motions drawn, each after all stages of descent."""
    values = [value_of(task, x) for x in drawn]
    best = sorted(range(len(drawn)), key=lambda k: values[k])[:starts]
    found, parts = [], len(best) * len(_STAGES)
    for n, k in enumerate(best):
        x = drawn[k]
        for m, stage in enumerate(_STAGES):
            x = improved(task, x, stage, on)
            progress((n * len(_STAGES) + m + 1) / parts)
        found.append(x)
    return found


def finished(
    task: Task, x: np.ndarray, wish: Wish, drawn: list[np.ndarray], early: bool, begun: float
) -> Exciting:
    """The result of a search, beside the random motions that it began with."""
    spec = task.columns.compiled.spec
    measured = [quality(task, y) for y in drawn]
    conditions = sorted(q.condition for q in measured)
    return Exciting(
        robot=spec.robot, bounds=task.bounds, wish=dataclasses.asdict(wish),
        series=series(wish.duration, wish.harmonics), x=x, quality=quality(task, x),
        random=(conditions[0], conditions[len(drawn) // 2]),
        random_log_det=max(q.log_det for q in measured), used=used(task, x),
        columns=tuple(spec.base[k].name for k in task.kept), beta=task.beta,
        ended_early=early, seconds=time.monotonic() - begun,
    )  # fmt: skip


def task_of(
    compiled: CompiledModel,
    bounds: Bounds,
    wish: Wish,
    sigma: np.ndarray | None,
    kept: np.ndarray | None,
    beta: np.ndarray | None,
) -> Task:
    """The search of a wish."""
    _check_wish(wish)
    check_bounds(bounds)
    columns = columns_of(compiled, bounds.middle, bounds.half, bounds.speed)
    if kept is None:
        kept = np.arange(len(compiled.spec.base))
    if np.isfinite(bounds.torque).any() and beta is None:
        raise DataError(
            f"{compiled.spec.robot}: limits of torques need values of the parameters; expected a "
            "MODEL, or a robot file with all [parameters]"
        )
    dense = DENSE if compiled.spec.closure is None else _DENSE_LOOPS
    return Task(
        columns, bounds, series(wish.duration, wish.harmonics, dense=dense),
        CRITERIA[wish.criterion],
        np.ones(len(bounds.joints)) if sigma is None else 1.0 / sigma,
        kept, posture_of(compiled, bounds), beta,
    )  # fmt: skip


def _check_wish(wish: Wish) -> None:
    if wish.criterion not in CRITERIA:
        raise DataError(f"criterion: got {wish.criterion}; expected one of {', '.join(CRITERIA)}")
    if not (math.isfinite(wish.duration) and 0.0 < wish.duration <= 3600.0):
        raise DataError(f"duration: got {wish.duration:g} s; expected more than 0, at most 3600")
    ranges = (("harmonics", 2, 40), ("starts", 1, RANDOM), ("seed", 0, 2**63), ("laps", 1, 1000))
    for name, least, most in ranges:
        value = getattr(wish, name)
        if not least <= value <= most:
            raise DataError(f"{name}: got {value}; expected {least} to {most}")
    if wish.time_limit is not None and not wish.time_limit > 0.0:
        raise DataError(f"time limit: got {wish.time_limit:g} s; expected more than 0")


def improved(
    task: Task, x: np.ndarray, stage: tuple[float, float, int], on: Callable[[], bool]
) -> np.ndarray:
    """The motion after one stage of descent."""
    height, soft, steps = stage
    task = dataclasses.replace(task, columns=dataclasses.replace(task.columns, soft=soft))
    walled = Walled(task, height)
    # Variables in shares of what each joint may do: all are then about as large.
    unit = task.bounds.half[:, None] * np.ones(x.shape[1])

    def shaped(flat: np.ndarray) -> np.ndarray:
        return flat.reshape(x.shape) * unit

    landscape = Landscape(
        value=lambda flat: walled.value(shaped(flat)),
        slope=lambda flat: walled.slope(shaped(flat)) * unit.ravel(),
        reach=lambda flat, way: task.reach(shaped(flat), shaped(way)),
    )
    start = (x / unit).ravel()
    if not np.isfinite(landscape.value(start)):
        return x
    return shaped(descend(landscape, start, steps, _SETTLED, on))


def value_of(task: Task, x: np.ndarray) -> float:
    """The criterion along a motion, dry friction as it is."""
    return task.criterion(task.rows(task.series.motion(x)))[0]


def usual_harmonics(bounds: Bounds, duration: float) -> int:
    """As many as reach what the slowest joint can swing by an eighth of its range, 5 to 10."""
    part = 0.25 * bounds.half
    swing = np.minimum(bounds.speed / part, np.sqrt(bounds.acceleration / part)) / (2.0 * np.pi)
    waves = duration * float(swing.min())
    return round(min(max(waves, 5.0), 10.0)) if math.isfinite(waves) else 5


def quality(task: Task, x: np.ndarray) -> Quality:
    """How good a motion is."""
    W = task.rows(task.series.motion(x))
    return Quality(condition(W), condition(W, scaled=False), log_det(W))


def finer(task: Task) -> Task:
    """The same with ten times the samples."""
    old: Series = task.series
    count = _FINER * len(old.time)
    times = np.arange(count) * (old.duration / count)
    return dataclasses.replace(task, series=series(old.duration, old.harmonics, times))


def kept_between(
    task: Task, x: np.ndarray, on: Callable[[], bool], descent: bool = True
) -> tuple[Task, np.ndarray]:
    """The motion, corrected until limits hold between the samples too.

    Ranges, speeds and accelerations hold there by `Series.room`; torques, boxes and loops are
    looked at ten times as densely, and are given less room where they are broken.

    Raises:
        DataError: they stay broken.
    """
    still = np.zeros_like(x)
    for _ in range(_CORRECTIONS):
        peak = _peak(finer(task), x)
        if peak < 1.0:
            return task, x
        task = dataclasses.replace(task, share=task.share * (0.99 / min(peak, 1.25)))
        still[:, 0] = rest_place(task)
        while not task.keeps(x):
            x = still + 0.97 * (x - still)
        if descent:
            x = improved(task, x, (*_STAGES[-1][:2], 20), on)
    raise DataError(
        f"{task.columns.compiled.spec.robot}: limits of torques, boxes or loops stay broken "
        "between samples; expected fewer --harmonics or wider limits"
    )


def _peak(task: Task, x: np.ndarray) -> float:
    """The largest share of a limit of torque, box or loop."""
    motion = task.series.motion(x)
    try:
        shares = [task.posture.shares(motion[0])]
        if task.beta is not None:
            s = task.columns.read(motion[0], task.series.time)
            loads = task.torques(task.columns.exact(*motion, s))
            shares += [] if loads is None else [loads]
    except LoopError:
        return np.inf
    return max(float(np.abs(part).max(initial=0.0)) for part in shares)


def used(task: Task, x: np.ndarray) -> Used:
    """What of each limit a motion uses, ten times as densely as it was searched."""
    fine = finer(task)
    q, qd, qdd = fine.series.motion(x)
    loads = None
    if task.beta is not None:
        s = fine.columns.read(q, fine.series.time)
        loads = np.abs(fine.columns.exact(q, qd, qdd, s) @ task.beta).max(axis=0)
    posture = fine.posture.shares(q)
    return Used(
        q.min(axis=0), q.max(axis=0), np.abs(qd).max(axis=0), np.abs(qdd).max(axis=0), loads,
        float(np.abs(posture).max()) if posture.size else None,
        float(posture[:, : len(fine.posture.kinds)].max()) if fine.posture.kinds else None,
    )  # fmt: skip
