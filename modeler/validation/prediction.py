"""What the compare stage takes: measured and predicted torque on the same rows."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import DataError, ShapeError
from modeler.core.table import errors_by_unit

_MATRICES = ("q", "qd", "qdd", "measured", "predicted")
_FURTHER = ("travel", "temperature", "sigma", "masks")


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
class FullRate(Brief):
    """The samples from which the rows were made; m samples, stacked log after log."""

    run: np.ndarray  # (m,) index into logs
    time: np.ndarray  # (m,) s, as in the log
    q: np.ndarray  # (m, joints) rad or m
    residual: np.ndarray  # (m, joints) N m or N, not filtered; NaN where it does not count
    filtered: np.ndarray  # (m, joints) through the filter of the rows; NaN where it cannot count


@dataclass(frozen=True, eq=False)
class Prediction(Brief):
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


def residual(prediction: Prediction) -> np.ndarray:
    """Measured minus predicted torque, NaN where the row does not count, (n, joints)."""
    difference = np.asarray(prediction.measured - prediction.predicted, dtype=float)
    return np.where(prediction.used, difference, np.nan)


def full_rate(prediction: Prediction) -> FullRate:
    """The samples behind the rows, or the rows themselves."""
    if prediction.full is not None:
        return prediction.full
    e = residual(prediction)
    return FullRate(prediction.run, prediction.time, prediction.q, e, e)


def relative_error(prediction: Prediction) -> float:
    """||measured - predicted|| / ||measured|| over all rows that count; NaN without a torque."""
    used = prediction.used
    size = float(np.linalg.norm(prediction.measured[used]))
    error = float(np.linalg.norm(residual(prediction)[used]))
    return error / size if size else math.nan


def unit_errors(prediction: Prediction, rows: np.ndarray | None = None) -> dict[str, float]:
    """Relative error over all joints of one unit, by unit.

    Args:
        prediction: measured and predicted.
        rows: (n,) bool, those that are looked at; None: all.
    """
    used = prediction.used if rows is None else prediction.used & rows[:, None]
    left = np.where(used, prediction.measured - prediction.predicted, 0.0)
    measured = np.where(used, prediction.measured, 0.0)
    return errors_by_unit(
        (info.effort_unit, float(left[:, j] @ left[:, j]), float(measured[:, j] @ measured[:, j]))
        for j, info in enumerate(prediction.joints)
    )


def check_prediction(prediction: Prediction) -> None:
    """Refuse a prediction that cannot be judged.

    Raises:
        ShapeError: an array does not have its rows, its columns, or its type.
        DataError: no row counts, a value that counts is not finite, or time runs backwards.
    """
    _check_shapes(prediction)
    if not prediction.used.any():
        raise DataError(
            f"{prediction.robot}: none of the {prediction.time.size} samples counts (all are "
            "masked); expected at least one used row; relax the low-speed or saturation mask, "
            "or give a log in which the robot moves"
        )
    for name in _MATRICES:
        _check_finite(prediction, name)
    _check_order(prediction)


def _check_shapes(prediction: Prediction) -> None:
    rows, columns = prediction.time.size, len(prediction.joints)
    if columns == 0:
        raise ShapeError("joints: got none; expected at least one joint to compare")
    further = [n for n in _FURTHER if getattr(prediction, n) is not None]
    expected: dict[str, tuple[int, ...]] = dict.fromkeys(("time", "run", "segment"), (rows,))
    expected |= dict.fromkeys((*_MATRICES, "used", *further), (rows, columns))
    _check_arrays(prediction, expected)
    if prediction.full is not None:
        rows = prediction.full.time.size
        expected = {"run": (rows,)}
        expected |= dict.fromkeys(("q", "residual", "filtered"), (rows, columns))
        _check_arrays(prediction.full, expected, "full.")
    if prediction.used.dtype != np.bool_:
        raise ShapeError(
            f"used: got {prediction.used.dtype}, expected bool; write `used.astype(bool)`"
        )
    outside = (prediction.run < 0) | (prediction.run >= len(prediction.logs))
    if outside.any():
        raise ShapeError(
            f"run: got log index {prediction.run[outside][0]}, expected 0 to "
            f"{len(prediction.logs) - 1} ({len(prediction.logs)} logs); name every log in `logs`"
        )


def _check_arrays(thing: object, expected: Mapping[str, tuple[int, ...]], head: str = "") -> None:
    rows, columns = max(expected.values(), key=len)
    for name, shape in expected.items():
        got = np.shape(getattr(thing, name))
        if got != shape:
            raise ShapeError(
                f"{head}{name}: got shape {got}, expected {shape} ({rows} samples, {columns} "
                "joints); give one row per sample and one column per joint"
            )


def _check_finite(prediction: Prediction, name: str) -> None:
    bad = prediction.used & ~np.isfinite(getattr(prediction, name))
    if bad.any():
        row, column = np.argwhere(bad)[0]
        raise DataError(
            f"{prediction.logs[prediction.run[row]]}: {name} of joint "
            f"{prediction.joints[column].name} is {getattr(prediction, name)[row, column]} at "
            f"{prediction.time[row]:.6g} s ({int(bad.sum())} such values); expected finite numbers "
            "in every row that counts; repair the log or mask these rows"
        )


def _check_order(prediction: Prediction) -> None:
    if not np.isfinite(prediction.time).all():
        row = int(np.flatnonzero(~np.isfinite(prediction.time))[0])
        raise DataError(
            f"{prediction.logs[prediction.run[row]]}: time of row {row} is "
            f"{prediction.time[row]}; expected a finite number of seconds; repair the log"
        )
    same = np.diff(prediction.segment) == 0
    if (same & (np.diff(prediction.run) != 0)).any():
        row = int(np.flatnonzero(same & (np.diff(prediction.run) != 0))[0]) + 1
        raise DataError(
            f"{prediction.logs[prediction.run[row]]}: segment {prediction.segment[row]} goes on "
            "from another log; expected segment numbers unique over the logs; renumber them"
        )
    backwards = same & (np.diff(prediction.time) <= 0)
    if backwards.any():
        row = int(np.flatnonzero(backwards)[0]) + 1
        raise DataError(
            f"{prediction.logs[prediction.run[row]]}: time goes from {prediction.time[row - 1]:.6g}"
            f" to {prediction.time[row]:.6g} s inside segment {prediction.segment[row]}; expected "
            "increasing time; sort the log or start a new segment there"
        )


# How sure a predicted torque is, as far as the parameters of the model are.


DEVIATIONS = 2.0
"""Half width of a band in standard deviations: 95 % of normal errors."""


def sigma_of(columns: np.ndarray, covariance: np.ndarray) -> np.ndarray:
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
