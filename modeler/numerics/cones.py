"""Least squares over bounds and positive semidefinite matrices, by Clarabel's interior point.

    minimise ||F x - g||^2 + c^T x - sum_k w_k log det S_k(x)

over x with A x + b >= 0 and every S_k(x) = M_k + sum_i x_i D_ki positive semidefinite. Of a matrix
with a weight, Z upper triangular with [diag Z, Z; Z^T, S] >= 0 has det S >= prod_i Z_ii
(Ben-Tal and Nemirovski 2001, section 4.2), and log Z_ii is an exponential cone.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.sparse import csc_array

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
    """Returns the minimiser x (m,); None if the solver finds none.

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
