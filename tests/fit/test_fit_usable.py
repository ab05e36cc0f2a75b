"""No false alarm: good logs of built-in robots of every kind are usable."""

import pytest

from modeler.api import observe
from modeler.estimation.identify import identify
from modeler.estimation.verdict import with_verdict
from modeler.observation.low_speed import shafts
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.modules import compiled, module
from tests.robots import ROBOTS
from tests.rotation import ROTATING

VAGUE = {"delta", "orthoglide-2003", "orthoglide-2012"}
"""Robots whose legs move so alike that sums of their parameters are known, not the values."""

ALIKE = {
    "evra", "lwr", "odrive", "orthoglide-2003-similar-legs", "orthoglide-leg-tree", "panda", "rx90",
    "sr400-tree", "tx40",
}  # fmt: skip
"""Robots for which others of their kind stand."""

KINDS = ("demo-arm", "emps", "five-bar", "wrist-coupled")


@pytest.mark.parametrize(
    "name",
    [n if n in KINDS else pytest.param(n, marks=ROTATING)
     for n in ROBOTS if n not in ALIKE],
)  # fmt: skip
def test_a_good_log_of_a_built_in_robot_is_usable(name, tmp_path):
    settings = SimulationSettings(duration=20.0, rate=300.0, seed=72)
    write_log(tmp_path / "a.parquet", simulate(module(name).model.robot, settings))
    observation = observe(compiled(name), [tmp_path / "a.parquet"])
    verdict = with_verdict(compiled(name), observation, identify(observation)).verdict
    assert verdict.usable
    assert verdict.valid_for == ("prediction" if name in VAGUE else "parameters"), verdict.line


def test_loops_that_close_near_home_only_have_shafts_too():
    assert shafts(compiled("3rrr")) == ()
