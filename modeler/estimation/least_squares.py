"""What an estimator is given, what it gives, and least squares of y = W beta by joints.

Rows of an observation with or without W; weights, iterations, standard deviations.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.numerics.least_squares import CompressedRegression, Rank, find_independent_columns
from modeler.regression import Observation, compute_fitted_torque, is_streamed, iterate_blocks
from modeler.runtime import CompiledModel

MAX_ITERATIONS = 500
_SETTLED = 1e-9  # relative change of the weights
_LEAST = 1e-9  # a joint's standard deviation is at least this share of its torque


def compute_base_residual(
    observation: Observation, beta: np.ndarray, counted: np.ndarray | None = None
) -> np.ndarray:
    """y - W beta of the base parameters, for all rows or those that are counted (rows,)."""
    keep = observation.used if counted is None else select_rows(observation, counted)
    return np.asarray((observation.torque - compute_fitted_torque(observation, beta, keep))[keep])


def select_rows(observation: Observation, counted: np.ndarray) -> np.ndarray:
    """(s, n) True for the rows that are counted (rows,)."""
    keep = np.zeros(observation.used.shape, dtype=bool)
    keep[observation.used] = counted
    return keep


def sum_streamed_products(
    observation: Observation, counted: np.ndarray, matrices: np.ndarray, r: Sequence[np.ndarray]
) -> np.ndarray:
    """(k, k) sum_j sum_l r_j(l) sum_t a_j(t) a_j(t + l)^T and its transpose; l = 1, 2, ...

    a_j(t) = w_j(t) A_j, w_j(t) the row of joint j at sample t, 0 where it is not counted. The
    columns of the samples pass by in blocks, and with them the last rows of the block before.

    Args:
        observation: of the rows.
        counted: (rows,) True for those that count.
        matrices: A_j (c, k) of each joint.
        r: r_j(0), r_j(1), ... of each joint; one value and no more for a joint to leave out.
    """
    keep = select_rows(observation, counted)
    k, longest = matrices.shape[2], max(len(values) - 1 for values in r)
    total = np.zeros((k, k))
    before: list[np.ndarray] = []
    at = -1
    for samples, columns in iterate_blocks(observation) if longest else ():
        if observation.segment[samples.start] != at:
            before = [np.zeros((longest, k))] * len(r)
        at = int(observation.segment[samples.start])
        for j, correlation in enumerate(r):
            if len(correlation) < 2:
                continue
            now = (columns[:, j] * keep[samples, j, None]) @ matrices[j]
            rows = np.concatenate([before[j], now])
            for lag, weight in enumerate(correlation[1:], start=1):
                earlier = rows[longest - lag : len(rows) - lag]
                total += weight * (earlier.T @ now)
            before[j] = rows[len(rows) - longest :]
    return total + total.T


# What an estimator is given.


@dataclass(frozen=True, eq=False)
class Rows:
    """Row for row those of an observation; c columns.

    Attributes:
        observation: says which row is which joint and sample, and holds the motion.
        given: (rows, c) W; None: that of the observation.
        y: (rows,) N m or N.
        counted: (rows,) rows to fit; the others are of joints without a torque.
    """

    observation: Observation
    matrix: np.ndarray | None
    y: np.ndarray
    counted: np.ndarray

    @property
    def W(self) -> np.ndarray:
        """(rows, c)."""
        return self.observation.W if self.matrix is None else self.matrix

    @property
    def has_streamed_rows(self) -> bool:
        """True if W is better not asked for: it is large."""
        return self.matrix is None and is_streamed(self.observation)

    @property
    def row_joint(self) -> np.ndarray:
        """(rows,) index of the joint of each row."""
        return self.observation.row_joint

    def compute_residual(self, beta: np.ndarray) -> np.ndarray:
        """(rows,) y - W beta."""
        if self.has_streamed_rows:
            return compute_base_residual(self.observation, beta)
        return np.asarray(self.y - self.W @ beta)


@dataclass(frozen=True, eq=False)
class Problem(Rows):
    """y = W beta + rho.

    Attributes:
        names: (c,) base parameters first, then those of loads.
        data: the counted rows, compressed.
        model: the compiled robot; None where nobody gave it.
    """

    names: tuple[str, ...]
    data: CompressedRegression
    model: CompiledModel | None = None

    def expand_rows(self, kept_columns: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(rows, c) of values (counted rows, kept columns); 0 elsewhere."""
        every = np.zeros((len(self.y), len(self.names)))
        every[np.ix_(self.counted, kept_columns)] = values
        return every

    def require_robot(self, method: str) -> CompiledModel:
        """The compiled robot, for an estimator that cannot do without it.

        Raises:
            DataError: it was not given, or there are loads beside it.
        """
        if self.model is None:
            raise DataError(
                f'method "{method}" evaluates the robot; got no compiled model; give it as '
                "identify(observation, method, model)"
            )
        if len(self.names) != len(self.observation.names):
            extra = ", ".join(self.names[len(self.observation.names) :])
            raise DataError(
                f'method "{method}" knows the columns of the bare robot only; got {extra} besides; '
                'fit logs without a load, or use method "weighted"'
            )
        return self.model


# The estimate.


@dataclass(frozen=True, eq=False)
class Estimate:
    """The solution; c columns, n joints. Columns set aside have value 0 and no variance.

    Attributes:
        beta: (c,).
        covariance: (c, c), rows and columns of parameters set aside are 0.
        sigma: (n,) standard deviation of a row of each joint, N m or N; the weights are 1/sigma.
        rank: columns kept and set aside.
        iterations: of the weights; 0 for ordinary least squares.
        settled: the weights reached their fixed point.
        condition_number: of W, kept columns.
        condition_scaled: with columns of length one.
        degrees: rows less parameters.
        sentences: what a reader must know of this estimate.
        bread: (c, c) of beta = bread W^T y; None for weights 1/sigma, where it is the covariance.
        pull: (rows, c) of d beta = sum_i pull_i e_i, in units of beta per unit of row i, 0 for rows
            that were not fitted; None for least squares over W.
        residual: (rows,) what was left of each row, N m or N, weighed as the estimator does; None:
            y - W beta.
        weight: (rows,) of the rows, 1 where they fit, of an estimator that weighs each; None: 1.
        whole: (c + 1, c + 1) triangle of the weighted equations whose least squares this is; None
            for those of the data with weights 1/sigma.
        standard: all standard parameters by name, SI, where the estimator ends in them.
        share: (c,) of what is known of each that comes from the prior; None without one.
        held: names of those that cannot move.
        contradicted: lines on what the prior says and the data contradict.
    """

    beta: np.ndarray
    covariance: np.ndarray
    sigma: np.ndarray
    rank: Rank
    iterations: int
    is_converged: bool
    condition_number: float
    condition_scaled: float
    degrees: int
    sentences: tuple[str, ...] = ()
    bread: np.ndarray | None = None
    influence: np.ndarray | None = None
    residual: np.ndarray | None = None
    weight: np.ndarray | None = None
    whole: np.ndarray | None = None
    standard: Mapping[str, float] = field(default_factory=dict)
    prior_share: np.ndarray | None = None
    fixed_names: tuple[str, ...] = ()
    contradicted: tuple[str, ...] = ()

    def describe_nonconvergence(self) -> list[str]:
        """A sentence where the weights of joints do not reach their fixed point."""
        if self.is_converged or self.iterations < MAX_ITERATIONS:
            return []
        return [
            f"the joint weights still change after {MAX_ITERATIONS} iterations; "
            'record more rows, or use method "ordinary"'
        ]


def solve_least_squares(data: CompressedRegression, method: Method = "weighted") -> Estimate:
    """The estimate of beta in y = W beta + rho.

    Ordinary: one variance for all rows, sigma^2 (W^T W)^-1. Weighted: rows of joint j divided by
    the standard deviation sigma_j of that joint's residual, and (sum_j W_j^T W_j / sigma_j^2)^-1
    (Gautier 1997). The weights are iterated until they no longer change: after one step, the
    misfit of one joint is still shared out to the others.

    sigma_j^2 = ||r_j||^2 / (rows_j - h_j), h_j the parameters that joint j's rows determine
    (trace of its part of the hat matrix; the h_j sum to the number of parameters).

    Rows 0 = W_j beta of a joint without a motor would be satisfied by beta = 0 and by their own
    weight drive the iteration there. Their sigma is at least as large, beside the torques that
    cancel in them, as the others' beside the torques that are measured.

    Args:
        data: compressed rows.
        method: which weights.
    """
    sigma = np.ones(len(data.rows))  # what rows tell apart does not depend on their torques
    rank = find_independent_columns(data.combine_joints(sigma)[:, :-1], data.names)
    kept_columns = np.asarray(rank.kept_columns, dtype=int)
    degrees = max(1, int(data.rows.sum()) - len(kept_columns))
    beta, covariance = _solve_weighted(data, kept_columns, sigma)
    common = np.sqrt(np.sum(data.compute_residual_norms(beta) ** 2) / degrees)
    iterations, settled = 0, True
    if method == "ordinary":
        sigma = np.full(len(data.rows), max(common, compute_least_sigma(data).max()))
        covariance = covariance * sigma[0] ** 2
    else:
        terms = np.linalg.norm(data.triangles[:, :, :-1] * beta, axis=(1, 2))
        cancelling = terms / np.sqrt(np.maximum(data.rows, 1))  # rms of the terms of W_j beta
        sigma = _bound_sigma(data, _estimate_sigma(data, beta, covariance, sigma), cancelling)
        settled = False
        while not settled and iterations < MAX_ITERATIONS:
            beta, covariance = _solve_weighted(data, kept_columns, sigma)
            updated = _bound_sigma(data, _estimate_sigma(data, beta, covariance, sigma), cancelling)
            settled = bool(np.all(np.abs(updated / sigma - 1.0) < _SETTLED))
            sigma, iterations = updated, iterations + 1
    raw, scaled = compute_condition_numbers(
        data.combine_joints(np.ones(len(data.rows)))[:, kept_columns]
    )
    return Estimate(beta, covariance, sigma, rank, iterations, settled, raw, scaled, degrees)


def solve_by_qr(W: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The beta (c,) of least ||y - W beta||, and a root (c, c): root root^T = (W^T W)^-1.

    Args:
        W: (rows, c) independent columns; scaled to length one before the QR.
        y: (rows,).
    """
    lengths = np.linalg.norm(W, axis=0)
    q, r = np.linalg.qr(W / lengths)
    root = np.linalg.solve(r, np.eye(W.shape[1])) / lengths[:, None]
    return root @ (q.T @ y), root


def compute_least_sigma(data: CompressedRegression) -> np.ndarray:
    """(n,) the smallest sigma of each joint: exact data would otherwise divide by zero."""
    rms = data.compute_torque_rms()
    return np.maximum(_LEAST * rms, max(1e-3 * _LEAST * rms.max(initial=0.0), 1e-300))


def _bound_sigma(
    data: CompressedRegression, spread: np.ndarray, cancelling: np.ndarray
) -> np.ndarray:
    """(n,) sigma from the spread of the residuals, kept away from 0."""
    sigma = np.maximum(spread, compute_least_sigma(data))
    rms = data.compute_torque_rms()
    driven = ~data.free & (rms > 0.0)
    if driven.any():
        error = float(np.sqrt(np.mean((sigma[driven] / rms[driven]) ** 2)))
        sigma = np.where(data.free, np.maximum(sigma, error * cancelling), sigma)
    return sigma


def _solve_weighted(
    data: CompressedRegression, kept_columns: np.ndarray, sigma: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """beta and (W^T S^-1 W)^-1 over all columns."""
    whole = data.combine_joints(sigma)
    values, root = solve_by_qr(whole[:, kept_columns], whole[:, -1])
    return expand_columns(len(data.names), kept_columns, values, root @ root.T)


def expand_columns(
    columns: int,
    kept_columns: Sequence[int] | np.ndarray,
    values: np.ndarray,
    covariance: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """(c,) values and (c, c) covariance of the kept columns among all c; 0 elsewhere."""
    at = np.asarray(kept_columns, dtype=int)
    beta, every = np.zeros(columns), np.zeros((columns, columns))
    beta[at], every[np.ix_(at, at)] = values, covariance
    return beta, every


def _estimate_sigma(
    data: CompressedRegression, beta: np.ndarray, covariance: np.ndarray, sigma: np.ndarray
) -> np.ndarray:
    """(n,) standard deviation of each joint's rows."""
    W = data.triangles[:, :, :-1]
    share = np.einsum("jik,kl,jil->j", W, covariance, W, optimize=True) / sigma**2
    degrees = np.maximum(data.rows - share, 0.0)
    spread = data.compute_residual_norms(beta) / np.sqrt(np.maximum(degrees, 1e-12))
    return np.where(degrees > 0.5, spread, np.maximum(data.compute_torque_rms(), 1e-300))


def compute_condition_numbers(W: np.ndarray) -> tuple[float, float]:
    """Of W (rows, c), and of W with columns of length one; infinite without columns."""
    if not W.size:
        return float("inf"), float("inf")
    return float(np.linalg.cond(W)), float(np.linalg.cond(W / np.linalg.norm(W, axis=0)))


# Ordinary least squares whose sigmas know that joints are not alike.


def estimate_ordinary(problem: Problem) -> Estimate:
    """min |y - W beta|^2; covariance A^-1 (sum_j s_j^2 W_j^T W_j) A^-1, A = W^T W.

    s_j^2 = |r_j|^2 / (rows_j - h_j) of joint j, h_j = trace(A^-1 W_j^T W_j). The textbook's
    sigma^2 A^-1 holds where all s_j are one sigma (White 1980, Econometrica 48(4)); a quiet wrist
    beside a loud shoulder then has sigmas that are too large, and the shoulder too small ones.

    Args:
        problem: beta in the units of its columns, y N m or N.
    """
    data = problem.data
    fit = solve_least_squares(data, "ordinary")
    bread = fit.covariance / fit.sigma[0] ** 2
    matrices = data.triangles[:, :, :-1]
    squares = np.einsum("jik,jil->jkl", matrices, matrices)
    spread = _estimate_sigma(data, fit.beta, fit.covariance, fit.sigma)
    spread = np.maximum(spread, compute_least_sigma(data))
    middle = np.einsum("j,jkl->kl", spread**2, squares)
    return dataclasses.replace(fit, covariance=bread @ middle @ bread, bread=bread)
