"""What every format gives: named columns of one length, read when they are requested."""

import errno
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError, is_out_of_memory, suggest_install
from modeler.core.files import PACKED, UNPACKED


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
