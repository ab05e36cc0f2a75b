"""Random motions within limits: where searches begin, and what they are compared with."""

import numpy as np

from modeler.core.errors import DataError
from modeler.excite.task import Task

_TRIES = 40
_SHRINK = 0.8
_FULL = 0.95  # of the limits


def random_motion(task: Task, rng: np.random.Generator) -> np.ndarray:
    """(J, 2 K - 1) a series with random coefficients, as large as the limits let it be.

    Each joint by itself is made as large as its range, speed and acceleration allow, around a
    random place; where a torque, a box or a loop is in the way, all shrink towards rest.

    Raises:
        DataError: no motion at all keeps to the limits.
    """
    joints, wide = len(task.bounds.joints), task.series.values.shape[1]
    x = np.zeros((joints, wide))
    x[:, 1:] = rng.normal(size=(joints, wide - 1))
    b, s = task.bounds, task.series
    for j in range(joints):
        q = s.values[:, 1:] @ x[j, 1:]
        extent = 0.5 * np.ptp(q)
        shares = (extent / b.half[j], np.abs(s.slopes @ x[j]).max() / b.speed[j],
                  np.abs(s.bends @ x[j]).max() / b.acceleration[j])  # fmt: skip
        x[j] *= _FULL * s.room / max(shares)
        q = s.values[:, 1:] @ x[j, 1:]
        least, most = _FULL * s.room * b.half[j] * np.array([-1, 1]) + b.middle[j]
        x[j, 0] = rng.uniform(least - q.min(), max(most - q.max(), least - q.min()))
    still = np.zeros_like(x)
    still[:, 0] = rest_place(task)
    for _ in range(_TRIES):
        if task.keeps(x):
            return x
        x = still + _SHRINK * (x - still)
    raise DataError(
        f"{task.columns.compiled.spec.robot}: no motion keeps to the limits, not even a small one "
        f"around {_told(task, still[:, 0])}; expected wider limits of torques, boxes or joints"
    )


def rest_place(task: Task) -> np.ndarray:
    """(J,) where the robot may stand: home, else the middle of the ranges, else where it is found.

    Raises:
        DataError: nowhere.
    """
    b = task.bounds
    first = (
        b.middle
        if b.home is None
        else np.clip(b.home, b.middle - 0.9 * b.half, b.middle + 0.9 * b.half)
    )
    rng = np.random.default_rng(0)
    wide = task.series.values.shape[1]
    for k in range(400):
        place = first if k == 0 else b.middle + 0.9 * b.half * rng.uniform(-1, 1, len(first))
        x = np.zeros((len(place), wide))
        x[:, 0] = place
        if task.keeps(x):
            return place
    raise DataError(
        f"{task.columns.compiled.spec.robot}: no posture of 400 keeps to the limits of torques and "
        f"boxes at rest, nor does {_told(task, first)}; expected wider ones"
    )


def _told(task: Task, place: np.ndarray) -> str:
    pairs = zip(task.bounds.joints, place, strict=True)
    return ", ".join(f"q{joint} = {value:.3g}" for joint, value in pairs)
