"""A `.par` file as the text of a robot file, with what had to be decided or left out."""

import re
import unicodedata
from dataclasses import dataclass
from pathlib import PurePath

from modeler.robot.par.bodies import Bodies, bodies, gravity_entries
from modeler.robot.par.frames import GEOMETRY, Counts, Frame, counts, frames, variables
from modeler.robot.par.letters import Symbols
from modeler.robot.par.scan import Statements, scan
from modeler.robot.par.table import gravity, table_cells
from modeler.robot.place import listed

_NO_HOME = (
    "a .par file states no posture: [home] says near which one the loops are closed, and so which "
    "assembly mode is meant"
)


@dataclass(frozen=True)
class Converted:
    """A robot file made from another program's.

    Attributes:
        text: TOML.
        notes: what was decided, and what was not carried over; one line each.
    """

    text: str
    notes: tuple[str, ...]


def par_to_toml(data: bytes, where: str) -> Converted:
    """The robot file that says what the SYMORO file says.

    Frames 1 .. NL are rows; frames NL + 1 .. NJ are rows without a body, each tied rigidly to its
    second frame NJ + 1 .. NF by a row of `[loops]`.

    Args:
        data: contents of the file.
        where: its name, for messages and the name of a robot that has none.

    Raises:
        RobotError: the file is wrong; says line, key, entry, what was got, what was expected.

    Source: W. Khalil, D. Creusot, SYMORO+: a system for the symbolic modelling of robots,
        Robotica 15, 1997; W. Khalil, E. Dombre, Modeling, identification and control of robots,
        2002, section 7.3 (closed chains).
    """
    statements = scan(data, where)
    found = counts(statements)
    made = frames(statements, found)
    symbols = Symbols()
    _settle_motors(made, found, symbols.notes)
    names = variables(made, statements)
    other = [theirs for theirs, ours in names.items() if theirs != ours]
    if other:
        symbols.notes.append(f"joint variables are called q<row> here: {listed(other)}")
    table_cells(made, found, names, symbols, statements.place)
    links = bodies(statements, found, made)
    pull = gravity(gravity_entries(statements, symbols.notes), symbols, statements.place)
    notes = (*symbols.notes, *links.notes, *_structure_notes(statements, found))
    parts = [
        *_head(statements, where, notes, pull), "",
        *_symbols(symbols), *_table(made), *_loops(found), *_tables(links, made),
    ]  # fmt: skip
    while not parts[-1]:
        parts.pop()
    return Converted("\n".join(parts) + "\n", notes)


def _structure_notes(statements: Statements, found: Counts) -> list[str]:
    """What is to be known of the loops.

    Raises:
        RobotError: Type is no type.
    """
    notes = [_NO_HOME] if found.loops else []
    statement = statements.by_key.get("Type")
    if statement is None:
        return notes
    kind = statement.entries[0]
    if kind not in ("0", "1", "2"):
        raise statement.place.error(
            f'Type: got "{kind}"; expected 0 (simple), 1 (tree) or 2 (closed)'
        )
    if (kind == "2") != bool(found.loops):
        notes.append(
            f"Type is {kind}, but NJ - NL says that {found.loops} joints are cut, which counts"
        )
    return notes


def _head(statements: Statements, where: str, notes: tuple[str, ...], pull: list[str]) -> list[str]:
    name = _name(statements, where)
    return [
        f'name = "{name}"',
        f'title = "{_title(statements, name)}"',
        _notes(where, notes),
        f"gravity = [{', '.join(_quoted(cell) for cell in pull)}]",
    ]


def _settle_motors(made: list[Frame], found: Counts, notes: list[str]) -> None:
    """A file in which no joint has a motor says nothing of motors, if there are no loops."""
    if not found.loops and not any(frame.mu for frame in made):
        for frame in made:
            frame.mu = int(frame.home is not None)
        notes.append("Mu is 0 for every joint: all are taken as actuated")


def _name(statements: Statements, where: str) -> str:
    """The name with the letters that names may have."""
    for wanted in (statements.name, PurePath(where).stem):
        plain = unicodedata.normalize("NFKD", wanted).encode("ascii", "ignore").decode()
        name = re.sub(r"[^A-Za-z0-9_-]+", "-", plain).strip("-_")
        if name:
            return name
    return "robot"


def _title(statements: Statements, name: str) -> str:
    title = "".join(c for c in statements.name if c.isprintable() and c not in '"\\')
    return title.strip() or name


def _notes(where: str, notes: tuple[str, ...]) -> str:
    lines = [f"Read from the SYMORO file {PurePath(where).name}.", *(f"* {n}." for n in notes)]
    text = "\n".join(lines).replace("\\", "/").replace('"""', "'''")
    text = "".join(c for c in text if c.isprintable() or c == "\n")
    return f'notes = """\n{text}"""'


def _quoted(cell: str) -> str:
    """A TOML cell: whole numbers bare, all else as text."""
    return cell if re.fullmatch(r"-?\d+(\.\d+)?", cell) else f'"{cell}"'


def _symbols(symbols: Symbols) -> list[str]:
    if not symbols.values:
        return []
    lines = ["[symbols]"]
    for name, worth in symbols.values.items():
        value = f'"{worth}"' if isinstance(worth, str) else repr(worth)
        comment = symbols.comments.get(name)
        start = f"{name} = {value}"
        lines.append(f"{start:<37} # {comment}" if comment else start)
    return [*lines, ""]


def _table(made: list[Frame]) -> list[str]:
    """`[mdh]`, aligned; columns that are 0 everywhere are left out."""
    used = [c for c in GEOMETRY if any(not frame.cells[c].is_zero for frame in made)]
    columns = ["j", "a", "mu", "sigma", *used]
    cells = [[f'"{column}"' for column in columns]]
    for frame in made:
        geometry = [frame.cells[c] for c in used]
        cells.append(
            [f'"{frame.number}"', f'"{frame.antecedent}"', str(frame.mu), str(frame.sigma)]
            + ["0" if cell.is_zero else _quoted(cell.text) for cell in geometry]
        )
    widths = [max(len(row[i]) for row in cells) + 2 for i in range(len(columns))]
    lines = [
        "".join(f"{cell},".ljust(width) for cell, width in zip(row, widths, strict=True))
        for row in cells
    ]
    lines = [line.rstrip().removesuffix(",") for line in lines]
    return [
        "[mdh]                                 # sigma: 0 revolute, 1 prismatic, 2 fixed; "
        "mu: 1 actuated, 0 passive",
        f"columns = [{lines[0]}]",
        "rows = [",
        *(f"          [{line}]," for line in lines[1:]),
        "]",
        "",
    ]


def _loops(found: Counts) -> list[str]:
    """Every cut joint meets its second frame."""
    if not found.loops:
        return []
    rows = [
        f'  ["cut{k + 1}", "{found.links + k + 1}", "{found.joints + k + 1}", "rigid"],'
        for k in range(found.loops)
    ]
    columns = 'columns = ["loop", "frame", "meets", "joint"]'
    return ["[loops]", columns, "rows = [", *rows, "]", ""]


def _tables(links: Bodies, made: list[Frame]) -> list[str]:
    lines = []
    if links.links:
        lines += ["[links]                               # parameters that these rows have"]
        for name, has in links.links.items():
            lines.append(f"{name} = [{', '.join(_quoted(key) for key in has)}]")
        lines.append("")
    actuated = [str(frame.number) for frame in made if frame.mu]
    if links.effects:
        lines.append("[effects]")
        for effect, joints in links.effects.items():
            names = ", ".join(f'"{joint}"' for joint in joints)
            where = '"all"' if joints == actuated else f"[{names}]"
            lines.append(f"{effect} = {where}")
        lines.append("")
    if links.parameters:
        lines.append("[parameters]                          # kg m^2, kg m, kg; N m s/rad, N m")
        lines += [f"{name} = {worth!r}" for name, worth in links.parameters.items()]
        lines.append("")
    return lines
