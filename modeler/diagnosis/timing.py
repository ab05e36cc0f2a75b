"""Effects that errors of timing imitate: does the smooth motion speak for them too?"""

import dataclasses
from collections.abc import Sequence
from typing import cast

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import Rows, build_base_columns, count_columns, expand_columns
from modeler.diagnosis.ranking import find_block_runs
from modeler.diagnosis.signals import Signals
from modeler.diagnosis.state import State, collect_pick_columns
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Requirement
from modeler.regression import apply_low_pass, find_nearest_closed


def is_confirmed(state: State, candidate: Candidate, values: np.ndarray) -> bool:
    """True if the smooth motion speaks for the effect too, and it is no convention of the logger.

    Noise of the encoder runs through the controller into the torque: least squares then see delays
    and elasticity that are not there. Instruments are the same columns built from a motion without
    that noise: the measured one, smoothed to little more than the band of the motion.

    Args:
        state: without the candidate.
        candidate: with its shapes.
        values: of its parameters by least squares.
    """
    _, supported, conventional = _check_smooth_motion(state, candidate, values)
    return supported and not conventional


def estimate_logger_shift(state: State, candidate: Candidate, values: np.ndarray) -> float:
    """s of a delay of about half a sample: which of two samples a torque belongs to; else 0.

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
    sure = bool(
        np.max(np.abs(estimates) / np.maximum(error, 1e-300)) > THRESHOLDS.min_instrumental_t
    )
    step = float(np.median([s.segment.logged_step for s in state.rows.signals]))
    small = (
        abs(float(estimates[0])) * candidate.nonlinear_parameters.get("tau", 1.0)
        < THRESHOLDS.max_logger_delay * step
    )
    timed = candidate.is_delay or Requirement.LAG in candidate.effect.needs
    supported = sure and bool(np.sum(estimates * values) > 0.0)
    return estimates, supported, small and timed


def estimate_instrumental(state: State, candidate: Candidate) -> tuple[np.ndarray, np.ndarray]:
    """Estimate of the candidate's parameters by instrumental variables, and standard errors.

    theta = (Z^T X)^-1 Z^T y; errors from sums over blocks, so that coloured residuals count.
    """
    smooth, cache = smooth_rows(state), state.rows.cache
    if "smooth columns" not in cache:
        cache["smooth columns"] = build_base_columns(smooth.blocks, smooth.signals)
    raw_columns, other = state.rows.build_columns(candidate), smooth.build_columns(candidate)
    extra = (*collect_pick_columns(smooth, state.picks), other)
    X, Z = [], []
    for j, sigma in enumerate(state.sigma):
        W, base = state.W[j], cache["smooth columns"][j][:, state.data.free_columns]
        X.append(np.hstack([W, expand_columns(raw_columns, j, len(W))]) / sigma)
        Z.append(
            np.hstack([base, *(expand_columns(columns, j, len(W)) for columns in extra)]) / sigma
        )
    return _solve_instrumental(state, X, Z, count_columns(raw_columns))


def _solve_instrumental(
    state: State, X: Sequence[np.ndarray], Z: Sequence[np.ndarray], k: int
) -> tuple[np.ndarray, np.ndarray]:
    """Of the last k of c columns, by joint."""
    c, y, block = X[0].shape[1], state.gram_blocks.y, state.gram_blocks.block
    length, size = (
        np.sqrt(sum(np.einsum("ij,ij->j", part, part) for part in part_rows))
        for part_rows in (X, Z)
    )
    is_used = (length > 0.0) & (size > 0.0)
    if not is_used[-k:].all():
        return np.zeros(k), np.ones(k)
    length, size = np.where(is_used, length, 1.0), np.where(is_used, size, 1.0)
    products = sum(z.T @ x for z, x in zip(Z, X, strict=True)) / np.outer(size, length)
    inverse = np.zeros((c, c))
    inverse[np.ix_(is_used, is_used)] = np.linalg.pinv(
        products[np.ix_(is_used, is_used)], rcond=1e-9
    )
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
    """The same rows of the motion without the noise of its sensors: smoothed to 3 of its bands.

    Its base columns are not there.
    """
    known, cache, key = state.rows.reference_cache, state.rows.cache, "smooth motion"
    if key not in cache:
        cutoff = 3.0 * max(THRESHOLDS.min_motion_band, state.data.observation.report.band)  # Hz
        cache[key] = tuple(_smooth_signals(s, cutoff) for s in state.rows.signals)  # of all states
    if key not in known:
        signals = tuple(dataclasses.replace(s, reference=state.reference) for s in cache[key])
        known[key] = dataclasses.replace(
            state.rows, W=(), signals=signals, reference_cache={}, cache={}
        )
    return cast(Rows, known[key])


def _smooth_signals(signals: Signals, cutoff: float) -> Signals:
    """Where a smooth posture does not close the loops, the nearest that does stands in."""
    step = signals.step
    q = apply_low_pass(signals.q, step, min(cutoff, 0.2 / step))
    v = np.gradient(q, step, axis=0)
    nearest = find_nearest_closed(signals.reference.compiled, q)
    q = signals.q if nearest is None else q[nearest]
    return dataclasses.replace(signals, q=q, v=v, a=np.gradient(v, step, axis=0))
