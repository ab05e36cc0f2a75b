"""The order spectrum: waves of the residual per turn of a joint."""

from dataclasses import dataclass

import numpy as np

from modeler.diagnose.candidates import Candidate
from modeler.diagnose.columns import all_columns
from modeler.diagnose.state import State
from modeler.effects import effect_named

MOTOR = 70.0
"""Waves per turn from which on a ripple is taken for the motor's: teeth and rollers are fewer."""

LEAST_WAVES = 3.0
"""In the stroke: slower waves cannot be told from gravity and springs."""

_HIGHEST = 1200.0  # waves per unit of position
_CELLS = 4  # per wave of the highest order
_STANDS_OUT = 12.0  # power over the median around it
_MOST = 3  # lines per joint


@dataclass(frozen=True, eq=False)
class OrderSpectrum:
    """Of one joint.

    Attributes:
        order: (m,) waves per 2 pi of position: rad, or m.
        amplitude: (m,) of the residual, N m or N.
        floor: (m,) median amplitude around each order.
        peaks: orders that stand out, the strongest first.
    """

    order: np.ndarray
    amplitude: np.ndarray
    floor: np.ndarray
    peaks: tuple[float, ...]


def order_spectrum(state: State, j: int) -> OrderSpectrum | None:
    """Mean of r exp(-i m q) over the moving samples of joint j, at full rate; None if it rests."""
    q, r = _samples(state, j)
    stroke = float(np.ptp(q)) if q.size else 0.0
    if stroke <= 0.0 or q.size < 100:
        return None
    unit = state.data.compiled.spec.joints[j].unit
    highest = _HIGHEST if unit == "rad" else _HIGHEST * 2.0 * np.pi / max(stroke, 1e-6)
    cells = int(min(2**19, max(1024, stroke * highest / (2 * np.pi) * _CELLS)))
    place = np.minimum(((q - q.min()) / stroke * cells).astype(int), cells - 1)
    total = np.bincount(place, r, cells)
    length = 1 << int(np.ceil(np.log2(cells * 4)))
    spectrum = np.fft.rfft(total, length) * 2.0 / q.size
    order = np.arange(len(spectrum)) * (2.0 * np.pi / stroke) * cells / length
    amplitude = np.abs(spectrum)
    resolution = 2.0 * np.pi / stroke
    kept = (order >= LEAST_WAVES * resolution) & (order <= highest) & (order <= _reached(state, j))
    order, amplitude = order[kept], amplitude[kept]
    if order.size < 32:
        return None
    floor = _floor(amplitude)
    return OrderSpectrum(order, amplitude, floor, _peaks(order, amplitude, floor, resolution))


def _reached(state: State, j: int) -> float:
    """Order that passes the parallel filter at the median speed of the joint."""
    cutoff = state.data.observation.report.processing.parallel_cutoff or 1e9
    speeds = np.abs(
        np.concatenate([s.v[s.segment.whole[:: s.every], j] for s in state.rows.signals])
    )
    slow = float(np.quantile(speeds[speeds > 0.0], 0.1)) if (speeds > 0.0).any() else 1.0
    return 2.0 * np.pi * cutoff / max(slow, 1e-9)


def _samples(state: State, j: int) -> tuple[np.ndarray, np.ndarray]:
    """Positions and residuals of the samples that count, not filtered."""
    q, r = [], []
    segment = state.rows.segment[j]
    for number, part in enumerate(state.data.observation.stretches):
        if not (segment == number).any():
            continue
        signals = state.rows.signals[number]
        usable = part.usable[:: signals.every, j]
        model = signals.torque[:, j] + _extra(state, number, j)
        q.append(signals.q[usable, j])
        r.append((part.segment.tau[:: signals.every, j] - model)[usable])
    if not q:
        return np.zeros(0), np.zeros(0)
    residual = np.concatenate(r)
    return np.concatenate(q), residual - residual.mean()


def _extra(state: State, number: int, j: int) -> np.ndarray:
    """Torque of the effects put in so far, at full rate."""
    signals = state.rows.signals[number]
    total = np.zeros(len(signals.q))
    for pick, values in zip(state.picks, state.values, strict=True):
        if pick.local and pick.index != j:
            continue
        total = total + all_columns(pick, signals)[:, j] @ values
    return total


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


def ripple_candidates(state: State) -> list[Candidate]:
    """Waves at the orders that stand out on each joint."""
    found = []
    for j, joint in enumerate(state.data.compiled.spec.joints):
        spectrum = order_spectrum(state, j) if joint.actuated else None
        for order in spectrum.peaks if spectrum else ():
            effect = effect_named("motor_ripple" if order >= MOTOR else "joint_ripple")
            runout = effect_named("encoder_eccentricity")
            assert effect is not None and runout is not None
            found.append(Candidate(effect, effect.forms[0], joint.name, j, {"m": order}))
            found.append(Candidate(runout, runout.forms[0], joint.name, j, {"k": order}))
    return found
