"""No false alarm: good logs of every built-in robot, and measured machines as an expert would."""

from pathlib import Path

import pytest

from modeler.api import compile_model, derive, generate, load, observe
from modeler.estimation.identify import identify
from modeler.estimation.verdict import with_verdict
from modeler.observation.low_speed import shafts
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.robots import ROBOTS

DATA = next(
    (p / "shared" / "data" for p in Path(__file__).resolve().parents
     if (p / "shared" / "data").is_dir()),
    None,
)  # fmt: skip

VAGUE = {"delta", "orthoglide-2003", "orthoglide-2012"}
"""Robots whose legs move so alike that sums of their parameters are known, not the values."""


def verdict_of(name, logs):
    emitted = generate(derive(load(name)))
    compiled = compile_model(emitted)
    observation = observe(compiled, logs)
    return with_verdict(compiled, observation, identify(observation)).verdict


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_a_good_log_of_a_built_in_robot_is_usable(name, tmp_path):
    robot = load(name)
    write_log(tmp_path / "a.parquet", simulate(robot, SimulationSettings(duration=20.0, seed=72)))
    verdict = verdict_of(name, [tmp_path / "a.parquet"])
    assert verdict.usable
    assert verdict.usable_for == ("like motion" if name in VAGUE else "physics"), verdict.line


@pytest.mark.parametrize("name", ["3rrr", "stewart"])
def test_loops_that_close_near_home_only_have_shafts_too(name):
    assert shafts(compile_model(generate(derive(load(name))))) == ()


MEASURED = {
    "emps": (["emps/train.parquet"], "physics", "a machine with these values"),
    "tx40": (["tx40/log_joint.parquet@0:4.6"], "physics", "a machine with these values"),
    "ur10e": (
        ["ur10e/ur-20_02_12-50sec_12harm.parquet", "ur10e/ur-20_02_05-20sec_8harm.parquet"],
        "physics", "a machine with these values",
    ),
    "kinova_gen3": (
        [f"kinova_gen3/traj_{i}.parquet" for i in (1, 3, 5)],
        "like motion", "is left and is no noise",
    ),
    "dvrk-psm": (["dvrk_psm/one.parquet"], "like motion", "is left and is no noise"),
    # the built-in robot has no friction
    "panda": (["panda/excitation.parquet"], "nothing", "joint 7: "),
    "odrive": (["odrive_cogging/slow2__nocomp_0.parquet"], "nothing", "joint 1: "),
}  # fmt: skip


@pytest.mark.measured
@pytest.mark.skipif(DATA is None, reason="no measured logs: shared/data is not beside us")
@pytest.mark.parametrize("name", MEASURED)
def test_a_measured_machine_gets_the_verdict_of_an_expert(name):
    logs, usable_for, words = MEASURED[name]
    verdict = verdict_of(name, [f"{DATA}/{log}" for log in logs])
    assert verdict.usable_for == usable_for, verdict.line
    assert words in verdict.line
    assert verdict.usable is (usable_for != "nothing")


@pytest.mark.measured
@pytest.mark.skipif(DATA is None, reason="no measured logs: shared/data is not beside us")
def test_a_log_of_one_joint_does_not_make_a_model_of_six():
    verdict = verdict_of("ur10e", [f"{DATA}/ur10e/ur-20_01_22-joint_5.parquet"])
    assert verdict.line.startswith("not usable: ")
    assert "not enough data for 58 parameters" in verdict.line
