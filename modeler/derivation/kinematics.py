"""Frames, joint axes and gravity by recursion from the base, over any algebra.

Everything is expressed in the link's own frame. Rotations are applied as their three plane
rotations, so that right angles cost nothing and general ones eight multiplications.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import sympy

from modeler.core.brief import Brief
from modeler.derivation.geometry import Geometry, GeometryRow, cos_sin
from modeler.derivation.graph import Algebra, Scalar, Vector


def cross(a: Vector, b: Vector) -> Vector:
    """a x b."""
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def dot(a: Vector, b: Vector) -> Scalar:
    """a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plus(a: Vector, b: Vector) -> Vector:
    """a + b."""
    return [x + y for x, y in zip(a, b, strict=True)]


def times(scalar: Scalar, a: Vector) -> Vector:
    """scalar * a."""
    return [scalar * x for x in a]


@dataclass(frozen=True)
class Pose(Brief):
    """Frame j in its antecedent frame: plane rotations and the position of its origin.

    R = Rz(gamma) Rx(alpha) Rz(theta), each as (cos, sin); `p` in the antecedent frame.
    """

    gamma: tuple[Scalar, Scalar]
    alpha: tuple[Scalar, Scalar]
    theta: tuple[Scalar, Scalar]
    p: Vector

    def to_link(self, v: Vector) -> Vector:
        """R^T v: from the antecedent frame to frame j."""
        return _turn_z(self.theta, _turn_x(self.alpha, _turn_z(self.gamma, v)))

    def to_antecedent(self, v: Vector) -> Vector:
        """R v: from frame j to the antecedent frame."""
        return _back_z(self.gamma, _back_x(self.alpha, _back_z(self.theta, v)))


def _turn_z(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]]


def _back_z(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]]


def _turn_x(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [v[0], c * v[1] + s * v[2], c * v[2] - s * v[1]]


def _back_x(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]]


def pose(row: GeometryRow, algebra: Algebra) -> Pose:
    """Pose of frame j in its antecedent, T = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r)."""
    gamma = _static_rotation(row.gamma, algebra)
    alpha = _static_rotation(row.alpha, algebra)
    d, b = algebra.static(row.d), algebra.static(row.b)
    prismatic = row.index is not None and not row.joint.angular
    r = algebra.variable(row) if prismatic else algebra.static(row.r)
    p = _back_z(gamma, plus(_back_x(alpha, [d, d * 0, r]), [b * 0, b * 0, b]))
    return Pose(gamma, alpha, algebra.cos_sin(row), p)


def _static_rotation(angle: sympy.Expr, algebra: Algebra) -> tuple[Scalar, Scalar]:
    c, s = cos_sin(angle)
    return algebra.static(c), algebra.static(s)


def poses(geometry: Geometry, algebra: Algebra) -> list[Pose]:
    """Pose of every row in its antecedent."""
    return [pose(row, algebra) for row in geometry.rows]


def unit_z(algebra: Algebra) -> Vector:
    """The joint axis in its own frame."""
    zero = algebra.static(sympy.Integer(0))
    return [zero, zero, algebra.static(sympy.Integer(1))]


@dataclass(frozen=True)
class Screw(Brief):
    """Twist of link k for unit speed of one joint, in frame k: rotation e, velocity m of O_k."""

    e: Vector
    m: Vector


def screws(geometry: Geometry, frames: Sequence[Pose], algebra: Algebra) -> list[dict[int, Screw]]:
    """For every row k, the screw of each joint that moves it, by variable index.

    The screw is both the column of the Jacobian of link k in its own frame and the projector of a
    force f and moment n at O_k on the joint: tau = e.n + m.f.
    """
    zero = algebra.static(sympy.Integer(0))
    found: list[dict[int, Screw]] = []
    for k, row in enumerate(geometry.rows):
        carried: dict[int, Screw] = {}
        if row.parent is not None:
            for index, screw in found[row.parent].items():
                moved = plus(screw.m, cross(screw.e, frames[k].p))
                carried[index] = Screw(frames[k].to_link(screw.e), frames[k].to_link(moved))
        if row.index is not None:
            axis = [x * row.rate for x in unit_z(algebra)]
            nothing = [zero, zero, zero]
            own = Screw(axis, nothing) if row.joint.angular else Screw(nothing, axis)
            carried[row.index] = own
        found.append(carried)
    return found


def gravity_in_frames(geometry: Geometry, frames: Sequence[Pose], algebra: Algebra) -> list[Vector]:
    """Acceleration of gravity in every frame."""
    base = [algebra.static(entry) for entry in geometry.gravity]
    found: list[Vector] = []
    for row, frame in zip(geometry.rows, frames, strict=True):
        found.append(frame.to_link(base if row.parent is None else found[row.parent]))
    return found


AxesOrigin = tuple[list[Vector], Vector]
"""Axes x, y, z of a frame, and its origin."""


def base_poses(geometry: Geometry, frames: Sequence[Pose], algebra: Algebra) -> list[AxesOrigin]:
    """Axes x, y, z of every frame and its origin, in frame 0: the forward kinematics.

    From the base outwards, R_j = R_a Rz(gamma) Rx(alpha) Rz(theta): each plane rotation turns two
    axes, and what one frame costs serves all that follow.
    """
    found: dict[int | None, AxesOrigin] = {None: _still(algebra)}
    for k, (row, frame) in enumerate(zip(geometry.rows, frames, strict=True)):
        found[k] = _carried(found[row.parent], frame)
    return [found[k] for k in range(len(frames))]


def poses_from(
    geometry: Geometry, frames: Sequence[Pose], algebra: Algebra, root: int | None, rows: set[int]
) -> dict[int | None, AxesOrigin]:
    """Axes and origins of some rows, and of all between them and `root`, in the frame of `root`.

    Args:
        geometry: the table.
        frames: its poses.
        algebra: of the entries.
        root: a row that all of `rows` descend from, or None for the base.
        rows: places in the table.
    """
    found: dict[int | None, AxesOrigin] = {root: _still(algebra)}
    needed = {k for row in rows for k in geometry.ancestors(row)}
    for k, (row, frame) in enumerate(zip(geometry.rows, frames, strict=True)):
        if k in needed and row.parent in found and k != root:
            found[k] = _carried(found[row.parent], frame)
    return found


def _still(algebra: Algebra) -> AxesOrigin:
    zero, one = algebra.static(sympy.Integer(0)), algebra.static(sympy.Integer(1))
    return [[one, zero, zero], [zero, one, zero], [zero, zero, one]], [zero] * 3


def _carried(parent: AxesOrigin, frame: Pose) -> AxesOrigin:
    """Axes and origin of a frame from those of its antecedent."""
    (x, y, z), origin = parent
    for axis, length in zip((x, y, z), frame.p, strict=True):
        origin = plus(origin, times(length, axis))
    x, y = _turned(frame.gamma, x, y)
    y, z = _turned(frame.alpha, y, z)
    x, y = _turned(frame.theta, x, y)
    return [x, y, z], origin


def _turned(angle: tuple[Scalar, Scalar], a: Vector, b: Vector) -> tuple[Vector, Vector]:
    """Two axes turned in their plane, a towards b."""
    c, s = angle
    return plus(times(c, a), times(s, b)), plus(times(c, b), times(-s, a))
