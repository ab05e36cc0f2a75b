"""Exact grouping of serial and tree robots, link by link.

A combination of standard parameters has no effect on the torques if and only if it adds nothing to
the energy rows: twice the kinetic energy and the power of gravity, as functions of the joint
positions and speeds (the equations of Lagrange give no torque exactly then). For a tree these
functions are sums over links, and a leaf's variable occurs in its own link only. So a combination
of the leaf's parameters can be hidden by the others if and only if its energy rows do not depend on
the leaf's variable and speed; then it equals a combination of the antecedent's parameters, the
leaf is cut off, and the argument repeats. All conditions are linear over the exact field: no
sampling, no trigonometric expansion.

What has to be known of the antecedent is which linear functions of its energy rows, of its twist
and of its gravity vector vanish identically. These three spaces follow by recursion from the base,
where twist and energy are zero and gravity is constant.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass

from modeler.derivation.elimination import null_space, row_reduce
from modeler.derivation.field import Element, ExactField
from modeler.derivation.geometry import Geometry, GeometryRow
from modeler.derivation.transfer import (
    Constant,
    Matrix,
    apply,
    inertial_transfer,
    joint_constant,
    joint_motion,
    placement,
    product,
    transferred,
)

INERTIA, OFFSET = 10, 11
"""Places of the rotor inertia and of the offset after the ten inertial parameters."""


@dataclass(frozen=True)
class Reach:
    """Which linear functions vanish for all motions of a frame: kernels of these matrices.

    Attributes:
        energy: (., 10) E.c = 0 for all motions iff energy c = 0; E are the frame's energy rows.
        twist: (., 6) the same for v.a + w.b.
        gravity: (., 4) the same for g.u + k.
    """

    energy: Matrix
    twist: Matrix
    gravity: Matrix


@dataclass(frozen=True)
class LinkGrouping:
    """What of one link's parameters another link hides.

    Attributes:
        hidden: basis of the combinations (10 inertial, rotor inertia, offset) of the link that do
            not depend on its own joint, as rows.
        moved: the same combinations as parameters of the antecedent frame, as rows of 10.
    """

    hidden: Matrix
    moved: Matrix


def group_tree(
    geometry: Geometry, K: ExactField, joint_columns: Collection[tuple[int, int]]
) -> list[LinkGrouping]:
    """For every row of the table, what its antecedent hides of it.

    Args:
        geometry: the table.
        K: its field.
        joint_columns: which (row, INERTIA) and (row, OFFSET) the robot has.
    """
    reaches: list[Reach] = []
    groupings: list[LinkGrouping] = []
    for k, row in enumerate(geometry.rows):
        base = _base_reach(geometry, K) if row.parent is None else reaches[row.parent]
        step = _TreeStep(row, K, base)
        absent = [i for i in (INERTIA, OFFSET) if (k, i) not in joint_columns]
        groupings.append(step.grouping(absent))
        reaches.append(step.reach())
    return groupings


def _base_reach(geometry: Geometry, K: ExactField) -> Reach:
    return Reach([], [], [[*(K.element(g) for g in geometry.gravity), K.one]])


class _TreeStep:
    """One joint: from the reach of the antecedent to the grouping and the reach of the link.

    The conditions are written for the parameters at the frame that moves with the joint, before the
    constant part of its placement. Once the antecedent moves in every way, which is so from the
    third or fourth joint on, they hold rational numbers only.
    """

    def __init__(self, row: GeometryRow, K: ExactField, antecedent: Reach) -> None:
        self.K, self.row = K, row
        self.fixed_part = placement(row, K)
        self.before = _through(antecedent, self.fixed_part, K)
        self.constant = joint_constant(row, K)
        self.motion = joint_motion(row.joint.angular) if row.index is not None else ()

    def grouping(self, absent: list[int]) -> LinkGrouping:
        """What the antecedent hides; `absent` are the joint columns that the robot has not."""
        K = self.K
        if not self.motion:
            return LinkGrouping([], [])
        rows = self._motion_rows(with_joint_columns=True)
        for L, _ in self.motion[1:]:
            rows += self._pad(product(self.before.energy, L, K.zero))
        rows += [[K.one if i == j else K.zero for i in range(12)] for j in absent]
        found = null_space(rows, 12, K.zero, K.one)
        steady = [apply(self.motion[0][0], line[:10], K.zero) for line in found]
        back = self.constant.inverse(K)
        return LinkGrouping(
            [[*transferred(back, line[:10], K), *line[10:]] for line in found],
            [transferred(self.fixed_part, line, K) for line in steady],
        )

    def reach(self) -> Reach:
        """What vanishes identically of the link's own motion."""
        K = self.K
        if not self.motion:
            return _through(self.before, self.constant, K)
        energy = [line[:10] for line in self._motion_rows(with_joint_columns=False)]
        twist: Matrix = [[K.one if i == self._own_speed else K.zero for i in range(6)]]
        gravity: Matrix = []
        for m, (L, X) in enumerate(self.motion):
            energy += product(self.before.energy, L, K.zero)
            twist += product(self.before.twist, X, K.zero)
            R = [[*line[:3], K.zero] for line in X[:3]]
            R.append([K.zero, K.zero, K.zero, K.one if m == 0 else K.zero])
            gravity += product(self.before.gravity, R, K.zero)
        own = Reach(row_reduce(energy)[0], row_reduce(twist)[0], row_reduce(gravity)[0])
        return _through(own, self.constant, K)

    @property
    def _own_speed(self) -> int:
        return 5 if self.row.joint.angular else 2

    def _pad(self, rows: Matrix) -> Matrix:
        return [[*line, self.K.zero, self.K.zero] for line in rows]

    def _motion_rows(self, with_joint_columns: bool) -> Matrix:
        """Conditions that nothing depends on the joint speed: terms in qd**2 and qd."""
        K, rows = self.K, []
        for m, (L, _) in enumerate(self.motion):
            own, momentum, pull = _speed_terms(L, self.row.joint.angular, K.zero)
            here = K.one if m == 0 and with_joint_columns else K.zero
            rows.append([*own, here, K.zero])
            # The offset's power is tau qd, the links' speed along z is rate * qd.
            offset = here * self.row.rate
            rows += self._pad(product(self.before.twist, momentum, K.zero))
            rows += product(
                self.before.gravity,
                [[*line, K.zero, K.zero] for line in pull] + [[K.zero] * 11 + [offset]],
                K.zero,
            )
        return [line for line in rows if any(line)]


def _speed_terms(
    carried: Matrix, angular: bool, zero: Element
) -> tuple[list[Element], Matrix, Matrix]:
    """Energy rows of a link whose joint adds qd z to its twist, as functions of its parameters.

    Returns:
        (10,) coefficient of qd**2 in 2T; (6, 10) of 2 qd in 2T as a function of (v, w); (3, 10) of
        qd in the power of gravity as a function of g.
    """
    XZ, YZ, ZZ, MX, MY, M = (carried[i] for i in (2, 4, 5, 6, 7, 9))
    none = [zero] * len(M)
    if angular:
        return ZZ, [_minus(MY), MX, none, XZ, YZ, ZZ], [MY, _minus(MX), none]
    return M, [none, none, M, MY, _minus(MX), none], [none, none, _minus(M)]


def _minus(line: list[Element]) -> list[Element]:
    return [-x for x in line]


def _through(reach: Reach, step: Constant, K: ExactField) -> Reach:
    """The reach of a frame posed at (R, p) on a frame: what vanishes, told in its coordinates."""
    return Reach(
        _told(reach.energy, 10, lambda: inertial_transfer(step.R, step.p, K.zero, K.one), K),
        _told(reach.twist, 6, lambda: _twist_transfer(step, K), K),
        _told(reach.gravity, 4, lambda: _gravity_transfer(step, K), K),
    )


def _told(rows: Matrix, width: int, transfer: Callable[[], Matrix], K: ExactField) -> Matrix:
    """Rows in the coordinates of the next frame; where all vanish there is nothing to compute."""
    if len(rows) == width:
        return rows
    return product(rows, transfer(), K.zero) if rows else []


def _twist_transfer(step: Constant, K: ExactField) -> Matrix:
    # a.v' + b.w' with v' = R^T (v + w x p), w' = R^T w is (R a).v + (R b + p x R a).w.
    R, p = step.R, step.p
    lower = [
        [p[(i + 1) % 3] * R[(i + 2) % 3][j] - p[(i + 2) % 3] * R[(i + 1) % 3][j] for j in range(3)]
        for i in range(3)
    ]
    return [[*line, K.zero, K.zero, K.zero] for line in R] + [[*lower[i], *R[i]] for i in range(3)]


def _gravity_transfer(step: Constant, K: ExactField) -> Matrix:
    return [[*line, K.zero] for line in step.R] + [[K.zero, K.zero, K.zero, K.one]]
