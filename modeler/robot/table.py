"""The `[mdh]` table of a robot file: rows to `Joint`s."""

import re
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from modeler.core.expression import Expression, parse
from modeler.core.toml_cells import Place, listed, near, shown
from modeler.robot.cells import (
    LARGEST_LENGTH,
    check_count,
    check_declared,
    check_name_length,
    check_size,
    check_unit,
    exact_angle_at,
    form_at,
    length_at,
    name_of,
)
from modeler.robot.conventions import (
    ANGLES,
    CONVENTIONS,
    GEOMETRY,
    Row,
    RowPlace,
    check_whose,
    is_length,
    khalil_columns,
    shifted,
    table_example,
    whose_line,
    written_cell,
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


def table_rows(
    place: Place, platform: Sequence[tuple[Row, RowPlace]] = (), convention: str = "khalil"
) -> Rows:
    """The rows of `[mdh]` as {Khalil's column: cell}, each with its place.

    `j` becomes text; a missing `a` becomes the name of the row above, "0" for the first. The rows
    of the platform stand before the others.

    Raises:
        RobotError: columns, row lengths, row names or antecedents are wrong.
    """
    example = table_example(convention)
    stated = {"convention": convention, **place.table(f"[mdh] {example}")}
    table = place.holding(stated).checked_table(
        ("columns", "rows", "convention"), "", "expected columns, rows and convention only",
        missing=f"write {example}",
    )  # fmt: skip
    columns = khalil_columns(place.at("columns", table["columns"]), convention)
    listed_rows = place.at("rows", table["rows"]).entries(example)
    count = len(listed_rows) + len(platform)
    told = "rows, those of all legs and of the platform counted"
    check_count(count, MOST_ROWS, told, place.at("rows"))
    if not listed_rows:
        raise place.at("rows").error(
            f"the table is empty; write one row per joint, as in {example}"
        )
    letters = CONVENTIONS[convention]
    rows: list[tuple[Row, RowPlace]] = list(platform)
    for number, cells in enumerate(listed_rows, start=1):
        row = _row(number, cells, columns, letters, place)
        name = _row_name(place.at(f"row {number}, column j", row["j"]))
        here = RowPlace(place.file, place.at(f'row "{name}"').spot, None, name, letters)
        names = [earlier["j"] for earlier, _ in rows]
        if name in names:
            first = names.index(name) + 1 - len(platform)
            where = f"in rows {first} and" if first > 0 else "in [platform] and in row"
            raise here.error(
                f"the name {shown(name)} stands {where} {number}; give each row its own name"
            )
        row["j"] = name
        rows.append((row, here))
    given = [row for row, _ in rows[len(platform) :]]
    check_whose(columns, given, place.holding(stated), "convention" in place.value)
    for row, above in zip(given, ["0", *(row["j"] for row in given)], strict=False):
        row["a"] = name_of(row.get("a", above))
    if convention == "classical":
        rows = shifted(rows)
    _check_antecedents(rows, columns)
    return tuple(rows)


def table_joints(
    rows: Rows, symbols: Mapping[str, float], rounded: dict[str, str]
) -> tuple[Joint, ...]:
    """The joints of checked rows (`table_rows`).

    Args:
        rows: cells by column, with their places.
        symbols: values of the declared symbols.
        rounded: grows by the decimal angles that are taken for multiples of pi.

    Raises:
        RobotError: a cell is wrong; says row, column, got, expected.
    """
    kinds = {row["j"]: row_kind(row, place) for row, place in rows}
    if all(kind is JointKind.FIXED for kind in kinds.values()):
        raise rows[0][1].error(
            "no row of the table moves; expected at least one joint with sigma 0 (revolute) "
            "or 1 (prismatic)"
        )
    joints = []
    for row, place in rows:
        name, kind = row["j"], kinds[row["j"]]
        # The place of the variable last: one in the wrong column is told there, not as missing.
        order = sorted(GEOMETRY, key=lambda column: column == HOME.get(kind))
        cells = {c: _cell(row.get(c, 0), c, place, kinds, symbols, rounded) for c in order}
        joints.append(Joint(name, row["a"], _actuated(row, kind, place), kind, **cells))
    return tuple(joints)


def check_units(robot: Robot, values: Mapping[str, float], place: Place) -> list[str]:
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
    for name, worth in robot.symbols.items():
        units[name] = worth.units(units) or {""}
    longest, told = LONGEST_LINK, list[str]()
    for joint in robot.joints:
        for column in GEOMETRY:
            cell, at = getattr(joint, column), place.at(written_cell(robot, joint, column))
            check_unit(cell, units, "rad" if column in ANGLES else "m", at)
            size = abs(cell.number({joint.variable: 0.0, **values}))
            if column not in ANGLES and size > longest and "m" not in cell.units(units):
                longest, told = size, [_IN_MM.format(at.spot, size)]
    return told


def _row(
    number: int, cells: Any, columns: list[str], letters: Mapping[str, str], place: Place
) -> Row:
    # The name is told if it can be read: it is what the user looks for.
    named = isinstance(cells, list) and cells and columns[0] == "j"
    name = f" ({shown(cells[0])})" if named else ""
    here = place.at(f"row {number}{name}", cells)
    cells = here.entries('["1", "0", 0, 0, "q1", 0]')
    if len(cells) != len(columns):
        raise here.error(
            f"got {len(cells)} cells, expected {len(columns)}, one for each of "
            f"{listed(letters[column] for column in columns)}; "
            f"{'add' if len(cells) < len(columns) else 'remove'} {abs(len(columns) - len(cells))}"
        )
    return dict(zip(columns, cells, strict=True))


def _row_name(place: Place) -> str:
    name = name_of(place.value)
    if not isinstance(name, str) or not ROW_NAME.fullmatch(name):
        raise place.mismatch(
            'a name of letters and digits such as "1" or "12" (it becomes part of names in the C '
            "code)"
        )
    check_name_length(name, place)
    if name == "0":
        raise place.error('got "0", which is the base; number the rows from "1"')
    return name


def _check_antecedents(rows: list[tuple[Row, RowPlace]], columns: list[str]) -> None:
    antecedents = {row["j"]: row["a"] for row, _ in rows}
    seen = ["0"]
    for row, place in rows:
        name, antecedent = row["j"], row["a"]
        here = place.column("a", antecedent)
        if not isinstance(antecedent, str) or antecedent not in {"0", *antecedents}:
            raise here.mismatch(
                f'"0" (the base) or the name of an earlier row ({listed(seen[1:])})'
                f"{near(antecedent, antecedents)}{_whose_hint(antecedent, rows, columns)}"
            )
        if antecedent not in seen:
            told = f"is a later row; move row {shown(antecedent)} above row {shown(name)}"
            if cycle := _cycle(name, antecedents):
                told = f"closes the circle {' -> '.join(cycle)}; every chain of antecedents must "
                told += 'end at "0"'
            raise here.error(f"got {shown(antecedent)}, which {told}")
        seen.append(name)


def _whose_hint(antecedent: Any, rows: list[tuple[Row, RowPlace]], columns: list[str]) -> str:
    """What to say of a length where Khalil's table has the antecedent."""
    letters = isinstance(antecedent, str) and all(row["j"].isdigit() for row, _ in rows)
    if "r" in columns or "d" not in columns or rows[-1][1].letter("a") != "a":
        return ""
    if not is_length(antecedent) and (not letters or antecedent.isdigit()):
        return ""
    return f"; a is a length in the tables of others: {whose_line(columns, [r for r, _ in rows])}"


def _cycle(name: str, antecedents: Mapping[str, str]) -> list[str]:
    """The rows from `name` back to itself, empty if its chain ends elsewhere."""
    chain = [name]
    while (following := antecedents.get(chain[-1])) is not None:
        if following in chain:
            return [*chain[chain.index(following) :], following]
        chain.append(following)
    return []


def row_kind(row: Row, place: RowPlace) -> JointKind:
    """Sigma of a row.

    Raises:
        RobotError: not 0, 1 or 2.
    """
    cell = place.column("sigma", row.get("sigma", 0))
    return JointKind(_one_of(3, cell, "0 (revolute), 1 (prismatic) or 2 (fixed)"))


def _one_of(count: int, place: Place, expected: str) -> int:
    """The cell, which must be one of 0, 1, ..."""
    if type(place.value) is not int or place.value not in range(count):
        raise place.mismatch(expected)
    return place.value


def _actuated(row: Row, kind: JointKind, place: RowPlace) -> bool:
    if "mu" not in row:
        return kind is not JointKind.FIXED
    cell = _one_of(2, place.column("mu", row["mu"]), "1 (actuated) or 0 (passive)")
    if cell == 1 and kind is JointKind.FIXED:
        raise place.column("mu").error(
            "got 1 on a fixed row (sigma 2), which has no motor; write 0, or correct sigma"
        )
    return cell == 1


def _cell(
    cell: Any,
    column: str,
    where: RowPlace,
    kinds: Mapping[str, JointKind],
    symbols: Mapping[str, float],
    rounded: dict[str, str],
) -> Expression:
    row = where.owner(column).row  # whose cell it is in the file
    place = where.column(column, cell)
    expression = place.expression()
    got = f"got {shown(expression.text)}"
    own, home = f"q{row}", HOME.get(kinds[row])
    for name in sorted(expression.names):  # joint variables stand in the place of their own only
        if name == own and home is None:
            raise place.error(f"{got}, but the row is fixed (sigma 2); remove {name} or set sigma")
        if name == own and column != home:
            raise place.error(
                f"{got}, but {name} of a {'revolute' if home == 'theta' else 'prismatic'} joint "
                f"belongs into column {where.letter(home or '')}; move it there, or correct sigma"
                + (_ALONG_Z if where.letter(column) == "d" and home == "r" else "")
            )
        if name != own and name.startswith("q") and name[1:] in kinds:
            raise place.error(
                f"{got}, which uses the variable {name} of another row; expected {own} and "
                "constants, or, where the joint follows others, a sum of their variables in "
                f"column {' or '.join(map(where.letter, [home] if home else HOME.values()))} "
                f"without {own}"
            )
    if column == home:
        example = f"{own} + {'pi/2' if column == 'theta' else '0.1'}"
        if own not in expression.names:
            raise place.error(
                f"{got}, without the joint variable; expected {own}, the variable of this row, as "
                f"in {shown(example)}; a row that does not move has sigma 2"
            )
    check_declared(expression, {**symbols, own: 0.0} if column == home else symbols, place)
    if column == home:
        form = form_at(expression, symbols, place, example)
        factor = form.coefficients.get(own, 0.0)
        if factor not in (1.0, -1.0):
            raise place.error(
                f"{got}: {own} has the coefficient {factor:g}; expected 1 or -1, as in "
                f'{shown(example)} or "-{own}" (a gear ratio belongs into the drive gain)'
            )
        if column not in ANGLES:  # a prismatic joint's offset is a length
            check_size(expression, (form.constant,), LARGEST_LENGTH, place)
    elif column in ANGLES:
        form_at(expression, symbols, place)
    else:
        length_at(expression, symbols, place)
    if column in ANGLES:
        return exact_angle_at(expression, own if column == home else None, place, rounded)
    # -0.0 and the like: one zero, so that everyone may drop it.
    return parse(0) if expression.is_zero else expression
