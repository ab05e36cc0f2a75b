"""Friction that grows with the load: what a fit of bare and loaded logs tells is what it writes."""

import re

import numpy as np
import pytest

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.api.workflow import recompile
from modeler.estimation.model_file import load_model, save_model
from modeler.estimation.payload import Payload
from modeler.observation.log import Log
from modeler.simulation import SimulationSettings, hidden_from_text, simulate
from modeler.validation.comparison import compare
from modeler.validation.predict import predict

MASS = 2.0


@pytest.fixture(scope="module")
def arm():
    derivation = derive(load("demo-arm"))
    emitted = generate(derivation)
    return derivation, emitted, compile_model(emitted)


def run(arm, seed, name, payload=False, coulomb=0.0):
    """A log of 10 s; `coulomb` N m more on every joint."""
    hidden = (hidden_from_text(f"payload:mass={MASS}"),) if payload else ()
    settings = SimulationSettings(duration=10.0, rate=250.0, seed=seed, hidden=hidden)
    made = simulate(arm[0].robot, settings)
    moves = np.tanh(np.gradient(made.q, made.time, axis=0) / 0.01)
    return Log(name, made.joints, made.time, made.q, made.tau + coulomb * moves)


@pytest.mark.parametrize(("seed", "more"), [(1, 0.0), (2, 0.4), (3, 1.2)])
def test_what_is_told_is_the_model_that_is_written(arm, tmp_path, seed, more):
    """Oracle: `compare` of the written file on the bare log."""
    logs = [run(arm, seed, "bare"), run(arm, seed + 10, "loaded", True, more)]
    model = fit(*arm[:2], observe(arm[2], logs), payloads=[Payload(("loaded",), mass=MASS)])
    save_model(tmp_path / "m.json", model)
    read = load_model(tmp_path / "m.json")
    seen = compare(predict(read, logs[:1], recompile(read))[0])
    bare = {joint.name: joint.relative_error for joint in read.fit.by_load["bare"]}
    for joint in seen.joints:
        assert bare[joint.joint.name] == pytest.approx(joint.relative_error, rel=0.05)
    worst = 100.0 * max(joint.relative_error for joint in seen.joints)
    told = re.search(r"at most ([\d.]+) % bare and ([\d.]+) % loaded", read.fit.verdict.line)
    assert told, read.fit.verdict.line
    assert 0.95 * worst < float(told[1]) < 1.5 * worst
    assert read.fit.verdict.valid_for == ("parameters" if more == 0.0 else "prediction")
