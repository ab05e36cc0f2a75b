"""Fractions in few of many letters are what sympy makes of them in all letters."""

import random

import pytest
from sympy import QQ
from sympy.polys.fields import field

from modeler.derivation.field import Fraction, cancelled

LETTERS = [f"u{i}" for i in range(9)]


def polynomial(ring, draw: random.Random, letters: list[int], terms: int):
    total = ring.zero
    for _ in range(terms):
        term = ring.ground_new(QQ(draw.randint(-6, 6), draw.randint(1, 4)))
        for i in letters:
            term *= ring.gens[i] ** draw.randint(0, 2)
        total += term
    return total


@pytest.mark.parametrize("seed", range(12))
def test_common_divisors_are_those_of_sympy(seed: int) -> None:
    draw = random.Random(seed)
    ring = field(LETTERS, QQ)[0].ring
    mine, others = (draw.sample(range(9), draw.randint(1, 2)) for _ in range(2))
    shared = polynomial(ring, draw, mine, 3) or ring.one
    numer = shared * (polynomial(ring, draw, others, 3) or ring.one)
    denom = shared * (polynomial(ring, draw, mine, 2) or ring.one)
    assert cancelled(numer, denom) == numer.cancel(denom)


def test_calculation_is_that_of_sympy() -> None:
    K, *letters = field(LETTERS, QQ)
    x, t = letters[2], letters[7]
    a, b = Fraction(K, x.numer), Fraction(K, t.numer)
    for e in ("(1 - b**2)/(1 + b**2)*a + 2*b/(1 + b**2)", "a/b - b/a", "(a**2 - b**2)/(a - b)/3"):
        found, told = eval(e, {"a": a, "b": b}), eval(e, {"a": x, "b": t})
        assert type(found) is Fraction and found == told and hash(found) == hash(told)
        assert (found.numer, found.denom) == (told.numer, told.denom)
