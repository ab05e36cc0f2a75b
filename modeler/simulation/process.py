"""A random torque on the machine itself, as from seals, cables and the air."""

import numpy as np

from modeler.simulation.portable_math import exponential
from modeler.simulation.settings import SimulationSettings

_CORRELATION = 0.03  # s


def process_torques(settings: SimulationSettings, ticks: int, rms: np.ndarray) -> np.ndarray:
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
    kept = float(exponential(-1 / (settings.rate * _CORRELATION)))
    white[1:] *= np.sqrt(1 - kept**2)  # the first sample has the variance of all
    noise = lfilter([1.0], [1.0, -kept], white, axis=0)
    return settings.process_noise * rms * np.round(noise, 10)  # the same on every machine
