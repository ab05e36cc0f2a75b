"""Long logs: a look at windows, by which all is chosen; what chunks make of it; their report."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.numerics.filters import choose_row_spacing
from modeler.regression import faults, prepare
from modeler.regression.chunk import Chunk, compute_margin
from modeler.regression.consistency import check_derivatives
from modeler.regression.log import (
    FINGER,
    LONG,
    Log,
    RawSegment,
    combine_hashes,
    compute_block_hashes,
    compute_fingerprint,
    split_log,
)
from modeler.regression.motion import ChosenProcessing, Processing, Segment, build_segment
from modeler.regression.observation import Observation, build_observation
from modeler.regression.observe import choose_filters
from modeler.regression.read import ChannelRanges, Source, cut_rows, join_logs, join_windows
from modeler.regression.repairs import choose_repairs
from modeler.regression.report import (
    DataReport,
    LogFacts,
    LogReport,
    build_joint_reports,
    build_log_report,
    count_rows,
)
from modeler.regression.segments import (
    REST_TRAVEL,
    FilteredSegment,
    FrictionShaft,
    choose_row_centres,
    clear_resting_speeds,
    compute_top_speeds,
    filter_segment,
    find_shafts,
)
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel

WINDOWS = 8
"""Windows of all logs together, at least one of each log."""


WINDOW = 4_096
"""Rows of a window, at least ..."""

SECONDS = 8.0
"""... and seconds, so that a fast logger shows a motion too ..."""

LONGEST = 65_536
"""... but no more rows than these."""


_PLACES = (0.5, 0.25, 0.75, 0.1, 0.9, 0.4, 0.6)  # of a window in its part of a log

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
    channel_scales: faults.ChannelScales
    extremes: Extremes
    shafts: tuple[FrictionShaft, ...]
    step: float
    chunk_rows: int
    margin_rows: int


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
    logs: tuple[prepare.PreparedLog, ...]
    chosen: tuple[LogChoices, ...]
    windows: int
    rows: int


@dataclass(frozen=True, eq=False)
class KnownFacts:
    """What an earlier pass over the logs found, that the windows did not show.

    Attributes:
        floors: speed floors, by shaft that stood still in the windows.
        extremes: (J,) smallest and largest torque by log; none before the first pass.
    """

    floors: Mapping[str, float] = dataclasses.field(default_factory=dict)
    extremes: Mapping[int, Extremes] = dataclasses.field(default_factory=dict)


def choose_from_windows(
    model: CompiledModel,
    sources: Sequence[Source],
    processing: Processing,
    known: KnownFacts,
    rows: int = FINGER,
) -> Survey:
    """Inspects at windows of the logs and chooses.

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
    counts = [_count_windows(sources, k) for k in range(len(sources))]
    windows = [_read_windows(*pair) for pair in zip(sources, counts, strict=True)]
    looked = [k for k, log_windows in enumerate(windows) if log_windows]
    logs = [join_windows(log_windows) if log_windows else None for log_windows in windows]
    seen = [log for log in logs if log is not None]
    try:
        repair = prepare.LogRepair(seen, model.spec)
        processing = choose_repairs(model, seen, processing, repair)
        prepared = prepare.prepare_logs(model.spec, seen, processing, repair)
        filtered = choose_filters(model, seen, prepared, processing, repair)
        observation = build_observation(model, seen, filtered)
    except (DataError, LoopError) as error:  # what is wrong here may be right elsewhere
        where = f"the {sum(len(log_windows) for log_windows in windows)} windows"
        raise WholeLogNeeded(f"{error}; found in {where} by which long logs are judged") from None
    chosen, parts = observation.report.processing, find_shafts(model)
    chosen = dataclasses.replace(chosen, speed_floors={**chosen.speed_floors, **known.floors})
    places = tuple(looked.index(k) if k in looked else 0 for k in range(len(sources)))
    every = []
    for k, (source, at) in enumerate(zip(sources, places, strict=True)):
        log = logs[k] or source.read_window(0.5, WINDOW)
        if log.rows < 2:
            raise DataError(
                f"{log.name}: {log.rows} rows where it was looked at; expected a motion; leave it "
                "out"
            )
        ranges, beside = ChannelRanges.compute_from(log), compute_margin(chosen, log.step)
        fresh = [piece.step for piece in prepared.logs[at].pieces if k in looked]
        every.append(
            LogChoices(
                run=k,
                name=source.name,
                processing=chosen,
                decimation=choose_row_spacing(
                    (*fresh, log.step)[0], chosen.parallel_cutoff, chosen.decimation
                ),
                logged=prepared.logs[at].check is not None,
                channel_scales=prepared.logs[at].channel_scales,
                extremes=known.extremes.get(k) or ranges.torques,
                shafts=parts,
                step=log.step,
                chunk_rows=rows * max(1, -(-4 * beside // rows)),  # most of what is read
                margin_rows=beside,
            )
        )
    sizes = sum(map(len, windows)), sum(log.rows for log in seen)
    prepared_logs = tuple(
        dataclasses.replace(prepared.logs[at], pieces=()) for at in places
    )  # memory
    return Survey(observation, prepared_logs, tuple(every), *sizes)


def _count_windows(sources: Sequence[Source], k: int) -> int:
    """Returns windows of a log."""
    if len(sources) > THRESHOLDS.max_window_logs:
        return int(k % -(-len(sources) // THRESHOLDS.max_window_logs) == 0)
    total = sum(source.rows for source in sources)
    return max(1, round(WINDOWS * sources[k].rows / max(1, total)))


def _read_windows(source: Source, count: int) -> list[Log]:
    """Returns windows of a log, increasing in time."""
    if not count:
        return []
    first = source.read_window(0.5 / count, WINDOW)
    size = int(np.clip(round(SECONDS / first.step), WINDOW, LONGEST)) if first.rows > 1 else WINDOW
    if count * size > 0.7 * source.rows:
        return [source.read_window(0.0, max(size, min(source.rows, count * size)))]
    windows: list[Log] = []
    for k in range(count):
        log = _find_moving_window(source, (k / count, (k + 1) / count), size)
        if not windows or log.time[0] > windows[-1].time[-1]:
            windows.append(log)
    _check_unit(windows)
    return windows


def _check_unit(windows: Sequence[Log]) -> None:
    """Refuses a log whose time changes its unit: at one rate, its second part is gaps or years.

    A logger may be slow while the robot rests; windows of motion count.

    Raises:
        DataError: rows of two windows come at rates that no logger has both of.
    """
    moving = [log for log in windows if log.rows > 1 and _is_moving(log)]
    for log in moving[1:]:
        first, ratio = moving[0], log.step / moving[0].step
        if max(ratio, 1.0 / ratio) > THRESHOLDS.max_rate_ratio:
            raise DataError(
                f"{log.name}: column time: a row every {first.step:.3g} s at {first.time[0]:.6g} s "
                f"and every {log.step:.3g} s at {log.time[0]:.6g} s; expected one unit, seconds, "
                "and about one rate; write the time of all rows in seconds, or split the file "
                "where it changes"
            )


def _find_moving_window(source: Source, part: tuple[float, float], size: int) -> Log:
    """Returns a window in which something moves, in a part of a log; its middle if none does."""
    start, stop = part
    looks = (source.read_window(start + place * (stop - start), size) for place in _PLACES)
    middle = next(looks)
    return next((log for log in chain([middle], looks) if _is_moving(log)), middle)


def _is_moving(log: Log) -> bool:
    there = log.q[np.isfinite(log.q).all(axis=1)]
    return bool(len(there) and np.ptp(there, axis=0).max() > THRESHOLDS.min_window_travel)


# What a chunk makes of its rows, with every choice given.


def build_chunk_rows(
    model: CompiledModel, chunk: Chunk, chosen: LogChoices
) -> tuple[tuple[FilteredSegment, ...], LogFacts]:
    """Returns the rows of a chunk: repaired, split, filtered and differentiated as a whole log.

    Its segments have the rows that are its own and no others.

    Raises:
        DataError: a value that cannot be.
    """
    spec, processing = model.spec, chosen.processing
    prepare.check_size(chunk.log, spec)
    names = faults.select_confirmed(processing.repairs_of(chosen.name))
    repairs = faults.parse_repairs(chunk.log, spec, names)
    mended, damage, _ = faults.repair_log(chunk.log, spec, chosen.channel_scales, repairs)
    log = chunk.log if processing.keep_damaged else mended
    pieces, cuts = split_log(log, chosen.run, chosen.logged, chosen.extremes)
    pushes = processing.get_pushes(log)
    pieces = tuple(dataclasses.replace(piece, pushes=pushes) for piece in pieces)
    check = None
    if chosen.logged:
        check = check_derivatives(log, pieces, processing.parallel_cutoff, refuse=False)
        if not processing.keep_contradicted:
            pieces = prepare.exclude_contradicted(pieces, check)
    filtered = [build_segment(piece, processing) for piece in pieces]
    both = [prepare.close_segment(model, segment) for segment in filtered if segment is not None]
    still = [part for part in chosen.shafts if processing.speed_floors[part.name] == float("inf")]
    closed, names_still = [segment for segment, _ in both], [part.name for part in still]
    segments = clear_resting_speeds(closed, still, names_still)
    every = [(segment, _find_centres(segment, chunk, chosen)) for segment in segments]
    stretches = tuple(filter_segment(s, chosen.shafts, processing, at) for s, at in every)
    inner_log = cut_rows(chunk.log, chunk.inner_rows)
    (start, stop), inner = chunk.span, dict[str, list[list[faults.Defect]]]()
    for name, by_joint in damage.items():
        inner[name] = [[one for one in some if chunk.is_inner(one.start)] for some in by_joint]
    for some in inner.get("rows", ()):  # as one, of as many rows
        if some:
            rows = sum(one.stop - one.start for one in some)
            some[:] = [dataclasses.replace(some[0], stop=some[0].start + rows)]
    contradictions = check.contradictions if check else ()
    open_times = [t for s, open_ in both for t in s.time[open_ & s.whole].tolist()]
    return stretches, LogFacts(
        tally=count_rows(chunk, pieces, cuts, stretches, check),
        defects=inner,
        contradictions=tuple(x for x in contradictions if start <= x.time < stop),
        ranges=ChannelRanges.compute_from(inner_log),
        block_hashes=compute_block_hashes(inner_log.time, inner_log.q, inner_log.tau),
        clipped=_find_clipped(chunk.log, pieces),
        moving_shafts=_find_moving_shafts(segments, chosen),
        open_times=tuple(t for t in open_times if start <= t < stop),
        span=(float(inner_log.time[0]), float(inner_log.time[-1])),
    )


def _find_centres(segment: Segment, chunk: Chunk, chosen: LogChoices) -> np.ndarray:
    """Returns samples on which the chunk's own rows are centred.

    A segment that begins and ends in the chunk has them where it would have them in a whole log.
    One that goes on beside it has them at every d-th row of the log, counted from its start, so
    that two chunks agree.
    """
    every, inside = chosen.decimation, np.flatnonzero(segment.whole)
    if not inside.size:
        return inside
    log = chunk.log
    begins = chunk.number == 0 and chunk.inner_rows.start == 0
    open_before = segment.time[0] <= log.time[0] and not begins
    open_behind = segment.time[-1] >= log.time[-1] and not chunk.last
    if open_before or open_behind:
        first = (every - 1) // 2 - (chunk.start - chunk.inner_rows.start)  # row of the chunk's log
        anchor = float(log.time[first % every]) if log.rows > every else float(log.time[0])
        phase = round((anchor - segment.time[0]) / segment.step) - int(inside[0])
        centres = inside[phase % every :: every]
    else:
        centres = choose_row_centres(segment, every)
    return np.asarray(centres[chunk.is_inside(segment.time[centres])])


def _find_clipped(log: Log, pieces: Sequence[RawSegment]) -> np.ndarray:
    """Returns (2, J) the ends of each torque's range that were taken for a limit; NaN of others."""
    limits = []
    if not any(piece.clipped.any() for piece in pieces):
        return np.full((2, log.tau.shape[1]), np.nan)
    for end in (np.fmin.reduce(log.tau, axis=0), np.fmax.reduce(log.tau, axis=0)):
        at = [np.any(piece.clipped & (piece.tau == end), axis=0) for piece in pieces]
        limits.append(np.where(np.any(at, axis=0), end, np.nan))
    return np.stack(limits)


def _find_moving_shafts(segments: Sequence[Segment], chosen: LogChoices) -> dict[str, float]:
    """Returns top speeds of the shafts that move, and were taken to stand still."""
    floors, moving = chosen.processing.speed_floors, [s for s in segments if s.whole.any()]
    still = [part for part in chosen.shafts if floors[part.name] == float("inf")]
    tops = compute_top_speeds(still, moving, least=REST_TRAVEL) if moving else []
    return {part.name: top for part, top in zip(still, tops, strict=False) if top > 0.0}


# The report of all rows.


@dataclass(frozen=True, eq=False)
class LogPasses:
    """What long logs were read for.

    Attributes:
        found: what the windows showed.
        facts: of all rows, by log.
        passes: over the logs.
    """

    survey: Survey
    facts: tuple[LogFacts, ...]
    passes: int

    def format_sentences(self) -> tuple[str, ...]:
        """Returns which rows were read for what."""
        counts = self.to_json()
        passes = "once" if self.passes == 1 else f"{self.passes} times"
        return (
            f"long logs: all {counts['rows']} rows are read {passes}, in {counts['chunks']} chunks "
            f"that overlap by the length of the filters; {counts['rows_in_windows']} of them, in "
            f"{counts['windows']} windows, serve the choices below, warnings about channels, and "
            "what needs samples side by side",
        )

    def to_json(self) -> dict[str, int]:
        """Returns the numbers of rows, chunks and windows that were read as plain data."""
        tallies = [facts.tally for facts in self.facts]
        return {
            "passes": self.passes,
            "chunks": sum(tally.count("chunks") for tally in tallies),
            "rows": sum(tally.count("rows") for tally in tallies),
            "windows": self.survey.windows,
            "rows_in_windows": self.survey.rows,
        }


def build_streamed_report(
    model: CompiledModel, sources: Sequence[Source], passes: LogPasses
) -> DataReport:
    """Returns what happened to all rows of long logs.

    Args:
        model: the compiled robot.
        sources: of the logs.
        passes: over them.
    """
    log_survey, facts = passes.survey, passes.facts
    looked, chosen = log_survey.observation.report, log_survey.chosen[0]
    floors, tallies = chosen.processing.speed_floors, [log_facts.tally for log_facts in facts]
    return dataclasses.replace(
        looked,
        processing=chosen.processing,
        choices=(*passes.format_sentences(), *looked.choices),
        logs=tuple(_build_log_report(model, source, k, passes) for k, source in enumerate(sources)),
        joints=build_joint_reports(model.spec.joints, chosen.shafts, floors, tallies),
    )


def _build_log_report(model: CompiledModel, source: Source, k: int, passes: LogPasses) -> LogReport:
    facts, chosen, log_survey = passes.facts[k], passes.survey.chosen[k], passes.survey
    counts, first, content = facts.tally, source.read_window(0.0, 2), source.content
    if not content and counts.count("rows") > LONG:
        content = combine_hashes(facts.block_hashes)
    elif not content:
        whole = join_logs(list(source.read_blocks(LONG)))
        content = compute_fingerprint(whole.time, whole.q, whole.tau)
    notes = (*first.notes, *facts.ranges.collect_warnings(chosen.step, model.spec))
    log = dataclasses.replace(first, name=source.name, notes=notes, content=content)
    report = build_log_report(
        log,
        model.spec,
        log_survey.logs[k],
        counts,
        facts.defects,
        facts.contradictions,
        chosen.decimation,
        facts.open_times,
    )
    return dataclasses.replace(report, rate=1.0 / chosen.step, span=facts.span)
