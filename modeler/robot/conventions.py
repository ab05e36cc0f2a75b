"""Whose table `[mdh]` is: that of Khalil and Kleinfinger, of Craig, of Denavit and Hartenberg.

All are read as rows of Khalil's. Craig's (Introduction to Robotics, 1986) are the same under other
letters. A classical row (Denavit and Hartenberg 1955; Paul 1981) is

    Rz(theta_j) Tz(d_j) Tx(a_j) Rx(alpha_j)

so its a and alpha stand in the next row of Khalil's, Rx(alpha) Tx(d) Rz(theta) Tz(r), and those of
the last row in a frame fixed on the last link: the same product, cut before each joint.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, NamedTuple

from modeler.core.expression import Expression, parse_expression
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.robot import Joint, Robot

COLUMNS = ("j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r")
GEOMETRY = COLUMNS[4:]
ANGLES = ("gamma", "alpha", "theta")

Row = dict[str, Any]
"""Cells by Khalil's column."""

_EMPTY: Mapping[str, str] = MappingProxyType({})
CONVENTIONS: Mapping[str, Mapping[str, str]] = {
    "khalil": {column: column for column in COLUMNS},
    "craig": {
        "j": "j", "a": "parent", "mu": "mu", "sigma": "sigma", "gamma": "gamma", "b": "b",
        "alpha": "alpha", "d": "a", "r": "d", "theta": "theta",
    },
    "classical": {
        "j": "j", "mu": "mu", "sigma": "sigma", "theta": "theta", "r": "d", "d": "a",
        "alpha": "alpha",
    },
}  # fmt: skip
"""By whose table it is: Khalil's column -> its letter there, in the order in which they print."""
_ONE_ROW = {
    "khalil": '["j", "alpha", "d", "theta", "r"], rows = [["1", 0, 0, "q1", 0]]',
    "craig": '["j", "alpha", "a", "d", "theta"], rows = [["1", 0, 0, 0, "q1"]]',
    "classical": '["j", "theta", "d", "a", "alpha"], rows = [["1", "q1", 0, 0, 0]]',
}
_GREEK = {
    "\u03b1": "alpha", "\u03b3": "gamma", "\u03b8": "theta", "\u03c3": "sigma", "\u03bc": "mu",
    "\u00b5": "mu",
}  # fmt: skip
_SERIAL = (
    "a classical table is of a serial robot, for its a and alpha place the one axis that follows; "
    'write the table in the notation of Khalil or Craig, convention = "khalil" or "craig"'
)
_ENDS = ("tool", "end", "flange", "last")


@dataclass(frozen=True)
class RowPlace(TomlCell):
    """The place of a row of the table.

    Attributes:
        row: its name.
        letters: Khalil's column -> how the table calls it.
        before: in a classical table the place of the row before, where alpha and d are written.
    """

    row: str = ""
    letters: Mapping[str, str] = field(default_factory=lambda: _EMPTY)
    before: "RowPlace | None" = None

    def find_owner(self, column: str) -> "RowPlace":
        """Where that cell is written."""
        return self.before if self.before and column in ("alpha", "d") else self

    def get_letter(self, column: str) -> str:
        """How the table calls that column of Khalil's."""
        return self.letters.get(column, column)

    def locate_column(self, column: str, value: Any = None) -> TomlCell:
        """The place of a cell."""
        return self.find_owner(column).enter(f"column {self.get_letter(column)}", value)


def read_convention(table: TomlCell, document: Mapping[str, Any]) -> str:
    """Whose table it is.

    Args:
        table: `[mdh]`.
        document: the whole file.

    Raises:
        RobotError: nobody's, or a classical one of a robot that is not serial.
    """
    place = table.enter(
        "convention", table.read_table(format_table_example("khalil")).get("convention", "khalil")
    )
    if place.value not in list(CONVENTIONS):
        names = join_names(f'"{name}"' for name in CONVENTIONS)
        raise place.make_mismatch(f"one of {names}{suggest_name(place.value, CONVENTIONS)}")
    branched = [key for key in ("legs", "platform", "loops") if key in document]
    if place.value == "classical" and branched:
        key = branched[0] if branched[0] == "legs" else f"[{branched[0]}]"
        raise place.make_error(f'got "classical", and the file has {key}; {_SERIAL}')
    return str(place.value)


def format_table_example(convention: str) -> str:
    """Columns and a row, as text."""
    return f"columns = {_ONE_ROW[convention]}"


def read_khalil_columns(place: TomlCell, convention: str) -> list[str]:
    """The columns of the table as Khalil calls them.

    Raises:
        RobotError: columns that such a table has not, or twice, or no names of rows.
    """
    written_columns = place.read_list(_ONE_ROW[convention].split(", rows")[0])
    columns = [_GREEK.get(c, c) if isinstance(c, str) else c for c in written_columns]
    ours = {letter: column for column, letter in CONVENTIONS[convention].items()}
    for number, column in enumerate(columns, start=1):
        if column not in list(ours):
            advice = '; row names stand in column "j"' if "j" not in columns else ""
            if column == "parent" and convention == "khalil":
                advice = '; of Craig\'s table? Write convention = "craig" in [mdh]'
            elif convention == "classical" and column in ("parent", "gamma", "b"):
                advice = f"; {_SERIAL}"
            elif convention != "khalil" and column == "r":
                advice = (
                    f'; r of Khalil is d in this table, and d is a: convention = "{convention}"'
                )
            raise place.make_error(
                f"entry {number} is {quote_value(column)}{suggest_name(column, ours)}; expected "
                "names among "
                f"{join_names(ours)}{advice}"
            )
        if column in columns[: number - 1]:
            raise place.make_error(f"{quote_value(column)} stands twice; remove one and its cells")
    if "j" not in columns:
        raise place.make_error(
            f'column "j" (row names) is missing, got {quote_value(columns)}; add it'
        )
    return [ours[column] for column in columns]


def check_convention(
    columns: Sequence[str], rows: Sequence[Row], place: TomlCell, stated: bool
) -> None:
    """Refuse a table that reads like that of another convention than it is said to be.

    Args:
        columns: Khalil's, in the order of the file.
        rows: their cells.
        place: of the table.
        stated: True if the file says whose it is.

    Raises:
        RobotError: the line to write.
    """
    above = ["0", *(str(row["j"]) for row in rows[:-1])]
    convention = place.value.get("convention", "khalil")
    if convention != "khalil":
        if len(rows) > 1 and [row.get("d") for row in rows] == above:
            raise place.enter("column a").make_error(
                f"got {join_names(above)}, the names of the rows above; a is a length in this "
                'convention: write convention = "khalil", where a is the antecedent'
            )
        return
    order = [c for c in columns if c in ("alpha", "a", "d", "theta")]
    if stated or "r" in columns or not {"alpha", "d", "theta"} <= set(order):
        return
    foreign = order.index("theta") < order.index("d") < order.index("alpha")
    if "a" in order:
        cells = [row["a"] for row in rows]
        zeros = all(cell == 0 for cell in cells)  # not "0", the base
        foreign = foreign or zeros or order.index("alpha") < order.index("a")
        named = all(isinstance(cell, str) and not is_length(cell) for cell in cells)
        foreign &= list(map(str, cells)) != above and not (named and set(cells) != {"0"})
    if foreign:
        raise place.enter("columns").make_error(
            f"got {join_names(order)}, which reads like another notation, in which "
            f"{'a is a length' if 'a' in order else 'd is along z'}; "
            f"{suggest_convention(columns, rows)}"
        )


def is_length(cell: Any) -> bool:
    """True of a cell that is no name of a row, but may be a length."""
    if isinstance(cell, float):
        return True
    return isinstance(cell, str) and not cell.isdigit() and any(c.isdigit() for c in cell)


def suggest_convention(columns: Sequence[str], rows: Sequence[Row]) -> str:
    """The line to write, by where the table begins and ends with zeros."""
    zero = [all(row.get(c, 0) in (0, "0") for c in ("alpha", "a")) for row in rows]
    classical = columns.index("theta") < columns.index("alpha") if "alpha" in columns else False
    if zero and zero[0] != zero[-1]:  # Craig's first axis is z0; often the last frame is the end
        classical = zero[-1]
    lines = [
        'convention = "craig" in [mdh] (alpha and a stand before the joint)',
        'convention = "classical" in [mdh] (behind it: Denavit and Hartenberg)',
    ]
    first, second = reversed(lines) if classical else lines
    khalil = "a names antecedents" if "a" in columns else "d is along x"
    return (
        f'write {first} or {second}, and "khalil" where {khalil}; `modeler new arm.toml '
        "--convention craig` begins such a file"
    )


def shift_classical_rows(rows: Sequence[tuple[Row, RowPlace]]) -> list[tuple[Row, RowPlace]]:
    """Classical rows as Khalil's; a fixed frame ends the last link where it has a or alpha."""
    khalil_rows: list[tuple[Row, RowPlace]] = []
    carried: Row = {}
    before: RowPlace | None = None
    for row, place in rows:
        unshifted_cells = {c: cell for c, cell in row.items() if c not in ("alpha", "d")}
        here = RowPlace(place.file, place.location, None, place.row, place.letters, before)
        khalil_rows.append(({**unshifted_cells, **carried}, here))
        carried, before = {c: row[c] for c in ("alpha", "d") if c in row}, place
    if before is not None and any(cell not in (0, "0") for cell in carried.values()):
        names = [row["j"] for row, _ in rows]
        name = next(n for n in (*_ENDS, *(f"end{k}" for k in range(len(rows)))) if n not in names)
        end = {"j": name, "a": names[-1], "mu": 0, "sigma": 2, **carried}
        spot = before.location.replace(f'"{names[-1]}"', f'"{name}"')
        khalil_rows.append((end, RowPlace(before.file, spot, None, name, before.letters, before)))
    return khalil_rows


# The table of a robot in the letters in which it was given.


STEPS = {
    "khalil": "T(a \u2192 j) = Rz(\u03b3) Tz(b) Rx(\u03b1) Tx(d) Rz(\u03b8) Tz(r)",
    "craig": "T(parent \u2192 j) = Rz(\u03b3) Tz(b) Rx(\u03b1) Tx(a) Rz(\u03b8) Tz(d) (Craig)",
    "classical": "row j is Rz(\u03b8) Tz(d) Tx(a) Rx(\u03b1) (Denavit and Hartenberg); frame j, of "
    "the picture and of the inertial parameters, is that behind Tz(d)",
}


class WrittenCell(NamedTuple):
    """A cell as the file has it: of which row of Khalil's it is; of none, it is 0."""

    joint: Joint | None
    column: str

    @property
    def expression(self) -> Expression:
        """What stands there."""
        return parse_expression(0) if self.joint is None else getattr(self.joint, self.column)


@dataclass(frozen=True)
class WrittenTable:
    """The table of a robot in the letters of its convention.

    Attributes:
        antecedent: name of the column of antecedents; empty if it has none.
        units: letter of each column of the geometry that is not zero everywhere -> its unit.
        rows: joint, and its cells by letter.
        step: what a row places.
    """

    antecedent: str
    units: Mapping[str, str]
    rows: Sequence[tuple[Joint, Mapping[str, WrittenCell]]]
    step: str


def locate_written_cell(robot: Robot, joint: Joint, column: str) -> str:
    """`row "3", column alpha`: where the file has that cell of Khalil's."""
    row, letter = _locate_cell(robot, joint, column)
    return f'row "{row}", column {letter}'


def get_written_letter(robot: Robot, joint: Joint, column: str) -> str:
    """`alpha`, or `alpha of 3`: how the file calls that cell of Khalil's."""
    row, letter = _locate_cell(robot, joint, column)
    return letter if row == joint.name else f"{letter} of {row}"


def _locate_cell(robot: Robot, joint: Joint, column: str) -> tuple[str, str]:
    """Row and letter."""
    carried = robot.convention == "classical" and column in ("alpha", "d")
    row = joint.antecedent if carried else joint.name
    return row, CONVENTIONS[robot.convention].get(column, column)


def build_written_table(robot: Robot) -> WrittenTable:
    """The table of a robot as its file has it."""
    letters = CONVENTIONS[robot.convention]
    after = {joint.antecedent: joint for joint in robot.joints if joint.name not in robot.motors}
    rows = []
    for joint in robot.joints:
        cells = {}
        for column in (c for c in letters if c in GEOMETRY):
            carried = robot.convention == "classical" and column in ("alpha", "d")
            cells[letters[column]] = WrittenCell(
                after.get(joint.name) if carried else joint, column
            )
        rows.append((joint, cells))
    units = {
        letter: "rad" if column in ANGLES else "m"
        for column, letter in letters.items()
        if column in GEOMETRY and any(not cells[letter].expression.is_zero for _, cells in rows)
    }
    used = [(joint, {letter: cells[letter] for letter in units}) for joint, cells in rows]
    return WrittenTable(letters.get("a", ""), units, used, STEPS[robot.convention])
