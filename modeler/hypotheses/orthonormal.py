"""Weighted columns made orthonormal over the rows of all joints at once."""

from collections.abc import Sequence

import numpy as np

_SAME = 1e-11
"""Eigenvalue of their Gram matrix, over the largest, below which columns are dependent."""


def orthonormal(
    W: Sequence[np.ndarray], sigma: np.ndarray
) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """(rows_j, r) orthonormal columns by joint, and the turn (c, r): they are W turn / sigma.

    Args:
        W: (rows_j, c) by joint.
        sigma: (J,) of each joint; the weights are its inverse.
    """
    turn = turn_of(W, sigma)
    return tuple(w @ (turn / s) for w, s in zip(W, sigma, strict=True)), turn


def turn_of(W: Sequence[np.ndarray], sigma: np.ndarray) -> np.ndarray:
    """(c, r) that makes weighted columns orthonormal: see `orthonormal`."""
    gram = sum((w.T @ w) / s**2 for w, s in zip(W, sigma, strict=True))
    length = np.sqrt(np.diag(gram))
    safe = np.where(length > 0.0, length, 1.0)
    values, vectors = np.linalg.eigh(gram / np.outer(safe, safe))
    kept = values > _SAME * float(values.max(initial=1e-300))
    return np.asarray(vectors[:, kept] / np.sqrt(values[kept]) / safe[:, None])
