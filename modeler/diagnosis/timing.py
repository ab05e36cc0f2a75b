"""Effects that errors of timing imitate: does the smooth motion speak for them too?"""

import dataclasses
from collections.abc import Sequence
from typing import cast

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import Rows, base_columns, dense, width
from modeler.diagnosis.ranking import pieces
from modeler.diagnosis.signals import Signals
from modeler.diagnosis.state import State, picked_columns
from modeler.effects import Needs
from modeler.observation import low_pass, nearest_closed

DELAY_T_RATIO = 4.0
"""Least ratio of the instrumental estimate to its standard error."""

SLOWEST = 0.5
"""Hz: no motion is smoothed as if it were slower."""

CONVENTION = 0.55
"""Delays below this share of a sample are a convention of the logger, not an effect."""


def confirmed(state: State, candidate: Candidate, values: np.ndarray) -> bool:
    """True if the smooth motion speaks for the effect too, and it is no convention of the logger.

    Noise of the encoder runs through the controller into the torque: least squares then see delays
    and elasticity that are not there. Instruments are the same columns built from a motion without
    that noise: the measured one, smoothed to little more than the band of the motion.

    Args:
        state: without the candidate.
        candidate: with its shapes.
        values: of its parameters by least squares.
    """
    _, supported, conventional = _by_smooth_motion(state, candidate, values)
    return supported and not conventional


def logger_shift(state: State, candidate: Candidate, values: np.ndarray) -> float:
    """s of a delay of about half a sample: which of two samples a torque belongs to; else 0.

    Args:
        state: without the candidate.
        candidate: a delay.
        values: of its parameter by least squares.
    """
    found, supported, conventional = _by_smooth_motion(state, candidate, values)
    return float(found[0]) if supported and conventional else 0.0


def _by_smooth_motion(
    state: State, candidate: Candidate, values: np.ndarray
) -> tuple[np.ndarray, bool, bool]:
    """Values by instruments, whether these support the effect, and whether it is a convention."""
    found, error = instrumental(state, candidate)
    sure = bool(np.max(np.abs(found) / np.maximum(error, 1e-300)) > DELAY_T_RATIO)
    step = float(np.median([s.segment.logged_step for s in state.rows.signals]))
    small = abs(float(found[0])) * candidate.shapes.get("tau", 1.0) < CONVENTION * step
    timed = candidate.delays or Needs.LAG in candidate.effect.needs
    supported = sure and bool(np.sum(found * values) > 0.0)
    return found, supported, small and timed


def instrumental(state: State, candidate: Candidate) -> tuple[np.ndarray, np.ndarray]:
    """Estimate of the candidate's parameters by instrumental variables, and standard errors.

    theta = (Z^T X)^-1 Z^T y; errors from sums over blocks, so that coloured residuals count.
    """
    smooth, cache = smoothed(state), state.rows.cache
    if "smooth columns" not in cache:
        cache["smooth columns"] = base_columns(smooth.blocks, smooth.signals)
    own, other = state.rows.columns(candidate), smooth.columns(candidate)
    extra = (*picked_columns(smooth, state.picks), other)
    X, Z = [], []
    for j, sigma in enumerate(state.sigma):
        W, base = state.W[j], cache["smooth columns"][j][:, state.data.free]
        X.append(np.hstack([W, dense(own, j, len(W))]) / sigma)
        Z.append(np.hstack([base, *(dense(columns, j, len(W)) for columns in extra)]) / sigma)
    return _solve(state, X, Z, width(own))


def _solve(
    state: State, X: Sequence[np.ndarray], Z: Sequence[np.ndarray], k: int
) -> tuple[np.ndarray, np.ndarray]:
    """Of the last k of c columns, by joint."""
    c, y, block = X[0].shape[1], state.base.y, state.base.block
    length, size = (
        np.sqrt(sum(np.einsum("ij,ij->j", part, part) for part in own)) for own in (X, Z)
    )
    kept = (length > 0.0) & (size > 0.0)
    if not kept[-k:].all():
        return np.zeros(k), np.ones(k)
    length, size = np.where(kept, length, 1.0), np.where(kept, size, 1.0)
    products = sum(z.T @ x for z, x in zip(Z, X, strict=True)) / np.outer(size, length)
    inverse = np.zeros((c, c))
    inverse[np.ix_(kept, kept)] = np.linalg.pinv(products[np.ix_(kept, kept)], rcond=1e-9)
    sums = np.zeros((max(int(own.max(initial=0)) for own in block) + 1, c))
    theta = inverse @ (sum(z.T @ t for z, t in zip(Z, y, strict=True)) / size)
    for x, z, t, own in zip(X, Z, y, block, strict=True):
        left = t - x @ (theta / length)
        for b, rows in pieces(own):
            sums[b] += left[rows] @ z[rows]
    sums /= size
    covariance = inverse @ (sums.T @ sums) @ inverse.T
    error = np.sqrt(np.diag(covariance))
    return theta[-k:] / length[-k:], error[-k:] / length[-k:]


def smoothed(state: State) -> Rows:
    """The same rows of the motion without the noise of its sensors: smoothed to 3 of its bands.

    Its base columns are not there.
    """
    known, cache, key = state.rows.known, state.rows.cache, "smooth motion"
    if key not in cache:
        cutoff = 3.0 * max(SLOWEST, state.data.observation.report.band)  # Hz
        cache[key] = tuple(_smooth(s, cutoff) for s in state.rows.signals)  # of all states
    if key not in known:
        signals = tuple(dataclasses.replace(s, reference=state.reference) for s in cache[key])
        known[key] = dataclasses.replace(state.rows, W=(), signals=signals, known={}, cache={})
    return cast(Rows, known[key])


def _smooth(signals: Signals, cutoff: float) -> Signals:
    """Where a smooth posture does not close the loops, the nearest that does stands in."""
    step = signals.step
    q = low_pass(signals.q, step, min(cutoff, 0.2 / step))
    v = np.gradient(q, step, axis=0)
    nearest = nearest_closed(signals.reference.compiled, q)
    q = signals.q if nearest is None else q[nearest]
    return dataclasses.replace(signals, q=q, v=v, a=np.gradient(v, step, axis=0))
