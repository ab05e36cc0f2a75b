"""A fit ends with a verdict: usable or not, what for, why, and what to do; no false alarms."""

import dataclasses
import json
import re

import numpy as np
import pytest

from modeler.api import assemble_model, observe
from modeler.cli import main
from modeler.codegen.workflow import Derivation
from modeler.core.errors import ManifestError
from modeler.estimation import find_log_faults, identify, judge_fit, load_model, save_model
from modeler.estimation.result import read_fit
from modeler.regression import DataWarning, Log
from modeler.regression.read import cut_rows
from modeler.robot.edit import replace_gravity
from modeler.robot.read import parse_robot_text, read_builtin_robot
from modeler.simulation import HiddenEffect, SimulationSettings, parse_hidden_effect, simulate
from tests.link_data import compiled as compiled_text
from tests.modules import compiled, module
from tests.robots import ROBOTS
from tests.rotation import ROTATING, rotating, with_cases


@pytest.fixture(scope="module")
def log():
    """A good log of the demonstration arm."""
    return log_of(SimulationSettings(duration=12.0, rate=500.0, seed=4))


def log_of(settings, robot=None):
    made = simulate(robot or module("demo-arm").model.robot, settings)
    return Log("a.parquet", made.joints, made.time, made.q, made.tau)


def observed_fit(log, machine=None, told=None):
    """The observation of a log, and the fit with its verdict; of the demonstration arm."""
    machine = machine or compiled("demo-arm")
    observation = observe(machine, [log])
    fit = identify(observation, "weighted", machine)
    return observation, judge_fit(machine, observation, fit, log_warnings=told or ())


def verdict_of(log, **more):
    return observed_fit(log, **more)[1].verdict


def clock(log, factor):
    return dataclasses.replace(log, time=log.time * factor)


def test_a_good_fit_leaves_no_doubt(log):
    verdict = verdict_of(log)
    assert (verdict.valid, verdict.valid_for, verdict.warnings) == (True, "parameters", ())
    assert verdict.line.startswith("Valid for torque prediction: cross-validated error at most ")
    assert verdict.line.endswith("Parameters are physically consistent.")
    assert verdict.format_warning() == []
    assert verdict.physically_consistent
    assert {one.state for one in verdict.by_joint.values()} == {"good"}
    assert all(", cross-validated error " in one.why[0] for one in verdict.by_joint.values())


def test_inertias_tell_the_unit_of_time_where_the_steps_do_not(log):
    # 0.18 s: five rows a second, if it were true; gravity is a clock that nobody can set
    verdict = verdict_of(clock(log, 90.0))
    assert not verdict.valid
    assert verdict.line.startswith("Not valid: the clock seems to be wrong: ")
    text = float(verdict.line.split("motion were ")[1].split(" times")[0])
    assert 50.0 < text < 200.0


def test_a_torque_with_the_wrong_sign(log):
    tau = log.tau.copy()
    tau[:, 1] *= -1.0
    spoilt = dataclasses.replace(log, tau=tau)
    verdict = verdict_of(spoilt)
    assert verdict.valid_for == "prediction"  # its torque is predicted as it is logged
    line = next(line for line in verdict.lines if line.startswith("not physically consistent: "))
    assert "2" in line.split("mainly from")[1]
    assert "% on joint 2, not " in line and line in verdict.by_joint["2"].why
    assert any("is negative, which physics does not allow" in line for line in verdict.lines)
    assert verdict.physically_consistent is False
    verdict = with_findings(spoilt).verdict
    assert verdict.line.startswith("Valid for prediction on joints 1, 3; joint 2 undetermined: ")
    assert "wrong sign" in verdict.line and verdict.by_joint["2"].cause == "torque_sign"
    assert verdict.format_warning() == [f"the fit of this model is v{verdict.line[1:]}"]


DEFECTS = {
    "milliseconds": (lambda log: clock(log, 1e3), "nothing", "median time step 2 s",
                     "rate would be 500 Hz; multiply the column time by 0.001"),
    "microseconds": (lambda log: clock(log, 1e6), "nothing", "median time step 2e+03 s",
                     "rate would be 500 Hz; multiply the column time by 1e-06"),
    "minutes": (lambda log: clock(log, 1.0 / 60.0), "", "in minutes, the rate would be"),
    "clock": (lambda log: clock(log, 2.0), ""),
    "torques of another motion": (
        lambda log: dataclasses.replace(log, tau=np.roll(log.tau, 800, axis=0)), "nothing",
        "is not described, even on the data of the fit; check units, signs"),
    "too few rows": (lambda log: cut_rows(log, slice(1000, 1800)), "nothing",
                     "cross-validated error above 50 %", "record the motion of `modeler excite`"),
    "torque twice as large":
        (lambda log: dataclasses.replace(log, tau=log.tau * [1.0, 1.0, 2.0]), ""),
    "gear ratio": (lambda log: dataclasses.replace(log, q=log.q * [1.0, 1.0, 2.0]), ""),
    "a slow sway": (lambda log: dataclasses.replace(
        log, tau=log.tau + 0.06 * log.tau.std(axis=0) * np.sin(1.9 * log.time)[:, None]), ""),
}  # fmt: skip
"""What is done to a log, what the model is valid for (empty: not for its parameters), words."""


@pytest.mark.parametrize("defect", DEFECTS)
def test_a_model_of_a_spoilt_log_is_not_valid_for_its_parameters(log, defect):
    change, valid_for, *words = DEFECTS[defect]
    verdict = verdict_of(change(log))
    assert verdict.valid_for == valid_for or (not valid_for and verdict.valid_for != "parameters")
    states = {one.state for one in verdict.by_joint.values()}
    assert ("good" in states) is (verdict.valid_for == "prediction")
    said = verdict.line if valid_for else "\n".join(verdict.lines)
    assert all(word in said for word in words), said


def test_a_joint_that_stands_still_leaves_the_prediction(log):
    q, tau = log.q.copy(), log.tau.copy()
    q[:, 0], tau[:, 0] = q[0, 0], 0.0
    fit = observed_fit(dataclasses.replace(log, q=q, tau=tau))[1]
    verdict, aside = fit.verdict, [p for p in fit.parameters if p.status == "set aside"]
    assert fit.status == "rank deficient" and aside
    for one in aside:
        assert one.value == 0.0 and one.sigma is None and not one.essential
        assert any(line.startswith(one.name) and "set aside" in line for line in fit.format_lines())
    assert verdict.valid_for != "parameters"
    assert any("record a motion that moves all joints" in line for line in verdict.lines)
    assert verdict.by_joint["1"].state == "undetermined" and verdict.needs_motion
    assert verdict.line.startswith(
        "Valid for prediction on joints 2, 3; joint 1 undetermined: too little motion in these "
    )


def test_values_that_stand_in_for_what_the_model_lacks(log):
    # without Coulomb friction in the model: torques are predicted, and Fv is not the machine's
    lines = read_builtin_robot("demo-arm").splitlines()
    model = compiled_text("\n".join(x for x in lines if not re.match(r"Fs\d|coulomb", x)))
    assert len(model.spec.base) == len(compiled("demo-arm").spec.base) - 3
    observation = observe(model, [log])
    verdict = judge_fit(model, observation, identify(observation)).verdict
    assert verdict.valid and verdict.valid_for == "prediction"
    stands_in = "an effect is missing, and values absorb it; run `modeler diagnose`"
    named = [one.joint for one in verdict.warnings if one.code == "systematic_residual"]
    assert named and all(stands_in in verdict.by_joint[name].why[1] for name in named)


@pytest.mark.rotating("long tests of fit")
def test_values_of_a_joint_whose_halves_differ_are_doubtful_and_of_no_other():
    # friction that grows with the load, which the model lacks, on joint 3 alone
    hidden = (HiddenEffect("load_friction", "3"),)
    settings = SimulationSettings(duration=16.0, rate=500.0, seed=9, hidden=hidden)
    verdict = verdict_of(log_of(settings))
    (why,), (_, *about) = (verdict.by_joint[name].why for name in "13")
    assert why.startswith("fit error ") and any("`modeler diagnose`" in line for line in about)
    assert verdict.valid_for == "prediction" and "joint 3" in verdict.line


def test_what_other_stages_tell_joins_in(log):
    swapped = DataWarning("joint 1 and 2: exchanged; exchange tau1 and tau2", True)
    verdict = verdict_of(log, told=[swapped])
    assert verdict.line == f"Not valid: {swapped.line}" and verdict.lines == [swapped.line]
    states = {one.state for one in verdict.by_joint.values()}
    assert states == {"undetermined"}  # it is about all of them
    local = dataclasses.replace(swapped, joints=("1", "2"))
    by_joint = verdict_of(log, told=[local]).by_joint
    assert [by_joint[name].state for name in "123"] == ["undetermined", "undetermined", "good"]
    vague = DataWarning("joint 3: positions may be late", False)
    verdict = verdict_of(log, told=[vague])
    assert verdict.valid and vague.line in verdict.line
    assert {one.state for one in verdict.by_joint.values()} == {"good"}


def test_the_model_file_keeps_it_and_old_ones_have_none(log, tmp_path):
    items, arm = observed_fit(clock(log, 1e3)), module("demo-arm")
    derivation = Derivation(arm.model.robot, arm.model, arm.base)
    model = assemble_model(derivation, arm.emitted, *items)
    save_model(tmp_path / "m.json", model)
    again = load_model(tmp_path / "m.json")
    assert again.fit.verdict == model.fit.verdict
    assert again.warning == [f"the fit of this model is n{model.fit.verdict.line[1:]}"]
    raw = model.fit.to_json()
    assert raw["valid"] is False and raw["warnings"] and raw["valid_for"] == "nothing"
    for name in ("valid", "valid_for", "verdict", "warnings"):
        del raw[name]
    old = read_fit(raw, model.fit.covariance)
    assert old.verdict is None
    assert dataclasses.replace(model, fit=old).warning == []
    with pytest.raises(ManifestError, match=r"verdict.valid is .yes., expected true"):
        read_fit({**model.fit.to_json(), "valid": "yes"}, model.fit.covariance)


@pytest.mark.rotating("long tests of fit")
def test_every_command_that_takes_the_model_says_so(log, tmp_path, capsys):
    tau = log.tau.copy()
    tau[:, 1] *= -1.0
    table = np.column_stack([log.time, log.q, tau])
    head = "time,q1,q2,q3,tau1,tau2,tau3"
    np.savetxt(tmp_path / "log.csv", table, "%.9g", ",", header=head, comments="")
    log, model, out = (str(tmp_path / name) for name in ("log.csv", "m.json", "out.json"))
    lines = printed(capsys, f"fit demo-arm {log} --out {model} --json {out}")
    partly = "alid for prediction on joints 1, 3; joint 2 undetermined: the measured torque "
    assert sum(line.startswith(f"V{partly}") for line in lines) == 1
    answer = json.loads((tmp_path / "out.json").read_text())
    assert answer["valid_for"] == "prediction" and answer["verdict"] in "\n".join(lines)
    assert answer["joints"]["2"]["state"] == "undetermined"
    assert answer["warnings"][0]["code"] == "torque_sign" and answer["warnings"][0]["joint"] == "2"
    for command in (
        f"compare {model} {log}",
        f"diagnose {model} {log}",
        f"add {model} stribeck --joint 1 {log} --out {tmp_path}/m2.json",
    ):
        said = printed(capsys, command)
        assert sum(line.startswith(f"the fit of this model is v{partly}") for line in said) == 1


TOLD = "differs significantly between samples"


def fit_and_errors(name, seed, hide=None, rate=500.0):
    """A fit, and the errors of its values in sigmas, by name."""
    hidden = () if hide is None else (parse_hidden_effect(hide),)
    settings = SimulationSettings(
        duration=12.0, rate=rate, seed=seed, hidden=hidden, parameter_seed=seed
    )
    made = simulate(module(name).model.robot, settings)
    fit, errors = observed_fit(made, compiled(name))[1], {}
    for base, item in zip(compiled(name).spec.base, fit.parameters, strict=True):
        value = sum(x.value * made.truth.parameters.get(x.parameter, 0.0) for x in base.terms)
        errors[base.name] = abs(item.value - value) / item.sigma
    return fit, errors


# Without the halves, the worst friction value is this many sigmas off: 12.4, 11.2, 7.5.
BIASED = [
    ("emps", 1, "stribeck"),
    *rotating(("demo-arm", 1, "load_friction"), ("demo-arm", 1, "position_friction")),
]


@pytest.mark.parametrize(("name", "seed", "effect"), BIASED)
def test_a_missing_effect_is_in_the_sigmas_of_what_carries_it(name, seed, effect):
    fit, errors = fit_and_errors(name, seed, effect)
    assert max(error for who, error in errors.items() if who.startswith("F")) < 4.0
    (lines,) = (line for line in fit.sentences if TOLD in line)
    assert "`modeler diagnose`" in lines


def printed(capsys, words):
    assert main(words.split()) == 0
    return capsys.readouterr().out.splitlines()


def test_the_terminal_ends_with_the_verdict_and_the_command_to_go_on_with(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    for name, words in (("good", ""), ("poor", " --hide stribeck")):
        record = f"simulate emps --duration 10 --rate 250 --seed 3 --out {name}.parquet"
        printed(capsys, record + words)
    *_, verdict, following = printed(capsys, "fit emps good.parquet --out m.json --report m.html")
    assert verdict.startswith("Valid for torque prediction: ")
    assert following == "next: modeler compare m.json good.parquet --report compare.html"
    assert following.removeprefix("next: ") in (tmp_path / "m.html").read_text()
    *text, verdict, following = printed(capsys, "fit emps poor.parquet --out p.json")
    assert verdict.startswith("Valid for torque prediction on similar motions only: ")
    assert following == "next: modeler diagnose p.json poor.parquet --report diagnosis.html"
    assert sum(line.startswith("parameter ") for line in text) == 1  # one table


DOWN = np.array([0.0, 0.0, -9.81])


def arm(gravity, name="demo-arm"):
    return replace_gravity(read_builtin_robot(name), [float(g) for g in gravity])


def log_under(gravity, name="demo-arm"):
    """A log of the arm where gravity is another."""
    settings = SimulationSettings(duration=12.0, rate=250.0, seed=4, torque_noise=0.02)
    return log_of(settings, parse_robot_text(arm(gravity, name), "arm"))


def with_findings(log, machine=None):
    machine = machine or compiled("demo-arm")
    return observed_fit(log, machine, find_log_faults(machine, observe(machine, [log])))[1]


@with_cases(
    "factor, words, name",
    (-1.0, "zero off by 180 degrees", "demo-arm"),
    *rotating((0.0, "the torques carry no gravity", "demo-arm")),
    *rotating(*((k, f"the torques carry {k:g} times the grav", "puma560") for k in (0.1, 2.0))),
)
def test_a_factor_of_gravity_is_named_and_no_clock(factor, words, name):
    verdict = with_findings(log_under(factor * DOWN, name), compiled(name)).verdict
    assert verdict.valid_for == "nothing" and words in verdict.line
    assert "clock" not in verdict.line and (factor != -1.0 or "alpha" in verdict.line)


TILTED = 9.81 * np.array([np.sin(1.0), 0.0, -np.cos(1.0)])


@pytest.mark.parametrize(("of_log", "of_file"), [(TILTED, DOWN), *rotating((DOWN, 0.0 * DOWN))])
def test_gravity_along_another_axis_is_named_with_its_direction(of_log, of_file):
    line = with_findings(log_under(of_log), compiled_text(arm(of_file))).verdict.line
    assert of_file is not DOWN or "gravity of the robot file, [0.0, 0.0, -9.8] m/s2, does" in line
    asked = line.partition("about [")[2].partition("]")[0].split(", ")
    np.testing.assert_allclose([float(x) for x in asked], of_log, atol=0.3)


@pytest.mark.rotating("long tests of fit")
def test_a_small_tilt_of_the_base_is_left_to_diagnosis():
    fit = with_findings(log_under(9.81 * np.array([np.sin(0.1), 0.0, -np.cos(0.1)])))
    assert "gravity of the robot file" not in fit.verdict.line
    assert fit.verdict.valid_for != "parameters" and fit.verdict.warnings


VAGUE = {"delta", "orthoglide-2003", "orthoglide-2012"}
"""Robots whose legs move so alike that sums of their parameters are known, not the values."""

ALIKE = set(
    """
    evra lwr odrive orthoglide-2003-similar-legs orthoglide-leg-tree panda rx90 sr400-tree tx40
""".split()
)
"""Robots for which others of their kind stand."""

QUICK = ["emps", "five-bar", *rotating("wrist-coupled")]


@with_cases(
    "name",
    *QUICK,
    *(
        pytest.param(n, marks=ROTATING)
        for n in ROBOTS
        if n not in {*ALIKE, "emps", "five-bar", "wrist-coupled"}
    ),
)
def test_a_good_log_of_a_built_in_robot_is_usable(name):
    settings = SimulationSettings(duration=20.0, rate=200.0, seed=72)
    log = log_of(settings, module(name).model.robot)
    verdict = observed_fit(log, compiled(name))[1].verdict
    assert verdict.valid
    assert verdict.valid_for == ("prediction" if name in VAGUE else "parameters"), verdict.line
