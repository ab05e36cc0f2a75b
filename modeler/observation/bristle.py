"""The bristle of Dahl's friction along measured positions."""

import numpy as np


def bristle(q: np.ndarray, distance: float) -> np.ndarray:
    """(n,) the state z along positions q (n,), from z = sign v at the start.

    z' = (v/d)(1 - z sign v): between reversals z = s + (z0 - s) exp(-travel/d), s = sign v.
    """
    step = np.diff(q)
    if not step.any():
        return np.zeros(len(q))
    z = np.empty(len(q))
    direction = _carried(np.sign(step))
    turns = np.flatnonzero(np.diff(direction)) + 1
    z[0] = direction[0]
    for begin, end in zip([0, *turns], [*turns, len(step)], strict=True):
        s = direction[begin]
        travel = np.abs(q[begin + 1 : end + 1] - q[begin])
        z[begin + 1 : end + 1] = s + (z[begin] - s) * np.exp(-travel / distance)
    return z


def _carried(direction: np.ndarray) -> np.ndarray:
    """Zeros replaced by the last direction before them, at the start by the first after."""
    known = np.flatnonzero(direction)
    place = np.searchsorted(known, np.arange(len(direction)), side="right") - 1
    return direction[known[np.maximum(place, 0)]]
