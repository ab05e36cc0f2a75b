"""What is in a log: clock, channels, doubts; numbers only, whoever shows them."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.contract import JointSpec
from modeler.core.errors import DataError
from modeler.core.json_text import nulled
from modeler.core.presented import Presented
from modeler.logs.columns import Stream
from modeler.logs.guess import Guess, guesses
from modeler.logs.log_text import absent_roles, log_text, unlike_si
from modeler.logs.mapping import LogMap
from modeler.logs.rates import moves, rate_doubts
from modeler.logs.table import Table
from modeler.logs.units import unit_named

_GAP = 1.5  # of the median step
_HELD = 3  # rows in a row at the extreme value that make it a limit
_STUCK = 0.005  # share of the rows
_SLOW = 0.2  # share of rows in such runs, at any value, from which on a channel is only slow
_JITTER = 0.05


@dataclass(frozen=True)
class Clock:
    """The time of the rows.

    Attributes:
        column: in the file.
        rate: Hz, by the median step; NaN where most steps are 0.
        jitter: standard deviation of the steps without gaps, as a share of the median.
        gaps: steps of more than 1.5 medians; `lost` rows would fit into them.
        largest: gap, s; `at`: s, where it begins, NaN without any.
        repeated: steps of 0; `back`: steps to an earlier time.
        duration: s.
        tick: s; what the steps differ by at least, 0 if they lie on no grid.
    """

    column: str
    rate: float
    jitter: float
    gaps: int
    lost: int
    largest: float
    at: float
    repeated: int
    back: int
    duration: float
    tick: float


@dataclass(frozen=True)
class Channel:
    """One column with numbers.

    Attributes:
        name: as the user knows it: `pos[2] (q2)`.
        unit: stated or guessed, "" if nobody knows; `guessed` says which.
        low, high: of the values, in that unit; NaN without any.
        missing: rows without value.
        resolution: smallest step between values, 0 if there is no grid.
        limits: values at which it stays, with the share of rows: saturation.
        constant: True if it never changes.
    """

    name: str
    unit: str
    guessed: bool
    low: float
    high: float
    missing: int
    resolution: float
    limits: tuple[tuple[float, float], ...]
    constant: bool


@dataclass(frozen=True, eq=False)
class Look(Presented):
    """All that a log shows by itself.

    Attributes:
        name: of the file.
        rows: of it.
        clock: None if no column is a time.
        channels: in the order of the file.
        streams: topics or groups.
        notes: of reading.
        doubts: what contradicts itself or looks like another unit.
        suggested: a [log] to paste, guessed; "" if a mapping is there already.
        plain: the same without what ranges say of positions.
        ranged: doubts about positions that rest on their range alone.
        time: (n,) s, or row numbers without a clock.
        values: (n,) of every channel, in its unit.
    """

    name: str

    rows: int
    clock: Clock | None
    channels: tuple[Channel, ...]
    streams: tuple[Stream, ...]
    notes: tuple[str, ...]
    doubts: tuple[str, ...]
    suggested: str
    plain: str
    ranged: tuple[str, ...]
    time: np.ndarray
    values: Mapping[str, np.ndarray]

    def to_json(self) -> dict[str, Any]:
        """Plain data, without the values; a number that is not there is null."""
        return nulled({
            "log": self.name,
            "rows": self.rows,
            "clock": None if self.clock is None else dataclasses.asdict(self.clock)
            | {"tick": self.clock.tick or None},
            "channels": [dataclasses.asdict(channel) | {"resolution": channel.resolution or None}
                         for channel in self.channels],
            "streams": [dataclasses.asdict(stream) for stream in self.streams],
            "notes": list(self.notes),
            "doubts": list(self.doubts),
            "suggested": self.suggested,
        })  # fmt: skip


def look(
    table: Table,
    mapping: LogMap,
    joints: Sequence[JointSpec] = (),
    span: tuple[float | None, float | None] = (None, None),
) -> Look:
    """What is in a log.

    Args:
        table: of the file, read with `mapping`.
        mapping: stated by the user; what it leaves open is guessed.
        joints: of the robot, if it is known.
        span: only the rows from one time to another, s.

    Raises:
        DataError: no rows in that span, or a time column without values.
    """
    values = {name: table.measured(name) for name in table.names if table.is_numeric(name)}
    values = _within(table, values, span, joints)
    found = guesses(values, {n: table.unit(n) for n in values if table.unit(n)}, joints)
    units = {n: u for one in found for n, u in zip(one.columns, one.units, strict=True) if u}
    time, clock = _clock(table, values, found)
    shown = {name: table.in_unit(name, v) for name, v in values.items()}
    channels = tuple(_channel(table, name, v, units.get(name, "")) for name, v in shown.items())
    pairs = _pairs(found)
    doubts = [*_of_clock(clock), *absent_roles(found), *unlike_si(found)]
    doubts += [*rate_doubts(pairs, values, time), *_dead(channels, shown, values, pairs)]
    bare = [one.without_range() if one.own in ("q", "qc") else one for one in found]
    suggested, plain = ("" if mapping.layers else log_text(f, joints, tuple(values))
                        for f in (found, bare))  # fmt: skip
    ranged = tuple(line for line in unlike_si(found) if line not in unlike_si(bare))
    return Look(
        table.path.name, len(time), clock, channels, table.found.streams, table.notes,
        tuple(doubts), suggested, plain, ranged, time, shown,
    )  # fmt: skip


def _pairs(found: Sequence[Guess]) -> list[tuple[str, str]]:
    """Columns of position and speed of the joints that have both."""
    by = {one.own: dict(zip(one.labels, one.columns, strict=True)) for one in found}
    positions, speeds = by.get("q", {}), by.get("qd", {})
    return [(q, speeds[label]) for label, q in positions.items() if label in speeds]


def _dead(
    channels: Sequence[Channel], names: Iterable[str],
    values: Mapping[str, np.ndarray], pairs: Sequence[tuple[str, str]],
) -> list[str]:  # fmt: skip
    """Channels that never change, but for the speed 0 of a joint that rests."""
    rest = {speed for position, speed in pairs if not moves(values[position])}
    return [
        f"{channel.name} never changes: is it connected?"
        for channel, name in zip(channels, names, strict=True)
        if channel.constant and not (name in rest and channel.low == 0.0)
    ]


def _within(
    table: Table,
    values: dict[str, np.ndarray],
    span: tuple[float | None, float | None],
    joints: Sequence[JointSpec],
) -> dict[str, np.ndarray]:
    """The rows of a span of time."""
    if span == (None, None):
        return values
    time, clock = _clock(table, values, guesses(values, {}, joints))
    low, high = (-np.inf, np.inf)
    if span[0] is not None:
        low = span[0]
    if span[1] is not None:
        high = span[1]
    rows = (time >= low) & (time < high)
    if clock is None or rows.sum() < 2:
        raise DataError(
            f"{table.path}: fewer than two rows from {low:g} to {high:g} s; its times go from "
            f"{np.nanmin(time):g} to {np.nanmax(time):g} s"
        )
    return {name: v[rows] for name, v in values.items()}


def _clock(
    table: Table, values: Mapping[str, np.ndarray], found: Sequence[Guess]
) -> tuple[np.ndarray, Clock | None]:
    guess = next((one for one in found if one.own == "time"), None)
    name = guess.columns[0] if guess is not None else "time"
    if name not in values:
        return np.arange(len(next(iter(values.values()), ())), dtype=float), None
    time = values[name]
    if guess is not None and guess.units[0] and not table.unit(name):
        time = time * unit_named(guess.units[0]).factor
    known = time[np.isfinite(time)]
    steps = np.diff(known)
    if not len(steps):
        raise DataError(f"{table.path}: column {name} has no values; expected the time of each row")
    step = float(np.median(steps))
    even = steps[(steps > 0.0) & (steps <= _GAP * step)]
    gaps = np.flatnonzero(steps > _GAP * step) if step > 0.0 else np.array([], dtype=int)
    widest = int(gaps[np.argmax(steps[gaps])]) if gaps.size else 0
    return time, Clock(
        column=table.called(name),
        rate=1.0 / step if step > 0.0 else np.nan,
        jitter=float(np.std(even)) / step if even.size and step > 0.0 else np.nan,
        gaps=int(gaps.size),
        lost=int(np.sum(np.round(steps[gaps] / step) - 1.0)) if gaps.size else 0,
        largest=float(steps[widest]) if gaps.size else 0.0,
        at=float(known[widest]) if gaps.size else np.nan,
        repeated=int(np.sum(steps == 0.0)),
        back=int(np.sum(steps < 0.0)),
        duration=float(known.max() - known.min()),
        tick=_tick(even, step),
    )


def _tick(steps: np.ndarray, step: float) -> float:
    """What steps of a clock differ by, if they are whole multiples apart; else 0."""
    off = np.abs(steps - step)
    off = off[off > 1e-4 * step]
    if not off.size:
        return 0.0
    tick = float(off.min())
    return tick if np.quantile(np.abs(off / tick - np.round(off / tick)), 0.9) < 0.05 else 0.0


def _channel(table: Table, name: str, values: np.ndarray, guessed: str) -> Channel:
    finite = values[np.isfinite(values)]
    stated = table.unit(name)
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (np.nan, np.nan)
    return Channel(
        name=table.called(name),
        unit=stated or guessed,
        guessed=not stated and bool(guessed),
        low=low,
        high=high,
        missing=int(values.size - finite.size),
        resolution=_resolution(finite),
        limits=_limits(finite, low, high),
        constant=bool(finite.size and low == high),
    )


def _resolution(values: np.ndarray) -> float:
    """The step of the grid that the values lie on; 0 if they lie on none."""
    levels = np.unique(values)
    if len(levels) < 3:
        return 0.0
    steps = np.diff(levels)
    steps = steps[steps > 1e-9 * (levels[-1] - levels[0])]  # what rounding parts is one level
    step = float(np.quantile(steps, 0.01, method="lower"))
    off = np.abs(steps / step - np.round(steps / step))
    return step if float(np.quantile(off, 0.9)) < 0.05 else 0.0


def _limits(values: np.ndarray, low: float, high: float) -> tuple[tuple[float, float], ...]:
    """Ends of the range at which the values stay for some rows, and for which share of all.

    Not at the beginning or the end, where a robot stands still; and not of a channel that stays
    anywhere, because it is slower than the log.
    """
    if not low < high:
        return ()
    edges = np.flatnonzero(np.diff(values)) + 1  # where another value begins
    starts, ends = edges[:-1], edges[1:]
    lengths = ends - starts
    long = lengths >= _HELD
    if lengths[long].sum() > _SLOW * values.size:
        return ()
    found = []
    for end in (low, high):
        rows = int(lengths[long & (values[starts] == end)].sum())
        if rows > _STUCK * values.size:
            found.append((end, rows / values.size))
    return tuple(found)


def _of_clock(clock: Clock | None) -> list[str]:
    """What a clock should not do."""
    if clock is None:
        return ["no column looks like the time: name it with --map time=COLUMN, or give --map rate"]
    lines = []
    if clock.back:
        lines.append(f"{clock.column} goes back in {clock.back} rows: sort or split the log")
    if clock.repeated:
        lines.append(f"{clock.column} repeats itself in {clock.repeated} rows: delete them")
    if clock.gaps:
        lines.append(
            f"{clock.column} has {clock.gaps} gap{'s' * (clock.gaps > 1)}, the widest "
            f"{clock.largest:.4g} s at {clock.at:.4g} s"
        )
    if clock.jitter > max(_JITTER, clock.tick * clock.rate):
        lines.append(f"{clock.column} is uneven: its steps differ by {clock.jitter:.0%}")
    return lines
