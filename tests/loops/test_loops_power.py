"""Laws of mechanics on closed robots."""

import numpy as np
import pytest

from tests.loops.closed_states import closed
from tests.modules import plain
from tests.robots import TIED


@pytest.mark.parametrize("name", TIED)
def test_power_balance(name):
    """(M qdd + c) . qd = dT/dt with T = qd' M qd / 2, along q(t) = q0 + qd t + qdd t**2 / 2."""
    c = plain(name)
    (q, qd, qdd), _, phi = closed(name, 8)
    qd, qdd = 0.3 * qd, 0.3 * qdd
    beta = c.base_parameters(np.random.default_rng(7).normal(size=phi.shape[2]))

    def kinetic(t):
        speed = qd + qdd * t
        M = c.inertia_matrix(q + qd * t + qdd * t * t / 2, beta)
        return np.einsum("ni,nij,nj->n", speed, M, speed) / 2

    h = 1e-4
    rate = (8 * (kinetic(h) - kinetic(-h)) - (kinetic(2 * h) - kinetic(-2 * h))) / (12 * h)
    torque = np.einsum("nij,nj->ni", c.inertia_matrix(q, beta), qdd) + c.coriolis(q, qd, beta)
    power = np.einsum("ni,ni->n", torque, qd)
    np.testing.assert_allclose(power, rate, rtol=0, atol=1e-7 * np.abs(rate).max())


@pytest.mark.parametrize("name", TIED)
def test_gravity_is_the_slope_of_a_potential(name):
    """The work of g(q) around a small closed way is 0: its Jacobian is symmetric."""
    c = plain(name)
    (q, _, _), _, phi = closed(name, 4)
    beta = c.base_parameters(np.random.default_rng(8).normal(size=phi.shape[2]))
    h, n = 1e-5, q.shape[1]
    slopes = [
        (c.gravity(q + h * unit, beta) - c.gravity(q - h * unit, beta)) / (2 * h)
        for unit in np.eye(n)
    ]
    K = np.stack(slopes, axis=2)
    np.testing.assert_allclose(K, np.swapaxes(K, 1, 2), atol=1e-6 * max(1.0, np.abs(K).max()))
