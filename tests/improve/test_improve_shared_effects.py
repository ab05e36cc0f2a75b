"""Effects of a folder: those of one robot are found, added and refused on another of its kind."""

from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.core.errors import DataError, RobotError
from modeler.observation.log import Log
from modeler.robot.read import robot_from_text
from modeler.robot.shared_effects import shared_effects
from tests.diagnose.conftest import Case, motion, on_joint

BRAKE = """
[own_effects.eddy_brake]
title = "drag of a magnet"
columns = {Keb = "v*exp(-((q - c)/w)**2)"}
shapes = {c = [-1, 0, 1], w = [0.1, 0.3]}
unit = "N*m*s/rad"
nonnegative = true
"""
FAR = """
[own_effects.leaning]
columns = {Kl = "v*(1 - cos(q7))"}
"""
LAW = """
[own_effects.learned_2]
columns = {Lw = "sign(v)*law(abs(v))"}
unit = "N*m"
law = {low = [0], high = [2], cells = [2], values = [0, 0, 0, 1, 1]}
"""
ROBOT = """
name = "spinner"
gravity = [0, 0, 0]
mdh = {columns = ["j", "theta"], rows = [["1", "q1"], ["2", "q2"]]}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Of three effects, and a file that is none."""
    place = tmp_path / "found"
    place.mkdir()
    for name, text in (("brake", BRAKE), ("far", FAR), ("law", LAW)):
        (place / f"{name}.toml").write_text(text, encoding="utf-8")
    (place / "read.me").write_text("x", encoding="utf-8")
    return place


def brake(log: Log) -> np.ndarray:
    """The magnet on joint 2, N m."""
    q, v = motion(log)
    return on_joint(log, 1, 4.0 * v[:, 1] * np.exp(-(((q[:, 1] - 0.7) / 0.2) ** 2)))


def test_it_is_found_and_added_on_a_robot_that_does_not_define_it(case: Case, folder: Path) -> None:
    model, train, holdout = case.hidden(brake)
    found = api.diagnose(model, [train], [holdout], effects_from=folder)
    assert [(f.effect, f.joint) for f in found.effects] == [("eddy_brake", "2")]
    left = [line for line in found.sentences if line.startswith("left out: ")]
    assert left == [
        f"left out: leaning ({folder / 'far.toml'}: it reads q7, no joint of demo-arm)",
        "left out: learned_2 (a learned law, no physics)",
    ]
    better = api.add(model, "eddy_brake", [train], [holdout], joint="2", effects_from=folder)
    own = robot_from_text(better.robot_text, "better").own_effects
    assert [effect.id for effect in own] == ["eddy_brake"]
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["Keb2"] == pytest.approx(4.0, rel=0.04)
    auto = api.auto(model, [train], [holdout], effects_from=folder)
    assert auto.robot_text == better.robot_text
    with pytest.raises(DataError, match=r"leaning of .*far\.toml: it reads q7, no joint of"):
        api.add(model, "leaning", [train], effects_from=folder)
    with pytest.raises(DataError, match="eddy_brake: no such effect"):
        api.add(model, "eddy_brake", [train])


def test_a_law_that_was_learned_is_added_by_its_name(case: Case, folder: Path) -> None:
    def bent(log: Log) -> np.ndarray:
        _, v = motion(log)
        law = effect.columns[0].equation.law
        return on_joint(log, 1, 5.0 * np.tanh(v[:, 1] / 0.002) * law(np.abs(v[:, 1])))

    effect = shared_effects(api.load("demo-arm"), folder).effects[1]
    model, train, holdout = case.hidden(bent)
    found = api.diagnose(model, [train], [holdout], effects_from=folder)
    assert "learned_2" not in {f.effect for f in (*found.effects, *found.refinements)}
    better = api.add(model, "learned_2", [train], [holdout], joint="2", effects_from=folder)
    value = {p.name: p for p in better.fit.parameters}["Lw2"]
    assert value.sigma is not None and abs(value.value - 5.0) < 4.0 * value.sigma
    assert better.history[1].learned
    assert better.history[1].error < 0.5 * better.history[0].error


def test_what_two_files_define_alike_counts_once(folder: Path) -> None:
    robot = robot_from_text(ROBOT + BRAKE.replace("[0.1, 0.3]", "[0.2, 0.5]"), "spinner.toml")
    (folder / "again.toml").write_text(ROBOT + LAW, encoding="utf-8")
    more = shared_effects(robot, folder)
    assert [effect.id for effect in more.effects] == ["learned_2"]
    assert list(more.left_out) == ["leaning"]
    assert more.written(robot.text, ["eddy_brake", "spring"]) == robot.text
    text = more.written(robot.text, ["learned_2"])
    assert [e.id for e in robot_from_text(text, "x").own_effects] == ["eddy_brake", "learned_2"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("v*exp", "a*exp", "x.toml: [own_effects.eddy_brake]: defined otherwise in the file of "
         "spinner; rename one of the two"),
        ("eddy_brake", "magnet", "x.toml: [own_effects.magnet], columns: the parameter \"Keb\" is "
         "that of eddy_brake already; choose another name"),
        ("Keb", "Fv", "the parameter \"Fv\" is that of viscous already; choose another name"),
        ("eddy_brake", "spring", '[own_effects.spring]: "spring" is spring of the catalogue'),
        ("title", "titel", 'unknown key "titel" (did you mean "title"?)'),
        ("]\n", "\n", "not TOML"),
        ("c)/w", "q2)/q2", "no equation uses c; use it or take it out"),
        ("eddy_brake]", "b]\nshapes = {v1 = [1, 2]}\ncolumns = {Kn = \"v1*v\"}\n[other]",
         'got the name "v1", which is the speed of joint 1; choose another'),
    ],
)  # fmt: skip
def test_mistakes_name_the_file(tmp_path: Path, old: str, new: str, said: str) -> None:
    robot = robot_from_text(ROBOT + BRAKE, "spinner.toml")
    (tmp_path / "x.toml").write_text(BRAKE.replace(old, new), encoding="utf-8")
    with pytest.raises(RobotError) as caught:
        shared_effects(robot, tmp_path)
    assert said in str(caught.value) and str(tmp_path / "x.toml") in str(caught.value)


def test_two_files_that_disagree_are_named_both(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    (folder / "other.toml").write_text(LAW.replace("0, 1, 1", "0, 1, 2"), encoding="utf-8")
    with pytest.raises(RobotError, match=r"^other\.toml: .*defined otherwise in law\.toml;"):
        shared_effects(robot_from_text(ROBOT, "spinner.toml"), ".")


def test_folders_without_effects_and_files_that_are_none(tmp_path: Path) -> None:
    robot = robot_from_text(ROBOT, "spinner.toml")
    (tmp_path / "robot.toml").write_text(ROBOT, encoding="utf-8")
    for place in (tmp_path, tmp_path / "robot.toml", tmp_path / "nowhere"):
        with pytest.raises(RobotError, match="no effects there; expected a folder with files"):
            shared_effects(robot, place)
    (tmp_path / "x.toml").write_bytes(b"\xff")
    with pytest.raises(RobotError, match=r"x\.toml: byte 0 is not UTF-8 text"):
        shared_effects(robot, tmp_path)
    (tmp_path / "x.toml").unlink()
    (tmp_path / "x.toml").mkdir()
    with pytest.raises(RobotError, match=r"x\.toml: is a folder"):
        shared_effects(robot, tmp_path)
