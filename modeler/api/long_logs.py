"""The fit of long logs, which never has all rows in memory."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import reduce
from pathlib import Path
from typing import TypeGuard

from modeler import regression
from modeler.api.fitting import FitOutcome, FitRequest, add_verdict, assemble_model
from modeler.api.log_maps import Mapped
from modeler.api.model import Model
from modeler.api.steps import Steps, ignore_step
from modeler.api.workflow import (
    AnyLog,
    are_long as are_long,
    are_too_long as are_too_long,
    check_fits_memory as check_fits_memory,
    open_sources as open_sources,
)
from modeler.codegen import Derivation
from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.jobs import Workers
from modeler.core.manifest import EmittedModule
from modeler.estimation import OF_TRIANGLES, FitResult, long_logs as chunked
from modeler.logs import LogMap
from modeler.runtime import CompiledModel, load_cached_model

Progress = Callable[[str], AbstractContextManager[Callable[[float], None]]]
"""Opens a step of this title whose share of done work can be reported."""


@dataclass(frozen=True)
class Reporter:
    """What a fit tells while it runs, and who does the work.

    Attributes:
        steps: is called with the title of each step, which lasts as long as the context.
        bar: the same, for a step whose share can be told.
        note: is told what is done otherwise than asked.
        cluster: gives workers for long logs; None: threads of this process.
    """

    report_step: Steps = ignore_step
    show_progress: Progress = lambda title: nullcontext(lambda share: None)
    print_note: Callable[[str], None] = lambda line: None
    cluster: AbstractContextManager[Workers] | None = None


def fit_long(
    derivation: Derivation,
    emitted: EmittedModule,
    compiled: CompiledModel,
    sources: Sequence[regression.Source],
    method: Method = "weighted",
    processing: regression.Processing | None = None,
    progress: Callable[[float], None] = lambda share: None,
    reducer: chunked.Reducer | None = None,
) -> tuple[Model, chunked.StreamedLogs]:
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
    streamed = chunked.stream_logs(compiled, sources, processing, progress, reducer=reducer)
    regression.check_no_overlap(streamed.observation.report.logs)
    result = add_long_verdict(compiled, streamed, method)
    return assemble_model(derivation, emitted, streamed.observation, result), streamed


def fit_if_long(
    request: FitRequest,
    derivation: Derivation,
    emitted: EmittedModule,
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    loaded: Sequence[AnyLog],
    processing: regression.Processing,
    mapping: Mapped,
    reporter: Reporter,
) -> tuple[Model, regression.Observation] | None:
    """The model of long logs, read in chunks; None where all rows are to be in memory.

    Raises:
        DataError: they are more rows than a way to fit that needs all of them may have.
    """
    every = [*logs, *loaded]
    if reporter.cluster is None and not are_long(every):
        return None
    if loaded or request != FitRequest(request.method) or request.method not in OF_TRIANGLES:
        what = f"method {request.method}" if request.below is None else "--essential-below"
        check_fits_memory(every, what)
        return None
    try:
        with (
            reporter.show_progress("reading and reducing") as bar,
            reporter.cluster or nullcontext() as workers,
        ):
            sources = open_sources(compiled, logs, mapping)
            reducer = None if workers is None else make_worker_reducer(workers, emitted)
            here = [each.name for each in sources if not can_read_from_middle(each)]
            if workers is not None and here:
                reporter.print_note(
                    f"--dask: {', '.join(here)}: read and reduced by this process; workers can "
                    "begin in the middle of Parquet files only"
                )
            model, streamed = fit_long(
                derivation, emitted, compiled, sources, request.method, processing, bar, reducer
            )
    except regression.WholeLogNeeded as error:
        if are_too_long(every):
            raise
        reporter.print_note(f"{error}; read as a whole instead")
        return None
    return model, streamed.observation


def add_long_verdict(
    compiled: CompiledModel, streamed: chunked.StreamedLogs, method: Method
) -> FitResult:
    """The fit of long logs with its verdict."""
    outcome = FitOutcome(chunked.identify_long(streamed, method, compiled))
    return add_verdict(compiled, streamed.observation, outcome, streamed.data)


# The chunks of long logs, reduced by workers: other processes, or other machines.


_CHUNKS = 2  # of a job: row groups are longer than chunks, and each job decodes whole pages
_JOBS = 16  # merged where they are, before the result travels


@dataclass(frozen=True, eq=False)
class ChunkJobContext:
    """What all jobs of a log share."""

    emitted: EmittedModule
    path: Path
    mapping: LogMap | None
    chosen: regression.LogChoices
    rows: int


def make_worker_reducer(workers: Workers, emitted: EmittedModule) -> chunked.Reducer:
    """A reducer of logs by workers, who read their rows of a Parquet file themselves.

    Logs of other formats are read from the beginning to the end: by this process. All logs are
    begun at once. Triangles of neighbours are merged in pairs; results differ from those of
    threads by the rounding of another order, about 1e-15.

    Args:
        workers: who see the files by the same paths.
        emitted: the C of the robot, which they compile, or take from their caches.
    """

    def reduce_with_workers(
        model: CompiledModel, source: regression.Source, chosen: regression.LogChoices
    ) -> Iterator[chunked.PartialFit]:
        if not can_read_from_middle(source):
            return chunked.reduce_by_threads(model, source, chosen)
        path, mapping = source.place
        code = replace(emitted, files=emitted.code)
        shared = ChunkJobContext(code, path.absolute(), mapping, chosen, source.rows)
        count = -(-source.rows // chosen.chunk_rows)
        jobs = [range(k, min(k + _CHUNKS, count)) for k in range(0, count, _CHUNKS)]
        pending = [
            workers.start_merge(reduce_rows, shared, jobs[k : k + _JOBS], merge_in_time)
            for k in range(0, len(jobs), _JOBS)
        ]
        return _yield_in_order(pending)

    return reduce_with_workers


def can_read_from_middle(source: regression.Source) -> TypeGuard[regression.FileSource]:
    """True of a log whose rows a worker can read by itself, from the middle of its file."""
    return isinstance(source, regression.FileSource) and source.exact


def reduce_rows(shared: ChunkJobContext, numbers: range) -> chunked.PartialFit:
    """Some chunks of a log, read and reduced by a worker.

    Raises:
        DataError: the worker does not see the file, or sees another.
    """
    model, chosen = load_cached_model(shared.emitted), shared.chosen
    source = regression.open_source(shared.path, model.spec, shared.mapping)
    if source is None or source.rows != shared.rows:
        got = "none" if source is None else f"one of {source.rows} rows"
        raise DataError(
            f"{shared.path}: a worker sees {got}, expected a file of {shared.rows} rows; workers "
            "must see the logs by the same paths"
        )
    parts = regression.read_chunks_between(source, numbers, chosen.chunk_rows, chosen.margin_rows)
    partials = (chunked.reduce_chunk(model, part, chosen) for part in parts)
    return reduce(chunked.PartialFit.merged_with, partials)


def merge_in_time(first: chunked.PartialFit, later: chunked.PartialFit) -> chunked.PartialFit:
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


def _yield_in_order(
    pending: Sequence[Callable[[], chunked.PartialFit]],
) -> Iterator[chunked.PartialFit]:
    """The results, one after the other, checked as those within each."""
    last: chunked.PartialFit | None = None
    for wait in pending:
        partial = wait()
        if last is not None:
            merge_in_time(last, partial)
        last = partial
        yield partial
