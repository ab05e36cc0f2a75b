"""The order spectrum of a state, and the ripples that it proposes."""

from collections.abc import Callable

import numpy as np

from modeler.diagnose.candidates import Candidate
from modeler.diagnose.columns import all_columns
from modeler.diagnose.state import State
from modeler.effects import RIPPLES, effect_named
from modeler.residuals.orders import OrderSpectrum
from modeler.residuals.orders import order_spectrum as spectrum_of

MOTOR = 70.0
"""Waves per turn from which on a ripple is taken for the motor's: teeth and rollers are fewer."""


def order_spectrum(state: State, j: int) -> OrderSpectrum | None:
    """Of the moving samples of joint j, at full rate; None if it rests."""
    q, r = _samples(state, j)
    unit = state.data.compiled.spec.joints[j].unit
    return spectrum_of(q, r, unit, _reached(state, j)) if q.size else None


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


def counted(order: float) -> float:
    """The whole number of waves next to an order: teeth and poles are counted."""
    return float(max(1, round(order)))


def ripple_candidates(
    state: State, allowed: Callable[[str, str | None], bool]
) -> list[Candidate]:  # fmt: skip
    """Waves at the orders that stand out on each joint, and at the whole numbers next to them.

    Args:
        state: it.
        allowed: False for an id and a joint that the user rules out; the other name of a ripple
            stands for it then.
    """
    found = []
    for j, joint in enumerate(state.data.compiled.spec.joints):
        spectrum = order_spectrum(state, j) if joint.actuated else None
        for order in spectrum.peaks if spectrum else ():
            names = RIPPLES if order >= MOTOR else RIPPLES[::-1]
            effect = effect_named(next((n for n in names if allowed(n, joint.name)), names[0]))
            runout = effect_named("encoder_eccentricity")
            assert effect is not None and runout is not None
            for waves in dict.fromkeys((order, counted(order))):
                found.append(Candidate(effect, effect.forms[0], joint.name, j, {"m": waves}))
                found.append(Candidate(runout, runout.forms[0], joint.name, j, {"k": waves}))
    return found
