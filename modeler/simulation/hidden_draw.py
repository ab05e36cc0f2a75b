"""Hidden effects made complete: joints and values that were not given are drawn from the seed."""

from collections.abc import Sequence

import casadi as ca
import numpy as np

from modeler.core.errors import RobotError
from modeler.robot import Limits, Robot
from modeler.simulation import closing
from modeler.simulation.log import HiddenEffect, SimulationSettings
from modeler.simulation.parameters import PlantParameters, estimate_joint_scales
from modeler.simulation.physics import HIDDEN, HiddenKind, ShaftScale, Site
from modeler.simulation.plant import build_torque_function, find_last_link
from modeler.simulation.portable_math import round_to_ten_digits
from modeler.simulation.rigid import compute_gravity_vector, compute_world_frames
from modeler.simulation.thresholds import THRESHOLDS
from modeler.simulation.trajectory import build_exciting_reference

# How large a torque on a joint of a robot with loops is for the motors, which carry them.


_DURATION, _RATE = 6.0, 50.0  # s and Hz of the motion that is looked at


def compute_motor_amplitudes(
    robot: Robot, parameters: PlantParameters, limits: Sequence[Limits], joint: str, seed: int
) -> tuple[float, float]:
    """Returns (torque, speed) of a joint that are large for the closed machine around it.

    The torque is the one that asks of some motor as much as its rms torque tau_m, and of none
    more: 1 / max_m(rms(G_m) / tau_m), with G_m = d speed / d speed of motor m; of a joint with a
    motor, its rms torque. The speed is the joint's 98 % quantile. Both along an exciting motion of
    the closed machine.

    Args:
        robot: with loops.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`.
        joint: name of a row.
        seed: of the motion.

    Raises:
        RobotError: `home` does not close.
        DataError: the loops close on no such motion.
    """
    constraints = closing.build_constraints(robot)
    names = [moving.name for moving in robot.moving_joints]
    coordinate_limits = tuple(limits[names.index(moving.name)] for moving in robot.coordinates)
    motion = closing.find_closed_motion(
        robot,
        constraints,
        coordinate_limits,
        lambda near: build_exciting_reference(near, _DURATION, _RATE, seed),
    )
    v, qd = motion.v, motion.reference.qd
    vd, vdd = closing.compute_rates(constraints, v, qd, motion.reference.qdd)
    torque, states = build_torque_function(robot, parameters, tuple(limits))
    load = closing.evaluate_samples(torque, v, vd, vdd, np.zeros((len(v), states)))[:, :, 0]
    needed = np.sqrt(np.mean(closing.compute_motor_torques(constraints, v, load) ** 2, axis=0))
    row = names.index(joint)
    shares = []
    for m, torque_m in enumerate(needed):
        motor_speeds = np.zeros_like(qd)
        motor_speeds[:, m] = 1.0
        slope = closing.compute_rates(constraints, v, motor_speeds, np.zeros_like(qd))[0][:, row]
        if torque_m > 0.0:
            shares.append(float(np.sqrt(np.mean(slope**2))) / torque_m)
    speed = float(np.quantile(np.abs(vd[:, row]), THRESHOLDS.top_speed_quantile))
    return (1.0 / max(shares) if any(shares) else 1.0), speed or limits[row].speed


_OWN = ("Fv", "Fs", "Ia")
_WHY_NONE = {
    "pair": "a joint with a motor, and another one after it",
    "geared": "a joint with a rotor inertia (effect rotor_inertia in the robot file)",
    "lever": "a joint that turns",
    "link": "a link before the last one",
    "passive": "a joint without motor in a loop",
}


def complete_effects(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    settings: SimulationSettings,
) -> tuple[HiddenEffect, ...]:
    """Returns the hidden effects of the settings with a joint and all values.

    What is drawn depends on `parameter_seed`, and not on the other effects that are hidden; the
    time at which an external force pushes also on the duration.

    Args:
        robot: its table and effects.
        parameters: of these.
        limits: in the order of `robot.moving`.
        settings: with the hidden effects, complete or not.

    Raises:
        RobotError: an effect, joint or value that this robot cannot have; says which it can.
    """
    if not settings.hidden:
        return ()
    rng = np.random.default_rng([settings.parameter_seed, 6])
    scales = estimate_joint_scales(robot, parameters.bodies, limits, rng)
    effects: list[HiddenEffect] = []
    for k, request in enumerate(settings.hidden):
        before = sum(other.effect == request.effect for other in settings.hidden[:k])
        seed = [settings.parameter_seed, 7, before, *request.effect.encode()]
        rng = np.random.default_rng(seed)
        kind, joint = _choose_kind_and_joint(robot, parameters, request, rng)
        site = _build_site(robot, parameters, limits, scales, settings, kind, joint)
        values = _complete_values(robot, kind, request, site, rng)
        effects.append(HiddenEffect(request.effect, joint, values))
    _check_together(robot, effects)
    return tuple(effects)


def _choose_kind_and_joint(
    robot: Robot, parameters: PlantParameters, request: HiddenEffect, rng: np.random.Generator
) -> tuple[HiddenKind, str | None]:
    where = f"robot {robot.name}, hidden effect {request.effect}"
    kind = HIDDEN.get(request.effect)
    if kind is None:
        raise RobotError(f"{where}: no such effect; expected one of {', '.join(HIDDEN)}")
    if robot.loops and not kind.loops:
        able = ", ".join(name for name, other in HIDDEN.items() if other.loops)
        raise RobotError(f"{where}: not simulated for robots with loops; expected one of {able}")
    if kind.role == "gravity" and not np.any(compute_gravity_vector(robot)):
        raise RobotError(f"{where}: the robot has no gravity; state one, or hide another effect")
    if kind.where == "system":
        if request.joint is not None:
            raise RobotError(
                f"{where}: got joint {request.joint}; expected none, it belongs to the whole "
                "machine"
            )
        return kind, None
    places = _find_places(robot, parameters, kind)
    if not places:
        needs = _WHY_NONE.get(kind.where, "a joint with a motor")
        raise RobotError(f"{where}: no place for it; expected {needs}")
    # The first link of an arm hardly depends on what is on it.
    inner = places[1:] if kind.where == "link" and len(places) > 1 else places
    drawn = str(rng.choice(inner))  # also where one is given: values do not depend on that
    if request.joint is not None and request.joint not in places:
        raise RobotError(f"{where}: got joint {request.joint}; expected one of {', '.join(places)}")
    return kind, request.joint or drawn


def _find_places(robot: Robot, parameters: PlantParameters, kind: HiddenKind) -> list[str]:
    """Joints or links that may have the effect."""
    joints = [joint for joint in robot.coordinates if joint.actuated]
    names = [joint.name for joint in joints]
    if kind.where == "lever":
        return [joint.name for joint in joints if joint.is_revolute]
    if kind.where == "pair":
        pairs = zip(robot.coordinates, robot.coordinates[1:], strict=False)
        pair_joints = [one.name for one, other in pairs if one.is_revolute == other.is_revolute]
        return [name for name in pair_joints if name in names]
    if kind.where == "geared":
        return [name for name in names if parameters.standard.get(f"Ia{name}", 0.0) > 0]
    if kind.where == "link":
        return [
            joint.name for joint in robot.moving_joints[:-1] if joint.name not in robot.platform
        ]
    if kind.where == "passive":
        rows = robot.moving_joints if robot.loops else ()
        excluded_rows = (*robot.platform, *robot.relations)
        return [
            joint.name for joint in rows if not joint.actuated and joint.name not in excluded_rows
        ]
    return names


def _build_site(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    scales: Sequence[ShaftScale],
    settings: SimulationSettings,
    kind: HiddenKind,
    joint: str | None,
) -> Site:
    names = [moving.name for moving in robot.moving_joints]
    row = names.index(find_last_link(robot) if joint is None else joint)
    scale, limit, name = scales[row], limits[row], names[row]
    standard = parameters.standard
    values = {p: standard[p + name] for p in _OWN if p + name in standard}
    # With what the robot file knows of friction and rotor, in the same motion.
    share = THRESHOLDS.lively_rms_share
    rotor = values.get("Ia", 0.0) * share * limit.acceleration
    viscous = values.get("Fv", 0.0) * share * limit.speed
    parts = (scale.torque, rotor, viscous, values.get("Fs", 0.0))
    torque, speed, inertia = float(np.linalg.norm(parts)), scale.speed, scale.inertia
    if kind.where == "pair":  # it acts on the next joint too: what is large for the weaker one
        motors = [names.index(other.name) for other in robot.coordinates]
        after = scales[motors[motors.index(row) + 1]]
        torque, inertia = min(torque, after.torque), min(inertia, after.inertia)
    elif joint is not None and robot.loops and kind.where in ("joint", "lever", "passive"):
        seed = settings.parameter_seed
        torque, joint_speed = compute_motor_amplitudes(robot, parameters, limits, joint, seed)
        # What no motor commands is as fast as the loops make it.
        speed = joint_speed if kind.where == "passive" else speed
    # Torque of a force of 1 N on the last body, per rms torque of the joint on which it acts most.
    q, last = ca.SX.sym("q", len(limits)), robot.moving_joints[-1].name
    frame = compute_world_frames(robot, q)[last]
    point = frame.position + frame.rotation @ parameters.bodies[last].centre
    slope = ca.Function("slope", [q], [ca.jacobian(point, q)])
    arms = np.linalg.norm(slope([(li.lower + li.upper) / 2 for li in limits]).full(), axis=0)
    return Site(
        torque=torque,
        speed=speed,
        inertia=inertia,
        span=limit.upper - limit.lower,
        angular=robot.moving_joints[row].is_revolute,
        joint_parameters=values,
        body=parameters.bodies[name],
        mass=sum(body.mass for body in parameters.bodies.values()),
        lever=float(np.max(arms / [each.torque for each in scales])),
        rate=settings.rate,
        duration=settings.duration,
    )


def _complete_values(
    robot: Robot, kind: HiddenKind, request: HiddenEffect, site: Site, rng: np.random.Generator
) -> dict[str, float]:
    where = f"robot {robot.name}, hidden effect {kind.effect}"
    values = {name: round_to_ten_digits(value) for name, value in kind.draw(rng, site).items()}
    for name, value in request.values.items():
        if name not in values:
            raise RobotError(
                f"{where}: got a value {name}; expected some of {', '.join(values) or 'none'}"
            )
        if not np.isfinite(value) or (value <= 0 and name not in kind.signed):
            raise RobotError(f"{where}, {name}: got {value:g}; expected a number above 0")
    return values | {name: float(value) for name, value in request.values.items()}


def _check_together(robot: Robot, effects: list[HiddenEffect]) -> None:
    """Nothing, unless two effects stand for the same part of the same joint."""
    taken: dict[tuple[str, str | None], str] = {}
    for effect in effects:
        kind = HIDDEN[effect.effect]
        parts = (*kind.replaces, *(["transmission"] if kind.role == "transmission" else []))
        for part in parts:
            if (part, effect.joint) in taken:
                other = taken[part, effect.joint]
                raise RobotError(
                    f"robot {robot.name}, joint {effect.joint}: hidden effects {other} and "
                    f"{effect.effect} both are its {part}; hide them on different joints"
                )
            taken[part, effect.joint] = effect.effect
