"""The fit of long logs, which never has all rows in memory."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import reduce
from pathlib import Path
from typing import TypeGuard

from modeler import observation
from modeler.api.fitting import FitOutcome, FitRequest, identified, judged
from modeler.api.log_maps import Mapped
from modeler.api.model import Model
from modeler.api.steps import Steps, silent
from modeler.api.workflow import (
    AnyLog,
    are_long as are_long,
    check_fits_memory as check_fits_memory,
    sources_of as sources_of,
    too_long as too_long,
)
from modeler.codegen import Derivation
from modeler.core.errors import DataError, Method
from modeler.core.jobs import Workers
from modeler.core.manifest import Emitted
from modeler.estimation import OF_TRIANGLES, FitResult, long_logs as chunked
from modeler.logs import LogMap
from modeler.runtime import CompiledModel, compiled_once


@dataclass(frozen=True)
class Telling:
    """What a fit tells while it runs, and who does the work.

    Attributes:
        steps: is called with the title of each step, which lasts as long as the context.
        bar: the same, for a step whose share can be told.
        note: is told what is done otherwise than asked.
        cluster: gives workers for long logs; None: threads of this process.
    """

    steps: Steps = silent
    bar: Callable[[str], AbstractContextManager[Callable[[float], None]]] = lambda title: (
        nullcontext(lambda share: None)
    )
    note: Callable[[str], None] = lambda line: None
    cluster: AbstractContextManager[Workers] | None = None


def fit_long(
    derivation: Derivation,
    emitted: Emitted,
    compiled: CompiledModel,
    sources: Sequence[observation.Source],
    method: Method = "weighted",
    processing: observation.Processing | None = None,
    progress: Callable[[float], None] = lambda share: None,
    reducer: chunked.Reducer | None = None,
) -> tuple[Model, chunked.Streamed]:
    """The fitted model of logs of any length, in flat memory; see `estimation.long_logs.stream`.

    Args:
        derivation: of the robot.
        emitted: its C.
        compiled: that, callable.
        sources: of the logs.
        method: "weighted" or "ordinary".
        processing: None: automatic.
        progress: is told the share of the rows that are done.
        reducer: of one log; None: threads of this process. See `api.spread`.

    Raises:
        DataError: see `stream` and `identify_long`.
    """
    streamed = chunked.stream(compiled, sources, processing, progress, reducer=reducer)
    observation.check_apart(streamed.observation.report.logs)
    result = judged_long(compiled, streamed, method)
    return identified(derivation, emitted, streamed.observation, result), streamed


def fit_if_long(
    asked: FitRequest,
    derivation: Derivation,
    emitted: Emitted,
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    loaded: Sequence[AnyLog],
    processing: observation.Processing,
    mapping: Mapped,
    told: Telling,
) -> tuple[Model, observation.Observation] | None:
    """The model of long logs, read in chunks; None where all rows are to be in memory.

    Raises:
        DataError: they are more rows than a way to fit that needs all of them may have.
    """
    every = [*logs, *loaded]
    if told.cluster is None and not are_long(every):
        return None
    if loaded or asked != FitRequest(asked.method) or asked.method not in OF_TRIANGLES:
        what = f"method {asked.method}" if asked.below is None else "--essential-below"
        check_fits_memory(every, what)
        return None
    try:
        with told.bar("reading and reducing") as bar, told.cluster or nullcontext() as workers:
            sources = sources_of(compiled, logs, mapping)
            reducer = None if workers is None else by_workers(workers, emitted)
            here = [each.name for each in sources if not from_anywhere(each)]
            if workers is not None and here:
                told.note(
                    f"--dask: {', '.join(here)}: read and reduced by this process; workers can "
                    "begin in the middle of Parquet files only"
                )
            model, streamed = fit_long(
                derivation, emitted, compiled, sources, asked.method, processing, bar, reducer
            )
    except observation.WholeLogNeeded as error:
        if too_long(every):
            raise
        told.note(f"{error}; read as a whole instead")
        return None
    return model, streamed.observation


def judged_long(compiled: CompiledModel, streamed: chunked.Streamed, method: Method) -> FitResult:
    """The fit of long logs with its verdict."""
    way = FitOutcome(chunked.identify_long(streamed, method, compiled))
    return judged(compiled, streamed.observation, way, streamed.data)


# The chunks of long logs, reduced by workers: other processes, or other machines.


_CHUNKS = 2  # of a job: row groups are longer than chunks, and each job decodes whole pages
_JOBS = 16  # merged where they are, before the result travels


@dataclass(frozen=True, eq=False)
class Shared:
    """What all jobs of a log share."""

    emitted: Emitted
    path: Path
    mapping: LogMap | None
    chosen: observation.LogChoices
    rows: int


def by_workers(workers: Workers, emitted: Emitted) -> chunked.Reducer:
    """A reducer of logs by workers, who read their rows of a Parquet file themselves.

    Logs of other formats are read from the beginning to the end: by this process. All logs are
    begun at once. Triangles of neighbours are merged in pairs; results differ from those of
    threads by the rounding of another order, about 1e-15.

    Args:
        workers: who see the files by the same paths.
        emitted: the C of the robot, which they compile, or take from their caches.
    """

    def reducer(
        model: CompiledModel, source: observation.Source, chosen: observation.LogChoices
    ) -> Iterator[chunked.Partial]:
        if not from_anywhere(source):
            return chunked.by_threads(model, source, chosen)
        path, mapping = source.place
        code = replace(emitted, files=emitted.code)
        shared = Shared(code, path.absolute(), mapping, chosen, source.rows)
        count = -(-source.rows // chosen.own)
        jobs = [range(k, min(k + _CHUNKS, count)) for k in range(0, count, _CHUNKS)]
        begun = [
            workers.begun(reduce_rows, shared, jobs[k : k + _JOBS], merged_in_time)
            for k in range(0, len(jobs), _JOBS)
        ]
        return _in_order(begun)

    return reducer


def from_anywhere(source: observation.Source) -> TypeGuard[observation.FileSource]:
    """True of a log whose rows a worker can read by itself, from the middle of its file."""
    return isinstance(source, observation.FileSource) and source.exact


def reduce_rows(shared: Shared, numbers: range) -> chunked.Partial:
    """Some chunks of a log, read and reduced by a worker.

    Raises:
        DataError: the worker does not see the file, or sees another.
    """
    model, chosen = compiled_once(shared.emitted), shared.chosen
    source = observation.source_of(shared.path, model.spec, shared.mapping)
    if source is None or source.rows != shared.rows:
        got = "none" if source is None else f"one of {source.rows} rows"
        raise DataError(
            f"{shared.path}: a worker sees {got}, expected a file of {shared.rows} rows; workers "
            "must see the logs by the same paths"
        )
    parts = observation.chunks_between(source, numbers, chosen.own, chosen.beside)
    made = (chunked.reduce_chunk(model, part, chosen) for part in parts)
    return reduce(chunked.Partial.merged_with, made)


def merged_in_time(first: chunked.Partial, later: chunked.Partial) -> chunked.Partial:
    """Of rows of a log, and of those that follow them.

    Raises:
        DataError: time does not increase from the ones to the others.
    """
    before, after = first.facts.span[1], later.facts.span[0]
    if after <= before:
        raise DataError(
            f"{after:.9g} s after {before:.9g} s; expected increasing time; sort and split the "
            "file where the clock restarts"
        )
    return first.merged_with(later)


def _in_order(begun: Sequence[Callable[[], chunked.Partial]]) -> Iterator[chunked.Partial]:
    """The results, one after the other, checked as those within each."""
    last: chunked.Partial | None = None
    for wait in begun:
        found = wait()
        if last is not None:
            merged_in_time(last, found)
        last = found
        yield found
