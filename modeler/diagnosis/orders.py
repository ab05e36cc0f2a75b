"""The order spectrum of a state, and the ripples that it proposes."""

from collections.abc import Callable, Set
from functools import lru_cache
from typing import cast

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import Rows, evaluate_columns, evaluate_equations
from modeler.diagnosis.signals import simulate_resonance
from modeler.diagnosis.state import State, make_column_key
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.diagnosis.timing import smooth_rows
from modeler.numerics.noise import (
    compute_noise_memory,
    estimate_burst_share,
    estimate_recurring_share,
)
from modeler.numerics.spectra import OrderSpectrum, compute_order_spectrum as spectrum_of
from modeler.numerics.splines import (
    LEAST,
    SLIPS,
    Measurements,
    NonparametricBaseline,
    fit_nonparametric_baseline,
    generate_function_sets,
)
from modeler.regression import compute_bristle_state


def compute_joint_order_spectrum(state: State, j: int) -> OrderSpectrum | None:
    """Of the moving samples of joint j, at full rate; None if it rests."""
    key = "order spectrum", j
    if key not in state.derived_cache:
        q, r = _collect_samples(state, j)
        # orders that pass the parallel filter where the joint is slow
        cutoff = state.data.observation.report.processing.parallel_cutoff or 1e9
        moving = [np.abs(s.v[s.segment.whole, j]) for s in state.rows.signals]
        speeds = np.concatenate(moving)
        slow = float(np.quantile(speeds[speeds > 0.0], 0.1)) if (speeds > 0.0).any() else 1.0
        reached = 2.0 * np.pi * cutoff / max(slow, 1e-9)
        unit = state.spec.joints[j].unit
        state.derived_cache[key] = spectrum_of(q, r, unit, reached) if q.size else None
    return cast(OrderSpectrum | None, state.derived_cache[key])


def _collect_samples(state: State, j: int) -> tuple[np.ndarray, np.ndarray]:
    """Positions and residuals of the samples that count, not filtered."""
    q, r = [], []
    segment = state.rows.segment[j]
    for number, signals in enumerate(state.rows.signals):
        if not (segment == number).any():
            continue
        usable = signals.usable[:, j]
        model = signals.torque[:, j] + _compute_added_torque(state, number, j)
        q.append(signals.q[usable, j])
        r.append((signals.segment.tau[:, j] - model)[usable])
    if not q:
        return np.zeros(0), np.zeros(0)
    residual = np.concatenate(r)
    return np.concatenate(q), residual - residual.mean()


def _compute_added_torque(state: State, number: int, j: int) -> np.ndarray:
    """Torque of the effects put in so far, at full rate."""
    signals = state.rows.signals[number]
    total = np.zeros(len(signals.q))
    for pick, values in zip(state.picks, state.values, strict=True):
        if pick.is_local and pick.index != j:
            continue
        if pick.is_local:
            total = total + evaluate_equations([pick], signals) @ values
            continue
        key = "torques", number, make_column_key(state.rows, pick)  # (n, J, k), for all joints
        if key not in state.rows.reference_cache:
            state.rows.reference_cache[key] = evaluate_columns(pick, signals)
        total = total + state.rows.reference_cache[key][:, j] @ values
    return total


def list_ripple_candidates(
    state: State, allowed: Callable[[str, str | None], bool], joints: Set[str | None] | None = None
) -> list[Candidate]:
    """Waves at the orders that stand out on each joint, and at the whole numbers next to them.

    Args:
        state: it.
        allowed: False for an id and a joint that the user rules out.
        joints: names of those that count; None: all.
    """
    candidates, catalogue = [], state.data.stated_effects.catalogue
    for j, joint in enumerate(state.spec.joints):
        asked = joint.actuated and (joints is None or joint.name in joints)
        spectrum = compute_joint_order_spectrum(state, j) if asked else None
        for order in spectrum.peaks if spectrum else ():
            # the other name of an effect that is ruled out counts too
            every = [e for e in catalogue if e.orders and allowed(e.id, joint.name)]
            likely = [e for e in every if e.orders and e.orders[0] <= order < e.orders[1]]
            named = {other for effect in likely for other in effect.same_as}
            others = (e for e in every if e not in likely and not named & {e.id, *e.same_as})
            for effect in (*likely, *others):
                (shape,) = effect.forms[0].nonlinear_parameters
                candidates += [  # teeth and poles are counted: a whole number of waves
                    Candidate(effect, effect.forms[0], joint.name, j, {shape.name: waves})
                    for waves in dict.fromkeys((order, float(max(1, round(order)))))
                ]
    return candidates


# How much of a residual is physics of whatever cause: predictable, back in every lap, no noise.


_RINGING = (0.7, 1.5, 3.0, 6.0, 12.0)
"""Hz of the oscillators that the motion excites: sloshing, swinging, springs."""


def compute_systematic_share(state: State, j: int, residual: np.ndarray) -> float:
    """Share of the variance of a residual of joint j (rows_j,) that surely is no noise."""
    rows = state.rows
    log = rows.time[j], residual, rows.run[j]
    cutoff = state.data.observation.report.processing.parallel_cutoff
    periods = state.data.time_blocks.period
    steps = (periods, [compute_noise_memory(cutoff)] * len(periods))
    again = [estimate_recurring_share(*log, later) or 0.0 for later in steps]
    baseline = fit_residual_baseline(state, j, residual)
    lumps = estimate_burst_share(residual, state.data.block_numbers[j])
    return max(baseline.share if baseline.is_significant else 0.0, lumps, *again)


def compute_burst_share(state: State, j: int) -> float:
    """Share of the energy of joint j's residual in outbursts."""
    return estimate_burst_share(state.residual[j], state.data.block_numbers[j])


def fit_residual_baseline(state: State, j: int, residual: np.ndarray) -> NonparametricBaseline:
    """What a flexible function of all that was measured says of a residual of joint j (rows_j,).

    It reads the smooth motion: what the noise of the positions makes of the columns of the model is
    in the residual, and in the motion as it was measured too, which would seem to predict it.
    """
    fold = state.data.time_blocks.fold[state.data.block_numbers[j]]
    sets = generate_function_sets(_collect_measurements(state, j)) if fold.size >= LEAST else ()
    return fit_nonparametric_baseline(sets, residual, fold)


def _collect_measurements(state: State, j: int) -> Measurements:
    rows, J = smooth_rows(state), state.rows.joint_count
    every = rows.filter_samples(j, _collect_signals(rows))
    q, v, a, load, torque = np.split(every[:, : 5 * J], 5, axis=1)
    direction = [np.sign(s.v[:, j]) for s in rows.signals]
    slips = [
        np.column_stack(
            [compute_bristle_state(s.q[:, j], d * state.joint_scales[j].range) for d in SLIPS]
        )
        for s in rows.signals
    ]
    return Measurements(
        joint=j,
        q=q,
        v=v,
        a=a,
        load=load,
        torque=torque,
        direction=rows.filter_samples(j, direction),
        bristle_states=rows.filter_samples(j, slips),
        extra_sets={"waves": _build_wave_columns(state, j), "ringing": every[:, 5 * J :]},
    )


@lru_cache(maxsize=1)  # all joints of some logs are asked for one after the other
def _collect_signals(rows: Rows) -> list[np.ndarray]:
    """(samples, 5 J + ...) by stretch: q, v, a, load and torque of all joints, and what rings.

    Oscillators that the accelerations of all joints excite, and their speeds.
    """
    every = []
    for s in rows.signals:
        z = np.column_stack(
            [
                simulate_resonance(a, s.step, frequency, THRESHOLDS.baseline_damping)
                for a in s.a.T
                for frequency in _RINGING
            ]
        )
        every.append(np.hstack([s.q, s.v, s.a, s.load, s.torque, z, np.gradient(z, axis=0)]))
    return every


def _build_wave_columns(state: State, j: int) -> np.ndarray:
    """(rows_j, 2 k) cosine and sine of the k orders that stand out in the residual."""
    spectrum = compute_joint_order_spectrum(state, j)
    if spectrum is None or not spectrum.peaks:
        return np.zeros((len(state.residual[j]), 0))
    angles = [np.outer(s.q[:, j], spectrum.peaks) for s in smooth_rows(state).signals]
    return state.rows.filter_samples(j, [np.hstack([np.cos(x), np.sin(x)]) for x in angles])
