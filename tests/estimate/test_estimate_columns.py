"""Least squares of columns in unlike units, and of rows in parts, against exact solutions."""

from functools import reduce

import numpy as np

from modeler.numerics import least_squares


def test_a_direction_that_is_not_seen_gets_nothing() -> None:
    twice = np.array([[1.0, 2.0], [2.0, 4.0], [3.0, 6.0]])
    beta = least_squares.solve_scaled_least_squares(twice, twice @ [1.0, 1.0], 1e-8)
    assert np.allclose(beta, [1.5, 0.75])  # of least length, columns of length one


def test_whitening_is_a_root_of_the_pseudo_inverse() -> None:
    units = np.array([1e-9, 1.0, 1e6, 1.0])
    W = np.random.default_rng(4).normal(size=(30, 4)) * units
    W[:, 3] = 0.0
    gram = W.T @ W
    turn = least_squares.compute_whitening(gram, 1e-11)
    assert turn.shape == (4, 3)
    assert np.allclose(turn.T @ gram @ turn, np.eye(3), atol=1e-12)
    assert np.allclose(
        gram @ turn @ turn.T @ gram / np.outer(units, units), gram / np.outer(units, units)
    )


def test_merged_triangles_have_the_singular_values_of_all_rows():
    """Parts of 3 and 1 rows have fewer rows than columns; one part is empty."""
    rng, names, count = np.random.default_rng(1), tuple(f"p{k}" for k in range(7)), 400
    left, _ = np.linalg.qr(rng.standard_normal((count, len(names))))
    right, _ = np.linalg.qr(rng.standard_normal((len(names), len(names))))
    W = left * np.geomspace(1.0, 1e-10, len(names)) @ right.T
    y = W @ rng.standard_normal(len(names)) + 1e-3 * rng.standard_normal(count)
    joint = np.arange(count) % 2
    cuts = np.split(np.arange(count), [3, 4, 4, 150])
    parts = [least_squares.compress_rows(W[item], y[item], joint[item], 2, names) for item in cuts]
    result = reduce(least_squares.merge_compressed, parts)
    assert result.rows.tolist() == [200, 200]
    for j in range(2):
        stacked = np.column_stack([W, y])[joint == j]
        norm = np.linalg.norm(stacked)
        actual = result.triangles[j]
        assert np.allclose(actual, np.triu(actual))
        # The squares of 1e-10 are lost in W^T W beside 1; they are kept here.
        gap = np.linalg.svd(actual, compute_uv=False) - np.linalg.svd(stacked, compute_uv=False)
        assert np.abs(gap).max() < 1e-14 * norm
        assert np.abs(actual.T @ actual - stacked.T @ stacked).max() < 1e-14 * norm**2
