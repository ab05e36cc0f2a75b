"""Parquet and CSV files as columns."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv
import pyarrow.parquet

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked
from modeler.logs.columns import Columns, NotNumbers, Wanted, unreadable

_UNEVEN = re.compile(r"Row #(\d+): Expected (\d+) columns, got (\d+): (.*)", re.DOTALL)
"""What Arrow says of a row; it counts the header."""

_MARKS = {";": "semicolons", "\t": "tabs", "|": "bars"}
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d")
_LINE = 2**24  # bytes of the longest line that is looked at
_BOM = "\ufeff"


@dataclass(frozen=True, eq=False)
class _Arrow:
    """A column of a table of Arrow."""

    column: pa.ChunkedArray
    before: int = 0  # rows of the file that stand before it

    @property
    def numeric(self) -> bool:
        kind = self.column.type
        return bool(
            pa.types.is_integer(kind)
            or pa.types.is_floating(kind)
            or pa.types.is_decimal(kind)
            or pa.types.is_null(kind)
        )

    def numbers(self) -> np.ndarray:
        if not self.numeric:
            raise NotNumbers(self._why())
        column = pc.cast(self.column, pa.float64(), safe=False)
        if column.null_count or not column.num_chunks:
            return np.array(column.to_numpy(), dtype=float)
        # Arrow's own `to_numpy` loads pandas, where it is installed.
        return np.concatenate([np.from_dlpack(chunk) for chunk in column.chunks])

    def _why(self) -> str:
        kind = self.column.type
        if pa.types.is_string(kind) or pa.types.is_large_string(kind):
            for row, value in enumerate(self.column.to_pylist(), start=self.before + 1):
                try:
                    float(value if value is not None else "nan")
                except ValueError:
                    return (
                        f', row {row}: got "{value}"; expected a number{_with_point(value)}; '
                        "correct it, or leave the entry empty if the measurement is missing"
                    )
        return f" holds {kind}; expected numbers; write the column as floating point"


def read_csv(path: Path, wanted: Wanted) -> Columns:
    """The columns of a CSV file."""
    del wanted  # one table, no parts
    with told(path, "CSV"):
        check_csv(path)
        return arrow_columns(_parsed(path))


def read_parquet(path: Path, wanted: Wanted) -> Columns:
    """The columns of a Parquet file."""
    del wanted
    with told(path, "PARQUET"):
        return arrow_columns(opened(path).read())  # read_table refuses equal names


def opened(path: Path, **how: Any) -> pa.parquet.ParquetFile:
    """A Parquet file whose columns have room.

    Raises:
        DataError: it unpacks to more than a log does.
    """
    file = pa.parquet.ParquetFile(path, **how)
    meta = file.metadata
    groups = [meta.row_group(place).total_byte_size for place in range(meta.num_row_groups)]
    check_unpacked(path, max(8 * meta.num_rows * meta.num_columns, sum(groups)))
    return file


@contextmanager
def told(path: Path, what: str) -> Iterator[None]:
    """Errors of Arrow as one line."""
    try:
        yield
    except (pa.ArrowException, OSError) as error:
        match = _UNEVEN.search(str(error))
        if match is None:
            raise unreadable(path, what, error, "write the file again") from None
        quote = ', where a quote (") is open' if match[4].count('"') % 2 else ""
        raise DataError(
            f"{path}: row {int(match[1]) - 1}: got {match[3]} entries for {match[2]} "
            f"columns{quote}; expected one each; correct that row"
        ) from None


def _parsed(path: Path) -> pa.Table:
    """The table of a CSV file; an error of one row names it."""
    try:
        return pa.csv.read_csv(path)
    except pa.ArrowInvalid:
        # Rows are counted only where one thread reads all.
        return pa.csv.read_csv(path, pa.csv.ReadOptions(use_threads=False))


def arrow_columns(table: pa.Table, before: int = 0) -> Columns:
    """The columns of a table; `before` rows of its file stand before it."""
    named = [
        (bare(name), _Arrow(table.column(i), before)) for i, name in enumerate(table.column_names)
    ]
    return Columns(tuple(named), table.num_rows)


def _with_point(value: str) -> str:
    return " with a decimal point" if re.fullmatch(r"\s*[+-]?\d*,\d+\s*", value) else ""


def bare(name: str) -> str:
    """A column name without blanks and quotes around it: `"time", "q1"` leaves both."""
    name = name.strip()
    if len(name) > 1 and name[0] == name[-1] and name[0] in "\"'":
        name = name[1:-1].strip()
    return name


def check_csv(path: Path) -> None:
    """Refuse what is not comma-separated UTF-8 with decimal points and its header in row 1.

    Raises:
        DataError: the header is in another encoding, a comment, or separated by something else;
            or the first row has more entries than there are columns.
        OSError: the file cannot be read.
    """
    with path.open("rb") as file:
        lines = iter(lambda: file.readline(_LINE), b"")
        written = (line for line in lines if line.strip())  # the parser skips blank lines too
        header = _header(path, next(written, b""))
        if len(header) >= _LINE:
            raise DataError(
                f"{path}: the first line does not end within {_LINE >> 20} MiB; expected the names "
                "of the columns; write the file again"
            )
        # Text columns are left out, so what they hold need not be readable.
        first = next(written, b"").decode("utf-8", errors="replace")
    if header.lstrip().startswith("#"):
        raise DataError(
            f'{path}: starts with a comment, "{header[:40]}"; expected the names of the columns; '
            'delete the lines before them, and a "#" in front of them'
        )
    if header.count('"') % 2:
        raise DataError(
            f'{path}: the first line has a quote (") that is not closed; expected the names of the '
            "columns; close it, or delete it"
        )
    if "," not in header:
        for mark, name in _MARKS.items():
            if mark in header:
                raise DataError(_separated_by(path, mark, name, first))
    columns, entries = header.count(",") + 1, first.count(",") + 1
    if entries > columns and '"' not in header + first:
        raise DataError(
            f"{path}: row 1: got {entries} entries for {columns} columns; expected one each; "
            "write decimal points where numbers have decimal commas"
        )


def _separated_by(path: Path, mark: str, name: str, first: str) -> str:
    also = ""
    if any(_DECIMAL_COMMA.match(entry) for entry in first.split(mark)):
        also = ", and decimal points for the decimal commas"
    return (
        f"{path}: columns separated by {name}; expected columns separated by commas; write the "
        f"file again with commas{also}"
    )


def _header(path: Path, line: bytes) -> str:
    try:
        return line.decode("utf-8").removeprefix(_BOM).rstrip("\r\n")
    except UnicodeDecodeError as error:
        before = line[: error.start].decode("utf-8")[-40:]
        raise DataError(
            f'{path}: the header is not UTF-8: byte 0x{line[error.start]:02x} after "{before}"; '
            "save the file as UTF-8"
        ) from None
