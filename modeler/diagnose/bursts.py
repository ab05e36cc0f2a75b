"""Play in a gear: bursts of the residual where the load changes sign, not the speed."""

import numpy as np

from modeler.diagnose.state import State

AFTER = 0.1
"""s: how long a burst lasts."""

BURST = 11.0
"""Energy within that time over that elsewhere from which on play is named."""


def burst_ratio(state: State, j: int) -> float:
    """Mean squared residual within 0.1 s after sign changes of the load, over that elsewhere.

    0 where the load changes sign less than four times, or where speed reversals come with it.
    """
    after: list[np.ndarray] = []
    for s in state.rows.signals:
        load, v = s.load[:, j], s.v[:, j]
        turns = np.flatnonzero(np.diff(np.sign(load)) != 0)
        span = max(1, round(AFTER / s.step))
        flags = np.zeros(len(load))
        for turn in turns:
            if abs(v[turn]) > 0.02 * state.scales[j].speed:
                flags[turn : turn + span] = 1.0
        after.append(flags)
    near = state.rows.filtered(j, after) > 0.5
    if near.sum() < 8 or (~near).sum() < 8:
        return 0.0
    square = state.residual[j] ** 2
    return float(square[near].mean() / max(float(np.mean(square[~near])), 1e-300))
