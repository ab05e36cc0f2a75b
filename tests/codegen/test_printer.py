"""The printed C against plain Python arithmetic on the same operations."""

import ctypes
import operator
import subprocess
from fractions import Fraction

import numpy as np
import pytest

from modeler.codegen.block import make_block, number_text
from modeler.codegen.targets import DOUBLE, SINGLE
from modeler.core.errors import EmitError
from modeler.core.files import resource_dir
from modeler.derivation.graph import Expr, Graph
from tests.modules import compiler

INPUTS = ("x", "y", "z")
OPERATORS = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv
}  # fmt: skip


class Pair:
    """A graph expression and its value, computed side by side by different code."""

    def __init__(self, expr: Expr, value: float, depth: int = 0) -> None:
        self.expr, self.value, self.depth = expr, value, depth


def call(name: str, pair: Pair) -> Pair:
    function = {"abs": abs, "sign": np.sign}.get(name) or getattr(np, name)
    return Pair(pair.expr.graph.call(name, pair.expr), float(function(pair.value)))


def combine(op: str, a: Pair, b: Pair) -> Pair:
    apply = OPERATORS[op]
    return Pair(apply(a.expr, b.expr), apply(a.value, b.value))


def run_in_c(outputs: list[Expr], values: dict[str, float], tmp_path, target=DOUBLE) -> np.ndarray:
    places = {name: f"in[{i}]" for i, name in enumerate(values)}
    block = make_block(
        [(f"out[{i}]", expr) for i, expr in enumerate(outputs)], places, target=target
    )
    lines = "\n".join((*block.constants, *block.calls, *block.body))
    number, kind = ("float", np.float32) if target is SINGLE else ("double", np.float64)
    source, library = tmp_path / "f.c", tmp_path / "f.so"
    source.write_text(
        '#include "modeler_real.h"\n#include "modeler_runtime.h"\n#include "modeler_sincos.h"\n'
        f"void f(const {number} *in, {number} *out);\n"
        f"void f(const {number} *in, {number} *out)\n{{\n(void)in;\n{lines}\n}}\n"
    )
    csrc = resource_dir("csrc")
    floats = ["-Wdouble-promotion", "-Wfloat-conversion", "-I", csrc / "single"]
    # No contraction: what is printed must be what Python computes.
    command = [compiler("gcc"), "-std=c99", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable",
               *floats * (target is SINGLE), "-I", csrc / "include", "-O1", "-ffp-contract=off",
               "-shared", "-fPIC", "-o", library, source, "-lm"]  # fmt: skip
    subprocess.run(command, check=True)
    given, out = np.array(list(values.values()), kind), np.empty(len(outputs), kind)
    arrays = (array.ctypes.data_as(ctypes.c_void_p) for array in (given, out))
    ctypes.CDLL(str(library)).f(*arrays)
    return out


def random_pairs(graph: Graph, values: dict[str, float], rng: np.random.Generator) -> list[Pair]:
    """Hundreds of expressions of each other: every operation, every sign, shared and not."""
    pool = [Pair(graph.symbol(n, static=n == "z"), v) for n, v in values.items()]
    pool += [
        Pair(graph.constant(c), float(c))
        for c in (Fraction(2), Fraction(-1), Fraction(1, 3), Fraction(-981, 100), Fraction(1, 8))
    ]
    while len(pool) < 400:
        a, b = (pool[i] for i in rng.integers(0, len(pool), 2))
        kind = rng.integers(0, 10)
        if kind < 8:
            made = combine("+-*/+-*-"[kind], a, b) if abs(b.value) > 0.1 else a
            scale = max(abs(a.value), abs(b.value))
        else:
            made = call(("sin", "cos", "tan", "tanh", "abs", "sign")[rng.integers(0, 6)], a)
            scale = abs(a.value)
        made.depth = max(a.depth, b.depth) + 1
        if rng.integers(0, 4) == 0:
            made = Pair(-made.expr, -made.value, made.depth)
        # No cancellation and no long chains: roundings of the graph's order stay roundings.
        if made.depth <= 6 and 0.05 * scale < abs(made.value) < 1e2:
            pool.append(made)
    return pool


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.rotating)])
def test_printed_expressions_compute_what_python_does(seed, tmp_path):
    rng = np.random.default_rng(seed)
    values = dict(zip(INPUTS, rng.uniform(-2, 2, 3), strict=True))
    pairs = random_pairs(Graph(), values, rng)
    got = run_in_c([pair.expr for pair in pairs], values, tmp_path)
    np.testing.assert_allclose(got, [pair.value for pair in pairs], rtol=1e-10)


@pytest.mark.parametrize(("target", "rtol"), [(DOUBLE, 1e-14), (SINGLE, 3e-6)])
def test_every_operation_keeps_its_signs_and_parentheses(target, rtol, tmp_path):
    values = {"x": 0.7, "y": -1.3, "z": 2.1}
    graph = Graph()
    x, y, z = (graph.symbol(name) for name in values)
    X, Y, Z = values.values()
    cases = {
        "a": (x - (y - z), X - (Y - Z)),
        "b": (-(x - y) - z, -(X - Y) - Z),
        "c": (x / (y * z), X / (Y * Z)),
        "d": (x / (y / z), X / (Y / Z)),
        "e": ((x / y) / z, X / Y / Z),
        "f": (y / (x * x), Y / (X * X)),
        "g": ((x + y) * (x - y) / (z + 1), (X + Y) * (X - Y) / (Z + 1)),
        "h": (-(x * y) * -(z + x), -(X * Y) * -(Z + X)),
        "i": (x - x, 0.0),
        "j": (graph.call("sign", y - x), -1.0),
        "k": (graph.call("sign", x - x), 0.0),
        "l": (graph.call("exp", -(x - y)), np.exp(Y - X)),
        "m": (graph.call("abs", y * z) * 3, abs(Y * Z) * 3),
        "n": (graph.call("sqrt", x + z) / 3, np.sqrt(X + Z) / 3),
        "o": (1 / x - 1 / (y - z), 1 / X - 1 / (Y - Z)),
        "p": (-x - y - z, -X - Y - Z),
        "q": (graph.call("sign", y) / graph.call("sign", z) / 2, -0.5),
        "r": (x**-3, X**-3),
        "s": (graph.constant(Fraction(-1, 3)) - x, -1 / 3 - X),
        "t": (graph.call("tanh", graph.call("tan", x)), np.tanh(np.tan(X))),
        "u": (graph.call("sin", x) * graph.call("cos", y), np.sin(X) * np.cos(Y)),
        "v": (graph.power(graph.call("abs", y), z) * graph.pi(), abs(Y) ** Z * np.pi),
        "w": (x + Fraction("9.81"), X + 9.81),
    }
    got = run_in_c([expr for expr, _ in cases.values()], values, tmp_path, target)
    expected = [value for _, value in cases.values()]
    np.testing.assert_allclose(got, expected, rtol=rtol, atol=0, err_msg=str(list(cases)))


@pytest.mark.parametrize(
    "value",
    ["9.81", "0", "2", "1/3", "1/10", "7/1024", "1e-12", "123456789012345678901234567890/7",
     "3.14159265358979323846"],
)  # fmt: skip
def test_a_number_is_printed_as_the_double_nearest_to_it(value):
    exact = Fraction(value)
    text = number_text(exact).text
    assert eval(text) == float(exact)
    assert "." in text or "e" in text, "an integer literal would divide as integers do"


def test_numbers_beyond_the_precision_are_refused():
    assert number_text(Fraction("0.0825")).text == "0.0825"
    assert number_text(Fraction("0.1"), SINGLE).text == "0.1f"
    assert number_text(Fraction(1, 3), SINGLE).text == "(1.0f/3.0f)"
    assert number_text(Fraction(1, 2**24 + 1), SINGLE).text == f"{1 / (2**24 + 1)!r}f"
    for size, target in ((400, DOUBLE), (39, SINGLE)):
        says = f"too large for {target.precision} precision, which has .* rescale"
        with pytest.raises(EmitError, match=says):
            number_text(Fraction(10**size), target)


def test_an_unknown_function_is_refused():
    graph = Graph()
    with pytest.raises(EmitError, match="function erf has no C99 form here; expected sin"):
        make_block([("out[0]", graph.call("erf", graph.symbol("x")))], {"x": "in[0]"})


def test_a_symbol_without_a_place_is_refused():
    with pytest.raises(EmitError, match="symbol lost has no place"):
        make_block([("out[0]", Graph().symbol("lost"))], {})
