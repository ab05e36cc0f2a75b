"""The C of a fitted UR10e, installed and found, drives the simulated one from a C++ program."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.robot.read import read_robot
from modeler.simulation import SimulationSettings
from tests.csrc.simulated_machine import Driven, Machine, fitted_folder, rms
from tests.modules import compiler

HERE = Path(__file__).resolve().parent
FOUND = """cmake_minimum_required(VERSION 3.13)
project(controller LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(ur10e REQUIRED)
add_executable(by_cmake closed_loop.cpp)
target_link_libraries(by_cmake ur10e::ur10e)
"""

JOINT, TORQUE = 2, 20.0  # which is pushed, and how, N m
FROM, TO = 1.5, 2.5  # s


def run(*command: object, where: Path, **more: str) -> str:
    clean = {k: v for k, v in os.environ.items() if k != "MAKEFLAGS"}
    clean |= {"CFLAGS": "-O0", "CXXFLAGS": "-O0", **more}
    words = [str(word) for word in command]
    ran = subprocess.run(words, cwd=where, env=clean, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, f"{words}\n{ran.stdout}{ran.stderr}"
    return ran.stdout


@pytest.fixture(scope="module")
def programs(tmp_path_factory) -> tuple[Path, Path]:
    """The controller, found by CMake and by pkg-config."""
    for name in ("make", "cmake", "pkg-config", "g++", "ldd"):
        compiler(name)
    place = tmp_path_factory.mktemp("controller")
    fitted_folder(read_robot("ur10e"), place / "ur10e_c")
    run("make", "install", f"PREFIX={place / 'robots'}", where=place / "ur10e_c")
    source = (HERE / "closed_loop.cpp").read_text()
    (place / "closed_loop.cpp").write_text(source)
    (place / "CMakeLists.txt").write_text(FOUND)
    run("cmake", "-S", ".", "-B", "b", f"-DCMAKE_PREFIX_PATH={place / 'robots'}", where=place)
    run("cmake", "--build", "b", where=place)
    lib = place / "robots" / "lib"
    flags = run("pkg-config", "--cflags", "--libs", "ur10e", where=place,
                PKG_CONFIG_PATH=str(lib / "pkgconfig")).split()  # fmt: skip
    strict = ["-std=c++17", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    run("g++", *strict, "closed_loop.cpp", *flags, f"-Wl,-rpath,{lib}", "-o", "by_pkg_config",
        where=place)  # fmt: skip
    return place / "b" / "by_cmake", place / "by_pkg_config"


@pytest.fixture(scope="module")
def machine() -> Machine:
    """Along a motion that the fit has not seen."""
    return Machine(read_robot("ur10e"), SimulationSettings(duration=3.0, rate=1000.0, seed=7))


def driven(machine: Machine, program: Path, mode: str, pushed: bool = False) -> Driven:
    commanded = machine.reference

    def line(k: int, q: np.ndarray, qd: np.ndarray, tau: np.ndarray) -> np.ndarray:
        return np.concatenate([q, commanded.q[k], commanded.qd[k], commanded.qdd[k]])

    def push(t: float) -> np.ndarray:
        return TORQUE * (np.arange(6) == JOINT) * (FROM <= t < TO)

    return machine.drive([program, mode], line, push if pushed else None)


@pytest.fixture(scope="module")
def free(programs, machine) -> Driven:
    """With the model, and nothing that pushes."""
    return driven(machine, programs[0], "model")


def test_the_model_follows_a_motion_that_pd_alone_does_not(programs, machine, free):
    """At 3 Hz, with encoders of 1e6 counts and speeds filtered at 150 Hz; rms over all joints.

    Measured: 0.32 mrad with the model, 73 mrad with its gravity only, 145 mrad without; the motion
    is 148 mrad rms. What is left grows with the lag of the speeds (0.12 mrad without).
    """
    gravity, alone = (driven(machine, programs[1], mode) for mode in ("gravity", "pd"))
    total, with_gravity, without = (float(rms(rms(d.error))) for d in (free, gravity, alone))
    assert total < 6e-4
    assert with_gravity > 100 * total
    assert without > 1.5 * with_gravity
    assert np.all(rms(free.error) < rms(gravity.error) / 10)


def test_the_observer_sees_the_push_and_where_it_is(programs, machine, free):
    """20 N m on joint 3, which it is not told. Measured: 19.87 N m, and 2.9 at most when free."""
    both = driven(machine, programs[1], "model", pushed=True)
    free, pushed = free.answers[:, 6:], both.answers[:, 6:]
    time = machine.reference.time
    seen = pushed[(time > FROM + 0.3) & (time < TO)].mean(axis=0)
    assert abs(seen[JOINT] - TORQUE) < 0.02 * TORQUE
    assert np.all(np.abs(np.delete(seen, JOINT)) < 0.05 * TORQUE)
    assert np.abs(free[:, JOINT]).max() < 0.25 * TORQUE
    before = time <= FROM
    np.testing.assert_allclose(pushed[before], free[before], rtol=0, atol=1e-6)
