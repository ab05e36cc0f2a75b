"""Effects that errors of timing imitate: does the smooth motion speak for them too?"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import Columns, Rows, base_columns, width
from modeler.diagnosis.gram import pieces
from modeler.diagnosis.signals import Signals
from modeler.diagnosis.state import State, picked_columns
from modeler.effects.effect import Acts
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
    own, other = state.rows.columns(candidate), smooth.columns(candidate)
    extra = picked_columns(smooth, state.picks)
    sizes = [width(e) for e in (*extra, own)]
    ends = np.cumsum([len(state.data.free), *sizes])
    X, Z = [], []
    for j, sigma in enumerate(state.sigma):
        base = smooth.W[j][:, state.data.free]
        further = zip(ends[:-1], ends[1:], (*extra, other), strict=True)
        X.append(_Parts([(slice(0, ends[-2]), state.W[j]), *_shown(own, j, ends[-2:])], sigma))
        shown = [part for first, last, e in further for part in _shown(e, j, (first, last))]
        Z.append(_Parts([(slice(0, ends[0]), base), *shown], sigma))
    return _solve(X, Z, (int(ends[-1]), sizes[-1]), state.base.y, state.base.block)


def _shown(
    columns: Columns, j: int, ends: Sequence[int] | np.ndarray
) -> list[tuple[slice, np.ndarray]]:
    here = columns[j]
    return [] if here is None else [(slice(int(ends[0]), int(ends[1])), here)]


@dataclass(frozen=True, eq=False)
class _Parts:
    """Columns of one joint, (rows, k) each, with their places among all; divided by sigma."""

    parts: list[tuple[slice, np.ndarray]]
    sigma: float

    def squares(self, count: int) -> np.ndarray:
        """(count,) of all columns."""
        found = np.zeros(count)
        for at, own in self.parts:
            found[at] = np.einsum("ij,ij->j", own, own)
        return found / self.sigma**2

    def times(self, other: "_Parts", count: int) -> np.ndarray:
        """(count, count) products with other columns."""
        found = np.zeros((count, count))
        for at, own in self.parts:
            for place, columns in other.parts:
                found[at, place] = own.T @ columns
        return found / self.sigma**2

    def on(self, values: np.ndarray, rows: slice = slice(None)) -> np.ndarray:
        """(count,) products with values of some rows."""
        found = np.zeros(max(at.stop for at, _ in self.parts))
        for at, own in self.parts:
            found[at] = values @ own[rows]
        return found / self.sigma

    def of(self, theta: np.ndarray) -> np.ndarray:
        """(rows,) with parameters."""
        return np.asarray(sum(own @ theta[at] for at, own in self.parts)) / self.sigma


def _solve(
    X: Sequence[_Parts], Z: Sequence[_Parts], count: tuple[int, int], y: Sequence[np.ndarray],
    block: Sequence[np.ndarray],
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Of the last k of c columns, count = (c, k); all else by joint."""
    c, k = count
    length, size = (np.sqrt(sum(part.squares(c) for part in own)) for own in (X, Z))
    kept = (length > 0.0) & (size > 0.0)
    if not kept[-k:].all():
        return np.zeros(k), np.ones(k)
    length, size = np.where(kept, length, 1.0), np.where(kept, size, 1.0)
    products = sum(z.times(x, c) for z, x in zip(Z, X, strict=True)) / np.outer(size, length)
    inverse = np.zeros((c, c))
    inverse[np.ix_(kept, kept)] = np.linalg.pinv(products[np.ix_(kept, kept)], rcond=1e-9)
    sums = np.zeros((max(int(own.max(initial=0)) for own in block) + 1, c))
    right = np.zeros(c)
    for z, t in zip(Z, y, strict=True):
        side = z.on(t)
        right[: len(side)] += side
    theta = inverse @ (right / size)
    for x, z, t, own in zip(X, Z, y, block, strict=True):
        left = t - x.of(theta / length)
        for b, rows in pieces(own):
            score = z.on(left[rows], rows)
            sums[b, : len(score)] += score
    sums /= size
    covariance = inverse @ (sums.T @ sums) @ inverse.T
    error = np.sqrt(np.diag(covariance))
    return theta[-k:] / length[-k:], error[-k:] / length[-k:]


def _smoothed(state: State) -> Rows:
    """The same rows with the motion smoothed."""
    if "smooth" in state.rows.known:
        return state.rows.known["smooth"]
    cutoff = 3.0 * max(SLOWEST, state.data.observation.report.band)  # Hz, of the band of the motion
    key = "smooth motion"  # the same for all states, and so are its base columns
    if key not in state.rows.cache:
        moved = tuple(_smooth(s, cutoff) for s in state.rows.signals)
        state.rows.cache[key] = moved, base_columns(state.rows.blocks, moved)
    moved, W = state.rows.cache[key]
    signals = tuple(dataclasses.replace(s, reference=state.reference) for s in moved)
    smooth = dataclasses.replace(state.rows, W=W, signals=signals, known={}, cache={})
    state.rows.known["smooth"] = smooth
    return smooth


def _smooth(signals: Signals, cutoff: float) -> Signals:
    step = signals.step
    q = low_pass(signals.q, step, min(cutoff, 0.2 / step))
    v = np.gradient(q, step, axis=0)
    return dataclasses.replace(signals, q=q, v=v, a=np.gradient(v, step, axis=0))
