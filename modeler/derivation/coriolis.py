"""Coriolis matrix by composite links, over any algebra.

C is that of Christoffel symbols: of a body made of points, C = sum of m J^T dJ/dt over the points,
where J dq/dt is the velocity of the point. So C v is linear in v, C qd is the Coriolis torque, and
dM/dt = C + C^T. (Echeandia and Wensing 2021 compute the same by spatial vectors.)
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from modeler.derivation.geometry import Geometry, GeometryRow
from modeler.derivation.graph import Scalar, Vector, attach_labels, attach_matrix_labels
from modeler.derivation.kinematics import (
    Composite,
    Motion,
    Pose,
    compute_steiner_term,
    cross,
    dot,
    plus,
    times,
)


def cross_z(v: Vector) -> Vector:
    """Returns z x v."""
    return [-v[1], v[0], 0 * v[2]]


def project_on_axis(row: GeometryRow, force: Vector, moment: Vector) -> Scalar:
    """Returns torque of the row's joint under a force and a moment at its frame's origin."""
    return (moment if row.joint.is_revolute else force)[2] * row.rate


def compute_slide_velocity(row: GeometryRow, frame: Pose, speed: Scalar) -> Vector:
    """Returns velocity of the frame's origin in its antecedent, where its joint slides."""
    none = [0 * speed] * 3
    if row.index is None or row.joint.is_revolute:
        return none
    return frame.rotate_to_antecedent([*none[:2], speed])


class MovingComposite(Composite):
    """A link with all that it carries, and how that changes seen from the link.

    Attributes:
        MS_rate: d MS/dt, of the components in the link's frame; likewise
        J_rate: d J/dt.
        h: moment of momentum about the origin of what moves in the frame.
    """

    def __init__(self, parameters: Mapping[str, Any], zero: Scalar, link: str = "") -> None:
        super().__init__(parameters, zero, link)
        self.MS_rate: Vector = [zero] * 3
        self.J_rate: list[Vector] = [[zero] * 3 for _ in range(3)]
        self.h: Vector = [zero] * 3

    def compute_turned_rates(self, speed: Scalar) -> tuple[Vector, list[Vector], Vector]:
        """Returns MS_rate, J_rate and h seen from a frame in which the link turns about its z axis.

        d MS/dt += speed z x MS; d J/dt += speed ([z x] J - J [z x]); h += speed J z.
        """
        J = self.J
        turned = [
            [-2 * J[0][1], J[0][0] - J[1][1], -J[1][2]],
            [J[0][0] - J[1][1], 2 * J[0][1], J[0][2]],
            [-J[1][2], J[0][2], 0 * J[2][2]],
        ]
        rates = [plus(a, times(speed, b)) for a, b in zip(self.J_rate, turned, strict=True)]
        first = plus(self.MS_rate, times(speed, cross_z(self.MS)))
        h = plus(self.h, times(speed, [line[2] for line in J]))
        attach_matrix_labels("Jd", self.link, rates, "t")
        return (
            attach_labels("MSd", self.link, first, "t"),
            rates,
            attach_labels("hc", self.link, h, "t"),
        )

    def add_moving_composite(
        self, other: "MovingComposite", frame: Pose, row: GeometryRow, speed: Scalar
    ) -> None:
        """Adds what hangs on the row's frame, whose joint has this speed."""
        p, dp = frame.p, compute_slide_velocity(row, frame, speed)
        turning = speed if row.index is not None and row.joint.is_revolute else 0 * speed
        first, rates, h = other.compute_turned_rates(turning)
        S, dS = frame.rotate_to_antecedent(other.MS), frame.rotate_to_antecedent(first)
        shifted = plus(S, times(other.M, p))
        turned, zero = (
            attach_matrix_labels("Jd", other.link, frame.rotate_inertia(rates), "a"),
            0 * other.M,
        )
        for i in range(3):
            for j in range(3):
                moved = compute_steiner_term(p, dS, zero, i, j) + compute_steiner_term(
                    dp, shifted, zero, i, j
                )
                self.J_rate[i][j] = self.J_rate[i][j] + turned[i][j] + moved
        self.h = plus(
            plus(self.h, frame.rotate_to_antecedent(h)), plus(cross(p, dS), cross(shifted, dp))
        )
        self.MS_rate = plus(self.MS_rate, plus(dS, times(other.M, dp)))
        attach_labels("MSd", self.link, self.MS_rate), attach_labels("hc", self.link, self.h)
        attach_matrix_labels("Jd", self.link, self.J_rate)
        self.add_composite(other, frame)

    def compute_column(self, row: GeometryRow, w: Vector) -> tuple[Vector, Vector]:
        """Returns force and moment per unit of v of the joint: sum of m dJ/dt and m r x dJ/dt.

        With z the axis, f = z x d MS/dt + w x (z x MS) and
        n = (d J/dt z + z x h)/2 + z x (J w) - tr(J)/2 z x w for a joint that turns.
        """
        spun = times(row.rate, cross_z(w))  # z x w
        if not row.joint.is_revolute:
            f = times(self.M, [-x for x in spun])
            return f, cross(spun, self.MS)
        f = plus(cross_z(self.MS_rate), cross(w, cross_z(self.MS)))
        Jw = [dot(line, w) for line in self.J]
        n = plus(self._compute_half_rate(cross_z(self.h)), cross_z(Jw))
        return times(row.rate, f), plus(times(row.rate, n), times(-self._halve_trace(), spun))

    def compute_arm_rate(self, row: GeometryRow, w: Vector) -> Vector:
        """Returns the moment of the changing arms: sum of m dr/dt x J for unit speed of the joint.

        (d J/dt z - z x h)/2 + tr(J)/2 w x z - J (w x z) for a joint that turns.
        """
        spun = times(-row.rate, cross_z(w))  # w x z
        if not row.joint.is_revolute:
            h = plus(self.MS_rate, cross(w, self.MS))
            return times(-row.rate, cross_z(h))
        n = self._compute_half_rate([-x for x in cross_z(self.h)])
        turned = [-dot(line, spun) for line in self.J]
        return plus(times(row.rate, n), plus(times(self._halve_trace(), spun), turned))

    def _compute_half_rate(self, h: Vector) -> Vector:
        return times(Fraction(1, 2), plus([line[2] for line in self.J_rate], h))

    def _halve_trace(self) -> Scalar:
        return (self.J[0][0] + self.J[1][1] + self.J[2][2]) * Fraction(1, 2)


def compute_coriolis_matrix(
    geometry: Geometry, frames: Sequence[Pose], moved: Sequence[Motion], speeds: Sequence[Scalar],
    parameters: Sequence[Mapping[str, Any]], zero: Scalar,
) -> list[list[Scalar]]:  # fmt: skip
    """Returns C(q, qd) of the rigid links, (joints, joints).

    Args:
        geometry: the table.
        frames: poses of the rows.
        moved: motions of the rows' links, of which the angular velocities are read.
        speeds: of the joints.
        parameters: per row, the inertial parameters that are not zero.
        zero: the algebra's zero.
    """
    links = [
        MovingComposite(p, zero, row.joint.name)
        for p, row in zip(parameters, geometry.rows, strict=True)
    ]
    at_rest = [zero] * 3
    arms: list[Vector] = []  # how fast p turns and grows
    for row, frame in zip(geometry.rows, frames, strict=True):
        w = at_rest if row.parent is None else moved[row.parent].w
        arms.append(
            plus(
                cross(w, frame.p),
                compute_slide_velocity(row, frame, _get_joint_speed(row, speeds, zero)),
            )
        )
    matrix = [[zero] * geometry.joint_count for _ in range(geometry.joint_count)]
    for k in reversed(range(len(links))):
        row = geometry.rows[k]
        if row.index is not None:
            _fill_column(matrix, geometry, frames, moved, arms, links[k], k)
        if row.parent is not None:
            speed = _get_joint_speed(row, speeds, zero)
            links[row.parent].add_moving_composite(links[k], frames[k], row, speed)
    return matrix


def _get_joint_speed(row: GeometryRow, speeds: Sequence[Scalar], zero: Scalar) -> Scalar:
    return zero if row.index is None else speeds[row.index] * row.rate


def _fill_column(
    matrix: list[list[Scalar]], geometry: Geometry, frames: Sequence[Pose],
    moved: Sequence[Motion], arms: Sequence[Vector], link: MovingComposite, k: int,
) -> None:  # fmt: skip
    """Column of joint k in the rows of the joints below, and its row in their columns.

    With F, N the force and moment of column k, C_ik = z_i . N of joints i that turn. With f, n the
    momentum of unit speed of joint k and a that of its arms' change, carried to frame i,
    C_ki = (w_i x z_i) . n + z_i . a: what M'_ki = C_ki + C_ik leaves.
    """
    row = geometry.rows[k]
    assert row.index is not None
    F, N = link.compute_column(row, moved[k].w)
    f, n = link.compute_momentum(row)
    a, name = link.compute_arm_rate(row, moved[k].w), row.joint.name
    (
        attach_labels("fu", name, F, of=name),
        attach_labels("nu", name, N, of=name),
        attach_labels("angd", name, a, of=name),
    )
    for at in geometry.find_ancestors(k):
        other = geometry.rows[at]
        if other.index is not None:
            matrix[other.index][row.index] = project_on_axis(other, F, N)
            if at != k:
                (x, y, _), momentum = moved[at].w, n if other.joint.is_revolute else f
                turning = y * momentum[0] - x * momentum[1]
                along = turning + a[2] if other.joint.is_revolute else turning
                matrix[row.index][other.index] = along * other.rate
        frame = frames[at]
        F, f = frame.rotate_to_antecedent(F), frame.rotate_to_antecedent(f)
        N = plus(frame.rotate_to_antecedent(N), cross(frame.p, F))
        n = plus(frame.rotate_to_antecedent(n), cross(frame.p, f))
        a = plus(frame.rotate_to_antecedent(a), cross(arms[at], f))
        for letter, vector in (("fu", F), ("nu", N), ("lin", f), ("ang", n), ("angd", a)):
            attach_labels(letter, other.joint.name, vector, "a", row.joint.name)
