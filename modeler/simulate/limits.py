"""The range of motion a simulated robot is given."""

import math
from collections.abc import Mapping

from modeler.core.errors import RobotError
from modeler.robot import Joint, Limits, Robot

REVOLUTE = Limits(lower=-1.5, upper=1.5, speed=2.0, acceleration=8.0)
"""Where the robot file says nothing: rad, rad/s, rad/s2."""

PRISMATIC = Limits(lower=-0.3, upper=0.3, speed=0.5, acceleration=3.0)
"""Where the robot file says nothing: m, m/s, m/s2."""


_AROUND_HOME = 0.2  # of the defaults' range, for robots with loops


def motion_limits(robot: Robot, changes: Mapping[str, Limits] | None = None) -> tuple[Limits, ...]:
    """Limits in the order of `robot.moving`: `changes`, else the robot file, else the defaults.

    A robot with loops moves around its home by default, and less: it could not close far away.

    Raises:
        RobotError: limits of a joint that is not there, or an empty range.
    """
    stated = {**robot.limits, **(changes or {})}
    names = [joint.name for joint in robot.moving]
    for name, limits in stated.items():
        where = f"robot {robot.name}, limits of joint {name}"
        if name not in names:
            raise RobotError(f"{where}: no such moving joint; expected one of {', '.join(names)}")
        _check(limits, where)
    return tuple(stated.get(joint.name, _default(robot, joint)) for joint in robot.moving)


def _default(robot: Robot, joint: Joint) -> Limits:
    usual = REVOLUTE if joint.angular else PRISMATIC
    if not robot.loops:
        return usual
    home, reach = robot.home.get(joint.name, 0.0), _AROUND_HOME * usual.upper
    return Limits(home - reach, home + reach, usual.speed, usual.acceleration)


def _check(limits: Limits, where: str) -> None:
    values = (limits.lower, limits.upper, limits.speed, limits.acceleration)
    if not all(math.isfinite(value) for value in values):
        raise RobotError(f"{where}: got {values}; expected finite numbers")
    if limits.lower >= limits.upper:
        raise RobotError(
            f"{where}: got lower {limits.lower}, upper {limits.upper}; expected lower < upper"
        )
    if limits.speed <= 0 or limits.acceleration <= 0:
        raise RobotError(
            f"{where}: got speed {limits.speed}, acceleration {limits.acceleration}; "
            "expected both above 0"
        )
