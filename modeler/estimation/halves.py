"""Do halves of the motion tell the same values? Where not, an effect is missing in some of them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.estimation.least_squares import Estimate, solve_by_qr
from modeler.numerics.least_squares import Compressed, triangle
from modeler.observation.observation import Observation

_FAR = 4.5  # standard deviations; noise alone reaches it in one of 1e5 differences
_NEAR = 3.0  # where most of the residual is no noise
_FELT = 2.0  # where another value differs so far
_MOST = 0.5  # of its variance: lasts from row to row


@dataclass(frozen=True)
class Halves:
    """What differs.

    Attributes:
        factors: (c,) on the standard deviations, 1 and more.
        worst: index of the column that differs by most standard deviations, the joint and the
            signal whose halves say so, and by how many; None where nothing does.
    """

    factors: np.ndarray
    worst: tuple[int, int, str, float] | None = None

    def sentences(self, names: Sequence[str], joints: Sequence[str]) -> list[str]:
        """One, if something differs."""
        if self.worst is None:
            return []
        column, joint, signal, apart = self.worst
        why = (
            "by more than noise: an effect is missing, and `modeler diagnose` names it"
            if apart > _FAR
            else "and most of the residual lasts from row to row: noise that remembers, or an "
            "effect that is missing; `modeler diagnose` tells which"
        )
        return [
            f"joint {joints[joint]}: rows of little and of much {signal} tell different "
            f"{names[column]}, {why}; the sigmas are raised for it, by up to a factor "
            f"{self.factors.max():.2g} ({names[int(self.factors.argmax())]})"
        ]


def halves(
    observation: Observation,
    compressed: Callable[[np.ndarray], Compressed],
    counted: np.ndarray,
    estimate: Estimate,
    sigma: np.ndarray,
    lasting: np.ndarray,
    loaded: np.ndarray | None = None,
) -> Halves:
    """By how much values that differ between halves of the motion raise the standard deviations.

    With all effects in the model, beta without some rows differs from beta by noise, of covariance
    C_k - C (Hausman 1978, Econometrica 46). Left out are, joint by joint, its rows below or above
    the mean of its |qd|, of q, of |tau|, and those with or without a load. Where a difference d_k
    is more than chance, the mean of d_k^2, weighed by how well either half tells the parameter,
    less what noise makes of it, is added to the variance: the error that an effect makes which is
    missing in slow motion only is then in sigma.

    Args:
        observation: says which row is which.
        compressed: of some rows (rows,), the equations.
        counted: (rows,) that were fitted.
        estimate: its joint weights and kept columns are taken.
        sigma: (c,) standard deviations so far, memory of the residuals included.
        lasting: (n,) autocorrelation of the residual of each joint over one row.
        loaded: (rows,) True where a load is carried; None: nowhere.
    """
    kept, row = np.array(estimate.rank.kept, dtype=int), observation.row_sample
    every = {"speed": np.abs(observation.qd), "position": observation.q,
             "torque": np.abs(observation.torque)}  # fmt: skip
    signals = {name: values[row, observation.row_joint] for name, values in every.items()}
    signals |= {} if loaded is None else {"load": loaded.astype(float)}
    added, farthest, worst = np.zeros(len(sigma)), 0.0, None
    for name, values in signals.items():
        count = np.bincount(observation.row_joint[counted], None, len(estimate.sigma))
        total = np.bincount(observation.row_joint[counted], values[counted], len(count))
        low = values < (total / np.maximum(count, 1))[observation.row_joint]
        parts = [compressed(counted & own) for own in (low, ~low)]
        R = [part.triangles / estimate.sigma[:, None, None] for part in parts]
        R = [own[:, :, [*kept, -1]] for own in R]
        beta, var = _solved([*R[0], *R[1]])
        if beta is None:
            break
        raised = np.maximum((sigma[kept] ** 2) / var, 1.0)
        for j in range(len(observation.joints)):
            found = [_solved([*np.delete(R[k], j, 0), *R[1 - k]]) for k in (0, 1)]
            if any(b is None for b, _ in found) or not all(part.rows[j] for part in parts):
                continue
            d = np.array([b - beta for b, _ in found])
            noise = raised * np.maximum(np.array([v for _, v in found]) - var, 1e-6 * var)
            z = np.abs(d) / np.sqrt(noise)
            weight = 1.0 / np.array([v for _, v in found])
            more = np.sum(weight * (d**2 - noise), axis=0) / weight.sum(axis=0)
            z = z.max(axis=0)
            if z.max() < (_NEAR if lasting[j] > _MOST else _FAR):
                continue
            added[kept] = np.maximum(added[kept], np.where(z > _FELT, more, 0.0))
            if z.max() > farthest:
                farthest, in_rows = float(z.max()), (R[0][j] != 0.0).any(axis=0)[:-1]
                worst = int(kept[np.where(in_rows, z, 0.0).argmax()]), j, name, farthest
    square = np.where(sigma > 0.0, sigma, 1.0) ** 2
    return Halves(np.sqrt(1.0 + added / square), worst)


def _solved(blocks: list[np.ndarray]) -> tuple[np.ndarray | None, np.ndarray]:
    """beta (k,) of weighted triangles [W y], and its white variances; None if they do not tell."""
    whole = triangle(np.vstack(blocks))
    W = whole[:, :-1]
    lengths = np.linalg.norm(W, axis=0)
    if len(W) < W.shape[1] or not lengths.all() or np.linalg.cond(W / lengths) > 1e7:
        return None, lengths
    beta, root = solve_by_qr(W, whole[:, -1])
    return beta, np.sum(root**2, axis=1)
