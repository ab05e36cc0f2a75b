"""The analysis at one point of the search: what is in the model so far, and what it leaves."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler import regression
from modeler.core.json import ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.diagnosis import ranking
from modeler.diagnosis.candidates import (
    Candidate,
    Columns,
    JointScale,
    Rows,
    StatedEffects,
    build_rows,
    compute_scales,
    count_columns,
    to_dense,
)
from modeler.diagnosis.signals import SignalReference
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget
from modeler.estimation import Prior, build_prior, estimate_correlation
from modeler.numerics import least_squares

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class SearchData(ShortRepr):
    """What does not change during a search.

    Attributes:
        compiled: the robot.
        observation: of the training logs, in the band of the analysis.
        fixed_parameters: (c,) base parameters where the robot has changed since the fit: those of
            links are not fitted again, friction and offsets are; None: all are fitted.
        stated_effects: the effects that may be missing, and how motors are coupled.
    """

    compiled: "CompiledModel"
    observation: regression.Observation
    fixed_parameters: np.ndarray | None = None
    stated_effects: StatedEffects = field(default_factory=StatedEffects)

    @property
    def spec(self) -> ModuleSpec:
        """Returns the manifest of the robot."""
        return self.compiled.spec

    @cached_property
    def time_blocks(self) -> ranking.TimeBlocks:
        """Returns the blocks of time of the observation, and their folds."""
        return ranking.build_time_blocks(self.observation)

    @cached_property
    def rows(self) -> Rows:
        """Returns all rows; effects are not linearised about anything yet."""
        beta = np.zeros(len(self.spec.base))
        reference = SignalReference(self.compiled, beta, *_find_references(self.observation))
        return build_rows(self.observation, reference)

    def linearise_rows(self, reference: SignalReference) -> Rows:
        """Returns the rows with effects linearised about a reference; the last few are cached."""
        key = reference.beta.tobytes(), _make_clock_key(reference)
        rows = self._row_cache.pop(key, None) or self.rows.replace_reference(reference)
        self._row_cache[key] = rows
        if len(self._row_cache) > THRESHOLDS.cached_references:
            del self._row_cache[next(iter(self._row_cache))]
        return rows

    @cached_property
    def _row_cache(self) -> dict[Any, Rows]:
        return {}

    @cached_property
    def free_columns(self) -> np.ndarray:
        """Returns the indices of the base columns that are fitted."""
        base = self.spec.base
        free = [i for i, b in enumerate(base) if self.fixed_parameters is None or b.kind in _FREE]
        return np.array(free, dtype=int)

    @cached_property
    def y(self) -> tuple[np.ndarray, ...]:
        """Returns torques, (rows_j,) by joint, less those of fixed base parameters."""
        if self.fixed_parameters is None:
            return self.rows.y
        fixed = self.fixed_parameters.copy()
        fixed[self.free_columns] = 0.0
        return tuple(y - w @ fixed for y, w in zip(self.rows.y, self.rows.W, strict=True))

    @cached_property
    def reduction(self) -> least_squares.Reduction:
        """Returns the reduction of the fitted base columns, and y."""
        W = self.rows.W
        if self.fixed_parameters is not None:
            W = tuple(w[:, self.free_columns] for w in W)
        return least_squares.reduce_rows(W, self.y)

    @cached_property
    def prior(self) -> Prior | None:
        """Returns the prior of the base parameters; None where they are fixed."""
        return build_prior(self.spec) if self.fixed_parameters is None else None

    @cached_property
    def block_numbers(self) -> tuple[np.ndarray, ...]:
        """Returns the number of the block of time, (rows_j,) by joint."""
        used = self.observation.used
        return tuple(self.time_blocks.number[used[:, j]] for j in range(self.rows.joint_count))


_FREE = ("friction", "offset")


def _make_clock_key(reference: SignalReference) -> tuple[Any, ...]:
    """What the time and the temperature of effects are counted from."""
    return reference.time, *sorted(reference.temperature.items())


@dataclass(frozen=True, eq=False)
class State(ShortRepr):
    """The model with the effects accepted so far.

    Attributes:
        data: the logs.
        picks: accepted candidates, in order.
        reference: where effects are linearised.
        rows: motion, torque, base columns.
        extra: columns of the picks.
        adopted_weights: sigma and prior of another state, which are taken; None: its own.
    """

    data: SearchData
    picks: tuple[Candidate, ...]
    reference: SignalReference
    rows: Rows
    extra: tuple[Columns, ...]
    adopted_weights: tuple[np.ndarray, np.ndarray] | None = None

    @property
    def spec(self) -> ModuleSpec:
        """Returns the manifest of the robot."""
        return self.data.spec

    @property
    def joint_names(self) -> list[str]:
        """Returns the names of the joints."""
        return [joint.name for joint in self.spec.joints]

    @property
    def W(self) -> tuple[np.ndarray, ...]:
        """Returns fitted base columns, then the picks', (rows_j, f + extra) by joint; a copy."""
        free, blocks = self.data.free_columns, []
        for j, base in enumerate(self.rows.W):
            extra = (to_dense(columns, j, len(base)) for columns in self.extra)
            blocks.append(np.hstack([base[:, free], *extra]))
        return tuple(blocks)

    def multiply_columns(self, values: np.ndarray) -> tuple[np.ndarray, ...]:
        """Returns `W values`, (rows_j, ...) by joint, of values (f + extra, ...); without W."""
        return _multiply_columns(self.rows.W, self.data.free_columns, self.extra, values)

    @property
    def column_count(self) -> int:
        """Returns the number of columns, f + extra."""
        return len(self.data.free_columns) + sum(map(count_columns, self.extra))

    @property
    def y(self) -> tuple[np.ndarray, ...]:
        """Returns torques, (rows_j,) by joint, less those of fixed base parameters."""
        return self.data.y

    @cached_property
    def gram_blocks(self) -> ranking.GramBlocks:
        """Returns the Gram matrices of the model so far, by block."""
        numbers, fold = self.data.block_numbers, self.data.time_blocks.fold
        known = numbers, fold, self.whitener, self.prior
        # of its parts: a state that its own columns refer to would not be let go of
        multiply = partial(_multiply_columns, self.rows.W, self.data.free_columns, self.extra)
        return ranking.build_gram_blocks(multiply, self.y, self.sigma, *known)

    @cached_property
    def fold_grams(self) -> ranking.GramBlocks:
        """Returns the Gram matrices of the model so far, by fold."""
        return ranking.merge_blocks(self.gram_blocks)

    @cached_property
    def reduced_rows(self) -> least_squares.ReducedRows:
        """Returns the rows of the model so far, reduced to few."""
        return self.data.reduction.append_columns(self.extra)

    def replace_weights(self, later: "State") -> "State":
        """Returns the state with residuals and prior of a state with more effects."""
        first = self.prior.shape[1] - 1
        prior = later.prior[:, [*range(first), -1]]
        return replace(self, adopted_weights=(later.sigma, prior))

    @cached_property
    def prior(self) -> np.ndarray:
        """Returns rows of prior knowledge, (k, f + extra + 1), beside autocorrelated rows.

        Rows of the logs count as if they were independent, and the prior as much more instead: by
        the sum of the autocorrelation of the residual, 1 + 2 sum_k r(k), of the middle joint. Where
        the logs would have a body that the prior excludes, what is missing is another effect,
        which the body would stand in for: its prior counts more, until it is not excluded.
        """
        if self.adopted_weights is not None:
            return self.adopted_weights[1]
        columns, known = self.reduced_rows.W[0].shape[1], self.data.prior
        if known is None:
            return np.zeros((0, columns + 1))
        every = zip(self.reduced_rows.W, ranking.estimate_sigma(self.reduced_rows), strict=True)
        lengths = np.sqrt(sum(np.sum((w / s) ** 2, axis=0) for w, s in every))
        rows, observation = known.extend_rows(lengths), self.data.observation
        solution, sums = self._solve_with_prior(rows), [1.0]
        predicted = self.multiply_columns(solution)
        for j, (y, torque) in enumerate(zip(self.y, predicted, strict=True)):
            if y.any():
                used = np.flatnonzero(observation.used[:, j])
                r = estimate_correlation(observation, y - torque, used)
                sums.append(max(1.0, 2.0 * float(r.sum()) - 1.0))
        repeats = float(np.median(sums[1:] or sums))
        tight: dict[str, float] = {}
        for _ in range(THRESHOLDS.max_prior_steps):
            rows = known.scale_sigmas(tight).extend_rows(lengths) * repeats**0.5
            solution = self._solve_with_prior(rows)
            nearer = known.find_unlikely_groups(solution[: len(self.data.free_columns)])
            if not nearer:
                break
            tight |= {name: 0.5 * tight.get(name, 1.0) for name in nearer}
        return rows

    @cached_property
    def sigma(self) -> np.ndarray:
        """Returns the rms residual of each joint, (J,)."""
        if self.adopted_weights:
            return self.adopted_weights[0]
        return ranking.estimate_sigma(self.reduced_rows, prior=self.prior)

    @cached_property
    def whitener(self) -> np.ndarray:
        """Returns the transform to orthonormal weighted columns, (f + extra, r)."""
        return self._compute_whitener(self.sigma, self.prior)

    @cached_property
    def solution(self) -> np.ndarray:
        """Returns the parameters on all rows (f + extra,), SI; first the fitted base parameters."""
        return self._solve_weighted(self.whitener, self.sigma, self.prior)

    def _solve_weighted(
        self, whitener: np.ndarray, sigma: np.ndarray, prior: np.ndarray
    ) -> np.ndarray:
        if not whitener.shape[1]:
            return np.zeros(len(whitener))
        G, u = 1e-12 * np.eye(whitener.shape[1]), np.zeros(whitener.shape[1])
        every = list(zip(self.reduced_rows.W, self.reduced_rows.y, sigma, strict=True))
        every.append((prior[:, :-1], prior[:, -1], 1.0))
        for w, y, s in every:
            columns = w @ (whitener / s)
            G, u = G + columns.T @ columns, u + columns.T @ (y / s)
        return np.asarray(whitener @ np.linalg.solve(G, u))

    def _compute_whitener(self, sigma: np.ndarray, prior: np.ndarray) -> np.ndarray:
        blocks = [*self.reduced_rows.W, prior[:, :-1]]
        return least_squares.compute_joint_whitening(blocks, np.append(sigma, 1.0))

    def _solve_with_prior(self, prior: np.ndarray) -> np.ndarray:
        """The solution beside such rows of a prior."""
        sigma = ranking.estimate_sigma(self.reduced_rows, prior=prior)
        whitener = self._compute_whitener(sigma, prior)
        return self._solve_weighted(whitener, sigma, prior)

    @cached_property
    def beta(self) -> np.ndarray:
        """Returns the base parameters, (c,)."""
        fixed = self.data.fixed_parameters
        beta = np.zeros(self.rows.W[0].shape[1]) if fixed is None else fixed.copy()
        beta[self.data.free_columns] = self.solution[: len(self.data.free_columns)]
        return beta

    @cached_property
    def values(self) -> list[np.ndarray]:
        """Returns the parameters of each pick, SI."""
        ends = np.cumsum([len(self.data.free_columns), *map(count_columns, self.extra)])
        return [self.solution[first:last] for first, last in pairwise(ends)]

    @cached_property
    def residual(self) -> tuple[np.ndarray, ...]:
        """Returns the residuals, (rows_j,) by joint, N m or N."""
        predicted = self.multiply_columns(self.solution)
        return tuple(y - torque for y, torque in zip(self.y, predicted, strict=True))

    @property
    def torque(self) -> np.ndarray:
        """Returns the model's torque, (s, n), on used rows; elsewhere the measured one."""
        torque = self.data.observation.torque.copy()
        pairs = zip(self.data.observation.used.T, self.residual, strict=True)
        for j, (used, left) in enumerate(pairs):
            torque[used, j] -= left
        return torque

    @cached_property
    def derived_cache(self) -> dict[Any, Any]:
        """Returns what was derived from it, by name."""
        return {}

    @cached_property
    def joint_scales(self) -> list[JointScale]:
        """Returns the scale of each joint."""
        whole = [(s, s.segment.whole) for s in self.rows.signals]
        q, v, load = ([getattr(s, x)[rows] for s, rows in whole] for x in ("q", "v", "load"))
        return compute_scales(self.spec, q, v, load)

    def rank_columns(self, every: Sequence[Columns]) -> ranking.Ranking:
        """Ranks candidates by their columns."""
        base = self.gram_blocks
        return ranking.rank_candidates(base, ranking.build_batch(base, every))


def _multiply_columns(
    W: Sequence[np.ndarray], free: np.ndarray, extra: Sequence[Columns], values: np.ndarray
) -> tuple[np.ndarray, ...]:
    """Free columns of W, then others, times values."""
    ends = np.cumsum([len(free), *map(count_columns, extra)])
    base = np.zeros((W[0].shape[1], *values.shape[1:]))
    base[free] = values[: ends[0]]
    products = [w @ base for w in W]
    for columns, (first, last) in zip(extra, pairwise(ends), strict=True):
        for product, part in zip(products, columns, strict=True):
            if part is not None:
                product += part @ values[first:last]
    return tuple(products)


def build_state(data: SearchData, picks: Sequence[Candidate], beta: np.ndarray) -> State:
    """Builds the analysis with these effects, linearised about beta (c,)."""
    rows = data.linearise_rows(replace(data.rows.signals[0].reference, beta=beta))
    columns = collect_pick_columns(rows, picks)
    return State(data, tuple(picks), rows.signals[0].reference, rows, columns)


def collect_pick_columns(rows: Rows, picks: Sequence[Candidate]) -> tuple[Columns, ...]:
    """Collects the columns of what was put in, cached for every reference."""
    for pick in picks:
        if make_column_key(rows, pick) not in rows.reference_cache:
            rows.reference_cache[make_column_key(rows, pick)] = build_columns(rows, pick)
    return tuple(rows.reference_cache[make_column_key(rows, pick)] for pick in picks)


def build_columns(rows: Rows, candidate: Candidate) -> Columns:
    """Builds the candidate's columns; those that do not depend on the model are cached."""
    return build_all_columns(rows, [candidate])[0]


def build_all_columns(rows: Rows, candidates: Sequence[Candidate]) -> list[Columns]:
    """Builds the columns of many candidates: all parameters of one effect at once."""
    keys = [(id(c), make_column_key(rows, c)) for c in candidates if _is_model_independent(c)]
    columns = {c: rows.cache[key] for c, key in keys if key in rows.cache}
    for every in _group_candidates([c for c in candidates if id(c) not in columns]):
        made = rows.build_batch(every) if len(every) > 1 else [rows.build_columns(every[0])]
        for candidate, candidate_columns in zip(every, made, strict=True):
            columns[id(candidate)] = candidate_columns
            if _is_model_independent(candidate):
                _cache_columns(rows.cache, make_column_key(rows, candidate), candidate_columns)
    return [columns[id(candidate)] for candidate in candidates]


_HELD = "bytes held"


def _cache_columns(cache: dict[Any, Any], key: Any, columns: Columns) -> None:
    """As long as there is room for them."""
    held = cache.get(_HELD, 0) + sum(8 * c.size for c in columns if c is not None)
    if held <= THRESHOLDS.max_cached_bytes:
        cache |= {_HELD: held, key: columns}


def batch_candidates(candidates: Sequence[Candidate], most: int) -> Iterator[list[Candidate]]:
    """Yields candidates whose columns are made together, about so many at a time."""
    some: list[Candidate] = []
    for group in _group_candidates(candidates):
        if some and len(some) + len(group) > most:
            yield some
            some = []
        some = [*some, *group]
    if some:
        yield some


def _group_candidates(candidates: Sequence[Candidate]) -> list[list[Candidate]]:
    """The shapes of one effect on one joint.

    Joint after joint: the slopes along the motion of one joint serve all its effects.
    """
    groups: dict[Any, list[Candidate]] = {}
    for candidate in candidates:
        groups.setdefault((candidate.key, id(candidate.form)), []).append(candidate)
    return sorted(groups.values(), key=lambda group: group[0].index)


def _is_model_independent(candidate: Candidate) -> bool:
    """True if its columns do not depend on the model."""
    memory = candidate.form.internal_state
    reads = candidate.form.names & {"load", "static", "torque", "rate"}
    rings = memory is not None and memory.kind == "resonance"
    return candidate.effect.acts in _FIXED and not reads and not rings


def make_column_key(rows: Rows, candidate: Candidate) -> tuple[Any, ...]:
    """Makes the key of columns that do not depend on the model."""
    shapes = tuple(sorted(candidate.nonlinear_parameters.items()))
    timed = not candidate.form.names.isdisjoint({"t", "T"})
    clock = _make_clock_key(rows.signals[0].reference) if timed else ()
    return candidate.effect.id, candidate.joint, shapes, clock


_FIXED = (EffectTarget.JOINT, EffectTarget.MOTOR, EffectTarget.PASSIVE, EffectTarget.LINK)
"""What reads the motion only, if its equations do."""


def is_visible(columns: Columns) -> bool:
    """Returns whether the columns are finite and none of them is zero throughout."""
    parts = [c.T for c in columns if c is not None]
    if not parts or not len(parts[0]):
        return False
    square = sum(np.einsum("ij,ij->i", c, c) for c in parts)
    return bool(np.isfinite(square).all() and np.all(square > 0.0))


def _find_references(observation: regression.Observation) -> tuple[float, Mapping[str, float]]:
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


def analyse_logs(
    compiled: "CompiledModel",
    logs: Sequence[regression.Log],
    fitted: regression.Processing,
    band: float | None = None,
    prepared: regression.PreparedLogs | None = None,
    repair: regression.LogRepair | None = None,
) -> regression.Observation:
    """Returns the observation of a diagnosis.

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
        repair: of the same logs, where it is shared.
    """
    prepared = choose_band(compiled, logs, fitted, band, prepared, repair)
    return observe_logs(compiled, logs, prepared)


def observe_logs(
    compiled: "CompiledModel", logs: Sequence[regression.Log], prepared: regression.PreparedLogs
) -> regression.Observation:
    """Returns the observation of logs whose band is chosen."""
    every = regression.build_observation(compiled, logs, prepared, every_joint=True)
    return every.select_rows(every.whole) if every.whole.any() else every


def choose_band(
    compiled: "CompiledModel",
    logs: Sequence[regression.Log],
    fitted: regression.Processing,
    band: float | None,
    prepared: regression.PreparedLogs | None = None,
    repair: regression.LogRepair | None = None,
) -> regression.PreparedLogs:
    """Prepares the logs in the band that `analyse_logs` chooses."""
    prepared = prepared or regression.prepare_logs(compiled.spec, logs, fitted, repair)
    prepared = prepared.drop_commands()
    noise = prepared.noise
    if "parallel_cutoff" not in fitted.automatic_cutoffs or not noise.moving:
        return prepared
    user_cutoff = None if "position_cutoff" in fitted.automatic_cutoffs else fitted.position_cutoff
    asked = replace(fitted, position_cutoff=user_cutoff, parallel_cutoff=None)
    asked = replace(asked, decimation=None, edge=None)
    wide, _ = regression.choose_cutoffs(asked, prepared.pieces, noise)
    motion, slowest = wide.parallel_cutoff, max(piece.step for piece in prepared.pieces)
    highest = user_cutoff or regression.THRESHOLDS.max_cutoff_share / slowest
    if band is None:
        parallel = max(motion, min(THRESHOLDS.max_band, 0.5 * highest, 0.5 * noise.cutoff))
        position = max(wide.position_cutoff, 2.0 * parallel)
    else:
        parallel = max(motion, min(band, 0.8 * highest))
        position = 1.25 * parallel if band else wide.position_cutoff
    prepared = replace(prepared, processing=wide)
    prepared = prepared.set_cutoffs(user_cutoff or min(position, highest), parallel)
    cutoffs = regression.CutoffSearch(compiled, prepared)
    quiet_cutoffs = cutoffs.find_chatter_free(motion, user_cutoff is not None)
    prepared = prepared.set_cutoffs(quiet_cutoffs.position, quiet_cutoffs.parallel)
    if any(log.check is not None for log in prepared.logs):  # in the band of the rows
        again = regression.prepare_logs(compiled.spec, logs, prepared.processing, repair)
        prepared = again.drop_commands()
    return prepared


def observe_in_band(
    compiled: "CompiledModel", logs: Sequence[regression.Log], processing: regression.Processing
) -> regression.Observation:
    """Returns other logs in the band of a diagnosis."""
    prepared = regression.prepare_logs(compiled.spec, logs, processing)
    return observe_logs(compiled, logs, prepared.drop_commands())


def get_cutoff(data: SearchData) -> float:
    """Returns the cut-off of the parallel filter, Hz."""
    return data.observation.report.processing.parallel_cutoff or 0.0


def describe_bands(fitted: regression.Processing, processing: regression.Processing) -> list[str]:
    """Describes the band of a diagnosis where it is not that of the fit."""
    if processing.parallel_cutoff == fitted.parallel_cutoff:
        return []
    if (processing.parallel_cutoff or 0.0) < (fitted.parallel_cutoff or 0.0):
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
        f"errors and values are those up to {processing.parallel_cutoff:.3g} Hz, beside all "
        f"effects named; `modeler fit` and `add` fit up to {fitted.parallel_cutoff:g} Hz: {why}"
    ]
