"""Smooth functions of one coordinate, and how much of a residual they explain on unseen motion."""

from dataclasses import dataclass

import numpy as np

_KNOTS = 16
_STIFFNESS = 1e-3  # of the penalty on second differences; small: fills empty stretches only


@dataclass(frozen=True, eq=False)
class Smooth:
    """A linear family of functions: columns (n, p) and the quadratic penalty (p, p)."""

    columns: np.ndarray
    penalty: np.ndarray


def smooth_function(x: np.ndarray, knots: int = _KNOTS) -> Smooth:
    """Piecewise linear functions of x, (n,); knots half at quantiles, half evenly spread.

    Quantiles put resolution where the data are (around zero velocity), even spacing covers the
    sparse ends. The hats sum to one, so the family contains the constants.
    """
    spread = np.linspace(x.min(), x.max(), knots - knots // 2)
    dense = np.quantile(x, np.linspace(0.0, 1.0, knots // 2 + 2)[1:-1])
    places = np.unique(np.concatenate((spread, dense)))
    span = float(places[-1] - places[0])
    if span <= 0.0:
        return Smooth(np.ones((x.size, 1)), np.zeros((1, 1)))
    # knots closer than 1 % of the range would be one column split in two
    keep = np.concatenate(([True], np.diff(places) > 0.01 * span))
    places = places[keep]
    return Smooth(_hats(x, places), _roughness(places.size))


def direction_function(sign: np.ndarray) -> Smooth:
    """A constant and a step at zero velocity."""
    return Smooth(np.column_stack((np.ones(sign.size), sign)), np.zeros((2, 2)))


def drift_function(time: np.ndarray, run: np.ndarray, knots: int = 5) -> Smooth:
    """Slow functions of time, each log its own, (n, knots * logs)."""
    parts = []
    for log in np.unique(run):
        rows = run == log
        part = smooth_function(time[rows], knots)
        columns = np.zeros((time.size, part.columns.shape[1]))
        columns[rows] = part.columns
        parts.append(Smooth(columns, part.penalty))
    return stack(parts)


def stack(parts: list[Smooth]) -> Smooth:
    """The sums of functions, one of each family."""
    sizes = np.cumsum([0, *(part.penalty.shape[0] for part in parts)])
    penalty = np.zeros((sizes[-1], sizes[-1]))
    for part, start, stop in zip(parts, sizes[:-1], sizes[1:], strict=True):
        penalty[start:stop, start:stop] = part.penalty
    return Smooth(np.hstack([part.columns for part in parts]), penalty)


def explained_share(function: Smooth, e: np.ndarray, blocks: int, folds: int) -> float:
    """Share of the variance of e that the family predicts on blocks it was not fitted to.

    1 - sum (e - f)^2 / sum (e - mean)^2, where f and mean come from the other blocks; 0 if that
    is negative, so white noise gives 0. Blocks are contiguous in row order: neighbouring samples,
    which share their noise, are not split between fitting and judging.

    Args:
        function: the family on the rows of e.
        e: residual, (n,), in time order.
        blocks: number of contiguous blocks.
        folds: block b is judged by the fit to all blocks with another b % folds.
    """
    fold = (np.arange(e.size) * blocks // e.size) % folds
    grams, sides = [], []
    for index in range(folds):
        rows = function.columns[fold == index]
        grams.append(rows.T @ rows)
        sides.append(rows.T @ e[fold == index])
    gram, side = np.sum(grams, axis=0), np.sum(sides, axis=0)
    size = gram.shape[0]
    scale = float(np.trace(gram)) / size
    # the last term only makes sums of families, which share their constants, solvable
    regular = scale * (_STIFFNESS * function.penalty + 1e-8 * np.eye(size))
    unexplained, variance = 0.0, 0.0
    for index in range(folds):
        judged = fold == index
        fitted = np.linalg.solve(gram - grams[index] + regular, side - sides[index])
        error = e[judged] - function.columns[judged] @ fitted
        unexplained += float(error @ error)
        centred = e[judged] - e[~judged].mean()
        variance += float(centred @ centred)
    return float(np.clip(1.0 - unexplained / variance, 0.0, 1.0)) if variance > 0.0 else 0.0


def _hats(x: np.ndarray, knots: np.ndarray) -> np.ndarray:
    right = np.clip(np.searchsorted(knots, x, side="right"), 1, knots.size - 1)
    weight = np.clip((x - knots[right - 1]) / (knots[right] - knots[right - 1]), 0.0, 1.0)
    columns = np.zeros((x.size, knots.size))
    rows = np.arange(x.size)
    columns[rows, right - 1] = 1.0 - weight
    columns[rows, right] = weight
    return columns


def _roughness(size: int) -> np.ndarray:
    if size < 3:
        return np.zeros((size, size))
    difference = np.diff(np.eye(size), n=2, axis=0)
    return difference.T @ difference
