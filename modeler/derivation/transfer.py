"""How inertial parameters, twists and gravity pass through a joint, over the exact field.

A link's ten parameters at frame j are carried to the frame before the joint motion, in which they
are polynomials in (cos, sin) of a rotation or in the travel of a prismatic joint, and from there by
a constant transformation to the antecedent. Khalil and Dombre 2002, section 9.4.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import sympy
from sympy import QQ

from modeler.derivation.field import Element, ExactField, times
from modeler.derivation.geometry import GeometryRow

Matrix = list[list[Element]]
"""Rows of equal length."""

_J = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


def product(a: Matrix, b: Matrix, zero: Element) -> Matrix:
    """a b."""
    columns = list(zip(*b, strict=True))
    return [[_dot(line, column, zero) for column in columns] for line in a]


def _dot(a: Sequence[Element], b: Sequence[Element], zero: Element) -> Element:
    total = zero
    for x, y in zip(a, b, strict=True):
        if x and y:
            total = total + times(x, y)
    return total


def apply(a: Matrix, v: Sequence[Element], zero: Element) -> list[Element]:
    """a v."""
    return [_dot(line, v, zero) for line in a]


def inertial_transfer(R: Matrix, p: Sequence[Element], zero: Element, one: Element) -> Matrix:
    """10 x 10: a body's parameters at a frame posed at (R, p) -> those at the origin."""
    units = [[one if i == j else zero for j in range(10)] for i in range(10)]
    columns = [_moved(R, p, unit, zero) for unit in units]
    return [list(line) for line in zip(*columns, strict=True)]


def _moved(R: Matrix, p: Sequence[Element], c: Sequence[Element], zero: Element) -> list[Element]:
    """MS' = S + M p and J' = R J R^T + 2 (p.S) 1 - p S^T - S p^T + M (p.p 1 - p p^T), S = R MS."""
    # Most combinations hold few of the ten: what is 0 is not multiplied out.
    M = c[9]
    S = apply(R, c[6:9], zero) if any(c[6:9]) else [zero] * 3
    if any(c[:6]):
        J = [[c[0], c[1], c[2]], [c[1], c[3], c[4]], [c[2], c[4], c[5]]]
        half = product(R, J, zero)
        turned = [_dot(half[i], R[j], zero) for i, j in _J]
    else:
        turned = [zero] * 6
    if not (M or any(S)) or not any(p):
        return [*turned, *S, M]
    spread = 2 * _dot(p, S, zero) + M * (_dot(p, p, zero) if M else zero)
    out = []
    for (i, j), value in zip(_J, turned, strict=True):
        if any(S):
            value = value - p[i] * S[j] - S[i] * p[j]
        if M:
            value = value - M * p[i] * p[j]
        out.append(value + spread if i == j else value)
    return out + [S[i] + M * p[i] for i in range(3)] + [M]


def rotation_z(c: Element, s: Element, zero: Element, one: Element) -> Matrix:
    """Rz as a matrix."""
    return [[c, -s, zero], [s, c, zero], [zero, zero, one]]


def rotation_x(c: Element, s: Element, zero: Element, one: Element) -> Matrix:
    """Rx as a matrix."""
    return [[one, zero, zero], [zero, c, -s], [zero, s, c]]


@dataclass(frozen=True)
class Constant:
    """A constant placement: R and p."""

    R: Matrix
    p: list[Element]

    def inverse(self, K: ExactField) -> "Constant":
        """R^T and -R^T p."""
        back = [list(column) for column in zip(*self.R, strict=True)]
        return Constant(back, [-x for x in apply(back, self.p, K.zero)])


def transferred(step: Constant, parameters: Sequence[Element], K: ExactField) -> list[Element]:
    """Ten parameters at a frame posed at `step`, as the same body's parameters at the origin."""
    return _moved(step.R, step.p, parameters, K.zero)


def placement(row: GeometryRow, K: ExactField) -> Constant:
    """Rz(gamma) Tz(b) Rx(alpha) Tx(d): the antecedent to the frame before the joint motion."""
    zero, one = K.zero, K.one
    gamma = rotation_z(*K.cos_sin(row.gamma), zero, one)
    alpha = rotation_x(*K.cos_sin(row.alpha), zero, one)
    R = product(gamma, alpha, zero)
    p = apply(R, [K.element(row.d), zero, zero], zero)
    return Constant(R, [p[0], p[1], p[2] + K.element(row.b)])


def joint_constant(row: GeometryRow, K: ExactField) -> Constant:
    """The constant part that commutes with the joint motion: Tz(r) or Rz(theta), or both."""
    zero, one = K.zero, K.one
    turns = row.index is not None and row.joint.angular
    slides = row.index is not None and not row.joint.angular
    c, s = (one, zero) if turns else K.cos_sin(row.theta)
    r = zero if slides else K.element(row.r)
    return Constant(rotation_z(c, s, zero, one), [zero, zero, r])


@lru_cache(maxsize=2)
def joint_motion(angular: bool) -> tuple[tuple[Matrix, Matrix], ...]:
    """The joint motion as a sum over its basis functions, the constant one first; over Q.

    Revolute: 1, c, s, c**2, cs of the rotation; prismatic: 1, r, r**2 of the travel.

    Returns:
        For each basis function (L, X): L (10, 10) acts on parameters, X (6, 6) on the coefficients
        of a linear function of the twist (v, w); both bring them to the frame before the motion.
    """
    points = _TURNS if angular else _SLIDES
    basis = _turn_basis if angular else _slide_basis
    samples = [_turned(*x) if angular else _slid(*x) for x in points]
    # The entries are polynomials of the basis: solve for their coefficients from sample points.
    system = sympy.Matrix([basis(*x) for x in points]).inv()
    found = []
    for m in range(len(points)):
        weights = [QQ(int(w.p), int(w.q)) for w in system[m, :]]
        found.append(
            (
                _weighted([s[0] for s in samples], weights),
                _weighted([s[1] for s in samples], weights),
            )
        )
    return tuple(found)


# Rational points of the unit circle, as many as basis functions.
_TURNS = (
    (QQ(1), QQ(0)), (QQ(0), QQ(1)), (QQ(-1), QQ(0)), (QQ(3, 5), QQ(4, 5)), (QQ(4, 5), QQ(3, 5)),
)  # fmt: skip
_SLIDES = ((QQ(0),), (QQ(1),), (QQ(-1),))


def _turn_basis(c: Element, s: Element) -> list[Element]:
    return [QQ(1), c, s, c**2, c * s]


def _slide_basis(r: Element) -> list[Element]:
    return [QQ(1), r, r**2]


def _turned(c: Element, s: Element) -> tuple[Matrix, Matrix]:
    R = rotation_z(c, s, QQ(0), QQ(1))
    nothing = [QQ(0)] * 3
    X = [line + nothing for line in R] + [nothing + line for line in R]
    return inertial_transfer(R, nothing, QQ(0), QQ(1)), X


def _slid(r: Element) -> tuple[Matrix, Matrix]:
    X = [[QQ(int(i == j)) for j in range(6)] for i in range(6)]
    # a.v + b.w of the moved frame, where v = v' + w' x (0, 0, r): b' = b + (0, 0, r) x a.
    X[3][1], X[4][0] = -r, r
    R = rotation_z(QQ(1), QQ(0), QQ(0), QQ(1))
    return inertial_transfer(R, [QQ(0), QQ(0), r], QQ(0), QQ(1)), X


def _weighted(matrices: list[Matrix], weights: list[Element]) -> Matrix:
    size = range(len(matrices[0]))
    return [
        [sum((m[i][j] * w for m, w in zip(matrices, weights, strict=True)), QQ(0)) for j in size]
        for i in size
    ]
