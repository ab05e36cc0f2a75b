"""What a fit fixes of physical parameters: base parameters, or coefficients, as polynomials."""

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import count
from math import prod
from typing import Any

import numpy as np
import sympy
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from modeler.core.errors import DerivationError, RobotError
from modeler.core.json import ShortRepr
from modeler.derivation import (
    BaseParameters,
    SymbolicModel,
    convert_to_fraction,
    evaluate_modulo,
    reduce_to_echelon,
)
from modeler.formulas.coefficients import (
    CoefficientTable,
    build_coefficient_table,
    format_forward_map,
)
from modeler.formulas.physical import (
    PhysicalParameters,
    derive_physical_parameters,
    draw_random_point,
)
from modeler.formulas.ring import (
    Poly,
    TrigRing,
    evaluate_polynomial,
    find_independent_modulo,
    find_places,
    get_generators,
)
from modeler.formulas.thresholds import THRESHOLDS


@dataclass(frozen=True)
class PhysicalSystem(ShortRepr):
    """data = polynomials of the physical parameters.

    Attributes:
        robot: name.
        source: "base" (data are base parameters, every length is known) or "coefficients" (data
            are PG and PJ; lengths that no fit needs are parameters like the others).
        ring: data, letters, then what is known of the geometry.
        data: names of the identified quantities.
        letters: physical parameters that the data depend on.
        kinds: {letter: "mass", "centre", "inertia", "rotor inertia" or "length"}.
        masses: letters that are the mass of a link.
        moments: letters that are a moment of inertia, of a link or a rotor.
        vanishing: physical parameters without effect on any torque.
        alone: those that are identified by themselves, as rotor inertias that group with nothing.
        constants: {generator of the geometry: value in the robot file}.
        abbreviations: {generator: what it stands for}, "1/D41", for quotients of lengths.
        inverse: {generator: the polynomial that it is the inverse of}.
        definitions: {data: polynomial of letters and constants}.
        base: names of the base parameters that the data follow from.
        map_lines: "PG1 = MY2R": coefficients in base parameters, as text, lengths as in the fit.
        to_data: (data, base), data = to_data @ base parameters, at the lengths of the robot file.
    """

    robot: str
    source: str
    ring: PolyRing
    data: tuple[str, ...]
    letters: tuple[str, ...]
    kinds: Mapping[str, str]
    masses: tuple[str, ...]
    moments: tuple[str, ...]
    vanishing: tuple[str, ...]
    alone: tuple[str, ...]
    constants: Mapping[str, float]
    abbreviations: Mapping[str, str]
    inverse: Mapping[str, Poly]
    definitions: Mapping[str, Poly]
    base: tuple[str, ...]
    map_lines: tuple[str, ...]
    to_data: np.ndarray

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Returns names of the generators."""
        return tuple(str(symbol) for symbol in self.ring.symbols)

    @cached_property
    def place(self) -> Mapping[str, int]:
        """Returns {generator: its place}."""
        return {name: i for i, name in enumerate(self.names)}

    @cached_property
    def slopes(self) -> Mapping[str, tuple[Poly, ...]]:
        """Returns {letter: d data / d letter}."""
        gens = self.ring.gens
        slopes = {}
        for letter in self.letters:
            generator = gens[self.place[letter]]
            slopes[letter] = tuple(self.definitions[d].diff(generator) for d in self.data)
        return slopes

    def build_point(self, values: Mapping[str, float]) -> np.ndarray:
        """Returns (generators,) the constants and these values, 0 for all others."""
        point = np.zeros(len(self.names))
        for name, value in (*self.constants.items(), *values.items()):
            if name in self.place:
                point[self.place[name]] = value
        return point

    def derive_consistent_values(self, values: Mapping[str, Any]) -> list[Any]:
        """Returns values of all generators: data follow from those of letters and constants."""
        plain = [values.get(name, 0) for name in self.names]
        for name, below in self.inverse.items():
            plain[self.place[name]] = 1 / evaluate_polynomial(below, plain)
        data_values = {d: evaluate_polynomial(self.definitions[d], plain) for d in self.data}
        return [data_values.get(name, value) for name, value in zip(self.names, plain, strict=True)]

    def draw_modular_point(self, chance: random.Random) -> tuple[int, list[int]]:
        """Returns (prime, random values modulo it), data as they follow from the letters."""
        prime, point = draw_random_point(self.names, chance)
        for name, below in self.inverse.items():
            point[self.place[name]] = pow(evaluate_modulo(below, point, prime), -1, prime)
        for name in self.data:
            point[self.place[name]] = evaluate_modulo(self.definitions[name], point, prime)
        return prime, point

    def normalise_polynomial(self, poly: Poly) -> Poly:
        """Returns the same function without products of a length and its inverse."""
        gens = self.ring.gens
        ones = [gens[self.place[name]] * below - 1 for name, below in self.inverse.items()]
        return poly.rem(ones) if ones else poly

    def compute_jacobian_modulo(
        self, chance: random.Random
    ) -> tuple[int, dict[str, dict[int, int]]]:
        """Returns (prime, {letter: column of d data / d letter at a random point})."""
        prime, point = self.draw_modular_point(chance)
        return prime, {
            x: {i: evaluate_modulo(poly, point, prime) for i, poly in enumerate(slopes) if poly}
            for x, slopes in self.slopes.items()
        }

    def compute_rank(self, letters: Sequence[str], seed: int = 2000, points: int = 2) -> int:
        """Returns the generic rank of d data / d letters, the highest of some random points."""
        chance, ranks = random.Random(seed), [0]
        for _ in range(points):
            prime, columns = self.compute_jacobian_modulo(chance)
            ranks.append(len(find_independent_modulo([columns[x] for x in letters], prime)))
        return max(ranks)


def build_physical_system(
    model: SymbolicModel, base: BaseParameters, source: str | None = None
) -> PhysicalSystem:
    """Returns the identified quantities of a robot as polynomials of its physical parameters.

    chi = (m, m c, J_c + m (c.c 1 - c c')) per link; beta = grouped chi; PG, PJ = map * beta.

    Args:
        model: of any robot; coefficients need one without loops and relations.
        base: its base parameters; those of friction and offsets are left out.
        source: "base" or "coefficients"; None: coefficients where a fit leaves a length free
            (robots of up to 3 joints are looked at), base parameters otherwise.

    Raises:
        DerivationError, RobotError: no closed form, where coefficients are wanted; `[physical]` is
            wrong, or has a letter of the name of a base parameter.
    """
    tied = bool(model.robot.relations or model.robot.loops)
    if source == "coefficients" and tied:
        raise RobotError(
            f"{model.robot.name}: coefficients are written for serial and tree robots; leave out "
            "--from, or write --from base"
        )
    many = len(model.robot.coordinates) > THRESHOLDS.closed_form_joints
    if source == "base" or tied or (source is None and many):
        return _build_from_base(model, base)
    try:
        table = build_coefficient_table(model, base)
    except DerivationError:
        if source is not None:
            raise
        return _build_from_base(model, base)
    free = find_free_lengths(table)
    if source is None and not free:
        return _build_from_base(model, base)
    return _build_from_coefficients(model, table, free)


def find_free_lengths(table: CoefficientTable) -> tuple[str, ...]:
    """Returns lengths whose values a fit does not need.

    The coefficients are A(length) beta; A reduced to its independent rows must not depend on the
    length. A length that is an angle counts as known.
    """
    ring = table.closed.algebra.static_ring
    names = [str(symbol) for symbol in ring.symbols]
    if not table.map.determinant:
        return ()
    letters = [x for x in table.physical.letters if table.physical.kinds[x] == "length"]
    chance = random.Random(2000)
    prime, point = draw_random_point(names, chance)
    before = _reduce_coefficients(table, point, prime)
    free = []
    for letter in letters:
        if letter in names and letter in table.identifiability.appearing:
            other = list(point)
            other[names.index(letter)] = chance.randrange(1, prime)
            if _reduce_coefficients(table, other, prime) == before:
                free.append(letter)
    return tuple(free)


def _reduce_coefficients(
    table: CoefficientTable, point: Sequence[int], prime: int
) -> list[list[int]]:
    """A B^-1 modulo the prime: all coefficients by the independent ones."""
    used = sorted({k for c in table.coefficients for k in c.base})
    rows = {
        c.name: [evaluate_modulo(c.base[k], point, prime) if k in c.base else 0 for k in used]
        for c in table.coefficients
    }
    size = len(table.map.rows)
    # X B = A for X: the echelon form of [B' | A'] is [1 | X'].
    both = [*(rows[name] for name in table.map.rows), *rows.values()]
    matrix = np.array(both, dtype=np.int64).T
    if len(reduce_to_echelon(matrix, range(size), prime)) < size:
        raise DerivationError("the map to the base parameters is singular at a random point")
    factors: list[list[int]] = matrix[:, size:].T.tolist()
    return factors


def _build_from_coefficients(
    model: SymbolicModel, table: CoefficientTable, free: Sequence[str]
) -> PhysicalSystem:
    physical, algebra = table.physical, table.closed.algebra
    definitions = {name: table.by_name[name].physical for name in table.map.rows}
    static = algebra.evaluate_static(model.robot.evaluate_symbols())
    to_data = np.zeros((len(table.map.rows), len(table.map.columns)))
    for at, factor in table.map.entries.items():
        to_data[at] = float(evaluate_polynomial(factor, static))
    geometry = _KnownGeometry(algebra, physical, model.robot.evaluate_symbols())
    base = table.map.columns, tuple(format_forward_map(table))
    return _build_system(model.robot.name, geometry, definitions, free, base, to_data)


@dataclass
class _KnownGeometry:
    """What is known of the geometry, as generators; quotients of lengths get names of their own."""

    algebra: TrigRing
    physical: PhysicalParameters
    symbol_values: Mapping[str, float]
    quotients: dict[str, str] = field(default_factory=dict)
    below: dict[str, Poly] = field(default_factory=dict)
    values: dict[str, float] = field(default_factory=dict)

    def convert_coefficient(self, value: sympy.Expr) -> tuple[Poly, tuple[str, ...]]:
        """Returns (polynomial of the geometry, names of further factors) of a coefficient.

        A quotient of lengths is a polynomial times the inverse of each factor below, so that
        quotients that depend on each other are distinguished from those that do not.
        """
        above, below = sympy.fraction(sympy.together(value))
        number, factors = sympy.factor_list(below)
        try:
            lower = [(x, self._convert_polynomial(x)) for x, power in factors for _ in range(power)]
            quotients = tuple(self._add_quotient(1 / x, p) for x, p in lower)
            return self._convert_polynomial(above / number), quotients
        except DerivationError:
            number, rest = sympy.sympify(value).as_coeff_Mul()
            return self._convert_polynomial(number), (self._add_quotient(rest, None),)

    def _convert_polynomial(self, value: sympy.Expr) -> Poly:
        static = self.algebra.separate_motion(self.algebra.static(sympy.sympify(value)))
        return self.physical.lift_polynomial(static[(0,) * self.algebra.moving])

    def _add_quotient(self, value: sympy.Expr, below: Poly | None) -> str:
        quotient_names = {text: name for name, text in self.quotients.items()}
        taken = {*self.physical.names, *self.symbol_values, *self.quotients}
        fresh = next(name for k in count(1) if (name := f"k{k}") not in taken)
        name = quotient_names.get(str(value), fresh)
        self.quotients[name] = str(value)
        if below is not None:
            self.below[name] = below
        values = {x: self.symbol_values[x.name] for x in value.free_symbols}
        self.values[name] = float(value.subs(values))
        return name


def _build_from_base(model: SymbolicModel, base: BaseParameters) -> PhysicalSystem:
    algebra = TrigRing(model.geometry)
    physical = derive_physical_parameters(model, algebra)
    geometry = _KnownGeometry(algebra, physical, model.robot.evaluate_symbols())
    columns = {column.name: i for i, column in enumerate(base.columns)}
    alone = []
    parts: dict[str, list[tuple[Poly, tuple[str, ...], Poly]]] = {}
    for parameter in base.parameters:
        places = [columns[term.parameter] for term in parameter.terms]
        if [str(physical.standard.get(place)) for place in places] == [parameter.name]:
            alone.append(parameter.name)
        elif all(place in physical.standard for place in places):
            numbers = [geometry.convert_coefficient(term.coefficient) for term in parameter.terms]
            pairs = zip(numbers, places, strict=True)
            parts[parameter.name] = [(*number, physical.standard[k]) for number, k in pairs]
    ring = PolyRing([*physical.names, *geometry.quotients], QQ, lex)
    gens = get_generators(ring)
    definitions = {}
    for name, terms in parts.items():
        total = ring.zero
        for factor, quotients, standard in terms:
            both = factor.set_ring(ring) * standard.set_ring(ring)
            total = total + prod([gens[x] for x in quotients], start=both)
        if total:
            definitions[name] = total
    used = tuple(definitions)
    same, name = np.eye(len(used)), model.robot.name
    return _build_system(name, geometry, definitions, None, (used, ()), same, tuple(alone))


def _build_system(
    robot: str,
    geometry: _KnownGeometry,
    definitions: Mapping[str, Poly],
    free: Sequence[str] | None,
    base: tuple[tuple[str, ...], tuple[str, ...]],
    to_data: np.ndarray,
    alone: tuple[str, ...] = (),
) -> PhysicalSystem:
    """The ring with what the definitions use, and all of them in it; None: of base parameters."""
    physical = geometry.physical
    some = next(iter(definitions.values()), physical.ring.zero).ring
    used = _find_used(definitions.values(), [str(symbol) for symbol in some.symbols])
    used |= _find_used(geometry.below.values(), physical.names)
    candidates = [x for x in physical.letters if physical.kinds[x] != "length" or x in (free or ())]
    letters = tuple(x for x in candidates if x in used)
    static = geometry.algebra.evaluate_static(geometry.symbol_values)
    names = map(str, geometry.algebra.static_ring.symbols)
    known = dict(zip(names, static, strict=True)) | geometry.values
    constants = {x: v for x, v in known.items() if x in used and x not in letters}
    for name in {*letters, *constants} & set(definitions):
        raise RobotError(
            f"robot {robot}: the letter {name} is also the name of an identified quantity; rename "
            "it in [physical] or [symbols]"
        )
    ring = PolyRing([*definitions, *letters, *constants], QQ, lex)
    return PhysicalSystem(
        robot,
        "base" if free is None else "coefficients",
        ring,
        tuple(definitions),
        letters,
        {x: physical.kinds[x] for x in letters},
        tuple(x for x in physical.masses if x in letters),
        tuple(x for x in physical.moments if x in letters),
        tuple(x for x in physical.letters if x not in {*used, *alone} and _has_body(x, physical)),
        alone,
        constants,
        geometry.quotients,
        {name: poly.set_ring(ring) for name, poly in geometry.below.items()},
        {name: poly.set_ring(ring) for name, poly in definitions.items()},
        *base,
        to_data,
    )


def _find_used(polys: Iterable[Poly], names: Sequence[str]) -> set[str]:
    """Generators that occur, an angle with both its cosine and its sine."""
    used = {names[i] for i in find_places(*polys)}
    used |= {"sin" + x[3:] for x in used if x.startswith("cos(")}
    return used | {"cos" + x[3:] for x in used if x.startswith("sin(")}


def _has_body(letter: str, physical: PhysicalParameters) -> bool:
    """True of letters of links that have a body, and of lengths."""
    if physical.kinds[letter] == "length":
        return True
    at = physical.names.index(letter)
    return any(e[at] for poly in physical.standard.values() for e in poly)


class NumericPolynomial:
    """Polynomials of a system as arrays: values and slopes quickly."""

    def __init__(self, poly: Poly) -> None:
        self.powers = np.array(list(poly), dtype=int).reshape(len(poly), poly.ring.ngens)
        self.factors = np.array([float(convert_to_fraction(value)) for value in poly.values()])

    def evaluate(self, point: np.ndarray) -> float:
        """Returns the value at a point of all generators."""
        return float(self.factors @ np.prod(point**self.powers, axis=1))

    def evaluate_slopes(self, point: np.ndarray) -> np.ndarray:
        """Returns (generators,) derivatives at a point."""
        slopes = np.zeros(len(point))
        for k in np.flatnonzero(self.powers.any(axis=0)):
            lower = self.powers.copy()
            lower[:, k] = np.maximum(lower[:, k] - 1, 0)
            terms = self.factors * self.powers[:, k] * np.prod(point**lower, axis=1)
            slopes[k] = terms.sum()
        return slopes
