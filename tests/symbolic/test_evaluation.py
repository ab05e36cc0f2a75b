"""Steps that are listed once give what the operations one after the other give."""

import itertools

import numpy as np

from modeler.derivation.graph import Graph


def test_every_operation_with_every_sign() -> None:
    graph = Graph()
    x, y = graph.symbol("x"), graph.symbol("y")
    values = {"x": np.array([0.3, 0.0, -2.0, 1e300]), "y": np.array([0.7, -0.0, 0.0, 1e-300])}
    a, b = values["x"], values["y"]
    with np.errstate(all="ignore"):
        for s, t in itertools.product((1.0, -1.0), repeat=2):
            u, v = (x if s > 0 else -x), (y if t > 0 else -y)
            actual = graph.evaluate_outputs([u + v, u * v, u / v, -(u + v)], values)
            lines = [s * a + t * b, (s * a) * (t * b), (s * a) / (t * b), -(s * a + t * b)]
            for one, other in zip(actual, lines, strict=True):
                np.testing.assert_array_equal(one, other)
            for name in ("sin", "cos", "tan", "exp", "abs", "sign", "tanh", "sqrt"):
                function = getattr(np, name)
                (one,) = graph.evaluate_outputs([graph.call(name, u)], values)
                np.testing.assert_array_equal(one, function(s * a))
