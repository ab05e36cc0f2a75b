"""Gravity that the torques of a log carry: absent, compensated, doubled, reversed, turned."""

import numpy as np
import pytest

from modeler.api import observe
from modeler.estimation.findings import log_findings
from modeler.estimation.identify import identify
from modeler.estimation.verdict import with_verdict
from modeler.observation.read import read_log
from modeler.robot import robot_from_text
from modeler.robot.edit import with_gravity
from modeler.robot.read import builtin_text
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.link_data import compiled as compiled_text
from tests.modules import compiled

DOWN = np.array([0.0, 0.0, -9.81])


def arm(gravity, name="demo-arm"):
    return with_gravity(builtin_text(name), [float(g) for g in gravity])


def log_of(folder, text, seed=4):
    settings = SimulationSettings(duration=12.0, rate=250.0, seed=seed, torque_noise=0.02)
    write_log(folder / "log.parquet", simulate(robot_from_text(text, "arm"), settings))
    return folder / "log.parquet"


def verdict_of(machine, place):
    observation = observe(machine, [read_log(place, machine.spec)])
    found = log_findings(machine, observation)
    return with_verdict(machine, observation, identify(observation, "weighted", machine), found)


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (0.0, ("the torques carry no gravity",)),
        (0.1, ("the torques carry 0.1 times the gravity",)),
        (0.5, ("the torques carry 0.5 times the gravity",)),
        (2.0, ("the torques carry 2 times the gravity",)),
        (-1.0, ("sign", "alpha", "zero off by 180 degrees")),
    ],
)
def test_a_factor_of_gravity_is_named_and_no_clock(tmp_path, factor, words):
    place = log_of(tmp_path, arm(factor * DOWN, "puma560"))
    verdict = verdict_of(compiled("puma560"), place).verdict
    assert verdict.valid_for == "nothing"
    assert all(word in verdict.line for word in words) and "clock" not in verdict.line


def test_gravity_along_another_axis_is_named_with_its_direction(tmp_path):
    g = 9.81 * np.array([np.sin(1.0), 0.0, -np.cos(1.0)])
    line = verdict_of(compiled("demo-arm"), log_of(tmp_path, arm(g))).verdict.line
    assert "gravity of the robot file, [0.0, 0.0, -9.8] m/s2, does not fit" in line
    asked = [float(x) for x in line.partition("about [")[2].partition("]")[0].split(", ")]
    np.testing.assert_allclose(asked, g, atol=0.3)


def test_a_robot_file_without_gravity_is_told_which(tmp_path):
    line = verdict_of(compiled_text(arm(0.0 * DOWN)), log_of(tmp_path, arm(DOWN))).verdict.line
    asked = [float(x) for x in line.partition("about [")[2].partition("]")[0].split(", ")]
    np.testing.assert_allclose(asked, DOWN, atol=0.3)


def test_a_small_tilt_of_the_base_is_left_to_diagnosis(tmp_path):
    g = 9.81 * np.array([np.sin(0.1), 0.0, -np.cos(0.1)])
    fit = verdict_of(compiled("demo-arm"), log_of(tmp_path, arm(g)))
    assert "gravity of the robot file" not in fit.verdict.line
    assert fit.verdict.valid_for != "parameters"
    assert any(one.state != "good" for one in fit.verdict.by_joint.values())
