"""Newton-Euler in screw form: regressor columns and inverse dynamics, over any algebra.

Khalil and Dombre 2002, section 9.5 (recursion) and 9.6 (regressor). The base accelerates with -g,
which makes gravity part of the acceleration of every link.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from modeler.derivation.geometry import Geometry, GeometryRow
from modeler.derivation.graph import Algebra, Scalar, Vector
from modeler.derivation.kinematics import Pose, Screw, cross, dot, plus, times


@dataclass(frozen=True)
class Motion:
    """Motion of a link in its own frame.

    Attributes:
        w: angular velocity, rad/s.
        wd: angular acceleration, rad/s2.
        vd: acceleration of the origin minus gravity, m/s2.
        U: [wd x] + [w x][w x], rows of three.
    """

    w: Vector
    wd: Vector
    vd: Vector
    U: list[Vector]


@dataclass(frozen=True)
class MotionState:
    """Joint speeds and accelerations, gravity in frame 0; zero where they are left out."""

    qd: Sequence[Scalar]
    qdd: Sequence[Scalar]
    gravity: Vector


def motions(
    geometry: Geometry, frames: Sequence[Pose], state: MotionState, algebra: Algebra
) -> list[Motion]:
    """Motion of every row's link."""
    zero = algebra.static(sympy.Integer(0))
    base = Motion([zero] * 3, [zero] * 3, [-g for g in state.gravity], [[zero] * 3] * 3)
    found: list[Motion] = []
    for row, frame in zip(geometry.rows, frames, strict=True):
        found.append(_next(base if row.parent is None else found[row.parent], row, frame, state))
    return found


def _next(a: Motion, row: GeometryRow, frame: Pose, state: MotionState) -> Motion:
    w, wd = frame.to_link(a.w), frame.to_link(a.wd)
    vd = frame.to_link(plus(a.vd, [dot(line, frame.p) for line in a.U]))
    if row.index is not None:
        qd, qdd = state.qd[row.index] * row.rate, state.qdd[row.index] * row.rate
        if row.joint.angular:
            wd = [wd[0] + w[1] * qd, wd[1] - w[0] * qd, wd[2] + qdd]
            w = [w[0], w[1], w[2] + qd]
        else:
            vd = [vd[0] + 2 * (w[1] * qd), vd[1] - 2 * (w[0] * qd), vd[2] + qdd]
    return Motion(w, wd, vd, _U(w, wd))


def _U(w: Vector, wd: Vector) -> list[Vector]:
    xx, yy, zz = w[0] * w[0], w[1] * w[1], w[2] * w[2]
    xy, xz, yz = w[0] * w[1], w[0] * w[2], w[1] * w[2]
    return [
        [-(yy + zz), xy - wd[2], xz + wd[1]],
        [xy + wd[2], -(xx + zz), yz - wd[0]],
        [xz - wd[1], yz + wd[0], -(xx + yy)],
    ]


def wrench_columns(motion: Motion) -> dict[str, tuple[Vector, Vector]]:
    """(force, moment at the origin) that one unit of each inertial parameter needs, in its frame.

    f = M vd + U MS and n = J wd + w x (J w) + MS x vd, where
    J = [[XX, XY, XZ], [XY, YY, YZ], [XZ, YZ, ZZ]].
    """
    w, wd, vd, U = motion.w, motion.wd, motion.vd, motion.U
    zero = 0 * vd[0]
    none = [zero, zero, zero]
    yz, xz, xy = w[1] * w[2], w[0] * w[2], w[0] * w[1]
    return {
        "XX": (none, [wd[0], xz, -xy]),
        "XY": (none, [-U[2][0], U[2][1], U[0][0] - U[1][1]]),
        "XZ": (none, [U[1][0], U[2][2] - U[0][0], -U[1][2]]),
        "YY": (none, [-yz, wd[1], xy]),
        "YZ": (none, [U[1][1] - U[2][2], -U[0][1], U[0][2]]),
        "ZZ": (none, [yz, -xz, wd[2]]),
        "MX": ([U[0][0], U[1][0], U[2][0]], [zero, -vd[2], vd[1]]),
        "MY": ([U[0][1], U[1][1], U[2][1]], [vd[2], zero, -vd[0]]),
        "MZ": ([U[0][2], U[1][2], U[2][2]], [-vd[1], vd[0], zero]),
        "M": (vd, none),
    }


def project(screw: Screw, force: Vector, moment: Vector) -> Scalar:
    """Torque of a joint under a force and a moment at O_k: e.n + m.f."""
    return dot(screw.e, moment) + dot(screw.m, force)


def inverse_dynamics(
    geometry: Geometry,
    frames: Sequence[Pose],
    moved: Sequence[Motion],
    parameters: Sequence[Mapping[str, Any]],
    zero: Scalar,
) -> list[Scalar]:
    """Torques of the rigid links by the backward recursion.

    Args:
        geometry: the table.
        frames: poses of the rows.
        moved: motions of the rows.
        parameters: per row, the inertial parameters that are not zero.
        zero: the algebra's zero.

    Returns:
        (joints,) torques in N m, forces in N.
    """
    count = len(geometry.rows)
    forces: list[Vector] = [[zero] * 3 for _ in range(count)]
    moments: list[Vector] = [[zero] * 3 for _ in range(count)]
    tau = [zero] * geometry.joints
    for k in reversed(range(count)):
        row = geometry.rows[k]
        f, n = link_wrench(moved[k], parameters[k], zero)
        forces[k], moments[k] = plus(forces[k], f), plus(moments[k], n)
        if row.index is not None:
            along = moments[k] if row.joint.angular else forces[k]
            tau[row.index] = along[2] * row.rate
        if row.parent is not None:
            f = frames[k].to_antecedent(forces[k])
            n = plus(frames[k].to_antecedent(moments[k]), cross(frames[k].p, f))
            forces[row.parent] = plus(forces[row.parent], f)
            moments[row.parent] = plus(moments[row.parent], n)
    return tau


def link_wrench(
    motion: Motion, parameters: Mapping[str, Any], zero: Scalar
) -> tuple[Vector, Vector]:
    """Force and moment at the origin that a link needs: Newton and Euler."""
    J = [[parameters.get(name, zero) for name in line] for line in _INERTIA]
    MS = [parameters.get(name, zero) for name in ("MX", "MY", "MZ")]
    f = plus(times(parameters.get("M", zero), motion.vd), [dot(line, MS) for line in motion.U])
    Jw = [dot(line, motion.w) for line in J]
    n = plus([dot(line, motion.wd) for line in J], cross(motion.w, Jw))
    return f, plus(n, cross(MS, motion.vd))


_INERTIA = (("XX", "XY", "XZ"), ("XY", "YY", "YZ"), ("XZ", "YZ", "ZZ"))


# Joint inertia matrix by composite links, over any algebra (Khalil and Dombre 2002, 9.7.2).


class Composite:
    """Mass, first moments and inertia (at its frame's origin) of a link and all that it carries."""

    def __init__(self, parameters: Mapping[str, Any], zero: Scalar) -> None:
        self.M: Scalar = parameters.get("M", zero)
        self.MS: Vector = [parameters.get(name, zero) for name in ("MX", "MY", "MZ")]
        self.J: list[Vector] = [[parameters.get(n, zero) for n in line] for line in _INERTIA]

    def carry(self, other: "Composite", frame: Pose) -> None:
        """Add what hangs on `frame`, moved to this link's frame.

        J += R J R^T + 2 (p.S) 1 - p S^T - S p^T + M (p.p 1 - p p^T) with S = R MS.
        """
        p, S = frame.p, frame.to_antecedent(other.MS)
        half = [frame.to_antecedent(line) for line in other.J]
        turned = [frame.to_antecedent([half[0][i], half[1][i], half[2][i]]) for i in range(3)]
        for i in range(3):
            for j in range(3):
                self.J[i][j] = self.J[i][j] + turned[i][j] + _steiner(p, S, other.M, i, j)
        self.MS = plus(self.MS, plus(S, times(other.M, p)))
        self.M = self.M + other.M


def _steiner(p: Vector, S: Vector, M: Scalar, i: int, j: int) -> Scalar:
    total = -(p[i] * S[j] + S[i] * p[j] + M * (p[i] * p[j]))
    if i == j:
        for k in range(3):
            total = total + 2 * (p[k] * S[k]) + M * (p[k] * p[k])
    return total


def inertia_matrix(
    geometry: Geometry,
    frames: Sequence[Pose],
    parameters: Sequence[Mapping[str, Any]],
    zero: Scalar,
) -> list[list[Scalar]]:
    """M(q) of the rigid links, (joints, joints), symmetric by construction.

    Args:
        geometry: the table.
        frames: poses of the rows.
        parameters: per row, the inertial parameters that are not zero.
        zero: the algebra's zero.
    """
    links = [Composite(p, zero) for p in parameters]
    matrix = [[zero] * geometry.joints for _ in range(geometry.joints)]
    for k in reversed(range(len(links))):
        row = geometry.rows[k]
        if row.index is not None:
            _fill(matrix, geometry, frames, links[k], k)
        if row.parent is not None:
            links[row.parent].carry(links[k], frames[k])
    return matrix


def _fill(
    matrix: list[list[Scalar]],
    geometry: Geometry,
    frames: Sequence[Pose],
    link: Composite,
    k: int,
) -> None:
    row = geometry.rows[k]
    assert row.index is not None
    z = [axis * row.rate for axis in (0, 0, 1)]
    if row.joint.angular:
        f, n = (
            [row.rate * x for x in (-link.MS[1], link.MS[0], 0 * link.M)],
            [line[2] * row.rate for line in link.J],
        )
    else:
        f, n = (
            [link.M * x for x in z],
            [row.rate * x for x in (link.MS[1], -link.MS[0], 0 * link.M)],
        )
    for at in geometry.ancestors(k):
        other = geometry.rows[at]
        if other.index is not None:
            along = (n if other.joint.angular else f)[2] * other.rate
            matrix[row.index][other.index] = along
            matrix[other.index][row.index] = along
        f = frames[at].to_antecedent(f)
        n = plus(frames[at].to_antecedent(n), cross(frames[at].p, f))
