"""Dates and times of day, as texts or as Arrow has them, in seconds from the first of a file."""

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from modeler.logs.columns import NotNumbers

_PATTERN = (
    r"^\s*(?:(?P<y>\d{4})[-/.](?P<m>\d{1,2})[-/.](?P<d>\d{1,2})"
    r"|(?P<a>\d{1,2})(?P<s>[./-])(?P<b>\d{1,2})[./-](?P<c>\d{4}))?[T ]*"
    r"(?:(?P<H>\d{1,2}):(?P<M>\d{2}):(?P<S>\d{2}(?:[.,]\d+)?)\s*(?P<p>[AaPp][Mm])?)?"
    r"\s*(?:Z|UTC|[+-]\d{2}:?\d{2})?\s*$"
)
"""`2024-05-01T12:00:00.25+02:00`, `01.05.2024 12:00:00,25`, `5/1/2024 1:02:03.4 PM`, `12:00:00`."""

_DAY = 86400.0  # s
_EXACT = 2**53  # whole numbers beyond it are no floats
_EPOCH_NS = (10**18, 4 * 10**18)  # 2001 to 2096
_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def is_clock(text: str) -> bool:
    """True of a date or a time of day."""
    match = re.match(_PATTERN, text.strip('" '))
    return match is not None and any(match[key] for key in ("y", "c", "H"))


def first_moment(text: str) -> tuple[int, float]:
    """Day since 1970, or 0, and second of that day, of one text."""
    days, seconds = _parts(pa.chunked_array([[text.strip('" ')]]))
    return int(days[0]), float(seconds[0])


Origin = tuple[int, float] | int | None
"""What times are counted from: day and second, a whole number in the unit of the column, 0."""


def seconds_between(later: Origin, first: Origin) -> float:
    """From one origin to another of the same kind."""
    if isinstance(later, tuple) and isinstance(first, tuple):
        return (later[0] - first[0]) * _DAY + later[1] - first[1]
    whole = isinstance(later, int) and isinstance(first, int)
    return float(later - first) if whole else 0.0  # type: ignore[operator]


def seconds_from(column: pa.ChunkedArray, first: tuple[int, float], before: int) -> np.ndarray:
    """(n,) seconds of texts from a first moment on; the zone of a file is one, so it is not asked.

    Args:
        column: of texts; what is missing is NaN.
        first: day and second that are counted from.
        before: rows of the file that stand before it.

    Raises:
        NotNumbers: a text that is no time; names its row.
    """
    days, seconds = _parts(column)
    known = np.array(column.is_valid())
    empty = np.array(pc.fill_null(pc.equal(pc.utf8_trim_whitespace(column), ""), True))
    if (wrong := np.isnan(seconds) & known & ~empty).any():
        row = int(np.argmax(wrong))
        raise NotNumbers(
            f', row {before + row + 1}: got "{column[row].as_py()}"; expected a time as in the '
            "other rows; correct it, or delete the row"
        )
    return np.where(empty, np.nan, (days - first[0]) * _DAY + (seconds - first[1]))


def _parts(column: pa.ChunkedArray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) days since 1970 and seconds of the day."""
    found = pc.extract_regex(column, _PATTERN)

    def number(key: str) -> np.ndarray:
        texts = pc.replace_substring(pc.struct_field(found, key), ",", ".")
        filled = pc.if_else(pc.equal(texts, ""), "0", texts)
        return np.array(pc.cast(filled, pa.float64()).to_numpy(), dtype=float)

    hours, first, second = number("H"), number("a"), number("b")
    half = np.array(pc.fill_null(pc.utf8_lower(pc.struct_field(found, "p")), "").to_pylist())
    hours = np.where(half == "", hours, hours % 12 + 12 * (half == "pm"))
    seconds = hours * 3600.0 + number("M") * 60.0 + number("S")
    if not (np.nanmax(number("y"), initial=0) or np.nanmax(number("c"), initial=0)):
        return np.zeros(len(seconds)), seconds
    american = "/" in pc.struct_field(found, "s").to_pylist() and np.nanmax(first) <= 12
    year = number("y") + number("c")
    month = number("m") + (first if american else second)
    day = number("d") + (second if american else first)
    there = ~np.isnan(year) & (month >= 1)
    start = (np.where(there, (year - 1970) * 12 + month - 1, 0)).astype("M8[M]").astype("M8[D]")
    return start.astype(float) + np.where(there, day - 1, 0), seconds


def origins_of(table: pa.Table) -> dict[str, int]:
    """What columns of times are counted from, as they state it: the first value of each.

    These are timestamps, durations, times of day, and whole numbers that no float holds.
    """
    found = {}
    for name, column in zip(table.column_names, table.columns, strict=True):
        whole = _whole(column.slice(0, 1))
        first = whole[0].as_py() if whole is not None and len(whole) else None
        if first is not None and (is_moment(column.type) or is_beyond(first) or name == "index"):
            found[name] = first
    return found


def is_beyond(number: int) -> bool:
    """True of a whole number that no float holds, as nanoseconds since 1970 are."""
    return abs(number) > _EXACT


def is_moment(kind: pa.DataType) -> bool:
    """True of the types of times that Arrow has."""
    t = pa.types
    return any(is_one(kind) for is_one in (t.is_timestamp, t.is_duration, t.is_time, t.is_date))


def _whole(column: pa.ChunkedArray) -> pa.ChunkedArray | None:
    """Its whole numbers; None of what has none."""
    if pa.types.is_integer(column.type):
        return column
    if not is_moment(column.type):
        return None
    narrow = column.type.bit_width == 32
    return pc.cast(pc.cast(column, pa.int32()) if narrow else column, pa.int64())


def counted(column: pa.ChunkedArray, origin: int) -> np.ndarray:
    """(n,) from an origin on: seconds of a time, whole numbers as they are."""
    kind = column.type
    steps = pc.cast(pc.subtract(_whole(column), origin), pa.float64(), safe=False)
    unit = _DAY if kind == pa.date32() else _SECONDS.get(getattr(kind, "unit", ""), 1.0)
    if pa.types.is_integer(kind):
        unit = 1.0
    elif kind == pa.date64():
        unit = 1e-3
    return np.array(steps.to_numpy(), dtype=float) * unit


def stated_units(table: pa.Table, origins: Mapping[str, Any]) -> dict[str, str]:
    """`ns` for whole numbers that are nanoseconds since 1970."""
    low, high = _EPOCH_NS
    kinds = zip(table.column_names, table.columns, strict=True)
    return {
        n: "ns" for n, c in kinds if pa.types.is_integer(c.type) and low < origins.get(n, 0) < high
    }
