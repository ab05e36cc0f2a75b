"""The reduced model: the essential parameters with values of their own, the others left out."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import DataError
from modeler.fit.essential import Essential
from modeler.fit.parameter import ParameterEstimate, read_parameter

if TYPE_CHECKING:
    from modeler.fit.model_file import IdentifiedModel
    from modeler.fit.result import FitResult


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

    def lines(self) -> list[str]:
        """Lines of text; none if nothing was left out. Its values stand beside those of all."""
        if not self.dropped:
            return []
        count = len(self.parameters)
        return [
            f"reduced model: {count} essential of {count + len(self.dropped)} parameters, "
            f"estimated anew; condition number {self.condition_number:.4g} "
            f"({self.condition_scaled:.4g} with columns of length one), relative error "
            f"{100.0 * self.relative_error:.3f} %"
        ]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        parameters = [parameter.to_json() for parameter in self.parameters]
        return vars(self) | {"parameters": parameters, "dropped": list(self.dropped)}


def reduced_from_json(raw: Mapping[str, Any] | None) -> Reduced | None:
    """Read `Reduced.to_json` back; None where a file of an earlier version has none."""
    if raw is None:
        return None
    return Reduced(
        parameters=tuple(read_parameter(entry) for entry in raw["parameters"]),
        dropped=tuple(raw["dropped"]),
        condition_number=float(raw["condition_number"]),
        condition_scaled=float(raw["condition_scaled"]),
        relative_error=float(raw["relative_error"]),
        ratio=float(raw["ratio"]),
        limit=None if raw["limit"] is None else float(raw["limit"]),
    )


def reduced_model(
    essential: Essential, factors: np.ndarray, units: Mapping[str, str]
) -> Reduced | None:
    """The reduced model of a fit; None if no parameter is left.

    Args:
        essential: which are, what leaving out the others costs, and the estimate of them alone.
        factors: (essential,) on its standard deviations, where residuals repeat each other.
        units: by name.
    """
    reduced = essential.reduced
    if not np.isfinite(reduced.condition_number):
        return None
    sigma = factors * np.sqrt(np.diag(reduced.covariance))
    return Reduced(
        parameters=tuple(
            ParameterEstimate(name, units[name], float(value), float(deviation), True, "estimated")
            for name, value, deviation in zip(essential.names, reduced.beta, sigma, strict=True)
        ),
        dropped=essential.dropped,
        condition_number=reduced.condition_number,
        condition_scaled=reduced.condition_scaled,
        relative_error=essential.error_after,
        ratio=essential.ratio,
        limit=essential.limit if essential.dropped else None,
    )


def with_essential_only(model: "IdentifiedModel", where: str) -> "IdentifiedModel":
    """The model with the values of its reduced model, all others 0.

    Args:
        model: as it was loaded.
        where: its file, for the error.

    Raises:
        DataError: the model was saved without one.
    """
    reduced = model.fit.essential
    if reduced is None:
        raise DataError(
            f"{where}: holds no reduced model (--essential), it was fitted by an earlier version; "
            "fit it again"
        )
    return dataclasses.replace(model, fit=_replaced(model.fit, reduced))


def _replaced(fit: "FitResult", reduced: Reduced) -> "FitResult":
    found = {parameter.name: parameter for parameter in reduced.parameters}
    values = tuple(
        found.get(
            p.name, dataclasses.replace(p, value=0.0, sigma=None, essential=False, interval=None)
        )
        for p in fit.parameters
    )
    deviations = np.array([p.sigma or 0.0 for p in values])
    return dataclasses.replace(
        fit,
        parameters=values,
        covariance=np.diag(deviations**2),
        relative_error=reduced.relative_error,
        condition_number=reduced.condition_number,
        condition_scaled=reduced.condition_scaled,
    )
