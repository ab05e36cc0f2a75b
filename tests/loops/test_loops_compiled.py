"""The emitted C of robots with loops: against the graph, and where loops do not close."""

import numpy as np
import pytest

from modeler.core.errors import LoopError, ShapeError
from tests.loops.closed_states import closed
from tests.modules import module, plain
from tests.robots import CLOSED, TIED, one_always

ALWAYS = ("five-bar", "wrist-coupled", "orthoglide-2003")
PLATFORMS = [name for name in CLOSED if name not in ("five-bar",)]


def close(a, b, tolerance=1e-11):
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance * np.abs(b).max())


@pytest.mark.parametrize("name", one_always(TIED, *ALWAYS))
def test_regressors_and_observation_are_those_of_the_graph(name):
    c, base = plain(name), module(name).base
    (q, qd, qdd), _, phi = closed(name, 25)
    rest = [parameter.column for parameter in base.parameters]
    close(c.regressor(q, qd, qdd), phi)
    close(c.base_regressor(q, qd, qdd), phi[:, :, rest])
    close(c.observation(q, qd, qdd), phi[:, :, rest].reshape(-1, base.rank))


@pytest.mark.parametrize("name", one_always(CLOSED, *ALWAYS))
def test_loops_close_where_they_should(name):
    c = plain(name)
    (q, qd, _), (u, ud, _), _ = closed(name, 25)
    np.testing.assert_allclose(c.close(q), u, atol=1e-9)
    np.testing.assert_allclose(np.einsum("nij,nj->ni", c.coupling(q), qd), ud, atol=1e-8)
    assert not np.any(c.closing_status(q))
    assert (name in PLATFORMS) == bool(module(name).model.closure.platform)


@pytest.mark.parametrize("name", one_always(PLATFORMS, "orthoglide-2003"))
def test_platform_coordinates_give_the_same_torques(name):
    """tau = G_x^T f, where dx = G_x dq."""
    c, closure = plain(name), module(name).model.closure
    (q, qd, qdd), (u, ud, udd), _ = closed(name, 10)
    places = list(closure.platform)
    x, xd, xdd = (array[:, places] for array in (u, ud, udd))
    Gx = c.coupling(q)[:, places]
    phi = c.platform_base_regressor(x, xd, xdd)
    close(np.einsum("nij,nic->njc", Gx, phi), c.base_regressor(q, qd, qdd), 1e-9)
    np.testing.assert_allclose(c.platform_close(x), u, atol=1e-9)
    beta = np.random.default_rng(0).normal(size=phi.shape[2])
    close(c.platform_inverse_dynamics(x, xd, xdd, beta), phi @ beta)


def test_what_is_out_of_reach_is_told_by_sample():
    c = plain("orthoglide-2003")
    q = np.array([[0.19, 0.19, 0.19], [0.19, 0.19, 1.4], [0.2, 0.2, 0.2]])
    assert list(c.closing_status(q)) == [0, 1, 0]
    with pytest.raises(LoopError, match=r"orthoglide-2003: sample 2: the loops cannot be closed; "):
        c.base_regressor(q, q, q)
    with pytest.raises(LoopError, match=r"sample 2.*got \(0.19, 0.19, 1.4\)"):
        c.observation(q, q, q)


def test_friction_of_passive_joints_needs_positions():
    c = plain("orthoglide-2003")
    with pytest.raises(ShapeError, match="depends on the positions; give q"):
        c.friction(np.zeros((1, 3)), np.zeros(43))
