"""Is the prediction right but for its sign or its scale?"""

import math
from dataclasses import dataclass

from modeler.compare.sums import JointSums

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


def scale(sums: JointSums) -> Scale | None:
    """The factor between two torques; None for too few samples or a constant.

    With e = m - p about their means, min_f ||m - f p||^2 = ||e||^2 - (e . p)^2 / ||p||^2.
    """
    (before, _, shared), (_, own, product), (_, _, squares) = sums.scatter.tolist()
    if sums.count < _FEWEST or squares <= 0.0 or own <= 0.0:
        return None
    return Scale(
        factor=product / squares,
        correlation=product / math.sqrt(squares * own),
        mended=shared**2 / (squares * before) if before > 0.0 else 0.0,
    )
