"""Values that stand still though the machine moves: repeated rows, frozen and clipped channels."""

from dataclasses import dataclass

import numpy as np

from modeler.numerics.noise import estimate_lattice_step, estimate_white_noise

OFTEN = 0.01
"""Share of the rows that repeat the one before from which on a recorder is faster than a robot."""

TOGETHER = 0.5
"""Least share of the rows with repeated positions in which all else repeats too."""

ANEW = 0.8
"""Least share of the other rows in which some channel has a new value: else each is held by itself.
"""

RESTS = 10.0
"""Times the usual number of equal rows that a robot at rest exceeds, and a recorder does not."""

LONGER = 4.0
"""Times the other runs of equal values of a channel that a frozen one lasts, and ..."""

LEAST = 20
"""... samples of it, at least."""

OVERSHOOT = 15.0
"""Standard deviations of its noise that a motion exceeds over a few rows, where it is no rest."""

_FEW = 3  # long runs of equal values that may be faults


def find_equal_rows(values: np.ndarray) -> np.ndarray:
    """(n,) True where a row of values (n, k) is, to the bit, the one before it; NaN is NaN."""
    same = (values[1:] == values[:-1]) | (np.isnan(values[1:]) & np.isnan(values[:-1]))
    return np.concatenate([[False], same.all(axis=1)])


def find_run_lengths(new: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Starts and lengths of the runs that begin where new (n,) is True; the first always does."""
    starts = np.flatnonzero(np.concatenate([[True], new[1:]]))
    return starts, np.diff(starts, append=len(new))


def find_repeated_rows(
    positions: np.ndarray, others: np.ndarray, always: bool = False
) -> np.ndarray:
    """(n,) True at the rows that a recorder wrote again, as it was faster than the robot.

    Then all channels repeat together, again and again, a few rows each time. One channel repeats
    alone where it is coarse; all of them do for long where the robot rests.

    Args:
        positions: (n, J).
        others: (n, k) all other channels that were measured at the same time.
        always: it is known already that the log has such rows.
    """
    still = find_equal_rows(positions)
    same = still & find_equal_rows(others)
    _, length = find_run_lengths(~same)
    usual = max(float(np.median(length)), 1.0)
    same &= ~np.repeat(length > RESTS * usual, length)
    fresh = np.column_stack([positions, others])[~same]
    anew = np.mean(fresh[1:] != fresh[:-1], axis=0) if len(fresh) > 1 else np.zeros(1)
    often = same.mean() > OFTEN and same.sum() > TOGETHER * still.sum() and anew.max() > ANEW
    if always or (often and all(estimate_hold_length(channel) == 1 for channel in fresh.T)):
        return np.asarray(same)
    return np.zeros(len(same), dtype=bool)


def find_longest_usual_run(values: np.ndarray) -> int:
    """Samples of the longest run of equal values (n,) but for the three longest of all."""
    _, length = find_run_lengths(np.concatenate([[True], np.diff(values) != 0.0]))
    return int(np.sort(length)[-_FEW - 1]) if len(length) > _FEW else len(values)


def find_frozen_runs(values: np.ndarray, position: np.ndarray, usual: int) -> list[tuple[int, int]]:
    """[start, stop) where a channel repeats a value far longer than it does else, in motion.

    Not at its largest and smallest value, where it may be at a limit, and not at 0: switched off.

    Args:
        values: (n,) of the channel, without gaps.
        position: (n,) of its joint.
        usual: `find_longest_usual_run` of the whole channel.
    """
    starts, length = find_run_lengths(np.concatenate([[True], np.diff(values) != 0.0]))
    long = length > max(LEAST, LONGER * usual)
    least = 2.0 * OVERSHOOT * estimate_channel_noise(position) if long.any() else 0.0
    return [
        (int(start) + 1, int(start + count))
        for start, count in zip(starts[long], length[long], strict=True)
        if values.min() < values[start] < values.max()
        and values[start] != 0.0
        and abs(float(position[start + count - 1] - position[start])) > least
    ]


def estimate_channel_noise(values: np.ndarray) -> float:
    """Standard deviation of a channel's noise (n,), or of its steps, the larger; 0 of a few."""
    if len(values) < LEAST:
        return 0.0
    return max(estimate_lattice_step(values) / float(np.sqrt(12.0)), estimate_white_noise(values))


def estimate_hold_length(values: np.ndarray) -> int:
    """Rows for which a channel (n,) repeats each value, as it is sampled more slowly; 1: none.

    Only runs between two changes of more than `COARSE` lattice steps count: a slow motion stays on
    a count of its encoder too.
    """
    there = values[np.isfinite(values)]
    if len(there) < LEAST:
        return 1
    starts, length = find_run_lengths(np.concatenate([[True], np.diff(there) != 0.0]))
    if len(starts) < FEWEST:
        return 1
    jumps = np.abs(np.diff(there[starts])) > COARSE * estimate_lattice_step(there)
    both = np.append(False, jumps[:-1] & jumps[1:])
    runs = length[:-1][both]
    _, again = np.unique(there[starts[:-1][both]], return_counts=True)
    if len(runs) < FEWEST or again.max() > SWITCHED * len(runs):
        return 1
    usual = float(np.median(runs))
    alike = np.mean(np.abs(runs - usual) <= max(1.0, 0.3 * usual)) > ALIKE
    alike = alike and np.mean(runs < 0.7 * usual) < SHORT
    return round(usual) if alike and usual >= 2.0 else 1


def interpolate_held_channel(
    time: np.ndarray, values: np.ndarray, rows: int, smooth: bool
) -> np.ndarray:
    """(n,) a held channel, straight or smoothly from each new value to the next.

    Args:
        time: (n,) s.
        values: (n,), NaN where missing.
        rows: for which values are held; one that stays longer was sampled again.
        smooth: by a cubic spline, whose second derivative does not leap.
    """
    there = np.flatnonzero(np.isfinite(values))
    starts, length = find_run_lengths(np.concatenate([[True], np.diff(values[there]) != 0.0]))
    age = np.arange(len(there)) - np.repeat(starts, length)
    fresh = there[(age % rows == 0) & (age < np.repeat(np.maximum(length - rows // 2, 1), length))]
    if smooth and len(fresh) > 1:
        from scipy.interpolate import CubicSpline  # takes long to load

        inside = np.clip(time, time[fresh[0]], time[fresh[-1]])
        between = CubicSpline(time[fresh], values[fresh])(inside)
    else:
        between = np.interp(time, time[fresh], values[fresh])
    return np.where(np.isfinite(values), between, np.nan)


COARSE = 3.0
"""Lattice steps that a change of a held channel exceeds ..."""

FEWEST = 8
"""... and the runs of equal values between such changes that show a hold ..."""

SWITCHED = 0.3
"""Share of the runs that have one value, at most: more, and a drive switches between its limits."""

ALIKE = 0.7
"""... of which this share is as long as the others."""

SHORT = 0.15
"""Share of runs that are shorter, at most: differences of an encoder's counts change at any row."""


@dataclass(frozen=True)
class Clip:
    """A value that a position does not pass, although its motion goes on.

    Attributes:
        value: that it stays at.
        upper: True if it is the largest, False if it is the smallest.
    """

    value: float
    upper: bool


LASTING = 0.75
"""Of its speed over the rows before, that a clipped motion has over the last ones before it stops:
a joint that turns back slows down."""

EVEN = 20
"""Rows of one stay that shows a clip by itself; else there are two stays."""


def find_clips(values: np.ndarray) -> tuple[Clip, ...]:
    """The ends of the range at which a position (n,) is cut off.

    A motion that is cut off reaches the end without slowing down, stays there to the bit, and
    leaves it as fast.
    """
    there = values[np.isfinite(values)]
    clips = []
    for sign in (1.0, -1.0):
        x = sign * there
        if len(x) <= LEAST or np.ptp(x) == 0.0:
            continue
        top = float(x.max())
        starts, length = find_run_lengths(np.concatenate([[True], np.diff(x == top) != 0]))
        least = OVERSHOOT * estimate_channel_noise(x)
        stays = [
            int(count)
            for start, count in zip(starts, length, strict=True)
            if x[start] == top
            and count >= 5
            and _is_unbraked(x[:start], least)
            and _is_unbraked(x[start + count :][::-1], least)
        ]
        enough = len(stays) > 1 or max(stays, default=0) >= EVEN
        if enough and sum(stays) > 0.5 * np.sum(x == top):
            clips.append(Clip(sign * top, sign > 0.0))
    return tuple(clips)


def _is_unbraked(before: np.ndarray, least: float) -> bool:
    """True if a motion (m,) goes on to its last value as fast as it was before, and not slowly.

    Over three rows, or so many that it goes farther than its noise.
    """
    for rows in (3, 6, 12):
        if len(before) <= 2 * rows:
            return False
        earlier, last = np.diff(before[[-1 - 2 * rows, -1 - rows, -1]])
        if max(earlier, last) > least:
            return bool(last >= LASTING * earlier)
    return False
