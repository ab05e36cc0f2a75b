"""Which part of the measured positions is motion, joint by joint."""

from collections.abc import Sequence

import numpy as np

from modeler.numerics.spectra import MotionSpectrum, motion_spectrum
from modeler.observation.excitation import ringing
from modeler.observation.segments import Piece

SHARE = 0.99
"""The motion band holds this share of the energy of the velocity."""

VALLEY = 4.0
"""Over an octave the position's energy is lower by this than that of motion and of trembling."""

APART = 4.0
"""Times the band of the joints' median: a joint that is faster may be one that trembles."""

TREMBLING = 0.05
"""Rms position of what is apart from the motion over that of the motion: below, it is none."""

REST = 0.01
"""Rms position over that of the joint that moves most: a joint at rest has less."""

_STEPS = 6  # per octave


def motion_bands(piece: Piece, measured: MotionSpectrum) -> np.ndarray:
    """(J, 3) what moves in one piece, whatever its noise; J joints.

    The band below which 99 % of the velocity's energy lies, Hz, NaN of joints at rest; the same
    with what trembles, without what rings; and the rms of the position that is not motion.

    What counts is the power above white noise, up to where the joint rings or trembles; where
    positions were commanded, up to the band of the command. The window's own width 2/T is taken
    off in quadrature, or a piece of half a second would look fast.

    Args:
        piece: of a log.
        measured: spectrum of its positions.
    """
    frequency, above = measured.frequency, measured.above
    joints = range(above.shape[1])
    speed = above * frequency[:, None] ** 2
    rings = [ringing(frequency, speed[:, j], j)[1] for j in joints]
    ends = [_end(frequency[:n], above[:n, j]) for j, n in zip(joints, rings, strict=True)]
    size = np.array([np.sqrt(above[: ends[j], j].sum()) for j in joints])
    moves = (size > REST * size.max()) & (np.ptp(piece.q, axis=0) > 0.0)
    ends = _together(frequency, above, ends, moves)
    left = [measured.power[ends[j] :, j].sum() + ends[j] * measured.white[j] for j in joints]
    window = 2.0 / (len(piece.time) * piece.step)
    bands = (
        np.fmin(_bands(frequency, above, ends), _commanded(piece)),
        _bands(frequency, above, rings),
    )
    band, shaken = (np.sqrt(np.maximum(0.0, own**2 - window**2)) for own in bands)
    return np.column_stack([np.where(moves, band, np.nan), shaken, np.sqrt(left)])


def _together(
    frequency: np.ndarray, above: np.ndarray, ends: list[int], moves: np.ndarray
) -> list[int]:
    """The ends of the motion, where a joint that is far faster than the others only trembles.

    The joints of a robot are moved together: what one of them does beyond `APART` bands of their
    median, and does a little of, is noise of any colour.
    """
    if not moves.any():
        return ends
    band = _bands(frequency, above, ends)
    most = int(np.searchsorted(frequency, APART * np.median(band[moves])))
    return [
        most if most < end and own > frequency[most] and _small(above[:end, j], most) else end
        for j, (end, own) in enumerate(zip(ends, band, strict=True))
    ]


def _bands(frequency: np.ndarray, power: np.ndarray, ends: Sequence[int]) -> np.ndarray:
    """(J,) energy bands of the power (n, J) before each joint's end."""
    return np.array([energy_band(frequency[:n], power[:n, j]) for j, n in enumerate(ends)])


def energy_band(frequency: np.ndarray, power: np.ndarray) -> float:
    """Frequency below which 99 % of the velocity's energy lies, Hz; 0 without any.

    Args:
        frequency: (n,) Hz.
        power: (n,) of the position.
    """
    total = np.cumsum(power * frequency**2)
    return float(frequency[np.searchsorted(total, SHARE * total[-1])]) if total[-1] > 0.0 else 0.0


def _commanded(piece: Piece) -> np.ndarray:
    """(J,) band of the commanded positions, Hz; NaN where none is known, or none moves."""
    if piece.commanded is None:
        return np.full(piece.q.shape[1], np.nan)
    command = motion_spectrum(piece.commanded, piece.step)
    size = np.sqrt(command.above.sum(axis=0))
    band = [energy_band(command.frequency, own) for own in command.above.T]
    return np.where(size > REST * size.max(), band, np.nan)


def _end(frequency: np.ndarray, above: np.ndarray) -> int:
    """Index of the first frequency that is not motion.

    Motion fades with frequency, noise and shaking grow before they fade: the position's energy per
    octave has a wide valley between them. What stands behind it is motion unless it is small.

    Args:
        frequency: (n,) Hz.
        above: (n,) power of the position above white noise.
    """
    if len(frequency) < 3 or not above.any():
        return len(frequency)
    octaves = np.log2(frequency[-1] / frequency[1])
    grid = frequency[1] * 2.0 ** np.arange(0.0, octaves, 1.0 / _STEPS)
    energy = _per_octave(frequency, above, grid)
    start = int(np.argmax(energy))
    while (valley := _valley(energy[start:])) is not None:
        first, last = (start + place for place in valley)
        bottom = grid[first + int(np.argmin(energy[first : last + 1]))]
        parted = int(np.searchsorted(frequency, bottom))
        if _small(above, parted):
            return parted
        start = last
    return len(frequency)


def _small(power: np.ndarray, place: int) -> bool:
    """True if what stands from there on in power (n,) is none of the motion before."""
    return bool(power[place:].sum() < TREMBLING**2 * power[:place].sum())


def _per_octave(frequency: np.ndarray, energy: np.ndarray, grid: np.ndarray) -> np.ndarray:
    """(m,) energy within half an octave of each frequency of the grid (m,), Hz."""
    total = np.concatenate([[0.0], np.cumsum(energy)])
    low = np.searchsorted(frequency, grid / np.sqrt(2.0))
    high = np.searchsorted(frequency, grid * np.sqrt(2.0), side="right")
    return np.asarray(total[high] - total[low])


def _valley(energy: np.ndarray) -> tuple[int, int] | None:
    """First and last place of the first valley of energies (m,) per octave; None without one.

    It is an octave wide or more, and lower than what stands on either side by `VALLEY`.
    """
    before = np.maximum.accumulate(energy)
    behind = np.maximum.accumulate(energy[::-1])[::-1]
    low = VALLEY * energy < np.minimum(before, behind)
    edges = np.flatnonzero(np.diff(low.astype(np.int8), prepend=0, append=0))
    for first, stop in zip(edges[::2], edges[1::2], strict=True):
        if stop - first > _STEPS:
            return int(first), int(stop) - 1
    return None
