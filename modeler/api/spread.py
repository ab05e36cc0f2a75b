"""The chunks of long logs, reduced by workers: other processes, or other machines."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeGuard

from modeler.compiled import CompiledModel
from modeler.compiled.once import compiled_once
from modeler.core.contract import Emitted
from modeler.core.errors import DataError
from modeler.fit.streamed import Partial, Reducer, by_threads, merge_all, reduce_chunk
from modeler.jobs import Workers
from modeler.logs import LogMap
from modeler.observation.chunk import chunks_between
from modeler.observation.seen import Chosen
from modeler.observation.source import FileSource, Source, source_of

_CHUNKS = 2  # of a job: row groups are longer than chunks, and each job decodes whole pages
_JOBS = 16  # merged where they are, before the result travels


@dataclass(frozen=True, eq=False)
class Shared:
    """What all jobs of a log share."""

    emitted: Emitted
    path: Path
    mapping: LogMap | None
    chosen: Chosen
    rows: int


def by_workers(workers: Workers, emitted: Emitted) -> Reducer:
    """A reducer of logs by workers, who read their rows of a Parquet file themselves.

    Logs of other formats are read from the beginning to the end: by this process. All logs are
    begun at once. Triangles of neighbours are merged in pairs; results differ from those of
    threads by the rounding of another order, about 1e-15.

    Args:
        workers: who see the files by the same paths.
        emitted: the C of the robot, which they compile, or take from their caches.
    """

    def reducer(model: CompiledModel, source: Source, chosen: Chosen) -> Iterator[Partial]:
        if not from_anywhere(source):
            return by_threads(model, source, chosen)
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


def from_anywhere(source: Source) -> TypeGuard[FileSource]:
    """True of a log whose rows a worker can read by itself, from the middle of its file."""
    return isinstance(source, FileSource) and source.exact


def reduce_rows(shared: Shared, numbers: range) -> Partial:
    """Some chunks of a log, read and reduced by a worker.

    Raises:
        DataError: the worker does not see the file, or sees another.
    """
    model, chosen = compiled_once(shared.emitted), shared.chosen
    source = source_of(shared.path, model.spec, shared.mapping)
    if source is None or source.rows != shared.rows:
        got = "none" if source is None else f"one of {source.rows} rows"
        raise DataError(
            f"{shared.path}: a worker sees {got}, expected a file of {shared.rows} rows; workers "
            "must see the logs by the same paths"
        )
    parts = chunks_between(source, numbers, chosen.own, chosen.beside)
    return merge_all(reduce_chunk(model, part, chosen) for part in parts)


def merged_in_time(first: Partial, later: Partial) -> Partial:
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
    return first.over(later)


def _in_order(begun: Sequence[Callable[[], Partial]]) -> Iterator[Partial]:
    """The results, one after the other, checked as those within each."""
    last: Partial | None = None
    for wait in begun:
        found = wait()
        if last is not None:
            merged_in_time(last, found)
        last = found
        yield found
