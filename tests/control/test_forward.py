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


def differences(model, *state, h=1e-6):
    """Those of Pinocchio's forward dynamics, whose derivatives want another order of rows."""
    pin = pytest.importorskip("pinocchio")
    data, found = model.createData(), np.zeros((3, model.nv, model.nv))
    for part in range(3):
        for j in range(model.nv):
            step = np.zeros((3, model.nv))
            step[part, j] = h
            ahead, behind = (pin.aba(model, data, *(state + s * step)) + 0.0 for s in (1, -1))
            found[part][:, j] = (ahead - behind) / (2 * h)
    return found


@pytest.mark.parametrize("name", few_first([*SERIAL, *TREE]))
def test_forward_derivatives(name):
    pin = pytest.importorskip("pinocchio")
    model, chi, beta, q, qd, tau = drawn(name, samples=6, seed=11)
    D = model.evaluate("forward_derivatives", q=q, qd=qd, tau=tau, beta=beta)
    other, rows = in_pinocchio(robot_of(name), chi)
    data, effort = other.createData(), tau - frictions(model.spec, chi, qd)
    viscous = np.diag([chi.get(f"Fv{joint.name}", 0.0) for joint in model.spec.joints])
    pick = np.ix_(rows, rows)
    for k in range(len(q)):
        x, v, f = np.zeros((3, other.nv))
        x[rows], v[rows], f[rows] = q[k], qd[k], effort[k]
        found = pin.computeABADerivatives(other, data, x, v, f)
        exact = name not in ("tree-1", "tree-3")
        by_q, by_qd, by_tau = (each[pick] for each in (found if exact else differences(other, x, v, f)))
        theirs = np.array([by_q, by_qd - by_tau @ viscous, by_tau])
        for ours, its in zip(D[k], theirs, strict=True):
            assert np.abs(ours - its).max() <= (1e-9 if exact else 1e-6) * np.abs(its).max()


@pytest.mark.parametrize("name", few_first([*SERIAL, *TREE]))
@pytest.mark.parametrize("damping", [0.0, 0.1])
def test_operational_space(name, damping):
    """L and Jbar by dense algebra on Pinocchio's matrices."""
    pin = pytest.importorskip("pinocchio")
    model, chi, beta, q, _, _ = drawn(name, samples=6, seed=12)
    other, rows = in_pinocchio(robot_of(name), chi)
    data, n = other.createData(), len(model.spec.joints)
    roles = ("operational_inertia", "operational_inverse")
    given = {"q": q, "beta": beta, "damping": [damping]}
    statuses = [model.statuses(role, **given) for role in roles]
    results = [model._called(role, given)[0] for role in roles]
    for k in range(len(q)):
        x = np.zeros(other.nv)
        x[rows] = q[k]
        M = pin.crba(other, data, x)
        M = (np.triu(M) + np.triu(M, 1).T)[np.ix_(rows, rows)]
        pin.computeJointJacobians(other, data, x)
        index = other.njoints - 1
        J = pin.getJointJacobian(other, data, index, pin.LOCAL_WORLD_ALIGNED)[:, rows]
        S = J @ np.linalg.solve(M, J.T) + damping**2 * np.eye(6)
        full = damping > 0 or np.linalg.matrix_rank(J) == 6
        assert [status[k] for status in statuses] == ([0, 0] if full else [2, 2])
        if not full:
            assert all(np.isnan(result[k]).all() for result in results)
            continue
        L = np.linalg.inv(S)
        slack = 1e-9 + 1e-14 * np.linalg.cond(S)
        assert np.abs(results[0][k] - L).max() <= slack * np.abs(L).max()
        Jbar = np.linalg.solve(M, J.T) @ L
        assert np.abs(results[1][k] - Jbar).max() <= slack * np.abs(Jbar).max()
        if damping == 0.0:
            assert np.abs(J @ results[1][k] - np.eye(6)).max() <= 1e-8
    assert n
