"""Graph expressions with 40 digits, for numbers that must be the same on every machine.

Sines, sums and solutions of linear systems in double precision differ in the last digit from one
processor to the next. What goes into the emitted C and its signature is computed here: its nearest
double is the same everywhere.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

from modeler.core.rounded import precise
from modeler.symbolic.graph import Expr, Graph, Node, combined

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
    return combined(node, found, _functions())


@cache
def _functions() -> Mapping[str, Callable[..., Number]]:
    mp = precise()
    names = ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh")
    return {name: getattr(mp, name) for name in names} | {"abs": abs, "pow": mp.power}
