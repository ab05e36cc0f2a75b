"""How fast the motion is, and the cut-offs that follow from it."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.observation.motion import HIGHEST
from modeler.observation.processing import Processing
from modeler.observation.ringing import Ringing, ringing
from modeler.observation.segments import Piece
from modeler.observation.weighted_median import weighted_median

SHARE = 0.99
"""The motion band holds this share of the energy of the velocity."""

POSITION_BANDS = 25.0
LEAST_POSITION = 30.0  # Hz
ENOUGH_POSITION = 100.0  # Hz; above it only 5 bands are kept: the rest would be noise
PARALLEL_BANDS = 4.0
LEAST_PARALLEL = 5.0  # Hz

_FLOOR = 10.0  # of exponentially distributed periodogram values, 0.1 % exceed 10 medians


Spectrum = tuple[np.ndarray, np.ndarray]
"""Frequencies (n,), Hz, and energies (n, J) of the velocities there."""


def motion_band(piece: Piece, spectrum: Spectrum) -> float:
    """Frequency below which 99 % of the velocity's energy lies, Hz; the fastest joint counts.

    What rings far above the motion is left out. The window's own width 2/T is taken off in
    quadrature, or a piece of half a second would look fast. 0 if nothing moves.

    Args:
        piece: of a log.
        spectrum: its velocity energy.
    """
    frequency, energy = spectrum
    bands = [0.0]
    for j in range(energy.shape[1]):
        own = energy[: ringing(frequency, energy[:, j], j)[1], j]
        if own.sum() > 0.0 and np.ptp(piece.q[:, j]) > 0.0:
            bands.append(float(frequency[np.searchsorted(np.cumsum(own), SHARE * own.sum())]))
    window = 2.0 / (len(piece.time) * piece.step)
    return float(np.sqrt(max(0.0, max(bands) ** 2 - window**2)))


def what_rings(spectra: Sequence[Spectrum]) -> list[Ringing]:
    """Joints that ring in the longest of some pieces, by their velocity energies."""
    if not spectra:
        return []
    frequency, energy = max(spectra, key=lambda spectrum: len(spectrum[0]))
    found = [ringing(frequency, energy[:, j], j)[0] for j in range(energy.shape[1])]
    return [ring for ring in found if ring is not None]


def velocity_energy(piece: Piece) -> Spectrum:
    """Frequencies (n,), Hz, and energy (n, J) of the velocities there, above the noise.

    From the periodogram P(f) of each position (Hann window, trend removed): energy of the velocity
    (2 pi f)^2 max(P - floor, 0), where floor is ten times the median of P over the upper half of
    the frequencies, where measured positions hold noise only.
    """
    samples = len(piece.time)
    ramp = np.linspace(0.0, 1.0, samples)[:, None]
    # A straight line between the ends: the window would turn the trend into low frequencies.
    detrended = piece.q - (1.0 - ramp) * piece.q[:1] - ramp * piece.q[-1:]
    spectrum = np.abs(np.fft.rfft(detrended * np.hanning(samples)[:, None], axis=0)) ** 2
    frequency = np.fft.rfftfreq(samples, piece.step)
    floor = _FLOOR * np.median(spectrum[len(frequency) // 2 :], axis=0)
    return frequency, np.maximum(spectrum - floor, 0.0) * frequency[:, None] ** 2


def choose_cutoffs(
    processing: Processing, pieces: Sequence[Piece], spectra: Sequence[Spectrum]
) -> tuple[Processing, tuple[str, ...]]:
    """The processing with both cut-offs chosen, and a sentence for each choice.

    Position filter: 25 times the motion band within 30 to 100 Hz, never less than 5 times, at most
    0.4 of the sampling rate; a filter too close to the motion looks like a flexible joint. Parallel
    filter: 4 times the motion band, at least 5 Hz, at most half the position filter. The EMPS
    benchmark, whose authors chose 100 Hz and 16 Hz by hand, comes out at 90 Hz and 14 Hz.

    Args:
        processing: what is given is kept.
        pieces: of all logs.
        spectra: their velocity energies.
    """
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    bands = np.array([motion_band(*pair) for pair in zip(pieces, spectra, strict=True)])
    band = weighted_median(bands, lengths)
    rate = 1.0 / float(np.median([piece.step for piece in pieces]))
    slowest = 1.0 / max(piece.step for piece in pieces)
    said = [f"motion band {band:.3g} Hz (99 % of the velocity's energy), sampled at {rate:.4g} Hz"]
    position = processing.position_cutoff
    logged = all(piece.qdd is not None for piece in pieces)
    unused = " (not needed: accelerations are logged)" if logged else ""
    if position is None:
        wanted = max(LEAST_POSITION, min(POSITION_BANDS * band, ENOUGH_POSITION), 5.0 * band)
        position = _two_digits(min(wanted, HIGHEST * slowest))
        said.append(
            f"position filter {position:g} Hz{unused}: {POSITION_BANDS:g} x the band within "
            f"{LEAST_POSITION:g} to {ENOUGH_POSITION:g} Hz, never less than 5 x, at most "
            f"{HIGHEST:g} of the sampling rate"
        )
    if not logged and 0.0 < position < 5.0 * band:
        said.append(
            f"position filter {position:g} Hz is less than 5 x the motion band: accelerations "
            "are damped; sample faster or move slower"
        )
    parallel = processing.parallel_cutoff
    if parallel is None:
        highest = 0.5 * (position or HIGHEST * slowest)
        parallel = _two_digits(min(max(LEAST_PARALLEL, PARALLEL_BANDS * band), highest))
        said.append(
            f"parallel filter {parallel:g} Hz: {PARALLEL_BANDS:g} x the band, at least "
            f"{LEAST_PARALLEL:g} Hz, at most half the position filter"
        )
    chosen = dataclasses.replace(processing, position_cutoff=position, parallel_cutoff=parallel)
    return chosen, tuple(said)


def _two_digits(value: float) -> float:
    return float(f"{value:.2g}")
