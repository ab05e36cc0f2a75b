"""Links as capsules: what is drawn of them, and what they would weigh of plastic or metal."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.exports.linkage import BASE, poses
from modeler.robot import Inertial, Robot, about_origin, together

DENSITY = 1000.0
"""kg/m3 of a link of which nothing is known."""

_THICK = 0.12  # radius over the middle length of the links
_BARE = 0.2  # m, of a robot without lengths
_SHORT = 0.02  # of the middle length: frames that are nearer stand at one place


@dataclass(frozen=True, eq=False)
class Capsule:
    """Points that are no farther than `radius` from the way from the frame's origin to `end`."""

    end: np.ndarray
    radius: float

    @property
    def length(self) -> float:
        """Of the way, m; 0 of a ball."""
        return float(np.linalg.norm(self.end))

    def inertial(self) -> Inertial:
        """Of a cylinder of the length of the whole, of `DENSITY`."""
        long, r = self.length + 2.0 * self.radius, self.radius
        mass = DENSITY * np.pi * r**2 * long
        along = self.end / self.length if self.length else np.array([0.0, 0.0, 1.0])
        across = mass * (3.0 * r**2 + long**2) / 12.0
        spin = 0.5 * mass * r**2
        inertia = across * np.eye(3) + (spin - across) * np.outer(along, along)
        return Inertial(mass, 0.5 * self.end, inertia)


def capsules(robot: Robot, q: Mapping[str, float]) -> dict[str, tuple[Capsule, ...]]:
    """By row, from its origin to those of the rows after it; a ball where there are none.

    Args:
        robot: its table.
        q: posture in which lengths are taken.
    """
    at, ends = poses(robot, q), dict[str, list[np.ndarray]]()
    for joint in robot.joints:
        there = at[joint.antecedent].inverse().place(at[joint.name].position)
        ends.setdefault(joint.antecedent, []).append(there)
    lengths = [float(np.linalg.norm(end)) for own in ends.values() for end in own]
    some = [length for length in lengths if length > 1e-6]
    middle = float(np.median(some)) if some else _BARE
    found = {}
    for row in (BASE, *(joint.name for joint in robot.joints)):
        far = {tuple(np.rint(end / (_SHORT * middle))): end for end in ends.get(row, [])}.values()
        long = [end for end in far if np.linalg.norm(end) > _SHORT * middle]
        found[row] = tuple(Capsule(end, _THICK * middle) for end in long or [np.zeros(3)])
    return found


def weights(robot: Robot, q: Mapping[str, float]) -> dict[str, np.ndarray]:
    """(10,) standard parameters of the capsules of every row."""
    found = {}
    for row, own in capsules(robot, q).items():
        whole = together(iter([capsule.inertial() for capsule in own]))
        assert whole is not None
        found[row] = about_origin(whole)
    return found
