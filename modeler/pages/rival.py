"""What any smooth function of the measured motion makes of a residual, fitted to other blocks."""

from collections.abc import Sequence

import numpy as np

from modeler.compare.predictable import LEAST
from modeler.diagnose.curves import curve_sets
from modeler.diagnose.state import State
from modeler.observation.bristle import bristle

_RIDGES = (10.0, 100.0, 600.0)
_SLIPS = (0.001, 0.01, 0.1)  # of the range of motion


def rival_prediction(state: State, j: int) -> np.ndarray | None:
    """(rows_j,) of the residual of joint j, N m or N; None for too few rows.

    Curves of the motion by ridge regression; every fold is predicted from all others.

    Args:
        state: of which the residual is.
        j: index of the joint.
    """
    residual = state.residual[j]
    fold = state.data.blocks.fold[state.base.block[j]]
    if residual.size < LEAST or np.unique(fold).size < 2:
        return None
    slips = _slips(state, j)
    found = [
        prediction
        for features in (np.hstack([own, slips]) for own in curve_sets(state, j))
        for prediction in _crossed(_standard(features), residual, fold)
    ]  # fmt: skip
    return min(found, key=lambda prediction: float(np.sum((residual - prediction) ** 2)))


def _slips(state: State, j: int) -> np.ndarray:
    """(rows_j, 3) states of bristles that turn over parts of the range of motion."""
    lengths = [share * state.scales[j].range for share in _SLIPS]
    every = [
        np.column_stack([bristle(s.q[:, j], length) for length in lengths])
        for s in state.rows.signals
    ]
    return state.rows.filtered(j, every)


def _crossed(features: np.ndarray, y: np.ndarray, fold: np.ndarray) -> Sequence[np.ndarray]:
    """(rows,) predictions of rows that were held out, for every ridge."""
    parts = [np.flatnonzero(fold == f) for f in np.unique(fold)]
    grams = [features[own].T @ features[own] for own in parts]
    sides = [features[own].T @ y[own] for own in parts]
    G, u = np.sum(grams, axis=0), np.sum(sides, axis=0)
    found = [np.zeros(len(y)) for _ in _RIDGES]
    for own, gram, side in zip(parts, grams, sides, strict=True):
        for prediction, ridge in zip(found, _RIDGES, strict=True):
            weights = np.linalg.solve(G - gram + ridge * np.eye(len(G)), u - side)
            prediction[own] = features[own] @ weights
    return found


def _standard(features: np.ndarray) -> np.ndarray:
    """Mean 0 and standard deviation 1; without what never changes."""
    centred = features - features.mean(axis=0)
    size = centred.std(axis=0)
    seen = size > 1e-9
    return np.asarray(centred[:, seen] / size[seen])
