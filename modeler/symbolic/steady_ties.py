"""How many joints a posture's loops tie by constant ratios, as a parallelogram does.

A parallelogram can also be put together crossed. With equal lengths both are assembly modes; the
one that keeps directions is what such lengths are chosen for.
"""

import numpy as np

from modeler.symbolic.linkage import Linkage

_TIMES = 2  # as many speeds as joints, so that half of the postures are enough
_FEWEST = 8
_SEED = 1784  # Watt
_STEP = 0.02  # rad or sizes, of the actuated joints
_TOLERANCE = 1e-7


def steady_ties(linkage: Linkage, u: np.ndarray) -> np.ndarray:
    """(n,) numbers of independent combinations of joint speeds that vanish all around a posture.

    0 where half of the motions around it are out of reach.

    Args:
        linkage: the robot.
        u: (n, u) regular closed postures.
    """
    closing, given = linkage.closing, list(linkage.closing.given)
    solved = list(closing.solved)
    count = max(_FEWEST, _TIMES * -(-closing.unknowns // len(given)))
    steps = np.random.default_rng(_SEED).uniform(-_STEP, _STEP, (count, len(given)))
    around = np.repeat(u[:, None], count, axis=1)
    around[:, :, given] += steps * linkage.closing.scale[given]
    around = closing.closed(around.reshape(-1, closing.unknowns))
    closed = np.all(np.isfinite(around), axis=1)
    J = closing.jacobians(around[closed]) * linkage.closing.scale
    speeds = np.zeros((len(around), closing.unknowns, len(given)))
    speeds[np.ix_(closed, given)] = np.eye(len(given))
    speeds[np.ix_(closed, solved)] = -np.linalg.pinv(J[:, :, solved]) @ J[:, :, given]
    every = speeds.reshape(len(u), count, closing.unknowns, len(given))
    flat = every.transpose(0, 2, 1, 3).reshape(len(u), closing.unknowns, -1)
    values = np.linalg.svd(flat, compute_uv=False)
    moving = np.sum(values > _TOLERANCE * values[:, :1], axis=1)
    enough = 2 * np.sum(closed.reshape(len(u), count), axis=1) >= count
    return np.where(enough, closing.unknowns - moving, 0)
