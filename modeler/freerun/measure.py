"""How far simulated positions are from measured ones."""

import numpy as np

_IDLE = {"rad": 1e-3, "m": 1e-4}  # a joint that moves less stands still


def fit_percentage(measured: np.ndarray, simulated: np.ndarray) -> float | None:
    """100 (1 - |q - q_s| / |q - mean q|), %, of samples (p,), as MATLAB's `compare` has it.

    None if nothing moves. A simulated value that is not finite, of a robot that was lost, counts as
    far away as the farthest that is.
    """
    spread = float(np.linalg.norm(measured - measured.mean()))
    if spread == 0.0:
        return None
    error = np.abs(measured - simulated)
    lost = ~np.isfinite(error)
    if lost.any():
        error[lost] = max(float(error[~lost].max(initial=0.0)), float(np.ptp(measured)))
    return 100.0 * (1.0 - float(np.linalg.norm(error)) / spread)


def horizons(error: np.ndarray, bound: np.ndarray, step: float) -> np.ndarray:
    """(b, n) s until |error| (samples, b, n) first passes `bound` (n,); infinite: it never does.

    What is not finite has passed it; samples after the end of a start are 0.
    """
    passed = ~(np.abs(error) <= bound)
    first = np.argmax(passed, axis=0).astype(float) * step
    return np.where(passed.any(axis=0), first, np.inf)


def ranges_of(q: np.ndarray, units: list[str]) -> np.ndarray:
    """(n,) ranges of positions (p, n); NaN for a joint that hardly moves."""
    found = np.ptp(q, axis=0)
    least = np.array([_IDLE[unit] for unit in units])
    return np.where(found > least, found, np.nan)
