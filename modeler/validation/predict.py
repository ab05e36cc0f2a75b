"""From a fitted model and logs, of any length, to measured and predicted torque."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.json import entries
from modeler.estimation import IdentifiedModel, all_rows, by_threads
from modeler.numerics.filters import LEAST_WEIGHT, moving_means, spacing
from modeler.observation import (
    FINGER,
    Chunk,
    DataReport,
    Facts,
    Log,
    LogChoices,
    Observation,
    Source,
    Stretch,
    blocks,
    masks_of,
    observe,
    prepare,
    rows_of_chunk,
    shafts,
    signals_of,
    stacked,
    streamed_report,
    travel_since_reversal,
    without_open,
)
from modeler.runtime import CompiledModel
from modeler.validation.comparison import Comparison, compare
from modeler.validation.prediction import FullRate, JointInfo, Motor, Prediction, sigma_of

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
    full = full_rate(observation, compiled, model.beta)
    return dataclasses.replace(of_rows(model, observation, compiled), full=full), observation


def at_every_row(
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
    prepared = prepare(compiled.spec, [log], processing)
    segments, _ = without_open(compiled, [log], prepared.segments)
    torque, sure = np.full(log.q.shape, np.nan), np.zeros(log.rows, dtype=bool)
    at = log.time + model.processing.delay  # the torque of a row belongs to the motion there
    for s in segments:
        tau = compiled.inverse_dynamics(s.q, s.qd, s.qdd, model.beta, signals_of(compiled, s))
        rows = np.flatnonzero((at >= s.time[0] - 0.5 * s.step) & (at <= s.time[-1] + 0.5 * s.step))
        torque[rows] = np.column_stack([np.interp(at[rows], s.time, own) for own in tau.T])
        sure[rows] = np.interp(at[rows], s.time, s.whole) > 1.0 - 1e-9
    return torque, sure


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
    joints: list[Any] = [(j.name, j.unit, j.effort_unit) for j in observation.joints]
    return Prediction(
        joints=tuple(JointInfo(*joint) for joint in joints),
        measured=observation.torque,
        predicted=predicted,
        **entries(observation, "robot logs run segment time q qd qdd used"),
    )


def _travel(observation: Observation) -> np.ndarray:
    """(s, joints) since the last reversal of each joint, seen at full rate."""
    parts = observation.stretches
    every = np.concatenate([part.segment.q[part.segment.whole] for part in parts])
    least = _TURN * np.ptp(every, axis=0)
    found = []
    for part in parts:
        pairs = zip(part.segment.q.T, least, strict=True)
        travel = np.column_stack([travel_since_reversal(q, turn) for q, turn in pairs])
        found.append(travel[part.rows.centres])
    return np.concatenate(found)


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
    cutoff = observation.report.processing.parallel_cutoff
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
    model = compiled.inverse_dynamics(s.q, s.qd, s.qdd, beta, signals_of(compiled, s))
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


@dataclass(frozen=True, eq=False)
class _Part:
    """Some consecutive rows of a log: what is compared of each chunk, and what they say of it."""

    rows: tuple[Prediction, ...]
    facts: Facts

    def merged_with(self, later: "_Part") -> "_Part":
        """Of these rows, and of those that follow them."""
        return _Part(self.rows + later.rows, self.facts.merged_with(later.facts))


def compare_long(
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
    step = sources[0].window(0.5, 1000).step
    if least > spacing(step, processing.parallel_cutoff or 0.0, processing.decimation):
        processing = dataclasses.replace(processing, decimation=least)
    reducer = partial(by_threads, reduce_by=partial(_part, model))
    passes, parts = all_rows(compiled, sources, processing, progress, rows, reducer)
    looked = passes.found.observation
    steps = [own.step * own.decimation for own in passes.found.chosen]
    prediction = _joined([source.name for source in sources], [own.rows for own in parts], steps)
    full = full_rate(looked, compiled, model.beta)
    ripples = dataclasses.replace(on_rows(looked, looked.torque), full=full)
    report = streamed_report(compiled, sources, passes)
    return compare(prediction, ripples), dataclasses.replace(looked, report=report)


def _part(
    model: IdentifiedModel, compiled: CompiledModel, chunk: Chunk, chosen: LogChoices
) -> _Part:
    stretches, facts = rows_of_chunk(compiled, chunk, chosen)
    some = tuple(part for part in stretches if len(part.rows.centres))
    if not some:
        return _Part((), facts)
    report = DataReport(chosen.processing, (), (), ())
    return _Part(
        (of_rows(model, stacked(compiled, (chunk.log.name,), some, report), compiled),), facts
    )


def _joined(
    names: Sequence[str], logs: Sequence[Sequence[Prediction]], steps: Sequence[float]
) -> Prediction:
    """The rows of all logs, `steps` s apart; what goes on in the next chunk is one segment."""
    number, found = -1, list[Prediction]()
    for run, (parts, step) in enumerate(zip(logs, steps, strict=True)):
        last = -np.inf
        for part in parts:
            number += not 0.5 < (part.time[0] - last) / step < 1.5
            segment, runs = part.segment + number, np.full(len(part.time), run)
            found.append(dataclasses.replace(part, segment=segment, run=runs))
            number, last = int(segment[-1]), float(part.time[-1])
    if not found:
        raise DataError(f"{', '.join(names)}: no row is left; record longer motion")
    columns = [
        name for name in vars(found[0])
        if all(isinstance(getattr(part, name), np.ndarray) for part in found)
    ]  # fmt: skip
    every: dict[str, Any] = {"temperature": None} | {
        name: np.concatenate([getattr(part, name) for part in found]) for name in columns
    }
    return dataclasses.replace(found[0], logs=tuple(names), **every)
