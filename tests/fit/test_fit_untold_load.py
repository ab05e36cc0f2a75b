"""A load whose mass no torque tells from its inertia: two arms on a torso that turns upright.

Joint 3 swings a load at the distance B from the torso's axis; its mass enters only there, as
B^2 M3 + YY3, since what it weighs in its own frame is its first moments'.
"""

import json

import pytest

from modeler.cli import main

B, MASS = 0.3, 1.2
ROBOT = f"""
name = "torso"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "a", "gamma", "b", "alpha", "d", "theta"]
rows = [
  ["1", "0", 0, 0, 0, 0, "q1"],
  ["2", "1", 0, 0.5, "pi/2", {B}, "q2"],
  ["3", "1", "pi", 0.5, "pi/2", {B}, "q3"],
]
[effects]
viscous = "all"
coulomb = "all"
[limits]
1 = [-2, 2, 3, 15]
2 = [-2, 2, 3, 15]
3 = [-2, 2, 3, 15]
"""


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("torso")
    (folder / "torso.toml").write_text(ROBOT)
    simulate = f"simulate {folder}/torso.toml --duration 10 --rate 250"
    gains = "--drive-gain 1=10 --drive-gain 2=1 --drive-gain 3=1.5"
    for name, words in (
        ("bare", "--seed 1"), ("loaded", f"--seed 2 --hide payload:mass={MASS}"),
        ("bare_i", f"--seed 1 {gains}"),
        ("loaded_i", f"--seed 2 {gains} --hide payload:mass={MASS}"),
    ):  # fmt: skip
        assert main(f"{simulate} {words} --out {folder}/{name}.parquet".split()) == 0
    return folder


def fit(folder, words, tail=""):
    base = f"fit {folder}/torso.toml {folder}/bare{tail}.parquet --payload-log "
    return main(f"{base}{folder}/loaded{tail}.parquet {words} --out {folder}/m.json".split())


def test_drive_gains_are_refused_where_the_mass_is_not_told(logs, capsys):
    assert fit(logs, f"--payload-mass {MASS} --method tls", "_i") == 1
    assert "or from the load's inertia" in capsys.readouterr().err


def test_a_mass_that_is_not_told_is_not_tested(logs, capsys):
    for mass in (MASS, 1.5 * MASS):
        assert fit(logs, f"--payload-mass {mass} --json {logs}/f.json") == 0
        told = json.loads((logs / "f.json").read_text())
        assert not any("weighs" in doubt for doubt in told["doubts"])
        assert f"its mass of {mass:g} kg is taken as given" in "\n".join(told["sentences"])


def test_a_sum_is_called_a_sum(logs):
    assert fit(logs, f"--json {logs}/f.json") == 0
    told = json.loads((logs / "f.json").read_text())
    loads = {load["name"]: load["value"] for load in told["loads"]}
    assert "M3_load" not in loads and loads["M3R_load"] > 1.1 * MASS
    assert f"load: M3R_load = M3 + {1.0 / B**2:.4g}*YY3" in told["sentences"]
