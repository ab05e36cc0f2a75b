"""The median of weighted values."""

import numpy as np

_SAME = 1e-6  # of all weight; less is rounding


def weighted_median(values: np.ndarray, weights: np.ndarray) -> float:
    """The smallest value up to which at least half of the weight lies.

    Half but for `_SAME`: of equal weights whose last digits differ, every choice of these digits
    (as that of a clock's zero) gives the same median.

    Args:
        values: (n,).
        weights: (n,) 0 or more, not all 0.
    """
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(total, (0.5 - _SAME) * total[-1])])
