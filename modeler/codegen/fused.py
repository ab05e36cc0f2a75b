"""The base regressor of a robot with loops in one block: speeds, drift, rows and projection.

    ud = G qd,  udd = G qdd - J_solved^-1 d/dt(J) ud,  phi = G^T phi_tree(u, ud, udd)

One expression graph shares what drift and regressor have in common, leaves out zeros of G and of
the tree's regressor, and reads the sines and cosines that the closure equations have computed.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from modeler.base.result import BaseParameters
from modeler.codegen.elimination import Elimination
from modeler.symbolic import Expr, Graph, SymbolicModel

_TURNS = ("sin", "cos")


@dataclass(frozen=True)
class Turns:
    """Sines and cosines of moving angles, in the order in which they are kept.

    Attributes:
        values: the expressions.
        symbols: {node: the symbol t[k] that stands for it}.
    """

    values: tuple[Expr, ...]
    symbols: Mapping[int, Expr]


def turns_of(graph: Graph, outputs: Sequence[Expr]) -> Turns:
    """Those that the outputs read."""
    nodes = [
        k
        for k in graph.reachable(outputs)
        if graph.nodes[k].op in _TURNS and not graph.nodes[k].static
    ]
    return Turns(
        values=tuple(Expr(graph, k) for k in nodes),
        symbols={k: graph.symbol(f"t[{at}]") for at, k in enumerate(nodes)},
    )


def base_columns(model: SymbolicModel, base: BaseParameters) -> dict[tuple[int, int], Expr]:
    """{(free variable, base parameter): entry} of the tree's regressor, zeros left out."""
    place = {parameter.column: i for i, parameter in enumerate(base.parameters)}
    return {
        (row, place[k]): value
        for (row, k), value in sorted(model.regressor.items(), key=lambda item: item[0])
        if k in place and not value.is_zero
    }


def fused_regressor(
    model: SymbolicModel,
    base: BaseParameters,
    given: Sequence[int],
    eliminated: Elimination,
    turns: Turns,
) -> tuple[tuple[int, Expr], ...]:
    """(place in phi, value) of what is not always 0.

    It reads u as q[k], t[k], the nonzeros of G as G[k], the factors as lu[k], speeds and
    accelerations of the given variables as v[j] and a[j].

    Args:
        model: with loops.
        base: its base parameters.
        given: places in u.
        eliminated: the elimination of the others.
        turns: what stands in t.
    """
    graph = model.graph
    shares = _shares(model, given, eliminated)
    moving = _moving(model, given, eliminated, turns, shares)
    columns = base_columns(model, base)
    values = replaced(graph, list(columns.values()), turns.symbols, moving)
    phi: dict[int, Expr] = {}
    for (k, column), value in zip(columns, values, strict=True):
        for j, share in shares[k].items():
            at = j * base.rank + column
            phi[at] = phi.get(at, graph.constant(0)) + share * value
    # Column after column: what a column reads is done with before the next one.
    order = sorted(phi, key=lambda at: (at % base.rank, at))
    return tuple((at, phi[at]) for at in order if not phi[at].is_zero)


def _shares(
    model: SymbolicModel, given: Sequence[int], eliminated: Elimination
) -> list[dict[int, Expr]]:
    """Rows of G: {place among the given: entry} of each free variable."""
    assert model.closure is not None
    shares: list[dict[int, Expr]] = [{} for _ in model.closure.home]
    for j, k in enumerate(given):
        shares[k][j] = model.graph.constant(1)
    for at, (k, j, _) in enumerate(eliminated.coupling):
        shares[k][j] = model.graph.symbol(f"G[{at}]")
    return shares


def _moving(
    model: SymbolicModel,
    given: Sequence[int],
    eliminated: Elimination,
    turns: Turns,
    shares: Sequence[Mapping[int, Expr]],
) -> dict[str, Expr]:
    """Speeds and accelerations of the free variables, by symbol."""
    closure, graph = model.closure, model.graph
    assert closure is not None

    def carried(name: str) -> list[Expr]:
        return [
            sum((share * graph.symbol(f"{name}[{j}]") for j, share in own.items()),
                graph.constant(0))
            for own in shares
        ]  # fmt: skip

    speeds = {f"qd[{k}]": value for k, value in enumerate(carried("v"))}
    drift = replaced(graph, closure.drift, turns.symbols, speeds)
    right = {f"right[{i}]": value for i, value in enumerate(drift)}
    back = replaced(graph, eliminated.solution, {}, right)
    accelerations = carried("a")
    solved = [k for k in range(len(shares)) if k not in given]
    for k, value in zip(solved, back, strict=True):
        accelerations[k] = accelerations[k] - value
    return speeds | {f"qdd[{k}]": value for k, value in enumerate(accelerations)}


def replaced(
    graph: Graph,
    outputs: Sequence[Expr],
    nodes: Mapping[int, Expr],
    symbols: Mapping[str, Expr],
) -> list[Expr]:
    """The outputs with other expressions in place of some nodes, and of symbols by name."""
    found: dict[int, Expr] = {0: graph.constant(0), **nodes}
    for index in graph.reachable(outputs):
        if index not in found:
            found[index] = _rebuilt(graph, index, found, symbols)
    return [_signed(found, output.ref) for output in outputs]


def _signed(found: Mapping[int, Expr], ref: int) -> Expr:
    return found[ref] if ref >= 0 else -found[-ref]


def _rebuilt(
    graph: Graph, index: int, found: Mapping[int, Expr], symbols: Mapping[str, Expr]
) -> Expr:
    node = graph.nodes[index]
    if node.op == "sym":
        return symbols.get(node.args[0], Expr(graph, index))
    if node.op in ("num", "pi") or node.static:
        return Expr(graph, index)
    args = [_signed(found, arg) for arg in node.args]
    if all(new.ref == old for new, old in zip(args, node.args, strict=True)):
        return Expr(graph, index)
    if node.op == "add":
        return args[0] + args[1]
    if node.op == "mul":
        return args[0] * args[1]
    if node.op == "div":
        return args[0] / args[1]
    if node.op == "pow":
        return graph.power(args[0], args[1])
    return graph.call(node.op, args[0])
