"""The true parameters of a simulated robot."""

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.core.errors import RobotError
from modeler.robot.robot import Limits, Robot
from modeler.simulation.links import alike, link_parameters, unshared
from modeler.simulation.physics import PHYSICS, EffectPhysics, ShaftScale
from modeler.simulation.portable_math import ten_digits
from modeler.simulation.rigid import Body, body_from_standard, rigid_dynamics

_STATES = 64  # random states from which the typical torque of a joint is taken
_IDLE = 1e-9  # of the largest torque: joints below it move no mass
_OF_LARGEST = 0.02  # their scale instead


@dataclass(frozen=True)
class PlantParameters:
    """What the simulated robot is made of.

    Attributes:
        standard: every standard parameter by name, row after row of the table, SI units: those of
            the link, then those of the joint's effects; of all legs, also where they share some.
        bodies: the same links as mass, centre and inertia about the centre, by joint name.
        drawn: names that the robot file leaves open and that were drawn.
    """

    standard: Mapping[str, float]
    bodies: Mapping[str, Body]
    drawn: tuple[str, ...]


def plant_parameters(robot: Robot, limits: tuple[Limits, ...], seed: int = 0) -> PlantParameters:
    """Parameters of the robot file, completed by plausible ones from the seed.

    Friction, offsets and rotor inertias are drawn as shares of the torque and inertia which the
    links themselves need within `limits` (order of `robot.moving`).

    Raises:
        RobotError: numbers that no rigid body has, a negative friction or rotor inertia, or an
            effect that cannot be simulated; names the link or joint.
    """
    robot, similar = unshared(robot), robot
    rng = np.random.default_rng([seed, 1])
    middle = np.array([(limit.lower + limit.upper) / 2 for limit in limits])
    links, drawn_links = link_parameters(robot, middle, rng)
    bodies = {name: body_from_standard(values) for name, values in links.items()}
    scales = joint_scales(robot, bodies, limits, rng)
    standard: dict[str, float] = {}
    drawn = list(drawn_links)
    for joint, scale in zip(robot.moving, scales, strict=True):
        name = joint.name
        standard |= {p + name: links[name][p] for p in robot.inertial(name)}
        for effect in effects_of(robot, name):
            for prefix, value in effect.draw(rng, scale).items():
                stated = robot.parameters.get(prefix + name)
                if stated is None:
                    drawn.append(prefix + name)
                standard[prefix + name] = ten_digits(value) if stated is None else float(stated)
                _check_sign(robot, effect, prefix + name, prefix, standard[prefix + name])
    standard, bodies = alike(similar, standard, bodies)
    return PlantParameters(standard, bodies, tuple(name for name in standard if name in drawn))


def effects_of(robot: Robot, joint: str) -> list[EffectPhysics]:
    """The physics of the effects of that joint, in the order of the robot's effects.

    Raises:
        RobotError: an effect without physics here.
    """
    found = []
    for use in robot.effects:
        if joint in use.joints:
            if use.effect not in PHYSICS:
                raise RobotError(
                    f"robot {robot.name}, joint {joint}: effect {use.effect} cannot be simulated; "
                    f"expected one of {', '.join(PHYSICS)}; leave it out of the robot file"
                )
            found.append(PHYSICS[use.effect])
    return found


def _check_sign(robot: Robot, effect: EffectPhysics, name: str, prefix: str, value: float) -> None:
    if not np.isfinite(value) or (value < 0 and prefix not in effect.signed):
        raise RobotError(
            f"robot {robot.name}: {name} = {value:g} would drive the joint by itself "
            f"({effect.effect}); expected 0 or more"
        )


def joint_scales(
    robot: Robot,
    bodies: Mapping[str, Body],
    limits: tuple[Limits, ...],
    rng: np.random.Generator,
) -> list[ShaftScale]:
    """What is large and small on each moving row, by the torques of the links in random states."""
    dynamics = rigid_dynamics(robot, bodies)
    q, qd = dynamics.q, dynamics.qd
    qdd = ca.SX.sym("qdd", q.shape[0])
    torque = ca.Function("torque", [q, qd, qdd], [dynamics.inertia @ qdd + dynamics.bias])
    diagonal = ca.Function("diagonal", [q], [ca.diag(dynamics.inertia)])
    low, high = (np.array([[getattr(li, k)] for li in limits]) for k in ("lower", "upper"))
    speed, lift = (np.array([[getattr(li, k)] for li in limits]) for k in ("speed", "acceleration"))
    shape = (len(limits), _STATES)
    poses = rng.uniform(low, high, shape)
    torques = torque.map(_STATES)(
        poses, 0.5 * speed * rng.uniform(-1, 1, shape), 0.5 * lift * rng.uniform(-1, 1, shape)
    ).full()
    inertias = diagonal.map(_STATES)(poses).full()
    rms, inertia = np.sqrt(np.mean(torques**2, axis=1)), np.median(inertias, axis=1)
    # A motor that stands on the base and turns joints by gears moves no link of its own.
    idle = rms <= _IDLE * rms.max()
    rms[idle] = _OF_LARGEST * rms.max()
    inertia[idle] = rms[idle] / lift[idle, 0]
    return [
        ShaftScale(float(torque), limit.speed, float(mass))
        for torque, mass, limit in zip(rms, inertia, limits, strict=True)
    ]
