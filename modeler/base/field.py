"""The exact field of the grouping: rational functions of the geometric symbols over Q.

cos and sin of a general angle a are (1 - t**2)/(1 + t**2) and 2t/(1 + t**2) with t = tan(a/2), so
that the field stays rational; results are turned back into cos(a) and sin(a). Any other irrational
constant (a square root, say) is a letter of its own.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import sympy
from sympy.polys.fields import field as rational_functions

from modeler.symbolic.geometry import Geometry

Element = Any
"""An element of the field: a sympy `FracElement`, or a rational number."""


class ExactField:
    """Q(letters): conversion from and to sympy expressions.

    Attributes:
        letters: what each generator stands for: a symbol, an angle, or an opaque constant.
    """

    def __init__(self, constants: Iterable[sympy.Expr]) -> None:
        letters: dict[sympy.Expr, str] = {}
        for constant in constants:
            _collect(sympy.sympify(constant), letters)
        self.letters = dict(sorted(letters.items(), key=lambda item: (item[1], str(item[0]))))
        names = [f"u{i}" for i in range(len(self.letters))]
        if names:
            self._field, *generators = rational_functions(names, sympy.QQ)
            self._one = self._field.one
        else:
            self._field, generators, self._one = None, [], sympy.QQ(1)
        self._generator = dict(zip(self.letters, generators, strict=True))
        self._found: dict[sympy.Expr, Element] = {}

    @property
    def one(self) -> Element:
        """1."""
        return self._one

    @property
    def zero(self) -> Element:
        """0."""
        return self._one - self._one

    def element(self, value: sympy.Expr) -> Element:
        """The field element of a constant expression."""
        found = self._found.get(value)
        if found is None:
            found = self._convert(value)
            self._found[value] = found
        return found

    def _convert(self, value: sympy.Expr) -> Element:
        if value.is_Rational:
            return self._one * sympy.QQ(int(value.p), int(value.q))
        if value in self._generator and self.letters[value] != "angle":
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
        t = self._generator[value.args[0]]
        if value.func is sympy.cos:
            return (1 - t**2) / (1 + t**2)
        assert value.func is sympy.sin
        return 2 * t / (1 + t**2)

    def expression(self, element: Element) -> sympy.Expr:
        """The element as a sympy expression in the symbols, cosines and sines."""
        if not self._generator:
            return sympy.Rational(int(element.numerator), int(element.denominator))
        numerator, denominator = (
            self._polynomial(part) for part in (element.numer, element.denom)
        )
        result = numerator / denominator
        for letter, kind in self.letters.items():
            if kind == "angle":
                result = _as_cosines(result, sympy.Dummy(), letter, self._t(letter))
        return _readable(result)

    def _t(self, angle: sympy.Expr) -> sympy.Symbol:
        return sympy.Symbol(f"t_{list(self.letters).index(angle)}", real=True)

    def _polynomial(self, part: Any) -> sympy.Expr:
        stands = [
            self._t(letter) if kind == "angle" else letter for letter, kind in self.letters.items()
        ]
        terms = []
        for monomial, coefficient in part.terms():
            term = sympy.Rational(int(coefficient.numerator), int(coefficient.denominator))
            for letter, exponent in zip(stands, monomial, strict=True):
                term = term * letter**exponent
            terms.append(term)
        return sympy.Add(*terms)

    def residue(self, element: Element, values: Mapping[sympy.Expr, int], prime: int) -> int:
        """The element modulo a prime, with residues for the letters (tan(a/2) for an angle a)."""
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
        if row.index is None or not row.joint.angular:
            angles.append(row.theta)
        if row.index is None or row.joint.angular:
            constants.append(row.r)
        for angle in angles:
            constants += [sympy.cos(angle), sympy.sin(angle)]
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
        letters[value.args[0]] = "angle"
    else:
        letters[value] = "opaque"


def _residue(part: Any, point: list[int], prime: int) -> int:
    total = 0
    for monomial, coefficient in part.terms():
        term = int(coefficient.numerator) * pow(int(coefficient.denominator), -1, prime)
        for value, exponent in zip(point, monomial, strict=True):
            term = term * pow(value, exponent, prime) % prime
        total += term
    return total % prime


def _as_cosines(
    value: sympy.Expr, mark: sympy.Dummy, angle: sympy.Expr, t: sympy.Symbol
) -> sympy.Expr:
    """A rational function of t = tan(angle/2) as one of cos(angle) and sin(angle)."""
    if not value.has(t):
        return value
    c, s = sympy.cos(angle), sympy.sin(angle)
    top, bottom = sympy.fraction(sympy.together(value))
    top, bottom = sympy.Poly(top, t), sympy.Poly(bottom, t)
    # Divide both by (1 + t**2)**K: t**i / (1 + t**2)**K is then a polynomial in cos and sin.
    K = (max(top.degree(), bottom.degree()) + 1) // 2
    return _cosine_form(top, K, c, s) / _cosine_form(bottom, K, c, s)


def _cosine_form(poly: sympy.Poly, K: int, c: sympy.Expr, s: sympy.Expr) -> sympy.Expr:
    # In pairs: t**2/(1+t**2) = (1-c)/2, 1/(1+t**2) = (1+c)/2, t/(1+t**2) = s/2.
    C, S = sympy.Dummy("c"), sympy.Dummy("s")
    total = sympy.Integer(0)
    for (i,), coefficient in poly.terms():
        pairs, single = divmod(i, 2)
        factor = ((1 - C) / 2) ** pairs * ((1 + C) / 2) ** (K - pairs - single)
        total += coefficient * factor * (S / 2 if single else 1)
    reduced = sympy.rem(sympy.expand(total), S**2 + C**2 - 1, S)
    return sympy.factor(reduced).subs({C: c, S: s})


def _readable(value: sympy.Expr) -> sympy.Expr:
    """Monomials as they are; sums factored, with sin**2 written for 1 - cos**2."""
    value = sympy.cancel(value) if value.has(sympy.cos, sympy.sin) else sympy.factor(value)
    if value.has(sympy.cos):
        value = sympy.factor(sympy.fu(sympy.factor(value)))
    return value
