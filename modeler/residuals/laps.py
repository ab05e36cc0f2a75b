"""Motion that repeats itself within one log."""

from collections.abc import Sequence

import numpy as np

ALIKE = 0.98
"""Correlation of the motion with itself one period later from which on it repeats."""

SHORTEST = 2.0
"""s, of a lap."""


def lap(since: np.ndarray, q: np.ndarray) -> float:
    """Period of a motion that repeats at least once, s; 0 if it does not.

    Args:
        since: (s,) s, from 0.
        q: (s, J) positions.
    """
    step = float(np.median(np.diff(since))) if len(since) > 2 else 0.0
    count = int(since[-1] / step) + 1 if step > 0.0 else 0
    if count < 8 or since[-1] < 2 * SHORTEST:
        return 0.0
    even = np.arange(count) * step
    moved = [np.interp(even, since, q[:, j]) for j in range(q.shape[1]) if np.ptp(q[:, j]) > 0.0]
    if not moved:
        return 0.0
    spread = [(x - x.mean()) / x.std() for x in moved]
    return _first_peak(spread, step)


def _first_peak(spread: Sequence[np.ndarray], step: float) -> float:
    count = len(spread[0])
    likeness = np.ones(count // 2 + 1)
    for x in spread:
        likeness = np.minimum(likeness, _likeness(x, count // 2 + 1))
    first = int(SHORTEST / step)
    high = np.flatnonzero(likeness[first:] > ALIKE) + first
    low = np.flatnonzero(likeness < 0.8)
    if not high.size or not low.size:
        return 0.0
    high = high[high > low[0]]
    if not high.size:
        return 0.0
    near = high[high < high[0] * 1.1 + 2]
    return float(near[np.argmax(likeness[near])] * step)


def _likeness(x: np.ndarray, lags: int) -> np.ndarray:
    """1 - mean squared difference of x(t + lag) and x(t) over twice its variance, by lag."""
    count = len(x)
    spectrum = np.fft.rfft(x, 2 * count)
    product = np.fft.irfft(np.abs(spectrum) ** 2)[:lags]
    power = np.concatenate([[0.0], np.cumsum(x**2)])
    overlap = count - np.arange(lags)
    head = power[overlap]
    tail = power[count] - power[np.arange(lags)]
    return 1.0 - (head + tail - 2.0 * product) / overlap / 2.0
