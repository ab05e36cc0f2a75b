"""Blocks of time, and folds that hold out different motion."""

from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief
from modeler.observation import Observation
from modeler.residuals.laps import lap

BLOCK = 0.5
"""s; longer where logs are long: statistics over blocks need no more than `MOST`."""

MOST = 120


FOLDS = 8


@dataclass(frozen=True, eq=False)
class Blocks(Brief):
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
