"""Times of rows: seconds and parts of a second in two columns; times that are coarser than rows."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.logs.columns import Column, NotNumericError
from modeler.logs.guess import guess_role

_SECONDS = re.compile(r"(?:(.*?)[._/ -]+)??(nano|n|micro|u)?_?s(?:ecs?|econds?)?", re.IGNORECASE)
_HUMP = re.compile(r"(?<=[a-z])(?=[A-Z])")
_PARTS = {"n": 1e-9, "u": 1e-6, "m": 1e-6}  # s, by the first letter
_UNEVEN = 1.5
"""Rows that a coarse time may come late or early: its rounding is one, a late row a half."""
_REPEATED = 0.05  # share of rows with the time before them: fewer are single faults
_LEAST_STEPS = 3  # of a coarse clock: fewer say nothing about a rate


@dataclass(frozen=True, eq=False)
class JoinedStamp:
    """Seconds and parts of a second as one time in s, counted from the first second.

    Attributes:
        seconds, fraction: the columns; the first is counted from its origin if it has one.
        unit: s, of the fraction.
    """

    seconds: Column
    fraction: Column
    unit: float

    @property
    def is_numeric(self) -> bool:
        """True, as both are."""
        return True

    @property
    def origin(self) -> float:
        """What it is counted from, s."""
        if (stated := getattr(self.seconds, "origin", None)) is not None:
            return float(stated)
        return float(np.nan_to_num(self.seconds.read_numbers()[:1]).sum())

    def read_numbers(self) -> np.ndarray:
        """(rows,) s: whole seconds are subtracted before the fraction is added."""
        part = self.unit * self.fraction.read_numbers()
        if (beyond := (part < 0.0) | (part >= 1.0)).any():
            raise NotNumericError(
                f", row {int(np.argmax(beyond)) + 1}: got {part[beyond][0]:.9g} s beside whole "
                "seconds; expected less than a second; say which column is the time, --map "
                "time=COLUMN"
            )
        is_counted = getattr(self.seconds, "origin", None) is not None
        return self.seconds.read_numbers() - (0.0 if is_counted else self.origin) + part


def find_stamp_pairs(names: Iterable[str]) -> dict[str, tuple[str, str, float]]:
    """Name of the time -> columns of its seconds and their parts, and the unit of these, s.

    >>> stamp_pairs(["header.stamp.sec", "header.stamp.nanosec", "q1"])
    {'header.stamp': ('header.stamp.sec', 'header.stamp.nanosec', 1e-09)}
    """
    by: dict[str, dict[str, str]] = {}
    for name in names:
        if match := _SECONDS.fullmatch(_HUMP.sub("_", name)):
            by.setdefault(match[1] or "", {}).setdefault((match[2] or "").lower()[:1], name)
    pairs = {}
    for stem, parts in by.items():
        fine = next((part for part in parts if part), "")
        if fine and "" in parts:
            timed = f"{stem}.time" if stem and guess_role(stem) != "time" else stem or "time"
            if timed not in names:
                pairs[timed] = (parts[""], parts[fine], _PARTS[fine])
    return pairs


def join_stamps(
    columns: Sequence[tuple[str, Column]],
) -> tuple[tuple[tuple[str, Column], ...], dict[str, str], tuple[str, ...]]:
    """Columns, and before two of a time the time that they are; its unit, what is told of it."""
    by_name, notes = dict(columns), list[str]()
    made: dict[str, tuple[str, JoinedStamp]] = {}
    for name, (seconds, fraction, unit) in find_stamp_pairs(by_name).items():
        both = by_name[seconds], by_name[fraction]
        if all(column.is_numeric for column in both):
            made[seconds] = name, JoinedStamp(*both, unit)
            notes.append(
                f"{name} is {seconds} + {unit:g} {fraction}, counted from the first second"
            )
    listed = list[tuple[str, Column]]()
    for name, column in columns:
        listed += [made[name]] if name in made else []
        listed.append((name, column))
    return tuple(listed), {name: "s" for name, _ in made.values()}, tuple(notes)


def find_first_seconds(names: Sequence[str], row: Mapping[str, str]) -> dict[str, int]:
    """What seconds of pairs are counted from: the first row of a file."""
    seconds = (column for column, *_ in find_stamp_pairs(names).values())
    return {name: int(float(row[name])) for name in seconds if _is_whole(row.get(name, ""))}


def _is_whole(text: str) -> bool:
    return re.fullmatch(r"\d{1,12}(?:\.0*)?", text) is not None


def describe_coarse_clock(time: np.ndarray, channels: Iterable[np.ndarray]) -> str:
    """What it means that times repeat because they are rounded, and what to do; else nothing.

    Rows are even if a rate tells every change of the time to a row and a half. A row that repeats
    all channels too was written twice.

    Args:
        time: (n,) s.
        channels: (n,) each, what was measured.
    """
    steps = np.diff(time)
    jumps, repeated = np.flatnonzero(steps > 0.0), steps == 0.0
    if jumps.size < _LEAST_STEPS or (steps < 0.0).any() or repeated.mean() < _REPEATED:
        return ""
    if not any((np.diff(values)[repeated] != 0.0).any() for values in channels):
        return ""
    description = f"times are rounded to {float(np.median(steps[jumps])):.3g} s and repeat"
    rows, since = (jumps - jumps[0]).astype(float), time[jumps + 1] - time[jumps[0] + 1]
    rate = _round_rate(rows[-1] - 1.0, rows[-1] + 1.0, float(since[-1]))
    if float(np.ptp(rows - rate * since)) > 2.0 * _UNEVEN:
        return f"{description}, and rows are not even; write times with more digits"
    return f"{description}; rows are even: give --map rate={rate:.10g}"


def _round_rate(low: float, high: float, span: float) -> float:
    """The rate of fewest digits that makes between `low` and `high` rows in so many seconds."""
    middle = 0.5 * (low + high) / span
    rates = (float(f"{middle:.{digits}g}") for digits in range(1, 10))
    return next((rate for rate in rates if low <= rate * span <= high), middle)
