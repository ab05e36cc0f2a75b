"""A channel of another time than the rest is named, with its delay; physics is not called late."""

import dataclasses

import numpy as np
import pytest
from scipy.signal import lfilter

from modeler.estimation.findings import log_findings
from modeler.observation.observe import observe
from modeler.observation.read import read_log
from modeler.simulation import SimulationSettings, hidden_from_text, simulate, write_log
from tests.modules import compiled, module
from tests.rotation import ROTATING

RATE = 200.0


def late_channels(machine, observation):
    every = [found.line for found in log_findings(machine, observation)]
    return [line for line in every if "late" in line or "filter" in line]


def observed(folder, name, seed, hidden=(), lagged=((), 0.0), **late):
    """An observation of a simulated log; late: {column of `Log`: (joints, samples)}.

    lagged: joints whose torque passes a filter, and its time constant, s.
    """
    settings = SimulationSettings(
        duration=10.0, rate=RATE, seed=seed, hidden=tuple(hidden_from_text(h) for h in hidden)
    )
    write_log(folder / "log.parquet", simulate(module(name).model.robot, settings))
    log = read_log(folder / "log.parquet", compiled(name).spec)
    tau = log.tau.copy()
    for j in lagged[0]:
        late_by = lagged[1] * RATE + 0.5  # samples; of the bilinear filter
        b, a = np.full(2, 0.5 / late_by), [1.0, 1.0 / late_by - 1.0]
        tau[:, j] = lfilter(b, a, tau[:, j], zi=[tau[0, j] * (1.0 - b[0])])[0]
    log = dataclasses.replace(log, tau=tau)
    for column, (joints, samples) in late.items():
        values = getattr(log, column).copy()
        for j in joints:
            values[samples:, j] = values[:-samples, j]
        log = dataclasses.replace(log, **{column: values})
    return observe(compiled(name), [log])


@pytest.mark.parametrize("name", ["demo-arm", pytest.param("puma560", marks=ROTATING)])
def test_whose_time_and_by_how_much(name, tmp_path):
    rng = np.random.default_rng([8, *name.encode()])
    c = compiled(name)
    n = len(c.spec.joints)
    for column, what in (("q", "position"), ("tau", "torque"), ("tau", "all")):
        joints = range(n) if what == "all" else [int(rng.integers(min(n, 3)))]
        samples = int(rng.integers(5, 17))
        told = late_channels(
            c, observed(tmp_path, name, int(rng.integers(1000)), **{column: (joints, samples)})
        )
        assert len(told) == 1
        whose = "all torques" if what == "all" else f"joint {c.spec.joints[joints[0]].name}: its"
        assert told[0].startswith(whose) and what in told[0] and " late, by" in told[0]
        ms = float(told[0].partition(" ms")[0].split()[-1])
        assert ms == pytest.approx(1e3 * samples / RATE, abs=5.0)


def test_a_filtered_torque_is_told_with_its_time_and_not_as_late(tmp_path):
    rng = np.random.default_rng(10)
    for joints, whose in (([1], "joint 2: its torque comes"), (range(3), "all torques come")):
        seconds = float(rng.uniform(0.03, 0.05))
        seen = observed(tmp_path, "demo-arm", int(rng.integers(1000)), lagged=(joints, seconds))
        (line,) = late_channels(compiled("demo-arm"), seen)
        assert line.startswith(f"{whose} through a first-order low-pass filter"), line
        ms = float(line.partition(" ms")[0].split()[-1])
        assert ms == pytest.approx(1e3 * seconds, rel=0.15)


EFFECTS = ("", "elasticity", "backlash", "cable_hysteresis", "counterbalance", "external_force")
MORE = ("stribeck", "presliding", "load_friction", "asymmetric_viscous", "payload", "motor_ripple")


@pytest.mark.parametrize(
    ("name", "hidden"),
    [("demo-arm", hidden) for hidden in EFFECTS]
    + [pytest.param("ur10e", hidden, marks=ROTATING) for hidden in EFFECTS[1::2] + MORE[::2]],
)
def test_physics_is_not_late(name, hidden, tmp_path):
    rng = np.random.default_rng([9, *name.encode(), *hidden.encode()])
    seen = observed(tmp_path, name, int(rng.integers(1000)), hidden=[hidden] if hidden else [])
    assert late_channels(compiled(name), seen) == []
