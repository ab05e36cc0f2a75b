"""What encoders and torque sensors read, the controller that sees it, and random torques."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.robot import Joint
from modeler.simulation.portable_math import compute_exponential, compute_sine_and_cosine
from modeler.simulation.settings import HiddenEffect, SimulationSettings

_PASSES = 30  # of the fixed point that inverts an eccentric encoder; contracts to a hundredth


def compute_encoder_resolution(joints: Sequence[Joint], settings: SimulationSettings) -> np.ndarray:
    """(joints,) rad or m per count; 0 for an ideal encoder."""
    return np.array([
        2 * np.pi / settings.encoder_counts if joint.is_revolute and settings.encoder_counts
        else 0.0 if joint.is_revolute else settings.linear_resolution
        for joint in joints
    ])  # fmt: skip


def quantise_position(position: np.ndarray, resolution: np.ndarray) -> np.ndarray:
    """What an encoder of that resolution reads; a resolution of 0 reads the position itself."""
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
    """The faults among hidden effects."""
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
    """(joints,) what encoders of endless resolution read at these positions."""
    read = position + faults.offset
    for i, amplitude, order, phase in faults.waves:
        read[i] += amplitude * compute_sine_and_cosine(order * position[i] + phase)[0]
    return read


def invert_encoders(faults: SensorFaults, reading: np.ndarray) -> np.ndarray:
    """(joints,) positions at which such encoders read that."""
    position = np.array(reading, dtype=float)
    for _ in range(_PASSES if faults.waves or np.any(faults.offset) else 0):
        position = position - (read_encoders(faults, position) - reading)
    return position


def compute_logged_torques(faults: SensorFaults, time: np.ndarray, held: np.ndarray) -> np.ndarray:
    """(n, joints) torques before noise: means over sampling intervals centred at the samples.

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
    """(n, joints) torques before noise, from (n, joints) torques at the samples, or times known."""
    if faults.delay:
        at, late = time if known is None else known, time - faults.delay
        tau = np.column_stack([np.interp(late, at, column) for column in tau.T])
    return tau * faults.ratio + faults.drift * time[:, None]


# A cascaded position and velocity controller, as drives have it, scheduled with the inertia.


_SPEED_FILTER = 150.0  # Hz, on the differenced encoder position
# Zero-order hold (0.5 tick), latency (1), difference (0.5), and the speed filter delay the velocity
# loop; where that takes more than 0.6 rad of phase at the bandwidth, the bandwidth is lowered.
_DELAY_TICKS = 2.0
_PHASE = 0.6
_LOWER_LOOPS = 0.25  # position loop and integral action, relative to the velocity loop


@dataclass(frozen=True, eq=False)
class ControllerGains:
    """Of the P-PI cascade, for unit inertia.

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
    """What the controller remembers from one tick to the next; (joints,) each.

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
    """Gains of a velocity loop of `bandwidth` [Hz], lowered where the delay asks for it."""
    delay = _DELAY_TICKS / rate + 1 / (2 * np.pi * _SPEED_FILTER)
    omega = min(2 * np.pi * bandwidth, _PHASE / delay)
    return ControllerGains(
        position=_LOWER_LOOPS * omega,
        speed=omega,
        integral=_LOWER_LOOPS * omega**2,
        forward=float(feedforward),
        highest=highest,
        filter_share=1 - float(compute_exponential(-2 * np.pi * _SPEED_FILTER / rate)),
        tick=1 / rate,
    )


def update_controller(
    gains: ControllerGains,
    state: ControllerState,
    inertia: np.ndarray,
    measured: np.ndarray,
    command: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> tuple[ControllerState, np.ndarray]:
    """The next state, and the torque the controller asks for; (joints,).

    tau = sat(M (kv (kp (qc - q) + qdc - v) + qddc) + effort), effort' = M ki (the same error). With
    fixed gains an arm without rotor inertias loses its wrist: its inertia varies a hundredfold.
    Gravity, Coriolis torques and friction are left to the integral action. The integral of a joint
    stands still while its torque is saturated and the error would drive it further.

    Args:
        gains: of the cascade.
        state: after the last tick.
        inertia: (joints, joints) M that the motors feel at the measured position.
        measured: encoder position now.
        command: commanded q, qd, qdd now.
    """
    q, qd, qdd = command
    difference = (measured - state.measured) / gains.tick
    speed = state.speed + gains.filter_share * (difference - state.speed)
    error = gains.position * (q - measured) + gains.forward * qd - speed
    rise = _multiply_in_order(inertia, gains.integral * gains.tick * error)
    effort = state.effort + rise
    unlimited_torque = (
        _multiply_in_order(inertia, gains.speed * error + gains.forward * qdd) + effort
    )
    torque = np.minimum(np.maximum(unlimited_torque, -gains.highest), gains.highest)
    winding = (unlimited_torque != torque) & (unlimited_torque * rise > 0)
    return ControllerState(measured, speed, np.where(winding, state.effort, effort)), torque


def _multiply_in_order(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """matrix vector, by sums in a fixed order: libraries of linear algebra round as they like."""
    return np.asarray(np.sum(matrix * vector, axis=1))


# A random torque on the machine itself, as from seals, cables and the air.


_CORRELATION = 0.03  # s


def draw_process_torques(settings: SimulationSettings, ticks: int, rms: np.ndarray) -> np.ndarray:
    """(ticks, joints) an Ornstein-Uhlenbeck process on each joint, stationary, held over ticks.

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
    decay = float(compute_exponential(-1 / (settings.rate * _CORRELATION)))
    white[1:] *= np.sqrt(1 - decay**2)  # the first sample has the variance of all
    noise = lfilter([1.0], [1.0, -decay], white, axis=0)
    return settings.process_noise * rms * np.round(noise, 10)  # the same on every machine
