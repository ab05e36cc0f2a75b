"""Estimated parameters, and the reduced model: the essential ones, estimated without the others."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from scipy.special import fdtri

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.json import Document, ShortRepr, build_instance, select_attributes
from modeler.core.table import format_error_pair
from modeler.estimation.least_squares import Estimate, solve_by_qr, solve_least_squares
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import CompressedRegression, compute_triangle

T = TypeVar("T")


@dataclass(frozen=True)
class ParameterEstimate(Document):
    """Holds one estimated parameter.

    Attributes:
        name: base parameter, or load parameter.
        unit: SI.
        value: 0 if it was dropped.
        sigma: standard deviation; None if it was dropped.
        essential: False if the model does as well without it.
        status: "estimated" | "set aside" | "held".
        interval: 95 %, of parameters of an effect whose nonlinear parameters were fitted too.
        prior: share of what is known of it that comes from the prior of the robot file, of the
            inverse variance; None without one.
    """

    KEYS = "name value sigma relative_sigma_percent essential unit status prior interval"

    name: str
    unit: str
    value: float
    sigma: float | None
    essential: bool
    status: str
    interval: tuple[float, float] | None = None
    prior: float | None = None

    @property
    def relative_sigma_percent(self) -> float | None:
        """Returns 100 sigma / |value|; None where that means nothing."""
        if self.sigma is None or self.value == 0.0:
            return None
        return 100.0 * self.sigma / abs(self.value)


def read_back(kind: type[T], raw: Mapping[str, Any], place: str) -> T:
    """Reads what `to_json` of a dataclass says; entries that are no fields follow from others.

    Raises:
        PlainError: a field is missing or of another type; names its place.
    """
    names = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    values = {name: value for name, value in raw.items() if name in names}
    return build_instance(kind, values, place)


def read_all(kind: type[T], raw: Mapping[str, Any], name: str) -> tuple[T, ...]:
    """Reads the entries of a list of an object."""
    return tuple(read_back(kind, one, f"{name}[{i}]") for i, one in enumerate(raw[name]))


def format_parameters(
    parameters: Sequence[ParameterEstimate], reduced: Sequence[ParameterEstimate] = ()
) -> list[str]:
    """Returns a table: name, value, sigma, %sigma, unit; of a reduced model, shares of a prior."""
    alone = {parameter.name: f"{parameter.value:.6g}" for parameter in reduced}
    width = max([9, *(len(parameter.name) for parameter in parameters)])
    known = any(parameter.prior is not None for parameter in parameters)
    head = (f"{'reduced':>13}" if alone else "") + (f"{'prior':>8}" if known else "")
    lines = [f"{'parameter':<{width}} {'value':>13} {'sigma':>10} {'%sigma':>8}{head}  unit"]
    for parameter in parameters:
        if parameter.sigma is None:
            lines.append(f"{parameter.name:<{width}} {'set aside':>13}")
            continue
        share = parameter.relative_sigma_percent
        percent = "-" if share is None else f"{share:.3g}" if share < 1e4 else ">10000"
        mark = "" if parameter.essential else "  (not essential)"
        column = f"{alone.get(parameter.name, '-'):>13}" if alone else ""
        column += f"{format_prior(parameter):>8}" if known else ""
        lines.append(
            f"{parameter.name:<{width}} {parameter.value:>13.6g} {parameter.sigma:>10.3g} "
            f"{percent:>8}{column}  {parameter.unit}{mark}"
        )
    return lines


def format_prior(parameter: ParameterEstimate) -> str:
    """Returns how much of what is known of it comes from the prior."""
    if parameter.status == "held":
        return "held"
    return "-" if parameter.prior is None else f"{100.0 * parameter.prior:.0f} %"


def format_spread(value: float, sigma: float, interval: tuple[float, float] | None) -> str:
    """Returns " +- sigma" behind a value, or where that says little " (low to high)"."""
    if interval is not None and interval[0] < interval[1]:
        down, up = value - interval[0], interval[1] - value
        if max(down, up) > THRESHOLDS.max_interval_ratio * min(down, up):
            return f" ({interval[0]:.3g} to {interval[1]:.3g})"
    return f" +- {sigma:.2g}" if sigma > 0.0 else ""


@dataclass(frozen=True, eq=False)
class EssentialParameters:
    """Holds the selection of a reduced model: an F-test cannot show that the others left.

    Attributes:
        names: essential parameters, in column order.
        dropped: the others that were kept by the rank, in the order of leaving.
        beta: (c,) values with the dropped ones at 0.
        ratio: F statistic of all dropped parameters together.
        limit: the F quantile, which decides unless sigmas do.
        reduced: the estimate of the essential parameters alone, columns as `names`.
        held_out: relative errors of all parameters and of the essential ones on rows that are
            left out of their fits; None where they were not computed.
    """

    names: tuple[str, ...]
    dropped: tuple[str, ...]
    beta: np.ndarray
    ratio: float
    limit: float
    reduced: Estimate
    held_out: tuple[float, float] | None = None

    def compute_errors(self, data: CompressedRegression, full: np.ndarray) -> tuple[float, float]:
        """Returns ||y - W beta|| / ||y|| over all rows: of all parameters (c,), of these."""
        total = float(np.linalg.norm(data.compute_torque_norms())) or np.nan
        norms = (np.linalg.norm(data.compute_residual_norms(beta)) for beta in (full, self.beta))
        before, after = (float(norm) / total for norm in norms)
        return before, after

    def describe(self, data: CompressedRegression, full: np.ndarray) -> str:
        """Returns the selection, and its error on rows beside that of all parameters (c,)."""
        if not self.dropped and self.held_out is None:
            return f"all {len(self.names)} parameters are essential"
        before, after = format_error_pair(*(self.held_out or self.compute_errors(data, full)))
        count = f"{len(self.names)} of {len(self.names) + len(self.dropped)} parameters"
        model = f"reduced model: {count}" if self.dropped else "no reduced model: one by an F-test"
        kind = "fit" if self.held_out is None else "cross-validated"
        return f"{model}; {kind} error {after} (full model: {before})"


def select_essential_parameters(
    data: CompressedRegression, full: Estimate, method: Method, below: float | None = None
) -> EssentialParameters:
    """Returns the essential parameters.

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
        got = f"got sigmas below {below:g} %"
        raise DataError(f"essential parameters: {got}; expected a number above 0, as 15")
    search = _Elimination(data, full, below)
    whole = search.whole
    columns, left, ratio, limit = search.run()
    dropped = tuple(data.names[i] for i in left)
    unused = [column.name for column in full.rank.dropped_columns]
    law: Method = "ordinary" if method == "ordinary" else "weighted"
    reduced = solve_least_squares(data.drop_columns([*dropped, *unused]), law)
    if columns and (full.prior_share is not None or method not in ("weighted", "ordinary")):
        values, root = solve_by_qr(whole[:, columns], whole[:, -1])
        reduced = dataclasses.replace(reduced, beta=values, covariance=root @ root.T)
    beta = np.zeros(len(data.names))
    beta[columns] = reduced.beta
    names = tuple(data.names[i] for i in columns)
    return EssentialParameters(names, dropped, beta, float(ratio), limit, reduced)


_Sets = tuple[list[int], list[int]]
"""Columns kept, and columns dropped in the order of leaving."""


class _Elimination:
    """Searches the essential columns of a triangle."""

    def __init__(self, data: CompressedRegression, full: Estimate, below: float | None) -> None:
        self.data, self.degrees, self.below = data, full.degrees, below
        self.whole = data.combine_joints(full.sigma) if full.whole is None else full.whole
        self.triangle = compute_triangle(self.whole)
        unknown = {column.name for column in full.rank.dropped_columns}
        self.every = [i for i in full.rank.kept_columns if data.names[i] not in unknown]
        self.squares = self.sum_squares(self.every)
        rounding = (THRESHOLDS.rounding_share * np.linalg.norm(self.triangle[:, -1])) ** 2
        self.noise = max(self.squares, float(rounding), np.finfo(float).tiny) / full.degrees
        least = THRESHOLDS.rounding_share * data.compute_torque_norms()
        errors = np.maximum(data.compute_residual_norms(full.beta), least)
        self.largest_errors = THRESHOLDS.max_reduced_error * errors

    def sum_squares(self, columns: list[int]) -> float:
        reduced = compute_triangle(self.triangle[:, [*columns, self.triangle.shape[1] - 1]])
        return float(np.sum(reduced[len(columns) :, -1] ** 2))

    def has_small_errors(self, columns: list[int]) -> bool:
        """Returns True if every joint is described as well by these columns."""
        beta = np.zeros(len(self.data.names))
        beta[columns] = solve_by_qr(self.whole[:, columns], self.whole[:, -1])[0]
        return bool(np.all(self.data.compute_residual_norms(beta) <= self.largest_errors))

    def test_columns(self, columns: list[int]) -> tuple[float, float]:
        """Returns the F statistic of the other columns, and its quantile."""
        count = len(self.every) - len(columns)
        ratio = (self.sum_squares(columns) - self.squares) / max(count, 1) / self.noise
        level = 1.0 - THRESHOLDS.significance_level
        return ratio, float(fdtri(count, self.degrees, level)) if count else np.inf

    def drop_weakest(self, columns: list[int], dropped: list[int], stays: int = -1) -> _Sets:
        """Returns the sets without the weakest, one after the other; the first is not `stays`."""
        while len(columns) > 1:
            beta, root = solve_by_qr(self.triangle[:, columns], self.triangle[:, -1])
            with np.errstate(divide="ignore"):  # a value of exactly 0 is the weakest of all
                shares = np.linalg.norm(root, axis=1) / np.abs(beta)
            shares[np.array(columns) == stays] = 0.0
            weakest, share = columns[int(np.argmax(shares))], float(shares.max())
            rest = [i for i in columns if i != weakest]
            if self.below is not None:
                if 100.0 * np.sqrt(self.noise) * share < self.below:
                    break
            else:
                ratio, limit = self.test_columns(rest)
                if ratio >= limit or not self.has_small_errors(rest):
                    break
            columns, dropped, stays = rest, [*dropped, weakest], -1
        return columns, dropped

    def run(self) -> tuple[list[int], list[int], float, float]:
        """Returns columns kept, columns dropped, their F statistic and its limit."""
        current, best = None, self.drop_weakest(self.every, [])
        while current is not best:
            current = best
            columns, dropped = current
            others = {i: [j for j in dropped if j != i] for i in dropped}
            back = [self.drop_weakest(sorted([*columns, i]), o, i) for i, o in others.items()]
            tried = [current, *back]
            best = min(tried, key=lambda sets: (len(sets[0]), self.sum_squares(sets[0])))
        return *best, *self.test_columns(best[0])


@dataclass(frozen=True)
class ReducedModel(ShortRepr):
    """Holds the essential parameters, estimated without the others (Gautier and Khalil 1991).

    Attributes:
        parameters: essential ones, in column order; sigma holds if those left out are 0.
        dropped_parameters: names of those left out, in the order of leaving.
        condition_number: of W with their columns only.
        condition_scaled: with columns of length one.
        relative_error: ||y - W beta|| / ||y||, with the same filter on both sides.
        f_statistic: F statistic of all that were left out together.
        f_limit: the F quantile, which decides unless sigmas do; None if nothing was left out.
    """

    parameters: tuple[ParameterEstimate, ...]
    dropped_parameters: tuple[str, ...]
    condition_number: float
    condition_scaled: float
    relative_error: float
    f_statistic: float
    f_limit: float | None


def build_reduced_model(
    essential: EssentialParameters, factors: np.ndarray, units: Mapping[str, str], error: float
) -> ReducedModel | None:
    """Returns the reduced model of a fit; None if no parameter is left.

    Args:
        essential: which are, the error without the others, and the estimate of them alone.
        factors: (essential,) on its standard deviations, where residuals are autocorrelated.
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
        dropped_parameters=essential.dropped,
        f_statistic=essential.ratio,
        **select_attributes(reduced, "condition_number condition_scaled"),
        relative_error=error,
        f_limit=essential.limit if essential.dropped else None,
    )
