"""Straight-line elimination of loop equations: against dense algebra, and how much it saves."""

import numpy as np
import pytest

from modeler.codegen.closed import solving_of
from modeler.codegen.fused import replaced
from modeler.derivation.graph import Graph
from modeler.derivation.walks import closed_walk, closing_of
from tests.modules import module

NAMES = ["five-bar", "orthoglide-2003", "stewart"]


def solved_numbers(name, head=""):
    """(elimination, J at closed postures, {symbol: values}, places of the given and the solved)."""
    model, base = module(name).model, module(name).base
    solving = solving_of(model, base)
    own, given = solving.eliminations[head], list(solving.sets[head])
    u = closed_walk(model, 6, np.random.default_rng(2), 0.3).postures
    J = closing_of(model).jacobians(u)
    values = dict(model.geometry.values)
    for k, (i, j) in enumerate(solving.pattern.places):
        values |= {f"J[{k}]": J[:, i, j], f"K[{k}]": np.roll(J, 1, axis=0)[:, i, j]}
    factors = evaluated(model.graph, own.factors, values, len(u))
    values |= {f"lu[{k}]": factors[:, k] for k in range(factors.shape[1])}
    return own, J, values, given, [k for k in range(J.shape[2]) if k not in given]


def evaluated(graph, outputs, values, n):
    """(n, outputs)."""
    return np.stack([np.broadcast_to(x, n) for x in graph.evaluate(list(outputs), values)], axis=1)


@pytest.mark.parametrize("name", NAMES)
def test_how_far_a_jacobian_has_turned_is_bounded_and_measured(name):
    model = module(name).model
    own, J, values, _, solved = solved_numbers(name)
    size = np.where(model.closure.lengths, model.closure.size, 1.0)[solved]
    inner, other = J[:, :, solved], np.roll(J, 1, axis=0)[:, :, solved]
    change = np.linalg.solve(inner, other - inner) * size / size[:, None]
    sums = np.abs(change).sum(axis=2)
    bound = evaluated(model.graph, own.turned, values, len(J))
    assert (bound >= sums * (1.0 - 1e-9)).all()
    squares = evaluated(model.graph, [own.spread], values, len(J))[:, 0]
    np.testing.assert_allclose(squares, (change**2).sum(axis=(1, 2)), rtol=1e-8)
    assert ((bound**2).sum(axis=1) >= squares * (1.0 - 1e-9)).all()


def test_it_takes_a_tenth_of_dense_factors():
    own, _, _, _, solved = solved_numbers("stewart")
    m, graph = len(solved), module("stewart").model.graph
    _, multiplications = graph.operations(own.factors)
    assert multiplications < 0.1 * m**3 / 3 + 18
    assert max(graph.operations(own.solution)) < 0.4 * m**2


def test_expressions_are_rebuilt_with_others_in_their_place():
    graph = Graph()
    a, b, c = (graph.symbol(name) for name in "abc")
    turn = graph.call("sin", a + b)
    values = [turn * a - c / b + graph.power(b, c), graph.call("abs", -turn)]
    found = replaced(graph, values, {abs(turn.ref): c}, {"b": a + c})
    numbers = {"a": 0.3, "b": np.nan, "c": 0.7}
    expected = [0.7 * 0.3 - 0.7 / 1.0 + 1.0**0.7, 0.7]
    np.testing.assert_allclose(graph.evaluate(found, numbers), expected)
