"""The band of the motion."""

import numpy as np

from modeler.diagnose.state import State


def band(state: State) -> float:
    """Frequency below which 99 % of the velocity's energy lies, Hz; the fastest joint counts."""
    found = 0.5
    for signals in state.rows.signals:
        if len(signals.v) < 64:
            continue
        window = np.hanning(len(signals.v))[:, None]
        power = np.abs(np.fft.rfft((signals.v - signals.v.mean(axis=0)) * window, axis=0)) ** 2
        frequency = np.fft.rfftfreq(len(signals.v), signals.step)
        for j in range(power.shape[1]):
            share = np.cumsum(power[:, j])
            if share[-1] > 0.0:
                found = max(found, float(frequency[np.searchsorted(share, 0.99 * share[-1])]))
    return found
