"""Values that stand still though the machine moves: repeated rows, frozen and clipped channels."""

from dataclasses import dataclass

import numpy as np

from modeler.numerics.noise import white_noise

OFTEN = 0.01
"""Share of the rows that repeat the one before from which on a recorder is faster than a robot."""

TOGETHER = 0.5
"""Least share of the rows with repeated positions in which all else repeats too."""

RESTS = 10.0
"""Times the usual number of equal rows that a robot at rest exceeds, and a recorder does not."""

LONGER = 4.0
"""Times the other runs of equal values of a channel that a frozen one lasts, and ..."""

LEAST = 20
"""... samples of it, at least."""

OVERSHOOT = 5.0
"""Steps of resolution and noise that a motion would have gone beyond the value that it stops at."""

STUCK = 0.005
"""Share of the values at an end of the range, at least: friction stops a joint there now and then.
"""

_FEW = 3  # long runs of equal values that may be faults
_PARABOLA = 1.5  # times the noise, what a motion may be off a parabola
_BEFORE = (6, 12, 24, 48)  # samples before a stop that show how the motion would go on


def equal_rows(values: np.ndarray) -> np.ndarray:
    """(n,) True where a row of values (n, k) is, to the bit, the one before it; NaN is NaN."""
    same = (values[1:] == values[:-1]) | (np.isnan(values[1:]) & np.isnan(values[:-1]))
    return np.concatenate([[False], same.all(axis=1)])


def lengths_of_runs(new: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Starts and lengths of the runs that begin where new (n,) is True; the first always does."""
    starts = np.flatnonzero(np.concatenate([[True], new[1:]]))
    return starts, np.diff(starts, append=len(new))


def repeated_rows(positions: np.ndarray, others: np.ndarray, always: bool = False) -> np.ndarray:
    """(n,) True at the rows that a recorder wrote again, as it was faster than the robot.

    Then all channels repeat together, again and again, a few rows each time. One channel repeats
    alone where it is coarse; all of them do for long where the robot rests.

    Args:
        positions: (n, J).
        others: (n, k) all other channels that were measured at the same time.
        always: it is known already that the log has such rows.
    """
    still = equal_rows(positions)
    same = still & equal_rows(others)
    _, length = lengths_of_runs(~same)
    usual = max(float(np.median(length)), 1.0)
    same &= ~np.repeat(length > RESTS * usual, length)
    if always or (same.mean() > OFTEN and same.sum() > TOGETHER * still.sum()):
        return np.asarray(same)
    return np.zeros(len(same), dtype=bool)


def longest_usual(values: np.ndarray) -> int:
    """Samples of the longest run of equal values (n,) but for the three longest of all."""
    _, length = lengths_of_runs(np.concatenate([[True], np.diff(values) != 0.0]))
    return int(np.sort(length)[-_FEW - 1]) if len(length) > _FEW else len(values)


def frozen_runs(values: np.ndarray, position: np.ndarray, usual: int) -> list[tuple[int, int]]:
    """[start, stop) where a channel repeats a value far longer than it does else, in motion.

    Not at its largest and smallest value, where it may be at a limit.

    Args:
        values: (n,) of the channel, without gaps.
        position: (n,) of its joint.
        usual: `longest_usual` of the whole channel.
    """
    starts, length = lengths_of_runs(np.concatenate([[True], np.diff(values) != 0.0]))
    long = length > max(LEAST, LONGER * usual)
    least = 2.0 * OVERSHOOT * noise_of(position) if long.any() else 0.0
    return [
        (int(start) + 1, int(start + count))
        for start, count in zip(starts[long], length[long], strict=True)
        if values.min() < values[start] < values.max()
        and abs(float(position[start + count - 1] - position[start])) > least
    ]


def noise_of(values: np.ndarray) -> float:
    """Resolution of a channel (n,) or its noise, the larger; 0 of a few values."""
    if len(values) < LEAST:
        return 0.0
    steps = np.abs(np.diff(values))
    moved = steps[steps > 1e-9 * max(float(np.ptp(values)), 1e-300)]
    grid = float(moved.min()) if moved.size and np.mean(steps == 0.0) > OFTEN else 0.0
    return max(grid, white_noise(values))


@dataclass(frozen=True)
class Clip:
    """A value that a position does not pass, although its motion goes on.

    Attributes:
        value: that it stays at.
        upper: True if it is the largest, False if it is the smallest.
    """

    value: float
    upper: bool


def clips_of(values: np.ndarray) -> tuple[Clip, ...]:
    """The ends of the range at which a position (n,) is cut off.

    A joint that turns back or stops slows down before; one that is cut off reaches the end in full
    motion, stays there to the bit and leaves it as fast. So the motion of the samples before each
    stay at the end, and after it, is carried on, as a parabola, and must lead beyond it.
    """
    there = values[np.isfinite(values)]
    found = []
    for sign in (1.0, -1.0):
        x = sign * there
        if len(x) <= LEAST or np.ptp(x) == 0.0:
            continue
        top = float(x.max())
        starts, length = lengths_of_runs(np.concatenate([[True], np.diff(x == top) != 0]))
        stays = [(s, n) for s, n in zip(starts, length, strict=True) if x[s] == top and n >= 5]
        noise = noise_of(x) if stays else 0.0
        cut = 0
        for start, count in stays:
            sides = (x[max(0, start - _BEFORE[-1]) : start],
                     x[start + count : start + count + _BEFORE[-1]][::-1])  # fmt: skip
            beyond = sum(_overshoot(side, count, top, noise) for side in sides)
            cut += int(count) if beyond > 2.0 * OVERSHOOT * noise else 0
        if cut > max(0.5 * np.sum(x == top), STUCK * len(x)):
            found.append(Clip(sign * top, sign > 0.0))
    return tuple(found)


def _overshoot(before: np.ndarray, stay: int, top: float, noise: float) -> float:
    """How far a motion that is a parabola just before leads beyond `top` in a stay there."""
    counts = (c for c in _BEFORE if c <= min(len(before), max(int(stay), _BEFORE[0])))
    carried = (_carried(before[-c:], min(0.5 * stay / c, 0.5), noise) - top for c in counts)
    return max(carried, default=0.0)


def _carried(before: np.ndarray, later: float, noise: float) -> float:
    """Where a motion (m,) leads that much later, by m samples; nowhere if it is no parabola."""
    time = np.arange(1 - len(before), 1) / len(before)
    shape = np.polyfit(time, before, 2)
    off = float(np.std(before - np.polyval(shape, time)))
    if off > _PARABOLA * noise or shape[1] <= 0.0:
        return float(before[-1])
    return float(shape[2] + shape[1] * later + min(shape[0], 0.0) * later**2)
