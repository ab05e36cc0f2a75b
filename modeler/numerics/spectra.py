"""Spectra of motions and residuals, orders of a shaft, laps of a motion that repeats."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.json import Document, ShortRepr
from modeler.numerics.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class ResidualSpectrum(ShortRepr, Document):
    """Autocorrelation and power spectral density of one residual."""

    KEYS = "correlation_time lag_one_correlation peak peak_share"

    period: float  # s between samples
    correlation: np.ndarray  # (lags,) autocorrelation at 0, 1, ... samples; correlation[0] = 1
    correlation_time: float  # s until the autocorrelation is below 0.2; one period for white noise
    frequency: np.ndarray  # (m,) Hz, without 0
    density: np.ndarray  # (m,) (N m)^2/Hz or N^2/Hz
    peak: float  # Hz, of the largest density, weighted over two frequency steps either side
    peak_share: float  # of the power, within two frequency steps of the peak

    @property
    def lag_one_correlation(self) -> float:
        """Returns the autocorrelation of neighbouring samples."""
        return float(self.correlation[1])


def estimate_residual_spectrum(
    time: np.ndarray, segment: np.ndarray, e: np.ndarray
) -> ResidualSpectrum | None:
    """Estimates the spectrum of one joint's residual; None if no segment has 16 samples.

    Rows that do not count enter as zeros and the result is scaled by the share that counts:
    this keeps the power and blurs lines a little. Segments sampled at another rate than most
    are left out.

    Args:
        time: (n,) s.
        segment: (n,) number of the evenly sampled segment of each row.
        e: residual on all rows, (n,), NaN where the row does not count.
    """
    pieces, period = _collect_segments(time, segment, e)
    if not pieces:
        return None
    correlation = _estimate_autocorrelation(pieces, round(THRESHOLDS.max_lag / period))
    frequency, density = _average_welch_density(pieces, period)
    below = np.flatnonzero(correlation < THRESHOLDS.uncorrelated_below)
    lags_until_decay = int(below[0]) if below.size else correlation.size
    top = int(np.argmax(density))
    around = slice(max(top - 2, 0), top + 3)
    near = float(density[around].sum())
    total = float(density.sum())
    return ResidualSpectrum(
        period=period,
        correlation=correlation,
        correlation_time=lags_until_decay * period,
        frequency=frequency,
        density=density,
        peak=float(frequency[around] @ density[around]) / near if near else 0.0,
        peak_share=near / total if total else 0.0,
    )


def find_segment_slices(segment: np.ndarray) -> list[slice]:
    """Finds the slices of equal segment number, in row order."""
    if segment.size == 0:
        return []
    edges = np.flatnonzero(np.diff(segment)) + 1
    starts = [0, *edges.tolist()]
    stops = [*edges.tolist(), int(segment.size)]
    return [slice(a, b) for a, b in zip(starts, stops, strict=True)]


def _collect_segments(
    time: np.ndarray, segment: np.ndarray, e: np.ndarray
) -> tuple[list[np.ndarray], float]:
    """Centred residual of each usable segment (NaN where it does not count), and the period."""
    centred = e - np.nanmean(e)
    segments = []
    for span in find_segment_slices(segment):
        rows = span.stop - span.start
        if rows >= 16 and np.isfinite(e[span]).sum() >= 16:
            segments.append((centred[span], float(np.median(np.diff(time[span])))))
    if not segments:
        return [], 0.0
    steps = np.repeat([step for _, step in segments], [piece.size for piece, _ in segments])
    period = float(np.median(steps))
    return [piece for piece, step in segments if abs(step - period) < 0.05 * period], period


def _estimate_autocorrelation(pieces: list[np.ndarray], lags: int) -> np.ndarray:
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


def _average_welch_density(
    pieces: list[np.ndarray], period: float
) -> tuple[np.ndarray, np.ndarray]:
    """Welch densities (Hann, half overlap) of the segments, averaged by samples that count."""
    # a quarter of the longest segment: about seven windows to average over
    window = min(THRESHOLDS.max_welch_samples, max(16, max(piece.size for piece in pieces) // 4))
    total, weight = np.zeros(window // 2 + 1), 0.0
    for piece in pieces:
        counts = float(np.isfinite(piece).sum())
        filled = np.nan_to_num(piece)
        density = estimate_welch_density(filled, min(window, piece.size), window, period)
        total = total + density * piece.size  # = counts * (density scaled by size / counts)
        weight += counts
    return np.fft.rfftfreq(window, period)[1:], total[1:] / weight


def estimate_welch_density(values: np.ndarray, length: int, size: int, period: float) -> np.ndarray:
    """Returns (size // 2 + 1,) one-sided power density, mean over half overlapping Hann windows.

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


def estimate_coherence(x: np.ndarray, y: np.ndarray, frequency: float) -> float:
    """Estimates the coherence of y (n,) with x (n,) around a frequency in periods a sample."""
    length = max(16, min(256, len(x) // 8))
    if len(x) < 2 * length:
        return 0.0
    hann = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(length) / length)
    a, b = (
        np.fft.rfft(
            hann
            * np.lib.stride_tricks.sliding_window_view(np.diff(values, 2), length)[:: length // 2]
        )
        for values in (x, y)
    )
    place = round(frequency * length)
    near = slice(max(1, place - 1), place + 2)
    both = np.abs(np.mean(a * np.conj(b), axis=0)[near]) ** 2
    each = (np.mean(np.abs(values) ** 2, axis=0)[near] for values in (a, b))
    return float(np.max(both / np.maximum(np.multiply(*each), 1e-300)))


# The order spectrum: waves of a residual per turn of a joint.


@dataclass(frozen=True, eq=False)
class OrderSpectrum(ShortRepr):
    """The spectrum of one joint's residual over waves of its position.

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


def compute_order_spectrum(
    q: np.ndarray, r: np.ndarray, unit: str, reached: float
) -> OrderSpectrum | None:
    """Computes (2/n) |sum r exp(-i m q)| by order m; None if the joint rests.

    A wave A cos(m q + phase) that is passed often gives A at m. Positions are sorted into cells,
    four for each wave of the highest order, so one fast Fourier transform gives all orders.

    Args:
        q: (n,) positions of the samples that count, rad or m, at full rate.
        r: (n,) residual there, its mean taken off, N m or N.
        unit: of the position, "rad" or "m".
        reached: highest order to look at; infinite for no limit.
    """
    stroke = float(np.ptp(q)) if q.size else 0.0
    if stroke <= 0.0 or q.size < THRESHOLDS.min_order_samples:
        return None
    highest = THRESHOLDS.max_order
    if unit != "rad":
        highest = THRESHOLDS.max_order * 2.0 * np.pi / max(stroke, 1e-6)
    cells = int(min(2**19, max(1024, stroke * highest / (2 * np.pi) * THRESHOLDS.cells_per_wave)))
    place = np.minimum(((q - q.min()) / stroke * cells).astype(int), cells - 1)
    total = np.bincount(place, r, cells)
    length = 1 << int(np.ceil(np.log2(cells * 4)))
    spectrum = np.fft.rfft(total, length) * 2.0 / q.size
    order = np.arange(len(spectrum)) * (2.0 * np.pi / stroke) * cells / length
    amplitude = np.abs(spectrum)
    resolution = 2.0 * np.pi / stroke
    is_in_range = (order >= THRESHOLDS.min_waves * resolution) & (order <= min(highest, reached))
    order, amplitude = order[is_in_range], amplitude[is_in_range]
    if order.size < 32:
        return None
    # The floor is the median over a wide neighbourhood.
    width = max(16, len(amplitude) // 40)
    centres = np.arange(0, len(amplitude), width)
    medians = [np.median(amplitude[max(0, c - 2 * width) : c + 2 * width]) for c in centres]
    floor = np.interp(np.arange(len(amplitude)), centres, medians)
    power = (amplitude / np.maximum(floor, 1e-300)) ** 2
    peaks: list[float] = []
    for place in np.argsort(-amplitude * (power > THRESHOLDS.min_peak_power)):
        if power[place] < THRESHOLDS.min_peak_power or len(peaks) == THRESHOLDS.max_peaks:
            break
        if all(abs(order[place] - other) > 2.0 * resolution for other in peaks):
            peaks.append(float(order[place]))
    return OrderSpectrum(order, amplitude, floor, tuple(peaks), float(r @ r) / r.size)


# Motion that repeats itself within one log.


def find_longest_stretch(time: np.ndarray, step: float) -> slice:
    """Finds the longest segment between pauses where they fill the time of a log; else all rows.

    Args:
        time: (n,) s, increasing.
        step: s, between rows.
    """
    if len(time) < 2 or time[-1] - time[0] < THRESHOLDS.min_pause_steps * step * len(time):
        return slice(0, len(time))
    pauses = np.flatnonzero(np.diff(time) > THRESHOLDS.min_pause_steps * step)
    ends = np.concatenate([[0], pauses + 1, [len(time)]])
    longest = int(np.argmax(np.diff(ends)))
    return slice(int(ends[longest]), int(ends[longest + 1]))


def estimate_lap_period(since: np.ndarray, q: np.ndarray) -> float:
    """Estimates the period, s, of a motion that repeats at least once; 0 if it does not.

    Args:
        since: (s,) s, from 0.
        q: (s, J) positions.
    """
    step = float(np.median(np.diff(since))) if len(since) > 2 else 0.0
    rows = find_longest_stretch(since, step)
    since, q = since[rows] - since[rows][:1], q[rows]
    count = int(since[-1] / step) + 1 if step > 0.0 and len(since) else 0
    if count < 8 or since[-1] < 2 * THRESHOLDS.min_lap_seconds:
        return 0.0
    even = np.arange(count) * step
    moved = [np.interp(even, since, q[:, j]) for j in range(q.shape[1]) if np.ptp(q[:, j]) > 0.0]
    if not moved:
        return 0.0
    likeness = np.ones(count // 2 + 1)
    for x in moved:
        scaled = (x - x.mean()) / x.std()
        likeness = np.minimum(likeness, _compute_self_similarity(scaled, count // 2 + 1))
    first = int(THRESHOLDS.min_lap_seconds / step)
    high = np.flatnonzero(likeness[first:] > THRESHOLDS.min_repeat_correlation) + first
    low = np.flatnonzero(likeness < 0.8)
    if not high.size or not low.size:
        return 0.0
    high = high[high > low[0]]
    if not high.size:
        return 0.0
    near = high[high < high[0] * 1.1 + 2]
    return float(near[np.argmax(likeness[near])] * step)


def _compute_self_similarity(x: np.ndarray, lags: int) -> np.ndarray:
    """1 - mean squared difference of x(t + lag) and x(t) over twice its variance, by lag."""
    count = len(x)
    spectrum = np.fft.rfft(x, 2 * count)
    product = np.fft.irfft(np.abs(spectrum) ** 2)[:lags]
    power = np.concatenate([[0.0], np.cumsum(x**2)])
    overlap = count - np.arange(lags)
    head = power[overlap]
    tail = power[count] - power[np.arange(lags)]
    return 1.0 - (head + tail - 2.0 * product) / overlap / 2.0


# How the positions of a piece are spread over frequencies.


@dataclass(frozen=True, eq=False)
class MotionSpectrum:
    """The spectrum of positions; n frequencies, J joints.

    Attributes:
        frequency: (n,) Hz, from 0 on.
        power: (n, J) variance of the positions at each frequency, rad^2 or m^2.
        white: (J,) what white noise contributes to each, on average.
    """

    frequency: np.ndarray
    power: np.ndarray
    noise_power: np.ndarray

    @property
    def power_above_noise(self) -> np.ndarray:
        """Returns (n, J) power above the largest value of white noise, 0 within it."""
        largest = self.noise_power * (np.log(len(self.frequency)) + THRESHOLDS.noise_exceedance)
        return np.maximum(self.power - largest, 0.0)


def compute_motion_spectrum(positions: np.ndarray, step: float) -> MotionSpectrum:
    """Computes the periodogram of positions (samples, J): Hann window, trend removed.

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
    return MotionSpectrum(np.fft.rfftfreq(samples, step), power, white)


# The power density of a signal that falls steeply: by third octaves, differentiated first.


@dataclass(frozen=True, eq=False)
class BandSpectrum(ShortRepr):
    """Means over third octaves; m of them, J channels.

    Attributes:
        frequency: (m,) Hz, in the middle of each.
        density: (m, J) one-sided power density; NaN where no line of the transform falls.
    """

    frequency: np.ndarray
    density: np.ndarray


def compute_band_spectrum(
    channels: Sequence[np.ndarray], steps: Sequence[float], order: int
) -> BandSpectrum:
    """Computes power densities by third octaves of signals with dominant low frequencies.

    Differences of the given order are transformed in Blackman windows of 4 s, half overlapping, and
    their density is divided by (2 sin(pi f h))^(2 order): that of the signal itself.

    Args:
        channels: (n, J) signals, uniform pieces.
        steps: s, of each.
        order: of the differences that make them level.
    """
    longest = max(THRESHOLDS.band_window, *(2.0 * step for step in steps))
    low, high = 1.0 / longest, 0.5 / min(steps)
    edges = low * 2.0 ** (
        np.arange(np.ceil(np.log2(high / low) * THRESHOLDS.bands_per_octave) + 1)
        / THRESHOLDS.bands_per_octave
    )
    total = np.zeros((len(edges) - 1, channels[0].shape[1]))
    count = np.zeros(len(edges) - 1)
    for values, step in zip(channels, steps, strict=True):
        level = np.diff(values, order, axis=0)
        length = min(len(level), max(8, round(THRESHOLDS.band_window / step)))
        if length < 8:
            continue
        power, frames = _estimate_blackman_density(level, length, step)
        f = np.fft.rfftfreq(length, step)
        gain = (2.0 * np.sin(np.pi * f[1:] * step)) ** (2 * order)
        place = np.searchsorted(edges, f[1:], side="right") - 1
        inside = (place >= 0) & (place < len(total)) & (f[1:] >= 2.5 / (length * step))
        np.add.at(total, place[inside], frames * power[1:][inside] / gain[inside, None])
        np.add.at(count, place[inside], frames)
    with np.errstate(invalid="ignore", divide="ignore"):
        density = np.where(count[:, None] > 0.0, total / count[:, None], np.nan)
    return BandSpectrum(np.sqrt(edges[1:] * edges[:-1]), density)


def _estimate_blackman_density(
    values: np.ndarray, length: int, step: float
) -> tuple[np.ndarray, int]:
    """(length // 2 + 1, J) one-sided density, mean over half overlapping windows; how many."""
    window = np.blackman(length)
    starts = range(0, len(values) - length + 1, max(1, length // 2))
    power = np.zeros((length // 2 + 1, values.shape[1]))
    for start in starts:
        frame = values[start : start + length] * window[:, None]
        power += np.abs(np.fft.rfft(frame, axis=0)) ** 2
    return 2.0 * step / (len(starts) * np.sum(window**2)) * power, len(starts)
