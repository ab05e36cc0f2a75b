"""Linear relations between functions, exactly: rank, independent set, map to base parameters."""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

from sympy.polys.domains import QQ
from sympy.polys.matrices import DomainMatrix

from modeler.terms.ring import Poly

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


class Elimination:
    """Row echelon form that grows vector by vector, over Q or modulo a prime."""

    def __init__(self, prime: int | None = None) -> None:
        self.prime = prime
        self._rows: list[tuple[Hashable, dict[Hashable, Any], dict[str, Any]]] = []

    def add(self, key: str, vector: Vector) -> Mapping[str, Any]:
        """The vector as a combination of independent ones; {key: 1} if it is one of them."""
        rest, combination = self.reduce(vector)
        if not rest:
            return combination
        pivot = next(iter(rest))
        inverse = self._inverse(rest[pivot])
        row = {place: self._wrap(value * inverse) for place, value in rest.items()}
        # rest = vector - sum combination, so row = inverse (key - combination)
        made = {name: self._wrap(-value * inverse) for name, value in combination.items()}
        made[key] = inverse
        self._rows.append((pivot, row, made))
        return {key: self._one()}

    def reduce(self, vector: Vector) -> tuple[dict[Hashable, Any], dict[str, Any]]:
        """(what is outside the span, combination of what is inside)."""
        rest = {place: value for place, value in vector.items() if value}
        combination: dict[str, Any] = {}
        for pivot, row, made in self._rows:
            factor = rest.get(pivot)
            if factor:
                self._add(rest, row, -factor)
                self._add(combination, made, factor)
        return rest, combination

    def _add(self, total: dict[Any, Any], row: Mapping[Any, Any], factor: Any) -> None:
        for place, value in row.items():
            new = self._wrap(total.get(place, 0) + factor * value)
            if new:
                total[place] = new
            else:
                total.pop(place, None)

    def _wrap(self, value: Any) -> Any:
        return value if self.prime is None else value % self.prime

    def _inverse(self, value: Any) -> Any:
        return QQ(1) / value if self.prime is None else pow(value, -1, self.prime)

    def _one(self) -> Any:
        return QQ(1) if self.prime is None else 1


def relations(vectors: Mapping[str, Vector]) -> Relations:
    """The independent vectors, first come first kept, and all the others in terms of them."""
    elimination = Elimination()
    combinations: dict[str, Mapping[str, Fraction]] = {}
    independent: list[str] = []
    for key, vector in vectors.items():
        found = elimination.add(key, vector)
        if key in found:
            independent.append(key)
        combinations[key] = _ordered(found, independent)
    return Relations(tuple(independent), combinations)


def _ordered(found: Mapping[str, Any], order: Sequence[str]) -> dict[str, Fraction]:
    return {
        name: Fraction(int(found[name].numerator), int(found[name].denominator))
        for name in order
        if found.get(name)
    }


def combination_of(vectors: Mapping[str, Vector], vector: Vector) -> Mapping[str, Fraction] | None:
    """`vector` as a combination of `vectors`, None if it is outside their span."""
    elimination = Elimination()
    for key, each in vectors.items():
        elimination.add(key, each)
    rest, found = elimination.reduce(vector)
    return None if rest else _ordered(found, list(vectors))


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
        determinant: of the square matrix, a polynomial of the geometry; None if it is not square.
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
    if len(used) == len(rows) and rows:
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
