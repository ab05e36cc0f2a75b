"""A robot file made of another program's: its text, and what had to be decided or left out."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from modeler.core.errors import RobotError
from modeler.robot.mechanism import MARK
from modeler.robot.table import GEOMETRY


@dataclass(frozen=True)
class ConvertedRobot:
    """A robot file made from another program's.

    Attributes:
        text: TOML.
        notes: what was decided, and what was not carried over; one line each.
    """

    text: str
    notes: tuple[str, ...]


@dataclass(frozen=True)
class TextRow:
    """A row of `[mdh]` as text.

    Attributes:
        name, antecedent: of rows.
        mu, sigma: as in the table.
        cells: column -> expression; what is left out is 0.
        comment: behind the row.
    """

    name: str
    antecedent: str
    mu: int
    sigma: int
    cells: Mapping[str, str] = field(default_factory=dict)
    comment: str = ""


def format_head(
    name: str, title: str, source: str, notes: Sequence[str], gravity: Sequence[str]
) -> list[str]:
    """Returns what stands above the first table.

    Args:
        name: of the robot.
        title: as the other program has it.
        source: such as "SYMORO file x.par".
        notes: what was decided.
        gravity: cells.
    """
    printable_title = "".join(c for c in title if c.isprintable() and c not in '"\\').strip()
    lines = "\n".join([f"Read from the {source}.", *(f"* {n}." for n in notes)])
    lines = remove_unprintable(lines.replace("\\", "/").replace('"""', "'''"), "\n")
    return [
        f'name = "{name}"',
        f'title = "{printable_title or name}"',
        f'notes = """\n{lines}"""',
        f"gravity = [{', '.join(quote_cell(cell) for cell in gravity)}]",
        "",
    ]


def remove_unprintable(text: str, more: str = "") -> str:
    """Returns the text without what no file should hold."""
    return "".join(c for c in text if c.isprintable() or c in more)


def quote_cell(cell: str) -> str:
    """Returns a TOML cell: whole numbers bare, all else as text."""
    return cell if re.fullmatch(r"-?\d+(\.\d+)?", cell) else f'"{cell}"'


def format_number(value: float, scale: float = 0.0) -> str:
    """Returns a TOML number, of as few digits as are within rounding of it.

    Args:
        value: what to print.
        scale: of what was added up to it; below 1e-14 of that, adding leaves nothing but rounding.
    """
    slack = 1e-14 * max(abs(value), scale)
    shorter = (float(f"{value:.{digits}g}") for digits in range(1, 16))
    short = next((short for short in shorter if abs(short - value) <= slack), float(value))
    return repr(short if abs(short) > slack else 0.0)


def align_cells(cells: Sequence[Sequence[str]]) -> list[str]:
    """Returns rows of a table, cells below each other."""
    widths = [max(map(len, column)) + 2 for column in zip(*cells, strict=True)]
    lines = [
        "".join(f"{cell},".ljust(width) for cell, width in zip(row, widths, strict=True))
        for row in cells
    ]
    return [line.rstrip().removesuffix(",") for line in lines]


def format_columns_and_rows(
    columns: Sequence[str], rows: Sequence[Sequence[str]], comments: Sequence[str] = ()
) -> list[str]:
    """Returns `columns` and `rows` of a table, aligned; a comment behind every row that has one."""
    first, *lines = align_cells([[f'"{column}"' for column in columns], *rows])
    lines = [f"          [{line}]," for line in lines]
    width = max(map(len, lines), default=0) + 2
    row_comments = [*comments, *[""] * (len(lines) - len(comments))]
    lines = [
        f"{line.ljust(width)}# {remove_unprintable(comment)}" if comment else line
        for line, comment in zip(lines, row_comments, strict=True)
    ]
    return [f"columns = [{first}]", "rows = [", *lines, "]", ""]


def format_mdh(rows: Sequence[TextRow]) -> list[str]:
    """Returns `[mdh]`, aligned; columns that are 0 everywhere are left out."""
    used = [c for c in GEOMETRY if any(row.cells.get(c, "0") != "0" for row in rows)]
    cells = [
        [f'"{row.name}"', f'"{row.antecedent}"', str(row.mu), str(row.sigma)]
        + [quote_cell(row.cells.get(c, "0")) for c in used]
        for row in rows
    ]
    return [
        "[mdh]                                 # sigma: 0 revolute, 1 prismatic, 2 fixed; "
        "mu: 1 actuated, 0 passive",
        *format_columns_and_rows(
            ["j", "a", "mu", "sigma", *used], cells, [row.comment for row in rows]
        ),
    ]


def format_symbols(values: Mapping[str, float | str], comments: Mapping[str, str]) -> list[str]:
    """Returns lines of `[symbols]`."""
    lines = []
    for name, value in values.items():
        start = f'{name} = "{value}"' if isinstance(value, str) else f"{name} = {value!r}"
        lines.append(f"{start:<37} # {comments[name]}" if comments.get(name) else start)
    return lines


def format_effects(effects: Mapping[str, Sequence[str]], actuated: Sequence[str]) -> list[str]:
    """Returns lines of `[effects]`: "all" where all actuated joints have it."""
    return [
        f"{effect} = " + ('"all"' if list(joints) == list(actuated) else format_name_list(joints))
        for effect, joints in effects.items()
    ]


LINKS = f"{'[links]':<37} # parameters that these rows have"
PARAMETERS = f"{'[parameters]':<37} # kg m^2, kg m, kg; N m s/rad, N m"


def format_loops(loops: Sequence[tuple[str, str, str, str]]) -> list[str]:
    """Returns `[loops]`: name, the frames that meet, and how."""
    if not loops:
        return []
    rows = [[f'"{cell}"' for cell in loop] for loop in loops]
    return ["[loops]", *format_columns_and_rows(["loop", "frame", "meets", "joint"], rows)]


def format_name_list(names: Sequence[str]) -> str:
    """Returns a TOML list of names, such as `["1", "2"]`."""
    return "[" + ", ".join(f'"{name}"' for name in names) + "]"


def format_section(head: str, lines: Sequence[str]) -> list[str]:
    """Returns a table and a blank line; nothing for one without entries."""
    return [head, *lines, ""] if lines else []


def join_lines(parts: Sequence[str]) -> str:
    """Returns the file of its lines."""
    return "\n".join(parts).rstrip("\n") + "\n"


# The cells of `[mdh]` where they stand in the text of a robot file, to change one and no more.


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
    """Returns the cells of the table; None where the text has none that can be found."""
    arrays = _find_arrays(text)
    if arrays is None:
        return None
    columns, rows = arrays

    def extract_cells(array: _Array) -> tuple[str, ...]:
        return tuple(_strip_quotes(text[start:end]) for start, end in array.cells)

    return TableText(extract_cells(columns), tuple(map(extract_cells, rows.arrays)))


def replace_cell(text: str, row: int, column: int, cell: str) -> str:
    """Returns the text with another cell; the columns stay below each other where there is room.

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
    """Returns the text with a row more, behind the row of that number.

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
    """Returns the text without that row.

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
    """Returns the text with another table.

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
    """Returns the row and the column that the line of a reader is about.

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
    """Returns whose table it is, as the text has it."""
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
    """Writes a TOML cell: numbers that are no names bare, all else as text; "" is 0."""
    plain = " ".join(cell.split()) or "0"
    if not name and re.fullmatch(r"[+-]?(0|[1-9]\d*)(\.\d+)?", plain):
        return plain
    escaped = plain.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
