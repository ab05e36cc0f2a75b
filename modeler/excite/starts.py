"""Random motions within limits: where searches begin, and what they are compared with."""

import numpy as np

from modeler.excite.task import Task

_FULL = 0.95  # of the limits


def random_motion(task: Task, rng: np.random.Generator) -> np.ndarray:
    """(J, 2 K - 1) a series with random coefficients, as large as the limits let it be.

    Each joint by itself is made as large as its range, speed and acceleration allow, around a
    random place; where a torque, a box or a loop is in the way, all shrink towards rest.

    Raises:
        DataError: no motion keeps to the limits, however small.
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
    return task.drawn_in(x)
