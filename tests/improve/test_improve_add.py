"""Effects into a model: the error falls on held-out motion, the C has the column, undo takes it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.core.errors import DataError
from modeler.diagnosis.add import add_effect, add_findings
from modeler.diagnosis.added_model import LogSplit, build_rows, describe_additions
from modeler.diagnosis.diagnosis import diagnose
from modeler.estimation.model_file import load_model
from modeler.regression.log import Log
from modeler.regression.observation import compute_model_torque
from modeler.runtime.model import load_module as load_compiled
from tests.diagnose.conftest import Case, motion, on_joint, spring, two
from tests.improve.conftest import Mended


@pytest.mark.rotating("long tests of improve")
def test_what_a_diagnosis_names_is_added(case: Case) -> None:
    model, train, holdout = case.hidden(two)
    result = case.found(two)
    logs = LogSplit([train], [holdout])
    better, _ = add_findings(model, case.compiled, result.effects, logs)
    errors = [step.error for step in better.history]
    assert errors == sorted(errors, reverse=True) and errors[-1] < 0.5 * errors[0]
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["Ks3"] == pytest.approx(1.5, rel=0.1)
    assert values["Fpc1"] == pytest.approx(2.5 * np.cos(1.0), rel=0.1)
    assert any("Fpc1" in text for text in better.sources.values())  # the header says so
    again = diagnose(better, load_compiled(better.spec, better.sources), [train], [holdout])
    assert not {("spring", "3"), ("position_friction", "1")} & {
        (f.effect, f.joint) for f in again.effects
    }


def test_presliding_has_a_state_that_the_c_advances(case: Case) -> None:
    model, train, holdout = case.hidden(spring)
    better = add_effect(model, case.compiled, "presliding", "2", LogSplit([train], [holdout]))
    compiled = load_compiled(better.spec, better.sources)
    assert [s.kind for s in better.spec.signals] == ["slip"]
    after = compiled.advance([0.0, 1e9, 0.0], 0.001, [-1.0])
    np.testing.assert_allclose(after, [1.0])  # far travel turns the bristle wholly


@pytest.mark.rotating("effects are added to simulated runs")
def test_a_temperature_effect_needs_the_column_ever_after(case: Case) -> None:
    def warm(log: Log) -> np.ndarray:
        _, v = motion(log)
        return on_joint(log, 1, -0.1 * (heat(log) - 30.0) * np.tanh(v[:, 1] / 0.002))

    def heat(log: Log) -> np.ndarray:
        return 30.0 + 20.0 * (1.0 - np.exp(-log.time / 12.0))

    model, train, holdout = case.hidden(warm)
    train, holdout = (replace(log, extra={"temperature2": heat(log)}) for log in (train, holdout))
    better = add_effect(
        model, case.compiled, "temperature_friction", "2", LogSplit([train], [holdout])
    )
    assert better.history[-1].error < 0.7 * better.history[0].error
    with pytest.raises(DataError, match="no column temperature2"):
        diagnose(better, load_compiled(better.spec, better.sources), [case.train])


@pytest.mark.rotating("effects are added to simulated runs")
def test_viscous_and_coulomb_one_after_the_other(loops: Path) -> None:
    """In a joint without motor they are its friction, which is one effect too."""
    model = load_model(loops / "m.json")
    logs = [loops / "train.parquet"], [loops / "other.parquet"]
    one = api.add(model, "viscous", *logs, joint="21")
    two = api.add(one, "coulomb", *logs, joint="21")
    assert "coulomb, joint 21: the held-out error falls: joint 11" in describe_additions(two)[-1]
    assert 'viscous = ["21"]' in two.robot_text and 'coulomb = ["21"]' in two.robot_text
    both = api.add(model, "passive_friction", *logs, joint="21")
    assert both.history[-1].error == pytest.approx(two.history[-1].error, rel=1e-3)


def test_rows_are_those_that_the_new_robot_would_make_itself(case: Case, sprung: Mended) -> None:
    model, logs, _, better, _ = sprung
    before = build_rows(case.compiled, logs, model.processing)
    compiled = load_compiled(better.spec, better.sources)
    alike, fresh = before.rebuild_for(compiled), build_rows(compiled, logs, model.processing)
    for ours, item in zip(alike.observations, fresh.observations, strict=True):
        np.testing.assert_array_equal(ours.W, item.W)
        np.testing.assert_array_equal(ours.y, item.y)
        assert (ours.names, ours.units, ours.joints) == (item.names, item.units, item.joints)
        assert ours.report == item.report


def test_the_inverse_dynamics_give_the_torque_of_the_columns(case: Case) -> None:
    model, train, _ = case.hidden(spring)
    seen = build_rows(case.compiled, LogSplit([train]), model.processing).fit_observation
    torque = compute_model_torque(seen, case.compiled, model.beta)
    np.testing.assert_allclose(torque, seen.predict(model.beta), atol=1e-9)
