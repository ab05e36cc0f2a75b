"""Least squares of many rows from few: the orthogonal part of a QR decomposition is left out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief


@dataclass(frozen=True, eq=False)
class Reduced(Brief):
    """As many rows as there are columns, with the same squares and products; J joints.

    Attributes:
        W: (few, c) by joint.
        y: (few,) by joint.
        count: (J,) rows that there were.
    """

    W: tuple[np.ndarray, ...]
    y: tuple[np.ndarray, ...]
    count: np.ndarray


@dataclass(frozen=True, eq=False)
class Reduction(Brief):
    """What takes rows to few, by joint: [W y] = Q R.

    Attributes:
        Q: (rows_j, few) orthonormal.
        R: (few, c + 1).
    """

    Q: tuple[np.ndarray, ...]
    R: tuple[np.ndarray, ...]

    def beside(self, extra: Sequence[Sequence[np.ndarray | None]]) -> Reduced:
        """The rows with further columns, (rows_j, k) each by joint; None where they are zero."""
        sizes = [next(c.shape[1] for c in columns if c is not None) for columns in extra]
        W, y = [], []
        for j, (Q, R) in enumerate(zip(self.Q, self.R, strict=True)):
            parts = [columns[j] for columns in extra]
            more = _beside(Q, parts, sizes)
            below = np.zeros((len(more) - len(R), R.shape[1]))
            whole = np.hstack([np.vstack([R, below]), more])
            W.append(np.delete(whole, R.shape[1] - 1, axis=1))
            y.append(whole[:, R.shape[1] - 1])
        return Reduced(tuple(W), tuple(y), np.array([len(Q) for Q in self.Q]))


def reduction(W: Sequence[np.ndarray], y: Sequence[np.ndarray]) -> Reduction:
    """Of the rows of every joint."""
    every = [np.linalg.qr(np.column_stack([w, t])) for w, t in zip(W, y, strict=True)]
    return Reduction(tuple(Q for Q, _ in every), tuple(R for _, R in every))


def _beside(Q: np.ndarray, parts: Sequence[np.ndarray | None], sizes: Sequence[int]) -> np.ndarray:
    """(few + more, k) further columns of one joint: within Q, and below it what Q lacks."""
    inside = np.zeros((Q.shape[1], sum(sizes)))
    ends = np.cumsum([0, *sizes])
    shown = [k for k, part in enumerate(parts) if part is not None]
    places = [i for k in shown for i in range(ends[k], ends[k + 1])]
    if not places:
        return inside
    own = np.hstack([part for part in parts if part is not None])
    inside[:, places] = Q.T @ own
    rest = np.linalg.qr(own - Q @ inside[:, places], mode="r")
    below = np.zeros((len(rest), sum(sizes)))
    below[:, places] = rest
    return np.vstack([inside, below])
