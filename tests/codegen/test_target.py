"""The same function for other number types: every literal, name and type follows the target."""

import ctypes
import subprocess
from fractions import Fraction

import numpy as np
import pytest

from modeler.codegen.block import Block, make_block, number_text
from modeler.codegen.targets import DOUBLE, FUNCTIONS, SINGLE, TILES
from modeler.core.errors import EmitError
from modeler.derivation.graph import Expr, Graph
from tests.modules import compiler

VALUES = {"x": 0.75, "y": -1.25, "L": 0.3}
PLACES = {"x": "in[0]", "y": "in[1]", "L": "arm_geo_L"}

SINGLE_SOURCE = """
#include <math.h>
static const float arm_geo_L = 0.3f;
static void modeler_sincos(float x, float *s, float *c) {{ *s = sinf(x); *c = cosf(x); }}
static float modeler_sign(float x) {{ return (float)((x > 0.0f) - (x < 0.0f)); }}
static float smooth_sign(float v, float width) {{ return tanhf(v/width); }}
void f(const float *in, float *out);
void f(const float *in, float *out)
{{
{lines}
}}
"""


def every_operation() -> list[tuple[Expr, float]]:
    """Expressions that together hold every operation, with their values in double."""
    graph = Graph()
    x, y = graph.symbol("x"), graph.symbol("y")
    length = graph.symbol("L", static=True)
    X, Y, L = VALUES.values()

    def f(name: str, value: Expr) -> Expr:
        return graph.call(name, value)

    return [
        (f("sin", x) * f("cos", y) - x / 3, np.sin(X) * np.cos(Y) - X / 3),
        (f("tan", y) + f("exp", x) * f("tanh", x), np.tan(Y) + np.exp(X) * np.tanh(X)),
        (f("abs", y) - f("sqrt", x + 1) * f("sign", y), abs(Y) + np.sqrt(X + 1)),
        (graph.power(f("abs", y), length) * graph.pi(), abs(Y) ** L * np.pi),
        (graph.power(length, x), L**X),
        (f("cos", length) * x + Fraction("9.81"), np.cos(L) * X + 9.81),
        (length * length, L * L),
        (-(x - x), 0.0),
        (graph.constant(-1), -1.0),
    ]


def block(target) -> Block:
    return make_block(
        [(f"out[{k}]", value) for k, (value, _) in enumerate(every_operation())],
        PLACES,
        target=target,
    )


def test_single_precision_computes_the_same_without_one_double(tmp_path):
    made = block(SINGLE)
    lines = "\n".join((*made.constants, *made.calls, *made.body))
    (tmp_path / "f.c").write_text(SINGLE_SOURCE.format(lines=lines))
    command = [compiler("gcc"), "-std=c99", "-O1", "-shared", "-fPIC", "-Wall", "-Wextra"]
    command += ["-Wdouble-promotion", "-Wfloat-conversion", "-Wno-unused-function", "-Werror"]
    subprocess.run([*command, "-o", tmp_path / "f.so", tmp_path / "f.c", "-lm"], check=True)
    given = np.array([VALUES["x"], VALUES["y"]], dtype=np.float32)
    expected = np.array([value for _, value in every_operation()])
    out = np.empty(len(expected), dtype=np.float32)
    float_p = ctypes.POINTER(ctypes.c_float)
    ctypes.CDLL(str(tmp_path / "f.so")).f(
        given.ctypes.data_as(float_p), out.ctypes.data_as(float_p)
    )
    np.testing.assert_allclose(out, expected, rtol=2e-6, atol=1e-7)


@pytest.mark.parametrize("target", [DOUBLE, SINGLE, *TILES.values()])
def test_a_target_names_all_functions(target):
    assert set(target.functions) == set(FUNCTIONS)


def test_a_tile_has_lanes_for_what_moves_and_numbers_for_what_does_not():
    made = block(TILES["double"])
    assert all(line.startswith("const double k") for line in made.constants)
    assert not any(word in line for line in made.body for word in ("double", " sin(", " pow("))
    assert made.body[-3].startswith("out[6] = modeler_lanes_spread(")
    assert made.body[-2:] == (
        "out[7] = modeler_lanes_spread(0.0);",
        "out[8] = modeler_lanes_spread(-1.0);",
    )


def test_single_precision_has_its_own_limits():
    assert number_text(Fraction("0.1"), SINGLE).text == "0.1f"
    assert number_text(Fraction(1, 3), SINGLE).text == "(1.0f/3.0f)"
    assert number_text(Fraction(1, 2**24 + 1), SINGLE).text == f"{1 / (2**24 + 1)!r}f"
    with pytest.raises(EmitError, match=r"too large for single precision, which has .* rescale"):
        number_text(Fraction(10**39), SINGLE)


def test_the_sign_that_turns_over_a_width_follows_the_target():
    graph = Graph()
    v = graph.symbol("x")
    made = make_block([("out[0]", graph.call("sign", v))], PLACES, {abs(v.ref): "width"}, SINGLE)
    assert made.calls == ("const float t1 = smooth_sign(in[0], width);",)
