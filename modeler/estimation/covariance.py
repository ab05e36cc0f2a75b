"""Residuals that remember: what that does to the standard deviations."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.estimation.least_squares import Estimate
from modeler.estimation.problem import Neighbours
from modeler.numerics.filters import SPREAD
from modeler.observation.observation import Observation
from modeler.observation.reduce import explained

_WORTH = 1.2  # a factor above it is said
_LAGS = 60  # rows; with one row per 1 / (2.5 cut-off), 24 periods of the parallel filter
_SPREADS = 1.0  # standard deviations of the autocorrelation of white residuals
_FADED = 0.01
_TOLD = 0.2  # autocorrelation that is told: filtering leaves 0.1


@dataclass(frozen=True, eq=False)
class Colour:
    """What the memory of the residuals does.

    Attributes:
        factors: (c,) on the standard deviations, 1 and more.
        memory: (joint, s) of the joints whose residuals are not white.
        lasting: (n,) autocorrelation of their residuals over one row.
    """

    factors: np.ndarray
    memory: tuple[tuple[str, float], ...]
    lasting: np.ndarray

    def sentences(self) -> list[str]:
        """One, if it matters."""
        if not self.memory or self.factors.max(initial=1.0) < _WORTH:
            return []
        longest = max(self.memory, key=lambda entry: entry[1])
        return [
            f"the residuals are no white noise (joint {longest[0]} remembers {longest[1]:.2g} s): "
            f"neighbouring rows repeat each other, and the sigmas are raised for it, by up to a "
            f"factor {self.factors.max():.2g}"
        ]


def coloured(
    observation: Observation,
    W: np.ndarray | Neighbours,
    y: np.ndarray,
    counted: np.ndarray,
    estimate: Estimate,
    at: Sequence[int] | None = None,
) -> Colour:
    """By how much autocorrelated residuals raise the standard deviations.

    The covariance C = (W^T S^-1 W)^-1 takes rows for independent. With residuals of joint j of
    autocorrelation r_j(k), stationary, it is

        C B C,  B = sum_j sum_k r_j(|k|) sum_t w_j(t) w_j(t+k)^T / sigma_j^2,

    w_j(t) the row of joint j at sample t (Newey and West 1987, weights replaced by truncation: the
    sum over k ends with the first r_j below one standard deviation of that of white noise). r_j is
    at least that of white noise through the parallel filter. An estimator with an influence has
    pull_t rms_j in place of C w_t / sigma_j. Each sigma is multiplied by the square root of the
    ratio of the diagonals, never by less than 1.

    Args:
        observation: says which row is which sample and joint.
        W: (rows, c), or that of the observation while its rows pass, of the same counted.
        y: (rows,).
        counted: (rows,) rows that were fitted.
        estimate: of those rows; its covariance is for white residuals.
        at: (c,) columns of the observation that W would have, in order; None: all.
    """
    if isinstance(W, Neighbours):
        return _passing(W, estimate, at)
    return _at_once(observation, W, y, counted, estimate)


def _at_once(
    observation: Observation, W: np.ndarray, y: np.ndarray, counted: np.ndarray, estimate: Estimate
) -> Colour:
    """As `coloured`, of rows that are there."""
    own_way = estimate.influence
    residual = y - W @ estimate.beta if own_way is None else own_way.residual
    extra, memory = np.zeros(len(estimate.beta)), []  # diagonal of C (B - C^-1) C
    lasting = np.zeros(len(observation.joints))
    for j, joint in enumerate(observation.joints):
        if not (own := counted & (observation.row_joint == j)).any():
            continue
        sample = observation.row_sample[own]
        r = remembered(observation, residual[own], sample)
        lasting[j] = r[1] if len(r) > 1 else 0.0
        pull = estimate.covariance / estimate.sigma[j]
        rows = W[own] @ pull if own_way is None else own_way.of(W)[own] * _rms(residual[own])
        extra += repeated(rows, r, sample, observation.segment)
        if told := int(np.sum(r > _TOLD)) - 1:
            memory.append((joint.name, told * _spacing(observation)))
    return Colour(_factors(estimate.covariance, extra), tuple(memory), lasting)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _factors(C: np.ndarray, extra: np.ndarray) -> np.ndarray:
    white = np.diag(C)
    ratio = 1.0 + extra / np.where(white > 0.0, white, 1.0)
    return np.sqrt(np.maximum(ratio, 1.0))


def _passing(beside: Neighbours, estimate: Estimate, at: Sequence[int] | None) -> Colour:
    """As `coloured`, while the rows pass."""
    observation, keep = beside.observation, beside.keep
    c = len(observation.names)
    places = np.arange(c) if at is None else np.asarray(at, dtype=int)
    own_way, beta = estimate.influence, np.zeros(c)
    beta[places] = estimate.beta
    residual = observation.torque - explained(observation, beta)
    matrices, memories, memory = [], [], []
    lasting = np.zeros(len(observation.joints))
    for j, joint in enumerate(observation.joints):
        r, A = np.ones(1), np.zeros((c, len(places)))
        sample = np.flatnonzero(keep[:, j])
        if sample.size:
            left = residual[sample, j]
            r = remembered(observation, left, sample)
            lasting[j] = r[1] if len(r) > 1 else 0.0
            if own_way is None:
                A[places] = estimate.covariance / estimate.sigma[j]
            else:
                assert own_way.bread is not None  # others ask for W
                A[places] = own_way.bread * _rms(left)
            if told := int(np.sum(r > _TOLD)) - 1:
                memory.append((joint.name, told * _spacing(observation)))
        matrices.append(A)
        memories.append(r)
    extra = beside.repeated(matrices, memories)
    return Colour(_factors(estimate.covariance, extra), tuple(memory), lasting)


def remembered(observation: Observation, e: np.ndarray, sample: np.ndarray) -> np.ndarray:
    """r(0) = 1, r(1), ... of the residual of one joint, at least that of the parallel filter.

    Args:
        observation: of the rows.
        e: (rows,) residual of one joint.
        sample: (rows,) its samples, ascending.
    """
    found = autocorrelation(e, sample, observation.segment)
    return _at_least(found, _of_the_filter(observation))


def repeated_whole(
    rows: np.ndarray, r: np.ndarray, sample: np.ndarray, segment: np.ndarray
) -> np.ndarray:
    """(c, c) sum_k r(k) sum_t (rows(t) rows(t + k)^T + its transpose); `repeated` is its diagonal.

    With rows^T rows it is the middle of the covariance of least squares over these rows.
    """
    total = np.zeros((rows.shape[1], rows.shape[1]))
    for lag in range(1, len(r)):
        left, right = _pairs(sample, segment, lag)
        total += r[lag] * (rows[left].T @ rows[right])
    return total + total.T


def repeated(
    rows: np.ndarray, r: np.ndarray, sample: np.ndarray, segment: np.ndarray
) -> np.ndarray:
    """(c,) 2 sum_k r(k) sum_t rows(t) rows(t + k)."""
    total = np.zeros(rows.shape[1])
    for lag in range(1, len(r)):
        left, right = _pairs(sample, segment, lag)
        total += 2.0 * r[lag] * np.einsum("tc,tc->c", rows[left], rows[right])
    return total


def autocorrelation(e: np.ndarray, sample: np.ndarray, segment: np.ndarray) -> np.ndarray:
    """r(0) = 1, r(1), ... up to the first that does not stand out, at most 60, within segments.

    Args:
        e: (rows,) residual of one joint.
        sample: (rows,) its samples, ascending.
        segment: (samples,) number of the segment of each sample.
    """
    r = [1.0]
    power = float(np.mean(e**2))
    while len(r) <= _LAGS and power > 0.0:
        left, right = _pairs(sample, segment, len(r))
        if not left.size:
            break
        value = float(np.mean(e[left] * e[right])) / power
        r.append(value)
        if value < _SPREADS / np.sqrt(left.size):
            break
    return np.array(r)


def _pairs(sample: np.ndarray, segment: np.ndarray, lag: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows that are `lag` samples apart within a segment."""
    if not len(sample):
        return sample, sample
    place = np.full(sample[-1] - sample[0] + 1 + lag, -1)
    place[sample - sample[0]] = np.arange(len(sample))
    right = place[sample - sample[0] + lag]
    together = (right >= 0) & (segment[sample[right]] == segment[sample])
    return np.flatnonzero(together), right[together]


def _of_the_filter(observation: Observation) -> np.ndarray:
    """r(0) = 1, r(1), ... of white noise through the parallel filter, down to 0.01.

    Means with Gaussian weights of standard deviation s, d apart, correlate by exp(-d^2 / 4 s^2).
    """
    cutoff = observation.report.processing.parallel_cutoff
    if not cutoff:
        return np.ones(1)
    lags = np.arange(_LAGS) * _spacing(observation) * cutoff / SPREAD
    r = np.exp(-(lags**2) / 4.0)
    return r[: max(1, int(np.argmax(r < _FADED)))]


def _at_least(r: np.ndarray, floor: np.ndarray) -> np.ndarray:
    """The estimate, where it is not less than what the filter alone makes."""
    longer = np.zeros(max(len(r), len(floor)))
    longer[: len(r)] = r
    longer[: len(floor)] = np.maximum(longer[: len(floor)], floor)
    return longer


def _spacing(observation: Observation) -> float:
    steps = np.diff(observation.time)[np.diff(observation.segment) == 0]
    return float(np.median(steps)) if steps.size else 0.0
