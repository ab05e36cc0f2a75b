"""Instrumental variables: what the noise of the measured motion cannot bias."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.estimate.compressed import triangle
from modeler.estimate.least_squares import Estimate, Influence, least_sigma, least_squares
from modeler.estimate.problem import Problem
from modeler.estimate.rank import independent_columns

_ITERATIONS = 200
_SETTLED = 1e-9  # relative change of the weights
_BLIND = 1e-6  # smallest singular value of Qz^T Qw at which instruments tell nothing of a column
_WEAK = 0.3  # and at which they tell so little that it is said


@dataclass(frozen=True, eq=False)
class _Solved:
    """beta = P S^-1/2 y, k columns kept."""

    beta: np.ndarray
    P: np.ndarray  # (k, rows)
    cosine: float  # between the spaces of W and of the instruments, the smallest
    worst: int  # the column that they carry least of
    whole: np.ndarray  # (k, k + 1) projected equations


def with_instruments(problem: Problem, Z: np.ndarray, method: str) -> Estimate:
    """beta = (Z^T S^-1 W)^-1 Z^T S^-1 y, S = diag sigma_j^2 of y - W beta, iterated.

    Consistent where the instruments Z are uncorrelated with the noise of y and of W; the covariance
    is (Z^T S^-1 W)^-1 Z^T S^-1 Z (W^T S^-1 Z)^-1 (Young 2011; Janot, Vandanjon and Gautier 2014,
    IEEE Trans. Control Systems Technology 22(1)).

    Args:
        problem: beta in the units of its columns, y N m or N.
        Z: (rows, c) the columns of W along a motion that the noise did not touch.
        method: for the refusal, DataError, of instruments that tell nothing of a parameter.
    """
    counted, joint = problem.counted, problem.joint[problem.counted]
    start = least_squares(problem.data, "weighted")
    kept = np.asarray(start.rank.kept, dtype=int)
    W, Z, y = problem.W[counted][:, kept], Z[counted][:, kept], problem.y[counted]
    _check(problem, method, Z, kept)
    sigma, settled, iterations = start.sigma, False, 0
    while not settled and iterations < _ITERATIONS:
        found = _solved(W, Z, y, sigma[joint])
        if found.cosine < _BLIND:
            raise DataError(_refusal(method, problem.names[kept[found.worst]]))
        before, sigma = sigma, _spread(problem, W, y, found, sigma, start)
        settled = bool(np.all(np.abs(sigma / before - 1.0) < _SETTLED))
        iterations += 1
    beta, covariance = np.zeros_like(start.beta), np.zeros_like(start.covariance)
    beta[kept], covariance[np.ix_(kept, kept)] = found.beta, found.P @ found.P.T
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        sigma=sigma,
        iterations=iterations,
        settled=settled,
        sentences=_weak(found.cosine),
        influence=_influence(problem, kept, found.P / sigma[joint], beta),
        whole=_whole(problem, kept, found, (y - W @ found.beta) / sigma[joint]),
    )


def _solved(W: np.ndarray, Z: np.ndarray, y: np.ndarray, sigma: np.ndarray) -> _Solved:
    lengths = np.linalg.norm(W / sigma[:, None], axis=0)
    X, y = W / sigma[:, None] / lengths, y / sigma
    far = np.linalg.norm(Z / sigma[:, None], axis=0)
    Qz, _ = np.linalg.qr(Z / sigma[:, None] / np.where(far > 0.0, far, 1.0))
    Qw, Rw = np.linalg.qr(X)
    across = Qz.T @ Qw
    cosine = float(np.linalg.svd(across, compute_uv=False).min(initial=1.0))
    across = across @ Rw
    worst = int(np.argmin(np.linalg.norm(across, axis=0)))
    P = np.linalg.lstsq(across, Qz.T, rcond=None)[0] / lengths[:, None]
    whole = np.column_stack([across * lengths, Qz.T @ y])
    return _Solved(P @ y, P, cosine, worst, whole)


def _spread(
    problem: Problem,
    W: np.ndarray,
    y: np.ndarray,
    found: _Solved,
    sigma: np.ndarray,
    start: Estimate,
) -> np.ndarray:
    """(n,) sigma_j^2 = |r_j|^2 / (rows_j - h_j), h_j the trace of joint j's part of W P."""
    data, joint = problem.data, problem.joint[problem.counted]
    n = len(data.rows)
    scaled = np.einsum("rk,kr->r", W / sigma[joint][:, None], found.P)
    share = np.bincount(joint, scaled, n)
    squares = np.bincount(joint, (y - W @ found.beta) ** 2, n)
    spread = np.sqrt(squares / np.maximum(data.rows - share, 0.5))
    spread = np.where(data.free | (data.rows == 0), start.sigma, spread)
    return np.maximum(spread, least_sigma(data))


def _influence(problem: Problem, kept: np.ndarray, pull: np.ndarray, beta: np.ndarray) -> Influence:
    every = np.zeros(problem.W.shape)
    every[np.ix_(problem.counted, kept)] = pull.T
    return Influence(every, problem.y - problem.W @ beta)


def _whole(problem: Problem, kept: np.ndarray, found: _Solved, residual: np.ndarray) -> np.ndarray:
    """Equations Qz^T S^-1/2 W beta = Qz^T S^-1/2 y, which beta satisfies, above what it leaves."""
    c = len(problem.names)
    whole = np.zeros((c + 1, c + 1))
    whole[np.ix_(np.arange(len(kept)), np.append(kept, c))] = found.whole
    whole[-1, -1] = np.linalg.norm(residual)
    return whole


def _check(problem: Problem, method: str, Z: np.ndarray, kept: np.ndarray) -> None:
    """Refuse instruments that depend on each other where the columns do not."""
    names = [problem.names[i] for i in kept]
    aside = independent_columns(triangle(Z), names).aside
    if aside:
        raise DataError(_refusal(method, aside[0].name))


def _refusal(method: str, name: str) -> str:
    return (
        f'method "{method}": the instruments tell nothing of a parameter; got it for {name}; '
        'expected a commanded motion that moves all joints as the log does; use method "weighted"'
    )


def _weak(cosine: float) -> tuple[str, ...]:
    if cosine > _WEAK:
        return ()
    return (
        f"the instruments are weak: of one combination of parameters they carry {cosine:.2g} of "
        "its column; noise then biases it as without instruments, and its sigma is too small",
    )
