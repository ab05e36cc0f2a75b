"""The `[symbols]` table and the gravity of a robot file."""

import keyword
import re
from collections.abc import Collection, Mapping
from typing import Any

from modeler.core.expression import FUNCTIONS, Expression
from modeler.robot.cells import (
    check_declared,
    check_name_length,
    expression_at,
    form_at,
    length_at,
    list_at,
    table_at,
)
from modeler.robot.place import Place, shown

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
# Symbols become names in C.
C_WORDS = """
    auto break case char const continue default do double else enum extern float for goto if
    inline int long register restrict return short signed sizeof static struct switch typedef
    union unsigned void volatile while
"""


def read_symbols(value: Any, variables: Collection[str], place: Place) -> dict[str, Expression]:
    """Symbols and their values, so ordered that each stands after those its value uses.

    Args:
        value: the table.
        variables: names of the joint variables, which symbols must not shadow.
        place: where it stands.

    Raises:
        RobotError: a bad name, a value that is no number, a circle of values.
    """
    table = table_at(value, place, "[symbols] D3 = 0.45")
    symbols = {}
    for name, cell in table.items():
        _check_name(name, variables, place)
        symbols[name] = expression_at(cell, place.at(name))
        check_declared(symbols[name], table, place.at(name))
    return _ordered(symbols, place)


def read_gravity(
    value: Any, variables: Collection[str], symbols: Mapping[str, float], place: Place
) -> tuple[Expression, Expression, Expression]:
    """Acceleration of gravity in frame 0, m/s2.

    Raises:
        RobotError: not three entries, or entries that are not constants.
    """
    cells = list_at(value, place, '[0, 0, "-g"]', length=3)
    for number, cell in enumerate(cells, start=1):
        here = place.at(f"entry {number}")
        expression = expression_at(cell, here)
        moving = sorted(expression.names & set(variables))
        if moving:
            raise here.error(
                f"got {shown(expression.text)}, which uses the joint variable {moving[0]}; "
                "gravity is constant in frame 0: expected numbers and symbols"
            )
        check_declared(expression, symbols, here)
        length_at(expression, symbols, here)
    x, y, z = (expression_at(cell, place) for cell in cells)
    return x, y, z


def _check_name(name: str, variables: Collection[str], place: Place) -> None:
    if not name.isascii() or not _NAME.fullmatch(name):
        raise place.error(
            f"got the name {shown(name)}; expected a letter, then letters, digits or _, such as D3"
        )
    check_name_length(name, place)
    taken = {
        "a joint variable": name in variables,
        "the number pi": name == "pi",
        "a function": name in FUNCTIONS,
        "a word of the C language": name in C_WORDS.split(),
        "a word of the expression language": keyword.iskeyword(name),
    }
    for what, is_taken in taken.items():
        if is_taken:
            raise place.error(f"{shown(name)} is the name of {what}; choose another name")


def _ordered(symbols: Mapping[str, Expression], place: Place) -> dict[str, Expression]:
    ordered: dict[str, Expression] = {}
    values: dict[str, float] = {}
    waiting = dict(symbols)
    while waiting:
        ready = next((n for n, e in waiting.items() if e.names <= ordered.keys()), None)
        if ready is None:
            names = ", ".join(waiting)
            raise place.error(
                f"the values of {names} refer to each other in a circle; give one of them a number"
            )
        ordered[ready] = waiting.pop(ready)
        values[ready] = form_at(ordered[ready], values, place.at(ready)).constant
    return ordered
