"""Drive gains and parameters together: mixed total least squares with one gain for each drive.

The rows of drive j are g_j V = W beta + m w, with V the measured current, g_j its torque per unit
and w the torque of a known load, per unit of m = 1. V alone is noisy, so

    [-V_1 .. -V_n | W | w] X = 0,   X = [g_1 .. g_n | beta | m],

is no least-squares problem: with V on the right-hand side of nothing, X = 0 would solve it, and
with m w there, the noise of V pulls every gain to 0. X is the null vector of the matrix nearest to
it that has one, V changed and W not (mixed LS-TLS, Van Huffel and Vandewalle 1991, ch. 3; for
drive gains Gautier and Briot 2012). The load of known size sets the length of X.
"""

from dataclasses import dataclass

import numpy as np

from modeler.estimation.least_squares import least_squares, solve_by_qr
from modeler.numerics.least_squares import Compressed, Rank, independent_columns, triangle

MAX_ITERATIONS = 30  # a dozen is enough where the gains are told
_SETTLED = 1e-9  # relative change of the gains
_SMALLEST = 1e-12  # singular values below are rounding


@dataclass(frozen=True, eq=False)
class GainEstimate:
    """The solution; n joints, d of them driven, c columns.

    Attributes:
        gains: (n,) torque per unit of V; 1 for joints without a motor; NaN if nothing bounds them.
        beta: (c,) of all columns, with `known` at its place; 0 for those set aside.
        covariance: (d + c, d + c) of the gains of the driven joints and of beta, for white
            residuals; 0 for columns set aside and for the known one; its diagonal infinite where
            nothing bounds them.
        sigma: (n,) standard deviation of a row of each joint, N m or N.
        rank: columns kept and set aside.
        singular: (d,) singular values of what W leaves of V, descending, every column of V in
            units of its noise: a combination of currents that is all noise has 1.
        vague: (n,) shares of the drives in the combination of the last but one singular value.
        settled: weights and gains reached their fixed point.
    """

    gains: np.ndarray
    beta: np.ndarray
    covariance: np.ndarray
    sigma: np.ndarray
    rank: Rank
    singular: np.ndarray
    vague: np.ndarray
    settled: bool

    @property
    def gap(self) -> float:
        """s[-2] / s[-1]; infinite with one drive, or without noise."""
        if len(self.singular) < 2 or self.singular[-1] <= _SMALLEST * self.singular[-2]:
            return float("inf")
        return float(self.singular[-2] / self.singular[-1])


def mixed_tls(data: Compressed, known: int, value: float = 1.0) -> GainEstimate | None:
    """Gains and beta of diag(g) V = W beta; None if W cannot tell the known column from others.

    QR takes the columns without noise away, [W | -V] = Q [R11 R12; 0 R22]; the gains are the
    smallest right singular vector of R22, and beta = -R11^-1 R12 g. Rows of drive j are divided by
    the standard deviation sigma_j of its residual, and column j of V by that of its own noise,
    sigma_j / g_j: both are iterated. At the fixed point g and beta are those of greatest
    likelihood for white noise of V (its equations are r_j^T V_j g_j = r_j^T r_j, r = g V - W beta),
    and the result does not depend on the units of the drives.

    Args:
        data: compressed rows of W and V; W includes the column of the known load.
        known: index of that column.
        value: of its parameter.
    """
    units = np.where(data.free, 1.0, data.torque_rms())
    scaled = _with_torque(data, 1.0 / np.where(units > 0.0, units, 1.0))
    size = np.linalg.norm(data.triangles[:, :, :-1], axis=(1, 2)) + 1e-300
    sigma = np.where(data.free & (data.torque_rms() == 0.0), size, 1.0)
    whole = scaled.whole(sigma)[:, :-1]
    rank = independent_columns(whole, data.names)
    others = [i for i in range(len(data.names)) if i != known]
    without = independent_columns(whole[:, others], [data.names[i] for i in others])
    if known not in rank.kept or len(without.kept) == len(rank.kept):
        return None
    kept = np.asarray(rank.kept, dtype=int)
    gains, settled, iterations = np.ones(len(units)), False, 0
    sigma = least_squares(data).sigma
    while not settled and iterations < MAX_ITERATIONS:
        beta, updated, singular, vague = _solve(data, kept, sigma, gains)
        length = value / beta[known] if beta[known] else 1.0
        beta, updated = length * beta, np.where(data.free, 1.0, length * updated)
        if not (np.isfinite(updated).all() and updated.all()):
            gains = np.full(len(gains), np.nan)  # nothing holds them: they run to 0, or away
            break
        settled = bool(np.all(np.abs(updated / gains - 1.0) < _SETTLED))
        gains, iterations = updated, iterations + 1
        sigma = _spread(data, gains, known, value)
    covariance = _covariance(data, kept, known, gains, beta, sigma)
    return GainEstimate(gains, beta, covariance, sigma, rank, singular, vague, settled)


def _stacked(
    data: Compressed, kept: np.ndarray, sigma: np.ndarray, torque: np.ndarray
) -> np.ndarray:
    """[W | V] over sigma: kept columns, then one for each drive with its torque (n, c + 1)."""
    driven, c = np.flatnonzero(~data.free), len(kept)
    stacked = np.zeros((*data.triangles.shape[:2], c + len(driven)))
    stacked[:, :, :c] = data.triangles[:, :, kept] / sigma[:, None, None]
    stacked[driven, :, c + np.arange(len(driven))] = torque[driven]
    return stacked.reshape(-1, stacked.shape[2])


def _solve(
    data: Compressed, kept: np.ndarray, sigma: np.ndarray, gains: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """One mixed LS-TLS with given weights and given noise of the columns of V.

    Returns the null vector, of any length, beta (c,) and gains (n,); singular (d,); vague (n,).
    """
    n, c = len(data.rows), len(kept)
    driven = np.flatnonzero(~data.free)
    noise = np.abs(gains) / np.sqrt(np.maximum(data.rows, 1))
    torque = -data.triangles[:, :, -1] * noise[:, None] / sigma[:, None]
    stacked = _stacked(data, kept, sigma, torque)
    lengths = np.linalg.norm(stacked[:, :c], axis=0)
    stacked[:, :c] /= lengths
    R = triangle(stacked)
    _, singular, right = np.linalg.svd(R[c:, c:])
    u = right[-1]
    found, beta = np.ones(n), np.zeros(len(data.names))
    found[driven] = noise[driven] * u
    beta[kept] = -np.linalg.solve(R[:c, :c], R[:c, c:] @ u) / lengths
    vague = np.zeros(n)
    vague[driven] = np.abs(right[-2]) if len(driven) > 1 else 0.0
    return beta, found, singular, vague


def _with_torque(data: Compressed, gains: np.ndarray) -> Compressed:
    """The data with the right-hand side of joint j multiplied by gains[j]."""
    triangles = data.triangles.copy()
    triangles[:, :, -1] *= gains[:, None]
    return Compressed(data.names, triangles, data.rows, data.free)


def _spread(data: Compressed, gains: np.ndarray, known: int, value: float) -> np.ndarray:
    """(n,) standard deviation of the rows with these gains, of the weighted fit of the others."""
    right = _with_torque(data, gains)
    right.triangles[:, :, -1] -= value * data.triangles[:, :, known]
    return least_squares(right.without([data.names[known]])).sigma


def _covariance(
    data: Compressed,
    kept: np.ndarray,
    known: int,
    gains: np.ndarray,
    beta: np.ndarray,
    sigma: np.ndarray,
) -> np.ndarray:
    """(J^T S^-1 J)^-1 with J = [-V | W], V without its noise: W beta / g; the known one left out.

    With the measured V in J, its noise would count as information.
    """
    driven = np.flatnonzero(~data.free)
    d = len(driven)
    kept = kept[kept != known]
    torque = -(data.triangles[:, :, :-1] @ beta) / gains[:, None] / sigma[:, None]
    R = triangle(np.roll(_stacked(data, kept, sigma, torque), d, axis=1))
    places = np.concatenate([np.arange(d), d + kept])
    covariance = np.zeros((d + len(beta),) * 2)
    lengths = np.linalg.norm(R, axis=0)  # 0 for the gain of a joint whose torque is noise
    if not (np.isfinite(R).all() and lengths.all()) or np.linalg.cond(R / lengths) > 1e12:
        covariance[places, places] = np.inf
        return covariance
    _, root = solve_by_qr(R, np.zeros(len(R)))
    covariance[np.ix_(places, places)] = root @ root.T
    return covariance
