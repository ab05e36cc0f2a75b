"""Ridge: what the data leave open is drawn towards 0, or towards the robot's nominal values."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from modeler.estimation.least_squares import Estimate, Problem, expand_columns, solve_least_squares
from modeler.numerics.least_squares import Rank, compute_triangle

_RANGE = (-6.0, 9.0)
"""log10 of the width of the prior, in standard deviations of the noise of a column alone."""

_WIDTHS = 601  # tried within it
_WITHIN = 2.0  # log-probability from the best, as of the 95 % interval


@dataclass(frozen=True, eq=False)
class _Posterior:
    """Of the deviations from the prior, columns scaled to length one."""

    mean: np.ndarray
    covariance: np.ndarray
    width: float
    data_directions: float  # directions that the data decide, sum of s^2 t^2 / (1 + s^2 t^2)


def estimate_ridge(problem: Problem) -> Estimate:
    """min |S^-1/2 (y - W beta)|^2 + lambda |D (beta - beta_0)|^2.

    S = diag sigma_j^2 of the weighted fit, D the lengths of the columns of S^-1/2 W, beta_0 the
    nominal values of the robot file where every standard parameter of a base parameter has one,
    else 0. lambda = 1 / t^2 by the probability of the data where D (beta - beta_0) is Gaussian of
    standard deviation t (MacKay 1992, Neural Computation 4(3)); the covariance is that of the
    posterior, (W^T S^-1 W + lambda D^2)^-1 averaged over what the data leave open of lambda. It
    holds if the values scatter about beta_0 as that says; of the bias of one that lies elsewhere
    it says nothing.

    Columns that the data cannot tell apart share their effect; columns of zeros are set aside.

    Args:
        problem: beta in the units of its columns, y N m or N.
    """
    data = problem.data
    start = solve_least_squares(data, "weighted")
    whole = data.combine_joints(start.sigma)
    lengths = np.linalg.norm(whole[:, :-1], axis=0)
    aside = tuple(tangle for tangle in start.rank.dropped_columns if not tangle.into)
    idle = {tangle.name for tangle in aside}
    kept_columns = [i for i, name in enumerate(data.names) if name not in idle]
    prior, known = collect_prior_values(problem)
    X = whole[:, kept_columns] / lengths[kept_columns]
    left = whole[:, -1] - whole[:, kept_columns] @ prior[kept_columns]
    posterior = _compute_posterior(X, left)
    kept_covariance = posterior.covariance / np.outer(lengths[kept_columns], lengths[kept_columns])
    beta, covariance = expand_columns(
        len(prior),
        kept_columns,
        prior[kept_columns] + posterior.mean / lengths[kept_columns],
        kept_covariance,
    )
    # The prior as further rows, D / t (beta - beta_0) = 0.
    rows = np.zeros((len(kept_columns), whole.shape[1]))
    rows[np.arange(len(kept_columns)), kept_columns] = lengths[kept_columns] / posterior.width
    rows[:, -1] = rows[:, :-1] @ prior
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        rank=Rank(tuple(kept_columns), aside, start.rank.last_kept, start.rank.first_dropped),
        condition_scaled=float(np.sqrt(np.linalg.cond(posterior.covariance))),
        sentences=_describe_ridge(problem, start, posterior, known),
        whole=compute_triangle(np.vstack([whole, rows])),
    )


def collect_prior_values(problem: Problem) -> tuple[np.ndarray, tuple[str, ...]]:
    """(c,) nominal values of the columns, 0 where the robot file gives none; and who has one."""
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
    """Of X g = y + white noise of variance 1, g Gaussian of a width t that the data say.

    X = U S V^T and a = U^T y: a_k is Gaussian of variance 1 + s_k^2 t^2, which is all that t
    changes of the probability of the data. Few columns say little of t: mean and covariance are
    those of the mixture over all t whose log-probability is within 2 of the best, by weight.
    """
    U, s, Vt = np.linalg.svd(X, full_matrices=False)
    a = U.T @ y
    widths = np.logspace(*_RANGE, _WIDTHS)
    variance = 1.0 + np.outer(widths**2, s**2)
    likely = -0.5 * np.sum(np.log(variance) + a**2 / variance, axis=1)
    near = likely > likely.max() - _WITHIN
    weight = np.exp(likely[near] - likely.max())
    weight = weight / weight.sum()
    spread = widths[near, None] ** 2 / variance[near]  # of each direction at each width
    means = spread * s * a
    mean = weight @ means
    away = means - mean
    within = np.diag(weight @ spread) + (away * weight[:, None]).T @ away
    return _Posterior(
        mean=Vt.T @ mean,
        covariance=Vt.T @ within @ Vt,
        width=float(np.exp(weight @ np.log(widths[near]))),
        data_directions=float(weight @ (s**2 * spread).sum(axis=1)),
    )


def _describe_ridge(
    problem: Problem, start: Estimate, posterior: _Posterior, known: tuple[str, ...]
) -> tuple[str, ...]:
    towards = "0"
    if known:
        rest = len(problem.names) - len(known)
        towards = "the nominal values of the robot file" + (f" ({rest} have none: 0)" * bool(rest))
    said = [
        f"ridge towards {towards}: lambda = {posterior.width**-2:.3g} with columns of length one; "
        "the "
        f"data decide {posterior.data_directions:.1f} of {len(posterior.mean)} directions, the "
        "prior the others; the "
        "sigmas hold if the values scatter about it as wide as these data say, and know no bias"
    ]
    said += [
        f"{tangle.name} cannot be told from {', '.join(tangle.into)} on these data: ridge shares "
        "their effect out by the prior"
        for tangle in start.rank.dropped_columns
        if tangle.into
    ]
    return tuple(said)
