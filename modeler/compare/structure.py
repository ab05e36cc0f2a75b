"""Does a residual still have structure: is it a repeatable function of something?"""

from dataclasses import dataclass

import numpy as np

from modeler.compare.coordinates import DRIFTS, coordinate_values, coordinates_of
from modeler.compare.prediction import Prediction
from modeler.residuals.smooth import (
    Smooth,
    direction_function,
    drift_function,
    explained_share,
    smooth_function,
    stack,
)

ENOUGH = 200  # samples below which nothing is said about structure

NEARLY = 0.9  # a simpler function that explains this much of the best is named instead

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
    motors: tuple[tuple[str, float], ...] = ()  # coupled motor, "5+6" -> share, of its velocity

    def share(self, coordinate: str) -> float:
        """Share of one coordinate; NaN where the logs do not hold it."""
        return dict(self.shares).get(coordinate, float("nan"))


def structure(prediction: Prediction, joint: int) -> Structure | None:
    """Structure of one joint's residual; None with fewer than ENOUGH samples."""
    rows = np.flatnonzero(prediction.used[:, joint])
    if rows.size < ENOUGH:
        return None
    rows = rows[:: -(-rows.size // _MOST)]
    e = prediction.measured[rows, joint] - prediction.predicted[rows, joint]
    families = {
        coordinate.id: _family(prediction, joint, coordinate.id, rows)
        for coordinate in coordinates_of(prediction, joint)
    }
    shares = tuple(
        (name, _share(name, family, e, prediction.qd[rows, joint]))
        for name, family in families.items()
    )
    motion = stack([family for name, family in families.items() if name not in DRIFTS])
    # many columns cost something on unseen motion: a sum may do worse than its best part
    alone = max(share for name, share in shares if name not in DRIFTS)
    speeds = prediction.qd[rows]
    return Structure(
        shares=shares,
        together=max(alone, explained_share(motion, e, *_MOTION)),
        across=tuple(
            (info.name, _across(speeds[:, other], e))
            for other, info in enumerate(prediction.joints)
        ),
        motors=tuple(
            (motor.name, _across(speeds @ np.asarray(motor.coefficients), e))
            for motor in prediction.motors
        ),
    )


def _share(name: str, family: Smooth, e: np.ndarray, qd: np.ndarray) -> float:
    """Of the variance of e; of a temperature, what it adds to the direction of motion alone."""
    if name not in DRIFTS:
        return explained_share(family, e, *_MOTION)
    share = explained_share(family, e, *_DRIFT)
    if name == "temperature":
        share -= explained_share(direction_function(np.sign(qd)), e, *_DRIFT)
    return max(0.0, share)


def across(prediction: Prediction, other: int, rows: np.ndarray, e: np.ndarray) -> dict[str, float]:
    """Shares of e (n,) on some rows by functions of one coordinate of another joint each."""
    found = {
        "position": smooth_function(prediction.q[rows, other]),
        "velocity": _of_velocity(prediction.qd[rows, other]),
        "acceleration": smooth_function(prediction.qdd[rows, other]),
    }
    return {name: explained_share(family, e, *_MOTION) for name, family in found.items()}


def _across(qd: np.ndarray, e: np.ndarray) -> float:
    if not np.isfinite(qd).all():  # rows that do not count for the other joint may hold anything
        return 0.0
    return explained_share(_of_velocity(qd), e, *_MOTION)


def _of_velocity(qd: np.ndarray) -> Smooth:
    """Smooth on either side of zero, with a step there: what friction looks like."""
    return stack([smooth_function(qd), direction_function(np.sign(qd))])


def _of_temperature(temperature: np.ndarray, way: np.ndarray) -> Smooth:
    """Slow, and another function for either direction: friction changes, and gravity does not."""
    slow = smooth_function(temperature, knots=5)
    return stack([slow, Smooth(slow.columns * way[:, None], slow.penalty)])


def _family(prediction: Prediction, joint: int, coordinate: str, rows: np.ndarray) -> Smooth:
    values = coordinate_values(prediction, joint, coordinate)[rows]
    if coordinate == "direction":
        return direction_function(values)
    if coordinate in ("velocity", "travel"):
        return _of_velocity(values)
    if coordinate == "temperature":
        return _of_temperature(values, np.sign(prediction.qd[rows, joint]))
    if coordinate == "time":
        return drift_function(values, prediction.run[rows])
    return smooth_function(values)
