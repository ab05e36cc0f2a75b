"""From a chunk of a long log to filtered rows, with every choice given."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from modeler.numerics.filters import filter_at
from modeler.observation.chunk import Chunk
from modeler.observation.consistency import Consistency, Contradiction, consistency
from modeler.observation.log import FINGER, Log, finger
from modeler.observation.low_speed import IDLE_TRAVEL, TOP, FrictionShaft, moving
from modeler.observation.motion import Segment, segment_of
from modeler.observation.outliers import Defects, Usual, defects
from modeler.observation.prepare import believed, check_size, closed
from modeler.observation.processing import Processing
from modeler.observation.read import Ranges, cut
from modeler.observation.segments import Piece, split
from modeler.observation.stretch import Stretch, stretch
from modeler.observation.tally import Facts, tally

if TYPE_CHECKING:
    from modeler.runtime.model import CompiledModel


@dataclass(frozen=True, eq=False)
class Chosen:
    """What is one choice for all rows of a log; J joints.

    Attributes:
        run: index of the log.
        processing: with cut-offs, speed floors and decimation chosen.
        logged: logged velocities are used.
        usual: what is usual in its channels.
        extremes: (J,) smallest and largest torque known so far.
        shafts: of the robot.
        step: of the log, s.
        own: rows of a chunk.
        beside: rows of its margins.
    """

    run: int
    processing: Processing
    logged: bool
    usual: Usual
    extremes: tuple[tuple[float, float], ...]
    shafts: tuple[FrictionShaft, ...]
    step: float
    own: int
    beside: int


def seen(model: "CompiledModel", chunk: Chunk, chosen: Chosen) -> tuple[tuple[Stretch, ...], Facts]:
    """The rows of a chunk: mended, split, filtered and differentiated as those of a whole log.

    Its stretches have the rows that are its own and no others.

    Raises:
        DataError: a value that cannot be.
    """
    spec, processing = model.spec, chosen.processing
    check_size(chunk.log, spec)
    mended, found, _ = defects(chunk.log, spec, chosen.usual)
    log = chunk.log if processing.keep_damaged else mended
    pieces, _ = split(log, chosen.run, chosen.logged, chosen.extremes)
    pieces, check = _checked(log, pieces, chosen)
    filtered = [segment_of(piece, processing) for piece in pieces]
    left_out = [p for p, segment in zip(pieces, filtered, strict=True) if segment is None]
    both = [closed(model, segment) for segment in filtered if segment is not None]
    segments = [segment for segment, _ in both]
    stretches = tuple(_stretch(segment, chunk, chosen) for segment in segments)
    own = cut(chunk.log, chunk.own)
    return stretches, Facts(
        tally=tally(chunk, pieces, stretches, left_out, check),
        defects=_own_defects(found, chunk),
        contradictions=() if check is None else _within(check.contradictions, chunk),
        ranges=Ranges.of(own),
        fingers=_fingers(own),
        clipped=_clipped(chunk.log, pieces),
        awake=_awake(segments, chosen),
        open_times=_open_times(both, chunk),
        span=(float(own.time[0]), float(own.time[-1])),
    )


def _checked(
    log: Log, pieces: Sequence[Piece], chosen: Chosen
) -> tuple[tuple[Piece, ...], Consistency | None]:
    """The pieces without samples whose logged derivatives cannot be."""
    processing = chosen.processing
    if not chosen.logged:
        return tuple(pieces), None
    assert processing.parallel_cutoff is not None
    check = consistency(log, pieces, processing.parallel_cutoff, refuse=False)
    return (tuple(pieces) if processing.keep_contradicted else believed(pieces, check)), check


def _stretch(segment: Segment, chunk: Chunk, chosen: Chosen) -> Stretch:
    processing = chosen.processing
    assert processing.speed_floors is not None and processing.parallel_cutoff is not None
    usable = segment.valid & moving(segment, chosen.shafts, processing.speed_floors)
    centres = _centres(segment, chunk, chosen)
    rows = filter_at(centres, segment.samples, segment.step, processing.parallel_cutoff)
    return stretch(segment, usable, rows)


def _centres(segment: Segment, chunk: Chunk, chosen: Chosen) -> np.ndarray:
    """Samples on which the chunk's own rows are centred.

    A segment that begins and ends in the chunk has them where it would have them in a whole log.
    One that goes on beside it has them at every d-th row of the log, counted from its start, so
    that two chunks agree.
    """
    every = chosen.processing.decimation
    assert every is not None
    inside = np.flatnonzero(segment.whole)
    if not inside.size:
        return inside
    log = chunk.log
    begins = chunk.number == 0 and chunk.own.start == 0
    open_before = segment.time[0] <= log.time[0] and not begins
    open_behind = segment.time[-1] >= log.time[-1] and not chunk.last
    if open_before or open_behind:
        first = (every - 1) // 2 - (chunk.start - chunk.own.start)  # row of the chunk's log
        anchor = float(log.time[first % every]) if log.rows > every else float(log.time[0])
        phase = round((anchor - segment.time[0]) / segment.step) - int(inside[0])
        centres = inside[phase % every :: every]
    else:
        centres = inside[(len(inside) - 1) % every // 2 :: every]
    start, stop = chunk.span
    time = segment.time[centres]
    return np.asarray(centres[(time >= start) & (time < stop)])


def _own_defects(found: Defects, chunk: Chunk) -> Defects:
    own = chunk.own
    return {
        name: [[one for one in some if own.start <= one.start < own.stop] for some in by_joint]
        for name, by_joint in found.items()
    }


def _within(found: Sequence[Contradiction], chunk: Chunk) -> tuple[Contradiction, ...]:
    start, stop = chunk.span
    return tuple(one for one in found if start <= one.time < stop)


def _fingers(own: Log) -> tuple[bytes, ...]:
    places = range(0, own.rows, FINGER)
    return tuple(
        finger(*(values[k : k + FINGER] for values in (own.time, own.q, own.tau))) for k in places
    )


def _clipped(log: Log, pieces: Sequence[Piece]) -> np.ndarray:
    """(2, J) the ends of each torque's range that were taken for a limit; NaN of the others."""
    found = np.full((2, log.tau.shape[1]), np.nan)
    if not pieces or not any(piece.clipped.any() for piece in pieces):
        return found
    low, high = np.fmin.reduce(log.tau, axis=0), np.fmax.reduce(log.tau, axis=0)
    for row, end in enumerate((low, high)):
        at = [np.any(piece.clipped & (piece.tau == end), axis=0) for piece in pieces]
        found[row] = np.where(np.any(at, axis=0), end, np.nan)
    return found


def _open_times(both: Sequence[tuple[Segment, np.ndarray]], chunk: Chunk) -> tuple[float, ...]:
    """s, of its own samples with which the loops cannot be closed."""
    start, stop = chunk.span
    times = [segment.time[open_ & segment.whole] for segment, open_ in both if open_.any()]
    return tuple(float(t) for own in times for t in own if start <= t < stop)


def _awake(segments: Sequence[Segment], chosen: Chosen) -> dict[str, float]:
    """Top speeds of the shafts that move, and were taken to stand still."""
    floors = chosen.processing.speed_floors or {}
    moves: dict[str, float] = {}
    for part in chosen.shafts:
        if floors[part.name] < float("inf"):
            continue
        for s in segments:
            if not s.whole.any():
                continue
            if np.ptp(part.speed(s.q[s.whole])) >= IDLE_TRAVEL[part.unit]:
                top = float(np.quantile(np.abs(part.speed(s.qd[s.whole])), TOP))
                moves[part.name] = max(moves.get(part.name, 0.0), top)
    return moves
