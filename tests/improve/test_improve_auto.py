"""What a diagnosis names goes into the model, if it lowers the error on motion never fitted."""

import dataclasses

import pytest

from modeler.diagnosis import add as module, added_model
from modeler.diagnosis.add import add_effect, add_findings
from modeler.diagnosis.added_model import LogSplit, describe_additions
from modeler.diagnosis.diagnosis import diagnose
from tests.diagnose.conftest import Case, spring
from tests.improve.conftest import Mended


def test_what_is_missing_is_added_and_lowers_the_error(sprung: Mended) -> None:
    before, step = sprung.better.history
    assert (step.effect, step.joint, sprung.left_out) == ("spring", "3", ())
    (line,) = describe_additions(sprung.better, 1)
    assert "error falls: joint" in line
    assert step.error < before.error and step.is_improvement and step.changed_joints
    assert any(step.joints[joint][1] < step.joints[joint][0] for joint in step.changed_joints)


@pytest.mark.rotating("effects are added to simulated runs")
def test_what_holds_on_the_fitted_logs_only_is_left_out(case: Case) -> None:
    """The held-out run is of a machine without the spring: with it, the error rises there."""
    model, train, _ = case.hidden(spring)
    result = diagnose(model, case.compiled, [train])
    assert ("spring", "3") in {(f.effect, f.joint) for f in result.effects}
    before = case.fitted(case.train)  # it describes the held-out run, as no spring is in it
    same, left_out = add_findings(
        before, case.compiled, result.effects, LogSplit([train], [case.holdout])
    )
    assert same is before
    assert any("left out: spring, joint 3 (the error rises: joint" in line for line in left_out)


def test_what_cannot_be_added_is_left_out_with_its_reason(case: Case, sprung: Mended) -> None:
    first = sprung.diagnosis.effects[0]
    findings = [dataclasses.replace(first, effect="backlash", joint="2", pick=None), first]
    better, left_out = add_findings(sprung.model, case.compiled, findings, sprung.logs)
    assert [step.effect for step in better.history] == ["", first.effect]
    (line,) = left_out
    assert line.startswith("left out: backlash, joint 2 (backlash: cannot be added (play has no")


def test_what_is_perhaps_missing_is_left_out_by_auto_and_told_by_add(case, sprung, monkeypatch):
    first = dataclasses.replace(sprung.diagnosis.effects[0], warning="it may be another")
    same, (line,) = add_findings(sprung.model, case.compiled, [first], sprung.logs)
    assert same is sprung.model and line.endswith("(weak evidence: it may be another)")
    monkeypatch.setattr(
        module, "_explain_weak_evidence", lambda *result: "the error falls by little"
    )
    step = add_effect(sprung.model, case.compiled, "spring", "3", sprung.logs)
    assert (
        "the evidence that it is missing is weak: the error falls by little"
        in describe_additions(step)[0]
    )
    assert step.history[-1].to_json()["warning"] == "the error falls by little"


@pytest.mark.rotating("effects are added to simulated runs")
def test_what_is_not_needed_beside_all_the_rest_is_taken_out_again(case, sprung, monkeypatch):
    wide = added_model.is_unneeded
    monkeypatch.setattr(module, "is_unneeded", lambda m, s: s.effect == "spring" or wide(m, s))
    better, taken = add_findings(sprung.model, case.compiled, sprung.diagnosis.effects, sprung.logs)
    assert "spring" not in {step.effect for step in better.history}
    assert any("spring, joint 3 (with the others in, none of its values" in s for s in taken)


def test_an_effect_is_needed_unless_all_of_its_values_are_below_their_sigmas(sprung):
    better, step = sprung.better, sprung.better.history[-1]
    assert not added_model.is_unneeded(better, step)
    for sigmas, needed in ((1.5, True), (-1.5, True), (0.9, False)):
        values = [dataclasses.replace(p, value=sigmas * p.sigma) for p in better.fit.parameters]
        fit = dataclasses.replace(better.fit, parameters=tuple(values))
        assert added_model.is_unneeded(dataclasses.replace(better, fit=fit), step) != needed


@pytest.mark.parametrize("refitted", [True, False], ids=["spring", "payload"])
def test_without_held_out_logs_parts_are_left_out_in_turn(case: Case, refitted: bool) -> None:
    model, train, _ = case.hidden(spring)
    effect, joint = ("spring", "3") if refitted else ("payload", None)
    better = add_effect(model, case.compiled, effect, joint, LogSplit([train]))
    step = better.history[-1]
    assert step.is_improvement is refitted and step.held_out_logs == ()
    if refitted:  # parameters that see a row describe it a little too well
        assert step.error > step.training_error
