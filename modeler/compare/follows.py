"""What a residual follows, of all that was measured: its own joint, another one, or several."""

from dataclasses import dataclass

import numpy as np

from modeler.compare.prediction import Prediction
from modeler.compare.structure import NEARLY, Structure, across
from modeler.residuals.features import SLIPS, Measured, functions
from modeler.residuals.flexible import flexible, stretches

_MOST = 3000  # rows beyond which every second, third, ... is looked at


@dataclass(frozen=True)
class Follows:
    """What flexible functions of all that was measured predict on motion not used to fit them.

    Attributes:
        share: of the residual's variance; 0 if it is within two standard errors of 0.
        joint: whose motion alone predicts nearly as much; None: no single joint's.
        coordinate: id of the one of that joint that does; "": none alone.
    """

    share: float
    joint: str | None = None
    coordinate: str = ""


def follows(prediction: Prediction, joint: int, found: Structure | None) -> Follows | None:
    """Of one joint; None with too few samples, or without a residual.

    Args:
        prediction: the rows.
        joint: which one.
        found: structure of its residual.
    """
    rows = np.flatnonzero(prediction.used[:, joint])
    rows = rows[:: -(-rows.size // _MOST)] if rows.size else rows
    e = prediction.measured[rows, joint] - prediction.predicted[rows, joint]
    if found is None or not np.ptp(e) > 0.0:
        return None
    kept = [k for k in range(len(prediction.joints)) if k == joint or _finite(prediction, rows, k)]
    sets = functions(_measured(prediction, joint, rows, kept))
    said = flexible(sets, e, stretches(prediction.run[rows]))
    if not said.sure:
        return Follows(0.0)
    places = {"own": kept.index(joint), "surface": kept.index(joint)}
    places |= {name: int(name) for name in said.alone if name.isdigit()}
    best = max(places, key=lambda name: said.alone.get(name, 0.0))
    if said.alone.get(best, 0.0) < NEARLY * said.share:
        return Follows(said.share)
    other = kept[places[best]]
    shares = {} if other == joint else across(prediction, other, rows, e)
    single = [name for name, share in shares.items() if share >= NEARLY * said.share]
    return Follows(said.share, prediction.joints[other].name, next(iter(single), ""))


def _finite(prediction: Prediction, rows: np.ndarray, joint: int) -> bool:
    """False for a joint whose rows were masked, and may hold anything."""
    every = (prediction.q, prediction.qd, prediction.qdd, prediction.predicted)
    return all(bool(np.isfinite(x[rows, joint]).all()) for x in every)


def _measured(prediction: Prediction, joint: int, rows: np.ndarray, kept: list[int]) -> Measured:
    every = (prediction.q, prediction.qd, prediction.qdd, prediction.predicted)
    q, v, a, torque = (x[rows][:, kept] for x in every)
    way = np.sign(prediction.qd[rows, joint])
    slips = np.zeros((rows.size, 0))
    if prediction.travel is not None:
        travel = prediction.travel[rows, joint]
        stroke = max(float(np.ptp(prediction.q[rows, joint])), 1e-12)
        turned = [1.0 - 2.0 * np.exp(-travel / (d * stroke)) for d in SLIPS]
        slips = way[:, None] * np.column_stack(turned)
    return Measured(kept.index(joint), q, v, a, torque, torque, way, slips, {})
