"""The `[mdh]` table of a robot file: rows to `Joint`s."""

import re
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from modeler.core.expression import Expression, parse_expression
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.cells import (
    LARGEST_LENGTH,
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
from modeler.robot.conventions import (
    ANGLES,
    CONVENTIONS,
    GEOMETRY,
    Row,
    RowPlace,
    check_convention,
    format_table_example,
    is_length,
    locate_written_cell,
    read_khalil_columns,
    shift_classical_rows,
    suggest_convention,
)
from modeler.robot.robot import Joint, JointKind, Robot

Rows = tuple[tuple[Row, RowPlace], ...]

MOST_ROWS = 150
"""Rows of a table. Deriving and the C grow with their square (docs/explanation/theory.md)."""
LONGEST_LINK = 20.0
"""m, of a robot; longer ones are told, for they may be mm."""
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
    """The rows of `[mdh]` as {Khalil's column: cell}, each with its place.

    `j` becomes text; a missing `a` becomes the name of the row above, "0" for the first. The rows
    of the platform stand before the others.

    Raises:
        RobotError: columns, row lengths, row names or antecedents are wrong.
    """
    example = format_table_example(convention)
    stated = {"convention": convention, **place.read_table(f"[mdh] {example}")}
    table = place.with_value(stated).read_checked_table(
        ("columns", "rows", "convention"), "", "expected columns, rows and convention only",
        missing=f"write {example}",
    )  # fmt: skip
    columns = read_khalil_columns(place.enter("columns", table["columns"]), convention)
    listed_rows = place.enter("rows", table["rows"]).read_list(example)
    count = len(listed_rows) + len(platform)
    description = "rows, those of all legs and of the platform counted"
    check_count(count, MOST_ROWS, description, place.enter("rows"))
    if not listed_rows:
        raise place.enter("rows").make_error(
            f"the table is empty; write one row per joint, as in {example}"
        )
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
            raise here.make_error(
                f"the name {quote_value(name)} stands {where} {number}; give each row its own name"
            )
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


def build_joints(
    rows: Rows, symbols: Mapping[str, float], rounded: dict[str, str]
) -> tuple[Joint, ...]:
    """The joints of checked rows (`read_table_rows`).

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
        # The place of the variable last: one in the wrong column is told there, not as missing.
        order = sorted(GEOMETRY, key=lambda column: column == HOME.get(kind))
        cells = {c: _read_cell(row.get(c, 0), c, place, kinds, symbols, rounded) for c in order}
        joints.append(Joint(name, row["a"], _read_actuated(row, kind, place), kind, **cells))
    return tuple(joints)


def check_units(robot: Robot, values: Mapping[str, float], place: TomlCell) -> list[str]:
    """Refuse angles in columns of lengths and the reverse.

    Args:
        robot: with its rows.
        values: of its symbols.
        place: of the table.

    Returns:
        What to tell of the longest length if it is one in mm by its looks.

    Raises:
        RobotError: names the cell.
    """
    units: dict[str, Collection[str]] = {}
    for name, expression in robot.symbols.items():
        units[name] = expression.infer_units(units) or {""}
    longest, notes = LONGEST_LINK, list[str]()
    for joint in robot.joints:
        for column in GEOMETRY:
            cell, at = (
                getattr(joint, column),
                place.enter(locate_written_cell(robot, joint, column)),
            )
            check_unit(cell, units, "rad" if column in ANGLES else "m", at)
            size = abs(cell.evaluate({joint.variable: 0.0, **values}))
            if column not in ANGLES and size > longest and "m" not in cell.units(units):
                longest, notes = size, [_IN_MM.format(at.location, size)]
    return notes


def _read_row(
    number: int, cells: Any, columns: list[str], letters: Mapping[str, str], place: TomlCell
) -> Row:
    # The name is told if it can be read: it is what the user looks for.
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
            problem = (
                f"is a later row; move row {quote_value(antecedent)} above row {quote_value(name)}"
            )
            if cycle := _find_cycle(name, antecedents):
                problem = (
                    f"closes the circle {' -> '.join(cycle)}; every chain of antecedents must "
                )
                problem += 'end at "0"'
            raise here.make_error(f"got {quote_value(antecedent)}, which {problem}")
        seen.append(name)


def _explain_length(antecedent: Any, rows: list[tuple[Row, RowPlace]], columns: list[str]) -> str:
    """What to say of a length where Khalil's table has the antecedent."""
    letters = isinstance(antecedent, str) and all(row["j"].isdigit() for row, _ in rows)
    if "r" in columns or "d" not in columns or rows[-1][1].get_letter("a") != "a":
        return ""
    if not is_length(antecedent) and (not letters or antecedent.isdigit()):
        return ""
    return (
        "; a is a length in the tables of others: "
        f"{suggest_convention(columns, [r for r, _ in rows])}"
    )


def _find_cycle(name: str, antecedents: Mapping[str, str]) -> list[str]:
    """The rows from `name` back to itself, empty if its chain ends elsewhere."""
    chain = [name]
    while (following := antecedents.get(chain[-1])) is not None:
        if following in chain:
            return [*chain[chain.index(following) :], following]
        chain.append(following)
    return []


def read_row_kind(row: Row, place: RowPlace) -> JointKind:
    """Sigma of a row.

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
    symbols: Mapping[str, float],
    rounded: dict[str, str],
) -> Expression:
    row = where.find_owner(column).row  # whose cell it is in the file
    place = where.locate_column(column, cell)
    expression = place.read_expression()
    got = f"got {quote_value(expression.text)}"
    row_variable, home = f"q{row}", HOME.get(kinds[row])
    for name in sorted(expression.names):  # joint variables stand in the place of their own only
        if name == row_variable and home is None:
            raise place.make_error(
                f"{got}, but the row is fixed (sigma 2); remove {name} or set sigma"
            )
        if name == row_variable and column != home:
            raise place.make_error(
                f"{got}, but {name} of a {'revolute' if home == 'theta' else 'prismatic'} joint "
                f"belongs into column {where.get_letter(home or '')}; move it there, or correct "
                "sigma" + (_ALONG_Z if where.get_letter(column) == "d" and home == "r" else "")
            )
        if name != row_variable and name.startswith("q") and name[1:] in kinds:
            raise place.make_error(
                f"{got}, which uses the variable {name} of another row; expected {row_variable} "
                "and "
                "constants, or, where the joint follows others, a sum of their variables in "
                f"column {' or '.join(map(where.get_letter, [home] if home else HOME.values()))} "
                f"without {row_variable}"
            )
    if column == home:
        example = f"{row_variable} + {'pi/2' if column == 'theta' else '0.1'}"
        if row_variable not in expression.names:
            raise place.make_error(
                f"{got}, without the joint variable; expected {row_variable}, the variable of this "
                "row, as "
                f"in {quote_value(example)}; a row that does not move has sigma 2"
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
        return read_exact_angle(
            expression, row_variable if column == home else None, place, rounded
        )
    # -0.0 and the like: one zero, so that everyone may drop it.
    return parse_expression(0) if expression.is_zero else expression
