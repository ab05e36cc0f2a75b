"""Friction by direction: what viscous, Coulomb, their asymmetry and the offset come to."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from modeler.core.contract import ModuleSpec
from modeler.fit.parameter import ParameterEstimate

_LAW = (
    ("Fv", "+", (("viscous", 1.0), ("asymmetric_viscous", 1.0))),
    ("Fs", "+", (("coulomb", 1.0), ("offset", 1.0))),
    ("Fv", "-", (("viscous", 1.0), ("asymmetric_viscous", -1.0))),
    ("Fs", "-", (("coulomb", 1.0), ("offset", -1.0))),
)


class Fitted(Protocol):
    """What of a fit enters here."""

    @property
    def parameters(self) -> tuple[ParameterEstimate, ...]:
        """(c,) base parameters."""

    @property
    def covariance(self) -> np.ndarray:
        """(c, c) of their values."""


@dataclass(frozen=True)
class Directed:
    """Friction of one joint in one direction of its motion, a sum of base parameters.

    Attributes:
        name: "Fv1+", "Fs1+" for qd > 0, "Fv1-", "Fs1-" for qd < 0.
        unit: SI.
        value: its estimate.
        sigma: standard deviation.
        relation: "Fv1+ = Fv1 + Fva1".
    """

    name: str
    unit: str
    value: float
    sigma: float
    relation: str

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        share = 100.0 * self.sigma / abs(self.value) if self.value else None
        return vars(self) | {"relative_sigma_percent": share}


def directed_from_json(raw: Mapping[str, Any]) -> Directed:
    """Read `Directed.to_json` back."""
    return Directed(**{k: v for k, v in raw.items() if k != "relative_sigma_percent"})


def friction_by_direction(spec: ModuleSpec, fit: Fitted) -> tuple[Directed, ...]:
    """Friction by direction of the joints whose viscous friction differs between the directions.

    The law of the columns qd, |qd|, sign(qd), 1 is that of two slopes and two levels,

        Fv qd + Fva |qd| + Fs sign(qd) + Off = Fv+ qd + Fs+ (qd > 0),  Fv- qd - Fs- (qd < 0),
        Fv+- = Fv +- Fva,  Fs+- = Fs +- Off

    (Fv1, Fs1 and Fv2, Fs2 of Houda et al., Table 1). A base parameter that carries others, such as
    a constant weight in OffR, carries them here too; its name in the relation says so.

    Args:
        spec: the robot.
        fit: its c base parameters, and the (c, c) covariance of their values.
    """
    parameters, covariance = fit.parameters, fit.covariance
    kinds = {parameter.name: parameter for parameter in spec.standard}
    column = {
        (kinds[base.column_of].effect, kinds[base.column_of].joint): i
        for i, base in enumerate(spec.base)
        if base.column_of in kinds and parameters[i].sigma is not None
    }
    found = []
    for joint in spec.joints:
        if ("asymmetric_viscous", joint.name) not in column:
            continue
        for prefix, sign, parts in _LAW:
            used = [(column[key, joint.name], c) for key, c in parts if (key, joint.name) in column]
            if (parts[0][0], joint.name) not in column:  # another carries it
                continue
            found.append(_sum(f"{prefix}{joint.name}{sign}", used, parameters, covariance))
    return tuple(found)


def _sum(
    name: str,
    used: list[tuple[int, float]],
    parameters: tuple[ParameterEstimate, ...],
    covariance: np.ndarray,
) -> Directed:
    at, c = [i for i, _ in used], np.array([factor for _, factor in used])
    variance = float(c @ covariance[np.ix_(at, at)] @ c)
    terms = " ".join(f"{'+' if f > 0 else '-'} {parameters[i].name}" for i, f in used)
    return Directed(
        name=name,
        unit=parameters[at[0]].unit,
        value=float(c @ [parameters[i].value for i in at]),
        sigma=max(variance, 0.0) ** 0.5,
        relation=f"{name} = {terms.removeprefix('+ ')}",
    )


def direction_lines(directions: tuple[Directed, ...]) -> list[str]:
    """A table; nothing without one."""
    if not directions:
        return []
    width = max(9, *(len(item.name) for item in directions))
    lines = [f"{'direction':<{width}} {'value':>13} {'sigma':>10}  unit"]
    lines += [
        f"{item.name:<{width}} {item.value:>13.6g} {item.sigma:>10.3g}  {item.unit:<10} "
        f"{item.relation}"
        for item in directions
    ]
    return lines
