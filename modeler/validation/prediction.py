"""What the compare stage takes: measured and predicted torque on the same rows."""

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from modeler import regression
from modeler.core.json import ShortRepr, select_attributes
from modeler.core.table import pool_errors_by_unit
from modeler.estimation import IdentifiedModel
from modeler.numerics.filters import LEAST_WEIGHT, compute_moving_means
from modeler.runtime import CompiledModel
from modeler.validation.thresholds import THRESHOLDS


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
    """Returns measured minus predicted torque (n, joints), NaN where a row does not count."""
    difference = np.asarray(prediction.measured - prediction.predicted, dtype=float)
    return np.where(prediction.used, difference, np.nan)


def select_full_rate(prediction: Prediction) -> FullRate:
    """Returns the samples behind the rows, or the rows themselves."""
    if prediction.full is not None:
        return prediction.full
    e = compute_residual(prediction)
    return FullRate(prediction.run, prediction.time, prediction.q, e, e)


def compute_relative_error(prediction: Prediction) -> float:
    """Returns ||measured - predicted|| / ||measured|| over rows that count; NaN without torque."""
    used = prediction.used
    size = float(np.linalg.norm(prediction.measured[used]))
    error = float(np.linalg.norm(compute_residual(prediction)[used]))
    return error / size if size else math.nan


def compute_unit_errors(prediction: Prediction, rows: np.ndarray | None = None) -> dict[str, float]:
    """Computes the relative error over all joints of one unit, by unit.

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


# Uncertainty of a predicted torque, as far as the parameters of the model are.


def propagate_covariance(columns: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Returns (s, n) standard deviation of the predicted torque, N m or N.

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


# From a fitted model and logs, of any length, to measured and predicted torque.


def predict(
    model: IdentifiedModel, logs: Sequence[regression.Log], compiled: CompiledModel
) -> tuple[Prediction, regression.Observation]:
    """Predicts the torques of logs, processed as the logs of the fit.

    Args:
        model: fitted.
        logs: read with its manifest.
        compiled: its robot.

    Raises:
        DataError: no usable row.
    """
    observation = regression.observe(compiled, logs, model.processing)
    full = compute_full_rate(observation, compiled, model.beta)
    return dataclasses.replace(predict_rows(model, observation, compiled), full=full), observation


def predict_every_row(
    model: IdentifiedModel, log: regression.Log, compiled: CompiledModel
) -> tuple[np.ndarray, np.ndarray]:
    """Predicts the torques of every row of a log, behind the filter of the positions alone.

    The positions are taken as they are: at rest without torques, rows that repeat are no damage.

    Args:
        model: fitted.
        log: whose torques are not read.
        compiled: its robot.

    Returns:
        (rows, joints) torque, N m or N, NaN in gaps; (rows,) True where that filter had started up.
    """
    processing = dataclasses.replace(model.processing, keep_damaged=True)
    prepared = regression.prepare_logs(compiled.spec, [log], processing)
    segments, _ = regression.close_segments(compiled, [log], prepared.segments)
    torque, sure = np.full(log.q.shape, np.nan), np.zeros(log.rows, dtype=bool)
    at = log.time + model.processing.delay  # the torque of a row belongs to the motion there
    for s in segments:
        tau = compiled.inverse_dynamics(
            s.q, s.qd, s.qdd, model.beta, regression.compute_signals(compiled, s)
        )
        rows = np.flatnonzero((at >= s.time[0] - 0.5 * s.step) & (at <= s.time[-1] + 0.5 * s.step))
        torque[rows] = np.column_stack([np.interp(at[rows], s.time, effort) for effort in tau.T])
        sure[rows] = np.interp(at[rows], s.time, s.whole) > 1.0 - 1e-9
    return torque, sure


def predict_rows(
    model: IdentifiedModel, observation: regression.Observation, compiled: CompiledModel
) -> Prediction:
    """Predicts the torques of rows, without the samples behind them."""
    made = [
        (x @ model.beta, propagate_covariance(x, model.covariance))
        for _, x in regression.iterate_blocks(observation)
    ]
    predicted, sigma = (np.concatenate(parts) for parts in zip(*made, strict=True))
    return dataclasses.replace(
        build_prediction(observation, predicted),
        travel=_compute_travel(observation),
        temperature=_collect_temperature(observation),
        motors=_find_coupled_motors(compiled),
        sigma=sigma,
        masks=regression.classify_rows(observation),
    )


def build_prediction(observation: regression.Observation, predicted: np.ndarray) -> Prediction:
    """Builds a prediction of the rows from predicted torque (s, joints) alone."""
    joints: list[Any] = [(j.name, j.unit, j.effort_unit) for j in observation.joints]
    return Prediction(
        joints=tuple(JointInfo(*joint) for joint in joints),
        measured=observation.torque,
        predicted=predicted,
        **select_attributes(observation, "robot logs run segment time q qd qdd used"),
    )


def _compute_travel(observation: regression.Observation) -> np.ndarray:
    """(s, joints) since the last reversal of each joint, seen at full rate."""
    parts = observation.stretches
    every = np.concatenate([part.segment.q[part.segment.whole] for part in parts])
    least = THRESHOLDS.min_reversal * np.ptp(every, axis=0)
    travel_parts = []
    for part in parts:
        pairs = zip(part.segment.q.T, least, strict=True)
        travel = np.column_stack(
            [regression.compute_travel_since_reversal(q, turn) for q, turn in pairs]
        )
        travel_parts.append(travel[part.rows.centres])
    return np.concatenate(travel_parts)


def _collect_temperature(observation: regression.Observation) -> np.ndarray | None:
    """(s, joints) of `temperature<j>`, else of `temperature`; None if no log has either."""
    columns = []
    for part in observation.stretches:
        extra, none = part.segment.extra, np.full(part.segment.samples, np.nan)
        shared = extra.get("temperature", none)
        joint_columns = [
            extra.get(f"temperature{joint.name}", shared) for joint in observation.joints
        ]
        columns.append(np.column_stack(joint_columns)[part.rows.centres])
    temperature = np.concatenate(columns)
    return temperature if np.isfinite(temperature).any() else None


def compute_full_rate(
    observation: regression.Observation, compiled: CompiledModel, beta: np.ndarray
) -> FullRate:
    """Computes the samples behind the rows of an observation."""
    parts = observation.stretches
    cutoff = observation.report.processing.parallel_cutoff
    left = [_compute_residual(part, compiled, beta) for part in parts]
    return FullRate(
        run=np.concatenate([np.full(part.segment.samples, part.segment.run) for part in parts]),
        time=np.concatenate([part.segment.time for part in parts]),
        q=np.concatenate([part.segment.q for part in parts]),
        residual=np.concatenate(left),
        filtered=np.concatenate(
            [
                _smooth_residual(e, part.segment.step, cutoff)
                for part, e in zip(parts, left, strict=True)
            ]
        ),
    )


def _compute_residual(
    part: regression.FilteredSegment, compiled: CompiledModel, beta: np.ndarray
) -> np.ndarray:
    """(samples, joints) measured minus predicted torque, NaN where a sample does not count."""
    s = part.segment
    model = compiled.inverse_dynamics(
        s.q, s.qd, s.qdd, beta, regression.compute_signals(compiled, s)
    )
    return np.where(part.usable, s.tau - model, np.nan)


def _smooth_residual(e: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """What the rows hold, at every sample: means over samples that count."""
    counts = np.isfinite(e)
    share = compute_moving_means(counts.astype(float), step, cutoff)
    total = compute_moving_means(np.where(counts, e, 0.0), step, cutoff)
    return np.where(share >= LEAST_WEIGHT, total / np.where(share > 0.0, share, 1.0), np.nan)


def _find_coupled_motors(compiled: CompiledModel) -> tuple[Motor, ...]:
    """Motors whose friction the model has; in loops, speeds depend on the posture."""
    if compiled.spec.closure is not None:
        return ()
    coupled_shafts = [
        part for part in regression.find_shafts(compiled) if np.count_nonzero(part.coefficients) > 1
    ]
    return tuple(Motor(part.name, part.coefficients) for part in coupled_shafts)
