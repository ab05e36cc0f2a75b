"""Spreadsheets (.xlsx and what else calamine reads), by the rules of text files."""

import re
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path

import pyarrow as pa

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked_size
from modeler.logs.blocks import build_arrow_columns
from modeler.logs.clock_times import is_clock, parse_moment
from modeler.logs.columns import (
    ColumnRequest,
    Columns,
    Stream,
    make_package_error,
    wrap_read_errors,
)
from modeler.logs.dialect import detect_head, parse_decimal

_PIECE = 2**22  # bytes that are unpacked at a time, to be counted
_CELL = 150  # bytes of a cell in memory: as read, and as text
_TAG = re.compile(rb"<(?:\w+:)?(row|c)((?:\s[^>]*)?)>")
_PLACE = re.compile(rb"""\sr=["']([A-Z]{0,3})(\d{1,7})["']""")
_LEAST = 2  # rows of a table with names


def read_sheets(path: Path, wanted: ColumnRequest) -> Columns:
    """The columns of the sheet of that topic, or of the first one with a row of numbers.

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
        cells = {n: book.get_sheet_by_name(n).to_python() for n in book.sheet_names
                 if wanted.topic in ("", n)}  # fmt: skip
        sheets = {n: [[str(c).strip() for c in row] for row in rows] for n, rows in cells.items()}
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
    first, columns = rows[head.first], zip(*filter(any, rows[head.first :]), strict=True)
    clocks = {n: parse_moment(c) for n, c in zip(head.names, first, strict=True) if is_clock(c)}
    arrays = [_build_array(c, n in clocks) for n, c in zip(head.names, columns, strict=True)]
    table = pa.table(arrays, names=list(head.names))
    table_columns = build_arrow_columns(table, 0, clocks)
    notes = [f"sheet {name}"] * (len(book.sheet_names) > 1) + [*head.notes]
    notes += [f"{n} counted from the first row" for n in clocks]
    read = (f"read with {', '.join(notes)}",) if notes else ()
    streams = tuple(Stream(n, "sheet", len(r), n == name) for n, r in sheets.items())
    streams *= len(streams) > 1
    return Columns(
        table_columns.columns,
        table_columns.rows,
        head.units,
        (),
        streams,
        head.rate,
        reading_notes=read,
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
        check_unpacked_size(path, max(_CELL * cells, longest * shared))


def _parse_column_number(letters: bytes) -> int:
    """The number of a column: 1 of `A`, 28 of `AB`."""
    return sum((letter - 64) * 26**k for k, letter in enumerate(reversed(letters)))


def _has_numbers(rows: Sequence[Sequence[str]]) -> bool:
    last = [row for row in rows if any(row)][-1:]
    return len(rows) >= _LEAST and any(parse_decimal(e) is not None for row in last for e in row)


def _build_array(entries: Sequence[str], clock: bool) -> pa.Array:
    """Numbers; texts where one is none, or of times."""
    numbers = [parse_decimal(entry) for entry in entries]
    if clock or any(n is None and e for n, e in zip(numbers, entries, strict=True)):
        return pa.array([entry or None for entry in entries], pa.string())
    return pa.array(numbers, pa.float64())
