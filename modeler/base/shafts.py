"""Grouping of friction columns: exact, from the speeds of their shafts alone.

Viscous columns are dependent iff their Rayleigh functions, sums of v**2, are, which is linear
algebra on the products of independent speeds. Coulomb columns are sums of weight * |direction|,
where a direction is a speed up to a factor; the functions |v| of different directions are
independent, since each has its kink where the others have none. So they are dependent iff their
weights are; no sampling of sign() is needed.
"""

from collections.abc import Callable, Hashable, Mapping, Sequence
from fractions import Fraction

from modeler.effects import EnergyBlock
from modeler.symbolic import StandardColumn, in_block

Relation = dict[int, Fraction]
"""sum of coefficient * column = 0, by column."""

Shaft = Mapping[int, Fraction]
"""Speed of a shaft: sum of coefficient * speed of a free variable."""


def friction_relations(columns: Sequence[StandardColumn]) -> list[Relation]:
    """All relations among the viscous and among the Coulomb columns, speeds being independent."""
    return _dependent(columns, EnergyBlock.RAYLEIGH, squares) + _dependent(
        columns, EnergyBlock.COULOMB, _direction
    )


def squares(shaft: Shaft) -> dict[Hashable, Fraction]:
    """v**2 as a polynomial in the speeds: {(i, j): coefficient}, i <= j."""
    found: dict[Hashable, Fraction] = {}
    for i, ci in shaft.items():
        for j, cj in shaft.items():
            key = (min(i, j), max(i, j))
            found[key] = found.get(key, Fraction(0)) + ci * cj
    return found


def _direction(shaft: Shaft) -> dict[Hashable, Fraction]:
    """|v| as {direction: weight}; the direction has the coefficient 1 at its first speed."""
    first = shaft[min(shaft)]
    direction = tuple(sorted((k, c / first) for k, c in shaft.items()))
    return {direction: abs(first)}


def _dependent(
    columns: Sequence[StandardColumn],
    block: EnergyBlock,
    function: Callable[[Shaft], dict[Hashable, Fraction]],
) -> list[Relation]:
    relations: list[Relation] = []
    basis: list[tuple[dict[Hashable, Fraction], Relation]] = []
    for place, column in enumerate(columns):
        if not in_block(column, block):
            continue
        rest: dict[Hashable, Fraction] = {}
        for part in column.parts:
            rest = _minus(rest, function(part.shaft), Fraction(-1)) if part.shaft else rest
        used = {place: Fraction(1)}
        for known, combination in basis:
            pivot = next(iter(known))
            factor = rest.get(pivot, Fraction(0)) / known[pivot]
            rest = _minus(rest, known, factor)
            used = _minus(used, combination, factor)
        if rest:
            basis.append((rest, used))
        else:
            relations.append(used)
    return relations


def _minus(a: Mapping, b: Mapping, factor: Fraction) -> dict:
    keys = list(a) + [key for key in b if key not in a]
    found = {key: a.get(key, Fraction(0)) - factor * b.get(key, Fraction(0)) for key in keys}
    return {key: value for key, value in found.items() if value}
