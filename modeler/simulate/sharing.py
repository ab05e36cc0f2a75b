"""Parameters that legs have in common: the first leg's links on all legs, told once."""

import dataclasses
from collections.abc import Mapping

from modeler.robot import INERTIAL, Robot
from modeler.simulate.body import Body, body_from_standard


def unshared(robot: Robot) -> Robot:
    """The robot with the values of shared parameters stated for each of their rows."""
    values = dict(robot.parameters)
    for shared in robot.shared:
        if shared.name in values:
            value = values.pop(shared.name)
            values |= dict.fromkeys(shared.members, value)
    return dataclasses.replace(robot, parameters=values, shared=())


def alike(
    robot: Robot, standard: Mapping[str, float], bodies: Mapping[str, Body]
) -> tuple[dict[str, float], dict[str, Body]]:
    """Standard parameters and bodies, with the first leg's values where legs share them."""
    values = dict(standard)
    for shared in robot.shared:
        values |= dict.fromkeys(shared.members, values[shared.members[0]])
    if not robot.shared:
        return values, dict(bodies)
    return values, {
        row: body_from_standard({p: values.get(f"{p}{row}", 0.0) for p in INERTIAL})
        for row in bodies
    }


def told_once(
    robot: Robot, standard: Mapping[str, float], drawn: tuple[str, ...]
) -> tuple[dict[str, float], tuple[str, ...]]:
    """Values and drawn ones by the robot's own names: XX2 where legs share XX21, XX22, XX23."""
    first = {shared.members[0]: shared.name for shared in robot.shared}
    gone = {member for shared in robot.shared for member in shared.members[1:]}
    return (
        {first.get(n, n): value for n, value in standard.items() if n not in gone},
        tuple(first.get(n, n) for n in drawn if n not in gone),
    )
