"""Columns that carry the names of joints of the file that a robot is from: --map auto."""

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate, inspect_log, load, read_logs
from modeler.logs.guess import split_label
from modeler.robot import parse_robot_text
from tests.rotation import with_cases

from .arms import ARM7, urdf

NAMES = [link.joint for link in ARM7]


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("names") / "arm.urdf"
    path.write_text(urdf("arm", ARM7[:3]))
    return compile_model(generate(derive(load(path))))


def columns(q, tau, seed=None):
    """Time, positions and torques of the first three joints, shuffled."""
    rng = np.random.default_rng(seed)
    n = 400
    values = {name: rng.normal(size=(2, n)).cumsum(axis=1) * 0.01 for name in NAMES[:3]}
    table = {"time": np.arange(n) / 200}
    for k in rng.permutation(3):
        name = NAMES[k]
        table |= {q.format(name): values[name][0], tau.format(name): values[name][1]}
    return table, values


@with_cases(
    "q, tau",
    ("{}", "{}_effort"),
    ("position/{}", "effort/{}"),
    ("joint_states.position[{}]", "joint_states.effort[{}]"),
    ("state[{}.pos]", "state[{}.torque]"),
    ("q_{}", "{} torque [N m]"),
)
def test_columns_in_any_order_go_to_their_joints(arm, q, tau):
    inputs, values = columns(q, tau)
    (log,) = read_logs(arm, [inputs], ["auto"])
    assert np.allclose(log.q, np.column_stack([values[name][0] for name in NAMES[:3]]))
    assert np.allclose(log.tau, np.column_stack([values[name][1] for name in NAMES[:3]]))


def test_further_joints_of_the_log_are_left_out(arm):
    inputs, values = columns("joint_states.position[{}]", "joint_states.effort[{}]")
    finger = {"joint_states.position[a_finger]": inputs["time"]}
    (log,) = read_logs(arm, [{"time": inputs["time"]} | finger | inputs], ["auto"])
    assert np.allclose(log.q[:, 1], values[NAMES[1]][0])


def test_the_guess_says_the_names(arm):
    inputs, _ = columns("position/{}", "effort/{}")
    suggested = inspect_log(inputs, arm).suggested_map
    assert f'names = {{1 = "{NAMES[0]}", 2 = "{NAMES[1]}", 3 = "{NAMES[2]}"}}\n' in suggested
    assert '"q<j>" = "position/{name}"' in suggested
    doubt = "in the order of the log: which joint is which?"
    assert doubt not in suggested and doubt in inspect_log(inputs).suggested_map


def test_names_of_log_go_before_those_of_the_file():
    item = parse_robot_text(load("so101").text + '\n[log]\nnames = {1 = "waist"}\n', "arm.toml")
    assert item.log_mapping == {"names": {"1": "waist"}}
    assert load("so101").log_mapping["names"]["5"] == "wrist_roll"
    assert load("two-link").log_mapping == {}


def test_a_joint_is_found_in_the_name_of_a_column():
    known = ("elbow", "elbow_roll", "joint_1", "joint_10")
    assert split_label("elbow_roll_pos", known) == ("{}_pos", "elbow_roll")
    assert split_label("joint_10.effort", known) == ("{}.effort", "joint_10")
    assert split_label("elbows", known) == ("elbows", "")
    assert split_label("joint3_pos", known) == ("joint{}_pos", "3")
