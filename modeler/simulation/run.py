"""The simulated measurement: plant, controller and sensors in closed loop."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.core.errors import DataError
from modeler.robot.motors import joint_directions
from modeler.robot.robot import Limits, Robot
from modeler.simulation.closed import (
    build_closed_plant,
    closed_command,
    inner_states,
    simulate_closed,
)
from modeler.simulation.closing import constraints_of
from modeler.simulation.control import (
    ControllerState,
    Faults,
    Gains,
    control,
    encoder_resolution,
    faults_of,
    logged_torques,
    quantised,
    sensed,
    tuned_gains,
    where_read,
)
from modeler.simulation.hidden import HiddenEffect
from modeler.simulation.hidden_bodies import machine
from modeler.simulation.hidden_draw import complete_effects
from modeler.simulation.links import told_once
from modeler.simulation.log import SimulatedLog, Truth
from modeler.simulation.parameters import PlantParameters, plant_parameters
from modeler.simulation.plant import (
    FastFunction,
    Plant,
    build_plant,
    felt_inertia,
    of_free,
    steps_per_tick,
    tick_function,
)
from modeler.simulation.process import process_torques
from modeler.simulation.settings import SimulationSettings, check_settings
from modeler.simulation.shafts import settled
from modeler.simulation.trajectory import Reference, motion_limits, reference_motion, widened

_REPORT_EVERY = 500  # ticks between looks at the tracking error, and calls of the callback
_THERMOMETER = 0.01  # K, resolution
_LOOKED_AT = 8  # postures of a closed robot, for the stiffest of its motions
_LOST = 0.5  # tracking error, in ranges of motion, at which the controller has lost the robot


@dataclass(frozen=True, eq=False)
class _Task:
    """What the machine is, and what it is to do."""

    plant: Plant
    limits: tuple[Limits, ...]  # of its joints
    reference: Reference
    along: np.ndarray  # (n, states) inner states of the plant at rest along the reference
    share: float  # of the range of motion


@dataclass(frozen=True, eq=False)
class _Run:
    """Raw results: state and torque held from each tick on, and encoder positions."""

    states: np.ndarray  # (n, 2 joints + inner states)
    torques: np.ndarray  # (n, joints)
    measured: np.ndarray  # (n, joints)
    random: np.ndarray  # (n, joints) torque on the machine beside the motors', as held


@dataclass(frozen=True, eq=False)
class _Encoders:
    """What the controller sees."""

    faults: Faults
    resolution: np.ndarray  # (joints,)

    def read(self, q: np.ndarray) -> np.ndarray:
        return quantised(sensed(self.faults, q), self.resolution)


def simulate(
    robot: Robot,
    settings: SimulationSettings | None = None,
    progress: Callable[[float], None] | None = None,
) -> SimulatedLog:
    """A measurement of `robot` under closed-loop control.

    With loops the commanded motion is carried out exactly (see `simulation.closed`), unless the
    settings ask for the controller.

    The robot's effects are simulated as physics, and so are those of `settings.hidden`, which the
    robot file lacks. The same robot and settings give the same bits.

    Args:
        robot: geometry, effects, and as many nominal parameters as are known.
        settings: motion, controller, sensors, seeds.
        progress: called with the share done, 0 to 1.

    Raises:
        RobotError: parameters no rigid body has, bad limits, effects that cannot be simulated.
        DataError: bad settings, friction too stiff, or a robot that the controller loses; says
            what to change.
    """
    settings = settings or SimulationSettings()
    check_settings(settings, tuple(joint.name for joint in robot.coordinates))
    if robot.loops and not settings.controller:
        return simulate_closed(robot, settings, progress)
    every = motion_limits(robot, settings.limits)
    parameters = plant_parameters(robot, every, settings.parameter_seed)
    hidden = complete_effects(robot, parameters, every, settings)
    task = (_closed_task if robot.loops else _task)(robot, parameters, every, settings, hidden)
    plant, ticks = task.plant, task.reference.time.size
    needed = _needed(task)
    highest = _torque_limits(plant, needed, settings)
    gains = tuned_gains(settings.rate, settings.bandwidth, settings.feedforward, highest)
    faults = faults_of(plant.joints, hidden)
    encoders = _Encoders(faults, encoder_resolution(robot.coordinates, settings))
    random = process_torques(settings, ticks, np.sqrt(np.mean(needed**2, axis=0)))
    run = _closed_loop(task, gains, encoders, random, progress)
    return _log(robot, task, parameters, settings, run, hidden)


def _task(
    robot: Robot,
    parameters: PlantParameters,
    every: tuple[Limits, ...],
    settings: SimulationSettings,
    hidden: tuple[HiddenEffect, ...],
) -> _Task:
    """Of a robot without loops."""
    limits = of_free(robot, every)
    if (reference := settings.commanded) is not None:
        limits = widened(limits, reference)
    else:
        reference = reference_motion(
            settings.motion, limits, settings.duration, settings.rate, settings.seed,
            _driven_directions(robot),
        )  # fmt: skip
    plant = build_plant(*machine(robot, parameters, hidden), every, hidden)
    along = np.zeros((reference.time.size, plant.states))
    return _Task(plant, limits, reference, along, 1.0)


def _driven_directions(robot: Robot) -> np.ndarray:
    """(joints with a motor, coordinates) how the coordinates move with each such joint."""
    ways = np.array([*joint_directions(robot).values()])
    passive = [k for k, joint in enumerate(robot.coordinates) if not joint.actuated]
    return ways[~np.any(ways[:, passive] != 0, axis=1)]


def _closed_task(
    robot: Robot,
    parameters: PlantParameters,
    every: tuple[Limits, ...],
    settings: SimulationSettings,
    hidden: tuple[HiddenEffect, ...],
) -> _Task:
    """Of a robot with loops."""
    constraints = constraints_of(robot)
    limits, motion = closed_command(robot, constraints, every, settings)
    plant = build_closed_plant(*machine(robot, parameters, hidden), every, constraints, hidden)
    along = inner_states(plant, constraints, motion.v)
    return _Task(plant, limits, motion.reference, along, motion.share)


def _needed(task: _Task) -> np.ndarray:
    """(about 500, joints) torques of the commanded motion."""
    reference = task.reference
    thinned = slice(None, None, max(1, reference.time.size // 500))
    motion = (reference.q, reference.qd, reference.qdd, task.along)
    samples = [values[thinned].T for values in motion]
    return task.plant.torque.map(samples[0].shape[1])(*samples).full().T


def _torque_limits(plant: Plant, torques: np.ndarray, settings: SimulationSettings) -> np.ndarray:
    """(joints,) saturation: as set, else twice the torque that the commanded motion needs."""
    needed = 2 * np.max(np.abs(torques), axis=0)
    set_or_needed = [
        settings.torque_limits.get(name, value)
        for name, value in zip(plant.joints, needed, strict=True)
    ]
    return np.where(plant.driven, set_or_needed, 0.0)


def _closed_loop(
    task: _Task,
    gains: Gains,
    encoders: _Encoders,
    random: np.ndarray,
    progress: Callable[[float], None] | None,
) -> _Run:
    """All ticks: read the encoders, hold the torque asked for one tick ago, move on, control."""
    plant, reference = task.plant, task.reference
    n, ticks = len(plant.joints), reference.time.size
    start = where_read(encoders.faults, reference.q[0])
    x = np.concatenate([start, np.zeros(n), settled(plant.strain, start, task.along[0])])
    # The brakes open with the torque that carries the robot, as drives remember it.
    torque = _holding_torque(plant, gains, x)
    state = ControllerState(encoders.read(x[:n]), np.zeros(n), torque)
    steps = steps_per_tick(plant, task.limits, gains.tick, _postures(task))
    advance = FastFunction(tick_function(plant, gains.tick, steps))
    mass = FastFunction(felt_inertia(plant))
    run = _Run(np.empty((ticks, x.size)), np.empty((ticks, n)), np.empty((ticks, n)), random)
    for begin in range(0, ticks, _REPORT_EVERY):
        with np.errstate(over="ignore", invalid="ignore"):  # a lost robot is reported below
            for k in range(begin, min(begin + _REPORT_EVERY, ticks)):
                run.states[k], run.torques[k] = x, torque
                measured = run.measured[k] = encoders.read(x[:n])
                inertia = mass(measured, x[2 * n :]).reshape(n, n)
                x = advance(x, torque + random[k])
                command = reference.q[k], reference.qd[k], reference.qdd[k]
                state, torque = control(gains, state, inertia, measured, command)
        _check_kept(task, begin, run.states[begin : k + 1, :n])
        if progress is not None:
            progress((k + 1) / ticks)
    return run


def _postures(task: _Task) -> tuple[np.ndarray, np.ndarray] | None:
    """Some of the commanded ones, where not all that the limits hold can be reached."""
    if task.plant.closer is None:
        return None
    some = np.linspace(0, len(task.along) - 1, _LOOKED_AT).astype(int)
    return task.reference.q[some], task.along[some]


def _holding_torque(plant: Plant, gains: Gains, x: np.ndarray) -> np.ndarray:
    n = len(plant.joints)
    rest = np.zeros(n)
    torque = plant.torque(x[:n], rest, rest, x[2 * n :]).full().ravel()
    return np.clip(torque, -gains.highest, gains.highest)


def _check_kept(task: _Task, begin: int, q: np.ndarray) -> None:
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
    task: _Task,
    parameters: PlantParameters,
    settings: SimulationSettings,
    run: _Run,
    hidden: tuple[HiddenEffect, ...],
) -> SimulatedLog:
    plant, reference = task.plant, task.reference
    n, ticks = len(plant.joints), reference.time.size
    q, qd, z = run.states[:, :n], run.states[:, n : 2 * n], run.states[:, 2 * n :]
    qdd = _accelerations(plant.acceleration, q, qd, z, run.torques + run.random)
    mean = logged_torques(faults_of(plant.joints, hidden), reference.time, run.torques)
    rms = np.sqrt(np.mean(mean**2, axis=0))
    noise = np.random.default_rng([settings.seed, 3]).normal(size=(ticks, n))
    values, drawn = told_once(robot, parameters.standard, parameters.drawn)
    return SimulatedLog(
        robot=robot.name,
        joints=plant.joints,
        driven=plant.driven,
        time=reference.time,
        q=run.measured,
        qc=reference.q,
        tau=mean + settings.torque_noise * rms * noise,
        settings=settings,
        truth=Truth(q, qd, qdd, run.torques, values, drawn, hidden),
        further=_thermometers(plant, z),
        range_share=task.share,
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


def _accelerations(acceleration: ca.Function, *samples: np.ndarray) -> np.ndarray:
    """(n, joints) qdd for rows of q, qd, z, tau."""
    values = acceleration.map(samples[0].shape[0])(*(sample.T for sample in samples))
    return values[0].full().T.copy()


# Logs of currents: which joints log theirs, and the torque that a unit of it makes.


def drive_gains(texts: Sequence[str], robot: Robot) -> dict[str, float]:
    """Torque per drive unit by joint, N m or N, from texts such as "11=2110".

    Raises:
        DataError: another form, no such joint or one without a motor, a joint twice, a gain that
            is no number or 0.
    """
    motors = [joint.name for joint in robot.coordinates if joint.actuated]
    found: dict[str, float] = {}
    for text in texts:
        joint, equals, number = (part.strip() for part in text.partition("="))
        if not equals or joint in found:
            raise DataError(
                f"--drive-gain {text}: expected each joint once as JOINT=VALUE, as in "
                f"{motors[0] if motors else 1}=12.5"
            )
        if joint not in motors:
            raise DataError(
                f"--drive-gain {text}: {robot.name} has no joint {joint} with a motor; expected "
                f"one of {', '.join(motors)}"
            )
        found[joint] = _gain(text, number)
    return found


def _gain(text: str, number: str) -> float:
    try:
        value = float(number)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or value == 0.0:
        raise DataError(
            f"--drive-gain {text}: got {number or 'nothing'}; expected torque per drive unit, a "
            "number other than 0"
        )
    return value
