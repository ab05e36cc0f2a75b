"""The signature: of everything that the C is, and the same on every machine."""

import dataclasses
import json
import math
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import mpmath
import numpy as np
import pytest
import sympy

from modeler.codegen.emit import emit
from modeler.core.errors import LoopError
from modeler.core.expression import ROUNDED, compute_power, parse_expression
from modeler.core.manifest import EmittedModule, digest_code
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.closure import LoopEquations, polish_home
from modeler.derivation.derive import derive_model
from modeler.derivation.graph import Graph
from modeler.robot.read import parse_robot_text, read_robot
from tests.codegen.fitted_library import robot_text
from tests.modules import module
from tests.repository import ROOT
from tests.robots import CLOSED, KINDS
from tests.rotation import rotating, with_cases

ARM = """
name = "arm"
gravity = [0, -9.81, 0]

[mdh]
columns = ["j", "a", "sigma", "alpha", "d", "theta", "r"]
rows = [["1", "0", 0, 0, 0, "q1", 0], ["2", "1", 0, 0.3, 0.1, "q2", 0.05]]
"""
TRIGONOMETRY = robot_text("bent")


@cache
def emitted(text: str) -> EmittedModule:
    model = derive_model(parse_robot_text(text, "arm"))
    return emit(model, derive_base_parameters(model))


def sources(made: EmittedModule) -> dict[str, str]:
    """The C files, without the signature."""
    signature = made.spec.compute_signature()
    texts = {name: made.files[name] for name in (*made.spec.sources, *made.spec.tile_sources)}
    for old, new in (
        (f'"{signature}"', '""'),
        *((f"0x{signature[i : i + 8]}u", "0xu") for i in (0, 8)),
    ):
        texts = {name: text.replace(old, new) for name, text in texts.items()}
    return texts


@pytest.mark.parametrize(
    ("old", "new"), [("-9.81", "-1.62"), ("0.1", "0.2"), ("0.3", "0.31"), ("0.05", "0.06")]
)
def test_a_number_of_the_table_is_in_the_signature(old, new):
    """The manifests were the same: only the C has the number."""
    one, other = emitted(ARM), emitted(ARM.replace(old, new))
    assert sources(one) != sources(other)
    assert one.spec.compute_signature() != other.spec.compute_signature()


@pytest.mark.parametrize(
    "name", ["emps", "five-bar", *rotating(*(n for n in KINDS if n not in ("emps", "five-bar")))]
)
def test_the_signature_covers_every_letter_of_the_c(name):
    made = module(name).emitted
    texts = sources(made)
    assert made.spec.code == digest_code(texts)
    signature = made.spec.compute_signature()
    assert sum(signature in made.files[n] for n in made.spec.sources) == 2  # and header
    for file, text in texts.items():
        changed = digest_code({**texts, file: text.replace("0", "1", 1) + " "})
        other = dataclasses.replace(made.spec, code=changed)
        assert other.compute_signature() != made.spec.compute_signature()


def other_machine(core: str, seed: str) -> dict[str, str]:
    """The environment of a processor without this one's newer instructions."""
    actual = np.show_config(mode="dicts")["SIMD Extensions"]["found"]
    tunables = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable"
    return {
        "NPY_DISABLE_CPU_FEATURES": " ".join(actual),
        "OPENBLAS_CORETYPE": core,
        "GLIBC_TUNABLES": tunables,
        "PYTHONHASHSEED": seed,
    }


@with_cases(
    "core, seed, names",
    ("Prescott", "1", ()),
    *rotating(
        ("Prescott", "1", ("five-bar",)),
        ("Prescott", "1", ("delta",)),
        ("Haswell", "77", ("five-bar", "panda")),
    ),
)
def test_signatures_are_the_same_on_every_machine(core, seed, names, tmp_path):
    """Loops are closed by iteration, coefficients are sines: last digits that must not show."""
    bent = tmp_path / "bent.toml"
    bent.write_text(TRIGONOMETRY)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **other_machine(core, seed)}
    ran = subprocess.run(
        [sys.executable, Path(__file__).with_name("signatures.py"), *names, bent],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    expected = {name: module(name).emitted.spec.compute_signature() for name in names}
    expected[str(bent)] = emitted(TRIGONOMETRY).spec.compute_signature()
    assert json.loads(ran.stdout) == expected


def test_homes_are_the_doubles_next_to_closed_postures():
    """Of the five-bar by the intersection of two circles, in 50 digits."""
    made = module("five-bar").emitted
    home = dict(zip(made.spec.closure.variables, made.spec.closure.home, strict=True))
    mp = mpmath.MPContext()
    mp.dps = 50
    l0, l1, l2, l3, l4 = (mp.mpf(x) for x in ("0.2", "0.3", "0.4", "0.31", "0.42"))
    q11, q12 = mp.mpf("2.2"), mp.mpf("0.9")
    one = mp.expj(q11) * l1
    other = mp.expj(q12) * l3 + l0
    way = other - one
    along = (l2**2 - l4**2 + abs(way) ** 2) / (2 * abs(way))
    height = mp.sqrt(l2**2 - along**2)
    tips = [one + way / abs(way) * mp.mpc(along, side * height) for side in (1, -1)]
    tip = max(tips, key=lambda z: z.imag)
    assert home["21"] == float(mp.arg((tip - one) / mp.expj(q11)))
    assert home["22"] == float(mp.arg((tip - other) / mp.expj(q12)))
    assert (home["11"], home["12"]) == (2.2, 0.9)
    assert ", ".join(map(repr, made.spec.closure.home)) in made.files["five_bar_loops.c"]


@pytest.mark.parametrize("start", [0.0, 1e-7])
def test_a_home_without_certain_digits_is_refused(start):
    """q0**2 = 0: a double root, near which every posture is closed up to rounding."""
    graph = Graph()
    q = graph.symbol("q[0]")
    loops = LoopEquations(graph, {}, [q * q], [[q * 2]], (), (0,), (False,), 1.0)
    with pytest.raises(LoopError, match=r"two-link: \[home\]: .* nearly singular there; state"):
        polish_home(loops, np.array([start]), [0], read_robot("two-link"))


@pytest.mark.parametrize("name", CLOSED)
def test_no_home_keeps_what_the_iteration_left(name):
    """What is 0 is 0; 1e-17 may be right, where a joint stands at the double next to pi/2."""
    assert all(x == 0.0 or abs(x) > 1e-20 for x in module(name).emitted.spec.closure.home)


@pytest.mark.parametrize("name", [*rotating("ur10e", "sr400"), "five-bar"])
def test_coefficients_are_the_doubles_next_to_their_formula(name):
    """Of the decimals that the robot file has, evaluated by sympy in 50 digits."""
    spec = module(name).emitted.spec
    names = {symbol.name: sympy.Symbol(symbol.name) for symbol in spec.symbols}
    values = {names[s.name]: sympy.Rational(repr(s.value)) for s in spec.symbols}
    terms = {(t.coefficient, t.value) for base in spec.base for t in base.terms}
    for text, value in terms:
        exact = sympy.sympify(text, locals=names, rational=True).subs(values)
        assert value == float(exact.evalf(50)), text
    assert len(terms) > 3


@pytest.mark.parametrize("name", ["sin", "cos", "tan", "exp", "tanh", "power"])
def test_functions_give_the_nearest_double(name):
    if np.finfo(np.longdouble).eps > 1e-18:
        pytest.skip("NOT CHECKED: no extended precision on this machine")
    rng = np.random.default_rng(2)
    for x in rng.uniform(-3.0, 3.0, 300):
        wide = np.longdouble(x)
        if name == "power":
            got, exact = compute_power(abs(x), 2.7), np.abs(wide) ** np.longdouble(2.7)
        else:
            got, exact = ROUNDED[name](x), getattr(np, name)(wide)
        assert abs(got - exact) <= 0.501 * np.spacing(abs(got))


def test_functions_refuse_what_has_no_value():
    for text, error in (
        ("exp(1e9)", OverflowError),
        ("1e200**2", OverflowError),
        ("0**-1", ZeroDivisionError),
        ("sqrt(-1)", ValueError),
        ("(-8)**0.5", TypeError),
    ):
        with pytest.raises(error):
            parse_expression(text).evaluate()
    assert parse_expression("2**10 + (-2)**3 + 0**0").evaluate() == 1017.0
    assert parse_expression("sign(-3)*abs(-2) + cos(0) + sin(1e22)").evaluate() == pytest.approx(
        -1 + math.sin(1e22)
    )
