"""Graph expressions with 40 digits, for numbers that must be the same on every machine.

Sines, sums and solutions of linear systems in double precision differ in the last digit from one
processor to the next. What goes into the emitted C and its signature is computed here: its nearest
double is the same everywhere.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from modeler.core.rounded import precise
from modeler.symbolic.graph import Expr, Graph, Node

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
        found[index] = _value(graph.nodes[index], values, found)
    return [found[abs(o.ref)] if o.ref >= 0 else -found[-o.ref] for o in outputs]


def decimal(value: float | Number) -> Number:
    """A double as the decimal that it prints; a number of 40 digits as it is."""
    return precise().mpf(repr(float(value)) if isinstance(value, float) else value)


def _value(node: Node, values: Mapping[str, float | Number], found: Mapping[int, Number]) -> Number:
    mp = precise()
    if node.op == "num":
        return mp.mpf(node.args[0].numerator) / node.args[0].denominator
    if node.op == "pi":
        return +mp.pi
    if node.op == "sym":
        return decimal(values[node.args[0]])
    args = [found[arg] if arg >= 0 else -found[-arg] for arg in node.args]
    if node.op == "add":
        return args[0] + args[1]
    if node.op == "mul":
        return args[0] * args[1]
    if node.op == "div":
        return args[0] / args[1]
    if node.op == "pow":
        return mp.power(args[0], args[1])
    return abs(args[0]) if node.op == "abs" else getattr(mp, node.op)(args[0])
