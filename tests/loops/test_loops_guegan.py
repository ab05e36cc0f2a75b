"""The identification of Guegan 2003, section 5, simulated: ten motions, 2.5 ms, encoders, noise.

The simulated robot is as the paper concludes: links of the parallelograms too light to be seen.
"""

import re

import numpy as np
import pytest

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.core.builtin import builtin_text
from modeler.robot.read import robot_from_text
from modeler.simulation import SimulationSettings, simulate, write_log

# `test_methods.py` reproduces them too.
pytestmark = [pytest.mark.slow, pytest.mark.rotating("identifications of papers")]

NAME = "orthoglide-2003-similar-legs"
RUNS, SECONDS, RATE = 10, 4.0, 400.0
TRUTH = {"MP": 1.5, "Ia1": 6.9, "M1": 1.8, "Fv1": 84.0, "Fs1": 55.0, "Off1": -2.5}


def light_robot():
    """No bodies but the slides and the platform."""
    text = builtin_text(NAME)
    text = re.sub(r"^shared = .*\n", "", text, flags=re.M)
    empty = "\n".join(f'"{row}{{i}}" = []' for row in "247") + '\n"3{i}" = []\n'
    text = text.replace('"5{i}" = []\n', '"5{i}" = []\n' + empty)
    inertial = "\n".join(
        f'"{name}1{{i}}" = {TRUTH.get(name + "1", 0.0)}' for name in ("Ia", "M", "Fv", "Fs", "Off")
    )
    head = text[: text.index("[parameters]")]
    return robot_from_text(f"{head}[parameters]\nMP = {TRUTH['MP']}\n{inertial}\n", "light.toml")


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("guegan")
    found = []
    for seed in range(RUNS):
        settings = SimulationSettings(
            duration=SECONDS, rate=RATE, seed=seed, torque_noise=0.1, linear_resolution=1e-6
        )
        log = simulate(light_robot(), settings)
        write_log(folder / f"run{seed}.parquet", log)
        found.append((str(folder / f"run{seed}.parquet"), log))
    return found


@pytest.fixture(scope="module")
def whole(logs):
    """The full model of 23 parameters, fitted: its compiled robot and its fit."""
    derivation = derive(load(NAME))
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    model = fit(derivation, emitted, observe(compiled, [path for path, _ in logs]))
    return compiled, model.fit


def test_table_3_is_selected_from_the_full_model(whole):
    """Of 23 parameters the data ask for the 13 of Table 3, with its condition number and values."""
    _, found = whole
    reduced = found.essential
    truth = {"MPR": TRUTH["MP"]}
    for leg in "123":
        truth |= {f"Ia1{leg}R": TRUTH["Ia1"] + TRUTH["M1"], f"Fv1{leg}": TRUTH["Fv1"]}
        truth |= {f"Fs1{leg}": TRUTH["Fs1"], f"Off1{leg}": TRUTH["Off1"]}
    truth["Off13R"] = truth.pop("Off13") - 9.81 * TRUTH["M1"]
    values = {p.name: p for p in reduced.parameters}
    assert len(found.parameters) == 23 and values.keys() == truth.keys()
    off = {n: (p.value - truth[n]) / p.sigma for n, p in values.items()}
    assert {n: z for n, z in off.items() if abs(z) > 3} == {}
    for name, largest in {"Ia11R": 0.01, "Fv11": 0.02, "Fs11": 0.02, "MPR": 0.1}.items():
        assert values[name].sigma < largest * abs(truth[name])
    assert found.condition_number > 1e4 and reduced.condition_number < 150.0
    assert reduced.relative_error == pytest.approx(found.relative_error, rel=1e-2)
    full = {p.name: p for p in found.parameters}
    assert values["MPR"].sigma < 0.5 * full["MPR"].sigma  # what the four of Table 2 blur


def test_with_all_23_the_noise_grows_along_one_direction(logs, whole):
    """(ZZ2, MX2, XX3, MX4) = (2 D4, 1, -D4, -1): Table 2 of the paper, divided by its MX2."""
    compiled, found = whole[0], {p.name: p for p in whole[1].parameters}
    assert len(found) == 23
    W = np.concatenate(
        [compiled.observation(log.truth.q, log.truth.qd, log.truth.qdd) for _, log in logs]
    )
    names = [base.name for base in compiled.spec.base]
    weakest = np.linalg.svd(W, full_matrices=False)[2][-1]
    weakest = weakest / weakest[names.index("MX2")]
    along = {n: weakest[names.index(n)] for n in ("ZZ2R", "MX2", "XX3R", "MX4")}
    D4 = 0.31
    expected = {"ZZ2R": 2 * D4, "MX2": 1.0, "XX3R": -D4, "MX4": -1.0}
    for name, value in expected.items():
        assert along[name] == pytest.approx(value, rel=0.1)
    others = [abs(v) for n, v in zip(names, weakest, strict=True) if n not in expected]
    assert max(others) < 0.1
    table_2 = {"ZZ2R": -2.8560, "MX2": -4.6706, "XX3R": 1.5458, "MX4": 4.5554}
    for name, value in table_2.items():
        assert value / table_2["MX2"] == pytest.approx(along[name], abs=0.05)
    # The truth of all four is 0, and the fit does not claim to know them.
    for name in expected:
        assert abs(found[name].value) < 4 * found[name].sigma
        assert found[name].sigma > 20 * found["MY3R"].sigma
