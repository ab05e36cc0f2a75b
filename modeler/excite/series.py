"""Motions that are finite Fourier series, at rest where they begin and end."""

from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief

DENSE = 32
"""Samples per period of the highest harmonic."""


@dataclass(frozen=True, eq=False)
class Series(Brief):
    """q_j(t) = V(t) x_j: periodic, and with no speed and no acceleration at t = 0.

    A finite Fourier series (Swevers et al. 1997, IEEE Trans. Robotics and Automation 13(5),
    eq. 8) of which two coefficients are given away: sum k b_k = 0 and sum k^2 a_k = 0. So it may be
    repeated, and a controller may also start it from rest and stop after it.

    Attributes:
        duration: of a period, s.
        harmonics: K, the highest.
        time: (n,) s, evenly over the period.
        values, slopes, bends: (n, 2 K - 1) V and its derivatives; the first column of V is 1.
    """

    duration: float
    harmonics: int
    time: np.ndarray
    values: np.ndarray
    slopes: np.ndarray
    bends: np.ndarray

    @property
    def room(self) -> float:
        """No value between the samples is larger than the largest at one over this.

        A trigonometric polynomial of degree K is at least cos(pi K / n) of its largest value at
        one of n even places: it falls no faster than a cosine of its own degree from its peak.
        """
        return float(np.cos(np.pi * self.harmonics / len(self.time)))

    def motion(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(n, joints) q, qd and qdd of (joints, 2 K - 1) coefficients."""
        return self.values @ x.T, self.slopes @ x.T, self.bends @ x.T


def series(
    duration: float, harmonics: int, times: np.ndarray | None = None, dense: int = DENSE
) -> Series:
    """The series over a period, at even times; at `times` (s) if given."""
    if times is None:
        count = dense * harmonics
        times = np.arange(count) * (duration / count)
    k = np.arange(1, harmonics + 1)
    omega = 2.0 * np.pi * k / duration
    phase = np.outer(times, omega)
    cosine, sine, none = np.cos(phase) / k, np.sin(phase) / k, np.zeros((len(times), 1))
    waves = (
        np.hstack([none + 1.0, cosine, sine]),
        np.hstack([none, -omega * sine, omega * cosine]),
        np.hstack([none, -(omega**2) * cosine, -(omega**2) * sine]),
    )
    resting = _resting(harmonics)
    return Series(duration, harmonics, times, *(wave @ resting for wave in waves))


def _resting(harmonics: int) -> np.ndarray:
    """(2 K + 1, 2 K - 1) orthonormal coefficients with no speed and acceleration at 0."""
    k = np.arange(1.0, harmonics + 1)
    basis = np.zeros((2 * harmonics + 1, 2 * harmonics - 1))
    basis[0, 0] = 1.0
    for begin, row in ((1, k), (1 + harmonics, np.ones(harmonics))):  # of a_k / k and b_k / k
        free = np.linalg.svd(row[None, :])[2][1:].T
        at = 1 if begin == 1 else harmonics
        basis[begin : begin + harmonics, at : at + harmonics - 1] = free
    return basis
