"""The cells of `[mdh]` where they stand in the text of a robot file, to change one and no more."""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from modeler.core.errors import RobotError
from modeler.robot.loops import MARK
from modeler.robot.robot_text import format_columns_and_rows

_Entry = TypeVar("_Entry")
_NAMES = (("j", "parent"), ("j", "a"))
"""Columns of names, which stand in quotes: of others' tables, of Khalil's."""
_HEAD = re.compile(r"^[ \t]*\[[ \t]*mdh[ \t]*\]", re.MULTILINE)
_KEY = re.compile(r"^[ \t]*(columns|rows)[ \t]*=[ \t]*(?=\[)", re.MULTILINE)
_NEXT = re.compile(r"^[ \t]*\[[ \t]*[\w.\"'-]+[ \t]*\][ \t]*(?:#.*)?$", re.MULTILINE)
_TOKEN = re.compile(
    r"(?P<skip>#[^\n]*|\s+)|(?P<open>\[)|(?P<close>\])|(?P<comma>,)"
    r"|(?P<cell>\"(?:[^\"\\\n]|\\.)*\"|'[^'\n]*'|[^\s,\[\]#\"']+)"
)


@dataclass
class _Array:
    """A TOML array: where it stands, its arrays, and where its other entries stand."""

    start: int
    end: int = 0
    arrays: "list[_Array]" = field(default_factory=list)
    cells: list[tuple[int, int]] = field(default_factory=list)


@dataclass(frozen=True)
class TableText:
    """`[mdh]` as it is written.

    Attributes:
        columns: names, as the file has them.
        rows: cells by column, without quotes.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def find_table_text(text: str) -> TableText | None:
    """The cells of the table; None where the text has none that can be found."""
    arrays = _find_arrays(text)
    if arrays is None:
        return None
    columns, rows = arrays

    def extract_cells(array: _Array) -> tuple[str, ...]:
        return tuple(_strip_quotes(text[start:end]) for start, end in array.cells)

    return TableText(extract_cells(columns), tuple(map(extract_cells, rows.arrays)))


def replace_cell(text: str, row: int, column: int, cell: str) -> str:
    """The text with another cell; the columns stay below each other where there is room.

    Args:
        text: of the file.
        row: number, from 0; -1 for the names of the columns.
        column: number, from 0.
        cell: what it is to say, without quotes.

    Raises:
        RobotError: there is no such cell, or it cannot be replaced.
    """
    columns, rows = _require_arrays(text)
    array = columns if row < 0 else _get_item(rows.arrays, row, "row")
    start, end = _get_item(array.cells, column, "column")
    name = (
        "" if row < 0 else _strip_quotes(text[slice(*_get_item(columns.cells, column, "column"))])
    )
    new = quote_table_cell(cell, row < 0 or name in _NAMES[read_table_convention(text) == "khalil"])
    behind = re.match(r",( *)", text[end:])
    if behind is not None:
        width = end - start + len(behind[1])
        new = f"{new},{' ' * max(1, width - len(new))}"
        end += behind.end()
    return text[:start] + new + text[end:]


def insert_row(text: str, after: int, cells: Sequence[str]) -> str:
    """The text with a row more, behind the row of that number.

    Raises:
        RobotError: there is no such row, or no table.
    """
    columns, rows = _require_arrays(text)
    names = [_strip_quotes(text[slice(*span)]) for span in columns.cells]
    name_columns = _NAMES[read_table_convention(text) == "khalil"]
    line = ", ".join(
        quote_table_cell(c, n in name_columns) for c, n in zip(cells, names, strict=False)
    )
    line = f"[{line}],"
    place = _get_item(rows.arrays, after, "row").end
    comma = re.match(r"[ \t]*,", text[place:])
    head = text[:place] + ("" if comma else ",")
    rest = text[place:]
    line_rest = re.match(r"[^\n]*", rest)
    assert line_rest is not None
    # A comment behind the row stays behind it; the table may end on that line.
    closing = len(line_rest[0]) >= rows.end - place
    cut = (comma.end() if comma else 0) if closing else line_rest.end()
    return f"{head}{rest[:cut]}\n          {line}{rest[cut:]}"


def remove_row(text: str, row: int) -> str:
    """The text without that row.

    Raises:
        RobotError: there is no such row.
    """
    _, rows = _require_arrays(text)
    row_array = _get_item(rows.arrays, row, "row")
    start, end = row_array.start, row_array.end
    behind = re.match(r"[ \t]*,?[ \t]*(?:#[^\n]*)?(?=\n)|[ \t]*,?[ \t]*", text[end:])
    end += behind.end() if behind else 0
    line = text.rfind("\n", 0, start)
    if not text[line + 1 : start].strip() and text[end : end + 1] == "\n":
        start = line
    return text[:start] + text[end:]


def replace_table(
    text: str, columns: Sequence[str], rows: Sequence[Sequence[str]], convention: str
) -> str:
    """The text with another table.

    Args:
        text: of the file.
        columns: names.
        rows: cells by column.
        convention: whose table it is from now on.

    Raises:
        RobotError: there is no table.
    """
    arrays = _require_arrays(text)
    head = text.index("\n", _find_section(text)[0]) + 1
    names = _NAMES[convention == "khalil"]
    cells = [
        [quote_table_cell(c, n in names) for c, n in zip(row, columns, strict=True)] for row in rows
    ]
    stated = [f'convention = "{convention}"'] if convention != "khalil" else []
    lines = "\n".join([*stated, *format_columns_and_rows(columns, cells)]).rstrip()
    return text[:head] + lines + text[max(array.end for array in arrays) :]


def locate_error_cell(error: str, text: str) -> tuple[int, str] | None:
    """The row and the column that the line of a reader is about.

    Args:
        error: the line.
        text: of the file.

    Returns:
        Number of the row, from 0, -1 for the names of columns, and the column as the line calls
        it, "" for the row as a whole; None of a line that is about something else.
    """
    table = find_table_text(text)
    about = re.search(r"\[mdh\],? (?:(columns?)\b|row (?:(\d+)\b|\"([^\"]*)\"))", error)
    if table is None or about is None:
        return None
    place = re.search(r", column (\w+)", error)
    column = place[1] if place else ""
    twice = re.search(r" stands in rows \d+ and (\d+)", error)
    if twice:
        return int(twice[1]) - 1, "j"
    if about[1]:
        return -1, column
    if about[2]:
        return int(about[2]) - 1, column
    for row, cells in enumerate(table.rows):
        row_name = dict(zip(table.columns, cells, strict=False)).get("j", "")
        if re.fullmatch(re.escape(row_name).replace(re.escape(MARK), r"\w+"), about[3]):
            return row, column
    return None


def read_table_convention(text: str) -> str:
    """Whose table it is, as the text has it."""
    begin, end = _find_section(text)
    stated = re.search(r"(?m)^[ \t]*convention[ \t]*=[ \t]*[\"'](\w+)", text[begin:end])
    return stated[1] if stated else "khalil"


def _find_section(text: str) -> tuple[int, int]:
    """Where `[mdh]` begins and ends."""
    head = _HEAD.search(text)
    if head is None:
        raise RobotError("the text has no table [mdh]; write one with columns and rows")
    following = next((m.start() for m in _NEXT.finditer(text, head.end())), len(text))
    return head.start(), following


def _find_arrays(text: str) -> tuple[_Array, _Array] | None:
    """`columns` and `rows`."""
    try:
        begin, end = _find_section(text)
    except RobotError:
        return None
    arrays = dict[str, _Array]()
    for key in _KEY.finditer(text, begin, end):
        array = _parse_array(text, key.end())
        if array is not None:
            arrays.setdefault(key[1], array)
    return (arrays["columns"], arrays["rows"]) if len(arrays) == 2 else None


def _require_arrays(text: str) -> tuple[_Array, _Array]:
    arrays = _find_arrays(text)
    if arrays is None:
        raise RobotError("[mdh]: columns and rows are not found; edit the file as text")
    return arrays


def _parse_array(text: str, start: int) -> _Array | None:
    """The array that begins there; None if it does not end."""
    open_: list[_Array] = []
    for token in _TOKEN.finditer(text, start):
        if token.lastgroup == "open":
            open_.append(_Array(token.start()))
        elif token.lastgroup == "cell":
            open_[-1].cells.append(token.span())
        elif token.lastgroup == "close":
            closed_array = open_.pop()
            closed_array.end = token.end()
            if not open_:
                return closed_array
            open_[-1].arrays.append(closed_array)
    return None


def _get_item(items: "Sequence[_Entry]", number: int, what: str) -> "_Entry":
    if not 0 <= number < len(items):
        raise RobotError(f"[mdh]: there is no {what} {number + 1}; edit the file as text")
    return items[number]


def _strip_quotes(cell: str) -> str:
    if cell[:1] not in "\"'":
        return cell
    try:
        return str(tomllib.loads(f"cell = {cell}")["cell"])
    except tomllib.TOMLDecodeError:
        return cell[1:-1]


def quote_table_cell(cell: str, name: bool) -> str:
    """As TOML has it: numbers that are no names bare, all else as text; "" is 0."""
    plain = " ".join(cell.split()) or "0"
    if not name and re.fullmatch(r"[+-]?(0|[1-9]\d*)(\.\d+)?", plain):
        return plain
    escaped = plain.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
