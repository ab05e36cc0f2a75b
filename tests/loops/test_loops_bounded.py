"""Emitted loops in a controller: whatever they are given, they end, and say what is the matter."""

import ctypes
import re
import subprocess
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.package import write_emitted
from modeler.codegen.workflow import generate
from modeler.core.manifest import EmittedModule
from tests.codegen.fitted_library import Functions, motion, with_values
from tests.loops.derived import of_file
from tests.modules import compiler, module
from tests.rotation import ROTATING

HERE = Path(__file__).resolve().parent
ROBOTS = ["five-bar", *(pytest.param(name, marks=ROTATING) for name in ("evra", "stewart"))]
DONE, OPEN, SINGULAR, NOT_FINITE, UNFINISHED = range(5)


def counted(emitted: EmittedModule, folder: Path, rows: np.ndarray) -> tuple[np.ndarray, int]:
    """(rows, 2): status and evaluations of closing at each q; and how many are allowed."""
    write_emitted(emitted, folder)
    prefix = emitted.spec.prefix
    units = [folder / n for n in emitted.spec.sources if n.endswith(".c")]
    names = {"TABLE": "loops", "HOME": "home", "POSTURE": "posture", "POSED": "posed"}
    bound = f"{prefix.upper()}_MAX_CLOSURE_EVALUATIONS"
    command = [compiler("gcc"), "-std=c99", "-O0", f'-DTREE="{prefix}_tree.h"', f"-DMOST={bound}"]
    command += [f"-D{macro}={prefix}_{name}" for macro, name in names.items()]
    command += ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    command += ["-I", folder, HERE / "counted.c", *units, "-lm", "-o", folder / "counted"]
    subprocess.run(command, check=True)
    text = "\n".join(" ".join(repr(float(x)) for x in row) for row in rows)
    ran = subprocess.run(
        [folder / "counted"], input=text, capture_output=True, text=True, check=True, timeout=60
    )
    *lines, allowed = ran.stdout.splitlines()
    return np.array([line.split() for line in lines], dtype=int), int(allowed)


def far_and_near(home: np.ndarray) -> np.ndarray:
    """Coordinates alone and together, both ways, at every magnitude that a double has."""
    sizes = [0.0, 5e-324, 1e-310, *(10.0**k for k in range(-12, 309, 4)), 1e3, 1e5, 1.7e308]
    n = len(home)
    ways = [*np.eye(n), np.ones(n), (-1.0) ** np.arange(n)]
    return np.array([home + sign * x * way for x, way, sign in product(sizes, ways, (1, -1))])


def check_bound(emitted: EmittedModule, folder: Path) -> None:
    closure = emitted.spec.closure
    rows = far_and_near(np.array([closure.home[k] for k in closure.actuated]))
    result, allowed = counted(emitted, folder, rows)
    assert len(result) == len(rows) and result[:, 1].max() <= allowed
    assert set(result[:, 0]) <= {DONE, OPEN, SINGULAR, UNFINISHED}
    moved = np.abs(rows - rows[0]).max(axis=1)
    assert np.all(result[moved < 1e-6, 0] == DONE)
    assert np.all(result[moved > 1e5, 0] != DONE)
    text = emitted.files[f"{emitted.spec.prefix}.h"]
    assert int(re.search(r"_MAX_CLOSURE_EVALUATIONS (\d+)", text)[1]) == allowed
    name = f"{emitted.spec.prefix.upper()}_MAX_CLOSURE_EVALUATIONS"
    assert f"{name}` times" in emitted.files["README.md"]


@pytest.mark.parametrize("name", ROBOTS)
def test_every_call_ends_within_the_stated_number_of_evaluations(name, tmp_path):
    """A slider of evra at 1e5 m took a second, at 1e300 m it went on for ever; 2 s each.

    Sanitizers find nothing on the way, wherever it leads.
    """
    check_bound(module(name).emitted, tmp_path)


@pytest.mark.slow
@pytest.mark.measured
@pytest.mark.parametrize("name", ["rccc_wide", "3rpr_sim"])
def test_so_do_those_of_further_robots(name, loop_robots_folder, tmp_path):
    check_bound(generate(of_file(loop_robots_folder / f"{name}.toml")), tmp_path)


def test_a_log_marks_the_samples_that_are_not_finite():
    emitted = module("five-bar").emitted
    library = Functions(emitted)._library
    q, qd, qdd = (np.repeat(motion("five-bar", 1)[k], 9, axis=0) for k in ("q", "qd", "qdd"))
    for k, array in enumerate((q, qd, qdd)):
        array[2 * k + 1, k % 2] = (np.nan, np.inf, -np.inf)[k]
    W, status = np.zeros((9, 2, len(emitted.spec.base))), np.zeros(9, dtype=np.intc)
    pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (q, qd, qdd, W, status)]
    library.five_bar_observation(ctypes.c_size_t(9), *pointers)
    bad = np.array([0, 1, 0, 1, 0, 1, 0, 0, 0], dtype=bool)
    assert list(status) == list(np.where(bad, NOT_FINITE, DONE))
    assert np.isnan(W[bad]).all() and np.isfinite(W[~bad]).all()


def test_torques_that_overflow_are_told_too():
    emitted = with_values("five-bar")
    functions, inputs = Functions(emitted), motion("five-bar", 1)
    rows = [inputs["q"][0], np.full(2, 1e200), inputs["qdd"][0]]
    out = np.zeros(2)
    pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (*rows, out)]
    call = functions._library.five_bar_fitted_inverse_dynamics
    assert call(*pointers) == NOT_FINITE and np.isnan(out).all()
