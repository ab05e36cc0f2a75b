"""Sets of columns of a matrix over a prime field that span its rows, many at once."""

from collections.abc import Iterator
from math import comb

import numpy as np

BLOCK = 4000  # sets reduced together


def components(kernel: np.ndarray) -> list[tuple[list[int], list[int]]]:
    """(rows, columns) of the parts that share no entry; a column of zeros is its own part."""
    label = list(range(len(kernel)))
    for k in range(kernel.shape[1]):
        merged = {label[r] for r in np.flatnonzero(kernel[:, k])}
        label = [min(merged) if x in merged else x for x in label]
    parts: list[tuple[list[int], list[int]]] = []
    for x in sorted(set(label)):
        rows = [r for r, y in enumerate(label) if y == x]
        parts.append((rows, [int(k) for k in np.flatnonzero(kernel[rows].any(axis=0))]))
    for k in np.flatnonzero(~kernel.any(axis=0)).tolist():
        parts.append(([], [k]))
    return parts


def spanning_sets(matrix: np.ndarray, size: int, prime: int) -> Iterator[tuple[float, np.ndarray]]:
    """(share done, sets of `size` columns that span the rows), in blocks.

    Elimination grows with the set: a column joins a set that comes before it, and the rest of the
    matrix is reduced by it; all sets of a block at once.
    """
    rows, n = matrix.shape
    start = (matrix[None], np.zeros((1, 0), dtype=np.int64), np.zeros(1, dtype=np.int64))
    stack = [start]
    done = 0.0
    total = float(comb(n, size))
    while stack:
        work, sets, rank = stack.pop()
        k = sets.shape[1]
        if k == size:
            done += len(sets)
            yield done / total, sets
            continue
        if k == size - 1 and rows:
            sets = _last(work, sets, rank, rows)
            done += len(sets)
            yield min(1.0, done / total), sets
            continue
        grown = _grown(work, sets, rank, size, prime)
        for at in range(0, len(grown[0]), BLOCK):
            part = slice(at, at + BLOCK)
            stack.append((grown[0][part], grown[1][part], grown[2][part]))


def _last(work: np.ndarray, sets: np.ndarray, rank: np.ndarray, rows: int) -> np.ndarray:
    """Sets made full by one column more, those that span."""
    n = work.shape[2]
    after = np.arange(n)[None] > (sets[:, -1:] if sets.shape[1] else -1)
    joins: np.ndarray = np.any(work, axis=1)
    fits = after & np.where((rank == rows)[:, None], True, joins & (rank == rows - 1)[:, None])
    which, column = np.nonzero(fits)
    return np.concatenate([sets[which], column[:, None]], axis=1)


def _grown(
    work: np.ndarray, sets: np.ndarray, rank: np.ndarray, size: int, prime: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Every set with every later column, if it can still span in the end."""
    rows, n = work.shape[1:]
    k = sets.shape[1]
    columns = np.arange(n)[None]
    after = (columns > (sets[:, -1:] if k else -1)) & (columns <= n - size + k)
    joins: np.ndarray = np.any(work, axis=1)
    reach = rank[:, None] + joins + (size - k - 1) >= rows
    which, column = np.nonzero(after & reach)
    joined = joins[which, column]
    grown = work[which]
    grown[joined] = reduced_by(grown[joined], column[joined], prime)
    return grown, np.concatenate([sets[which], column[:, None]], axis=1), rank[which] + joined


def reduced_by(work: np.ndarray, column: np.ndarray, prime: int) -> np.ndarray:
    """Matrices reduced by one of their columns, its pivot row set to zero."""
    if not len(work):
        return work
    at = np.arange(len(work))
    entries = work[at, :, column]
    pivot = (entries != 0).argmax(axis=1)
    row = work[at, pivot]
    # No inverse is needed: rows times the pivot have the same zeros.
    scale = entries[at, pivot]
    reduced = work * scale[:, None, None] % prime - entries[:, :, None] * row[:, None, :] % prime
    reduced %= prime
    reduced[at, pivot] = 0
    return reduced


def span(kernel: np.ndarray, sets: np.ndarray, prime: int) -> np.ndarray:
    """Which sets of columns have the rank of the matrix."""
    work = np.broadcast_to(kernel, (len(sets), *kernel.shape)).copy()
    rank = np.zeros(len(sets), dtype=np.int64)
    at = np.arange(len(sets))
    for k in range(sets.shape[1]):
        joins: np.ndarray = np.any(work[at, :, sets[:, k]], axis=1)
        work[joins] = reduced_by(work[joins], sets[joins, k], prime)
        rank += joins
    return np.asarray(rank == len(kernel))
