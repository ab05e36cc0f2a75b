"""What encoders and torque sensors read."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.robot import Joint
from modeler.simulate.elementary import sine_and_cosine
from modeler.simulate.hidden import HiddenEffect
from modeler.simulate.settings import SimulationSettings

_PASSES = 30  # of the fixed point that inverts an eccentric encoder; contracts to a hundredth


def encoder_resolution(joints: Sequence[Joint], settings: SimulationSettings) -> np.ndarray:
    """(joints,) rad or m per count; 0 for an ideal encoder."""
    return np.array([
        2 * np.pi / settings.encoder_counts if joint.angular and settings.encoder_counts
        else 0.0 if joint.angular else settings.linear_resolution
        for joint in joints
    ])  # fmt: skip


def quantised(position: np.ndarray, resolution: np.ndarray) -> np.ndarray:
    """What an encoder of that resolution reads; a resolution of 0 reads the position itself."""
    step = np.where(resolution > 0, resolution, 1.0)
    return np.where(resolution > 0, np.round(position / step) * step, position)


@dataclass(frozen=True, eq=False)
class Faults:
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


def faults_of(joints: Sequence[str], hidden: Sequence[HiddenEffect]) -> Faults:
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
    return Faults(offset, tuple(waves), delay, ratio, drift)


def sensed(faults: Faults, position: np.ndarray) -> np.ndarray:
    """(joints,) what encoders of endless resolution read at these positions."""
    read = position + faults.offset
    for i, amplitude, order, phase in faults.waves:
        read[i] += amplitude * sine_and_cosine(order * position[i] + phase)[0]
    return read


def where_read(faults: Faults, reading: np.ndarray) -> np.ndarray:
    """(joints,) positions at which such encoders read that."""
    position = np.array(reading, dtype=float)
    for _ in range(_PASSES if faults.waves or np.any(faults.offset) else 0):
        position = position - (sensed(faults, position) - reading)
    return position


def logged_torques(faults: Faults, time: np.ndarray, held: np.ndarray) -> np.ndarray:
    """(n, joints) torques before noise: means over sampling intervals centred at the samples.

    Args:
        faults: of the sensors.
        time: (n,) s.
        held: (n, joints) torques, each held from its sample to the next.
    """
    before = np.vstack([held[:1], held[:-1]])
    if not faults.delay:
        return _faulty(faults, time, (before + held) / 2)
    # The mean over one interval runs straight between the middles of the ticks.
    return _faulty(faults, time, _late(faults, time, time + (time[1] - time[0]) / 2, held))


def sampled_torques(faults: Faults, time: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """(n, joints) torques before noise, from (n, joints) torques at the samples themselves."""
    return _faulty(faults, time, _late(faults, time, time, tau) if faults.delay else tau)


def _late(faults: Faults, time: np.ndarray, known: np.ndarray, tau: np.ndarray) -> np.ndarray:
    late = time - faults.delay
    return np.column_stack([np.interp(late, known, column) for column in tau.T])


def _faulty(faults: Faults, time: np.ndarray, tau: np.ndarray) -> np.ndarray:
    return tau * faults.ratio + faults.drift * time[:, None]
