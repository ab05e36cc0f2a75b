"""What every format gives: named columns of one length, read when they are requested."""

import errno
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import lazy_loader
import numpy as np
import pyarrow as pa

from modeler.core.errors import DataError, is_out_of_memory, suggest_install
from modeler.core.files import PACKED, UNPACKED
from modeler.logs.guess import guess_role
from modeler.logs.thresholds import THRESHOLDS


class Column:
    """One column: whether it holds numbers, and those."""

    @property
    def origin(self) -> float | None:
        """Returns what a time is counted from; None of what is none."""
        return None

    @property
    def is_time(self) -> bool:
        """Returns True of dates and times of day, which nothing but `time` may be."""
        return False

    @property
    def is_numeric(self) -> bool:
        """Returns True if it holds numbers, or nothing at all."""
        return True

    def read_numbers(self) -> np.ndarray:
        """Returns (rows,) floats, a copy; what is missing is NaN.

        Raises:
            NotNumbers: it holds something else.
        """
        raise NotImplementedError


class NotNumericError(Exception):
    """Why a column has no numbers: what follows "column NAME", and what to do."""


@dataclass(frozen=True)
class Stream:
    """A part of a file that was recorded by itself: a topic, a group.

    Attributes:
        name: as `topic` takes it.
        kind: of what it holds: the type of its messages.
        rows: how many.
        is_clock: True if its rows are those of the columns.
    """

    name: str
    kind: str
    rows: int
    is_clock: bool = False


@dataclass(frozen=True)
class Columns:
    """The columns that a file holds.

    Attributes:
        columns: (name, column), in the order of the file; a name may stand twice.
        rows: of every column.
        units: that the file states: name -> text.
        notes: what was left out or joined, one sentence each.
        reading_notes: how it was read, one sentence each: nothing to warn of.
        streams: topics or groups, if the file has such.
        rate: Hz, that the file states of its rows; None if it does not.
    """

    columns: tuple[tuple[str, Column], ...]
    rows: int
    units: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    reading_notes: tuple[str, ...] = field(default=(), kw_only=True)
    streams: tuple[Stream, ...] = ()
    rate: float | None = None


@dataclass(frozen=True)
class ColumnRequest:
    """What of a file is wanted.

    Attributes:
        topic: the part that holds the motion; "" if there is one only.
        any: True: take the likeliest part rather than asking which.
        files: of a log in several files, our name -> how the name of the file ends.
    """

    topic: str = ""
    any: bool = False
    files: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ColumnValues(Column):
    """A column that is in memory already."""

    values: np.ndarray

    @property
    def is_numeric(self) -> bool:
        """Returns True for integers and floats."""
        return self.values.dtype.kind in "iuf"

    def read_numbers(self) -> np.ndarray:
        """Returns a copy as floats."""
        return np.array(self.values, dtype=float)


@contextmanager
def wrap_read_errors(path: Path, what: str, advice: str = "write the file again") -> Iterator[None]:
    """Raises whatever another's reader raises about a damaged file as one line.

    Raises:
        DataError: it raised anything; the file is at fault.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    except DataError:
        raise
    except Exception as error:  # a flipped bit takes these readers anywhere
        raise make_read_error(path, what, error, advice) from None


def make_read_error(path: Path, what: str, error: Exception, advice: str) -> DataError:
    """Returns the error for what another's reader raised, as one line."""
    short = is_out_of_memory(error)
    if short and (path.is_dir() or path.stat().st_size > UNPACKED / PACKED):
        return DataError(
            f"{path}: not enough memory; expected {what} that fits; raise the "
            "limit (ulimit -v) or free some"
        )
    words = " ".join(str(error).split(": (")[0].split())[:200] or "its structure is broken"
    if short or isinstance(error, OverflowError) or getattr(error, "errno", None) == errno.EINVAL:
        words = "it states a length or a place that no file has"
    return DataError(
        f"{path}: cannot be read as {what}: damaged, or another kind of file ({words}); {advice}"
    )


READERS = {"h5py": "hdf5", "rosbags": "rosbags", "python-calamine": "excel"}
"""Packages that read a format, and the extra that installs them."""


def make_package_error(path: Path, what: str, package: str) -> DataError:
    """Returns the error of a format whose reader is not installed."""
    part = READERS.get(package, package)
    return DataError(f"{path}: {what} needs the package {package}; run: {suggest_install(part)}")


# Times of rows: dates, times of day, seconds with parts, times coarser than rows.


_SECONDS = re.compile(r"(?:(.*?)[._/ -]+)??(nano|n|micro|u)?_?s(?:ecs?|econds?)?", re.IGNORECASE)
_HUMP = re.compile(r"(?<=[a-z])(?=[A-Z])")
_PARTS = {"n": 1e-9, "u": 1e-6, "m": 1e-6}  # s, by the first letter


@dataclass(frozen=True, eq=False)
class JoinedStamp(Column):
    """Seconds and parts of a second as one time in s, counted from the first second.

    Attributes:
        seconds, fraction: the columns; the first is counted from its origin if it has one.
        unit: s, of the fraction.
    """

    seconds: Column
    fraction: Column
    unit: float

    @property
    def origin(self) -> float:
        """Returns what it is counted from, s."""
        if (stated := self.seconds.origin) is not None:
            return float(stated)
        return float(np.nan_to_num(self.seconds.read_numbers()[:1]).sum())

    def read_numbers(self) -> np.ndarray:
        """Returns (rows,) s: whole seconds are subtracted before the fraction is added."""
        part = self.unit * self.fraction.read_numbers()
        if (beyond := (part < 0.0) | (part >= 1.0)).any():
            raise NotNumericError(
                f", row {int(np.argmax(beyond)) + 1}: got {part[beyond][0]:.9g} s beside whole "
                "seconds; expected less than a second; say which column is the time, --map "
                "time=COLUMN"
            )
        convert_times = self.seconds.origin is not None
        return self.seconds.read_numbers() - (0.0 if convert_times else self.origin) + part


def find_stamp_pairs(names: Iterable[str]) -> dict[str, tuple[str, str, float]]:
    """Finds {time: (column of its seconds, column of their parts, unit of these in s)}.

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
    """Returns the columns, a time before the two that make it; its unit, notes on it."""
    by_name, notes = dict(columns), list[str]()
    made: dict[str, tuple[str, JoinedStamp]] = {}
    for name, (seconds, fraction, unit) in find_stamp_pairs(by_name).items():
        both = by_name[seconds], by_name[fraction]
        if all(column.is_numeric for column in both):
            made[seconds] = name, JoinedStamp(*both, unit)
            stamp = f"{seconds} + {unit:g} {fraction}"
            notes.append(f"{name} is {stamp}, counted from the first second")
    listed = list[tuple[str, Column]]()
    for name, column in columns:
        listed += [made[name]] if name in made else []
        listed.append((name, column))
    return tuple(listed), {name: "s" for name, _ in made.values()}, tuple(notes)


def find_first_seconds(names: Sequence[str], row: Mapping[str, str]) -> dict[str, int]:
    """Returns what seconds of pairs are counted from: the first row of a file."""
    seconds = (column for column, *_ in find_stamp_pairs(names).values())
    return {name: int(float(row[name])) for name in seconds if _is_whole(row.get(name, ""))}


def _is_whole(text: str) -> bool:
    return re.fullmatch(r"\d{1,12}(?:\.0*)?", text) is not None


def describe_coarse_clock(time: np.ndarray, channels: Iterable[np.ndarray]) -> str:
    """Returns what it means that times repeat because they are rounded, and what to do.

    Else nothing.

    Rows are even if a rate shows every change of the time to a row and a half. A row that repeats
    all channels too was written twice.

    Args:
        time: (n,) s.
        channels: (n,) each, what was measured.
    """
    steps = np.diff(time)
    jumps, repeated = np.flatnonzero(steps > 0.0), steps == 0.0
    if (
        jumps.size < THRESHOLDS.min_clock_steps
        or (steps < 0.0).any()
        or repeated.mean() < THRESHOLDS.min_repeated_share
    ):
        return ""
    if not any((np.diff(values)[repeated] != 0.0).any() for values in channels):
        return ""
    description = f"times are rounded to {float(np.median(steps[jumps])):.3g} s and repeat"
    rows, since = (jumps - jumps[0]).astype(float), time[jumps + 1] - time[jumps[0] + 1]
    rate = _round_rate(rows[-1] - 1.0, rows[-1] + 1.0, float(since[-1]))
    if float(np.ptp(rows - rate * since)) > 2.0 * THRESHOLDS.max_row_offset:
        return f"{description}, and rows are not even; write times with more digits"
    return f"{description}; rows are even: give --map rate={rate:.10g}"


def _round_rate(low: float, high: float, span: float) -> float:
    """The rate of fewest digits that makes between `low` and `high` rows in so many seconds."""
    middle = 0.5 * (low + high) / span
    rates = (float(f"{middle:.{digits}g}") for digits in range(1, 10))
    return next((rate for rate in rates if low <= rate * span <= high), middle)


# Dates and times of day, as texts or as Arrow has them, in seconds from the first of a file.


pc: Any = lazy_loader.load("pyarrow.compute", suppress_warning=True)  # it takes long

_PATTERN = (
    r"^\s*(?:(?P<y>\d{4})[-/.](?P<m>\d{1,2})[-/.](?P<d>\d{1,2})"
    r"|(?P<a>\d{1,2})(?P<s>[./-])(?P<b>\d{1,2})[./-](?P<c>\d{4}))?[T ]*"
    r"(?:(?P<H>\d{1,2}):(?P<M>\d{2}):(?P<S>\d{2}(?:[.,]\d+)?)\s*(?P<p>[AaPp][Mm])?)?"
    r"\s*(?:Z|UTC|[+-]\d{2}:?\d{2})?\s*$"
)
"""`2024-05-01T12:00:00.25+02:00`, `01.05.2024 12:00:00,25`, `5/1/2024 1:02:03.4 PM`, `12:00:00`."""

_DAY = 86_400 * 10**9  # ns
_EXACT = 2**53  # whole numbers beyond it are no floats
_EPOCH_NS = (10**18, 4 * 10**18)  # 2001 to 2096


def is_clock(text: str) -> bool:
    """Returns True of a date or a time of day."""
    match = re.match(_PATTERN, text)
    return match is not None and any(match[key] for key in ("y", "c", "H"))


def parse_moment(text: str) -> int:
    """Returns the nanoseconds of one text, since 1970 or of a day."""
    return int(_parse_nanoseconds(pa.chunked_array([[text]]), 0)[0][0])


def is_beyond(number: int) -> bool:
    """Returns True of a whole number that no float holds, as nanoseconds since 1970 are."""
    return abs(number) > _EXACT


def is_moment(kind: pa.DataType) -> bool:
    """Returns True of the types of times that Arrow has."""
    t = pa.types
    return any(is_one(kind) for is_one in (t.is_timestamp, t.is_duration, t.is_time, t.is_date))


def convert_times(column: pa.ChunkedArray, origin: int, before: int) -> np.ndarray:
    """Returns (n,) numbers from an origin on: s of times, whole numbers as they are.

    Missing is NaN.

    Args:
        column: of texts, of times, of whole numbers. The zone of a file is one: it is not asked.
        origin: what they are counted from, ns.
        before: rows of the file that stand before it.

    Raises:
        NotNumbers: a text that is no time; names its row.
    """
    if pa.types.is_string(column.type):
        whole, missing = _parse_nanoseconds(column, before)
        return np.where(missing, np.nan, (whole - origin) * 1e-9)
    steps = pc.cast(pc.subtract(_convert_to_whole(column), origin), pa.float64(), safe=False)
    return np.array(steps.to_numpy()) * (1e-9 if is_moment(column.type) else 1.0)


def _parse_nanoseconds(column: pa.ChunkedArray, before: int) -> tuple[np.ndarray, np.ndarray]:
    """(n,) nanoseconds of texts, and whether they are missing."""
    fields = pc.extract_regex(column, _PATTERN)

    def get_text(key: str) -> pa.ChunkedArray:
        return pc.fill_null(pc.struct_field(fields, key), "")

    def get_number(key: str) -> np.ndarray:
        texts = pc.replace_substring(get_text(key), ",", ".")
        return pc.cast(pc.if_else(pc.equal(texts, ""), "0", texts), pa.float64()).to_numpy()

    missing = np.array(pc.equal(pc.utf8_trim_whitespace(pc.fill_null(column, "")), ""))
    if (wrong := np.array(pc.is_null(fields)) & ~missing).any():
        row = int(np.argmax(wrong))
        raise NotNumericError(
            f', row {before + row + 1}: got "{column[row].as_py()}"; expected a time as in the '
            "other rows; correct it, or delete the row"
        )
    half = np.array(pc.utf8_lower(get_text("p")).to_pylist())
    hours = np.where(half == "", get_number("H"), get_number("H") % 12 + 12 * (half == "pm"))
    seconds = hours * 3600.0 + get_number("M") * 60.0 + get_number("S")
    first, second, year = get_number("a"), get_number("b"), get_number("y") + get_number("c")
    american = "/" in get_text("s").to_pylist() and first.max() <= 12
    month = get_number("m") + (first if american else second)
    day = get_number("d") + (second if american else first)
    months = np.where(year > 0, (year - 1970) * 12 + month - 1, 0).astype("M8[M]")
    days = months.astype("M8[D]").astype(np.int64) + np.where(year > 0, day - 1, 0).astype(np.int64)
    return days * _DAY + np.rint(seconds * 1e9).astype(np.int64), missing


def find_origins(table: pa.Table) -> dict[str, int]:
    """Returns what columns of times are counted from: the first value of each.

    These are timestamps, durations, times of day, and whole numbers that no float holds.
    """
    origins = {}
    counted = {"index", *(seconds for seconds, *_ in find_stamp_pairs(table.column_names).values())}
    for name, column in zip(table.column_names, table.columns, strict=True):
        is_second = name in counted and pa.types.is_floating(column.type)
        whole = pc.floor(column.slice(0, 1)) if is_second else _convert_to_whole(column.slice(0, 1))
        first = whole[0].as_py() if whole is not None and len(whole) else None
        if first is not None and (is_moment(column.type) or is_beyond(first) or name in counted):
            origins[name] = int(first)
    return origins


def _convert_to_whole(column: pa.ChunkedArray) -> pa.ChunkedArray | None:
    """Its whole numbers, ns of times; None of what has none."""
    kind, t = column.type, pa.types
    if t.is_integer(kind):
        return column
    if not is_moment(kind):
        return None
    stamp = pa.timestamp("ns", getattr(kind, "tz", None))
    ns = pa.duration("ns") if t.is_duration(kind) else pa.time64("ns") if t.is_time(kind) else stamp
    return pc.cast(pc.cast(column, ns), pa.int64())


def find_stated_units(table: pa.Table, origins: Mapping[str, int]) -> dict[str, str]:
    """Returns `ns` for whole numbers that are nanoseconds since 1970."""
    whole = [f.name for f in table.schema if pa.types.is_integer(f.type)]
    return {n: "ns" for n in whole if _EPOCH_NS[0] < origins.get(n, 0) < _EPOCH_NS[1]}
