"""An independent check of the grouping, modulo a prime.

The energy rows are computed anew, in the base frame, at random states and random geometry modulo a
prime: a rank found there is a lower bound of the true rank (a minor that does not vanish modulo the
prime does not vanish), and a relation that holds there at many random points holds identically but
for a probability of about (degree / prime) for each point. Together with the relations, which bound
the rank from above, this proves the number of base parameters.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import accumulate
from math import isqrt, lcm

import numpy as np
import sympy

from modeler.derivation.columns import LinkColumn, ShaftColumn, StandardColumn, is_in_block
from modeler.derivation.field import ExactField, get_cosine_symbol
from modeler.derivation.geometry import Geometry, GeometryRow, cos_sin
from modeler.effects import EnergyBlock

# Vectors of residues modulo a prime: one entry per random point.
#
# Modulo SMALL they are int64 arrays, products of two residues fitting in 64 bits; modulo LARGE
# arrays of Python integers, slower, with room to tell the rational number that a residue stands
# for.


SMALL = 2**31 - 1
LARGE = 2**127 - 1

Residues = np.ndarray
"""Reduced modulo the prime; one entry per point."""


def fill_residues(value: int, points: int, prime: int) -> Residues:
    """Returns the same residue at all points."""
    return np.full(points, value % prime, dtype=np.int64 if prime == SMALL else object)


def draw_residues(rng: np.random.Generator, shape: tuple[int, ...], prime: int) -> Residues:
    """Returns random residues, neither 0 nor 1."""
    if prime == SMALL:
        return rng.integers(2, prime, size=shape, dtype=np.int64)
    parts = rng.integers(2, 2**62, size=(2, *shape)).astype(object)
    return (parts[0] * 2**62 + parts[1]) % prime


def compute_power(value: Residues, n: int, prime: int) -> Residues:
    """Returns value**n, n >= 0."""
    result = value * 0 + 1
    while n:
        if n & 1:
            result = result * value % prime
        value = value * value % prime
        n >>= 1
    return result


def invert_residues(value: Residues, prime: int) -> Residues:
    """Returns 1 / value.

    Raises:
        ValueError: an entry is 0, modulo LARGE.
    """
    if prime == SMALL:
        return compute_power(value, prime - 2, prime)
    # One inversion for all entries (Montgomery): that of their product.
    products = list(accumulate(value.tolist(), lambda a, b: a * b % prime))
    rest = pow(products[-1], -1, prime)
    inverses = np.empty(len(products), dtype=object)
    for i in range(len(products) - 1, 0, -1):
        inverses[i] = rest * products[i - 1] % prime
        rest = rest * value[i] % prime
    inverses[0] = rest
    return inverses


def reduce_rational(number: Fraction, prime: int) -> int:
    """Returns a rational number as a residue.

    Raises:
        ValueError: its denominator is a multiple of the prime.
    """
    return number.numerator * pow(number.denominator, -1, prime) % prime


def compute_circle_point(t: Residues, prime: int) -> tuple[Residues, Residues]:
    """Returns the point of the unit circle with tan(a/2) = t: (cos, sin)."""
    square = t * t % prime
    # 1 + t**2 is never 0: both primes are 3 modulo 4.
    scale = invert_residues((1 + square) % prime, prime)
    return (1 - square) * scale % prime, 2 * t % prime * scale % prime


def add_angles(
    a: tuple[Residues, Residues], b: tuple[Residues, Residues], prime: int
) -> tuple[Residues, Residues]:
    """Returns (cos, sin) of the sum of two angles."""
    c = (a[0] * b[0] % prime - a[1] * b[1] % prime) % prime
    return c, (a[1] * b[0] % prime + a[0] * b[1] % prime) % prime


def reconstruct_rational(residue: int, prime: int) -> Fraction | None:
    """Returns the rational number of small numerator and denominator that the residue stands for.

    Wang's algorithm: half of the extended Euclidean algorithm, bounded by sqrt(prime / 2); None if
    there is none.
    """
    bound = isqrt(prime // 2)
    a, b, u, v = prime, residue % prime, 0, 1
    while b > bound:
        q = a // b
        a, b, u, v = b, a - q * b, v, u - q * v
    if v == 0 or abs(v) > bound:
        return None
    return Fraction(b, v)


def reduce_to_echelon(
    matrix: np.ndarray, order: Sequence[int], prime: int, reduced: bool = True
) -> list[tuple[int, int]]:
    """Reduces `matrix` in place to (reduced) row echelon form, columns in the given order.

    432 x 210 modulo SMALL take 0.11 s; 3.0 s as a sympy `DomainMatrix`, 0.24 s by python-flint.

    Returns:
        (row, column) of the pivots; the pivot columns are the first-come independent ones.
    """
    pivots: list[tuple[int, int]] = []
    for column in order:
        rank = len(pivots)
        if rank == matrix.shape[0]:
            break
        having = np.nonzero(matrix[rank:, column])[0]
        if len(having) == 0:
            continue
        pivot = rank + int(having[0])
        matrix[[rank, pivot]] = matrix[[pivot, rank]]
        scale = pow(int(matrix[rank, column]), -1, prime)
        matrix[rank] = matrix[rank] * scale % prime
        factors = matrix[:, column].copy()
        factors[rank if reduced else 0 : rank + 1] = 0
        used = np.nonzero(factors)[0]
        touched = np.ix_(used, np.nonzero(matrix[rank])[0])
        lines = factors[used][:, None] * matrix[rank][touched[1]] % prime
        matrix[touched] = (matrix[touched] - lines) % prime
        pivots.append((rank, column))
    return pivots


def compute_kernel(matrix: np.ndarray, prime: int) -> np.ndarray:
    """Returns rows (columns - rank, columns) that span {x: matrix x = 0}; reduces `matrix`."""
    width = matrix.shape[1]
    pivots = [column for _, column in reduce_to_echelon(matrix, range(width), prime)]
    free = [k for k in range(width) if k not in pivots]
    kernel = np.zeros((len(free), width), dtype=matrix.dtype)
    kernel[range(len(free)), free] = 1
    kernel[:, pivots] = -matrix[: len(pivots), free].T % prime
    return kernel


# Vectors (3, points) and rotations (3, 3, points) of residues; the columns of a rotation are the
# axes of a frame.


def cross(a: Residues, b: Residues, prime: int) -> Residues:
    """Returns a x b."""
    (x, y, z), (u, v, w) = a, b
    return np.stack([y * w % prime - z * v, z * u % prime - x * w, x * v % prime - y * u]) % prime


def dot(a: Residues, b: Residues, prime: int) -> Residues:
    """Returns a . b."""
    return np.asarray((a * b % prime).sum(axis=0) % prime)


def rotate_into_axes(R: Residues, v: Residues, prime: int) -> Residues:
    """Returns R^T v: the components of v along the axes of R."""
    return np.asarray((R * v[:, None] % prime).sum(axis=0) % prime)


def rotate_about_axis(R: Residues, axis: int, c: Residues, s: Residues, prime: int) -> Residues:
    """Returns R times the rotation by (c, s) about its own axis x (0) or z (2)."""
    i, j = (1, 2) if axis == 0 else (0, 1)
    out = R.copy()
    out[:, i] = (c * R[:, i] % prime + s * R[:, j] % prime) % prime
    out[:, j] = (c * R[:, j] % prime - s * R[:, i] % prime) % prime
    return out


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
        self.letters = letters or {
            letter: fill_residues(residue, points, prime)
            for letter, residue in self.residues.items()
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
        self._units = [
            compute_circle_point(t, prime) for t in draw_residues(rng, (count, points), prime)
        ]
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
        r = (
            self.value(row.r)
            if not slides or self.geometry.has_relations
            else self.value(sympy.Integer(0))
        )
        if slides:
            r = (r + row.rate * self._combine_row(row, self.travel)) % prime
        p = (p + R[:, 2] * r) % prime
        v = (v + cross(w, p - p0, prime)) % prime
        if moving:
            speed = row.rate * self._combine_row(row, self.qd) % prime
            joint_velocity = R[:, 2] * speed
            w, v = (
                ((w + joint_velocity) % prime, v)
                if row.joint.is_revolute
                else (w, (v + joint_velocity) % prime)
            )
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
        total = (
            fill_residues(1, self.points, self.prime),
            fill_residues(0, self.points, self.prime),
        )
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

        rows = {
            "XX": multiply_speeds(0, 0),
            "XY": multiply_speeds(0, 1),
            "XZ": multiply_speeds(0, 2),
        }
        rows |= {
            "YY": multiply_speeds(1, 1),
            "YZ": multiply_speeds(1, 2),
            "ZZ": multiply_speeds(2, 2),
        }
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
