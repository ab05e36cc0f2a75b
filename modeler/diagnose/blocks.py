"""Blocks of time, and folds that hold out different motion."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.diagnose.rank import FOLDS
from modeler.observation import Observation

BLOCK = 0.5
"""s; longer where logs are long: statistics over blocks need no more than `MOST`."""

MOST = 120

ALIKE = 0.98
"""Correlation of the motion with itself one period later from which on it repeats."""

_SHORTEST = 2.0  # s, of a lap


@dataclass(frozen=True, eq=False)
class Blocks:
    """Of an observation.

    Attributes:
        number: (s,) block of each sample.
        fold: (blocks,) fold of each block.
        period: s by log; 0 where the motion does not repeat.
    """

    number: np.ndarray
    fold: np.ndarray
    period: tuple[float, ...]


def blocks_of(observation: Observation) -> Blocks:
    """Blocks of half a second, and eight folds.

    Each log is cut into eight stretches; where its motion repeats, one lap is, and the same phase
    of all laps is held out together: neighbouring laps would give the answer away.
    """
    time, run = observation.time, observation.run
    length = max(BLOCK, _total(time, run) / MOST)
    number = np.zeros(len(time), dtype=int)
    folds: list[int] = []
    periods = []
    for log in range(len(observation.logs)):
        own = np.flatnonzero(run == log)
        if not own.size:
            periods.append(0.0)
            continue
        since = time[own] - time[own[0]]
        period = lap(since, observation.q[own])
        periods.append(period)
        block = np.floor(since / length).astype(int)
        _, block = np.unique(block, return_inverse=True)
        phase = (since % period) / period if period else since / (since[-1] + 1e-9)
        middle = np.zeros(block.max() + 1)
        np.add.at(middle, block, phase)
        middle /= np.bincount(block)
        number[own] = block + len(folds)
        folds += [(int(FOLDS * min(m, 0.999)) + log) % FOLDS for m in middle]
    return Blocks(number, np.array(folds), tuple(periods))


def _total(time: np.ndarray, run: np.ndarray) -> float:
    return float(sum(np.ptp(time[run == log]) for log in np.unique(run)))


def lap(since: np.ndarray, q: np.ndarray) -> float:
    """Period of a motion that repeats at least once, s; 0 if it does not.

    Args:
        since: (s,) s, from 0.
        q: (s, J) positions.
    """
    step = float(np.median(np.diff(since))) if len(since) > 2 else 0.0
    count = int(since[-1] / step) + 1 if step > 0.0 else 0
    if count < 8 or since[-1] < 2 * _SHORTEST:
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
    first = int(_SHORTEST / step)
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
