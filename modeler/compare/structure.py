"""Does a residual still have structure: is it a repeatable function of something?"""

from dataclasses import dataclass

import numpy as np

from modeler.compare.coordinates import COORDINATES, coordinate_values
from modeler.compare.prediction import Prediction
from modeler.compare.smooth import (
    Smooth,
    direction_function,
    drift_function,
    explained_share,
    smooth_function,
    stack,
)

ENOUGH = 200  # samples below which nothing is said about structure

_MOST = 50_000  # samples beyond which every second, third, ... is looked at

# Motion: few long blocks, so that slow noise is not mistaken for a function of position.
_MOTION = (10, 10)  # blocks, folds
# Drift: many short blocks, because a slow function of time can only be judged between its knots.
_DRIFT = (40, 5)


@dataclass(frozen=True)
class Structure:
    """Shares of the residual variance that functions predict on motion not used to fit them.

    Coordinates of one trajectory go together, so the shares overlap and do not add up.
    """

    shares: tuple[tuple[str, float], ...]  # coordinate id -> share, in the order of COORDINATES
    together: float  # a sum of one function of each motion coordinate, or the best one alone
    across: tuple[tuple[str, float], ...]  # joint name -> share, by a function of its velocity

    def share(self, coordinate: str) -> float:
        """Share of one coordinate."""
        return dict(self.shares)[coordinate]


def structure(prediction: Prediction, joint: int) -> Structure | None:
    """Structure of one joint's residual; None with fewer than ENOUGH samples."""
    rows = np.flatnonzero(prediction.used[:, joint])
    if rows.size < ENOUGH:
        return None
    rows = rows[:: -(-rows.size // _MOST)]
    e = prediction.measured[rows, joint] - prediction.predicted[rows, joint]
    families = {
        coordinate.id: _family(prediction, joint, coordinate.id, rows) for coordinate in COORDINATES
    }
    shares = tuple(
        (name, explained_share(family, e, *(_DRIFT if name == "time" else _MOTION)))
        for name, family in families.items()
    )
    motion = stack([family for name, family in families.items() if name != "time"])
    # many columns cost something on unseen motion: a sum may do worse than its best part
    alone = max(share for name, share in shares if name != "time")
    return Structure(
        shares=shares,
        together=max(alone, explained_share(motion, e, *_MOTION)),
        across=tuple(
            (info.name, _across(prediction, e, rows, other))
            for other, info in enumerate(prediction.joints)
        ),
    )


def _across(prediction: Prediction, e: np.ndarray, rows: np.ndarray, other: int) -> float:
    qd = prediction.qd[rows, other]
    if not np.isfinite(qd).all():  # rows that do not count for the other joint may hold anything
        return 0.0
    return explained_share(_of_velocity(qd), e, *_MOTION)


def _of_velocity(qd: np.ndarray) -> Smooth:
    """Smooth on either side of zero, with a step there: what friction looks like."""
    return stack([smooth_function(qd), direction_function(np.sign(qd))])


def _family(prediction: Prediction, joint: int, coordinate: str, rows: np.ndarray) -> Smooth:
    values = coordinate_values(prediction, joint, coordinate)[rows]
    if coordinate == "direction":
        return direction_function(values)
    if coordinate == "velocity":
        return _of_velocity(values)
    if coordinate == "time":
        return drift_function(values, prediction.run[rows])
    return smooth_function(values)
