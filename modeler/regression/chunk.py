"""Chunks of a log: rows prepared together, and those beside them that filters need."""

import dataclasses
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import reduce
from itertools import chain

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.numerics.filters import compute_reach
from modeler.regression.log import FINGER, Log, combine_hashes, compute_block_hash
from modeler.regression.motion import ChosenProcessing
from modeler.regression.read import (
    ChannelRanges,
    FileSource,
    Source,
    cut_rows,
    join_logs,
    join_windows,
)
from modeler.regression.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class Chunk:
    """Consecutive rows of a log.

    Attributes:
        number: from 0.
        start: row of the log, from 0, that is the first of its own.
        own: which rows of `log` are its own; every row of the log is one chunk's own.
        log: they, and a margin to both sides.
        last: True if no row comes after it.
    """

    number: int
    start: int
    inner_rows: slice
    log: Log
    last: bool

    @property
    def span(self) -> tuple[float, float]:
        """Returns the times, s, midway between its rows and those beside them; open at a log's end.

        In the middle of two rows, as samples of a uniform grid lie on rows but for rounding.
        """
        time, inner_rows = self.log.time, self.inner_rows
        start = (
            -np.inf
            if self.number == 0
            else float(time[inner_rows.start - 1 : inner_rows.start + 1].mean())
        )
        stop = float(time[inner_rows.stop - 1 : inner_rows.stop + 1].mean())
        return start, np.inf if self.last else stop

    @property
    def rows(self) -> int:
        """Returns the number of the chunk's own rows, margins left out."""
        return self.inner_rows.stop - self.inner_rows.start

    def is_inside(self, time: np.ndarray) -> np.ndarray:
        """Returns (n,) True at the times (n,), s, that are its own."""
        start, stop = self.span
        return np.asarray((time >= start) & (time < stop))

    def find_inside(self, time: np.ndarray) -> slice:
        """Returns which of increasing times (n,), s, are its own."""
        return slice(*np.searchsorted(time, self.span).tolist())

    def is_inner(self, rows: np.ndarray | int) -> np.ndarray:
        """Returns True for the rows of `log` that are its own."""
        return np.asarray((self.inner_rows.start <= rows) & (rows < self.inner_rows.stop))


def wrap_log(log: Log) -> Chunk:
    """Returns a log as its one chunk."""
    return Chunk(0, 0, slice(0, log.rows), log, True)


def compute_margin(processing: ChosenProcessing, step: float) -> int:
    """Returns rows beside a chunk that filters and searches of its own rows reach.

    Zero-phase filtering of a chunk then differs from that of the whole log by what the position
    filter depends after `MEMORY` periods, exp(-12 x 2.4) = 3e-13 of the motion within them.

    Args:
        processing: of the log.
        step: of the log, s.
    """
    position, parallel = processing.position_cutoff, processing.parallel_cutoff
    memory = THRESHOLDS.filter_memory / (position * step) if position > 0.0 else 0.0
    window = 1.0 / (parallel * step) if parallel > 0.0 else 0.0  # in which derivatives are checked
    delay = abs(processing.delay) / step
    edge = (processing.edge or 0.0) / step
    reach = compute_reach(step, parallel)
    return THRESHOLDS.min_margin_rows + int(np.ceil(max(memory, edge) + reach + window + delay))


def read_chunks(source: Source, size: int, margin: int) -> Iterator[Chunk]:
    """Yields all rows of a log as chunks.

    Args:
        source: of the log.
        size: rows of each, but for the last.
        margin: rows of its margins.
    """
    held, first, rows, number = list[Log](), 0, 0, 0  # first: row of the log that held begins with
    for block in chain(source.read_blocks(size), [None]):
        if block is not None:
            held.append(block)
            rows += block.rows
        # behind the last block there is no margin to wait for
        while first + rows > number * size + (size + margin) * (block is not None):
            log = join_logs(held)
            last = block is None and first + rows <= (number + 1) * size
            yield _cut_chunk(log, first, number, size, margin, last)
            number += 1
            dropped_rows = max(0, number * size - margin) - first
            held, first, rows = (
                [cut_rows(log, slice(dropped_rows, None))],
                first + dropped_rows,
                log.rows - dropped_rows,
            )


def read_chunks_between(source: Source, numbers: range, size: int, margin: int) -> Iterator[Chunk]:
    """Yields some of those chunks, of a log that can be read from any row; the same to the bit.

    Args:
        source: whose windows begin at the very row that is requested.
        numbers: of the chunks, from 0, one after the other.
        size: as of `read_chunks`.
        margin: as of `read_chunks`.
    """
    start = max(0, numbers[0] * size - margin)
    stop = min((numbers[-1] + 1) * size + margin, source.rows)
    log = source.read_window((start + 0.5) / source.rows, stop - start)
    for number in numbers:
        yield _cut_chunk(log, start, number, size, margin, source.rows <= (number + 1) * size)


def _cut_chunk(log: Log, first: int, number: int, size: int, margin: int, last: bool) -> Chunk:
    start, stop = number * size, min((number + 1) * size, first + log.rows)
    low, high = max(first, start - margin), min(stop + margin, first + log.rows)
    part = cut_rows(log, slice(low - first, high - first))
    return Chunk(number, start, slice(start - low, stop - low), part, last)


# A piece of a log by time.


def cut_window(
    log: Log, start: float | None, end: float | None, span: tuple[float, float] | None = None
) -> Log:
    """Returns the rows of `log` with start <= time < end, s; None leaves that side open.

    Args:
        log: it, or those rows of it that may be in the window.
        start: s.
        end: s.
        span: first and last time of the whole log; None: of `log`.

    Raises:
        DataError: the window ends before it starts, or no rows are left.
    """
    low = -np.inf if start is None else start
    high = np.inf if end is None else end
    if high <= low:
        raise DataError(
            f"{log.name}: got the window {low:g}:{high:g}, which ends before it starts; expected "
            "START:END in seconds, START first"
        )
    rows = (log.time >= low) & (log.time < high)
    if not rows.any():
        first, last = span or log.span
        raise DataError(
            f"{log.name}: no rows from {low:g} to {high:g} s; its times go from {first:g} to "
            f"{last:g} s"
        )
    sides = ("" if time is None else f"{time:g}" for time in (start, end))
    return dataclasses.replace(cut_rows(log, rows), name=f"{log.name}@{':'.join(sides)}")


def read_part(source: FileSource, spec: ModuleSpec, start: float | None, end: float | None) -> Log:
    """Returns what `cut_window` makes of the whole log. All rows are read.

    A piece has the log's fingerprint.

    Args:
        source: of a log of more than `log.LONG` rows.
        spec: the robot's manifest.
        start: s; None leaves that side open.
        end: the same.

    Raises:
        DataError: the log is damaged, or has no rows there.
    """
    low, high = -np.inf if start is None else start, np.inf if end is None else end

    def there(chunk: Chunk) -> Log | None:
        return chunk.log if chunk.log.time[0] < high and chunk.log.time[-1] >= low else None

    parts, last, span = _read_parts(source, spec, there)
    log = join_logs(parts or [last])
    whole = dataclasses.replace(log, notes=last.notes, content=last.content)
    return cut_window(whole, start, end, span)


SPREAD = 2**20
"""Rows of a log from which on a diagnosis looks at segments of it."""

_ROWS, _PARTS = 2**18, 32  # that are kept of it


def read_spread(source: FileSource, spec: ModuleSpec) -> Log:
    """Returns evenly spread segments of a log of more than `SPREAD` rows, as its segments.

    All rows are read: the fingerprint and what channels hold are those of the whole log.

    Raises:
        DataError: the log is damaged.
    """
    blocks = -(-source.rows // FINGER)
    places = np.unique(np.linspace(0, blocks - 1, min(blocks, _PARTS)).astype(int))
    size = min(FINGER, _ROWS // len(places))

    def there(chunk: Chunk) -> Log | None:
        # copies: of a view all rows would stay
        rows = np.arange(min(size, chunk.rows))
        return cut_rows(chunk.log, rows) if chunk.number in places else None

    parts, last, span = _read_parts(source, spec, there)
    rows, least = sum(log.rows for log in parts), min(log.rows for log in parts)
    note = (
        f"{source.rows} rows; {rows} of them are looked at, in {len(parts)} segments of "
        f"{least * last.step:.3g} s that are spread evenly over {span[1] - span[0]:.6g} s"
    )
    return dataclasses.replace(join_windows(parts), notes=(*last.notes, note), content=last.content)


def _read_parts(
    source: FileSource, spec: ModuleSpec, there: Callable[[Chunk], Log | None]
) -> tuple[list[Log], Log, tuple[float, float]]:
    """Returns the kept parts of a log that is read once, its end with all notes, and its times."""
    parts, hashes, ranges, start = list[Log](), list[bytes](), list[ChannelRanges](), None
    for chunk in read_chunks(source, FINGER, 0):
        log = chunk.log
        hashes.append(compute_block_hash(log.time, log.q, log.tau))
        ranges.append(ChannelRanges.compute_from(log))
        start = log.span[0] if start is None else start
        if (part := there(chunk)) is not None:
            parts.append(part)
    assert start is not None
    seen = reduce(ChannelRanges.merged_with, ranges)
    seen.check_values(source.place[0], spec)
    notes, content = (*log.notes, *seen.collect_warnings(log.step, spec)), combine_hashes(hashes)
    return parts, dataclasses.replace(log, notes=notes, content=content), (start, log.span[1])
