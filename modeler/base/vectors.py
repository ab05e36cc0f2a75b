"""Vectors and rotations whose entries are residues, by random point: see `residues`."""

from collections.abc import Sequence

from modeler.base.residues import Residues

Vector = Sequence[Residues]
"""Three entries."""
Rotation = Sequence[Vector]
"""Three lines; its columns are the axes of a frame."""


def plus(a: Vector, b: Vector, prime: int) -> list[Residues]:
    """a + b."""
    return [(x + y) % prime for x, y in zip(a, b, strict=True)]


def minus(a: Vector, b: Vector, prime: int) -> list[Residues]:
    """a - b."""
    return [(x - y) % prime for x, y in zip(a, b, strict=True)]


def cross(a: Vector, b: Vector, prime: int) -> list[Residues]:
    """a x b."""
    return [
        (a[(i + 1) % 3] * b[(i + 2) % 3] % prime - a[(i + 2) % 3] * b[(i + 1) % 3] % prime) % prime
        for i in range(3)
    ]


def dot(a: Vector, b: Vector, prime: int) -> Residues:
    """a . b."""
    (x, y, z), (u, v, w) = a, b
    return (x * u % prime + y * v % prime + z * w % prime) % prime


def in_axes(R: Rotation, v: Vector, prime: int) -> list[Residues]:
    """R^T v: the components of v along the axes of R."""
    return [dot([R[j][i] for j in range(3)], v, prime) for i in range(3)]


def turn(R: Rotation, axis: int, c: Residues, s: Residues, prime: int) -> list[list[Residues]]:
    """R times the rotation by (c, s) about its own axis x (0) or z (2)."""
    i, j = (1, 2) if axis == 0 else (0, 1)
    out = [list(line) for line in R]
    for line in out:
        x, y = line[i], line[j]
        line[i] = (c * x % prime + s * y % prime) % prime
        line[j] = (c * y % prime - s * x % prime) % prime
    return out


def shift(p: Vector, R: Rotation, axis: int, length: Residues, prime: int) -> list[Residues]:
    """The point p moved along an axis of R."""
    return [(p[i] + R[i][axis] * length % prime) % prime for i in range(3)]
