"""The emitted elimination with a fixed order: dense pivoting says the same, everywhere."""

import dataclasses
import re

import numpy as np
import pytest

from modeler.codegen.closed import solving_of
from tests.modules import loaded, module, plain
from tests.rotation import rotating

NAME = "orthoglide-2003"


def with_limits(share):
    """The robot's C with other limits of 1/pivot; 0: rows are exchanged at every posture."""
    emitted = module(NAME).emitted
    files = dict(emitted.files)
    (unit,) = (file for file in files if file.endswith("_loops.c"))

    def scaled(match):
        numbers = [repr(share * float(x)) for x in match[2].split(",")]
        return match[1] + ", ".join(numbers) + match[3]

    pattern = r"(limits\[\d+\] = \{)([^}]*)(\})"
    files[unit], count = re.subn(pattern, scaled, files[unit])
    assert count == 2
    return loaded(dataclasses.replace(emitted, files=files))


def around_home(samples, reach, seed=4):
    """(samples, 3) positions, speeds and accelerations."""
    closure = plain(NAME).spec.closure
    home = np.asarray(closure.home)[list(closure.given)]
    q, qd, qdd = np.random.default_rng(seed).uniform(-1.0, 1.0, (3, samples, 3))
    return home + reach * q, qd, qdd


def smooth_motion():
    """(1500, 3) positions, speeds and accelerations, which need not belong together."""
    t = np.linspace(0.0, 6.0, 1500)[:, None]
    q = around_home(1, 0.0)[0] + 0.12 * np.sin(t * np.array([1.0, 1.7, 2.3]))
    return q, np.cos(t + np.arange(3)), np.sin(t + np.arange(3))


@pytest.fixture(scope="module")
def dense():
    return with_limits(0.0)


@pytest.mark.rotating("long tests of loops")
@pytest.mark.parametrize("reach", [1.0, *rotating(0.05, 0.3)])
def test_dense_pivoting_closes_the_same_postures(dense, reach):
    sparse = plain(NAME)
    q, qd, qdd = around_home(400, reach)
    found = sparse.closing_status(q)
    np.testing.assert_array_equal(dense.closing_status(q) == 0, found == 0)
    assert reach < 0.3 or 0 < np.count_nonzero(found) < 400
    q, qd, qdd = (x[found == 0] for x in (q, qd, qdd))
    np.testing.assert_allclose(sparse.close(q), dense.close(q), rtol=0, atol=1e-11)
    G = dense.coupling(q)
    tight = 1e-11 * np.abs(G).max(axis=(1, 2), keepdims=True) ** 2
    assert (np.abs(sparse.coupling(q) - G) <= tight).all()
    phi = dense.base_regressor(q, qd, qdd)
    tight = tight * np.abs(phi).max(axis=(1, 2), keepdims=True)
    assert (np.abs(sparse.base_regressor(q, qd, qdd) - phi) <= tight).all()


def largest_shares(q):
    """(n,) of the pivots at q: the largest of |1/pivot| in its limit."""
    model = module(NAME).model
    solving = solving_of(model, module(NAME).base)
    own, u = solving.eliminations[""], plain(NAME).close(q)
    J = model.closure.jacobians(u)
    values = {f"J[{k}]": J[:, i, j] for k, (i, j) in enumerate(solving.pattern.places)}
    found = model.graph.evaluate(list(own.factors), model.geometry.values | values)
    return np.max(
        [np.abs(x) / limit + 0.0 * q[:, 0] for x, limit in zip(found, own.limits, strict=False)],
        axis=0,
    )


def test_either_may_follow_the_other_along_a_motion(dense):
    """With limits that half of the postures exceed, rows are exchanged now and then."""
    q, qd, qdd = smooth_motion()
    shares = largest_shares(q)
    middle = float(np.median(shares))
    assert np.count_nonzero(np.diff(shares > middle)) > 4
    exact = dense.observation(q, qd, qdd)
    for model in (plain(NAME), with_limits(middle)):
        W = model.observation(q, qd, qdd)
        np.testing.assert_allclose(W, exact, rtol=0, atol=1e-12 * np.abs(exact).max())


def test_from_the_last_is_as_from_home_and_a_hole_does_not_matter():
    model = plain(NAME)
    q, qd, qdd = smooth_motion()
    q[700:720] = q[700]  # it stands, the filter of a log may do that
    q[1000:] = q[1000:][::-1]  # a leap
    W = model.observation(q, qd, qdd).reshape(1500, 3, -1)
    np.testing.assert_allclose(
        W, model.base_regressor(q, qd, qdd), rtol=0, atol=1e-12 * np.abs(W).max()
    )
    away = q.copy()
    away[300] += 5.0
    out, status = np.empty((4500, W.shape[2])), np.zeros(1500, dtype=np.intc)
    model._library.observation([away, qd, qdd], out, status)
    assert np.flatnonzero(status).tolist() == [300]
    out = out.reshape(1500, 3, -1)
    assert np.isnan(out[300]).all()
    out[300] = W[300]
    np.testing.assert_allclose(out, W, rtol=0, atol=1e-12 * np.abs(W).max())
