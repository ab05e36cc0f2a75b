"""Pushes, delays of loggers, temperatures with gaps, declared couplings: on simulated runs."""

import dataclasses
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from modeler.diagnosis.candidates import StatedEffects, compute_scales, list_candidates
from modeler.diagnosis.diagnosis import diagnose
from modeler.effects.catalogue import find_effect
from modeler.regression.log import Log
from modeler.views.diagnosis import build_diagnosis_page
from modeler.views.evidence import draw_push_picture
from modeler.views.page import write_page
from tests.diagnose.conftest import Case, check_gains, motion, on_joint
from tests.rotation import rotating, with_cases


def pushed(*windows: tuple[float, float], size: float = 1.0):
    def torque(log: Log) -> np.ndarray:
        inside = [(log.time > start) & (log.time < end) for start, end in windows]
        return np.outer(size * np.any(inside, axis=0), [1.0, -1.5, 0.5])

    return torque


def once(torque, case: Case, **options):
    """Only the training run has it."""
    model, train, _ = case.hidden(torque)
    result = diagnose(model, case.compiled, [train], [case.holdout], **options)
    check_gains(result)
    return result


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_push_as_small_as_the_noise_is_found_by_its_duration(case: Case) -> None:
    noise = 0.01 * np.sqrt(np.mean(case.train.tau**2, axis=0))
    size = 2.0 * float(noise[2]) / 0.5
    first = once(pushed((12.0, 13.2), size=size), case).effects[0]
    assert first.effect == "external_force"
    assert first.parameters["t0"] == pytest.approx(12.0, abs=0.4)
    assert first.parameters["t1"] == pytest.approx(13.2, abs=0.3)


@pytest.mark.rotating("long tests of diagnose")
def test_a_push_whose_torque_changes_its_sign_is_one_push(case: Case, tmp_path: Path) -> None:
    def torque(log: Log) -> np.ndarray:
        turning = np.where(log.time < 12.8, 1.0, -1.0)[:, None]
        return pushed((12.0, 13.6), size=4.0)(log) * turning

    diagnosis = once(torque, case)
    first = diagnosis.effects[0]
    assert first.effect == "external_force"
    assert first.parameters["t0"] == pytest.approx(12.0, abs=0.4)
    assert first.parameters["t1"] == pytest.approx(13.6, abs=0.3)
    # It stands out in its picture, on the page.
    assert diagnosis.window is not None
    ((panel,),) = draw_push_picture(diagnosis.search.end, diagnosis.window).panels
    assert panel.shade is not None
    start, end = panel.shade
    for curve in panel.series:
        inside = (curve.x > start + 0.2) & (curve.x < end - 0.2)
        outside = (curve.x < start - 0.2) | (curve.x > end + 0.2)
        loud, quiet = (np.nanmedian(np.abs(curve.y[x])) for x in (inside, outside))
        assert loud > 20.0 * quiet
    page = write_page(tmp_path / "page.html", build_diagnosis_page(diagnosis)).read_text()
    assert "Something pushed" in page


@pytest.mark.rotating("diagnoses of simulated runs")
@pytest.mark.parametrize("again", [(18.0, 19.0), ()], ids=["acts again", "is ruled out"])
def test_no_push_is_named_that(case: Case, again: tuple[float, ...]) -> None:
    windows = [(6.0, 7.0), (12.0, 13.0), again] if again else [(12.0, 13.0)]
    result = once(pushed(*windows, size=4.0), case, without=() if again else ("external_force",))
    assert "external_force" not in {f.effect for f in result.effects}


@pytest.mark.rotating("diagnoses of simulated runs")
def test_what_the_held_out_motion_shows_too_is_a_description_at_most(case: Case) -> None:
    diagnosis = case.found(pushed((12.0, 13.0), size=6.0))
    assert diagnosis.effects[0].effect == "external_force"
    assert diagnosis.verdict == "closest description"
    assert "in the held-out motion too" in diagnosis.sentences[0]


def helical(log: Log, pull: float = 0.0) -> np.ndarray:
    """A spring, or a constant pull, between b = 0.2 m on link 2 and h = 0.4 m above its axis."""
    angle, b, h = motion(log)[0][:, 1] - 0.6, 0.2, 0.4
    length = np.sqrt(b**2 + h**2 - 2.0 * b * h * np.cos(angle))
    return on_joint(log, 1, (pull or 900.0 * (length - 0.15)) * b * h * np.sin(angle) / length)


constant = partial(helical, pull=150.0)


@pytest.mark.rotating("long tests of diagnose")
@with_cases(
    "torque, named, ties, status",
    (constant, "constant_force_spring", (), "confirmed"),
    *rotating((helical, "counterbalance", (("constant_force_spring", "2"),), "likely")),
)
def test_a_helical_spring_and_a_constant_pull_are_told_apart(case, torque, named, ties, status):
    first = case.found(torque).effects[0]
    assert (first.effect, first.joint, first.equivalents) == (named, "2", ties)
    assert (first.status == "confirmed") is (status == "confirmed")


@pytest.mark.rotating("diagnoses of simulated runs")
def test_what_is_ruled_out_on_a_joint_is_neither_named_nor_tied(case: Case) -> None:
    first = case.found(constant, without=("balancer@2",)).effects[0]
    assert (first.effect, first.joint) == ("constant_force_spring", "2")
    assert ("counterbalance", "2") not in first.equivalents


def slower(log: Log, every: int, late: float) -> Log:
    """Every so many rows, with torques that come late by so many s."""
    tau = np.column_stack([np.interp(log.time - late, log.time, t) for t in log.tau.T])
    rows = {"time": log.time, "q": log.q, "tau": tau, "commanded": log.commanded}
    rest = {name: values[::every] for name, values in rows.items() if values is not None}
    return dataclasses.replace(log, qd=None, qdd=None, extra={}, **rest)


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize(("late", "named"), [*rotating((0.0054, False)), (0.009, True)])
def test_half_a_sample_is_a_convention_and_more_is_a_delay(case, late, named):
    """Of 12 ms; a delay is given as instruments see it, which noise does not make smaller."""
    every = round(0.012 / float(np.median(np.diff(case.train.time))))
    train, holdout = (slower(log, every, late) for log in (case.train, case.holdout))
    diagnosis = diagnose(case.fitted(train), case.compiled, [train], [holdout])
    moved = [line for line in diagnosis.data_warnings if "a convention of the logger" in line]
    assert (bool(diagnosis.effects), len(moved)) == ((True, 0) if named else (False, 1))
    for first in diagnosis.effects[:1]:
        assert first.effect == "time_delay"
        assert abs(first.parameters["dt"]) == pytest.approx(late, rel=0.1)


def heated(log: Log) -> Log:
    warm = 20.0 * (1.0 - np.exp(-log.time / 8.0))
    tau = log.tau + on_joint(log, 1, -0.2 * warm * np.tanh(motion(log)[1][:, 1] / 0.002))
    return dataclasses.replace(log, tau=tau, extra={**log.extra, "temperature2": 25.0 + warm})


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_held_out_log_without_temperature_is_told_and_used(case: Case) -> None:
    train, holdout = heated(case.train), heated(case.holdout)
    blind = dataclasses.replace(holdout, extra={})
    model = case.fitted(train)
    whole = diagnose(model, case.compiled, [train], [holdout])
    assert (whole.effects[0].effect, whole.verdict) == ("temperature_friction", "missing")
    diagnosis = diagnose(model, case.compiled, [train], [blind])
    assert any("has no temperature of joint 2" in line for line in diagnosis.data_warnings)
    assert diagnosis.joints["2"].error_after > whole.joints["2"].error_after


def test_a_declared_coupling_is_the_one_that_is_tried(case: Case) -> None:
    spec = case.compiled.spec
    motors = [np.random.default_rng(1).normal(size=(50, len(spec.joints)))]
    effect = find_effect("coupled_friction")
    known = StatedEffects([effect], {"3": {"2": 0.5, "3": 1.0}})
    result = list_candidates(spec, compute_scales(spec, motors, motors, motors), {}, set(), known)
    assert [(c.joint, c.coupling) for c in result if c.joint == "3"] == [("3", {1: 0.5, 2: 1.0})]
    assert {c.nonlinear_parameters["c"] for c in result if c.joint == "2"} == {1.0, -1.0}
