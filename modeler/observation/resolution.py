"""The smallest step of a channel."""

import numpy as np

_ROUNDING = 1e-9  # of the largest value: smaller differences are those of the arithmetic


def resolution(values: np.ndarray) -> float:
    """Smallest step between two values (n,); 0 if there are no two."""
    levels = np.unique(values[np.isfinite(values)])
    gaps = np.diff(levels)
    gaps = gaps[gaps > _ROUNDING * np.max(np.abs(levels), initial=0.0)]
    return float(gaps.min()) if gaps.size else 0.0
