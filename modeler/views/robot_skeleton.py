"""The table of a robot in numbers: frames, closed postures, gaps of loops, for its picture."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.json import ShortRepr
from modeler.robot import Joint, JointKind, Loop, Robot, extract_linear_form
from modeler.views.thresholds import THRESHOLDS

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
        is_virtual: True for a row that stands for a motion of the platform, not for a joint.
    """

    joint: Joint
    parent: int
    cells: Mapping[str, float]
    rate: float
    constant: float
    coefficients: np.ndarray
    is_virtual: bool


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
        """Returns the places in u of the variables that the loops determine."""
        return tuple(k for k in range(len(self.free)) if k not in self.independent_places)

    @property
    def is_travel(self) -> np.ndarray:
        """Returns (free,) True where u is a travel in m."""
        return np.array(
            [not self.robot.get_joint(name).is_revolute for name in self.free], dtype=bool
        )

    def find_row(self, name: str) -> int:
        """Returns the place of the row of that name; `BASE` for "0"."""
        return next((i for i, row in enumerate(self.rows) if row.joint.name == name), BASE)

    def find_body_row(self, row: int) -> int:
        """Returns the moving row that carries the frame of that row; `BASE` for the base."""
        while row != BASE and not self.rows[row].joint.is_moving:
            row = self.rows[row].parent
        return row

    def count_depth(self, row: int) -> int:
        """Counts the moving joints between the row and the base, those of the platform apart."""
        count = 0
        while row != BASE:
            count += self.rows[row].joint.is_moving and not self.rows[row].is_virtual
            row = self.rows[row].parent
        return count


def build_skeleton(robot: Robot) -> Skeleton:
    """Builds the numbers of a robot's table, at the values of its symbols."""
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
    """Returns `revolute`, `prismatic` or `fixed`."""
    return JointKind(joint.kind).name.lower()


# Where the frames are: poses from the table, and what a joint moves.


def compute_poses(skeleton: Skeleton, u: np.ndarray) -> np.ndarray:
    """Computes (rows, 4, 4) poses of all frames in frame 0.

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
    """Returns (4, 4) pose of the joint axis' foot in the antecedent frame: before theta and r."""
    cells = row.cells
    tilt = np.eye(4)
    c, s = np.cos(cells["alpha"]), np.sin(cells["alpha"])
    tilt[1:3, 1:3] = [[c, -s], [s, c]]
    tilt[0, 3] = cells["d"]
    return np.asarray(_compute_screw(cells["gamma"], cells["b"]) @ tilt)


def compute_corner(row: SkeletonRow) -> np.ndarray:
    """Returns (3,) where the common normal leaves the antecedent's z axis, in its frame."""
    return np.array([0.0, 0.0, row.cells["b"]])


def _compute_screw(angle: complex | float, travel: complex | float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, travel], [0, 0, 0, 1]])


def estimate_robot_size(skeleton: Skeleton, u: np.ndarray) -> float:
    """Returns the diagonal, m, of the box around the robot's frames; 1 without any extent."""
    frames = compute_poses(skeleton, u)
    points = [np.zeros(3)]
    for i, row in enumerate(skeleton.rows):
        before = np.eye(4) if row.parent == BASE else frames[row.parent]
        points += [frames[i][:3, 3], (before @ compute_foot_pose(row))[:3, 3]]
    span = np.ptp(np.array(points), axis=0)
    size = float(np.linalg.norm(span))
    return 1.0 if size <= 1e-9 else size


# Loops: how far they are open, and postures in which they are closed.
#
# Axes are compared as vectors, not by right angles: opposite axes are not closed. Gauss-Newton in
# the sense of least squares, derivatives by complex steps; the page does the same (closing.js).


@dataclass(frozen=True)
class LoopGap:
    """How far a loop is open.

    Attributes:
        loop: which.
        distance: m, between what should meet: points, axes, or planes.
        angle: rad, between directions that should agree; 0 where none should.
        way: (3, 3) from the origin of one frame, along what the joint lets free, to that of the
            other: three points in frame 0, the gap between the last two.
    """

    loop: Loop
    distance: float
    angle: float
    path: np.ndarray


@dataclass(frozen=True)
class Posture:
    """A posture to look at.

    Attributes:
        u: (free,) variables.
        size: a length of the robot there, m.
        is_closed: True if all loops are closed.
        is_as_stated: True if the actuated joints stand where [home] states them.
        loose_joints: joints that could move there with the actuated joints locked: the posture is
            singular, or the loops determine too little.
        note: a line on where the posture comes from; "" for [home] as the file states it.
    """

    u: np.ndarray
    size: float
    is_closed: bool
    is_as_stated: bool
    loose_joints: tuple[str, ...] = ()
    note: str = ""


def find_home_posture(skeleton: Skeleton) -> Posture:
    """Closes [home] by the passive joints, else by all joints; else returns it as stated."""
    stated = skeleton.stated
    size = estimate_robot_size(skeleton, stated)
    for places, held in ((skeleton.dependent_places, True), (tuple(range(len(stated))), False)):
        closed_u = solve_closure(skeleton, stated, places, size)
        if closed_u is not None:
            return Posture(
                closed_u,
                estimate_robot_size(skeleton, closed_u),
                True,
                held,
                _find_loose_joints(skeleton, closed_u),
            )
    return Posture(stated, size, False, True)


def _find_loose_joints(skeleton: Skeleton, u: np.ndarray) -> tuple[str, ...]:
    """Names of the joints that the loops leave undetermined at u to first order."""
    places = skeleton.dependent_places
    if not places or not skeleton.robot.loops:
        return ()
    size = estimate_robot_size(skeleton, u)
    J = (
        compute_jacobian(skeleton, u, size, places)
        * np.where(skeleton.is_travel, size, 1.0)[list(places)]
    )
    _, sizes, turned = np.linalg.svd(J)
    idle = turned[int(np.sum(sizes > THRESHOLDS.min_loose_value * sizes[0])) :]
    if not len(idle):
        return ()
    share = np.max(np.abs(idle), axis=0)
    return tuple(
        skeleton.free[k] for k, s in zip(places, share, strict=True) if s > 0.1 * np.max(share)
    )


def solve_closure(
    skeleton: Skeleton, start: np.ndarray, places: Sequence[int], size: float
) -> np.ndarray | None:
    """Solves the closed posture from `start` by moving `places`; None if there is none.

    Args:
        skeleton: the robot.
        start: (free,) where to begin.
        places: in u, of what may move.
        size: a length of the robot, m.
    """
    u = np.array(start, dtype=float)
    scale = np.where(skeleton.is_travel, size, 1.0)[list(places)]
    for _ in range(THRESHOLDS.newton_iterations):
        f = compute_residuals(skeleton, u, size)
        if np.max(np.abs(f), initial=0.0) < THRESHOLDS.newton_tolerance or not places:
            break
        J = compute_jacobian(skeleton, u, size, places) * scale
        step = np.linalg.lstsq(J, -f, rcond=THRESHOLDS.min_closure_pivot)[0]
        step *= min(1.0, THRESHOLDS.max_newton_step / max(float(np.max(np.abs(step))), 1e-300))
        u[list(places)] += step * scale
        if np.max(np.abs(step)) < 1e-15:
            break
    f = compute_residuals(skeleton, u, size)
    return u if np.max(np.abs(f), initial=0.0) < THRESHOLDS.max_loop_residual else None


def compute_jacobian(
    skeleton: Skeleton, u: np.ndarray, size: float, places: Sequence[int]
) -> np.ndarray:
    """Computes (equations, places) derivatives of `compute_residuals`."""
    columns = []
    for k in places:
        moved = u.astype(complex)
        moved[k] += 1j * THRESHOLDS.complex_step
        columns.append(compute_residuals(skeleton, moved, size).imag / THRESHOLDS.complex_step)
    return np.array(columns).T


def compute_residuals(skeleton: Skeleton, u: np.ndarray, size: float) -> np.ndarray:
    """Returns the residuals of closed loops: lengths in robot sizes, direction cosines."""
    frames = compute_poses(skeleton, u)
    parts = [
        np.atleast_1d(value)
        for loop in skeleton.robot.loops
        for value in _KINDS[loop.kind](*_select_loop_frames(skeleton, frames, loop), size)
    ]
    return np.concatenate(parts) if parts else np.zeros(0)


def _select_loop_frames(
    skeleton: Skeleton, frames: np.ndarray, loop: Loop
) -> tuple[np.ndarray, np.ndarray]:
    numbers = (skeleton.find_row(loop.frame), skeleton.find_row(loop.meets))
    one, other = (np.eye(4) if i == BASE else frames[i] for i in numbers)
    return one, other


def _compute_offset(a: np.ndarray, b: np.ndarray, size: float) -> np.ndarray:
    return np.asarray((b[:3, 3] - a[:3, 3]) / size)


def _compute_lateral_offset(a: np.ndarray, b: np.ndarray, size: float) -> np.ndarray:
    return np.cross(a[:3, 2], _compute_offset(a, b, size))


_KINDS: Mapping[str, Callable[[np.ndarray, np.ndarray, float], list[np.ndarray]]] = {
    "position": lambda a, b, s: [_compute_offset(a, b, s)],
    "spherical": lambda a, b, s: [_compute_offset(a, b, s)],
    "universal": lambda a, b, s: [_compute_offset(a, b, s), a[:3, 2] @ b[:3, 2]],
    "revolute": lambda a, b, s: [_compute_offset(a, b, s), a[:3, 2] - b[:3, 2]],
    "cylindrical": lambda a, b, s: [_compute_lateral_offset(a, b, s), a[:3, 2] - b[:3, 2]],
    "prismatic": lambda a, b, s: [_compute_lateral_offset(a, b, s), *(a - b)[:3, [2, 0]].T],
    "planar": lambda a, b, s: [a[:3, 2] @ _compute_offset(a, b, s), a[:3, 2] - b[:3, 2]],
    "rigid": lambda a, b, s: [_compute_offset(a, b, s), *(a - b)[:3, [2, 0]].T],
}


def compute_gaps(skeleton: Skeleton, u: np.ndarray) -> tuple[LoopGap, ...]:
    """Computes how far every loop is open at u."""
    frames = compute_poses(skeleton, u)
    gaps = []
    for loop in skeleton.robot.loops:
        a, b = _select_loop_frames(skeleton, frames, loop)
        way, z = b[:3, 3] - a[:3, 3], a[:3, 2]
        allowed = np.zeros(3)
        if loop.kind in ("cylindrical", "prismatic"):
            allowed = z * (z @ way)
        elif loop.kind == "planar":
            allowed = way - z * (z @ way)
        points = np.array([a[:3, 3], a[:3, 3] + allowed, b[:3, 3]])
        distance = float(np.linalg.norm(way - allowed))
        gaps.append(LoopGap(loop, distance, _compute_gap_angle(loop.kind, a, b), points))
    return tuple(gaps)


def _compute_gap_angle(kind: str, a: np.ndarray, b: np.ndarray) -> float:
    """The largest angle between directions that should agree."""
    if kind in ("position", "spherical"):
        return 0.0
    if kind == "universal":
        return float(abs(np.arcsin(np.clip(a[:3, 2] @ b[:3, 2], -1.0, 1.0))))
    axes = (0, 2) if kind in ("rigid", "prismatic") else (2,)
    chords = [float(np.linalg.norm(a[:3, k] - b[:3, k])) for k in axes]
    return 2.0 * float(np.arcsin(min(1.0, max(chords) / 2.0)))
