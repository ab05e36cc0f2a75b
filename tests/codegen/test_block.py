"""The shape of an emitted function body: order, names, counts."""

import re
from fractions import Fraction

import pytest

from modeler.codegen.block import make_block, number_text
from modeler.codegen.targets import DOUBLE, FUNCTIONS, SINGLE, TILES
from modeler.core.errors import EmitError
from modeler.derivation.graph import Graph
from tests.modules import module

PLACES = {"q0": "q[0]", "q1": "q[1]", "D4": "ARM_GEO_D4", "g": "ARM_GEO_g"}


def test_two_angles_of_one_joint_get_two_names():
    graph = Graph()
    q0, g = graph.symbol("q0"), graph.symbol("g", static=True)
    block = make_block(
        [("tau[0]", graph.call("cos", q0) + graph.call("cos", q0 + g) + graph.call("sin", q0))],
        PLACES,
    )
    names = re.findall(r"double (\w+), (\w+);", " ".join(block.calls))
    assert len({name for pair in names for name in pair}) == 4


def test_a_very_long_sum_is_cut_into_readable_lines():
    graph = Graph()
    total = graph.constant(0)
    places = {f"x{i}": f"chi[{i}]" for i in range(300)}
    for name in places:
        total = total + graph.symbol(name)
    block = make_block([("beta[0]", total)], places)
    assert max(len(line) for line in block.body) <= 100
    assert sum(line.count(" + ") for line in block.body) == 299


def test_a_symbol_with_a_very_long_name_is_written_out():
    graph = Graph()
    name = "length_of_the_" + "very_" * 20 + "long_link"
    place = f"ARM_GEO_{name}"
    long, q = graph.symbol(name, static=True), graph.symbol("q0")
    block = make_block([("phi[0]", long * q), ("phi[1]", long)], {**PLACES, name: place})
    lines = tuple(" ".join(line.split()) for line in block.body)
    assert lines == (f"phi[0] = {place}*q[0];", f"phi[1] = {place};")


def test_pi_is_written_as_a_number():
    graph = Graph()
    angle = graph.symbol("q0") + graph.pi() / 7
    block = make_block([("phi[0]", graph.call("sin", angle)), ("phi[1]", graph.pi())], PLACES)
    assert block.constants == ("const double k1 = 3.14159265358979323846*(1.0/7.0);",)
    assert block.calls[1] == "modeler_sincos(q[0] + k1, &sa1, &ca1);"
    assert block.body == ("phi[0] = sa1;", "phi[1] = 3.14159265358979323846;")


def test_each_temporary_is_defined_once_and_before_its_use():
    block = module("puma560").emitted.files["puma560_base_regressor.c"]
    for body in re.findall(r"^\{\n(.*?)^\}", block, re.M | re.S):
        seen: set[str] = set()
        for line in body.splitlines():
            names = re.findall(r"double (\w+)(?:, (\w+);| =)", line)
            new = {name for pair in names for name in pair if name}
            assert not new & seen, line
            used = set(re.findall(r"\b[tksc]\d+\b", line.split("=", 1)[-1]))
            assert used - new <= seen, line
            seen |= new
        assert seen


@pytest.mark.parametrize("target", [DOUBLE, SINGLE, *TILES.values()])
def test_a_target_names_all_functions(target):
    assert set(target.functions) == set(FUNCTIONS)


def test_a_tile_has_lanes_for_what_moves_and_numbers_for_what_does_not():
    graph = Graph()
    x, length = graph.symbol("q0"), graph.symbol("D4", static=True)
    values = [
        graph.call("cos", length) * graph.call("sin", x),
        graph.power(length, x),
        length * length,
        x - x,
    ]
    values.append(graph.constant(-1))
    pairs = [(f"out[{k}]", value) for k, value in enumerate(values)]
    made = make_block(pairs, PLACES, target=TILES["double"])
    assert made.constants and all(line.startswith("const double k") for line in made.constants)
    assert not any(word in line for line in made.body for word in ("double", " sin(", " pow("))
    assert made.body[-3].startswith("out[2] = modeler_lanes_spread(")
    assert made.body[-2:] == (
        "out[3] = modeler_lanes_spread(0.0);", "out[4] = modeler_lanes_spread(-1.0);"
    )  # fmt: skip


def test_single_precision_has_its_own_limits():
    assert number_text(Fraction("0.1"), SINGLE).text == "0.1f"
    assert number_text(Fraction(1, 3), SINGLE).text == "(1.0f/3.0f)"
    assert number_text(Fraction(1, 2**24 + 1), SINGLE).text == f"{1 / (2**24 + 1)!r}f"
    with pytest.raises(EmitError, match=r"too large for single precision, which has .* rescale"):
        number_text(Fraction(10**39), SINGLE)


def test_the_sign_that_turns_over_a_width_follows_the_target():
    graph = Graph()
    v = graph.symbol("q0")
    made = make_block([("out[0]", graph.call("sign", v))], PLACES, {abs(v.ref): "width"}, SINGLE)
    assert made.calls == ("const float t1 = smooth_sign(q[0], width);",)
