"""From a fitted model and logs to measured and predicted torque."""

import dataclasses
from collections.abc import Sequence
from typing import Literal, cast

import numpy as np

from modeler.compare.band import sigma_of
from modeler.compare.prediction import FullRate, JointInfo, Motor, Prediction
from modeler.compiled import CompiledModel
from modeler.fit import IdentifiedModel
from modeler.observation import Log, Observation, observe
from modeler.observation.dry_friction import shafts
from modeler.observation.masks import masks_of
from modeler.observation.passing import blocks
from modeler.observation.row_filter import LEAST_WEIGHT, moving_means
from modeler.observation.signals import signals_of
from modeler.observation.stretch import Stretch
from modeler.observation.travel import travel_since_reversal

_TURN = 1e-3  # of the stroke in all logs: a shorter way back is no reversal, but noise


def predict(
    model: IdentifiedModel, logs: Sequence[Log], compiled: CompiledModel
) -> tuple[Prediction, Observation]:
    """What the model says of logs, processed as the logs it was fitted on.

    Args:
        model: fitted.
        logs: read with its manifest.
        compiled: its robot.

    Raises:
        DataError: no usable row.
    """
    observation = observe(compiled, logs, model.processing)
    full = full_rate(observation, compiled, model.beta)
    return dataclasses.replace(of_rows(model, observation, compiled), full=full), observation


def of_rows(
    model: IdentifiedModel, observation: Observation, compiled: CompiledModel
) -> Prediction:
    """What the model says of rows, without the samples behind them."""
    made = [(x @ model.beta, sigma_of(x, model.covariance)) for _, x in blocks(observation)]
    predicted, sigma = (np.concatenate(parts) for parts in zip(*made, strict=True))
    return dataclasses.replace(
        on_rows(observation, predicted),
        travel=_travel(observation),
        temperature=_temperature(observation),
        motors=_motors(compiled),
        sigma=sigma,
        masks=masks_of(observation),
    )


def on_rows(observation: Observation, predicted: np.ndarray) -> Prediction:
    """Measured and predicted torque (s, joints) on the rows, and nothing besides."""
    return Prediction(
        robot=observation.robot,
        joints=tuple(
            JointInfo(
                joint.name,
                cast(Literal["rad", "m"], joint.unit),
                cast(Literal["N m", "N"], joint.effort_unit),
            )
            for joint in observation.joints
        ),
        logs=observation.logs,
        run=observation.run,
        segment=observation.segment,
        time=observation.time,
        q=observation.q,
        qd=observation.qd,
        qdd=observation.qdd,
        measured=observation.torque,
        predicted=predicted,
        used=observation.used,
    )


def _travel(observation: Observation) -> np.ndarray:
    """(s, joints) since the last reversal of each joint, seen at full rate."""
    parts = observation.stretches
    every = np.concatenate([part.segment.q[part.segment.whole] for part in parts])
    least = _TURN * np.ptp(every, axis=0)
    return np.concatenate(
        [
            np.column_stack(
                [travel_since_reversal(q, turn) for q, turn in zip(part.segment.q.T, least,
                                                                   strict=True)]
            )[part.rows.centres]
            for part in parts
        ]
    )  # fmt: skip


def _temperature(observation: Observation) -> np.ndarray | None:
    """(s, joints) of `temperature<j>`, else of `temperature`; None if no log has either."""
    columns = []
    for part in observation.stretches:
        extra, none = part.segment.extra, np.full(part.segment.samples, np.nan)
        shared = extra.get("temperature", none)
        own = [extra.get(f"temperature{joint.name}", shared) for joint in observation.joints]
        columns.append(np.column_stack(own)[part.rows.centres])
    found = np.concatenate(columns)
    return found if np.isfinite(found).any() else None


def full_rate(observation: Observation, compiled: CompiledModel, beta: np.ndarray) -> FullRate:
    """The samples behind the rows of an observation."""
    parts = observation.stretches
    cutoff = observation.report.processing.parallel_cutoff or 0.0
    left = [_left(part, compiled, beta) for part in parts]
    return FullRate(
        run=np.concatenate([np.full(part.segment.samples, part.segment.run) for part in parts]),
        time=np.concatenate([part.segment.time for part in parts]),
        q=np.concatenate([part.segment.q for part in parts]),
        residual=np.concatenate(left),
        filtered=np.concatenate(
            [_smoothed(e, part.segment.step, cutoff) for part, e in zip(parts, left, strict=True)]
        ),
    )


def _left(part: Stretch, compiled: CompiledModel, beta: np.ndarray) -> np.ndarray:
    """(samples, joints) measured minus predicted torque, NaN where a sample does not count."""
    s = part.segment
    model = compiled.inverse_dynamics(s.q, s.qd, s.qdd, beta, signals_of(compiled.spec, s))
    return np.where(part.usable, s.tau - model, np.nan)


def _smoothed(e: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """What the rows hold, at every sample: means over samples that count."""
    counts = np.isfinite(e)
    share = moving_means(counts.astype(float), step, cutoff)
    total = moving_means(np.where(counts, e, 0.0), step, cutoff)
    return np.where(share >= LEAST_WEIGHT, total / np.where(share > 0.0, share, 1.0), np.nan)


def _motors(compiled: CompiledModel) -> tuple[Motor, ...]:
    """Motors whose friction the model has; in loops, speeds depend on the posture."""
    if compiled.spec.closure is not None:
        return ()
    found = [part for part in shafts(compiled) if np.count_nonzero(part.coefficients) > 1]
    return tuple(Motor(part.name, part.coefficients) for part in found)
