"""The order spectrum of a joint's residual, seen before any filter takes the ripple away."""

from dataclasses import dataclass

import numpy as np

from modeler.compare.prediction import Prediction, full_rate
from modeler.residuals.orders import OrderSpectrum, order_spectrum


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


def waves(orders: OrderSpectrum, unit: str) -> tuple[np.ndarray, str]:
    """Orders of a spectrum as a user counts them, and per what.

    Args:
        orders: the spectrum.
        unit: of the joint's position, rad or m.
    """
    if unit == "rad":
        return orders.order, "turn"
    return orders.order / (2.0 * np.pi), "m"


def lines(orders: OrderSpectrum | None, unit: str) -> tuple[Line, ...]:
    """What stands out in an order spectrum, the strongest first; see `waves`."""
    if orders is None:
        return ()
    found, (counted, _) = orders, waves(orders, unit)
    places = [int(np.argmin(np.abs(found.order - order))) for order in found.peaks]
    return tuple(
        Line(
            waves=float(counted[k]),
            amplitude=float(found.amplitude[k]),
            share=0.5 * float(found.amplitude[k]) ** 2 / found.power,
        )
        for k in places
    )
