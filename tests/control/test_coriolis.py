"""The Coriolis matrix: its product is the Coriolis torque, and dM/dt - 2 C is skew."""

import numpy as np
import pytest

from modeler.codegen import derive, generate, load
from modeler.codegen.control import Control
from modeler.runtime import load as compiled


@pytest.mark.parametrize("name", ["puma560", "sr400-tree"])
def test_coriolis_matrix(name):
    emitted = generate(derive(load(name)), control=Control())
    model = compiled(emitted.spec, emitted.files)
    random = np.random.default_rng(7)
    n, beta = len(emitted.spec.joints), random.normal(size=len(emitted.spec.base))
    q, qd = random.normal(size=(2, 20, n))
    C = model.evaluate("coriolis_matrix", q=q, qd=qd, beta=beta)
    c = model.coriolis(q, qd, beta)
    assert np.abs(np.einsum("kij,kj->ki", C, qd) - c).max() <= 1e-12 * np.abs(c).max()
    h = 1e-5
    Md = (model.inertia_matrix(q + h * qd, beta) - model.inertia_matrix(q - h * qd, beta)) / (2 * h)
    skew = Md - 2 * C
    assert np.abs(skew + skew.transpose(0, 2, 1)).max() <= 1e-7 * np.abs(Md).max()
