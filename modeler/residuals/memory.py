"""What noise does not do: return in the next lap, last, come in outbursts."""

from collections.abc import Sequence

import numpy as np

LATER = 0.2
"""s after which noise has nothing to do with itself any more."""

FORGOTTEN = 2.0
"""Periods of the parallel filter's cut-off after which filtered noise has forgotten itself."""

EVEN = 0.3
"""Median energy of a block over the mean from which on noise is even: with and without
encoder noise, at rest and at top speed, joints without any hidden effect have 0.4 to 1."""

_FEW = 100  # rows below which nothing is said
_FEW_OF_LOG = 20


def forgotten(cutoff: float) -> float:
    """s after which noise behind a parallel filter of a cut-off (Hz, 0: none) is forgotten.

    Torque noise and quantisation are forgotten within a tenth of a second; a brake that drags, a
    cable that pulls, a temperature are not. Rows of a narrow band remember longer by themselves.
    """
    return max(LATER, FORGOTTEN / cutoff) if cutoff else LATER


def returning(
    time: np.ndarray, r: np.ndarray, run: np.ndarray, later: Sequence[float]
) -> float | None:
    """Share of a residual's variance that is there some time later: it lasts, or comes back.

    Args:
        time: (n,) s, increasing within each log.
        r: (n,) residual.
        run: (n,) number of the log.
        later: s by log: a lap, or what noise is forgotten in; 0 leaves a log out. None are left:
            None.
    """
    product = square = 0.0
    logs = [(run == k, step) for k, step in enumerate(later) if step]
    logs = [(own, step) for own, step in logs if own.sum() >= _FEW_OF_LOG]
    for own, step in logs:
        second = at(time[own], r[own], time[own] + step)
        both = np.isfinite(second)
        first, second = r[own][both], second[both]
        product += float(first @ second)
        square += 0.5 * float(first @ first + second @ second)
    if not logs:
        return None
    return max(0.0, product / square) if square > 0.0 else 0.0


def at(time: np.ndarray, values: np.ndarray, then: np.ndarray) -> np.ndarray:
    """(m,) values at other times, straight between neighbours; NaN outside, and in gaps.

    Args:
        time: (n,) s, increasing.
        values: (n,).
        then: (m,) s.
    """
    if time.size < 3:
        return np.full(then.size, np.nan)
    place = np.clip(np.searchsorted(time, then), 1, time.size - 1)
    near = time[place] - time[place - 1] < 1.5 * float(np.median(np.diff(time)))
    inside = (then >= time[0]) & (then <= time[-1]) & near
    return np.where(inside, np.interp(then, time, values), np.nan)


def outbursts(r: np.ndarray, block: np.ndarray) -> float:
    """Share of a residual's energy in outbursts: 0 for noise that is even over time.

    What exceeds the median energy of the blocks, if their mean is several times that. Blocks with
    few rows do not count.

    Args:
        r: (n,) residual.
        block: (n,) number of the block of time.
    """
    if r.size < _FEW:
        return 0.0
    rows = np.bincount(block)
    full = rows > 0.5 * np.median(rows[rows > 0])
    energy = np.bincount(block, r**2)[full] / rows[full]
    mean = float(energy.mean())
    even = float(np.median(energy)) / mean if mean > 0.0 else 1.0
    return 1.0 - even if even < EVEN else 0.0
