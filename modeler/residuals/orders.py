"""The order spectrum: waves of a residual per turn of a joint."""

from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief

LEAST_WAVES = 3.0
"""In the stroke: slower waves cannot be told from gravity and springs."""

_HIGHEST = 1200.0  # waves per unit of position
_CELLS = 4  # per wave of the highest order
_STANDS_OUT = 12.0  # power over the median around it
_MOST = 3  # lines per joint
_FEWEST = 100  # samples


@dataclass(frozen=True, eq=False)
class OrderSpectrum(Brief):
    """Of one joint.

    Attributes:
        order: (m,) waves per 2 pi of position: rad, or m.
        amplitude: (m,) of the residual, N m or N.
        floor: (m,) median amplitude around each order.
        peaks: orders that stand out, the strongest first.
        power: mean squared residual, (N m)^2 or N^2.
    """

    order: np.ndarray
    amplitude: np.ndarray
    floor: np.ndarray
    peaks: tuple[float, ...]
    power: float


def order_spectrum(q: np.ndarray, r: np.ndarray, unit: str, reached: float) -> OrderSpectrum | None:
    """(2/n) |sum r exp(-i m q)| by order m; None if the joint rests.

    A wave A cos(m q + phase) that is passed often gives A at m. Positions are sorted into cells,
    four for each wave of the highest order, so one fast Fourier transform gives all orders.

    Args:
        q: (n,) positions of the samples that count, rad or m, at full rate.
        r: (n,) residual there, its mean taken off, N m or N.
        unit: of the position, "rad" or "m".
        reached: highest order to look at; infinite for no limit.
    """
    stroke = float(np.ptp(q)) if q.size else 0.0
    if stroke <= 0.0 or q.size < _FEWEST:
        return None
    highest = _HIGHEST if unit == "rad" else _HIGHEST * 2.0 * np.pi / max(stroke, 1e-6)
    cells = int(min(2**19, max(1024, stroke * highest / (2 * np.pi) * _CELLS)))
    place = np.minimum(((q - q.min()) / stroke * cells).astype(int), cells - 1)
    total = np.bincount(place, r, cells)
    length = 1 << int(np.ceil(np.log2(cells * 4)))
    spectrum = np.fft.rfft(total, length) * 2.0 / q.size
    order = np.arange(len(spectrum)) * (2.0 * np.pi / stroke) * cells / length
    amplitude = np.abs(spectrum)
    resolution = 2.0 * np.pi / stroke
    kept = (order >= LEAST_WAVES * resolution) & (order <= highest) & (order <= reached)
    order, amplitude = order[kept], amplitude[kept]
    if order.size < 32:
        return None
    floor = _floor(amplitude)
    peaks = _peaks(order, amplitude, floor, resolution)
    return OrderSpectrum(order, amplitude, floor, peaks, float(r @ r) / r.size)


def _floor(amplitude: np.ndarray) -> np.ndarray:
    """Median over a wide neighbourhood."""
    width = max(16, len(amplitude) // 40)
    centres = np.arange(0, len(amplitude), width)
    medians = [np.median(amplitude[max(0, c - 2 * width) : c + 2 * width]) for c in centres]
    return np.interp(np.arange(len(amplitude)), centres, medians)


def _peaks(
    order: np.ndarray, amplitude: np.ndarray, floor: np.ndarray, resolution: float
) -> tuple[float, ...]:
    power = (amplitude / np.maximum(floor, 1e-300)) ** 2
    found: list[float] = []
    for place in np.argsort(-amplitude * (power > _STANDS_OUT)):
        if power[place] < _STANDS_OUT or len(found) == _MOST:
            break
        if all(abs(order[place] - other) > 2.0 * resolution for other in found):
            found.append(float(order[place]))
    return tuple(found)
