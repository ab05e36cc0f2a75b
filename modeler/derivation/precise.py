"""Graph expressions in ball arithmetic: numbers that carry a bound of their own error.

A ball [m +- r] holds the true value, whatever was rounded on the way (Johansson 2017, "Arb"). What
a ball excludes is excluded for certain: that is a proof, where a small number in floating point is
not. Numbers of the robot file are the decimals that it says, symbols are their own expressions.
"""

import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

from modeler.core.expression import FUNCTIONS
from modeler.core.rounded import precise
from modeler.derivation.graph import Expr, Graph, combined
from modeler.robot.robot import Robot

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
                self._fixed[index] = _ball_value(node.op, node.args, symbols, self._fixed)
            else:
                self._moving.append((index, node.op, node.args))

    def __call__(self, inputs: Mapping[str, Ball]) -> list[Ball]:
        """The outputs' balls; `inputs` by name as `q[0]`."""
        found = dict(self._fixed)
        for index, op, args in self._moving:
            found[index] = _ball_value(op, args, inputs, found)
        return [found[ref] if ref >= 0 else -found[-ref] for ref in self._refs]


def _ball_value(
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


# Constants of the geometry that are zero for certain: in rational numbers, as they are written.


def surely_zero(expression: Expr, robot: Robot) -> bool:
    """True if an expression is 0 at the given values; False if it moves or is not rational.

    Lengths in a file are decimals, so sums and products of them are rational numbers: the offsets
    along the axes of a plane loop add up to 0, or they do not.
    """
    values: dict[str, Fraction] = {}
    for name, text in robot.symbols.items():
        try:
            values[name] = text.fold(values, {}, None, Fraction)
        except (KeyError, TypeError, ZeroDivisionError):
            continue  # an angle: missed where it is needed
    graph, found = expression.graph, {0: Fraction(0)}
    try:
        for index in graph.reachable([expression]):
            node = graph.nodes[index]
            if node.op == "num":
                found[index] = Fraction(node.args[0])
            elif node.op == "sym" and node.args[0] in values:
                found[index] = values[node.args[0]]
            elif node.op in ("add", "mul", "div"):
                found[index] = combined(node, found, {})
            else:
                return False
        return found[abs(expression.ref)] == 0
    except ZeroDivisionError:
        return False


# Graph expressions with 40 digits, for numbers that must be the same on every machine.
#
# Sines, sums and solutions of linear systems in double precision differ in the last digit from one
# processor to the next. What goes into the emitted C and its signature is computed here: its
# nearest double is the same everywhere.


Number = Any
"""A number of the context `modeler.core.rounded.precise()`."""


def precise_values(
    graph: Graph, outputs: Sequence[Expr], values: Mapping[str, float | Number]
) -> list[Number]:
    """Values of the outputs, 40 digits; `values` gives a number per symbol.

    A double counts as the decimal that it prints, which is what was written: 0.3 is 3/10.
    """
    mp = precise()
    found: dict[int, Number] = {0: mp.zero}
    for index in graph.reachable(outputs):
        node = graph.nodes[index]
        if node.op == "num":
            found[index] = mp.mpf(node.args[0].numerator) / node.args[0].denominator
        elif node.op == "pi":
            found[index] = +mp.pi
        elif node.op == "sym":
            found[index] = decimal(values[node.args[0]])
        else:
            found[index] = combined(node, found, _functions())
    return [found[abs(o.ref)] if o.ref >= 0 else -found[-o.ref] for o in outputs]


def decimal(value: float | Number) -> Number:
    """A double as the decimal that it prints; a number of 40 digits as it is."""
    return precise().mpf(repr(float(value)) if isinstance(value, float) else value)


@cache
def _functions() -> Mapping[str, Callable[..., Number]]:
    mp = precise()
    names = ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh")
    return {name: getattr(mp, name) for name in names} | {"abs": abs, "pow": mp.power}
