"""One estimated parameter, and a table of them."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from modeler.core.json import build_instance, select_attributes

T = TypeVar("T")

LOPSIDED = 2.0
"""Ratio of the sides of an interval above which one standard deviation does not describe it."""


@dataclass(frozen=True)
class ParameterEstimate:
    """One estimated parameter.

    Attributes:
        name: base parameter, or load parameter.
        unit: SI.
        value: 0 if it was set aside.
        sigma: standard deviation; None if it was set aside.
        essential: False if the model does as well without it.
        status: "estimated" | "set aside" | "held".
        interval: 95 %, of parameters of an effect whose shapes were fitted too; None for others.
        prior: share of what is known of it that comes from the prior of the robot file, of the
            inverse variance; None without one.
    """

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
        """100 sigma / |value|; None where that means nothing."""
        if self.sigma is None or self.value == 0.0:
            return None
        return 100.0 * self.sigma / abs(self.value)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        names = "name value sigma relative_sigma_percent essential unit status prior interval"
        return select_attributes(self, names)


def read_back(kind: type[T], raw: Mapping[str, Any], place: str) -> T:
    """What `to_json` of a dataclass says; entries that are none of its fields follow from others.

    Raises:
        PlainError: a field is missing or of another type; names its place.
    """
    names = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    return build_instance(
        kind, {name: value for name, value in raw.items() if name in names}, place
    )


def read_all(kind: type[T], raw: Mapping[str, Any], name: str) -> tuple[T, ...]:
    """What stands in a list of an object."""
    return tuple(read_back(kind, one, f"{name}[{i}]") for i, one in enumerate(raw[name]))


def format_parameters(
    parameters: Sequence[ParameterEstimate], reduced: Sequence[ParameterEstimate] = ()
) -> list[str]:
    """A table: name, value, sigma, %sigma, unit; values of a reduced model, shares of a prior."""
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
    """How much of what is known of it comes from the prior."""
    if parameter.status == "held":
        return "held"
    return "-" if parameter.prior is None else f"{100.0 * parameter.prior:.0f} %"


def format_spread(value: float, sigma: float, interval: tuple[float, float] | None) -> str:
    """What stands behind a value: " +- sigma", or where that says little " (low to high)"."""
    if interval is not None and interval[0] < interval[1]:
        down, up = value - interval[0], interval[1] - value
        if max(down, up) > LOPSIDED * min(down, up):
            return f" ({interval[0]:.3g} to {interval[1]:.3g})"
    return f" +- {sigma:.2g}" if sigma > 0.0 else ""
