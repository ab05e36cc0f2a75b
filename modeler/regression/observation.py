"""y = W beta: the rows of all logs through the compiled model and the parallel filter."""

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.core.result import Result
from modeler.numerics.filters import LEAST_WEIGHT
from modeler.regression.chunk import wrap_log
from modeler.regression.log import Log
from modeler.regression.motion import (
    BRIDGES,
    CAUSES,
    CONTRADICTED,
    EDGE,
    MISSING,
    OPEN,
    PUSHED,
    SATURATED,
    UNSETTLED,
    Segment,
)
from modeler.regression.prepare import PreparedLogs, close_segments
from modeler.regression.report import DataReport, build_joint_reports, build_log_report, count_rows
from modeler.regression.segments import (
    FilteredSegment,
    clear_resting_speeds,
    compute_signals,
    compute_speed_floors,
    compute_wide_floors,
    filter_segment,
    find_all_shafts,
    find_moving_samples,
    find_shafts,
    mask_unsettled_samples,
)
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import (
    CompiledModel,
    NonzeroPattern,
    Triangles,
    average_rows,
    make_empty_triangles,
    reduce_rows,
)

# The rows of y = W beta, and which is which.


@dataclass(frozen=True, eq=False)
class Observation(Result):
    """Filtered, decimated data of all logs: s samples, n joints, c base parameters.

    Attributes:
        robot: name.
        joints: order of the second axis below.
        names: (c,) base parameters, the columns.
        units: (c,) of the base parameters.
        logs: names of the logs.
        run: (s,) index into `logs`.
        segment: (s,) number of the uniform piece, unique over logs; never difference across it.
        time: (s,) s.
        q, qd, qdd: (s, n) motion, filtered alike.
        torque: (s, n) filtered torque, N m or N.
        used: (s, n) rows that count; the others are for pictures.
        stretches: full-rate data, for further columns.
        regressor: (b, n, c) at full rate, for the b samples of a segment in a window.
        report: what was done.
        steady: (s, n) rows that count and lie far from reversals; None where nothing rubs.
    """

    robot: str
    joints: tuple[JointSpec, ...]
    names: tuple[str, ...]
    units: tuple[str, ...]
    logs: tuple[str, ...]
    run: np.ndarray
    segment: np.ndarray
    time: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    torque: np.ndarray
    used: np.ndarray
    stretches: tuple[FilteredSegment, ...]
    regressor: Callable[[Segment, slice], np.ndarray]
    report: DataReport
    steady: np.ndarray | None = None

    @cached_property
    def columns(self) -> np.ndarray:
        """Returns the filtered regressor (s, n, c): torque = columns beta + residual."""
        return self.filter_columns(self.regressor)

    @cached_property
    def W(self) -> np.ndarray:
        """Returns the observation matrix (rows, c), joint after joint within each sample."""
        return self.columns[self.used]

    @cached_property
    def y(self) -> np.ndarray:
        """Returns the torques (rows,), N m or N."""
        return self.torque[self.used]

    @cached_property
    def row_sample(self) -> np.ndarray:
        """Returns the index (rows,) of the sample of each row."""
        return np.nonzero(self.used)[0]

    @cached_property
    def row_joint(self) -> np.ndarray:
        """Returns the index (rows,) of the joint of each row."""
        return np.nonzero(self.used)[1]

    @cached_property
    def row_run(self) -> np.ndarray:
        """Returns the index (rows,) of the log of each row."""
        return self.run[self.row_sample]

    @cached_property
    def driven(self) -> list[int]:
        """Returns the indices of the joints with a motor, rows and a torque."""
        motors = [j for j, joint in enumerate(self.joints) if joint.actuated]
        return [j for j in motors if self.torque[self.used[:, j], j].any()]

    @cached_property
    def whole(self) -> np.ndarray:
        """Returns (s, n) flags of rows that count, with weights all but wholly on usable samples.

        A row at the edge of a masked reversal is the mean of few samples, and what the filter makes
        of the sign of a speed there looks like physics.
        """
        shares = [part.rows.compute_usable_share(part.usable) for part in self.stretches]
        return self.used & (np.concatenate(shares) >= THRESHOLDS.complete_weight)

    def select_rows(self, used: np.ndarray) -> "Observation":
        """Returns the observation with other rows (s, n) that count."""
        ends = np.cumsum([len(part.used) for part in self.stretches])[:-1]
        pairs = zip(self.stretches, np.split(used, ends), strict=True)
        parts = tuple(dataclasses.replace(part, used=part_used) for part, part_used in pairs)
        return dataclasses.replace(self, used=used, stretches=parts)

    def predict(self, beta: np.ndarray) -> np.ndarray:
        """Returns (s, n) torque of the model, filtered like the measurement: columns beta."""
        return self.columns @ beta

    def filter_columns(self, evaluate: Callable[[Segment, slice], np.ndarray]) -> np.ndarray:
        """Returns further columns (s, n, ...) through the same filter, row by row as `columns`.

        Args:
            evaluate: (b, n, ...) for the b samples of a segment in a window.
        """
        parts = [(part, partial(evaluate, part.segment)) for part in self.stretches]
        return np.concatenate([part.filter_columns(function) for part, function in parts])


# A compiled model over the segments of an observation: its regressor, and what needs none.


class ModelRegressor:
    """The base regressor over the samples of a segment, with what its effects read."""

    def __init__(self, model: CompiledModel, stretches: Sequence[FilteredSegment]) -> None:
        self._model = model
        self._signals = {part.segment: compute_signals(model, part.segment) for part in stretches}

    def __call__(self, s: Segment, w: slice | np.ndarray) -> np.ndarray:
        """Returns (b, n, c) for the b samples of a window, or of indices."""
        return self._model.base_regressor(s.q[w], s.qd[w], s.qdd[w], self._read_signals(s, w))

    @property
    def is_tree(self) -> bool:
        """Returns True without loops, which close at some positions only."""
        return self._model.spec.closure is None

    def evaluate_motion(self, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
        """Returns (m, n, c) along another motion; what effects read is that of some samples."""
        read = next(iter(self._signals.values()))
        if read is not None:
            read = read[np.linspace(0, len(read) - 1, len(q)).astype(int)]
        return self._model.base_regressor(q, qd, qdd, read)

    @property
    def pattern(self) -> NonzeroPattern:
        """Returns which columns can enter the torque of each joint."""
        return self._model.pattern

    def compute_torque(
        self, s: Segment, w: slice | np.ndarray, beta: np.ndarray, turn: np.ndarray | None = None
    ) -> np.ndarray:
        """Returns (b, n) torque of the model, by the inverse dynamics; w may be indices.

        With a turn (n, n) the motion is q turn instead of q.
        """
        motion = s.q[w], s.qd[w], s.qdd[w]
        q, qd, qdd = motion if turn is None else (x @ turn for x in motion)
        return self._model.inverse_dynamics(q, qd, qdd, beta, self._read_signals(s, w))

    def add_means(
        self, part: FilteredSegment, torque: np.ndarray, use: np.ndarray, state: Triangles
    ) -> Triangles:
        """Returns triangles with the rows of a segment added; as `add_stretch`."""
        s, model = part.segment, self._model
        if model.has_entries:
            motion = s.q, s.qd, s.qdd
            return model.mean_triangles(
                motion, self._signals[s], torque, part.rows.kernels, part.usable, use, state
            )
        for rows, columns in part.iterate_blocks(
            partial(self, s), THRESHOLDS.triangle_block_samples, self.pattern.spans
        ):
            used = np.ascontiguousarray(use[rows])
            state = reduce_rows(state.pattern, columns, torque[rows], used, state)
        return state

    def _read_signals(self, s: Segment, w: slice | np.ndarray) -> np.ndarray | None:
        read = self._signals[s]
        return None if read is None else read[w]


def build_observation(
    model: CompiledModel, logs: Sequence[Log], prepared: PreparedLogs, every_joint: bool = False
) -> Observation:
    """Returns the observation of logs that are prepared already, for this or a like robot.

    Raises:
        DataError: no usable row.
        LoopError: hardly a sample closes the loops.
    """
    segments, open_times = close_segments(model, logs, prepared.segments)
    segments = tuple(mask_unsettled_samples(model.spec, segment) for segment in segments)
    parts = find_all_shafts(model) if every_joint else find_shafts(model)
    seen = prepared.processing, parts, segments
    floors = compute_speed_floors(*seen, prepared.noise)
    chosen = dataclasses.replace(prepared.processing, speed_floors=floors)
    still = [name for name, floor in floors.items() if floor == float("inf")]
    segments = clear_resting_speeds(segments, parts, still)
    stretches = tuple(filter_segment(segment, parts, chosen) for segment in segments)
    tallies, reports = [], []
    for run, (log, times, of) in enumerate(zip(logs, open_times, prepared.logs, strict=True)):
        log_stretches = [part for part in stretches if part.segment.run == run]
        whole = count_rows(wrap_log(log), of.pieces, of.cuts, log_stretches, of.check)
        wrong = of.check.contradictions if of.check else ()
        decimation = max((part.decimation for part in log_stretches), default=1)
        tallies.append(whole)
        facts = whole, of.defects, wrong, decimation, times
        reports.append(build_log_report(log, model.spec, of, *facts))
    joints = build_joint_reports(model.spec.joints, parts, floors, tallies)
    known = prepared.noise, prepared.band, prepared.lowered
    report = DataReport(chosen, prepared.choices, tuple(reports), joints, *known)
    if parts and all(floor == float("inf") for floor in floors.values()):
        names = ", ".join(log.name for log in logs)
        raise DataError(f"{names}: no joint moves; expected a motion; move every joint")
    if not any(part.used.any() for part in stretches):
        raise build_no_row_error(report)
    rows = assemble_observation(model, [log.name for log in logs], stretches, report)
    if every_joint or not parts:
        return rows
    wide, far = compute_wide_floors(*seen, prepared.noise), []
    margin = THRESHOLDS.reversal_periods / chosen.position_cutoff if chosen.position_cutoff else 0.0
    for part in stretches:
        usable = part.segment.valid & find_moving_samples(part.segment, parts, wide, margin)
        far.append(part.used & (part.rows.compute_usable_share(usable) >= LEAST_WEIGHT))
    return dataclasses.replace(rows, steady=np.concatenate(far))


def build_no_row_error(report: DataReport) -> DataError:
    """Returns what is reported about logs without a usable row."""
    notes = [f"{log.name}: {note}" for log in report.logs for note in log.notes]
    return DataError(
        f"{', '.join(log.name for log in report.logs)}: no usable row is left: "
        + "; ".join([*(joint.format_line() for joint in report.joints), *notes])
        + "; check these columns, or record longer and faster motion of every joint"
    )


def rebuild_observation(model: CompiledModel, like: Observation) -> Observation:
    """Returns the observation of another robot, of logs that mask the same samples."""
    return dataclasses.replace(like, **_describe_columns(model, like.stretches))


def _describe_columns(model: CompiledModel, stretches: Sequence[FilteredSegment]) -> dict[str, Any]:
    """Returns what an observation has of its robot."""
    spec, regressor = model.spec, ModelRegressor(model, stretches)
    names, units = (tuple(getattr(b, of) for b in spec.base) for of in ("name", "unit"))
    columns = {"names": names, "units": units, "regressor": regressor}
    return {"robot": spec.robot, "joints": spec.joints, **columns}


def assemble_observation(
    model: CompiledModel,
    logs: Sequence[str],
    stretches: tuple[FilteredSegment, ...],
    report: DataReport,
) -> Observation:
    """Returns the rows of some segments of logs of these names, with notes on them."""
    motion = np.concatenate([_filter_motion(part) for part in stretches])
    counts = [len(part.rows.centres) for part in stretches]
    return Observation(
        **_describe_columns(model, stretches),
        logs=tuple(logs),
        run=np.repeat([part.segment.run for part in stretches], counts),
        segment=np.repeat(np.arange(len(stretches)), counts),
        time=np.concatenate([part.segment.time[part.rows.centres] for part in stretches]),
        q=motion[:, 0],
        qd=motion[:, 1],
        qdd=motion[:, 2],
        torque=np.concatenate([part.filter_torque() for part in stretches]),
        used=np.concatenate([part.used for part in stretches]),
        stretches=stretches,
        report=report,
    )


def _filter_motion(part: FilteredSegment) -> np.ndarray:
    """Returns (rows, 3, joints) q, qd, qdd over all whole samples."""
    s, every = part.segment, np.ones((len(part.used), 3), dtype=bool)
    motion, usable = np.stack([s.q, s.qd, s.qdd], axis=1), np.stack([s.whole] * 3, axis=1)
    return average_rows(part.rows.kernels, motion, usable, every, s.whole)


# Why a row does not count, for those who draw it.


WHY = {
    "low speed": "the joint moves so slowly that the sign of its friction is doubtful",
    "torque at its limit": "the drive gave all it could, so the torque is not what was asked",
    "no good value": "a position or torque is missing or damaged, or lies beside one that is",
    "impossible derivative": "a logged speed or acceleration is not that of the positions",
    "filter end": "the position filter still starts up there",
    "loops open": "the loops cannot be closed with these positions",
    "push": "something pushed on the robot, which `modeler add` left out",
    "unknown state": "the state of a bristle or cable at the start is not forgotten yet",
}
"""In short, for legends, and in a sentence."""

MASKS = tuple(WHY)

_OF = {
    EDGE: "filter end",
    MISSING: "no good value",
    BRIDGES: "no good value",
    CONTRADICTED: "impossible derivative",
    SATURATED: "torque at its limit",
    OPEN: "loops open",
    PUSHED: "push",
    UNSETTLED: "unknown state",
}


def classify_rows(observation: Observation) -> np.ndarray:
    """Returns (s, n) place in MASKS of what most weight of a row falls on; -1 where the row counts.

    Args:
        observation: of logs.
    """
    of = np.array([MASKS.index(_OF[name]) for name in CAUSES] + [0])  # the last: low speed
    masks = []
    for part in observation.stretches:
        flags = np.where(part.usable, -1, of[part.segment.cause])
        shares = np.stack([part.rows.compute_usable_share(flags == k) for k in range(len(MASKS))])
        masks.append(np.where(part.used, -1, np.argmax(shares, axis=0)).astype(np.int8))
    return np.concatenate(masks)


# The torque of a model over the samples of an observation, through the filter of its rows.


def compute_model_torque(
    observation: Observation, model: CompiledModel, beta: np.ndarray, turn: np.ndarray | None = None
) -> np.ndarray:
    """Returns (s, n) `observation.predicted(beta)` without its columns, by the inverse dynamics.

    Args:
        observation: of the robot.
        model: it, or one with other effects on the same joints.
        beta: (c,) base parameters of the model.
        turn: (n, n) if given, the motion is q turn instead of q.
    """
    torque = ModelRegressor(model, observation.stretches).compute_torque
    return observation.filter_columns(partial(torque, beta=beta, turn=turn))


KEPT = 2**26
"""Bytes of the filtered regressor up to which it is kept."""


def is_streamed(observation: Observation) -> bool:
    """Returns True if W is not built: it would be large, and nobody has requested it yet.

    What passes by is the regressor of a compiled model; another one is kept.
    """
    large = 8 * observation.used.size * len(observation.names) > KEPT
    compiled = isinstance(observation.regressor, ModelRegressor)
    return large and compiled and "columns" not in vars(observation)


def iterate_blocks(observation: Observation) -> Iterator[tuple[slice, np.ndarray]]:
    """Yields samples (b of them) and their filtered regressor (b, n, c), in order."""
    for part, part_rows in _iterate_stretches(observation):
        for rows, columns in part.iterate_blocks(partial(observation.regressor, part.segment)):
            yield slice(part_rows.start + rows.start, part_rows.start + rows.stop), columns


def evaluate_columns_at(observation: Observation, places: np.ndarray) -> np.ndarray:
    """Returns (m, n, c) filtered regressor of some samples (m,), ascending."""
    compiled = isinstance(observation.regressor, ModelRegressor)
    if not compiled or "columns" in vars(observation):
        return np.asarray(observation.columns[places])
    columns = []
    for part, part_rows in _iterate_stretches(observation):
        rows = places[(places >= part_rows.start) & (places < part_rows.stop)] - part_rows.start
        if rows.size:
            columns.append(part.filter_rows(rows, partial(observation.regressor, part.segment)))
    return np.concatenate(columns)


def compute_fitted_torque(
    observation: Observation, beta: np.ndarray, keep: np.ndarray
) -> np.ndarray:
    """Returns (s, n) torque of the model, `columns beta`, where keep (s, n); 0 elsewhere."""
    regressor = observation.regressor
    assert isinstance(regressor, ModelRegressor)
    torque = partial(regressor.compute_torque, beta=beta)
    return np.where(keep, observation.filter_columns(torque), 0.0)


def compute_triangles(observation: Observation, keep: np.ndarray) -> Triangles:
    """Returns triangles of [W_j y_j] over the rows keep (s, n) bool."""
    regressor = observation.regressor
    assert isinstance(regressor, ModelRegressor)
    state = make_empty_triangles(regressor.pattern)
    for part, part_rows in _iterate_stretches(observation):
        state = add_stretch(regressor, part, observation.torque[part_rows], keep[part_rows], state)
    return state


def add_stretch(
    regressor: ModelRegressor,
    part: FilteredSegment,
    torque: np.ndarray,
    keep: np.ndarray,
    state: Triangles,
) -> Triangles:
    """Returns triangles with the rows of a segment added.

    Args:
        regressor: over its samples.
        part: the segment.
        torque: (rows, n) filtered.
        keep: (rows, n) bool.
        state: before.
    """
    if not keep.any():
        return state
    return regressor.add_means(part, torque, keep, state)


def _iterate_stretches(observation: Observation) -> Iterator[tuple[FilteredSegment, slice]]:
    first = 0
    for part in observation.stretches:
        count = len(part.rows.centres)
        yield part, slice(first, first + count)
        first += count
