"""The cells of `[mdh]` where they stand in the text of a robot file, to change one and no more."""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from modeler.core.errors import RobotError
from modeler.robot.loops import MARK
from modeler.robot.robot_text import aligned

_Entry = TypeVar("_Entry")
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


def table_text(text: str) -> TableText | None:
    """The cells of the table; None where the text has none that can be found."""
    found = _arrays(text)
    if found is None:
        return None
    columns, rows = found

    def cells(array: _Array) -> tuple[str, ...]:
        return tuple(_bare(text[start:end]) for start, end in array.cells)

    return TableText(cells(columns), tuple(map(cells, rows.arrays)))


def with_cell(text: str, row: int, column: int, cell: str) -> str:
    """The text with another cell; the columns stay below each other where there is room.

    Args:
        text: of the file.
        row: number, from 0; -1 for the names of the columns.
        column: number, from 0.
        cell: what it is to say, without quotes.

    Raises:
        RobotError: there is no such cell, or it cannot be replaced.
    """
    columns, rows = _table(text)
    array = columns if row < 0 else _at(rows.arrays, row, "row")
    start, end = _at(array.cells, column, "column")
    name = "" if row < 0 else _bare(text[slice(*_at(columns.cells, column, "column"))])
    new = quoted_cell(cell, row < 0 or name in _names(text))
    behind = re.match(r",( *)", text[end:])
    if behind is not None:
        width = end - start + len(behind[1])
        new = f"{new},{' ' * max(1, width - len(new))}"
        end += behind.end()
    return _sure(text, text[:start] + new + text[end:])


def with_row(text: str, after: int, cells: Sequence[str]) -> str:
    """The text with a row more, behind the row of that number; -1: before all others.

    Raises:
        RobotError: there is no such row, or no table.
    """
    columns, rows = _table(text)
    names = [_bare(text[slice(*span)]) for span in columns.cells]
    kept = _names(text)
    line = ", ".join(quoted_cell(c, n in kept) for c, n in zip(cells, names, strict=False))
    line = f"[{line}],"
    if after < 0:
        return _sure(text, text[: rows.start + 1] + f"\n          {line}" + text[rows.start + 1 :])
    place = _at(rows.arrays, after, "row").end
    comma = re.match(r"[ \t]*,", text[place:])
    head = text[:place] + ("" if comma else ",")
    rest = text[place:]
    own = re.match(r"[^\n]*", rest)
    assert own is not None
    # A comment behind the row stays behind it; the table may end on that line.
    closing = len(own[0]) >= rows.end - place
    cut = (comma.end() if comma else 0) if closing else own.end()
    return _sure(text, f"{head}{rest[:cut]}\n          {line}{rest[cut:]}")


def without_row(text: str, row: int) -> str:
    """The text without that row.

    Raises:
        RobotError: there is no such row.
    """
    _, rows = _table(text)
    own = _at(rows.arrays, row, "row")
    start, end = own.start, own.end
    behind = re.match(r"[ \t]*,?[ \t]*(?:#[^\n]*)?(?=\n)|[ \t]*,?[ \t]*", text[end:])
    end += behind.end() if behind else 0
    line = text.rfind("\n", 0, start)
    if not text[line + 1 : start].strip() and text[end : end + 1] == "\n":
        start = line
    return _sure(text, text[:start] + text[end:])


def with_columns(text: str, columns: Sequence[str], rows: Sequence[Sequence[str]],
                 convention: str = "") -> str:  # fmt: skip
    """The text with another table.

    Args:
        text: of the file.
        columns: names.
        rows: cells by column.
        convention: whose table it is from now on; "": as before.

    Raises:
        RobotError: there is no table.
    """
    if convention:
        text = _with_convention(text, convention)
    columns_, rows_ = _table(text)
    kept = _names(text)
    quoted = [
        [quoted_cell(c, n in kept) for c, n in zip(row, columns, strict=True)] for row in rows
    ]
    head, *lines = aligned([[f'"{c}"' for c in columns], *quoted])
    body = "".join(f"          [{line}],\n" for line in lines)
    for array, new in sorted(
        ((columns_, f"[{head}]"), (rows_, f"[\n{body}]")), key=lambda one: -one[0].start
    ):
        text = text[: array.start] + new + text[array.end :]
    return _sure("", text)


def _with_convention(text: str, convention: str) -> str:
    begin, end = _section(text)
    own = re.compile(r"^[ \t]*convention[ \t]*=[^\n]*\n", re.MULTILINE)
    stated = f'convention = "{convention}"\n' if convention != "khalil" else ""
    section = own.sub("", text[begin:end])
    first = section.index("\n") + 1
    return text[:begin] + section[:first] + stated + section[first:] + text[end:]


def cell_of(error: str, text: str) -> tuple[int, str] | None:
    """The row and the column that the line of a reader is about.

    Args:
        error: the line.
        text: of the file.

    Returns:
        Number of the row, from 0, -1 for the names of columns, and the column as the line calls
        it, "" for the row as a whole; None of a line that is about something else.
    """
    table = table_text(text)
    if table is None:
        return None
    if re.search(r"\[mdh\], columns?\b", error):
        return -1, _column(error)
    twice = re.search(r"\[mdh\], row .* stands in rows \d+ and (\d+)", error)
    if twice:
        return int(twice[1]) - 1, "j"
    numbered = re.search(r"\[mdh\], row (\d+)\b", error)
    if numbered:
        row = int(numbered[1]) - 1
        return (row, _column(error)) if row < len(table.rows) else None
    named = re.search(r"\[mdh\],? row \"([^\"]*)\"", error)
    if named is None or "j" not in table.columns:
        return None
    for row, cells in enumerate(table.rows):
        names = dict(zip(table.columns, cells, strict=False))
        pattern = re.escape(names.get("j", "")).replace(re.escape(MARK), r"\w+")
        if re.fullmatch(pattern, named[1]):
            return row, _column(error)
    return None


def _column(error: str) -> str:
    found = re.search(r", column (\w+)", error)
    return found[1] if found else ""


def convention_of(text: str) -> str:
    """Whose table it is, as the text has it."""
    begin, end = _section(text)
    stated = re.search(r"(?m)^[ \t]*convention[ \t]*=[ \t]*[\"'](\w+)", text[begin:end])
    return stated[1] if stated else "khalil"


def names_in(convention: str) -> tuple[str, ...]:
    """Columns of names, which stand in quotes."""
    return ("j", "a") if convention == "khalil" else ("j", "parent")


def _names(text: str) -> tuple[str, ...]:
    return names_in(convention_of(text))


def _section(text: str) -> tuple[int, int]:
    """Where `[mdh]` begins and ends."""
    head = _HEAD.search(text)
    if head is None:
        raise RobotError("the text has no table [mdh]; write one with columns and rows")
    following = next((m.start() for m in _NEXT.finditer(text, head.end())), len(text))
    return head.start(), following


def _arrays(text: str) -> tuple[_Array, _Array] | None:
    """`columns` and `rows`."""
    try:
        begin, end = _section(text)
    except RobotError:
        return None
    found = dict[str, _Array]()
    for key in _KEY.finditer(text, begin, end):
        array = _array(text, key.end())
        if array is not None:
            found.setdefault(key[1], array)
    return (found["columns"], found["rows"]) if len(found) == 2 else None


def _table(text: str) -> tuple[_Array, _Array]:
    found = _arrays(text)
    if found is None:
        raise RobotError("[mdh]: columns and rows are not found; edit the file as text")
    return found


def _array(text: str, start: int) -> _Array | None:
    """The array that begins there; None if it does not end."""
    open_: list[_Array] = []
    for token in _TOKEN.finditer(text, start):
        if token.lastgroup == "open":
            open_.append(_Array(token.start()))
        elif token.lastgroup == "cell":
            open_[-1].cells.append(token.span())
        elif token.lastgroup == "close":
            own = open_.pop()
            own.end = token.end()
            if not open_:
                return own
            open_[-1].arrays.append(own)
    return None


def _at(items: "Sequence[_Entry]", number: int, what: str) -> "_Entry":
    if not 0 <= number < len(items):
        raise RobotError(f"[mdh]: there is no {what} {number + 1}; edit the file as text")
    return items[number]


def _bare(cell: str) -> str:
    if cell[:1] not in "\"'":
        return cell
    try:
        return str(tomllib.loads(f"cell = {cell}")["cell"])
    except tomllib.TOMLDecodeError:
        return cell[1:-1]


def quoted_cell(cell: str, name: bool) -> str:
    """As TOML has it: numbers that are no names bare, all else as text; "" is 0."""
    plain = " ".join(cell.split()) or "0"
    if not name and re.fullmatch(r"[+-]?(0|[1-9]\d*)(\.\d+)?", plain):
        return plain
    escaped = plain.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _sure(before: str, after: str) -> str:
    """The changed text, if it is TOML, or the text was none before."""
    try:
        tomllib.loads(after)
    except tomllib.TOMLDecodeError:
        try:
            tomllib.loads(before)
        except tomllib.TOMLDecodeError:
            return after
        raise RobotError("[mdh]: the table cannot be changed; edit the file as text") from None
    return after
