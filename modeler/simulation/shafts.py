"""What acts on the shafts of a simulated robot: the robot file's effects and the hidden ones."""

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.core.errors import RobotError
from modeler.robot import Limits, Robot
from modeler.simulation.log import HiddenEffect
from modeler.simulation.parameters import PlantParameters, find_joint_physics
from modeler.simulation.physics import HIDDEN, Act, Contribution, Shaft, Values
from modeler.simulation.rigid import RigidDynamics, compute_world_frames
from modeler.simulation.thresholds import THRESHOLDS


@dataclass(frozen=True)
class ShaftEffects:
    """What all effects together do on the shafts of a robot.

    Attributes:
        torque: (coordinates, 1) resisting torque, N m or N.
        inertia: (coordinates, coordinates) of the shafts.
        state, rate: (k, 1) inner states and their time derivatives.
        load: (coordinates, 1) symbols in these: torque that the links ask for.
        fastest: rate of the inner states at top speed, 1/s.
        temperatures: what thermometers read, by joint, degC.
    """

    torque: ca.SX
    inertia: np.ndarray
    state: ca.SX
    rate: ca.SX
    load: ca.SX
    fastest: float
    temperatures: dict[str, ca.SX]


def combine_shaft_effects(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    links: RigidDynamics,
    tie: tuple[np.ndarray, np.ndarray],
    hidden: tuple[HiddenEffect, ...] = (),
) -> ShaftEffects:
    """Returns the effects in the coordinates of `links`.

    Args:
        robot: with the effects of its file.
        parameters: of these.
        limits: in the order of `robot.moving`.
        links: their coordinates u, and the torques that the links ask for.
        tie: F and c of v = F u + c for the variables v of all moving rows.
        hidden: further effects.
    """
    turns, offset = tie
    n = turns.shape[1]
    load, torque, inertia = ca.SX.sym("load", n), ca.SX.zeros(n), np.zeros((n, n))
    speeds = {j.name: limit.speed for j, limit in zip(robot.moving_joints, limits, strict=True)}
    contributions: list[Contribution] = []
    temperatures: dict[str, ca.SX] = {}
    for name, joint, row, act, values in _iterate_shaft_effects(robot, parameters, hidden):
        turn = row @ turns  # speed of the shaft = turn . ud
        shaft = Shaft(
            position=ca.dot(ca.SX(turn), links.q) + float(row @ offset),
            speed=ca.dot(ca.SX(turn), links.qd),
            settling=THRESHOLDS.dry_friction_core_share * speeds[joint],
            name=name,
            load=ca.dot(ca.SX(turn), load),
            top=speeds[joint],
        )
        contributions.append(act(shaft, values))
        torque += ca.SX(turn) * contributions[-1].torque
        inertia += contributions[-1].inertia * np.outer(turn, turn)
        if contributions[-1].temperature is not None:
            temperatures[joint] = contributions[-1].temperature
    for effect in hidden:
        if HIDDEN[effect.effect].role == "push":
            contributions.append(_compute_push(robot, effect, links, tie))
            torque += contributions[-1].torque
    state = ca.vertcat(ca.SX(0, 1), *(c.state for c in contributions))
    rate = ca.vertcat(ca.SX(0, 1), *(c.rate for c in contributions))
    fastest = max((c.fastest for c in contributions), default=0.0)
    return ShaftEffects(torque, inertia, state, rate, load, fastest, temperatures)


def _iterate_shaft_effects(
    robot: Robot, parameters: PlantParameters, hidden: tuple[HiddenEffect, ...]
) -> Iterator[tuple[str, str, np.ndarray, Act, Values]]:
    """Name, joint, (moving rows,) r of the speed r . qd of its shaft, physics and its values."""
    names = [joint.name for joint in robot.moving_joints]
    unit = dict(zip(names, np.eye(len(names)), strict=True))
    replaced_effects = {(old, h.joint) for h in hidden for old in HIDDEN[h.effect].replaces}
    for joint in unit:
        for physics in find_joint_physics(robot, joint):
            if (physics.effect, joint) in replaced_effects:
                continue
            if physics.on_motor and joint not in robot.coupling:
                raise RobotError(
                    f"robot {robot.name}, joint {joint}: {physics.effect} needs the motor's "
                    f'coupling; add {joint} = "q{joint} + ..." under [coupling]'
                )
            turned = robot.coupling[joint] if physics.on_motor else {joint: 1.0}
            row = sum(float(share) * unit[name] for name, share in turned.items())
            values = {p: parameters.standard[p + joint] for p in physics.prefixes}
            yield f"{physics.effect}_{joint}", joint, np.asarray(row), physics.act, values
    names = [joint.name for joint in robot.coordinates]
    for effect in hidden:
        kind, joint_name = HIDDEN[effect.effect], effect.joint
        if kind.act is None or joint_name is None:
            continue
        row = unit[joint_name]
        if kind.where == "pair":
            row = row + effect.values["ratio"] * unit[names[names.index(joint_name) + 1]]
        yield f"hidden_{effect.effect}_{joint_name}", joint_name, row, kind.act, effect.values


def _compute_push(
    robot: Robot, effect: HiddenEffect, links: RigidDynamics, tie: tuple[np.ndarray, np.ndarray]
) -> Contribution:
    """-J^T F while it lasts, by the slope of the work F.p in the coordinates; a clock is a state.

    F is along the axes of the world, p a point of the last link.
    """
    values = effect.values
    turns, offset = tie
    poses = compute_world_frames(robot, ca.SX(turns) @ links.q + offset)
    frame = poses[robot.moving_joints[-1].name]
    point = frame.position + frame.rotation @ ca.SX([values[k] for k in "xyz"])
    work = ca.dot(ca.SX([values[k] for k in ("fx", "fy", "fz")]), point)
    clock = ca.SX.sym("clock")
    begun = ca.tanh((clock - values["start"]) / THRESHOLDS.push_rise_time)
    ended = ca.tanh((clock - values["start"] - values["length"]) / THRESHOLDS.push_rise_time)
    torque = -ca.jacobian(work, links.q).T * (begun - ended) / 2
    return Contribution(torque=torque, state=clock, rate=ca.SX(1.0))


# Transmissions that give way: motor and link as two bodies with a spring between them.


@dataclass(frozen=True)
class Transmissions:
    """Those of a robot that give way.

    Attributes:
        rows: places of their joints among the free ones.
        turns: (free joints, free joints + transmissions) F: positions of the links are F times
            those of the motors and, after these, how far the links are ahead of them.
        effects: of each.
    """

    rows: tuple[int, ...]
    turns: np.ndarray
    effects: tuple[HiddenEffect, ...]

    def compute_torque(self, ahead: ca.SX, rate: ca.SX) -> ca.SX:
        """Returns (transmissions, 1) torques that pull the links back to their motors, N m or N."""
        torques = [ca.SX(0, 1)]
        for i, effect in enumerate(self.effects):
            spring = HIDDEN[effect.effect].spring
            assert spring is not None
            torques.append(spring(ahead[i], rate[i], effect.values))
        return ca.vertcat(*torques)


def find_transmissions(robot: Robot, hidden: tuple[HiddenEffect, ...]) -> Transmissions:
    """Returns the hidden effects that lie between motors and links."""
    names = [joint.name for joint in robot.free_joints]
    effects = tuple(h for h in hidden if HIDDEN[h.effect].role == "transmission")
    rows = tuple(names.index(effect.joint) for effect in effects if effect.joint)
    unit = np.eye(len(names))
    return Transmissions(rows, np.hstack([unit, unit[:, rows]]), effects)


def compute_rest_states(strain: ca.Function, q: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Returns (states,) inner states of a robot at rest: links sag until their springs carry them.

    Args:
        strain: (q, z) -> torque on each such link, rising with how far it is ahead.
        q: motor positions.
        z: (states,) of a robot whose links do not sag, those of the transmissions first.
    """
    z = z.copy()
    for _ in range(THRESHOLDS.sag_sweeps if strain.size1_out(0) else 0):
        for i in range(strain.size1_out(0)):
            low, high = -THRESHOLDS.max_sag, THRESHOLDS.max_sag
            for _ in range(THRESHOLDS.sag_halvings):
                z[i] = (low + high) / 2
                pull = float(strain(q, z).full()[i, 0])
                low, high = (low, z[i]) if pull > 0 else (z[i], high)
    return z
