"""The simulated measurement: plant, controller and sensors in closed loop, or the exact command."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from modeler.core.errors import DataError
from modeler.robot import Limits, Robot, joint_directions
from modeler.simulation.closing import (
    ClosedMotion,
    Constraints,
    closed_motion,
    constraints_of,
    followed,
    motor_torques,
    rates,
    sampled,
)
from modeler.simulation.control import (
    ControllerState,
    Faults,
    Gains,
    control,
    encoder_resolution,
    faults_of,
    logged_torques,
    process_torques,
    quantised,
    sampled_torques,
    sensed,
    tuned_gains,
    where_read,
)
from modeler.simulation.hidden_draw import complete_effects
from modeler.simulation.log import SimulatedLog, Truth
from modeler.simulation.parameters import PlantParameters, by_shared_names, plant_parameters
from modeler.simulation.plant import (
    FastFunction,
    Plant,
    build_plant,
    felt_inertia,
    inner_states,
    machine,
    of_free,
    steps_per_tick,
    tick_function,
    torque_function,
)
from modeler.simulation.settings import HiddenEffect, SimulationSettings, check_settings
from modeler.simulation.shafts import settled
from modeler.simulation.trajectory import (
    Reference,
    exciting_reference,
    motion_limits,
    one_joint_reference,
    point_to_point_reference,
    widened,
)

_REPORT_EVERY = 500  # ticks between looks at the tracking error, and calls of the callback
_THERMOMETER = 0.01  # K, resolution
_LOOKED_AT = 8  # postures of a closed robot, for the stiffest of its motions
_LOST = 0.5  # tracking error, in ranges of motion, at which the controller has lost the robot


@dataclass(frozen=True, eq=False)
class PlantTask:
    """What the machine is, and what it is to do.

    Attributes:
        plant: the machine.
        limits: of its joints.
        reference: the commanded motion.
        along: (n, states) inner states of the plant at rest along the reference.
        share: of the range of motion.
    """

    plant: Plant
    limits: tuple[Limits, ...]
    reference: Reference
    along: np.ndarray
    share: float


def simulate(
    robot: Robot,
    settings: SimulationSettings | None = None,
    progress: Callable[[float], None] | None = None,
) -> SimulatedLog:
    """A measurement of `robot` under closed-loop control.

    With loops the commanded motion is carried out exactly, unless the settings ask for the
    controller.

    The robot's effects are simulated as physics, and so are those of `settings.hidden`, which the
    robot file lacks. The same robot and settings give the same bits.

    Args:
        robot: geometry, effects, and as many nominal parameters as are known.
        settings: motion, controller, sensors, seeds.
        progress: called with the share done, 0 to 1.

    Raises:
        RobotError: parameters no rigid body has, bad limits, effects that cannot be simulated, a
            `home` that does not close.
        DataError: bad settings, friction too stiff, a robot that the controller loses, or loops
            that do not close on the motion; says what to change.
    """
    settings = settings or SimulationSettings()
    check_settings(settings, tuple(joint.name for joint in robot.coordinates))
    every = motion_limits(robot, settings.limits)
    if robot.loops and not settings.controller:
        return _on_command(robot, every, settings, progress)
    parameters = plant_parameters(robot, every, settings.parameter_seed)
    hidden = complete_effects(robot, parameters, every, settings)
    task = task_of(robot, parameters, every, settings, hidden)
    plant, reference, n = task.plant, task.reference, len(task.plant.joints)
    needed = needed_torques(task)
    # Saturation: as set, else twice the torque that the commanded motion needs.
    most = zip(plant.joints, 2 * np.max(np.abs(needed), axis=0), strict=True)
    limits = [settings.torque_limits.get(name, twice) for name, twice in most]
    highest = np.where(plant.driven, limits, 0.0)
    gains = tuned_gains(settings.rate, settings.bandwidth, settings.feedforward, highest)
    faults = faults_of(plant.joints, hidden)
    resolution = encoder_resolution(robot.coordinates, settings)
    random = process_torques(settings, len(reference.time), np.sqrt(np.mean(needed**2, axis=0)))
    states, tau, measured = _closed_loop(task, gains, faults, resolution, random, progress)
    q, qd, z = states[:, :n], states[:, n : 2 * n], states[:, 2 * n :]
    samples = [each.T for each in (q, qd, z, tau + random)]
    qdd = plant.acceleration.map(len(q))(*samples)[0].full().T.copy()
    logged = logged_torques(faults, reference.time, tau)
    truth = Truth(q, qd, qdd, tau, *by_shared_names(robot, parameters), hidden)
    return _log(robot, settings, task, truth, measured, logged, _thermometers(plant, z))


def _on_command(
    robot: Robot,
    every: tuple[Limits, ...],
    settings: SimulationSettings,
    progress: Callable[[float], None] | None,
) -> SimulatedLog:
    """A measurement of a robot with loops that carries out the commanded motion exactly.

    Drives of parallel robots are stiff and well tuned: the actuated joints are where they are
    commanded to be, the others follow, and the motors give what that needs. Torques are those of
    the instant, by the equations of motion of the open tree and Lagrange multipliers for what ties
    it.
    """
    constraints = constraints_of(robot)
    _, motion = _closed_command(robot, constraints, every, settings, progress)
    parameters = plant_parameters(robot, every, settings.parameter_seed)
    hidden = complete_effects(robot, parameters, every, settings)
    v, reference = motion.v, motion.reference
    vd, vdd = rates(constraints, v, reference.qd, reference.qdd)
    torque, states = torque_function(*machine(robot, parameters, hidden), every, hidden)
    load = sampled(torque, v, vd, vdd, np.zeros((len(v), states)))[:, :, 0]
    needed = motor_torques(constraints, v, load)
    # What pushes on a machine that moves as commanded is pushed back by its motors.
    rms = np.sqrt(np.mean(needed**2, axis=0))
    tau = needed - process_torques(settings, len(needed), rms)
    faults = faults_of([joint.name for joint in robot.coordinates], hidden)
    measured = quantised(reference.q, encoder_resolution(robot.coordinates, settings))
    logged = sampled_torques(faults, reference.time, tau)
    moved = (reference.q, reference.qd, reference.qdd, tau)
    truth = Truth(*moved, *by_shared_names(robot, parameters), hidden)
    return _log(robot, settings, motion, truth, measured, logged, {})


def _closed_command(
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

    commanded = partial(_commanded, settings)
    return limits, closed_motion(robot, constraints, limits, commanded, progress)


def _commanded(
    settings: SimulationSettings, limits: tuple[Limits, ...], directions: np.ndarray | None = None
) -> Reference:
    """The motion of that name within limits."""
    timed = limits, settings.duration, settings.rate, settings.seed
    if settings.motion == "one-joint":
        return one_joint_reference(*timed, directions)
    alike = settings.motion == "point-to-point"
    return point_to_point_reference(*timed) if alike else exciting_reference(*timed)


def task_of(
    robot: Robot,
    parameters: PlantParameters,
    every: tuple[Limits, ...],
    settings: SimulationSettings,
    hidden: tuple[HiddenEffect, ...],
) -> PlantTask:
    """The machine under a controller, with these parameters and limits of `robot.moving`."""
    real = machine(robot, parameters, hidden)
    if robot.loops:
        constraints = constraints_of(robot)
        limits, motion = _closed_command(robot, constraints, every, settings)
        plant = build_plant(*real, every, hidden, constraints)
        along = inner_states(plant, constraints, motion.v)
        return PlantTask(plant, limits, motion.reference, along, motion.share)
    limits = of_free(robot, every)
    if (reference := settings.commanded) is not None:
        limits = widened(limits, reference)
    else:
        # How the coordinates move with each joint that has a motor.
        ways = np.array([*joint_directions(robot).values()])
        passive = [k for k, joint in enumerate(robot.coordinates) if not joint.actuated]
        driven = ways[~np.any(ways[:, passive] != 0, axis=1)]
        reference = _commanded(settings, limits, driven)
    plant = build_plant(*real, every, hidden)
    return PlantTask(plant, limits, reference, np.zeros((len(reference.time), plant.states)), 1.0)


def needed_torques(task: PlantTask) -> np.ndarray:
    """(about 500, joints) torques of the commanded motion."""
    reference = task.reference
    thinned = slice(None, None, max(1, reference.time.size // 500))
    motion = (reference.q, reference.qd, reference.qdd, task.along)
    samples = [values[thinned].T for values in motion]
    return np.asarray(task.plant.torque.map(samples[0].shape[1])(*samples).full().T)


def _closed_loop(
    task: PlantTask,
    gains: Gains,
    faults: Faults,
    resolution: np.ndarray,
    random: np.ndarray,
    progress: Callable[[float], None] | None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All ticks: read the encoders, hold the torque asked for one tick ago, move on, control.

    Args:
        task: machine and motion.
        gains: of the controller.
        faults: of the encoders.
        resolution: (joints,) of the encoders.
        random: (n, joints) torque on the machine beside the motors', as held.
        progress: called with the share done, 0 to 1.

    Returns:
        (n, 2 joints + inner states) states and (n, joints) torques held from each tick on, and
        (n, joints) encoder positions.
    """
    plant, reference = task.plant, task.reference
    n, ticks = len(plant.joints), reference.time.size
    start, rest = where_read(faults, reference.q[0]), np.zeros(n)
    x = np.concatenate([start, rest, settled(plant.strain, start, task.along[0])])
    # The brakes open with the torque that carries the robot, as drives remember it.
    torque = plant.torque(x[:n], rest, rest, x[2 * n :]).full().ravel()
    torque = np.clip(torque, -gains.highest, gains.highest)
    state = ControllerState(quantised(sensed(faults, x[:n]), resolution), rest, torque)
    steps = steps_per_tick(plant, task.limits, gains.tick, postures_of(task))
    advance = FastFunction(tick_function(plant, gains.tick, steps))
    mass = FastFunction(felt_inertia(plant))
    states, torques, measured = (
        np.empty((ticks, x.size)),
        np.empty((ticks, n)),
        np.empty((ticks, n)),
    )
    for begin in range(0, ticks, _REPORT_EVERY):
        with np.errstate(over="ignore", invalid="ignore"):  # a lost robot is reported below
            for k in range(begin, min(begin + _REPORT_EVERY, ticks)):
                states[k], torques[k] = x, torque
                measured[k] = quantised(sensed(faults, x[:n]), resolution)
                inertia = mass(measured[k], x[2 * n :]).reshape(n, n)
                x = advance(x, torque + random[k])
                command = reference.q[k], reference.qd[k], reference.qdd[k]
                state, torque = control(gains, state, inertia, measured[k], command)
        _check_kept(task, begin, states[begin : k + 1, :n])
        if progress is not None:
            progress((k + 1) / ticks)
    return states, torques, measured


def postures_of(task: PlantTask) -> tuple[np.ndarray, np.ndarray] | None:
    """Some of the commanded ones, where not all that the limits hold can be reached."""
    if task.plant.closer is None:
        return None
    some = np.linspace(0, len(task.along) - 1, _LOOKED_AT).astype(int)
    return task.reference.q[some], task.along[some]


def _check_kept(task: PlantTask, begin: int, q: np.ndarray) -> None:
    """Nothing, if the driven joints are near their commands in the samples from `begin` on."""
    plant, reference = task.plant, task.reference
    widths = np.array([limit.upper - limit.lower for limit in task.limits])
    error = np.abs(q - reference.q[begin : begin + len(q)]) / widths
    lost = ~(error <= _LOST) & plant.driven | ~np.isfinite(q)
    if np.any(lost):
        sample, joint = np.argwhere(lost)[0]
        raise DataError(
            f"simulation: the controller lost joint {plant.joints[joint]} at "
            f"{reference.time[begin + sample]:.3f} s; expected it to stay within half its range "
            "of the command; lower the speed limits or the bandwidth, or raise the torque limit"
        )


def _log(
    robot: Robot,
    settings: SimulationSettings,
    made: PlantTask | ClosedMotion,
    truth: Truth,
    measured: np.ndarray,
    logged: np.ndarray,
    further: Mapping[str, np.ndarray],
) -> SimulatedLog:
    """Of encoder positions and torques before noise."""
    rms = np.sqrt(np.mean(logged**2, axis=0))
    noise = np.random.default_rng([settings.seed, 3]).normal(size=logged.shape)

    return SimulatedLog(
        robot=robot.name,
        joints=tuple(joint.name for joint in robot.coordinates),
        driven=np.array([joint.actuated for joint in robot.coordinates]),
        time=made.reference.time,
        q=measured,
        qc=made.reference.q,
        tau=logged + settings.torque_noise * rms * noise,
        settings=settings,
        truth=truth,
        further=further,
        range_share=made.share,
    )


def _thermometers(plant: Plant, z: np.ndarray) -> dict[str, np.ndarray]:
    """Readings by column name, degC."""
    if not plant.warmed:
        return {}
    readings = plant.temperatures.map(len(z))(z.T).full()
    return {
        f"temperature{joint}": np.round(values / _THERMOMETER) * _THERMOMETER
        for joint, values in zip(plant.warmed, readings, strict=True)
    }
