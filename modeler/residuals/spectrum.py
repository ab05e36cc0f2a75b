"""Memory and spectrum of a residual, never across a segment."""

from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief

_LONGEST = 1024  # samples of one Welch window
_LAG = 2.0  # s, longest lag of the autocorrelation
_FORGOTTEN = 0.2  # autocorrelation below which the past is called forgotten


@dataclass(frozen=True, eq=False)
class Spectrum(Brief):
    """Autocorrelation and power spectral density of one residual."""

    period: float  # s between samples
    correlation: np.ndarray  # (lags,) autocorrelation at 0, 1, ... samples; correlation[0] = 1
    memory: float  # s until the autocorrelation is below 0.2; one period for white noise
    frequency: np.ndarray  # (m,) Hz, without 0
    density: np.ndarray  # (m,) (N m)^2/Hz or N^2/Hz
    peak: float  # Hz, of the largest density, weighted over two frequency steps either side
    peak_share: float  # of the power, within two frequency steps of the peak


def spectrum(time: np.ndarray, segment: np.ndarray, e: np.ndarray) -> Spectrum | None:
    """Spectrum of one joint's residual; None when no segment is long enough (16 samples).

    Rows that do not count enter as zeros and the result is scaled by the share that counts:
    this keeps the power and blurs lines a little. Segments sampled at another rate than most
    are left out.

    Args:
        time: (n,) s.
        segment: (n,) number of the evenly sampled stretch of each row.
        e: residual on all rows, (n,), NaN where the row does not count.
    """
    pieces, period = _pieces(time, segment, e)
    if not pieces:
        return None
    correlation = _autocorrelation(pieces, round(_LAG / period))
    frequency, density = _welch(pieces, period)
    below = np.flatnonzero(correlation < _FORGOTTEN)
    memory = int(below[0]) if below.size else correlation.size
    top = int(np.argmax(density))
    around = slice(max(top - 2, 0), top + 3)
    near = float(density[around].sum())
    total = float(density.sum())
    return Spectrum(
        period=period,
        correlation=correlation,
        memory=memory * period,
        frequency=frequency,
        density=density,
        peak=float(frequency[around] @ density[around]) / near if near else 0.0,
        peak_share=near / total if total else 0.0,
    )


def spans(segment: np.ndarray) -> list[slice]:
    """The stretches of equal segment number, in row order."""
    if segment.size == 0:
        return []
    edges = np.flatnonzero(np.diff(segment)) + 1
    starts = [0, *edges.tolist()]
    stops = [*edges.tolist(), int(segment.size)]
    return [slice(a, b) for a, b in zip(starts, stops, strict=True)]


def _pieces(time: np.ndarray, segment: np.ndarray, e: np.ndarray) -> tuple[list[np.ndarray], float]:
    """Centred residual of each usable segment (NaN where it does not count), and the period."""
    centred = e - np.nanmean(e)
    found = []
    for span in spans(segment):
        rows = span.stop - span.start
        if rows >= 16 and np.isfinite(e[span]).sum() >= 16:
            found.append((centred[span], float(np.median(np.diff(time[span])))))
    if not found:
        return [], 0.0
    steps = np.repeat([step for _, step in found], [piece.size for piece, _ in found])
    period = float(np.median(steps))
    return [piece for piece, step in found if abs(step - period) < 0.05 * period], period


def _autocorrelation(pieces: list[np.ndarray], lags: int) -> np.ndarray:
    """Mean product of pairs that both count and lie in one segment, over the mean square."""
    lags = max(2, min(lags, max(piece.size for piece in pieces) // 2))
    product, pairs = np.zeros(lags), np.zeros(lags)
    for piece in pieces:
        size = 1 << (2 * piece.size - 1).bit_length()
        counts = np.isfinite(piece).astype(float)
        reach = min(lags, piece.size)
        for values, total in ((np.nan_to_num(piece), product), (counts, pairs)):
            power = np.abs(np.fft.rfft(values, size)) ** 2
            total[:reach] += np.fft.irfft(power, size)[:reach]
    mean = product / np.maximum(pairs, 1.0)
    return mean / mean[0] if mean[0] > 0.0 else np.eye(1, lags)[0]


def _welch(pieces: list[np.ndarray], period: float) -> tuple[np.ndarray, np.ndarray]:
    """Welch densities (Hann, half overlap) of the segments, averaged by samples that count."""
    # a quarter of the longest segment: about seven windows to average over
    window = min(_LONGEST, max(16, max(piece.size for piece in pieces) // 4))
    total, weight = np.zeros(window // 2 + 1), 0.0
    for piece in pieces:
        counts = float(np.isfinite(piece).sum())
        density = welch(np.nan_to_num(piece), min(window, piece.size), window, period)
        total = total + density * piece.size  # = counts * (density scaled by size / counts)
        weight += counts
    return np.fft.rfftfreq(window, period)[1:], total[1:] / weight


def welch(values: np.ndarray, length: int, size: int, period: float) -> np.ndarray:
    """(size // 2 + 1,) one-sided power density, mean over half overlapping Hann windows.

    That of scipy.signal.welch without detrending; scipy.signal takes long to load.

    Args:
        values: (n,).
        length: of a window, at most n.
        size: to which windows are filled with zeros.
        period: s.
    """
    hann = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(length) / length)
    frames = np.lib.stride_tricks.sliding_window_view(values, length)[:: length - length // 2]
    power = np.mean(np.abs(np.fft.rfft(frames * hann, size)) ** 2, axis=0)
    power *= 2.0 * period / np.sum(hann**2)
    power[0] *= 0.5
    if size % 2 == 0:
        power[-1] *= 0.5
    return np.asarray(power)
