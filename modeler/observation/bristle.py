"""The bristle of Dahl's friction along measured positions."""

import numpy as np


def bristle(q: np.ndarray, distance: float) -> np.ndarray:
    """(n,) the state z along positions q (n,), from z = sign v at the start.

    z' = (v/d)(1 - z sign v): between reversals z = s + (z0 - s) exp(-travel/d), s = sign v.
    """
    step = np.diff(q)
    if not step.any():
        return np.zeros(len(q))
    direction = _carried(np.sign(step))
    begins = np.concatenate([[0], np.flatnonzero(np.diff(direction)) + 1])
    lengths = np.diff(np.append(begins, len(step)))
    travel = np.abs(q[1:] - np.repeat(q[begins], lengths))
    left = np.exp(-travel / distance)
    way, kept = direction[begins], left[begins + lengths - 1]
    apart = np.empty(len(begins))  # z - s at each turn
    before = float(direction[0])
    for k, (s, share) in enumerate(zip(way.tolist(), kept.tolist(), strict=True)):
        apart[k] = before - s
        before = s + (before - s) * share
    return np.concatenate([direction[:1], direction + np.repeat(apart, lengths) * left])


def _carried(direction: np.ndarray) -> np.ndarray:
    """Zeros replaced by the last direction before them, at the start by the first after."""
    known = np.flatnonzero(direction)
    place = np.searchsorted(known, np.arange(len(direction)), side="right") - 1
    return direction[known[np.maximum(place, 0)]]
