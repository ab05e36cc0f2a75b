"""Effects of a folder: those of one robot are found, added and refused on another of its kind."""

from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.core.errors import DataError, RobotError
from modeler.estimation.model_file import save_model
from modeler.regression.log import Log
from modeler.robot.edit import collect_shared_effects, export_effect
from modeler.robot.read import parse_robot_text
from tests.chain import chain_of
from tests.diagnose.conftest import Case, Run, motion, on_joint
from tests.diagnose.test_diagnose_discover import two_links
from tests.improve.conftest import BRAKE, brake, long_runs
from tests.rotation import with_cases

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


@pytest.fixture(scope="module")
def case() -> Case:
    return long_runs()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Of three effects, and a file that is none."""
    place = tmp_path / "found"
    place.mkdir()
    for name, text in (("brake", BRAKE), ("far", FAR), ("law", LAW)):
        (place / f"{name}.toml").write_text(text, encoding="utf-8")
    (place / "read.me").write_text("x", encoding="utf-8")
    return place


@pytest.mark.rotating("effects are added to simulated runs")
def test_it_is_found_and_added_on_a_robot_that_does_not_define_it(case: Case, folder: Path) -> None:
    model, train, holdout = case.hidden(brake)
    result = api.diagnose(model, [train], [holdout], effects_from=folder)
    assert [(f.effect, f.joint) for f in result.effects] == [("eddy_brake", "2")]
    left = [line for line in result.sentences if line.startswith("left out: ")]
    assert left == [
        f"left out: leaning ({folder / 'far.toml'}: it reads q7, no joint of demo-arm)",
        "left out: learned_2 (a learned law, no physics)",
    ]
    better = api.add(model, "eddy_brake", [train], [holdout], joint="2", effects_from=folder)
    local = parse_robot_text(better.robot_text, "better").own_effects
    assert [effect.id for effect in local] == ["eddy_brake"]
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["Keb2"] == pytest.approx(4.0, rel=0.04)
    with pytest.raises(DataError, match=r"leaning of .*far\.toml: it reads q7, no joint of"):
        api.add(model, "leaning", [train], effects_from=folder)
    with pytest.raises(DataError, match="eddy_brake: no such effect"):
        api.add(model, "eddy_brake", [train])


@pytest.mark.rotating("effects are added to simulated runs")
def test_a_law_that_was_learned_is_added_by_its_name(case: Case, folder: Path) -> None:
    (law,) = (
        e for e in collect_shared_effects(api.load("demo-arm"), folder).effects if e.is_learned
    )

    def bent(log: Log) -> np.ndarray:
        speed = np.abs(v := motion(log)[1][:, 1])
        return on_joint(log, 1, 5.0 * np.tanh(v / 0.002) * law.columns[0].equation.law(speed))

    model, train, holdout = case.hidden(bent)
    better = api.add(model, "learned_2", [train], [holdout], joint="2", effects_from=folder)
    value = {p.name: p for p in better.fit.parameters}["Lw2"]
    assert value.sigma is not None and abs(value.value - 5.0) < 4.0 * value.sigma
    assert better.history[1].is_learned
    assert better.history[1].error < 0.5 * better.history[0].error


def test_what_two_files_define_alike_counts_once(folder: Path) -> None:
    robot = parse_robot_text(ROBOT + BRAKE.replace("[0.1, 0.3]", "[0.2, 0.5]"), "spinner.toml")
    (folder / "again.toml").write_text(ROBOT + LAW, encoding="utf-8")
    more = collect_shared_effects(robot, folder)
    assert [effect.id for effect in more.effects] == ["learned_2"]
    assert list(more.left_out) == ["leaning"]
    assert more.insert_definitions(robot.text, ["eddy_brake", "spring"]) == robot.text
    text = more.insert_definitions(robot.text, ["learned_2"])
    assert [e.id for e in parse_robot_text(text, "x").own_effects] == ["eddy_brake", "learned_2"]


@with_cases(
    "old, new, said",
    (
        "v*exp",
        "a*exp",
        "x.toml: [own_effects.eddy_brake]: defined otherwise in the file of "
        "spinner; rename one of the two",
    ),
    (
        "eddy_brake",
        "magnet",
        'x.toml: [own_effects.magnet], columns: the parameter "Keb" is '
        "that of eddy_brake already; choose another name",
    ),
    ("eddy_brake", "spring", '[own_effects.spring]: "spring" is spring of the catalogue'),
    ("]\n", "\n", "not TOML"),
    ("c)/w", "q2)/q2", "no equation uses c; use it or take it out"),
    (
        "eddy_brake]",
        'b]\nshapes = {v1 = [1, 2]}\ncolumns = {Kn = "v1*v"}\n[other]',
        'got the name "v1", which is the speed of joint 1; choose another',
    ),
)
def test_mistakes_name_the_file(tmp_path: Path, old: str, new: str, said: str) -> None:
    robot = parse_robot_text(ROBOT + BRAKE, "spinner.toml")
    (tmp_path / "x.toml").write_text(BRAKE.replace(old, new), encoding="utf-8")
    with pytest.raises(RobotError) as caught:
        collect_shared_effects(robot, tmp_path)
    assert said in str(caught.value) and str(tmp_path / "x.toml") in str(caught.value)


def test_folders_without_effects_and_files_that_are_none(folder: Path, tmp_path: Path) -> None:
    robot = parse_robot_text(ROBOT, "spinner.toml")
    (folder / "other.toml").write_text(LAW.replace("0, 1, 1", "0, 1, 2"), encoding="utf-8")
    with pytest.raises(RobotError, match=r"other\.toml: .*learned_2\]: defined otherwise in "):
        collect_shared_effects(robot, folder)
    place, bad = tmp_path / "robot.toml", tmp_path / "x.toml"
    place.write_text(ROBOT, encoding="utf-8")
    for nothing in (tmp_path, place, tmp_path / "nowhere"):
        with pytest.raises(RobotError, match="no effects there; expected a folder with files"):
            collect_shared_effects(robot, nothing)
    bad.write_bytes(b"\xff")
    with pytest.raises(RobotError, match=r"x\.toml: byte 0 is not UTF-8 text"):
        collect_shared_effects(robot, tmp_path)
    bad.unlink()
    bad.mkdir()
    with pytest.raises(RobotError, match=r"x\.toml: is a folder"):
        collect_shared_effects(robot, tmp_path)


USED = """
[effects]
eddy_brake = [{joint = "1", c = 0.7, w = 0.25}, {joint = "2", c = -0.4, w = 0.125}]
"""


def test_an_export_tries_the_values_that_were_found_and_their_neighbours() -> None:
    robot = parse_robot_text(ROBOT + BRAKE + USED, "spinner.toml")
    text = export_effect(robot, "eddy_brake")
    assert text.startswith("[own_effects.eddy_brake]\n") and text.count("[own_effects") == 1
    (effect,) = parse_robot_text(ROBOT + text, "other.toml").own_effects
    assert {s.name: s.grid for s in effect.forms[0].nonlinear_parameters} == {
        "c": (-1.4, -0.4, 0.7, 1.7),
        "w": (0.0625, 0.125, 0.25, 0.5),
    }
    (before,) = robot.own_effects
    assert (effect.title, effect.columns) == (before.title, before.columns)
    unused = parse_robot_text(ROBOT + BRAKE, "spinner.toml")
    again = parse_robot_text(ROBOT + export_effect(unused, "eddy_brake"), "x")
    assert again.own_effects == unused.own_effects


def test_a_grid_at_which_an_equation_has_no_value_stays_as_it_was() -> None:
    steep = """
[own_effects.steep]
columns = {Kx = "v*sqrt(4.5 - p)"}
shapes = {p = [2, 4]}
"""
    text = ROBOT + steep + '[effects]\nsteep = [{joint = "1", p = 3}]\n'
    files = export_effect(parse_robot_text(text, "x.toml"), "steep")
    (effect,) = parse_robot_text(ROBOT + files, "y.toml").own_effects
    assert effect.forms[0].nonlinear_parameters[0].grid == (2.0, 4.0)


def test_export_as_a_command(tmp_path: Path, run: Run) -> None:
    """Of a model that has the effect, and of the robot file with other values."""
    fitted, robot = two_links(), api.load("two-link").text + BRAKE
    for name, w in (("has", 0.2), ("other", 0.1)):
        use = f'[effects]\neddy_brake = [{{joint = "2", c = 0.7, w = {w}}}]'
        (tmp_path / f"{name}.toml").write_text(robot.replace("[effects]", use), encoding="utf-8")
    model, shelf = tmp_path / "b.json", tmp_path / "shelf"
    save_model(model, chain_of(tmp_path / "has.toml").fit([fitted.train]))
    export = ("effects", "--export", "eddy_brake", "--out", shelf, "--robot")
    status, out, _ = run(*export, model)
    files = [shelf / "eddy_brake.toml", shelf / "eddy_brake.html"]
    assert (status, out) == (0, "".join(f"written: {file}\n" for file in files))
    assert sorted(shelf.iterdir()) == sorted(files)
    page = files[1].read_text(encoding="utf-8")
    for said in ("drag of a magnet", "Keb2", "[own_effects.eddy_brake]", "v*exp(-((q - c)/w)**2)"):
        assert said in page, said
    assert "http://" not in page.split("<script>")[0]
    content = files[0].read_text(encoding="utf-8")
    assert run(*export, model)[0] == 0  # the same again
    status, _, err = run(*export, tmp_path / "other.toml")
    assert status == 1 and "there is such a file with another content" in err
    assert [file.read_text(encoding="utf-8") for file in files] == [content, page]
    assert run(*export, tmp_path / "other.toml", "--force")[0] == 0
    assert files[0].read_text(encoding="utf-8") != content


def test_what_cannot_be_exported(tmp_path: Path, run: Run) -> None:
    item = tmp_path / "eddy_brake.toml"
    item.write_text(ROBOT + BRAKE, encoding="utf-8")
    for words, said in (
        (("eddy_brake",), "--export: needs --robot; give both"),
        (("eddy_brak", "--robot", item), 'eddy_brak: no such effect (did you mean "eddy_brake"?)'),
        (("spring", "--robot", item), "spring: every robot may have it; expected one that spinner"),
        (
            ("eddy_brake", "--robot", item, "--out", tmp_path, "--force"),
            "this is the robot file that is read; expected a name of its own",
        ),
        (("eddy_brake", "--robot", "emps"), "expected one that emps defines: none"),
    ):
        status, out, err = run("effects", "--export", *words)
        assert (status, out) == (1, "") and said in err and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == [item]
