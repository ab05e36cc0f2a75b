"""On microcontrollers: what the code weighs, what it needs, and what it computes there."""

import dataclasses
import re
import subprocess
from functools import cache

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.manifest import EmittedModule
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.read import read_robot
from modeler.robot.robot import EffectUse
from tests.codegen.fitted_library import robot_module
from tests.csrc.cortex_m import library, output, run, section_bytes, tool, undefined
from tests.modules import loaded, states

LIMITS = {"puma560": 4300, "panda": 7000}
"""Bytes of the compact regressor of the base parameters, sines and cosines included, at most."""

FLOAT_FUNCTIONS = {"memset", "memcpy", "memmove", "sqrtf", "fminf", "tanf", "tanhf", "expf", "powf"}
"""What a library in single precision may want; with __aeabi_ names it would be soft floats."""


@cache
def emitted(name: str, precision: str = "single") -> EmittedModule:
    module = robot_module(name)
    return emit(module.model, module.base, precision=precision)


def with_losses(name: str) -> EmittedModule:
    """With rotor inertia, viscous and Coulomb friction at every joint."""
    robot = read_robot(name)
    names = tuple(joint.name for joint in robot.moving_joints)
    effects = tuple(EffectUse(e, names) for e in ("rotor_inertia", "viscous", "coulomb"))
    model = derive_model(dataclasses.replace(robot, effects=effects))
    return emit(model, derive_base_parameters(model), precision="single")


@pytest.mark.slow
@pytest.mark.parametrize("name", LIMITS)
def test_the_regressor_is_small(name, tmp_path):
    made = with_losses(name)
    library(made, tmp_path, "cortex-m7")
    unit = tmp_path / f"{made.spec.prefix}_base_regressor.c.cortex-m7.o"
    assert section_bytes(unit, "nonzeros", "sincos", "rodata") <= LIMITS[name]
    assert undefined([unit]) <= {"memset"}


@pytest.mark.slow
@pytest.mark.parametrize("cpu", ["cortex-m4", "cortex-m7"])
@pytest.mark.parametrize("name", ["panda", "five-bar", "slow-arm"])
def test_no_routine_of_double_precision_is_wanted(name, cpu, tmp_path):
    assert undefined(library(emitted(name), tmp_path, cpu)) <= FLOAT_FUNCTIONS


@pytest.mark.slow
def test_sines_of_the_library_are_not_wanted_where_angles_are_bounded(tmp_path):
    double = emitted("puma560", "double")
    assert {"sin", "cos"} <= undefined(library(double, tmp_path, "cortex-m7"))
    bounded = library(double, tmp_path, "cortex-m7", "-DMODELER_BOUNDED_ANGLES")
    assert undefined(bounded) <= {"memset", "memcpy"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cpu", "precision", "bound"),
    [("cortex-m4", "single", 1e-6), ("cortex-m7", "single", 1e-6), ("cortex-m7", "double", 1e-14)],
)
@pytest.mark.parametrize("name", ["puma560", "slow-arm", "five-bar"])
def test_it_computes_what_the_host_computes(name, cpu, precision, bound, tmp_path):
    made, host = emitted(name, precision), robot_module(name).emitted
    compiled = loaded(host)
    cells = dict(zip(("q", "qd", "qdd"), states(len(host.spec.joints), 20), strict=True))
    if host.spec.closure is not None:
        loops = host.spec.closure
        cells["q"] = 0.1 * cells["q"] + [loops.home[k] for k in loops.actuated]
        bound *= 10  # what closes the loops is only as exact as the posture is far from singular
    rng = np.random.default_rng(1)
    cells["beta"] = np.tile(rng.normal(size=len(host.spec.base)), (20, 1))
    cells["s"] = rng.uniform(0, 1, (20, len(host.spec.signals)))
    cells = {key: value.astype(np.float32).astype(float) for key, value in cells.items()}
    motion = [cells["q"], cells["qd"], cells["qdd"]]
    signals = {"s": cells["s"]} if host.spec.signals else {}
    functions = {f.name.removeprefix(f"{host.spec.prefix}_"): f for f in made.spec.functions}
    calls = [
        (functions[role], {a.name: cells[a.name] for a in functions[role].inputs})
        for role in ("base_regressor", "inverse_dynamics")
    ]
    phi, tau = run(made, tmp_path, cpu, calls)
    if precision == "single":  # neither in the code nor in what <math.h> brings
        assert not re.findall(r"__aeabi_(?:d|f2d|i2d|ui2d)\w*", linked(tmp_path / "main.elf"))
    expected = compiled.base_regressor(*motion, **signals)
    size = np.abs(expected).max(axis=(1, 2))
    assert (np.abs(phi - expected).max(axis=(1, 2)) <= bound * size).all()
    parts = np.einsum("njc,nc->nj", np.abs(expected), np.abs(cells["beta"])).max(axis=1)
    apart = np.abs(tau - compiled.inverse_dynamics(*motion, cells["beta"][0], **signals))
    assert (apart.max(axis=1) <= bound * parts).all()


@pytest.mark.slow
@pytest.mark.parametrize("precision", ["single", "double"])
def test_instructions_of_a_call_are_counted(precision, tmp_path):
    """Straight-line code: as many as the listing has."""
    tool("qemu-system-arm")
    made = emitted("puma560", precision)
    write_emitted(made, tmp_path)
    library(made, tmp_path, "cortex-m7")
    subprocess.run(["make", "-s", "-C", tmp_path, "count"], check=True, stdout=subprocess.DEVNULL)
    text = (tmp_path / "puma560_instructions.h").read_text()
    counts = {role: int(n) for role, n in re.findall(r"PUMA560_(\w+)_INSTRUCTIONS (\d+)", text)}
    assert len(counts) == len(made.spec.functions)
    for role in ("friction", "base_parameters"):
        assert counts[role.upper()] == listed(tmp_path / "puma560.c.cortex-m7.o", f"puma560_{role}")
    compact, dense = counts["BASE_REGRESSOR_NONZEROS"], counts["BASE_REGRESSOR"]
    assert 500 < compact < dense < counts["REGRESSOR"] < 5000


def linked(program) -> str:
    return output([tool("arm-none-eabi-nm"), str(program)])


def listed(path, function: str) -> int:
    text = output([tool("arm-none-eabi-objdump"), "-d", "-j", f".text.{function}", str(path)])
    lines = [line for line in text.splitlines() if re.match(r"\s+[0-9a-f]+:\t", line)]
    ends = [k for k, line in enumerate(lines) if "bx\tlr" in line or re.search(r"pop.*pc}", line)]
    return ends[-1] + 1  # constants follow
