"""Noise, outliers, frozen, repeated, clipped and held values of a sampled channel."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import median_filter

from modeler.numerics.thresholds import THRESHOLDS

NEAR = 5.0
"""... and this many times what its neighbourhood reaches: motion that is rough there is physics ...
"""

STEPS = 5.0
"""... and this many resolution steps of the channel."""

REACH = 30
"""Samples of the neighbourhood to both sides."""


LEAST = 4 * THRESHOLDS.median_half_width
"""Values below which nothing can be said."""


def estimate_robust_deviation(values: np.ndarray) -> float:
    """Returns 1.4826 median |values|: their standard deviation about 0 if most are Gaussian."""
    return 1.4826 * float(np.median(np.abs(values)))


def estimate_white_noise(values: np.ndarray) -> float:
    """Estimates the standard deviation of white noise on a smooth signal by third differences."""
    return estimate_robust_deviation(np.diff(values, 3)) / float(np.sqrt(20.0))


def subtract_running_median(values: np.ndarray) -> np.ndarray:
    """Returns (n,) values less their running median over 11 samples: near 0 for a smooth signal."""
    return np.asarray(values - compute_running_median(values))


def compute_running_median(values: np.ndarray) -> np.ndarray:
    """Computes (n,) the median over 11 samples, mirrored at the ends."""
    return np.asarray(median_filter(values, 2 * THRESHOLDS.median_half_width + 1, mode="reflect"))


def can_depart(values: np.ndarray, floor: float) -> bool:
    """Returns False if no value (n,) departs from its running median by more than a floor.

    Cheaply: 6 of 11 samples lie on the other side of their median, so one of the nearest does,
    also where they are mirrored at the ends.
    """
    nearest = range(1, (THRESHOLDS.median_half_width + 1) // 2 + 1)
    return any(np.abs(values[k:] - values[:-k]).max(initial=0.0) > floor for k in nearest)


def compute_outlier_threshold(departed: np.ndarray, resolution: float, share: float) -> float:
    """Returns the departure below which no value of a channel is an isolated outlier.

    The largest of `min_outlier_deviations` robust standard deviations, `min_outlier_over_rare`
    times what a share of the values exceeds, and `STEPS` resolution steps.

    Args:
        departed: (n,) `subtract_running_median` of the channel, of all its segments.
        resolution: its smallest step.
        share: of the values that may be lone, 8 at least.
    """
    size = np.abs(departed)
    if not size.size:
        return float("inf")
    rare = min(len(size) - 1, max(THRESHOLDS.min_rare_values, round(share * len(size))))
    common = float(np.partition(size, len(size) - 1 - rare)[len(size) - 1 - rare])
    return max(
        THRESHOLDS.min_outlier_deviations * estimate_robust_deviation(departed),
        THRESHOLDS.min_outlier_over_rare * common,
        STEPS * resolution,
    )


def compute_local_threshold(departed: Sequence[np.ndarray], floor: float, share: float) -> float:
    """Returns the threshold of a channel, or that of a part where many values exceed it.

    What happens again and again in a part is no lone value there, however quiet the rest is.

    Args:
        departed: (n,) `subtract_running_median` of the segments of the part.
        floor: `compute_outlier_threshold` of the whole channel.
        share: of the values that may be lone.
    """
    beyond = sum(int(np.count_nonzero(np.abs(part) > floor)) for part in departed)
    if beyond <= THRESHOLDS.min_rare_values:
        return floor
    return max(floor, compute_outlier_threshold(np.concatenate(departed), 0.0, share))


def find_isolated_outliers(departed: np.ndarray, floor: float) -> np.ndarray:
    """Finds the places of isolated outliers of one segment, increasing.

    Args:
        departed: (n,) `subtract_running_median` of the segment.
        floor: what they exceed, besides `NEAR` times the fourth largest within 30 samples. The
            first and the last ten are not judged: a machine that is just switched on leaps too, and
            the start-up of the position filter costs these samples anyway.
    """
    size = np.abs(departed)
    size[: THRESHOLDS.unjudged_ends] = size[max(0, len(size) - THRESHOLDS.unjudged_ends) :] = 0.0
    levels = ((int(k), compute_nearby_level(size, int(k))) for k in np.flatnonzero(size > floor))
    places = [k for k, level in levels if size[k] > NEAR * level]
    return np.array(places, dtype=int)


def compute_nearby_level(size: np.ndarray, place: int) -> float:
    """Returns the fourth largest of size (n,) within 30 samples of a place, the place included."""
    window = size[max(0, place - REACH) : place + REACH + 1]
    order = max(0, len(window) - 1 - THRESHOLDS.max_outliers_nearby)
    return float(np.partition(window, order)[order])


# What noise does not do: return in the next lap, last, come in bursts.


def compute_noise_memory(cutoff: float) -> float:
    """Returns the correlation time, s, of noise behind a parallel filter (cut-off in Hz, 0: none).

    Torque noise and quantisation are forgotten within a tenth of a second; a brake that drags, a
    cable that pulls, a temperature are not. Rows of a narrow band are correlated longer by
    themselves.
    """
    if cutoff:
        return max(THRESHOLDS.min_correlation_time, THRESHOLDS.correlation_periods / cutoff)
    return THRESHOLDS.min_correlation_time


def estimate_recurring_share(
    time: np.ndarray, r: np.ndarray, run: np.ndarray, later: Sequence[float]
) -> float | None:
    """Estimates the share of a residual's variance that persists or recurs some time later.

    0 where it is no more than two standard errors, from sums over parts of the rows: by chance.

    Args:
        time: (n,) s, increasing within each log.
        r: (n,) residual.
        run: (n,) number of the log.
        later: s by log: a lap, or what noise is forgotten in; 0 leaves a log out. None are left:
            None.
    """
    products, square = [np.zeros(0)], 0.0
    logs = [(run == k, step) for k, step in enumerate(later) if step]
    least = THRESHOLDS.min_log_rows
    logs = [(is_of_log, step) for is_of_log, step in logs if is_of_log.sum() >= least]
    for is_of_log, step in logs:
        second = interpolate_between_gaps(time[is_of_log], r[is_of_log], time[is_of_log] + step)
        both = np.isfinite(second)
        first, second = r[is_of_log][both], second[both]
        products.append(first * second)
        square += 0.5 * float(first @ first + second @ second)
    if not logs:
        return None
    every = np.concatenate(products)
    if not square > 0.0:
        return 0.0
    parts = [float(part.sum()) for part in np.array_split(every, THRESHOLDS.recurrence_parts)]
    total, scatter = sum(parts), float(np.sqrt(THRESHOLDS.recurrence_parts) * np.std(parts, ddof=1))
    return total / square if total > THRESHOLDS.min_t_ratio * scatter else 0.0


def interpolate_between_gaps(time: np.ndarray, values: np.ndarray, then: np.ndarray) -> np.ndarray:
    """Interpolates (m,) values at other times linearly; NaN outside, and in gaps.

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


def estimate_burst_share(r: np.ndarray, block: np.ndarray) -> float:
    """Estimates the share of a residual's energy in bursts: 0 for stationary noise.

    What exceeds the median energy of the blocks, if their mean is several times that. Blocks with
    few rows do not count.

    Args:
        r: (n,) residual.
        block: (n,) number of the block of time.
    """
    if r.size < THRESHOLDS.min_burst_rows:
        return 0.0
    rows = np.bincount(block)
    full = rows > 0.5 * np.median(rows[rows > 0])
    energy = np.bincount(block, r**2)[full] / rows[full]
    mean = float(energy.mean())
    even = float(np.median(energy)) / mean if mean > 0.0 else 1.0
    return 1.0 - even if even < THRESHOLDS.min_even_energy else 0.0


# The smallest step of a channel.


_SINGLE = 2.4e-7  # of the largest value: two steps of single precision
_DECIMAL = 1e-9  # of the largest value: rounding of the text or the arithmetic


def estimate_lattice_step(values: np.ndarray) -> float:
    """Estimates the step of the lattice that the values (n,) lie on; 0 without one.

    Least squares over small differences of neighbours, or of levels where neighbours are too far
    apart. Differences at the level of single precision are arithmetic.
    """
    there = values[np.isfinite(values)]
    largest = float(np.max(np.abs(there), initial=0.0))
    levels = np.unique(there)
    new = len(levels) / max(1, len(there))
    for rounding in (_DECIMAL * largest, _SINGLE * largest):
        for gaps, share in ((np.abs(np.diff(there)), new), (np.diff(levels), 1.0)):
            step = _fit_lattice_step(gaps[gaps > rounding], share)
            if step > 4.0 * _SINGLE * largest:
                return step
    return 0.0


def _fit_lattice_step(gaps: np.ndarray, levels: float) -> float:
    """Least-squares step of differences (m,) above rounding; 0 if they have none.

    Args:
        gaps: differences.
        levels: share of the values that are new; few differences do where it is small.
    """
    if not len(gaps):
        return 0.0
    step = float(np.quantile(gaps, 0.01, method="lower"))
    gaps = gaps[gaps < THRESHOLDS.max_lattice_steps * step]
    whole = np.round(gaps / step)
    step = float(whole @ gaps / (whole @ whole))
    off = float(np.quantile(np.abs(gaps - step * np.round(gaps / step)), 0.9))
    # differences of one size may be a constant speed, where no value comes again
    seen = levels < THRESHOLDS.max_new_levels or np.mean(whole == 1.0) < THRESHOLDS.max_new_levels
    sure = len(gaps) >= THRESHOLDS.min_lattice_gaps or levels < 0.1
    return step if seen and sure and off < THRESHOLDS.max_lattice_deviation * step else 0.0


# Values that stand still though the machine moves: repeated rows, frozen and clipped channels.


RESTS = 10.0
"""Times the usual number of equal rows that a robot at rest exceeds, and a recorder does not."""


def find_equal_rows(values: np.ndarray) -> np.ndarray:
    """Returns (n,) True where a row of values (n, k) equals the one before; NaN is NaN."""
    same = (values[1:] == values[:-1]) | (np.isnan(values[1:]) & np.isnan(values[:-1]))
    return np.concatenate([[False], same.all(axis=1)])


def find_run_lengths(new: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns starts and lengths of the runs that begin where new (n,) is True, and at 0."""
    starts = np.flatnonzero(np.concatenate([[True], new[1:]]))
    return starts, np.diff(starts, append=len(new))


def find_repeated_rows(
    positions: np.ndarray, others: np.ndarray, always: bool = False
) -> np.ndarray:
    """Returns (n,) True at rows that a recorder faster than the robot wrote again.

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
    often = (
        same.mean() > THRESHOLDS.min_repeated_rows
        and same.sum() > THRESHOLDS.min_joint_repeats * still.sum()
        and anew.max() > THRESHOLDS.min_new_values
    )
    if always or (often and all(estimate_hold_length(channel) == 1 for channel in fresh.T)):
        return np.asarray(same)
    return np.zeros(len(same), dtype=bool)


def find_longest_usual_run(values: np.ndarray) -> int:
    """Returns the samples of the longest run of equal values (n,), the three longest left out."""
    _, length = find_run_lengths(np.concatenate([[True], np.diff(values) != 0.0]))
    if len(length) > THRESHOLDS.ignored_long_runs:
        return int(np.sort(length)[-THRESHOLDS.ignored_long_runs - 1])
    return len(values)


def find_frozen_runs(values: np.ndarray, position: np.ndarray, usual: int) -> list[tuple[int, int]]:
    """Finds [start, stop) where a channel repeats a value unusually long during motion.

    Not at its largest and smallest value, where it may be at a limit, and not at 0: switched off.

    Args:
        values: (n,) of the channel, without gaps.
        position: (n,) of its joint.
        usual: `find_longest_usual_run` of the whole channel.
    """
    starts, length = find_run_lengths(np.concatenate([[True], np.diff(values) != 0.0]))
    long = length > max(THRESHOLDS.min_channel_samples, THRESHOLDS.min_frozen_length * usual)
    noise = estimate_channel_noise(position) if long.any() else 0.0
    least = 2.0 * THRESHOLDS.min_motion_deviations * noise
    return [
        (int(start) + 1, int(start + count))
        for start, count in zip(starts[long], length[long], strict=True)
        if values.min() < values[start] < values.max()
        and values[start] != 0.0
        and abs(float(position[start + count - 1] - position[start])) > least
    ]


def estimate_channel_noise(values: np.ndarray) -> float:
    """Returns noise or quantisation of a channel (n,), the larger, 1 sigma; 0 of a few samples."""
    if len(values) < THRESHOLDS.min_channel_samples:
        return 0.0
    return max(estimate_lattice_step(values) / float(np.sqrt(12.0)), estimate_white_noise(values))


def estimate_hold_length(values: np.ndarray) -> int:
    """Estimates for how many rows a slower channel (n,) repeats each value; 1: none.

    Only runs between two changes of more than `COARSE` lattice steps count: a slow motion stays on
    a count of its encoder too.
    """
    there = values[np.isfinite(values)]
    if len(there) < THRESHOLDS.min_channel_samples:
        return 1
    starts, length = find_run_lengths(np.concatenate([[True], np.diff(there) != 0.0]))
    if len(starts) < THRESHOLDS.min_hold_runs:
        return 1
    jumps = np.abs(np.diff(there[starts])) > COARSE * estimate_lattice_step(there)
    both = np.append(False, jumps[:-1] & jumps[1:])
    runs = length[:-1][both]
    _, again = np.unique(there[starts[:-1][both]], return_counts=True)
    most = THRESHOLDS.max_switch_share * len(runs)
    if len(runs) < THRESHOLDS.min_hold_runs or again.max() > most:
        return 1
    usual = float(np.median(runs))
    alike = np.mean(np.abs(runs - usual) <= max(1.0, 0.3 * usual)) > THRESHOLDS.min_equal_runs
    alike = alike and np.mean(runs < 0.7 * usual) < THRESHOLDS.max_short_runs
    return round(usual) if alike and usual >= 2.0 else 1


def interpolate_held_channel(
    time: np.ndarray, values: np.ndarray, rows: int, smooth: bool
) -> np.ndarray:
    """Interpolates (n,) a held channel, linearly or smoothly between its new values.

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


@dataclass(frozen=True)
class Clip:
    """A value that a position does not pass, although its motion goes on.

    Attributes:
        value: that it stays at.
        upper: True if it is the largest, False if it is the smallest.
    """

    value: float
    upper: bool


def find_clips(values: np.ndarray) -> tuple[Clip, ...]:
    """Finds the ends of the range at which a position (n,) is clipped.

    A motion that is cut off reaches the end without slowing down, stays there to the bit, and
    leaves it as fast.
    """
    there = values[np.isfinite(values)]
    clips = []
    for sign in (1.0, -1.0):
        x = sign * there
        if len(x) <= THRESHOLDS.min_channel_samples or np.ptp(x) == 0.0:
            continue
        top = float(x.max())
        starts, length = find_run_lengths(np.concatenate([[True], np.diff(x == top) != 0]))
        least = THRESHOLDS.min_motion_deviations * estimate_channel_noise(x)
        stays = [
            int(count)
            for start, count in zip(starts, length, strict=True)
            if x[start] == top
            and count >= 5
            and _is_unbraked(x[:start], least)
            and _is_unbraked(x[start + count :][::-1], least)
        ]
        enough = len(stays) > 1 or max(stays, default=0) >= THRESHOLDS.min_single_stay
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
            return bool(last >= THRESHOLDS.min_end_speed * earlier)
    return False
