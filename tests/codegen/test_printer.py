"""The printed C against plain Python arithmetic on the same operations."""

import ctypes
import subprocess
from fractions import Fraction

import numpy as np
import pytest

from modeler.codegen.block import DOUBLE, FUNCTIONS, SINGLE, TILES, format_number, make_block
from modeler.core.errors import EmitError
from modeler.core.files import locate_resources
from modeler.derivation.graph import Expr, Graph
from tests.modules import compiler


def run_in_c(outputs: list[Expr], values: dict[str, float], tmp_path, target=DOUBLE) -> np.ndarray:
    places = {name: f"in[{i}]" for i, name in enumerate(values)}
    block = make_block([(f"out[{i}]", e) for i, e in enumerate(outputs)], places, target=target)
    lines = "\n".join((*block.constants, *block.calls, *block.body))
    number, kind = ("float", np.float32) if target is SINGLE else ("double", np.float64)
    source, library = tmp_path / "f.c", tmp_path / "f.so"
    source.write_text(
        '#include "modeler_real.h"\n#include "modeler_runtime.h"\n#include "modeler_sincos.h"\n'
        f"void f(const {number} *in, {number} *out);\n"
        f"void f(const {number} *in, {number} *out)\n{{\n(void)in;\n{lines}\n}}\n"
    )
    csrc = locate_resources("csrc")
    floats = ["-Wdouble-promotion", "-Wfloat-conversion", "-I", csrc / "single"]
    # No contraction: what is printed must be what Python computes.
    command = [
        compiler("gcc"),
        *"-std=c99 -Wall -Wextra -Werror -Wno-unused-variable".split(),
        *floats * (target is SINGLE),
        "-I",
        csrc / "include",
        *"-O1 -ffp-contract=off -shared -fPIC -o".split(),
        library,
        source,
        "-lm",
    ]
    subprocess.run(command, check=True)
    inputs, out = np.array(list(values.values()), kind), np.empty(len(outputs), kind)
    arrays = (array.ctypes.data_as(ctypes.c_void_p) for array in (inputs, out))
    ctypes.CDLL(str(library)).f(*arrays)
    return out


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
        "two angles of one joint": (
            graph.call("cos", x) + graph.call("cos", x + z) + graph.call("sin", x),
            np.cos(X) + np.cos(X + Z) + np.sin(X),
        ),
        "a fraction of pi": (graph.call("sin", x + graph.pi() / 7), np.sin(X + np.pi / 7)),
        "negative": (graph.constant(-1), -1.0),
    }
    got = run_in_c([expr for expr, _ in cases.values()], values, tmp_path, target)
    expected = [value for _, value in cases.values()]
    np.testing.assert_allclose(got, expected, rtol=rtol, atol=0, err_msg=str(list(cases)))


@pytest.mark.parametrize(
    "value", ["9.81", "0", "2", "1/3", "7/1024", "1e-12", "123456789012345678901234567890/7"]
)
def test_a_number_is_printed_as_the_double_nearest_to_it(value):
    exact = Fraction(value)
    text = format_number(exact).text
    assert eval(text) == float(exact)
    assert "." in text or "e" in text, "an integer literal would divide as integers do"


def test_numbers_of_single_precision_and_those_beyond_a_precision():
    assert format_number(Fraction("0.1"), SINGLE).text == "0.1f"
    assert format_number(Fraction(1, 3), SINGLE).text == "(1.0f/3.0f)"
    assert format_number(Fraction(1, 2**24 + 1), SINGLE).text == f"{1 / (2**24 + 1)!r}f"
    for size, target in ((400, DOUBLE), (39, SINGLE)):
        says = f"too large for {target.precision} precision, which has .* rescale"
        with pytest.raises(EmitError, match=says):
            format_number(Fraction(10**size), target)
    for number, what in ((1e60, "large"), (-4e-50, "small")):
        says = rf"too {what} for single precision.* or generate in double"
        with pytest.raises(EmitError, match=says):
            SINGLE.format_literal(number)
        assert DOUBLE.format_literal(number) == repr(number)


def test_what_has_no_form_in_c_is_refused():
    graph = Graph()
    for expression, places, says in (
        (
            graph.call("erf", graph.symbol("x")),
            {"x": "in[0]"},
            "function erf has no C99 form here; expected sin",
        ),
        (graph.symbol("lost"), {}, "symbol lost has no place"),
    ):
        with pytest.raises(EmitError, match=says):
            make_block([("out[0]", expression)], places)


@pytest.mark.parametrize("target", [DOUBLE, SINGLE, *TILES.values()])
def test_a_target_names_all_functions(target):
    assert set(target.functions) == set(FUNCTIONS)


def test_a_symbol_with_a_very_long_name_is_written_out():
    graph = Graph()
    name = "length_of_the_" + "very_" * 20 + "long_link"
    place = f"ARM_GEO_{name}"
    long, q = graph.symbol(name, static=True), graph.symbol("q0")
    block = make_block([("phi[0]", long * q), ("phi[1]", long)], {"q0": "q[0]", name: place})
    lines = tuple(" ".join(line.split()) for line in block.body)
    assert lines == (f"phi[0] = {place}*q[0];", f"phi[1] = {place};")
