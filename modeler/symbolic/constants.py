"""Constants of the geometry that are zero for certain: in rational numbers, as they are written."""

from collections.abc import Mapping
from fractions import Fraction

from modeler.robot import Robot
from modeler.symbolic.graph import Expr, combined


class _NotRational(Exception):
    """An angle, a root, or something that moves."""


def surely_zero(expression: Expr, robot: Robot) -> bool:
    """True if an expression is 0 at the given values; False if it moves or is not rational.

    Lengths in a file are decimals, so sums and products of them are rational numbers: the offsets
    along the axes of a plane loop add up to 0, or they do not.
    """
    try:
        values = _rational(robot)
        return _value(expression, values) == 0
    except (_NotRational, ZeroDivisionError):
        return False


def _rational(robot: Robot) -> dict[str, Fraction]:
    known: dict[str, Fraction] = {}
    for name, expression in robot.symbols.items():
        try:
            known[name] = expression.fold(known, {}, None, Fraction)
        except (KeyError, TypeError, ZeroDivisionError):
            continue  # an angle: missed where it is needed
    return known


def _value(expression: Expr, values: Mapping[str, Fraction]) -> Fraction:
    graph = expression.graph
    found: dict[int, Fraction] = {0: Fraction(0)}
    for index in graph.reachable([expression]):
        node = graph.nodes[index]
        if node.op == "num":
            found[index] = Fraction(node.args[0])
        elif node.op == "sym" and node.args[0] in values:
            found[index] = values[node.args[0]]
        elif node.op in ("add", "mul", "div"):
            found[index] = combined(node, found, {})
        else:
            raise _NotRational
    return found[expression.ref] if expression.ref >= 0 else -found[-expression.ref]
