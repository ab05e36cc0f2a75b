"""Is what is left like noise: the same all the time, and forgotten at once?"""

import numpy as np

from modeler.diagnose.state import State

LATER = 0.2
"""s after which noise has nothing to do with itself any more."""

FORGOTTEN = 2.0
"""Periods of the parallel filter's cut-off after which filtered noise has forgotten itself."""

EVEN = 0.3
"""Median energy of a block over the mean from which on noise is even: with and without
encoder noise, at rest and at top speed, joints without any hidden effect have 0.4 to 1."""

_FEW = 100  # rows below which nothing is said


def lasting(state: State, j: int) -> float:
    """Share of the residual's variance that is still there after `LATER`: its autocorrelation.

    Torque noise and quantisation are forgotten within a tenth of a second; a brake that drags, a
    cable that pulls, a temperature are not. Rows of a narrow band remember longer by themselves.
    """
    cutoff = state.data.observation.report.processing.parallel_cutoff or np.inf
    later = max(LATER, FORGOTTEN / cutoff)
    return returning(*(np.sum([agreement(t, r, later) for t, r in runs(state, j)], axis=0)))


def agreement(t: np.ndarray, r: np.ndarray, later: float) -> np.ndarray:
    """(2,) products of residuals with those some time later, and the mean of their squares.

    Args:
        t: (n,) s, increasing.
        r: (n,) residuals; between two rows, if they are near each other, a straight line.
        later: s.
    """
    if len(t) < 3:
        return np.zeros(2)
    then = t + later
    place = np.clip(np.searchsorted(t, then), 1, len(t) - 1)
    gap = t[place] - t[place - 1]
    inside = (then <= t[-1]) & (gap < 2.0 * float(np.median(np.diff(t))))
    share = (then - t[place - 1]) / np.maximum(gap, 1e-12)
    first, second = r[inside], (r[place - 1] + share * (r[place] - r[place - 1]))[inside]
    return np.array([first @ second, 0.5 * (first @ first + second @ second)])


def returning(product: float, square: float) -> float:
    """The share that returns, between 0 and 1."""
    return max(0.0, float(product / square)) if square > 0.0 else 0.0


def knocking(state: State, j: int) -> float:
    """Share of the residual's energy in outbursts: 0 for noise that is even over time.

    What exceeds the median energy of the blocks, if their mean is several times that. Blocks with
    few rows do not count.
    """
    r, block = state.residual[j], state.base.block[j]
    if r.size < _FEW:
        return 0.0
    rows = np.bincount(block)
    full = rows > 0.5 * np.median(rows[rows > 0])
    energy = np.bincount(block, r**2)[full] / rows[full]
    mean = float(energy.mean())
    even = float(np.median(energy)) / mean if mean > 0.0 else 1.0
    return 1.0 - even if even < EVEN else 0.0


def runs(state: State, j: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Times and residuals of each log."""
    run, time, residual = state.rows.run[j], state.rows.time[j], state.residual[j]
    logs = range(len(state.data.observation.logs))
    return [(time[run == k], residual[run == k]) for k in logs]
