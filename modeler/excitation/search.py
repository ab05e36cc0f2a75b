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
from modeler.excitation.clearance import nearest
from modeler.excitation.criterion import CRITERIA, Known, columns_of, condition, log_det
from modeler.excitation.families import DENSE, FAMILIES, series
from modeler.excitation.motion import Bounds, check_bounds, posture_of
from modeler.excitation.result import Exciting, Quality, Used
from modeler.excitation.task import Task, Walled
from modeler.numerics.optimize import Landscape, descend
from modeler.runtime import CompiledModel

RANDOM = 50
"""Random motions that the result is compared with; the best of them are improved."""

_STAGES = ((0.1, 0.1, 80), (0.01, 0.03, 120), (0.001, 0.01, 300))
"""Height of the barrier, softness of dry friction, steps at most."""

_SETTLED = 5e-4  # of the criterion, in ten steps
_DENSE_LOOPS = 16  # samples per period of the highest harmonic, where loops are closed for each
_FINER = 10  # times as many samples for the last check
_NEARLY = 0.999  # of the limits, at these samples
_DRAWN = 0.995  # of the size, as often as links come too near between them
_INWARD = 20  # steps of a tenth towards rest, where smooth dry friction breaks a limit of torque

_FULL = 0.95  # of the limits, of random motions

Item = TypeVar("Item")


@dataclass(frozen=True)
class Wish:
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


def excite(
    compiled: CompiledModel,
    bounds: Bounds,
    wish: Wish,
    sigma: np.ndarray | None = None,
    kept: np.ndarray | None = None,
    beta: np.ndarray | None = None,
    progress: Callable[[float], None] = lambda share: None,
    known: Known | None = None,
) -> Exciting:
    """A motion within limits along which parameters are well told apart.

    Minimises log cond(W) with columns of length one (Gautier and Khalil 1992), or the mean log
    sigma of the parameters, -log det(W^T W) / (2 c) (Swevers et al. 1997), or their sum, over
    motions of a family, all joints alike. The limits are barriers, which fall in three stages.

    Args:
        compiled: the robot.
        bounds: limits.
        wish: duration, criterion, seed.
        sigma: (J,) standard deviation of the torque of each joint; None: all alike.
        kept: (k,) columns that matter; None: all.
        beta: (c,) base parameters, where torques are limited.
        progress: called with the share done.
        known: what logs tell already; the motion adds to it.

    Raises:
        DataError: limits that no motion keeps to, a bad wish, too few rows.
    """
    on = Deadline(wish.time_limit)
    task = task_of(compiled, bounds, wish, sigma, kept, beta, known)
    drawn = drawn_motions(task, np.random.default_rng([wish.seed, 7]), on)

    def value(x: np.ndarray) -> float:  # dry friction as it is
        return task.criterion(task.rows(task.series.motion(x)))[0]

    values = [value(x) for x in on.through(x for x, _ in drawn)]
    best = sorted(range(len(values)), key=lambda k: values[k])[: wish.starts]
    found, parts = [], len(best) * len(_STAGES)
    for n, k in enumerate(best):
        x, _ = drawn[k]
        for m, stage in enumerate(_STAGES):
            x = improved(task, x, stage, on)
            progress((n * len(_STAGES) + m + 1) / parts)
        found.append(x)
    return finished(task, min(found, key=value), wish, drawn, on)


class Deadline:
    """True as long as there is time."""

    def __init__(self, limit: float | None) -> None:
        self._begun, self._limit = time.monotonic(), math.inf if limit is None else limit

    def __call__(self) -> bool:
        """Is there?"""
        return self.spent() < self._limit

    def spent(self) -> float:
        """Seconds since it was made."""
        return time.monotonic() - self._begun

    def through(self, items: Iterable[Item]) -> Iterator[Item]:
        """The first of the items, and the others as long as there is time."""
        for k, item in enumerate(items):
            if k and not self():
                return
            yield item


def drawn_motions(
    task: Task, rng: np.random.Generator, on: Deadline
) -> list[tuple[np.ndarray, Quality]]:
    """Random motions, 50 where there is time, and how good each is."""
    drawn = []
    for _ in on.through(range(RANDOM)):
        x = random_motion(task, rng)
        drawn.append((x, quality(task, x)))
    return drawn


def finished(
    task: Task, x: np.ndarray, wish: Wish, drawn: list[tuple[np.ndarray, Quality]], on: Deadline
) -> Exciting:
    """The result of a search, beside the random motions that it began with.

    Ranges, speeds and accelerations hold between the samples by `Series.room`; torques, boxes and
    loops are looked at ten times as densely, and the motion is drawn in until they hold there;
    distances of links hold at all times, by `nearest`.
    """
    early = not on()
    x = task.drawn_in(x, finer(task))
    clearance, near = task.bounds.clearance, None
    while clearance is not None and len(clearance.solids.pairs):
        near = nearest(
            task.columns.compiled, clearance.solids,
            lambda t, x=x: task.series.at(t).motion(x)[0], wish.duration,  # type: ignore[misc]
        )  # fmt: skip
        if near.bound >= clearance.margin:
            break
        x = task.still + _DRAWN * (x - task.still)
    spec = task.columns.compiled.spec
    conditions = sorted(q.condition for _, q in drawn)
    return Exciting(
        robot=spec.robot, bounds=task.bounds, wish=dataclasses.asdict(wish),
        series=task.series, x=x, quality=quality(task, x),
        drawn=len(drawn), random=(conditions[0], conditions[len(drawn) // 2]),
        random_log_det=max(q.log_det for _, q in drawn), used=used(task, x),
        columns=tuple(spec.base[k].name for k in task.kept), beta=task.beta,
        ended_early=early, seconds=on.spent(), nearest=near,
    )  # fmt: skip


def task_of(
    compiled: CompiledModel,
    bounds: Bounds,
    wish: Wish,
    sigma: np.ndarray | None,
    kept: np.ndarray | None,
    beta: np.ndarray | None,
    known: Known | None = None,
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
    motion = series(wish.duration, wish.harmonics, None, dense, wish.family)
    criterion = CRITERIA[wish.criterion]
    if known is not None:
        each = wish.laps * wish.duration * known.rate / len(motion.time)
        criterion = known.beside(criterion, each)
    return Task(
        columns, bounds, motion, criterion,
        np.ones(len(bounds.joints)) if sigma is None else 1.0 / sigma,
        kept, posture_of(compiled, bounds), beta,
    )  # fmt: skip


def _check_wish(wish: Wish) -> None:
    if wish.criterion not in CRITERIA:
        raise DataError(f"criterion: got {wish.criterion}; expected one of {', '.join(CRITERIA)}")
    if wish.family not in FAMILIES:
        raise DataError(f"family: got {wish.family}; expected one of {', '.join(FAMILIES)}")
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
    softer = dataclasses.replace(task, columns=dataclasses.replace(task.columns, soft=soft))
    walled = Walled(softer, height)
    # Variables in shares of what each joint may do: all are then about as large.
    unit = task.bounds.half[:, None] * np.ones(x.shape[1])

    def shaped(flat: np.ndarray) -> np.ndarray:
        return flat.reshape(x.shape) * unit

    landscape = Landscape(
        value=lambda flat: walled.value(shaped(flat)),
        slope=lambda flat: walled.slope() * unit.ravel(),  # where the value was asked for last
        reach=lambda flat, way: task.reach(shaped(flat), shaped(way)),
    )
    for _ in range(_INWARD):
        start = (x / unit).ravel()
        if not on():
            break
        if np.isfinite(landscape.value(start)):
            return shaped(descend(landscape, start, steps, _SETTLED, on))
        x = task.still + 0.9 * (x - task.still)
    return x


def default_harmonics(bounds: Bounds, duration: float) -> int:
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
    """The same with ten times the samples, and nearly all of the limits."""
    return dataclasses.replace(task, series=task.series.finer(_FINER), share=_NEARLY)


def used(task: Task, x: np.ndarray) -> Used:
    """What of each limit a motion uses, ten times as densely as it was searched."""
    fine = finer(task)
    q, qd, qdd = fine.series.motion(x)
    loads = None
    if task.beta is not None:
        s = fine.columns.read((q, qd, qdd), fine.series.time)
        loads = np.abs(fine.columns.exact(q, qd, qdd, s) @ task.beta).max(axis=0)
    posture = fine.posture.shares(q)
    return Used(
        q.min(axis=0), q.max(axis=0), np.abs(qd).max(axis=0), np.abs(qdd).max(axis=0), loads,
        float(np.abs(posture).max()) if posture.size else None,
        float(posture[:, : len(fine.posture.kinds)].max()) if fine.posture.kinds else None,
    )  # fmt: skip


def random_motion(task: Task, rng: np.random.Generator) -> np.ndarray:
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
        shares = (extent / b.half[j], np.abs(s.slopes @ x[j]).max() / b.speed[j],
                  np.abs(s.bends @ x[j]).max() / b.acceleration[j])  # fmt: skip
        x[j] *= _FULL * s.room / max(shares)
        q = s.values[:, 1:] @ x[j, 1:]
        least, most = _FULL * s.room * b.half[j] * np.array([-1, 1]) + b.middle[j]
        x[j, 0] = rng.uniform(least - q.min(), max(most - q.max(), least - q.min()))
    return task.drawn_in(x)
