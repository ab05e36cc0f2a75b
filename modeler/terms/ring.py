"""Polynomials in the sines and cosines of the joints: an algebra for the recursions, exact over Q.

Generators, in this order: for every free joint its motion (`s1`, `c1` of a revolute joint, `q4` of
a prismatic one), then what the geometry is made of: letters of lengths and of gravity, sine and
cosine of every general constant angle, square roots of numbers. Normal form: no square of a sine.
"""

from collections.abc import Mapping
from math import comb
from typing import Any, TypeAlias

import sympy
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from modeler.core.errors import DerivationError
from modeler.symbolic.geometry import Geometry, Row
from modeler.terms.motions import Motion, motions_of

Poly: TypeAlias = PolyElement
"""Sparse polynomial: {exponents: rational number}."""


class TrigRing:
    """Trigonometric polynomials of one geometry (`modeler.symbolic.algebra.Algebra`).

    Attributes:
        ring: all generators.
        motions: angles and travels, with their generators.
        moving: number of generators that depend on q; they stand first.
        static_ring: the others alone.
        squares: {place of a constant sine: place of its cosine}, in `ring`.
        roots: {place of a square root: the number under it}, in `ring`.
    """

    def __init__(self, geometry: Geometry) -> None:
        self.geometry = geometry
        self._found = motions_of(geometry)
        self.motions = self._found.each
        names = list(self._found.names)
        self.moving = len(names)
        atoms = _atoms(geometry)
        static = [str(atom) for atom in atoms]
        for name in static:
            if name in names:
                raise DerivationError(
                    f"robot {geometry.robot.name}: the symbol {name} reads like the sine, cosine "
                    f"or variable of a joint; rename it in [symbols] to print closed forms"
                )
        self.ring = PolyRing(names + static, QQ, lex)
        self.static_ring = PolyRing(static, QQ, lex)
        self._place = {atom: self.moving + i for i, atom in enumerate(atoms)}
        self.squares = {
            self._place[atom]: self._place[sympy.cos(atom.args[0])]
            for atom in atoms
            if isinstance(atom, sympy.sin)
        }
        self.roots = {
            place: QQ(int(atom.base.p), int(atom.base.q))
            for atom, place in self._place.items()
            if atom.is_Pow
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the generators, motion first."""
        return tuple(str(symbol) for symbol in self.ring.symbols)

    def static(self, value: sympy.Expr) -> Poly:
        """A geometric constant.

        Raises:
            DerivationError: not a polynomial of symbols, sines, cosines and roots of numbers.
        """
        return self.normal(_polynomial(sympy.expand_trig(value), self.ring, self._place))

    def variable(self, row: Row) -> Poly:
        """Rate * q + offset of a prismatic joint."""
        assert row.index is not None
        total = self.static(row.r)
        for k, coefficient in self.geometry.forms[row.index].items():
            factor = QQ(coefficient.numerator, coefficient.denominator) * row.rate
            total = total + self.ring.gens[self._found.travel(k)] * factor
        return total

    def cos_sin(self, row: Row) -> tuple[Poly, Poly]:
        """Cosine and sine of theta = rate * q + offset, by the addition theorem."""
        c, s = self.static(sympy.cos(row.theta)), self.static(sympy.sin(row.theta))
        if row.index is None or not row.joint.angular:
            return c, s
        for place, turns in self._found.turns[row.index].items():
            motion = self.motions[place]
            assert motion.sine is not None and motion.cosine is not None
            turn = self.ring.gens[motion.sine] * (row.rate if turns > 0 else -row.rate)
            for _ in range(abs(turns)):
                cosine = self.ring.gens[motion.cosine]
                c, s = c * cosine - s * turn, s * cosine + c * turn
        return self.normal(c), self.normal(s)

    def normal(self, poly: Poly) -> Poly:
        """The same function without squares of sines and of roots."""
        for motion in self.motions:
            if motion.sine is not None and motion.cosine is not None:
                poly = without_squares(poly, motion.sine, motion.cosine)
        for sine, cosine in self.squares.items():
            poly = without_squares(poly, sine, cosine)
        for place, number in self.roots.items():
            poly = _without_roots(poly, place, number)
        return poly

    def derivative(self, poly: Poly, index: int) -> Poly:
        """d poly / d u of the free variable `index`, in normal form."""
        total = self.ring.zero
        for motion in self.motions:
            rate = motion.form.get(index)
            if rate:
                slope = self._slope(poly, motion)
                total = total + (
                    slope if rate == 1 else slope * QQ(rate.numerator, rate.denominator)
                )
        return total

    def _slope(self, poly: Poly, motion: Motion) -> Poly:
        """The derivative by the angle or travel of one motion."""
        if motion.variable is not None:
            return poly.diff(self.ring.gens[motion.variable])
        s, c = motion.sine, motion.cosine
        assert s is not None and c is not None
        found: dict[tuple[int, ...], Any] = {}
        for exponents, value in poly.items():
            for down, up, sign in ((s, c, 1), (c, s, -1)):
                if exponents[down]:
                    at = list(exponents)
                    at[down] -= 1
                    at[up] += 1
                    key = tuple(at)
                    found[key] = found.get(key, 0) + sign * exponents[down] * value
        return without_squares(_clean(self.ring, found), s, c)

    def split(self, poly: Poly) -> dict[tuple[int, ...], Poly]:
        """{exponents of the motion generators: factor from the geometry}."""
        found: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
        for exponents, value in poly.items():
            found.setdefault(exponents[: self.moving], {})[exponents[self.moving :]] = value
        return {key: _clean(self.static_ring, part) for key, part in found.items()}

    def static_values(self, values: Mapping[str, float]) -> list[float]:
        """Numbers of the static generators."""
        used = {symbol for atom in self._place for symbol in atom.free_symbols} - {_PI}
        numbers = {symbol: values[symbol.name] for symbol in used} | {_PI: sympy.pi}
        return [float(atom.subs(numbers)) for atom in self._place]

    @property
    def static_atoms(self) -> tuple[sympy.Expr, ...]:
        """What the static generators stand for."""
        return tuple(self._place)


def without_squares(poly: Poly, square: int, other: int) -> Poly:
    """x**2 -> 1 - y**2 for the generators x, y of sine and cosine, or cosine and sine."""
    if all(exponents[square] < 2 for exponents in poly):
        return poly
    found: dict[tuple[int, ...], Any] = {}
    for exponents, value in poly.items():
        half, rest = divmod(exponents[square], 2)
        for k in range(half + 1):
            at = list(exponents)
            at[square] = rest
            at[other] += 2 * k
            key = tuple(at)
            found[key] = found.get(key, 0) + (-1) ** k * comb(half, k) * value
    return _clean(poly.ring, found)


def _without_roots(poly: Poly, place: int, number: Any) -> Poly:
    if all(exponents[place] < 2 for exponents in poly):
        return poly
    found: dict[tuple[int, ...], Any] = {}
    for exponents, value in poly.items():
        half, rest = divmod(exponents[place], 2)
        key = (*exponents[:place], rest, *exponents[place + 1 :])
        found[key] = found.get(key, 0) + value * number**half
    return _clean(poly.ring, found)


def _clean(ring: PolyRing, found: Mapping[tuple[int, ...], Any]) -> Poly:
    return ring.zero.new({key: QQ.convert(value) for key, value in found.items() if value})


def _atoms(geometry: Geometry) -> list[sympy.Expr]:
    """Generators of the geometry: letters in the order of the file, then angles, then roots."""
    values: list[sympy.Expr] = list(geometry.gravity)
    for row in geometry.rows:
        values += [row.b, row.d, row.r]
        for angle in (row.gamma, row.alpha, row.theta):
            values += [sympy.expand_trig(sympy.cos(angle)), sympy.expand_trig(sympy.sin(angle))]
    letters: set[sympy.Expr] = set()
    angles: dict[str, sympy.Expr] = {}
    roots: dict[str, sympy.Expr] = {}
    for value in values:
        _collect(sympy.expand_trig(value), letters, angles, roots)
    order = {name: i for i, name in enumerate(geometry.robot.symbols)}
    found = sorted(letters, key=lambda x: (order.get(x.name, len(order)), str(x)))
    for angle in angles.values():
        found += [sympy.cos(angle), sympy.sin(angle)]
    return found + list(roots.values())


def _collect(
    value: sympy.Expr, letters: set, angles: dict[str, sympy.Expr], roots: dict[str, sympy.Expr]
) -> None:
    if value.is_Symbol or value is sympy.pi:
        letters.add(value if value.is_Symbol else _PI)
    elif isinstance(value, sympy.cos | sympy.sin):
        angles.setdefault(str(value.args[0]), value.args[0])
    elif _is_root(value):
        roots.setdefault(str(value), sympy.sqrt(value.base))
    elif not value.is_Rational:
        for arg in value.args:
            _collect(arg, letters, angles, roots)


_PI = sympy.Symbol("pi", real=True)


def _is_root(value: sympy.Expr) -> bool:
    return bool(value.is_Pow and value.exp == sympy.Rational(1, 2) and value.base.is_Rational)


def _polynomial(value: sympy.Expr, ring: PolyRing, place: Mapping[sympy.Expr, int]) -> Poly:
    if value.is_Rational:
        return ring.ground_new(QQ(int(value.p), int(value.q)))
    if value is sympy.pi:
        value = _PI
    if value in place:
        return ring.gens[place[value]]
    if value.is_Add or value.is_Mul:
        parts = [_polynomial(arg, ring, place) for arg in value.args]
        total = parts[0]
        for part in parts[1:]:
            total = total + part if value.is_Add else total * part
        return total
    if value.is_Pow and value.exp.is_Integer and value.exp > 0:
        return _polynomial(value.base, ring, place) ** int(value.exp)
    raise DerivationError(
        f"got {value} in the table; closed forms need lengths and angles whose sines are "
        "polynomials of the symbols: declare a symbol for it"
    )
