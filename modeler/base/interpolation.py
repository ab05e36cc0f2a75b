"""Rational functions from their values modulo a prime."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Protocol

import numpy as np
from sympy import QQ

from modeler.base.elimination import TooLarge
from modeler.base.field import Element, ExactField
from modeler.base.residues import LARGE, reconstructed, row_echelon

_EXPONENTS = (1, -1, 2, -2, 3, -3, 4, -4)
_LARGEST_DEGREE = 8
_MOST_LETTERS = 4
_MOST_TERMS = 220


class Sampler(Protocol):
    """Gives values of functions of the geometry; abstract, holds no data."""

    home: tuple[int, ...]

    def fresh(self) -> int:
        """A random residue."""
        ...

    def values(self, at: tuple[int, int], geometries: Sequence[tuple[int, ...]]) -> list[int]:
        """The function `at`, at the geometries."""
        ...


@dataclass(frozen=True)
class Sampled:
    """One function of the letters of K that can be evaluated modulo LARGE."""

    K: ExactField
    sampler: Sampler
    at: tuple[int, int]

    def __call__(self, geometries: Sequence[tuple[int, ...]]) -> list[int]:
        """Its values at the geometries."""
        return self.sampler.values(self.at, geometries)


def coefficient(function: Sampled) -> Element:
    """The element of K whose values the function has: a monomial, or a quotient of polynomials.

    Raises:
        TooLarge: it depends on too many letters, or its degree is too high.
    """
    home = function.sampler.home
    moved = _shared_moves(function.sampler)
    value, *others = function([home, *moved])
    letters = [i for i, other in enumerate(others) if other != value]
    found = _monomial(function, value, letters, moved, others)
    if found is None:
        found = _quotient(function, letters)
    _check(function, found)
    return found


def _shared_moves(sampler: Sampler) -> list[tuple[int, ...]]:
    """For each letter a geometry in which only it has changed; the same for all functions."""
    moved = getattr(sampler, "moved", None)
    if moved is None:
        home = sampler.home
        moved = [(*home[:i], sampler.fresh(), *home[i + 1 :]) for i in range(len(home))]
        sampler.moved = moved  # type: ignore[attr-defined]
        sampler.checks = [  # type: ignore[attr-defined]
            tuple(sampler.fresh() for _ in home) for _ in range(2)
        ]
    return moved


def _monomial(
    function: Sampled,
    value: int,
    letters: Sequence[int],
    moved: Sequence[tuple[int, ...]],
    others: Sequence[int],
) -> Element | None:
    """c * product of powers, if it is one."""
    home, K = function.sampler.home, function.K
    exponents = {}
    for i in letters:
        ratio = others[i] * pow(value, -1, LARGE) % LARGE
        step = moved[i][i] * pow(home[i], -1, LARGE) % LARGE
        fitting = [e for e in _EXPONENTS if pow(step, e, LARGE) == ratio]
        if not fitting:
            return None
        exponents[i] = fitting[0]
    for i, e in exponents.items():
        value = value * pow(home[i], -e, LARGE) % LARGE
    number = reconstructed(value, LARGE)
    if number is None:
        return None
    found = K.one * QQ(number.numerator, number.denominator)
    for i, e in exponents.items():
        generator = K.generator(i)
        found = found * (generator**e if e > 0 else K.one / generator**-e)
    return found


def _quotient(function: Sampled, letters: Sequence[int]) -> Element:
    """numerator / denominator of the lowest total degree that fits."""
    if len(letters) > _MOST_LETTERS:
        raise TooLarge(f"a coefficient depends on {len(letters)} lengths and angles")
    home, K = function.sampler.home, function.K
    for degree in range(1, _LARGEST_DEGREE + 1):
        monomials = _monomials(len(letters), degree)
        if 2 * len(monomials) > _MOST_TERMS:
            break
        points = _shared_points(function.sampler, tuple(letters), 2 * len(monomials) + 2)
        geometries = []
        for point in points:
            geometry = list(home)
            for i, x in zip(letters, point, strict=True):
                geometry[i] = x
            geometries.append(tuple(geometry))
        values = function(geometries)
        weights = _fitted(points, values, monomials)
        if weights is None:
            continue
        numbers = [reconstructed(w, LARGE) for w in weights]
        if any(number is None for number in numbers):
            continue
        parts = []
        for half in (numbers[: len(monomials)], numbers[len(monomials) :]):
            total = K.zero
            for number, monomial in zip(half, monomials, strict=True):
                if number:
                    term = K.one * QQ(number.numerator, number.denominator)
                    for i, e in zip(letters, monomial, strict=True):
                        term = term * K.generator(i) ** e
                    total = total + term
            parts.append(total)
        return parts[0] / parts[1]
    raise TooLarge("a coefficient is no quotient of short polynomials")


def _monomials(count: int, degree: int) -> list[tuple[int, ...]]:
    found = []
    for total in range(degree + 1):
        for chosen in combinations_with_replacement(range(count), total):
            found.append(tuple(chosen.count(i) for i in range(count)))
    return found


def _shared_points(sampler: Sampler, letters: tuple[int, ...], count: int) -> list[tuple[int, ...]]:
    """Random values of these letters; the same for all functions, so that samples are reused."""
    known = getattr(sampler, "drawn_points", None)
    if known is None:
        known = {}
        sampler.drawn_points = known  # type: ignore[attr-defined]
    points = known.setdefault(letters, [])
    while len(points) < count:
        points.append(tuple(sampler.fresh() for _ in letters))
    return points[:count]


def _fitted(
    points: Sequence[tuple[int, ...]], values: Sequence[int], monomials: Sequence[tuple[int, ...]]
) -> list[int] | None:
    """Coefficients of numerator and denominator with numerator - value * denominator = 0."""
    rows = []
    for point, value in zip(points, values, strict=True):
        line = []
        for monomial in monomials:
            term = 1
            for x, e in zip(point, monomial, strict=True):
                term = term * pow(x, e, LARGE) % LARGE
            line.append(term)
        rows.append([*line, *(-value * term % LARGE for term in line)])
    matrix = np.array(rows, dtype=object)
    width = matrix.shape[1]
    pivots = row_echelon(matrix, range(width), LARGE)
    free = [column for column in range(width) if column not in {c for _, c in pivots}]
    if not free:
        return None
    found = [0] * width
    found[free[0]] = 1
    for row, column in pivots:
        found[column] = int(-matrix[row, free[0]] % LARGE)
    return found if any(found[len(monomials) :]) else None


def _check(function: Sampled, found: Element) -> None:
    """The element has the function's values at fresh geometries.

    Raises:
        TooLarge: it has not.
    """
    checks = function.sampler.checks  # type: ignore[attr-defined]
    for geometry, value in zip(checks, function(checks), strict=True):
        at = dict(zip(function.K.letters, geometry, strict=True))
        if function.K.residue(found, at, LARGE) != value:
            raise TooLarge("a coefficient is no quotient of short polynomials")
