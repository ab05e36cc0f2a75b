"""The simulated measurement: plant, controller and sensors in closed loop, or the exact command."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from modeler.core.errors import DataError
from modeler.robot import Joint, Limits, Robot, compute_joint_directions
from modeler.simulation import closing, log, trajectory
from modeler.simulation.closing import ClosedMotion, Constraints, build_constraints
from modeler.simulation.hidden_draw import complete_effects
from modeler.simulation.log import HiddenEffect, SimulatedLog, SimulationSettings, Truth
from modeler.simulation.parameters import PlantParameters, draw_plant_parameters, merge_shared_names
from modeler.simulation.plant import (
    FastFunction,
    Plant,
    apply_hidden_loads,
    build_motor_inertia,
    build_plant,
    build_tick_function,
    build_torque_function,
    choose_steps_per_tick,
    compute_inner_states,
    select_free_limits,
)
from modeler.simulation.portable_math import compute_exponential, compute_sine_and_cosine
from modeler.simulation.shafts import compute_rest_states
from modeler.simulation.thresholds import THRESHOLDS
from modeler.simulation.trajectory import Reference, widen_limits


def compute_encoder_resolution(joints: Sequence[Joint], settings: SimulationSettings) -> np.ndarray:
    """Returns (joints,) rad or m per count; 0 for an ideal encoder."""
    turn = 2 * np.pi / settings.encoder_counts if settings.encoder_counts else 0.0
    slide = settings.linear_resolution
    return np.array([turn if joint.is_revolute else slide for joint in joints])


def quantise_position(position: np.ndarray, resolution: np.ndarray) -> np.ndarray:
    """Returns what an encoder of that resolution reads; 0: the position itself."""
    step = np.where(resolution > 0, resolution, 1.0)
    return np.where(resolution > 0, np.round(position / step) * step, position)


@dataclass(frozen=True, eq=False)
class SensorFaults:
    """What the sensors of a machine do wrong, beside resolution and noise.

    Attributes:
        offset: (joints,) encoders read so much more, rad or m.
        waves: place, amplitude [rad, m], order [1/rad, 1/m] and phase of eccentric encoders.
        delay: of logged torques, s.
        ratio: (joints,) logged torque per torque.
        drift: (joints,) of logged torques, N m/s or N/s.
    """

    offset: np.ndarray
    waves: tuple[tuple[int, float, float, float], ...]
    delay: float
    ratio: np.ndarray
    drift: np.ndarray


def collect_sensor_faults(joints: Sequence[str], hidden: Sequence[HiddenEffect]) -> SensorFaults:
    """Returns the faults among hidden effects."""
    offset, ratio, drift = np.zeros(len(joints)), np.ones(len(joints)), np.zeros(len(joints))
    waves, delay = [], 0.0
    for effect in hidden:
        i = joints.index(effect.joint) if effect.joint in joints else -1
        values = effect.values
        if effect.effect == "encoder_offset":
            offset[i] += values["angle"]
        elif effect.effect == "encoder_eccentricity":
            waves.append((i, values["amplitude"], values["order"], values["phase"]))
        elif effect.effect == "time_delay":
            delay += values["delay"]
        elif effect.effect == "drive_gain":
            ratio[i] *= values["ratio"]
        elif effect.effect == "drift":
            drift[i] += values["per_minute"] / 60
    return SensorFaults(offset, tuple(waves), delay, ratio, drift)


def read_encoders(faults: SensorFaults, position: np.ndarray) -> np.ndarray:
    """Returns (joints,) what encoders of endless resolution read at these positions."""
    read = position + faults.offset
    for i, amplitude, order, phase in faults.waves:
        read[i] += amplitude * compute_sine_and_cosine(order * position[i] + phase)[0]
    return read


def invert_encoders(faults: SensorFaults, reading: np.ndarray) -> np.ndarray:
    """Returns (joints,) positions at which such encoders read that."""
    position = np.array(reading, dtype=float)
    is_needed = faults.waves or np.any(faults.offset)
    for _ in range(THRESHOLDS.encoder_inversion_passes if is_needed else 0):
        position = position - (read_encoders(faults, position) - reading)
    return position


def compute_logged_torques(faults: SensorFaults, time: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Computes (n, joints) torques before noise: means over intervals about the samples.

    Args:
        faults: of the sensors.
        time: (n,) s.
        held: (n, joints) torques, each held from its sample to the next.
    """
    if not faults.delay:
        return compute_sampled_torques(faults, time, (np.vstack([held[:1], held[:-1]]) + held) / 2)
    # The mean over one interval runs straight between the middles of the ticks.
    return compute_sampled_torques(faults, time, held, known=time + (time[1] - time[0]) / 2)


def compute_sampled_torques(
    faults: SensorFaults, time: np.ndarray, tau: np.ndarray, known: np.ndarray | None = None
) -> np.ndarray:
    """Computes (n, joints) torques before noise, from torques at the samples or times known."""
    if faults.delay:
        at, late = time if known is None else known, time - faults.delay
        tau = np.column_stack([np.interp(late, at, column) for column in tau.T])
    return tau * faults.ratio + faults.drift * time[:, None]


# A cascaded position and velocity controller, as drives have it, scheduled with the inertia.


# Zero-order hold (0.5 tick), latency (1), difference (0.5), and the speed filter delay the velocity
# loop; where that takes more than 0.6 rad of phase at the bandwidth, the bandwidth is lowered.


@dataclass(frozen=True, eq=False)
class ControllerGains:
    """Gains of the P-PI cascade, for unit inertia.

    Attributes:
        position: rad/s of speed per rad of position error, 1/s.
        speed: acceleration per speed error, 1/s.
        integral: acceleration per integrated speed error, 1/s2.
        forward: 1 if commanded speed and acceleration are fed forward, else 0.
        highest: (joints,) saturation, N m or N; 0 for a joint without motor.
        filter_share: of the new difference in the filtered speed, per tick.
        tick: s.
    """

    position: float
    speed: float
    integral: float
    forward: float
    highest: np.ndarray
    filter_share: float
    tick: float


@dataclass(frozen=True, eq=False)
class ControllerState:
    """What the controller keeps from one tick to the next; (joints,) each.

    Attributes:
        measured: encoder position at the last tick.
        speed: filtered.
        effort: torque of the integral action.
    """

    measured: np.ndarray
    speed: np.ndarray
    effort: np.ndarray


def tune_gains(
    rate: float, bandwidth: float, feedforward: bool, highest: np.ndarray
) -> ControllerGains:
    """Returns gains of a velocity loop of `bandwidth` [Hz], lowered where the delay asks for it."""
    delay = THRESHOLDS.loop_delay_ticks / rate + 1 / (2 * np.pi * THRESHOLDS.speed_filter_hz)
    omega = min(2 * np.pi * bandwidth, THRESHOLDS.max_delay_phase / delay)
    return ControllerGains(
        position=THRESHOLDS.outer_loop_share * omega,
        speed=omega,
        integral=THRESHOLDS.outer_loop_share * omega**2,
        forward=float(feedforward),
        highest=highest,
        filter_share=1 - float(compute_exponential(-2 * np.pi * THRESHOLDS.speed_filter_hz / rate)),
        tick=1 / rate,
    )


def update_controller(
    gains: ControllerGains,
    state: ControllerState,
    inertia: np.ndarray,
    measured: np.ndarray,
    command: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> tuple[ControllerState, np.ndarray]:
    """Returns the next state, and the torque the controller asks for; (joints,).

    tau = sat(M (kv (kp (qc - q) + qdc - v) + qddc) + effort), effort' = M ki (the same error). With
    fixed gains an arm without rotor inertias loses its wrist: its inertia varies a hundredfold.
    Gravity, Coriolis torques and friction are left to the integral action. The integral of a joint
    stands still while its torque is saturated and the error would drive it further.

    Args:
        gains: of the cascade.
        state: after the last tick.
        inertia: (joints, joints) M that acts on the motors at the measured position.
        measured: encoder position now.
        command: commanded q, qd, qdd now.
    """
    q, qd, qdd = command
    difference = (measured - state.measured) / gains.tick
    speed = state.speed + gains.filter_share * (difference - state.speed)
    error = gains.position * (q - measured) + gains.forward * qd - speed
    rise = _multiply_in_order(inertia, gains.integral * gains.tick * error)
    effort = state.effort + rise
    wanted = _multiply_in_order(inertia, gains.speed * error + gains.forward * qdd) + effort
    torque = np.minimum(np.maximum(wanted, -gains.highest), gains.highest)
    winding = (wanted != torque) & (wanted * rise > 0)
    return ControllerState(measured, speed, np.where(winding, state.effort, effort)), torque


def _multiply_in_order(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """matrix vector, by sums in a fixed order: libraries of linear algebra round as they like."""
    return np.asarray(np.sum(matrix * vector, axis=1))


# A random torque on the machine itself, as from seals, cables and the air.


def draw_process_torques(settings: SimulationSettings, ticks: int, rms: np.ndarray) -> np.ndarray:
    """Draws (ticks, joints) a stationary Ornstein-Uhlenbeck process on each joint.

    Args:
        settings: share, rate and seed.
        ticks: number of samples.
        rms: (joints,) torque of which it is a share, N m or N.
    """
    shape = (ticks, rms.size)
    if not settings.process_noise:
        return np.zeros(shape)
    from scipy.signal import lfilter  # it takes long to load

    white = np.random.default_rng([settings.seed, 5]).normal(size=shape)
    decay = float(compute_exponential(-1 / (settings.rate * THRESHOLDS.process_noise_time)))
    white[1:] *= np.sqrt(1 - decay**2)  # the first sample has the variance of all
    noise = lfilter([1.0], [1.0, -decay], white, axis=0)
    return settings.process_noise * rms * np.round(noise, 10)  # the same on every machine


# The simulated measurement: plant, controller and sensors in closed loop, or the exact command.


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
    states_along: np.ndarray
    range_share: float


def simulate(
    robot: Robot,
    settings: SimulationSettings | None = None,
    progress: Callable[[float], None] | None = None,
) -> SimulatedLog:
    """Returns a measurement of `robot` under closed-loop control.

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
    log.check_settings(settings, tuple(joint.name for joint in robot.coordinates))
    all_limits = trajectory.collect_motion_limits(robot, settings.limits)
    elastic = collect_elastic_joints(robot)
    if elastic:  # two masses each, as where the robot file does not say so
        robot = robot.rigid
        settings = dataclasses.replace(settings, hidden=(*elastic, *settings.hidden))
    if robot.loops and not settings.controller:
        return _simulate_exact_command(robot, all_limits, settings, progress)
    parameters = draw_plant_parameters(robot, all_limits, settings.parameter_seed)
    hidden = complete_effects(robot, parameters, all_limits, settings)
    task = build_task(robot, parameters, all_limits, settings, hidden)
    plant, reference, n = task.plant, task.reference, len(task.plant.joints)
    needed = compute_needed_torques(task)
    # Saturation: as set, else twice the torque that the commanded motion needs.
    most = zip(plant.joints, 2 * np.max(np.abs(needed), axis=0), strict=True)
    limits = [settings.torque_limits.get(name, default_limit) for name, default_limit in most]
    highest = np.where(plant.driven, limits, 0.0)
    gains = tune_gains(settings.rate, settings.bandwidth, settings.feedforward, highest)
    faults = collect_sensor_faults(plant.joints, hidden)
    resolution = compute_encoder_resolution(robot.coordinates, settings)
    rms = np.sqrt(np.mean(needed**2, axis=0))
    random = draw_process_torques(settings, len(reference.time), rms)
    states, tau, measured = _run_closed_loop(task, gains, faults, resolution, random, progress)
    q, qd, z = states[:, :n], states[:, n : 2 * n], states[:, 2 * n :]
    samples = [each.T for each in (q, qd, z, tau + random)]
    qdd = plant.acceleration.map(len(q))(*samples)[0].full().T.copy()
    logged = compute_logged_torques(faults, reference.time, tau)
    hidden = hidden[len(elastic) :]
    truth = Truth(q, qd, qdd, tau, *merge_shared_names(robot, parameters), hidden)
    return _build_log(robot, settings, task, truth, measured, logged, _read_thermometers(plant, z))


def collect_elastic_joints(robot: Robot) -> tuple[HiddenEffect, ...]:
    """Returns the elastic joints of the robot file as transmissions of the simulator."""
    joints = [(joint.name, robot.find_windup(joint.name)) for joint in robot.moving_joints]
    return tuple(
        HiddenEffect("elasticity", name, {"stiffness": sizes[0], "damping": sizes[1]})
        for name, sizes in joints
        if sizes is not None
    )


def _simulate_exact_command(
    robot: Robot,
    all_limits: tuple[Limits, ...],
    settings: SimulationSettings,
    progress: Callable[[float], None] | None,
) -> SimulatedLog:
    """A measurement of a robot with loops that carries out the commanded motion exactly.

    Drives of parallel robots are stiff and well tuned: the actuated joints are where they are
    commanded to be, the others follow, and the motors give what that needs. Torques are those of
    the instant, by the equations of motion of the open tree and Lagrange multipliers for what ties
    it.
    """
    constraints = build_constraints(robot)
    _, motion = _build_closed_command(robot, constraints, all_limits, settings, progress)
    parameters = draw_plant_parameters(robot, all_limits, settings.parameter_seed)
    hidden = complete_effects(robot, parameters, all_limits, settings)
    v, reference = motion.v, motion.reference
    vd, vdd = closing.compute_rates(constraints, v, reference.qd, reference.qdd)
    loaded = apply_hidden_loads(robot, parameters, hidden)
    torque, states = build_torque_function(*loaded, all_limits, hidden)
    load = closing.evaluate_samples(torque, v, vd, vdd, np.zeros((len(v), states)))[:, :, 0]
    needed = closing.compute_motor_torques(constraints, v, load)
    # What pushes on a machine that moves as commanded is pushed back by its motors.
    rms = np.sqrt(np.mean(needed**2, axis=0))
    tau = needed - draw_process_torques(settings, len(needed), rms)
    faults = collect_sensor_faults([joint.name for joint in robot.coordinates], hidden)
    resolution = compute_encoder_resolution(robot.coordinates, settings)
    measured = quantise_position(reference.q, resolution)
    logged = compute_sampled_torques(faults, reference.time, tau)
    exact_motion = (reference.q, reference.qd, reference.qdd, tau)
    truth = Truth(*exact_motion, *merge_shared_names(robot, parameters), hidden)
    return _build_log(robot, settings, motion, truth, measured, logged, {})


def _build_closed_command(
    robot: Robot,
    constraints: Constraints,
    all_limits: tuple[Limits, ...],
    settings: SimulationSettings,
    progress: Callable[[float], None] | None = None,
) -> tuple[tuple[Limits, ...], ClosedMotion]:
    """Limits of the coordinates, from those of `robot.moving`, and the motion of the settings."""
    names = [joint.name for joint in robot.moving_joints]
    limits = tuple(all_limits[names.index(joint.name)] for joint in robot.coordinates)
    if (reference := settings.commanded) is not None:
        closed = closing.compute_closed_postures(robot, constraints, reference.q, progress)
        return widen_limits(limits, reference), ClosedMotion(reference, closed, 1.0)

    commanded = partial(_build_reference, settings)
    return limits, closing.find_closed_motion(robot, constraints, limits, commanded, progress)


def _build_reference(
    settings: SimulationSettings, limits: tuple[Limits, ...], directions: np.ndarray | None = None
) -> Reference:
    """The motion of that name within limits."""
    timed = limits, settings.duration, settings.rate, settings.seed
    if settings.motion == "one-joint":
        return trajectory.build_one_joint_reference(*timed, directions)
    is_point_to_point = settings.motion == "point-to-point"
    if is_point_to_point:
        return trajectory.build_point_to_point_reference(*timed)
    return trajectory.build_exciting_reference(*timed)


def build_task(
    robot: Robot,
    parameters: PlantParameters,
    all_limits: tuple[Limits, ...],
    settings: SimulationSettings,
    hidden: tuple[HiddenEffect, ...],
) -> PlantTask:
    """Returns machine under a controller, with these parameters and limits of `robot.moving`."""
    real = apply_hidden_loads(robot, parameters, hidden)
    if robot.loops:
        constraints = build_constraints(robot)
        limits, motion = _build_closed_command(robot, constraints, all_limits, settings)
        plant = build_plant(*real, all_limits, hidden, constraints)
        along = compute_inner_states(plant, constraints, motion.v)
        return PlantTask(plant, limits, motion.reference, along, motion.range_share)
    limits = select_free_limits(robot, all_limits)
    if (reference := settings.commanded) is not None:
        limits = widen_limits(limits, reference)
    else:
        # How the coordinates move with each joint that has a motor.
        directions = np.array([*compute_joint_directions(robot).values()])
        passive = [k for k, joint in enumerate(robot.coordinates) if not joint.actuated]
        driven = directions[~np.any(directions[:, passive] != 0, axis=1)]
        reference = _build_reference(settings, limits, driven)
    plant = build_plant(*real, all_limits, hidden)
    return PlantTask(plant, limits, reference, np.zeros((len(reference.time), plant.states)), 1.0)


def compute_needed_torques(task: PlantTask) -> np.ndarray:
    """Returns (about 500, joints) torques of the commanded motion."""
    reference = task.reference
    thinned = slice(None, None, max(1, reference.time.size // 500))
    motion = (reference.q, reference.qd, reference.qdd, task.states_along)
    samples = [values[thinned].T for values in motion]
    return np.asarray(task.plant.torque.map(samples[0].shape[1])(*samples).full().T)


def _run_closed_loop(
    task: PlantTask,
    gains: ControllerGains,
    faults: SensorFaults,
    resolution: np.ndarray,
    random: np.ndarray,
    progress: Callable[[float], None] | None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All ticks: read the encoders, hold the torque requested one tick ago, move on, control.

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
    start, rest = invert_encoders(faults, reference.q[0]), np.zeros(n)
    inner = compute_rest_states(plant.strain, start, task.states_along[0])
    x = np.concatenate([start, rest, inner])
    # The brakes open with the torque that carries the robot, as drives store it.
    torque = plant.torque(x[:n], rest, rest, x[2 * n :]).full().ravel()
    torque = np.clip(torque, -gains.highest, gains.highest)
    measured_start = quantise_position(read_encoders(faults, x[:n]), resolution)
    state = ControllerState(measured_start, rest, torque)
    steps = choose_steps_per_tick(plant, task.limits, gains.tick, select_postures(task))
    advance = FastFunction(build_tick_function(plant, gains.tick, steps))
    mass = FastFunction(build_motor_inertia(plant))
    states = np.empty((ticks, x.size))
    torques, measured = np.empty((ticks, n)), np.empty((ticks, n))
    for begin in range(0, ticks, THRESHOLDS.ticks_per_report):
        with np.errstate(over="ignore", invalid="ignore"):  # a lost robot is reported below
            for k in range(begin, min(begin + THRESHOLDS.ticks_per_report, ticks)):
                states[k], torques[k] = x, torque
                measured[k] = quantise_position(read_encoders(faults, x[:n]), resolution)
                inertia = mass(measured[k], x[2 * n :]).reshape(n, n)
                x = advance(x, torque + random[k])
                command = reference.q[k], reference.qd[k], reference.qdd[k]
                state, torque = update_controller(gains, state, inertia, measured[k], command)
        _check_tracking(task, begin, states[begin : k + 1, :n])
        if progress is not None:
            progress((k + 1) / ticks)
    return states, torques, measured


def select_postures(task: PlantTask) -> tuple[np.ndarray, np.ndarray] | None:
    """Returns some of the commanded ones, where not all that the limits hold can be reached."""
    if task.plant.closer is None:
        return None
    some = np.linspace(0, len(task.states_along) - 1, THRESHOLDS.checked_postures).astype(int)
    return task.reference.q[some], task.states_along[some]


def _check_tracking(task: PlantTask, begin: int, q: np.ndarray) -> None:
    """Nothing, if the driven joints are near their commands in the samples from `begin` on."""
    plant, reference = task.plant, task.reference
    widths = np.array([limit.upper - limit.lower for limit in task.limits])
    error = np.abs(q - reference.q[begin : begin + len(q)]) / widths
    is_lost = ~(error <= THRESHOLDS.max_tracking_error_share) & plant.driven | ~np.isfinite(q)
    if np.any(is_lost):
        sample, joint = np.argwhere(is_lost)[0]
        raise DataError(
            f"simulation: the controller lost joint {plant.joints[joint]} at "
            f"{reference.time[begin + sample]:.3f} s; expected it to stay within half its range "
            "of the command; lower the speed limits or the bandwidth, or raise the torque limit"
        )


def _build_log(
    robot: Robot,
    settings: SimulationSettings,
    motion: PlantTask | ClosedMotion,
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
        time=motion.reference.time,
        q=measured,
        qc=motion.reference.q,
        tau=logged + settings.torque_noise * rms * noise,
        settings=settings,
        truth=truth,
        further=further,
        range_share=motion.range_share,
    )


def _read_thermometers(plant: Plant, z: np.ndarray) -> dict[str, np.ndarray]:
    """Readings by column name, degC."""
    if not plant.thermometer_joints:
        return {}
    readings = plant.temperatures.map(len(z))(z.T).full()
    least = THRESHOLDS.thermometer_resolution
    rows = zip(plant.thermometer_joints, readings, strict=True)
    return {f"temperature{joint}": np.round(values / least) * least for joint, values in rows}
