"""The chunks of long logs, reduced by workers: other processes, or other machines."""

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from pathlib import Path
from typing import TypeGuard

from modeler import regression
from modeler.api.thresholds import THRESHOLDS
from modeler.core.errors import DataError
from modeler.core.jobs import Workers
from modeler.core.manifest import EmittedModule
from modeler.estimation import long_logs as chunked
from modeler.logs import LogMap
from modeler.runtime import CompiledModel, load_cached_model


@dataclasses.dataclass(frozen=True, eq=False)
class ChunkJobContext:
    """What all jobs of a log share."""

    emitted: EmittedModule
    path: Path
    mapping: LogMap | None
    chosen: regression.LogChoices
    rows: int


def make_worker_reducer(workers: Workers, emitted: EmittedModule) -> chunked.Reducer:
    """Makes a reducer of logs whose workers read their rows of a Parquet file themselves.

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
        code = dataclasses.replace(emitted, files=emitted.code)
        shared = ChunkJobContext(code, path.absolute(), mapping, chosen, source.rows)
        count = -(-source.rows // chosen.chunk_rows)
        jobs = [
            range(k, min(k + THRESHOLDS.chunks_per_job, count))
            for k in range(0, count, THRESHOLDS.chunks_per_job)
        ]
        pending = [
            workers.start_merge(
                reduce_rows, shared, jobs[k : k + THRESHOLDS.jobs_per_merge], merge_in_time
            )
            for k in range(0, len(jobs), THRESHOLDS.jobs_per_merge)
        ]
        return _yield_in_order(pending)

    return reduce_with_workers


def can_read_from_middle(source: regression.Source) -> TypeGuard[regression.FileSource]:
    """Returns True if a worker can read rows from the middle of the file."""
    return isinstance(source, regression.FileSource) and source.exact


def reduce_rows(shared: ChunkJobContext, numbers: range) -> chunked.PartialFit:
    """Reads and reduces some chunks of a log, in a worker.

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
    """Merges the reduction of rows with that of the rows that follow.

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
