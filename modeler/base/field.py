"""The exact field of the grouping: rational functions of the geometric symbols over Q.

cos and sin of a general angle a are (1 - t**2)/(1 + t**2) and 2t/(1 + t**2) with t = tan(a/2), so
that the field stays rational; results are turned back into cos(a) and sin(a). Any other irrational
constant (a square root, say) is a letter of its own.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import sympy
from sympy.polys.fields import FracElement
from sympy.polys.fields import field as rational_functions

from modeler.base.fraction import Fraction
from modeler.base.trigonometry import in_cosines
from modeler.symbolic.angles import cos_sin
from modeler.symbolic.geometry import Geometry

Element = Any
"""An element of the field: a sympy `FracElement`, or a rational number."""


def times(a: Element, b: Element) -> Element:
    """a b. Most factors are 1, and the product of two fractions cancels common divisors."""
    if a == 1:
        return b
    if b == 1:
        return a
    # Polynomials have nothing to cancel, and looking for it is most of the work of a long chain.
    if _is_polynomial(a) and _is_polynomial(b):
        return a.raw_new(a.numer * b.numer, a.denom)
    return a * b


def minus(a: Element, b: Element) -> Element:
    """a - b."""
    if _is_polynomial(a) and _is_polynomial(b):
        return a.raw_new(a.numer - b.numer, a.denom)
    return a - b


def _is_polynomial(a: Element) -> bool:
    """True for a fraction over 1: its coefficients are whole then."""
    return isinstance(a, FracElement) and a.denom == 1


class ExactField:
    """Q(letters): conversion from and to sympy expressions.

    Attributes:
        letters: what each generator stands for: a "symbol", the cosine of an "angle" (the
            generator is then the tangent of half the angle), or an "opaque" constant.
    """

    def __init__(self, constants: Iterable[sympy.Expr]) -> None:
        letters: dict[sympy.Expr, str] = {}
        for constant in constants:
            _collect(sympy.sympify(constant), letters)
        self.letters = dict(sorted(letters.items(), key=lambda item: (item[1], str(item[0]))))
        names = [f"u{i}" for i in range(len(self.letters))]
        if names:
            self._field, *generators = rational_functions(names, sympy.QQ)
            generators = [Fraction(self._field, letter.numer) for letter in generators]
            self._one = Fraction(self._field, self._field.ring.one)
        else:
            self._field, generators, self._one = None, [], sympy.QQ(1)
        self._zero = self._one - self._one
        self._generator = dict(zip(self.letters, generators, strict=True))
        self._found: dict[sympy.Expr, Element] = {}
        self._told: dict[Element, sympy.Expr] = {}

    @property
    def one(self) -> Element:
        """1."""
        return self._one

    @property
    def zero(self) -> Element:
        """0."""
        return self._zero

    def element(self, value: sympy.Expr) -> Element:
        """The field element of a constant expression."""
        found = self._found.get(value)
        if found is None:
            found = self._convert(value)
            self._found[value] = found
        return found

    def generator(self, place: int) -> Element:
        """The generator of the letter at that place of `letters`."""
        return self._generator[list(self.letters)[place]]

    def cos_sin(self, angle: sympy.Expr) -> tuple[Element, Element]:
        """Cosine and sine of a constant angle."""
        c, s = cos_sin(angle)
        return self.element(c), self.element(s)

    def _convert(self, value: sympy.Expr) -> Element:
        if value.is_Rational:
            return self._one * sympy.QQ(int(value.p), int(value.q))
        if self.letters.get(value) in ("symbol", "opaque"):
            return self._generator[value]
        if value.is_Add or value.is_Mul:
            total = self.element(value.args[0])
            for arg in value.args[1:]:
                other = self.element(arg)
                total = total + other if value.is_Add else total * other
            return total
        if value.is_Pow:
            base, n = self.element(value.base), int(value.exp)
            return base**n if n >= 0 else self._one / base**-n
        assert value.func in (sympy.cos, sympy.sin)
        t = self._generator[cosine_letter(value)]
        return (1 - t**2 if value.func is sympy.cos else 2 * t) / (1 + t**2)

    def expression(self, element: Element) -> sympy.Expr:
        """The element as a sympy expression in the symbols, cosines and sines."""
        if not self._generator:
            return sympy.Rational(int(element.numerator), int(element.denominator))
        # Most coefficients of a long chain are the same few.
        found = self._told.get(element)
        if found is None:
            found = in_cosines(element.numer, element.denom, self.letters)
            self._told[element] = found
        return found

    def residue(self, element: Element, values: Mapping[sympy.Expr, int], prime: int) -> int:
        """The element modulo a prime, with residues for the letters (tan(a/2) for cos(a))."""
        if not self._generator:
            return int(element.numerator) * pow(int(element.denominator), -1, prime) % prime
        point = [values[letter] for letter in self.letters]
        top, bottom = (_residue(part, point, prime) for part in (element.numer, element.denom))
        return top * pow(bottom, -1, prime) % prime


def geometry_field(geometry: Geometry) -> ExactField:
    """The field that the table of a robot needs."""
    constants: list[sympy.Expr] = list(geometry.gravity)
    for row in geometry.rows:
        constants += [row.b, row.d]
        angles = [row.gamma, row.alpha]
        # The constant part of a free joint's variable only shifts it.
        if row.index is None or not row.joint.angular or geometry.tied:
            angles.append(row.theta)
        if row.index is None or row.joint.angular or geometry.tied:
            constants.append(row.r)
        for angle in angles:
            constants += cos_sin(angle)
    return ExactField(constants)


def _collect(value: sympy.Expr, letters: dict[sympy.Expr, str]) -> None:
    if value.is_Rational:
        return
    if value.is_Symbol:
        letters[value] = "symbol"
    elif value.is_Add or value.is_Mul or (value.is_Pow and value.exp.is_Integer):
        for arg in value.args:
            _collect(arg, letters)
    elif value.func in (sympy.cos, sympy.sin):
        letters[cosine_letter(value)] = "angle"
    else:
        letters[value] = "opaque"


def cosine_letter(value: sympy.Expr) -> sympy.Expr:
    """cos(a) of a cos(a) or sin(a): the key of an angle among the letters."""
    return sympy.cos(value.args[0], evaluate=False)


def _residue(part: Any, point: list[int], prime: int) -> int:
    total = 0
    for monomial, coefficient in part.terms():
        term = int(coefficient.numerator) * pow(int(coefficient.denominator), -1, prime)
        for value, exponent in zip(point, monomial, strict=True):
            if exponent:
                term = term * pow(value, exponent, prime) % prime
        total += term
    return total % prime
