"""Graph expressions in ball arithmetic: numbers that carry a bound of their own error.

A ball [m +- r] holds the true value, whatever was rounded on the way (Johansson 2017, "Arb"). What
a ball excludes is excluded for certain: that is a proof, where a small number in floating point is
not. Numbers of the robot file are the decimals that it says, symbols are their own expressions.
"""

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

from modeler.core.expression import FUNCTIONS
from modeler.robot import Robot
from modeler.symbolic.graph import Expr, Graph

Ball = Any
"""An `arb` of python-flint: a real ball."""


@cache
def flint() -> Any:
    """The library of ball arithmetic; its precision is `flint().ctx.workprec(bits)`."""
    # Only here: most derivations need no balls.
    import flint as library

    return library


def exact_ball(value: Any) -> Ball:
    """The ball around a fraction, or the ball of radius 0 that is a double or a whole number."""
    if isinstance(value, int | float):
        return flint().arb(value)
    return flint().arb(flint().fmpq(value.numerator, value.denominator))


def symbol_balls(robot: Robot) -> dict[str, Ball]:
    """The value of every symbol of a robot, by name, as its expression says it."""
    known: dict[str, Ball] = {}
    for name, expression in robot.symbols.items():
        known[name] = expression.fold(known, _CALLS, flint().arb.pi(), exact_ball, operator.pow)
    return known


class BallFunction:
    """Expressions of a graph as one function of their inputs, at the precision of the caller."""

    def __init__(self, graph: Graph, outputs: Sequence[Expr], symbols: Mapping[str, Ball]) -> None:
        """A function of what is neither a number nor among `symbols`.

        Args:
            graph: of the expressions.
            outputs: the expressions.
            symbols: geometric symbols by name.
        """
        self._refs = [output.ref for output in outputs]
        self._fixed: dict[int, Ball] = {0: exact_ball(0)}
        self._moving = []
        for index in graph.reachable(outputs):
            node = graph.nodes[index]
            if node.static:
                self._fixed[index] = _value(node.op, node.args, symbols, self._fixed)
            else:
                self._moving.append((index, node.op, node.args))

    def __call__(self, inputs: Mapping[str, Ball]) -> list[Ball]:
        """The outputs' balls; `inputs` by name as `q[0]`."""
        found = dict(self._fixed)
        for index, op, args in self._moving:
            found[index] = _value(op, args, inputs, found)
        return [found[ref] if ref >= 0 else -found[-ref] for ref in self._refs]


def _value(
    op: str, args: tuple[Any, ...], values: Mapping[str, Ball], found: Mapping[int, Ball]
) -> Ball:
    if op == "num":
        return exact_ball(args[0])
    if op == "pi":
        return flint().arb.pi()
    if op == "sym":
        return values[args[0]]
    return _CALLS[op](*[found[arg] if arg >= 0 else -found[-arg] for arg in args])


def _named(name: str) -> Callable[[Ball], Ball]:
    return operator.methodcaller({"sign": "sgn"}.get(name, name))


_CALLS: Mapping[str, Callable[..., Ball]] = {
    "add": operator.add,
    "mul": operator.mul,
    "div": operator.truediv,
    "pow": operator.pow,
} | {name: abs if name == "abs" else _named(name) for name in FUNCTIONS}


def proven_regular(matrix: Sequence[Sequence[Ball]]) -> bool:
    """True if every square matrix within the balls is regular; False if that is not certain.

    The system with the right side 1 is solved in balls, which Arb does only where the matrix is
    proven regular (by the product with an approximate inverse, or by pivots without zero).
    """
    rows = flint().arb_mat(matrix)
    try:
        rows.solve(flint().arb_mat([[1]] * rows.nrows()))
    except ZeroDivisionError:
        return False
    return True
