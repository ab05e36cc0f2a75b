"""Measurements of robots whose joints are tied: the commanded motion, carried out exactly.

Drives of parallel robots are stiff and well tuned: the actuated joints are where they are commanded
to be, the others follow, and the motors give what that needs. No controller is simulated.
"""

import dataclasses
from collections.abc import Callable

import numpy as np

from modeler.core.errors import RobotError
from modeler.robot import Robot
from modeler.simulate.constraints import constraints_of, followed, motor_torques, rates
from modeler.simulate.limits import motion_limits
from modeler.simulate.log import SimulatedLog, Truth
from modeler.simulate.parameters import PlantParameters, plant_parameters
from modeler.simulate.plant import torque_function
from modeler.simulate.sensors import encoder_resolution, quantised
from modeler.simulate.settings import SimulationSettings
from modeler.simulate.trajectory import Reference, exciting_reference


def simulate_closed(
    robot: Robot, settings: SimulationSettings, progress: Callable[[float], None] | None = None
) -> SimulatedLog:
    """A measurement of a robot with relations or loops.

    Torques are those of the instant, by the tree's own equations of motion and Lagrange
    multipliers for the ties.

    Raises:
        RobotError: a coordinate without motor, parameters no body has.
        DataError: the loops do not close on the motion.
    """
    passive = [joint.name for joint in robot.coordinates if not joint.actuated]
    if passive:
        raise RobotError(
            f"robot {robot.name}: joints {', '.join(passive)} move freely and have no motor; "
            "expected loops or relations that move them with actuated joints"
        )
    every = motion_limits(robot, settings.limits)
    names = [joint.name for joint in robot.moving]
    limits = tuple(every[names.index(joint.name)] for joint in robot.coordinates)
    reference = exciting_reference(limits, settings.duration, settings.rate, settings.seed)
    parameters = _shared(robot, plant_parameters(_unshared(robot), every, settings.parameter_seed))
    constraints = constraints_of(robot)
    v = followed(robot, constraints, reference.q, progress)
    vd, vdd = rates(constraints, v, reference.qd, reference.qdd)
    torque, states = torque_function(_unshared(robot), parameters, every)
    load = torque.map(len(v))(v.T, vd.T, vdd.T, np.zeros((states, len(v)))).full().T
    tau = motor_torques(constraints, v, load)
    return _log(robot, parameters, reference, settings, tau)


def _unshared(robot: Robot) -> Robot:
    """The robot with the values of shared parameters on each of their rows."""
    values = dict(robot.parameters)
    for shared in robot.shared:
        if shared.name in values:
            value = values.pop(shared.name)
            values |= dict.fromkeys(shared.members, value)
    return dataclasses.replace(robot, parameters=values, shared=())


def _shared(robot: Robot, drawn: PlantParameters) -> PlantParameters:
    """The first leg's links on all legs, where legs share them; shared names in the truth."""
    standard, bodies, names = dict(drawn.standard), dict(drawn.bodies), list(drawn.drawn)
    for shared in robot.shared:
        first, *others = shared.members
        for other in others:
            standard[other] = standard[first]
    for shared in robot.shared:
        if shared.members[0].startswith("MX"):
            rows = [member.removeprefix("MX") for member in shared.members]
            bodies |= {row: bodies[rows[0]] for row in rows if row in bodies}
    if not robot.shared:
        return drawn
    return PlantParameters(standard, bodies, tuple(names))


def _truth(robot: Robot, standard: dict[str, float]) -> dict[str, float]:
    """Values by the names of the robot's own parameters."""
    first = {shared.members[0]: shared.name for shared in robot.shared}
    gone = {member for shared in robot.shared for member in shared.members[1:]}
    return {first.get(n, n): value for n, value in standard.items() if n not in gone}


def _log(
    robot: Robot,
    parameters: PlantParameters,
    reference: Reference,
    settings: SimulationSettings,
    tau: np.ndarray,
) -> SimulatedLog:
    resolution = encoder_resolution(robot.coordinates, settings)
    rms = np.sqrt(np.mean(tau**2, axis=0))
    noise = np.random.default_rng([settings.seed, 3]).normal(size=tau.shape)
    return SimulatedLog(
        robot=robot.name,
        joints=tuple(joint.name for joint in robot.coordinates),
        driven=np.ones(tau.shape[1], dtype=bool),
        time=reference.time,
        q=quantised(reference.q, resolution),
        qc=reference.q,
        tau=tau + settings.torque_noise * rms * noise,
        settings=settings,
        truth=Truth(
            reference.q, reference.qd, reference.qdd, tau,
            _truth(robot, dict(parameters.standard)), parameters.drawn,
        ),
    )  # fmt: skip
