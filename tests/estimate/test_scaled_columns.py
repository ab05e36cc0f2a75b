"""Least squares of columns in unlike units, against exact solutions."""

import numpy as np
import pytest

from modeler.numerics.least_squares import scaled_least_squares, whitening

UNITS = np.array([1e-9, 1.0, 1e6, 1.0])


@pytest.fixture
def W() -> np.ndarray:
    """Four columns in unlike units; the last one is zero."""
    columns = np.random.default_rng(4).normal(size=(30, 4)) * UNITS
    columns[:, 3] = 0.0
    return columns


def test_a_direction_that_is_not_seen_gets_nothing() -> None:
    twice = np.array([[1.0, 2.0], [2.0, 4.0], [3.0, 6.0]])
    beta = scaled_least_squares(twice, twice @ [1.0, 1.0], 1e-8)
    assert np.allclose(beta, [1.5, 0.75])  # of least length, columns of length one


def test_whitening_is_a_root_of_the_pseudo_inverse(W: np.ndarray) -> None:
    gram = W.T @ W
    turn = whitening(gram, 1e-11)
    assert turn.shape == (4, 3)
    assert np.allclose(turn.T @ gram @ turn, np.eye(3), atol=1e-12)
    assert np.allclose(gram @ turn @ turn.T @ gram / np.outer(UNITS, UNITS),
                       gram / np.outer(UNITS, UNITS))  # fmt: skip
