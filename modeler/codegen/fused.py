"""The base regressor of a robot with loops in one block: speeds, drift, rows and projection.

    ud = G qd,  udd = G qdd - J_solved^-1 d/dt(J) ud,  phi = G^T phi_tree(u, ud, udd)

One expression graph shares what drift and regressor have in common, leaves out zeros of G and of
the tree's regressor, and reads the sines and cosines that the closure equations have computed.
"""

import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from modeler.codegen.block import make_block
from modeler.codegen.elimination import Elimination
from modeler.codegen.functions import CFunction, wrap_names
from modeler.codegen.targets import Target
from modeler.core.json import select_attributes
from modeler.core.law import Law
from modeler.derivation import BaseParameters, Expr, Graph, SymbolicModel

_TURNS = ("sin", "cos")
_ARITHMETIC: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "add": operator.add,
    "mul": operator.mul,
    "div": operator.truediv,
    "pow": lambda base, exponent: base.graph.power(base, exponent),
}


@dataclass(frozen=True)
class SharedSines:
    """Sines and cosines of moving angles, in the order in which they are kept.

    Attributes:
        values: the expressions.
        symbols: {node: the symbol t[k] that stands for it}.
    """

    values: tuple[Expr, ...]
    symbols: Mapping[int, Expr]


def find_shared_sines(graph: Graph, outputs: Sequence[Expr]) -> SharedSines:
    """Those of positions that the outputs read."""
    nodes = [
        k
        for k in graph.find_reachable(outputs)
        if graph.nodes[k].op in _TURNS and not graph.nodes[k].static and _is_positional(graph, k)
    ]
    return SharedSines(
        values=tuple(Expr(graph, k) for k in nodes),
        symbols={k: graph.symbol(f"t[{at}]") for at, k in enumerate(nodes)},
    )


def _is_positional(graph: Graph, node: int) -> bool:
    """True if it reads no speed."""
    read = (graph.nodes[k] for k in graph.find_reachable([Expr(graph, node)]))
    return all(each.op != "sym" or not each.args[0].startswith(("qd", "s[")) for each in read)


def list_base_entries(model: SymbolicModel, base: BaseParameters) -> dict[tuple[int, int], Expr]:
    """{(free variable, base parameter): entry} of the tree's regressor, zeros left out."""
    place = {parameter.column: i for i, parameter in enumerate(base.parameters)}
    return {
        (row, place[k]): value
        for (row, k), value in sorted(model.regressor.items(), key=lambda item: item[0])
        if k in place and not value.is_zero
    }


def build_fused_regressor(
    model: SymbolicModel,
    base: BaseParameters,
    independent: Sequence[int],
    eliminated: Elimination,
    turns: SharedSines,
) -> tuple[tuple[int, Expr], ...]:
    """(place in phi, value) of what is not always 0.

    It reads u as q[k], t[k], the nonzeros of G as G[k], the factors as lu[k], speeds and
    accelerations of the given variables as v[j] and a[j].

    Args:
        model: with loops.
        base: its base parameters.
        independent: places in u.
        eliminated: the elimination of the others.
        turns: what stands in t.
    """
    closure, graph = model.closure, model.graph
    assert closure is not None
    # Rows of G: {place among the given: entry} of each free variable.
    shares: list[dict[int, Expr]] = [{} for _ in closure.home]
    for j, k in enumerate(independent):
        shares[k][j] = graph.constant(1)
    for at, (k, j, _) in enumerate(eliminated.coupling):
        shares[k][j] = graph.symbol(f"G[{at}]")

    def carry_over(name: str) -> list[Expr]:
        return [
            sum((share * graph.symbol(f"{name}[{j}]") for j, share in row.items()),
                graph.constant(0))
            for row in shares
        ]  # fmt: skip

    # Speeds and accelerations of the free variables, by symbol.
    moving = {f"qd[{k}]": value for k, value in enumerate(carry_over("v"))}
    drift = replace_nodes(graph, closure.drift, turns.symbols, moving)
    right = {f"right[{i}]": value for i, value in enumerate(drift)}
    back = replace_nodes(graph, eliminated.solution, {}, right)
    accelerations = carry_over("a")
    solved = [k for k in range(len(shares)) if k not in independent]
    for k, value in zip(solved, back, strict=True):
        accelerations[k] = accelerations[k] - value
    moving |= {f"qdd[{k}]": value for k, value in enumerate(accelerations)}
    columns = list_base_entries(model, base)
    values = replace_nodes(graph, list(columns.values()), turns.symbols, moving)
    phi: dict[int, Expr] = {}
    for (k, column), value in zip(columns, values, strict=True):
        for j, share in shares[k].items():
            at = j * base.rank + column
            phi[at] = phi.get(at, graph.constant(0)) + share * value
    # Column after column: what a column reads is done with before the next one.
    order = sorted(phi, key=lambda at: (at % base.rank, at))
    return tuple((at, phi[at]) for at in order if not phi[at].is_zero)


def replace_nodes(
    graph: Graph, outputs: Sequence[Expr], nodes: Mapping[int, Expr], symbols: Mapping[str, Expr]
) -> list[Expr]:
    """The outputs with other expressions in place of some nodes, and of symbols by name."""
    replacements: dict[int, Expr] = {0: graph.constant(0), **nodes}

    def get_signed(ref: int) -> Expr:
        return replacements[ref] if ref >= 0 else -replacements[-ref]

    for index in graph.find_reachable(outputs):
        if index in replacements:
            continue
        node, replacements[index] = graph.nodes[index], Expr(graph, index)
        if node.op == "sym":
            replacements[index] = symbols.get(node.args[0], replacements[index])
        if node.op in ("sym", "num", "pi") or node.static:
            continue
        args = [get_signed(arg) for arg in node.args]
        if all(new.ref == old for new, old in zip(args, node.args, strict=True)):
            continue
        if table := graph.tables.get(node.op):
            replacements[index] = graph.law(table.law, *args, along=table.along)
        elif node.op in _ARITHMETIC:
            replacements[index] = _ARITHMETIC[node.op](*args)
        else:
            replacements[index] = graph.call(node.op, args[0])
    return [get_signed(output.ref) for output in outputs]


# The unit of tiles: base regressors of some samples at once, each in a lane of its own.
#
# The arithmetic is that of the scalar function of the entries, with vectors in the place of
# numbers.


UNIT = "_tile"
"""C file of the tiles, without the robot's name and `.c`."""

ENTRIES = "base_regressor_nonzeros"
"""Role of the scalar function whose values a tile has."""


@dataclass(frozen=True)
class Tile:
    """The finished strings of a unit.

    Attributes:
        lines: of the function of one vector.
        steps: statements that take the inputs to the next samples.
        symbols: names of the graph's symbols that are read.
        additions: for each sample.
        multiplications: the same, divisions included.
        laws: tables that are read, by name.
        signals: how many there are.
    """

    lines: tuple[str, ...]
    steps: tuple[str, ...]
    symbols: frozenset[str]
    additions: int
    multiplications: int
    laws: Mapping[str, Law]
    signals: int


@dataclass(frozen=True)
class ClosingFunction:
    """One function of what closes the loops of some samples at once; arrays of vectors.

    Attributes:
        name: in C.
        inputs: names.
        output: name; None: the values of a tile.
        lines: all statements.
    """

    name: str
    inputs: tuple[str, ...]
    output: str | None
    lines: tuple[str, ...]


@dataclass(frozen=True)
class ClosingTile:
    """The finished strings of a unit that closes loops; symbols and laws as of `Tile`.

    Attributes:
        parts: functions.
        entries: (coordinate, column) of the values.
    """

    parts: tuple[ClosingFunction, ...]
    entries: tuple[tuple[int, int], ...]
    symbols: frozenset[str]
    laws: Mapping[str, Law]
    signals: int = 0

    @property
    def rows(self) -> list[str]:
        """The coordinates, lines of a C table."""
        return wrap_names([row for row, _ in self.entries])

    @property
    def columns(self) -> list[str]:
        """The columns, lines of a C table."""
        return wrap_names([column for _, column in self.entries])


_PARTS = ("closure", "residual", "factor", "solve", "coupling", "turned", "spread", "rows")


def build_closing_tile(
    functions: Iterable[CFunction], places: Mapping[str, str], columns: int, target: Target
) -> ClosingTile | None:
    """The tile of a robot with loops; None where it has no regressor.

    Args:
        functions: of the module.
        places: C text of every symbol of the graph.
        columns: how many the base regressor has.
        target: of the precision's `TILES`.
    """
    by_role = {f.role: f for f in functions if f.internal}
    if "tree_rows" not in by_role:
        return None
    parts, symbols, laws, entries = [], frozenset[str](), dict[str, Law](), []
    for name in _PARTS:
        f = by_role[f"tree_{name}"]
        rows, out = name == "rows", f.output.name
        if rows:
            entries = sorted(at for at, _ in f.entries)
        block = make_block(
            [(f"MODELER_PUT({entries.index(at)})" if rows else f"{out}[{at}]", value)
             for at, value in f.entries],
            places, target=target,
        )  # fmt: skip
        symbols |= block.symbols
        laws |= block.laws
        inputs = tuple(argument.name for argument in f.inputs)
        read = {symbol.partition("[")[0] for symbol in block.symbols}
        written = {at for at, _ in f.entries}
        zeros = () if rows else tuple(
            f"{out}[{at}] = modeler_lanes_spread(0);"
            for at in range(f.output.size) if at not in written
        )  # fmt: skip
        unread = tuple(f"(void){name};" for name in inputs if name not in read)
        lines = (*unread, *block.constants, *block.calls, *block.body, *zeros)
        parts.append(ClosingFunction(name, inputs, None if rows else out, lines))
    return ClosingTile(tuple(parts), tuple(divmod(at, columns) for at in entries), symbols, laws)


def build_tile(
    functions: Iterable[CFunction], places: Mapping[str, str],
    nonzeros: Sequence[tuple[int, int]], target: Target,
) -> Tile | None:  # fmt: skip
    """The tile of a module; None where it has no function of the entries: with loops.

    Args:
        functions: of the module.
        places: C text of every symbol of the graph.
        nonzeros: (joint, column) of the entries.
        target: of the precision's `TILES`.
    """
    function = next((f for f in functions if f.role == ENTRIES), None)
    if function is None or not function.entries:
        return None
    # Column after column as there; the link's own joint first is another 5 % faster with vectors.
    ordered = sorted(
        function.entries, key=lambda entry: (nonzeros[entry[0]][1], -nonzeros[entry[0]][0])
    )
    outputs = [(f"MODELER_PUT({index})", value) for index, value in ordered]
    # `q[3]` of all lanes is the variable q_3.
    lanes = {s: re.sub(r"^(q|qd|qdd|s)\[(\d+)\]$", r"\1_\2", at) for s, at in places.items()}
    block = make_block(outputs, lanes, target=target)
    lengths = {argument.name: argument.shape[0] for argument in function.inputs}
    loads: dict[str, list[str]] = {}
    for name, length in lengths.items():
        rows = f"_OF_ONE({name})" if length == 1 else f"({name}, {length}, {{}})"
        loads[name] = [
            f"const modeler_lanes {name}_{i} = MODELER_ROWS{rows.format(i)};"
            for i in range(length)
            if f"{name}[{i}]" in block.symbols
        ]
    unread = tuple(name for name in ("q", "qd", "qdd", "s") if not loads.get(name))
    parts = [
        [f"(void){name};" for name in unread], block.constants,
        [line for lines in loads.values() for line in lines], block.calls, block.body,
    ]  # fmt: skip
    return Tile(
        lines=tuple([line for part in parts if part for line in ("", *part)][1:]),
        steps=tuple(
            f"{name} += {length}*MODELER_WIDTH;"
            for name, length in lengths.items()
            if name not in unread
        ),
        **select_attributes(block, "symbols additions multiplications laws"),
        signals=lengths.get("s", 0),
    )
