"""Laws that were learned, in all emitted code: the tables of Python, and of scipy."""

import re
import sys
from functools import cache

import numpy as np
import pytest

import modeler.runtime.fused as tiling
from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.core.expression import Law
from modeler.core.manifest import EmittedModule
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.read import parse_robot_text
from modeler.runtime.bind import load_tile_library
from modeler.runtime.gpu import load_gpu
from modeler.runtime.model import CompiledModel
from tests.codegen.fitted_library import fitted_of
from tests.codegen.structured_text import Program
from tests.compiled.cupy_on_cpu import cupy
from tests.compiled.test_tiles import compiled_check
from tests.export.test_casadi import far
from tests.learned import drawn, scipy_value, text_with
from tests.modules import Module, compiler, loaded
from tests.rotation import ROTATING, rotating, with_cases

RNG = np.random.default_rng(20260)
LAWS = {
    "1": ("sign(v)*law(q, abs(v))", drawn(RNG, 2)),
    "2": ("law(-v)", drawn(RNG, 1)),
    "3": ("law(1/3, q)*v + law(a, 0)", drawn(RNG, 2, (4, 3))),
}  # of two quantities, of one, and of constants
ARGUMENTS = {"1": lambda q, v, a: (q, np.abs(v)), "2": lambda q, v, a: (-v,)}


@cache
def made() -> Module:
    model = derive_model(parse_robot_text(text_with("demo-arm", LAWS), "demo-arm"))
    base = derive_base_parameters(model)
    return Module(model, base, emit(model, base))


@cache
def with_control() -> EmittedModule:
    model, base, emitted = made()
    return emit(model, base, fitted_of(emitted.spec), control=Control())


@cache
def compiled(precision: str) -> CompiledModel:
    model, base, _ = made()
    return loaded(emit(model, base, precision=precision))


def motion(samples: int = 40) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Within the tables, at their knots and far beyond their ends."""
    rng = np.random.default_rng()
    result = rng.uniform(-2.5, 2.5, (3, samples, 3))
    for k, law in enumerate(law for _, law in LAWS.values()):
        knots = np.linspace(law.low[0], law.high[0], law.cells[0] + 1)
        result[0, : len(knots), k] = knots
        result[1, : len(knots), k] = -knots
    result[:, -9:] *= 1e4
    return tuple(result)


def expected(joint: str, motion, law_of=scipy_value) -> np.ndarray:
    q, v, a = (x[:, int(joint) - 1] for x in motion)
    law = LAWS[joint][1]
    if joint == "3":
        same = np.full_like(q, 1 / 3)
        return law_of(law, same, q) * v + law_of(law, a, 0 * q)
    value = law_of(law, *ARGUMENTS[joint](q, v, a))
    return np.sign(v) * value if joint == "1" else value


def column(model: CompiledModel, joint: str, phi: np.ndarray) -> np.ndarray:
    name = f"Law{'abc'[int(joint) - 1]}{joint}"
    place = [p.column_of for p in model.spec.base].index(name)
    return phi[:, int(joint) - 1, place]


def close(got: np.ndarray, wanted: np.ndarray, joint: str, motion, precision: float) -> None:
    """To a share of the law's size; in single precision also of what x is rounded by."""
    law = LAWS[joint][1]
    size = np.abs(law.values).max()
    if joint == "3":
        size = size * (1 + np.abs(motion[1][:, 2]))
    slope = 4 * max(law.scales) * (2 + max(map(abs, law.low + law.high)))
    assert (np.abs(got - wanted) <= precision * (10 + slope) * size).all()


@pytest.mark.parametrize("joint", LAWS)
@with_cases(
    "precision, bound", pytest.param("double", 1e-15, marks=pytest.mark.digits), ("single", 2e-7)
)
def test_the_c_has_the_values_of_python_and_of_scipy(joint, precision, bound):
    model, states = compiled(precision), motion(400)
    got = column(model, joint, model.base_regressor(*states))
    close(got, expected(joint, states), joint, states, bound)
    close(got, expected(joint, states, Law.__call__), joint, states, bound)


@pytest.mark.parametrize("precision", ["double", "single"])
def test_what_is_not_finite_gives_no_number_in_any_lane(precision):
    """As in Python; in the lanes of tiles too, each for itself. What is huge is held."""
    model, states = compiled(precision), motion()
    v = states[1][:, 1]
    v[:4] = np.nan, np.inf, -np.inf, 1e38
    out = np.empty((40 * 3, len(model.spec.base)))
    tiles = load_tile_library(model.spec, model._tile_files, model._library)
    tiles.fill_samples(list(states), out, True)
    got = column(model, "2", out.reshape(40, 3, -1))
    wanted = LAWS["2"][1](-v)
    assert np.isnan(got[:3]).all() and np.isfinite(got[3:]).all()
    np.testing.assert_allclose(got, wanted, atol=1e-5)


@with_cases(
    "cc, flags",
    ("gcc", ["-O0"]),
    *rotating(("clang", ["-DMODELER_PLAIN"]), ("clang", ["-O0"]), ("gcc", ["-O2"])),
)
def test_every_instruction_set_and_compiler_gives_the_same(cc, flags, tmp_path):
    names = [name for name in with_control().spec.sources if name.startswith("demo_arm")]
    units = [n for n in names if n[-2:] == ".c" and not re.search("base_regressor|batch", n)]
    assert compiled_check(with_control(), tmp_path, cc, *flags, units=units * (flags == ["-O0"]))


@pytest.mark.rotating("laws and kernels")
@pytest.mark.parametrize("name", ["five-bar", pytest.param("orthoglide-2003", marks=ROTATING)])
def test_robots_with_loops_have_laws_of_their_motors(name, monkeypatch):
    """Columns by scipy, one by one and in tiles; parts of the torque; casadi's G is the C's."""
    rng = np.random.default_rng(12)
    laws = {"11": ("sign(v)*law(q, abs(v))", drawn(rng, 2)), "12": ("law(v)", drawn(rng, 1))}
    model = derive_model(parse_robot_text(text_with(name, laws), name))
    c = loaded(emit(model, derive_base_parameters(model)))
    home = np.array(c.spec.closure.home)[list(c.spec.closure.actuated)]
    q = home + np.cumsum(rng.uniform(-2e-3, 2e-3, (40, len(home))), axis=0)
    qd, qdd = rng.normal(size=(2, *q.shape))
    phi = c.base_regressor(q, qd, qdd)
    names = [base.column_of for base in c.spec.base]
    for joint, column, wanted in (
        (0, "Lawa11", np.sign(qd[:, 0]) * scipy_value(laws["11"][1], q[:, 0], np.abs(qd[:, 0]))),
        (1, "Lawb12", scipy_value(laws["12"][1], qd[:, 1])),
    ):
        law = phi[:, :, names.index(column)]
        np.testing.assert_allclose(law[:, joint], wanted, atol=1e-13)
        assert np.abs(np.delete(law, joint, axis=1)).max() <= 1e-13
    beta = rng.normal(size=len(names))
    tau = c.inverse_dynamics(q, qd, qdd, beta)
    parts = np.einsum("nij,nj->ni", c.inertia_matrix(q, beta), qdd) + c.gravity(q, beta)
    parts += c.coriolis(q, qd, beta) + c.friction(qd, beta, q, qdd)
    np.testing.assert_allclose(parts, tau, atol=1e-9 * np.abs(tau).max())
    monkeypatch.setattr(tiling, "TILED_FROM", 1)
    W = c.observation(q, qd, qdd)
    np.testing.assert_allclose(W, phi.reshape(W.shape), rtol=1e-9, atol=1e-9)


def test_casadi_and_every_function_for_controllers_are_the_same(tmp_path):
    path = tmp_path / "robot.toml"
    path.write_text(text_with("demo-arm", LAWS))
    errors = far(str(path), tmp_path, np.random.default_rng(5))
    assert {"inverse_dynamics", "derivatives", "friction"} <= errors.keys()
    assert max(errors.values()) < 1e-11, errors


def test_structured_text_gives_what_the_c_gives():
    model, base, _ = made()
    emitted = emit(model, base, control=Control(structured_text=True))
    program, states = Program(emitted.files["demo_arm.st"]), motion()
    q, v, a = states
    v[7, 1] = np.nan
    beta = np.random.default_rng(3).normal(size=base.rank)
    wanted = compiled("double").base_regressor(*(np.nan_to_num(x) for x in states)) @ beta
    wanted[7, 1] = np.nan
    for i in range(len(q)):
        tau = [0.0] * 3
        program(
            "demo_arm_inverse_dynamics",
            q=list(q[i]),
            qd=list(v[i]),
            qdd=list(a[i]),
            beta=list(beta),
            tau=tau,
        )
        assert i == 7 or np.allclose(tau, wanted[i], rtol=1e-11, atol=1e-9)
        assert i != 7 or np.isnan(tau[1])


@pytest.mark.rotating("laws and kernels")
def test_kernels_compute_what_the_c_computes(tmp_path, monkeypatch):
    compiler("g++")
    model, base, _ = made()
    monkeypatch.setitem(sys.modules, "cupy", cupy(tmp_path))
    kernels, states = load_gpu(emit(model, base, cuda=True)), motion()
    wanted = compiled("double").nonzeros(*states)
    apart = np.abs(kernels.nonzeros(*states).T - wanted).max(axis=1)
    assert (apart <= 1e-12 * np.abs(wanted).max(axis=1)).all()
