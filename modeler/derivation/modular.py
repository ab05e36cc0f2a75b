"""Exact linear algebra modulo a prime: an independent check of the grouping; ties of loops.

The energy rows are computed anew, in the base frame, at random states and random geometry modulo a
prime: a rank found there is a lower bound of the true rank (a minor that does not vanish modulo the
prime does not vanish), and a relation that holds there at many random points holds identically but
for a probability of about (degree / prime) for each point. Together with the relations, which bound
the rank from above, this proves the number of base parameters.
"""

from collections.abc import Callable, Mapping, Sequence, Set
from fractions import Fraction
from functools import cache, partial
from itertools import combinations_with_replacement, product
from math import lcm

import numpy as np
import sympy
from sympy import QQ

from modeler.derivation.field import (
    LARGE,
    SMALL,
    CoefficientTooLarge,
    Element,
    ExactField,
    Residues,
    add_angles,
    compute_circle_point,
    compute_kernel,
    compute_power,
    cross,
    dot,
    draw_residues,
    fill_residues,
    get_cosine_symbol,
    invert_residues,
    reconstruct_rational,
    reduce_rational,
    reduce_to_echelon,
    rotate_about_axis,
    rotate_into_axes,
)
from modeler.derivation.geometry import Geometry, GeometryRow, cos_sin
from modeler.derivation.model import LinkColumn, ShaftColumn, StandardColumn, is_in_block
from modeler.derivation.thresholds import THRESHOLDS
from modeler.effects import EnergyBlock

# Vectors of residues modulo a prime: one entry per random point.
#
# Modulo SMALL they are int64 arrays, products of two residues fitting in 64 bits; modulo LARGE
# arrays of Python integers, slower, with room to find the rational number that a residue stands
# for.


# Vectors (3, points) and rotations (3, 3, points) of residues; the columns of a rotation are the
# axes of a frame.


PRIME = SMALL


class ModularState:
    """Random geometry, positions and speeds modulo the prime, and the links' motion.

    Loops are left open; joints that follow others by relations do so.
    """

    def __init__(
        self,
        geometry: Geometry,
        K: ExactField,
        points: int,
        seed: int,
        prime: int = SMALL,
        letters: Mapping[sympy.Expr, Residues] | None = None,
    ) -> None:
        """A state at `points` random points.

        Args:
            geometry: the table.
            K: its field.
            points: number of points.
            seed: of everything random.
            prime: modulus.
            letters: values of the letters at every point; one random geometry if left out.
        """
        rng = np.random.default_rng(seed)
        self.geometry, self.points, self.prime = geometry, points, prime
        self.residues = {letter: int(draw_residues(rng, (1,), prime)[0]) for letter in K.letters}
        residues = self.residues.items()
        self.letters = letters or {
            letter: fill_residues(x, points, prime) for letter, x in residues
        }
        self.value = cache(self._evaluate_constant)
        count = geometry.coordinate_count
        self.qd = draw_residues(rng, (count, points), prime)
        self.travel = draw_residues(rng, (count, points), prime)
        # Common denominators of the coefficients with which the free variables enter angles.
        self._scales = [1] * count
        for row in geometry.rows:
            if row.index is not None and row.joint.is_revolute:
                for k, coefficient in geometry.forms[row.index].items():
                    self._scales[k] = lcm(self._scales[k], coefficient.denominator)
        draws = draw_residues(rng, (count, points), prime)
        self._units = [compute_circle_point(t, prime) for t in draws]
        self.gravity = np.stack([self.value(entry) for entry in geometry.gravity])
        # R, p, angular and linear velocity of every row's frame, in the base frame.
        zero, one = (fill_residues(n, points, prime) for n in (0, 1))
        none = np.stack([zero] * 3)
        identity = np.stack([one, *[zero] * 3] * 2 + [one]).reshape(3, 3, points)
        self.motion: list[tuple[Residues, ...]] = []
        for row in geometry.rows:
            at = (identity, none, none, none) if row.parent is None else self.motion[row.parent]
            self.motion.append(self._propagate_frame(row, *at))

    def _evaluate_constant(self, e: sympy.Expr) -> Residues:
        """Residues of a constant expression."""
        if e.is_Rational:
            number = reduce_rational(Fraction(int(e.p), int(e.q)), self.prime)
            return fill_residues(number, self.points, self.prime)
        if e.func in (sympy.cos, sympy.sin):
            c, s = compute_circle_point(self.letters[get_cosine_symbol(e)], self.prime)
            return c if e.func is sympy.cos else s
        if e in self.letters:
            return self.letters[e]
        if e.is_Add or e.is_Mul:
            total = self.value(e.args[0])
            for arg in e.args[1:]:
                other = self.value(arg)
                total = (total + other if e.is_Add else total * other) % self.prime
            return total
        n = int(e.exp)
        base = compute_power(self.value(e.base), abs(n), self.prime)
        return base if n >= 0 else invert_residues(base, self.prime)

    def _propagate_frame(
        self, row: GeometryRow, R: Residues, p: Residues, w: Residues, v: Residues
    ) -> tuple[Residues, ...]:
        p0, prime = p, self.prime
        R = rotate_about_axis(R, 2, *self._evaluate_cos_sin(row.gamma), prime)
        p = (p + R[:, 2] * self.value(row.b)) % prime
        R = rotate_about_axis(R, 0, *self._evaluate_cos_sin(row.alpha), prime)
        p = (p + R[:, 0] * self.value(row.d)) % prime
        moving = row.index is not None
        if not moving or not row.joint.is_revolute or self.geometry.has_relations:
            # The constant part of a free angle only shifts the variable, which is random anyway.
            R = rotate_about_axis(R, 2, *self._evaluate_cos_sin(row.theta), prime)
        if moving and row.joint.is_revolute:
            R = rotate_about_axis(R, 2, *self._compute_joint_angle(row), prime)
        slides = moving and not row.joint.is_revolute
        counts = not slides or self.geometry.has_relations
        r = self.value(row.r if counts else sympy.Integer(0))
        if slides:
            r = (r + row.rate * self._combine_row(row, self.travel)) % prime
        p = (p + R[:, 2] * r) % prime
        v = (v + cross(w, p - p0, prime)) % prime
        if moving:
            speed = row.rate * self._combine_row(row, self.qd) % prime
            joint_velocity = R[:, 2] * speed
            if row.joint.is_revolute:
                w = (w + joint_velocity) % prime
            else:
                v = (v + joint_velocity) % prime
        return R, p, w, v

    def _combine_row(self, row: GeometryRow, free: Residues) -> Residues:
        assert row.index is not None
        return self._combine_form(self.geometry.forms[row.index], free)

    def _combine_form(self, form: Mapping[int, Fraction], free: Residues) -> Residues:
        total = fill_residues(0, self.points, self.prime)
        for k, coefficient in form.items():
            total = (total + reduce_rational(coefficient, self.prime) * free[k]) % self.prime
        return total

    def _compute_joint_angle(self, row: GeometryRow) -> tuple[Residues, Residues]:
        """(cos, sin) of rate * the row's variable: powers of the free variables' angles."""
        assert row.index is not None
        one, zero = (fill_residues(n, self.points, self.prime) for n in (1, 0))
        total = one, zero
        for k, coefficient in self.geometry.forms[row.index].items():
            turns = int(coefficient * self._scales[k]) * row.rate
            c, s = self._units[k]
            unit = (c, s if turns > 0 else -s % self.prime)
            for bit in bin(abs(turns))[:1:-1]:
                if bit == "1":
                    total = add_angles(total, unit, self.prime)
                unit = add_angles(unit, unit, self.prime)
        return total

    def _evaluate_cos_sin(self, angle: sympy.Expr) -> tuple[Residues, Residues]:
        c, s = cos_sin(angle)
        return self.value(c), self.value(s)

    def compute_energy_rows(self, columns: Sequence[StandardColumn]) -> np.ndarray:
        """Returns (2 points, columns): rows of 2T, then of the power of gravity and constants."""
        n = self.points
        rows = np.stack([fill_residues(0, 2 * n, self.prime)] * len(columns), axis=1)
        links: dict[int, Mapping[str, tuple[Residues, Residues]]] = {}
        for place, column in enumerate(columns):
            for part in column.parts:
                if isinstance(part, LinkColumn):
                    if part.row not in links:
                        links[part.row] = self._compute_link_rows(part.row)
                    kinetic, power_of_gravity = links[part.row][part.prefix]
                    rows[:n, place] += kinetic
                    rows[n:, place] += power_of_gravity
                elif part.block is EnergyBlock.KINETIC:
                    rows[:n, place] += compute_power(self.compute_shaft_speed(part), 2, self.prime)
                elif part.block is EnergyBlock.POWER:
                    rows[n:, place] += self.compute_shaft_speed(part)
        return rows % self.prime

    def compute_rayleigh_rows(self, columns: Sequence[StandardColumn]) -> np.ndarray:
        """Returns (points, columns): v**2 of the viscous columns."""
        rows = np.stack([fill_residues(0, self.points, self.prime)] * len(columns), axis=1)
        for place, column in enumerate(columns):
            if is_in_block(column, EnergyBlock.RAYLEIGH):
                for part in column.parts:
                    rows[:, place] += compute_power(self.compute_shaft_speed(part), 2, self.prime)
        return rows % self.prime

    def compute_shaft_speed(self, column: ShaftColumn) -> Residues:
        """Returns the speed of the shaft of an effect's column."""
        return self._combine_form(column.shaft, self.qd)

    def _compute_link_rows(self, row: int) -> Mapping[str, tuple[Residues, Residues]]:
        prime = self.prime
        R, _, w, v = self.motion[row]
        w, v, g = (rotate_into_axes(R, x, prime) for x in (w, v, self.gravity))
        vw, gw = cross(v, w, prime), cross(g, w, prime)
        nothing = fill_residues(0, self.points, prime)

        def multiply_speeds(i: int, j: int) -> tuple[Residues, Residues]:
            return (w[i] * w[j] % prime * (1 if i == j else 2)) % prime, nothing

        pairs = combinations_with_replacement(range(3), 2)
        names = ("XX", "XY", "XZ", "YY", "YZ", "ZZ")
        rows = {name: multiply_speeds(i, j) for name, (i, j) in zip(names, pairs, strict=True)}
        for i, name in enumerate(("MX", "MY", "MZ")):
            rows[name] = (2 * vw[i] % prime, -gw[i] % prime)
        rows["M"] = (dot(v, v, prime), -dot(g, v, prime) % prime)
        return rows


def compute_modular_rank(matrix: np.ndarray) -> int:
    """Returns the rank modulo the small prime, of rows at random points.

    Where half of the rows suffice, the others are added to them at random: the rank of such sums is
    at most that of all rows, and less only by a chance of columns over prime.
    """
    left = matrix % PRIME
    half = (len(left) + 1) // 2
    if half >= left.shape[1]:
        weights = np.random.default_rng(half).integers(1, PRIME, (len(left) - half, 1))
        left[: len(weights)] = (left[: len(weights)] + weights * left[half:]) % PRIME
        left = left[:half]
    return len(reduce_to_echelon(left, range(left.shape[1]), PRIME, reduced=False))


# Exact grouping where joints follow others by linear relations.
#
# Link-by-link elimination (`modeler.derivation.link_relations`) needs joints that move on their
# own. Here the energy rows are sampled modulo a prime at random states: which columns depend on
# which others follows from one random geometry; each coefficient, a rational function of a few
# letters of the geometry, is interpolated from its values at several geometries and checked at
# fresh ones.


# Rational functions from their values modulo a prime.
#
# The functions are coefficients of relations: quotients of polynomials in the letters of the exact
# field, with rational numbers that are small against the prime. Most are one monomial, which shows
# when one letter is changed at a time. For the others the degrees in each letter are found first,
# then all coefficients from one linear system.


Point = tuple[int, ...]
"""A residue modulo LARGE for each letter of the field."""

Function = Callable[[Sequence[Point]], list[int]]
"""Its values modulo LARGE at some points."""

_EXPONENTS = (1, -1, 2, -2, 3, -3, 4, -4)


class Probes:
    """Random points, the same for all functions, so that what was sampled serves again.

    Attributes:
        home: one point.
        fresh: points that no function is made from, for checks.
    """

    def __init__(self, letters: int, seed: int) -> None:
        self._rng = np.random.default_rng(seed)
        self._letters = letters
        self.home = self._draw_point()
        self.fresh = [self._draw_point() for _ in range(THRESHOLDS.interpolation_checks)]
        self._known: dict[tuple[int, ...], list[Point]] = {}

    def draw_moved_points(self, letters: tuple[int, ...], count: int) -> list[Point]:
        """Returns the first `count` points that differ from home in these letters only."""
        known = self._known.setdefault(letters, [])
        while len(known) < count:
            other = self._draw_point()
            known.append(tuple(other[i] if i in letters else x for i, x in enumerate(self.home)))
        return known[:count]

    def _draw_point(self) -> Point:
        return tuple(int(x) for x in draw_residues(self._rng, (self._letters,), LARGE))


def interpolate_coefficient(function: Function, K: ExactField, probes: Probes) -> Element:
    """Returns the element of K that has the values of the function.

    Raises:
        TooLarge: it has too many terms or too high a degree, or is no such element.
    """
    moved = [probes.draw_moved_points((i,), 1)[0] for i in range(len(K.letters))]
    value, *others = function([probes.home, *moved])
    changes = {i: other for i, other in enumerate(others) if other != value}
    element = _fit_monomial(value, changes, moved, K, probes)
    if element is None:
        element = _fit_quotient(function, tuple(changes), K, probes)
    for point, value in zip(probes.fresh, function(probes.fresh), strict=True):
        if K.compute_residue(element, dict(zip(K.letters, point, strict=True)), LARGE) != value:
            raise CoefficientTooLarge("a coefficient is not a quotient of short polynomials")
    return element


def _fit_monomial(
    value: int, changes: Mapping[int, int], moved: Sequence[Point], K: ExactField, probes: Probes
) -> Element | None:
    """number * product of powers, if it is one: changing a letter multiplies by a power."""
    if value == 0:
        return None
    element = K.one
    for i, other in changes.items():
        ratio = other * pow(value, -1, LARGE) % LARGE
        step = moved[i][i] * pow(probes.home[i], -1, LARGE) % LARGE
        exponent = next((e for e in _EXPONENTS if pow(step, e, LARGE) == ratio), None)
        if exponent is None:
            return None
        element = element * K.get_generator(i) ** exponent
    at_home = K.compute_residue(element, dict(zip(K.letters, probes.home, strict=True)), LARGE)
    number = reconstruct_rational(value * pow(at_home, -1, LARGE) % LARGE, LARGE)
    return None if number is None else element * QQ(number.numerator, number.denominator)


def _fit_quotient(
    function: Function, letters: tuple[int, ...], K: ExactField, probes: Probes
) -> Element:
    """numerator / denominator of the degrees in each letter that the function has alone in it."""
    degrees = [_find_degrees(function, i, probes) for i in letters]
    above, below = (list(product(*(range(d[k] + 1) for d in degrees))) for k in (0, 1))
    terms = len(above) + len(below)
    if terms > THRESHOLDS.max_quotient_terms:
        raise CoefficientTooLarge(f"a coefficient has up to {terms} terms")
    moved = probes.draw_moved_points(letters, terms)
    weights = _fit_coefficients(function, moved, letters, above, below)
    if weights is None:
        raise CoefficientTooLarge("a coefficient is not a quotient of short polynomials")
    numbers = [reconstruct_rational(weight, LARGE) for weight in weights]
    top, bottom = K.zero, K.zero
    for place, (number, monomial) in enumerate(zip(numbers, [*above, *below], strict=True)):
        if number is None:
            raise CoefficientTooLarge("a coefficient has long numbers")
        if number:
            term = K.one * QQ(number.numerator, number.denominator)
            for i, e in zip(letters, monomial, strict=True):
                term = term * K.get_generator(i) ** e
            top, bottom = (top + term, bottom) if place < len(above) else (top, bottom + term)
    return top / bottom


def _find_degrees(function: Function, letter: int, probes: Probes) -> tuple[int, int]:
    """Degrees of numerator and denominator in one letter, the others at home.

    Raises:
        TooLarge: they are above `THRESHOLDS.max_letter_degree`.
    """
    for degree in range(1, THRESHOLDS.max_letter_degree + 1):
        powers = [(e,) for e in range(degree + 1)]
        # One point more than there are terms, or some quotient would always fit.
        points = probes.draw_moved_points((letter,), 2 * len(powers) + 1)
        weights = _fit_coefficients(function, points, (letter,), powers, powers)
        if weights is not None:
            return _get_degree(weights[: degree + 1]), _get_degree(weights[degree + 1 :])
    raise CoefficientTooLarge(f"a coefficient is of degree above {THRESHOLDS.max_letter_degree}")


def _get_degree(weights: Sequence[int]) -> int:
    return max((i for i, weight in enumerate(weights) if weight), default=0)


def _fit_coefficients(
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
    sides = [_evaluate_monomials(at, above), -values * _evaluate_monomials(at, below)]
    matrix = np.hstack(sides) % LARGE
    kernel = compute_kernel(matrix, LARGE)
    weights: list[int] = kernel[0].tolist() if len(kernel) else []
    return weights if any(weights[len(above) :]) else None


def _evaluate_monomials(at: np.ndarray, monomials: Sequence[Point]) -> np.ndarray:
    """(points, monomials): values of the monomials at `at` (points, letters)."""
    values = np.ones((len(at), len(monomials)), dtype=object)
    for i in range(at.shape[1]):
        table = [values[:, 0] * 0 + 1]
        for _ in range(max(monomial[i] for monomial in monomials)):
            table.append(table[-1] * at[:, i] % LARGE)
        for place, monomial in enumerate(monomials):
            values[:, place] = values[:, place] * table[monomial[i]] % LARGE
    return values


def derive_tied_relations(
    geometry: Geometry,
    columns: Sequence[StandardColumn],
    K: ExactField,
    order: Sequence[int],
    seed: int,
) -> list[dict[int, Element]]:
    """Returns all relations among the energy rows of the columns, loops left open.

    Args:
        geometry: the table, with relations.
        columns: inertial, rotor inertia and offset columns; others are not looked at.
        K: the field of the geometry.
        order: columns in the order in which they are kept.
        seed: of the random points.

    Returns:
        A basis: sum of coefficient * column = 0, the coefficient of one column of each being 1.

    Raises:
        TooLarge: a coefficient is no short quotient of polynomials, or has long numbers.
    """
    energetic = [i for i in order if has_energy(columns[i])]

    def compute_rows(state: ModularState, places: Sequence[int]) -> np.ndarray:
        return state.compute_energy_rows([columns[i] for i in places])

    return find_dependent_columns(geometry, compute_rows, K, energetic, set(energetic), seed)


ExactFunctions = Callable[[ModularState, Sequence[int]], np.ndarray]
"""(2 points, places): what numbered functions on the opened tree, of which relations are looked
for, add to 2T, then to the power of gravity."""


def find_dependent_columns(
    geometry: Geometry,
    functions: ExactFunctions,
    K: ExactField,
    order: Sequence[int],
    wanted: Set[int],
    seed: int,
) -> list[dict[int, Element]]:
    """Returns the relation of every wanted function that depends on those before it.

    Args:
        geometry: the table.
        functions: on its opened tree.
        K: the field of the geometry.
        order: numbers of the functions, in the order in which they are kept.
        wanted: numbers of those whose coefficients are wanted; others are left out of relations.
        seed: of the random points.

    Raises:
        TooLarge: a coefficient is no short quotient of polynomials, or has long numbers.
    """
    try:
        supports = _find_supports(geometry, functions, K, order, seed)
        supports = {column: support for column, support in supports.items() if column in wanted}
        sampler = _CoefficientSampler(geometry, functions, K, supports, seed)
        probes = Probes(len(K.letters), seed)
        places = [(i, k) for i, support in supports.items() for k in support if k in wanted]
        points = (probes.draw_moved_points((i,), 1)[0] for i in range(len(K.letters)))
        moved = [probes.home, *points]
        # That of most letters first: if one is too large, it is.
        places.sort(key=lambda at: len(set(sampler.evaluate_coefficient(at, moved))), reverse=True)
        parts = {at: partial(sampler.evaluate_coefficient, at) for at in places}
        coefficients = {at: -interpolate_coefficient(part, K, probes) for at, part in parts.items()}
        return [
            {column: K.one} | {k: coefficients[column, k] for k in support if k in wanted}
            for column, support in supports.items()
        ]
    except ValueError as error:  # a constant whose denominator is a multiple of a prime
        raise CoefficientTooLarge(f"a constant has no value modulo a prime ({error})") from None


def _find_supports(
    geometry: Geometry, functions: ExactFunctions, K: ExactField, order: Sequence[int], seed: int
) -> dict[int, list[int]]:
    """For each dependent function the kept ones that it is a combination of."""
    state = ModularState(geometry, K, len(order) + THRESHOLDS.spare_points, seed, SMALL)
    rows = functions(state, order)
    pivots = reduce_to_echelon(rows, range(len(order)), SMALL)
    pivot_rows = {column: row for row, column in pivots}
    dependent = (column for column in range(len(order)) if column not in pivot_rows)
    by_pivot = pivot_rows.items()
    return {
        order[c]: [order[pivot] for pivot, row in by_pivot if rows[row, c] != 0] for c in dependent
    }


def has_energy(column: StandardColumn) -> bool:
    """Returns True where a column adds to the energies: no friction."""
    return isinstance(column, LinkColumn) or column.kind in ("rotor_inertia", "offset")


class _CoefficientSampler:
    """Values of all coefficients at given geometries, modulo the large prime."""

    def __init__(
        self,
        geometry: Geometry,
        functions: ExactFunctions,
        K: ExactField,
        supports: Mapping[int, Sequence[int]],
        seed: int,
    ) -> None:
        self.geometry, self.K, self.supports, self.seed = geometry, K, supports, seed
        self.functions = functions
        self.blocks = _partition_blocks(supports)
        self.used = sorted({c for both in self.blocks for columns in both for c in columns})
        self.place = {column: i for i, column in enumerate(self.used)}
        largest = max((len(kept_columns) for kept_columns, _ in self.blocks), default=0)
        self.points = largest + THRESHOLDS.extra_points
        self._known: dict[Point, dict[tuple[int, int], int]] = {}

    def evaluate_coefficient(self, at: tuple[int, int], geometries: Sequence[Point]) -> list[int]:
        """Returns the coefficient `at` = (dependent column, kept column) at the geometries.

        Raises:
            TooLarge: there the column is not the combination that it was at one geometry.
        """
        missing = [g for g in dict.fromkeys(geometries) if g not in self._known]
        if missing:
            self._add_samples(missing)
        return [self._known[g][at] for g in geometries]

    def _add_samples(self, geometries: Sequence[Point]) -> None:
        n = self.points
        letters: dict[sympy.Expr, Residues] = {
            letter: np.array([g[i] for g in geometries for _ in range(n)], dtype=object)
            for i, letter in enumerate(self.K.letters)
        }
        total = n * len(geometries)
        self.seed += 1
        state = ModularState(self.geometry, self.K, total, self.seed, LARGE, letters)
        rows = self.functions(state, self.used).reshape(2, len(geometries), n, -1)
        for i, geometry in enumerate(geometries):
            self._known[geometry] = {}
            for kept_columns, dependent in self.blocks:
                places = [self.place[column] for column in (*kept_columns, *dependent)]
                count = len(kept_columns) + THRESHOLDS.extra_points
                part = rows[:, i, :count, places].reshape(len(places), -1).T
                solved = self._solve_coefficients(part.copy(), kept_columns, dependent)
                self._known[geometry] |= solved

    def _solve_coefficients(
        self, matrix: np.ndarray, kept_columns: Sequence[int], dependent: Sequence[int]
    ) -> dict[tuple[int, int], int]:
        """Coefficients at one geometry, from its energy rows (rows, kept and then dependent)."""
        size = len(kept_columns)
        pivots = reduce_to_echelon(matrix, range(size), LARGE)
        coefficients = {}
        for column, values in zip(dependent, matrix[:, size:].T, strict=True):
            combination = {c for c, value in zip(kept_columns, values, strict=False) if value}
            supported = len(pivots) == size and combination == {*self.supports[column]}
            if not supported or np.any(values[size:]):
                raise CoefficientTooLarge(
                    "what depends on what at one geometry does not at another"
                )
            for c, value in zip(kept_columns, values, strict=False):
                coefficients[column, c] = int(value)
        return coefficients


def _partition_blocks(supports: Mapping[int, Sequence[int]]) -> list[tuple[list[int], list[int]]]:
    """(kept, dependent) columns, apart where no dependent column involves kept ones of both."""
    blocks: list[tuple[list[int], list[int]]] = []
    for column, support in supports.items():
        if not support:
            continue
        kept_columns, dependent = list(support), [column]
        for block in [block for block in blocks if set(block[0]) & set(support)]:
            blocks.remove(block)
            kept_columns = [*block[0], *(c for c in kept_columns if c not in block[0])]
            dependent = [*block[1], *dependent]
        blocks.append((kept_columns, dependent))
    return blocks
