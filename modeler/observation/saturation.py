"""Torque stuck at the drive's limit."""

import numpy as np

LEAST_RUN = 5
QUANTA = 3.0


def saturated(values: np.ndarray, extremes: tuple[float, float] | None = None) -> np.ndarray:
    """Samples at which a torque is clipped; (n,) bool.

    A run counts when the torque is exactly its largest or smallest value of the whole log for at
    least 5 samples in a row, and leaps into or out of that run by more than 3 steps of its own
    resolution. A clean quantised signal rounds its crest one step at a time and is not caught;
    a torque at rest, which is constant all along, has no leap and is not caught either.

    Args:
        values: (n,) torque of one joint, NaN where missing.
        extremes: smallest and largest value of the log elsewhere, of which these are a part.
    """
    found = np.zeros(len(values), dtype=bool)
    if not len(values):
        return found
    low, high = float(np.fmin.reduce(values)), float(np.fmax.reduce(values))
    if not low < high:
        return found
    ends = [low, high]
    if extremes is not None:
        ends = [low] * (low <= extremes[0]) + [high] * (high >= extremes[1])
    runs = [(end, run) for end in ends for run in _runs(values == end) if _long_enough(run)]
    if not runs:
        return found
    gaps = np.diff(np.unique(values[np.isfinite(values)]))
    # Differences at the level of rounding (a product with a drive gain) are no resolution.
    resolution = float(np.min(gaps[gaps > 1e-9 * (high - low)]))
    for extreme, (start, stop) in runs:
        beside = [values[i] for i in (start - 1, stop) if 0 <= i < len(values)]
        leap = max((abs(extreme - v) for v in beside if np.isfinite(v)), default=0.0)
        if leap > QUANTA * resolution:
            found[start:stop] = True
    return found


def _long_enough(run: tuple[int, int]) -> bool:
    """True of a run that may be clipped."""
    return run[1] - run[0] >= LEAST_RUN


def _runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """[start, stop) of each stretch of True."""
    steps = np.diff(np.concatenate(([0], flags.astype(np.int8), [0])))
    return list(zip(np.flatnonzero(steps == 1), np.flatnonzero(steps == -1), strict=True))
