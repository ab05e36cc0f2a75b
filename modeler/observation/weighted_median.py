"""The median of weighted values."""

import numpy as np


def weighted_median(values: np.ndarray, weights: np.ndarray) -> float:
    """The smallest value up to which at least half of the weight lies.

    Args:
        values: (n,).
        weights: (n,) 0 or more, not all 0.
    """
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(total, 0.5 * total[-1])])
