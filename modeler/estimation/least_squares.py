"""Estimators of y = W beta by rows and joints: ordinary and weighted least squares, ridge, robust.

Rows of an observation with or without W; weights, iterations, standard deviations.
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.table import format_percent
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import (
    CompressedRegression,
    Rank,
    compute_triangle,
    find_independent_columns,
)
from modeler.numerics.noise import estimate_robust_deviation
from modeler.regression import Observation, compute_fitted_torque, is_streamed, iterate_blocks
from modeler.runtime import CompiledModel


def compute_base_residual(
    observation: Observation, beta: np.ndarray, counted: np.ndarray | None = None
) -> np.ndarray:
    """Returns y - W beta of the base parameters, for all rows or those that are counted (rows,)."""
    keep = observation.used if counted is None else select_rows(observation, counted)
    return np.asarray((observation.torque - compute_fitted_torque(observation, beta, keep))[keep])


def select_rows(observation: Observation, counted: np.ndarray) -> np.ndarray:
    """Returns (s, n) True for the rows that are counted (rows,)."""
    keep = np.zeros(observation.used.shape, dtype=bool)
    keep[observation.used] = counted
    return keep


def sum_streamed_products(
    observation: Observation, counted: np.ndarray, matrices: np.ndarray, r: Sequence[np.ndarray]
) -> np.ndarray:
    """Returns (k, k) sum_j sum_l r_j(l) sum_t a_j(t) a_j(t + l)^T and its transpose; l = 1, 2, ...

    a_j(t) = w_j(t) A_j, w_j(t) the row of joint j at sample t, 0 where it is not counted. The
    columns of the samples are streamed in blocks, and with them the last rows of the block before.

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
                total += weight * (rows[longest - lag : len(rows) - lag].T @ now)
            before[j] = rows[len(rows) - longest :]
    return total + total.T


# What an estimator works on.


@dataclass(frozen=True, eq=False)
class Rows:
    """Holds rows, one by one those of an observation; c columns.

    Attributes:
        observation: says which row is which joint and sample, and holds the motion.
        matrix: (rows, c) W; None: that of the observation.
        y: (rows,) N m or N.
        counted: (rows,) rows to fit; the others are of joints without a torque.
    """

    observation: Observation
    matrix: np.ndarray | None
    y: np.ndarray
    counted: np.ndarray

    @property
    def W(self) -> np.ndarray:
        """Returns the matrix W (rows, c) of the rows."""
        return self.observation.W if self.matrix is None else self.matrix

    @property
    def has_streamed_rows(self) -> bool:
        """Returns True if W is better not built: it is large."""
        return self.matrix is None and is_streamed(self.observation)

    @property
    def row_joint(self) -> np.ndarray:
        """Returns the index (rows,) of the joint of each row."""
        return self.observation.row_joint

    def compute_residual(self, beta: np.ndarray) -> np.ndarray:
        """Returns (rows,) y - W beta."""
        if self.has_streamed_rows:
            return compute_base_residual(self.observation, beta)
        return np.asarray(self.y - self.W @ beta)


@dataclass(frozen=True, eq=False)
class Problem(Rows):
    """Holds y = W beta + rho.

    Attributes:
        names: (c,) base parameters first, then those of loads.
        data: the counted rows, compressed.
        model: the compiled robot; None without one.
    """

    names: tuple[str, ...]
    data: CompressedRegression
    model: CompiledModel | None = None

    def expand_rows(self, kept_columns: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Returns (rows, c) of values (counted rows, kept columns); 0 elsewhere."""
        every = np.zeros((len(self.y), len(self.names)))
        every[np.ix_(self.counted, kept_columns)] = values
        return every

    def require_robot(self, method: str) -> CompiledModel:
        """Returns the compiled robot, for an estimator that needs it.

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


@dataclass(frozen=True, eq=False)
class Estimate:
    """Holds the solution; c columns, n joints. Columns that are not kept have value 0.

    Attributes:
        beta: (c,).
        covariance: (c, c), rows and columns of dropped parameters are 0.
        sigma: (n,) standard deviation of a row of each joint, N m or N; the weights are 1/sigma.
        rank: columns kept, and those that the rows alone do not determine.
        iterations: of the weights; 0 for ordinary least squares.
        is_converged: the weights reached their fixed point.
        condition_number: of W, kept columns.
        condition_scaled: with columns of length one.
        degrees: rows less parameters.
        sentences: what a reader must know of this estimate.
        bread: (c, c) of beta = bread W^T y; None for weights 1/sigma, where it is the covariance.
        influence: (rows, c) of d beta = sum_i influence_i e_i, in units of beta per unit of row i,
            0 for rows that were not fitted; None for least squares over W.
        residual: (rows,) of each row, N m or N, weighed as the estimator does; None: y - W beta.
        weight: (rows,) of the rows, 1 where they fit, of an estimator that weighs each; None: 1.
        whole: (c + 1, c + 1) triangle of the weighted equations whose least squares this is; None
            for those of the data with weights 1/sigma.
        standard: all standard parameters by name, SI, where the estimator ends in them.
        prior_share: (c,) of what is known of each that comes from the prior; None without one.
        fixed_names: of parameters that cannot move.
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
        """Returns a sentence where the weights of joints do not reach their fixed point."""
        most = THRESHOLDS.max_weight_iterations
        if self.is_converged or self.iterations < most:
            return []
        return [
            f"the joint weights have not converged after {most} iterations; record more rows, or "
            'use method "ordinary"'
        ]


def solve_least_squares(data: CompressedRegression, method: Method = "weighted") -> Estimate:
    """Returns the estimate of beta in y = W beta + rho.

    Ordinary: one variance for all rows, sigma^2 (W^T W)^-1. Weighted: rows of joint j divided by
    the standard deviation sigma_j of that joint's residual, and (sum_j W_j^T W_j / sigma_j^2)^-1
    (Gautier 1997). The weights are iterated until they no longer change: after one step, the
    misfit of one joint is still shared out to the others.

    sigma_j^2 = ||r_j||^2 / (rows_j - h_j), h_j the parameters that joint j's rows determine
    (trace of its part of the hat matrix; the h_j sum to the number of parameters).

    Rows 0 = W_j beta of a joint without a motor would be satisfied by beta = 0 and by their own
    weight drive the iteration there. Their sigma is at least as large, beside the torques that
    cancel in them, as the others' beside the torques that are measured.

    With a prior no column is left out: those that the rows do not tell apart share their effect,
    and `rank` still says which they are.

    Args:
        data: compressed rows.
        method: which weights; "ordinary" knows no prior, as it has no scale.
    """
    if method == "ordinary":
        data = dataclasses.replace(data, prior=None)
    sigma = np.ones(len(data.rows))  # the rank does not depend on torques
    unweighted = dataclasses.replace(data, prior=None).combine_joints(sigma)[:, :-1]
    rank = find_independent_columns(unweighted, data.names)
    columns = np.asarray(rank.kept_columns, dtype=int)
    degrees = max(1, int(data.rows.sum()) - len(columns))
    raw, scaled = compute_condition_numbers(unweighted[:, columns])
    if data.prior is not None:  # no column carries what another does
        columns = np.flatnonzero(np.any(data.combine_joints(sigma)[:, :-1], axis=0))
        rank = dataclasses.replace(rank, kept_columns=tuple(columns.tolist()))
    beta, covariance = _solve_weighted(data, columns, sigma)
    iterations, is_converged = 0, True
    if method == "ordinary":
        common = np.sqrt(np.sum(data.compute_residual_norms(beta) ** 2) / degrees)
        sigma = np.full(len(data.rows), max(common, compute_least_sigma(data).max()))
        covariance = covariance * sigma[0] ** 2
    else:
        terms = np.linalg.norm(data.triangles[:, :, :-1] * beta, axis=(1, 2))
        cancelling = terms / np.sqrt(np.maximum(data.rows, 1))  # rms of the terms of W_j beta
        sigma = _bound_sigma(data, _estimate_sigma(data, beta, covariance, sigma), cancelling)
        is_converged = False
        while not is_converged and iterations < THRESHOLDS.max_weight_iterations:
            beta, covariance = _solve_weighted(data, columns, sigma)
            updated = _estimate_sigma(data, beta, covariance, sigma)
            updated = _bound_sigma(data, updated, cancelling)
            change = np.abs(updated / sigma - 1.0)
            is_converged = bool(np.all(change < THRESHOLDS.weight_tolerance))
            sigma, iterations = updated, iterations + 1
    return Estimate(beta, covariance, sigma, rank, iterations, is_converged, raw, scaled, degrees)


def solve_by_qr(W: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the beta (c,) of least ||y - W beta||, and a root: root root^T = (W^T W)^-1.

    Args:
        W: (rows, c) independent columns; scaled to length one before the QR.
        y: (rows,).
    """
    lengths = np.linalg.norm(W, axis=0)
    q, r = np.linalg.qr(W / lengths)
    root = np.linalg.solve(r, np.eye(W.shape[1])) / lengths[:, None]
    return root @ (q.T @ y), root


def compute_least_sigma(data: CompressedRegression) -> np.ndarray:
    """Returns (n,) the smallest sigma of each joint: exact data would otherwise divide by zero."""
    least = THRESHOLDS.rounding_share * data.compute_torque_rms()
    return np.maximum(least, max(1e-3 * least.max(initial=0.0), 1e-300))


def _bound_sigma(
    data: CompressedRegression, spread: np.ndarray, cancelling: np.ndarray
) -> np.ndarray:
    """Returns (n,) sigma from the spread of the residuals, kept away from 0."""
    sigma = np.maximum(spread, compute_least_sigma(data))
    rms = data.compute_torque_rms()
    driven = ~data.free & (rms > 0.0)
    if driven.any():
        error = float(np.sqrt(np.mean((sigma[driven] / rms[driven]) ** 2)))
        sigma = np.where(data.free, np.maximum(sigma, error * cancelling), sigma)
    return sigma


def _solve_weighted(
    data: CompressedRegression, columns: np.ndarray, sigma: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Returns beta and (W^T S^-1 W)^-1 over all columns."""
    whole = data.combine_joints(sigma)
    values, root = solve_by_qr(whole[:, columns], whole[:, -1])
    return expand_columns(len(data.names), columns, values, root @ root.T)


def expand_columns(
    count: int, columns: Sequence[int] | np.ndarray, values: np.ndarray, covariance: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Returns (c,) values and (c, c) covariance of some columns among all; 0 elsewhere."""
    at = np.asarray(columns, dtype=int)
    beta, every = np.zeros(count), np.zeros((count, count))
    beta[at], every[np.ix_(at, at)] = values, covariance
    return beta, every


def _estimate_sigma(
    data: CompressedRegression, beta: np.ndarray, covariance: np.ndarray, sigma: np.ndarray
) -> np.ndarray:
    """Returns (n,) standard deviation of each joint's rows."""
    W = data.triangles[:, :, :-1]
    share = np.einsum("jik,kl,jil->j", W, covariance, W, optimize=True) / sigma**2
    degrees = np.maximum(data.rows - share, 0.0)
    spread = data.compute_residual_norms(beta) / np.sqrt(np.maximum(degrees, 1e-12))
    return np.where(degrees > 0.5, spread, np.maximum(data.compute_torque_rms(), 1e-300))


def compute_condition_numbers(W: np.ndarray) -> tuple[float, float]:
    """Returns that of W (rows, c), and with columns of length one; infinite without columns."""
    if not W.size:
        return float("inf"), float("inf")
    return float(np.linalg.cond(W)), float(np.linalg.cond(W / np.linalg.norm(W, axis=0)))


def estimate_ordinary(problem: Problem) -> Estimate:
    """Returns min |y - W beta|^2; covariance A^-1 (sum_j s_j^2 W_j^T W_j) A^-1, A = W^T W.

    s_j^2 = |r_j|^2 / (rows_j - h_j) of joint j, h_j = trace(A^-1 W_j^T W_j). The textbook's
    sigma^2 A^-1 holds where all s_j are one sigma (White 1980, Econometrica 48(4)); a quiet wrist
    beside a loud shoulder then has sigmas that are too large, and the shoulder too small ones.

    Args:
        problem: beta in the units of its columns, y N m or N.
    """
    data = problem.data
    fit = solve_least_squares(data, "ordinary")
    bread = fit.covariance / fit.sigma[0] ** 2
    W = data.triangles[:, :, :-1]
    squares = np.einsum("jik,jil->jkl", W, W)
    spread = _estimate_sigma(data, fit.beta, fit.covariance, fit.sigma)
    spread = np.maximum(spread, compute_least_sigma(data))
    middle = np.einsum("j,jkl->kl", spread**2, squares)
    return dataclasses.replace(fit, covariance=bread @ middle @ bread, bread=bread)


# Ridge: what the data leave open is drawn towards 0, or towards the robot's nominal values.


_LOG_WIDTHS = (-6.0, 9.0)
"""log10 of the width of the prior, in standard deviations of the noise of a column alone."""


@dataclass(frozen=True, eq=False)
class _Posterior:
    """Holds that of the deviations from the prior, columns scaled to length one."""

    mean: np.ndarray
    covariance: np.ndarray
    width: float
    data_directions: float  # that the data decide, sum of s^2 t^2 / (1 + s^2 t^2)


def estimate_ridge(problem: Problem) -> Estimate:
    """Returns min |S^-1/2 (y - W beta)|^2 + lambda |D (beta - beta_0)|^2.

    S = diag sigma_j^2 of the weighted fit, D the lengths of the columns of S^-1/2 W, beta_0 the
    nominal values of the robot file where every standard parameter of a base parameter has one,
    else 0. lambda = 1 / t^2 by the probability of the data where D (beta - beta_0) is Gaussian of
    standard deviation t (MacKay 1992, Neural Computation 4(3)); the covariance is that of the
    posterior, (W^T S^-1 W + lambda D^2)^-1 averaged over what the data leave open of lambda. It
    holds if the values scatter about beta_0 as that says; of the bias of one that lies elsewhere
    it says nothing.

    Columns that depend on each other share their effect; columns of zeros are dropped.

    Args:
        problem: beta in the units of its columns, y N m or N.
    """
    data = problem.data
    start = solve_least_squares(data, "weighted")
    whole = data.combine_joints(start.sigma)
    lengths = np.linalg.norm(whole[:, :-1], axis=0)
    dropped = tuple(column for column in start.rank.dropped_columns if not column.into)
    idle = {column.name for column in dropped}
    columns = [i for i, name in enumerate(data.names) if name not in idle]
    prior, known = collect_prior_values(problem)
    scale = lengths[columns]
    left = whole[:, -1] - whole[:, columns] @ prior[columns]
    posterior = _compute_posterior(whole[:, columns] / scale, left)
    values, V = prior[columns] + posterior.mean / scale, posterior.covariance
    beta, covariance = expand_columns(len(prior), columns, values, V / np.outer(scale, scale))
    # The prior as further rows, D / t (beta - beta_0) = 0.
    rows = np.zeros((len(columns), whole.shape[1]))
    rows[np.arange(len(columns)), columns] = scale / posterior.width
    rows[:, -1] = rows[:, :-1] @ prior
    towards = "0"
    if known:
        rest = len(problem.names) - len(known)
        towards = "the nominal values of the robot file" + (f" ({rest} have none: 0)" * bool(rest))
    note = (
        f"ridge towards {towards}: lambda = {posterior.width**-2:.3g} with columns of length one; "
        f"the data determine {posterior.data_directions:.1f} of {len(posterior.mean)} directions, "
        "the prior the others; the sigmas do not include bias"
    )
    shared = (
        f"{column.name} is not identifiable apart from {', '.join(column.into)} from these data: "
        "ridge shares their effect out by the prior"
        for column in start.rank.dropped_columns
        if column.into
    )
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        rank=Rank(tuple(columns), dropped, start.rank.last_kept, start.rank.first_dropped),
        condition_scaled=float(np.sqrt(np.linalg.cond(V))),
        sentences=(note, *shared),
        whole=compute_triangle(np.vstack([whole, rows])),
    )


def collect_prior_values(problem: Problem) -> tuple[np.ndarray, tuple[str, ...]]:
    """Returns (c,) nominal values of the columns, 0 where there are none; and which have one."""
    values, known = np.zeros(len(problem.names)), []
    if problem.model is not None:
        spec = problem.model.spec
        nominal = {p.name: p.nominal for p in spec.standard if p.nominal is not None}
        for i, base in enumerate(spec.base):
            if base.terms and all(term.parameter in nominal for term in base.terms):
                values[i] = sum(term.value * nominal[term.parameter] for term in base.terms)
                known.append(base.name)
    return values, tuple(known)


def _compute_posterior(X: np.ndarray, y: np.ndarray) -> _Posterior:
    """Returns that of X g = y + white noise of variance 1, g Gaussian of a width t from the data.

    X = U S V^T and a = U^T y: a_k is Gaussian of variance 1 + s_k^2 t^2, which is all that t
    changes of the probability of the data. Few columns say little of t: mean and covariance are
    those of the mixture over all t whose log-probability is within 2 of the best, by weight.
    """
    U, s, Vt = np.linalg.svd(X, full_matrices=False)
    a = U.T @ y
    widths = np.logspace(*_LOG_WIDTHS, THRESHOLDS.prior_widths)
    variance = 1.0 + np.outer(widths**2, s**2)
    likely = -0.5 * np.sum(np.log(variance) + a**2 / variance, axis=1)
    near = likely > likely.max() - THRESHOLDS.width_log_probability
    weight = np.exp(likely[near] - likely.max())
    weight = weight / weight.sum()
    spread = widths[near, None] ** 2 / variance[near]  # of each direction at each width
    means = spread * s * a
    mean = weight @ means
    away = means - mean
    within = np.diag(weight @ spread) + (away * weight[:, None]).T @ away
    width = float(np.exp(weight @ np.log(widths[near])))
    decided = float(weight @ (s**2 * spread).sum(axis=1))
    return _Posterior(Vt.T @ mean, Vt.T @ within @ Vt, width, decided)


# Iteratively reweighted least squares: rows that do not fit lose their weight.


HUBER = 1.345
TUKEY = 4.685
"""Standard deviations from which a row's weight falls (Huber) and is 0 (Tukey): both lose 5 % of
efficiency on Gaussian noise (Holland and Welsch 1977)."""


def estimate_robust(problem: Problem) -> Estimate:
    """Returns the M-estimate sum_i psi(r_i / sigma_j) w_i / sigma_j = 0, j the joint of row i.

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
    columns = np.asarray(start.rank.kept_columns, dtype=int)
    joint = problem.row_joint[problem.counted]
    W, y = problem.W[problem.counted], problem.y[problem.counted]
    fit = _Reweighted(W[:, columns], y, joint, start, columns)
    driven = [int(j) for j in np.unique(joint) if not data.free[j]]
    is_converged = fit.iterate_weights(
        lambda u: np.minimum(1.0, HUBER / np.maximum(u, HUBER)), driven, compute_least_sigma(data)
    ) and fit.iterate_weights(lambda u: (1.0 - np.minimum(u / TUKEY, 1.0) ** 2) ** 2)
    V, influence, row_residual = fit.compute_sandwich()
    values = fit.start + fit.root @ fit.step
    beta, covariance = expand_columns(len(data.names), columns, values, V)
    residual, weight = np.zeros((2, len(problem.y)))
    residual[problem.counted], weight[problem.counted] = row_residual, fit.weight
    rows = np.column_stack([W, y]) * (np.sqrt(fit.weight) / fit.sigma[joint])[:, None]
    lines = []
    for j in np.unique(joint):
        share = float(np.mean(fit.weight[joint == j] < 0.5))
        if share > THRESHOLDS.max_rejected_share:
            lines.append(
                f"joint {problem.observation.joints[j].name}: {format_percent(share)} of its rows "
                "have less than half a weight in the robust fit (Gaussian noise: 2 %); where they "
                "lie together, the model is wrong there"
            )
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        sigma=fit.sigma,
        iterations=fit.iterations,
        is_converged=is_converged,
        sentences=tuple(lines),
        influence=problem.expand_rows(columns, influence),
        residual=residual,
        weight=weight,
        whole=compute_triangle(rows),
    )


class _Reweighted:
    """Runs the iteration, in coordinates in which start's equations are orthonormal.

    There every step is a small well-conditioned system, however many rows there are.
    """

    def __init__(
        self, W: np.ndarray, y: np.ndarray, joint: np.ndarray, start: Estimate, columns: np.ndarray
    ) -> None:
        self.root = np.linalg.cholesky(start.covariance[np.ix_(columns, columns)])
        self.X = W @ self.root
        self.joint, self.sigma = joint, start.sigma.copy()
        self.start = start.beta[columns]
        self.residual = y - W @ self.start
        self.step = np.zeros(len(columns))
        self.weight = np.ones(len(y))
        self.iterations = 0

    def iterate_weights(
        self,
        weigh: Callable[[np.ndarray], np.ndarray],
        scaled: Sequence[int] = (),
        least: Sequence[float] | np.ndarray = (),
    ) -> bool:
        """Runs to the fixed point of beta, and of the scales of some joints, at least so large."""
        for _ in range(THRESHOLDS.max_reweightings):
            left = self.residual - self.X @ self.step
            for j in scaled:
                self.sigma[j] = max(estimate_robust_deviation(left[self.joint == j]), least[j])
            self.weight = weigh(np.abs(left / self.sigma[self.joint]))
            weighted = self.X * (self.weight / self.sigma[self.joint] ** 2)[:, None]
            step = np.linalg.lstsq(weighted.T @ self.X, weighted.T @ self.residual, rcond=None)[0]
            moved = float(np.max(np.abs(step - self.step), initial=0.0))
            self.step, self.iterations = step, self.iterations + 1
            if moved < THRESHOLDS.robust_tolerance:
                return True
        return False

    def compute_sandwich(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns covariance (k, k), influence (rows, k) and weighed residual (rows,)."""
        u = (self.residual - self.X @ self.step) / self.sigma[self.joint]
        slope = np.where(np.abs(u) < TUKEY, (1 - (u / TUKEY) ** 2) * (1 - 5 * (u / TUKEY) ** 2), 0)
        counts = np.bincount(self.joint, minlength=len(self.sigma))
        means = np.bincount(self.joint, slope, len(self.sigma)) / np.maximum(counts, 1)
        scaled = self.X / self.sigma[self.joint][:, None]
        A = scaled.T @ (scaled * np.maximum(means, 1e-3)[self.joint][:, None])
        influence = np.linalg.solve(A, scaled.T).T
        psi = self.weight * u
        middle = influence * psi[:, None]
        rows, columns = self.X.shape
        covariance = middle.T @ middle * rows / max(1, rows - columns)
        back = influence @ self.root.T / self.sigma[self.joint][:, None]
        return self.root @ covariance @ self.root.T, back, psi * self.sigma[self.joint]
