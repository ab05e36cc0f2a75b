"""What physics does not allow is told; what it allows is not."""

import dataclasses

import numpy as np
import pytest

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.fit import doubts
from modeler.observation import read_log
from modeler.simulate import SimulationSettings, simulate, write_log


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("doubts")
    derivation = derive(load("demo-arm"))
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    settings = SimulationSettings(duration=8.0, rate=500.0, seed=4)
    write_log(folder / "a.parquet", simulate(derivation.robot, settings))
    log = read_log(folder / "a.parquet", emitted.spec)

    def result(log):
        return fit(derivation, emitted, observe(compiled, [log])).fit

    return emitted.spec, log, result


def test_a_good_fit_leaves_no_doubt(fitted):
    spec, log, result = fitted
    assert doubts(spec, result(log)) == ()


def test_a_torque_with_the_wrong_sign(fitted):
    spec, log, result = fitted
    tau = log.tau.copy()
    tau[:, 2] *= -1.0
    said = doubts(spec, result(dataclasses.replace(log, tau=tau)))
    assert any(line.startswith("Fs3 = -") and "physics does not allow" in line for line in said)
    assert any(line.startswith("joint 3: ") and "check units, signs" in line for line in said)


def test_torques_of_another_motion(fitted):
    spec, log, result = fitted
    said = doubts(spec, result(dataclasses.replace(log, tau=np.roll(log.tau, 800, axis=0))))
    assert any("is not described even on the data of the fit" in line for line in said)
