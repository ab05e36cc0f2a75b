"""What the compare stage takes: measured and predicted torque on the same rows."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.table import pool_errors_by_unit


@dataclass(frozen=True)
class JointInfo:
    """One judged joint and the units of its coordinate and of its effort."""

    name: str  # "2"
    unit: Literal["rad", "m"]
    effort_unit: Literal["N m", "N"]


@dataclass(frozen=True)
class Motor:
    """A motor with friction of its own that turns with several joints ([coupling])."""

    name: str  # "5+6"
    coefficients: tuple[float, ...]  # (joints,) its speed is coefficients . qd


@dataclass(frozen=True, eq=False)
class FullRate(ShortRepr):
    """The samples from which the rows were made; m samples, stacked log after log."""

    run: np.ndarray  # (m,) index into logs
    time: np.ndarray  # (m,) s, as in the log
    q: np.ndarray  # (m, joints) rad or m
    residual: np.ndarray  # (m, joints) N m or N, not filtered; NaN where it does not count
    filtered: np.ndarray  # (m, joints) through the filter of the rows; NaN where it cannot count


@dataclass(frozen=True, eq=False)
class Prediction(ShortRepr):
    """Measured and predicted torque after the same filtering of both sides.

    n samples, stacked log after log. Rows of one segment are evenly sampled and follow each
    other; nothing may be differenced, correlated or windowed across two segments.
    """

    robot: str
    joints: tuple[JointInfo, ...]
    logs: tuple[str, ...]  # names of the logs
    run: np.ndarray  # (n,) index into logs
    segment: np.ndarray  # (n,) segment number, unique over logs
    time: np.ndarray  # (n,) s, as in the log
    q: np.ndarray  # (n, joints) rad or m
    qd: np.ndarray  # (n, joints) rad/s or m/s
    qdd: np.ndarray  # (n, joints) rad/s^2 or m/s^2
    measured: np.ndarray  # (n, joints) N m or N
    predicted: np.ndarray  # (n, joints) N m or N
    used: np.ndarray  # (n, joints) bool: rows that count (not masked for low speed, saturation)
    travel: np.ndarray | None = None  # (n, joints) rad or m since the last reversal
    temperature: np.ndarray | None = None  # (n, joints) as logged; NaN where it was not
    full: FullRate | None = None  # None: the rows are all there is
    motors: tuple[Motor, ...] = ()
    sigma: np.ndarray | None = None  # (n, joints) N m or N, of `predicted` by the fit's covariance
    masks: np.ndarray | None = None  # (n, joints) why a row does not count, see observation.masks


def compute_residual(prediction: Prediction) -> np.ndarray:
    """Measured minus predicted torque, NaN where the row does not count, (n, joints)."""
    difference = np.asarray(prediction.measured - prediction.predicted, dtype=float)
    return np.where(prediction.used, difference, np.nan)


def select_full_rate(prediction: Prediction) -> FullRate:
    """The samples behind the rows, or the rows themselves."""
    if prediction.full is not None:
        return prediction.full
    e = compute_residual(prediction)
    return FullRate(prediction.run, prediction.time, prediction.q, e, e)


def compute_relative_error(prediction: Prediction) -> float:
    """||measured - predicted|| / ||measured|| over all rows that count; NaN without a torque."""
    used = prediction.used
    size = float(np.linalg.norm(prediction.measured[used]))
    error = float(np.linalg.norm(compute_residual(prediction)[used]))
    return error / size if size else math.nan


def compute_unit_errors(prediction: Prediction, rows: np.ndarray | None = None) -> dict[str, float]:
    """Relative error over all joints of one unit, by unit.

    Args:
        prediction: measured and predicted.
        rows: (n,) bool, those that are looked at; None: all.
    """
    used = prediction.used if rows is None else prediction.used & rows[:, None]
    left = np.where(used, prediction.measured - prediction.predicted, 0.0)
    measured = np.where(used, prediction.measured, 0.0)
    return pool_errors_by_unit(
        (info.effort_unit, float(left[:, j] @ left[:, j]), float(measured[:, j] @ measured[:, j]))
        for j, info in enumerate(prediction.joints)
    )


# How sure a predicted torque is, as far as the parameters of the model are.


DEVIATIONS = 2.0
"""Half width of a band in standard deviations: 95 % of normal errors."""


def propagate_covariance(columns: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """(s, n) standard deviation of the predicted torque, N m or N.

    For a row phi of the filtered regressor, tau = phi beta, so var(tau) = phi C phi^T with the
    covariance C of beta (propagation of errors; Gautier and Khalil 1991 give C). It says nothing
    of effects that the model lacks, nor of the noise of the measurement.

    Args:
        columns: (s, n, c) filtered regressor.
        covariance: (c, c) of beta.
    """
    deviation = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    scale = np.where(deviation > 0.0, deviation, 1.0)  # parameters have units of their own
    correlation = covariance / np.outer(scale, scale)
    values, vectors = np.linalg.eigh(0.5 * (correlation + correlation.T))
    root = scale[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))  # C = root root^T
    return np.asarray(np.sqrt(np.sum((columns @ root) ** 2, axis=2)))
