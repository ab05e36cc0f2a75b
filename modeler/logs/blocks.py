"""Parquet and CSV files: whole, or block by block, so that one of any length fits in memory."""

import re
from collections.abc import Iterator, Mapping, Sequence
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
from modeler.logs.columns import Columns, ColumnValues, NotNumbers, Wanted, unreadable

_UNEVEN = re.compile(r"Row #(\d+): Expected (\d+) columns, got (\d+): (.*)", re.DOTALL)
"""What Arrow says of a row; it counts the header."""

_MARKS = {";": "semicolons", "\t": "tabs", "|": "bars"}
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d")
_LINE = 2**24  # bytes of the longest line that is looked at
_BOM = "\ufeff"

State = tuple[int, int]
"""Bytes of a file, and when it was last written to."""

_LINES = 200  # by whose length the rows of the file are counted
_BYTES = 1 << 20  # of a file at a time


@dataclass(frozen=True, eq=False)
class _Arrow:
    """A column of a table of Arrow."""

    column: pa.ChunkedArray
    before: int = 0  # rows of the file that stand before it

    @property
    def numeric(self) -> bool:
        t = pa.types
        numbers = (t.is_integer, t.is_floating, t.is_decimal, t.is_null)
        return any(is_one(self.column.type) for is_one in numbers)

    def numbers(self) -> np.ndarray:
        if not self.numeric:
            kind = self.column.type
            text = pa.types.is_string(kind) or pa.types.is_large_string(kind)
            values = self.column.to_pylist() if text else []
            for row, value in enumerate(values, start=self.before + 1):
                try:
                    float(value if value is not None else "nan")
                except ValueError:
                    comma = re.fullmatch(r"\s*[+-]?\d*,\d+\s*", value or "")
                    raise NotNumbers(
                        f', row {row}: got "{value}"; expected a number'
                        f"{' with a decimal point' if comma else ''}; correct it, or leave the "
                        "entry empty if the measurement is missing"
                    ) from None
            raise NotNumbers(f" holds {kind}; expected numbers; write the column as floating point")
        column = pc.cast(self.column, pa.float64(), safe=False)
        if column.null_count or not column.num_chunks:
            return np.array(column.to_numpy(), dtype=float)
        # Arrow's own `to_numpy` loads pandas, where it is installed.
        return np.concatenate([np.from_dlpack(chunk) for chunk in column.chunks])


def read_csv(path: Path, wanted: Wanted) -> Columns:
    """The columns of a CSV file."""
    del wanted  # one table, no parts
    with arrow_errors(path, "CSV"):
        check_csv(path)
        return arrow_columns(_parsed(path))


def read_parquet(path: Path, wanted: Wanted) -> Columns:
    """The columns of a Parquet file."""
    del wanted
    with arrow_errors(path, "PARQUET"):
        return arrow_columns(open_parquet(path).read())  # read_table refuses equal names


def open_parquet(path: Path, **how: Any) -> pa.parquet.ParquetFile:
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
def arrow_errors(path: Path, what: str) -> Iterator[None]:
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


def _parsed(source: Any, **options: Any) -> pa.Table:
    """The table of a CSV file, or of some of its lines; an error of one row names it."""
    names = options.pop("column_names", None)
    convert = pa.csv.ConvertOptions(**options)
    try:
        return pa.csv.read_csv(
            source, pa.csv.ReadOptions(column_names=names), convert_options=convert
        )
    except pa.ArrowInvalid:
        # Rows are counted only where one thread reads all.
        alone = pa.csv.ReadOptions(column_names=names, use_threads=False)
        return pa.csv.read_csv(source, alone, convert_options=convert)


def arrow_columns(table: pa.Table, before: int = 0) -> Columns:
    """The columns of a table; `before` rows of its file stand before it."""
    named = [
        (bare(name), _Arrow(table.column(i), before)) for i, name in enumerate(table.column_names)
    ]
    return Columns(tuple(named), table.num_rows)


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
                decimals = any(_DECIMAL_COMMA.match(entry) for entry in first.split(mark))
                also = ", and decimal points for the decimal commas" if decimals else ""
                raise DataError(
                    f"{path}: columns separated by {name}; expected columns separated by commas; "
                    f"write the file again with commas{also}"
                )
    columns, entries = header.count(",") + 1, first.count(",") + 1
    if entries > columns and '"' not in header + first:
        raise DataError(
            f"{path}: row 1: got {entries} entries for {columns} columns; expected one each; "
            "write decimal points where numbers have decimal commas"
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


def state_of(path: Path) -> State:
    """Of a file that is there."""
    state = path.stat()
    return state.st_size, state.st_mtime_ns


def check_unchanged(path: Path, before: State) -> None:
    """A file that is written while it is read has no one content.

    Raises:
        DataError: it is another than before.
    """
    try:
        now = state_of(path)
    except OSError as error:
        raise DataError(
            f"{path}: went away while it was read ({error.strerror}); expected it to stay; run "
            "this again"
        ) from None
    if now != before:
        raise DataError(
            f"{path}: was written to while it was read ({before[0]} bytes, now {now[0]}); expected "
            "a log that is complete; wait until it is, and run this again"
        )


class CsvBlocks:
    """The lines of a CSV file; a block is parsed by itself, and its columns are what it holds."""

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, state_of(path)
        with arrow_errors(path, "CSV"):
            check_csv(path)
            with path.open("rb") as file:
                header = file.readline()
                while header and not header.strip():
                    header = file.readline()
                self._start = file.tell()
                lines = [line for _, line in zip(range(_LINES), file, strict=False) if line.strip()]
            self._names = pa.csv.read_csv(pa.py_buffer(header)).column_names
        self._line = max(1.0, sum(map(len, lines)) / max(1, len(lines)))  # bytes

    @property
    def rows(self) -> int:
        """About as many as the file has."""
        return round((self._state[0] - self._start) / self._line)

    def blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """All rows in their order, about `size` at a time.

        Args:
            size: rows of a block.
            names: of the columns that are wanted; all without any.

        Raises:
            DataError: the file is damaged, or was written to while it was read.
        """
        read, rest = 0, b""
        with arrow_errors(self._path, "CSV"), self._path.open("rb") as file:
            file.seek(self._start)
            while True:
                text = file.read(max(1, int(size * self._line)))
                end = text.rfind(b"\n") + 1
                if text and not end:
                    rest += text
                    continue
                whole, rest = (rest + text[:end], text[end:]) if text else (rest, b"")
                if whole.strip():
                    table = self._parsed(whole, names, read)
                    yield arrow_columns(table, read)
                    read += table.num_rows
                if not text:
                    break
        check_unchanged(self._path, self._state)

    def window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Up to `size` rows from about a share of the file on."""
        room = int(size * self._line)
        start = max(self._start, min(self._start + int(share * self._state[0]),
                                     self._state[0] - room))  # fmt: skip
        with arrow_errors(self._path, "CSV"), self._path.open("rb") as file:
            file.seek(start - 1)
            file.readline()  # the line that begins before
            text = file.read(room)
            text += file.readline()
            return arrow_columns(self._parsed(text, names, 0))

    def _parsed(self, text: bytes, names: Sequence[str], before: int) -> pa.Table:
        """A table of whole lines; an error of one row names its place in the file."""
        wanted = [name for name in self._names if not names or bare(name) in names]
        try:
            return _parsed(pa.py_buffer(text), column_names=self._names, include_columns=wanted)
        except pa.ArrowInvalid as error:
            check_unchanged(self._path, self._state)
            # As in a file that is read whole, the header is row 1.
            placed = re.sub(r"Row #(\d+)", lambda m: f"Row #{int(m[1]) + before + 1}", str(error))
            raise pa.ArrowInvalid(placed) from None


class ParquetBlocks:
    """The row groups of a Parquet file, decoded one after the other; as `CsvBlocks`.

    Attributes:
        rows: of the file.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, state_of(path)
        with arrow_errors(path, "PARQUET"):
            meta = self._open().metadata
            rows = [meta.row_group(place).num_rows for place in range(meta.num_row_groups)]
        self._starts = np.concatenate([[0], np.cumsum(rows, dtype=int)])  # of the row groups
        self.rows = int(self._starts[-1])

    def blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """All rows in their order, `size` at a time."""
        read = 0
        for table in self._read(0, size, names):
            yield arrow_columns(table, read)
            read += table.num_rows
        check_unchanged(self._path, self._state)

    def window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Up to `size` rows from about a share of the file on."""
        start = max(0, min(int(share * self.rows), self.rows - size))
        at = int(np.argmax(self._starts[1:] > start))
        parts, rows, skip = list[pa.Table](), 0, start - int(self._starts[at])
        for table in self._read(at, size, names):
            taken = table.slice(min(skip, table.num_rows), size - rows)
            skip -= min(skip, table.num_rows)
            parts.append(taken)
            rows += taken.num_rows
            if rows >= size:
                break
        return arrow_columns(pa.concat_tables(parts), start)

    def _open(self) -> pa.parquet.ParquetFile:
        return open_parquet(self._path, buffer_size=_BYTES, pre_buffer=False)

    def _read(self, first: int, size: int, names: Sequence[str]) -> Iterator[pa.Table]:
        """The rows from the first of a row group on."""
        read, places = int(self._starts[first]), list(range(first, len(self._starts) - 1))
        try:
            file = self._open()
            for batch in file.iter_batches(size, row_groups=places, columns=list(names) or None):
                yield pa.Table.from_batches([batch])
                read += batch.num_rows
        except (pa.ArrowException, OSError) as error:
            check_unchanged(self._path, self._state)
            words = str(error).strip().split("\n")[0]
            raise DataError(
                f"{self._path}: cannot be read as PARQUET beyond row {read} ({words}); copy it "
                "again, or write what can be read of it to a new file"
            ) from None


Blocks = CsvBlocks | ParquetBlocks
"""A file as consecutive blocks of rows."""


def blocks_of(path: Path) -> Blocks | None:
    """The blocks of a Parquet or CSV file; None of a format that is read whole.

    Raises:
        DataError: the file is damaged.
    """
    if not path.is_file() or path.stat().st_size == 0:
        return None
    kinds: Mapping[str, type[Blocks]] = {".parquet": ParquetBlocks, ".csv": CsvBlocks}
    kind = kinds.get(path.suffix.lower())
    return None if kind is None else kind(path)


def windows_of(blocks: Blocks, count: int, size: int) -> Columns:
    """Windows spread over a file, one after the other; columns that hold numbers in all of them."""
    found = [dict(blocks.window((k + 0.5) / count, size).columns) for k in range(count)]
    values = tuple(
        (name, ColumnValues(np.concatenate([own[name].numbers() for own in found])))
        for name in found[0]
        if all(own[name].numeric for own in found)
    )
    return Columns(values, len(values[0][1].values) if values else 0)
