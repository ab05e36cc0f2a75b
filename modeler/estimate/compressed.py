"""The data of a fit as one small triangle per joint: everything else is computed from these."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Compressed:
    """R of [W_j y_j] = Q R for the rows of each joint; c columns, n joints.

    For any beta, ||y_j - W_j beta|| = ||R_j [-beta; 1]||: no row is needed again.

    Attributes:
        names: (c,) columns.
        triangles: (n, c + 1, c + 1).
        rows: (n,) rows of each joint.
        free: (n,) True for joints without a motor, whose torque is 0 by definition.
    """

    names: tuple[str, ...]
    triangles: np.ndarray
    rows: np.ndarray
    free: np.ndarray

    def residual_norms(self, beta: np.ndarray) -> np.ndarray:
        """(n,) ||y_j - W_j beta||, N m or N."""
        return np.linalg.norm(self.triangles @ np.append(-beta, 1.0), axis=1)

    def torque_norms(self) -> np.ndarray:
        """(n,) ||y_j||."""
        return np.linalg.norm(self.triangles[:, :, -1], axis=1)

    def whole(self, sigma: np.ndarray) -> np.ndarray:
        """Triangle (c + 1, c + 1) of all rows, those of joint j divided by sigma_j."""
        weighted = self.triangles / sigma[:, None, None]
        return triangle(weighted.reshape(-1, weighted.shape[2]))

    def without(self, names: Sequence[str]) -> "Compressed":
        """The same data without some columns."""
        kept = [i for i, name in enumerate(self.names) if name not in set(names)]
        return Compressed(
            tuple(self.names[i] for i in kept),
            self.triangles[:, :, [*kept, len(self.names)]],
            self.rows,
            self.free,
        )


def triangle(matrix: np.ndarray) -> np.ndarray:
    """R of matrix = Q R, (min(rows, columns), columns)."""
    return np.asarray(np.linalg.qr(matrix, mode="r"))


def merged(first: Compressed, second: Compressed) -> Compressed:
    """The rows of both: R of [R1; R2] per joint, as [W1 y1; W2 y2] has the same R^T R.

    Each triangle errs backwards by rounding of its own rows only, so any order of merging is as
    exact as one factorisation (Demmel, Grigori, Hoemmen and Langou 2012, SIAM J. Sci. Comput.
    34(1)); take a fixed order where equal runs must give equal bits.

    Args:
        first: of some rows.
        second: of other rows of the same columns and joints.
    """
    assert first.names == second.names and np.array_equal(first.free, second.free)
    stacked = np.concatenate([first.triangles, second.triangles], axis=1)
    triangles = np.stack([triangle(own) for own in stacked])
    return Compressed(first.names, triangles, first.rows + second.rows, first.free)


def compress(
    W: np.ndarray,
    y: np.ndarray,
    joint: np.ndarray,
    joints: int,
    names: Sequence[str],
    free: Sequence[int] = (),
) -> Compressed:
    """Compress y = W beta.

    Args:
        W: (rows, c).
        y: (rows,).
        joint: (rows,) index of the joint of each row.
        joints: number of joints.
        names: (c,).
        free: indices of the joints without a motor.
    """
    size = W.shape[1] + 1
    assert W.shape == (len(y), len(names)) and np.isfinite(W).all() and np.isfinite(y).all()
    triangles = np.zeros((joints, size, size))
    for j in range(joints):
        own = joint == j
        if own.any():
            own_triangle = triangle(np.column_stack([W[own], y[own]]))
            triangles[j, : len(own_triangle)] = own_triangle
    rows = np.bincount(joint, minlength=joints)
    return Compressed(tuple(names), triangles, rows, np.isin(np.arange(joints), free))
