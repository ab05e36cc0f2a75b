"""Which physical parameters the coefficients show, and how many of them at most."""

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from modeler.formulas.physical import PhysicalParameters
from modeler.formulas.relations import independent_modulo
from modeler.formulas.ring import Poly

SEED = 2000
_LARGEST = 2**31


@dataclass(frozen=True)
class Identifiability:
    """What the coefficients tell of the physical parameters.

    Attributes:
        letters: all physical parameters.
        appearing: those that some coefficient depends on.
        vanishing: the others.
        sums: groups that enter only together, as {letter: +1 or -1}: bl1 and ct1 as bl1 + ct1.
        jacobian_rank: generic rank of d coefficients / d appearing parameters: so many of them
            follow at most from the coefficients; the others must be known.
        points: number of random points, modulo a prime, of which the highest rank was taken.
        seed: of the points.
    """

    letters: tuple[str, ...]
    appearing: tuple[str, ...]
    vanishing: tuple[str, ...]
    sums: tuple[Mapping[str, int], ...]
    jacobian_rank: int
    points: int
    seed: int


def identifiability(
    physical: PhysicalParameters, coefficients: Sequence[Poly], points: int = 2, seed: int = SEED
) -> Identifiability:
    """What those coefficients, polynomials of the physical parameters, tell of them."""
    slopes = {
        letter: tuple(physical.derivative(poly, letter) for poly in coefficients)
        for letter in physical.letters
    }
    appearing = tuple(letter for letter, column in slopes.items() if any(column))
    chance = random.Random(seed)
    ranks = [_rank([slopes[x] for x in appearing], physical, chance) for _ in range(points)]
    return Identifiability(
        physical.letters,
        appearing,
        tuple(letter for letter in physical.letters if letter not in appearing),
        _sums({letter: slopes[letter] for letter in appearing}),
        max(ranks),
        points,
        seed,
    )


def _sums(slopes: Mapping[str, tuple[Poly, ...]]) -> tuple[dict[str, int], ...]:
    """Letters whose columns of the Jacobian are the same polynomials up to the sign."""
    groups: list[tuple[tuple[Poly, ...], dict[str, int]]] = []
    for letter, column in slopes.items():
        for other, members in groups:
            if column == other:
                members[letter] = 1
                break
            if all(a == -b for a, b in zip(column, other, strict=True)):
                members[letter] = -1
                break
        else:
            groups.append((column, {letter: 1}))
    return tuple(members for _, members in groups if len(members) > 1)


def _rank(
    columns: Sequence[Sequence[Poly]], physical: PhysicalParameters, chance: random.Random
) -> int:
    prime, point = random_point(physical.names, chance)
    vectors = [
        {i: value_modulo(poly, point, prime) for i, poly in enumerate(column) if poly}
        for column in columns
    ]
    return len(independent_modulo(vectors, prime))


def random_point(names: Sequence[str], chance: random.Random) -> tuple[int, list[int]]:
    """(prime, values of the generators modulo it): random letters, angles on the circle, roots."""
    numbers = {name: sympy.sympify(name).args[0] for name in names if name.startswith("sqrt(")}
    prime = sympy.prevprime(chance.randrange(_LARGEST // 2, _LARGEST))
    while not all(sympy.is_quad_residue(_modulo(x, prime), prime) for x in numbers.values()):
        prime = sympy.prevprime(prime)
    values: dict[str, int] = {}
    for name in names:
        if name in numbers:
            values[name] = int(sympy.sqrt_mod(_modulo(numbers[name], prime), prime))
        elif name.startswith("cos("):
            t = chance.randrange(2, 10**6)
            down = pow(1 + t * t, -1, prime)
            values[name] = (1 - t * t) * down % prime
            values["sin" + name[3:]] = 2 * t * down % prime
        elif name not in values:
            values[name] = chance.randrange(1, prime)
    return prime, [values[name] for name in names]


def _modulo(value: sympy.Rational, prime: int) -> int:
    return int(value.p) * pow(int(value.q), -1, prime) % prime


def value_modulo(poly: Poly, point: Sequence[int], prime: int) -> int:
    """The polynomial's value modulo the prime."""
    total = 0
    for at, value in poly.items():
        term: Any = int(value.numerator) * pow(int(value.denominator), -1, prime)
        for x, exponent in zip(point, at, strict=True):
            if exponent:
                term = term * pow(x, exponent, prime) % prime
        total += term
    return total % prime
