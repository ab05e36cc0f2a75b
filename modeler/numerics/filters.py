"""The parallel filter: one weighted mean for the torque and for every column of W."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dtbtrs
from scipy.ndimage import gaussian_filter1d
from scipy.sparse import csr_array

from modeler.core.json import ShortRepr
from modeler.numerics.thresholds import THRESHOLDS

SPREAD = 0.1325
"""Standard deviation of the Gaussian weights times the cut-off: its gain is -3 dB there."""

BANDWIDTH = 1.0645
"""Noise bandwidth for white noise, sqrt(pi) / (4 pi SPREAD), over the cut-off."""


LEAST_WEIGHT = 0.5
"""A row is used if at least this share of its weights falls on usable samples."""


@dataclass(frozen=True, eq=False)
class RowFilter(ShortRepr):
    """F in F y = F W beta: row k is the Gaussian-weighted mean of the samples around one sample.

    The equation holds for any F, so no choice of it biases beta. Weights are not negative and have
    a finite reach; samples that may not be used get weight 0 and the others are scaled up to sum
    one, so neither the ends of a segment nor a masked segment smears into its neighbours.

    Attributes:
        weights: (rows, samples) sparse, each row sums to at most 1.
        centres: (rows,) sample in the middle of each row.
    """

    weights: csr_array
    centres: np.ndarray

    @property
    def kernels(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns the weights of all rows, their samples, and where each row's begin."""
        return self.weights.data, self.weights.indices, self.weights.indptr

    def average_samples(self, values: np.ndarray, usable: np.ndarray) -> np.ndarray:
        """Averages values (samples, ...) over usable (samples,) by row: (rows, ...), 0 without any.

        As `runtime.average_rows`, which has such samples for each joint.
        """
        masked = restrict_weights(self.weights, usable)
        total = masked @ np.ones(len(usable))
        flat = masked @ values.reshape(len(values), -1)
        flat = flat / np.where(total > 0.0, total, 1.0)[:, None]
        return flat.reshape(len(self.centres), *values.shape[1:])

    def find_sample_range(self, rows: slice) -> slice:
        """Finds the range of samples that those rows average."""
        start, stop = self.weights.indptr[rows.start], self.weights.indptr[rows.stop]
        reached = self.weights.indices[start:stop]
        return slice(int(reached.min()), int(reached.max()) + 1)

    def extract_rows(self, rows: slice, window: slice) -> "RowFilter":
        """Returns the same filter for some rows, over a window of the samples."""
        return RowFilter(self.weights[rows, window], self.centres[rows] - window.start)

    def compute_usable_share(self, usable: np.ndarray) -> np.ndarray:
        """Returns (rows, joints) share of each row's weight on usable samples (samples, joints)."""
        return (self.weights @ usable.astype(float)) / self.weights.sum(axis=1)[:, None]


def restrict_weights(weights: csr_array, usable: np.ndarray) -> csr_array:
    """Returns the weights (rows, samples) with 0 for samples that are not usable (samples,)."""
    data = weights.data * usable[weights.indices]
    return csr_array((data, weights.indices, weights.indptr), shape=weights.shape)


def choose_row_spacing(step: float, cutoff: float, decimation: int | None) -> int:
    """Chooses the samples from one row to the next; halves are rounded up.

    Args:
        step: s.
        cutoff: Hz at -3 dB; 0 for none.
        decimation: samples per row; None: `rows_per_cutoff_period` rows per period.
    """
    if decimation is None:
        rate = THRESHOLDS.rows_per_cutoff_period * cutoff * step
        return max(1, round(THRESHOLDS.clock_rounding / rate)) if rate > 0.0 else 1
    return decimation


def compute_reach(step: float, cutoff: float) -> int:
    """Returns the samples on either side of a row's centre that have a weight."""
    spread = SPREAD / (cutoff * step) if cutoff > 0.0 else 0.0
    if spread > THRESHOLDS.min_kernel_samples:
        return int(np.ceil(THRESHOLDS.kernel_reach * spread))
    return 0


def build_row_filter(centres: np.ndarray, samples: int, step: float, cutoff: float) -> RowFilter:
    """Builds the filter of a segment of `samples` samples, rows centred on some of them (rows,)."""
    spread = SPREAD / (cutoff * step) if cutoff > 0.0 else 0.0  # samples
    reach = compute_reach(step, cutoff)
    offsets = np.arange(-reach, reach + 1)
    bell = np.exp(-0.5 * (offsets / spread) ** 2) if reach else np.ones(1)
    bell = bell / bell.sum()
    places = centres[:, None] + offsets
    there = (places >= 0) & (places < samples)
    starts = np.append(0, np.cumsum(there.sum(axis=1)))
    weights = np.broadcast_to(bell, there.shape)[there], places[there], starts
    return RowFilter(csr_array(weights, shape=(len(centres), samples)), centres)


def compute_moving_means(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """Computes (samples, ...) the rows of `build_row_filter` centred on every sample.

    Outside the segment values count as 0: divide by the same means of ones.

    Args:
        values: (samples, ...).
        step: s.
        cutoff: Hz at -3 dB; 0 for none.
    """
    spread = SPREAD / (cutoff * step) if cutoff > 0.0 else 0.0
    if spread <= THRESHOLDS.min_kernel_samples:
        return values
    reach = int(np.ceil(THRESHOLDS.kernel_reach * spread))
    return np.asarray(gaussian_filter1d(values, spread, axis=0, mode="constant", radius=reach))


# The zero-phase Butterworth low-pass of order 4; scipy.signal takes long to load.
#
# Each of its two sections is the bilinear transform of 1 / (s^2 + 2 s cos(theta) + 1), theta = pi/8
# and 3 pi/8, with K = tan(pi cutoff step):
#
#     y(n) + a1 y(n-1) + a2 y(n-2) = b (x(n) + 2 x(n-1) + x(n-2)),
#     b = K^2 / c,  a1 = 2 (K^2 - 1) / c,  a2 = (1 - 2 K cos(theta) + K^2) / c,
#     c = 1 + 2 K cos(theta) + K^2,
#
# which is a triangular system of equations with three diagonals, and LAPACK solves it.


_ANGLES = (np.pi / 8.0, 3.0 * np.pi / 8.0)


def apply_zero_phase_lowpass(
    values: np.ndarray, step: float, cutoff: float, padding: int
) -> np.ndarray:
    """Filters `values` (n, k) by the low-pass forwards and backwards: twice 3 dB at the cut-off.

    As scipy.signal.sosfiltfilt of butter(4, ...): both ends are extended, turned about the last
    value, and the filter starts as if the first value of that had been there for ever.

    Args:
        values: (n, k).
        step: s.
        cutoff: Hz, below the Nyquist frequency.
        padding: samples of the extensions, fewer than n.
    """
    before = 2.0 * values[0] - values[1 : padding + 1][::-1]
    after = 2.0 * values[-1] - values[::-1][1 : padding + 1]
    longer = np.concatenate([before, values, after])
    there = _apply_lowpass(longer, step, cutoff)
    back = _apply_lowpass(there[::-1], step, cutoff)[::-1]
    return np.ascontiguousarray(back[padding : padding + len(values)])


def _apply_lowpass(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """Forwards, after the first value for ever: that is what all of it is measured from."""
    start = values[0].copy()
    y = np.asfortranarray(values - start)
    K = np.tan(np.pi * cutoff * step)
    for angle in _ANGLES:
        damping = 2.0 * K * np.cos(angle)
        whole = 1.0 + damping + K * K
        driven = _compute_forward_terms(y, (1.0, 2.0, 1.0))
        driven *= K * K / whole
        y = _solve_recursion(driven, 2.0 * (K * K - 1.0) / whole, (1.0 - damping + K * K) / whole)
    return np.asarray(y + start)


def apply_biquad(x: np.ndarray, b: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Solves y(n) + a1 y(n-1) + a2 y(n-2) = b0 x(n) + b1 x(n-1) + b2 x(n-2), 0 before x (n,)."""
    return np.asarray(_solve_recursion(_compute_forward_terms(x[:, None], b), a[1], a[2])[:, 0])


def _solve_recursion(driven: np.ndarray, a1: float, a2: float) -> np.ndarray:
    """y (n, k) of y(n) + a1 y(n-1) + a2 y(n-2) = driven (n, k), which is overwritten."""
    diagonals = np.ones((3, len(driven)), order="F")
    diagonals[1], diagonals[2] = a1, a2
    y, info = dtbtrs(diagonals, driven, uplo="L", diag="U", overwrite_b=1)
    assert info == 0
    return np.asarray(y)


def _compute_forward_terms(x: np.ndarray, b: Sequence[float] | np.ndarray) -> np.ndarray:
    """b0 x(n) + b1 x(n-1) + b2 x(n-2), 0 before the first."""
    total = np.asfortranarray(b[0] * x) if b[0] != 1.0 else x.copy(order="F")
    total[1:] += b[1] * x[:-1]
    total[2:] += b[2] * x[:-2] if b[2] != 1.0 else x[:-2]
    return total
