"""What is in a log: clock, channels, doubts; numbers only, whoever shows them."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations
from typing import Any

import numpy as np

from modeler.core.contract import JointSpec
from modeler.core.errors import DataError
from modeler.core.presented import Presented
from modeler.logs.columns import Stream
from modeler.logs.guess import RATES, Guess, guesses, log_text
from modeler.logs.mapping import LogMap
from modeler.logs.table import Table
from modeler.logs.units import unit_named

_GAP = 1.5  # of the median step
_LIKE = 0.95  # correlation from which on a speed is the derivative of a position
_NEAR = 0.1  # relative; of a ratio that is a matter of units
_HELD = 3  # rows in a row at the extreme value that make it a limit
_STUCK = 0.005  # share of the rows
_SLOW = 0.2  # share of rows in such runs, at any value, from which on a channel is only slow
_JITTER = 0.05


@dataclass(frozen=True)
class Clock:
    """The time of the rows.

    Attributes:
        column: in the file.
        rate: Hz, by the median step.
        jitter: standard deviation of the steps without gaps, as a share of the median.
        gaps: steps of more than 1.5 medians; `lost` rows would fit into them.
        largest: gap, s; `at`: s, where it begins.
        repeated: steps of 0; `back`: steps to an earlier time.
        duration: s.
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
    time: np.ndarray
    values: Mapping[str, np.ndarray]

    def to_json(self) -> dict[str, Any]:
        """Plain data, without the values; a number that is not there is null."""
        return {
            "log": self.name,
            "rows": self.rows,
            "clock": None if self.clock is None else dataclasses.asdict(self.clock),
            "channels": [_plain(dataclasses.asdict(channel)) for channel in self.channels],
            "streams": [dataclasses.asdict(stream) for stream in self.streams],
            "notes": list(self.notes),
            "doubts": list(self.doubts),
            "suggested": self.suggested,
        }


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
    units = {name: one.unit for one in found for name in one.columns if one.unit}
    time, clock = _clock(table, values, found)
    shown = {name: table.in_unit(name, v) for name, v in values.items()}
    channels = tuple(_channel(table, name, v, units.get(name, "")) for name, v in shown.items())
    doubts = [*_of_clock(clock), *_units(found), *_rates(found, values, time)]
    doubts += [
        f"{channel.name} never changes: is it connected?" for channel in channels
        if channel.constant
    ]  # fmt: skip
    suggested = "" if mapping.layers else log_text(found, joints)
    return Look(
        table.path.name, len(time), clock, channels, table.found.streams, table.notes,
        tuple(doubts), suggested, time, shown,
    )  # fmt: skip


def _plain(channel: dict[str, Any]) -> dict[str, Any]:
    unlike = {k: None for k, v in channel.items() if isinstance(v, float) and not np.isfinite(v)}
    return channel | unlike


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
    if guess is not None and guess.unit and not table.unit(name):
        time = time * unit_named(guess.unit).factor
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
        rate=1.0 / step if step > 0.0 else 0.0,
        jitter=float(np.std(even)) / step if even.size and step > 0.0 else 0.0,
        gaps=int(gaps.size),
        lost=int(np.sum(np.round(steps[gaps] / step) - 1.0)) if gaps.size else 0,
        largest=float(steps[widest]) if gaps.size else 0.0,
        at=float(known[widest]) if gaps.size else 0.0,
        repeated=int(np.sum(steps == 0.0)),
        back=int(np.sum(steps < 0.0)),
        duration=float(known.max() - known.min()),
    )


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
    if len(levels) < 3 or len(levels) > 0.8 * len(values):
        return 0.0
    steps = np.diff(levels)
    step = float(np.median(steps[steps <= 2.0 * np.quantile(steps, 0.25)]))
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
            f"{clock.column} has {clock.gaps} gaps, the widest {clock.largest:.4g} s at "
            f"{clock.at:.4g} s"
        )
    if clock.jitter > _JITTER:
        lines.append(f"{clock.column} is uneven: its steps differ by {clock.jitter:.0%}")
    return lines


def _units(found: Sequence[Guess]) -> list[str]:
    """Columns whose range looks like another unit than SI, where nobody states one."""
    lines = []
    for one in found:
        if one.why != "by its range":
            continue
        columns = one.columns[0] if len(one.columns) == 1 else one.template.replace("{}", "*")
        what = "counts of an encoder" if one.unit == "rev/COUNTS" else one.unit
        lines.append(f"{columns} looks like {what}, by its range; say so in [log] or with --map")
    return lines


def _rates(found: Sequence[Guess], values: Mapping[str, np.ndarray], time: np.ndarray) -> list[str]:
    """Speeds that are not the derivative of their position: unit, sign, order."""
    by = {one.own: one for one in found}
    if "q" not in by or "qd" not in by or len(by["q"].columns) != len(by["qd"].columns):
        return []
    with np.errstate(all="ignore"):
        slopes = [np.gradient(values[name], time) for name in by["q"].columns]
    speeds = [values[name] for name in by["qd"].columns]
    lines, like = [], np.array([[_alike(a, b) for b in speeds] for a in slopes])
    for j, name in enumerate(by["qd"].columns):
        position = by["q"].columns[j]
        if abs(like[j, j]) < _LIKE:
            other = int(np.argmax(np.abs(like[:, j])))
            if other != j and abs(like[other, j]) > _LIKE:
                lines.append(
                    f"{name} is the derivative of {by['q'].columns[other]}, not of {position}: are "
                    "columns exchanged?"
                )
            elif np.isfinite(like[j, j]):
                lines.append(
                    f"{name} is not the derivative of {position} (correlation {like[j, j]:.2f})"
                )
            continue
        line = _ratio(name, position, slopes[j], speeds[j])
        if line:
            lines.append(line)
    return lines


def _alike(a: np.ndarray, b: np.ndarray) -> float:
    both = np.isfinite(a) & np.isfinite(b)
    if both.sum() < 10 or not a[both].std() > 0.0 or not b[both].std() > 0.0:
        return np.nan
    return float(np.corrcoef(a[both], b[both])[0, 1])


def _ratio(name: str, position: str, slope: np.ndarray, speed: np.ndarray) -> str:
    """What a speed is times the derivative of its position, if not 1, and what that looks like."""
    both = np.isfinite(slope) & np.isfinite(speed)
    size = float(slope[both] @ slope[both])
    if not 0.0 < size < np.inf:
        return ""
    ratio = float(slope[both] @ speed[both]) / size
    if abs(ratio - 1.0) < _NEAR:
        return ""
    if abs(ratio + 1.0) < _NEAR:
        return f"{name} has the other sign of the derivative of {position}"
    pairs = [
        (abs(abs(ratio) * RATES[b] / RATES[a] - 1.0), a.removesuffix("/s"), b)
        for a, b in permutations(RATES, 2)
        if a != "rpm"
    ]
    off, first, second = min(pairs)
    words = f": {position} in {first} and {name} in {second}?" if off < _NEAR else ""
    return f"{name} is {ratio:.3g} times the derivative of {position}{words}"
