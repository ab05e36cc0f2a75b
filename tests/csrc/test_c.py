"""Hand-written C under sanitizers, and an emitted folder that builds by itself."""

import ctypes
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.package import write_emitted
from modeler.core.files import resource_dir
from tests.modules import STRICT, compiler, module

HERE = Path(__file__).resolve().parent
CLEAN = {k: v for k, v in os.environ.items() if k != "MAKEFLAGS"} | {"CFLAGS": "-O0"}


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


def control_step() -> tuple[str, np.ndarray]:
    """(numbers for the program, torques that numpy expects)."""
    model = module("wrist").model
    rng = np.random.default_rng(4)
    chi = rng.normal(size=len(model.columns))
    q, qd, q_d, qd_d, qdd_d = rng.normal(size=(5, 3))
    v = qdd_d + 40 * (qd_d - qd) + 400 * (q_d - q)
    values = dict(model.geometry.values)
    for kind, vector in (("q", q), ("qd", qd), ("qdd", v)):
        values |= {f"{kind}[{i}]": x for i, x in enumerate(vector)}
    phi = np.zeros((3, len(chi)))
    entries = model.graph.evaluate(list(model.regressor.values()), values)
    for place, value in zip(model.regressor, entries, strict=True):
        phi[place] = value
    numbers = np.concatenate([chi, q, qd, q_d, qd_d, qdd_d])
    return "\n".join(repr(float(x)) for x in numbers), phi @ chi


def check_controller(folder: Path, library: Path) -> None:
    program = folder / "controller"
    command = [compiler("gcc"), *STRICT, "-I", folder, "-o", program]
    command += [HERE / "computed_torque.c", library, "-lm"]
    subprocess.run(command, check=True)
    numbers, expected = control_step()
    ran = subprocess.run([program], input=numbers, capture_output=True, text=True, check=True)
    tau = np.array([float(line) for line in ran.stdout.split()])
    np.testing.assert_allclose(tau, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_the_folder_builds_with_make_and_controls(tmp_path):
    write_emitted(module("wrist").emitted, tmp_path)
    compiler("make")
    subprocess.run(["make", "-C", tmp_path], check=True, capture_output=True, env=CLEAN)
    again = subprocess.run(
        ["make", "-C", tmp_path, "--question"], check=False, capture_output=True, env=CLEAN
    )
    assert again.returncode == 0, "make would build an unchanged folder again"
    check_controller(tmp_path, tmp_path / "libwrist_model.a")


def test_the_folder_builds_with_cmake_and_controls(tmp_path):
    write_emitted(module("wrist").emitted, tmp_path)
    compiler("cmake")
    build = tmp_path / "build"
    for command in (["cmake", "-S", tmp_path, "-B", build], ["cmake", "--build", build]):
        subprocess.run(command, check=True, capture_output=True, env=CLEAN)
    check_controller(tmp_path, build / "libwrist_model.a")


def test_two_robots_link_into_one_program(tmp_path):
    """Each library carries the runtime; the linker takes it once."""
    compiler("make")
    libraries, includes, calls = [], [], []
    for name in ("wrist", "emps"):
        emitted = module(name).emitted
        write_emitted(emitted, tmp_path / name)
        subprocess.run(["make", "-C", tmp_path / name], check=True, capture_output=True, env=CLEAN)
        libraries.append(tmp_path / name / f"lib{name}_model.a")
        includes += ["-I", tmp_path / name]
        calls.append(f"{name}_signature()")
    program = tmp_path / "both.c"
    program.write_text(
        '#include "wrist.h"\n#include "emps.h"\n#include <stdio.h>\nint main(void)\n'
        "{\n    double W[400], x[3] = {0};\n    wrist_observation(1, x, x, x, W);\n"
        "    emps_observation(1, x, x, x, W);\n"
        f'    printf("%s %s", {", ".join(calls)});\n    return 0;\n}}\n'
    )
    command = [compiler("gcc"), "-std=c99", *includes, "-o", tmp_path / "both", program]
    subprocess.run([*command, *libraries, "-lm"], check=True)
    ran = subprocess.run([tmp_path / "both"], capture_output=True, text=True, check=True)
    expected = [module(name).emitted.spec.signature() for name in ("wrist", "emps")]
    assert ran.stdout.split() == expected
