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
_FEW_OF_LAPS = 20  # rows of a log


def lasting(time: np.ndarray, r: np.ndarray, run: np.ndarray, cutoff: float) -> float:
    """Share of a residual's variance that is still there after `LATER`: its autocorrelation.

    Torque noise and quantisation are forgotten within a tenth of a second; a brake that drags, a
    cable that pulls, a temperature are not. Rows of a narrow band remember longer by themselves.

    Args:
        time: (n,) s, increasing within each log.
        r: (n,) residual.
        run: (n,) number of the log.
        cutoff: of the parallel filter, Hz; 0 for none.
    """
    later = max(LATER, FORGOTTEN / cutoff) if cutoff else LATER
    return _alike([(time[run == k], r[run == k], later) for k in np.unique(run)])


def repeating(
    time: np.ndarray, r: np.ndarray, run: np.ndarray, periods: Sequence[float]
) -> float | None:
    """Share of a residual's variance that returns in the next lap; None without laps.

    Args:
        time, r, run: as for `lasting`.
        periods: s by log; 0 where the motion does not repeat.
    """
    logs = [(time[run == k], r[run == k], period) for k, period in enumerate(periods) if period]
    laps = [log for log in logs if len(log[0]) >= _FEW_OF_LAPS]
    return _alike(laps) if laps else None


def _alike(logs: Sequence[tuple[np.ndarray, np.ndarray, float]]) -> float:
    """Products of residuals with those some time later over the mean of their squares, 0 to 1."""
    product = square = 0.0
    for time, r, later in logs:
        second = at(time, r, time + later)
        both = np.isfinite(second)
        first, second = r[both], second[both]
        product += float(first @ second)
        square += 0.5 * float(first @ first + second @ second)
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
