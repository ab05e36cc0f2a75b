"""How the positions of a piece are spread over frequencies."""

from dataclasses import dataclass

import numpy as np

_NEVER = 5.0  # noise exceeds ln(n) + 5 means at none of n frequencies, in 99 of 100 spectra


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Of positions; n frequencies, J joints.

    Attributes:
        frequency: (n,) Hz, from 0 on.
        power: (n, J) variance of the positions at each frequency, rad^2 or m^2.
        white: (J,) what white noise contributes to each, on average.
    """

    frequency: np.ndarray
    power: np.ndarray
    white: np.ndarray

    @property
    def above(self) -> np.ndarray:
        """(n, J) power less the largest value that the white noise takes: 0 where it may be it."""
        largest = self.white * (np.log(len(self.frequency)) + _NEVER)
        return np.maximum(self.power - largest, 0.0)


def spectrum(positions: np.ndarray, step: float) -> Spectrum:
    """The periodogram of positions (samples, J): Hann window, trend removed.

    The white noise is the median over the upper half of the frequencies, where measured positions
    hold noise only, over ln 2: values of a periodogram of noise are exponentially distributed.
    """
    samples = len(positions)
    ramp = np.linspace(0.0, 1.0, samples)[:, None]
    # A straight line between the ends: the window would turn the trend into low frequencies.
    detrended = positions - (1.0 - ramp) * positions[:1] - ramp * positions[-1:]
    window = np.hanning(samples)
    transform = np.fft.rfft(detrended * window[:, None], axis=0)
    power = 2.0 * np.abs(transform) ** 2 / (samples * np.sum(window**2))
    white = np.median(power[len(power) // 2 :], axis=0) / np.log(2.0)
    return Spectrum(np.fft.rfftfreq(samples, step), power, white)
