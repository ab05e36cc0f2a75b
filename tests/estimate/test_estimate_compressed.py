"""Triangles of parts of the rows, merged, are those of all rows."""

from functools import reduce

import numpy as np

from modeler.numerics.least_squares import Compressed, compress, merged

NAMES = tuple(f"p{k}" for k in range(7))


def _rows(seed: int, spread: float, count: int = 400) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """W with singular values from 1 down to `spread`, y with noise, the joint of each row."""
    rng = np.random.default_rng(seed)
    left, _ = np.linalg.qr(rng.standard_normal((count, len(NAMES))))
    right, _ = np.linalg.qr(rng.standard_normal((len(NAMES), len(NAMES))))
    W = left * np.geomspace(1.0, spread, len(NAMES)) @ right.T
    y = W @ rng.standard_normal(len(NAMES)) + 1e-3 * rng.standard_normal(count)
    return W, y, np.arange(count) % 2


def _parts(W: np.ndarray, y: np.ndarray, joint: np.ndarray, cuts: list[int]) -> list[Compressed]:
    pieces = np.split(np.arange(len(y)), cuts)
    return [compress(W[own], y[own], joint[own], 2, NAMES) for own in pieces]


def test_merged_triangles_have_the_singular_values_of_all_rows():
    W, y, joint = _rows(1, 1e-10)
    # Parts of 3 and 1 rows have fewer rows than columns; one part is empty.
    parts = _parts(W, y, joint, [3, 4, 4, 150])
    found = reduce(merged, parts)
    assert found.rows.tolist() == [200, 200]
    for j in range(2):
        stacked = np.column_stack([W, y])[joint == j]
        norm = np.linalg.norm(stacked)
        own = found.triangles[j]
        assert np.allclose(own, np.triu(own))
        # The squares of 1e-10 are lost in W^T W beside 1; they are kept here.
        difference = np.linalg.svd(own, compute_uv=False) - np.linalg.svd(stacked, compute_uv=False)
        assert np.abs(difference).max() < 1e-14 * norm
        assert np.abs(own.T @ own - stacked.T @ stacked).max() < 1e-14 * norm**2
