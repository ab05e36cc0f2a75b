"""Lengths and angles replaced at compile time: right, or refused; never wrong."""

import dataclasses
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.context import find_deciding_symbols
from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.choices import read_builtin_robot
from modeler.core.manifest import EmittedModule
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.model import SymbolicModel
from modeler.robot.read import parse_robot_text
from tests.modules import STRICT, compiler, loaded, module, states
from tests.rotation import with_cases

PLANAR = """
name = "{name}"
title = "Arm with symbols"
gravity = {gravity}

[symbols]
g = 9.81
{symbols}

[mdh]
columns = ["j", "a", "sigma", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 0, 0, 0, "q1", 0],
  ["2", "1", 0, "{alpha}", "{d}", "q2", "{r}"],
]
"""


def arm(symbols, name="arm", gravity='[0, "-g", 0]', alpha="0", d="L", r="0") -> SymbolicModel:
    text = PLANAR.format(name=name, gravity=gravity, symbols=symbols, alpha=alpha, d=d, r=r)
    return derive_model(parse_robot_text(text, name))


def emitted_of(model: SymbolicModel) -> EmittedModule:
    return emit(model, derive_base_parameters(model))


def compile_with(emitted, macro, folder) -> subprocess.CompletedProcess:
    """All C of a robot's own, one of its macros replaced."""
    write_emitted(emitted, folder)
    names = [name for name in emitted.spec.sources if re.match(r"(?!modeler).*\.c", name)]
    text = "\n".join(emitted.files[name] for name in names)
    command = [compiler("gcc"), "-std=c99", "-E", f"-D{macro}=0.37", "-I", folder, "-x", "c", "-"]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=False)


def with_macro(emitted, macro, value) -> EmittedModule:
    """The module, as if compiled with -Dmacro=value."""
    files = {
        name: f"#define {macro} {value}\n{text}" if name.endswith(".c") else text
        for name, text in emitted.files.items()
    }
    return dataclasses.replace(emitted, files=files)


def test_a_length_can_be_replaced():
    """-DWRIST_GEO_bl1=... gives the model of a robot file with that length."""
    emitted = module("wrist").emitted
    text = re.sub(r"(?m)^bl1\s*=\s*[0-9.]+", "bl1 = 0.37", read_builtin_robot("wrist"))
    other = emitted_of(derive_model(parse_robot_text(text, "wrist with a longer link")))
    q, qd, qdd = states(3, 5)
    changed = loaded(with_macro(emitted, "WRIST_GEO_bl1", 0.37))
    derived, known = (loaded(m) for m in (other, emitted))
    rows = (each.base_regressor(q, qd, qdd) for each in (changed, derived))
    np.testing.assert_allclose(*rows)
    chi = np.linspace(-1, 1, len(emitted.spec.standard))
    np.testing.assert_allclose(changed.base_parameters(chi), derived.base_parameters(chi))
    np.testing.assert_allclose(changed.forward_kinematics(q), derived.forward_kinematics(q))
    assert not np.allclose(changed.base_regressor(q, qd, qdd), known.base_regressor(q, qd, qdd))


def torque_with(cc, folder, define) -> subprocess.CompletedProcess:
    """Torques that the C computes where `define` stands for L1, strictly compiled."""
    write_emitted(module("two-link").emitted, folder)
    torque = Path(__file__).with_name("programs") / "torque.c"
    paths = ["-I", folder, "-o", "torque", torque, "two_link.c", "-lm"]
    command = [compiler(cc), *STRICT, "-O0", f"-DTWO_LINK_GEO_L1={define}", *paths]
    built = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if built.returncode:
        return built
    return subprocess.run([folder / "torque"], capture_output=True, text=True, check=True)


def test_a_macro_may_be_any_expression(tmp_path):
    """L1 squared, L1 times a sum: none of them takes the expression apart."""

    def tau(define, cc="gcc"):
        return np.array(torque_with(cc, tmp_path, define).stdout.split(), float)

    right, other = tau("-0.623"), tau("-0.6127")
    assert len(right) == 2 and np.abs(other - right).max() > 1e-3 * np.abs(right).max()
    for cc, define in (("gcc", "-0.613-0.01"), ("clang", "1?-0.623:2")):
        np.testing.assert_allclose(tau(define, cc), right, rtol=0, atol=1e-12 * np.abs(right).max())
    np.testing.assert_array_equal(tau("-1"), tau("-1.0"))  # a whole number is a length


@pytest.mark.parametrize(("cc", "define"), [("gcc", ""), ("gcc", '"long"'), ("clang", "-0,613")])
def test_what_is_no_number_does_not_compile(cc, define, tmp_path):
    """A decimal comma would be the operator that throws -0 away and leaves 613 m."""
    done = torque_with(cc, tmp_path, define)
    assert done.returncode != 0 and "error" in done.stderr


@pytest.mark.parametrize(
    "symbols", ["L = 0.5\nL1 = 0.2", 'L1 = 0.2\nL = "2*L1 + 0.1"', 'a = 0.5\nL = "sqrt(1 + a**2)"']
)
def test_symbols_in_plain_cells_are_free(symbols):
    assert find_deciding_symbols(arm(symbols).geometry) == set()


@with_cases(
    "symbols, cells, stay",  # A symbol worth 0 through others: these others must keep their sum.
    ('L = 0.5\nA = 0.2\nB = 0.2\ne = "A - B"', {"r": "e"}, {"A", "B"}),
    # The other cell of these symbols stays as it is, but the structure does not.
    ('L = 0.5\nB = 0.5\ne = "L - B"', {"r": "L + e"}, {"L", "B"}),
    # Two angles that are a right one together.
    (f'L = 0.5\na = 0.7\nb = {np.pi / 2 - 0.7!r}\nc = "a + b"', {"alpha": "c"}, {"a", "b"}),
    # A right angle but for a hair.
    ("L = 0.5\ne = 1e-12", {"alpha": "pi/2 + e"}, {"e"}),
    # Folded into the structure.
    *(
        (f"L = 0.5\na = {value}", {"alpha": "a"}, set())
        for value in ("0", repr(np.pi / 2), '"pi/6"', '"2*L"')
    ),
)
def test_symbols_on_which_the_structure_rests_must_stay(symbols, cells, stay, tmp_path):
    model = arm(symbols, **cells)
    assert find_deciding_symbols(model.geometry) == stay
    emitted = emitted_of(model)
    for name in model.robot.symbols:
        done = compile_with(emitted, f"ARM_GEO_{name}", tmp_path)
        folded = name not in model.geometry.values
        assert (done.returncode != 0) == (name in stay or folded), (name, done.stderr)
        assert not folded or f"#define ARM_GEO_{name}" not in emitted.files["arm.c"]
        if done.returncode:
            says = f"ARM_GEO_{name} cannot be replaced; change the robot file and generate again"
            assert says in done.stderr and emitted.files["arm.c"].count(says) == 1


def test_an_angle_that_is_a_fraction_of_pi_is_that_angle():
    q, qd, qdd = states(2, 6)
    by_pi = emitted_of(arm('L = 0.5\na = "pi/7"', alpha="a + pi/5", r="a*L"))
    number = emitted_of(arm(f"L = 0.5\na = {np.pi / 7!r}", alpha=f"a + {np.pi / 5!r}", r="a*L"))
    got, expected = (loaded(m).regressor(q, qd, qdd) for m in (by_pi, number))
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12)


def test_relations_that_rest_on_given_values_let_no_symbol_be_replaced(tmp_path):
    """d = L1 + L2 - L3 is 0 at the given values only, and then fewer parameters act."""
    lengths = "L1 = 0.3\nL2 = 0.2\nL3 = 0.5"
    model = arm(lengths, "zero", gravity='[0, 0, "-g"]', d="L1 + L2 - L3")
    base = derive_base_parameters(model)
    assert base.proof.kind == "exact at the given values"
    emitted = emit(model, base)
    for name in ("L1", "L2", "L3", "g"):
        done = compile_with(emitted, f"ZERO_GEO_{name}", tmp_path)
        assert f"ZERO_GEO_{name} cannot be replaced" in done.stderr
    for file in ("zero.c", "zero_regressor.c", "zero_base_regressor.c"):
        assert "#ifndef" not in emitted.files[file]
        assert "The base parameters hold for these values only." in emitted.files[file]
    chi = np.linspace(-1, 1, len(emitted.spec.standard))
    q, qd, qdd = states(2, 6)
    library = loaded(emitted)
    tau = library.inverse_dynamics(q, qd, qdd, library.base_parameters(chi))
    np.testing.assert_allclose(tau, library.regressor(q, qd, qdd) @ chi, rtol=0, atol=1e-10)


def test_a_robot_and_a_symbol_may_be_called_like_a_macro_of_math_h(tmp_path):
    """FP_NAN of robot fp would turn every isnan() of the program around."""
    emitted = emitted_of(arm("L = 0.5\nNAN = 0.3", name="fp", r="NAN"))
    write_emitted(emitted, tmp_path)
    units = [tmp_path / name for name in emitted.spec.sources if name.endswith(".c")]
    command = [compiler("gcc"), "-std=gnu99", "-Wall", "-Werror", "-fsyntax-only", "-I", tmp_path]
    subprocess.run([*command, *units], check=True)
    q, qd, qdd = states(2, 6)
    same = emitted_of(arm("L = 0.5\nR = 0.3", name="other", r="R"))
    got, expected = (loaded(m).regressor(q, qd, qdd) for m in (emitted, same))
    np.testing.assert_array_equal(got, expected)
    np.testing.assert_array_equal(np.isfinite(got), True)
