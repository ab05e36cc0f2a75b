"""How much of a residual is physics of whatever cause: predictable, or back in every lap."""

import numpy as np

from modeler.diagnose.state import State
from modeler.observation.bristle import bristle

_OWN, _BENT, _WIDE = 80, 40, 350  # features of the joint, turned with its direction, of all joints
_LEAST = 300  # rows
_RIDGES = (10.0, 100.0, 600.0)
_SLIPS = (0.001, 0.01, 0.1)  # of the range of motion


def predictable(state: State, j: int) -> float:
    """Share of the residual's variance on joint j that smooth functions of the motion predict.

    Random Fourier features (Rahimi and Recht 2007) of position, speed, acceleration, load and
    direction of the joint, of position and speed of all joints, and bristle states; ridge
    regression, judged on the folds that were held out. Near 0 for noise, never below 0.
    """
    residual = state.residual[j] / state.base.sigma[j]
    if residual.size < _LEAST:
        return 0.0
    fold = state.data.blocks.fold[state.base.block[j]]
    left = min(
        _left(features, residual, fold, ridge)
        for features in _features(state, j)
        for ridge in _RIDGES
    )
    return max(0.0, 1.0 - left / float(residual @ residual))


def _left(features: np.ndarray, y: np.ndarray, fold: np.ndarray, ridge: float) -> float:
    total = 0.0
    G, u = features.T @ features, features.T @ y
    for f in np.unique(fold):
        own = fold == f
        X, t = features[own], y[own]
        theta = np.linalg.solve(G - X.T @ X + ridge * np.eye(len(G)), u - X.T @ t)
        total += float(np.sum((t - X @ theta) ** 2))
    return total


def _features(state: State, j: int) -> tuple[np.ndarray, np.ndarray]:
    """Functions of the joint's own motion, and functions of the motion of all joints."""
    rows = state.rows
    used = state.data.observation.used[:, j]
    observation = state.data.observation
    q, v, a = (x[used] for x in (observation.q, observation.qd, observation.qdd))
    load = rows.filtered(j, [s.load[:, j] for s in rows.signals])
    slips = [
        rows.filtered(j, [bristle(s.q[:, j], d * state.scales[j].range) for s in rows.signals])
        for d in _SLIPS
    ]
    own = np.column_stack([q[:, j], v[:, j], a[:, j], load])
    near = np.column_stack([q, v])
    generator = np.random.default_rng(5)
    direction = np.sign(v[:, j])[:, None]
    smooth = _fourier(own, _OWN, generator)
    wide = _fourier(near, _WIDE, generator)
    bent = _fourier(own[:, :2], _BENT, generator) * direction
    alone = np.column_stack([own, *slips, smooth, bent, direction])
    return _standard(alone), _standard(np.column_stack([near, wide]))


def _standard(features: np.ndarray) -> np.ndarray:
    """Mean 0 and standard deviation 1."""
    centred = features - features.mean(axis=0)
    size = centred.std(axis=0)
    return centred[:, size > 1e-9] / size[size > 1e-9]


def _fourier(x: np.ndarray, count: int, generator: np.random.Generator) -> np.ndarray:
    """(n, count) cosines of random directions, lengths of order one in standard deviations."""
    spread = x.std(axis=0)
    scaled = x / np.where(spread > 0.0, spread, 1.0)
    width = generator.uniform(0.5, 3.0, count) / np.sqrt(x.shape[1])
    turn = generator.normal(size=(x.shape[1], count)) * width
    return np.cos(scaled @ turn + generator.uniform(0.0, 2.0 * np.pi, count))


def repeatable(state: State, j: int) -> float | None:
    """Share of the residual's variance that returns in the next lap; None without laps."""
    blocks = state.data.blocks
    rows, residual = state.rows, state.residual[j]
    products, squares = 0.0, 0.0
    for run, period in enumerate(blocks.period):
        own = rows.run[j] == run
        if period == 0.0 or own.sum() < 20:
            continue
        t, r = rows.time[j][own], residual[own]
        later = t + period
        step = float(np.median(np.diff(t)))
        place = np.clip(np.searchsorted(t, later), 1, len(t) - 1)
        inside = (later <= t[-1]) & (t[place] - t[place - 1] < 2.0 * step)
        share = (later - t[place - 1]) / np.maximum(t[place] - t[place - 1], 1e-12)
        again = r[place - 1] + share * (r[place] - r[place - 1])
        first, second = r[inside], again[inside]
        products += float(first @ second)
        squares += 0.5 * float(first @ first + second @ second)
    return max(0.0, products / squares) if squares > 0.0 else None
