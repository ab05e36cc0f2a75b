"""What the variance of a joint's torque is made of: explained, repeatable, noise."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.compare.predictable import LEAST, Moved, predictable
from modeler.compare.prediction import Prediction, full_rate
from modeler.compare.repetition import Repetition, met
from modeler.compare.structure import Structure

Method = Literal["laps", "logs", "smooth"]

_ENOUGH = 0.5  # of the rows must have been repeated
_FEWEST = 50  # rows
_NEIGHBOURS = 6  # rows
_MOST = 3000  # rows of the smooth functions, beyond which every second, third, ... is taken
_FOLDS = 8
_SLIPS = (0.001, 0.01, 0.1)  # of the range of motion


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
    again = _smooth(prediction, joint, e, rows, found)
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
        other = met(full, joint, partner, prediction.time[rows])
        there = np.isfinite(other)
        if not there.any():
            continue
        own = e[rows][there]
        if _copies(own, other[there]):
            continue
        product = own * other[there]
        products += float(product.sum())
        squares += float(own @ own)
        # every pair of moments stands here twice, once from either side
        scatter += 2.0 * float(np.sum(np.add.reduceat(product, _starts(own.size)) ** 2))
        repeated[rows[there]] = True
    if repeated.sum() < max(_FEWEST, _ENOUGH * np.isfinite(e).sum()):
        return None
    if squares == 0.0:
        return 0.0, 0.0
    return float(np.clip(products / squares, 0.0, 1.0)), float(np.sqrt(scatter)) / squares


def _copies(first: np.ndarray, second: np.ndarray) -> bool:
    """True if these are the same measurements given twice: their noise is alike, too."""
    return bool(np.median(np.abs(first - second) > 1e-3 * np.abs(first)) < 0.5)


def _starts(size: int) -> np.ndarray:
    return np.arange(0, size, _NEIGHBOURS)


def _smooth(
    prediction: Prediction, joint: int, e: np.ndarray, rows: np.ndarray, found: Structure
) -> float:
    """Share of the squared residual that is its mean, or predicted by the motion."""
    own = e[rows]
    energy, mean, share = float(own @ own), float(own.mean()), found.together
    looked = rows[:: -(-rows.size // _MOST)]
    size = float(e[looked].std())
    moved = _moved(prediction, joint, looked)
    if moved is not None and size > 0.0:
        fold = _folds(prediction.run[looked])
        share = max(share, predictable(moved, (e[looked] - mean) / size, fold))
    offset = own.size * mean**2 / energy
    return offset + (1.0 - offset) * share


def _folds(run: np.ndarray) -> np.ndarray:
    """(n,) each log in eight stretches."""
    fold = np.zeros(run.size, dtype=int)
    for log in np.unique(run):
        own = np.flatnonzero(run == log)
        fold[own] = (np.arange(own.size) * _FOLDS // own.size + log) % _FOLDS
    return fold


def _moved(prediction: Prediction, joint: int, rows: np.ndarray) -> Moved | None:
    """Motion on the rows of one joint; None if they are few, or another joint has none there."""
    q, v, a = (x[rows] for x in (prediction.q, prediction.qd, prediction.qdd))
    if rows.size < LEAST or not all(np.isfinite(x).all() for x in (q, v, a)):
        return None
    slips = []
    if prediction.travel is not None:
        travel, way = prediction.travel[rows, joint], np.sign(v[:, joint])
        stroke = max(float(np.ptp(q[:, joint])), 1e-12)
        slips = [way * (1.0 - 2.0 * np.exp(-travel / (d * stroke))) for d in _SLIPS]
    return Moved(joint, q, v, a, prediction.predicted[rows, joint], slips)
