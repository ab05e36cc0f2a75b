"""Effects hidden in simulated runs, written here as torques: are they named, with their values?"""

import dataclasses
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from modeler.api import load
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.observation.log import Log
from modeler.observation.read import read_log
from modeler.robot.read import robot_from_text
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.diagnose.conftest import Case, motion, on_joint


def stribeck(log: Log) -> np.ndarray:
    _, v = motion(log)
    return on_joint(log, 1, 4.0 * np.exp(-((v[:, 1] / 0.1) ** 2)) * np.tanh(v[:, 1] / 0.002))


def asymmetric_viscous(log: Log) -> np.ndarray:
    _, v = motion(log)
    return on_joint(log, 2, 0.6 * np.abs(v[:, 2]))


def position_friction(log: Log) -> np.ndarray:
    q, v = motion(log)
    return on_joint(log, 0, 2.5 * np.cos(q[:, 0] - 1.0) * np.tanh(v[:, 0] / 0.002))


def spring(log: Log) -> np.ndarray:
    q, _ = motion(log)
    return on_joint(log, 2, 1.5 * q[:, 2])


def drift(log: Log) -> np.ndarray:
    return on_joint(log, 1, 0.08 * log.time)


def motor_ripple(log: Log) -> np.ndarray:
    q, _ = motion(log)
    return on_joint(log, 1, 1.2 * np.sin(101.0 * q[:, 1] + 0.7))


NAMED: dict[str, tuple[Callable[[Log], np.ndarray], str | None, dict[str, float]]] = {
    "stribeck": (stribeck, "2", {"Fst2": 4.0, "vs": 0.1, "d": 2.0}),
    "asymmetric_viscous": (asymmetric_viscous, "3", {"Fva3": 0.6}),
    "position_friction": (position_friction, "1", {"Fpc1": 1.351, "Fps1": 2.104}),
    "spring": (spring, "3", {}),
    "drift": (drift, "2", {"Dr2": 0.08}),
    "motor_ripple": (motor_ripple, "2", {"m": 101.0}),
}  # fmt: skip


def found(case: Case, torque: Callable[[Log], np.ndarray], **options: object) -> Diagnosis:
    model, train, holdout = case.hidden(torque)
    return diagnose(model, case.compiled, [train], [holdout], **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("effect", NAMED)
def test_a_hidden_effect_is_named_with_its_values(case: Case, effect: str) -> None:
    torque, joint, values = NAMED[effect]
    diagnosis = found(case, torque)
    first = diagnosis.effects[0]
    assert (first.effect, first.joint) == (effect, joint)
    assert diagnosis.verdict == "missing"
    assert first.error_after < 0.6 * first.error_before
    for name, value in values.items():
        assert first.parameters[name] == pytest.approx(value, rel=0.15), name


def test_nothing_is_named_where_nothing_is_hidden(case: Case) -> None:
    model = case.fitted(case.train)
    diagnosis = diagnose(model, case.compiled, [case.train], [case.holdout])
    assert diagnosis.verdict == "nothing significant"
    assert diagnosis.effects == ()
    assert ("payload", None) in diagnosis.blind_spots


def test_friction_that_vibration_smooths_mends_the_law_and_hides_nothing(case: Case) -> None:
    def smoothed(log: Log) -> np.ndarray:
        return -0.5 * stribeck(log)

    alone = found(case, smoothed)
    assert alone.effects == ()
    assert alone.verdict == "nothing significant"
    assert alone.sentences[0] == "nothing to add: a law that the model has can be refined"
    assert [(f.effect, f.joint) for f in alone.refinements] == [("stribeck", "2")]
    assert alone.refinements[0].parameters["Fst2"] < 0.0
    assert any("has not yet built up near standstill" in line for line in alone.sentences)
    both = found(case, lambda log: smoothed(log) + spring(log))
    assert [(f.effect, f.joint) for f in both.effects] == [("spring", "3")]
    assert [f.effect for f in both.refinements] == ["stribeck"]


def test_a_delay_is_named_and_its_sign_is_right(case: Case) -> None:
    def late(log: Log) -> np.ndarray:
        return np.roll(log.tau, 4, axis=0) - log.tau  # torques 4 ms after the motion

    first = found(case, late).effects[0]
    assert (first.effect, first.joint) == ("time_delay", None)
    assert first.parameters["dt"] == pytest.approx(-0.004, rel=0.25)


def test_a_load_since_the_fit_is_named_with_its_mass(case: Case, tmp_path: Path) -> None:
    """1.2 kg, 0.3 m along x of the last frame, in a simulation of its own."""
    text = load("demo-arm").text
    for name, more in {"M3": 1.2, "MX3": 0.36, "YY3": 0.108, "ZZ3": 0.108}.items():
        value = case.derivation.robot.parameters[name]
        text = re.sub(rf"(?m)^{name} = .*$", f"{name} = {value + more}", text)
    settings = SimulationSettings(duration=20.0, seed=8, torque_noise=0.01)
    write_log(tmp_path / "loaded.parquet", simulate(robot_from_text(text, "loaded"), settings))
    log = read_log(tmp_path / "loaded.parquet", case.compiled.spec)
    diagnosis = diagnose(case.fitted(case.train), case.compiled, [log])
    assert diagnosis.changed
    first = diagnosis.effects[0]
    assert (first.effect, first.joint) == ("payload", None)
    assert first.parameters["mass"] == pytest.approx(1.2, rel=0.1)


def test_a_contact_is_named_with_its_window(case: Case) -> None:
    def push(log: Log) -> np.ndarray:
        window = ((log.time > 12.0) & (log.time < 12.8)).astype(float)
        return np.outer(window, [6.0, -9.0, 4.0])

    model, train, _ = case.hidden(push)
    first = diagnose(model, case.compiled, [train]).effects[0]
    assert (first.effect, first.joint) == ("external_force", None)
    assert first.parameters["t0"] == pytest.approx(12.0, abs=0.2)
    assert first.parameters["t1"] == pytest.approx(12.8, abs=0.2)
    ruled_out = diagnose(model, case.compiled, [train], without=("external_force",))
    assert "external_force" not in {f.effect for f in ruled_out.effects}


def test_what_the_user_rules_out_is_not_named(case: Case) -> None:
    diagnosis = found(case, spring, without=("spring@3",))
    assert ("spring", "3") not in {(f.effect, f.joint) for f in diagnosis.effects}
    assert diagnosis.verdict != "missing", "what stands in for it is no fact"


def test_effects_that_fail_on_held_out_motion_are_not_named(case: Case) -> None:
    """A torque of the training run alone: whatever describes it there is vetoed."""
    model, train, _ = case.hidden(spring)
    diagnosis = diagnose(model, case.compiled, [train], [case.holdout])
    assert ("spring", "3") not in {(f.effect, f.joint) for f in diagnosis.effects}
    assert ("spring", "3") in {judged.candidate.key for judged in diagnosis.search.vetoed}
    told = [line for line in diagnosis.sentences if line.startswith("not named: spring")]
    assert len(told) == 1 and "that of motion left out does not surely fall" in told[0]


def test_a_cause_outside_the_catalogue_is_not_stated_as_a_fact(case: Case) -> None:
    """A torque of the product of two joints' speeds and positions, which no effect has."""

    def strange(log: Log) -> np.ndarray:
        q, v = motion(log)
        return on_joint(log, 1, 3.0 * np.sin(2.0 * q[:, 2]) * np.tanh(v[:, 0]) * np.cos(q[:, 1]))

    diagnosis = found(case, strange)
    assert diagnosis.verdict in ("closest description", "unexplained")


def test_a_drive_gain_is_a_matter_of_all_joints_that_share_parameters(case: Case) -> None:
    """Held-out errors of its own joint alone would veto it: the fit spreads it over others."""
    diagnosis = found(case, lambda log: on_joint(log, 2, -0.12 * log.tau[:, 2]))
    first = diagnosis.effects[0]
    assert (first.effect, first.joint) == ("drive_gain", "3")
    assert 1.0 / (1.0 - first.parameters["eps3"]) == pytest.approx(1.0 / 0.88, rel=0.02)
    assert diagnosis.verdict == "missing"


def test_a_brake_that_drags_now_and_then_is_no_noise(case: Case) -> None:
    def dragging(log: Log) -> np.ndarray:
        _, v = motion(log)
        on = np.sin(2.0 * log.time) > 0.6
        return on_joint(log, 1, 6.0 * on * np.tanh(v[:, 1] / 0.002))

    diagnosis = found(case, dragging)
    assert diagnosis.verdict in ("unexplained", "closest description")
    assert diagnosis.joints["2"].systematic > 0.5 * diagnosis.joints["2"].noise


def test_knocks_that_follow_nothing_are_told_and_not_named(case: Case) -> None:
    def knocks(log: Log) -> np.ndarray:
        random = np.random.default_rng(len(log.time)).normal(size=len(log.time))
        return on_joint(log, 0, 60.0 * random * (np.abs(np.sin(0.8 * log.time)) > 0.99))

    diagnosis = found(case, knocks)
    assert diagnosis.effects == ()
    assert diagnosis.verdict == "unexplained"
    assert any("comes in brief outbursts" in line for line in diagnosis.sentences)


def test_of_two_springs_on_levers_the_other_is_tried_where_one_is_ruled_out(case: Case) -> None:
    def gas(log: Log) -> np.ndarray:
        q, _ = motion(log)
        turn = q[:, 1] - 0.6
        return on_joint(log, 1, 25.0 * np.sin(turn) / np.sqrt(1.36 - 1.2 * np.cos(turn)))

    tied = found(case, gas).effects[0]
    assert tied.joint == "2"
    assert {tied.effect, *(effect for effect, _ in tied.ties)} >= {
        "counterbalance", "constant_force_spring"
    }  # fmt: skip
    alone = found(case, gas, without=("counterbalance",)).effects[0]
    assert (alone.effect, alone.joint) == ("constant_force_spring", "2")


def test_the_json_has_the_fields_that_scripts_read(case: Case) -> None:
    content = found(case, spring).to_json()
    assert {"verdict", "effects", "blind_spots", "joints"} <= content.keys()
    fields = {"effect", "joint", "gain", "error_before", "error_after", "parameters", "ties"}
    assert fields | {"evidence"} <= content["effects"][0].keys()
    assert content["joints"].keys() == {"1", "2", "3"}


def test_exchanged_and_reversed_channels_are_named_before_any_physics(case: Case) -> None:
    model = case.fitted(case.train)
    exchanged = dataclasses.replace(case.holdout, tau=case.holdout.tau[:, [1, 0, 2]])
    lines = " ".join(diagnose(model, case.compiled, [exchanged], most=0).data)
    assert "looks like that of joint" in lines
    reversed_ = dataclasses.replace(case.holdout, tau=case.holdout.tau * [1.0, 1.0, -1.0])
    lines = " ".join(diagnose(model, case.compiled, [reversed_], most=0).data)
    assert "joint 3: the measured torque has the other sign" in lines


def test_a_joint_that_never_moves_is_said(case: Case) -> None:
    model = case.fitted(case.train)
    q = case.holdout.q.copy()
    q[:, 0] = 0.3
    still = dataclasses.replace(case.holdout, q=q)
    lines = diagnose(model, case.compiled, [still], most=0).data
    assert any("joint 1 never moves" in line for line in lines)


def test_friction_that_would_drive_is_not_named(case: Case) -> None:
    """A torque that follows the direction and helps the motor at half of the poses."""

    def helping(log: Log) -> np.ndarray:
        q, v = motion(log)
        return on_joint(log, 1, 60.0 * np.cos(q[:, 1]) * np.tanh(v[:, 1] / 0.002))

    diagnosis = found(case, helping)
    assert not any(f.effect == "position_friction" for f in diagnosis.effects)
    assert any(
        "position_friction" in line and "would drive" in line for line in diagnosis.sentences
    )


def test_every_effect_tells_what_other_looks_say(case: Case) -> None:
    diagnosis = found(case, spring)
    looks = diagnosis.effects[0].looks
    assert [look.what for look in looks] == [
        "the held-out logs", "cut-offs x 0.7", "cut-offs x 1.4",
    ]  # fmt: skip
    assert all(look.agrees and look.leads == ("spring", "3") for look in looks)
    assert diagnosis.to_json()["effects"][0]["looks"][0]["leads"] == {
        "effect": "spring", "joint": "3",
    }  # fmt: skip
