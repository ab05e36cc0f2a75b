"""Loops in straight-line code: sparse elimination of their Jacobian, the base regressor."""

import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from modeler.codegen.block import Target, make_block
from modeler.codegen.functions import CFunction, wrap_names
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.expression import Law
from modeler.core.json import select_attributes
from modeler.derivation import BaseParameters, Expr, Graph, Label, SymbolicModel

SMALLEST = 1e-2
"""Share of its row's size below which a pivot counts as small when the code runs."""

_POSTURES, _MOVED, _ROUNDS = 16, 0.2, 6
_SEED = 1957


@dataclass(frozen=True)
class SparsityPattern:
    """The nonzeros of df/du, row after row.

    Attributes:
        places: (row, column) of each.
        entries: the expression of each.
    """

    places: tuple[tuple[int, int], ...]
    entries: tuple[Expr, ...]


def find_pattern(model: SymbolicModel) -> SparsityPattern:
    """Returns the nonzeros of the closure's Jacobian."""
    assert model.closure is not None
    lines = enumerate(model.closure.jacobian)
    entries = [((i, k), entry) for i, line in lines for k, entry in enumerate(line)]
    nonzeros = [pair for pair in entries if not pair[1].is_zero]
    return SparsityPattern(
        tuple(place for place, _ in nonzeros), tuple(entry for _, entry in nonzeros)
    )


@dataclass(frozen=True)
class Elimination:
    """What the emitted functions compute, as expressions of J[k], the nonzeros of df/du.

    Attributes:
        limits: largest size of the inverse of each pivot, in their order.
        factors: what `factor` writes: inverses of the pivots, then multipliers and rows.
        solution: of J_solved x = right, from lu[k] and right[i].
        coupling: (place in u, place in the given, value) of the nonzeros of G in solved rows,
            from lu[k] and J[k].
        change_bounds: of the sums of the absolute entries of each row of J_solved^-1 (J' - J),
            from lu[k], J[k] and K[k], the nonzeros of J'.
        change_squares: sum of the squares of its entries.
    """

    limits: tuple[float, ...]
    factors: tuple[Expr, ...]
    solution: tuple[Expr, ...]
    coupling: tuple[tuple[int, int, Expr], ...]
    change_bounds: tuple[Expr, ...]
    change_squares: Expr


def eliminate(
    model: SymbolicModel, pattern: SparsityPattern, independent: Sequence[int], J: np.ndarray
) -> Elimination:
    """Returns the elimination of the columns that are not given.

    Args:
        model: with loops.
        pattern: of its Jacobian.
        independent: places in u.
        J: (n, len(solved), len(u)) values of the Jacobian, for the order of the pivots.
    """
    closure, graph = model.closure, model.graph
    assert closure is not None
    solved = [k for k in range(len(closure.home)) if k not in independent]
    scale = np.array([closure.size if long else 1.0 for long in closure.is_travel])
    size = 2.0 ** np.round(np.log2(np.max(np.linalg.norm(J * scale, axis=2), axis=0)))
    places = {(i, solved.index(k)) for i, k in pattern.places if k in solved}
    order = _order_pivots(J[:, :, solved] * scale[solved] / size[:, None], places)
    symbols = {
        (i, k): entry if graph.nodes[abs(entry.ref)].op == "num" else graph.symbol(f"J[{at}]")
        for at, ((i, k), entry) in enumerate(zip(pattern.places, pattern.entries, strict=True))
    }
    entries = {(i, solved.index(k)): entry for (i, k), entry in symbols.items() if k in solved}
    factors = _Factors(graph, order, entries)
    zero, every = graph.constant(0), range(len(solved))
    # J' - J of the solved columns; sums over its rows, and J^-1 times it, in scaled variables.
    changes = {
        (i, solved.index(k)): graph.symbol(f"K[{at}]") - graph.symbol(f"J[{at}]")
        for at, ((i, k), entry) in enumerate(zip(pattern.places, pattern.entries, strict=True))
        if k in solved and not graph.nodes[abs(entry.ref)].static
    }
    lengths = [graph.constant(Fraction(repr(float(scale[k])))) for k in solved]
    sums = [zero for _ in every]
    for (i, j), change in changes.items():
        sums[i] = sums[i] + graph.call("abs", change) * lengths[j]
    bounds = factors.solve(sums, bound=True)
    solution = factors.solve([graph.symbol(f"right[{i}]") for i in every])
    coupling = []  # G = -J_solved^-1 J_given
    for j, k in enumerate(independent):
        column = factors.solve([-symbols.get((i, k), zero) for i in every])
        coupling += [(at, j, x) for at, x in zip(solved, column, strict=True) if not x.is_zero]
    turned = tuple(bound / length for bound, length in zip(bounds, lengths, strict=True))
    squares = zero
    for j in every:
        column = factors.solve([changes.get((i, j), zero) for i in every])
        for x, length in zip(column, lengths, strict=True):
            share = x * (lengths[j] / length)
            squares = squares + share * share
    return Elimination(
        limits=tuple(float(scale[solved[j]] / (SMALLEST * size[i])) for i, j in order),
        factors=tuple(factors.values),
        solution=tuple(solution),
        coupling=tuple(coupling),
        change_bounds=turned,
        change_squares=squares,
    )


def sample_jacobians(model: SymbolicModel) -> np.ndarray:
    """Returns (n, len(equations), len(u)) df/du at home, and at closed postures around it."""
    closure = model.closure
    assert closure is not None
    solved, scale = list(closure.solved), closure.scale
    home = np.asarray(closure.home)
    shape = (_POSTURES, len(closure.actuated))
    moves = np.random.default_rng(_SEED).uniform(-_MOVED, _MOVED, shape)
    u = np.tile(home, (_POSTURES, 1))
    u[:, list(closure.actuated)] += moves * scale[list(closure.actuated)]
    good = np.ones(_POSTURES, dtype=bool)
    with np.errstate(all="ignore"):
        for _ in range(_ROUNDS):
            f = closure.compute_residuals(u)
            inner = closure.compute_jacobians(u)[:, :, solved]
            steps = [_solve_step(A, b) for A, b in zip(inner, f, strict=True)]
            u[:, solved] -= np.array(steps)
            good &= np.isfinite(u).all(axis=1)
            u[~good] = home
        residuals = np.abs(closure.compute_residuals(u)).max(axis=1)
        good &= residuals <= THRESHOLDS.max_sampled_residual * closure.size
    return closure.compute_jacobians(np.concatenate([home[None], u[good]]))


def _solve_step(A: np.ndarray, b: np.ndarray) -> np.ndarray:
    try:
        return np.linalg.solve(A, b)
    except np.linalg.LinAlgError:
        return np.full_like(b, np.nan)


def _order_pivots(values: np.ndarray, pattern: set[tuple[int, int]]) -> list[tuple[int, int]]:
    """(row, column) of each pivot.

    Args:
        values: (n, m, m) of the matrix, rows and columns scaled.
        pattern: where it is not always 0.
    """
    A, left, order = values.copy(), set(pattern), list[tuple[int, int]]()
    m = values.shape[1]
    rows, columns = set(range(m)), set(range(m))
    for _ in range(m):
        live = sorted((i, j) for i, j in left if i in rows and j in columns)
        height = {j: np.abs(A[:, sorted(rows), j]).max(axis=1) for j in columns}
        floors = {j: np.maximum(height[j], 1e-300) for j in columns}
        share = {(i, j): float(np.min(np.abs(A[:, i, j]) / floors[j])) for i, j in live}
        good = [place for place in live if share[place] >= THRESHOLDS.min_pivot_share]
        if good:
            width = {i: sum(1 for r, _ in live if r == i) - 1 for i in rows}
            depth = {j: sum(1 for _, c in live if c == j) - 1 for j in columns}
            i, j = min(good, key=lambda place: (width[place[0]] * depth[place[1]], place))
        else:
            i, j = max(live, key=lambda place: (round(share[place], 6), place))
        order.append((i, j))
        rows.discard(i)
        columns.discard(j)
        for r in sorted(r for r in rows if (r, j) in left):
            with np.errstate(all="ignore"):
                A[:, r] -= (A[:, r, j] / A[:, i, j])[:, None] * A[:, i]
            left |= {(r, c) for c in columns if (i, c) in left}
    return order


class _Factors:
    """A = P L U Q with the pivots in a fixed order; the factors are read as lu[k]."""

    def __init__(
        self,
        graph: Graph,
        order: Sequence[tuple[int, int]],
        entries: Mapping[tuple[int, int], Expr],
    ) -> None:
        """Factors of the matrix with these entries."""
        self.graph, self.order = graph, order
        A, one, size = dict(entries), graph.constant(1), len(order)
        rows, columns = set(range(size)), set(range(size))
        self.values: list[Expr] = []
        upper, lower = [], []
        for i, j in order:
            rows.discard(i)
            columns.discard(j)
            inverse = one / A[i, j]
            self.values.append(inverse)  # all stand first, numbers too: they are checked
            across = [(c, A[i, c]) for c in sorted(columns) if (i, c) in A]
            down = [(r, A[r, j] * inverse) for r in sorted(rows) if (r, j) in A]
            for r, share in down:
                for c, value in across:
                    A[r, c] = A.get((r, c), graph.constant(0)) - share * value
            A = {place: value for place, value in A.items() if not value.is_zero}
            upper.append(across)
            lower.append(down)
        self.inverse = [graph.symbol(f"lu[{k}]") for k in range(size)]
        self.right: list[list[tuple[int, Expr]]] = []  # by pivot: (column, entry)
        self.below: list[list[tuple[int, Expr]]] = []  # by pivot: (row, multiplier)
        for across, down in zip(upper, lower, strict=True):
            self.right.append([(c, self._store_value(value)) for c, value in across])
            self.below.append([(r, self._store_value(value)) for r, value in down])

    def _store_value(self, value: Expr) -> Expr:
        """The value as the other functions read it."""
        if self.graph.nodes[abs(value.ref)].op == "num":
            return value
        self.values.append(value)
        return self.graph.symbol(f"lu[{len(self.values) - 1}]")

    def solve(self, right: Sequence[Expr], bound: bool = False) -> list[Expr]:
        """Returns x with A x = right; as a bound, |A^-1| right <= x.

        The inverse of a triangle is at most that of its comparison matrix.
        """

        def subtract(value: Expr, factor: Expr, x: Expr) -> Expr:
            if bound:
                return value + self.graph.call("abs", factor) * x
            return value - factor * x

        y, x = list(right), [self.graph.constant(0)] * len(right)
        for (i, _), below in zip(self.order, self.below, strict=True):
            for r, share in below:
                y[r] = subtract(y[r], share, y[i])
        for k, (i, j) in reversed([*enumerate(self.order)]):
            rest = y[i]
            for c, value in self.right[k]:
                rest = subtract(rest, value, x[c])
            x[j] = rest * (self.graph.call("abs", self.inverse[k]) if bound else self.inverse[k])
        return x


# The base regressor of a robot with loops in one block: speeds, drift, rows and projection.
#
#     ud = G qd,  udd = G qdd - J_solved^-1 d/dt(J) ud,  phi = G^T phi_tree(u, ud, udd)
#
# One expression graph shares what drift and regressor have in common, leaves out zeros of G and of
# the tree's regressor, and reads the sines and cosines that the closure equations have computed.


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
    """Returns the sines and cosines of positions that the outputs read."""
    reachable = ((k, graph.nodes[k]) for k in graph.find_reachable(outputs))
    turning = (k for k, node in reachable if node.op in _TURNS and not node.static)
    nodes = [k for k in turning if _is_positional(graph, k)]
    symbols = {k: graph.symbol(f"t[{at}]") for at, k in enumerate(nodes)}
    return SharedSines(values=tuple(Expr(graph, k) for k in nodes), symbols=symbols)


def _is_positional(graph: Graph, node: int) -> bool:
    """True if it reads no speed."""
    read = (graph.nodes[k] for k in graph.find_reachable([Expr(graph, node)]))
    return all(each.op != "sym" or not each.args[0].startswith(("qd", "s[")) for each in read)


def list_base_entries(model: SymbolicModel, base: BaseParameters) -> dict[tuple[int, int], Expr]:
    """Returns {(free variable, base parameter): entry} of the tree's regressor, zeros left out."""
    place = {parameter.column: i for i, parameter in enumerate(base.parameters)}
    entries = sorted(model.regressor.items(), key=lambda item: item[0])
    entries = [((row, k), value) for (row, k), value in entries if k in place and not value.is_zero]
    return {(row, place[k]): value for (row, k), value in entries}


def build_fused_regressor(
    model: SymbolicModel,
    base: BaseParameters,
    independent: Sequence[int],
    eliminated: Elimination,
    turns: SharedSines,
) -> tuple[tuple[int, Expr], ...]:
    """Returns (place in phi, value) of what is not always 0.

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
            sum(
                (share * graph.symbol(f"{name}[{j}]") for j, share in row.items()),
                graph.constant(0),
            )
            for row in shares
        ]

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
    """Returns the outputs with other expressions in place of some nodes, and of symbols by name."""
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
        """Returns the coordinates, lines of a C table."""
        return wrap_names([row for row, _ in self.entries])

    @property
    def columns(self) -> list[str]:
        """Returns the columns, lines of a C table."""
        return wrap_names([column for _, column in self.entries])


_PARTS = ("closure", "residual", "factor", "solve", "coupling", "turned", "spread", "rows")


def build_closing_tile(
    functions: Iterable[CFunction],
    places: Mapping[str, str],
    columns: int,
    target: Target,
    labels: Mapping[int, Label],
) -> ClosingTile | None:
    """Returns the tile of a robot with loops; None where it has no regressor.

    Args:
        functions: of the module.
        places: C text of every symbol of the graph.
        columns: how many the base regressor has.
        target: of the precision's `TILES`.
        labels: of the graph's nodes.
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
            [
                (f"MODELER_PUT({entries.index(at)})" if rows else f"{out}[{at}]", value)
                for at, value in f.entries
            ],
            places,
            target=target,
            labels=labels,
        )
        symbols |= block.symbols
        laws |= block.laws
        inputs = tuple(argument.name for argument in f.inputs)
        read = {symbol.partition("[")[0] for symbol in block.symbols}
        written = {at for at, _ in f.entries}
        zeros: tuple[str, ...] = ()
        if not rows:
            unwritten = (at for at in range(f.output.size) if at not in written)
            zeros = tuple(f"{out}[{at}] = modeler_lanes_spread(0);" for at in unwritten)
        unread = tuple(f"(void){name};" for name in inputs if name not in read)
        lines = (*unread, *block.constants, *block.calls, *block.body, *zeros)
        parts.append(ClosingFunction(name, inputs, None if rows else out, lines))
    return ClosingTile(tuple(parts), tuple(divmod(at, columns) for at in entries), symbols, laws)


def build_tile(
    functions: Iterable[CFunction],
    places: Mapping[str, str],
    nonzeros: Sequence[tuple[int, int]],
    target: Target,
    labels: Mapping[int, Label],
) -> Tile | None:
    """Returns the tile of a module; None where it has no function of the entries: with loops.

    Args:
        functions: of the module.
        places: C text of every symbol of the graph.
        nonzeros: (joint, column) of the entries.
        target: of the precision's `TILES`.
        labels: of the graph's nodes.
    """
    function = next((f for f in functions if f.role == ENTRIES), None)
    if function is None or not function.entries:
        return None
    # Column after column as there; the link's own joint first is another 5 % faster with vectors.
    ordered = sorted(function.entries, key=lambda e: (nonzeros[e[0]][1], -nonzeros[e[0]][0]))
    outputs = [(f"MODELER_PUT({index})", value) for index, value in ordered]
    # `q[3]` of all lanes is the variable q_3.
    lanes = {s: re.sub(r"^(q|qd|qdd|s)\[(\d+)\]$", r"\1_\2", at) for s, at in places.items()}
    block = make_block(outputs, lanes, target=target, labels=labels)
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
    voids = [f"(void){name};" for name in unread]
    rows_read = [line for lines in loads.values() for line in lines]
    parts = [voids, block.constants, rows_read, block.calls, block.body]
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
