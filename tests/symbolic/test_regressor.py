"""The symbolic model against other derivations and the laws of mechanics."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from modeler.derivation.lagrange import compute_lagrange_torque
from modeler.derivation.model import LinkColumn
from modeler.derivation.numeric_rank import draw_random_states, evaluate_regressor
from tests.modules import module
from tests.robots import ROBOTS, TREES

TEXTBOOK = ("wrist", "sr400-tree", "scara")


def inertial(model) -> list[int]:
    return [i for i, column in enumerate(model.columns) if isinstance(column, LinkColumn)]


@pytest.mark.parametrize("name", ROBOTS)
def test_newton_euler_agrees_with_lagrange(name):
    model = module(name).model
    states = draw_random_states(model, 12, np.random.default_rng(1))
    chi = np.zeros(len(model.columns))
    chi[inertial(model)] = np.random.default_rng(2).normal(size=len(inertial(model)))
    tau = evaluate_regressor(model, states) @ chi
    other = compute_lagrange_torque(model, *states, chi)
    assert_allclose(tau, other, rtol=0, atol=1e-12 * np.abs(other).max())


@pytest.mark.parametrize("name", TREES)
def test_regressor_agrees_with_pinocchio(name):
    from tests.oracles.pinocchio_dynamics import pinocchio_regressor

    model = module(name).model
    states = draw_random_states(model, 15, np.random.default_rng(3))
    ours = evaluate_regressor(model, states)[:, :, inertial(model)]
    theirs = pinocchio_regressor(model.robot, *states)
    assert_allclose(ours, theirs, rtol=0, atol=1e-10 * np.abs(theirs).max())


@pytest.mark.parametrize("name", TEXTBOOK)
def test_rank_agrees_with_pinocchio(name):
    from tests.oracles.pinocchio_dynamics import pinocchio_regressor

    model = module(name).model
    states = draw_random_states(model, 60, np.random.default_rng(4))
    W = pinocchio_regressor(model.robot, *states).reshape(-1, len(inertial(model)))
    singular = np.linalg.svd(W, compute_uv=False)
    assert np.sum(singular > 1e-9 * singular[0]) == module(name).base.rank


@pytest.mark.parametrize("name", TREES)
def test_recursion_agrees_with_the_regressor(name):
    """tau by the backward recursion = phi chi, and tau = M qdd + c + g + f with M symmetric."""
    model = module(name).model
    q, qd, qdd = draw_random_states(model, 12, np.random.default_rng(5))
    chi = np.random.default_rng(6).normal(size=len(model.columns))
    symbols = {i: model.graph.symbol(f"chi[{i}]") for i in range(len(chi))}
    values = dict(model.geometry.values) | {f"chi[{i}]": x for i, x in enumerate(chi)}
    for kind, array in (("q", q), ("qd", qd), ("qdd", qdd)):
        values |= {f"{kind}[{i}]": array[:, i] for i in range(array.shape[1])}

    def evaluated(expressions) -> np.ndarray:
        actual = model.graph.evaluate_outputs(expressions, values)
        return np.stack([x + np.zeros(len(q)) for x in actual], axis=-1)

    tau = evaluate_regressor(model, (q, qd, qdd)) @ chi
    scale = np.abs(tau).max()
    assert_allclose(evaluated(model.derive_torque(symbols)), tau, rtol=0, atol=1e-12 * scale)
    n = q.shape[1]
    M = evaluated([x for row in model.derive_inertia_matrix(symbols) for x in row]).reshape(
        -1, n, n
    )
    np.testing.assert_array_equal(M, M.transpose(0, 2, 1))
    effects = {i: s for i, s in symbols.items() if model.columns[i].kind != "rotor_inertia"}
    parts = (
        np.einsum("sij,sj->si", M, qdd)
        + evaluated(model.derive_torque(symbols, accelerations=False, gravity=False, effects=False))
        + evaluated(model.derive_torque(symbols, speeds=False, accelerations=False, effects=False))
        + evaluated(model.derive_torque(effects, links=False))
    )
    assert_allclose(parts, tau, rtol=0, atol=1e-12 * scale)
