"""The slotted lever of docs/robots/parallel-examples.md against its mechanics on paper.

By hand: where the lever points and the ram stands, from them every body's velocity per crank
speed, from these the energies, parameter by parameter, and Lagrange's equation of the one freedom.
"""

from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.workflow import derive
from modeler.robot.read import robot_from_text
from tests.loops.derived import compiled_plainly

PAGE = Path(__file__).resolve().parents[2] / "docs/robots/parallel-examples.md"
G, H, R, L, C, HR = 9.81, 0.30, 0.10, 0.60, 0.20, 0.65


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


def bodies(q):
    """{body: (origin, angle, [axis of a first moment: its angle from the body's], inertia)}."""
    lever, way, coupler, ram = on_paper(q)
    along = np.array([np.cos(lever), np.sin(lever)])
    # Axes of rows 3 and 5 in the plane: z along the travel, x a quarter turn on.
    turned, own = {"MZ": 0.0, "MX": np.pi / 2}, {"MX": 0.0, "MY": np.pi / 2}
    return {
        "1": (np.array([0.0 * q, H + 0.0 * q]), q + np.pi / 2, own, "ZZ"),
        "2": (np.array([0.0 * q, 0.0 * q]), lever, own, "ZZ"),
        "3": (way * along, lever, turned, "YY"),
        "4": (L * along, coupler, own, "ZZ"),
        "5": (np.array([ram, HR + 0.0 * q]), 0.0 * q, turned, "YY"),
    }


def inertia_and_height(q):
    """{parameter: (2 T / qd^2, V)} of one kg, kg m or kg m2 at a crank angle."""
    step = 1e-30j
    here, ahead = bodies(q), bodies(q + step)
    found = {}
    for name, (origin, angle, axes, turn) in here.items():
        v = (ahead[name][0] - origin).imag / step.imag
        w = (ahead[name][1] - angle).imag / step.imag
        found[f"M{name}"] = v @ v, G * origin[1]
        found[f"{turn}{name}"] = w**2, 0.0
        for axis, offset in axes.items():
            c, s = np.cos(angle + offset), np.sin(angle + offset)
            found[f"{axis}{name}"] = 2.0 * w * (v @ np.array([-s, c])), G * s
    return found


def torque(q, qd, qdd):
    """{parameter: torque on the crank}: m qdd + m' qd^2 / 2 + V'."""
    h = 1e-5
    here, ahead, behind = (inertia_and_height(x) for x in (q, q + h, q - h))
    slope = {name: (np.array(ahead[name]) - np.array(behind[name])) / (2 * h) for name in here}
    return {
        name: here[name][0] * qdd + 0.5 * slope[name][0] * qd**2 + slope[name][1] for name in here
    }


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


def test_the_torques_are_those_of_lagrange_on_paper(shaper):
    derivation, c = shaper
    q, qd, qdd = states()
    phi = c.regressor(q[:, None], qd[:, None], qdd[:, None])[:, 0, :]
    ours = dict(zip([column.name for column in derivation.base.columns], phi.T, strict=True))
    theirs = [torque(*state) for state in zip(q, qd, qdd, strict=True)]
    for name, column in ours.items():
        expected = np.array([each.get(name, 0.0) for each in theirs])
        if name not in ("Fv1", "Fs1"):
            np.testing.assert_allclose(column, expected, atol=1e-6 * (1 + np.abs(expected).max()))
    rank = np.linalg.matrix_rank(np.array([list(each.values()) for each in theirs]), tol=1e-4)
    assert rank == derivation.base.rank - 2 == 11
