"""What the variance of a joint's torque is made of: explained, repeatable, noise."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.compare.prediction import Prediction, full_rate
from modeler.compare.repetition import Repetition
from modeler.compare.structure import Structure
from modeler.residuals.memory import at

Method = Literal["laps", "logs", "smooth"]

_ENOUGH = 0.5  # of the rows must have been repeated
_FEWEST = 50  # rows
_NEIGHBOURS = 6  # rows


@dataclass(frozen=True)
class Shares:
    """Of sum (measured - mean)^2; the three sum to one.

    Explained is R^2, and negative for a prediction that is worse than the best constant.
    """

    explained: float
    systematic: float  # repeatable, and not in the model
    floor: float  # noise, as far as these logs can tell
    method: Method  # how the last two were told apart
    sigma: float | None  # standard error of both; None by the method "smooth"

    @property
    def repeats(self) -> float:
        """Repeatable share of what is not explained; 0 if nothing is left."""
        left = self.systematic + self.floor
        return self.systematic / left if left > 0.0 else 0.0


def shares(
    prediction: Prediction,
    joint: int,
    e: np.ndarray,
    repeated: tuple[Repetition, ...],
    found: Structure | None,
) -> Shares | None:
    """Shares of one joint; None for a constant torque, or too few samples to tell.

    Where the motion was repeated, the repeatable part is the mean product of the residual and that
    of the same moment in another lap (or log): noise of different laps has mean product zero.
    Otherwise it is the squared mean and what smooth functions of the motion predict of the rest on
    blocks of time that were held out.

    Args:
        prediction: the rows.
        joint: which one.
        e: (n,) its residual, NaN where a row does not count.
        repeated: laps, logs of one motion.
        found: structure of the residual.
    """
    rows = np.flatnonzero(prediction.used[:, joint])
    y = prediction.measured[rows, joint]
    spread, energy = float(np.sum((y - y.mean()) ** 2)), float(e[rows] @ e[rows])
    if spread <= 0.0:
        return None
    left = energy / spread
    for repetition in repeated:
        returning = _returning(prediction, joint, e, repetition)
        if returning is not None:
            again, error = returning
            kind = repetition.kind
            return Shares(1.0 - left, again * left, (1.0 - again) * left, kind, error * left)
    if found is None or energy == 0.0:
        return None if energy else Shares(1.0, 0.0, 0.0, "smooth", None)
    offset = rows.size * float(e[rows].mean()) ** 2 / energy
    smooth = max(found.together, found.follows.share)
    again = offset + (1.0 - offset) * smooth
    return Shares(1.0 - left, again * left, (1.0 - again) * left, "smooth", None)


def _returning(
    prediction: Prediction, joint: int, e: np.ndarray, repetition: Repetition
) -> tuple[float, float] | None:
    """Share of the squared residual that laps have in common, and its standard error.

    The error comes from sums over half a dozen neighbouring rows, which may share their noise.
    None with too few rows repeated.
    """
    full = full_rate(prediction)
    products, squares, scatter = 0.0, 0.0, 0.0
    repeated = np.zeros(e.size, dtype=bool)
    for partner in repetition.partners:
        rows = np.flatnonzero((prediction.run == partner.run) & np.isfinite(e))
        there = full.run == partner.other
        then = prediction.time[rows] + partner.shift
        other = at(full.time[there], full.filtered[there, joint], then)
        there = np.isfinite(other)
        if not there.any():
            continue
        own = e[rows][there]
        if _copies(own, other[there]):
            continue
        product = own * other[there]
        parts = np.add.reduceat(product, np.arange(0, own.size, _NEIGHBOURS))
        products += float(product.sum())
        squares += float(own @ own)
        # every pair of moments stands here twice, once from either side
        scatter += 2.0 * float(parts @ parts)
        repeated[rows[there]] = True
    if repeated.sum() < max(_FEWEST, _ENOUGH * np.isfinite(e).sum()):
        return None
    if squares == 0.0:
        return 0.0, 0.0
    return float(np.clip(products / squares, 0.0, 1.0)), float(np.sqrt(scatter)) / squares


def _copies(first: np.ndarray, second: np.ndarray) -> bool:
    """True if these are the same measurements given twice: their noise is alike, too."""
    return bool(np.median(np.abs(first - second) > 1e-3 * np.abs(first)) < 0.5)
