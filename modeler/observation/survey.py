"""Long logs: a look at windows, by which all is chosen; what chunks make of it; their report."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.numerics.filters import spacing
from modeler.observation.chunk import Chunk, margin
from modeler.observation.consistency import consistency
from modeler.observation.log import FINGER, LONG, Log, fingerprint, fingerprint_of, fingers
from modeler.observation.low_speed import REST_TRAVEL, FrictionShaft, at_rest, shafts, top_speeds
from modeler.observation.motion import Segment, segment_of
from modeler.observation.observation import Observation, observed
from modeler.observation.observe import lowered
from modeler.observation.outliers import ChannelScales, confirmed, defects, repairs_named
from modeler.observation.prepare import PreparedLog, believed, check_size, closed, prepare
from modeler.observation.read import Ranges, Source, cut, joined, windows_joined
from modeler.observation.repairs import with_repairs
from modeler.observation.report import DataReport, LogReport
from modeler.observation.segments import Piece, split
from modeler.observation.settings import ChosenProcessing, Processing
from modeler.observation.spikes import Defect
from modeler.observation.stretch import Stretch, row_centres, stretch
from modeler.observation.tally import Facts, joint_reports, log_report, tally
from modeler.runtime import CompiledModel

WINDOWS = 8
"""Windows of all logs together, at least one of each log."""

MOST_WINDOWS = 64
"""Logs that are looked at; of more, every so many."""

WINDOW = 16_384
"""Rows of a window, at least ..."""

SECONDS = 8.0
"""... and seconds, so that a fast logger shows a motion too ..."""

LONGEST = 65_536
"""... but no more rows than these."""

UNIT = 100.0
"""Ratio of time steps of two motions in a log that another unit of time makes: it is 1000 or so."""

_PLACES = (0.5, 0.25, 0.75, 0.1, 0.9, 0.4, 0.6)  # of a window in its part of a log
_TRAVEL = 1e-3  # rad or m: less is rest

Extremes = tuple[tuple[float, float], ...]


class WholeLogNeeded(DataError):
    """Only a log that is in memory as a whole can be fitted."""


@dataclass(frozen=True, eq=False)
class LogChoices:
    """What is one choice for all rows of a log; J joints.

    Attributes:
        run: index of the log.
        name: of the log.
        processing: of all logs.
        decimation: samples per row.
        logged: logged velocities are used.
        usual: what is usual in its channels.
        extremes: (J,) smallest and largest torque known so far.
        shafts: of the robot.
        step: of the log, s.
        own: rows of a chunk: a multiple of those of a fingerprint.
        beside: rows of its margins.
    """

    run: int
    name: str
    processing: ChosenProcessing
    decimation: int
    logged: bool
    usual: ChannelScales
    extremes: Extremes
    shafts: tuple[FrictionShaft, ...]
    step: float
    own: int
    beside: int


@dataclass(frozen=True, eq=False)
class Survey:
    """What the windows show.

    Attributes:
        observation: of the windows, for all that needs rows side by side.
        logs: what else was seen in the windows of each; of another where it has none.
        chosen: by log.
        windows: how many.
        rows: of them.
    """

    observation: Observation
    logs: tuple[PreparedLog, ...]
    chosen: tuple[LogChoices, ...]
    windows: int
    rows: int


@dataclass(frozen=True, eq=False)
class FactsSoFar:
    """What an earlier pass over the logs found, that the windows did not show.

    Attributes:
        floors: speed floors, by shaft that stood still in the windows.
        extremes: (J,) smallest and largest torque by log; none before the first pass.
    """

    floors: Mapping[str, float] = dataclasses.field(default_factory=dict)
    extremes: Mapping[int, Extremes] = dataclasses.field(default_factory=dict)


def survey(
    model: CompiledModel,
    sources: Sequence[Source],
    processing: Processing,
    known: FactsSoFar,
    rows: int = FINGER,
) -> Survey:
    """Looks at windows of the logs and chooses.

    Args:
        model: the compiled robot.
        sources: of the logs.
        processing: what is given is kept.
        known: of an earlier pass.
        rows: of a chunk, at least.

    Raises:
        DataError: a log is damaged.
        WholeNeeded: `observe` refuses the windows.
    """
    windows = [_windows(source, _count(sources, k)) for k, source in enumerate(sources)]
    looked = [k for k, own in enumerate(windows) if own]
    logs = [windows_joined(own) if own else None for own in windows]
    seen = [log for log in logs if log is not None]
    try:
        processing = with_repairs(model, seen, processing)
        prepared = prepare(model.spec, seen, processing)
        observation = observed(model, seen, lowered(model, prepared, processing))
    except (DataError, LoopError) as error:  # what is wrong here may be right elsewhere
        where = f"the {sum(len(own) for own in windows)} windows"
        raise WholeLogNeeded(f"{error}; found in {where} by which long logs are judged") from None
    chosen, parts = observation.report.processing, shafts(model)
    chosen = dataclasses.replace(chosen, speed_floors={**chosen.speed_floors, **known.floors})
    places = tuple(looked.index(k) if k in looked else 0 for k in range(len(sources)))
    every = []
    for k, (source, at) in enumerate(zip(sources, places, strict=True)):
        log = logs[k] or source.window(0.5, WINDOW)
        if log.rows < 2:
            raise DataError(
                f"{log.name}: {log.rows} rows where it was looked at; expected a motion; leave it "
                "out"
            )
        ranges, beside = Ranges.of(log), margin(chosen, log.step)
        fresh = [piece.step for piece in prepared.logs[at].pieces if k in looked]
        every.append(
            LogChoices(
                run=k,
                name=source.name,
                processing=chosen,
                decimation=spacing(
                    (*fresh, log.step)[0], chosen.parallel_cutoff, chosen.decimation
                ),
                logged=prepared.logs[at].check is not None,
                usual=prepared.logs[at].usual,
                extremes=known.extremes.get(k) or ranges.torques,
                shafts=parts,
                step=log.step,
                own=rows * max(1, -(-4 * beside // rows)),  # most of what is read
                beside=beside,
            )
        )
    count, rows_seen = sum(len(own) for own in windows), sum(log.rows for log in seen)
    told = tuple(dataclasses.replace(prepared.logs[at], pieces=()) for at in places)  # memory
    return Survey(observation, told, tuple(every), count, rows_seen)


def _count(sources: Sequence[Source], k: int) -> int:
    """Windows of a log."""
    if len(sources) > MOST_WINDOWS:
        return int(k % -(-len(sources) // MOST_WINDOWS) == 0)
    total = sum(source.rows for source in sources)
    return max(1, round(WINDOWS * sources[k].rows / max(1, total)))


def _windows(source: Source, count: int) -> list[Log]:
    """Windows of a log, increasing in time."""
    if not count:
        return []
    first = source.window(0.5 / count, WINDOW)
    size = int(np.clip(round(SECONDS / first.step), WINDOW, LONGEST)) if first.rows > 1 else WINDOW
    if count * size > 0.7 * source.rows:
        return [source.window(0.0, max(size, min(source.rows, count * size)))]
    found: list[Log] = []
    for k in range(count):
        log = _moving(source, (k / count, (k + 1) / count), size)
        if not found or log.time[0] > found[-1].time[-1]:
            found.append(log)
    _check_unit(found)
    return found


def _check_unit(windows: Sequence[Log]) -> None:
    """Refuse a log whose time changes its unit: at one rate, its second part is gaps or years.

    A logger may be slow while the robot rests; windows of motion count.

    Raises:
        DataError: rows of two windows come at rates that no logger has both of.
    """
    moving = [log for log in windows if log.rows > 1 and _moves(log)]
    for log in moving[1:]:
        first, ratio = moving[0], log.step / moving[0].step
        if max(ratio, 1.0 / ratio) > UNIT:
            raise DataError(
                f"{log.name}: column time: a row every {first.step:.3g} s at {first.time[0]:.6g} s "
                f"and every {log.step:.3g} s at {log.time[0]:.6g} s; expected one unit, seconds, "
                "and about one rate; write the time of all rows in seconds, or split the file "
                "where it changes"
            )


def _moving(source: Source, part: tuple[float, float], size: int) -> Log:
    """A window in which something moves, in a part of a log; that in its middle if none does."""
    start, stop = part
    looks = (source.window(start + place * (stop - start), size) for place in _PLACES)
    middle = next(looks)
    return next((log for log in chain([middle], looks) if _moves(log)), middle)


def _moves(log: Log) -> bool:
    there = log.q[np.isfinite(log.q).all(axis=1)]
    return bool(len(there) and np.ptp(there, axis=0).max() > _TRAVEL)


# What a chunk makes of its rows, with every choice given.


def rows_of_chunk(
    model: CompiledModel, chunk: Chunk, chosen: LogChoices
) -> tuple[tuple[Stretch, ...], Facts]:
    """The rows of a chunk: mended, split, filtered and differentiated as those of a whole log.

    Its stretches have the rows that are its own and no others.

    Raises:
        DataError: a value that cannot be.
    """
    spec, processing = model.spec, chosen.processing
    check_size(chunk.log, spec)
    names = confirmed(processing.repairs_of(chosen.name))
    repairs = repairs_named(chunk.log, spec, names)
    mended, found, _ = defects(chunk.log, spec, chosen.usual, repairs)
    log = chunk.log if processing.keep_damaged else mended
    pieces, cuts = split(log, chosen.run, chosen.logged, chosen.extremes)
    check = None
    if chosen.logged:
        check = consistency(log, pieces, processing.parallel_cutoff, refuse=False)
        if not processing.keep_contradicted:
            pieces = believed(pieces, check)
    filtered = [segment_of(piece, processing) for piece in pieces]
    both = [closed(model, segment) for segment in filtered if segment is not None]
    still = [part for part in chosen.shafts if processing.speed_floors[part.name] == float("inf")]
    segments = at_rest([segment for segment, _ in both], still, [part.name for part in still])
    stretches = tuple(
        stretch(s, chosen.shafts, processing, _centres(s, chunk, chosen)) for s in segments
    )
    own = cut(chunk.log, chunk.own)
    start, stop = chunk.span
    return stretches, Facts(
        tally=tally(chunk, pieces, cuts, stretches, check),
        defects={
            name: [_own(chunk, some, name == "rows") for some in by_joint]
            for name, by_joint in found.items()
        },
        contradictions=tuple(
            one for one in (check.contradictions if check else ()) if start <= one.time < stop
        ),
        ranges=Ranges.of(own),
        fingers=fingers(own.time, own.q, own.tau),
        clipped=_clipped(chunk.log, pieces),
        awake=_awake(segments, chosen),
        open_times=tuple(
            float(t)
            for segment, open_ in both
            for t in segment.time[open_ & segment.whole]
            if start <= t < stop
        ),
        span=(float(own.time[0]), float(own.time[-1])),
    )


def _own(chunk: Chunk, found: Sequence[Defect], together: bool) -> list[Defect]:
    """What was found in the chunk's own rows; together: as one, of as many rows."""
    own = [one for one in found if chunk.has(one.start)]
    if not together or not own:
        return own
    rows = sum(one.stop - one.start for one in own)
    return [dataclasses.replace(own[0], stop=own[0].start + rows)]


def _centres(segment: Segment, chunk: Chunk, chosen: LogChoices) -> np.ndarray:
    """Samples on which the chunk's own rows are centred.

    A segment that begins and ends in the chunk has them where it would have them in a whole log.
    One that goes on beside it has them at every d-th row of the log, counted from its start, so
    that two chunks agree.
    """
    every, inside = chosen.decimation, np.flatnonzero(segment.whole)
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
        centres = row_centres(segment, every)
    return np.asarray(centres[chunk.holds(segment.time[centres])])


def _clipped(log: Log, pieces: Sequence[Piece]) -> np.ndarray:
    """(2, J) the ends of each torque's range that were taken for a limit; NaN of the others."""
    found = []
    for end in (np.fmin.reduce(log.tau, axis=0), np.fmax.reduce(log.tau, axis=0)):
        at = [np.any(piece.clipped & (piece.tau == end), axis=0) for piece in pieces]
        found.append(np.where(np.any(at, axis=0), end, np.nan))
    return np.stack(found)


def _awake(segments: Sequence[Segment], chosen: LogChoices) -> dict[str, float]:
    """Top speeds of the shafts that move, and were taken to stand still."""
    floors, moving = chosen.processing.speed_floors, [s for s in segments if s.whole.any()]
    still = [part for part in chosen.shafts if floors[part.name] == float("inf")]
    tops = top_speeds(still, moving, least=REST_TRAVEL) if moving else []
    return {part.name: top for part, top in zip(still, tops, strict=False) if top > 0.0}


# The report of all rows.


@dataclass(frozen=True, eq=False)
class Passes:
    """What long logs were read for.

    Attributes:
        found: what the windows showed.
        facts: of all rows, by log.
        passes: over the logs.
    """

    found: Survey
    facts: tuple[Facts, ...]
    passes: int

    def sentences(self) -> tuple[str, ...]:
        """Which rows were read for what."""
        told = self.to_json()
        passes = "once" if self.passes == 1 else f"{self.passes} times"
        return (
            f"long logs: all {told['rows']} rows are read {passes}, in {told['chunks']} chunks "
            "that overlap by what the filters remember; "
            f"{told['rows_in_windows']} of them, in {told['windows']} windows, are looked at for "
            "the choices below, doubts about channels, and what needs samples side by side",
        )

    def to_json(self) -> dict[str, int]:
        """Plain data."""
        tallies = [facts.tally for facts in self.facts]
        return {
            "passes": self.passes,
            "chunks": sum(tally.count("chunks") for tally in tallies),
            "rows": sum(tally.count("rows") for tally in tallies),
            "windows": self.found.windows,
            "rows_in_windows": self.found.rows,
        }


def streamed_report(model: CompiledModel, sources: Sequence[Source], passes: Passes) -> DataReport:
    """What happened to all rows of long logs.

    Args:
        model: the compiled robot.
        sources: of the logs.
        passes: over them.
    """
    found, facts = passes.found, passes.facts
    looked, chosen = found.observation.report, found.chosen[0]
    floors, tallies = chosen.processing.speed_floors, [own.tally for own in facts]
    return dataclasses.replace(
        looked,
        processing=chosen.processing,
        choices=(*passes.sentences(), *looked.choices),
        logs=tuple(_log_report(model, source, k, passes) for k, source in enumerate(sources)),
        joints=joint_reports(model.spec.joints, chosen.shafts, floors, tallies),
    )


def _log_report(model: CompiledModel, source: Source, k: int, passes: Passes) -> LogReport:
    facts, chosen, found = passes.facts[k], passes.found.chosen[k], passes.found
    counts, first, content = facts.tally, source.window(0.0, 2), source.content
    if not content and counts.count("rows") > LONG:
        content = fingerprint_of(facts.fingers)
    elif not content:
        whole = joined(list(source.blocks(LONG)))
        content = fingerprint(whole.time, whole.q, whole.tau)
    notes = (*first.notes, *facts.ranges.doubts(chosen.step, model.spec))
    log = dataclasses.replace(first, name=source.name, notes=notes, content=content)
    report = log_report(
        log, model.spec, found.logs[k], counts, facts.defects, facts.contradictions,
        chosen.decimation, facts.open_times,
    )  # fmt: skip
    return dataclasses.replace(report, rate=1.0 / chosen.step, span=facts.span)
