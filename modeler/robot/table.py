"""The `[mdh]` table of a robot file: rows to `Joint`s."""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, NamedTuple

from modeler.core.expression import Expression, parse_expression
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.cells import (
    LARGEST_LENGTH,
    Values,
    check_count,
    check_declared,
    check_name_length,
    check_size,
    check_unit,
    normalise_row_name,
    read_exact_angle,
    read_length,
    read_linear_form,
)
from modeler.robot.robot import Joint, JointKind, Robot
from modeler.robot.thresholds import THRESHOLDS

COLUMNS = ("j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r")
GEOMETRY = COLUMNS[4:]
ANGLES = ("gamma", "alpha", "theta")

Row = dict[str, Any]
"""Cells by Khalil's column."""

_EMPTY: Mapping[str, str] = MappingProxyType({})
CONVENTIONS: Mapping[str, Mapping[str, str]] = {
    name: {khalil: letter for khalil, _, letter in (c.partition(":") for c in columns.split())}
    for name, columns in {
        "khalil": " ".join(f"{column}:{column}" for column in COLUMNS),
        "craig": "j:j a:parent mu:mu sigma:sigma gamma:gamma b:b alpha:alpha d:a r:d theta:theta",
        "classical": "j:j mu:mu sigma:sigma theta:theta r:d d:a alpha:alpha",
    }.items()
}
"""By whose table it is: Khalil's column -> its letter there, in the order in which they print."""
_ONE_ROW = {
    "khalil": '["j", "alpha", "d", "theta", "r"], rows = [["1", 0, 0, "q1", 0]]',
    "craig": '["j", "alpha", "a", "d", "theta"], rows = [["1", 0, 0, 0, "q1"]]',
    "classical": '["j", "theta", "d", "a", "alpha"], rows = [["1", "q1", 0, 0, 0]]',
}
GREEK_LETTERS = "\u03b3\u03b1\u03b8\u03c3\u03bc\u00b5"
GREEK = dict(zip(GREEK_LETTERS, [*ANGLES, "sigma", "mu", "mu"], strict=True))
"""Greek letter -> its name."""
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
        """Returns where that cell is written."""
        return self.before if self.before and column in ("alpha", "d") else self

    def get_letter(self, column: str) -> str:
        """Returns how the table calls that column of Khalil's."""
        return self.letters.get(column, column)

    def locate_column(self, column: str, value: Any = None) -> TomlCell:
        """Returns the place of a cell."""
        return self.find_owner(column).enter(f"column {self.get_letter(column)}", value)


def read_convention(table: TomlCell, document: Mapping[str, Any]) -> str:
    """Returns whose table it is.

    Args:
        table: `[mdh]`.
        document: the whole file.

    Raises:
        RobotError: nobody's, or a classical one of a robot that is not serial.
    """
    stated = table.read_table(format_table_example("khalil"))
    place = table.enter("convention", stated.get("convention", "khalil"))
    if place.value not in list(CONVENTIONS):
        names = join_names(f'"{name}"' for name in CONVENTIONS)
        raise place.make_mismatch(f"one of {names}{suggest_name(place.value, CONVENTIONS)}")
    branched = [key for key in ("legs", "platform", "loops") if key in document]
    if place.value == "classical" and branched:
        key = branched[0] if branched[0] == "legs" else f"[{branched[0]}]"
        raise place.make_error(f'got "classical", and the file has {key}; {_SERIAL}')
    return str(place.value)


def format_table_example(convention: str) -> str:
    """Returns columns and a row, as text."""
    return f"columns = {_ONE_ROW[convention]}"


def read_khalil_columns(place: TomlCell, convention: str) -> list[str]:
    """Returns the columns of the table as Khalil calls them.

    Raises:
        RobotError: columns that such a table has not, or twice, or no names of rows.
    """
    written_columns = place.read_list(_ONE_ROW[convention].split(", rows")[0])
    columns = [GREEK.get(c, c) if isinstance(c, str) else c for c in written_columns]
    ours = {letter: column for column, letter in CONVENTIONS[convention].items()}
    for number, column in enumerate(columns, start=1):
        if column not in list(ours):
            advice = '; row names stand in column "j"' if "j" not in columns else ""
            if column == "parent" and convention == "khalil":
                advice = '; of Craig\'s table? Write convention = "craig" in [mdh]'
            elif convention == "classical" and column in ("parent", "gamma", "b"):
                advice = f"; {_SERIAL}"
            elif convention != "khalil" and column == "r":
                advice = "; r of Khalil is d in this table, and d is a: "
                advice += f'convention = "{convention}"'
            raise place.make_error(
                f"entry {number} is {quote_value(column)}{suggest_name(column, ours)}; expected "
                f"names among {join_names(ours)}{advice}"
            )
        if column in columns[: number - 1]:
            raise place.make_error(f"{quote_value(column)} stands twice; remove one and its cells")
    if "j" not in columns:
        got = f'column "j" (row names) is missing, got {quote_value(columns)}'
        raise place.make_error(f"{got}; add it")
    return [ours[column] for column in columns]


def check_convention(
    columns: Sequence[str], rows: Sequence[Row], place: TomlCell, stated: bool
) -> None:
    """Refuses a table that reads like that of another convention than it is said to be.

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
    """Returns True of a cell that is no name of a row, but may be a length."""
    if isinstance(cell, float):
        return True
    return isinstance(cell, str) and not cell.isdigit() and any(c.isdigit() for c in cell)


def suggest_convention(columns: Sequence[str], rows: Sequence[Row]) -> str:
    """Returns the line to write, by where the table begins and ends with zeros."""
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
    """Converts classical rows to those of Khalil; a fixed frame ends the last link if needed."""
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
        """Returns the expression that stands in the cell."""
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
    """Returns `row "3", column alpha`: where the file has that cell of Khalil's."""
    row, letter = _locate_cell(robot, joint, column)
    return f'row "{row}", column {letter}'


def get_written_letter(robot: Robot, joint: Joint, column: str) -> str:
    """Returns `alpha`, or `alpha of 3`: how the file calls that cell of Khalil's."""
    row, letter = _locate_cell(robot, joint, column)
    return letter if row == joint.name else f"{letter} of {row}"


def _locate_cell(robot: Robot, joint: Joint, column: str) -> tuple[str, str]:
    """Row and letter."""
    carried = robot.convention == "classical" and column in ("alpha", "d")
    row = joint.antecedent if carried else joint.name
    return row, CONVENTIONS[robot.convention].get(column, column)


def build_written_table(robot: Robot) -> WrittenTable:
    """Returns the table of a robot as its file has it."""
    letters = CONVENTIONS[robot.convention]
    after = {joint.antecedent: joint for joint in robot.joints if joint.name not in robot.motors}
    rows = []
    for joint in robot.joints:
        cells = {}
        for column in (c for c in letters if c in GEOMETRY):
            carried = robot.convention == "classical" and column in ("alpha", "d")
            owner = after.get(joint.name) if carried else joint
            cells[letters[column]] = WrittenCell(owner, column)
        rows.append((joint, cells))
    units = {
        letter: "rad" if column in ANGLES else "m"
        for column, letter in letters.items()
        if column in GEOMETRY and any(not cells[letter].expression.is_zero for _, cells in rows)
    }
    used = [(joint, {letter: cells[letter] for letter in units}) for joint, cells in rows]
    return WrittenTable(letters.get("a", ""), units, used, STEPS[robot.convention])


# The `[mdh]` table of a robot file: rows to `Joint`s.


Rows = tuple[tuple[Row, RowPlace], ...]

_IN_MM = (
    'lengths are in m: {0}, is {1:g} m; write "{1:g} mm" if it is in mm, there or in [symbols], '
    'and "{1:g} m" if it is in m'
)
_ALONG_Z = '; a table where d is along z needs convention = "craig" or "classical" in [mdh]'
ROW_NAME = re.compile(r"[A-Za-z0-9]+")

HOME = {JointKind.REVOLUTE: "theta", JointKind.PRISMATIC: "r"}
"""Column of the joint variable."""


def read_table_rows(
    place: TomlCell, platform: Sequence[tuple[Row, RowPlace]] = (), convention: str = "khalil"
) -> Rows:
    """Returns the rows of `[mdh]` as {Khalil's column: cell}, each with its place.

    `j` becomes text; a missing `a` becomes the name of the row above, "0" for the first. The rows
    of the platform stand before the others.

    Raises:
        RobotError: columns, row lengths, row names or antecedents are wrong.
    """
    example = format_table_example(convention)
    stated = {"convention": convention, **place.read_table(f"[mdh] {example}")}
    keys = ("columns", "rows", "convention")
    unknown, missing = "expected columns, rows and convention only", f"write {example}"
    table = place.with_value(stated).read_checked_table(keys, "", unknown, missing)
    columns = read_khalil_columns(place.enter("columns", table["columns"]), convention)
    listed_rows = place.enter("rows", table["rows"]).read_list(example)
    count = len(listed_rows) + len(platform)
    description = "rows, those of all legs and of the platform counted"
    check_count(count, THRESHOLDS.max_rows, description, place.enter("rows"))
    if not listed_rows:
        what = f"the table is empty; write one row per joint, as in {example}"
        raise place.enter("rows").make_error(what)
    letters = CONVENTIONS[convention]
    rows: list[tuple[Row, RowPlace]] = list(platform)
    for number, cells in enumerate(listed_rows, start=1):
        row = _read_row(number, cells, columns, letters, place)
        name = _read_row_name(place.enter(f"row {number}, column j", row["j"]))
        here = RowPlace(place.file, place.enter(f'row "{name}"').location, None, name, letters)
        names = [earlier["j"] for earlier, _ in rows]
        if name in names:
            first = names.index(name) + 1 - len(platform)
            where = f"in rows {first} and" if first > 0 else "in [platform] and in row"
            what = f"the name {quote_value(name)} stands {where} {number}"
            raise here.make_error(f"{what}; give each row its own name")
        row["j"] = name
        rows.append((row, here))
    file_rows = [row for row, _ in rows[len(platform) :]]
    check_convention(columns, file_rows, place.with_value(stated), "convention" in place.value)
    for row, above in zip(file_rows, ["0", *(row["j"] for row in file_rows)], strict=False):
        row["a"] = normalise_row_name(row.get("a", above))
    if convention == "classical":
        rows = shift_classical_rows(rows)
    _check_antecedents(rows, columns)
    return tuple(rows)


def build_joints(rows: Rows, symbols: Values, rounded: dict[str, str]) -> tuple[Joint, ...]:
    """Returns the joints of checked rows (`read_table_rows`).

    Args:
        rows: cells by column, with their places.
        symbols: values of the declared symbols.
        rounded: grows by the decimal angles that are taken for multiples of pi.

    Raises:
        RobotError: a cell is wrong; says row, column, got, expected.
    """
    kinds = {row["j"]: read_row_kind(row, place) for row, place in rows}
    if all(kind is JointKind.FIXED for kind in kinds.values()):
        raise rows[0][1].make_error(
            "no row of the table moves; expected at least one joint with sigma 0 (revolute) "
            "or 1 (prismatic)"
        )
    joints = []
    for row, place in rows:
        name, kind = row["j"], kinds[row["j"]]
        # The place of the variable last: one in the wrong column is reported there, not as missing.
        order = sorted(GEOMETRY, key=lambda column: column == HOME.get(kind))
        cells = {c: _read_cell(row.get(c, 0), c, place, kinds, symbols, rounded) for c in order}
        joints.append(Joint(name, row["a"], _read_actuated(row, kind, place), kind, **cells))
    return tuple(joints)


def check_units(robot: Robot, values: Values, place: TomlCell) -> list[str]:
    """Refuses angles in columns of lengths and the reverse.

    Args:
        robot: with its rows.
        values: of its symbols.
        place: of the table.

    Returns:
        What to show of the longest length if it is one in mm by its looks.

    Raises:
        RobotError: names the cell.
    """
    units: dict[str, Collection[str]] = {}
    for name, expression in robot.symbols.items():
        units[name] = expression.infer_units(units) or {""}
    longest, notes = THRESHOLDS.max_silent_length, list[str]()
    for joint in robot.joints:
        for column in GEOMETRY:
            cell = getattr(joint, column)
            at = place.enter(locate_written_cell(robot, joint, column))
            check_unit(cell, units, "rad" if column in ANGLES else "m", at)
            size = abs(cell.evaluate({joint.variable: 0.0, **values}))
            if column not in ANGLES and size > longest and "m" not in cell.infer_units(units):
                longest, notes = size, [_IN_MM.format(at.location, size)]
    return notes


def _read_row(
    number: int, cells: Any, columns: list[str], letters: Mapping[str, str], place: TomlCell
) -> Row:
    # The name is reported if it can be read: it is what the user looks for.
    named = isinstance(cells, list) and cells and columns[0] == "j"
    name = f" ({quote_value(cells[0])})" if named else ""
    here = place.enter(f"row {number}{name}", cells)
    cells = here.read_list('["1", "0", 0, 0, "q1", 0]')
    if len(cells) != len(columns):
        raise here.make_error(
            f"got {len(cells)} cells, expected {len(columns)}, one for each of "
            f"{join_names(letters[column] for column in columns)}; "
            f"{'add' if len(cells) < len(columns) else 'remove'} {abs(len(columns) - len(cells))}"
        )
    return dict(zip(columns, cells, strict=True))


def _read_row_name(place: TomlCell) -> str:
    name = normalise_row_name(place.value)
    if not isinstance(name, str) or not ROW_NAME.fullmatch(name):
        raise place.make_mismatch(
            'a name of letters and digits such as "1" or "12" (it becomes part of names in the C '
            "code)"
        )
    check_name_length(name, place)
    if name == "0":
        raise place.make_error('got "0", which is the base; number the rows from "1"')
    return name


def _check_antecedents(rows: list[tuple[Row, RowPlace]], columns: list[str]) -> None:
    antecedents = {row["j"]: row["a"] for row, _ in rows}
    seen = ["0"]
    for row, place in rows:
        name, antecedent = row["j"], row["a"]
        here = place.locate_column("a", antecedent)
        if not isinstance(antecedent, str) or antecedent not in {"0", *antecedents}:
            raise here.make_mismatch(
                f'"0" (the base) or the name of an earlier row ({join_names(seen[1:])})'
                f"{suggest_name(antecedent, antecedents)}"
                f"{_explain_length(antecedent, rows, columns)}"
            )
        if antecedent not in seen:
            above, below = quote_value(antecedent), quote_value(name)
            problem = f"is a later row; move row {above} above row {below}"
            if cycle := _find_cycle(name, antecedents):
                problem = f"closes the circle {' -> '.join(cycle)}; every chain of antecedents"
                problem += ' must end at "0"'
            raise here.make_error(f"got {quote_value(antecedent)}, which {problem}")
        seen.append(name)


def _explain_length(antecedent: Any, rows: list[tuple[Row, RowPlace]], columns: list[str]) -> str:
    """What to say of a length where Khalil's table has the antecedent."""
    letters = isinstance(antecedent, str) and all(row["j"].isdigit() for row, _ in rows)
    if "r" in columns or "d" not in columns or rows[-1][1].get_letter("a") != "a":
        return ""
    if not is_length(antecedent) and (not letters or antecedent.isdigit()):
        return ""
    suggested = suggest_convention(columns, [row for row, _ in rows])
    return f"; a is a length in the tables of others: {suggested}"


def _find_cycle(name: str, antecedents: Mapping[str, str]) -> list[str]:
    """The rows from `name` back to itself, empty if its chain ends elsewhere."""
    chain = [name]
    while (following := antecedents.get(chain[-1])) is not None:
        if following in chain:
            return [*chain[chain.index(following) :], following]
        chain.append(following)
    return []


def read_row_kind(row: Row, place: RowPlace) -> JointKind:
    """Returns sigma of a row.

    Raises:
        RobotError: not 0, 1 or 2.
    """
    cell = place.locate_column("sigma", row.get("sigma", 0))
    return JointKind(_read_choice(3, cell, "0 (revolute), 1 (prismatic) or 2 (fixed)"))


def _read_choice(count: int, place: TomlCell, expected: str) -> int:
    """The cell, which must be one of 0, 1, ..."""
    if type(place.value) is not int or place.value not in range(count):
        raise place.make_mismatch(expected)
    return place.value


def _read_actuated(row: Row, kind: JointKind, place: RowPlace) -> bool:
    if "mu" not in row:
        return kind is not JointKind.FIXED
    cell = _read_choice(2, place.locate_column("mu", row["mu"]), "1 (actuated) or 0 (passive)")
    if cell == 1 and kind is JointKind.FIXED:
        raise place.locate_column("mu").make_error(
            "got 1 on a fixed row (sigma 2), which has no motor; write 0, or correct sigma"
        )
    return cell == 1


def _read_cell(
    cell: Any,
    column: str,
    where: RowPlace,
    kinds: Mapping[str, JointKind],
    symbols: Values,
    rounded: dict[str, str],
) -> Expression:
    row = where.find_owner(column).row  # whose cell it is in the file
    place = where.locate_column(column, cell)
    expression = place.read_expression()
    got = f"got {quote_value(expression.text)}"
    row_variable, home = f"q{row}", HOME.get(kinds[row])
    for name in sorted(expression.names):  # joint variables stand in the place of their own only
        if name == row_variable and home is None:
            todo = f"remove {name} or set sigma"
            raise place.make_error(f"{got}, but the row is fixed (sigma 2); {todo}")
        if name == row_variable and column != home:
            raise place.make_error(
                f"{got}, but {name} of a {'revolute' if home == 'theta' else 'prismatic'} joint "
                f"belongs into column {where.get_letter(home or '')}; move it there, or correct "
                "sigma" + (_ALONG_Z if where.get_letter(column) == "d" and home == "r" else "")
            )
        if name != row_variable and name.startswith("q") and name[1:] in kinds:
            raise place.make_error(
                f"{got}, which uses the variable {name} of another row; expected {row_variable} "
                "and constants, or, where the joint follows others, a sum of their variables in "
                f"column {' or '.join(map(where.get_letter, [home] if home else HOME.values()))} "
                f"without {row_variable}"
            )
    if column == home:
        example = f"{row_variable} + {'pi/2' if column == 'theta' else '0.1'}"
        if row_variable not in expression.names:
            raise place.make_error(
                f"{got}, without the joint variable; expected {row_variable}, the variable of this "
                f"row, as in {quote_value(example)}; a row that does not move has sigma 2"
            )
    check_declared(expression, {**symbols, row_variable: 0.0} if column == home else symbols, place)
    if column == home:
        form = read_linear_form(expression, symbols, place, example)
        factor = form.coefficients.get(row_variable, 0.0)
        if factor not in (1.0, -1.0):
            raise place.make_error(
                f"{got}: {row_variable} has the coefficient {factor:g}; expected 1 or -1, as in "
                f'{quote_value(example)} or "-{row_variable}" (a gear ratio belongs into the drive '
                "gain)"
            )
        if column not in ANGLES:  # a prismatic joint's offset is a length
            check_size(expression, (form.constant,), LARGEST_LENGTH, place)
    elif column in ANGLES:
        read_linear_form(expression, symbols, place)
    else:
        read_length(expression, symbols, place)
    if column in ANGLES:
        variable = row_variable if column == home else None
        return read_exact_angle(expression, variable, place, rounded)
    # -0.0 and the like: one zero, so that everyone may drop it.
    return parse_expression(0) if expression.is_zero else expression
