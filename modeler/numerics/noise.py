"""Noise of a sampled channel, its isolated outliers, and what noise does not do."""

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import median_filter

from modeler.numerics.thresholds import THRESHOLDS

NEAR = 5.0
"""Times what its neighbourhood reaches, of an outlier: motion that is rough there is physics."""

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
