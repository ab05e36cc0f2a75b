"""A fit ends with a verdict: usable or not, what for, why, and what to do."""

import dataclasses
import json
import re

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate, identified, load, observe
from modeler.cli import main
from modeler.core.errors import ManifestError
from modeler.estimation.identify import identify
from modeler.estimation.model_file import load_model, save_model
from modeler.estimation.result import fit_from_json
from modeler.estimation.verdict import with_verdict
from modeler.observation import Doubt
from modeler.observation.read import read_log
from modeler.robot.read import robot_from_text
from modeler.simulation import HiddenEffect, SimulationSettings, simulate, write_log


@dataclasses.dataclass(frozen=True)
class Bench:
    """A robot, a good log of it, and how a log is fitted and judged."""

    folder: object
    derivation: object
    emitted: object
    compiled: object
    log: object

    def fit(self, log, **more):
        observation = observe(self.compiled, [log])
        return with_verdict(self.compiled, observation, identify(observation), **more)

    def verdict(self, log, **more):
        return self.fit(log, **more).verdict

    def model(self, log):
        observation = observe(self.compiled, [log])
        result = with_verdict(self.compiled, observation, identify(observation))
        return identified(self.derivation, self.emitted, observation, result)


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    folder = tmp_path_factory.mktemp("doubts")
    derivation = derive(load("demo-arm"))
    emitted = generate(derivation)
    settings = SimulationSettings(duration=12.0, rate=500.0, seed=4)
    write_log(folder / "a.parquet", simulate(derivation.robot, settings))
    log = read_log(folder / "a.parquet", emitted.spec)
    return Bench(folder, derivation, emitted, compile_model(emitted), log)


def rows(log, start, stop):
    parts = {name: getattr(log, name)[start:stop] for name in ("time", "q", "tau")}
    return dataclasses.replace(log, **parts)


def clock(log, factor):
    return dataclasses.replace(log, time=log.time * factor)


def test_a_good_fit_leaves_no_doubt(bench):
    verdict = bench.verdict(bench.log)
    assert (verdict.usable, verdict.valid_for, verdict.doubts) == (True, "parameters", ())
    assert verdict.line.startswith("Valid for torque prediction: cross-validated error at most ")
    assert verdict.line.endswith("Parameters are physically consistent.")
    assert verdict.warning() == []
    assert verdict.possible
    assert {one.state for one in verdict.by_joint.values()} == {"good"}
    assert all(", cross-validated error " in one.why[0] for one in verdict.by_joint.values())


@pytest.mark.parametrize(
    ("factor", "unit", "times"), [(1e3, "milliseconds", "0.001"), (1e6, "microseconds", "1e-06")]
)
def test_a_time_that_is_not_in_seconds(bench, factor, unit, times):
    verdict = bench.verdict(clock(bench.log, factor))
    assert not verdict.usable and verdict.valid_for == "nothing"
    assert f"median time step {0.002 * factor:.3g} s" in verdict.line
    assert f"in {unit}, the rows came at 500 Hz; multiply it by {times}" in verdict.line


def test_inertias_tell_the_unit_of_time_where_the_steps_do_not(bench):
    # 0.18 s: five rows a second, if it were true; gravity is a clock that nobody can set
    verdict = bench.verdict(clock(bench.log, 90.0))
    assert not verdict.usable
    assert verdict.line.startswith("Not valid: the clock seems to be wrong: ")
    told = float(verdict.line.split("motion were ")[1].split(" times")[0])
    assert 50.0 < told < 200.0


def test_minutes_are_a_doubt_about_values(bench):
    verdict = bench.verdict(clock(bench.log, 1.0 / 60.0))
    assert verdict.valid_for != "parameters"
    assert any("were the column time in minutes" in line for line in verdict.doubts)


def test_a_torque_with_the_wrong_sign(bench):
    tau = bench.log.tau.copy()
    tau[:, 1] *= -1.0
    verdict = bench.verdict(dataclasses.replace(bench.log, tau=tau))
    assert not verdict.usable
    assert verdict.line.startswith("Not valid: no machine that could be built has these values: ")
    assert "carried by" in verdict.line and "2" in verdict.line.split("carried by")[1]
    assert "% of the torque of joint 2, not " in verdict.line
    assert any("is negative, which physics does not allow" in line for line in verdict.doubts)
    assert verdict.possible is False
    assert (
        verdict.by_joint["2"].state == "undetermined"
        and verdict.line[11:] in verdict.by_joint["2"].why
    )


def test_torques_of_another_motion(bench):
    rolled = dataclasses.replace(bench.log, tau=np.roll(bench.log.tau, 800, axis=0))
    verdict = bench.verdict(rolled)
    assert not verdict.usable
    assert "is not described even on the data of the fit; check units, signs" in verdict.line


def test_too_few_rows(bench):
    result = bench.fit(rows(bench.log, 1000, 1800))
    assert result.relative_error < 0.3  # it looks like a fit
    assert not result.verdict.usable
    assert "not enough data for 25 parameters" in result.verdict.line
    assert "record a longer motion of all joints" in result.verdict.line


def test_a_joint_that_stands_still_leaves_the_prediction(bench):
    q, tau = bench.log.q.copy(), bench.log.tau.copy()
    q[:, 0], tau[:, 0] = q[0, 0], 0.0
    verdict = bench.verdict(dataclasses.replace(bench.log, q=q, tau=tau))
    assert verdict.valid_for != "parameters"
    assert any("and set aside; record a motion that moves" in line for line in verdict.doubts)
    assert verdict.by_joint["1"].state == "undetermined"
    assert "no row was fitted" in verdict.by_joint["1"].why


def test_values_that_stand_in_for_what_the_model_lacks(bench):
    # without Coulomb friction in the model: torques are foretold, and Fv is not the machine's
    lines = bench.derivation.robot.text.splitlines()
    kept = [line for line in lines if not re.match(r"Fs\d|coulomb", line)]
    derivation = derive(robot_from_text("\n".join(kept), "without"))
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    assert len(emitted.spec.base) == len(bench.emitted.spec.base) - 3
    observation = observe(compiled, [bench.log])
    verdict = with_verdict(compiled, observation, identify(observation)).verdict
    assert verdict.usable and verdict.valid_for == "prediction"
    stands_in = "the values of others stand in for it; `modeler diagnose` names it"
    assert any(stands_in in line for line in verdict.doubts)
    about = next(line for line in verdict.doubts if stands_in in line).split(":")[0]
    named = about.removeprefix("joint ").split(", ")
    assert all(verdict.by_joint[name].state == "doubtful" for name in named)


def test_a_joint_whose_halves_differ_is_doubtful_and_no_other(bench, tmp_path):
    # friction that grows with the load, which the model lacks, on joint 3 alone
    hidden = (HiddenEffect("load_friction", "3"),)
    settings = SimulationSettings(duration=16.0, rate=500.0, seed=9, hidden=hidden)
    write_log(tmp_path / "a.parquet", simulate(bench.derivation.robot, settings))
    verdict = bench.verdict(read_log(tmp_path / "a.parquet", bench.emitted.spec))
    assert verdict.by_joint["1"].state == "good"
    assert verdict.by_joint["3"].state == "doubtful"
    assert "`modeler diagnose`" in verdict.by_joint["3"].why[0]
    assert verdict.valid_for == "prediction" and "joint 3" in verdict.line


@pytest.mark.parametrize(
    "defect",
    [
        lambda log: dataclasses.replace(log, tau=log.tau * [1.0, 1.0, 2.0]),
        lambda log: dataclasses.replace(log, q=log.q * [1.0, 1.0, 2.0]),
        lambda log: dataclasses.replace(log, tau=log.tau + 0.06 * log.tau.std(axis=0)
                                        * np.sin(1.9 * log.time)[:, None]),
        lambda log: clock(log, 2.0),
    ],
    ids=["torque twice as large", "gear ratio", "a slow sway", "clock"],
)  # fmt: skip
def test_no_model_with_a_doubtful_joint_is_valid_for_its_parameters(bench, defect):
    verdict = bench.verdict(defect(bench.log))
    states = {one.state for one in verdict.by_joint.values()}
    assert states != {"good"} and verdict.valid_for != "parameters", (states, verdict.line)


def test_what_other_stages_tell_joins_in(bench):
    swapped = Doubt("joint 1 and 2: exchanged; exchange tau1 and tau2", True)
    verdict = bench.verdict(bench.log, told=[swapped])
    assert verdict.line == f"Not valid: {swapped.line}" and verdict.doubts == (swapped.line,)
    assert {one.state for one in verdict.by_joint.values()} == {
        "undetermined"
    }  # it is about all of them
    own = dataclasses.replace(swapped, about=("1", "2"))
    lights = {
        name: one.state for name, one in bench.verdict(bench.log, told=[own]).by_joint.items()
    }
    assert lights == {"1": "undetermined", "2": "undetermined", "3": "good"}
    vague = Doubt("joint 3: positions may be late", False)
    verdict = bench.verdict(bench.log, told=[vague])
    assert verdict.usable and vague.line in verdict.line
    assert {one.state for one in verdict.by_joint.values()} == {"good"}


def test_the_model_file_keeps_it_and_old_ones_have_none(bench, tmp_path):
    model = bench.model(clock(bench.log, 1e3))
    save_model(tmp_path / "m.json", model)
    again = load_model(tmp_path / "m.json")
    assert again.fit.verdict == model.fit.verdict
    assert again.warning == [f"the fit of this model is n{model.fit.verdict.line[1:]}"]
    raw = model.fit.to_json()
    assert raw["usable"] is False and raw["doubts"] and raw["valid_for"] == "nothing"
    for name in ("usable", "valid_for", "verdict", "doubts"):
        del raw[name]
    old = fit_from_json(raw, model.fit.covariance)
    assert old.verdict is None
    assert dataclasses.replace(model, fit=old).warning == []
    with pytest.raises(ManifestError, match=r"verdict.usable is .yes., expected true"):
        fit_from_json({**model.fit.to_json(), "usable": "yes"}, model.fit.covariance)


def test_every_command_that_takes_the_model_says_so(bench, tmp_path, capsys):
    tau = bench.log.tau.copy()
    tau[:, 1] *= -1.0
    lines = ["time,q1,q2,q3,tau1,tau2,tau3"]
    every = zip(bench.log.time, bench.log.q, tau, strict=True)
    lines += [",".join(f"{x:.9g}" for x in (t, *q, *u)) for t, q, u in every]
    (tmp_path / "log.csv").write_text("\n".join(lines), encoding="utf-8")
    log, model, out = (str(tmp_path / name) for name in ("log.csv", "m.json", "out.json"))
    assert main(["fit", "demo-arm", log, "--out", model, "--json", out]) == 0
    printed = capsys.readouterr().out
    assert sum(line.startswith("Not valid: ") for line in printed.splitlines()) == 1
    answer = json.loads((tmp_path / "out.json").read_text())
    assert answer["usable"] is False and answer["verdict"] in printed
    for command in (
        ["compare", model, log],
        ["diagnose", model, log],
        ["add", model, "stribeck", "--joint", "1", log, "--out", str(tmp_path / "m2.json")],
    ):
        assert main(command) == 0, command
        said = capsys.readouterr().out.splitlines()
        assert sum(line.startswith("the fit of this model is not valid: ") for line in said) == 1
