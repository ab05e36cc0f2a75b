"""Spreadsheets (.xlsx and what else calamine reads), by the rules of text files."""

from collections.abc import Sequence
from pathlib import Path

import pyarrow as pa

from modeler.core.errors import DataError
from modeler.logs.blocks import arrow_columns
from modeler.logs.clock_times import first_moment, is_clock
from modeler.logs.columns import Columns, Stream, Wanted, missing_package, reading
from modeler.logs.dialect import decimal_number, head_of

_LEAST = 2  # rows of a table with names


def read_sheets(path: Path, wanted: Wanted) -> Columns:
    """The columns of the sheet of that topic, or of the first one with a row of numbers.

    Raises:
        DataError: python-calamine is not installed, no such sheet, none with numbers, or damaged.
    """
    try:
        from python_calamine import CalamineWorkbook
    except ModuleNotFoundError:
        raise missing_package(path, "a spreadsheet", "python-calamine") from None
    with reading(path, "spreadsheet", "save it again as .xlsx, or as CSV"):
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
    head = head_of(["\t".join(row) for row in rows], rows, "\t", "", f"{path}, sheet {name}")
    first, columns = rows[head.first], zip(*filter(any, rows[head.first :]), strict=True)
    clocks = {n: first_moment(c) for n, c in zip(head.names, first, strict=True) if is_clock(c)}
    arrays = [_array(c, n in clocks) for n, c in zip(head.names, columns, strict=True)]
    table = pa.table(arrays, names=list(head.names))
    found = arrow_columns(table, 0, clocks)
    told = [f"sheet {name}"] * (len(book.sheet_names) > 1) + [*head.told]
    told += [f"{n} counted from the first row" for n in clocks]
    read = (f"read with {', '.join(told)}",) if told else ()
    streams = tuple(Stream(n, "sheet", len(r), n == name) for n, r in sheets.items())
    streams *= len(streams) > 1
    return Columns(found.columns, found.rows, head.units, (), streams, head.rate, told=read)


def _has_numbers(rows: Sequence[Sequence[str]]) -> bool:
    last = [row for row in rows if any(row)][-1:]
    return len(rows) >= _LEAST and any(decimal_number(e) is not None for row in last for e in row)


def _array(entries: Sequence[str], clock: bool) -> pa.Array:
    """Numbers; texts where one is none, or of times."""
    numbers = [decimal_number(entry) for entry in entries]
    if clock or any(n is None and e for n, e in zip(numbers, entries, strict=True)):
        return pa.array([entry or None for entry in entries], pa.string())
    return pa.array(numbers, pa.float64())
