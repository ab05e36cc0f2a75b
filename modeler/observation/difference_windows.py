"""Means of a logged derivative and difference quotients of what it derives from, over windows."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.observation.segments import Piece

_LEAST_HALF = 3  # samples: a leap of the acceleration then weighs 1/12 of itself at most

Column = Literal["qd", "qdd"]


@dataclass(frozen=True, eq=False)
class Windows:
    """Window means of one piece: logged derivative and difference quotient, (n - 2m, joints)."""

    time: np.ndarray
    step: float
    half: int
    logged: np.ndarray
    quotient: np.ndarray
    slope: np.ndarray  # of the logged derivative, for its delay

    @property
    def error(self) -> np.ndarray:
        """Logged less quotient."""
        return self.logged - self.quotient


def windows_of(
    piece: Piece, column: Column, lower: str, cutoff: float, delay: np.ndarray
) -> Windows:
    """The windows of one period of the parallel filter, 7 samples at least.

    Args:
        piece: with the column logged.
        column: of the logged derivative.
        lower: of what it derives from.
        cutoff: of the parallel filter, Hz; 0: windows of 7 samples.
        delay: (joints,) s by which the logged derivative is late, taken out.
    """
    below, logged = getattr(piece, lower), getattr(piece, column)
    if delay.any():
        logged = np.column_stack(
            [np.interp(piece.time + d, piece.time, v) for d, v in zip(delay, logged.T, strict=True)]
        )
    half = max(_LEAST_HALF, round(0.5 / (cutoff * piece.step)) if cutoff else 0)
    half = min(half, (len(piece.time) - 1) // 2)
    length = 2 * half * piece.step
    trapezoids = 0.5 * piece.step * (logged[1:] + logged[:-1])
    integral = np.concatenate([np.zeros((1, logged.shape[1])), np.cumsum(trapezoids, axis=0)])
    mean, quotient, slope = (
        (v[2 * half :] - v[: -2 * half]) / length for v in (integral, below, logged)
    )
    return Windows(piece.time[half:-half], piece.step, half, mean, quotient, slope)


def size_of(values: np.ndarray) -> np.ndarray:
    """(joints,) of (n, joints): root mean square weighted by energy, so long rests do not count."""
    total = np.sum(values**2, axis=0)
    return np.sqrt(np.sum(values**4, axis=0) / np.where(total > 0.0, total, 1.0))
