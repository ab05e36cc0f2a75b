"""`modeler new`: a robot file to start from, which derives, closes, simulates and fits as it is."""

import io
import json
import tomllib

import numpy as np
import pytest

from modeler import api
from modeler.api import new_robot
from modeler.core.choices import CONVENTIONS, TEMPLATES
from modeler.core.errors import RobotError
from modeler.robot.read import read_robot
from modeler.robot.table import CONVENTIONS as LETTERS
from tests.cli.running import answer, refusal, run
from tests.modules import unoptimised
from tests.rotation import with_cases


class Terminal(io.StringIO):
    """A terminal on which somebody types."""

    def isatty(self):
        return True


@pytest.mark.parametrize("template", TEMPLATES)
def test_a_template_derives_simulates_and_is_found_again(template, capsys, tmp_path):
    path = tmp_path / "my arm.toml"
    out = answer(capsys, "new", path, "--template", template)
    assert out.endswith(f"next: modeler derive {path}\n")
    robot = read_robot(path)
    assert robot.name == "my-arm" and not robot.readings
    assert bool(robot.loops) == (template != "serial")
    assert api.derive(robot).base.proof.kind == "exact"


@pytest.mark.rotating
@pytest.mark.parametrize("template", ["serial", "parallelogram"])
def test_simulated_logs_of_a_template_are_fitted(template, tmp_path):
    robot = new_robot(tmp_path / "arm.toml", template)
    derivation = api.derive(robot)
    with unoptimised():
        emitted = api.generate(derivation)
        log = api.simulate(robot, duration=8.0)
        seen = api.observe(api.compile_model(emitted), [log])
    result = api.fit(derivation, emitted, seen).fit
    assert derivation.base.rank == len(result.parameters) > 10
    assert result.relative_error < 0.02


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_serial_robots_of_any_joints_are_the_same_in_every_convention(convention, tmp_path):
    rng = np.random.default_rng(28)
    for k in range(8):
        joints = "".join(rng.choice(["R", "R", "P"], rng.integers(1, 9)))
        path = tmp_path / f"a{k}.toml"
        robot = new_robot(path, joints=joints, convention=convention)
        khalil = new_robot(path, joints=joints, force=True)
        assert "".join("P" if j.kind else "R" for j in robot.moving_joints) == joints
        assert robot.joints[: len(joints)] == khalil.joints
        assert robot.convention == convention and set(robot.symbols) >= {"g"}
    assert tuple(LETTERS) == CONVENTIONS


def test_nothing_is_written_over_without_force(capsys, tmp_path):
    path = tmp_path / "arm.toml"
    path.write_text("mine")
    assert "--force" in refusal(capsys, "new", path)
    assert path.read_text() == "mine"
    assert run(capsys, "new", path, "--force", "--json", tmp_path / "n.json")[0] == 0
    assert json.loads((tmp_path / "n.json").read_text())["joints"] == ["1", "2", "3"]
    assert tomllib.loads(path.read_text())["name"] == "arm"
    for words in ({"template": "delta"}, {"convention": "paul"}):
        with pytest.raises(RobotError, match=r"expected one of (serial|khalil)"):
            new_robot(tmp_path / "new.toml", **words)


@with_cases(
    "words, message",
    ("arm.par", "another program's robot file"),
    ("arm.json", "got .json"),
    ("arm.toml --joints RX", "expected R (revolute) or P"),
    (f"arm.toml --joints {'R' * 21}", "20 at most"),
    ("arm.toml --template parallel --joints RR", "the template parallel"),
    ("arm.toml --template parallel --convention craig", "has its own"),
)
def test_what_cannot_be_begun_is_told(words, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert message in refusal(capsys, "new", *words.split())
    assert not list(tmp_path.iterdir())


def test_questions_are_asked_on_a_terminal_only(capsys, tmp_path, monkeypatch):
    typed = "delta\n\nRPX\nrpr\nclassical\n"
    monkeypatch.setattr("sys.stdin", Terminal(typed))
    path = tmp_path / "arm.toml"
    status, _, err = run(capsys, "new", path)
    assert status == 0
    assert "every command reads it" in err and "got delta" in err and "got 'RPX'" in err
    robot = read_robot(path)
    assert robot.convention == "classical"
    assert [joint.kind for joint in robot.moving_joints] == [0, 1, 0]
    monkeypatch.setattr("sys.stdin", io.StringIO(typed))  # a pipe: nothing is asked
    assert run(capsys, "new", path, "--force")[2] == ""
    assert len(read_robot(path).moving_joints) == 3
    monkeypatch.setattr("sys.stdin", Terminal("parallel\n"))
    assert run(capsys, "new", path, "--force")[0] == 0
    assert read_robot(path).platform
