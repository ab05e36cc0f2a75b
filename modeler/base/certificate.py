"""An independent check of the grouping, modulo a prime.

The energy rows are computed anew, in the base frame, at random states and random geometry modulo a
prime: a rank found there is a lower bound of the true rank (a minor that does not vanish modulo the
prime does not vanish), and a relation that holds there at many random points holds identically but
for a probability of about (degree / prime) for each point. Together with the relations, which bound
the rank from above, this proves the number of base parameters.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import sympy

from modeler.base.field import ExactField, cosine_letter
from modeler.effects import EnergyBlock
from modeler.symbolic import Geometry, StandardColumn
from modeler.symbolic.angles import cos_sin

PRIME = 2**31 - 1
"""Products of two residues fit in 64 bits."""

Residues = np.ndarray
"""int64, reduced modulo PRIME; one entry per random point."""


class ModularState:
    """Random geometry, positions and speeds modulo the prime, and the links' motion."""

    def __init__(self, geometry: Geometry, K: ExactField, points: int, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.geometry, self.points = geometry, points
        self.residues = {letter: int(rng.integers(2, PRIME)) for letter in K.letters}
        self.letters = {
            letter: np.full(points, residue, dtype=np.int64)
            for letter, residue in self.residues.items()
        }
        self.qd = rng.integers(1, PRIME, size=(geometry.joints, points), dtype=np.int64)
        self.q = rng.integers(2, PRIME, size=(geometry.joints, points), dtype=np.int64)
        self.gravity = [self.value(entry) for entry in geometry.gravity]
        self._frames()

    def value(self, expression: sympy.Expr) -> Residues:
        """Residues of a constant expression."""
        e = expression
        if e.is_Rational:
            number = int(e.p) * pow(int(e.q), -1, PRIME) % PRIME
            return np.full(self.points, number, dtype=np.int64)
        if e.func in (sympy.cos, sympy.sin):
            c, s = _circle(self.letters[cosine_letter(e)])
            return c if e.func is sympy.cos else s
        if e in self.letters:
            return self.letters[e]
        if e.is_Add or e.is_Mul:
            total = self.value(e.args[0])
            for arg in e.args[1:]:
                other = self.value(arg)
                total = (total + other if e.is_Add else total * other) % PRIME
            return total
        n = int(e.exp)
        base = power(self.value(e.base), abs(n))
        return base if n >= 0 else inverse(base)

    def _frames(self) -> None:
        """R (3, 3), p, angular and linear velocity of every row's frame, in the base frame."""
        zero, one = (np.full(self.points, n, dtype=np.int64) for n in (0, 1))
        identity = [[one if i == j else zero for j in range(3)] for i in range(3)]
        none = [zero] * 3
        self.motion: list[tuple[list, list, list, list]] = []
        for row in self.geometry.rows:
            R, p, w, v = (
                (identity, none, none, none) if row.parent is None else self.motion[row.parent]
            )
            p0 = p
            R = _turn(R, 2, *self._cos_sin(row.gamma))
            p = _shift(p, R, 2, self.value(row.b))
            R = _turn(R, 0, *self._cos_sin(row.alpha))
            p = _shift(p, R, 0, self.value(row.d))
            moving = row.index is not None
            if moving and row.joint.angular:
                # The constant part of theta shifts the variable, which is random anyway.
                R = _turn(R, 2, *_circle(self.q[row.index]))
            else:
                R = _turn(R, 2, *self._cos_sin(row.theta))
            slides = moving and not row.joint.angular
            p = _shift(p, R, 2, self.q[row.index] if slides else self.value(row.r))
            v = _plus(v, _cross(w, _plus(p, [-x for x in p0])))
            axis = [R[i][2] for i in range(3)]
            if moving:
                own = [x * (row.rate * self.qd[row.index] % PRIME) % PRIME for x in axis]
                w, v = (_plus(w, own), v) if row.joint.angular else (w, _plus(v, own))
            self.motion.append((R, p, w, v))

    def _cos_sin(self, angle: sympy.Expr) -> tuple[Residues, Residues]:
        c, s = cos_sin(angle)
        return self.value(c), self.value(s)

    def energy_rows(self, columns: Sequence[StandardColumn]) -> np.ndarray:
        """(2 points, columns): rows of 2T, then of the power of gravity and constant forces."""
        rows = np.zeros((2 * self.points, len(columns)), dtype=np.int64)
        links = {}
        for place, column in enumerate(columns):
            if column.column is None:
                if column.row not in links:
                    links[column.row] = self._link_rows(column.row)
                kinetic, power_of_gravity = links[column.row][column.prefix]
                rows[: self.points, place] = kinetic
                rows[self.points :, place] = power_of_gravity
            elif column.column.block is EnergyBlock.KINETIC:
                rows[: self.points, place] = power(self.speed(column), 2)
            elif column.column.block is EnergyBlock.POWER:
                rows[self.points :, place] = self.speed(column)
        return rows

    def rayleigh_rows(self, columns: Sequence[StandardColumn]) -> np.ndarray:
        """(points, columns): v**2 of the viscous columns."""
        rows = np.zeros((self.points, len(columns)), dtype=np.int64)
        for place, column in enumerate(columns):
            if column.column is not None and column.column.block is EnergyBlock.RAYLEIGH:
                rows[:, place] = power(self.speed(column), 2)
        return rows

    def speed(self, column: StandardColumn) -> Residues:
        """Speed of the shaft of an effect's column."""
        assert column.shaft is not None
        total = np.zeros(self.points, dtype=np.int64)
        for joint, coefficient in column.shaft.items():
            exact = sympy.Rational(coefficient.numerator, coefficient.denominator)
            total = (total + self.value(exact) * self.qd[joint]) % PRIME
        return total

    def _link_rows(self, row: int) -> Mapping[str, tuple[Residues, Residues]]:
        R, _, w, v = self.motion[row]
        w, v, g = (_to_frame(R, x) for x in (w, v, self.gravity))
        vw, gw = _cross(v, w), _cross(g, w)
        nothing = np.zeros(self.points, dtype=np.int64)

        def both(i: int, j: int) -> tuple[Residues, Residues]:
            return (w[i] * w[j] % PRIME * (1 if i == j else 2)) % PRIME, nothing

        rows = {"XX": both(0, 0), "XY": both(0, 1), "XZ": both(0, 2)}
        rows |= {"YY": both(1, 1), "YZ": both(1, 2), "ZZ": both(2, 2)}
        for i, name in enumerate(("MX", "MY", "MZ")):
            rows[name] = (2 * vw[i] % PRIME, -gw[i] % PRIME)
        rows["M"] = (_dot(v, v), -_dot(g, v) % PRIME)
        return rows


def power(value: Residues, n: int) -> Residues:
    """value**n modulo the prime."""
    result = np.ones_like(value)
    while n:
        if n & 1:
            result = result * value % PRIME
        value = value * value % PRIME
        n >>= 1
    return result


def inverse(value: Residues) -> Residues:
    """1 / value modulo the prime."""
    return power(value, PRIME - 2)


def _circle(t: Residues) -> tuple[Residues, Residues]:
    square = t * t % PRIME
    # 1 + t**2 is never 0: the prime is 3 modulo 4.
    scale = inverse((1 + square) % PRIME)
    return (1 - square) * scale % PRIME, 2 * t % PRIME * scale % PRIME


def _turn(R: list, axis: int, c: Residues, s: Residues) -> list:
    """R times the rotation by (c, s) about its own axis x (0) or z (2)."""
    i, j = (1, 2) if axis == 0 else (0, 1)
    out = [list(line) for line in R]
    for line in out:
        x, y = line[i], line[j]
        line[i], line[j] = (c * x + s * y % PRIME) % PRIME, (c * y - s * x % PRIME) % PRIME
    return out


def _shift(p: list, R: list, axis: int, length: Residues) -> list:
    return [(p[i] + R[i][axis] * length) % PRIME for i in range(3)]


def _plus(a: list, b: list) -> list:
    return [(x + y) % PRIME for x, y in zip(a, b, strict=True)]


def _cross(a: list, b: list) -> list:
    return [
        (a[(i + 1) % 3] * b[(i + 2) % 3] % PRIME - a[(i + 2) % 3] * b[(i + 1) % 3] % PRIME) % PRIME
        for i in range(3)
    ]


def _dot(a: list, b: list) -> Residues:
    return sum(x * y % PRIME for x, y in zip(a, b, strict=True)) % PRIME


def _to_frame(R: list, v: list) -> list:
    return [_dot([R[j][i] for j in range(3)], v) for i in range(3)]


def modular_rank(matrix: np.ndarray) -> int:
    """Rank modulo the prime."""
    left = matrix.copy() % PRIME
    rank = 0
    for column in range(left.shape[1]):
        having = np.nonzero(left[rank:, column])[0]
        if len(having) == 0:
            continue
        pivot = rank + int(having[0])
        left[[rank, pivot]] = left[[pivot, rank]]
        scale = pow(int(left[rank, column]), -1, PRIME)
        left[rank] = left[rank] * scale % PRIME
        below = left[rank + 1 :, column][:, None] * left[rank][None, :] % PRIME
        left[rank + 1 :] = (left[rank + 1 :] - below) % PRIME
        rank += 1
        if rank == left.shape[0]:
            break
    return rank
