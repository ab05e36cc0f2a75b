"""Curves: columns whose sums are any smooth function of one coordinate."""

import numpy as np


def curve(x: np.ndarray, knots: int = 16) -> np.ndarray:
    """(n, p) hats over x (n,): straight between knots, half at quantiles, half evenly spread.

    Quantiles put resolution where the data are (around zero velocity), even spacing covers the
    sparse ends. The hats sum to one.
    """
    spread = np.linspace(x.min(), x.max(), knots - knots // 2)
    dense = np.quantile(x, np.linspace(0.0, 1.0, knots // 2 + 2)[1:-1])
    places = np.unique(np.concatenate((spread, dense)))
    span = float(places[-1] - places[0])
    if span <= 0.0:
        return np.ones((x.size, 1))
    # knots closer than 1 % of the range would be one column split in two
    places = places[np.concatenate(([True], np.diff(places) > 0.01 * span))]
    right = np.clip(np.searchsorted(places, x, side="right"), 1, places.size - 1)
    weight = np.clip((x - places[right - 1]) / (places[right] - places[right - 1]), 0.0, 1.0)
    columns = np.zeros((x.size, places.size))
    rows = np.arange(x.size)
    columns[rows, right - 1] = 1.0 - weight
    columns[rows, right] = weight
    return columns


def friction_curve(v: np.ndarray) -> np.ndarray:
    """(n, p) of a speed: smooth on either side of zero, with a step there."""
    return np.column_stack((curve(v), np.sign(v)))


def drift_curve(time: np.ndarray, run: np.ndarray, knots: int = 5) -> np.ndarray:
    """(n, knots * logs) slow functions of time, each log its own."""
    own = run[:, None] == np.unique(run)
    return np.hstack([curve(time, knots) * rows[:, None] for rows in own.T])
