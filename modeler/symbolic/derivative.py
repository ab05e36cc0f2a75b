"""Derivatives of graph expressions along a direction, by the rules of differentiation."""

from collections.abc import Mapping, Sequence

from modeler.core.errors import DerivationError
from modeler.symbolic.graph import Expr, Node

_EVERYWHERE = {"add", "mul", "div", "sin", "cos", "sqrt", "exp", "tan", "tanh"}
"""Operations that have a derivative wherever they have a value, for our purposes."""


def derivatives(values: Sequence[Expr], direction: Mapping[str, Expr]) -> list[Expr]:
    """d values / ds where each symbol of `direction` moves with that speed; others stand still.

    With speeds 1 and 0 these are partial derivatives; with dq/dt they are time derivatives.

    Raises:
        DerivationError: a function that has no derivative everywhere (sign, abs).
    """
    if not values:
        return []
    graph = values[0].graph
    zero = graph.constant(0)
    found: dict[int, Expr] = {0: zero}
    for index in graph.reachable(values):
        node = graph.nodes[index]
        if node.op == "sym":
            found[index] = direction.get(node.args[0], zero)
        elif node.static:
            found[index] = zero
        elif node.op in _EVERYWHERE and not any(found[abs(ref)].ref for ref in node.args):
            found[index] = zero  # most nodes depend on few symbols
        else:
            found[index] = _derivative(index, node, values[0], found)
    return [found[abs(v.ref)] if v.ref >= 0 else -found[-v.ref] for v in values]


def _derivative(index: int, node: Node, like: Expr, found: Mapping[int, Expr]) -> Expr:
    graph = like.graph
    args = [Expr(graph, ref) for ref in node.args]
    slopes = [found[abs(a.ref)] if a.ref >= 0 else -found[-a.ref] for a in args]
    if node.op == "add":
        return slopes[0] + slopes[1]
    if node.op == "mul":
        return slopes[0] * args[1] + args[0] * slopes[1]
    value = Expr(graph, index)
    if node.op == "div":
        return (slopes[0] - value * slopes[1]) / args[1]
    rules = {
        "sin": lambda x: graph.call("cos", x),
        "cos": lambda x: -graph.call("sin", x),
        "sqrt": lambda x: 1 / (2 * value),
        "exp": lambda x: value,
        "tan": lambda x: 1 + value * value,
        "tanh": lambda x: 1 - value * value,
    }
    if node.op not in _EVERYWHERE:
        raise DerivationError(f"{node.op} has no derivative everywhere")
    return rules[node.op](args[0]) * slopes[0]
