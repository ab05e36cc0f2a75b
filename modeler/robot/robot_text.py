"""A robot file made of another program's: its text, and what had to be decided or left out."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from modeler.robot.conventions import GEOMETRY


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
    """What stands above the first table.

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
    """The text without what no file should hold."""
    return "".join(c for c in text if c.isprintable() or c in more)


def quote_cell(cell: str) -> str:
    """A TOML cell: whole numbers bare, all else as text."""
    return cell if re.fullmatch(r"-?\d+(\.\d+)?", cell) else f'"{cell}"'


def format_number(value: float, scale: float = 0.0) -> str:
    """A TOML number, of as few digits as are within rounding of it.

    Args:
        value: what to print.
        scale: of what was added up to it; below 1e-14 of that, adding leaves nothing but rounding.
    """
    slack = 1e-14 * max(abs(value), scale)
    shorter = (float(f"{value:.{digits}g}") for digits in range(1, 16))
    short = next((short for short in shorter if abs(short - value) <= slack), float(value))
    return repr(short if abs(short) > slack else 0.0)


def align_cells(cells: Sequence[Sequence[str]]) -> list[str]:
    """Rows of a table, cells below each other."""
    widths = [max(map(len, column)) + 2 for column in zip(*cells, strict=True)]
    lines = [
        "".join(f"{cell},".ljust(width) for cell, width in zip(row, widths, strict=True))
        for row in cells
    ]
    return [line.rstrip().removesuffix(",") for line in lines]


def format_columns_and_rows(
    columns: Sequence[str], rows: Sequence[Sequence[str]], comments: Sequence[str] = ()
) -> list[str]:
    """`columns` and `rows` of a table, aligned; a comment behind every row that has one."""
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
    """`[mdh]`, aligned; columns that are 0 everywhere are left out."""
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
    """Lines of `[symbols]`."""
    lines = []
    for name, value in values.items():
        start = f'{name} = "{value}"' if isinstance(value, str) else f"{name} = {value!r}"
        lines.append(f"{start:<37} # {comments[name]}" if comments.get(name) else start)
    return lines


def format_effects(effects: Mapping[str, Sequence[str]], actuated: Sequence[str]) -> list[str]:
    """Lines of `[effects]`: "all" where all actuated joints have it."""
    return [
        f"{effect} = " + ('"all"' if list(joints) == list(actuated) else format_name_list(joints))
        for effect, joints in effects.items()
    ]


LINKS = f"{'[links]':<37} # parameters that these rows have"
PARAMETERS = f"{'[parameters]':<37} # kg m^2, kg m, kg; N m s/rad, N m"


def format_loops(loops: Sequence[tuple[str, str, str, str]]) -> list[str]:
    """`[loops]`: name, the frames that meet, and how."""
    if not loops:
        return []
    rows = [[f'"{cell}"' for cell in loop] for loop in loops]
    return ["[loops]", *format_columns_and_rows(["loop", "frame", "meets", "joint"], rows)]


def format_name_list(names: Sequence[str]) -> str:
    """`["1", "2"]`."""
    return "[" + ", ".join(f'"{name}"' for name in names) + "]"


def format_section(head: str, lines: Sequence[str]) -> list[str]:
    """A table and a blank line; nothing for one without entries."""
    return [head, *lines, ""] if lines else []


def join_lines(parts: Sequence[str]) -> str:
    """The file of its lines."""
    return "\n".join(parts).rstrip("\n") + "\n"
