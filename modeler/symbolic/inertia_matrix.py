"""Joint inertia matrix by composite links, over any algebra (Khalil and Dombre 2002, 9.7.2)."""

from collections.abc import Mapping, Sequence
from typing import Any

from modeler.symbolic.algebra import Scalar, Vector
from modeler.symbolic.geometry import Geometry
from modeler.symbolic.kinematics import Pose, cross, plus, times
from modeler.symbolic.newton_euler import _INERTIA


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
