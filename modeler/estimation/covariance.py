"""What raises standard deviations: autocorrelated residuals, halves of the motion that differ."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.estimation.least_squares import Estimate, Rows, solve_by_qr, sum_streamed_products
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.filters import SPREAD
from modeler.numerics.least_squares import CompressedRegression, compute_triangle
from modeler.regression import THRESHOLDS as REGRESSION, DataWarning, Observation


@dataclass(frozen=True, eq=False)
class ResidualAutocorrelation:
    """Holds what the autocorrelation of the residuals does.

    Attributes:
        factors: (c,) on the standard deviations, 1 and more.
        correlation_times: (joint, s) of the joints whose residuals are not white.
        lag1: (n,) autocorrelation of their residuals over one row.
        added_covariance: (c, c) what it adds to the covariance of white residuals.
    """

    factors: np.ndarray
    correlation_times: tuple[tuple[str, float], ...]
    lag1: np.ndarray
    added_covariance: np.ndarray

    def inflate_covariance(self, white: np.ndarray) -> np.ndarray:
        """Returns (c, c) the covariance with it: in no direction less than that of white ones."""
        at = np.ix_(*[np.flatnonzero(np.diag(white))] * 2)
        root, inverse = compute_roots(white[at])
        ratio, turn = np.linalg.eigh(inverse @ self.added_covariance[at] @ inverse.T)
        turned = root @ turn * np.sqrt(1.0 + np.maximum(ratio, 0.0))
        inflated = np.zeros(white.shape)
        inflated[at] = turned @ turned.T
        return inflated

    def format_sentences(self) -> list[str]:
        """Returns one sentence, if it matters."""
        factor = self.factors.max(initial=1.0)
        if not self.correlation_times or factor < THRESHOLDS.reported_sigma_factor:
            return []
        joint, seconds = max(self.correlation_times, key=lambda entry: entry[1])
        return [
            f"Residuals are autocorrelated (joint {joint}: {seconds:.2g} s); standard deviations "
            f"are corrected for it (up to x {factor:.2g})."
        ]


def compute_roots(V: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns (k, k) R, R R^T = V, and R^-1, of V (k, k) without zeros on its diagonal.

    Nothing is known better than rounding lets V say.
    """
    size = np.sqrt(np.diag(V))
    values, vectors = np.linalg.eigh(V / np.outer(size, size))
    half = np.sqrt(np.maximum(values, 1e-15 * values.max(initial=1.0)))
    return size[:, None] * vectors * half, (vectors / half).T / size


def estimate_hac_covariance(
    rows: Rows, estimate: Estimate, at: Sequence[int] | None = None, share: float = 1.0
) -> ResidualAutocorrelation:
    """Estimates by how much autocorrelated residuals raise the standard deviations.

    The covariance C = (W^T S^-1 W)^-1 takes rows for independent. With residuals of joint j of
    autocorrelation r_j(k), stationary, it is

        C B C,  B = sum_j sum_k r_j(|k|) sum_t w_j(t) w_j(t+k)^T / sigma_j^2,

    w_j(t) the row of joint j at sample t (Newey and West 1987, weights replaced by truncation: the
    sum over k ends with the first r_j below one standard deviation of that of white noise). r_j is
    at least that of white noise through the parallel filter. An estimator with a bread or an
    influence has bread w_t rms_j or influence_t rms_j in place of C w_t / sigma_j. Each sigma is
    multiplied by the square root of the ratio of the diagonals, never by less than 1.

    Args:
        rows: of which the counted ones were fitted.
        estimate: of those rows; its covariance is for white residuals.
        at: (c,) columns of the rows that were fitted, in order; None: all.
        share: of the fitted rows that these are.
    """
    observation, W, bread = rows.observation, rows, estimate.bread
    columns = len(observation.names) if rows.has_streamed_rows else rows.W.shape[1]
    picked = np.eye(columns) if at is None else np.eye(columns)[:, at]
    residual = estimate.residual
    if residual is None:
        residual = rows.compute_residual(picked @ estimate.beta)
    matrix = picked @ (estimate.covariance if bread is None else bread)
    if estimate.influence is not None:
        W, matrix = Rows(observation, estimate.influence, rows.y, rows.counted), picked
    is_white = estimate.influence is None and bread is None
    joints, correlation_times = len(observation.joints), []
    lag1, matrices = np.zeros(joints), np.zeros((joints, *picked.shape))
    correlations = [np.ones(1) for _ in observation.joints]
    for j, joint in enumerate(observation.joints):
        if not (part := rows.counted & (rows.row_joint == j)).any():
            continue
        sample = observation.row_sample[part]
        correlations[j] = r = estimate_correlation(observation, residual[part], sample)
        lag1[j] = r[1] if len(r) > 1 else 0.0
        if lags := int(np.sum(r > THRESHOLDS.reported_correlation)) - 1:
            correlation_times.append((joint.name, lags * _compute_spacing(observation)))
        rms = float(np.sqrt(np.mean(residual[part] ** 2)))
        matrices[j] = matrix * (1.0 / estimate.sigma[j] if is_white else rms)
    extra = _sum_row_products(W, matrices, correlations) / share  # C (B - C^-1) C
    white = np.diag(estimate.covariance)
    ratio = 1.0 + np.diag(extra) / np.where(white > 0.0, white, 1.0)
    factors = np.sqrt(np.maximum(ratio, 1.0))
    return ResidualAutocorrelation(factors, tuple(correlation_times), lag1, extra)


def _sum_row_products(
    rows: Rows, matrices: np.ndarray, correlations: Sequence[np.ndarray]
) -> np.ndarray:
    """Returns (k, k) `sum_lagged_products` of counted rows times their joint's matrix (c, k)."""
    observation = rows.observation
    if rows.has_streamed_rows:
        return sum_streamed_products(observation, rows.counted, matrices, correlations)
    total = np.zeros((matrices.shape[2],) * 2)
    for j, r in enumerate(correlations):
        part = rows.counted & (rows.row_joint == j)
        sample, weighted = observation.row_sample[part], rows.W[part] @ matrices[j]
        total += sum_lagged_products(weighted, r, sample, observation.segment)
    return total


def estimate_correlation(observation: Observation, e: np.ndarray, sample: np.ndarray) -> np.ndarray:
    """Returns r(0) = 1, r(1), ... of the residual of one joint, at least the parallel filter's.

    Args:
        observation: of the rows.
        e: (rows,) residual of one joint.
        sample: (rows,) its samples, ascending.
    """
    correlation = estimate_autocorrelation(e, sample, observation.segment)
    cutoff = observation.report.processing.parallel_cutoff
    if not cutoff:
        return correlation
    # White noise through the filter: means with Gaussian weights of standard deviation s, d apart,
    # correlate by exp(-d^2 / 4 s^2), down to 0.01.
    lags = np.arange(THRESHOLDS.max_lags) * _compute_spacing(observation) * cutoff / SPREAD
    floor = np.exp(-(lags**2) / 4.0)
    floor = floor[: max(1, int(np.argmax(floor < THRESHOLDS.faded_correlation)))]
    longer = np.zeros(max(len(correlation), len(floor)))
    longer[: len(correlation)] = correlation
    longer[: len(floor)] = np.maximum(longer[: len(floor)], floor)
    return longer


def sum_lagged_products(
    rows: np.ndarray, r: np.ndarray, sample: np.ndarray, segment: np.ndarray
) -> np.ndarray:
    """Returns (c, c) sum_k r(k) sum_t (rows(t) rows(t + k)^T + its transpose).

    With rows^T rows it is the middle of the covariance of least squares over these rows.
    """
    total = np.zeros((rows.shape[1], rows.shape[1]))
    for lag in range(1, len(r)):
        left, right = _pair_rows(sample, segment, lag)
        total += r[lag] * (rows[left].T @ rows[right])
    return total + total.T


def estimate_autocorrelation(e: np.ndarray, sample: np.ndarray, segment: np.ndarray) -> np.ndarray:
    """Returns r(0) = 1, r(1), ... up to the first that is not significant, within segments.

    Args:
        e: (rows,) residual of one joint.
        sample: (rows,) its samples, ascending.
        segment: (samples,) number of the segment of each sample.
    """
    r = [1.0]
    power = float(np.mean(e**2))
    while len(r) <= THRESHOLDS.max_lags and power > 0.0:
        left, right = _pair_rows(sample, segment, len(r))
        if not left.size:
            break
        r.append(float(np.mean(e[left] * e[right])) / power)
        if r[-1] < THRESHOLDS.white_lag_sigmas / np.sqrt(left.size):
            break
    return np.array(r)


def _pair_rows(sample: np.ndarray, segment: np.ndarray, lag: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns rows that are `lag` samples apart within a segment."""
    if not len(sample):
        return sample, sample
    place = np.full(sample[-1] - sample[0] + 1 + lag, -1)
    place[sample - sample[0]] = np.arange(len(sample))
    right = place[sample - sample[0] + lag]
    together = (right >= 0) & (segment[sample[right]] == segment[sample])
    return np.flatnonzero(together), right[together]


def _compute_spacing(observation: Observation) -> float:
    steps = np.diff(observation.time)[np.diff(observation.segment) == 0]
    return float(np.median(steps)) if steps.size else 0.0


# Do halves of the motion have the same values? Where not, an effect is missing in some of them.


@dataclass(frozen=True)
class HalvesComparison:
    """Holds what differs between the halves of signals.

    Attributes:
        factors: (c,) on the standard deviations, 1 and more.
        worst: index of the column that differs by most standard deviations, the joint and the
            signal whose halves show it, and by how many; None where nothing does.
    """

    factors: np.ndarray
    worst: tuple[int, int, str, float] | None = None

    def collect_warnings(self, names: Sequence[str], joints: Sequence[str]) -> list[DataWarning]:
        """Returns a warning, if something differs."""
        if self.worst is None:
            return []
        column, joint, signal, apart = self.worst
        sure = apart > THRESHOLDS.split_sigmas
        why = "a model term is missing" if sure else "coloured noise, or a missing model term"
        line = (
            f"joint {joints[joint]}: {names[column]} differs significantly between samples of low "
            f"and of high {signal}: {why}; standard deviations are raised by up to a factor "
            f"{self.factors.max():.2g} ({names[int(self.factors.argmax())]}); run `modeler "
            "diagnose`"
        )
        return [DataWarning(line, False, True, joints=(joints[joint],), code="different_halves")]


def compare_halves(
    observation: Observation,
    compressed: Callable[[np.ndarray], CompressedRegression],
    counted: np.ndarray,
    estimate: Estimate,
    sigma: np.ndarray,
    lag1: np.ndarray,
    loaded: np.ndarray | None = None,
    prior: np.ndarray | None = None,
) -> HalvesComparison:
    """Estimates by how much values that differ between halves of the motion raise the sigmas.

    With all effects in the model, beta without some rows differs from beta by noise, of covariance
    C_k - C (Hausman 1978, Econometrica 46). Left out are, joint by joint, its rows below or above
    the mean of its |qd|, of q, of |tau|, and those with or without a load. Where a difference d_k
    is more than chance, the mean of d_k^2, weighed by how well either half determines the
    parameter, less what noise makes of it, is added to the variance: the error that an effect makes
    which is missing in slow motion only is then in sigma.

    Args:
        observation: says which row is which.
        compressed: of some rows (rows,), the equations.
        counted: (rows,) that were fitted.
        estimate: its joint weights and kept columns are taken.
        sigma: (c,) standard deviations so far, autocorrelation included.
        lag1: (n,) autocorrelation of the residual of each joint over one row.
        loaded: (rows,) True where a load is carried; None: nowhere.
        prior: (r, c + 1) rows that stay, whatever is left out.
    """
    columns, row = np.array(estimate.rank.kept_columns, dtype=int), observation.row_sample
    weighted = _weight_triangles(compressed, estimate)
    known = [] if prior is None else [prior[:, [*columns, -1]]]
    every = {"speed": np.abs(observation.qd), "position": observation.q}
    every["torque"] = np.abs(observation.torque)
    signals = {name: values[row, observation.row_joint] for name, values in every.items()}
    signals |= {} if loaded is None else {"load": loaded.astype(float)}
    added, farthest, worst = np.zeros(len(sigma)), 0.0, None
    for name, values in signals.items():
        count = np.bincount(observation.row_joint[counted], None, len(estimate.sigma))
        total = np.bincount(observation.row_joint[counted], values[counted], len(count))
        low = values < (total / np.maximum(count, 1))[observation.row_joint]
        R = [weighted(counted & half) for half in (low, ~low)]
        beta, var = _solve_blocks([*known, *R[0], *R[1]])
        if beta is None:
            break
        raised = np.maximum((sigma[columns] ** 2) / var, 1.0)
        for j in range(len(observation.joints)):
            solutions = [_solve_blocks([*known, *np.delete(R[k], j, 0), *R[1 - k]]) for k in (0, 1)]
            if any(b is None for b, _ in solutions) or not all(half[j].any() for half in R):
                continue
            d = np.array([b - beta for b, _ in solutions])
            variances = np.array([v for _, v in solutions])
            noise = raised * np.maximum(variances - var, 1e-6 * var)
            z = (np.abs(d) / np.sqrt(noise)).max(axis=0)
            more = np.sum((d**2 - noise) / variances, axis=0) / np.sum(1.0 / variances, axis=0)
            is_correlated = lag1[j] > THRESHOLDS.correlated_share
            limits = THRESHOLDS.split_sigmas, THRESHOLDS.coloured_split_sigmas
            if z.max() < limits[int(is_correlated)]:
                continue
            more = np.where(z > THRESHOLDS.raised_split_sigmas, more, 0.0)
            added[columns] = np.maximum(added[columns], more)
            if z.max() > farthest:
                farthest, in_rows = float(z.max()), (R[0][j] != 0.0).any(axis=0)[:-1]
                worst = int(columns[np.where(in_rows, z, 0.0).argmax()]), j, name, farthest
    bias = estimate_reversal_bias(observation, compressed, counted, estimate, sigma, known)
    added = np.maximum(added, bias)
    square = np.where(sigma > 0.0, sigma, 1.0) ** 2
    return HalvesComparison(np.sqrt(1.0 + added / square), worst)


def estimate_reversal_bias(
    observation: Observation,
    compressed: Callable[[np.ndarray], CompressedRegression],
    counted: np.ndarray,
    estimate: Estimate,
    sigma: np.ndarray,
    known: Sequence[np.ndarray] = (),
) -> np.ndarray:
    """Returns (c,) variances from rows near reversals: noise of the speed biases friction there.

    Without those rows beta is d off. Of noise alone d has the variance u = V_w - V (Hausman 1978);
    what d^2 is more than 4 (u + 0.1 V) is a bias that no residual shows.

    Args:
        observation: that knows which rows are far from reversals.
        compressed: of some rows (rows,), the equations.
        counted: (rows,) that were fitted.
        estimate: its joint weights and kept columns are taken.
        sigma: (c,) standard deviations so far.
        known: rows of a prior, of the kept columns.
    """
    added = np.zeros(len(sigma))
    if observation.steady is None:
        return added
    columns = np.array(estimate.rank.kept_columns, dtype=int)
    weighted = _weight_triangles(compressed, estimate)
    steady = counted & observation.steady[observation.used]
    (whole, var), (far, far_var) = (
        _solve_blocks([*known, *weighted(x)]) for x in (counted, steady)
    )
    if whole is None or far is None:
        return added
    raised = np.maximum(sigma[columns] ** 2 / var, 1.0)
    noise = raised * (np.abs(far_var - var) + THRESHOLDS.reversal_variance_share * var)
    d = (far - whole) ** 2
    added[columns] = np.maximum(d - THRESHOLDS.reversal_sigmas**2 * noise, 0.0)
    return added


def _weight_triangles(
    compressed: Callable[[np.ndarray], CompressedRegression], estimate: Estimate
) -> Callable[[np.ndarray], np.ndarray]:
    """Returns (n, ., k + 1) triangles of some rows, over an estimate's sigmas; its kept columns."""
    scale, columns = estimate.sigma[:, None, None], [*estimate.rank.kept_columns, -1]
    return lambda rows: (compressed(rows).triangles / scale)[:, :, columns]


def _solve_blocks(blocks: list[np.ndarray]) -> tuple[np.ndarray | None, np.ndarray]:
    """Returns beta (k,) of weighted triangles [W y], None if singular, and its white variances."""
    whole = compute_triangle(np.vstack(blocks))
    W = whole[:, :-1]
    lengths = np.linalg.norm(W, axis=0)
    if len(W) < W.shape[1] or not lengths.all() or np.linalg.cond(W / lengths) > 1e7:
        return None, lengths
    beta, root = solve_by_qr(W, whole[:, -1])
    return beta, np.sum(root**2, axis=1)


def compare_bands(observation: Observation, estimate: Estimate) -> list[str]:
    """Returns a sentence where wider filters give other values: noise of the motion biases them."""
    values = np.array(observation.report.bands.widest_values)
    if not values.size:
        return []
    sigma = np.sqrt(np.diag(estimate.covariance))[: len(values)]
    d = np.abs(values - estimate.beta[: len(values)])
    apart = np.divide(d, sigma, out=np.zeros(len(d)), where=sigma > 0.0)
    worst = int(apart.argmax())
    # of long logs, only a part was looked at
    rows = sum(log.rows for log in observation.report.logs)
    share = min(1.0, REGRESSION.search_samples / rows)
    if apart[worst] < THRESHOLDS.band_sigmas / share**0.5:
        return []
    return [
        f"the widest cut-offs and the chosen ones differ by {apart[worst]:.2g} sigma "
        f"({observation.names[worst]}): noise of the motion biases the values of the wider ones"
    ]
