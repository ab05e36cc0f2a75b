"""The energy model beside the torque model of the same data: figures, and what they come to."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from modeler.core.brief import Brief

SURE = 10.0
"""%sigma below which a parameter counts as known."""

_FELT = 0.5  # sigmas: a bias that is no longer small beside the noise
_WORTH = 1.2  # ratio of two uncertainties that is told as a difference


@dataclass(frozen=True)
class ModelFigures(Brief):
    """One model fitted to the data.

    Attributes:
        model: "torque", "energy, Simpson" or "energy, trapezoid".
        rows: of its W.
        condition_scaled: of W with columns of length one.
        known: parameters with a sigma below 10 % of their value.
        torque_error: ||tau - W beta|| / ||tau|| with its beta, on the rows of the torque model.
        torque_sigma: sqrt(tr(W C W^T)) / ||tau||: what its covariance C comes to in the same
            torques. Noise of the torques themselves is not in it.
        imbalance: share of the energy that integrals and derivatives miss: the work of inertia by
            the rule against the difference of kinetic energy; None for the torque model.
        bias: what that moves the parameter that it moves most, in sigmas; None for the torque
            model.
        joint_sigma: by joint, the root mean square of what the covariance comes to in its torques,
            N m or N.
    """

    model: str
    rows: int
    condition_scaled: float
    known: int
    torque_error: float
    torque_sigma: float
    imbalance: float | None = None
    bias: float | None = None
    joint_sigma: Mapping[str, float] = field(default_factory=dict)

    def cells(self) -> tuple[str, ...]:
        """Its line of the table."""
        return (
            f"{self.rows}",
            f"{self.condition_scaled:.4g}",
            f"{self.known}",
            f"{100.0 * self.torque_error:.3g} %",
            f"{100.0 * self.torque_sigma:.2g} %",
            "-" if self.imbalance is None else f"{self.imbalance:.1e}",
            "-" if self.bias is None else f"{self.bias:.2g} sigma",
        )


def _line(name: str, cells: Sequence[str]) -> str:
    widths = (7, 10, 7, 10, 10, 9, 13)
    return f"{name:<18}" + "".join(f"{c:>{w}}" for c, w in zip(cells, widths, strict=True))


@dataclass(frozen=True)
class EnergyReport(Brief):
    """How the rows of energy were made, and how they compare.

    Attributes:
        window: s.
        relative_error: ||y - W beta|| / ||y|| of the energies.
        figures: torque model, energy by Simpson's rule, energy by the trapezoid.
        parameters: estimated ones.
    """

    window: float
    relative_error: float
    figures: tuple[ModelFigures, ...]
    parameters: int

    @property
    def ratio(self) -> float:
        """Uncertainty of the torques over that of the torque model, at the joint where it is most.

        Of all joints together the largest torques alone would speak.
        """
        return self._worst()[1]

    def _worst(self) -> tuple[str, float]:
        torque, energy, _ = self.figures
        pairs = {
            f"joint {name}": (sigma, torque.joint_sigma.get(name, 0.0))
            for name, sigma in energy.joint_sigma.items()
        } or {"all joints": (energy.torque_sigma, torque.torque_sigma)}  # a file from before
        ratios = {name: own / first if first > 0.0 else 1.0 for name, (own, first) in pairs.items()}
        return max(ratios.items(), key=lambda item: item[1])

    def lines(self) -> list[str]:
        """Lines of text."""
        head = ("rows", "cond", "known", "error", "sigma", "missed", "bias")
        lines = [
            f"energy model: windows of {self.window:.4g} s, energies met to "
            f"{100.0 * self.relative_error:.3g} %; beside the torque model on the same data:",
            _line("model", head),
            *(_line(item.model, item.cells()) for item in self.figures),
        ]
        return [
            *lines,
            "cond: columns of length one; known: sigma below 10 %; error, sigma: of the predicted "
            "torques; missed: share of the energy that integrals and derivatives miss; bias: what "
            "that moves at most",
            *self.sentences(),
        ]

    def sentences(self) -> list[str]:
        """Which of the two models to take, and what the rule of integration does."""
        torque, energy, _ = self.figures
        where, ratio = self._worst()
        knows = (
            f"knows {energy.known} parameters where that knows {torque.known}, of {self.parameters}"
        )
        first = (
            f"the energy model predicts the torques of {where} {ratio:.3g} times less surely than "
            f"the torque model on the same data and {knows}: one equation a window in place of one "
            "a joint; for torques and values take --model torque"
            if ratio > _WORTH
            else "the energy model is about as sure as the torque model (at most "
            f"{ratio:.3g} times its sigma of the torques, {where}), {knows}, and needs no "
            "acceleration"
        )
        simpson, trapezoid = (item.bias or 0.0 for item in self.figures[1:])
        second = (
            f"integrals by Simpson's rule, and derivatives, move no parameter by more than "
            f"{simpson:.2g} sigma; with the trapezoid {trapezoid:.2g}"
        )
        if simpson > _FELT:
            second += "; log faster, or move more slowly"
        return [first, second]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "window": self.window,
            "relative_error": self.relative_error,
            "parameters": self.parameters,
            "ratio": self.ratio,
            "figures": [vars(item) for item in self.figures],
            "sentences": self.sentences(),
        }


def energy_report_from_json(raw: Mapping[str, Any] | None) -> EnergyReport | None:
    """Read `EnergyReport.to_json` back; None for a fit of the torque model."""
    if raw is None:
        return None
    return EnergyReport(
        window=float(raw["window"]),
        relative_error=float(raw["relative_error"]),
        figures=tuple(ModelFigures(**entry) for entry in raw["figures"]),
        parameters=int(raw["parameters"]),
    )
