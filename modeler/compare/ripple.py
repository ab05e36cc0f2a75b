"""The order spectrum of a joint's residual, seen before any filter takes the ripple away."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from modeler.compare.orders import OrderSpectrum, order_spectrum
from modeler.compare.prediction import Prediction, full_rate

if TYPE_CHECKING:
    from modeler.compare.comparison import JointComparison


@dataclass(frozen=True)
class Line:
    """A wave that stands out."""

    waves: float  # per turn of a revolute joint, per m of a prismatic one
    amplitude: float  # N m or N
    share: float  # of the squared residual before filtering


def ripple(prediction: Prediction, joint: int) -> OrderSpectrum | None:
    """Of the samples that count, at full rate; None if they are few, or the joint rests."""
    full = full_rate(prediction)
    r, q = full.residual[:, joint], full.q[:, joint]
    counts = np.isfinite(r) & np.isfinite(q)
    if not counts.any():
        return None
    left = r[counts]
    return order_spectrum(
        q[counts], left - left.mean(), prediction.joints[joint].unit, float("inf")
    )


def waves(item: "JointComparison") -> tuple[np.ndarray, str]:
    """Orders of the spectrum as a user counts them, and per what."""
    assert item.orders is not None
    if item.joint.unit == "rad":
        return item.orders.order, "turn"
    return item.orders.order / (2.0 * np.pi), "m"


def lines(item: "JointComparison") -> tuple[Line, ...]:
    """What stands out in the order spectrum, the strongest first."""
    if item.orders is None:
        return ()
    found, (counted, _) = item.orders, waves(item)
    places = [int(np.argmin(np.abs(found.order - order))) for order in found.peaks]
    return tuple(
        Line(
            waves=float(counted[k]),
            amplitude=float(found.amplitude[k]),
            share=0.5 * float(found.amplitude[k]) ** 2 / found.power,
        )
        for k in places
    )
