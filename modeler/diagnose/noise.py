"""Is what is left like noise: the same all the time, and forgotten at once?"""

import numpy as np

from modeler.diagnose.state import State

LATER = 0.2
"""s after which noise has nothing to do with itself any more."""

EVEN = 0.3
"""Median energy of half a second over the mean from which on noise is even: with and without
encoder noise, at rest and at top speed, joints without any hidden effect have 0.4 to 1."""

_FEW = 100  # rows below which nothing is said


def lasting(state: State, j: int) -> float:
    """Share of the residual's variance that is still there after `LATER`: its autocorrelation.

    Torque noise and quantisation are forgotten within a tenth of a second; a brake that drags, a
    cable that pulls, a temperature are not.
    """
    products = squares = 0.0
    for t, r in _runs(state, j):
        later = np.searchsorted(t, t + LATER)
        now = np.flatnonzero(later < len(t))
        now = now[np.abs(t[later[now]] - t[now] - LATER) < 0.1 * LATER]
        products += float(r[now] @ r[later[now]])
        squares += float(r[now] @ r[now])
    return max(0.0, products / squares) if squares > 0.0 else 0.0


def knocking(state: State, j: int) -> float:
    """Share of the residual's energy in outbursts: 0 for noise that is even over time.

    What exceeds the median energy of the blocks (half a second each), if their mean is several
    times that.
    """
    r, block = state.residual[j], state.base.block[j]
    if r.size < _FEW:
        return 0.0
    rows = np.bincount(block)
    energy = np.bincount(block, r**2)[rows > 0] / rows[rows > 0]
    mean = float(energy.mean())
    even = float(np.median(energy)) / mean if mean > 0.0 else 1.0
    return 1.0 - even if even < EVEN else 0.0


def _runs(state: State, j: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Times and residuals of each log."""
    run, time, residual = state.rows.run[j], state.rows.time[j], state.residual[j]
    return [(time[run == k], residual[run == k]) for k in np.unique(run)]
