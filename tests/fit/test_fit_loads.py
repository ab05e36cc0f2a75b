"""Loads: friction that grows with them, the force of a known one, one of unknown mass.

Of two arms on a torso that turns upright, no torque separates a load's mass from its inertia: joint
3 swings it at the distance B from the torso's axis; its mass enters only there, as B^2 M3 + YY3.
"""

import json
import re
from dataclasses import make_dataclass

import numpy as np
import pytest

from modeler.api import fit, observe
from modeler.api.workflow import compile
from modeler.cli import main
from modeler.codegen.workflow import Derivation
from modeler.core.errors import DataError
from modeler.estimation import Payload, add_known_load, load_model, save_model
from modeler.regression.log import Log
from modeler.simulation import SimulationSettings, parse_hidden_effect, simulate
from modeler.validation import compare, predict
from tests.modules import compiled, module, plain
from tests.rotation import rotating, with_cases

MASS = 2.0


@pytest.fixture(scope="module")
def arm():
    model, base, emitted = module("demo-arm")
    return Derivation(model.robot, model, base), emitted, compiled("demo-arm")


def run(arm, seed, name, payload=False, coulomb=0.0):
    """A log of 10 s; `coulomb` N m more on every joint."""
    hidden = (parse_hidden_effect(f"payload:mass={MASS}"),) if payload else ()
    settings = SimulationSettings(duration=10.0, rate=250.0, seed=seed, hidden=hidden)
    made = simulate(arm[0].robot, settings)
    moves = np.tanh(np.gradient(made.q, made.time, axis=0) / 0.01)
    return Log(name, made.joints, made.time, made.q, made.tau + coulomb * moves)


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize(("seed", "more"), [(1, 0.0), (3, 1.2)])
def test_what_is_told_is_the_model_that_is_written(arm, tmp_path, seed, more):
    """Oracle: `compare` of the written file on the bare log."""
    logs = [run(arm, seed, "bare"), run(arm, seed + 10, "loaded", True, more)]
    model = fit(*arm[:2], observe(arm[2], logs), payloads=[Payload(("loaded",), mass=MASS)])
    save_model(tmp_path / "m.json", model)
    read = load_model(tmp_path / "m.json")
    seen = compare(predict(read, logs[:1], compile(read))[0])
    bare = {joint.name: joint.relative_error for joint in read.fit.by_load["bare"]}
    for joint in seen.joints:
        assert bare[joint.joint.name] == pytest.approx(joint.relative_error, rel=0.05)
    worst = 100.0 * max(joint.relative_error for joint in seen.joints)
    text = re.search(r"at most ([\d.]+) % bare and ([\d.]+) % loaded", read.fit.verdict.line)
    assert text, read.fit.verdict.line
    assert 0.95 * worst < float(text[1]) < 1.5 * worst
    assert read.fit.verdict.valid_for == ("parameters" if more == 0.0 else "prediction")


Value, Fit, Model = (
    make_dataclass(name, fields)
    for name, fields in (("Value", ["value"]), ("Fit", ["parameters"]), ("Model", ["spec", "fit"]))
)


def bare(name, seed):
    """A compiled robot, and as much of a model as a load is added to."""
    compiled = plain(name)
    values = np.random.default_rng(seed).normal(size=len(compiled.spec.base))
    return compiled, Model(compiled.spec, Fit(tuple(map(Value, values))))


def moved(compiled, row, c, q):
    """(n, 3) place of the point c of a link, in frame 0."""
    pose = compiled.forward_kinematics(q)[:, row]
    return pose[:, :, :3] @ c + pose[:, :, 3]


CASES = [
    ("five-bar", "22", (0, -9.81, 0), 0.05),
    ("puma560", "6", (0, 0, -9.81), 0.8),
    *rotating(("orthoglide-2012", "6", (0, 9.81, 0), 0.01)),
]


@pytest.mark.parametrize(("name", "link", "g", "reach"), CASES)
def test_the_load_takes_the_force_of_a_point_mass(name, link, g, reach):
    """J'm (a - g), by differences of the place of the point along q(t) and by each joint."""
    compiled, model = bare(name, 3)
    rng, mass, c = np.random.default_rng(7), 1.7, np.array([0.03, -0.05, 0.08])
    closure = compiled.spec.closure
    home = 0.0 if closure is None else np.array(closure.home)[list(closure.actuated)]
    n, joints = 6, len(compiled.spec.joints)
    q, qd, qdd = (home * k + reach * rng.uniform(-1, 1, (n, joints)) for k in (1, 0, 0))
    row, h = [joint.name for joint in module(name).model.robot.moving_joints].index(link), 1e-4
    place = [moved(compiled, row, c, q + t * qd + 0.5 * t * t * qdd) for t in (-h, 0.0, h)]
    a = (place[0] - 2 * place[1] + place[2]) / h**2
    two = [[moved(compiled, row, c, q + s * h * e) for s in (1, -1)] for e in np.eye(joints)]
    J = np.stack([(ahead - behind) / (2 * h) for ahead, behind in two], axis=2)
    expected = np.einsum("nxj,nx->nj", J, mass * (a - np.array(g)))
    loaded = add_known_load(model, mass, c)  # the link that carries is found
    change = np.array([p.value for p in loaded.fit.parameters])
    change -= [p.value for p in model.fit.parameters]
    actual = compiled.base_regressor(q, qd, qdd) @ change
    np.testing.assert_allclose(actual, expected, atol=2e-5 * np.abs(expected).max())


@with_cases(
    "mass, centre, link, text",
    (0.0, (0, 0, 0), None, "got 0 kg at 0, 0, 0; expected a mass above 0"),
    *((1.0, centre, None, "x, y, z of its centre") for centre in ((0, 0, np.inf), (0, 0))),
    (1.0, (0, 0, 0), "9", "no link 9; puma560 has 1, 2, 3, 4, 5, 6"),
)
def test_what_can_be_no_load_is_refused(mass, centre, link, text):
    with pytest.raises(DataError, match=text):
        add_known_load(bare("puma560", 1)[1], mass, centre, link)


B, UNTOLD = 0.3, 1.2
TORSO = f"""
name = "torso"
gravity = [0, 0, -9.81]
effects = {{viscous = "all", coulomb = "all"}}
limits = {{1 = [-2, 2, 3, 15], 2 = [-2, 2, 3, 15], 3 = [-2, 2, 3, 15]}}
[mdh]
columns = ["j", "a", "gamma", "b", "alpha", "d", "theta"]
rows = [
  ["1", "0", 0, 0, 0, 0, "q1"],
  ["2", "1", 0, 0.5, "pi/2", {B}, "q2"],
  ["3", "1", "pi", 0.5, "pi/2", {B}, "q3"],
]
"""


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("torso")
    (folder / "torso.toml").write_text(TORSO)
    return simulated(folder)


def simulated(folder, gains=""):
    """The folder, with a bare log of the torso and a loaded one in it."""
    for name, words in (("bare", "--seed 1"), ("loaded", f"--seed 2 --hide payload:mass={UNTOLD}")):
        made = f"simulate {folder}/torso.toml --duration 10 --rate 150 {gains} {words} --out"
        assert main([*made.split(), f"{folder}/{name}.parquet"]) == 0
    return folder


def fit_loaded(folder, words):
    base = f"fit {folder}/torso.toml {folder}/bare.parquet --payload-log {folder}/loaded.parquet"
    return main(f"{base} {words} --out {folder}/m.json".split())


@pytest.mark.rotating("long tests of fit")
def test_drive_gains_are_refused_where_the_mass_is_not_told(tmp_path, capsys):
    (tmp_path / "torso.toml").write_text(TORSO)
    simulated(tmp_path, "--drive-gain 1=10 --drive-gain 2=1 --drive-gain 3=1.5")
    assert fit_loaded(tmp_path, f"--payload-mass {UNTOLD} --method tls") == 1
    assert "the weight of the known load is not identifiable" in capsys.readouterr().err


@pytest.mark.rotating("long tests of fit")
def test_a_mass_that_is_not_told_is_not_tested_and_a_sum_is_called_a_sum(logs):
    for mass in (UNTOLD, 1.5 * UNTOLD):
        assert fit_loaded(logs, f"--payload-mass {mass} --json {logs}/f.json") == 0
        data = json.loads((logs / "f.json").read_text())
        assert not any("weighs" in doubt["text"] for doubt in data["warnings"])
        assert f"its mass of {mass:g} kg is taken as given" in "\n".join(data["sentences"])
    assert fit_loaded(logs, f"--json {logs}/f.json") == 0
    data = json.loads((logs / "f.json").read_text())
    loads = {load["name"]: load["value"] for load in data["loads"]}
    assert "M3_load" not in loads and loads["M3R_load"] > 1.1 * UNTOLD
    assert f"load: M3R_load = M3 + {1.0 / B**2:.4g}*YY3" in data["sentences"]
