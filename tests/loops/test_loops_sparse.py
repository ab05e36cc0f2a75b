"""The emitted elimination with a fixed order: dense pivoting says the same, everywhere."""

import dataclasses
import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.modules import loaded, module, plain
from tests.rotation import rotating

NAME = "orthoglide-2003"


def around_home(samples, reach, seed=4):
    """(samples, 3) positions, speeds and accelerations."""
    closure = plain(NAME).spec.closure
    home = np.asarray(closure.home)[list(closure.actuated)]
    q, qd, qdd = np.random.default_rng(seed).uniform(-1.0, 1.0, (3, samples, 3))
    return home + reach * q, qd, qdd


@pytest.fixture(scope="module")
def dense():
    """The robot's C with limits 0 of 1/pivot: rows are exchanged at every posture."""
    emitted = module(NAME).emitted
    files = dict(emitted.files)
    (unit,) = (file for file in files if file.endswith("_loops.c"))

    def without(match):
        return match[1] + re.sub(r"[^,]+", "0.0", match[2]) + match[3]

    files[unit], count = re.subn(r"(limits\[\d+\] = \{)([^}]*)(\})", without, files[unit])
    assert count == 2
    return loaded(dataclasses.replace(emitted, files=files))


@pytest.mark.parametrize("reach", [1.0, *rotating(0.05, 0.3)])
def test_dense_pivoting_closes_the_same_postures(dense, reach):
    sparse = plain(NAME)
    q, qd, qdd = around_home(400, reach)
    result = sparse.closing_status(q)
    np.testing.assert_array_equal(dense.closing_status(q) == 0, result == 0)
    assert reach < 0.3 or 0 < np.count_nonzero(result) < 400
    q, qd, qdd = (x[result == 0] for x in (q, qd, qdd))
    assert_allclose(sparse.close(q), dense.close(q), rtol=0, atol=1e-11)
    G = dense.coupling(q)
    tight = 1e-11 * np.abs(G).max(axis=(1, 2), keepdims=True) ** 2
    assert (np.abs(sparse.coupling(q) - G) <= tight).all()
    phi = dense.base_regressor(q, qd, qdd)
    tight = tight * np.abs(phi).max(axis=(1, 2), keepdims=True)
    assert (np.abs(sparse.base_regressor(q, qd, qdd) - phi) <= tight).all()


def test_from_the_last_is_as_from_home_and_a_hole_does_not_matter():
    model = plain(NAME)
    t = np.linspace(0.0, 6.0, 1500)[:, None]
    q = around_home(1, 0.0)[0] + 0.12 * np.sin(t * np.array([1.0, 1.7, 2.3]))
    qd, qdd = np.cos(t + np.arange(3)), np.sin(t + np.arange(3))
    q[700:720] = q[700]  # it stands, the filter of a log may do that
    q[1000:] = q[1000:][::-1]  # a leap
    W = model.observation(q, qd, qdd).reshape(1500, 3, -1)
    assert_allclose(W, model.base_regressor(q, qd, qdd), rtol=0, atol=1e-12 * np.abs(W).max())
    away = q.copy()
    away[300] += 5.0
    out, status = np.empty((4500, W.shape[2])), np.zeros(1500, dtype=np.intc)
    model._library.fill_observation([away, qd, qdd], out, status)
    assert np.flatnonzero(status).tolist() == [300]
    out = out.reshape(1500, 3, -1)
    assert np.isnan(out[300]).all()
    out[300] = W[300]
    assert_allclose(out, W, rtol=0, atol=1e-12 * np.abs(W).max())
