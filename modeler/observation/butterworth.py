"""The zero-phase Butterworth low-pass of order 4; scipy.signal takes long to load.

Each of its two sections is the bilinear transform of 1 / (s^2 + 2 s cos(theta) + 1), theta = pi/8
and 3 pi/8, with K = tan(pi cutoff step):

    y(n) + a1 y(n-1) + a2 y(n-2) = b (x(n) + 2 x(n-1) + x(n-2)),
    b = K^2 / c,  a1 = 2 (K^2 - 1) / c,  a2 = (1 - 2 K cos(theta) + K^2) / c,
    c = 1 + 2 K cos(theta) + K^2,

which is a triangular system of equations with three diagonals, and LAPACK solves it.
"""

import numpy as np
from scipy.linalg.lapack import dtbtrs

_ANGLES = (np.pi / 8.0, 3.0 * np.pi / 8.0)


def forwards_and_backwards(
    values: np.ndarray, step: float, cutoff: float, padding: int
) -> np.ndarray:
    """`values` (n, k) through the low-pass in time and then against it: twice 3 dB at the cut-off.

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
    there = _once(longer, step, cutoff)
    back = _once(there[::-1], step, cutoff)[::-1]
    return np.ascontiguousarray(back[padding : padding + len(values)])


def _once(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """Forwards, after the first value for ever: that is what all of it is measured from."""
    start = values[0].copy()
    y = np.asfortranarray(values - start)
    K = np.tan(np.pi * cutoff * step)
    diagonals = np.ones((3, len(values)), order="F")
    for angle in _ANGLES:
        damping = 2.0 * K * np.cos(angle)
        whole = 1.0 + damping + K * K
        diagonals[1] = 2.0 * (K * K - 1.0) / whole
        diagonals[2] = (1.0 - damping + K * K) / whole
        y, info = dtbtrs(diagonals, _driven(y, K * K / whole), uplo="L", diag="U", overwrite_b=1)
        assert info == 0
    return np.asarray(y + start)


def _driven(x: np.ndarray, b: float) -> np.ndarray:
    """b (x(n) + 2 x(n-1) + x(n-2)), 0 before the first."""
    total = x.copy(order="F")
    total[1:] += 2.0 * x[:-1]
    total[2:] += x[:-2]
    total *= b
    return total
