"""A robot file made of another program's: its text, and what had to be decided or left out."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from modeler.core.errors import RobotError
from modeler.robot.mechanism import MARK
from modeler.robot.table import GEOMETRY

if TYPE_CHECKING:
    from tomlkit import TOMLDocument
    from tomlkit.items import Array, Item

Words = Sequence[str]
Cells = Sequence[Words]


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


def format_head(name: str, title: str, source: str, notes: Words, gravity: Words) -> list[str]:
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


def align_cells(cells: Cells) -> list[str]:
    """Returns rows of a table, cells below each other."""
    widths = [max(map(len, column)) + 2 for column in zip(*cells, strict=True)]
    padded = [zip(row, widths, strict=True) for row in cells]
    lines = ["".join(f"{cell},".ljust(width) for cell, width in row) for row in padded]
    return [line.rstrip().removesuffix(",") for line in lines]


def format_columns_and_rows(columns: Words, rows: Cells, comments: Words = ()) -> list[str]:
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


_NAMES = (("j", "parent"), ("j", "a"))
"""Columns of names, which stand in quotes: of others' tables, of Khalil's."""
_HERE = "\N{WHITE SQUARE}"
"""Stands for a cell while its place in the text is looked for."""


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
    try:
        _, columns, rows = _parse_table(text)
    except RobotError:
        return None
    return TableText(_format_cells(columns), tuple(map(_format_cells, rows)))


def _format_cells(cells: "Array") -> tuple[str, ...]:
    """Returns cells as they are written, without quotes."""
    return tuple(str(cell) if isinstance(cell, str) else cell.as_string() for cell in cells)


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
    document, columns, rows = _parse_table(text)
    cells = columns if row < 0 else _get_item(rows, row, "row")
    before = _get_item(cells, column, "column").as_string()
    name = "" if row < 0 else str(_get_item(columns, column, "column"))
    new = quote_table_cell(cell, row < 0 or name in _NAMES[read_table_convention(text) == "khalil"])
    cells[column] = _HERE
    head, _, rest = document.as_string().partition(f'"{_HERE}"')
    if gap := re.match(r",( *)", rest):
        width = len(before) + len(gap[1])
        return f"{head}{new},{' ' * max(1, width - len(new))}{rest[gap.end() :]}"
    return head + new + rest


def insert_row(text: str, after: int, cells: Words) -> str:
    """Returns the text with a row more, behind the row of that number.

    Raises:
        RobotError: there is no such row, or no table.
    """
    document, columns, rows = _parse_table(text)
    _get_item(rows, after, "row")
    rows.insert(after + 1, _build_array(_quote_cells(cells, columns, read_table_convention(text))))
    return document.as_string()


def remove_row(text: str, row: int) -> str:
    """Returns the text without that row.

    Raises:
        RobotError: there is no such row.
    """
    document, _, rows = _parse_table(text)
    _get_item(rows, row, "row")
    del rows[row]
    return document.as_string()


def replace_table(text: str, columns: Words, rows: Cells, convention: str) -> str:
    """Returns the text with another table.

    Args:
        text: of the file.
        columns: names.
        rows: cells by column.
        convention: whose table it is from now on.

    Raises:
        RobotError: there is no table.
    """
    import tomlkit

    document, _, _ = _parse_table(text)
    cells = [_quote_cells(row, columns, convention) for row in rows]
    table: Any = document["mdh"]
    table.pop("convention", None)
    stated = {"convention": convention} if convention != "khalil" else {}
    written = tomlkit.parse("\n".join(format_columns_and_rows(columns, cells)))
    for key, entry in {**written, **stated}.items():
        table[key] = entry
    return document.as_string()


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
    document, _, _ = _parse_table(text)
    table: Any = document["mdh"]
    return str(table.get("convention", "khalil"))


def _parse_table(text: str) -> "tuple[TOMLDocument, Array, Array]":
    """Returns the document, and `columns` and `rows` of `[mdh]` in it."""
    import tomlkit  # 0.05 s, for edits only
    from tomlkit.items import Array

    try:
        document = tomlkit.parse(text)
    except ValueError:
        raise RobotError("the text is no TOML; correct the line that its error names") from None
    table: Any = document.get("mdh", {})
    columns, rows = table.get("columns"), table.get("rows")
    if not isinstance(columns, Array) or not isinstance(rows, Array):
        raise RobotError("[mdh]: columns and rows are not found; edit the file as text")
    return document, columns, rows


def _get_item(items: "Array", number: int, what: str) -> Any:
    if not 0 <= number < len(items):
        raise RobotError(f"[mdh]: there is no {what} {number + 1}; edit the file as text")
    return items[number]


def _build_array(cells: Words) -> "Item":
    import tomlkit

    return tomlkit.value(f"[{', '.join(cells)}]")


def _quote_cells(cells: Words, columns: Words, convention: str) -> list[str]:
    names = _NAMES[convention == "khalil"]
    return [quote_table_cell(c, n in names) for c, n in zip(cells, columns, strict=False)]


def quote_table_cell(cell: str, name: bool) -> str:
    """Writes a TOML cell: numbers that are no names bare, all else as text; "" is 0."""
    plain = " ".join(cell.split()) or "0"
    if not name and re.fullmatch(r"[+-]?(0|[1-9]\d*)(\.\d+)?", plain):
        return plain
    escaped = plain.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
