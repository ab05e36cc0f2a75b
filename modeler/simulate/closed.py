"""Measurements of robots with loops: the commanded motion, carried out exactly.

Drives of parallel robots are stiff and well tuned: the actuated joints are where they are commanded
to be, the others follow, and the motors give what that needs. No controller is simulated; for one
see `simulate.closed_plant`.
"""

from collections.abc import Callable

import numpy as np

from modeler.robot import Limits, Robot
from modeler.simulate.closed_motion import ClosedMotion, closed_motion
from modeler.simulate.closing import followed, motor_torques, rates
from modeler.simulate.constraints import Constraints, constraints_of, sampled
from modeler.simulate.hidden import HiddenEffect
from modeler.simulate.hidden_bodies import machine
from modeler.simulate.hidden_draw import complete_effects
from modeler.simulate.limits import motion_limits
from modeler.simulate.log import SimulatedLog, Truth
from modeler.simulate.parameters import PlantParameters, plant_parameters
from modeler.simulate.plant import torque_function
from modeler.simulate.process import process_torques
from modeler.simulate.sensors import (
    encoder_resolution,
    faults_of,
    quantised,
    sampled_torques,
)
from modeler.simulate.settings import SimulationSettings
from modeler.simulate.sharing import told_once
from modeler.simulate.trajectory import Reference, reference_motion, widened


def simulate_closed(
    robot: Robot, settings: SimulationSettings, progress: Callable[[float], None] | None = None
) -> SimulatedLog:
    """A measurement of a robot with loops.

    Torques are those of the instant, by the equations of motion of the open tree and Lagrange
    multipliers for what ties it.

    Raises:
        RobotError: parameters no body has, a `home` that does not close.
        DataError: the loops do not close on the motion.
    """
    every = motion_limits(robot, settings.limits)
    constraints = constraints_of(robot)
    _, motion = closed_command(robot, constraints, every, settings, progress)
    parameters = plant_parameters(robot, every, settings.parameter_seed)
    hidden = complete_effects(robot, parameters, every, settings)
    v, reference = motion.v, motion.reference
    vd, vdd = rates(constraints, v, reference.qd, reference.qdd)
    torque, states = torque_function(*machine(robot, parameters, hidden), every, hidden)
    load = sampled(torque, v, vd, vdd, np.zeros((len(v), states)))[:, :, 0]
    tau = motor_torques(constraints, v, load)
    return _log(robot, parameters, motion, settings, tau, hidden)


def closed_command(
    robot: Robot,
    constraints: Constraints,
    every: tuple[Limits, ...],
    settings: SimulationSettings,
    progress: Callable[[float], None] | None = None,
) -> tuple[tuple[Limits, ...], ClosedMotion]:
    """Limits of the coordinates, from those of `robot.moving`, and the motion of the settings."""
    names = [joint.name for joint in robot.moving]
    limits = tuple(every[names.index(joint.name)] for joint in robot.coordinates)
    if (asked := settings.commanded) is not None:
        closed = followed(robot, constraints, asked.q, progress)
        return widened(limits, asked), ClosedMotion(asked, closed, 1.0)

    def motion(near: tuple[Limits, ...]) -> Reference:
        return reference_motion(
            settings.motion, near, settings.duration, settings.rate, settings.seed
        )

    return limits, closed_motion(robot, constraints, limits, motion, progress)


def _log(
    robot: Robot,
    parameters: PlantParameters,
    motion: ClosedMotion,
    settings: SimulationSettings,
    tau: np.ndarray,
    hidden: tuple[HiddenEffect, ...],
) -> SimulatedLog:
    reference = motion.reference
    resolution = encoder_resolution(robot.coordinates, settings)
    faults = faults_of([joint.name for joint in robot.coordinates], hidden)
    needed = np.sqrt(np.mean(tau**2, axis=0))
    # What pushes on a machine that moves as commanded is pushed back by its motors.
    tau = tau - process_torques(settings, len(tau), needed)
    told = sampled_torques(faults, reference.time, tau)
    rms = np.sqrt(np.mean(told**2, axis=0))
    noise = np.random.default_rng([settings.seed, 3]).normal(size=tau.shape)
    values, drawn = told_once(robot, parameters.standard, parameters.drawn)
    return SimulatedLog(
        robot=robot.name,
        joints=tuple(joint.name for joint in robot.coordinates),
        driven=np.ones(tau.shape[1], dtype=bool),
        time=reference.time,
        q=quantised(reference.q, resolution),
        qc=reference.q,
        tau=told + settings.torque_noise * rms * noise,
        settings=settings,
        truth=Truth(reference.q, reference.qd, reference.qdd, tau, values, drawn, hidden),
        range_share=motion.share,
    )
