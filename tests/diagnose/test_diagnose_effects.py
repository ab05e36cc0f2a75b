"""Effects hidden in simulated runs, written here as torques: are they named, with their values?"""

import dataclasses
import re
from collections.abc import Callable

import numpy as np
import pytest

from modeler.api import load
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.messages import format_lines
from modeler.regression.log import Log
from modeler.views import suggest_after_diagnosis
from tests.chain import chain_of
from tests.diagnose import conftest
from tests.diagnose.conftest import RATE, Case, Torque, motion, nothing, on_joint, spring
from tests.rotation import rotating


def stribeck(log: Log) -> np.ndarray:
    _, v = motion(log)
    return on_joint(log, 1, 4.0 * np.exp(-((v[:, 1] / 0.1) ** 2)) * np.tanh(v[:, 1] / 0.002))


def drift(log: Log) -> np.ndarray:
    return on_joint(log, 1, 0.08 * log.time)


def motor_ripple(log: Log) -> np.ndarray:
    return on_joint(log, 1, 1.2 * np.sin(101.0 * motion(log)[0][:, 1] + 0.7))


def late(log: Log) -> np.ndarray:
    """Torques 4 ms after the motion."""
    return np.roll(log.tau, round(0.004 * RATE), axis=0) - log.tau


#        effect: torque, its joint, values, their tolerance
NAMED: dict[str, tuple[Torque, str | None, dict[str, float], float]] = {
    "stribeck": (stribeck, "2", {"Fst2": 4.0, "vs": 0.1, "d": 2.0}, 0.15),
    "position_friction": (conftest.position_friction, "1", {"Fpc1": 1.351, "Fps1": 2.104}, 0.15),
    "drift": (drift, "2", {"Dr2": 0.08}, 0.15),
    "motor_ripple": (motor_ripple, "2", {"m": 101.0}, 0.15),
    "time_delay": (late, None, {"dt": -0.004}, 0.25),
    "spring": (spring, "3", {}, 0.15),
}


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize("effect", ["spring", "time_delay", *rotating(*[*NAMED][:-2])])
def test_a_hidden_effect_is_named_with_its_values(case: Case, effect: str) -> None:
    torque, joint, values, tolerance = NAMED[effect]
    diagnosis = case.found(torque)
    first = diagnosis.effects[0]
    assert (first.effect, first.joint, diagnosis.verdict) == (effect, joint, "missing")
    assert first.error_after < 0.7 * first.error_before
    for name, value in values.items():
        assert first.parameters[name] == pytest.approx(value, rel=tolerance), name


def test_one_effect_alone_has_the_errors_of_its_joint_and_what_other_looks_say(case: Case) -> None:
    """Same rows, same weights; looks in the fields that scripts read too."""
    result = case.found(spring)
    (best,) = [*result.effects, *result.refinements]
    joint = result.joints["3"]
    assert best.error_before == pytest.approx(joint.error_before)
    assert best.error_after == pytest.approx(joint.error_after)
    held_out, band = best.cross_checks
    assert held_out.label == "in the held-out logs" and band.label.startswith("up to")
    assert band.variance_reduction > 0.5 and best.warning == "" and best.status != "possible"
    assert all(look.agrees and look.leading_effect == ("spring", "3") for look in best.cross_checks)
    data = result.to_json()
    leads = data["effects"][0]["splits"][0]["leading_effect"]
    assert leads == {"effect": "spring", "joint": "3"} and data["joints"].keys() == {"1", "2", "3"}
    assert result.machine_changed == ()


@pytest.mark.rotating("diagnoses of simulated runs")
def test_what_the_user_rules_out_is_not_named(case: Case) -> None:
    diagnosis = case.found(spring, without=("spring@3",))
    assert ("spring", "3") not in {(f.effect, f.joint) for f in diagnosis.effects}
    assert diagnosis.verdict != "missing", "what stands in for it is no fact"


@pytest.mark.rotating("diagnoses of simulated runs")
def test_effects_that_fail_on_held_out_motion_are_not_named(case: Case) -> None:
    """A torque of the training run alone: whatever describes it there is vetoed."""
    model, train, _ = case.hidden(spring)
    diagnosis = diagnose(model, case.compiled, [train], [case.holdout])
    assert ("spring", "3") not in {(f.effect, f.joint) for f in diagnosis.effects}
    assert ("spring", "3") in {one.candidate.key for one in diagnosis.search.vetoed_candidates}
    (lines,) = [line for line in diagnosis.sentences if line.startswith("not named: spring at")]
    assert "that of motion left out does not fall significantly" in lines


def test_nothing_is_named_where_nothing_is_hidden(case: Case) -> None:
    diagnosis = case.found(nothing)
    assert diagnosis.verdict == "nothing significant" and diagnosis.effects == ()
    assert ("payload", None) in diagnosis.undetectable and diagnosis.machine_changed == ()


def smoothed(log: Log) -> np.ndarray:
    """Friction that has not yet built up near standstill."""
    return -0.5 * stribeck(log)


@pytest.mark.rotating("long tests of diagnose")
def test_friction_that_vibration_smooths_mends_the_law(case: Case) -> None:
    alone = case.found(smoothed)
    assert alone.effects == () and alone.verdict == "nothing significant"
    assert alone.sentences[0] == "nothing to add: a law that the model has can be refined"
    assert [(f.effect, f.joint) for f in alone.refinements] == [("stribeck", "2")]
    assert alone.refinements[0].parameters["Fst2"] < 0.0
    assert any("has not yet built up near standstill" in line for line in alone.sentences)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_law_that_is_mended_hides_nothing(case: Case) -> None:
    both = case.found(lambda log: smoothed(log) + spring(log))
    assert [(f.effect, f.joint) for f in both.effects] == [("spring", "3")]
    assert [f.effect for f in both.refinements] == ["stribeck"]


@pytest.mark.rotating("long tests of diagnose")
def test_a_load_since_the_fit_is_named_with_its_mass(case: Case) -> None:
    """1.2 kg, 0.3 m along x of the last frame, in a simulation of its own."""
    text = load("demo-arm").text
    for name, more in {"M3": 1.2, "MX3": 0.36, "YY3": 0.108, "ZZ3": 0.108}.items():
        value = case.derivation.robot.parameters[name]
        text = re.sub(rf"(?m)^{name} = .*$", f"{name} = {value + more}", text)
    log = chain_of(text).log("loaded", duration=15.0, rate=RATE, seed=8, torque_noise=0.01)
    diagnosis = diagnose(case.fitted(case.train), case.compiled, [log])
    first = diagnosis.effects[0]
    assert diagnosis.has_changed and (first.effect, first.joint) == ("payload", None)
    assert first.parameters["mass"] == pytest.approx(1.2, rel=0.1)


def strange(log: Log) -> np.ndarray:
    """A torque of the product of two joints' speeds and positions, which no effect has."""
    q, v = motion(log)
    return on_joint(log, 1, 3.0 * np.sin(2.0 * q[:, 2]) * np.tanh(v[:, 0]) * np.cos(q[:, 1]))


def test_a_cause_outside_the_catalogue_is_not_stated_as_a_fact(case: Case) -> None:
    diagnosis = case.found(strange)
    assert diagnosis.verdict in ("closest description", "unexplained")
    assert diagnosis.joints["2"].systematic_share > 0.5 * diagnosis.joints["2"].noise_share


@pytest.mark.rotating("diagnoses of simulated runs")
def test_knocks_that_follow_nothing_are_told_and_not_named(case: Case) -> None:
    def knocks(log: Log) -> np.ndarray:
        random = np.random.default_rng(len(log.time)).normal(size=len(log.time))
        return on_joint(log, 0, 60.0 * random * (np.abs(np.sin(0.8 * log.time)) > 0.99))

    diagnosis = case.found(knocks)
    assert diagnosis.effects == () and diagnosis.verdict == "unexplained"
    assert any("is concentrated in short bursts" in line for line in diagnosis.sentences)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_friction_that_would_drive_is_not_named(case: Case) -> None:
    """A torque that follows the direction and helps the motor at half of the poses."""

    def helping(log: Log) -> np.ndarray:
        q, v = motion(log)
        return on_joint(log, 1, 60.0 * np.cos(q[:, 1]) * np.tanh(v[:, 1] / 0.002))

    diagnosis = case.found(helping)
    assert not any(f.effect == "position_friction" for f in diagnosis.effects)
    assert any("position_friction" in x and "would drive" in x for x in diagnosis.sentences)


def rubbing(log: Log, share: float) -> np.ndarray:
    """More friction of joint 2."""
    v = motion(log)[1][:, 1]
    return on_joint(log, 1, share * (3.0 * np.tanh(v / 0.002) + 2.0 * v))


CHANGES: dict[str, tuple[Callable[[Log], np.ndarray], set[str]]] = {
    "friction": (lambda log: rubbing(log, 1.0), {"Fs2", "Fv2"}),
    "less friction": (lambda log: rubbing(log, -0.4), {"Fs2", "Fv2"}),
    "bias": (lambda log: on_joint(log, 0, np.full(len(log.time), 2.0)), {"Off1"}),
}


@pytest.mark.parametrize("name", ["friction", *rotating(*[*CHANGES][1:])])
def test_what_has_changed_is_told(case: Case, name: str) -> None:
    torque, moved = CHANGES[name]
    model, train, holdout = case.hidden(nothing)
    holdout = dataclasses.replace(holdout, tau=holdout.tau + torque(holdout), content="y")
    result = diagnose(model, case.compiled, [train], [holdout])
    assert {p.name for p in result.machine_changed} == moved, result.sentences
    assert result.verdict == "nothing significant" and not result.unexplained_change
    first = result.machine_changed[0]
    assert f"joint {first.joint}: " in result.sentences[0] and first.describe() in "\n".join(
        format_lines(result)
    )
    said = result.to_json()["machine_changed"][0]
    assert {"name", "before", "after", "sigma_before", "sigma_after", "unit"} <= set(said)
    assert not any("generate" in row for row in suggest_after_diagnosis("m", ["a"], ["b"], result))


@pytest.mark.rotating("diagnoses of simulated runs")
def test_an_effect_is_named_beside_a_change(case: Case) -> None:
    """Ripple of the motor of joint 2 in both logs; it rubs more in the held-out one."""
    model, train, holdout = case.hidden(motor_ripple)
    holdout = dataclasses.replace(holdout, tau=holdout.tau + rubbing(holdout, 1.0), content="y")
    result = diagnose(model, case.compiled, [train], [holdout])
    assert {p.name for p in result.machine_changed} == {"Fs2", "Fv2"}, result.sentences
    assert [(f.effect, f.joint) for f in result.effects] == [("motor_ripple", "2")]


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_difference_without_a_name_is_told(case: Case) -> None:
    """Inertia of the motor of joint 2: no friction, no load."""
    model, train, holdout = case.hidden(nothing)
    acceleration = np.gradient(motion(holdout)[1][:, 1], holdout.time)
    torque = on_joint(holdout, 1, 2.0 * acceleration)
    holdout = dataclasses.replace(holdout, tau=holdout.tau + torque, content="y")
    result = diagnose(model, case.compiled, [train], [holdout])
    assert result.unexplained_change == ("2",) and not result.machine_changed, result.sentences
    assert result.effects == () and result.held_out_logs == ()
    assert not any("generate" in row for row in suggest_after_diagnosis("m", ["a"], ["b"], result))
