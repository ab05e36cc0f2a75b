"""Hidden loads on links, and a base that does not stand level."""

import dataclasses
from collections.abc import Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from modeler.core.expression import parse
from modeler.robot.robot import Robot
from modeler.simulation.hidden import HiddenEffect
from modeler.simulation.hidden_catalogue import HIDDEN
from modeler.simulation.parameters import PlantParameters
from modeler.simulation.portable_math import ten_digits
from modeler.simulation.rigid import Body, body_from_standard, gravity_vector, standard_from_body


def machine(
    robot: Robot, parameters: PlantParameters, effects: Sequence[HiddenEffect]
) -> tuple[Robot, PlantParameters]:
    """The robot with hidden loads on its links, on a base that stands askew."""
    bodies = dict(parameters.bodies)
    for effect in effects:
        role = HIDDEN[effect.effect].role
        if role == "gravity":
            robot = _tilted(robot, effect)
        elif role == "body":
            name = effect.joint or last_link(robot)
            bodies[name] = _loaded(bodies[name], effect)
    return robot, dataclasses.replace(parameters, bodies=bodies)


def last_link(robot: Robot) -> str:
    """The row that carries a load: the platform, or the last one that moves."""
    return robot.platform[-1] if robot.platform else robot.moving[-1].name


def _loaded(body: Body, effect: HiddenEffect) -> Body:
    """With a ball of that mass at (x, y, z), of that radius of gyration: all ten parameters."""
    values = effect.values
    inertia = values["mass"] * values["radius"] ** 2 * np.eye(3)
    ball = Body(values["mass"], np.array([values[k] for k in "xyz"]), inertia)
    one, other = standard_from_body(body), standard_from_body(ball)
    return body_from_standard({name: one[name] + other[name] for name in one})


def _tilted(robot: Robot, effect: HiddenEffect) -> Robot:
    """Gravity turned by `angle` about a horizontal axis, `heading` away from the first one.

    The horizontal axes are the world's two that are farther from gravity, made square to it.
    """
    gravity = gravity_vector(robot)
    down = gravity / np.linalg.norm(gravity)
    first, second = (np.eye(3)[i] for i in np.sort(np.argsort(np.abs(down), kind="stable")[:2]))
    first = first - (first @ down) * down
    first /= np.linalg.norm(first)
    second = second - (second @ down) * down - (second @ first) * first
    second /= np.linalg.norm(second)
    heading = effect.values["heading"]
    axis = np.cos(heading) * first + np.sin(heading) * second
    turned = Rotation.from_rotvec(effect.values["angle"] * axis).apply(gravity)
    x, y, z = (parse(ten_digits(component)) for component in turned)
    return dataclasses.replace(robot, gravity=(x, y, z))
