"""The reduced model: the essential parameters with values of their own, the others left out."""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import fdtri

from modeler.core.brief import ShortRepr
from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.json import select_attributes
from modeler.core.table import format_error_pair
from modeler.estimation.least_squares import Estimate, solve_by_qr, solve_least_squares
from modeler.estimation.parameter import ParameterEstimate
from modeler.numerics.least_squares import CompressedRegression, compute_triangle

# Essential parameters: the others may be left out and no F-test notices.


LEVEL = 0.05

MOST_RAISED = 1.05
"""Times the fit error of each joint with all parameters, that a reduced model may have."""

_EXACT = 1e-9  # of the torque; a smaller error is rounding


@dataclass(frozen=True, eq=False)
class EssentialParameters:
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

    def compute_errors(self, data: CompressedRegression, full: np.ndarray) -> tuple[float, float]:
        """||y - W beta|| / ||y|| over all rows: of all parameters (c,), of the essential ones."""
        total = float(np.linalg.norm(data.compute_torque_norms())) or np.nan
        left = (np.linalg.norm(data.compute_residual_norms(beta)) for beta in (full, self.beta))
        before, after = (float(norm) / total for norm in left)
        return before, after

    def describe(self, data: CompressedRegression, full: np.ndarray) -> str:
        """What was found, and what it costs on rows beside all parameters (c,)."""
        if not self.dropped and self.held_out is None:
            return f"all {len(self.names)} parameters are essential"
        before, after = format_error_pair(*(self.held_out or self.compute_errors(data, full)))
        count = f"{len(self.names)} of {len(self.names) + len(self.dropped)} parameters"
        model = f"reduced model: {count}" if self.dropped else "no reduced model: one by an F-test"
        kind = "fit" if self.held_out is None else "cross-validated"
        return f"{model}; {kind} error {after} (full model: {before})"


NONE_LEAVES = 1e300
"""Percent of `essential_parameters` below which no parameter leaves."""


def select_essential_parameters(
    data: CompressedRegression, full: Estimate, method: Method, below: float | None = None
) -> EssentialParameters:
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
    whole = data.combine_joints(full.sigma) if full.whole is None else full.whole
    most = MOST_RAISED * np.maximum(
        data.compute_residual_norms(full.beta), _EXACT * data.compute_torque_norms()
    )

    def as_good(kept_columns: list[int]) -> bool:
        """True if every joint is described as well by these columns."""
        beta = np.zeros(len(data.names))
        beta[kept_columns] = solve_by_qr(whole[:, kept_columns], whole[:, -1])[0]
        return bool(np.all(data.compute_residual_norms(beta) <= most))

    kept_columns, dropped, ratio, limit = _eliminate(compute_triangle(whole), full, below, as_good)
    left = tuple(data.names[i] for i in dropped)
    aside = [tangle.name for tangle in full.rank.dropped_columns]
    reduced_data = data.drop_columns([*left, *aside])
    reduced = solve_least_squares(reduced_data, "ordinary" if method == "ordinary" else "weighted")
    if kept_columns and (full.prior_share is not None or method not in ("weighted", "ordinary")):
        values, root = solve_by_qr(whole[:, kept_columns], whole[:, -1])
        reduced = dataclasses.replace(reduced, beta=values, covariance=root @ root.T)
    beta = np.zeros(len(data.names))
    beta[kept_columns] = reduced.beta
    names = tuple(data.names[i] for i in kept_columns)
    return EssentialParameters(names, left, beta, float(ratio), limit, reduced)


def _eliminate(
    whole: np.ndarray, full: Estimate, below: float | None, as_good: Callable[[list[int]], bool]
) -> tuple[list[int], list[int], float, float]:
    """Columns kept, columns dropped in the order of leaving, their F statistic and its limit."""
    every = list(full.rank.kept_columns)
    reference = _sum_squares(whole, every)
    noise = max(reference / full.degrees, np.finfo(float).tiny)

    def tested(kept_columns: list[int]) -> tuple[float, float]:
        count = len(every) - len(kept_columns)
        ratio = (_sum_squares(whole, kept_columns) - reference) / max(count, 1) / noise
        return ratio, float(fdtri(count, full.degrees, 1.0 - LEVEL)) if count else np.inf

    def fewer(
        kept_columns: list[int], dropped: list[int], stays: int = -1
    ) -> tuple[list[int], list[int]]:
        """Without the weakest, one after the other; the first of them is not `stays`."""
        while len(kept_columns) > 1:
            beta, root = solve_by_qr(whole[:, kept_columns], whole[:, -1])
            with np.errstate(divide="ignore"):  # a value of exactly 0 is the weakest of all
                shares = np.linalg.norm(root, axis=1) / np.abs(beta)
            shares[np.array(kept_columns) == stays] = 0.0
            weakest, share = kept_columns[int(np.argmax(shares))], float(shares.max())
            rest = [i for i in kept_columns if i != weakest]
            ratio, limit = tested(rest)
            vague = below is not None and 100.0 * np.sqrt(noise) * share >= below
            if not (vague or (below is None and ratio < limit and as_good(rest))):
                break
            kept_columns, dropped, stays = rest, [*dropped, weakest], -1
        return kept_columns, dropped

    current, best = None, fewer(every, [])
    while current is not best:
        current = best
        kept_columns, dropped = current
        back = [
            fewer(sorted([*kept_columns, i]), [other for other in dropped if other != i], i)
            for i in dropped
        ]
        best = min([current, *back], key=lambda sets: (len(sets[0]), _sum_squares(whole, sets[0])))
    return *current, *tested(current[0])


def _sum_squares(whole: np.ndarray, kept_columns: list[int]) -> float:
    reduced = compute_triangle(whole[:, [*kept_columns, whole.shape[1] - 1]])
    return float(np.sum(reduced[len(kept_columns) :, -1] ** 2))


@dataclass(frozen=True)
class ReducedModel(ShortRepr):
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


def build_reduced_model(
    essential: EssentialParameters, factors: np.ndarray, units: Mapping[str, str], error: float
) -> ReducedModel | None:
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
    return ReducedModel(
        tuple(ParameterEstimate(n, units[n], x, s, True, "estimated") for n, x, s in values),
        **select_attributes(essential, "dropped ratio"),
        **select_attributes(reduced, "condition_number condition_scaled"),
        relative_error=error,
        limit=essential.limit if essential.dropped else None,
    )
