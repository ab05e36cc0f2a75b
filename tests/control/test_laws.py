"""Functions for controllers: what friction they go through, frames, operations, refusals."""

import numpy as np
import pytest

from modeler.api import generate as generate_robot
from modeler.api.workflow import load
from modeler.cli import main
from modeler.codegen import Control, derive, generate
from modeler.core.errors import DerivationError, EmitError
from modeler.robot import parse_robot_text, replace_effects
from tests.control.draw import emitted
from tests.elementary_motions import frames, shift, turn
from tests.modules import loaded
from tests.rotation import with_cases
from tests.texts import read_pairs


def test_derivatives_go_through_friction_that_reads_loads_and_powers():
    effects = {
        "viscous": "all",
        "load_friction": [{"joint": "1", "w": 0.0}],
        "nonlinear_viscous": [{"joint": "2", "p": 0.5}],
        "spring": [{"joint": "2", "q0": 0.5, "h": 0.1}],
        "stribeck": [{"joint": "1", "vs": 0.6, "d": 1.5}],
        "rotor_inertia": "all",
    }
    text = load("two-link").text + "\n[reference]\n"
    text += "".join(f"{p} = {x}\n" for p, x in (("M1", 3), ("M2", 2), ("MX2", 0.4), ("ZZ2", 0.2)))
    robot = parse_robot_text(replace_effects(text, effects), "lossy")
    made = generate(derive(robot), control=Control())
    model, rng = loaded(made), np.random.default_rng(41)
    roles = {f.name.removeprefix("two_link_") for f in made.spec.control.functions}
    assert "derivatives" in roles and "slotine_li_regressor" not in roles
    beta, h = rng.uniform(0.5, 1.0, len(made.spec.base)), 1e-6
    q, qd, qdd = rng.uniform(0.3, 1.5, (3, 6, 2)) * rng.choice([-1, 1], (3, 6, 2))
    D = model.evaluate("derivatives", q=q, qd=qd, qdd=qdd, beta=beta)
    for j, e in enumerate(h * np.eye(2)):
        for k, (a, b) in enumerate(((e, 0 * e), (0 * e, e))):
            ahead = model.inverse_dynamics(q + a, qd + b, qdd, beta)
            slope = (ahead - model.inverse_dynamics(q - a, qd - b, qdd, beta)) / (2 * h)
            assert np.abs(D[:, k, :, j] - slope).max() <= 1e-6 * np.abs(slope).max(), (k, j)


FRAMES = """
[frames]
columns = ["link", "row", "x", "z", "roll", "pitch", "yaw"]
rows = [["hand-1", "2", 0.1, "0.2", 0.3, -0.4, 0.5], ["hand_1", "1", 0, 0, 0, 0, 0],
        ["base", "0", 0, 0, 0, 0, 0]]
"""


def test_links_of_frames_have_their_jacobians():
    robot = parse_robot_text(load("two-link").text + FRAMES, "hands")
    model = loaded(generate_robot(derive(robot), frames=["hand-1", "1"]))
    q = np.array([0.4, -1.1])
    on = shift(0, 0.1) @ shift(2, 0.2) @ turn(2, 0.5) @ turn(1, -0.4) @ turn(0, 0.3)

    def pose(q):
        return frames(robot, dict(zip("12", q, strict=True)))["2"] @ on

    T = model.evaluate("pose_hand_1", q=q)[0]
    np.testing.assert_allclose(T, pose(q)[:3], rtol=0, atol=1e-14)
    J, h = model.evaluate("jacobian_hand_1", q=q)[0], 1e-6
    slopes = [(pose(q + e)[:3, 3] - pose(q - e)[:3, 3]) / (2 * h) for e in h * np.eye(2)]
    np.testing.assert_allclose(J[:3].T, slopes, rtol=0, atol=1e-9)
    assert model.evaluate("jacobian_1", q=q).shape == (1, 6, 2)


@with_cases(
    "names, text",
    (["hand"], 'frame "hand": two-link has none of that name; expected hand-1, hand_1, 1, 2'),
    (["base"], 'frame "base": two-link has none of that name; expected hand-1'),
    (["hand-1", "hand_1"], 'frame "hand_1": functions of another frame or role end in _hand_1'),
)
def test_frames_that_cannot_be_are_told(names, text):
    result = derive(parse_robot_text(load("two-link").text + FRAMES, "hands"))
    with pytest.raises((DerivationError, EmitError)) as error:
        generate_robot(result, frames=names)
    assert text in str(error.value) and "\n" not in str(error.value)


def test_the_command_line_asks_for_frames(tmp_path):
    assert main(["generate", "scara", "--out", str(tmp_path / "c"), "--frame", "2"]) == 0
    assert "scara_jacobian_dot_qd_2(" in (tmp_path / "c" / "scara_control.h").read_text()


MOST = read_pairs("""
    coriolis_matrix 1110 coriolis_transpose 275 momentum 274 derivatives 3546
    slotine_li_regressor 782 momentum_regressor 388 momentum_rest_regressor 474 jacobian 74
    jacobian_dot_qd 155
""")


def test_functions_need_no_more_operations_than_were_reached():
    """Half to a quarter of differentiating the torques; each shares only what it computes."""
    spec = emitted("puma560")[1].spec
    counts = {
        f.name.removeprefix(f"{spec.prefix}_"): f.additions + f.multiplications
        for f in spec.control.functions
    }
    assert not {role: counts[role] for role, bound in MOST.items() if counts[role] > bound}
