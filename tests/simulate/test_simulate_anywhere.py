"""A simulated measurement is the same on every machine, whatever its libraries round."""

import os
import subprocess
import sys
from pathlib import Path

import casadi as ca
import mpmath
import numpy as np
import pytest

from modeler.simulation.portable_math import (
    compute_exponential,
    compute_hyperbolic_tangent,
    compute_power,
    compute_sine_and_cosine,
    make_portable,
)

_WRITE = """
import sys
import numpy as np
from modeler.api.workflow import load
from modeler.simulation import SimulationSettings, parse_hidden_effect, simulate
found = {}
for text in sys.argv[2:]:
    name, *hidden = text.split()
    hidden = tuple(map(parse_hidden_effect, hidden))
    log = simulate(load(name), SimulationSettings(duration=2.0, rate=500.0, seed=9, hidden=hidden))
    found |= {f"{name} q": log.q, f"{name} tau": log.tau, f"{name} state": log.truth.q}
np.savez(sys.argv[1], **found)
"""
_CASES = (
    "demo-arm",  # stands upright: what is below one count grows by itself
    "ur10e load_friction elasticity encoder_eccentricity base_tilt",
    "wrist nonlinear_viscous cable_hysteresis temperature_friction",
    "five-bar payload",
)

# Variables that make libraries take the code of older processors; where the processor or the
# library knows none of it, they change nothing.
_OTHER = {
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX512VL",
    "OPENBLAS_CORETYPE": "Prescott",
    "NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL "
    "AVX512_SPR AVX2 FMA3",
    "NPY_ENABLE_CPU_FEATURES": "",
}


def measured(out: Path, environment: dict[str, str]) -> dict:
    command = [sys.executable, "-c", _WRITE, str(out), *_CASES]
    subprocess.run(command, check=True, env=os.environ | environment, capture_output=True)
    return dict(np.load(out))


@pytest.mark.slow
def test_logs_do_not_depend_on_the_processor(tmp_path):
    here = measured(tmp_path / "here.npz", {})
    assert len(here) == 3 * len(_CASES)
    other = measured(tmp_path / "other.npz", _OTHER)
    for name, values in here.items():
        # Noise has digits of the C library's logarithm, loops those of linear algebra.
        assert np.abs(other[name] - values).max() <= 1e-9 * np.abs(values).max(), name


def test_elementary_functions_against_many_digits():
    rng = np.random.default_rng(5)
    with mpmath.workdps(40):
        for x in [*rng.uniform(-1000, 1000, 300), *(np.arange(-40, 40) * np.pi / 4)]:
            s, c = compute_sine_and_cosine(float(x))
            assert abs(s - mpmath.sin(float(x))) < 3e-16
            assert abs(c - mpmath.cos(float(x))) < 3e-16
            e = compute_exponential(float(x) / 2)
            assert abs(e / mpmath.exp(float(x) / 2) - 1) < 5e-16
            assert abs(compute_hyperbolic_tangent(float(x) / 9) - mpmath.tanh(float(x) / 9)) < 4e-16
        for x, y in zip(10 ** rng.uniform(-10, 10, 300), rng.uniform(-2, 2, 300), strict=True):
            assert abs(compute_power(float(x), y) / mpmath.mpf(float(x)) ** y - 1) < 2e-14


def test_functions_of_expressions_are_those_of_numbers():
    x = ca.SX.sym("x", 2)
    column = ca.vertcat(
        ca.sin(x[0]), ca.cos(x[0]), ca.tan(x[0]), ca.tanh(x[1]), ca.exp(x[1]), ca.fabs(x[0]) ** 1.7
    )
    made = make_portable(ca.Function("f", [x], [column, ca.jacobian(column, x)]))
    rng = np.random.default_rng(6)
    for a, b in rng.uniform(-20, 20, (50, 2)):
        s, c = compute_sine_and_cosine(a)
        wanted = [
            s,
            c,
            s / c,
            compute_hyperbolic_tangent(b),
            compute_exponential(b),
            compute_power(abs(a), 1.7),
        ]
        assert np.array_equal(made([a, b])[0].full().ravel(), wanted)
    assert made.sparsity_out(1).nnz() == 6
