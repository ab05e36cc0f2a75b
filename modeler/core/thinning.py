"""Fewer points for a picture, without losing a peak."""

from collections.abc import Callable
from typing import Any

import numpy as np

LIMIT = 1200


def thin_curves(curves: tuple[np.ndarray, ...], limit: int = LIMIT) -> np.ndarray:
    """Row numbers to keep, increasing, at most `limit`, the same for all curves.

    The rows are cut into bins; of each bin stay the smallest and the largest value of each
    curve, so every extreme of every curve stays, and curves thinned together stay comparable
    sample by sample. NaN never counts as an extreme.

    Args:
        curves: values of each curve, (n,) each.
        limit: largest number of rows; at least 2 per curve plus 2.
    """
    rows = curves[0].size
    if rows <= limit:
        return np.arange(rows)
    size = -(-rows // max(1, (limit - 2) // (2 * len(curves))))
    row_groups = [np.array([0, rows - 1])]
    for values in curves:
        row_groups += [
            _find_bin_extremes(values, size, np.argmin, np.inf),
            _find_bin_extremes(values, size, np.argmax, -np.inf),
        ]
    return np.unique(np.concatenate(row_groups))


def _find_bin_extremes(
    values: np.ndarray, size: int, find: Callable[..., Any], gap: float
) -> np.ndarray:
    """The row of an extreme of each bin of so many rows; the last bin has what is left."""
    missing = np.isnan(values)
    filled = np.where(missing, gap, values) if missing.any() else values
    whole = values.size - values.size % size
    extreme_rows = find(filled[:whole].reshape(-1, size), axis=1) + np.arange(0, whole, size)
    return (
        extreme_rows
        if whole == values.size
        else np.append(extreme_rows, whole + find(filled[whole:]))
    )


def thin_points(x: np.ndarray, y: np.ndarray, limit: int = LIMIT) -> np.ndarray:
    """Row numbers of a scatter to keep, increasing, at most `limit`.

    Half are the extremes of y along x, half are evenly spaced samples, so that both the
    outline and the density of the cloud stay.
    """
    if x.size <= limit:
        return np.arange(x.size)
    order = np.argsort(x, kind="stable")
    outline = order[thin_curves((y[order],), limit // 2)]
    even = np.linspace(0, x.size - 1, limit - limit // 2).astype(int)
    return np.unique(np.concatenate((outline, even)))
