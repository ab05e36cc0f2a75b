"""Ranking: how much of the residual each candidate explains on motion it was not fitted to."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.diagnose.gram import RIDGE, VISIBLE, Base, Pool

FOLDS = 8


@dataclass(frozen=True, eq=False)
class Ranking:
    """Of N candidates; weighted units: the residual of each joint has variance about 1.

    Attributes:
        drop: (blocks, N) fall of the squared residual in blocks that were held out.
        before: (J,) squared residual there without any candidate.
        sure: (N,) fall fitted on all rows over its standard error: sums over blocks of what the
            candidate explains and what it leaves, so that coloured residuals count.
        value: (K,) parameters on all rows, SI.
        deviation: (K,) their standard deviation for white residuals of variance 1, SI.
        visible: (N,) share of the columns that the base does not hide.
    """

    drop: np.ndarray
    before: np.ndarray
    sure: np.ndarray
    value: np.ndarray
    deviation: np.ndarray
    visible: np.ndarray


def rank(base: Base, pool: Pool, fold: np.ndarray) -> Ranking:
    """Blocked cross-validation of every candidate beside the base.

    Candidates are projected off the base: what the base can imitate is not theirs. For each fold,
    base and candidate are fitted on the others, and the fall of the squared residual is counted
    there, block by block.

    Args:
        base: current model.
        pool: candidates.
        fold: (blocks,) number of the fold of each block.
    """
    drop = np.zeros((base.blocks, pool.count))
    before = np.zeros(len(base.y))
    every = _solve(pool, *(gram.sum(axis=0) for gram in _grams(base, pool)))
    score = np.zeros(pool.count)
    for f, held, own, solved in _folds(base, pool, fold):
        before += _residual_energy(base, solved.beta, fold == f)
        cross, square = _in_blocks(pool, own, solved)
        drop[held] = 2.0 * cross - square
        cross, square = _in_blocks(pool, own, every)
        score += np.sum((cross - square) ** 2, axis=0)
    sure = every.fitted / np.sqrt(np.maximum(score, 1e-300))
    return Ranking(
        drop,
        before,
        sure,
        every.gamma / pool.scale,
        every.deviation / pool.scale,
        every.visible,
    )


def fall(base: Base, pool: Pool, fold: np.ndarray) -> np.ndarray:
    """(blocks, N) fall of the squared residual in blocks that were held out: `Ranking.drop`."""
    drop = np.zeros((base.blocks, pool.count))
    for _, held, own, solved in _folds(base, pool, fold):
        cross, square = _in_blocks(pool, own, solved)
        drop[held] = 2.0 * cross - square
    return drop


def _grams(base: Base, pool: Pool) -> tuple[np.ndarray, ...]:
    return base.G, base.u, pool.T, pool.w, pool.D


def _folds(
    base: Base, pool: Pool, fold: np.ndarray
) -> Iterator[tuple[int, np.ndarray, list[np.ndarray], "_Solved"]]:
    """Of every fold: its number, its blocks, their Gram matrices, and what all others say."""
    grams = _grams(base, pool)
    total = [gram.sum(axis=0) for gram in grams]
    for f in np.unique(fold):
        held = np.flatnonzero(fold == f)
        own = [gram[held] for gram in grams]
        others = [a - b.sum(axis=0) for a, b in zip(total, own, strict=True)]
        yield int(f), held, own, _solve(pool, *others)


@dataclass(frozen=True, eq=False)
class _Solved:
    beta: np.ndarray  # (r,) of the base alone
    A: np.ndarray  # (r, K) candidates' columns in the base
    gamma: np.ndarray  # (K,) candidates' parameters
    deviation: np.ndarray  # (K,)
    visible: np.ndarray  # (N,)
    fitted: np.ndarray  # (N,)


def _solve(
    pool: Pool, G: np.ndarray, u: np.ndarray, T: np.ndarray, w: np.ndarray, D: np.ndarray
) -> _Solved:
    inverse = np.linalg.inv(G + RIDGE * np.eye(len(G))) if len(G) else np.zeros((0, 0))
    beta, A = inverse @ u, inverse @ T
    i, k = pool.pairs[:, 0], pool.pairs[:, 1]
    M = D - np.einsum("ri,ri->i", T[:, i], A[:, k])
    h = w - A.T @ u
    gamma, deviation = np.zeros(len(h)), np.zeros(len(h))
    visible, fitted = np.zeros(pool.count), np.zeros(pool.count)
    sizes = np.bincount(pool.owner, minlength=pool.count)
    start = np.concatenate([[0], np.cumsum(sizes**2)])
    for size in np.unique(sizes):
        own = np.flatnonzero(sizes == size)
        places = pool.first[own][:, None] + np.arange(size)
        square = start[own][:, None] + np.arange(size**2)
        matrix = M[square].reshape(-1, size, size)
        values, vectors = np.linalg.eigh(0.5 * (matrix + matrix.transpose(0, 2, 1)))
        seen = values > VISIBLE**2
        inverted = np.where(seen, 1.0 / np.where(seen, values, 1.0), 0.0)
        turned = np.einsum("nij,ni->nj", vectors, h[places])
        gamma[places] = np.einsum("nij,nj->ni", vectors, inverted * turned)
        deviation[places] = np.sqrt(np.einsum("nij,nj->ni", vectors**2, inverted))
        visible[own] = np.sqrt(np.maximum(values[:, -1], 0.0))
        fitted[own] = np.sum(inverted * turned**2, axis=1)
    return _Solved(beta, A, gamma, deviation, visible, fitted)


def _residual_energy(base: Base, beta: np.ndarray, held: np.ndarray) -> np.ndarray:
    """(J,) squared residual of the base alone in the blocks that are held out (blocks,)."""
    found = np.zeros(len(base.y))
    for j, (columns, y, block) in enumerate(zip(base.columns, base.y, base.block, strict=True)):
        rows = held[block]
        found[j] = np.sum((y[rows] - columns[rows] @ beta) ** 2)
    return found


def _in_blocks(
    pool: Pool, grams: Sequence[np.ndarray], at: _Solved
) -> tuple[np.ndarray, np.ndarray]:
    """(b, N) e^T r and e^T e in some blocks: r the residual of the base, e what is added.

    Args:
        pool: all candidates.
        grams: G, u, T, w, D of these blocks.
        at: parameters.
    """
    G, u, T, w, D = grams
    a = _by_owner(pool, at.A * at.gamma)
    i, k = pool.pairs[:, 0], pool.pairs[:, 1]
    products = _sums(D * (at.gamma[i] * at.gamma[k]), _pair_starts(pool))
    left = u - G @ at.beta
    cross = _by_owner(pool, (w - at.beta @ T) * at.gamma) - left @ a
    own = _by_owner(pool, np.einsum("rk,brk->bk", a[:, pool.owner], T) * at.gamma)
    inner = np.einsum("rn,brn->bn", a, G @ a) - 2.0 * own
    return cross, products + inner


def _by_owner(pool: Pool, values: np.ndarray) -> np.ndarray:
    """(..., N) sums over the columns of each candidate of values (..., K)."""
    return _sums(values, pool.first)


def _sums(values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Sums of the last axis from each start to the next."""
    if not starts.size or not values.size:
        return np.zeros((*values.shape[:-1], len(starts)))
    return np.add.reduceat(values, starts, axis=-1)


def _pair_starts(pool: Pool) -> np.ndarray:
    sizes = np.bincount(pool.owner, minlength=pool.count)
    return np.concatenate([[0], np.cumsum(sizes**2)[:-1]]).astype(int)
