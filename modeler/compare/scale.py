"""Is the prediction right but for its sign or its scale?"""

from dataclasses import dataclass

import numpy as np

_AGAINST = -0.7  # correlation of measured and predicted torque below which the sign is wrong
_ALIKE = 0.9  # from which on they have one shape
_OFF = 0.1  # a scale nearer to one is no wrong scale
_EXPLAINS = 0.75  # of the squared residual, by the scale alone
_FEWEST = 20  # samples


@dataclass(frozen=True)
class Scale:
    """measured = factor * predicted + constant, by least squares."""

    factor: float
    correlation: float
    mended: float  # share of the squared residual that the factor takes away

    @property
    def opposite(self) -> bool:
        """True if the prediction has the wrong sign."""
        return self.correlation < _AGAINST

    @property
    def off(self) -> bool:
        """True if the prediction is right but for a factor."""
        wrong = abs(self.factor - 1.0) > _OFF and self.mended > _EXPLAINS
        return self.correlation > _ALIKE and wrong


def scale(measured: np.ndarray, predicted: np.ndarray) -> Scale | None:
    """The factor between two torques, (n,) each; None for too few samples or a constant."""
    if measured.size < _FEWEST:
        return None
    m, p = measured - measured.mean(), predicted - predicted.mean()
    squares, own = float(p @ p), float(m @ m)
    if squares <= 0.0 or own <= 0.0:
        return None
    factor = float(m @ p) / squares
    before, after = float(np.sum((m - p) ** 2)), float(np.sum((m - factor * p) ** 2))
    return Scale(
        factor=factor,
        correlation=float(m @ p) / float(np.sqrt(squares * own)),
        mended=1.0 - after / before if before > 0.0 else 0.0,
    )
