"""Candidates that the data suggest: smooth motion, order spectrum, baseline, ripples, loads."""

import itertools
from collections.abc import Callable, Sequence, Set
from dataclasses import replace
from functools import lru_cache
from typing import cast

import numpy as np

from modeler.diagnosis.candidates import (
    Candidate,
    Rows,
    build_base_columns,
    count_columns,
    evaluate_columns,
    evaluate_equations,
    list_candidates,
    list_links,
    to_dense,
)
from modeler.diagnosis.ranking import find_block_runs
from modeler.diagnosis.signals import Signals, simulate_resonance
from modeler.diagnosis.state import State, collect_pick_columns, make_column_key
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget, Requirement
from modeler.numerics import noise
from modeler.numerics.spectra import OrderSpectrum, compute_order_spectrum as spectrum_of
from modeler.numerics.splines import (
    LEAST,
    SLIPS,
    Measurements,
    NonparametricBaseline,
    fit_nonparametric_baseline,
    generate_function_sets,
)
from modeler.regression import apply_low_pass, compute_bristle_state, find_nearest_closed


def is_confirmed(state: State, candidate: Candidate, values: np.ndarray) -> bool:
    """Returns whether the smooth motion supports the effect, and no convention explains it.

    Noise of the encoder runs through the controller into the torque: least squares then see delays
    that are not there. Instruments are the same columns built from a motion without
    that noise: the measured one, smoothed to little more than the band of the motion.

    Args:
        state: without the candidate.
        candidate: with its shapes.
        values: of its parameters by least squares.
    """
    if candidate.effect.is_oscillator:
        return candidate.elastic is not None
    _, supported, conventional = _check_smooth_motion(state, candidate, values)
    return supported and not conventional


def estimate_logger_shift(state: State, candidate: Candidate, values: np.ndarray) -> float:
    """Estimates a delay, s, of about half a sample that a logger causes; else 0.

    Args:
        state: without the candidate.
        candidate: a delay.
        values: of its parameter by least squares.
    """
    estimates, supported, conventional = _check_smooth_motion(state, candidate, values)
    return float(estimates[0]) if supported and conventional else 0.0


def _check_smooth_motion(
    state: State, candidate: Candidate, values: np.ndarray
) -> tuple[np.ndarray, bool, bool]:
    """Values by instruments, whether these support the effect, and whether it is a convention."""
    estimates, error = estimate_instrumental(state, candidate)
    t_ratio = float(np.max(np.abs(estimates) / np.maximum(error, 1e-300)))
    sure = t_ratio > THRESHOLDS.min_instrumental_t
    step = float(np.median([s.segment.logged_step for s in state.rows.signals]))
    delay = abs(float(estimates[0])) * candidate.nonlinear_parameters.get("tau", 1.0)
    small = delay < THRESHOLDS.max_logger_delay * step
    timed = candidate.is_delay or Requirement.LAG in candidate.effect.needs
    supported = sure and bool(np.sum(estimates * values) > 0.0)
    return estimates, supported, small and timed


def estimate_instrumental(state: State, candidate: Candidate) -> tuple[np.ndarray, np.ndarray]:
    """Estimates the candidate's parameters by instrumental variables, with standard errors.

    theta = (Z^T X)^-1 Z^T y; errors from sums over blocks, so that coloured residuals count.
    """
    smooth, cache = smooth_rows(state), state.rows.cache
    if "smooth columns" not in cache:
        cache["smooth columns"] = build_base_columns(smooth.blocks, smooth.signals)
    raw_columns, other = state.rows.build_columns(candidate), smooth.build_columns(candidate)
    extra = (*collect_pick_columns(smooth, state.picks), other)
    X, Z = [], []
    for j, (W, sigma) in enumerate(zip(state.W, state.sigma, strict=True)):
        base = cache["smooth columns"][j][:, state.data.free_columns]
        X.append(np.hstack([W, to_dense(raw_columns, j, len(W))]) / sigma)
        Z.append(np.hstack([base, *(to_dense(columns, j, len(W)) for columns in extra)]) / sigma)
    return _solve_instrumental(state, X, Z, count_columns(raw_columns))


def _solve_instrumental(
    state: State, X: Sequence[np.ndarray], Z: Sequence[np.ndarray], k: int
) -> tuple[np.ndarray, np.ndarray]:
    """Of the last k of c columns, by joint."""
    c, y, block = X[0].shape[1], state.gram_blocks.y, state.gram_blocks.block
    squares = ([np.einsum("ij,ij->j", part, part) for part in parts] for parts in (X, Z))
    length, size = (np.sqrt(sum(parts)) for parts in squares)
    is_used = (length > 0.0) & (size > 0.0)
    if not is_used[-k:].all():
        return np.zeros(k), np.ones(k)
    length, size = np.where(is_used, length, 1.0), np.where(is_used, size, 1.0)
    products = sum(z.T @ x for z, x in zip(Z, X, strict=True)) / np.outer(size, length)
    inverse = np.zeros((c, c))
    used = np.ix_(is_used, is_used)
    inverse[used] = np.linalg.pinv(products[used], rcond=1e-9)
    sums = np.zeros((max(int(part_rows.max(initial=0)) for part_rows in block) + 1, c))
    theta = inverse @ (sum(z.T @ t for z, t in zip(Z, y, strict=True)) / size)
    for x, z, t, part_rows in zip(X, Z, y, block, strict=True):
        left = t - x @ (theta / length)
        for b, rows in find_block_runs(part_rows):
            sums[b] += left[rows] @ z[rows]
    sums /= size
    covariance = inverse @ (sums.T @ sums) @ inverse.T
    error = np.sqrt(np.diag(covariance))
    return theta[-k:] / length[-k:], error[-k:] / length[-k:]


def smooth_rows(state: State) -> Rows:
    """Returns the rows of the motion, smoothed to three times its bandwidth.

    Its base columns are not there.
    """
    known, cache, key = state.rows.reference_cache, state.rows.cache, "smooth motion"
    if key not in cache:
        cutoff = 3.0 * max(THRESHOLDS.min_motion_band, state.data.observation.report.band)  # Hz
        cache[key] = tuple(_smooth_signals(s, cutoff) for s in state.rows.signals)  # of all states
    if key not in known:
        signals = tuple(replace(s, reference=state.reference) for s in cache[key])
        known[key] = replace(state.rows, W=(), signals=signals, reference_cache={}, cache={})
    return cast(Rows, known[key])


def _smooth_signals(signals: Signals, cutoff: float) -> Signals:
    """Where a smooth posture does not close the loops, the nearest that does stands in."""
    step = signals.step
    q = apply_low_pass(signals.q, step, min(cutoff, 0.2 / step))
    v = np.gradient(q, step, axis=0)
    nearest = find_nearest_closed(signals.reference.compiled, q)
    q = signals.q if nearest is None else q[nearest]
    return replace(signals, q=q, v=v, a=np.gradient(v, step, axis=0))


def compute_joint_order_spectrum(state: State, j: int) -> OrderSpectrum | None:
    """Computes the order spectrum of joint j at full rate; None if it rests."""
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
    """Lists waves at the orders that stand out, and at the whole numbers next to them.

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
            named = {other for effect in likely for other in effect.equivalent_effects}
            others = (
                e for e in every if e not in likely and not named & {e.id, *e.equivalent_effects}
            )
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
    """Computes the share of the variance of a residual (rows_j,) that is certainly no noise."""
    rows = state.rows
    log = rows.time[j], residual, rows.run[j]
    cutoff = state.data.observation.report.processing.parallel_cutoff
    periods = state.data.time_blocks.period
    steps = (periods, [noise.compute_noise_memory(cutoff)] * len(periods))
    again = [noise.estimate_recurring_share(*log, later) or 0.0 for later in steps]
    baseline = fit_residual_baseline(state, j, residual)
    lumps = noise.estimate_burst_share(residual, state.data.block_numbers[j])
    return max(baseline.share if baseline.is_significant else 0.0, lumps, *again)


def compute_burst_share(state: State, j: int) -> float:
    """Computes the share of the energy of joint j's residual in bursts."""
    return noise.estimate_burst_share(state.residual[j], state.data.block_numbers[j])


def fit_residual_baseline(state: State, j: int, residual: np.ndarray) -> NonparametricBaseline:
    """Fits the nonparametric baseline to a residual of joint j (rows_j,).

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
    travels = [share * state.joint_scales[j].range for share in SLIPS]
    slips = [[compute_bristle_state(s.q[:, j], d) for d in travels] for s in rows.signals]
    states = rows.filter_samples(j, [np.column_stack(slip) for slip in slips])
    extra_sets = {"waves": _build_wave_columns(state, j), "ringing": every[:, 5 * J :]}
    motion = q, v, a, load, torque, rows.filter_samples(j, direction), states
    return Measurements(j, *motion, extra_sets)


@lru_cache(maxsize=1)  # all joints of some logs are requested one after the other
def _collect_signals(rows: Rows) -> list[np.ndarray]:
    """(samples, 5 J + ...) by segment: q, v, a, load and torque of all joints, and what rings.

    Oscillators that the accelerations of all joints excite, and their speeds.
    """
    every = []
    for s in rows.signals:
        damping, pairs = THRESHOLDS.baseline_damping, itertools.product(s.a.T, _RINGING)
        z = np.column_stack([simulate_resonance(a, s.step, f, damping) for a, f in pairs])
        every.append(np.hstack([s.q, s.v, s.a, s.load, s.torque, z, np.gradient(z, axis=0)]))
    return every


def _build_wave_columns(state: State, j: int) -> np.ndarray:
    """(rows_j, 2 k) cosine and sine of the k orders that stand out in the residual."""
    spectrum = compute_joint_order_spectrum(state, j)
    if spectrum is None or not spectrum.peaks:
        return np.zeros((len(state.residual[j]), 0))
    angles = [np.outer(s.q[:, j], spectrum.peaks) for s in smooth_rows(state).signals]
    return state.rows.filter_samples(j, [np.hstack([np.cos(x), np.sin(x)]) for x in angles])


def _compute_shortest_travels(state: State) -> np.ndarray:
    """(J,) that samples show: from rest, at the rms acceleration of the joint, over a few."""
    times = [s.step * np.ones(len(s.a)) for s in state.rows.signals]
    span = THRESHOLDS.min_turn_samples * np.concatenate(times)[:, None]
    travels = 0.5 * np.abs(np.concatenate([s.a for s in state.rows.signals])) * span**2
    return np.asarray(np.sqrt(np.mean(travels**2, axis=0)))


def generate_candidates(
    state: State,
    only: str | None = None,
    without: Sequence[str] = (),
    keys: Set[tuple[str, str | None]] | None = None,
) -> list[Candidate]:
    """Generates the candidates of this state, without those that were put in.

    Args:
        state: it.
        only: id of the one effect that is requested.
        without: ids of effects, or id@joint, that the user rules out.
        keys: effects and joints that count; None: all.
    """
    spec = state.spec
    temperature = {joint.name: joint.name in state.reference.temperature for joint in spec.joints}
    changed = state.data.fixed_parameters is not None
    present = set() if changed else {(p.effect, p.joint) for p in spec.standard}
    windups = {spec.signals[place].joint for place in spec.windups}
    every = state.data.stated_effects.catalogue
    asked = [e for e in every if (only is None and not e.is_learned) or e.id == only]
    known = replace(state.data.stated_effects, catalogue=asked)

    def is_allowed(effect: str, joint: str | None) -> bool:
        return not is_ruled_out(effect, joint, without)

    results = list_candidates(spec, state.joint_scales, temperature, present, known, is_allowed)
    is_tree, lowest = spec.closure is None, np.inf  # loops read no windup
    slowest = find_slowest_ringing(state)
    ringing = {id(c): c.nonlinear_parameters["f"] for c in results if c.effect.is_oscillator}
    results = [c for c in results if ringing.get(id(c), lowest) >= slowest]
    results = [c for c in results if id(c) not in ringing or (is_tree and c.joint not in windups)]
    shortest = _compute_shortest_travels(state)
    results = [c for c in results if not c.loop or c.loop[0] >= shortest[c.index]]
    if waving := {effect.id for effect in known.catalogue if effect.orders}:
        waves = None if keys is None else {joint for effect, joint in keys if effect in waving}
        results += list_ripple_candidates(state, is_allowed, waves)
    if changed:
        results += list_load_candidates(state)
    single = [pick for pick in state.picks if not pick.effect.is_repeatable]
    taken = {(x, p.joint) for p in single for x in (p.effect.id, *p.effect.equivalent_effects)}
    results = [c for c in results if only in (None, c.effect.id) and is_allowed(*c.key)]
    return [c for c in results if c.key not in taken]


def is_ruled_out(effect: str, joint: str | None, without: Sequence[str]) -> bool:
    """Returns whether the user rules out the effect, everywhere or on that joint."""
    return effect in without or f"{effect}@{joint}" in without


def find_slowest_ringing(state: State) -> float:
    """Returns the frequency, Hz, from which an elastic joint may resonate."""
    return THRESHOLDS.min_resonance_ratio * state.data.observation.report.band


def list_load_candidates(state: State) -> list[Candidate]:
    """Lists bodies on a link, where the links' parameters are fixed."""
    closure, links = state.spec.closure, list_links(state.spec)
    last = (closure.carrier if closure is not None else "") or links[-1]
    bodies = [e for e in state.data.stated_effects.catalogue if e.acts is EffectTarget.LINK]
    pairs = [
        (e, k) for e in bodies for k, x in enumerate(links) if e.is_on_last_link is (x == last)
    ]
    return [
        Candidate(e, e.forms[0], None if e.is_on_last_link else links[k], k, {}) for e, k in pairs
    ]
