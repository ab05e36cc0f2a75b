"""Linear relations between functions, exactly: rank, independent set, map to base parameters."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from sympy.polys.domains import QQ
from sympy.polys.matrices import DomainMatrix

from modeler.derivation.certificate import row_echelon
from modeler.formulas.ring import Poly

MOST_MONOMIALS = 150
"""Monomials of a map up to which its determinant is expanded: 67 for a PUMA 560, 106 for a tree of
three joints with general angles (1 s); minutes at 216."""

Vector: TypeAlias = Mapping[Any, Any]
"""Sparse vector over Q: {place: rational number}."""


@dataclass(frozen=True)
class Relations:
    """Every vector in terms of those that come first.

    Attributes:
        independent: keys of the independent vectors, in order.
        combinations: {key: {independent key: rational factor}}, for all keys.
    """

    independent: tuple[str, ...]
    combinations: Mapping[str, Mapping[str, Fraction]]

    @property
    def rank(self) -> int:
        """Dimension of the span over Q."""
        return len(self.independent)


def relations(vectors: Mapping[str, Vector]) -> Relations:
    """The independent vectors, first come first kept, and all the others in terms of them."""
    names, places = list(vectors), _places(vectors.values())
    columns: dict[int, dict[int, Any]] = {}
    for k, vector in enumerate(vectors.values()):
        for place, value in vector.items():
            if value:
                columns.setdefault(places[place], {})[k] = value
    reduced, pivots = DomainMatrix(columns, (len(places), len(names)), QQ).rref()
    found: dict[str, dict[str, Fraction]] = {name: {} for name in names}
    for row, line in sorted(reduced.to_dod().items()):
        for k, value in line.items():
            number = Fraction(int(value.numerator), int(value.denominator))
            found[names[k]][names[pivots[row]]] = number
    return Relations(tuple(names[k] for k in pivots), found)


def combination_of(vectors: Mapping[str, Vector], vector: Vector) -> Mapping[str, Fraction] | None:
    """`vector` as a combination of `vectors`, None if it is outside their span."""
    found = relations({**vectors, "": vector})
    return None if "" in found.independent else found.combinations[""]


def independent_modulo(vectors: Sequence[Vector], prime: int) -> list[int]:
    """Places of the independent vectors of residues, first come first kept; the prime < 2**31."""
    places = _places(vectors)
    matrix = np.zeros((len(places), len(vectors)), dtype=np.int64)
    for k, vector in enumerate(vectors):
        for place, value in vector.items():
            matrix[places[place], k] = value
    return [k for _, k in row_echelon(matrix, range(len(vectors)), prime)]


def _places(vectors: Iterable[Vector]) -> dict[Any, int]:
    """Row by place, in order of appearance."""
    return {place: i for i, place in enumerate(dict.fromkeys(p for v in vectors for p in v))}


def classes(found: Relations) -> list[list[str]]:
    """Keys that are the same up to a constant factor."""
    groups: dict[tuple[tuple[str, Fraction], ...], list[str]] = {}
    for key, combination in found.combinations.items():
        first = next(iter(combination.values()), Fraction(1))
        shape = tuple((name, value / first) for name, value in combination.items())
        groups.setdefault(shape, []).append(key)
    return list(groups.values())


@dataclass(frozen=True)
class BaseMap:
    """Coefficients = matrix * base parameters.

    Attributes:
        rows: names of coefficients, independent when the geometry is known.
        columns: names of the base parameters that occur.
        entries: {(row, column): factor, a polynomial of the geometry}.
        determinant: of the square matrix, a polynomial of the geometry; None if it is not square,
            or has so many monomials that nobody would read it.
    """

    rows: tuple[str, ...]
    columns: tuple[str, ...]
    entries: Mapping[tuple[int, int], Poly]
    determinant: Poly | None


def base_map(
    rows: Sequence[str], forms: Sequence[Mapping[int, Poly]], names: Sequence[str], ring: Any
) -> BaseMap:
    """The map from base parameters to coefficients.

    Args:
        rows: names of the coefficients.
        forms: {index of the base parameter: factor}, per row.
        names: names of all base parameters.
        ring: of the factors.
    """
    used = sorted({k for form in forms for k in form})
    place = {k: i for i, k in enumerate(used)}
    entries = {(r, place[k]): factor for r, form in enumerate(forms) for k, factor in form.items()}
    determinant = None
    size = sum(len(factor) for factor in entries.values())
    if len(used) == len(rows) and rows and size <= MOST_MONOMIALS:
        determinant = _matrix(entries, len(used), ring).det()
        determinant = ring(determinant)
    return BaseMap(tuple(rows), tuple(names[k] for k in used), entries, determinant)


def inverse_map(found: BaseMap, ring: Any) -> Mapping[str, Mapping[str, Any]] | None:
    """{base parameter: {coefficient: factor, a rational function of the geometry}}.

    None if the map is not square or not invertible.
    """
    if not found.determinant:
        return None
    inverse = _matrix(found.entries, len(found.rows), ring).to_field().inv().to_dod()
    return {
        name: {found.rows[c]: value for c, value in sorted(inverse.get(r, {}).items())}
        for r, name in enumerate(found.columns)
    }


def _matrix(entries: Mapping[tuple[int, int], Poly], size: int, ring: Any) -> DomainMatrix:
    rows: dict[int, dict[int, Poly]] = {}
    for (r, c), factor in entries.items():
        rows.setdefault(r, {})[c] = factor
    return DomainMatrix(rows, (size, size), ring.to_domain())
