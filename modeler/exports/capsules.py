"""Links as capsules: what is drawn of them, and what they would weigh of plastic or metal."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from modeler.exports.linkage import BASE, compute_row_pose, compute_row_poses
from modeler.robot import Inertial, Pose, Robot, combine_inertials, compute_standard_parameters

DENSITY = 1000.0
"""kg/m3 of a link of which nothing is known."""

_THICK = 0.12  # radius over the middle length of the links
_BARE = 0.2  # m, of a robot without lengths
_SHORT = 0.02  # of the middle length: frames that are nearer stand at one place


@dataclass(frozen=True, eq=False)
class Capsule:
    """Points that are no farther than `radius` from the way from `start` to `end`, in a frame."""

    end: np.ndarray
    radius: float
    start: np.ndarray = field(default_factory=lambda: np.zeros(3))

    @property
    def axis_vector(self) -> np.ndarray:
        """(3,) from start to end, m."""
        return self.end - self.start

    @property
    def length(self) -> float:
        """Of the way, m; 0 of a ball."""
        return float(np.linalg.norm(self.axis_vector))

    def compute_inertial(self) -> Inertial:
        """Of a cylinder of the length of the whole, of `DENSITY`."""
        long, r = self.length + 2.0 * self.radius, self.radius
        mass = DENSITY * np.pi * r**2 * long
        along = self.axis_vector / self.length if self.length else np.array([0.0, 0.0, 1.0])
        across = mass * (3.0 * r**2 + long**2) / 12.0
        spin = 0.5 * mass * r**2
        inertia = across * np.eye(3) + (spin - across) * np.outer(along, along)
        return Inertial(mass, 0.5 * (self.start + self.end), inertia)


def build_capsules(robot: Robot, q: Mapping[str, float]) -> dict[str, tuple[Capsule, ...]]:
    """By row: those of the robot file, else from its origin to those of the rows after it.

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
    middle = float(np.median(some)) if some else _BARE
    capsules_by_row = {}
    for row in (BASE, *(joint.name for joint in robot.joints)):
        far = {tuple(np.rint(end / (_SHORT * middle))): end for end in ends.get(row, [])}.values()
        long = [end for end in far if np.linalg.norm(end) > _SHORT * middle]
        stated = [capsule for capsule in robot.capsules if capsule.row == row]
        radius = stated[0].radius if stated else _THICK * middle
        capsules_by_row[row] = tuple(Capsule(end, radius) for end in long or [np.zeros(3)])
        if stated and stated[0].ends is not None:
            capsules_by_row[row] = tuple(
                Capsule(np.array(entry.ends[1]), entry.radius, np.array(entry.ends[0]))
                for entry in stated if entry.ends is not None
            )  # fmt: skip
    return capsules_by_row


def compute_capsule_parameters(robot: Robot, q: Mapping[str, float]) -> dict[str, np.ndarray]:
    """(10,) standard parameters of the capsules of every row."""
    parameters = {}
    for row, row_capsules in build_capsules(robot, q).items():
        whole = combine_inertials(iter([capsule.compute_inertial() for capsule in row_capsules]))
        assert whole is not None
        parameters[row] = compute_standard_parameters(whole)
    return parameters


def locate_capsules(robot: Robot, q: Mapping[str, float]) -> list[tuple[str, str, Capsule]]:
    """Every body's capsules: its row, the moving row that carries it (or the base), the shape.

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
    return [
        (
            row,
            on,
            Capsule(
                pose.transform_point(shape.end), shape.radius, pose.transform_point(shape.start)
            ),
        )
        for row, shapes in build_capsules(robot, q).items()
        if row not in none
        for shape in shapes
        for on, pose in [places[row]]
    ]
