"""Ball arithmetic on the expression graph: the true value is inside, and what is outside is not."""

import math

import mpmath
import numpy as np
import pytest

from modeler.derivation.graph import Graph
from modeler.derivation.precise import (
    build_ball,
    build_ball_function,
    enclose_symbols,
    evaluate_precisely,
    is_proven_regular,
    load_flint,
)
from modeler.robot.read import parse_robot_text
from tests.modules import module

arb = load_flint().arb


def around(value):
    """A ball that holds a number of 40 digits."""
    return arb(mpmath.nstr(value, 39), 1e-35 * max(1.0, abs(float(value))))


@pytest.mark.parametrize("name", ["five-bar", "wrist", "scara"])
def test_entries_of_the_regressor_are_inside(name):
    """Floating point is near the ball, 40 digits are in it."""
    model = module(name).model
    outputs = list(model.regressor.values())
    rng = np.random.default_rng(4)
    n = model.geometry.coordinate_count
    names = [f"{kind}[{k}]" for kind in ("q", "qd", "qdd") for k in range(n)]
    inputs = {name: float(x) for name, x in zip(names, rng.normal(size=3 * n), strict=True)}
    inputs |= {f"s[{k}]": 0.5 for k in range(len(model.signals))}
    values = {**model.geometry.values, **inputs}
    rough = model.graph.evaluate_outputs(outputs, values)
    exact = evaluate_precisely(model.graph, outputs, values)
    with load_flint().ctx.workprec(100):
        decimal = {name: arb(repr(x)) for name, x in inputs.items()}
        balls = build_ball_function(model.graph, outputs, enclose_symbols(model.robot))(decimal)
        for ball, near, true in zip(balls, rough, exact, strict=True):
            assert ball.overlaps(around(true))
            assert float(ball.rad()) < 1e-24 * max(1.0, abs(near))
            assert abs(float(ball.mid()) - near) < 1e-12 * max(1.0, abs(near))


def test_every_function_of_the_language():
    graph = Graph()
    x = graph.symbol("x")
    names = ("sin", "cos", "tan", "sqrt", "exp", "abs", "sign", "tanh")
    outputs = [graph.call(name, x) for name in names]
    outputs += [graph.power(x, graph.constant(1) / 3), graph.pi() * x, 1 / x, -x, graph.constant(0)]
    result = build_ball_function(graph, outputs, {})({"x": build_ball(0.75)})
    rough = [getattr(math, name)(0.75) for name in ("sin", "cos", "tan", "sqrt", "exp")]
    rough += [0.75, 1.0, math.tanh(0.75), 0.75 ** (1 / 3), math.pi * 0.75, 1 / 0.75, -0.75, 0.0]
    for ball, near in zip(result, rough, strict=True):
        assert abs(float(ball.mid()) - near) < 1e-14 and float(ball.rad()) < 1e-14


def test_symbols_are_what_the_file_says():
    """sqrt(2)/2 is that number, not the double next to it; 0.1 is a tenth."""
    text = (
        'name = "t"\ngravity = [0, 0, "-g"]\n[symbols]\ng = 0.1\nL = "sqrt(2)/2"\nK = "3*L + g"\n'
        '[mdh]\ncolumns = ["j", "a", "d", "theta"]\nrows = [["1", "0", "L", "q1"]]\n'
    )
    with load_flint().ctx.workprec(200):
        values = enclose_symbols(parse_robot_text(text, "t.toml"))
        assert (values["L"] ** 2 * 2).contains(1) and not values["L"].contains(math.sqrt(2) / 2)
        assert (values["g"] * 10).contains(1) and not values["g"].contains(0.1)
        assert values["K"].overlaps(3 * values["L"] + values["g"])


def test_regular_is_said_of_what_is_regular_only():
    third = build_ball(1) / 3
    assert is_proven_regular([[build_ball(1), third], [third, build_ball(1)]])
    assert not is_proven_regular([[build_ball(1), third], [build_ball(3), build_ball(1)]])
    wide = arb(0, 0.4)
    assert not is_proven_regular([[third, wide], [wide, third]])
