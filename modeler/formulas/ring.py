"""Polynomials in the sines and cosines of the joints: an algebra for the recursions, exact over Q.

Generators, in this order: for every free joint its motion (`s1`, `c1` of a revolute joint, `q4` of
a prismatic one), then what the geometry is made of: letters of lengths and of gravity, sine and
cosine of every general constant angle, square roots of numbers. Normal form: no square of a sine.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from typing import Any, TypeAlias

import numpy as np
import sympy
from sympy.polys.domains import QQ
from sympy.polys.matrices import DomainMatrix
from sympy.polys.orderings import lex
from sympy.polys.polyerrors import ExactQuotientFailed
from sympy.polys.rings import PolyElement, PolyRing

from modeler.core.errors import DerivationError
from modeler.core.expression import Expression, format_decimal
from modeler.core.formula import format_latex_name
from modeler.derivation import (
    Geometry,
    GeometryRow,
    LinearRelations,
    SparseVector,
    convert_to_fraction,
    enumerate_places,
    find_linear_relations,
    format_coefficient,
    reduce_to_echelon,
    replace_square,
)
from modeler.formulas.thresholds import THRESHOLDS
from modeler.robot import Robot

# Which sines, cosines and travels the configuration of a robot is written in.
#
# The free variables u of the table, or of a robot whose joints follow others by linear relations,
# move every row: q_row = sum of coefficient * u[k] + constant. A *motion* is one angle, or one
# travel, of which functions are polynomials. The angle of a free joint is its own motion; a row
# that follows others is a sum of whole multiples of such angles, and the addition theorem says
# the rest.


@dataclass(frozen=True)
class RingMotion:
    """One angle with the places of its sine and cosine, or one travel with its place.

    Attributes:
        joint: whose variable it is, or the row that turns by it: the letter after s, c, q.
        sine: place of its sine among the generators; None for a travel.
        cosine: likewise.
        variable: place of the travel; None for an angle.
        form: {k: coefficient}: the angle or travel as a sum of coefficient * u[k].
    """

    joint: str
    sine: int | None
    cosine: int | None
    variable: int | None
    form: Mapping[int, Fraction]


@dataclass(frozen=True)
class Motions:
    """The motions of a geometry, and every row in them.

    Attributes:
        names: of the generators.
        each: the motions.
        turns: {index of a row that turns: {place of a motion: whole multiple}}.
    """

    names: tuple[str, ...]
    each: tuple[RingMotion, ...]
    turns: Mapping[int, Mapping[int, int]]

    def find_travel(self, k: int) -> int:
        """Returns place of the generator of the free variable u[k]."""
        wanted = {k: Fraction(1)}
        return next(m.variable for m in self.each if m.variable is not None and m.form == wanted)


def find_motions(geometry: Geometry) -> Motions:
    """Returns the motions of all rows, in table order."""
    parts = _find_divisors(geometry)
    names: list[str] = []
    each: list[RingMotion] = []
    turns: dict[int, Mapping[int, int]] = {}
    for row in sorted(geometry.rows, key=lambda row: not _is_free(row, geometry)):
        if row.index is None:
            continue
        form = geometry.forms[row.index]
        if not row.joint.is_revolute:
            _add_travels(form, geometry, names, each)
            continue
        multiples = _express_in_motions(form, each)
        if multiples is None:
            divided = {k: c / parts.get(k, 1) if len(form) == 1 else c for k, c in form.items()}
            free = _is_free(row, geometry)
            whose = row.joint.name
            if free and parts.get(min(form), 1) > 1:
                whose, form = f"{whose}_{parts[min(form)]}", divided
            each.append(RingMotion(whose, len(names), len(names) + 1, None, form))
            names += [f"s{whose}", f"c{whose}"]
            multiples = _express_in_motions(geometry.forms[row.index], each)
            assert multiples is not None, "an angle is a multiple of itself"
        turns[row.index] = multiples
    return Motions(tuple(names), tuple(each), turns)


def _is_free(row: GeometryRow, geometry: Geometry) -> bool:
    return row.joint.name not in geometry.robot.relations


def _add_travels(
    form: Mapping[int, Fraction], geometry: Geometry, names: list[str], each: list[RingMotion]
) -> None:
    """The free variables themselves, for rows that travel by them."""
    known = [motion.form for motion in each if motion.variable is not None]
    for k in form:
        if {k: Fraction(1)} not in known:
            joint = geometry.robot.free_joints[k].name
            each.append(RingMotion(joint, None, None, len(names), {k: Fraction(1)}))
            names.append(f"q{joint}")


def _find_divisors(geometry: Geometry) -> dict[int, int]:
    """{k: n}: rows turn by whole multiples of u[k] / n."""
    divisors: dict[int, int] = {}
    for row in geometry.rows:
        if row.index is not None and row.joint.is_revolute:
            for k, coefficient in geometry.forms[row.index].items():
                if coefficient.denominator <= THRESHOLDS.max_angle_parts:
                    divisors[k] = lcm(divisors.get(k, 1), coefficient.denominator)
    return divisors


def _express_in_motions(
    form: Mapping[int, Fraction], each: list[RingMotion]
) -> dict[int, int] | None:
    """The angle as whole multiples of known motions; None if it is none, or too many."""
    for place, motion in enumerate(each):
        if motion.sine is not None and motion.form == form:
            return {place: 1}
    multiples: dict[int, int] = {}
    for k, coefficient in form.items():
        single = [i for i, m in enumerate(each) if m.sine is not None and set(m.form) == {k}]
        ratios = {i: coefficient / each[i].form[k] for i in single}
        place = next((i for i, x in ratios.items() if x.denominator == 1), -1)
        if place < 0:
            return None
        multiples[place] = int(ratios[place])
    return multiples if sum(map(abs, multiples.values())) <= THRESHOLDS.max_angle_terms else None


Poly: TypeAlias = PolyElement
"""Sparse polynomial: {exponents: rational number}."""


class TrigRing:
    """Trigonometric polynomials of one geometry (`modeler.derivation.graph.Algebra`).

    Attributes:
        ring: all generators.
        motions: angles and travels, with their generators.
        moving: number of generators that depend on q; they stand first.
        static_ring: the others alone.
        squares: {place of a sine or of a square root: what its square is}, in `ring`.
    """

    def __init__(self, geometry: Geometry) -> None:
        self.geometry = geometry
        self._row_motions = find_motions(geometry)
        self.motions = self._row_motions.each
        names = list(self._row_motions.names)
        self.moving = len(names)
        atoms = _collect_atoms(geometry)
        static = [format_coefficient(atom, geometry.robot.has_binary_fractions) for atom in atoms]
        for name in static:
            if name in names:
                raise DerivationError(
                    f"robot {geometry.robot.name}: the symbol {name} reads like the sine, cosine "
                    f"or variable of a joint; rename it in [symbols] to print closed forms"
                )
        self.ring = PolyRing(names + static, QQ, lex)
        self.static_ring = PolyRing(static, QQ, lex)
        self._place = {atom: self.moving + i for i, atom in enumerate(atoms)}
        turning = {m.sine: m.cosine for m in self.motions if m.sine is not None}
        for atom in atoms:
            if isinstance(atom, sympy.sin):
                turning[self._place[atom]] = self._place[sympy.cos(atom.args[0])]
        self.squares = {s: 1 - self.ring.gens[c] ** 2 for s, c in turning.items()}
        for atom, place in self._place.items():
            if atom.is_Pow:
                self.squares[place] = self.ring(QQ(int(atom.base.p), int(atom.base.q)))

    @property
    def names(self) -> tuple[str, ...]:
        """Returns names of the generators, motion first."""
        return tuple(str(symbol) for symbol in self.ring.symbols)

    def static(self, value: sympy.Expr) -> Poly:
        """Returns a geometric constant.

        Raises:
            DerivationError: not a polynomial of symbols, sines, cosines and roots of numbers.
        """
        expanded = _convert_polynomial(sympy.expand_trig(value), self.ring, self._place)
        return self.normalise_polynomial(expanded)

    def variable(self, row: GeometryRow) -> Poly:
        """Returns rate * q + offset of a prismatic joint."""
        assert row.index is not None
        total = self.static(row.r)
        for k, coefficient in self.geometry.forms[row.index].items():
            factor = QQ(coefficient.numerator, coefficient.denominator) * row.rate
            total = total + self.ring.gens[self._row_motions.find_travel(k)] * factor
        return total

    def cos_sin(self, row: GeometryRow) -> tuple[Poly, Poly]:
        """Returns cosine and sine of theta = rate * q + offset, by the addition theorem."""
        c, s = self.static(sympy.cos(row.theta)), self.static(sympy.sin(row.theta))
        if row.index is None or not row.joint.is_revolute:
            return c, s
        for place, turns in self._row_motions.turns[row.index].items():
            motion = self.motions[place]
            assert motion.sine is not None and motion.cosine is not None
            turn = self.ring.gens[motion.sine] * (row.rate if turns > 0 else -row.rate)
            for _ in range(abs(turns)):
                cosine = self.ring.gens[motion.cosine]
                c, s = c * cosine - s * turn, s * cosine + c * turn
        return self.normalise_polynomial(c), self.normalise_polynomial(s)

    def normalise_polynomial(self, poly: Poly) -> Poly:
        """Returns the same function without squares of sines and of roots."""
        for place, square in self.squares.items():
            poly = replace_square(poly, place, square)
        return poly

    def differentiate_polynomial(self, poly: Poly, index: int) -> Poly:
        """Returns d poly / d u of the free variable `index`, in normal form."""
        total = self.ring.zero
        for motion in self.motions:
            rate = motion.form.get(index)
            if rate:
                slope = self._differentiate_motion(poly, motion)
                total += slope if rate == 1 else slope * QQ(rate.numerator, rate.denominator)
        return total

    def _differentiate_motion(self, poly: Poly, motion: RingMotion) -> Poly:
        """The derivative by the angle or travel of one motion."""
        if motion.variable is not None:
            return poly.diff(self.ring.gens[motion.variable])
        s, c = motion.sine, motion.cosine
        assert s is not None and c is not None
        slope_terms: dict[tuple[int, ...], Any] = {}
        for exponents, value in poly.items():
            for down, up, sign in ((s, c, 1), (c, s, -1)):
                if exponents[down]:
                    at = list(exponents)
                    at[down] -= 1
                    at[up] += 1
                    key = tuple(at)
                    slope_terms[key] = slope_terms.get(key, 0) + sign * exponents[down] * value
        return replace_square(_drop_zeros(self.ring, slope_terms), s, self.squares[s])

    def separate_motion(self, poly: Poly) -> dict[tuple[int, ...], Poly]:
        """Returns {exponents of the motion generators: factor from the geometry}."""
        factors: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
        for exponents, value in poly.items():
            factors.setdefault(exponents[: self.moving], {})[exponents[self.moving :]] = value
        return {key: _drop_zeros(self.static_ring, part) for key, part in factors.items()}

    def evaluate_static(self, values: Mapping[str, float]) -> list[float]:
        """Returns numbers of the static generators."""
        used = {symbol for atom in self._place for symbol in atom.free_symbols} - {_PI}
        numbers = {symbol: values[symbol.name] for symbol in used} | {_PI: sympy.pi}
        return [float(atom.subs(numbers)) for atom in self._place]

    @property
    def static_atoms(self) -> tuple[sympy.Expr, ...]:
        """Returns what the static generators stand for."""
        return tuple(self._place)


def get_generators(ring: PolyRing) -> dict[str, Poly]:
    """Returns the generators by name."""
    return {str(symbol): x for symbol, x in zip(ring.symbols, ring.gens, strict=True)}


def find_places(*polys: Poly) -> set[int]:
    """Returns places of the generators that occur."""
    return {i for poly in polys for at in poly for i, exponent in enumerate(at) if exponent}


def _drop_zeros(ring: PolyRing, terms: Mapping[tuple[int, ...], Any]) -> Poly:
    return ring.zero.new({key: QQ.convert(value) for key, value in terms.items() if value})


def _collect_atoms(geometry: Geometry) -> list[sympy.Expr]:
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
        _collect_parts(sympy.expand_trig(value), letters, angles, roots)
    order = {name: i for i, name in enumerate(geometry.robot.symbols)}
    atoms = sorted(letters, key=lambda x: (order.get(x.name, len(order)), str(x)))
    for angle in angles.values():
        atoms += [sympy.cos(angle), sympy.sin(angle)]
    return atoms + list(roots.values())


def _collect_parts(
    value: sympy.Expr, letters: set, angles: dict[str, sympy.Expr], roots: dict[str, sympy.Expr]
) -> None:
    if value.is_Symbol or value is sympy.pi:
        letters.add(value if value.is_Symbol else _PI)
    elif isinstance(value, sympy.cos | sympy.sin):
        angles.setdefault(str(value.args[0]), value.args[0])
    elif value.is_Pow and value.exp == sympy.Rational(1, 2) and value.base.is_Rational:
        roots.setdefault(str(value), sympy.sqrt(value.base))
    elif not value.is_Rational:
        for arg in value.args:
            _collect_parts(arg, letters, angles, roots)


_PI = sympy.Symbol("pi", real=True)


def _convert_polynomial(value: sympy.Expr, ring: PolyRing, place: Mapping[sympy.Expr, int]) -> Poly:
    if value.is_Rational:
        return ring.ground_new(QQ(int(value.p), int(value.q)))
    if value is sympy.pi:
        value = _PI
    if value in place:
        return ring.gens[place[value]]
    if value.is_Add or value.is_Mul:
        parts = [_convert_polynomial(arg, ring, place) for arg in value.args]
        total = parts[0]
        for part in parts[1:]:
            total = total + part if value.is_Add else total * part
        return total
    if value.is_Pow and value.exp.is_Integer and value.exp > 0:
        return _convert_polynomial(value.base, ring, place) ** int(value.exp)
    raise DerivationError(
        f"got {value} in the table; closed forms need lengths and angles whose sines are "
        "polynomials of the symbols: declare a symbol for it"
    )


# Linear relations between functions, exactly: rank, independent set, map to base parameters.


def find_combination(
    vectors: Mapping[str, SparseVector], vector: SparseVector
) -> Mapping[str, Fraction] | None:
    """Returns `vector` as a combination of `vectors`, None if it is outside their span."""
    relations = find_linear_relations({**vectors, "": vector})
    return None if "" in relations.independent else relations.combinations[""]


def find_independent_modulo(vectors: Sequence[SparseVector], prime: int) -> list[int]:
    """Returns the places of independent vectors of residues, first come first kept."""
    places = enumerate_places(vectors)
    matrix = np.zeros((len(places), len(vectors)), dtype=np.int64)
    for k, vector in enumerate(vectors):
        for place, value in vector.items():
            matrix[places[place], k] = value
    return [k for _, k in reduce_to_echelon(matrix, range(len(vectors)), prime)]


def partition_by_ratio(relations: LinearRelations) -> list[list[str]]:
    """Returns keys that are the same up to a constant factor."""
    groups: dict[tuple[tuple[str, Fraction], ...], list[str]] = {}
    for key, combination in relations.combinations.items():
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


def build_base_map(
    rows: Sequence[str], forms: Sequence[Mapping[int, Poly]], names: Sequence[str], ring: Any
) -> BaseMap:
    """Builds the map from base parameters to coefficients.

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
    if len(used) == len(rows) and rows and size <= THRESHOLDS.max_determinant_monomials:
        determinant = ring(_build_domain_matrix(entries, len(used), ring).det())
    return BaseMap(tuple(rows), tuple(names[k] for k in used), entries, determinant)


def invert_base_map(base_map: BaseMap, ring: Any) -> Mapping[str, Mapping[str, Any]] | None:
    """Returns {base parameter: {coefficient: factor, a rational function of the geometry}}.

    None if the map is not square or not invertible.
    """
    if not base_map.determinant:
        return None
    matrix = _build_domain_matrix(base_map.entries, len(base_map.rows), ring)
    inverse = matrix.to_field().inv().to_dod()
    rows = ((n, sorted(inverse.get(r, {}).items())) for r, n in enumerate(base_map.columns))
    return {name: {base_map.rows[c]: value for c, value in row} for name, row in rows}


def _build_domain_matrix(
    entries: Mapping[tuple[int, int], Poly], size: int, ring: Any
) -> DomainMatrix:
    rows: dict[int, dict[int, Poly]] = {}
    for (r, c), factor in entries.items():
        rows.setdefault(r, {})[c] = factor
    return DomainMatrix(rows, (size, size), ring.to_domain())


def convert_to_polynomial(
    expression: Expression, values: Mapping[str, Any], ring: PolyRing
) -> Poly | None:
    """Returns the expression as a polynomial, `values` for its names; None if it is none."""
    try:
        return ring(expression.fold(values, {}, None, lambda x: QQ(x.numerator, x.denominator)))
    except (KeyError, TypeError, ValueError, ZeroDivisionError, ExactQuotientFailed):
        return None


def evaluate_monomial(exponents: Sequence[int], values: Sequence[Any]) -> Any:
    """Returns the monomial's value."""
    product: Any = 1
    for exponent, value in zip(exponents, values, strict=True):
        if exponent:
            product = product * value**exponent
    return product


def evaluate_polynomial(poly: Poly, values: Sequence[Any]) -> Any:
    """Returns the polynomial's value."""
    total: Any = 0
    for exponents, coefficient in poly.items():
        total = total + evaluate_monomial(exponents, values) * convert_to_fraction(coefficient)
    return total


# Monomials, polynomials and linear forms as text and LaTeX.


@dataclass(frozen=True)
class TextStyle:
    """How signs of operation look.

    Attributes:
        times: between factors.
        latex: True to write names and powers as LaTeX.
        halves: True to write 1/2 as 0.5: so the robot file writes its numbers.
    """

    times: str
    latex: bool
    halves: bool = False

    def format_name(self, name: str) -> str:
        """Returns the text of one letter."""
        return format_latex_symbol(name) if self.latex else name

    def format_power(self, name: str, exponent: int) -> str:
        """Returns the text of name ** exponent."""
        base = self.format_name(name)
        if exponent == 1:
            return base
        if not self.latex:
            return f"{base}**{exponent}"
        function = re.fullmatch(r"\\(cos|sin)\{\((.*)\)\}", base)
        if function:
            return f"\\{function[1]}^{{{exponent}}}{{({function[2]})}}"
        return f"{base}^{{{exponent}}}"

    def add_brackets(self, text: str) -> str:
        """Returns a sum as a factor."""
        return rf"\left({text}\right)" if self.latex else f"({text})"

    def adjust_to_robot(self, robot: Robot) -> "TextStyle":
        """Returns the style for numbers of that robot."""
        return replace(self, halves=robot.has_binary_fractions)

    def format_decimal(self, value: Fraction) -> str | None:
        """Returns the digits of a number that is written as a decimal."""
        return format_decimal(value, self.halves)

    def format_fraction(self, value: Fraction) -> str:
        """Returns the text of a positive number."""
        if digits := self.format_decimal(value):
            return digits
        if self.latex and value.denominator != 1:
            return f"\\tfrac{{{value.numerator}}}{{{value.denominator}}}"
        return str(value)


TEXT = TextStyle("*", False)
LATEX = TextStyle(r"\,", True)


def format_latex_symbol(name: str) -> str:
    """Returns LaTeX of a letter; sines, cosines and roots as functions."""
    function = re.fullmatch(r"(cos|sin|sqrt)\((.*)\)", name)
    if function:
        return f"\\{function[1]}{{({format_latex_symbol(function[2])})}}"
    angle = re.fullmatch(r"(\d[\d.]*)?\*?(pi)?(/\d+)?", name)
    if angle:
        return (angle[1] or "") + (r"\pi" if angle[2] else "") + (angle[3] or "")
    return format_latex_name(name)


def format_monomial(exponents: Sequence[int], names: Sequence[str], style: TextStyle = TEXT) -> str:
    """Returns the monomial, as "c2*s1**2"; cosines before sines, "1" for the empty product."""
    factors = [(name, e) for name, e in zip(names, exponents, strict=True) if e]
    return style.times.join(style.format_power(name, e) for name, e in sorted(factors)) or "1"


def format_polynomial(poly: Poly, names: Sequence[str], style: TextStyle = TEXT) -> str:
    """Returns a polynomial, highest monomial first; "0" if it has none."""
    terms = ((convert_to_fraction(x), _format_plain(at, names, style)) for at, x in poly.terms())
    return format_signed_sum(terms, style)


def format_linear_form(
    form: Mapping[int, Poly],
    parameters: Sequence[str],
    names: Sequence[str],
    style: TextStyle = TEXT,
) -> str:
    """Returns a linear form of parameters, e.g. "2*XZ3 - 2*bl1*MX3"."""
    terms: list[tuple[Fraction, str]] = []
    for column, factor in form.items():
        letter = style.format_name(parameters[column])
        if len(factor) == 1:
            ((at, value),) = factor.items()
            plain = _format_plain(at, names, style)
            text = f"{plain}{style.times}{letter}" if plain else letter
            terms.append((convert_to_fraction(value), text))
        else:
            inside = format_polynomial(factor, names, style)
            terms.append((Fraction(1), f"({inside}){style.times}{letter}"))
    return format_signed_sum(terms, style)


def format_physical(
    poly: Poly, names: Sequence[str], masses: Iterable[str], style: TextStyle = TEXT
) -> str:
    """Returns a polynomial of physical parameters with each mass in front of its own bracket."""
    wanted = [i for i, name in enumerate(names) if name in set(masses)]
    loose: dict[tuple[int, ...], Any] = {}
    brackets: dict[int, dict[tuple[int, ...], Any]] = {}
    for at, value in poly.terms():
        mass = next((i for i in wanted if at[i] == 1), None)
        if mass is None:
            loose[at] = value
        else:
            rest = (*at[:mass], 0, *at[mass + 1 :])
            brackets.setdefault(mass, {})[rest] = value
    terms = [(convert_to_fraction(v), _format_plain(at, names, style)) for at, v in loose.items()]
    for mass, inside in sorted(brackets.items()):
        letter = style.format_name(names[mass])
        if len(inside) == 1:
            ((at, value),) = inside.items()
            plain = _format_plain(at, names, style)
            text = f"{letter}{style.times}{plain}" if plain else letter
            terms.append((convert_to_fraction(value), text))
        else:
            values = [convert_to_fraction(value) for value in inside.values()]
            smallest = min(abs(value) for value in values)
            shared = all((value / smallest).denominator == 1 for value in values)
            content = smallest if shared else Fraction(1)
            content = content if any(value > 0 for value in values) else -content
            numbers = zip(inside, (value / content for value in values), strict=True)
            parts = [(value, _format_plain(at, names, style)) for at, value in numbers]
            terms.append((content, f"{letter}{style.times}({format_signed_sum(parts, style)})"))
    return format_signed_sum(terms, style)


def format_combination(combination: Mapping[str, Fraction], style: TextStyle = TEXT) -> str:
    """Returns a combination of named coefficients: "2*PJ1 + 2*PJ3", "-PJ5/2"."""
    terms = ((value, style.format_name(name)) for name, value in combination.items())
    return format_signed_sum(terms, style)


def format_signed_sum(terms: Iterable[tuple[Fraction, str]], style: TextStyle = TEXT) -> str:
    """Returns the sum of number * text with the signs pulled out; an empty text is 1."""
    out = ""
    for value, text in terms:
        size = abs(value)
        if not text:
            piece = style.format_fraction(size)
        elif size == 1:
            piece = text
        elif size.denominator == 1 or style.latex or style.format_decimal(size):
            piece = f"{style.format_fraction(size)}{style.times}{text}"
        elif size.numerator == 1:
            piece = f"{text}/{size.denominator}"
        else:
            piece = f"{size.numerator}{style.times}{text}/{size.denominator}"
        if out:
            out += f" - {piece}" if value < 0 else f" + {piece}"
        else:
            out = f"-{piece}" if value < 0 else piece
    return out or "0"


def _format_plain(at: Sequence[int], names: Sequence[str], style: TextStyle) -> str:
    """The monomial in the order of its generators; empty for 1."""
    factors = ((name, e) for name, e in zip(names, at, strict=True) if e)
    return style.times.join(style.format_power(name, e) for name, e in factors)
