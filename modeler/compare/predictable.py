"""How much of a residual smooth functions of the motion predict on motion that was held out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dposv

_OWN, _BENT, _WIDE = 80, 40, 350  # features of the joint, turned with its direction, of all joints
LEAST = 300
"""Rows below which nothing is said."""

_RIDGES = (10.0, 100.0, 600.0)


@dataclass(frozen=True, eq=False)
class Moved:
    """What the functions read; s rows of one joint, J joints.

    Attributes:
        joint: which one.
        q, v, a: (s, J) motion of all joints.
        load: (s,) torque that loads the gear of the joint, N m or N.
        slips: (s,) bristle states of the joint, by distance.
    """

    joint: int
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    load: np.ndarray
    slips: Sequence[np.ndarray]


def predictable(
    moved: Moved, residual: np.ndarray, fold: np.ndarray, further: Sequence[np.ndarray] = ()
) -> float:
    """Share of sum r^2 that smooth functions of the motion predict where they were not fitted.

    Random Fourier features (Rahimi and Recht 2007) of position, speed, acceleration, load and
    direction of the joint, of position and speed of all joints, and bristle states; ridge
    regression, judged on the folds that were held out. Near 0 for noise, never below 0; 0 for
    fewer than `LEAST` rows.

    Args:
        moved: the motion.
        residual: (s,) r, of standard deviation about 1.
        fold: (s,) rows of one fold are predicted from those of all others.
        further: (s, ...) sets of functions to try besides; the best set counts.
    """
    if residual.size < LEAST:
        return 0.0
    sets = [*_features(moved), *map(_standard, further)]
    left = min(_left(features, residual, fold) for features in sets if features.shape[1])
    return max(0.0, 1.0 - left / float(residual @ residual))


def _left(features: np.ndarray, y: np.ndarray, fold: np.ndarray) -> float:
    """Squared error on rows that were held out, by the best ridge."""
    parts = [(features[fold == f], y[fold == f]) for f in np.unique(fold)]
    grams = [X.T @ X for X, _ in parts]
    sides = [X.T @ t for X, t in parts]
    G, u = sum(grams), sum(sides)
    total = np.zeros(len(_RIDGES))
    for (X, t), gram, side in zip(parts, grams, sides, strict=True):
        for k, ridge in enumerate(_RIDGES):
            theta = _solved(G - gram, ridge, u - side)
            total[k] += float(np.sum((t - X @ theta) ** 2))
    return float(total.min())


def _solved(gram: np.ndarray, ridge: float, side: np.ndarray) -> np.ndarray:
    """x of (gram + ridge 1) x = side; a fresh symmetric gram is used up."""
    matrix = gram.T  # in the order of LAPACK, which then copies nothing
    matrix.flat[:: len(matrix) + 1] += ridge
    _, x, failed = dposv(matrix, side, lower=1, overwrite_a=1)
    assert failed == 0, "a ridge keeps the matrix positive"
    return np.asarray(x)


def _features(moved: Moved) -> tuple[np.ndarray, np.ndarray]:
    """Functions of the joint's own motion, and functions of the motion of all joints."""
    q, v, a, j = moved.q, moved.v, moved.a, moved.joint
    own = np.column_stack([q[:, j], v[:, j], a[:, j], moved.load])
    near = np.column_stack([q, v])
    generator = np.random.default_rng(5)
    direction = np.sign(v[:, j])[:, None]
    smooth = _fourier(own, _OWN, generator)
    wide = _fourier(near, _WIDE, generator)
    bent = _fourier(own[:, :2], _BENT, generator) * direction
    alone = np.column_stack([own, *moved.slips, smooth, bent, direction])
    return _standard(alone), _standard(np.column_stack([near, wide]))


def _standard(features: np.ndarray) -> np.ndarray:
    """Mean 0 and standard deviation 1."""
    centred = features - features.mean(axis=0)
    size = np.sqrt(np.einsum("ij,ij->j", centred, centred) / max(1, len(centred)))
    seen = size > 1e-9
    if not seen.all():
        centred, size = centred[:, seen], size[seen]
    centred /= size
    return centred


def _fourier(x: np.ndarray, count: int, generator: np.random.Generator) -> np.ndarray:
    """(n, count) cosines of random directions, lengths of order one in standard deviations."""
    spread = x.std(axis=0)
    scaled = x / np.where(spread > 0.0, spread, 1.0)
    width = generator.uniform(0.5, 3.0, count) / np.sqrt(x.shape[1])
    turn = generator.normal(size=(x.shape[1], count)) * width
    return np.cos(scaled @ turn + generator.uniform(0.0, 2.0 * np.pi, count))
