"""The `[mdh]` table of a robot file: rows to `Joint`s."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.core.expression import Expression, parse
from modeler.core.toml_cells import Place, listed, near, shown
from modeler.robot.cells import (
    LARGEST_LENGTH,
    check_declared,
    check_name_length,
    check_size,
    exact_angle,
    form_at,
    length_at,
    name_of,
)
from modeler.robot.robot import Joint, JointKind

COLUMNS = ("j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r")
_GEOMETRY = ("gamma", "b", "alpha", "d", "theta", "r")
_ANGLES = ("gamma", "alpha", "theta")
_EXAMPLE = 'columns = ["j", "alpha", "d", "theta", "r"], rows = [["1", 0, 0, "q1", 0]]'
MOST_ROWS = 150
"""Rows of a table. Deriving and the C grow with their square: docs/theory.md has the seconds."""
ROW_NAME = re.compile(r"[A-Za-z0-9]+")

Row = dict[str, Any]

HOME = {JointKind.REVOLUTE: "theta", JointKind.PRISMATIC: "r"}
"""Column of the joint variable."""


def table_rows(
    place: Place, platform: Sequence[tuple[Row, Place]] = ()
) -> tuple[tuple[Row, Place], ...]:
    """The rows of `[mdh]` as {column: cell}, each with its place; names and antecedents filled in.

    `j` becomes text; a missing `a` becomes the name of the row above, "0" for the first. The rows
    of the platform stand before the others.

    Raises:
        RobotError: columns, row lengths, row names or antecedents are wrong.
    """
    table = place.checked_table(
        ("columns", "rows"), f"[mdh] {_EXAMPLE}", "expected columns and rows only",
        missing=f"write {_EXAMPLE}",
    )  # fmt: skip
    columns = _columns(place.at("columns", table["columns"]))
    listed_rows = place.at("rows", table["rows"]).entries(_EXAMPLE)
    count = len(listed_rows) + len(platform)
    if count > MOST_ROWS:  # before any work that nobody could wait for
        raise place.at("rows").error(
            f"got {count} rows, those of all legs and of the platform counted; "
            f"expected at most {MOST_ROWS}: model parts of the robot in files of their own"
        )
    if not listed_rows:
        raise place.at("rows").error(
            f"the table is empty; write one row per joint, as in {_EXAMPLE}"
        )
    rows: list[tuple[Row, Place]] = list(platform)
    for number, cells in enumerate(listed_rows, start=1):
        row = _row(number, cells, columns, place)
        name = _row_name(place.at(f"row {number}, column j", row["j"]))
        here = place.at(f'row "{name}"')
        names = [earlier["j"] for earlier, _ in rows]
        if name in names:
            first = names.index(name) + 1 - len(platform)
            where = f"in rows {first} and" if first > 0 else "in [platform] and in row"
            raise here.error(
                f"the name {shown(name)} stands {where} {number}; give each row its own name"
            )
        row["j"] = name
        above = names[-1] if len(names) > len(platform) else "0"
        row["a"] = name_of(row.get("a", above))
        rows.append((row, here))
    _check_antecedents(rows)
    return tuple(rows)


def table_joints(
    rows: tuple[tuple[Row, Place], ...], symbols: Mapping[str, float]
) -> tuple[Joint, ...]:
    """The joints of checked rows (`table_rows`).

    Args:
        rows: cells by column, with their places.
        symbols: values of the declared symbols.

    Raises:
        RobotError: a cell is wrong; says row, column, got, expected.
    """
    kinds = {row["j"]: row_kind(row, place) for row, place in rows}
    if all(kind is JointKind.FIXED for kind in kinds.values()):
        raise rows[0][1].error(
            "no row of the table moves; expected at least one joint with sigma 0 (revolute) "
            "or 1 (prismatic)"
        )
    return tuple(_joint(row, place, kinds, symbols) for row, place in rows)


def _columns(place: Place) -> list[str]:
    columns = place.entries('["j", "alpha", "d", "theta", "r"]')
    for number, column in enumerate(columns, start=1):
        if column not in COLUMNS:
            raise place.error(
                f"entry {number} is {shown(column)}{near(column, COLUMNS)}; expected names among "
                f"{listed(COLUMNS)}"
            )
        if column in columns[: number - 1]:
            raise place.error(f"{shown(column)} stands twice; remove one and its cells")
    if "j" not in columns:
        raise place.error(f'column "j" (row names) is missing, got {shown(columns)}; add it')
    return columns


def _row(number: int, cells: Any, columns: list[str], place: Place) -> Row:
    # The name is told if it can be read: it is what the user looks for.
    named = isinstance(cells, list) and cells and columns[0] == "j"
    name = f" ({shown(cells[0])})" if named else ""
    here = place.at(f"row {number}{name}", cells)
    cells = here.entries('["1", "0", 0, 0, "q1", 0]')
    if len(cells) != len(columns):
        raise here.error(
            f"got {len(cells)} cells, expected {len(columns)}, one for each of "
            f"{listed(columns)}; {'add' if len(cells) < len(columns) else 'remove'} "
            f"{abs(len(columns) - len(cells))}"
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


def _check_antecedents(rows: list[tuple[Row, Place]]) -> None:
    antecedents = {row["j"]: row["a"] for row, _ in rows}
    seen = ["0"]
    for row, place in rows:
        name, antecedent = row["j"], row["a"]
        here = place.at("column a", antecedent)
        if not isinstance(antecedent, str) or antecedent not in {"0", *antecedents}:
            raise here.mismatch(
                f'"0" (the base) or the name of an earlier row ({listed(seen[1:])})'
                f"{near(antecedent, antecedents)}"
            )
        if antecedent not in seen:
            told = f"is a later row; move row {shown(antecedent)} above row {shown(name)}"
            if cycle := _cycle(name, antecedents):
                told = f"closes the circle {' -> '.join(cycle)}; every chain of antecedents must "
                told += 'end at "0"'
            raise here.error(f"got {shown(antecedent)}, which {told}")
        seen.append(name)


def _cycle(name: str, antecedents: Mapping[str, str]) -> list[str]:
    """The rows from `name` back to itself, empty if its chain ends elsewhere."""
    chain = [name]
    while (following := antecedents.get(chain[-1])) is not None:
        if following in chain:
            return [*chain[chain.index(following) :], following]
        chain.append(following)
    return []


def row_kind(row: Row, place: Place) -> JointKind:
    """Sigma of a row.

    Raises:
        RobotError: not 0, 1 or 2.
    """
    cell = row.get("sigma", 0)
    if isinstance(cell, bool) or not isinstance(cell, int) or cell not in (0, 1, 2):
        raise place.at("column sigma", cell).mismatch("0 (revolute), 1 (prismatic) or 2 (fixed)")
    return JointKind(cell)


def _actuated(row: Row, kind: JointKind, place: Place) -> bool:
    if "mu" not in row:
        return kind is not JointKind.FIXED
    cell = row["mu"]
    if isinstance(cell, bool) or not isinstance(cell, int) or cell not in (0, 1):
        raise place.at("column mu", cell).mismatch("1 (actuated) or 0 (passive)")
    if cell == 1 and kind is JointKind.FIXED:
        raise place.at("column mu").error(
            "got 1 on a fixed row (sigma 2), which has no motor; write 0, or correct sigma"
        )
    return cell == 1


def _joint(
    row: Row, place: Place, kinds: Mapping[str, JointKind], symbols: Mapping[str, float]
) -> Joint:
    kind = kinds[row["j"]]
    # The place of the variable last: a variable in the wrong column is told there, not as missing.
    order = sorted(_GEOMETRY, key=lambda column: column == HOME.get(kind))
    cells = {
        column: _cell(row, column, place.at(f"column {column}", row.get(column, 0)), kinds, symbols)
        for column in order
    }
    return Joint(row["j"], row["a"], _actuated(row, kind, place), kind, **cells)


def _cell(
    row: Row,
    column: str,
    place: Place,
    kinds: Mapping[str, JointKind],
    symbols: Mapping[str, float],
) -> Expression:
    expression = place.expression()
    got = f"got {shown(expression.text)}"
    own, home = f"q{row['j']}", HOME.get(kinds[row["j"]])
    for name in sorted(expression.names):  # joint variables stand in the place of their own only
        if name == own and home is None:
            raise place.error(f"{got}, but the row is fixed (sigma 2); remove {name} or set sigma")
        if name == own and column != home:
            raise place.error(
                f"{got}, but {name} of a {'revolute' if home == 'theta' else 'prismatic'} joint "
                f"belongs into column {home}; move it there, or correct sigma"
            )
        if name != own and name.startswith("q") and name[1:] in kinds:
            raise place.error(
                f"{got}, which uses the variable {name} of another row; expected {own} and "
                "constants, or, where the joint follows others, a sum of their variables in "
                f"column {home or 'theta or r'} without {own}"
            )
    check_declared(expression, {**symbols, own: 0.0} if column == home else symbols, place)
    if column == home:
        example = f"{own} + {'pi/2' if column == 'theta' else '0.1'}"
        if own not in expression.names:
            raise place.error(
                f"{got}, without the joint variable; expected {own}, as in {shown(example)}; a row "
                "that does not move has sigma 2"
            )
        form = form_at(expression, symbols, place, example)
        factor = form.coefficients.get(own, 0.0)
        if factor not in (1.0, -1.0):
            raise place.error(
                f"{got}: {own} has the coefficient {factor:g}; expected 1 or -1, as in "
                f'{shown(example)} or "-{own}" (a gear ratio belongs into the drive gain)'
            )
        if column not in _ANGLES:  # a prismatic joint's offset is a length
            check_size(expression, (form.constant,), LARGEST_LENGTH, place)
    elif column in _ANGLES:
        form_at(expression, symbols, place)
    else:
        length_at(expression, symbols, place)
    if column in _ANGLES:
        return exact_angle(expression, own if column == home else None, place)
    # -0.0 and the like: one zero, so that everyone may drop it.
    return parse(0) if expression.is_zero else expression
