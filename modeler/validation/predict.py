"""From a fitted model and logs, of any length, to measured and predicted torque."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.json import select_attributes
from modeler.estimation import IdentifiedModel, read_all_rows, reduce_by_threads
from modeler.numerics.filters import LEAST_WEIGHT, choose_row_spacing, compute_moving_means
from modeler.regression import (
    FINGER,
    Chunk,
    DataReport,
    FilteredSegment,
    Log,
    LogChoices,
    LogFacts,
    Observation,
    Source,
    assemble_observation,
    build_chunk_rows,
    build_streamed_report,
    classify_rows,
    close_segments,
    compute_signals,
    compute_travel_since_reversal,
    find_shafts,
    iterate_blocks,
    observe,
    prepare_logs,
)
from modeler.runtime import CompiledModel
from modeler.validation.comparison import Comparison, compare
from modeler.validation.prediction import (
    FullRate,
    JointInfo,
    Motor,
    Prediction,
    propagate_covariance,
)

_TURN = 1e-3  # of the stroke in all logs: a shorter way back is no reversal, but noise

MOST = 400_000
"""Rows of a comparison, after decimation; of longer logs fewer rows are taken."""


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
    full = compute_full_rate(observation, compiled, model.beta)
    return dataclasses.replace(predict_rows(model, observation, compiled), full=full), observation


def predict_every_row(
    model: IdentifiedModel, log: Log, compiled: CompiledModel
) -> tuple[np.ndarray, np.ndarray]:
    """What the model says of every row of a log, behind the filter of the positions alone.

    The positions are taken as they are: at rest without torques, rows that repeat are no damage.

    Args:
        model: fitted.
        log: whose torques are not read.
        compiled: its robot.

    Returns:
        (rows, joints) torque, N m or N, NaN in gaps; (rows,) True where that filter had started up.
    """
    processing = dataclasses.replace(model.processing, keep_damaged=True)
    prepared = prepare_logs(compiled.spec, [log], processing)
    segments, _ = close_segments(compiled, [log], prepared.segments)
    torque, sure = np.full(log.q.shape, np.nan), np.zeros(log.rows, dtype=bool)
    at = log.time + model.processing.delay  # the torque of a row belongs to the motion there
    for s in segments:
        tau = compiled.inverse_dynamics(s.q, s.qd, s.qdd, model.beta, compute_signals(compiled, s))
        rows = np.flatnonzero((at >= s.time[0] - 0.5 * s.step) & (at <= s.time[-1] + 0.5 * s.step))
        torque[rows] = np.column_stack(
            [np.interp(at[rows], s.time, joint_torque) for joint_torque in tau.T]
        )
        sure[rows] = np.interp(at[rows], s.time, s.whole) > 1.0 - 1e-9
    return torque, sure


def predict_rows(
    model: IdentifiedModel, observation: Observation, compiled: CompiledModel
) -> Prediction:
    """What the model says of rows, without the samples behind them."""
    made = [
        (x @ model.beta, propagate_covariance(x, model.covariance))
        for _, x in iterate_blocks(observation)
    ]
    predicted, sigma = (np.concatenate(parts) for parts in zip(*made, strict=True))
    return dataclasses.replace(
        build_prediction(observation, predicted),
        travel=_compute_travel(observation),
        temperature=_collect_temperature(observation),
        motors=_find_coupled_motors(compiled),
        sigma=sigma,
        masks=classify_rows(observation),
    )


def build_prediction(observation: Observation, predicted: np.ndarray) -> Prediction:
    """Measured and predicted torque (s, joints) on the rows, and nothing besides."""
    joints: list[Any] = [(j.name, j.unit, j.effort_unit) for j in observation.joints]
    return Prediction(
        joints=tuple(JointInfo(*joint) for joint in joints),
        measured=observation.torque,
        predicted=predicted,
        **select_attributes(observation, "robot logs run segment time q qd qdd used"),
    )


def _compute_travel(observation: Observation) -> np.ndarray:
    """(s, joints) since the last reversal of each joint, seen at full rate."""
    parts = observation.stretches
    every = np.concatenate([part.segment.q[part.segment.whole] for part in parts])
    least = _TURN * np.ptp(every, axis=0)
    travel_parts = []
    for part in parts:
        pairs = zip(part.segment.q.T, least, strict=True)
        travel = np.column_stack([compute_travel_since_reversal(q, turn) for q, turn in pairs])
        travel_parts.append(travel[part.rows.centres])
    return np.concatenate(travel_parts)


def _collect_temperature(observation: Observation) -> np.ndarray | None:
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
    observation: Observation, compiled: CompiledModel, beta: np.ndarray
) -> FullRate:
    """The samples behind the rows of an observation."""
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
    part: FilteredSegment, compiled: CompiledModel, beta: np.ndarray
) -> np.ndarray:
    """(samples, joints) measured minus predicted torque, NaN where a sample does not count."""
    s = part.segment
    model = compiled.inverse_dynamics(s.q, s.qd, s.qdd, beta, compute_signals(compiled, s))
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
        part for part in find_shafts(compiled) if np.count_nonzero(part.coefficients) > 1
    ]
    return tuple(Motor(part.name, part.coefficients) for part in coupled_shafts)


@dataclass(frozen=True, eq=False)
class _ChunkPrediction:
    """Some consecutive rows of a log: what is compared of each chunk, and what they say of it."""

    rows: tuple[Prediction, ...]
    facts: LogFacts

    def merged_with(self, later: "_ChunkPrediction") -> "_ChunkPrediction":
        """Of these rows, and of those that follow them."""
        return _ChunkPrediction(self.rows + later.rows, self.facts.merged_with(later.facts))


def compare_long_logs(
    model: IdentifiedModel,
    sources: Sequence[Source],
    compiled: CompiledModel,
    progress: Callable[[float], None] = lambda share: None,
    rows: int = FINGER,
) -> tuple[Comparison, Observation]:
    """As `compare` of what `predict` makes of logs, of any length in flat memory.

    Args:
        model: fitted.
        sources: of the logs.
        compiled: its robot.
        progress: is told the share of the rows that are done.
        rows: of a chunk, at least.

    Raises:
        DataError: as `estimation.long_logs.stream`.
    """
    processing = model.processing
    least = -(-sum(source.rows for source in sources) // MOST)
    step = sources[0].read_window(0.5, 1000).step
    if least > choose_row_spacing(step, processing.parallel_cutoff or 0.0, processing.decimation):
        processing = dataclasses.replace(processing, decimation=least)
    reducer = partial(reduce_by_threads, reduce_by=partial(_predict_chunk, model))
    passes, parts = read_all_rows(compiled, sources, processing, progress, rows, reducer)
    ripple_windows = passes.survey.observation
    steps = [log_part.step * log_part.decimation for log_part in passes.survey.chosen]
    prediction = _join_chunks(
        [source.name for source in sources], [log_part.rows for log_part in parts], steps
    )
    full = compute_full_rate(ripple_windows, compiled, model.beta)
    ripples = dataclasses.replace(
        build_prediction(ripple_windows, ripple_windows.torque), full=full
    )
    report = build_streamed_report(compiled, sources, passes)
    return compare(prediction, ripples), dataclasses.replace(ripple_windows, report=report)


def _predict_chunk(
    model: IdentifiedModel, compiled: CompiledModel, chunk: Chunk, chosen: LogChoices
) -> _ChunkPrediction:
    stretches, facts = build_chunk_rows(compiled, chunk, chosen)
    some = tuple(part for part in stretches if len(part.rows.centres))
    if not some:
        return _ChunkPrediction((), facts)
    report = DataReport(chosen.processing, (), (), ())
    return _ChunkPrediction(
        (
            predict_rows(
                model, assemble_observation(compiled, (chunk.log.name,), some, report), compiled
            ),
        ),
        facts,
    )


def _join_chunks(
    names: Sequence[str], logs: Sequence[Sequence[Prediction]], steps: Sequence[float]
) -> Prediction:
    """The rows of all logs, `steps` s apart; what goes on in the next chunk is one segment."""
    number, chunks = -1, list[Prediction]()
    for run, (parts, step) in enumerate(zip(logs, steps, strict=True)):
        last = -np.inf
        for part in parts:
            number += not 0.5 < (part.time[0] - last) / step < 1.5
            segment, runs = part.segment + number, np.full(len(part.time), run)
            chunks.append(dataclasses.replace(part, segment=segment, run=runs))
            number, last = int(segment[-1]), float(part.time[-1])
    if not chunks:
        raise DataError(f"{', '.join(names)}: no row is left; record longer motion")
    columns = [
        name for name in vars(chunks[0])
        if all(isinstance(getattr(part, name), np.ndarray) for part in chunks)
    ]  # fmt: skip
    every: dict[str, Any] = {"temperature": None} | {
        name: np.concatenate([getattr(part, name) for part in chunks]) for name in columns
    }
    return dataclasses.replace(chunks[0], logs=tuple(names), **every)
