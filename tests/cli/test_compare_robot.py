"""`modeler compare ROBOT LOG`: with the values that the robot's file states, before any fit."""

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from modeler import compare, compare_models, identify
from modeler.api.model import open_robot
from modeler.cli import main
from tests.rotation import with_cases

INERTIAL = """<inertial><origin xyz="{centre} 0 0.01"/><mass value="{mass}"/>
<inertia ixx="0.01" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial>"""
FRICTION = '<dynamics damping="0.4" friction="0.6"/>'


def urdf(mass: float = 3.0, friction: str = "") -> str:
    """Two joints about y; only the upper arm differs."""
    links = [("upper", mass, 0.15), ("fore", 1.5, 0.1)]
    bodies = [f'<link name="{n}">{INERTIAL.format(mass=m, centre=c)}</link>' for n, m, c in links]
    tag = (
        '<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/>'
        '<origin xyz="{3} 0 0"/><axis xyz="0 1 0"/>'
        '<limit lower="-2" upper="2" velocity="3" effort="80"/>' + friction + "</joint>"
    )
    joints = [tag.format("shoulder", "base", "upper", 0), tag.format("elbow", "upper", "fore", 0.3)]
    return f'<robot name="duo"><link name="base"/>{"".join(bodies + joints)}</robot>'


@pytest.fixture(scope="module")
def duo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file says 3 kg where the machine has 2; the friction of the machine is 0.4 and 0.6."""
    place = tmp_path_factory.mktemp("duo")
    (place / "arm.urdf").write_text(urdf())
    (place / "true.urdf").write_text(urdf(2.0, FRICTION))
    seed = int(np.random.default_rng().integers(1 << 20))
    words = f"simulate {place}/true.urdf --duration 8 --seed {seed} --out {place}/run.csv"
    assert main(words.split()) == 0
    return place


@pytest.fixture
def folder(duo: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(duo)


def next_line(text: str) -> list[str]:
    """The command that is suggested, as words."""
    (line,) = re.findall(r"^next: modeler (.*)$", text, re.MULTILINE)
    return shlex.split(line)


@pytest.mark.rotating("long tests of cli")
def test_the_values_of_the_file_are_compared_before_any_fit(folder, capsys) -> None:
    capsys.readouterr()
    assert main(["compare", "arm.urdf", "run.csv", "--json", "before.json"]) == 0
    printed = capsys.readouterr().out
    zero = "taken as 0: rotor_inertia, viscous, coulomb, offset of joint 1, 2"
    assert zero in printed
    before = json.loads(Path("before.json").read_text())
    assert any("taken as 0" in line for line in before["warnings"])
    # By hand: the torque that the file's numbers give, of the torque that was measured.
    assert 0.05 < before["joints"]["1"]["relative_error"] < 1.0
    assert main(next_line(printed)) == 0
    assert Path("arm.model.json").is_file()
    capsys.readouterr()
    words = ["compare", "arm.urdf", "arm.model.json", "run.csv", "--json", "both.json"]
    assert main(words) == 0
    both = json.loads(Path("both.json").read_text())
    assert both["relative_error"] == pytest.approx(before["relative_error"], rel=0.05)
    assert "arm.model.json predicts joints 1 and 2 significantly better." in capsys.readouterr().out


@pytest.mark.rotating("long tests of cli")
def test_a_file_that_states_the_truth_has_no_error_but_noise(folder, capsys) -> None:
    """Friction too; rotors and offsets of a simulated machine are drawn, so they are set."""
    assert main(["convert", "true.urdf", "--out", "true.toml"]) == 0
    text = Path("true.toml").read_text()
    zeros = "".join(f"{name}{j} = 0.0\n" for name in ("Ia", "Off") for j in "12")
    Path("whole.toml").write_text(text.replace("Fv1 =", f"{zeros}Fv1 =", 1))
    assert main(["simulate", "whole.toml", "--duration", "8", "--out", "whole.csv"]) == 0
    comparison = compare(open_robot("whole.toml"), "whole.csv")
    assert comparison.relative_error < 0.005
    capsys.readouterr()
    assert main(["compare", "whole.toml", "whole.csv"]) == 0
    assert "taken as 0" not in capsys.readouterr().out


@with_cases(
    "words, message",
    ("two-link.toml run.csv", "two-link.toml: there is no such file"),
    ("emps run.csv", "emps: its file states no parameter values; expected [parameters]"),
    ("arm.urdf run.csv --essential", "--essential: duo is a robot; expected a model"),
    ("arm.urdf run.csv --run-embedded-c", "--run-embedded-c: duo is a robot; expected"),
    ("none.json run.csv", "none.json: cannot be read"),
)
def test_what_cannot_be_compared(folder, capsys, words: str, message: str) -> None:
    assert main(["compare", *words.split()]) == 1
    assert message in capsys.readouterr().err


@pytest.mark.rotating
@pytest.mark.parametrize("method", ["ridge", "consistent"])
def test_every_method_takes_a_converted_robot(folder, capsys, method: str) -> None:
    assert main(["fit", "arm.urdf", "run.csv", "--method", method, "--out", "m.json"]) == 0
    printed = capsys.readouterr().out
    assert f"method {method} does not use inertial = 0.3 of [parameters.uncertainty]" in printed
    assert main(["compare", "m.json", "run.csv", "--json", "m.compare.json"]) == 0
    assert json.loads(Path("m.compare.json").read_text())["relative_error"] < 0.01


def test_python_takes_a_robot_as_well(folder) -> None:
    arm, model = open_robot("arm.urdf"), identify("arm.urdf", "run.csv")
    assert compare(arm, "run.csv").relative_error > 10.0 * model.fit.relative_error
    assert compare_models({"before": arm, "after": model}, ["run.csv"]).names == ("before", "after")
