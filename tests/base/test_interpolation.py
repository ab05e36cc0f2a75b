"""Rational functions come back from their residues, or are refused."""

import pytest
import sympy

from modeler.derivation.certificate import (
    LARGE,
)
from modeler.derivation.field import ExactField, TooLarge
from modeler.derivation.tied import Probes, coefficient

al, L, d, r = sympy.symbols("al L d r", real=True)
K = ExactField([sympy.cos(al), d, r, L])


def sampled(expression: sympy.Expr):
    """The function as a black box: evaluated in Python integers, not in the field."""
    letters = {letter: sympy.Symbol(f"x{i}") for i, letter in enumerate(K.letters)}
    t = letters[sympy.cos(al, evaluate=False)]
    halves = {sympy.cos(al): (1 - t**2) / (1 + t**2), sympy.sin(al): 2 * t / (1 + t**2)}
    top, bottom = sympy.fraction(sympy.together(expression.subs(halves).subs(letters)))
    parts = [sympy.Poly(part, *letters.values()) for part in (top, bottom)]

    def residue(poly: sympy.Poly, point: tuple[int, ...]) -> int:
        total = 0
        for exponents, number in poly.terms():
            term = int(number.p) * pow(int(number.q), -1, LARGE)
            for x, e in zip(point, exponents, strict=True):
                term = term * pow(x, e, LARGE) % LARGE
            total += term
        return total % LARGE

    def function(points):
        return [residue(parts[0], p) * pow(residue(parts[1], p), -1, LARGE) % LARGE for p in points]

    return function


@pytest.mark.parametrize(
    "expression",
    [
        sympy.Integer(-1),
        sympy.Rational(10186, 10000) ** 2,
        -3 * d**2 / (7 * r),
        d / r**4,
        sympy.sin(al) ** 2 * (r**2 + d**2),
        d * sympy.cos(al) / sympy.sin(al),
        (d * L - r**2) / (L + 2 * d),
        sympy.Rational(3, 1000) + d * (L + r) * sympy.cos(al) / 17,
        d**9 / L,
        1 + d**9,
    ],
)  # fmt: skip
def test_a_quotient_of_polynomials_is_recovered(expression):
    probes = Probes(len(K.letters), 4)
    found = K.expression(coefficient(sampled(expression), K, probes))
    assert sympy.simplify(found - expression) == 0


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (sampled(1 + d**13), "degree above 12"),
        (sampled((1 + d**4) * (1 + r**4) * (1 + L**4) * (d + r * L)), "up to 217 terms"),
        (lambda points: [pow(p[1], (LARGE + 1) // 4, LARGE) for p in points], "degree above"),
        (sampled(sympy.Integer(3) ** 60), "long numbers"),
        (sampled(1 + d * sympy.Integer(3) ** 60), "long numbers"),
    ],
)
def test_what_is_no_short_quotient_is_refused(function, message):
    with pytest.raises(TooLarge, match=message):
        coefficient(function, K, Probes(len(K.letters), 4))


def test_a_function_that_differs_elsewhere_is_refused():
    """What fits the points that it was made from must also hold at fresh ones."""
    probes = Probes(len(K.letters), 4)
    d_of, far = sampled(d), set(probes.fresh)

    def function(points):
        return [(x + (p in far)) % LARGE for x, p in zip(d_of(points), points, strict=True)]

    with pytest.raises(TooLarge, match="no quotient"):
        coefficient(function, K, probes)
