"""How sure a predicted torque is, as far as the parameters of the model are."""

import numpy as np

DEVIATIONS = 2.0
"""Half width of a band in standard deviations: 95 % of normal errors."""


def sigma_of(columns: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """(s, n) standard deviation of the predicted torque, N m or N.

    For a row phi of the filtered regressor, tau = phi beta, so var(tau) = phi C phi^T with the
    covariance C of beta (propagation of errors; Gautier and Khalil 1991 give C). It says nothing
    of effects that the model lacks, nor of the noise of the measurement.

    Args:
        columns: (s, n, c) filtered regressor.
        covariance: (c, c) of beta.
    """
    deviation = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    scale = np.where(deviation > 0.0, deviation, 1.0)  # parameters have units of their own
    correlation = covariance / np.outer(scale, scale)
    values, vectors = np.linalg.eigh(0.5 * (correlation + correlation.T))
    root = scale[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))  # C = root root^T
    return np.asarray(np.sqrt(np.sum((columns @ root) ** 2, axis=2)))
