"""The flexible rival: how well can a smooth function of all that was measured predict a residual?"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np
from scipy.linalg.lapack import sposv
from scipy.optimize import nnls

LEAST = 100
"""Rows below which nothing is predicted."""

SURE = 2.0
"""Share over its standard error that is more than chance."""

_MOST = 3000  # rows that fits see; of more, every second, third, ...
_RIDGES = (0.1, 2.0)  # times the number of columns: noise over signal, variances
_FOLDS = 8
_PARTS = 40  # of the rows in order: what noise makes of one has nothing to do with the next


@dataclass(frozen=True, eq=False)
class Flexible:
    """What the rival says of one joint.

    Attributes:
        prediction: (n,) of the residual, N m or N; each row by fits to other stretches of time.
        share: of the residual's variance that it predicts, between 0 and 1.
        sigma: standard error of the share.
        alone: the same by each set of functions alone.
    """

    prediction: np.ndarray
    share: float
    sigma: float = 0.0
    alone: Mapping[str, float] = field(default_factory=dict)

    @property
    def sure(self) -> bool:
        """True if the share is more than chance, also in noise that has a colour."""
        return self.share > SURE * self.sigma


def flexible(sets: Mapping[str, np.ndarray], residual: np.ndarray, fold: np.ndarray) -> Flexible:
    """The residual as predicted by sets of functions where they were not fitted.

    Each set is fitted by ridge regression; the sets and their ridges are added with weights that
    are not negative (stacking, Wolpert 1992; Breiman 1996). Rows of one fold are predicted by what
    the others say: fits, and weights, which come from fits without a second fold. So neither a
    ridge nor a set is chosen by the rows that judge it, and noise, white or coloured, gives a
    share near 0.

    Args:
        sets: by name, (n, p) values of functions.
        residual: (n,), in order of time.
        fold: (n,) whole numbers from 0; a fold is made of stretches much longer than noise lasts.
    """
    n, folds = residual.size, np.unique(fold)
    y = residual - residual.mean() if n else residual
    energy = float(y @ y)
    usable = {name: _standard(values) for name, values in sets.items()}
    usable = {name: values for name, values in usable.items() if values.shape[1]}
    if n < LEAST or folds.size < 3 or energy == 0.0 or not usable:
        return Flexible(np.full(n, residual.mean() if n else 0.0), 0.0)
    place = np.searchsorted(folds, fold)
    found = [_crossed(values, y, place, folds.size) for values in usable.values()]
    every = -(-n // _MOST)
    seen = y[::every], place[::every]
    alone = {}
    for name, (inner, outer) in zip(usable, found, strict=True):
        alone[name] = _share(y, _stacked(inner, outer, *seen, place), energy)
    inner, outer = (np.concatenate([pair[k] for pair in found], axis=-1) for k in (0, 1))
    predicted = _stacked(inner, outer, *seen, place)
    share = _share(y, predicted, energy)
    return Flexible(predicted + residual.mean(), share, _error(y, predicted) / energy, alone)


def stretches(run: np.ndarray) -> np.ndarray:
    """(n,) folds for rows in order of time, their log by number: each log in eight stretches."""
    fold = np.zeros(run.size, dtype=int)
    for log in np.unique(run):
        own = np.flatnonzero(run == log)
        fold[own] = (np.arange(own.size) * _FOLDS // own.size + log) % _FOLDS
    return fold


def _share(y: np.ndarray, predicted: np.ndarray, energy: float) -> float:
    return max(0.0, 1.0 - float(np.sum((y - predicted) ** 2)) / energy)


def _error(y: np.ndarray, predicted: np.ndarray) -> float:
    """Standard error of the squares that a prediction takes away."""
    starts = np.arange(_PARTS) * y.size // _PARTS
    gains = np.add.reduceat(y**2 - (y - predicted) ** 2, starts)
    return float(np.sqrt(_PARTS) * gains.std(ddof=1))


def _crossed(
    X: np.ndarray, y: np.ndarray, fold: np.ndarray, folds: int
) -> tuple[np.ndarray, np.ndarray]:
    """Predictions by one set and each ridge: fits without two folds, and without one.

    Returns:
        (folds, rows that fits see, ridges): at [f], rows of another fold g by fits without f, g.
        (n, ridges): rows of a fold by fits without it.
    """
    every = -(-len(y) // _MOST)
    few, known, thin = X[::every], y[::every].astype(np.float32), fold[::every]
    rows = [np.flatnonzero(thin == f) for f in range(folds)]
    own = [few[r] for r in rows]
    grams = [x.T @ x for x in own]
    sides = [x.T @ known[r] for x, r in zip(own, rows, strict=True)]
    G, u = sum(grams), sum(sides)
    inner = np.zeros((folds, len(few), len(_RIDGES)))
    outer = np.zeros((len(X), len(_RIDGES)))
    every_row = [X[fold == f] for f in range(folds)]
    for k, ridge in enumerate(_RIDGES):
        for f in range(folds):
            theta = _solved(G - grams[f], ridge * X.shape[1], u - sides[f])
            outer[fold == f, k] = every_row[f] @ theta
        for f, g in combinations(range(folds), 2):
            theta = _solved(G - grams[f] - grams[g], ridge * X.shape[1], u - sides[f] - sides[g])
            inner[f, rows[g], k] = own[g] @ theta
            inner[g, rows[f], k] = own[f] @ theta
    return inner, outer


def _stacked(
    inner: np.ndarray, outer: np.ndarray, y: np.ndarray, thin: np.ndarray, fold: np.ndarray
) -> np.ndarray:
    """(n,) sum of predictions (n, c), weights of each fold from what others predict of others."""
    predicted = np.zeros(len(outer))
    for f, columns in enumerate(inner):
        known = columns[thin != f]
        gram = known.T @ known
        scale = float(np.trace(gram)) / len(gram)
        if scale == 0.0:
            continue
        root = np.linalg.cholesky(gram + 1e-6 * scale * np.eye(len(gram)))
        weights, _ = nnls(root.T, np.linalg.solve(root, known.T @ y[thin != f]))
        predicted[fold == f] = outer[fold == f] @ weights
    return predicted


def _solved(gram: np.ndarray, ridge: float, side: np.ndarray) -> np.ndarray:
    """x of (gram + ridge 1) x = side; a fresh symmetric gram is used up."""
    matrix = gram.T  # in the order of LAPACK, which then copies nothing
    matrix.flat[:: len(matrix) + 1] += ridge
    _, x, failed = sposv(matrix, side, lower=1, overwrite_a=1)
    assert failed == 0, "a ridge keeps the matrix positive"
    return np.asarray(x)


def _standard(features: np.ndarray) -> np.ndarray:
    """Mean 0 and standard deviation 1; without what is constant."""
    centred = features - features.mean(axis=0) if len(features) else features
    size = np.sqrt(np.einsum("ij,ij->j", centred, centred) / max(1, len(centred)))
    seen = size > 1e-9
    return np.asarray(centred[:, seen] / size[seen], dtype=np.float32)
