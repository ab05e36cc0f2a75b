"""Linear least squares: ranks, triangles, whitening, cones; minimisation by BFGS and CMA-ES."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import qr, solve_triangular
from scipy.sparse import csc_array

from modeler.core.json import ShortRepr
from modeler.numerics.thresholds import THRESHOLDS


@dataclass(frozen=True)
class DroppedColumn:
    """A column that was set aside.

    Attributes:
        name: its parameter.
        into: kept parameters whose columns reproduce it; empty if the column is zero.
        pivot: its pivot, as a share of the first.
    """

    name: str
    into: tuple[str, ...]
    pivot: float

    def describe(self) -> str:
        """Describes what happened to the parameter and what to do."""
        if not self.into:
            return (
                f"{self.name} is not excited: its column is zero on these data; it is set to 0; "
                "move the joints it belongs to"
            )
        return (
            f"{self.name} cannot be distinguished from {', '.join(self.into)} on these data (pivot "
            f"{self.pivot:.1g}, tolerance {THRESHOLDS.min_pivot:g}): it is set to 0 and they carry "
            "its effect; record a motion that moves all joints over a wide range"
        )


@dataclass(frozen=True)
class Rank:
    """Columns kept (indices, ascending), columns set aside, and the gap between them.

    Attributes:
        kept: indices.
        aside: one entry per column set aside.
        last_kept: smallest pivot kept, as a share of the first.
        first_dropped: largest pivot dropped; 0 if none.
    """

    kept_columns: tuple[int, ...]
    dropped_columns: tuple[DroppedColumn, ...]
    last_kept: float
    first_dropped: float


def find_independent_columns(R: np.ndarray, names: Sequence[str]) -> Rank:
    """Finds independent columns of R (or W) by QR with column pivoting of the scaled columns.

    Args:
        R: (rows, c).
        names: (c,).
    """
    lengths = np.linalg.norm(R, axis=0)
    active = np.flatnonzero(lengths > THRESHOLDS.min_column_norm * lengths.max(initial=0.0))
    inactive = (i for i in range(len(names)) if i not in set(active))
    dropped_columns = [DroppedColumn(names[i], (), 0.0) for i in inactive]
    if not active.size:
        return Rank((), tuple(dropped_columns), 0.0, 0.0)
    triangle, order = qr(R[:, active] / lengths[active], mode="r", pivoting=True)
    pivots = np.abs(np.diag(triangle)) / abs(triangle[0, 0])
    rank = int(np.sum(pivots > THRESHOLDS.min_pivot))
    kept_columns, dropped = active[order[:rank]], active[order[rank:]]
    if len(dropped):
        shares = solve_triangular(triangle[:rank, :rank], triangle[:rank, rank:])
        for position, column in enumerate(dropped):
            share = shares[:, position]
            into = tuple(
                names[kept_columns[i]]
                for i in np.argsort(-np.abs(share))
                if abs(share[i]) > THRESHOLDS.min_named_share
            )
            pivot = pivots[rank + position] if rank + position < len(pivots) else 0.0
            dropped_columns.append(DroppedColumn(names[column], into[:6], float(pivot)))
    return Rank(
        kept_columns=tuple(int(i) for i in sorted(kept_columns)),
        dropped_columns=tuple(dropped_columns),
        last_kept=float(pivots[rank - 1]),
        first_dropped=float(pivots[rank]) if rank < len(pivots) else 0.0,
    )


# Columns of unlike units: scaled before anything is decomposed.


def compute_column_norms(matrix: np.ndarray) -> np.ndarray:
    """Computes (c,) norms of the columns; 1 for a column of zeros."""
    length = np.linalg.norm(matrix, axis=0)
    return np.where(length > 0.0, length, 1.0)


def solve_scaled_least_squares(
    W: np.ndarray, y: np.ndarray, cutoff: float | None = None
) -> np.ndarray:
    """Returns (c, ...) of least ||y - W beta||; 0 along directions in the null space of W.

    Args:
        W: (rows, c), its columns scaled to length one.
        y: (rows, ...).
        cutoff: singular value, over the largest, below which nothing is seen; None: rounding.
    """
    length = compute_column_norms(W)
    solution = np.linalg.lstsq(W / length, y, rcond=cutoff)[0]
    return np.asarray(solution / length.reshape(-1, *(1,) * (solution.ndim - 1)))


def compute_whitening(gram: np.ndarray, cutoff: float) -> np.ndarray:
    """Computes (c, r) T with T^T G T = 1 on the range of G; T T^T is its pseudo-inverse.

    Args:
        gram: (c, c) G, symmetric, positive semi-definite; scaled to unit diagonal.
        cutoff: eigenvalue of that, over the largest, below which nothing is seen.
    """
    length = np.sqrt(np.where(np.diag(gram) > 0.0, np.diag(gram), 1.0))
    values, vectors = np.linalg.eigh(gram / np.outer(length, length))
    is_significant = values > cutoff * float(values.max(initial=1e-300))
    significant = vectors[:, is_significant]
    return np.asarray(significant / np.sqrt(values[is_significant]) / length[:, None])


# The data of a fit as one small triangle per joint: everything else is computed from these.


@dataclass(frozen=True, eq=False)
class CompressedRegression:
    """R of [W_j y_j] = Q R for the rows of each joint; c columns, n joints.

    For any beta, ||y_j - W_j beta|| = ||R_j [-beta; 1]||: no row is needed again.

    Attributes:
        names: (c,) columns.
        triangles: (n, c + 1, c + 1).
        rows: (n,) rows of each joint.
        free: (n,) True for joints without a motor, whose torque is 0 by definition.
        prior: (r, c + 1) further rows [D, D beta_0] of a Gaussian prior, of standard deviation 1.
    """

    names: tuple[str, ...]
    triangles: np.ndarray
    rows: np.ndarray
    free: np.ndarray
    prior: np.ndarray | None = None

    def compute_residual_norms(self, beta: np.ndarray) -> np.ndarray:
        """Computes (n,) ||y_j - W_j beta||, N m or N."""
        return np.linalg.norm(self.triangles @ np.append(-beta, 1.0), axis=1)

    def compute_torque_norms(self) -> np.ndarray:
        """Computes (n,) ||y_j||."""
        return np.linalg.norm(self.triangles[:, :, -1], axis=1)

    def compute_torque_rms(self) -> np.ndarray:
        """Computes (n,) root mean square of y_j."""
        return self.compute_torque_norms() / np.sqrt(np.maximum(self.rows, 1))

    def combine_joints(self, sigma: np.ndarray) -> np.ndarray:
        """Returns the triangle (c + 1, c + 1) of all rows, those of joint j divided by sigma_j.

        Those of the prior are among them.
        """
        weighted = (self.triangles / sigma[:, None, None]).reshape(-1, self.triangles.shape[2])
        if self.prior is not None:
            weighted = np.vstack([weighted, self.prior])
        return compute_triangle(weighted)

    def drop_columns(self, names: Sequence[str]) -> "CompressedRegression":
        """Returns the same data without some columns."""
        kept_indices = [i for i, name in enumerate(self.names) if name not in set(names)]
        columns = [*kept_indices, len(self.names)]
        return CompressedRegression(
            tuple(self.names[i] for i in kept_indices),
            self.triangles[:, :, columns],
            self.rows,
            self.free,
            None if self.prior is None else self.prior[:, columns],
        )


def compute_triangle(matrix: np.ndarray) -> np.ndarray:
    """Computes R of matrix = Q R, (min(rows, columns), columns)."""
    return np.asarray(np.linalg.qr(matrix, mode="r"))


def merge_compressed(
    first: CompressedRegression, second: CompressedRegression
) -> CompressedRegression:
    """Merges the rows of both: R of [R1; R2] per joint, as [W1 y1; W2 y2] has the same R^T R.

    Each triangle errs backwards by rounding of its own rows only, so any order of merging is as
    exact as one factorisation (Demmel, Grigori, Hoemmen and Langou 2012, SIAM J. Sci. Comput.
    34(1)); take a fixed order where equal runs must give equal bits.

    Args:
        first: of some rows.
        second: of other rows of the same columns and joints.
    """
    assert first.names == second.names and np.array_equal(first.free, second.free)
    stacked = np.concatenate([first.triangles, second.triangles], axis=1)
    triangles = np.stack([compute_triangle(joint_rows) for joint_rows in stacked])
    return CompressedRegression(first.names, triangles, first.rows + second.rows, first.free)


def compress_rows(
    W: np.ndarray,
    y: np.ndarray,
    joint: np.ndarray,
    joints: int,
    names: Sequence[str],
    free: Sequence[int] = (),
) -> CompressedRegression:
    """Compresses y = W beta to a triangle of each joint.

    Args:
        W: (rows, c).
        y: (rows,).
        joint: (rows,) index of the joint of each row.
        joints: number of joints.
        names: (c,).
        free: indices of the joints without a motor.
    """
    size = W.shape[1] + 1
    assert W.shape == (len(y), len(names)) and np.isfinite(W).all() and np.isfinite(y).all()
    triangles = np.zeros((joints, size, size))
    for j in range(joints):
        is_of_joint = joint == j
        if is_of_joint.any():
            joint_triangle = compute_triangle(np.column_stack([W[is_of_joint], y[is_of_joint]]))
            triangles[j, : len(joint_triangle)] = joint_triangle
    rows = np.bincount(joint, minlength=joints)
    return CompressedRegression(tuple(names), triangles, rows, np.isin(np.arange(joints), free))


# Least squares of many rows from few: the orthogonal part of a QR decomposition is left out.


@dataclass(frozen=True, eq=False)
class ReducedRows(ShortRepr):
    """As many rows as there are columns, with the same squares and products; J joints.

    Attributes:
        W: (few, c) by joint.
        y: (few,) by joint.
        count: (J,) rows that there were.
    """

    W: tuple[np.ndarray, ...]
    y: tuple[np.ndarray, ...]
    count: np.ndarray


@dataclass(frozen=True, eq=False)
class Reduction(ShortRepr):
    """The factors that reduce rows to few, by joint: [W y] = Q R.

    Attributes:
        Q: (rows_j, few) orthonormal.
        R: (few, c + 1).
    """

    Q: tuple[np.ndarray, ...]
    R: tuple[np.ndarray, ...]

    def append_columns(self, extra: Sequence[Sequence[np.ndarray | None]]) -> ReducedRows:
        """Appends further columns, (rows_j, k) each by joint; None where they are zero."""
        sizes = [next(c.shape[1] for c in columns if c is not None) for columns in extra]
        W, y = [], []
        for j, (Q, R) in enumerate(zip(self.Q, self.R, strict=True)):
            parts = [columns[j] for columns in extra]
            more = _append_joint_columns(Q, parts, sizes)
            below = np.zeros((len(more) - len(R), R.shape[1]))
            whole = np.hstack([np.vstack([R, below]), more])
            W.append(np.delete(whole, R.shape[1] - 1, axis=1))
            y.append(whole[:, R.shape[1] - 1])
        return ReducedRows(tuple(W), tuple(y), np.array([len(Q) for Q in self.Q]))


def reduce_rows(W: Sequence[np.ndarray], y: Sequence[np.ndarray]) -> Reduction:
    """Reduces the rows of every joint by a QR decomposition."""
    every = [_reduce_joint_rows(w, t) for w, t in zip(W, y, strict=True)]
    return Reduction(tuple(Q for Q, _ in every), tuple(R for _, R in every))


def _reduce_joint_rows(W: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Q and R of [W y]; columns that are 0 throughout, those of other joints, take no part."""
    seen = np.append(W.any(axis=0), True)
    Q, R = np.linalg.qr(np.column_stack([W[:, seen[:-1]], y]))
    whole = np.zeros((len(R), len(seen)))
    whole[:, seen] = R
    return Q, whole


def _append_joint_columns(
    Q: np.ndarray, parts: Sequence[np.ndarray | None], sizes: Sequence[int]
) -> np.ndarray:
    """(few + more, k) further columns of one joint: within Q, and below it what Q lacks."""
    inside = np.zeros((Q.shape[1], sum(sizes)))
    ends = np.cumsum([0, *sizes])
    shown = [k for k, part in enumerate(parts) if part is not None]
    places = [i for k in shown for i in range(ends[k], ends[k + 1])]
    if not places:
        return inside
    joint_columns = np.hstack([part for part in parts if part is not None])
    inside[:, places] = Q.T @ joint_columns
    rest = np.linalg.qr(joint_columns - Q @ inside[:, places], mode="r")
    below = np.zeros((len(rest), sum(sizes)))
    below[:, places] = rest
    return np.vstack([inside, below])


def compute_joint_whitening(W: Sequence[np.ndarray], sigma: np.ndarray) -> np.ndarray:
    """Computes (c, r) T that makes weighted columns orthonormal over the rows of all joints.

    Args:
        W: (rows_j, c) by joint.
        sigma: (J,) of each joint; the weights are its inverse.
    """
    gram = np.asarray(sum((w.T @ w) / s**2 for w, s in zip(W, sigma, strict=True)))
    return compute_whitening(gram, THRESHOLDS.min_joint_eigenvalue)


# The median of weighted values.


def compute_weighted_median(values: np.ndarray, weights: np.ndarray) -> float:
    """Returns the smallest value up to which at least half of the weight lies.

    Half but for rounding: of equal weights whose last digits differ, every choice of these digits
    (as that of a clock's zero) gives the same median.

    Args:
        values: (n,).
        weights: (n,) 0 or more, not all 0.
    """
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    half = (0.5 - THRESHOLDS.weight_rounding) * total[-1]
    return float(values[order][np.searchsorted(total, half)])


# Quasi-Newton descent inside an open set; evolution, a search that needs values only.


@dataclass(frozen=True)
class ObjectiveFunction:
    """A function on an open set.

    Attributes:
        value: f(x), infinite outside of the set.
        slope: its gradient where it is finite; called at the point last requested.
        reach: how far from x along d the set's flat walls stand, in lengths of d.
    """

    value: Callable[[np.ndarray], float]
    gradient: Callable[[np.ndarray], np.ndarray]
    boundary_distance: Callable[[np.ndarray, np.ndarray], float]


def minimise_bfgs(
    landscape: ObjectiveFunction,
    x: np.ndarray,
    steps: int,
    tolerance: float,
    proceed: Callable[[], bool],
) -> np.ndarray:
    """Returns the lowest point (d,) that BFGS reaches from x.

    Args:
        landscape: the function.
        x: inside of the set.
        steps: at most so many.
        tolerance: it ends where ten steps together bring less than this.
        proceed: asked before each value; False ends it.
    """
    value = landscape.value(x)
    slope = landscape.gradient(x)
    curve, fresh, values = _build_initial_inverse_hessian(slope), True, [value]
    for _ in range(steps):
        if not proceed():
            break
        way = -curve @ slope
        lower_point = _search_line(landscape, x, value, way, float(way @ slope), proceed)
        if lower_point is None:
            if fresh:
                break
            curve, fresh = (
                _build_initial_inverse_hessian(slope),
                True,
            )  # a kink: what was learnt of curvature misleads
            continue
        ahead, new = lower_point
        after = landscape.gradient(ahead)
        curve, fresh = _update_inverse_hessian(curve, ahead - x, after - slope, fresh), False
        x, value, slope = ahead, new, after
        values.append(value)
        steps = THRESHOLDS.stall_steps
        if len(values) > steps and values[-1 - steps] - value < tolerance:
            break
    return x


def _build_initial_inverse_hessian(slope: np.ndarray) -> np.ndarray:
    return np.eye(len(slope)) / max(float(np.linalg.norm(slope)), 1e-12)


def _search_line(
    landscape: ObjectiveFunction,
    x: np.ndarray,
    value: float,
    way: np.ndarray,
    fall: float,
    proceed: Callable[[], bool],
) -> tuple[np.ndarray, float] | None:
    """A point along `way` that is lower than promised in part, and its value."""
    share = min(1.0, THRESHOLDS.max_boundary_share * landscape.boundary_distance(x, way))
    while fall < 0.0 and share > THRESHOLDS.min_step_share and proceed():
        ahead = x + share * way
        new = landscape.value(ahead)
        if new <= value + THRESHOLDS.armijo_share * share * fall:
            return ahead, new
        share *= 0.4
    return None


def _update_inverse_hessian(
    curve: np.ndarray, step: np.ndarray, change: np.ndarray, first: bool
) -> np.ndarray:
    """The inverse of the second derivative, with what one step taught of it (BFGS)."""
    along = float(step @ change)
    if not along > 1e-10 * float(np.linalg.norm(step) * np.linalg.norm(change)):
        return curve
    if first:
        curve = np.eye(len(step)) * (along / float(change @ change))
    turned = curve @ change
    return (
        curve
        + np.outer(step, step) * ((along + change @ turned) / along**2)
        - (np.outer(turned, step) + np.outer(step, turned)) / along
    )


def minimise_cma_es(
    value: Callable[[np.ndarray], float],
    x: np.ndarray,
    size: float,
    generations: int,
    rng: np.random.Generator,
    proceed: Callable[[int], bool],
) -> np.ndarray:
    """Returns the lowest point (d,) that CMA-ES reaches from x.

    N. Hansen, The CMA Evolution Strategy: A Tutorial, arXiv:1604.00772, appendix A.

    Args:
        value: to be made small; any point may be requested.
        x: where it begins.
        size: standard deviation of the first points.
        generations: at most so many.
        rng: draws the points.
        proceed: asked before each point, with the number of its generation; False ends it.
    """
    d = len(x)
    count = 8 + int(3 * np.log(d))
    parents = count // 2
    share = np.log(parents + 0.5) - np.log(np.arange(1, parents + 1))
    share /= share.sum()
    mu = 1.0 / np.sum(share**2)
    c_size, c_path = (mu + 2) / (d + mu + 5), (4 + mu / d) / (d + 4 + 2 * mu / d)
    damp = 1 + 2 * max(0.0, np.sqrt((mu - 1) / (d + 1)) - 1) + c_size
    c_one = 2 / ((d + 1.3) ** 2 + mu)
    c_many = min(1 - c_one, 2 * (mu - 2 + 1 / mu) / ((d + 2) ** 2 + mu))
    usual = np.sqrt(d) * (1 - 1 / (4 * d) + 1 / (21 * d**2))
    covariance, path, size_path = np.eye(d), np.zeros(d), np.zeros(d)
    best, lowest = x, value(x)
    for generation in range(generations):
        spread, turn = np.linalg.eigh(covariance)
        spread = np.sqrt(np.maximum(spread, 1e-20))
        steps = (rng.normal(size=(count, d)) * spread) @ turn.T
        values = np.full(count, np.inf)
        for k, step in enumerate(steps):
            if not proceed(generation):
                return best
            values[k] = value(x + size * step)
            if values[k] < lowest:
                best, lowest = x + size * step, values[k]
        order = np.argsort(values, kind="stable")
        chosen = steps[order[:parents]]
        mean = share @ chosen
        x = x + size * mean
        whitened = turn @ ((turn.T @ mean) / spread)
        size_path = (1 - c_size) * size_path + np.sqrt(c_size * (2 - c_size) * mu) * whitened
        path = (1 - c_path) * path + np.sqrt(c_path * (2 - c_path) * mu) * mean
        covariance = (
            (1 - c_one - c_many) * covariance
            + c_one * np.outer(path, path)
            + c_many * (chosen.T * share) @ chosen
        )
        size *= float(np.exp(c_size / damp * (np.linalg.norm(size_path) / usual - 1)))
    return best


# Least squares over bounds and positive semidefinite matrices, by Clarabel's interior point.


_SOLVED = ("Solved", "AlmostSolved")

Matrices = tuple[np.ndarray, np.ndarray]
"""M (n, n) and D (x, n, n) of a symmetric matrix M + sum_i x_i D_i."""


def minimize_over_cones(
    residual: tuple[np.ndarray, np.ndarray],
    bounds: tuple[np.ndarray, np.ndarray],
    matrices: Sequence[Matrices],
    weights: Sequence[float] = (),
    linear: np.ndarray | None = None,
    **settings: Any,
) -> np.ndarray | None:
    """Returns the minimiser x (m,) of ||F x - g||^2 + c^T x - sum_k w_k log det S_k(x).

    Subject to A x + b >= 0 and every S_k(x) = M_k + sum_i x_i D_ki positive semidefinite; None if
    the solver finds none. Of a matrix with a weight, Z upper triangular with
    [diag Z, Z; Z^T, S] >= 0 has det S >= prod_i Z_ii (Ben-Tal and Nemirovski 2001, section 4.2),
    and log Z_ii is an exponential cone.

    Args:
        residual: F (r, m) and g (r,).
        bounds: A (k, m) and b (k,).
        matrices: S_k.
        weights: w_k; empty: 0.
        linear: c (m,); None: 0.
        **settings: of Clarabel, as `tol_gap_abs`.
    """
    import clarabel  # most commands need no solver

    F, g = residual
    unknowns, factored = F.shape[1], [len(M) for M, _ in matrices] if len(weights) else []
    total = unknowns + sum(n * (n + 3) // 2 for n in factored) + len(F)
    cost, curvature = np.zeros(total), np.zeros(total)
    cost[:unknowns] = 0.0 if linear is None else linear
    curvature[total - len(F) :] = 2.0
    rows = [np.hstack([F, np.zeros((len(F), total - unknowns - len(F))), -np.eye(len(F))])]
    sides, cones = [g], [clarabel.ZeroConeT(len(F))]

    def add(cone: Any, matrix: np.ndarray, side: np.ndarray) -> None:
        """Adds the rows matrix x + side in a cone, of the first unknowns."""
        rows.append(-np.pad(matrix, ((0, 0), (0, total - matrix.shape[1]))))
        sides.append(side)
        cones.append(cone)

    if len(bounds[0]):
        add(clarabel.NonnegativeConeT(len(bounds[0])), *bounds)
    first = unknowns
    for k, (M, D) in enumerate(matrices):
        if not factored:
            add(clarabel.PSDTriangleConeT(len(M)), _pack(D).T, _pack(M))
            continue
        n, upper = len(M), np.triu_indices(len(M))
        Z, diagonal = first + np.arange(len(upper[0])), np.flatnonzero(upper[0] == upper[1])
        E = np.zeros((Z[-1] + 1, 2 * n, 2 * n))
        E[: len(D), n:, n:] = D
        E[Z, upper[0], n + upper[1]] = E[Z, n + upper[1], upper[0]] = 1.0
        E[Z[diagonal], range(n), range(n)] = 1.0
        add(clarabel.PSDTriangleConeT(2 * n), _pack(E).T, _pack(np.pad(M, ((n, 0), (n, 0)))))
        first = Z[-1] + 1 + n
        cost[first - n : first] = -weights[k]
        for i in range(n):
            add(
                clarabel.ExponentialConeT(),
                np.eye(first)[[first - n + i, 0, Z[diagonal[i]]]] * [[1.0], [0.0], [1.0]],
                np.array([0.0, 1.0, 0.0]),
            )
    options = clarabel.DefaultSettings()
    for name, value in {"verbose": False, **settings}.items():
        setattr(options, name, value)
    solution = clarabel.DefaultSolver(
        csc_array(np.diag(curvature)),
        cost,
        csc_array(np.vstack(rows)),
        np.concatenate(sides),
        cones,
        options,
    ).solve()
    return np.array(solution.x[:unknowns]) if str(solution.status) in _SOLVED else None


def _pack(matrix: np.ndarray) -> np.ndarray:
    """Returns (..., n (n + 1) / 2) upper triangles, columns one after the other, of (..., n, n)."""
    column, row = np.tril_indices(matrix.shape[-1])
    return matrix[..., row, column] * np.where(row == column, 1.0, np.sqrt(2.0))


def solve_normal_equations(
    gram: np.ndarray, cross: np.ndarray, prior: np.ndarray | float = 0.0
) -> np.ndarray:
    """Returns the solution, to a few digits; a ridge for what data and prior leave open.

    The prior (c,) is added to the diagonal: each parameter alone makes no more torque than all.
    """
    gram = gram + np.diag(prior + np.zeros(len(gram)))
    size = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    scaled = gram / np.outer(size, size) + THRESHOLDS.normal_equation_ridge * np.eye(len(gram))
    return np.asarray(np.linalg.solve(scaled, cross / size) / size)
