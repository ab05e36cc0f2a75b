"""What is in a log: clock, channels, warnings and where they lie."""

import dataclasses
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.json import Document
from modeler.core.manifest import JointSpec
from modeler.core.result import Result
from modeler.core.table import format_percent
from modeler.logs.columns import Stream, describe_coarse_clock
from modeler.logs.guess import (
    Guess,
    describe_doubtful_degrees,
    describe_non_si_columns,
    find_absent_roles,
    flag_prismatic_columns,
    format_log_table,
    guess_columns,
    guess_role,
    pair_speeds,
)
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import LENGTH, LogMap, find_unit, parse_unit
from modeler.logs.rates import check_rates, describe_repeats, is_moving, is_on_grid
from modeler.logs.thresholds import THRESHOLDS
from modeler.numerics.channels import find_repeated_rows, model_channel

GAP = 1.9  # of a usual step: a row is missing
HELD = 3  # rows in a row at the extreme value that make it a limit
_MEASURED = ("q", "qd", "qdd", "tau", "current")
_TOLD = (
    "long log: all {} rows are read for ranges, missing values, limits, gaps and pictures, {} of "
    "them, in windows, for rate, units, resolution and speeds"
)


@dataclass(frozen=True)
class Clock(Document):
    """The time of the rows.

    Attributes:
        column: in the file.
        rate: Hz, by the median step; NaN where most steps are 0.
        jitter: standard deviation of the steps without gaps, as a share of the median.
        gaps: steps of more than 1.9 usual ones; `lost_rows` rows would fit into them.
        largest_gap: gap, s; `at`: s, where it begins, NaN without any.
        repeated_steps: of 0; `backward_steps`: to an earlier time.
        duration: s.
        tick: s; what the steps differ by at least, 0 if they lie on no grid.
    """

    KEYS = """
        column rate jitter gaps lost_rows largest_gap largest_gap_start repeated_steps
        backward_steps duration tick=known_tick
    """

    column: str
    rate: float
    jitter: float
    gaps: int
    lost_rows: int
    largest_gap: float
    largest_gap_start: float
    repeated_steps: int
    backward_steps: int
    duration: float
    tick: float

    @property
    def known_tick(self) -> float | None:
        """Returns the grid of the steps, s; None where they lie on none."""
        return self.tick or None


@dataclass(frozen=True)
class Channel(Document):
    """One column with numbers.

    Attributes:
        name: as the user knows it: `pos[2] (q2)`.
        unit: stated or guessed, "" if nobody knows; `is_unit_guessed` says which.
        low, high: of the values, in that unit; NaN without any.
        missing_rows: rows without value.
        resolution: smallest step between values, 0 if there is no grid.
        held_rows: rows for which each value is held; 1 if it is sampled at every row.
        limits: values at which it stays, with the share of rows: saturation.
        is_constant: True if it never changes.
    """

    KEYS = """
        name unit is_unit_guessed low high missing_rows resolution=known_resolution held_rows limits
        is_constant
    """

    name: str
    unit: str
    is_unit_guessed: bool
    low: float
    high: float
    missing_rows: int
    resolution: float
    held_rows: int
    limits: tuple[tuple[float, float], ...]
    is_constant: bool

    @property
    def known_resolution(self) -> float | None:
        """Returns the smallest step between values; None where there is no grid."""
        return self.resolution or None


@dataclass(frozen=True, eq=False)
class Positions:
    """What looks like the positions of joints, in the rows that are looked at.

    Attributes:
        names: of the channels, as the user knows them.
        units: "rad" or "m"; "counts" of an encoder whose counts a turn nobody said.
        time: (n,) s.
        values: (n, J) in these units.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    time: np.ndarray
    values: np.ndarray


@dataclass(frozen=True, eq=False)
class LogInspection(Result, Document):
    """All that a log shows by itself.

    Attributes:
        name: of the file.
        rows: of it.
        clock: None if no column is a time.
        channels: in the order of the file.
        streams: topics or groups.
        notes: of reading.
        warnings: what contradicts itself or looks like another unit.
        suggested_map: a [log] to paste, guessed; "" if a mapping is there already.
        suggested_map_without_ranges: the same without what ranges say of positions.
        range_warnings: warnings about positions that rest on their range alone.
        time: (n,) s, or row numbers without a clock; of a long log at the extremes of each block.
        steps: (2, m) times, and steps of the clock up to them, s; of a long log the extremes.
        values: (n,) of every channel, in its unit.
        positions: None without a clock, or without any.
    """

    KEYS = "log=name rows clock channels streams notes warnings suggested_map"

    name: str

    rows: int
    clock: Clock | None
    channels: tuple[Channel, ...]
    streams: tuple[Stream, ...]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    suggested_map: str
    suggested_map_without_ranges: str
    range_warnings: tuple[str, ...]
    time: np.ndarray
    steps: np.ndarray
    values: Mapping[str, np.ndarray]
    positions: Positions | None = None


def inspect_table(
    table: LogTable,
    mapping: LogMap,
    joints: Sequence[JointSpec] = (),
    span: tuple[float | None, float | None] = (None, None),
    every: Iterable[LogTable] | None = None,
) -> LogInspection:
    """Returns what is in a log.

    Args:
        table: of the file, read with `mapping`; of a long one of windows, by which rate, units,
            resolution and speeds are judged.
        mapping: stated by the user; what it leaves open is guessed.
        joints: of the robot, if it is known.
        span: only the rows from one time to another, s.
        every: all rows of a long log, block after block; None: the table has them.

    Raises:
        DataError: no rows in that span, or a time column without values.
    """
    values = {name: table.read_measured(name) for name in table.names if table.is_numeric(name)}
    names = {j.name: mapping.names[j.name] for j in joints if j.name in mapping.names}

    def measure_block(
        block: LogTable,
    ) -> dict[str, np.ndarray]:  # what turns out to be text has none
        none = np.full(block.rows, np.nan)
        is_numeric = block.is_numeric
        return {name: block.read_measured(name) if is_numeric(name) else none for name in values}

    blocks: Iterable[dict[str, np.ndarray]]
    blocks = [values] if every is None else map(measure_block, every)
    if span != (None, None):
        guesses = guess_columns(values, {}, joints, names)
        values, every = _select_span(table, guesses, blocks, span), None
        blocks = [values]
    units = {n: unit for n in values if (unit := table.get_unit(n))}
    guesses = guess_columns(values, units, joints, names)
    units = {n: u for one in guesses for n, u in zip(one.columns, one.units, strict=True) if u}
    time, clock = _measure_clock(table, values, guesses)
    shown = {name: table.convert_to_unit(name, v) for name, v in values.items()}
    rows, clock, extents, drawn = _scan_rows(table, blocks, guesses, clock, every is None)
    again = _find_repeats(guesses, values, clock)
    models = {name: model_channel(time[~again], v[~again]) for name, v in shown.items()}
    channels = []
    for name in shown:
        stated, missing = table.get_unit(name), sum(extent.missing for extent in extents[name])
        ends = np.stack([extent.ends for extent in extents[name]])
        held = np.stack([extent.held for extent in extents[name]])
        low, high = float(np.fmin.reduce(ends[:, 1])), float(np.fmax.reduce(ends[:, 2]))
        limits = _find_limits(ends.ravel()[1:-1], held.ravel()[1:-1], (low, high), rows - missing)
        if high - low <= models[name].resolution:  # at rest
            limits = ()
        channels.append(
            Channel(
                name=table.format_name(name),
                unit=stated or units.get(name, ""),
                is_unit_guessed=not stated and name in units,
                low=low,
                high=high,
                missing_rows=missing,
                resolution=models[name].step,
                held_rows=models[name].hold,
                limits=limits,
                is_constant=low == high,
            )
        )
    notes, pairs = (*table.reading_notes, *table.notes), pair_speeds(guesses)
    if every is not None:
        notes = (*notes, _TOLD.format(rows, len(time)))
    coarse = ""
    if clock is not None and clock.repeated_steps and every is None:
        others = (v for name, v in values.items() if table.format_name(name) != clock.column)
        coarse = describe_coarse_clock(time, others)
    doubts = [*_describe_clock(clock, coarse), *find_absent_roles(guesses)]
    doubts += describe_non_si_columns(guesses)
    doubts += describe_doubtful_degrees(guesses, values)
    doubts += check_rates(pairs, values, time)
    if clock is not None:
        holds = {table.format_name(name): models[name].hold for name in _list_measured(guesses)}
        doubts += _describe_holds(holds, float(again.mean()), rows, clock.rate)
    constant = {name for c, name in zip(channels, shown, strict=True) if c.is_constant}
    still = map(table.format_name, _find_dead_channels(guesses, values, constant))
    if names_still := ", ".join(still):
        verb = "never change: are they" if "," in names_still else "never changes: is it"
        doubts.append(f"{names_still} {verb} connected?")
    bare = [one.drop_range_units() if one.quantity in ("q", "qc") else one for one in guesses]
    suggested, plain = (
        "" if mapping.layers else format_log_table(f, joints, tuple(values), names)
        for f in (guesses, bare)
    )
    unitless = describe_non_si_columns(bare)
    ranged = tuple(line for line in describe_non_si_columns(guesses) if line not in unitless)
    return LogInspection(
        table.path.name,
        rows,
        clock,
        tuple(channels),
        table.file_columns.streams,
        notes,
        tuple(doubts),
        suggested,
        plain,
        ranged,
        *drawn,
        None if clock is None else _build_positions(table, values, guesses, joints, names, time),
    )


def _find_dead_channels(
    guesses: Sequence[Guess], values: Mapping[str, np.ndarray], constant: Collection[str]
) -> list[str]:
    """Returns speeds and torques that never change though their joint moves."""
    by = {one.quantity: dict(zip(one.labels, one.columns, strict=True)) for one in guesses}
    moving = {label for label, name in by.get("q", {}).items() if is_moving(values[name])}
    measured = [by.get(name, {}) for name in _MEASURED if name != "q"]
    return [x[label] for x in measured for label in x if label in moving and x[label] in constant]


def _build_positions(
    table: LogTable,
    values: Mapping[str, np.ndarray],
    guesses: Sequence[Guess],
    joints: Sequence[JointSpec],
    names: Mapping[str, str],
    time: np.ndarray,
) -> Positions | None:
    one = next((one for one in guesses if one.quantity == "q"), None)
    if one is None:
        return None
    units, columns = list[str](), list[np.ndarray]()
    linear = flag_prismatic_columns(one.labels, joints, names)
    for name, guessed, slides in zip(one.columns, one.units, linear, strict=True):
        text = table.get_unit(name) or guessed
        known = find_unit(text) if text else None
        slides = slides if known is None else known.powers == LENGTH
        units.append("counts" if text and known is None else "m" if slides else "rad")
        factor = 1.0 if known is None or table.get_unit(name) else known.factor  # else it is SI
        columns.append(values[name] * factor)
    called = tuple(map(table.format_name, one.columns))
    return Positions(called, tuple(units), time, np.column_stack(columns))


def _list_measured(guesses: Sequence[Guess], but: Collection[str] = ()) -> list[str]:
    """Columns of what was measured, but for some quantities."""
    some = (one for one in guesses if one.quantity in _MEASURED and one.quantity not in but)
    return [name for one in some for name in one.columns]


def _find_repeats(
    guesses: Sequence[Guess], values: Mapping[str, np.ndarray], clock: Clock | None
) -> np.ndarray:
    """(n,) True at rows that a recorder wrote again; in windows of a long log."""
    others = [values[name] for name in _list_measured(guesses, but=("q",))]
    q = [values[name] for one in guesses if one.quantity == "q" for name in one.columns]
    if clock is None or not q or not others:
        return np.zeros(len(next(iter(values.values()), ())), dtype=bool)
    return find_repeated_rows(np.column_stack(q), np.column_stack(others))


def _describe_holds(held: Mapping[str, int], share: float, rows: int, rate: float) -> list[str]:
    """A share of rows that repeat, and channels that are sampled more slowly than the rows."""
    lines = [describe_repeats(round(share * rows), rows, rate)] if share else []
    fresh = rate * (1.0 - share)
    for hold in sorted({*held.values()} - {1}):
        names = ", ".join(name for name, other in held.items() if other == hold)
        lines.append(
            f"{names}: holds each value for {hold} rows: sampled at {fresh / hold:.3g} Hz, not "
            f"{fresh:.4g} Hz"
        )
    return lines


def _select_span(
    table: LogTable,
    guesses: Sequence[Guess],
    blocks: Iterable[dict[str, np.ndarray]],
    span: tuple[float | None, float | None],
) -> dict[str, np.ndarray]:
    """The rows of a span of time."""
    low = -np.inf if span[0] is None else span[0]
    high = np.inf if span[1] is None else span[1]
    parts, ends, clock = [], list[float](), None
    for values in blocks:
        time, clock = _measure_clock(table, values, guesses)
        parts.append({name: v[(time >= low) & (time < high)] for name, v in values.items()})
        ends += [float(np.nanmin(time)), float(np.nanmax(time))]
    inside = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    if clock is None or len(next(iter(inside.values()))) < 2:
        raise DataError(
            f"{table.path}: fewer than two rows from {low:g} to {high:g} s; its times go from "
            f"{min(ends):g} to {max(ends):g} s"
        )
    return inside


@dataclass(frozen=True, eq=False)
class _Extent:
    """What the values of a channel in a block of rows take up.

    Attributes:
        missing: rows without a value.
        ends, held: (5,) values at which it stays for some rows, and for how many rows: at the
            first, the least, the largest, all others together, and the last.
    """

    missing: int
    ends: np.ndarray
    held: np.ndarray


Drawn = tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]
"""Time, steps and values of a `LogInspection`."""


def _scan_rows(
    table: LogTable,
    blocks: Iterable[dict[str, np.ndarray]],
    guesses: Sequence[Guess],
    seen: Clock | None,
    whole: bool,
) -> tuple[int, Clock | None, dict[str, list[_Extent]], Drawn]:
    """Rows, clock, extents by channel, and what is drawn; `seen`: of the windows of a long log."""
    counts, clocks, extents, drawn = list[int](), list[Clock](), list[dict](), list[Drawn]()
    last: dict[str, np.ndarray] = {}  # a block knows the row before it: one step more
    for values in blocks:
        rows = {name: np.append(last.get(name, v[:0]), v) for name, v in values.items()}
        time, clock = _measure_clock(table, rows, guesses, None if whole else seen)
        if clock is None:
            time = time + sum(counts)
        else:
            clocks.append(clock)
        block = time[1 if last else 0 :]
        shown = {name: table.convert_to_unit(name, v) for name, v in values.items()}
        extents.append({name: _measure_extent(v) for name, v in shown.items()})
        part = block, np.stack([time[1:], np.diff(time)]), shown
        drawn.append(part if whole else _find_extremes(*part))
        last = {name: v[-1:] for name, v in values.items()}
        counts.append(len(block))
    times, steps, values_drawn = zip(*drawn, strict=True)
    time = np.concatenate(times)
    return (
        sum(counts),
        None if seen is None else _merge_clocks(seen, clocks, time),
        {name: [block[name] for block in extents] for name in last},
        (
            time,
            np.concatenate(steps, axis=1),
            {name: np.concatenate([block[name] for block in values_drawn]) for name in last},
        ),
    )


def _find_extremes(time: np.ndarray, steps: np.ndarray, values: Mapping[str, np.ndarray]) -> Drawn:
    """The rows at which time and channels are least and largest, and such steps."""
    series = [x for x in (time, steps[1], *values.values()) if np.isfinite(x).any()]
    ends = [[np.nanargmin(x), np.nanargmax(x)] for x in series]
    rows = np.unique([ends[0], *ends[2:]])
    return time[rows], steps[:, ends[1]], {name: x[rows] for name, x in values.items()}


def _merge_clocks(seen: Clock, clocks: Sequence[Clock], time: np.ndarray) -> Clock:
    """The clock of consecutive blocks."""
    duration = float(np.nanmax(time) - np.nanmin(time))
    counted = ("gaps", "lost_rows", "repeated_steps", "backward_steps")
    sums = {name: sum(getattr(clock, name) for clock in clocks) for name in counted}
    widest = max(clocks, key=lambda clock: clock.largest_gap)
    jitters = [clock.jitter**2 for clock in clocks if np.isfinite(clock.jitter)] or [np.nan]
    jitter = float(np.sqrt(np.mean(jitters)))
    sums |= {"jitter": jitter, "duration": duration}
    return dataclasses.replace(widest, rate=seen.rate, tick=seen.tick, **sums)


def _measure_clock(
    table: LogTable,
    values: Mapping[str, np.ndarray],
    guesses: Sequence[Guess],
    seen: Clock | None = None,
) -> tuple[np.ndarray, Clock | None]:
    """Times of rows, and their clock, by the usual step of `seen` or their own."""
    guess = next((one for one in guesses if one.quantity == "time"), None)
    name = guess.columns[0] if guess is not None else "time"
    if name not in values:
        return np.arange(len(next(iter(values.values()), ())), dtype=float), None
    time = values[name]
    if guess is not None and guess.units[0] and not table.get_unit(name):
        time = time * parse_unit(guess.units[0]).factor
    known = time[np.isfinite(time)]
    steps = np.diff(known)
    if not len(steps):
        raise DataError(f"{table.path}: column {name} has no values; expected the time of each row")
    step = float(np.median(steps)) if seen is None else 1.0 / seen.rate
    longest = GAP * find_usual_step(steps, step)
    even = steps[(steps > 0.0) & (steps <= longest)]
    gaps = np.flatnonzero(steps > longest) if step > 0.0 else np.array([], dtype=int)
    widest = int(gaps[np.argmax(steps[gaps])]) if gaps.size else 0
    return time, Clock(
        column=table.format_name(name),
        rate=1.0 / step if step > 0.0 else np.nan,
        jitter=float(np.std(even)) / step if even.size and step > 0.0 else np.nan,
        gaps=int(gaps.size),
        lost_rows=int(np.sum(np.round(steps[gaps] / step) - 1.0)) if gaps.size else 0,
        largest_gap=float(steps[widest]) if gaps.size else 0.0,
        largest_gap_start=float(known[widest]) if gaps.size else np.nan,
        repeated_steps=int(np.sum(steps == 0.0)),
        backward_steps=int(np.sum(steps < 0.0)),
        duration=float(known.max() - known.min()),
        tick=_find_tick(even, step),
    )


def find_usual_step(steps: np.ndarray, step: float) -> float:
    """Returns longest step, s, of an uneven clock but for the rarest; `step` of an even one."""
    known = steps[steps > 0.0]
    if not len(known):
        return step
    return max(step, float(np.quantile(known, THRESHOLDS.usual_step_quantile)))


def _find_tick(steps: np.ndarray, step: float) -> float:
    """What steps of a clock differ by, if they are whole multiples apart; else 0."""
    off = np.abs(steps - step)
    off = off[off > 1e-4 * step]
    if not off.size:
        return 0.0
    tick = float(off.min())
    return tick if is_on_grid(off, tick) else 0.0


def _measure_extent(values: np.ndarray) -> _Extent:
    finite = values[np.isfinite(values)]
    missing = values.size - finite.size
    if not finite.size:
        return _Extent(missing, np.full(5, np.nan), np.zeros(5, dtype=int))
    starts = np.append(0, np.flatnonzero(np.diff(finite)) + 1)  # where another value begins
    at, rows = finite[starts], np.diff(starts, append=finite.size)
    rows[rows < HELD] = 0
    low, high, inner = finite.min(), finite.max(), rows[1:-1]
    held = [inner[at[1:-1] == end].sum() for end in (low, high)]
    held = [rows[0], *held, inner.sum() - sum(held), rows[-1] if rows.size > 1 else 0]
    return _Extent(missing, np.array([at[0], low, high, np.nan, at[-1]]), np.array(held))


def _find_limits(
    ends: np.ndarray, held: np.ndarray, limits: tuple[float, float], rows: int
) -> tuple[tuple[float, float], ...]:
    """Ends of the range at which so many values stay for some rows, and for which share of all.

    Not at the beginning or the end, where a robot stands still; and not of a channel that stays
    anywhere, because it is slower than the log.
    """
    if not limits[0] < limits[1] or held.sum() > THRESHOLDS.max_held_share * rows:
        return ()
    counts = [(end, int(held[ends == end].sum())) for end in limits]
    least = THRESHOLDS.min_limit_share * rows
    return tuple((end, count / rows) for end, count in counts if count > least)


def _describe_clock(clock: Clock | None, coarse: str) -> list[str]:
    """What a clock should not do."""
    if clock is None:
        return ["no column looks like the time: name it with --map time=COLUMN, or give --map rate"]
    if coarse:
        return [f"{clock.column}: {coarse}"]
    lines = []
    if clock.backward_steps:
        lines.append(
            f"{clock.column} decreases in {clock.backward_steps} rows: sort or split the log"
        )
    if clock.repeated_steps:
        lines.append(f"{clock.column} is repeated in {clock.repeated_steps} rows: delete them")
    if clock.gaps:
        lines.append(
            f"{clock.column} has {clock.gaps} gap{'s' * (clock.gaps > 1)}, the widest "
            f"{clock.largest_gap:.4g} s at {clock.largest_gap_start:.4g} s"
        )
    if clock.jitter > max(THRESHOLDS.max_jitter, clock.tick * clock.rate):
        jitter = format_percent(clock.jitter)
        lines.append(f"{clock.column} is not uniform: steps deviate by {jitter} (rms)")
    return lines


# Where in a log what is doubtful lies: segments of its time.


MOST = 100
"""Marks of one kind in one channel; of more, the longest."""

DRIVEN = ("tau", "current", "duty")
"""What has a limit of the drive; that a position stays at an end is as a rule rest."""


@dataclass(frozen=True)
class Mark:
    """A segment of a log of which something is said.

    Attributes:
        kind: "gap", "back", "repeated", "missing", "limit" of what drives; of a robot also what
            none does: "spike", "frozen", "clipped", "wrap", "zero", "lost", "open".
        channel: that it is seen in.
        start, end: s; alike where it is one row.
        line: what it is.
    """

    kind: str
    channel: str
    start: float
    end: float
    line: str


def find_marks(seen: LogInspection) -> list[Mark]:
    """Finds gaps and faults of the clock, missing values, range ends at which a channel stays.

    Of a long log, of which not all rows are kept, the clock alone.
    """
    if seen.clock is None:
        return []
    marks = [*_mark_clock(seen)]
    if seen.time.size == seen.rows:
        marks += _mark_channels(seen)
    return keep_longest(marks)


def _mark_clock(seen: LogInspection) -> Iterator[Mark]:
    assert seen.clock is not None
    time, step = seen.steps
    usual, name = 1.0 / seen.clock.rate if seen.clock.rate > 0.0 else np.inf, seen.clock.column
    if seen.time.size == seen.rows:
        usual = find_usual_step(step, usual)
    for k in np.flatnonzero(step > GAP * usual):
        line = f"{name}: no rows for {step[k]:.4g} s"
        yield Mark("gap", name, float(time[k] - step[k]), float(time[k]), line)
    for k in np.flatnonzero(step < 0.0):
        line = f"{name} decreases by {-step[k]:.4g} s: sort or split the log"
        yield Mark("back", name, float(time[k]), float(time[k] - step[k]), line)
    for k in np.flatnonzero(step == 0.0):
        yield Mark("repeated", name, float(time[k]), float(time[k]), f"{name} is repeated")


def _mark_channels(seen: LogInspection) -> Iterator[Mark]:
    for channel, (name, values) in zip(seen.channels, seen.values.items(), strict=True):
        for start, end in _find_runs(np.isnan(values) & np.isfinite(seen.time), seen.time, 1):
            line = f"{channel.name} has no value for {end - start:.4g} s"
            yield Mark("missing", channel.name, start, end, line)
        for value, _ in channel.limits if guess_role(name) in DRIVEN else ():
            for start, end in _find_runs(values == value, seen.time, HELD):
                what = f"{value:.4g} {channel.unit}".rstrip()
                line = f"{channel.name} stays at its limit {what} for {end - start:.4g} s: clipped?"
                yield Mark("limit", channel.name, start, end, line)


def _find_runs(flags: np.ndarray, time: np.ndarray, least: int) -> Iterator[tuple[float, float]]:
    """First and last time of so many flagged rows one after the other; near ones are one."""
    rows = np.flatnonzero(flags)
    for run in np.split(rows, np.flatnonzero(np.diff(rows) > THRESHOLDS.max_merged_gap) + 1):
        if run.size >= least:
            yield float(time[run[0]]), float(time[run[-1]])


def keep_longest(marks: Iterable[Mark]) -> list[Mark]:
    """Returns marks in the order of time; of a kind in a channel the longest ones."""
    by: dict[tuple[str, str], list[Mark]] = {}
    for mark in marks:
        by.setdefault((mark.kind, mark.channel), []).append(mark)
    longest = [sorted(marks, key=lambda one: one.start - one.end)[:MOST] for marks in by.values()]
    return sorted((one for marks in longest for one in marks), key=lambda one: one.start)
