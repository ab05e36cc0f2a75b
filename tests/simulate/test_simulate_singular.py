"""Simulated motion of robots with loops keeps away from singular postures.

Measured with the kinematics of the oracle (`tests.oracles`), not with the simulator's.
"""

from pathlib import Path

import numpy as np
import pytest
from closed_robots import LOOPS

from modeler.cli import main
from modeler.robot.read import parse_robot_text, read_robot
from modeler.robot.robot import Robot
from modeler.simulation import SimulationSettings, simulate
from tests.oracles.closed_ways import closed_near, followed, regularity
from tests.oracles.complex_step import Oracle
from tests.robot_texts import CRANK
from tests.robots import LOOPED
from tests.rotation import rotating, with_cases

SHARE = 0.45
"""Of home's distance; less than what is promised by what two ways to write a loop differ."""

STEPS, EVERY = 10, 40

# The rod is hardly longer than the crank: the slider goes mad where the crank stands upright.
STEEP = CRANK.replace("L = 0.35", "L = 0.1001")
for old, new in (('"pi/2"\nq2 = -1.86', "1.25\nq2 = -2.496"), ("q3 = 0.33", "q3 = 0.063")):
    STEEP = STEEP.replace(old, new)


def least_share(robot: Robot, q: np.ndarray) -> float:
    """Least distance to a singular posture along positions (n, coordinates), beside home's."""
    oracle = Oracle(robot)
    home = np.array([[robot.home.get(joint.name, 0.0) for joint in robot.free_joints]])
    home = closed_near(oracle, home, rounds=30)[0]
    targets = np.vstack([home[oracle.given], q[::EVERY]])
    u, _ = followed(oracle, home, targets, STEPS)
    assert np.all(np.isfinite(u))
    least = regularity(oracle, u)
    return float(least[1:].min() / least[0])


@with_cases("name", *LOOPS, *rotating("offset_parallelogram", "3rpr_passive", "rccc_wide"))
def test_half_of_homes_distance_is_kept(name: str, request: pytest.FixtureRequest) -> None:
    elsewhere = name not in LOOPED
    path = request.getfixturevalue("loop_robots_folder") / f"{name}.toml" if elsewhere else name
    robot = read_robot(path)
    seconds, seed = (8.0, 2) if elsewhere else (12.0, 1)
    settings = SimulationSettings(duration=seconds, rate=50.0, seed=seed)
    assert least_share(robot, simulate(robot, settings).truth.q) > SHARE


def test_without_limits_and_near_a_singular_posture() -> None:
    """The range of a robot without [limits], 0.3 rad around home, holds a bad posture."""
    robot = parse_robot_text(STEEP, "steep")
    log = simulate(robot, SimulationSettings(duration=8.0, rate=50.0))
    assert least_share(robot, log.truth.q) > SHARE
    assert least_share(robot, np.array([[1.45]])) < SHARE
    assert 0.1 < log.range_share < 1.0
    assert np.ptp(log.truth.q) > 0.3 * 0.6 * log.range_share


def test_what_was_done_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "steep.toml").write_text(STEEP)
    for robot, text in ((str(tmp_path / "steep.toml"), True), ("five-bar", False)):
        words = ["simulate", robot, "--duration", "8", "--rate", "50"]
        assert main([*words, "--out", str(tmp_path / "a.csv")]) == 0
        said = "of the way from [home] to the limits: farther, the loops"
        assert (said in capsys.readouterr().out) == text
