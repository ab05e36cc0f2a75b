"""What makes an observation matrix good, as a number to minimise, and its slope by the matrix."""

from collections.abc import Callable

import numpy as np

Criterion = Callable[[np.ndarray], tuple[float, np.ndarray]]
"""From W (rows, c) to a value and its derivative by W; infinite if W lacks rank."""

_SHARP = 8  # power of the norm that stands for the largest singular value
_RANK = 1e-13


def log_condition(W: np.ndarray) -> tuple[float, np.ndarray]:
    """About log cond(W) with columns of length one; smooth.

    The p-norms of the singular values and of their inverses, p = 8, stand for the largest and the
    inverse of the smallest: log cond <= value <= log cond + log(c) / 4.
    """
    lengths = np.linalg.norm(W, axis=0)
    if len(W) < W.shape[1] or not lengths.min() > 0.0:
        return np.inf, W
    scaled = W / lengths
    sizes, turn = _sizes(scaled)
    if not sizes[-1] > _RANK * sizes[0]:
        return np.inf, W
    large = np.sum(sizes**_SHARP)
    small = np.sum((sizes[-1] / sizes) ** _SHARP)
    value = (np.log(large) + np.log(small)) / _SHARP - np.log(sizes[-1])
    slope = sizes ** (_SHARP - 1) / large - (sizes[-1] / sizes) ** _SHARP / (sizes * small)
    pull = scaled @ (turn * (slope / sizes)) @ turn.T
    # Lengths are one whatever W is: what changes them has no effect.
    return value, (pull - scaled * np.sum(pull * scaled, axis=0)) / lengths


def lost_information(W: np.ndarray) -> tuple[float, np.ndarray]:
    """-log det(W^T W) / (2 c): the mean log of the standard deviations, but for a constant."""
    columns = W.shape[1]
    if len(W) < columns:
        return np.inf, W
    R = np.linalg.qr(W, mode="r")
    diagonal = np.abs(np.diagonal(R))
    if not diagonal.min() > _RANK * diagonal.max():
        return np.inf, W
    inverse = np.linalg.solve(R, np.eye(columns))
    value = -float(np.sum(np.log(diagonal))) / columns
    return value, -(W @ inverse) @ inverse.T / columns


def balanced(W: np.ndarray) -> tuple[float, np.ndarray]:
    """The sum of both: well conditioned, and not by moving little."""
    (first, pull), (second, more) = log_condition(W), lost_information(W)
    return first + second, pull + more


CRITERIA: dict[str, Criterion] = {
    "both": balanced, "condition": log_condition, "information": lost_information,
}  # fmt: skip
"""By the name that a user gives."""


def condition(W: np.ndarray, scaled: bool = True) -> float:
    """cond(W), with columns of length one if `scaled`."""
    lengths = np.linalg.norm(W, axis=0) if scaled else np.ones(W.shape[1])
    if len(W) < W.shape[1] or not lengths.min() > 0.0:
        return float("inf")
    sizes = np.linalg.svd(np.linalg.qr(W, mode="r") / lengths, compute_uv=False)
    return float(sizes[0] / sizes[-1]) if sizes[-1] > 0.0 else float("inf")


def log_det(W: np.ndarray) -> float:
    """log det(W^T W), of the information matrix where rows are divided by their sigma."""
    with np.errstate(divide="ignore"):
        return 2.0 * float(np.sum(np.log(np.abs(np.diagonal(np.linalg.qr(W, mode="r"))))))


def _sizes(W: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Singular values and right singular vectors, as columns."""
    _, sizes, turned = np.linalg.svd(np.linalg.qr(W, mode="r"))
    return sizes, turned.T
