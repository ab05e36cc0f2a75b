"""Robots with loops, simulated: driven by a controller, or on the command exactly."""

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.robot.robot import Limits, Robot
from modeler.simulation.closed_motion import ClosedMotion, closed_motion
from modeler.simulation.closing import (
    Constraints,
    constraints_of,
    followed,
    motor_torques,
    rates,
    sampled,
    untied,
)
from modeler.simulation.control import encoder_resolution, faults_of, quantised, sampled_torques
from modeler.simulation.hidden import HiddenEffect
from modeler.simulation.hidden_bodies import machine
from modeler.simulation.hidden_draw import complete_effects
from modeler.simulation.links import told_once
from modeler.simulation.log import SimulatedLog, Truth
from modeler.simulation.parameters import PlantParameters, plant_parameters
from modeler.simulation.plant import Plant, torque_function
from modeler.simulation.portable_math import portable
from modeler.simulation.process import process_torques
from modeler.simulation.rigid import RigidDynamics, rigid_dynamics
from modeler.simulation.settings import SimulationSettings
from modeler.simulation.shafts import ShaftEffects, shaft_effects
from modeler.simulation.trajectory import Reference, motion_limits, reference_motion, widened


def build_closed_plant(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    constraints: Constraints,
    hidden: tuple[HiddenEffect, ...] = (),
) -> Plant:
    """The plant whose q are the coordinates; the other joints are the first of its inner states.

    With J the constraints' slope, vd = G qd and vdd = G qdd + g in all moving rows, where
    J_s G_s = -J_q and J_s g_s = -J' vd by least squares. The principle of virtual work gives
    G^T M G qdd + G^T (M g + h) = tau: no constraint force does work.

    Args:
        robot: with loops.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`.
        constraints: its loops and relations.
        hidden: further effects on shafts, all their values given.
    """
    links = rigid_dynamics(robot, parameters.bodies)
    effects = shaft_effects(robot, parameters, limits, links, untied(robot), hidden)
    return _assembled(robot, links, effects, constraints)


def inner_states(plant: Plant, constraints: Constraints, v: np.ndarray) -> np.ndarray:
    """(n, plant.states) of a plant at rest in postures v (n, moving rows)."""
    z = np.zeros((len(v), plant.states))
    z[:, : len(constraints.others)] = v[:, constraints.others]
    return z


@dataclass(frozen=True)
class _Following:
    """All moving rows by the coordinates: vd = G qd, vdd = G qdd + g."""

    q: ca.SX
    qd: ca.SX
    follow: ca.SX
    v: ca.SX
    vd: ca.SX
    G: ca.SX
    g: ca.SX
    closer: ca.SX  # follow after a step of Newton


def _following(constraints: Constraints, rows: int) -> _Following:
    given, others = constraints.given, constraints.others
    q, qd = (ca.SX.sym(name, len(given)) for name in ("q", "qd"))
    follow = ca.SX.sym("follow", len(others))
    v, G, g = ca.SX.zeros(rows), ca.SX.zeros(rows, len(given)), ca.SX.zeros(rows)
    v[given], v[others] = q, follow
    slope = _at(constraints.slope, v)
    inner = slope[:, others]
    factors = ca.ldl(inner.T @ inner, False)  # L D L' without pivoting: away from singularities

    def least(right: ca.SX) -> ca.SX:
        return ca.ldl_solve(inner.T @ right, *factors)

    G[given, :], G[others, :] = ca.SX.eye(len(given)), -least(slope[:, given])
    g[others] = -least(_at(constraints.curvature, v, G @ qd))
    closer = follow - least(_at(constraints.value, v))
    return _Following(q, qd, follow, v, G @ qd, G, g, closer)


def _at(function: ca.Function, *arguments: ca.SX) -> ca.SX:
    """The function's expression, not a call of it."""
    return function.call(list(arguments), True, False)[0]


def _assembled(
    robot: Robot, links: RigidDynamics, effects: ShaftEffects, constraints: Constraints
) -> Plant:
    way = _following(constraints, len(robot.moving))
    q, qd, G, vd = way.q, way.qd, way.G, way.vd
    qdd, tau = (ca.SX.sym(name, q.shape[0]) for name in ("qdd", "tau"))
    z = ca.vertcat(way.follow, effects.state)
    tree = [links.inertia + ca.SX(effects.inertia), links.bias, effects.torque, effects.rate]
    tree += [links.kinetic, links.potential, *effects.temperatures.values()]
    M, bias, friction, rate, kinetic, potential, *readings = ca.substitute(
        tree, [links.q, links.qd], [way.v, vd]
    )
    inertia, load = G.T @ M @ G, G.T @ (M @ way.g + bias + friction)
    rotors = ca.dot(vd, ca.SX(effects.inertia) @ vd) / 2
    solved = ca.ldl_solve(tau - load, *ca.ldl(inertia, False))
    z_rate = ca.vertcat(vd[constraints.others], rate)
    return Plant(
        joints=tuple(joint.name for joint in robot.coordinates),
        driven=np.array([joint.actuated for joint in robot.coordinates]),
        states=z.shape[0],
        acceleration=_function("acceleration", [q, qd, z, tau], [solved, z_rate]),
        torque=_function("torque", [q, qd, qdd, z], [inertia @ qdd + load]),
        inertia=_function("inertia", [q, z], [ca.densify(inertia)]),
        resistance=_function("resistance", [q, qd, z], [G.T @ friction]),
        energy=_function("energy", [q, qd, z], [kinetic + rotors, potential]),
        strain=_function("strain", [q, z], [ca.SX(0, 1)]),
        fastest=effects.fastest,
        temperatures=_function("temperatures", [z], [ca.vertcat(ca.SX(0, 1), *readings)]),
        warmed=tuple(effects.temperatures),
        closer=_function("closer", [q, z], [ca.densify(ca.vertcat(way.closer, effects.state))]),
    )


def _function(name: str, inputs: list[ca.SX], outputs: list[ca.SX]) -> ca.Function:
    return portable(ca.Function(name, inputs, [ca.cse(output) for output in outputs]))


# Measurements of robots with loops: the commanded motion, carried out exactly.
#
# Drives of parallel robots are stiff and well tuned: the actuated joints are where they are
# commanded to be, the others follow, and the motors give what that needs. No controller is
# simulated; for one see the plant above.


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
