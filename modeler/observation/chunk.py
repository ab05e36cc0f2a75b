"""Chunks of a log: rows prepared together, and those beside them that filters need."""

import dataclasses
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import reduce
from itertools import chain

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.numerics.filters import reach_of
from modeler.observation.log import FINGER, Log, finger, fingerprint_of
from modeler.observation.read import FileSource, Ranges, Source, cut, joined, windows_joined
from modeler.observation.settings import ChosenProcessing

MEMORY = 12.0
"""Periods of the position filter after which nothing of it is left: its slowest poles fade as
exp(-2.4 t cutoff), to 3e-13."""

_BESIDE = 64  # rows, at least: what looks for damage sees 30 to both sides, and judges not the ends


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
    own: slice
    log: Log
    last: bool

    @property
    def span(self) -> tuple[float, float]:
        """s, between its own rows and those beside them; open at the log's ends.

        In the middle of two rows, as samples of a uniform grid lie on rows but for rounding.
        """
        time, own = self.log.time, self.own
        start = -np.inf if self.number == 0 else float(time[own.start - 1 : own.start + 1].mean())
        return start, np.inf if self.last else float(time[own.stop - 1 : own.stop + 1].mean())

    @property
    def rows(self) -> int:
        """Of its own."""
        return self.own.stop - self.own.start

    def holds(self, time: np.ndarray) -> np.ndarray:
        """(n,) True at the times (n,), s, that are its own."""
        start, stop = self.span
        return np.asarray((time >= start) & (time < stop))

    def has(self, rows: np.ndarray | int) -> np.ndarray:
        """True for the rows of `log` that are its own."""
        return np.asarray((self.own.start <= rows) & (rows < self.own.stop))


def whole_log(log: Log) -> Chunk:
    """A log as its one chunk."""
    return Chunk(0, 0, slice(0, log.rows), log, True)


def margin(processing: ChosenProcessing, step: float) -> int:
    """Rows beside a chunk that filters and searches of its own rows reach.

    Zero-phase filtering of a chunk then differs from that of the whole log by what the position
    filter remembers after `MEMORY` periods, exp(-12 x 2.4) = 3e-13 of the motion within them.

    Args:
        processing: of the log.
        step: of the log, s.
    """
    position, parallel = processing.position_cutoff, processing.parallel_cutoff
    memory = MEMORY / (position * step) if position > 0.0 else 0.0
    window = 1.0 / (parallel * step) if parallel > 0.0 else 0.0  # in which derivatives are checked
    delay = abs(processing.delay) / step
    edge = (processing.edge or 0.0) / step
    reach = reach_of(step, parallel)
    return _BESIDE + int(np.ceil(max(memory, edge) + reach + window + delay))


def chunks(source: Source, own: int, beside: int) -> Iterator[Chunk]:
    """All rows of a log as chunks.

    Args:
        source: of the log.
        own: rows of each, but for the last.
        beside: rows of its margins.
    """
    held, first, rows, number = list[Log](), 0, 0, 0  # first: row of the log that held begins with
    for block in chain(source.blocks(own), [None]):
        if block is not None:
            held.append(block)
            rows += block.rows
        # behind the last block there is no margin to wait for
        while first + rows > number * own + (own + beside if block is not None else 0):
            log = joined(held)
            last = block is None and first + rows <= (number + 1) * own
            yield _chunk(log, first, number, own, beside, last)
            number += 1
            kept = max(0, number * own - beside) - first
            held, first, rows = [cut(log, slice(kept, None))], first + kept, log.rows - kept


def chunks_between(source: Source, numbers: range, own: int, beside: int) -> Iterator[Chunk]:
    """Some of those chunks, of a log whose rows can be read from anywhere; the same to the bit.

    Args:
        source: whose windows begin at the very row that is asked for.
        numbers: of the chunks, from 0, one after the other.
        own: as of `chunks`.
        beside: as of `chunks`.
    """
    start = max(0, numbers[0] * own - beside)
    stop = min((numbers[-1] + 1) * own + beside, source.rows)
    log = source.window((start + 0.5) / source.rows, stop - start)
    for number in numbers:
        yield _chunk(log, start, number, own, beside, source.rows <= (number + 1) * own)


def _chunk(log: Log, first: int, number: int, own: int, beside: int, last: bool) -> Chunk:
    start, stop = number * own, min((number + 1) * own, first + log.rows)
    low, high = max(first, start - beside), min(stop + beside, first + log.rows)
    part = cut(log, slice(low - first, high - first))
    return Chunk(number, start, slice(start - low, stop - low), part, last)


# A piece of a log by time.


def window(
    log: Log, start: float | None, end: float | None, span: tuple[float, float] | None = None
) -> Log:
    """The rows of `log` with start <= time < end, s; None leaves that side open.

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
    return dataclasses.replace(cut(log, rows), name=f"{log.name}@{':'.join(sides)}")


def read_part(source: FileSource, spec: ModuleSpec, start: float | None, end: float | None) -> Log:
    """What `window` makes of the whole log. All rows are read: a piece has the log's fingerprint.

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

    kept, last, span = _passed(source, spec, there)
    log = joined(kept or [last])
    whole = dataclasses.replace(log, notes=last.notes, content=last.content)
    return window(whole, start, end, span)


SPREAD = 2**20
"""Rows of a log from which on a diagnosis looks at stretches of it."""

_ROWS, _PARTS = 2**18, 32  # that are kept of it


def read_spread(source: FileSource, spec: ModuleSpec) -> Log:
    """Evenly spread stretches of a log of more than `SPREAD` rows, as its segments.

    All rows are read: the fingerprint and what channels hold are those of the whole log.

    Raises:
        DataError: the log is damaged.
    """
    blocks = -(-source.rows // FINGER)
    places = np.unique(np.linspace(0, blocks - 1, min(blocks, _PARTS)).astype(int))
    size = min(FINGER, _ROWS // len(places))

    def there(chunk: Chunk) -> Log | None:
        # copies: of a view all rows would stay
        return cut(chunk.log, np.arange(min(size, chunk.rows))) if chunk.number in places else None

    kept, last, span = _passed(source, spec, there)
    rows, least = sum(log.rows for log in kept), min(log.rows for log in kept)
    note = (
        f"{source.rows} rows; {rows} of them are looked at, in {len(kept)} stretches of "
        f"{least * last.step:.3g} s that are spread evenly over {span[1] - span[0]:.6g} s"
    )
    return dataclasses.replace(
        windows_joined(kept), notes=(*last.notes, note), content=last.content
    )


def _passed(
    source: FileSource, spec: ModuleSpec, there: Callable[[Chunk], Log | None]
) -> tuple[list[Log], Log, tuple[float, float]]:
    """What is kept of a log that is read once; its end, with what all rows tell; its times."""
    kept, fingers, ranges, start = list[Log](), list[bytes](), list[Ranges](), None
    for chunk in chunks(source, FINGER, 0):
        log = chunk.log
        fingers.append(finger(log.time, log.q, log.tau))
        ranges.append(Ranges.of(log))
        start = log.span[0] if start is None else start
        if (part := there(chunk)) is not None:
            kept.append(part)
    assert start is not None
    seen = reduce(Ranges.merged_with, ranges)
    seen.check(source.place[0], spec)
    notes, content = (*log.notes, *seen.doubts(log.step, spec)), fingerprint_of(fingers)
    return kept, dataclasses.replace(log, notes=notes, content=content), (start, log.span[1])
