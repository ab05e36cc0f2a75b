"""The table in numbers: every cell a constant, or a constant and a coefficient of the variable."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.robot import Joint, JointKind, Robot, extract_linear_form

BASE = -1
"""Number of the base among the rows."""

_CELLS = ("gamma", "b", "alpha", "d", "theta", "r")


@dataclass(frozen=True)
class SkeletonRow(ShortRepr):
    """One row of the table, in numbers: rad and m.

    Attributes:
        joint: the row as it was read.
        parent: number of the antecedent row, `BASE` for the base.
        cells: gamma, b, alpha, d, theta, r without the joint variable.
        rate: of the joint variable in theta (revolute) or r (prismatic); 0 for a fixed frame.
        constant: of the joint variable.
        coefficients: (free,) of the joint variable: it is constant + coefficients @ u.
        virtual: True for a row that stands for a motion of the platform, not for a joint.
    """

    joint: Joint
    parent: int
    cells: Mapping[str, float]
    rate: float
    constant: float
    coefficients: np.ndarray
    virtual: bool


@dataclass(frozen=True)
class Skeleton(ShortRepr):
    """A robot's table, loops and home in numbers.

    Attributes:
        robot: as read.
        rows: in table order.
        free: names of the rows whose variables are u.
        given: places in u of the actuated joints, which the others follow.
        stated: (free,) u at [home] as the file states it.
        gravity: (3,) acceleration of gravity in frame 0, m/s2.
    """

    robot: Robot
    rows: tuple[SkeletonRow, ...]
    free: tuple[str, ...]
    independent_places: tuple[int, ...]
    stated: np.ndarray
    gravity: np.ndarray

    @property
    def dependent_places(self) -> tuple[int, ...]:
        """Places in u of the variables that the loops determine."""
        return tuple(k for k in range(len(self.free)) if k not in self.independent_places)

    @property
    def is_travel(self) -> np.ndarray:
        """(free,) True where u is a travel in m."""
        return np.array(
            [not self.robot.get_joint(name).is_revolute for name in self.free], dtype=bool
        )

    def find_row(self, name: str) -> int:
        """Place of the row of that name; `BASE` for "0"."""
        return next((i for i, row in enumerate(self.rows) if row.joint.name == name), BASE)

    def find_body_row(self, row: int) -> int:
        """The moving row that carries the frame of that row; `BASE` for the base."""
        while row != BASE and not self.rows[row].joint.is_moving:
            row = self.rows[row].parent
        return row

    def count_depth(self, row: int) -> int:
        """How many moving joints, those of the platform apart, lie between the row and the base."""
        count = 0
        while row != BASE:
            count += self.rows[row].joint.is_moving and not self.rows[row].virtual
            row = self.rows[row].parent
        return count


def build_skeleton(robot: Robot) -> Skeleton:
    """The numbers of a robot's table, at the values of its symbols."""
    values = robot.evaluate_symbols()
    free = tuple(joint.name for joint in robot.free_joints)
    places = {joint.name: i for i, joint in enumerate(robot.joints)}
    forms = _build_joint_forms(robot, values, free)
    rows = []
    for joint in robot.joints:
        cells: dict[str, float] = {}
        rate = 0.0
        for name in _CELLS:
            affine = extract_linear_form(getattr(joint, name), values)
            cells[name] = affine.constant
            rate += affine.coefficients.get(joint.variable, 0.0)
        form = forms.get(joint.name, np.zeros(1 + len(free)))
        parent, virtual = places.get(joint.antecedent, BASE), joint.name in robot.platform
        rows.append(SkeletonRow(joint, parent, cells, rate, float(form[0]), form[1:], virtual))
    return Skeleton(
        robot=robot,
        rows=tuple(rows),
        free=free,
        independent_places=tuple(free.index(joint.name) for joint in robot.coordinates),
        stated=np.array([robot.home.get(name, 0.0) for name in free]),
        gravity=np.array([component.evaluate(values) for component in robot.gravity]),
    )


def _build_joint_forms(
    robot: Robot, values: Mapping[str, float], free: tuple[str, ...]
) -> dict[str, np.ndarray]:
    """Of every moving row: constant, then coefficients of u."""
    forms = {name: np.eye(1 + len(free))[1 + k] for k, name in enumerate(free)}
    left = dict(robot.relations)
    while left:
        for name in list(left):
            form = extract_linear_form(left[name], values)
            owners = {variable[1:]: c for variable, c in form.coefficients.items()}
            if owners.keys() <= forms.keys():
                total = np.eye(1 + len(free))[0] * form.constant
                forms[name] = sum((c * forms[o] for o, c in owners.items()), total)
                del left[name]
    return forms


def format_joint_kind(joint: Joint) -> str:
    """`revolute`, `prismatic`, `fixed`."""
    return JointKind(joint.kind).name.lower()


# Where the frames are: poses from the table, and what a joint moves.


def compute_poses(skeleton: Skeleton, u: np.ndarray) -> np.ndarray:
    """(rows, 4, 4) poses of all frames in frame 0.

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) (Khalil and Kleinfinger 1986).

    Args:
        skeleton: the table.
        u: (free,) variables; may be complex, for derivatives.
    """
    frame_poses = np.empty((len(skeleton.rows), 4, 4), dtype=np.result_type(u, float))
    for i, row in enumerate(skeleton.rows):
        before = np.eye(4) if row.parent == BASE else frame_poses[row.parent]
        q = row.constant + row.coefficients @ u
        theta, r = row.cells["theta"], row.cells["r"]
        moved = (theta + row.rate * q, r) if row.joint.is_revolute else (theta, r + row.rate * q)
        frame_poses[i] = before @ compute_foot_pose(row) @ _compute_screw(*moved)
    return frame_poses


def compute_foot_pose(row: SkeletonRow) -> np.ndarray:
    """(4, 4) pose of the foot of the joint axis in the antecedent frame: before theta and r."""
    cells = row.cells
    tilt = np.eye(4)
    c, s = np.cos(cells["alpha"]), np.sin(cells["alpha"])
    tilt[1:3, 1:3] = [[c, -s], [s, c]]
    tilt[0, 3] = cells["d"]
    return np.asarray(_compute_screw(cells["gamma"], cells["b"]) @ tilt)


def compute_corner(row: SkeletonRow) -> np.ndarray:
    """(3,) where the common normal leaves the antecedent's z axis, in the antecedent frame."""
    return np.array([0.0, 0.0, row.cells["b"]])


def _compute_screw(angle: complex | float, travel: complex | float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, travel], [0, 0, 0, 1]])


def estimate_robot_size(skeleton: Skeleton, u: np.ndarray) -> float:
    """A length of the robot, m: the diagonal of the box around its frames; 1 without any extent."""
    frames = compute_poses(skeleton, u)
    points = [np.zeros(3)]
    for i, row in enumerate(skeleton.rows):
        before = np.eye(4) if row.parent == BASE else frames[row.parent]
        points += [frames[i][:3, 3], (before @ compute_foot_pose(row))[:3, 3]]
    span = np.ptp(np.array(points), axis=0)
    size = float(np.linalg.norm(span))
    return 1.0 if size <= 1e-9 else size
