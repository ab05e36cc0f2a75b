"""Rational functions from their values modulo a prime.

The functions are coefficients of relations: quotients of polynomials in the letters of the exact
field, with rational numbers that are small against the prime. Most are one monomial, which shows
when one letter is changed at a time. For the others the degrees in each letter are found first,
then all coefficients from one linear system.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import product

import numpy as np
from sympy import QQ

from modeler.base.elimination import TooLarge
from modeler.base.field import Element, ExactField
from modeler.base.residues import LARGE, drawn, reconstructed, row_echelon

Point = tuple[int, ...]
"""A residue modulo LARGE for each letter of the field."""

Function = Callable[[Sequence[Point]], list[int]]
"""Its values modulo LARGE at some points."""

_EXPONENTS = (1, -1, 2, -2, 3, -3, 4, -4)
_LARGEST_DEGREE = 12
_MOST_TERMS = 160
_CHECKS = 2


class Probes:
    """Random points, the same for all functions, so that what was sampled serves again.

    Attributes:
        home: one point.
        fresh: points that no function is made from, for checks.
    """

    def __init__(self, letters: int, seed: int) -> None:
        self._rng = np.random.default_rng(seed)
        self._letters = letters
        self.home = self._point()
        self.fresh = [self._point() for _ in range(_CHECKS)]
        self._known: dict[tuple[int, ...], list[Point]] = {}

    def moved(self, letters: tuple[int, ...], count: int) -> list[Point]:
        """The first `count` points that differ from home in these letters only."""
        known = self._known.setdefault(letters, [])
        while len(known) < count:
            other = self._point()
            known.append(tuple(other[i] if i in letters else x for i, x in enumerate(self.home)))
        return known[:count]

    def _point(self) -> Point:
        return tuple(int(x) for x in drawn(self._rng, (self._letters,), LARGE))


def coefficient(function: Function, K: ExactField, probes: Probes) -> Element:
    """The element of K whose values the function has.

    Raises:
        TooLarge: it has too many terms or too high a degree, or is no such element.
    """
    moved = [probes.moved((i,), 1)[0] for i in range(len(K.letters))]
    value, *others = function([probes.home, *moved])
    changes = {i: other for i, other in enumerate(others) if other != value}
    found = _monomial(value, changes, moved, K, probes)
    if found is None:
        found = _quotient(function, tuple(changes), K, probes)
    for point, value in zip(probes.fresh, function(probes.fresh), strict=True):
        if K.residue(found, dict(zip(K.letters, point, strict=True)), LARGE) != value:
            raise TooLarge("a coefficient is no quotient of short polynomials")
    return found


def _monomial(
    value: int, changes: Mapping[int, int], moved: Sequence[Point], K: ExactField, probes: Probes
) -> Element | None:
    """number * product of powers, if it is one: changing a letter multiplies by a power."""
    if value == 0:
        return None
    found = K.one
    for i, other in changes.items():
        ratio = other * pow(value, -1, LARGE) % LARGE
        step = moved[i][i] * pow(probes.home[i], -1, LARGE) % LARGE
        exponent = next((e for e in _EXPONENTS if pow(step, e, LARGE) == ratio), None)
        if exponent is None:
            return None
        found = found * K.generator(i) ** exponent
    at_home = K.residue(found, dict(zip(K.letters, probes.home, strict=True)), LARGE)
    number = reconstructed(value * pow(at_home, -1, LARGE) % LARGE, LARGE)
    return None if number is None else found * QQ(number.numerator, number.denominator)


def _quotient(
    function: Function, letters: tuple[int, ...], K: ExactField, probes: Probes
) -> Element:
    """numerator / denominator of the degrees in each letter that the function has alone in it."""
    degrees = [_degrees(function, i, probes) for i in letters]
    above, below = (list(product(*(range(d[k] + 1) for d in degrees))) for k in (0, 1))
    terms = len(above) + len(below)
    if terms > _MOST_TERMS:
        raise TooLarge(f"a coefficient has up to {terms} terms")
    weights = _fitted(function, probes.moved(letters, terms), letters, above, below)
    if weights is None:
        raise TooLarge("a coefficient is no quotient of short polynomials")
    numbers = [reconstructed(weight, LARGE) for weight in weights]
    top, bottom = K.zero, K.zero
    for place, (number, monomial) in enumerate(zip(numbers, [*above, *below], strict=True)):
        if number is None:
            raise TooLarge("a coefficient has long numbers")
        if number:
            term = K.one * QQ(number.numerator, number.denominator)
            for i, e in zip(letters, monomial, strict=True):
                term = term * K.generator(i) ** e
            top, bottom = (top + term, bottom) if place < len(above) else (top, bottom + term)
    return top / bottom


def _degrees(function: Function, letter: int, probes: Probes) -> tuple[int, int]:
    """Degrees of numerator and denominator in one letter, the others at home.

    Raises:
        TooLarge: they are above `_LARGEST_DEGREE`.
    """
    for degree in range(1, _LARGEST_DEGREE + 1):
        powers = [(e,) for e in range(degree + 1)]
        # One point more than there are terms, or some quotient would always fit.
        points = probes.moved((letter,), 2 * len(powers) + 1)
        weights = _fitted(function, points, (letter,), powers, powers)
        if weights is not None:
            return _degree(weights[: degree + 1]), _degree(weights[degree + 1 :])
    raise TooLarge(f"a coefficient is of degree above {_LARGEST_DEGREE}")


def _degree(weights: Sequence[int]) -> int:
    return max((i for i, weight in enumerate(weights) if weight), default=0)


def _fitted(
    function: Function,
    points: Sequence[Point],
    letters: tuple[int, ...],
    above: Sequence[Point],
    below: Sequence[Point],
) -> list[int] | None:
    """Coefficients of the monomials `above` and `below` the line; None if nothing fits.

    numerator - value * denominator = 0 at all points.
    """
    values = np.array(function(points), dtype=object)[:, None]
    at = np.array(points, dtype=object)[:, list(letters)]
    matrix = np.hstack([_powers(at, above), -values * _powers(at, below)]) % LARGE
    width = matrix.shape[1]
    pivots = row_echelon(matrix, range(width), LARGE)
    free = sorted(set(range(width)) - {column for _, column in pivots})
    if not free:
        return None
    found = [0] * width
    found[free[0]] = 1
    for row, column in pivots:
        found[column] = int(-matrix[row, free[0]] % LARGE)
    return found if any(found[len(above) :]) else None


def _powers(at: np.ndarray, monomials: Sequence[Point]) -> np.ndarray:
    """(points, monomials): values of the monomials at `at` (points, letters)."""
    values = np.ones((len(at), len(monomials)), dtype=object)
    for i in range(at.shape[1]):
        table = [values[:, 0] * 0 + 1]
        for _ in range(max(monomial[i] for monomial in monomials)):
            table.append(table[-1] * at[:, i] % LARGE)
        for place, monomial in enumerate(monomials):
            values[:, place] = values[:, place] * table[monomial[i]] % LARGE
    return values
