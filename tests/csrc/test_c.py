"""Hand-written C under sanitizers, and an emitted folder that builds by itself."""

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.core.files import locate_resources
from tests.modules import STRICT, compiler

HERE = Path(__file__).resolve().parent


@pytest.mark.parametrize("cc", ["gcc", pytest.param("clang", marks=pytest.mark.rotating)])
def test_runtime_under_sanitizers(cc, tmp_path):
    csrc = locate_resources("csrc")
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


FAST = ["-O2", "-march=native", "-ffp-contract=fast"]


def sines(x: np.ndarray, folder: Path, *flags: str) -> np.ndarray:
    """(2, n) sine and cosine of the C, in the precision of the angles."""
    single = x.dtype == np.float32
    number, library = "float" if single else "double", folder / f"{x.dtype}.so"
    if not library.exists():
        (folder / "many.c").write_text(f"""#include "modeler_sincos.h"
void many(int n, const {number} *x, {number} *s, {number} *c);
void many(int n, const {number} *x, {number} *s, {number} *c)
{{ for (int i = 0; i < n; i++) modeler_sincos(x[i], s + i, c + i); }}
""")
        csrc = locate_resources("csrc")
        more = ["-Wdouble-promotion", "-Wfloat-conversion", "-I", csrc / "single"] * single
        paths = ["-I", csrc / "include", "-shared", "-fPIC", "-o", library, folder / "many.c"]
        command = [compiler("gcc"), *STRICT, *flags, *more, *paths]
        subprocess.run([*command, *["-lm"] * (not single)], check=True)  # floats need none
    out = np.zeros((2, len(x)), x.dtype)
    arrays = (array.ctypes.data_as(ctypes.c_void_p) for array in (x, *out))
    ctypes.CDLL(str(library)).many(len(x), *arrays)
    return out


@pytest.mark.parametrize("flags", [["-O0"], FAST])
def test_sine_and_cosine_are_right_to_the_last_places(flags, tmp_path):
    """Against extended precision: everywhere, near multiples of pi/2, and where they are huge."""
    if np.finfo(np.longdouble).eps > 1e-18:
        pytest.skip("NOT CHECKED: no extended precision on this machine")
    rng = np.random.default_rng(1)
    quarters = rng.integers(-60_000, 60_000, 30_000) * (np.pi / 2)
    beside = quarters * (1 + rng.choice([-1, 1], 30_000) * 2.0 ** -rng.integers(20, 52, 30_000))
    edges = np.array([0.0, -0.0, 1e-300, 1e5, -1e5, np.nextafter(1e5, 0), 1e15, 1e300])
    for x, places in (
        (rng.uniform(-320, 320, 100_000), 1.6),
        (np.concatenate([rng.uniform(-1e5, 1e5, 100_000), quarters, beside, edges]), 2.5),
    ):
        for got, function in zip(sines(x, tmp_path, *flags), (np.sin, np.cos), strict=True):
            exact = function(x.astype(np.longdouble))
            unit = np.spacing(np.abs(exact).astype(float))
            assert float(np.max(np.abs(got - exact) / unit)) < places
    assert np.isnan(sines(np.array([np.nan, np.inf, -np.inf]), tmp_path, *flags)).all()


@pytest.mark.parametrize("flags", [["-O0"], FAST])
def test_sine_and_cosine_of_floats(flags, tmp_path):
    """Everywhere below 1e5, beside multiples of pi/2 too; beyond, and of no number, NaN."""
    rng = np.random.default_rng(1)
    near = rng.uniform(-100, 100, 200_000)
    quarters = rng.integers(-60_000, 60_000, 100_000) * (np.pi / 2)
    far = np.concatenate([rng.uniform(-1e5, 1e5, 200_000), quarters, [0.0, -0.0, 1e-30, 99999.99]])
    for x, units in ((near, 2.0), (far, np.inf)):
        x = x.astype(np.float32)
        for got, function in zip(sines(x, tmp_path, *flags), (np.sin, np.cos), strict=True):
            exact = function(x.astype(float))
            apart = np.abs(got - exact)
            assert apart.max() < 1e-7
            large = np.abs(exact) > 1e-3  # where the angle's own rounding is not all there is
            assert (apart / np.spacing(np.abs(exact).astype(np.float32)))[large].max() < units
    beyond = np.array([1e5, -1e5, 3e38, np.inf, -np.inf, np.nan], np.float32)
    assert np.isnan(sines(beyond, tmp_path, *flags)).all()
