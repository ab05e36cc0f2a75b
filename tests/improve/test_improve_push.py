"""A push is left out: of the fit, of judging, and of what later commands read of the same log."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.diagnosis import diagnose
from modeler.diagnosis.add import add_effect, add_findings, remove_last_effect
from modeler.diagnosis.added_model import LogSplit, describe_additions
from modeler.estimation import load_model, save_model
from modeler.regression import observe
from modeler.regression.log import Log
from modeler.validation.prediction import predict
from tests.diagnose.conftest import Case
from tests.diagnose.test_diagnose_pushes import pushed

PUSH = pushed((12.0, 13.2), size=6.0)
LATER = pushed((9.0, 10.0), size=6.0)
TOUCHED = 12.0, 13.2


def pushed_log(log: Log, torque) -> Log:
    return replace(log, tau=log.tau + torque(log))


def errors_of(model, log: Log, case: Case) -> np.ndarray:
    """Relative errors of the joints."""
    prediction, _ = predict(model, [log], case.compiled)
    left = np.where(prediction.used, prediction.measured - prediction.predicted, 0.0)
    whole = np.where(prediction.used, prediction.measured, 0.0)
    return np.linalg.norm(left, axis=0) / np.linalg.norm(whole, axis=0)


def test_a_push_is_left_out_and_the_rest_is_as_good_as_without_it(case: Case, tmp_path: Path):
    train, holdout = pushed_log(case.train, PUSH), pushed_log(case.holdout, LATER)
    clean, bent = case.fitted(case.train), case.fitted(train)
    logs = LogSplit([train], [holdout])
    better = add_effect(bent, case.compiled, "contact", None, logs)
    step = better.history[-1]
    assert step.is_improvement and step.effect == "external_force"
    # It says which seconds and rows of which log, and the file holds them.
    of_fit, of_judging, change = describe_additions(better)
    assert of_fit.startswith(f"{train.name}: 11.") and "rows 28" in of_fit
    assert of_judging.startswith(f"{holdout.name}: 8.") and "left out: something" in of_judging
    assert "error falls" in change
    save_model(tmp_path / "m.json", better)
    again = load_model(tmp_path / "m.json")
    assert again.processing == better.processing and again.history[-1] == step
    (window,) = again.processing.get_pushes(train)
    assert window[0] < TOUCHED[0] and window[1] > TOUCHED[1]
    assert window[1] - window[0] < 3.0
    # No row of it counts any more, and who reads the log again is told.
    seen = observe(case.compiled, [train], again.processing)
    inside = (seen.time > TOUCHED[0]) & (seen.time < TOUCHED[1])
    assert inside.any() and not seen.used[inside].any() and seen.used[~inside].any()
    assert any("left out: something pushed" in line for line in seen.report.collect_notes())
    # On a third motion: the clean machine's error.
    third = case.holdout
    floor, before, after = (errors_of(m, third, case) for m in (clean, bent, again))
    assert np.all(after < 1.15 * floor) and np.max(before / floor) > 2.0
    back = remove_last_effect(better, logs)
    assert not back.processing.pushes
    np.testing.assert_allclose(back.beta, bent.beta, rtol=1e-6, atol=1e-9)


def test_what_a_diagnosis_says_of_a_push_is_what_is_added(case: Case) -> None:
    train = pushed_log(case.train, PUSH)
    model = case.fitted(train)
    result = diagnose(model, case.compiled, [train], [case.holdout])
    (finding,) = result.effects
    assert result.addable_findings == (finding,)
    better, left_out = add_findings(
        model, case.compiled, result.effects, LogSplit([train], [case.holdout])
    )
    assert left_out == () and better.history[-1].is_improvement
    ((start, end),) = better.processing.get_pushes(train)
    assert start == pytest.approx(finding.parameters["t0"] - 0.5, abs=0.2)
    assert end == pytest.approx(finding.parameters["t1"] + 0.5, abs=0.2)


def test_a_push_in_held_out_logs_alone_does_not_judge(case: Case) -> None:
    model, holdout = case.fitted(case.train), pushed_log(case.holdout, LATER)
    result = diagnose(model, case.compiled, [case.train], [holdout])
    assert result.effects == () and result.verdict == "nothing significant"
    assert any(line.startswith("held out: something pushed") for line in result.data_warnings)
    logs = LogSplit([case.train], [holdout])
    better = add_effect(model, case.compiled, "external_force", None, logs)
    assert better.processing.get_pushes(case.train) == ()
    assert len(better.processing.get_pushes(holdout)) == 1 and better.history[-1].is_improvement
    of_judging, rest = describe_additions(better)
    assert "left out: something pushed" in of_judging and "error of the rest: joint 1 0." in rest
    assert errors_of(better, holdout, case).max() < 0.5 * errors_of(model, holdout, case).max()


def test_without_a_push_nothing_is_left_out(case: Case) -> None:
    model, logs = case.fitted(case.train), LogSplit([case.train], [case.holdout])
    with pytest.raises(DataError, match=r"external_force: no torque acts once .* nothing is left"):
        add_effect(model, case.compiled, "external_force", None, logs)
