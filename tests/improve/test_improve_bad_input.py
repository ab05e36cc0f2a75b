"""`modeler add` asked for what cannot be: one line, nothing written; or its cost is reported."""

from pathlib import Path

import pytest

from modeler.diagnosis.add import add_effect, remove_last_effect
from modeler.diagnosis.added_model import LogSplit, describe_additions
from tests.chain import chain_of
from tests.diagnose.conftest import Run

REFUSED = {
    "viscous --joint 1": "viscous: joint 1 has it in this model already",
    "viscous": "viscous: every joint has it in this model already",
    "load_fricton": 'load_fricton: no such effect (did you mean "load_friction"',
    "spring --joint 7": "--joint 7: no such joint; expected one of 1, 2, 3",
    "encoder_offset --joint 3": "encoder_offset: cannot be distinguished from what the model",
    "encoder_offset --joint 1": "encoder_offset: these logs show nothing of it",
    "time_delay --joint 2": "time_delay acts on the whole robot, not on one joint",
    "elasticity --joint 2": "elasticity: these logs show nothing of it",
    "external_force": "external_force: no torque acts once in these logs",
    "undo": "undo: no effect was added to this model",
    "undo --effects-from .": "got it with undo; expected an effect of the folder, or auto",
    "auto --joint 2": "--joint 2: `auto` takes no joint; expected one effect",
    "auto": "auto: nothing is added, because nothing that can be added is",
    "learned --joint 9": "--joint 9: no such joint; expected one of",
    "learned --joint 2 --of q,v,a": "--of q,v,a: expected one or two quantities, as in q,v",
    "learned --joint 2 --of speed": '--of speed: law: columns, xa: got "speed": speed is',
    "viscous --of q": "--of, --odd, --monotone: got them with viscous; expected",
    "viscous --learned": "--learned: got it with viscous; expected the effect auto",
}


@pytest.mark.parametrize("words", REFUSED)
def test_what_cannot_be_added_is_refused_in_one_line(arm, run, tmp_path, words):
    effect, *joint = words.split()
    outputs = ("--out", tmp_path / "m2.json", "--robot-out", tmp_path / "r.toml")
    words_ = ("add", arm / "m.json", effect, *joint, arm / "train.parquet", *outputs)
    status, out, err = run(*words_)
    assert (status, out) == (1, "")
    assert err.startswith("modeler: ") and err.count("\n") == 1 and REFUSED[words] in err
    assert list(tmp_path.iterdir()) == []


LOOPS = {
    "encoder_eccentricity --joint 11": "cannot be added (five-bar has loops, and",
    "load_friction --joint 11": "load_friction: cannot be added (five-bar has loops",
    "presliding --joint 12": "presliding: cannot be added (five-bar has loops",
    "passive_friction --joint 11": "expected one of 21, 22",
    "stribeck --joint 1": "--joint 1: no such joint; expected one of 11, 12",
    "stribeck --joint 21": "--joint 21: it has no motor, and there stribeck cannot be",
    "viscous --joint 7": "no such joint; expected one of 11, 12, 21, 22",
}


@pytest.mark.rotating("long tests of improve")
def test_robots_with_loops_say_what_they_cannot_have(loops: Path, run: Run, tmp_path: Path) -> None:
    for words, message in LOOPS.items():
        line = ("add", loops / "m.json", *words.split(), loops / "train.parquet")
        status, _, err = run(*line, "--out", tmp_path / "m2.json")
        assert status == 1 and err.count("\n") == 1 and message in err
    assert list(tmp_path.iterdir()) == []


def test_held_out_rows_are_not_fitted_too(arm: Path, run: Run, tmp_path: Path) -> None:
    train = arm / "train.parquet"
    line = ("add", arm / "m.json", "spring", "--joint", "3", train, "--holdout", train)
    status, _, err = run(*line, "--out", tmp_path / "m2.json")
    assert status == 1 and "--holdout train.parquet: shares rows with train.parquet" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.rotating("effects are added to simulated runs")
def test_a_warm_up_takes_longer_than_a_short_log(arm: Path, run: Run, tmp_path: Path) -> None:
    logs = (arm / "train.parquet", "--holdout", arm / "other.parquet")
    line = ("add", arm / "m.json", "temperature_friction", "--joint", "1", *logs)
    status, _, err = run(*line, "--out", tmp_path / "m2.json")
    assert status == 1 and "cannot be distinguished from what the model has on these logs" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.rotating("effects are added to simulated runs")
def test_a_temperature_that_was_not_logged_is_told() -> None:
    """Time stands in for it; and as the machine has no such effect, the error does not fall."""
    emps = chain_of("emps")
    train, other = (emps.log(str(k), duration=120.0, rate=50.0, seed=k) for k in (1, 2))
    logs = LogSplit([train], [other])
    hot = add_effect(emps.fit([train]), emps.compiled, "temperature_friction", "1", logs)
    line, change = describe_additions(hot)
    assert line.startswith("temperature_friction, joint 1: the logs have no column temperature1 or")
    assert "the error does not fall" in change and "undo" in change
    assert "temperature_friction" not in remove_last_effect(hot, logs).robot_text
