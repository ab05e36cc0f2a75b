"""Weights of joints without a motor, whose rows say 0 = W beta."""

import numpy as np

from modeler.diagnosis.ranking import sigma_of
from modeler.numerics.least_squares import ReducedRows


def test_rows_without_torque_do_not_drive_the_parameters_to_zero() -> None:
    """They hold to the accuracy of the columns, and beta = 0 would satisfy them exactly."""
    rng = np.random.default_rng(0)
    beta = np.array([3.0, -2.0, 1.0])
    driven = rng.normal(size=(400, 3))
    swinging = rng.normal(size=(400, 3))
    swinging -= np.outer(swinging @ beta, beta) / (beta @ beta)
    swinging += 0.01 * rng.normal(size=(400, 3))
    torques = driven @ beta + 0.05 * rng.normal(size=400)
    rows = ReducedRows((driven, swinging), (torques, np.zeros(400)), np.array([400, 400]))
    sigma = sigma_of(rows)
    np.testing.assert_allclose(sigma[0], 0.05, rtol=0.2)
    assert 0.01 < sigma[1] < 0.2
