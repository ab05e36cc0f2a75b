"""Relations in numbers are emitted with every digit: torques and accelerations keep theirs."""

import numpy as np
import pytest

from modeler.codegen import Control, generate
from modeler.codegen.workflow import derive
from modeler.robot import parse_robot_text
from tests.codegen.fitted_library import robot_text
from tests.loops.drawn_robots import drawn
from tests.modules import loaded
from tests.rotation import with_cases

TWISTED = robot_text("twisted")
"""A base that is tilted as gravity is: what that does to the relations only numbers say."""


def text_of(name: str) -> str:
    return TWISTED if name == "twisted" else drawn(name, 1)


@with_cases(
    "name",
    pytest.param("twisted", marks=pytest.mark.digits),
    pytest.param("on_a_plane", marks=pytest.mark.slow),
)
def test_relations_in_numbers_keep_the_digits_of_a_double(name: str) -> None:
    derivation = derive(parse_robot_text(text_of(name), name))
    assert derivation.base.proof.kind == "numeric"
    c = loaded(generate(derivation, control=Control()))
    spec, rng = c.spec, np.random.default_rng(6)
    n, chi = len(spec.joints), rng.uniform(0.05, 0.1, len(spec.standard))
    chi[[p.name[:2] in ("XX", "YY", "ZZ", "Ia") for p in spec.standard]] += 2.0
    chi[[p.name.startswith("M") and p.name[1] not in "XYZ" for p in spec.standard]] += 1.0
    beta = c.base_parameters(chi)
    K = {p.name: {t.parameter: t.value for t in p.terms} for p in spec.base}
    assert any(x != round(x, 9) for terms in K.values() for x in terms.values())
    known = dict(zip((p.name for p in spec.standard), chi, strict=True))
    stated = [sum(x * known[name] for name, x in K[p.name].items()) for p in spec.base]
    np.testing.assert_allclose(beta, stated, rtol=1e-14, atol=1e-14)
    home = np.zeros(n)
    if spec.closure is not None:
        home = np.array([spec.closure.home[k] for k in spec.closure.actuated])
    q = home + rng.uniform(-0.05, 0.05, (40, n)) * (1.0 if spec.closure else 40.0)
    qd, qdd = rng.uniform(-1.0, 1.0, (2, 40, n))

    def torques(a: np.ndarray, v: np.ndarray = qd) -> np.ndarray:
        return c.regressor(q, v, a) @ chi

    tau = torques(qdd)
    apart = np.abs(c.inverse_dynamics(q, qd, qdd, beta) - tau).max()
    assert apart <= (1e-14 if spec.closure is None else 1e-12) * np.abs(tau).max()
    # Accelerations against those that the standard parameters give.
    rest, unit = torques(0.0 * qdd), np.eye(n)
    M = np.stack([torques(0.0 * qdd + unit[j]) - rest for j in range(n)], axis=2)
    right = np.linalg.solve(M, (tau - rest)[:, :, None])[:, :, 0]
    actual = c.evaluate("forward_dynamics", q=q, qd=qd, tau=tau, beta=beta)
    assert np.abs(actual - right).max() <= 1e-12 * np.abs(right).max()
    assert np.abs(actual - qdd).max() <= 1e-11 * np.abs(qdd).max()
