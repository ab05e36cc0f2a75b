"""Iteratively reweighted least squares: rows that do not fit lose their say."""

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np

from modeler.core.table import format_percent
from modeler.estimation.least_squares import (
    Estimate,
    Problem,
    compute_least_sigma,
    expand_columns,
    solve_least_squares,
)
from modeler.numerics.least_squares import compute_triangle
from modeler.numerics.noise import estimate_robust_deviation

HUBER = 1.345
TUKEY = 4.685
"""Standard deviations from which a row's weight falls (Huber) and is 0 (Tukey): both lose 5 % of
efficiency on Gaussian noise (Holland and Welsch 1977)."""

_ITERATIONS = 200
_SETTLED = 1e-8  # step, in standard deviations of the parameters
_TOLD = 0.05  # share of a joint's rows with less than half a weight that is told; Gaussian: 1.7 %


def estimate_robust(problem: Problem) -> Estimate:
    """The M-estimate sum_i psi(r_i / sigma_j) w_i / sigma_j = 0, r = y - W beta, j the joint of i.

    Huber's psi with sigma_j = 1.4826 median |r_i| of joint j to the fixed point; then Tukey's
    bisquare with these sigma_j held. Rows far off count less, far enough not at all. Covariance by
    the sandwich A^-1 B A^-1 rows / (rows - c), A = sum m_j w w^T / sigma_j^2, m_j the mean of psi'
    over joint j, B = sum psi^2 w w^T / sigma_j^2: it holds for noise that is not Gaussian and not
    alike in all rows (Huber 1981, section 7.6).

    Args:
        problem: beta in the units of its columns, y N m or N.
    """
    data = problem.data
    start = solve_least_squares(data, "weighted")
    kept_columns = np.asarray(start.rank.kept_columns, dtype=int)
    joint = problem.row_joint[problem.counted]
    W, y = problem.W[problem.counted], problem.y[problem.counted]
    fit = _Reweighted(W[:, kept_columns], y, joint, start, kept_columns)
    driven = [int(j) for j in np.unique(joint) if not data.free[j]]
    settled = fit.iterate_weights(
        _weigh_huber, driven, compute_least_sigma(data)
    ) and fit.iterate_weights(_weigh_tukey)
    kept_covariance, pull, kept_residual = fit.compute_sandwich()
    beta, covariance = expand_columns(len(data.names), kept_columns, fit.beta, kept_covariance)
    residual, weight = np.zeros((2, len(problem.y)))
    residual[problem.counted], weight[problem.counted] = kept_residual, fit.weight
    rows = np.column_stack([W, y]) * (np.sqrt(fit.weight) / fit.sigma[joint])[:, None]
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        sigma=fit.sigma,
        iterations=fit.iterations,
        is_converged=settled,
        sentences=_describe_weights(problem, fit.weight, joint),
        influence=problem.expand_rows(kept_columns, pull),
        residual=residual,
        weight=weight,
        whole=compute_triangle(rows),
    )


def _weigh_huber(u: np.ndarray) -> np.ndarray:
    return np.minimum(1.0, HUBER / np.maximum(u, HUBER))


def _weigh_tukey(u: np.ndarray) -> np.ndarray:
    return np.asarray((1.0 - np.minimum(u / TUKEY, 1.0) ** 2) ** 2)


class _Reweighted:
    """The iteration, in coordinates in which start's equations are orthonormal.

    There every step is a small well-conditioned system, however many rows there are.
    """

    def __init__(
        self,
        W: np.ndarray,
        y: np.ndarray,
        joint: np.ndarray,
        start: Estimate,
        kept_columns: np.ndarray,
    ) -> None:
        self.root = np.linalg.cholesky(start.covariance[np.ix_(kept_columns, kept_columns)])
        self.X = W @ self.root
        self.y, self.joint, self.sigma = y, joint, start.sigma.copy()
        self.start = start.beta[kept_columns]
        self.residual = y - W @ self.start
        self.step = np.zeros(len(kept_columns))
        self.weight = np.ones(len(y))
        self.iterations = 0

    @property
    def beta(self) -> np.ndarray:
        return self.start + self.root @ self.step

    def iterate_weights(
        self,
        weigh: Callable[[np.ndarray], np.ndarray],
        scaled: Sequence[int] = (),
        least: Sequence[float] | np.ndarray = (),
    ) -> bool:
        """To the fixed point of beta, and of the scales of some joints, at least so large."""
        for _ in range(_ITERATIONS):
            for j in scaled:
                self.sigma[j] = max(
                    estimate_robust_deviation(self._compute_residual()[self.joint == j]), least[j]
                )
            self.weight = weigh(np.abs(self._compute_residual() / self.sigma[self.joint]))
            weighted = self.X * (self.weight / self.sigma[self.joint] ** 2)[:, None]
            step = np.linalg.lstsq(weighted.T @ self.X, weighted.T @ self.residual, rcond=None)[0]
            moved = float(np.max(np.abs(step - self.step), initial=0.0))
            self.step, self.iterations = step, self.iterations + 1
            if moved < _SETTLED:
                return True
        return False

    def _compute_residual(self) -> np.ndarray:
        return np.asarray(self.residual - self.X @ self.step)

    def compute_sandwich(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Covariance (k, k), pull (rows, k) and weighed residual (rows,)."""
        u = self._compute_residual() / self.sigma[self.joint]
        slope = np.where(np.abs(u) < TUKEY, (1 - (u / TUKEY) ** 2) * (1 - 5 * (u / TUKEY) ** 2), 0)
        counts = np.bincount(self.joint, minlength=len(self.sigma))
        means = np.bincount(self.joint, slope, len(self.sigma)) / np.maximum(counts, 1)
        scaled = self.X / self.sigma[self.joint][:, None]
        A = scaled.T @ (scaled * np.maximum(means, 1e-3)[self.joint][:, None])
        pull = np.linalg.solve(A, scaled.T).T
        psi = self.weight * u
        middle = pull * psi[:, None]
        rows, columns = self.X.shape
        covariance = middle.T @ middle * rows / max(1, rows - columns)
        back = pull @ self.root.T / self.sigma[self.joint][:, None]
        return self.root @ covariance @ self.root.T, back, psi * self.sigma[self.joint]


def _describe_weights(problem: Problem, weight: np.ndarray, joint: np.ndarray) -> tuple[str, ...]:
    said = []
    for j, spec in enumerate(problem.observation.joints):
        is_of_joint = joint == j
        share = float(np.mean(weight[is_of_joint] < 0.5)) if is_of_joint.any() else 0.0
        if share > _TOLD:
            said.append(
                f"joint {spec.name}: {format_percent(share)} of its rows have less than half a "
                "weight "
                "in the robust fit; Gaussian noise leaves 2 %; if they lie together (low speed, "
                "a part of the range), the model is wrong there and not the rows"
            )
    return tuple(said)
