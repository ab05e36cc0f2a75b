"""Essential parameters: the others may be left out and no F-test notices."""

import dataclasses
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtri

from modeler.core.choices import Method
from modeler.estimate.compressed import Compressed, triangle
from modeler.estimate.least_squares import Estimate, least_squares, solve_by_qr

LEVEL = 0.05


@dataclass(frozen=True, eq=False)
class Essential:
    """The reduced model.

    Attributes:
        names: essential parameters, in column order.
        dropped: the others that were kept by the rank, in the order of leaving.
        beta: (c,) values with the dropped ones at 0.
        error_before: relative error ||y - W beta|| / ||y|| with all parameters.
        error_after: with the essential ones.
        ratio: F statistic of all dropped parameters together.
        limit: the F quantile that it stays under.
        reduced: the estimate of the essential parameters alone, columns as `names`.
    """

    names: tuple[str, ...]
    dropped: tuple[str, ...]
    beta: np.ndarray
    error_before: float
    error_after: float
    ratio: float
    limit: float
    reduced: Estimate

    def sentence(self) -> str:
        """What was found."""
        if not self.dropped:
            return f"all {len(self.names)} parameters are essential"
        return (
            f"{len(self.names)} of {len(self.names) + len(self.dropped)} parameters are "
            f"essential; leaving the others out changes the relative error from "
            f"{100.0 * self.error_before:.4g} % to {100.0 * self.error_after:.4g} %"
        )


def essential_parameters(data: Compressed, full: Estimate, method: Method) -> Essential:
    """The essential parameters.

    The parameter of the largest relative standard deviation leaves, one after the other, as long
    as F = ((S_r - S) / k) / (S / (rows - c)) stays below the 95 % quantile of F(k, rows - c): S
    and S_r are the weighted sums of squares of the full model and without k parameters, with the
    weights of the full model (Gautier and Khalil 1991; Janot, Vandanjon and Gautier 2014). An
    estimator that is the least squares of equations of its own is reduced in these.

    Args:
        data: compressed rows.
        full: the estimate with all parameters.
        method: how the reduced model is estimated at the end.
    """
    whole = data.whole(full.sigma) if full.whole is None else full.whole
    kept, dropped, ratio, limit = _eliminate(whole, full)
    left = tuple(data.names[i] for i in dropped)
    aside = [tangle.name for tangle in full.rank.aside]
    own = data.without([*left, *aside])
    reduced = least_squares(own, "ordinary" if method == "ordinary" else "weighted")
    if kept and method not in ("weighted", "ordinary"):
        values, root = solve_by_qr(whole[:, kept], whole[:, -1])
        reduced = dataclasses.replace(reduced, beta=values, covariance=root @ root.T)
    beta = np.zeros(len(data.names))
    beta[kept] = reduced.beta
    return Essential(
        names=tuple(data.names[i] for i in kept),
        dropped=left,
        beta=beta,
        error_before=relative_error(data, full.beta),
        error_after=relative_error(data, beta),
        ratio=float(ratio),
        limit=limit,
        reduced=reduced,
    )


def relative_error(data: Compressed, beta: np.ndarray) -> float:
    """||y - W beta|| / ||y|| over all rows, unweighted."""
    total = np.linalg.norm(data.torque_norms())
    return float(np.linalg.norm(data.residual_norms(beta)) / total) if total > 0.0 else np.nan


def _eliminate(whole: np.ndarray, full: Estimate) -> tuple[list[int], list[int], float, float]:
    """Columns kept, columns dropped in the order of leaving, their F statistic and its limit."""
    kept = list(full.rank.kept)
    dropped: list[int] = []
    reference = _squares(whole, kept)
    noise = max(reference / full.degrees, np.finfo(float).tiny)
    ratio, limit = 0.0, float("inf")
    while len(kept) > 1:
        weakest = _weakest(whole, kept)
        rest = [i for i in kept if i != weakest]
        count = len(dropped) + 1
        trial = (_squares(whole, rest) - reference) / count / noise
        quantile = float(fdtri(count, full.degrees, 1.0 - LEVEL))
        if not trial < quantile:
            break
        kept, ratio, limit = rest, trial, quantile
        dropped.append(weakest)
    return kept, dropped, ratio, limit


def _squares(whole: np.ndarray, kept: list[int]) -> float:
    reduced = triangle(whole[:, [*kept, whole.shape[1] - 1]])
    return float(np.sum(reduced[len(kept) :, -1] ** 2))


def _weakest(whole: np.ndarray, kept: list[int]) -> int:
    """Column with the largest sigma / |beta|; a value of exactly 0 is the weakest of all."""
    beta, root = solve_by_qr(whole[:, kept], whole[:, -1])
    sigma = np.linalg.norm(root, axis=1)
    with np.errstate(divide="ignore"):
        return kept[int(np.argmax(sigma / np.abs(beta)))]
