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
from modeler.simulation import SimulationSettings, parse_hidden_effect, simulate
from tests.chain import chain_of
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


HYSTERESIS = {
    "presliding": {"Fz2": "level", "Fzd2": "damping", "d": "distance"},
    "cable_hysteresis": {"Fh2": "level", "d": "width", "b": ""},
}
"""Parameters and shapes of the effect -> what they are called in the simulator."""
SIMULATED_SHARE = 0.7


@pytest.mark.parametrize("effect", HYSTERESIS)
def test_the_start_of_a_bristle_is_unknown_and_does_not_spoil_its_values(effect: str) -> None:
    """Logs that begin in the midst of the motion of another machine, by physics of its own."""
    arm, hidden = chain_of("demo-arm"), (parse_hidden_effect(f"{effect}@2"),)
    settings = dict(duration=22.0, rate=1000.0, parameter_seed=7, hidden=hidden)
    machine = simulate(arm.derivation.robot, SimulationSettings(seed=1, **settings)).truth
    truth = {"": SIMULATED_SHARE, **machine.hidden_effects[0].values}
    train, holdout = (late(arm.log(f"{seed}", seed=seed, **settings)) for seed in (5, 6))
    logs, model = LogSplit([train], [holdout]), arm.fit([train])
    better = add_effect(model, arm.compiled, effect, "2", logs)
    step = better.history[-1]
    before, after = step.joints["2"]
    assert step.is_improvement and after < 0.0016 and before > 5.0 * after
    deviations = {p.name: p.sigma for p in better.fit.parameters} | step.nonlinear_sigmas
    estimates = {p.name: p.value for p in better.fit.parameters} | step.nonlinear_parameters
    ends = {p.name: p.interval for p in better.fit.parameters} | step.nonlinear_intervals
    for name, key in HYSTERESIS[effect].items():
        value, sigma, true = estimates[name], deviations[name], truth[key]
        assert abs(value - true) < 3.0 * sigma < 0.2 * true, (name, value, sigma, true)
        assert ends[name][0] < value < ends[name][1]
    rows = build_rows(load_compiled(better.spec, better.sources), logs, better.processing)
    (note,) = rows.fit_observation.report.collect_notes()
    assert note.startswith("note: joint 2: ") and "state of its bristle or cable" in note


def late(log: Log) -> Log:
    """The log without its first two seconds."""
    k = int(np.searchsorted(log.time, 2.0))
    arrays = {name: getattr(log, name) for name in ("time", "q", "tau", "qd", "qdd", "commanded")}
    cut = {name: values[k:] for name, values in arrays.items() if values is not None}
    return replace(log, **cut, extra={}, segment=None, channels={})


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
