"""How far a joint has come since it last turned back."""

import numpy as np


def travel_since_reversal(q: np.ndarray, least: float = 0.0) -> np.ndarray:
    """(n,) |q - q at the last turning point|; before the first one, from the first sample.

    Args:
        q: (n,) positions of one joint without a gap, rad or m.
        least: rad or m; a way back of no more than this is noise of the encoder, and no turn.
    """
    turns = np.array([0, *_turning_points(q, least)])
    last = turns[np.searchsorted(turns, np.arange(len(q)), side="right") - 1]
    return np.abs(q - q[last])


def _turning_points(q: np.ndarray, least: float) -> list[int]:
    """Samples at which the joint turns back by more than `least`, increasing."""
    moving = np.flatnonzero(np.diff(q))
    leaps = np.sign(np.diff(q)[moving])
    corners = [*(moving[1:][np.diff(leaps) != 0]), len(q) - 1]
    found: list[int] = []
    way, farthest = 0.0, 0
    for corner in map(int, corners):
        step = q[corner] - q[farthest]
        if step * way >= 0.0 and (way != 0.0 or abs(step) > least):
            way, farthest = way or float(np.sign(step)), corner
        elif step * way < 0.0 and abs(step) > least:
            found.append(farthest)
            way, farthest = -way, corner
    return found
