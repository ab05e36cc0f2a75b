"""Robots with loops through the whole story: a hidden effect is named, added, and gone after."""

import json
from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.cli import main
from modeler.core.errors import DataError
from modeler.robot.read import read_robot
from modeler.simulation import HiddenEffect, SimulationSettings, simulate
from tests.robots import ROBOTS
from tests.rotation import ROTATING, slow_rotating, with_cases


@pytest.mark.rotating("long tests of loops")
@with_cases(
    "name",
    "five-bar",
    *(
        pytest.param(name, marks=ROTATING)
        for name in ("orthoglide-2003", "orthoglide-leg", "3rpr_passive", "excavator_sim")
    ),
)
def test_a_hidden_friction_is_named_and_added(name, loop_robots_folder, tmp_path):
    """Of the second motor: named first, added, and gone after.

    Joints without motor that swing, as of the leg, have rows 0 = W beta: a diagnosis must not be
    driven to beta = 0 by them.
    """
    source = name if name in ROBOTS else str(loop_robots_folder / f"{name}.toml")
    robot = read_robot(source)
    motors = [joint.name for joint in robot.coordinates if joint.actuated]
    hidden = ("asymmetric_viscous", motors[min(1, len(motors) - 1)])
    a, b, m, m2, out = (str(tmp_path / n) for n in ("a.csv", "b.csv", "m.json", "m2.json", "out"))
    stated = () if robot.effects else ("--effects", "viscous,coulomb")
    seconds = "6" if len(robot.coordinates) > 1 else "20"  # one motor gives one row a sample
    hide = ("--hide", "@".join(hidden), "--duration", seconds, "--rate", "150")

    def answer(*words: str) -> dict:
        assert main([*words, "--json", out]) == 0, words
        return json.loads(Path(out).read_text())

    def effects(*words: str) -> list[tuple[str, str | None]]:
        return [(f["effect"], f["joint"]) for f in answer("diagnose", *words)["effects"]]

    for seed, log in (("1", a), ("2", b)):
        answer("simulate", source, *stated, *hide, "--seed", seed, "--out", log)
    answer("fit", source, *stated, a, "--out", m)
    answer("compare", m, b)
    assert effects(m, a, "--holdout", b)[:1] == [hidden]
    steps = answer("add", m, "auto", a, "--holdout", b, "--out", m2)["waterfall"]
    assert steps[-1]["error"] < steps[0]["error"]
    assert hidden not in effects(m2, a, "--holdout", b)


def logged(robot: str, folder: Path, name: str, seed: int, *hidden: str) -> str:
    words = ["simulate", robot, "--duration", "8", "--rate", "200", "--seed", str(seed)]
    assert main([*words, *hidden, "--out", str(folder / name)]) == 0
    return str(folder / name)


@slow_rotating("logs of robots with loops")
def test_a_load_on_the_platform_is_called_a_load(tmp_path, capsys):
    """The mass of a platform that translates acts like masses of the legs that end on it."""
    hidden = ("--hide", "payload:mass=1.983")
    plain = logged("orthoglide-2003", tmp_path, "a.csv", 1)
    loaded = [logged("orthoglide-2003", tmp_path, f"{k}.csv", k, *hidden) for k in (2, 3)]
    model = str(tmp_path / "m.json")
    assert main(["fit", "orthoglide-2003", plain, "--out", model]) == 0
    capsys.readouterr()
    assert main(["diagnose", model, loaded[0], "--holdout", loaded[1]]) == 0
    said = capsys.readouterr().out
    assert said.startswith("missing: a load on the last link (payload)"), said
    assert "payload" not in said.partition("cannot show:")[2].partition("\n")[0]


@pytest.mark.rotating("long tests of loops")
@pytest.mark.parametrize("robot", ["five-bar", pytest.param("delta", marks=ROTATING)])
def test_friction_that_is_drawn_for_a_passive_joint_is_felt(robot: str) -> None:
    """By some motor as a share of its torque that a diagnosis can see, by none as most of it."""
    source = read_robot(robot)
    still = SimulationSettings(duration=3.0, rate=50.0, torque_noise=0.0, process_noise=0.0)
    with_friction = SimulationSettings(
        duration=3.0, rate=50.0, torque_noise=0.0, hidden=(HiddenEffect("passive_friction"),)
    )
    before, after = (simulate(source, settings).truth.tau for settings in (still, with_friction))
    needed = np.sqrt(np.mean(before**2, axis=0))
    share = np.sqrt(np.mean((after - before) ** 2, axis=0)) / needed
    assert 0.03 < share.max() < 0.5


@pytest.mark.rotating("long tests of loops")
def test_a_law_of_the_load_is_refused(tmp_path: Path) -> None:
    """In robots with loops a law reads the motion of its own joint: said before a fit."""
    model = api.identify(api.load("five-bar"), [logged("five-bar", tmp_path, "a.csv", 1)])
    text = "of load: five-bar has loops, and there a law reads the q, v and a of its joint"
    with pytest.raises(DataError, match=text):
        api.add(model, "learned", [tmp_path / "a.csv"], joint="11", of=["load"])
