"""The analysis at one point of the search: what is in the model so far, and what it leaves."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler.core.brief import Brief
from modeler.core.manifest import ModuleSpec
from modeler.diagnosis.candidates import Candidate, JointScale, StatedEffects, scales_of
from modeler.diagnosis.effect_columns import Columns, Rows, dense, rows_of, width
from modeler.diagnosis.ranking import (
    Base,
    Ranking,
    TimeBlocks,
    base_of,
    blocks_of,
    folded,
    pool_of,
    rank,
    sigma_of,
)
from modeler.diagnosis.signals import SignalReference
from modeler.effects import Acts
from modeler.estimation import Prior, prior_of, remembered
from modeler.numerics.least_squares import ReducedRows, Reduction, reduction, turn_of
from modeler.observation import (
    HIGHEST,
    ChosenProcessing,
    Log,
    LogRepair,
    Look,
    Observation,
    Prepared,
    Processing,
    choose_cutoffs,
    observed,
    prepare,
)

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class SearchData(Brief):
    """What does not change during a search.

    Attributes:
        compiled: the robot.
        observation: of the training logs, in the band of the analysis.
        kept: (c,) base parameters where the robot has changed since their fit: those of the
            links are not fitted again, friction and offsets are; None: all are fitted.
        known: the effects that may be missing, and how motors are coupled.
    """

    compiled: "CompiledModel"
    observation: Observation
    kept: np.ndarray | None = None
    known: StatedEffects = field(default_factory=StatedEffects)

    @property
    def spec(self) -> ModuleSpec:
        """What the robot is made of."""
        return self.compiled.spec

    @cached_property
    def blocks(self) -> TimeBlocks:
        """Blocks and folds."""
        return blocks_of(self.observation)

    @cached_property
    def rows(self) -> Rows:
        """All rows; effects are not linearised about anything yet."""
        beta = np.zeros(len(self.spec.base))
        return rows_of(
            self.observation, SignalReference(self.compiled, beta, *_references(self.observation))
        )

    def about(self, reference: SignalReference) -> Rows:
        """The rows with effects linearised about a reference; the last few are remembered."""
        key = reference.beta.tobytes(), _clock(reference)
        found = self._about.pop(key, None) or self.rows.about(reference)
        self._about[key] = found
        if len(self._about) > _REMEMBERED:
            del self._about[next(iter(self._about))]
        return found

    @cached_property
    def _about(self) -> dict[Any, Rows]:
        return {}

    @cached_property
    def free(self) -> np.ndarray:
        """Indices of the base columns that are fitted."""
        base = self.spec.base
        free = [i for i, b in enumerate(base) if self.kept is None or b.kind in _FREE]
        return np.array(free, dtype=int)

    @cached_property
    def y(self) -> tuple[np.ndarray, ...]:
        """(rows_j,) by joint: torques, less those of base parameters that are kept."""
        if self.kept is None:
            return self.rows.y
        kept = self.kept.copy()
        kept[self.free] = 0.0
        return tuple(y - w @ kept for y, w in zip(self.rows.y, self.rows.W, strict=True))

    @cached_property
    def reduction(self) -> Reduction:
        """Of the base columns that are fitted, and y."""
        return reduction([w[:, self.free] for w in self.rows.W], self.y)

    @cached_property
    def prior(self) -> Prior | None:
        """What is known beforehand of the base parameters; None where they are kept."""
        return prior_of(self.spec) if self.kept is None else None

    @cached_property
    def numbers(self) -> tuple[np.ndarray, ...]:
        """(rows_j,) by joint, number of the block of time."""
        used = self.observation.used
        return tuple(self.blocks.number[used[:, j]] for j in range(self.rows.joints))


_FREE = ("friction", "offset")

_STRONGER = 12  # times twice

_REMEMBERED = 3  # references: that of a state, and those of the next


def _clock(reference: SignalReference) -> tuple[Any, ...]:
    """What the time and the temperature of effects are counted from."""
    return reference.time, *sorted(reference.temperature.items())


@dataclass(frozen=True, eq=False)
class State(Brief):
    """The model with the effects accepted so far.

    Attributes:
        data: the logs.
        picks: accepted candidates, in order.
        reference: where effects are linearised.
        rows: motion, torque, base columns.
        extra: columns of the picks.
        weighed: sigma and prior of another state, which are taken; None: its own.
    """

    data: SearchData
    picks: tuple[Candidate, ...]
    reference: SignalReference
    rows: Rows
    extra: tuple[Columns, ...]
    weighed: tuple[np.ndarray, np.ndarray] | None = None

    @property
    def spec(self) -> ModuleSpec:
        """What the robot is made of."""
        return self.data.spec

    @property
    def names(self) -> list[str]:
        """Of the joints."""
        return [joint.name for joint in self.spec.joints]

    @cached_property
    def W(self) -> tuple[np.ndarray, ...]:
        """(rows_j, f + extra) by joint: base columns that are fitted, then the picks'."""
        if not self.extra and self.data.kept is None:
            return self.rows.W
        return tuple(
            np.hstack([base[:, self.data.free], *(dense(e, j, len(base)) for e in self.extra)])
            for j, base in enumerate(self.rows.W)
        )

    @property
    def y(self) -> tuple[np.ndarray, ...]:
        """(rows_j,) by joint: torques, less those of base parameters that are kept."""
        return self.data.y

    @cached_property
    def base(self) -> Base:
        """Of the model so far."""
        numbers, fold = self.data.numbers, self.data.blocks.fold
        return base_of(self.W, self.y, self.sigma, numbers, fold, self.turn, self.prior)

    @cached_property
    def folded(self) -> Base:
        """The same by folds."""
        return folded(self.base)

    @cached_property
    def reduced(self) -> ReducedRows:
        """The rows of the model so far, reduced to few."""
        return self.data.reduction.beside(self.extra)

    def weighed_as(self, later: "State") -> "State":
        """The same beside the residuals and the prior of a state with more effects."""
        first = self.prior.shape[1] - 1
        prior = later.prior[:, [*range(first), -1]]
        return dataclasses.replace(self, weighed=(later.sigma, prior))

    @cached_property
    def prior(self) -> np.ndarray:
        """(k, f + extra + 1) rows of what is known beforehand, beside rows that repeat each other.

        Rows of the logs count as if they were independent, and the prior as much more instead: by
        the sum of the autocorrelation of the residual, 1 + 2 sum_k r(k), of the middle joint. Where
        the logs would have a body that the prior excludes, what is missing is another effect,
        which the body would stand in for: its prior counts more, until it is not excluded.
        """
        if self.weighed is not None:
            return self.weighed[1]
        columns, known = self.reduced.W[0].shape[1], self.data.prior
        if known is None:
            return np.zeros((0, columns + 1))
        every = zip(self.reduced.W, sigma_of(self.reduced), strict=True)
        lengths = np.sqrt(sum(np.sum((w / s) ** 2, axis=0) for w, s in every))
        rows, observation = known.beside(lengths), self.data.observation
        found, sums = self._beside(rows), [1.0]
        for j, (y, w) in enumerate(zip(self.y, self.W, strict=True)):
            if y.any():
                r = remembered(observation, y - w @ found, np.flatnonzero(observation.used[:, j]))
                sums.append(max(1.0, 2.0 * float(r.sum()) - 1.0))
        repeats = float(np.median(sums[1:] or sums))
        tight: dict[str, float] = {}
        for _ in range(_STRONGER):
            rows = known.tightened(tight).beside(lengths) * repeats**0.5
            nearer = known.excluded(self._beside(rows)[: len(self.data.free)])
            if not nearer:
                break
            tight |= {name: 0.5 * tight.get(name, 1.0) for name in nearer}
        return rows

    @cached_property
    def sigma(self) -> np.ndarray:
        """(J,) rms residual of each joint."""
        return sigma_of(self.reduced, prior=self.prior) if not self.weighed else self.weighed[0]

    @cached_property
    def turn(self) -> np.ndarray:
        """(f + extra, r) to orthonormal weighted columns."""
        return turn_of([*self.reduced.W, self.prior[:, :-1]], np.append(self.sigma, 1.0))

    @cached_property
    def solution(self) -> np.ndarray:
        """(f + extra,) parameters on all rows, SI; first the base parameters that are fitted."""
        return self._solved(self.turn, self.sigma, self.prior)

    def _solved(self, turn: np.ndarray, sigma: np.ndarray, prior: np.ndarray) -> np.ndarray:
        if not turn.shape[1]:
            return np.zeros(len(turn))
        G, u = 1e-12 * np.eye(turn.shape[1]), np.zeros(turn.shape[1])
        every = [*zip(self.reduced.W, self.reduced.y, sigma, strict=True),
                 (prior[:, :-1], prior[:, -1], 1.0)]  # fmt: skip
        for w, y, s in every:
            columns = w @ (turn / s)
            G, u = G + columns.T @ columns, u + columns.T @ (y / s)
        return np.asarray(turn @ np.linalg.solve(G, u))

    def _beside(self, prior: np.ndarray) -> np.ndarray:
        """The solution beside such rows of a prior."""
        sigma = sigma_of(self.reduced, prior=prior)
        turn = turn_of([*self.reduced.W, prior[:, :-1]], np.append(sigma, 1.0))
        return self._solved(turn, sigma, prior)

    @cached_property
    def beta(self) -> np.ndarray:
        """(c,) base parameters."""
        found = np.zeros(self.rows.W[0].shape[1]) if self.data.kept is None else self.data.kept
        found = found.copy()
        found[self.data.free] = self.solution[: len(self.data.free)]
        return found

    @cached_property
    def values(self) -> list[np.ndarray]:
        """Parameters of each pick, SI."""
        ends = np.cumsum([len(self.data.free), *map(width, self.extra)])
        return [self.solution[first:last] for first, last in pairwise(ends)]

    @cached_property
    def residual(self) -> tuple[np.ndarray, ...]:
        """(rows_j,) by joint, N m or N."""
        return tuple(y - w @ self.solution for y, w in zip(self.y, self.W, strict=True))

    @property
    def torque(self) -> np.ndarray:
        """(s, n) of the model, beside the rows that are used; of the others the measured one."""
        found = self.data.observation.torque.copy()
        for j, (used, left) in enumerate(
            zip(self.data.observation.used.T, self.residual, strict=True)
        ):
            found[used, j] -= left
        return found

    @cached_property
    def known(self) -> dict[Any, Any]:
        """What was made of it, by name."""
        return {}

    @cached_property
    def scales(self) -> list[JointScale]:
        """What is large on each joint."""
        motion = (
            [getattr(s, name)[s.segment.whole] for s in self.rows.signals]
            for name in ("q", "v", "load")
        )
        return scales_of(self.spec, *motion)

    def ranked(self, every: Sequence[Columns]) -> Ranking:
        """Candidates by their columns."""
        return rank(self.base, pool_of(self.base, every))


def state_of(data: SearchData, picks: Sequence[Candidate], beta: np.ndarray) -> State:
    """The analysis with these effects, linearised about beta (c,)."""
    rows = data.about(dataclasses.replace(data.rows.signals[0].reference, beta=beta))
    return State(data, tuple(picks), rows.signals[0].reference, rows, picked_columns(rows, picks))


def picked_columns(rows: Rows, picks: Sequence[Candidate]) -> tuple[Columns, ...]:
    """The columns of what was put in: remembered for every reference."""
    for pick in picks:
        if column_key(rows, pick) not in rows.known:
            rows.known[column_key(rows, pick)] = columns_of(rows, pick)
    return tuple(rows.known[column_key(rows, pick)] for pick in picks)


def columns_of(rows: Rows, candidate: Candidate) -> Columns:
    """The candidate's columns; those that do not depend on the model are computed once."""
    return all_columns_of(rows, [candidate])[0]


def all_columns_of(rows: Rows, candidates: Sequence[Candidate]) -> list[Columns]:
    """The columns of many candidates: the shapes of one effect at once."""
    found = {
        id(c): rows.cache[key] for c in candidates
        if _fixed(c) and (key := column_key(rows, c)) in rows.cache
    }  # fmt: skip
    for every in _groups([c for c in candidates if id(c) not in found]):
        made = rows.many(every) if len(every) > 1 else [rows.columns(every[0])]
        for candidate, own in zip(every, made, strict=True):
            found[id(candidate)] = own
            if _fixed(candidate):
                _remember(rows.cache, column_key(rows, candidate), own)
    return [found[id(candidate)] for candidate in candidates]


KEPT = 2**27
"""Bytes of columns that do not depend on the model, remembered for the next state."""

_HELD = "bytes held"


def _remember(cache: dict[Any, Any], key: Any, columns: Columns) -> None:
    """As long as there is room for them."""
    held = cache.get(_HELD, 0) + sum(8 * c.size for c in columns if c is not None)
    if held <= KEPT:
        cache |= {_HELD: held, key: columns}


def together(candidates: Sequence[Candidate], most: int) -> Iterator[list[Candidate]]:
    """Candidates whose columns are made together, about so many at a time."""
    some: list[Candidate] = []
    for group in _groups(candidates):
        if some and len(some) + len(group) > most:
            yield some
            some = []
        some = [*some, *group]
    if some:
        yield some


def _groups(candidates: Sequence[Candidate]) -> list[list[Candidate]]:
    """The shapes of one effect on one joint.

    Joint after joint: the slopes along the motion of one joint serve all its effects.
    """
    groups: dict[Any, list[Candidate]] = {}
    for candidate in candidates:
        groups.setdefault((candidate.key, id(candidate.form)), []).append(candidate)
    return sorted(groups.values(), key=lambda own: own[0].index)


def _fixed(candidate: Candidate) -> bool:
    """True if its columns do not depend on the model."""
    memory = candidate.form.memory
    return (
        candidate.form.names.isdisjoint({"load", "static", "torque", "rate"})
        and candidate.effect.acts in _FIXED
        and (memory is None or memory.kind != "resonance")
    )


def column_key(rows: Rows, candidate: Candidate) -> tuple[Any, ...]:
    """What columns that do not depend on the model depend on."""
    shapes = tuple(sorted(candidate.shapes.items()))
    clock = () if candidate.form.names.isdisjoint({"t", "T"}) else _clock(rows.signals[0].reference)
    return candidate.effect.id, candidate.joint, shapes, clock


_FIXED = (Acts.JOINT, Acts.MOTOR, Acts.PASSIVE, Acts.LINK)
"""What reads the motion only, if its equations do."""


def visible(columns: Columns) -> bool:
    """True if the columns are finite and none of them is zero throughout."""
    own = [c.T for c in columns if c is not None]
    if not own or not len(own[0]):
        return False
    square = sum(np.einsum("ij,ij->i", c, c) for c in own)
    return bool(np.isfinite(square).all() and np.all(square > 0.0))


def _references(observation: Observation) -> tuple[float, Mapping[str, float]]:
    """The first time, and the mean temperature by joint where one is logged."""
    segments = [part.segment for part in observation.stretches]
    temperature = {}
    for joint in observation.joints:
        for name in (f"temperature{joint.name}", "temperature"):
            if all(name in s.extra and np.isfinite(s.extra[name]).all() for s in segments):
                every = np.concatenate([s.extra[name] for s in segments])
                temperature[joint.name] = float(every.mean())
                break
    return float(np.min(observation.time)), temperature


# The logs as a diagnosis sees them: as far up as positions are more than noise, and quiet.


BAND = 30.0
"""Hz: highest cut-off of the parallel filter. Fits use a narrow band, where torque noise is least;
ripple, elasticity, delays and reversals show above it."""


def analysed(
    compiled: "CompiledModel", logs: Sequence[Log], fitted: Processing, band: float | None = None,
    prepared: Prepared | None = None, mending: LogRepair | None = None,
) -> Observation:  # fmt: skip
    """The observation of a diagnosis.

    With f0 where the positions drown in their noise, and c the parallel cut-off that the motion
    asks for, the parallel filter is at f0/2 within c and `BAND`, that of the positions at f0 and at
    least twice as high. Both are lowered until the model's torque is `quiet`, the parallel filter
    first down to c. What the user gave stays.

    Args:
        compiled: the robot.
        logs: to look at.
        fitted: processing of the fit.
        band: Hz of the parallel filter to begin with; None: as above; 0: c.
        prepared: the logs as `fitted` prepares them; None: they are.
        mending: of the same logs, where it is shared.
    """
    look = in_band(compiled, logs, fitted, band, prepared, mending)
    return seen_in(compiled, logs, look)


def seen_in(compiled: "CompiledModel", logs: Sequence[Log], look: Prepared) -> Observation:
    """The observation of logs whose band is chosen."""
    return _whole(observed(compiled, logs, look, every_joint=True))


def in_band(
    compiled: "CompiledModel", logs: Sequence[Log], fitted: Processing, band: float | None,
    prepared: Prepared | None = None, mending: LogRepair | None = None,
) -> Prepared:  # fmt: skip
    """The logs, with the band that `analysed` chooses."""
    prepared = (prepared or prepare(compiled.spec, logs, fitted, mending)).uncommanded()
    noise = prepared.noise
    if "parallel_cutoff" not in fitted.chosen or not noise.moving:
        return prepared
    given = None if "position_cutoff" in fitted.chosen else fitted.position_cutoff
    asked = dataclasses.replace(
        fitted, position_cutoff=given, parallel_cutoff=None, decimation=None, edge=None
    )
    wide, _ = choose_cutoffs(asked, prepared.pieces, noise)
    motion = wide.parallel_cutoff
    highest = given or HIGHEST / max(piece.step for piece in prepared.pieces)
    if band is None:
        parallel = max(motion, min(BAND, 0.5 * highest, 0.5 * noise.cutoff))
        position = max(wide.position_cutoff, 2.0 * parallel)
    else:
        parallel = max(motion, min(band, 0.8 * highest))
        position = 1.25 * parallel if band else wide.position_cutoff
    prepared = dataclasses.replace(prepared, processing=wide)
    prepared = prepared.with_cutoffs(given or min(position, highest), parallel)
    found = Look(compiled, prepared).quiet(motion, given is not None)
    prepared = prepared.with_cutoffs(found.position, found.parallel)
    if any(log.check is not None for log in prepared.logs):  # in the band of the rows
        prepared = prepare(compiled.spec, logs, prepared.processing, mending).uncommanded()
    return prepared


def again(
    compiled: "CompiledModel", logs: Sequence[Log], processing: ChosenProcessing
) -> Observation:
    """Other logs in the band of a diagnosis."""
    return seen_in(compiled, logs, prepare(compiled.spec, logs, processing).uncommanded())


def cutoff(data: SearchData) -> float:
    """Hz of the parallel filter."""
    return data.observation.report.processing.parallel_cutoff or 0.0


def bands_line(fitted: Processing, seen: Processing) -> list[str]:
    """A sentence on the band of a diagnosis where it is not that of the fit."""
    if seen.parallel_cutoff == fitted.parallel_cutoff:
        return []
    if (seen.parallel_cutoff or 0.0) < (fitted.parallel_cutoff or 0.0):
        why = (
            "of these logs, and with what the model has, no more of the motion is answered by the "
            "torques"
        )
    else:
        why = (
            "ripple, elasticity, delays and reversals show above; fit with --parallel-cutoff "
            f"{fitted.parallel_cutoff:g} to have both alike"
        )
    return [
        f"errors and values are those up to {seen.parallel_cutoff:.3g} Hz, beside all effects "
        f"named; `modeler fit` and `add` fit up to {fitted.parallel_cutoff:g} Hz: {why}"
    ]


def _whole(observation: Observation) -> Observation:
    """Only whole rows, if there are any."""
    used = observation.whole
    return observation.with_rows(used) if used.any() else observation
