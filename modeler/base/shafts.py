"""Grouping of friction columns: exact, from the speeds of their shafts alone.

Viscous columns are dependent iff their Rayleigh functions v**2 are, which is linear algebra on the
products of independent joint speeds. Two Coulomb columns are dependent iff their speeds are
proportional, v_a = lambda v_b, and then with weight |lambda|; no sampling of sign() is needed, and
no three columns of pairwise non-proportional speeds are dependent, since |v| has its kink where
the others have none.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction

from modeler.effects import EnergyBlock
from modeler.symbolic import StandardColumn
from modeler.symbolic.model import exact

Relation = dict[int, Fraction]
"""sum of coefficient * column = 0, by column."""


def friction_relations(columns: Sequence[StandardColumn]) -> list[Relation]:
    """All relations among the viscous and among the Coulomb columns of a tree robot."""
    return _rayleigh(columns) + _coulomb(columns)


def _of_block(
    columns: Sequence[StandardColumn], block: EnergyBlock
) -> list[tuple[int, Mapping[int, Fraction]]]:
    return [
        (place, {i: exact(c) for i, c in column.shaft.items()})
        for place, column in enumerate(columns)
        if column.column is not None and column.shaft and column.column.block is block
    ]


def squares(shaft: Mapping[int, Fraction]) -> dict[tuple[int, int], Fraction]:
    """v**2 as a polynomial in the joint speeds: {(i, j): coefficient}, i <= j."""
    found: dict[tuple[int, int], Fraction] = {}
    for i, ci in shaft.items():
        for j, cj in shaft.items():
            key = (min(i, j), max(i, j))
            found[key] = found.get(key, Fraction(0)) + ci * cj
    return found


def _rayleigh(columns: Sequence[StandardColumn]) -> list[Relation]:
    relations: list[Relation] = []
    basis: list[tuple[dict[tuple[int, int], Fraction], Relation]] = []
    for place, shaft in _of_block(columns, EnergyBlock.RAYLEIGH):
        rest, used = squares(shaft), {place: Fraction(1)}
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


def _coulomb(columns: Sequence[StandardColumn]) -> list[Relation]:
    relations: list[Relation] = []
    kept: list[tuple[int, Mapping[int, Fraction]]] = []
    for place, shaft in _of_block(columns, EnergyBlock.COULOMB):
        for other, known in kept:
            ratio = proportion(shaft, known)
            if ratio is not None:
                relations.append({place: Fraction(1), other: -abs(ratio)})
                break
        else:
            kept.append((place, shaft))
    return relations


def proportion(a: Mapping[int, Fraction], b: Mapping[int, Fraction]) -> Fraction | None:
    """lambda with a = lambda b, or None."""
    if set(a) != set(b):
        return None
    ratios = {a[i] / b[i] for i in a}
    return ratios.pop() if len(ratios) == 1 else None
