"""Commanded motion of a robot with loops: closed all along, and away from singular postures."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.robot.robot import Limits, Robot
from modeler.simulation.closing import Constraints, distances, followed
from modeler.simulation.trajectory import Reference

KEPT = 0.5
"""Share of home's distance to a singular posture that a simulated motion keeps."""

_NARROWER = 0.85  # of the range, from one attempt to the next
_NARROWEST = 0.03
_APART = 0.02  # rad or m, between postures looked at on the way from home to the first one
_LOOKS = 100.0  # Hz, at which a motion is tried

Motion = Callable[[tuple[Limits, ...]], Reference]
"""A commanded motion within limits, in the order of `robot.coordinates`."""


@dataclass(frozen=True, eq=False)
class ClosedMotion:
    """A commanded motion and what follows from it.

    Attributes:
        reference: of the coordinates.
        v: (n, moving rows) closed postures.
        share: of the way from home to the limits, that the motion was given; 1 is the whole range.
    """

    reference: Reference
    v: np.ndarray
    share: float


def closed_motion(
    robot: Robot,
    constraints: Constraints,
    limits: tuple[Limits, ...],
    motion: Motion,
    progress: Callable[[float], None] | None = None,
) -> ClosedMotion:
    """The motion over the largest share of the range that keeps away from singular postures.

    The loops close all along, and every posture keeps half of home's distance to a singular one
    (see `distances`). Near one the motors' torques grow without bound, and so does every error.

    Args:
        robot: with loops.
        constraints: its loops and relations.
        limits: of the coordinates.
        motion: makes the commanded motion within limits.
        progress: called with the share done, 0 to 1.

    Raises:
        RobotError: `home` does not close.
        DataError: no share of the range will do.
    """
    home = np.array([[robot.home.get(joint.name, 0.0) for joint in robot.coordinates]])
    least = KEPT * distances(constraints, followed(robot, constraints, home))[0]
    share = 1.0
    while share > _NARROWEST:
        near = tuple(_narrowed(li, at, share) for li, at in zip(limits, home[0], strict=True))
        reference = motion(near)
        if _keeps_away(robot, constraints, reference, least):
            return ClosedMotion(
                reference, followed(robot, constraints, reference.q, progress), share
            )
        share *= _NARROWER
    joints = ", ".join(joint.name for joint in robot.coordinates)
    raise DataError(
        f"simulation: no motion of joints {joints} of {robot.name} keeps its loops closed and away "
        "from singular postures; expected [limits] around [home]; state other [limits], or "
        "another [home]"
    )


def _keeps_away(robot: Robot, constraints: Constraints, reference: Reference, least: float) -> bool:
    """True if the loops close from home on, nowhere nearer than `least` to a singularity."""
    home = np.array([robot.home.get(joint.name, 0.0) for joint in robot.coordinates])
    first = reference.q[0] - home
    way = np.linspace(0.0, 1.0, 1 + int(np.ceil(np.max(np.abs(first)) / _APART)))
    every = max(1, round(1 / (_LOOKS * (reference.time[1] - reference.time[0]))))
    try:
        v = followed(
            robot, constraints, np.vstack([home + way[:, None] * first, reference.q[::every]])
        )
    except DataError:
        return False
    return bool(distances(constraints, v).min() >= least)


def _narrowed(limits: Limits, home: float, share: float) -> Limits:
    """The same share of the way from home to both limits."""
    middle = min(max(home, limits.lower), limits.upper)
    return dataclasses.replace(
        limits,
        lower=middle + share * (limits.lower - middle),
        upper=middle + share * (limits.upper - middle),
    )
