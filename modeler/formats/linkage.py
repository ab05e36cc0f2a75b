"""Rows of a table as numbers: where their frames are, what their variables follow."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from modeler.core.errors import DataError
from modeler.formats.body_tree import (
    Inertial,
    Pose,
    combine_inertials,
    compute_axis_rotation,
    compute_standard_parameters,
)
from modeler.formats.mdh_rows import compute_cells_pose
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import GEOMETRY, Joint, JointKind, LinkFrame, Loop, Robot, extract_linear_form

BASE = "0"
"""Name of the frame that stands still."""


def compute_frame_pose(frame: LinkFrame, symbols: Mapping[str, float]) -> Pose:
    """Returns pose of a link's frame on its row."""
    position = np.array([cell.evaluate(symbols) for cell in frame.position])
    return Pose(position, compute_rpy_rotation([cell.evaluate(symbols) for cell in frame.angles]))


def compute_rpy_rotation(angles: Sequence[float]) -> np.ndarray:
    """Returns (3, 3) Rz(yaw) Ry(pitch) Rx(roll)."""
    turns = zip(np.eye(3), angles, strict=True)
    about_x, about_y, about_z = (compute_axis_rotation(axis, angle) for axis, angle in turns)
    return about_z @ about_y @ about_x


def compute_row_pose(joint: Joint, values: Mapping[str, float]) -> Pose:
    """Returns T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r).

    Args:
        joint: the row.
        values: of the symbols, and of its variable if it has one.
    """
    cells = {column: getattr(joint, column).evaluate(values) for column in GEOMETRY}
    return compute_cells_pose(cells)


def compute_gravity(robot: Robot) -> np.ndarray:
    """Returns (3,) acceleration of gravity in frame 0."""
    symbols = robot.evaluate_symbols()
    return np.array([cell.evaluate(symbols) for cell in robot.gravity])


def get_variable_sign(joint: Joint, symbols: Mapping[str, float]) -> float:
    """Returns 1.0, or -1.0 where the table has the variable of the row with a minus."""
    cell = joint.theta if joint.kind is JointKind.REVOLUTE else joint.r
    return float(np.sign(extract_linear_form(cell, symbols).coefficients[joint.variable]))


def evaluate_variables(robot: Robot, q: Mapping[str, float]) -> dict[str, float]:
    """Returns values of the symbols and of all joint variables, those that follow others included.

    Args:
        robot: its relations.
        q: by row; rows that are left out, and follow no other, stand at 0.
    """
    values = robot.evaluate_symbols()
    free = [joint for joint in robot.moving_joints if joint.name not in robot.relations]
    values |= {joint.variable: float(q.get(joint.name, 0.0)) for joint in free}
    waiting = dict(robot.relations)
    while waiting:
        ready = [row for row, cell in waiting.items() if cell.names <= values.keys()]
        for row in ready or list(waiting):
            values[f"q{row}"] = waiting.pop(row).evaluate(values)
    return values


def compute_row_poses(robot: Robot, q: Mapping[str, float]) -> dict[str, Pose]:
    """Returns pose of every row's frame in frame 0, and of frame 0, by row."""
    values, poses = evaluate_variables(robot, q), {BASE: Pose()}
    for joint in robot.joints:
        poses[joint.name] = poses[joint.antecedent] @ compute_row_pose(joint, values)
    return poses


# Loops.

CLOSED_BY = ("spherical", "position", "revolute", "rigid")
"""Kinds of loops that points which meet can state."""


def close_loops(robot: Robot) -> dict[str, float]:
    """Returns every joint variable at [home], by row, the passive ones moved until the loops close.

    Raises:
        DataError: a loop of another kind; the loops do not close near [home].
    """
    from scipy.optimize import least_squares  # a fit has no use for it

    names = [joint.name for joint in robot.moving_joints]
    if robot.loops:
        for loop in robot.loops:
            if loop.kind not in CLOSED_BY:
                raise DataError(
                    f"{robot.name}: loop {loop.name} is {loop.kind}, which is not written; "
                    f"expected one of {', '.join(CLOSED_BY)}, or cut the loops"
                )
        leading_rows = {joint.name for joint in robot.coordinates} | set(robot.relations)
        passive = [name for name in names if name not in leading_rows]

        def compute_gaps(x: np.ndarray) -> np.ndarray:
            at = compute_row_poses(robot, {**robot.home, **dict(zip(passive, x, strict=True))})
            return np.concatenate([_compute_gap(loop, at) for loop in robot.loops])

        start = np.array([robot.home.get(name, 0.0) for name in passive])
        solution = least_squares(compute_gaps, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if np.abs(solution.fun).max() > THRESHOLDS.max_loop_gap:
            todo = "find it with `modeler home`"
            raise DataError(f"{robot.name}: its loops do not close near [home]; {todo}")
        robot = replace(robot, home={**robot.home, **dict(zip(passive, solution.x, strict=True))})
    values = evaluate_variables(robot, robot.home)
    return {name: values[f"q{name}"] for name in names}


def _compute_gap(loop: Loop, at: Mapping[str, Pose]) -> np.ndarray:
    """What is left of a loop: the points apart, and the axes, m and rad."""
    apart = at[loop.frame].inverse() @ at[loop.meets]
    R = apart.rotation
    if loop.kind == "revolute":
        return np.array([*apart.position, R[0, 2], R[1, 2]])
    if loop.kind == "rigid":
        return np.array([*apart.position, R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return apart.position


# Links as capsules: what is drawn of them, and what they would weigh of plastic or metal.


@dataclass(frozen=True, eq=False)
class Capsule:
    """Points that are no farther than `radius` from the way from `start` to `end`, in a frame."""

    end: np.ndarray
    radius: float
    start: np.ndarray = field(default_factory=lambda: np.zeros(3))

    @property
    def axis_vector(self) -> np.ndarray:
        """Returns (3,) from start to end, m."""
        return self.end - self.start

    @property
    def length(self) -> float:
        """Returns the length of the axis, m; 0 of a ball."""
        return float(np.linalg.norm(self.axis_vector))

    def compute_inertial(self) -> Inertial:
        """Computes mass, centre and inertia of a cylinder of the same length."""
        long, r = self.length + 2.0 * self.radius, self.radius
        mass = THRESHOLDS.capsule_density * np.pi * r**2 * long
        along = self.axis_vector / self.length if self.length else np.array([0.0, 0.0, 1.0])
        across = mass * (3.0 * r**2 + long**2) / 12.0
        spin = 0.5 * mass * r**2
        inertia = across * np.eye(3) + (spin - across) * np.outer(along, along)
        return Inertial(mass, 0.5 * (self.start + self.end), inertia)


def build_capsules(robot: Robot, q: Mapping[str, float]) -> dict[str, tuple[Capsule, ...]]:
    """Builds the capsules of every row: those of the robot file, else by the frames after it.

    A ball where there are none; as thick as 0.12 of the middle length where no radius is stated.

    Args:
        robot: its table.
        q: posture in which lengths are taken.
    """
    at, ends = compute_row_poses(robot, q), dict[str, list[np.ndarray]]()
    for joint in robot.joints:
        if joint.name in robot.platform or joint.name in robot.motors:
            continue  # which is carried by nothing, and which carries nothing
        end_point = at[joint.antecedent].inverse().transform_point(at[joint.name].position)
        ends.setdefault(joint.antecedent, []).append(end_point)
    lengths = [float(np.linalg.norm(end)) for entry in ends.values() for end in entry]
    some = [length for length in lengths if length > 1e-6]
    middle = float(np.median(some)) if some else THRESHOLDS.capsule_default_length
    capsules_by_row = {}
    for row in (BASE, *(joint.name for joint in robot.joints)):
        far = {
            tuple(np.rint(end / (THRESHOLDS.min_capsule_length_share * middle))): end
            for end in ends.get(row, [])
        }.values()
        least = THRESHOLDS.min_capsule_length_share * middle
        long = [end for end in far if np.linalg.norm(end) > least]
        stated = [capsule for capsule in robot.capsules if capsule.row == row]
        radius = stated[0].radius if stated else THRESHOLDS.capsule_radius_share * middle
        capsules_by_row[row] = tuple(Capsule(end, radius) for end in long or [np.zeros(3)])
        if stated and stated[0].ends is not None:
            capsules_by_row[row] = tuple(
                Capsule(np.array(entry.ends[1]), entry.radius, np.array(entry.ends[0]))
                for entry in stated
                if entry.ends is not None
            )
    return capsules_by_row


def compute_capsule_parameters(robot: Robot, q: Mapping[str, float]) -> dict[str, np.ndarray]:
    """Returns (10,) standard parameters of the capsules of every row."""
    parameters = {}
    for row, row_capsules in build_capsules(robot, q).items():
        whole = combine_inertials(iter([capsule.compute_inertial() for capsule in row_capsules]))
        assert whole is not None
        parameters[row] = compute_standard_parameters(whole)
    return parameters


def locate_capsules(robot: Robot, q: Mapping[str, float]) -> list[tuple[str, str, Capsule]]:
    """Lists every body's capsules: its row, the moving row that carries it, the shape.

    The shape is in the frame of the row that carries it. Where the robot file has [capsules], rows
    that are not among them have none.

    Args:
        robot: its table.
        q: posture in which lengths are taken.
    """
    symbols, places = robot.evaluate_symbols(), {BASE: (BASE, Pose())}
    for joint in robot.joints:
        on, pose = places[joint.antecedent]
        fixed = (on, pose if joint.is_moving else pose @ compute_row_pose(joint, symbols))
        places[joint.name] = (joint.name, Pose()) if joint.is_moving else fixed
    none = {*robot.platform[:-1], *robot.motors}
    if robot.capsules:
        none |= places.keys() - {capsule.row for capsule in robot.capsules}
    located = []
    for row, shapes in build_capsules(robot, q).items():
        on, pose = places[row]
        for shape in shapes if row not in none else ():
            end, start = pose.transform_point(shape.end), pose.transform_point(shape.start)
            located.append((row, on, Capsule(end, shape.radius, start)))
    return located
