"""Joints that follow others: `[relations]`, and cells that hold other rows' variables."""

from collections.abc import Mapping, Sequence
from typing import Any

from modeler.core.expression import Expression
from modeler.robot.cells import (
    LARGEST_RATIO,
    check_declared,
    check_size,
    expression_at,
    form_at,
    table_at,
)
from modeler.robot.place import Place, near, shown
from modeler.robot.table import HOME, Row, row_kind

_EXAMPLE = '[relations] q4 = "-q3"'


def read_relations(
    value: Any,
    rows: Sequence[tuple[Row, Place]],
    symbols: Mapping[str, float],
    place: Place,
) -> dict[str, Expression]:
    """The relations of a file, by row; rows that follow others become passive in `rows`.

    A row whose theta (revolute) or r (prismatic) holds other rows' variables and not its own
    follows them: its variable is that cell.

    Raises:
        RobotError: unknown joints, a relation that is not linear, a circle, an actuated joint
            that follows others.
    """
    kinds = {row["j"]: row_kind(row, spot) for row, spot in rows}
    variables = {f"q{name}": name for name, kind in kinds.items() if kind in HOME}
    places = {row["j"]: spot for row, spot in rows}
    found: dict[str, tuple[Expression, Place]] = {}
    for row, spot in rows:
        _take_cell(row, spot.at(f"column {HOME.get(kinds[row['j']], '')}"), kinds, found)
    for key, cell in table_at(value, place, _EXAMPLE).items():
        here = place.at(shown(key))
        if key not in variables:
            raise here.error(
                f"is no joint variable{near(key, variables)}; expected one such as {_EXAMPLE}"
            )
        if variables[key] in found:
            raise here.error(f"{key} stands as a relation in the table too; keep one of them")
        found[variables[key]] = (expression_at(cell, here), here)
    for name, (expression, here) in found.items():
        _check(name, expression, variables, symbols, here)
        _make_passive(next(row for row, _ in rows if row["j"] == name), places[name], here)
    _check_circles({name: expression for name, (expression, _) in found.items()}, place)
    return {name: expression for name, (expression, _) in found.items()}


def _take_cell(
    row: Row, place: Place, kinds: Mapping[str, Any], found: dict[str, tuple[Expression, Place]]
) -> None:
    """Take a cell that is a relation out of the row."""
    column, own = HOME.get(kinds[row["j"]]), f"q{row['j']}"
    if column is None or not isinstance(row.get(column), str):
        return
    expression = expression_at(row[column], place)
    others = {n for n in expression.names if n.startswith("q") and n[1:] in kinds and n != own}
    if others and own not in expression.names:
        found[row["j"]] = (expression, place)
        row[column] = own


def _check(
    name: str,
    expression: Expression,
    variables: Mapping[str, str],
    symbols: Mapping[str, float],
    place: Place,
) -> None:
    check_declared(expression, {**symbols, **dict.fromkeys(variables, 0.0)}, place)
    if f"q{name}" in expression.names:
        raise place.error(
            f"got {shown(expression.text)}, which holds q{name} itself; expected other joints"
        )
    form = form_at(expression, symbols, place, "-q2 - pi/2")
    check_size(expression, form.coefficients.values(), LARGEST_RATIO, place)
    if not form.coefficients:
        raise place.error(
            f"got {shown(expression.text)}, a constant; a joint that does not move has sigma 2"
        )


def _make_passive(row: Row, place: Place, relation: Place) -> None:
    if row.get("mu", 0) == 1:
        raise place.at("column mu").error(
            f"got 1, and q{row['j']} follows other joints ({relation.spot}); write 0, or remove "
            "the relation"
        )
    row["mu"] = 0


def _check_circles(relations: Mapping[str, Expression], place: Place) -> None:
    left = dict(relations)
    while left:
        names = {f"q{name}" for name in left}
        ready = [name for name, expression in left.items() if not expression.names & names]
        if not ready:
            raise place.error(
                f"{', '.join(f'q{name}' for name in left)} follow each other in a circle; leave "
                "one of them free"
            )
        for name in ready:
            del left[name]
