"""The order spectrum of a state, and the ripples that it proposes."""

from collections.abc import Callable, Set
from typing import cast

import numpy as np

from modeler.effects import Effect
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.columns import all_columns, own_columns
from modeler.residuals.orders import OrderSpectrum
from modeler.residuals.orders import order_spectrum as spectrum_of
from modeler.scoring.state import State, column_key


def order_spectrum(state: State, j: int) -> OrderSpectrum | None:
    """Of the moving samples of joint j, at full rate; None if it rests."""
    key = "order spectrum", j
    if key not in state.known:
        state.known[key] = _order_spectrum(state, j)
    return cast(OrderSpectrum | None, state.known[key])


def _order_spectrum(state: State, j: int) -> OrderSpectrum | None:
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
        if pick.local:
            total = total + own_columns(pick, signals) @ values
        else:
            total = total + _torques(state, number, pick)[:, j] @ values
    return total


def _torques(state: State, number: int, pick: Candidate) -> np.ndarray:
    """(n, J, k) torques of the columns of a pick over one stretch, remembered for all joints."""
    key = "torques", number, column_key(state.rows, pick)
    if key not in state.rows.known:
        state.rows.known[key] = all_columns(pick, state.rows.signals[number])
    return np.asarray(state.rows.known[key])


def counted(order: float) -> float:
    """The whole number of waves next to an order: teeth and poles are counted."""
    return float(max(1, round(order)))


def ripple_candidates(
    state: State,
    allowed: Callable[[str, str | None], bool],
    joints: Set[str | None] | None = None,
) -> list[Candidate]:
    """Waves at the orders that stand out on each joint, and at the whole numbers next to them.

    Args:
        state: it.
        allowed: False for an id and a joint that the user rules out.
        joints: names of those that count; None: all.
    """
    found = []
    for j, joint in enumerate(state.data.compiled.spec.joints):
        asked = joint.actuated and (joints is None or joint.name in joints)
        spectrum = order_spectrum(state, j) if asked else None
        for order in spectrum.peaks if spectrum else ():
            for effect in _waving(state, order, joint.name, allowed):
                (shape,) = effect.forms[0].shapes
                found += [
                    Candidate(effect, effect.forms[0], joint.name, j, {shape.name: waves})
                    for waves in dict.fromkeys((order, counted(order)))
                ]
    return found


def _waving(
    state: State, order: float, joint: str, allowed: Callable[[str, str | None], bool]
) -> list[Effect]:
    """Effects that such waves are proposed for; the other name of one that is ruled out."""
    every = [e for e in state.data.known.catalogue if e.orders and allowed(e.id, joint)]
    likely = [e for e in every if e.orders and e.orders[0] <= order < e.orders[1]]
    named = {other for effect in likely for other in effect.same_as}
    return likely + [e for e in every if e not in likely and not named & {e.id, *e.same_as}]
