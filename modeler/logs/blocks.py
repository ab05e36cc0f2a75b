"""Parquet, CSV files and spreadsheets: whole, or block by block."""

import dataclasses
import os
import re
import sys
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, BinaryIO

import lazy_loader
import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked_size
from modeler.logs import datasets
from modeler.logs.columns import (
    Column,
    ColumnRequest,
    Columns,
    ColumnValues,
    NotNumericError,
    Stream,
    convert_times,
    find_origins,
    find_stamp_pairs,
    find_stated_units,
    is_beyond,
    is_clock,
    is_moment,
    join_stamps,
    make_package_error,
    make_read_error,
    parse_moment,
    wrap_read_errors,
)
from modeler.logs.datasets import Dataset, find_dataset
from modeler.logs.dialect import TEXTS, detect_dialect, detect_head, parse_decimal, strip_quotes
from modeler.logs.thresholds import THRESHOLDS

pc: Any = lazy_loader.load("pyarrow.compute", suppress_warning=True)  # it takes long

_UNEVEN = re.compile(r"Row #(\d+): Expected (\d+) columns, got (\d+): (.*)", re.DOTALL)
"""What Arrow says of a row; it counts the header."""

State = tuple[int, int]
"""Bytes of a file, and when it was last written to."""

_BYTES = 1 << 20  # of a file at a time


@dataclass(frozen=True, eq=False)
class _ArrowColumn(Column):
    """A column of a table of Arrow.

    Attributes:
        column: of it.
        before: rows of the file that stand before it.
        origin: what a time is counted from, ns; None of what is none.
    """

    column: pa.ChunkedArray
    before: int = 0
    origin: int | None = None

    @property
    def is_time(self) -> bool:
        kind = self.column.type
        return self.origin is not None and (is_moment(kind) or pa.types.is_string(kind))

    @property
    def is_numeric(self) -> bool:
        t = pa.types
        numbers = (t.is_integer, t.is_floating, t.is_decimal, t.is_null)
        return self.is_time or any(is_one(self.column.type) for is_one in numbers)

    def read_numbers(self) -> np.ndarray:
        if self.is_time or (self.origin is not None and pa.types.is_integer(self.column.type)):
            return convert_times(self.column, self.origin or 0, self.before)
        if not self.is_numeric:
            kind = self.column.type
            text = pa.types.is_string(kind) or pa.types.is_large_string(kind)
            values = self.column.to_pylist() if text else []
            for row, value in enumerate(values, start=self.before + 1):
                try:
                    float(value if value is not None else "nan")
                except ValueError:
                    comma = re.fullmatch(r"\s*[+-]?\d*,\d+\s*", value or "")
                    raise NotNumericError(
                        f', row {row}: got "{value}"; expected a number'
                        f"{' with a decimal point' if comma else ''}; correct it, or leave the "
                        "entry empty if the measurement is missing"
                    ) from None
            raise NotNumericError(
                f" holds {kind}; expected numbers; write the column as floating point"
            )
        column = self.column
        if column.type != pa.float64():
            column = pc.cast(column, pa.float64(), safe=False)
        first = self.origin or 0  # of whole numbers, some of which are floats here
        if column.null_count or not column.num_chunks:
            return np.array(column.to_numpy(), dtype=float) - first
        # Arrow's own `to_numpy` loads pandas, where it is installed.
        return np.concatenate([np.from_dlpack(chunk) for chunk in column.chunks]) - first


def read_csv(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of a text file."""
    del wanted  # one table, no parts
    with wrap_arrow_errors(path, "CSV"):
        text = _TextFile(path)
        with text.dialect.open_text(path) as file:
            file.seek(text.dialect.start)
            return text.parse_columns(file.read())


def read_parquet(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of a Parquet file."""
    del wanted
    with wrap_arrow_errors(path, "PARQUET"):
        table = decode_texts(path, open_parquet(path).read())  # read_table refuses equal names
        return _build_parquet_columns(table, find_dataset(path), find_origins(table))


def read_dataset(folder: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of all Parquet files of a LeRobot dataset, one after the other."""
    del wanted
    places = sorted((folder / "data").rglob("*.parquet"))
    if not places:
        raise DataError(f"{folder}: no Parquet files in data/; copy the dataset again")
    with wrap_arrow_errors(folder, "PARQUET"):
        table = pa.concat_tables([decode_texts(p, open_parquet(p).read()) for p in places])
        return _build_parquet_columns(table, find_dataset(folder), find_origins(table))


def _build_parquet_columns(
    table: pa.Table,
    dataset: Dataset | None,
    origins: Mapping[str, int],
    before: int = 0,
    names: Sequence[str] = (),
) -> Columns:
    """With entries of lists as columns, and the clock of a dataset."""
    table, clock_notes = datasets.join_episodes(table, dataset, origins.get("index", 0))
    counted_from = {n: first for n, first in origins.items() if n != "index" or is_beyond(first)}
    columns = build_arrow_columns(datasets.flatten_table(table, dataset), before, counted_from)
    rate = None if dataset is None else dataset.fps
    notes = (*clock_notes, *columns.reading_notes)
    return select_columns(dataclasses.replace(columns, reading_notes=notes, rate=rate), names)


def open_parquet(path: Path, **how: Any) -> pa.parquet.ParquetFile:
    """Returns a Parquet file whose columns have room.

    Raises:
        DataError: it unpacks to more than a log does.
    """
    file = pa.parquet.ParquetFile(path, **how)
    meta, size = file.metadata, 8 * file.metadata.num_rows * file.metadata.num_columns
    groups = [meta.row_group(place) for place in range(meta.num_row_groups)]
    values = sum(g.column(k).num_values for g in groups for k in range(g.num_columns))
    check_unpacked_size(path, max(size, 8 * values, sum(g.total_byte_size for g in groups)))
    texts = [f.name for f in file.schema_arrow if pa.types.is_string(f.type)]
    return pa.parquet.ParquetFile(path, read_dictionary=texts, **how) if texts else file


def decode_texts(path: Path, table: pa.Table) -> pa.Table:
    """Returns the table with texts as such, which are read as numbers of a list of them.

    One may be long.

    Raises:
        DataError: they unpack to more than a log does.
    """
    for at, field in enumerate(table.schema):
        if not pa.types.is_dictionary(field.type) or not pa.types.is_string(field.type.value_type):
            continue
        column = table.column(at)
        for chunk in column.chunks:
            longest = pc.max(pc.binary_length(chunk.dictionary)).as_py() or 0
            check_unpacked_size(path, longest * len(chunk))
        table = table.set_column(at, field.name, pc.cast(column, pa.string()))
    return table


@contextmanager
def wrap_arrow_errors(path: Path, what: str) -> Iterator[None]:
    """Raises errors of Arrow as one line."""
    try:
        yield
    except (pa.ArrowException, OSError) as error:
        match = _UNEVEN.search(str(error))
        if match is None:
            raise make_read_error(path, what, error, "write the file again") from None
        quote = ', where a quote (") is open' if match[4].count('"') % 2 else ""
        raise DataError(
            f"{path}: row {int(match[1]) - 1}: got {match[3]} entries for {match[2]} "
            f"columns{quote}; expected one each; correct that row"
        ) from None


class _TextFile:
    """The rows of a text file, some lines at a time."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.dialect = detect_dialect(path)
        self.names = self.dialect.head.names

    def parse_columns(self, text: bytes, wanted: Sequence[str] = (), before: int = 0) -> Columns:
        """Parses whole lines, `before` rows after the first; an error of a row names its place.

        Raises:
            ArrowInvalid: a row has more or fewer entries.
        """
        dialect, head = self.dialect, self.dialect.head
        made = {*wanted} - {*self.names}  # of several columns
        names = [name for name in self.names if not wanted or made or name in wanted]
        parse = pa.csv.ParseOptions(delimiter=dialect.delimiter)
        convert = pa.csv.ConvertOptions(
            decimal_point=dialect.decimal,
            include_columns=names,
            column_types=dict.fromkeys(dialect.clocks, pa.string()),
        )
        if not text.strip():
            table = pa.table({name: pa.nulls(0) for name in dict.fromkeys(names)})
        else:
            table = self._parse_rows(dialect.normalise_rows(text), before, parse, convert)
        kinds = dict(zip(table.column_names, table.schema.types, strict=True))
        texts = {name for name, kind in kinds.items() if pa.types.is_string(kind)}
        wholes = {name: first for name, first in dialect.wholes.items() if name not in texts}
        columns = build_arrow_columns(table, before, {**dialect.clocks, **wholes})
        units = {**columns.units, **head.units}
        notes = (*dialect.reading_notes, *columns.reading_notes)
        columns = dataclasses.replace(columns, units=units, reading_notes=notes, rate=head.rate)
        return select_columns(columns, wanted)

    def _parse_rows(
        self, text: bytes, before: int, parse: pa.csv.ParseOptions, convert: pa.csv.ConvertOptions
    ) -> pa.Table:
        # In memory of Arrow: what is Python's would be let go by a thread of Arrow, which ends the
        # process (SIGABRT) where Python is ending already, as after an error of a name.
        source = pa.allocate_buffer(len(text))
        pa.FixedSizeBufferWriter(source).write(text)
        for threads in (True, False):  # rows are counted only where one thread reads all
            how = pa.csv.ReadOptions(column_names=list(self.names), use_threads=threads)
            try:
                return pa.csv.read_csv(source, how, parse, convert)
            except pa.ArrowInvalid as error:
                if threads:
                    continue
                # As in a file whose first line is the header, that is row 1.
                message = re.sub(
                    r"Row #(\d+)", lambda m: f"Row #{int(m[1]) + before + 1}", str(error)
                )
                raise pa.ArrowInvalid(message) from None
        raise AssertionError


def build_arrow_columns(
    table: pa.Table, before: int = 0, origins: Mapping[str, int] = MappingProxyType({})
) -> Columns:
    """Returns the columns of a table; `before` rows of its file stand before it.

    Args:
        table: of some rows.
        before: rows of the file that stand before them.
        origins: what columns of times are counted from.
    """
    table, by_names = datasets.rename_by_joint_names(table)
    pairs = zip(table.column_names, table.columns, strict=True)
    named = [(strip_quotes(n), _ArrowColumn(x, before, origins.get(n))) for n, x in pairs]
    columns, units, stamp_notes = join_stamps(named)
    units = {**find_stated_units(table, origins), **units}
    return Columns(columns, table.num_rows, units, reading_notes=(*by_names, *stamp_notes))


def select_columns(columns: Columns, names: Sequence[str]) -> Columns:
    """Returns the columns of these names, where only some are wanted."""
    some = tuple(entry for entry in columns.columns if entry[0] in names)
    return dataclasses.replace(columns, columns=some) if names else columns


def get_file_state(path: Path) -> State:
    """Returns the state of a file that is there."""
    state = path.stat()
    return state.st_size, state.st_mtime_ns


def check_unchanged(path: Path, before: State) -> None:
    """Refuses a file that was written to while it was read.

    Raises:
        DataError: it is another than before.
    """
    try:
        now = get_file_state(path)
    except OSError as error:
        raise DataError(
            f"{path}: was removed while it was read ({error.strerror}); expected it to stay; run "
            "this again"
        ) from None
    if now != before:
        raise DataError(
            f"{path}: was written to while it was read ({before[0]} bytes, now {now[0]}); expected "
            "a log that is complete; wait until it is, and run this again"
        )


class CsvBlocks:
    """The lines of a text file; a block is parsed by itself, and its columns are what it holds."""

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, get_file_state(path)
        with wrap_arrow_errors(path, "CSV"):
            self._text = _TextFile(path)
            self._start, self.lists = self._text.dialect.start, self._text.dialect.lists
            with self._open_rows() as file:
                numbered = zip(range(THRESHOLDS.sampled_lines), file, strict=False)
                lines = [line for _, line in numbered if line.strip()]
                self._size = file.seek(0, os.SEEK_END)
        self._line = max(1.0, sum(map(len, lines)) / max(1, len(lines)))  # bytes

    def _open_rows(self) -> BinaryIO:
        file = self._text.dialect.open_text(self._path)
        file.seek(self._start)
        return file

    @property
    def rows(self) -> int:
        """Returns about as many rows as the file has."""
        return round((self._size - self._start) / self._line)

    def read_blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """Yields all rows in their order, about `size` at a time.

        Args:
            size: rows of a block.
            names: of the columns that are wanted; all without any.

        Raises:
            DataError: the file is damaged, or was written to while it was read.
        """
        read, rest = 0, b""
        with wrap_arrow_errors(self._path, "CSV"), self._open_rows() as file:
            while True:
                text = file.read(max(1, int(size * self._line)))
                end = text.rfind(b"\n") + 1
                if text and not end:
                    rest += text
                    continue
                whole, rest = (rest + text[:end], text[end:]) if text else (rest, b"")
                if whole.strip():
                    columns = self._parse_block(whole, names, read)
                    yield columns
                    read += columns.rows
                if not text:
                    break
        check_unchanged(self._path, self._state)

    def read_window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Returns up to `size` rows from about a share of the file on."""
        room = int(size * self._line)
        start = max(self._start, min(self._start + int(share * self._size), self._size - room))
        with wrap_arrow_errors(self._path, "CSV"), self._open_rows() as file:
            if start > self._start:
                file.seek(start - 1)
                file.readline()  # the line that begins before
            text = file.read(room)
            text += file.readline()
            return self._text.parse_columns(text, names)

    def _parse_block(self, text: bytes, names: Sequence[str], before: int) -> Columns:
        try:
            return self._text.parse_columns(text, names, before)
        except pa.ArrowInvalid:
            check_unchanged(self._path, self._state)
            raise


class ParquetBlocks:
    """The row groups of a Parquet file, decoded one after the other; as `CsvBlocks`.

    Attributes:
        rows: of the file.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, get_file_state(path)
        with wrap_arrow_errors(path, "PARQUET"):
            meta = self._open_file().metadata
            rows = [meta.row_group(place).num_rows for place in range(meta.num_row_groups)]
            self._dataset, schema = find_dataset(path), self._open_file().schema_arrow
            self._stored = schema.names
            timed = [f.name for f in schema if is_moment(f.type) or pa.types.is_integer(f.type)]
            timed += [seconds for seconds, *_ in find_stamp_pairs(schema.names).values()]
        self._starts = np.concatenate([[0], np.cumsum(rows, dtype=int)])  # of the row groups
        self.rows = int(self._starts[-1])
        self._origins: Mapping[str, int] = {}
        if timed and self.rows:
            self._origins = find_origins(next(self._read_tables(0, 1, [*dict.fromkeys(timed)])))

    def read_blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """Yields all rows in their order, `size` at a time."""
        read = 0
        for table in self._read_tables(0, size, names):
            yield _build_parquet_columns(table, self._dataset, self._origins, read, names)
            read += table.num_rows
        check_unchanged(self._path, self._state)

    def read_window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Returns up to `size` rows from about a share of the file on."""
        start = max(0, min(int(share * self.rows), self.rows - size))
        at = int(np.argmax(self._starts[1:] > start))
        parts, rows, skip = list[pa.Table](), 0, start - int(self._starts[at])
        for table in self._read_tables(at, size, names):
            taken = table.slice(min(skip, table.num_rows), size - rows)
            skip -= min(skip, table.num_rows)
            parts.append(taken)
            rows += taken.num_rows
            if rows >= size:
                break
        table = pa.concat_tables(parts)
        return _build_parquet_columns(table, self._dataset, self._origins, start, names)

    def _open_file(self) -> pa.parquet.ParquetFile:
        return open_parquet(self._path, buffer_size=_BYTES, pre_buffer=False)

    def _read_tables(self, first: int, size: int, names: Sequence[str]) -> Iterator[pa.Table]:
        """The rows from the first of a row group on."""
        read, places = int(self._starts[first]), list(range(first, len(self._starts) - 1))
        try:
            file = self._open_file()
            some = datasets.select_needed_columns(list(names), self._stored) or None
            for batch in file.iter_batches(size, row_groups=places, columns=some):
                yield decode_texts(self._path, pa.Table.from_batches([batch]))
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


def open_blocks(path: Path) -> Blocks | None:
    """Returns the blocks of a Parquet or CSV file; None of a format that is read whole.

    Raises:
        DataError: the file is damaged.
    """
    if not path.is_file() or path.stat().st_size == 0:
        return None
    if path.suffix.lower() == ".parquet":
        return ParquetBlocks(path)
    if path.suffix.lower() not in TEXTS:
        return None
    blocks = CsvBlocks(path)
    return None if blocks.lists else blocks  # whose cells may go over several lines


def read_windows(blocks: Blocks, count: int, size: int) -> Columns:
    """Reads windows spread over a file, one after the other; columns of numbers in all of them."""
    windows = [dict(blocks.read_window((k + 0.5) / count, size).columns) for k in range(count)]
    values = []
    for name in windows[0]:
        if all(window[name].is_numeric for window in windows):
            numbers = np.concatenate([window[name].read_numbers() for window in windows])
            values.append((name, ColumnValues(numbers)))
    rows = len(values[0][1].values) if values else 0
    first = blocks.read_window(0.0, 1)
    notes, rate = first.reading_notes, first.rate
    return Columns(tuple(values), rows, first.units, reading_notes=notes, rate=rate)


# Spreadsheets (.xlsx and what else calamine reads), by the rules of text files.


_PIECE = 2**22  # bytes that are unpacked at a time, to be counted
_TAG = re.compile(rb"<(?:\w+:)?(row|c)((?:\s[^>]*)?)>")
_PLACE = re.compile(rb"""\sr=["']([A-Z]{0,3})(\d{1,7})["']""")


def read_sheets(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of the sheet of that topic, or of the first one with a row of numbers.

    Raises:
        DataError: python-calamine is not installed, no such sheet, none with numbers, or damaged.
    """
    try:
        from python_calamine import CalamineWorkbook
    except ModuleNotFoundError:
        raise make_package_error(path, "a spreadsheet", "python-calamine") from None
    with wrap_read_errors(path, "spreadsheet", "save it again as .xlsx, or as CSV"):
        _check_room(path)
        book = CalamineWorkbook.from_path(str(path))
        names = [n for n in book.sheet_names if wanted.topic in ("", n)]
        pages = {n: book.get_sheet_by_name(n).to_python() for n in names}
        sheets = {n: [[str(c).strip() for c in row] for row in rows] for n, rows in pages.items()}
    if not sheets:
        raise DataError(
            f"{path}: topic {wanted.topic}: no sheet of that name; the sheets are "
            f"{', '.join(book.sheet_names)}"
        )
    name = next((n for n, rows in sheets.items() if _has_numbers(rows)), None)
    if name is None:
        raise DataError(
            f"{path}: no sheet with rows of numbers; expected the samples of a motion, one column "
            "each; save the values of the formulas, or as CSV"
        )
    rows = sheets[name]
    head = detect_head(["\t".join(row) for row in rows], rows, "\t", "", f"{path}, sheet {name}")
    first, cells = rows[head.first], zip(*filter(any, rows[head.first :]), strict=True)
    clocks = {n: parse_moment(c) for n, c in zip(head.names, first, strict=True) if is_clock(c)}
    arrays = [_build_array(c, n in clocks) for n, c in zip(head.names, cells, strict=True)]
    table = pa.table(arrays, names=list(head.names))
    columns = build_arrow_columns(table, 0, clocks)
    notes = [f"sheet {name}"] * (len(book.sheet_names) > 1) + [*head.notes]
    notes += [f"{n} counted from the first row" for n in clocks]
    read = (f"read with {', '.join(notes)}",) if notes else ()
    streams = tuple(Stream(n, "sheet", len(r), n == name) for n, r in sheets.items())
    streams *= len(streams) > 1
    return Columns(
        columns.columns, columns.rows, head.units, (), streams, head.rate, reading_notes=read
    )


def _check_room(path: Path) -> None:
    """Refuse a workbook that unpacks, or whose cells fill their rows and columns, to too much.

    Office Open XML (ECMA-376), part 1, section 18.3: a sheet lists the cells that hold something by
    their places; readers make a table as large as the farthest of them. Of the texts that cells
    share, each has a copy.
    """
    size = cells = longest = shared = 0
    with zipfile.ZipFile(path) as book:
        for part in book.infolist():
            part.file_size = sys.maxsize  # what it states: it is unpacked to its end
            text, row, column, ends = b"", 0, 0, [0, 0]
            with book.open(part) as file:
                while piece := file.read(_PIECE):
                    size += len(piece)
                    check_unpacked_size(path, size)
                    text = text[text.rfind(b"<") :] + piece
                    if "sharedStrings" in part.filename:
                        longest = max(longest, *map(len, text.split(b"</si>")))
                    for tag in _TAG.finditer(text[: text.rfind(b"<")]):
                        of_row, attributes = tag[1] == b"row", tag[2]
                        row, column = (row + 1, 0) if of_row else (row, column + 1)
                        if place := _PLACE.search(attributes):
                            row, column = int(place[2]), _parse_column_number(place[1])
                        if not of_row and not attributes.endswith(b"/"):
                            ends = [max(ends[0], row), max(ends[1], column)]
                            shared += b't="s"' in attributes
            cells += ends[0] * ends[1]
        check_unpacked_size(path, max(THRESHOLDS.bytes_per_cell * cells, longest * shared))


def _parse_column_number(letters: bytes) -> int:
    """The number of a column: 1 of `A`, 28 of `AB`."""
    return sum((letter - 64) * 26**k for k, letter in enumerate(reversed(letters)))


def _has_numbers(rows: Sequence[Sequence[str]]) -> bool:
    last = [row for row in rows if any(row)][-1:]
    cells = (e for row in last for e in row)
    return len(rows) >= THRESHOLDS.min_sheet_rows and any(
        parse_decimal(e) is not None for e in cells
    )


def _build_array(entries: Sequence[str], clock: bool) -> pa.Array:
    """Numbers; texts where one is none, or of times."""
    numbers = [parse_decimal(entry) for entry in entries]
    if clock or any(n is None and e for n, e in zip(numbers, entries, strict=True)):
        return pa.array([entry or None for entry in entries], pa.string())
    return pa.array(numbers, pa.float64())
