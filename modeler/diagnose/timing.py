"""Effects that errors of timing imitate: does the smooth motion speak for them too?"""

import dataclasses

import numpy as np

from modeler.diagnose.candidates import Candidate
from modeler.diagnose.rows import Rows, dense
from modeler.diagnose.signals import Signals
from modeler.diagnose.state import State
from modeler.effects import Acts
from modeler.observation.motion import low_pass

SURE = 4.0
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
    found, error = instrumental(state, candidate)
    return _supported(found, error, values) and not _conventional(state, candidate, found)


def logger_shift(state: State, candidate: Candidate, values: np.ndarray) -> float:
    """s of a delay of about half a sample: which of two samples a torque belongs to; else 0.

    Args:
        state: without the candidate.
        candidate: a delay.
        values: of its parameter by least squares.
    """
    found, error = instrumental(state, candidate)
    believed = _supported(found, error, values) and _conventional(state, candidate, found)
    return float(found[0]) if believed else 0.0


def _supported(found: np.ndarray, error: np.ndarray, values: np.ndarray) -> bool:
    same = bool(np.sum(found * values) > 0.0)
    return same and bool(np.max(np.abs(found) / np.maximum(error, 1e-300)) > SURE)


def _conventional(state: State, candidate: Candidate, found: np.ndarray) -> bool:
    step = float(np.median([s.segment.step for s in state.rows.signals]))
    return candidate.effect.acts is Acts.TORQUE and abs(float(found[0])) < CONVENTION * step


def instrumental(state: State, candidate: Candidate) -> tuple[np.ndarray, np.ndarray]:
    """Estimate of the candidate's parameters by instrumental variables, and standard errors.

    theta = (Z^T X)^-1 Z^T y; errors from sums over blocks, so that coloured residuals count.
    """
    smooth = _smoothed(state)
    X, Z, y, block = [], [], [], []
    own, other = state.rows.columns(candidate), smooth.columns(candidate)
    extra = [smooth.columns(pick) for pick in state.picks]
    for j in range(state.rows.joints):
        sigma = state.base.sigma[j]
        base = smooth.W[j][:, state.data.free]
        picks = [dense(e, j, len(base)) for e in extra]
        X.append(np.hstack([state.W[j], dense(own, j, len(base))]) / sigma)
        Z.append(np.hstack([base, *picks, dense(other, j, len(base))]) / sigma)
        y.append(state.y[j] / sigma)
        block.append(state.base.block[j])
    k = next(c.shape[1] for c in own if c is not None)
    return _solve(np.vstack(X), np.vstack(Z), np.concatenate(y), np.concatenate(block), k)


def _solve(
    X: np.ndarray, Z: np.ndarray, y: np.ndarray, block: np.ndarray, k: int
) -> tuple[np.ndarray, np.ndarray]:
    length = np.linalg.norm(X, axis=0)
    size = np.linalg.norm(Z, axis=0)
    kept = (length > 0.0) & (size > 0.0)
    if not kept[-k:].all():
        return np.zeros(k), np.ones(k)
    X, Z, length = X[:, kept] / length[kept], Z[:, kept] / size[kept], length[kept]
    inverse = np.linalg.pinv(Z.T @ X, rcond=1e-9)
    theta = inverse @ (Z.T @ y)
    scores = Z * (y - X @ theta)[:, None]
    sums = np.zeros((int(block.max()) + 1, Z.shape[1]))
    np.add.at(sums, block, scores)
    covariance = inverse @ (sums.T @ sums) @ inverse.T
    error = np.sqrt(np.diag(covariance))
    return theta[-k:] / length[-k:], error[-k:] / length[-k:]


def _smoothed(state: State) -> Rows:
    """The same rows with the motion smoothed."""
    key = "smooth rows"
    if key not in state.cache:
        state.cache[key] = [_smooth(s, _cutoff(state)) for s in state.rows.signals]
    motion = state.cache[key]
    signals = tuple(
        dataclasses.replace(s, q=q, v=v, a=a, reference=state.reference)
        for s, (q, v, a) in zip(state.rows.signals, motion, strict=True)
    )
    model = state.data.compiled
    base = [model.base_regressor(s.q, s.v, s.a, s.read) for s in signals]
    W = tuple(
        state.rows.filtered(j, [value[:, j] for value in base]) for j in range(state.rows.joints)
    )
    return dataclasses.replace(state.rows, W=W, signals=signals)


def _cutoff(state: State) -> float:
    """Hz: three times the band of the motion."""
    return 3.0 * max(SLOWEST, state.data.observation.report.band)


def _smooth(signals: Signals, cutoff: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    step = signals.step
    q = low_pass(signals.q, step, min(cutoff, 0.2 / step))
    v = np.gradient(q, step, axis=0)
    return q, v, np.gradient(v, step, axis=0)
