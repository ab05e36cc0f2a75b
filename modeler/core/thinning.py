"""Fewer points for a picture, without losing a peak."""

from itertools import pairwise

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
    bins = max(1, (limit - 2) // (2 * len(curves)))
    edges = np.linspace(0, rows, bins + 1).astype(int)
    kept = [np.array([0, rows - 1])]
    for values in curves:
        low = np.where(np.isnan(values), np.inf, values)
        high = np.where(np.isnan(values), -np.inf, values)
        for start, stop in pairwise(edges):
            low_at, high_at = np.argmin(low[start:stop]), np.argmax(high[start:stop])
            kept.append(start + np.array([low_at, high_at]))
    return np.unique(np.concatenate(kept))


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
