"""Least squares over rows of unequal, modelled variance: one sum of known shares per row."""

from dataclasses import dataclass

import numpy as np

from modeler.core.choices import Method
from modeler.estimate.coloured import autocorrelation, repeated
from modeler.estimate.compressed import triangle
from modeler.estimate.least_squares import condition_numbers
from modeler.estimate.rank import Rank, independent_columns

_ROUNDS = 30
_SETTLED = 1e-6  # relative change of the variances
_LEAST = 1e-12  # of the mean square of y: a variance is at least this


@dataclass(frozen=True, eq=False)
class Unequal:
    """The solution; c columns. Columns set aside have value 0 and no variance.

    Attributes:
        beta: (c,).
        covariance: (c, c).
        deviation: (rows,) modelled standard deviation of each row.
        rank: columns kept and set aside.
        settled: the variances reached their fixed point.
        condition_number: of W, kept columns, unweighted.
        condition_scaled: with columns of length one.
        memory: largest factor by which neighbours that repeat each other raise a sigma.
    """

    beta: np.ndarray
    covariance: np.ndarray
    deviation: np.ndarray
    rank: Rank
    settled: bool
    condition_number: float
    condition_scaled: float
    memory: float


def unequal_least_squares(
    W: np.ndarray,
    y: np.ndarray,
    shares: np.ndarray,
    names: tuple[str, ...],
    stretch: np.ndarray,
    method: Method = "weighted",
) -> Unequal:
    """The estimate of beta in y = W beta + rho, var(rho_r) = sum_j shares_rj s_j, s_j >= 0.

    The variances s_j, and one more that all rows have alike (what no source of noise explains:
    rows at rest must not weigh without bound), follow from the squares of the residuals by
    Fisher's scoring, which is their maximum likelihood for normal noise: weighted non-negative
    least squares of r^2 / (1 - h), h the leverage, with weights 1 / var^2, until they settle.

    Weighted: rows divided by their standard deviations, (W^T V^-1 W)^-1. Ordinary: eq. (18) of
    Houda et al., all rows alike; its covariance is (W^T W)^-1 W^T V W (W^T W)^-1, for the rows are
    no more alike than before. Both are raised where neighbouring residuals repeat each other.

    Args:
        W: (rows, c).
        y: (rows,).
        shares: (rows, sources) not negative.
        names: (c,).
        stretch: (rows,) number of the stretch of each row; within one, rows are neighbours.
        method: "weighted" or "ordinary".
    """
    rank = independent_columns(triangle(W), names)
    kept = np.asarray(rank.kept, dtype=int)
    X = W[:, kept]
    deviation, settled = _settled_deviations(X, y, _with_common(shares), method)
    A = _influence(X, 1.0 / deviation if method == "weighted" else np.ones(len(y)))
    beta, covariance = np.zeros(len(names)), np.zeros((len(names),) * 2)
    beta[kept] = A @ y
    C = (A * deviation**2) @ A.T
    factors = _memory(A * deviation, (y - W @ beta) / deviation, C, stretch)
    covariance[np.ix_(kept, kept)] = C * np.outer(factors, factors)
    raw, scaled = condition_numbers(X)
    largest = float(factors.max(initial=1.0))
    return Unequal(beta, covariance, deviation, rank, settled, raw, scaled, largest)


def _settled_deviations(
    X: np.ndarray, y: np.ndarray, sources: np.ndarray, method: Method
) -> tuple[np.ndarray, bool]:
    """(rows,) standard deviations, and whether they no longer change."""
    deviation = np.ones(len(y))
    for _ in range(_ROUNDS):
        A = _influence(X, 1.0 / deviation if method == "weighted" else np.ones(len(y)))
        leverage = np.clip(np.einsum("rc,cr->r", X, A), 0.0, 0.99)
        squares = (y - X @ (A @ y)) ** 2 / (1.0 - leverage)
        updated = _deviations(squares, sources, deviation, y)
        if np.all(np.abs(updated / deviation - 1.0) < _SETTLED):
            return updated, True
        deviation = updated
    return deviation, False


def _influence(X: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """(c, rows) A of beta = A y."""
    lengths = np.linalg.norm(X * weight[:, None], axis=0)
    q, r = np.linalg.qr(X * weight[:, None] / lengths)
    return np.asarray(np.linalg.solve(r, q.T) / lengths[:, None] * weight)


def _with_common(shares: np.ndarray) -> np.ndarray:
    """(rows, sources + 1) shares of mean one, and a source that all rows have alike."""
    used = shares[:, shares.max(axis=0) > 0.0]
    return np.column_stack([used / used.mean(axis=0), np.ones(len(shares))])


def _deviations(
    squares: np.ndarray, sources: np.ndarray, deviation: np.ndarray, y: np.ndarray
) -> np.ndarray:
    """(rows,) from squares of residuals, by one step of scoring."""
    weight = 1.0 / deviation**2
    scale = float(np.mean(squares * weight)) or 1.0
    from scipy.optimize import nnls  # it takes long to load

    found, _ = nnls(sources * weight[:, None], squares * weight / scale)
    least = max(_LEAST * float(np.mean(y**2)), np.finfo(float).tiny)
    return np.asarray(np.sqrt(np.maximum(sources @ found * scale, least)))


def _memory(rows: np.ndarray, white: np.ndarray, C: np.ndarray, stretch: np.ndarray) -> np.ndarray:
    """(c,) factors on the standard deviations, 1 and more, as in `coloured`.

    Neighbours share the sample between them, so a little of it is always there.
    """
    sample = np.arange(len(white))
    extra = repeated(rows.T, autocorrelation(white, sample, stretch), sample, stretch)
    return np.sqrt(np.maximum(1.0 + extra / np.diag(C), 1.0))
