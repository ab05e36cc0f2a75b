"""The slotted lever of docs/robots/parallel-examples.md: closed postures, torques by the oracle."""

from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.workflow import derive
from modeler.robot.read import parse_robot_text
from tests.loops.derived import compiled_plainly
from tests.oracles.complex_step import Oracle

PAGE = Path(__file__).resolve().parents[2] / "docs/robots/parallel-examples.md"


@pytest.fixture(scope="module")
def shaper():
    """The derivation from the page, and its compiled C."""
    text = PAGE.read_text(encoding="utf-8")
    text = text[text.index("# shaper.toml") :]
    derivation = derive(parse_robot_text(text[: text.index("```")], "shaper.toml"))
    return derivation, compiled_plainly(derivation)


def test_the_torques_are_those_of_the_oracle(shaper):
    derivation, c = shaper
    rng = np.random.default_rng(11)
    q, qd, qdd = (x[:, None] for x in (rng.uniform(-3.1, 3.1, 200), *rng.normal(0, 3, (2, 200))))
    oracle, result = Oracle(derivation.robot), Oracle(derivation.model.robot)
    known = result.variables(c.close(q))
    u = np.stack([known[joint.name] for joint in derivation.robot.free_joints], axis=1)
    assert np.abs(oracle.errors(u)[0]).max() < 1e-9
    assert np.all(known["5"] > -0.6 * np.sin(known["2"]))  # the ram right of the lever's end
    phi = c.regressor(q, qd, qdd)[:, 0, :]
    ours = dict(zip([column.name for column in derivation.base.columns], phi.T, strict=True))
    theirs = oracle.regressor(u, qd, qdd)
    for name in ours.keys() - {"Fv1", "Fs1"}:
        expected = theirs[name][:, 0]
        np.testing.assert_allclose(ours[name], expected, atol=1e-8 * (1 + np.abs(expected).max()))
    rank = np.linalg.matrix_rank(np.array([x[:, 0] for x in theirs.values()]), tol=1e-4)
    assert rank == derivation.base.rank - 2 == 11
