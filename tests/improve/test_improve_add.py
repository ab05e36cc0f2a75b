"""Effects into a model: the error falls on held-out motion, the C has the column, undo takes it."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.errors import DataError, RobotError
from modeler.diagnosis.add import add_effect, add_findings, undone
from modeler.diagnosis.added_model import Logs
from modeler.diagnosis.diagnosis import diagnose
from modeler.estimation.model_file import load_model, save_model
from modeler.observation.log import Log
from modeler.robot.read import robot_from_text
from modeler.runtime.model import load as load_compiled
from tests.diagnose.conftest import (
    Case,
    case as case,  # the fixture
    motion,
    on_joint,
)


def hidden(log: Log) -> np.ndarray:
    """A spring on joint 3 and friction that depends on the position of joint 1."""
    q, v = motion(log)
    friction = 2.5 * np.cos(q[:, 0] - 1.0) * np.tanh(v[:, 0] / 0.002)
    return on_joint(log, 2, 1.5 * q[:, 2]) + on_joint(log, 0, friction)


def test_two_effects_added_one_after_the_other_and_undone(case: Case, tmp_path: Path) -> None:
    model, train, holdout = case.hidden(hidden)
    logs = Logs([train], [holdout])
    one = add_effect(model, case.compiled, "spring", "3", logs)
    two = add_effect(one, load_compiled(one.spec, one.sources), "position_friction", "1", logs)
    errors = [step.error for step in two.history]
    assert errors[0] > 1.1 * errors[1] and errors[1] > 1.3 * errors[2]
    values = {p.name: p.value for p in two.fit.parameters}
    assert values["Ks3"] == pytest.approx(1.5, rel=0.1)
    assert values["Fpc1"] == pytest.approx(2.5 * np.cos(1.0), rel=0.1)
    assert "position_friction" in two.robot_text
    assert any("Fpc1" in text for text in two.sources.values())  # the header says so
    save_model(tmp_path / "two.json", two)
    assert load_model(tmp_path / "two.json").history == two.history
    back = undone(two, logs)
    assert "position_friction" not in back.robot_text
    np.testing.assert_allclose(back.beta, one.beta, rtol=1e-9)


def test_what_a_diagnosis_names_is_added(case: Case) -> None:
    model, train, holdout = case.hidden(hidden)
    found = diagnose(model, case.compiled, [train], [holdout])
    better, _ = add_findings(model, case.compiled, found.effects, Logs([train], [holdout]))
    assert better.history[-1].error < 0.5 * better.history[0].error
    again = diagnose(better, load_compiled(better.spec, better.sources), [train], [holdout])
    assert not {("spring", "3"), ("position_friction", "1")} & {
        (f.effect, f.joint) for f in again.effects
    }


def test_friction_that_depends_on_the_load_is_linearised_at_the_reference(case: Case) -> None:
    """A column that reads the links' torques: the robot file says at which parameters."""
    _, train, holdout = case.hidden(hidden)
    weight = case.compiled.gravity(motion(train)[0], case.fitted(case.train).beta)

    def loaded(log: Log) -> np.ndarray:
        q, v = motion(log)
        load = case.compiled.gravity(q, case.fitted(case.train).beta)[:, 1]
        return on_joint(log, 1, 0.08 * np.abs(load) * np.tanh(v[:, 1] / 0.002))

    model, train, holdout = case.hidden(loaded)
    better = add_effect(model, case.compiled, "load_friction", "2", Logs([train], [holdout]))
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["mu2"] == pytest.approx(0.08, rel=0.1)
    assert robot_from_text(better.robot_text, "better").reference
    assert better.history[-1].error < 0.7 * better.history[0].error
    assert np.abs(weight).max() > 0.0


def test_presliding_has_a_state_that_the_c_advances(case: Case) -> None:
    model, train, holdout = case.hidden(hidden)
    better = add_effect(model, case.compiled, "presliding", "2", Logs([train], [holdout]))
    compiled = load_compiled(better.spec, better.sources)
    assert [s.kind for s in better.spec.signals] == ["slip"]
    after = compiled.advance([0.0, 1e9, 0.0], 0.001, [-1.0])
    np.testing.assert_allclose(after, [1.0])  # far travel turns the bristle wholly


REFUSED = {
    "there already": ("viscous", "1", "has it in this model already"),
    "unknown": ("stiction2", None, "no such effect"),
    "no such joint": ("stribeck", "9", "expected one of 1, 2, 3"),
    "not visible": ("encoder_offset", "3", "cannot be told|show nothing"),
    "no column": ("elasticity", "1", "second mass"),
}


@pytest.mark.parametrize("mistake", REFUSED)
def test_what_cannot_be_added_is_refused_with_a_reason(case: Case, mistake: str) -> None:
    name, joint, message = REFUSED[mistake]
    model = case.fitted(case.train)
    with pytest.raises((DataError, RobotError), match=message):
        add_effect(model, case.compiled, name, joint, Logs([case.train]))


def test_nothing_to_undo(case: Case) -> None:
    with pytest.raises(DataError, match="no effect was added"):
        undone(case.fitted(case.train), Logs([case.train]))


def test_a_temperature_effect_needs_the_column_ever_after(case: Case) -> None:
    def warm(log: Log) -> np.ndarray:
        _, v = motion(log)
        return on_joint(log, 1, -0.1 * (heat(log) - 30.0) * np.tanh(v[:, 1] / 0.002))

    def heat(log: Log) -> np.ndarray:
        return 30.0 + 20.0 * (1.0 - np.exp(-log.time / 12.0))

    model, train, holdout = case.hidden(warm)
    train, holdout = (
        dataclasses.replace(log, extra={"temperature2": heat(log)}) for log in (train, holdout)
    )
    better = add_effect(model, case.compiled, "temperature_friction", "2", Logs([train], [holdout]))
    assert better.history[-1].error < 0.7 * better.history[0].error
    with pytest.raises(DataError, match="no column temperature2"):
        diagnose(better, load_compiled(better.spec, better.sources), [case.train])


def test_commands(case: Case, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """fit, diagnose and add as a user types them; pages and robot file are written."""
    model, train, holdout = case.hidden(hidden)
    for name, log in (("train", train), ("holdout", holdout)):
        columns = {"time": log.time}
        for j in range(3):
            columns |= {f"q{j + 1}": log.q[:, j], f"tau{j + 1}": log.tau[:, j]}
        table = np.column_stack(list(columns.values()))
        header = ",".join(columns)
        np.savetxt(tmp_path / f"{name}.csv", table, delimiter=",", header=header, comments="")
    place = {n: str(tmp_path / n) for n in ("m.json", "m2.json", "train.csv", "holdout.csv")}
    assert main(["fit", "demo-arm", place["train.csv"], "--out", place["m.json"]]) == 0
    words = ["diagnose", place["m.json"], place["train.csv"], "--holdout", place["holdout.csv"]]
    assert main([*words, "--report", str(tmp_path / "d.html")]) == 0
    assert "missing:" in capsys.readouterr().out
    page = (tmp_path / "d.html").read_text(encoding="utf-8")
    assert "Why not another effect" in page and "http://" not in page.split("<script>")[0]
    words = ["add", place["m.json"], "spring", "--joint", "3", place["train.csv"]]
    words += ["--holdout", place["holdout.csv"], "--out", place["m2.json"]]
    assert main([*words, "--robot", str(tmp_path / "r.toml"), "--report",
                 str(tmp_path / "a.html")]) == 0  # fmt: skip
    assert "spring" in (tmp_path / "r.toml").read_text(encoding="utf-8")
    assert (
        main(["add", place["m.json"], "auto", place["train.csv"], "--out", place["train.csv"]]) == 1
    )
    assert "this is a log" in capsys.readouterr().err
    words = ["diagnose", place["m.json"], place["train.csv"], "--holdout", place["train.csv"]]
    assert main(words) == 1
    assert "shares rows" in capsys.readouterr().err
    assert main(["diagnose", place["m.json"], place["train.csv"], "--without", "magic"]) == 1
    assert "no such effect" in capsys.readouterr().err
    del model
