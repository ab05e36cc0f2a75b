"""Ranking: how much of the residual each candidate explains on motion it was not fitted to.

The rows are there as small matrices by block of time.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import ClassVar
from weakref import WeakSet

import numpy as np

from modeler.core.json import ShortRepr
from modeler.diagnosis.candidates import Columns, count_columns
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.numerics.least_squares import ReducedRows, compute_whitening
from modeler.numerics.spectra import estimate_lap_period
from modeler.regression import Observation

Product = Callable[[np.ndarray], Sequence[np.ndarray]]
"""W values, (rows_j, ...) by joint, new arrays, of values (c, ...)."""


@dataclass(frozen=True, eq=False)
class GramBlocks(ShortRepr):
    """The base columns as an orthonormal set over all weighted rows; c columns, r of them kept.

    Attributes:
        source: of the columns.
        y: (rows_j,) by joint, weighted.
        whitener: (c, r) of the base columns W.
        sigma: (J,) rms residual of each joint, N m or N: the weights are its inverse.
        block: (rows_j,) by joint, number of the block of time.
        fold: (blocks,) number of the fold of each block.
        G: (blocks, r, r) Gram matrices of the columns.
        u: (blocks, r) their products with y.
        prior: (r, r + 1) what is known beforehand, in every fold: its Gram matrix and products.
    """

    source: "WhitenedColumns"
    y: tuple[np.ndarray, ...]
    whitener: np.ndarray
    sigma: np.ndarray
    block: tuple[np.ndarray, ...]
    fold: np.ndarray
    G: np.ndarray
    u: np.ndarray
    prior: np.ndarray

    @property
    def whitened_columns(self) -> tuple[np.ndarray, ...]:
        """Returns W turn / sigma, (rows_j, r) by joint; those of the last base are cached."""
        return self.source.compute_columns()

    @property
    def block_count(self) -> int:
        """Returns the number of blocks of time."""
        return len(self.fold)

    @cached_property
    def row_slices(self) -> list[list[tuple[int, slice]]]:
        """Returns blocks and their rows, by joint."""
        return [find_block_runs(joint_blocks) for joint_blocks in self.block]

    @cached_property
    def fold_fits(self) -> "FoldFits":
        """Fits the base to all folds but one."""
        place = np.unique(self.fold, return_inverse=True)[1]
        count = int(place.max()) + 1
        u = leave_one_fold_out(self.u, place, count) + self.prior[:, -1]
        G = leave_one_fold_out(self.G, place, count) + self.prior[:, :-1]
        inverse, beta = solve_grams(G, u)
        return FoldFits(place, inverse, beta)

    @cached_property
    def out_of_fold(self) -> tuple[np.ndarray, ...]:
        """Computes weighted cross-validated residuals, (rows_j,) by joint."""
        fits = self.fold_fits
        betas = (fits.beta[fits.fold_index[block]] for block in self.block)
        rows = zip(self.y, self.whitened_columns, betas, strict=True)
        return tuple(y - np.einsum("ij,ij->i", columns, beta) for y, columns, beta in rows)


class WhitenedColumns:
    """The columns of a base: the product of W (rows_j, c) by joint, turn (c, r), sigma (J,).

    Many bases are there at a time: only the one that was asked last keeps its columns.
    """

    _last: ClassVar["WeakSet[WhitenedColumns]"] = WeakSet()

    def __init__(self, multiply: Product, turn: np.ndarray, sigma: np.ndarray) -> None:
        self._source, self._columns = (multiply, turn, sigma), tuple[np.ndarray, ...]()

    def compute_columns(self) -> tuple[np.ndarray, ...]:
        """Computes the columns, (rows_j, r) by joint."""
        if not self._columns:
            for other in list(self._last):
                other._columns = ()
            self._last.clear()
            self._last.add(self)
            multiply, turn, sigma = self._source
            self._columns = tuple(multiply(turn))
            for columns, s in zip(self._columns, sigma, strict=True):
                columns /= s
        return self._columns


@dataclass(frozen=True, eq=False)
class FoldFits(ShortRepr):
    """Fits of the base to all folds but one, F of them.

    Attributes:
        fold_index: (blocks,) index of the fit that a block is held out of.
        inverse: (F, r, r) of the Gram matrices.
        beta: (F, r) parameters.
    """

    fold_index: np.ndarray
    inverse: np.ndarray
    beta: np.ndarray


def leave_one_fold_out(values: np.ndarray, place: np.ndarray, count: int) -> np.ndarray:
    """Computes sums (F, ...) of values (blocks, ...) over all folds but one."""
    fold_sums = np.stack([values[place == f].sum(axis=0) for f in range(count)])
    return np.asarray(fold_sums.sum(axis=0) - fold_sums)


def solve_grams(G: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Computes inverses (F, r, r) of Gram matrices of the base, and parameters (F, r)."""
    ridge = THRESHOLDS.gram_ridge * np.eye(G.shape[1])
    inverse = np.linalg.inv(G + ridge) if G.shape[1] else np.zeros_like(G)
    return inverse, np.einsum("frs,fs->fr", inverse, u)


def build_gram_blocks(
    multiply: Product,
    y: Sequence[np.ndarray],
    sigma: np.ndarray,
    block: Sequence[np.ndarray],
    fold: np.ndarray,
    whitener: np.ndarray,
    prior: np.ndarray,
) -> GramBlocks:
    """Builds the weighted base.

    Args:
        multiply: with W (rows_j, c) by joint.
        y: (rows_j,) by joint.
        sigma: (J,) of each joint.
        block: (rows_j,) by joint.
        fold: (blocks,) of each block.
        whitener: (c, r) of the columns.
        prior: (k, c + 1) rows of what is known beforehand, of weight 1.
    """
    target = tuple(t / s for t, s in zip(y, sigma, strict=True))
    r = whitener.shape[1]
    G, u = np.zeros((len(fold), r, r)), np.zeros((len(fold), r))
    known = np.column_stack([prior[:, :-1] @ whitener, prior[:, -1]])
    known = known[:, :-1].T @ known
    source = WhitenedColumns(multiply, whitener, sigma)
    base = GramBlocks(source, target, whitener, sigma, tuple(block), fold, G, u, known)
    for w, t, slices in zip(base.whitened_columns, target, base.row_slices, strict=True):
        for b, rows in slices:
            G[b] += w[rows].T @ w[rows]
            u[b] += w[rows].T @ t[rows]
    return base


def merge_blocks(base: GramBlocks) -> GramBlocks:
    """Merges blocks to whole folds, where only sums over all blocks count."""
    place, count = base.fold_fits.fold_index, len(base.fold_fits.beta)
    block = tuple(place[joint_blocks] for joint_blocks in base.block)
    G, u = (np.stack([x[place == f].sum(axis=0) for f in range(count)]) for x in (base.G, base.u))
    return replace(base, block=block, fold=np.arange(count), G=G, u=u)


def find_block_runs(block: np.ndarray) -> list[tuple[int, slice]]:
    """Finds the runs of equal block number, in row order."""
    if not block.size:
        return []
    edges = [0, *(np.flatnonzero(np.diff(block)) + 1).tolist(), block.size]
    return [(int(block[a]), slice(a, b)) for a, b in pairwise(edges)]


@dataclass(frozen=True, eq=False)
class CandidateBatch:
    """The columns of many candidates beside the base; K columns of N candidates.

    Attributes:
        owner: (K,) candidate of each column, ascending.
        sizes: (N,) columns of each candidate.
        first: (N,) the first of them.
        scale: (K,) columns were divided by this to have length one.
        T: (blocks, r, K) base' columns.
        w: (blocks, K) columns' y.
        pairs: (P, 2) columns of one candidate, both orders.
        D: (blocks, P) products of these pairs.
    """

    owner: np.ndarray
    sizes: np.ndarray
    first: np.ndarray
    scale: np.ndarray
    T: np.ndarray
    w: np.ndarray
    pairs: np.ndarray
    D: np.ndarray

    @property
    def candidate_count(self) -> int:
        """Returns the number of candidates, N."""
        return len(self.first)

    @cached_property
    def first_pairs(self) -> np.ndarray:
        """Returns the first pair of each candidate, (N,)."""
        return np.cumsum(self.sizes**2) - self.sizes**2


def build_batch(base: GramBlocks, every: Sequence[Columns]) -> CandidateBatch:
    """Builds the Gram matrices of candidates' columns, all of them finite and none zero."""
    sizes = np.array([count_columns(columns) for columns in every], dtype=int)
    first = np.cumsum(sizes) - sizes
    owner = np.repeat(np.arange(len(sizes)), sizes)
    K, r = len(owner), base.whitener.shape[1]
    starts = zip(first, sizes, strict=True)
    blocks = [f + np.indices((size, size)).reshape(2, -1) for f, size in starts]
    pairs = np.concatenate([np.zeros((2, 0), dtype=int), *blocks], axis=1).T
    T, w = np.zeros((base.block_count, r, K)), np.zeros((base.block_count, K))
    D, square = np.zeros((base.block_count, len(pairs))), np.zeros(K)
    pool = CandidateBatch(owner, sizes, first, np.ones(K), T, w, pairs, D)
    for j in range(len(base.sigma)):
        active = [i for i, columns in enumerate(every) if columns[j] is not None]
        chunk = THRESHOLDS.candidate_chunk
        for some in (active[k : k + chunk] for k in range(0, len(active), chunk)):
            if not base.y[j].size:
                continue
            places = np.concatenate([np.arange(first[i], first[i] + sizes[i]) for i in some])
            stacked = np.concatenate([np.asarray(every[i][j]).T for i in some])
            stacked /= base.sigma[j]
            square[places] += np.einsum("ij,ij->i", stacked, stacked)
            _add_joint(base, pool, j, places, stacked)
    pool.scale[:] = np.sqrt(np.where(square > 0.0, square, 1.0))
    T /= pool.scale
    w /= pool.scale
    D /= pool.scale[pairs].prod(axis=1)
    return pool


def _add_joint(
    base: GramBlocks, pool: CandidateBatch, j: int, places: np.ndarray, columns: np.ndarray
) -> None:
    """Adds the rows of one joint, columns (k, rows_j), to the products of a pool."""
    T, w, D, owner = pool.T, pool.w, pool.D, pool.owner[places]
    products = np.zeros((len(T), T.shape[1], len(places)))
    sizes, lag = pool.sizes[owner], places - pool.first[owner]  # of a candidate's columns
    squares = pool.first_pairs[owner] + lag * (sizes + 1)
    for b, rows in base.row_slices[j]:
        part = columns[:, rows]
        products[b] += base.whitened_columns[j][rows].T @ part.T
        w[b, places] += part @ base.y[j][rows]
        D[b, squares] += np.einsum("ij,ij->i", part, part)
        for apart in range(1, sizes.max()):
            here = np.flatnonzero(lag + apart < sizes)
            cross = np.einsum("ij,ij->i", part[here], part[here + apart])
            D[b, squares[here] + apart] += cross
            D[b, squares[here] + apart * sizes[here]] += cross
    T[:, :, places] += products


def estimate_sigma(rows: ReducedRows, prior: np.ndarray | None = None) -> np.ndarray:
    """Estimates the rms residual of each joint, (J,), by iterated weighted least squares.

    Rows 0 = W_j beta of a joint without a motor, which beta = 0 would satisfy, weigh as those of a
    fit (see `estimation.least_squares`): their sigma beside the torques that cancel in them is at
    least that of the others beside the torques that are measured.

    Args:
        rows: of the analysis.
        prior: (k, c + 1) rows of what is known beforehand, of weight 1; None: nothing.
    """
    count = rows.count
    size = np.array([_compute_rms(y, n) if n else 1.0 for y, n in zip(rows.y, count, strict=True)])
    floor = 1e-6 * np.maximum(size, 1e-6 * size.max()) + 1e-300
    free = size == 0.0
    sigma = np.maximum(np.where(free, size.max(), size), floor)
    grams = [w.T @ w for w in rows.W]
    sides = [w.T @ y for w, y in zip(rows.W, rows.y, strict=True)]
    if prior is not None:
        grams.append(prior[:, :-1].T @ prior[:, :-1])
        sides.append(prior[:, :-1].T @ prior[:, -1])
    weights = np.ones(len(grams))
    for _ in range(50):
        weights[: len(sigma)] = sigma
        beta = _solve_least_squares(grams, sides, weights)
        every = zip(rows.y, rows.W, count, strict=True)
        updated = np.array([_compute_rms(y - w @ beta, n) if n else 1.0 for y, w, n in every])
        if free.any() and not free.all():
            error = float(np.sqrt(np.mean((updated[~free] / size[~free]) ** 2)))
            pairs = zip(grams, count, strict=False)
            parts = [np.diag(gram) @ beta**2 / max(n, 1) for gram, n in pairs]
            updated = np.where(free, np.maximum(updated, error * np.sqrt(parts)), updated)
        updated = np.maximum(updated, floor)
        settled = np.all(np.abs(updated / sigma - 1.0) < 1e-4)
        sigma = updated
        if settled:
            break
    return sigma


def _compute_rms(values: np.ndarray, count: int) -> float:
    return float(np.sqrt(values @ values / count)) if count else 0.0


def _solve_least_squares(
    grams: Sequence[np.ndarray], sides: Sequence[np.ndarray], sigma: np.ndarray
) -> np.ndarray:
    """Weighted least squares from the Gram matrices of the joints."""
    if not len(sides[0]):
        return np.zeros(0)
    gram = np.asarray(sum(g / s**2 for g, s in zip(grams, sigma, strict=True)))
    right = sum(u / s**2 for u, s in zip(sides, sigma, strict=True))
    turn = compute_whitening(gram, 1e-11)
    return np.asarray(turn @ (turn.T @ right))


# Blocks of time, and folds that hold out different motion.


@dataclass(frozen=True, eq=False)
class TimeBlocks(ShortRepr):
    """Blocks of time of an observation, and the folds that they are in.

    Attributes:
        number: (s,) block of each sample.
        fold: (blocks,) fold of each block.
        period: s by log; 0 where the motion does not repeat.
    """

    number: np.ndarray
    fold: np.ndarray
    period: tuple[float, ...]


def build_time_blocks(observation: Observation) -> TimeBlocks:
    """Builds blocks of half a second, and eight folds.

    Each log is cut into eight segments; where its motion repeats, one lap is, and the same phase
    of all laps is held out together: neighbouring laps would give the answer away.
    """
    time, run = observation.time, observation.run
    total = float(sum(np.ptp(time[run == log]) for log in np.unique(run)))
    length = max(THRESHOLDS.block_duration, total / THRESHOLDS.max_blocks)
    number, folds, periods = np.zeros(len(time), dtype=int), list[int](), []
    for log in range(len(observation.logs)):
        log_rows = np.flatnonzero(run == log)
        if not log_rows.size:
            periods.append(0.0)
            continue
        since = time[log_rows] - time[log_rows[0]]
        period = estimate_lap_period(since, observation.q[log_rows])
        periods.append(period)
        block = np.floor(since / length).astype(int)
        _, block = np.unique(block, return_inverse=True)
        phase = (since % period) / period if period else since / (since[-1] + 1e-9)
        middle = np.zeros(block.max() + 1)
        np.add.at(middle, block, phase)
        middle /= np.bincount(block)
        number[log_rows] = block + len(folds)
        folds += [(int(THRESHOLDS.folds * min(m, 0.999)) + log) % THRESHOLDS.folds for m in middle]
    return TimeBlocks(number, np.array(folds), tuple(periods))


# Blocked cross-validation of every candidate beside the base.


@dataclass(frozen=True, eq=False)
class Ranking:
    """The falls of N candidates, weighted: the residual of each joint has variance about 1.

    Attributes:
        reductions: (blocks, N) fall of the squared residual in blocks that were held out.
        before: (J,) squared residual there without any candidate.
        t_ratios: (N,) fall fitted on all rows over its standard error: sums over blocks of what the
            candidate explains and what it leaves, so that coloured residuals count.
        value: by candidate, its parameters on all rows, SI.
        deviation: their standard deviation for white residuals of variance 1, SI.
        visible_shares: (N,) share of the columns that the base does not hide.
    """

    reductions: np.ndarray
    before: np.ndarray
    t_ratios: np.ndarray
    value: Sequence[np.ndarray]
    deviation: Sequence[np.ndarray]
    visible_shares: np.ndarray


def rank_candidates(base: GramBlocks, pool: CandidateBatch) -> Ranking:
    """Ranks candidates by blocked cross-validation beside the base.

    Candidates are projected off the base: what the base can imitate is not theirs. For each fold,
    base and candidate are fitted on the others, and the fall of the squared residual is counted
    there, block by block.

    Args:
        base: current model.
        pool: candidates.
    """
    every = _fit_all_rows(base, pool)
    cross, square = _compute_products(base, pool, every, slice(None), slice(1))
    score = np.sum((cross - square) ** 2, axis=0)
    before = np.array([float(left @ left) for left in base.out_of_fold])
    t_ratios = every.fitted[0] / np.sqrt(np.maximum(score, 1e-300))
    sizes = every.gamma[0] / pool.scale, every.deviation[0] / pool.scale
    value, deviation = (np.split(x, pool.first[1:]) for x in sizes)
    reductions = compute_reductions(base, pool)
    return Ranking(reductions, before, t_ratios, value, deviation, every.visible[0])


def compute_reductions(base: GramBlocks, pool: CandidateBatch) -> np.ndarray:
    """Computes the fall of the squared residual in held-out blocks, (blocks, N).

    These are `Ranking.reductions`.
    """
    crossed = base.fold_fits
    at = (crossed.fold_index, len(crossed.beta))
    grams = [leave_one_fold_out(gram, *at) for gram in (base.u, pool.T, pool.w, pool.D)]
    grams[0] = grams[0] + base.prior[:, -1]
    held_out = _solve_batch(pool, crossed.inverse, crossed.beta, grams)
    cross, square = np.zeros((2, base.block_count, pool.candidate_count))
    for f in range(len(crossed.beta)):
        here = crossed.fold_index == f
        cross[here], square[here] = _compute_products(base, pool, held_out, here, slice(f, f + 1))
    return 2.0 * cross - square


def compute_total_reductions(
    base: GramBlocks, pool: CandidateBatch
) -> tuple[np.ndarray, list[np.ndarray]]:
    """Computes the total fall, and parameters, where base and pool are those of whole folds.

    What chooses among shapes.

    (N,) fall of the squared residual in folds that were held out, and by candidate its parameters
    on all rows, SI.
    """
    value = _fit_all_rows(base, pool).gamma[0] / pool.scale
    return compute_reductions(base, pool).sum(axis=0), np.split(value, pool.first[1:])


def _fit_all_rows(base: GramBlocks, pool: CandidateBatch) -> "_BatchFits":
    """Fitted to all rows."""
    G, *grams = (g.sum(axis=0)[None] for g in (base.G, base.u, pool.T, pool.w, pool.D))
    grams[0] = grams[0] + base.prior[:, -1]
    return _solve_batch(pool, *solve_grams(G + base.prior[:, :-1], grams[0]), grams)


@dataclass(frozen=True, eq=False)
class _BatchFits:
    beta: np.ndarray  # (F, r) of the base alone
    A: np.ndarray  # (F, r, K) candidates' columns in the base
    gamma: np.ndarray  # (F, K) candidates' parameters
    deviation: np.ndarray  # (F, K)
    visible: np.ndarray  # (F, N)
    fitted: np.ndarray  # (F, N)


def _solve_batch(
    pool: CandidateBatch, inverse: np.ndarray, beta: np.ndarray, grams: Sequence[np.ndarray]
) -> _BatchFits:
    """F fits of every candidate beside the base, from their Gram matrices (F, ...): u, T, w, D."""
    u, T, w, D = grams
    A = inverse @ T
    i, k = pool.pairs[:, 0], pool.pairs[:, 1]
    M = D - np.einsum("fri,fri->fi", T[:, :, i], A[:, :, k])
    h = w - np.einsum("frk,fr->fk", A, u)
    gamma, deviation = np.zeros(h.shape), np.zeros(h.shape)
    visible, fitted = np.zeros((2, len(h), pool.candidate_count))
    for size in np.unique(pool.sizes):
        same_size = np.flatnonzero(pool.sizes == size)
        places = pool.first[same_size][:, None] + np.arange(size)
        square = pool.first_pairs[same_size][:, None] + np.arange(size**2)
        matrix = M[:, square].reshape(len(h), -1, size, size)
        values, vectors = np.linalg.eigh(0.5 * (matrix + matrix.swapaxes(2, 3)))
        is_resolved = values > THRESHOLDS.min_visible_share**2
        inverted = np.where(is_resolved, 1.0 / np.where(is_resolved, values, 1.0), 0.0)
        turned = np.einsum("fnij,fni->fnj", vectors, h[:, places])
        gamma[:, places] = np.einsum("fnij,fnj->fni", vectors, inverted * turned)
        deviation[:, places] = np.sqrt(np.einsum("fnij,fnj->fni", vectors**2, inverted))
        visible[:, same_size] = np.sqrt(np.maximum(values[..., -1], 0.0))
        fitted[:, same_size] = np.sum(inverted * turned**2, axis=2)
    return _BatchFits(beta, A, gamma, deviation, visible, fitted)


def _compute_products(
    base: GramBlocks, pool: CandidateBatch, at: _BatchFits, here: np.ndarray | slice, fit: slice
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
    a = _aggregate_ranges(at.A[fit] * gamma[:, None], pool.first)
    products = _aggregate_ranges(pool.D[here] * (gamma[:, i] * gamma[:, k]), pool.first_pairs)
    left = base.u[here] - (G @ beta[:, :, None])[:, :, 0]
    known = (beta[:, None] @ T)[:, 0]
    added = _aggregate_ranges((pool.w[here] - known) * gamma, pool.first)
    cross = added - (left[:, None] @ a)[:, 0]
    column_products = np.einsum("...rk,...rk->...k", a[:, :, pool.owner], T)
    square = products + np.einsum("...rn,...rn->...n", a, G @ a)
    return cross, square - 2.0 * _aggregate_ranges(column_products * gamma, pool.first)


def _aggregate_ranges(values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Sums of the last axis from each start to the next."""
    if not starts.size or not values.size:
        return np.zeros((*values.shape[:-1], len(starts)))
    return np.add.reduceat(values, starts, axis=-1)
