"""The slotted lever of docs/robots/parallel-examples.md: postures on paper, torques by the oracle.

By hand: where the lever points and the ram stands, which are all bodies of the machine.
"""

from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.workflow import derive
from modeler.robot.read import robot_from_text
from tests.loops.derived import compiled_plainly
from tests.oracles.complex_step import Oracle

PAGE = Path(__file__).resolve().parents[2] / "docs/robots/parallel-examples.md"
H, R, L, C, HR = 0.30, 0.10, 0.60, 0.20, 0.65


@pytest.fixture(scope="module")
def shaper():
    """The derivation from the page, and its compiled C."""
    text = PAGE.read_text(encoding="utf-8")
    text = text[text.index("# shaper.toml") :]
    derivation = derive(robot_from_text(text[: text.index("```")], "shaper.toml"))
    return derivation, compiled_plainly(derivation)


def on_paper(q):
    """Lever angle from x0, pin's way along it, coupler angle, ram; for the ram on the right."""
    pin = np.array([-R * np.sin(q), H + R * np.cos(q)])
    lever = np.pi / 2 - np.arctan(pin[0] / pin[1])
    end = L * np.array([np.cos(lever), np.sin(lever)])
    coupler = np.arcsin((HR - end[1]) / C)
    return lever, np.sqrt(pin @ pin), coupler, end[0] + C * np.cos(coupler)


def states():
    rng = np.random.default_rng(11)
    return rng.uniform(-3.1, 3.1, 200), rng.normal(0, 2, 200), rng.normal(0, 5, 200)


def test_the_loops_close_as_on_paper(shaper):
    derivation, c = shaper
    q = states()[0]
    u = c.close(q[:, None])
    places = {joint.name: k for k, joint in enumerate(derivation.model.robot.free)}
    for k, angle in enumerate(q):
        lever, way, coupler, ram = on_paper(angle)
        expected = {"2": lever - np.pi / 2, "3": way, "4": coupler - lever, "5": ram}
        for name, value in expected.items():
            assert u[k, places[name]] == pytest.approx(value, abs=1e-9), name


def test_the_torques_are_those_of_the_oracle(shaper):
    derivation, c = shaper
    q, qd, qdd = (x[:, None] for x in states())
    oracle, found = Oracle(derivation.robot), Oracle(derivation.model.robot)
    known = found.variables(c.close(q))
    u = np.stack([known[joint.name] for joint in derivation.robot.free], axis=1)
    phi = c.regressor(q, qd, qdd)[:, 0, :]
    ours = dict(zip([column.name for column in derivation.base.columns], phi.T, strict=True))
    theirs = oracle.regressor(u, qd, qdd)
    for name in ours.keys() - {"Fv1", "Fs1"}:
        expected = theirs[name][:, 0]
        np.testing.assert_allclose(ours[name], expected, atol=1e-8 * (1 + np.abs(expected).max()))
    rank = np.linalg.matrix_rank(np.array([x[:, 0] for x in theirs.values()]), tol=1e-4)
    assert rank == derivation.base.rank - 2 == 11
