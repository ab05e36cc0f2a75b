"""Forward dynamics against Pinocchio's articulated bodies, and there and back again."""

import numpy as np
import pytest

from tests.control.robots import SERIAL, TREE, controlled, frictions, in_pinocchio, physical, robot_of

FEW = ("puma560", "tree-1")


def few_first(names):
    return [n if n in FEW else pytest.param(n, marks=pytest.mark.slow) for n in names]


def drawn(name, samples=20, seed=3):
    model, random = controlled(name), np.random.default_rng(seed)
    chi = physical(model.spec, random)
    q, qd, tau = random.normal(size=(3, samples, len(model.spec.joints)))
    return model, chi, model.base_parameters([*chi.values()]), q, qd, 5 * tau


@pytest.mark.parametrize("name", few_first([*SERIAL, *TREE]))
def test_forward_dynamics(name):
    pin = pytest.importorskip("pinocchio")
    model, chi, beta, q, qd, tau = drawn(name)
    qdd = model.evaluate("forward_dynamics", q=q, qd=qd, tau=tau, beta=beta)
    back = model.inverse_dynamics(q, qd, qdd, beta)
    assert np.abs(back - tau).max() <= 1e-10 * np.abs(tau).max()
    other, rows = in_pinocchio(robot_of(name), chi)
    data, effort = other.createData(), tau - frictions(model.spec, chi, qd)
    for k in range(len(q)):
        x, v, f = np.zeros((3, other.nv))
        x[rows], v[rows], f[rows] = q[k], qd[k], effort[k]
        theirs = pin.aba(other, data, x, v, f)[rows]
        assert np.abs(qdd[k] - theirs).max() <= 1e-9 * np.abs(theirs).max()
