"""Sparse elimination of a loop Jacobian as straight-line code: its pattern is known.

The order of the pivots is fixed here, at home and at postures around it: among entries that are
not small in their column at any of them, the one that fills in least (Markowitz 1957). Where a
pivot is small after all, the emitted code says so and the loops are closed with dense pivoting.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from modeler.derivation import Expr, Graph, SymbolicModel

SMALLEST = 1e-2
"""Share of its row's size below which a pivot counts as small when the code runs."""

_LARGE = 0.0937  # of the largest in the column: large enough for a pivot
_POSTURES, _MOVED, _ROUNDS = 16, 0.2, 6
_SEED = 1957
_CLOSED = 1e-9


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
    """The nonzeros of the closure's Jacobian."""
    assert model.closure is not None
    nonzeros = [
        ((i, k), entry)
        for i, line in enumerate(model.closure.jacobian)
        for k, entry in enumerate(line)
        if not entry.is_zero
    ]
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
        turned: bounds of the sums of the absolute entries of each row of J_solved^-1 (J' - J),
            from lu[k], J[k] and K[k], the nonzeros of J'.
        spread: sum of the squares of its entries.
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
    """The elimination of the columns that are not given.

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
    solved_entries = {
        (i, solved.index(k)): entry for (i, k), entry in symbols.items() if k in solved
    }
    factors = _Factors(graph, order, solved_entries)
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
    """(n, len(equations), len(u)) df/du at home, and at closed postures around it."""
    closure = model.closure
    assert closure is not None
    solved, scale = list(closure.solved), closure.scale
    home = np.asarray(closure.home)
    moves = np.random.default_rng(_SEED).uniform(
        -_MOVED, _MOVED, (_POSTURES, len(closure.actuated))
    )
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
        good &= np.abs(closure.compute_residuals(u)).max(axis=1) <= _CLOSED * closure.size
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
        share = {
            (i, j): float(np.min(np.abs(A[:, i, j]) / np.maximum(height[j], 1e-300)))
            for i, j in live
        }
        good = [place for place in live if share[place] >= _LARGE]
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
        """x with A x = right; as a bound, |A^-1| right <= x.

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
