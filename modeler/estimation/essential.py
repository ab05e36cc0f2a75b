"""The reduced model: the essential parameters with values of their own, the others left out."""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import fdtri

from modeler.core.brief import Brief
from modeler.core.errors import DataError, Method
from modeler.core.json import entries
from modeler.core.table import printed
from modeler.estimation.least_squares import Estimate, least_squares, solve_by_qr
from modeler.estimation.parameter import ParameterEstimate
from modeler.numerics.least_squares import Compressed, triangle

# Essential parameters: the others may be left out and no F-test notices.


LEVEL = 0.05

MOST_RAISED = 1.05
"""Times the fit error of each joint with all parameters, that a reduced model may have."""

_EXACT = 1e-9  # of the torque; a smaller error is rounding


@dataclass(frozen=True, eq=False)
class Essential:
    """The reduced model.

    Attributes:
        names: essential parameters, in column order.
        dropped: the others that were kept by the rank, in the order of leaving.
        beta: (c,) values with the dropped ones at 0.
        ratio: F statistic of all dropped parameters together.
        limit: the F quantile, which rules unless sigmas do.
        reduced: the estimate of the essential parameters alone, columns as `names`.
        held_out: relative errors of all parameters and of the essential ones on rows that are
            left out of their fits; None where nobody asked.
    """

    names: tuple[str, ...]
    dropped: tuple[str, ...]
    beta: np.ndarray
    ratio: float
    limit: float
    reduced: Estimate
    held_out: tuple[float, float] | None = None

    def errors(self, data: Compressed, full: np.ndarray) -> tuple[float, float]:
        """||y - W beta|| / ||y|| over all rows: of all parameters (c,), of the essential ones."""
        total = float(np.linalg.norm(data.torque_norms())) or np.nan
        left = (np.linalg.norm(data.residual_norms(beta)) for beta in (full, self.beta))
        before, after = (float(own) / total for own in left)
        return before, after

    def sentence(self, data: Compressed, full: np.ndarray) -> str:
        """What was found, and what it costs on rows beside all parameters (c,)."""
        if not self.dropped and self.held_out is None:
            return f"all {len(self.names)} parameters are essential"
        before, after = printed(*(self.held_out or self.errors(data, full)))
        count = f"{len(self.names)} of {len(self.names) + len(self.dropped)} parameters"
        model = f"reduced model: {count}" if self.dropped else "no reduced model: one by an F-test"
        kind = "fit" if self.held_out is None else "cross-validated"
        return f"{model}; {kind} error {after} (full model: {before})"


NONE_LEAVES = 1e300
"""Percent of `essential_parameters` below which no parameter leaves."""


def essential_parameters(
    data: Compressed, full: Estimate, method: Method, below: float | None = None
) -> Essential:
    """The essential parameters.

    The parameter of the largest relative standard deviation leaves, one after the other, as long
    as F = ((S_r - S) / k) / (S / (rows - c)) stays below the 95 % quantile of F(k, rows - c): S
    and S_r are the weighted sums of squares of the full model and without k parameters, with the
    weights of the full model (Gautier and Khalil 1991; Janot, Vandanjon and Gautier 2014). Then
    each of those left out comes back for another, as long as fewer parameters, or as many with a
    smaller S_r, are found so; none leaves that raises the fit error of a joint by more than 5 %,
    which weights and priors may hide. An estimator that is the least squares of equations of its
    own is reduced in these.

    Args:
        data: compressed rows.
        full: the estimate with all parameters.
        method: how the reduced model is estimated at the end.
        below: percent; given, a parameter leaves where its relative standard deviation, in the
            model that it leaves, is not below this, whatever F says (Guegan, Khalil and Lemoine
            2003: 15).

    Raises:
        DataError: `below` is no positive number.
    """
    if below is not None and not 0.0 < below < np.inf:
        raise DataError(
            f"essential parameters: got sigmas below {below:g} %; expected a number above 0, as 15"
        )
    whole = data.whole(full.sigma) if full.whole is None else full.whole
    most = MOST_RAISED * np.maximum(data.residual_norms(full.beta), _EXACT * data.torque_norms())

    def as_good(kept: list[int]) -> bool:
        """True if every joint is described as well by these columns."""
        beta = np.zeros(len(data.names))
        beta[kept] = solve_by_qr(whole[:, kept], whole[:, -1])[0]
        return bool(np.all(data.residual_norms(beta) <= most))

    kept, dropped, ratio, limit = _eliminate(triangle(whole), full, below, as_good)
    left = tuple(data.names[i] for i in dropped)
    aside = [tangle.name for tangle in full.rank.aside]
    own = data.without([*left, *aside])
    reduced = least_squares(own, "ordinary" if method == "ordinary" else "weighted")
    if kept and (full.share is not None or method not in ("weighted", "ordinary")):
        values, root = solve_by_qr(whole[:, kept], whole[:, -1])
        reduced = dataclasses.replace(reduced, beta=values, covariance=root @ root.T)
    beta = np.zeros(len(data.names))
    beta[kept] = reduced.beta
    names = tuple(data.names[i] for i in kept)
    return Essential(names, left, beta, float(ratio), limit, reduced)


def _eliminate(
    whole: np.ndarray, full: Estimate, below: float | None, as_good: Callable[[list[int]], bool]
) -> tuple[list[int], list[int], float, float]:
    """Columns kept, columns dropped in the order of leaving, their F statistic and its limit."""
    every = list(full.rank.kept)
    reference = _squares(whole, every)
    noise = max(reference / full.degrees, np.finfo(float).tiny)

    def tested(kept: list[int]) -> tuple[float, float]:
        count = len(every) - len(kept)
        ratio = (_squares(whole, kept) - reference) / max(count, 1) / noise
        return ratio, float(fdtri(count, full.degrees, 1.0 - LEVEL)) if count else np.inf

    def fewer(kept: list[int], dropped: list[int], stays: int = -1) -> tuple[list[int], list[int]]:
        """Without the weakest, one after the other; the first of them is not `stays`."""
        while len(kept) > 1:
            beta, root = solve_by_qr(whole[:, kept], whole[:, -1])
            with np.errstate(divide="ignore"):  # a value of exactly 0 is the weakest of all
                shares = np.linalg.norm(root, axis=1) / np.abs(beta)
            shares[np.array(kept) == stays] = 0.0
            weakest, share = kept[int(np.argmax(shares))], float(shares.max())
            rest = [i for i in kept if i != weakest]
            ratio, limit = tested(rest)
            vague = below is not None and 100.0 * np.sqrt(noise) * share >= below
            if not (vague or (below is None and ratio < limit and as_good(rest))):
                break
            kept, dropped, stays = rest, [*dropped, weakest], -1
        return kept, dropped

    found, best = None, fewer(every, [])
    while found is not best:
        found = best
        kept, dropped = found
        back = [
            fewer(sorted([*kept, i]), [other for other in dropped if other != i], i)
            for i in dropped
        ]
        best = min([found, *back], key=lambda sets: (len(sets[0]), _squares(whole, sets[0])))
    return *found, *tested(found[0])


def _squares(whole: np.ndarray, kept: list[int]) -> float:
    reduced = triangle(whole[:, [*kept, whole.shape[1] - 1]])
    return float(np.sum(reduced[len(kept) :, -1] ** 2))


@dataclass(frozen=True)
class Reduced(Brief):
    """The essential parameters, estimated anew without the others (Gautier and Khalil 1991).

    Attributes:
        parameters: essential ones, in column order; sigma holds if those left out are 0.
        dropped: names of those left out, in the order of leaving.
        condition_number: of W with their columns only.
        condition_scaled: with columns of length one.
        relative_error: ||y - W beta|| / ||y||, with the same filter on both sides.
        ratio: F statistic of all that were left out together.
        limit: the F quantile, which rules unless sigmas do; None if nothing was left out.
    """

    parameters: tuple[ParameterEstimate, ...]
    dropped: tuple[str, ...]
    condition_number: float
    condition_scaled: float
    relative_error: float
    ratio: float
    limit: float | None

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return vars(self) | {"parameters": [parameter.to_json() for parameter in self.parameters]}


def reduced_model(
    essential: Essential, factors: np.ndarray, units: Mapping[str, str], error: float
) -> Reduced | None:
    """The reduced model of a fit; None if no parameter is left.

    Args:
        essential: which are, what leaving out the others costs, and the estimate of them alone.
        factors: (essential,) on its standard deviations, where residuals repeat each other.
        units: by name.
        error: relative, of them alone.
    """
    reduced = essential.reduced
    if not np.isfinite(reduced.condition_number):
        return None
    sigma = factors * np.sqrt(np.diag(reduced.covariance))
    values = zip(essential.names, reduced.beta.tolist(), sigma.tolist(), strict=True)
    return Reduced(
        tuple(ParameterEstimate(n, units[n], x, s, True, "estimated") for n, x, s in values),
        **entries(essential, "dropped ratio"),
        **entries(reduced, "condition_number condition_scaled"),
        relative_error=error,
        limit=essential.limit if essential.dropped else None,
    )
