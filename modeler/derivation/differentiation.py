"""Derivatives of graph expressions along a direction, by the rules of differentiation."""

import re
from collections.abc import Callable, Mapping, Sequence

from modeler.core.errors import DerivationError
from modeler.derivation.graph import Expr, Graph, Node, attach_labels

_EVERYWHERE = {"add", "mul", "div", "sin", "cos", "sqrt", "exp", "tan", "tanh"}
"""Operations that have a derivative wherever they have a value, for our purposes."""


def differentiate(
    values: Sequence[Expr], direction: Mapping[str, Expr], kinks: bool = False
) -> list[Expr]:
    """Returns d values / ds where each symbol of `direction` moves with that speed.

    With speeds 1 and 0 these are partial derivatives; with dq/dt they are time derivatives.

    Args:
        values: of one graph.
        direction: {symbol: speed}.
        kinks: True to take 0 for the derivative of a sign, and the sign for that of |x|.

    Raises:
        DerivationError: a function that has no derivative everywhere (sign, abs), without `kinks`.
    """
    if not values:
        return []
    graph = values[0].graph
    zero = graph.constant(0)
    node_slopes: dict[int, Expr] = {0: zero}
    for index in graph.find_reachable(values):
        node = graph.nodes[index]
        if node.op == "sym":
            node_slopes[index] = direction.get(node.args[0], zero)
        elif node.static:
            node_slopes[index] = zero
        elif (kinks or node.op in _EVERYWHERE) and not any(
            node_slopes[abs(ref)].ref for ref in node.args
        ):
            node_slopes[index] = zero  # most nodes depend on few symbols
        else:
            node_slopes[index] = _differentiate_node(index, node, values[0], node_slopes, kinks)
            _attach_label(graph, index, node_slopes[index], direction)
    return [node_slopes[abs(v.ref)] if v.ref >= 0 else -node_slopes[-v.ref] for v in values]


def _attach_label(graph: Graph, index: int, slope: Expr, direction: Mapping[str, Expr]) -> None:
    """Names it by what is derived, and by the one variable that moves, or the time."""
    if label := graph.labels.get(index):
        by = re.sub(r"\W", "", min(direction)) if len(direction) == 1 else "t"
        value = [-slope if label.minus else slope]
        step, of = f"{label.step}d", label.of + by
        attach_labels(label.quantity, label.link, value, step, of, [label.component])


def _differentiate_node(
    index: int, node: Node, like: Expr, node_slopes: Mapping[int, Expr], kinks: bool
) -> Expr:
    graph = like.graph
    args = [Expr(graph, ref) for ref in node.args]
    slopes = [node_slopes[abs(a.ref)] if a.ref >= 0 else -node_slopes[-a.ref] for a in args]
    if node.op == "add":
        return slopes[0] + slopes[1]
    if node.op == "mul":
        return slopes[0] * args[1] + args[0] * slopes[1]
    if table := graph.tables.get(node.op):
        if table.along is not None:
            raise DerivationError("a law that was learned is derived once only")
        total = graph.constant(0)
        for axis, slope in enumerate(slopes):
            total = total + (graph.law(table.law, *args, along=axis) * slope if slope.ref else 0)
        return total
    value = Expr(graph, index)
    if node.op == "div":
        return (slopes[0] - value * slopes[1]) / args[1]
    rules: dict[str, Callable[[Expr], Expr]] = {
        "sin": lambda x: graph.call("cos", x),
        "cos": lambda x: -graph.call("sin", x),
        "sqrt": lambda x: 1 / (2 * value),
        "exp": lambda x: value,
        "tan": lambda x: 1 + value * value,
        "tanh": lambda x: 1 - value * value,
    }
    if kinks:
        rules |= {
            "sign": lambda x: graph.constant(0),
            "abs": lambda x: graph.call("sign", x),
            "pow": lambda x: args[1] * graph.power(x, args[1] - 1),  # of constant exponents
        }
    if node.op not in rules:
        raise DerivationError(f"{node.op} has no derivative everywhere")
    return rules[node.op](args[0]) * slopes[0]
