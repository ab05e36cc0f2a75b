"""Ranking: how much of the residual each candidate explains on motion it was not fitted to."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.diagnosis.gram import VISIBLE, Base, Pool, but_one, solved


@dataclass(frozen=True, eq=False)
class Ranking:
    """Of N candidates; weighted units: the residual of each joint has variance about 1.

    Attributes:
        drop: (blocks, N) fall of the squared residual in blocks that were held out.
        before: (J,) squared residual there without any candidate.
        sure: (N,) fall fitted on all rows over its standard error: sums over blocks of what the
            candidate explains and what it leaves, so that coloured residuals count.
        value: by candidate, its parameters on all rows, SI.
        deviation: their standard deviation for white residuals of variance 1, SI.
        visible: (N,) share of the columns that the base does not hide.
    """

    drop: np.ndarray
    before: np.ndarray
    sure: np.ndarray
    value: Sequence[np.ndarray]
    deviation: Sequence[np.ndarray]
    visible: np.ndarray


def rank(base: Base, pool: Pool) -> Ranking:
    """Blocked cross-validation of every candidate beside the base.

    Candidates are projected off the base: what the base can imitate is not theirs. For each fold,
    base and candidate are fitted on the others, and the fall of the squared residual is counted
    there, block by block.

    Args:
        base: current model.
        pool: candidates.
    """
    every = _whole(base, pool)
    cross, square = _by_fit(base, pool, every, slice(None), slice(None))
    score = np.sum((cross - square) ** 2, axis=0)
    return Ranking(
        fall(base, pool),
        np.array([float(left @ left) for left in base.left_out]),
        every.fitted[0] / np.sqrt(np.maximum(score, 1e-300)),
        np.split(every.gamma[0] / pool.scale, pool.first[1:]),
        np.split(every.deviation[0] / pool.scale, pool.first[1:]),
        every.visible[0],
    )


def fall(base: Base, pool: Pool) -> np.ndarray:
    """(blocks, N) fall of the squared residual in blocks that were held out: `Ranking.drop`."""
    crossed = base.crossed
    at = (crossed.place, len(crossed.beta))
    grams = [but_one(gram, *at) for gram in (base.u, pool.T, pool.w, pool.D)]
    held_out = _solve(pool, crossed.inverse, crossed.beta, grams)
    place, count = at
    if count == 1 or (len(place) == count and np.array_equal(place, np.arange(count))):
        cross, square = _by_fit(base, pool, held_out, slice(None), slice(None))
    else:
        cross, square = np.zeros((2, base.blocks, pool.count))
        for f in range(count):
            here = place == f
            cross[here], square[here] = _by_fit(base, pool, held_out, here, slice(f, f + 1))
    return 2.0 * cross - square


def total_falls(base: Base, pool: Pool) -> tuple[np.ndarray, list[np.ndarray]]:
    """`rank` in sums, where base and pool are those of whole folds: what chooses among shapes.

    (N,) fall of the squared residual in folds that were held out, and by candidate its parameters
    on all rows, SI.
    """
    value = _whole(base, pool).gamma[0] / pool.scale
    return fall(base, pool).sum(axis=0), np.split(value, pool.first[1:])


def _whole(base: Base, pool: Pool) -> "_SolvedPool":
    """Fitted to all rows."""
    G, *grams = (g.sum(axis=0)[None] for g in (base.G, base.u, pool.T, pool.w, pool.D))
    return _solve(pool, *solved(G, grams[0]), grams)


@dataclass(frozen=True, eq=False)
class _SolvedPool:
    beta: np.ndarray  # (F, r) of the base alone
    A: np.ndarray  # (F, r, K) candidates' columns in the base
    gamma: np.ndarray  # (F, K) candidates' parameters
    deviation: np.ndarray  # (F, K)
    visible: np.ndarray  # (F, N)
    fitted: np.ndarray  # (F, N)


def _solve(
    pool: Pool, inverse: np.ndarray, beta: np.ndarray, grams: Sequence[np.ndarray]
) -> _SolvedPool:
    """F fits of every candidate beside the base, from their Gram matrices (F, ...): u, T, w, D."""
    u, T, w, D = grams
    A = inverse @ T
    i, k = pool.pairs[:, 0], pool.pairs[:, 1]
    M = D - np.einsum("fri,fri->fi", T[:, :, i], A[:, :, k])
    h = w - np.einsum("frk,fr->fk", A, u)
    gamma, deviation = np.zeros(h.shape), np.zeros(h.shape)
    visible, fitted = np.zeros((len(h), pool.count)), np.zeros((len(h), pool.count))
    for size in np.unique(pool.sizes):
        own = np.flatnonzero(pool.sizes == size)
        places = pool.first[own][:, None] + np.arange(size)
        square = pool.first_pairs[own][:, None] + np.arange(size**2)
        matrix = M[:, square].reshape(len(h), -1, size, size)
        values, vectors = np.linalg.eigh(0.5 * (matrix + matrix.swapaxes(2, 3)))
        seen = values > VISIBLE**2
        inverted = np.where(seen, 1.0 / np.where(seen, values, 1.0), 0.0)
        turned = np.einsum("fnij,fni->fnj", vectors, h[:, places])
        gamma[:, places] = np.einsum("fnij,fnj->fni", vectors, inverted * turned)
        deviation[:, places] = np.sqrt(np.einsum("fnij,fnj->fni", vectors**2, inverted))
        visible[:, own] = np.sqrt(np.maximum(values[..., -1], 0.0))
        fitted[:, own] = np.sum(inverted * turned**2, axis=2)
    return _SolvedPool(beta, A, gamma, deviation, visible, fitted)


def _by_fit(
    base: Base, pool: Pool, at: _SolvedPool, here: np.ndarray | slice, fit: slice
) -> tuple[np.ndarray, np.ndarray]:
    """(blocks, N) e^T r and e^T e: r the residual of the base, e what is added.

    Args:
        base: current model.
        pool: all candidates.
        at: parameters of F fits.
        here: the blocks that are counted.
        fit: that which counts in all of them, or one for each.
    """
    beta, gamma = at.beta[fit], at.gamma[fit]
    G, T = base.G[here], pool.T[here]
    i, k = pool.pairs[:, 0], pool.pairs[:, 1]
    a = _by_owner(pool, at.A[fit] * gamma[:, None])
    products = _sums(pool.D[here] * (gamma[:, i] * gamma[:, k]), pool.first_pairs)
    left = base.u[here] - (G @ beta[:, :, None])[:, :, 0]
    known = (beta[:, None] @ T)[:, 0]
    cross = _by_owner(pool, (pool.w[here] - known) * gamma) - (left[:, None] @ a)[:, 0]
    own = np.einsum("...rk,...rk->...k", a[:, :, pool.owner], T)
    square = products + np.einsum("...rn,...rn->...n", a, G @ a)
    return cross, square - 2.0 * _by_owner(pool, own * gamma)


def _by_owner(pool: Pool, values: np.ndarray) -> np.ndarray:
    """(..., N) sums over the columns of each candidate of values (..., K)."""
    return _sums(values, pool.first)


def _sums(values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Sums of the last axis from each start to the next."""
    if not starts.size or not values.size:
        return np.zeros((*values.shape[:-1], len(starts)))
    return np.add.reduceat(values, starts, axis=-1)
