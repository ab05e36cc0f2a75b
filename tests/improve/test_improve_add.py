"""Effects into a model: the error falls on held-out motion, the C has the column, undo takes it."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.diagnosis.add import add_effect, add_findings, undone
from modeler.diagnosis.added_model import Logs
from modeler.diagnosis.diagnosis import diagnose
from modeler.estimation.model_file import load_model, save_model
from modeler.observation.log import Log
from modeler.robot.read import robot_from_text
from modeler.runtime.model import load as load_compiled
from tests.diagnose.conftest import Case, motion, on_joint, two
from tests.rotation import rotating_with


@rotating_with("effects are added")
def test_two_effects_added_one_after_the_other_and_undone(case: Case, tmp_path: Path) -> None:
    model, train, holdout = case.hidden(two)
    logs = Logs([train], [holdout])
    one = add_effect(model, case.compiled, "spring", "3", logs)
    both = add_effect(one, load_compiled(one.spec, one.sources), "position_friction", "1", logs)
    errors = [step.error for step in both.history]
    assert errors[0] > 1.1 * errors[1] and errors[1] > 1.3 * errors[2]
    values = {p.name: p.value for p in both.fit.parameters}
    assert values["Ks3"] == pytest.approx(1.5, rel=0.1)
    assert values["Fpc1"] == pytest.approx(2.5 * np.cos(1.0), rel=0.1)
    assert "position_friction" in both.robot_text
    assert any("Fpc1" in text for text in both.sources.values())  # the header says so
    save_model(tmp_path / "two.json", both)
    assert load_model(tmp_path / "two.json").history == both.history
    back = undone(both, logs)
    assert "position_friction" not in back.robot_text
    np.testing.assert_allclose(back.beta, one.beta, rtol=1e-9)


def test_what_a_diagnosis_names_is_added(case: Case) -> None:
    model, train, holdout = case.hidden(two)
    found = case.found(two)
    better, _ = add_findings(model, case.compiled, found.effects, Logs([train], [holdout]))
    assert better.history[-1].error < 0.5 * better.history[0].error
    again = diagnose(better, load_compiled(better.spec, better.sources), [train], [holdout])
    assert not {("spring", "3"), ("position_friction", "1")} & {
        (f.effect, f.joint) for f in again.effects
    }


def test_friction_that_depends_on_the_load_is_linearised_at_the_reference(case: Case) -> None:
    """A column that reads the links' torques: the robot file says at which parameters."""
    beta = case.fitted(case.train).beta

    def loaded(log: Log) -> np.ndarray:
        q, v = motion(log)
        load = case.compiled.gravity(q, beta)[:, 1]
        return on_joint(log, 1, 0.08 * np.abs(load) * np.tanh(v[:, 1] / 0.002))

    model, train, holdout = case.hidden(loaded)
    better = add_effect(model, case.compiled, "load_friction", "2", Logs([train], [holdout]))
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["mu2"] == pytest.approx(0.08, rel=0.1)
    assert robot_from_text(better.robot_text, "better").reference
    assert better.history[-1].error < 0.7 * better.history[0].error


def test_presliding_has_a_state_that_the_c_advances(case: Case) -> None:
    model, train, holdout = case.hidden(two)
    better = add_effect(model, case.compiled, "presliding", "2", Logs([train], [holdout]))
    compiled = load_compiled(better.spec, better.sources)
    assert [s.kind for s in better.spec.signals] == ["slip"]
    after = compiled.advance([0.0, 1e9, 0.0], 0.001, [-1.0])
    np.testing.assert_allclose(after, [1.0])  # far travel turns the bristle wholly


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
