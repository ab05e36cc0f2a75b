"""Hand-written C under sanitizers, and an emitted folder that builds by itself."""

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.core.files import resource_dir
from tests.modules import STRICT, compiler

HERE = Path(__file__).resolve().parent


@pytest.mark.parametrize("cc", ["gcc", "clang"])
def test_runtime_under_sanitizers(cc, tmp_path):
    csrc = resource_dir("csrc")
    command = [compiler(cc), *STRICT, "-g", "-fsanitize=address,undefined"]
    command += ["-fno-sanitize-recover=all", "-I", csrc / "include", "-I", csrc]
    command += ["-o", tmp_path / "test"]
    command += [HERE / "test_runtime.c", *sorted(csrc.glob("*.c")), "-lm"]
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    if "cannot find" in built.stderr and "san" in built.stderr:
        pytest.skip(f"NOT CHECKED: {cc} has no sanitizer libraries")
    assert built.returncode == 0, built.stderr
    ran = subprocess.run([tmp_path / "test"], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stdout + ran.stderr


@pytest.mark.parametrize("flags", [["-O0"], ["-O2", "-march=native", "-ffp-contract=fast"]])
def test_sine_and_cosine_are_right_to_the_last_places(flags, tmp_path):
    """Against extended precision: everywhere, near multiples of pi/2, and where they are huge."""
    if np.finfo(np.longdouble).eps > 1e-18:
        pytest.skip("NOT CHECKED: no extended precision on this machine")
    source, library = tmp_path / "many.c", tmp_path / "many.so"
    source.write_text(
        '#include "modeler_sincos.h"\nvoid many(int n, const double *x, double *s, double *c);\n'
        "void many(int n, const double *x, double *s, double *c)\n"
        "{\n    for (int i = 0; i < n; i++) modeler_sincos(x[i], s + i, c + i);\n}\n"
    )
    include = resource_dir("csrc") / "include"
    command = [compiler("gcc"), *STRICT, *flags, "-shared", "-fPIC", "-I", include, "-o", library]
    subprocess.run([*command, source, "-lm"], check=True)
    rng = np.random.default_rng(1)
    quarters = rng.integers(-60_000, 60_000, 50_000) * (np.pi / 2)
    beside = quarters * (1 + rng.choice([-1, 1], 50_000) * 2.0 ** -rng.integers(20, 52, 50_000))
    edges = np.array([0.0, -0.0, 1e-300, 1e5, -1e5, np.nextafter(1e5, 0), 1e15, 1e300])
    for x, places in (
        (rng.uniform(-320, 320, 200_000), 1.6),
        (np.concatenate([rng.uniform(-1e5, 1e5, 200_000), quarters, beside, edges]), 2.5),
    ):
        sine, cosine = np.empty_like(x), np.empty_like(x)
        double_p = ctypes.POINTER(ctypes.c_double)
        arrays = (array.ctypes.data_as(double_p) for array in (x, sine, cosine))
        ctypes.CDLL(str(library)).many(len(x), *arrays)
        for got, function in ((sine, np.sin), (cosine, np.cos)):
            exact = function(x.astype(np.longdouble))
            unit = np.spacing(np.abs(exact).astype(float))
            assert float(np.max(np.abs(got - exact) / unit)) < places
    bad = np.array([np.nan, np.inf, -np.inf])
    sine, cosine = np.zeros(3), np.zeros(3)
    arrays = (array.ctypes.data_as(double_p) for array in (bad, sine, cosine))
    ctypes.CDLL(str(library)).many(3, *arrays)
    assert np.isnan(sine).all() and np.isnan(cosine).all()
