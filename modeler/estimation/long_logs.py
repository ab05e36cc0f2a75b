"""Long logs: windows are inspected, then every row once, in chunks, in flat memory; their fit.

A chunk is reduced to what a fit needs of it by pure functions, for any worker.
"""

import dataclasses
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import reduce
from itertools import accumulate
from os import cpu_count
from pathlib import Path
from typing import Any

import numpy as np

from modeler import regression
from modeler.core.choices import Method
from modeler.core.errors import DataError, LoopError
from modeler.estimation.identify import (
    build_base_equations,
    find_disconnected_joints,
    find_method,
    find_methods,
    fit_equations,
)
from modeler.estimation.result import FitResult
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import CompressedRegression, merge_compressed
from modeler.runtime import CompiledModel, make_empty_triangles

OF_TRIANGLES = find_methods("triangles")
"""Methods that need no row again once the triangles are there."""

Share = Callable[[float], None]
"""Gets the share of the rows that are done."""

Reducer = Callable[[CompiledModel, regression.Source, regression.LogChoices], Iterable[Any]]
"""Parts of all chunks of a log in order: `PartialFit`, or what has `facts` and `merged_with`."""


@dataclass(frozen=True, eq=False)
class PartialFit:
    """Holds what a fit needs of some rows of a log; it can be pickled.

    Attributes:
        data: their triangles.
        facts: what the rows say of the log.
    """

    data: CompressedRegression
    facts: regression.LogFacts

    def merged_with(self, later: "PartialFit") -> "PartialFit":
        """Returns that of these rows, and of those that follow them."""
        facts = self.facts.merged_with(later.facts)
        return PartialFit(merge_compressed(self.data, later.data), facts)


def reduce_chunk(
    model: CompiledModel, chunk: regression.Chunk, chosen: regression.LogChoices
) -> PartialFit:
    """Reduces the rows y = W beta of a chunk to triangles. Pure: equal chunks give equal bits.

    Args:
        model: the compiled robot.
        chunk: of a log.
        chosen: for that log.

    Raises:
        DataError: a value that cannot be.
    """
    stretches, facts = regression.build_chunk_rows(model, chunk, chosen)
    parts = [part for part in stretches if part.used.any()]
    regressor, state = regression.ModelRegressor(model, parts), make_empty_triangles(model.pattern)
    for part in parts:  # W is never there as a whole
        state = regression.add_stretch(regressor, part, part.filter_torque(), part.used, state)
    names, joints = tuple(base.name for base in model.spec.base), model.spec.joints
    free, rows = np.array([not joint.actuated for joint in joints]), state.rows.astype(np.intp)
    return PartialFit(CompressedRegression(names, state.triangles, rows, free), facts)


@dataclass(frozen=True, eq=False)
class StreamedLogs:
    """Holds long logs, ready for a fit.

    Attributes:
        observation: of the windows, whose report is that of all rows.
        data: triangles of all rows.
        passes: over the logs.
    """

    observation: regression.Observation
    data: CompressedRegression
    passes: regression.LogPasses


def stream_logs(
    model: CompiledModel,
    sources: Sequence[regression.Source],
    processing: regression.Processing | None = None,
    progress: Share = lambda share: None,
    rows: int = regression.FINGER,
    reducer: Reducer | None = None,
) -> StreamedLogs:
    """Reads every row of long logs once, in chunks, and keeps what a fit needs.

    Windows spread over the logs choose what must be one choice: cut-offs, speed floors, where
    velocities come from, the scales of each channel. Then every chunk is repaired, split,
    filtered and reduced to triangles by itself, with margins as long as the filters need.
    Where rows contradict what the windows showed, all are read again with what is known then.

    Args:
        model: the compiled robot.
        sources: of the logs.
        processing: None: automatic.
        progress: gets the share that is done.
        rows: of a chunk, at least; a multiple of `log.FINGER` for a log read from a file.
        reducer: of one log; None: by threads of this process.

    Raises:
        DataError: a log that is damaged, changes while it is read or lacks a column; rows that no
            choice of the windows fits; no usable row.
    """
    reducer = reducer or reduce_by_threads
    passes, every = read_all_rows(model, sources, processing, progress, rows, reducer)
    data = reduce(merge_compressed, [part.data for part in every])
    report = regression.build_streamed_report(model, sources, passes)
    if not data.rows.any():
        raise regression.build_no_row_error(report)
    observation = dataclasses.replace(passes.survey.observation, report=report)
    return StreamedLogs(observation, data, passes)


def identify_long(
    streamed: StreamedLogs, method: Method = "weighted", model: CompiledModel | None = None
) -> FitResult:
    """Returns the fit of the base parameters to long logs.

    Values, sigmas, errors and the essential parameters come from all rows; how long residuals
    are correlated, and by what factor that raises the sigmas, from the windows.

    Args:
        streamed: the logs.
        method: "weighted" or "ordinary".
        model: the compiled robot.

    Raises:
        DataError: another method, fewer rows than parameters, or no torque at all.
    """
    find_method(method, "triangles")
    observation, data, passes = streamed.observation, streamed.data, streamed.passes
    share = min(1.0, float(observation.used.sum() / data.rows.sum()))
    alive = ~np.isin(np.arange(len(data.rows)), find_disconnected_joints(observation))
    triangles = data.triangles * alive[:, None, None]
    data = dataclasses.replace(data, triangles=triangles, rows=data.rows * alive)
    equations = build_base_equations(observation)
    fit = fit_equations(observation, equations, method, model, data=data, share=share)
    samples = sum(facts.tally.count("samples") for facts in passes.facts)
    return dataclasses.replace(fit, samples=samples, reading=passes.to_json())


def read_all_rows(
    model: CompiledModel,
    sources: Sequence[regression.Source],
    processing: regression.Processing | None,
    progress: Share,
    rows: int,
    reducer: Reducer,
) -> tuple[regression.LogPasses, list[Any]]:
    """Returns the passes over long logs, and of each log its part; whatever is kept of rows.

    Raises:
        DataError: as `stream_logs`.
    """
    if any(signal.is_internal_state for signal in model.spec.signals):
        raise regression.WholeLogNeeded(
            f"{sources[0].name}: an effect of {model.spec.robot} depends on all motion before, and "
            "long logs are read in chunks; fit a part of it, FILE@START:END"
        )
    known, total = regression.KnownFacts(), max(1, sum(source.rows for source in sources))
    for number in range(1, THRESHOLDS.max_passes + 1):
        survey = regression.choose_from_windows(
            model, sources, processing or regression.Processing(), known, rows
        )
        begun = [reducer(model, *each) for each in zip(sources, survey.chosen, strict=True)]
        every: list[Any] = []
        for source, parts in zip(sources, begun, strict=True):
            whole: Any = None
            for whole in accumulate(parts, lambda before, part: before.merged_with(part)):
                done = sum(part.facts.tally.count("rows") for part in (*every, whole))
                progress(min(1.0, done / total))
            if whole is None:
                raise DataError(f"{source.name}: no rows; expected a motion; leave it out")
            every.append(whole)
        facts = tuple(part.facts for part in every)
        again = _prepare_next_pass(facts, survey, known)
        if again is None or number == THRESHOLDS.max_passes:
            break
        known = again
    _check_whole_logs(model, sources, facts)
    return regression.LogPasses(survey, facts, number), every


def reduce_by_threads(
    model: CompiledModel,
    source: regression.Source,
    chosen: regression.LogChoices,
    reduce_by: Callable[
        [CompiledModel, regression.Chunk, regression.LogChoices], Any
    ] = reduce_chunk,
) -> Iterator[Any]:
    """Yields the parts of all chunks of a log, in their order, by threads of this process.

    As many chunks are in memory as there are threads, and two. `reduce_by` says what is kept of
    each.
    """
    workers, waiting = cpu_count() or 1, deque[Future[Any]]()
    with ThreadPoolExecutor(workers) as pool:
        try:
            for chunk in regression.read_chunks(source, chosen.chunk_rows, chosen.margin_rows):
                waiting.append(pool.submit(reduce_by, model, chunk, chosen))
                if len(waiting) > workers:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:  # an error, or Ctrl-C: what has not begun is not begun
            for future in waiting:
                future.cancel()


def _prepare_next_pass(
    facts: Sequence[regression.LogFacts], survey: regression.Survey, known: regression.KnownFacts
) -> regression.KnownFacts | None:
    """Returns what another pass is to know; None if this one knew all."""
    low = survey.chosen[0].processing.low_speed
    floors = {name: low * top for log in facts for name, top in log.moving_shafts.items()}
    if not floors and not any(log.is_wrongly_clipped() for log in facts):
        return None
    extremes = {k: log.ranges.torques for k, log in enumerate(facts)}
    return regression.KnownFacts({**known.floors, **floors}, extremes)


def _check_whole_logs(
    model: CompiledModel, sources: Sequence[regression.Source], facts: Sequence[regression.LogFacts]
) -> None:
    """Refuses what only a log as a whole shows.

    Raises:
        DataError: a channel without values, or a position whose count changes for good.
    """
    for source, log in zip(sources, facts, strict=True):
        log.ranges.check_values(Path(source.name), model.spec)
        turned = {j: t for j, t in log.find_first("wrap").items() if not _is_periodic(model, j)}
        zeros = log.find_first("zero")
        for kind, first_times in (("another zero", zeros), ("another turn", turned)):
            for j, time in first_times.items():
                raise regression.WholeLogNeeded(
                    f"{source.name}: q{model.spec.joints[j].name} counts from {kind} from "
                    f"{time:.6g} s on; a log of {log.tally.count('rows')} rows is read in chunks, "
                    "which cannot be joined across that; fit its parts, as in "
                    f"{source.name}@:{time:.6g}"
                )


def _is_periodic(model: CompiledModel, j: int) -> bool:
    """Returns True if a turn of a joint changes nothing in the model."""
    joints, signals = len(model.spec.joints), model.spec.signals
    q, qd, qdd = np.random.default_rng(2).uniform(0.2, 1.0, (3, 1, joints))
    read = np.full((1, len(signals)), 0.5) if signals else None
    turned = q + 2.0 * np.pi * np.eye(joints)[j]
    try:
        here, there = (model.base_regressor(x, qd, qdd, read) for x in (q, turned))
    except LoopError:
        return True
    return bool(np.allclose(here, there, rtol=1e-6, atol=1e-6))
