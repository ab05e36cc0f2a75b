"""The simulated robot: rigid links and effects as one ordinary differential equation."""

from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.core.errors import RobotError
from modeler.robot import Limits, Robot
from modeler.simulate.parameters import PlantParameters, effects_of
from modeler.simulate.physics import EffectPhysics, Shaft
from modeler.simulate.rigid import RigidDynamics, rigid_dynamics, tied_dynamics
from modeler.simulate.ties import tree_from_free, untied

_CORE = 1e-3  # width of the smooth core of dry friction, relative to the top speed


@dataclass(frozen=True)
class Plant:
    """M(q) qdd + h(q, qd) + friction(q, qd, z) = tau, and z' = f(q, qd, z) of inner states.

    All functions take and give CasADi columns: q, qd, qdd, tau (joints), z (states).

    Attributes:
        joints: names, in the order of q.
        driven: (joints,) True where a motor sits.
        states: number of inner states z of effects; all 0 at the start.
        acceleration: (q, qd, z, tau) -> (qdd, z').
        torque: (q, qd, qdd, z) -> tau.
        inertia: (q) -> M, rotors included.
        resistance: (q, qd, z) -> torque that the effects take from the motors.
        energy: (q, qd) -> (kinetic energy, rotors included; potential energy), J.
    """

    joints: tuple[str, ...]
    driven: np.ndarray
    states: int
    acceleration: ca.Function
    torque: ca.Function
    inertia: ca.Function
    resistance: ca.Function
    energy: ca.Function


@dataclass(frozen=True)
class _Effects:
    """All effects together: resisting torque, inertia of shafts, inner states and their rates."""

    torque: ca.SX
    inertia: np.ndarray
    state: ca.SX
    rate: ca.SX


def build_plant(robot: Robot, parameters: PlantParameters, limits: tuple[Limits, ...]) -> Plant:
    """The plant with these parameters, in the coordinates of the free joints.

    Args:
        robot: without loops.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`; they set the speed scale of dry friction.

    Raises:
        RobotError: a joint that nothing gives an inertia, or an effect that cannot be simulated.
    """
    links = rigid_dynamics(robot, parameters.bodies)
    tie = tree_from_free(robot)
    if robot.relations:
        links = tied_dynamics(links, *tie)
    effects = _effects(robot, parameters, limits, links, tie)
    q, qd, z = links.q, links.qd, effects.state
    n = len(robot.free)
    tau, qdd = ca.SX.sym("tau", n), ca.SX.sym("qdd", n)
    inertia = links.inertia + ca.SX(effects.inertia)
    load = links.bias + effects.torque
    diagonal, lower, order = ca.ldl(inertia, False)  # M = L D L': no pivoting for M > 0
    solved = ca.ldl_solve(tau - load, diagonal, lower, order)
    rotors = ca.dot(qd, ca.SX(effects.inertia) @ qd) / 2
    plant = Plant(
        joints=tuple(joint.name for joint in robot.free),
        driven=np.array([joint.actuated for joint in robot.free]),
        states=z.shape[0],
        acceleration=ca.Function("acceleration", [q, qd, z, tau], [ca.cse(solved), effects.rate]),
        torque=ca.Function("torque", [q, qd, qdd, z], [inertia @ qdd + load]),
        inertia=ca.Function("inertia", [q], [ca.densify(inertia)]),
        resistance=ca.Function("resistance", [q, qd, z], [effects.torque]),
        energy=ca.Function("energy", [q, qd], [links.kinetic + rotors, links.potential]),
    )
    _check_inertia(robot, plant, of_free(robot, limits))
    return plant


def torque_function(
    robot: Robot, parameters: PlantParameters, limits: tuple[Limits, ...]
) -> tuple[ca.Function, int]:
    """(q, qd, qdd, z) -> tau of all moving rows, untied, and the number of states z."""
    links = rigid_dynamics(robot, parameters.bodies)
    effects = _effects(robot, parameters, limits, links, untied(robot))
    qdd = ca.SX.sym("qdd", len(limits))
    torque = (links.inertia + ca.SX(effects.inertia)) @ qdd + links.bias + effects.torque
    inputs = [links.q, links.qd, qdd, effects.state]
    return ca.Function("torque", inputs, [ca.cse(torque)]), effects.state.shape[0]


def of_free(robot: Robot, limits: tuple[Limits, ...]) -> tuple[Limits, ...]:
    """Those of `robot.free` among limits in the order of `robot.moving`."""
    pairs = zip(robot.moving, limits, strict=True)
    return tuple(limit for joint, limit in pairs if joint.name not in robot.relations)


def sample_poses(limits: tuple[Limits, ...], count: int = 16) -> np.ndarray:
    """(count, joints) poses spread over the range of motion, the middle first; always the same."""
    lower, upper = (np.array([getattr(li, k) for li in limits]) for k in ("lower", "upper"))
    share = np.random.default_rng(0).uniform(size=(count, len(limits)))
    share[0] = 0.5
    return lower + share * (upper - lower)


def _effects(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    links: RigidDynamics,
    tie: tuple[np.ndarray, np.ndarray],
) -> _Effects:
    turns, offset = tie
    n = turns.shape[1]
    torque, inertia = ca.SX.zeros(n), np.zeros((n, n))
    states, rates = [ca.SX(0, 1)], [ca.SX(0, 1)]
    for joint, limit in zip(robot.moving, limits, strict=True):
        for physics in effects_of(robot, joint.name):
            all_joints = _shaft_row(robot, joint.name, physics)
            row = all_joints @ turns
            shaft = Shaft(
                position=ca.dot(ca.SX(row), links.q) + float(all_joints @ offset),
                speed=ca.dot(ca.SX(row), links.qd),
                settling=_CORE * limit.speed,
                name=f"{physics.effect}_{joint.name}",
            )
            values = {p: parameters.standard[p + joint.name] for p in physics.prefixes}
            contribution = physics.act(shaft, values)
            torque += ca.SX(row) * contribution.torque
            inertia += contribution.inertia * np.outer(row, row)
            states.append(contribution.state)
            rates.append(contribution.rate)
    return _Effects(torque, inertia, ca.vertcat(*states), ca.vertcat(*rates))


def _shaft_row(robot: Robot, joint: str, physics: EffectPhysics) -> np.ndarray:
    """(joints,) shaft speed = row . qd."""
    names = [moving.name for moving in robot.moving]
    row = np.zeros(len(names))
    if not physics.on_motor:
        row[names.index(joint)] = 1.0
        return row
    if joint not in robot.coupling:
        raise RobotError(
            f"robot {robot.name}, joint {joint}: {physics.effect} needs the motor's coupling; "
            f'add {joint} = "q{joint} + ..." under [coupling]'
        )
    for name, coefficient in robot.coupling[joint].items():
        row[names.index(name)] = coefficient
    return row


def _check_inertia(robot: Robot, plant: Plant, limits: tuple[Limits, ...]) -> None:
    for pose in sample_poses(limits):
        values, vectors = np.linalg.eigh(plant.inertia(pose).full())
        if values[0] <= 1e-12 * values[-1]:
            joint = plant.joints[int(np.argmax(np.abs(vectors[:, 0])))]
            raise RobotError(
                f"robot {robot.name}, joint {joint}: nothing gives it an inertia (smallest "
                f"eigenvalue {values[0]:.3g} of the inertia matrix); state a mass or a rotor "
                "inertia"
            )
