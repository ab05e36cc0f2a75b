"""One log of a fleet, read once: triangles and what its residuals remember, no rows."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.core.manifest import EmittedModule
from modeler.estimation import (
    estimate_correlation,
    find_contradictions,
    find_disconnected_joints,
    find_log_faults,
    identify,
    solve_least_squares,
    sum_lagged_products,
)
from modeler.fleet.naming import LogName
from modeler.logs import LogMap
from modeler.numerics.least_squares import CompressedRegression, compress_rows
from modeler.regression import Log, Observation, Processing, cut_window, observe, read_log
from modeler.runtime import CompiledModel, load_cached_model

TEMPERATURE = "temperature"
"""How the names of columns of temperatures begin; the rest is the joint, or nothing."""


@dataclass(frozen=True, eq=False)
class LogJob:
    """What a worker needs to reduce a log; it can be sent to another process or machine.

    Attributes:
        named: machine, period and place.
        path: the file.
        span: seconds of it that count; None: all.
        processing: None: chosen from this log.
        mapping: which columns of the logs are ours.
    """

    log_name: LogName
    path: str
    span: tuple[float | None, float | None] | None
    processing: Processing | None = None
    mapping: LogMap | None = None


@dataclass(frozen=True, eq=False)
class LogSummary:
    """A log, reduced; n joints, c base parameters.

    Attributes:
        named: machine, period and place.
        content: fingerprint of the file's measurements.
        span: first and last time, s.
        samples: after decimation.
        data: triangles of [W_j y_j], joint by joint; those of a dead joint are 0.
        repeats: (n, c, c) sum_k r_j(k) sum_t w_j(t) w_j(t + k)^T + transpose, see `coloured`.
        temperatures: mean of each column, by the joint that its name ends in; "" for all.
        processing: with all choices filled in.
        doubts: what is wrong with the measurements.
        beyond: joints with a position and a torque that the robot has not.
    """

    log_name: LogName
    content: str
    span: tuple[float, float]
    samples: int
    data: CompressedRegression
    repeats: np.ndarray
    temperatures: Mapping[str, float] = field(default_factory=dict)
    processing: Processing | None = None
    doubts: tuple[str, ...] = ()
    extra_joints: tuple[str, ...] = ()


@dataclass(frozen=True)
class SkippedLog:
    """A log that could not be used, and why."""

    log_name: LogName
    reason: str


def reduce_log(emitted: EmittedModule, job: LogJob) -> LogSummary | SkippedLog:
    """The summary of one log; pure, so that it can run anywhere and be run again.

    Args:
        emitted: the C of the robot, which is compiled here, or taken from the cache.
        job: of the log.
    """
    model = load_cached_model(emitted)
    try:
        log = read_log(job.path, model.spec, job.mapping)
        if job.span is not None:
            log = cut_window(log, *job.span)
        return summarise_log(model, log, job.log_name, job.processing)
    except (DataError, LoopError) as error:
        return SkippedLog(job.log_name, str(error))


def summarise_log(
    model: CompiledModel, log: Log, log_name: LogName, processing: Processing | None = None
) -> LogSummary:
    """The summary of a log that was read.

    Raises:
        ModelerError: it has no usable rows, or contradicts the robot beyond doubt.
    """
    observation = observe(model, [log], processing)
    dead = find_disconnected_joints(observation)
    alive = ~np.isin(observation.row_joint, dead)
    W, y, joint = observation.W[alive], observation.y[alive], observation.row_joint[alive]
    if len(y) < W.shape[1]:
        raise DataError(f"{log.name}: {len(y)} rows for {W.shape[1]} parameters; record more")
    free = [j for j, each in enumerate(observation.joints) if not each.actuated]
    data = compress_rows(W, y, joint, len(observation.joints), observation.names, free)
    result = identify(observation, "weighted", model)
    findings = find_log_faults(model, observation)
    against = find_contradictions(model, observation, result, findings, data)
    if against:  # certainly not usable: its deviations would say anything
        raise DataError(f"{log_name.place}: does not fit {model.spec.robot}: {against[0]}")
    residual = y - W @ solve_least_squares(data).beta
    doubts = [f"joint {observation.joints[j].name}: its torque is 0 throughout" for j in dead]
    return LogSummary(
        log_name=log_name,
        content=log.content,
        span=(float(log.time[0]), float(log.time[-1])),
        samples=len(observation.time),
        data=data,
        repeats=_compute_repeats(observation, W, joint, observation.row_sample[alive], residual),
        temperatures={
            name.removeprefix(TEMPERATURE): float(np.mean(values))
            for name, values in log.extra.items()
            if name.startswith(TEMPERATURE)
        },
        processing=observation.report.processing,
        doubts=(*observation.report.collect_warnings(), *doubts),
        extra_joints=_find_extra_joints(log.extra),
    )


def _compute_repeats(
    observation: Observation,
    W: np.ndarray,
    joint: np.ndarray,
    sample: np.ndarray,
    residual: np.ndarray,
) -> np.ndarray:
    repeats = np.zeros((len(observation.joints), W.shape[1], W.shape[1]))
    for j in range(len(observation.joints)):
        is_of_joint = joint == j
        if is_of_joint.any():
            r = estimate_correlation(observation, residual[is_of_joint], sample[is_of_joint])
            repeats[j] = sum_lagged_products(
                W[is_of_joint], r, sample[is_of_joint], observation.segment
            )
    return repeats


def _find_extra_joints(columns: Iterable[str]) -> tuple[str, ...]:
    """Joints with a position and a torque among columns that are none of the robot's."""
    names = set(columns)
    return tuple(sorted(name[1:] for name in names if name[0] == "q" and f"tau{name[1:]}" in names))


# Logs that hold channels of joints which the robot has not: of another robot, it seems.


def separate_foreign_logs(
    used: Sequence[LogSummary],
) -> tuple[list[LogSummary], list[SkippedLog], list[str]]:
    """The logs to compare, those that are left out, and what is to be said of the others.

    A log with positions and torques of more joints than the robot has is left out where more than
    half of all logs have other joints than it; where no such half is, or it has them too, it is
    told.
    """
    kinds = Counter(each.extra_joints for each in used)
    usable, left, places_by_joints = [], [], dict[tuple[str, ...], list[str]]()
    for each in used:
        others = max((n for joints, n in kinds.items() if joints != each.extra_joints), default=0)
        if each.extra_joints and 2 * others > len(used):
            why = (
                f"has joint{'s' * (len(each.extra_joints) > 1)} {', '.join(each.extra_joints)} "
                "besides, which "
                "most logs have not; a log of another robot? name the right one"
            )
            left.append(SkippedLog(each.log_name, f"{each.log_name.place}: {why}"))
            continue
        usable.append(each)
        if each.extra_joints:
            places_by_joints.setdefault(each.extra_joints, []).append(each.log_name.place)
    notes = [
        f"{places[0]}{f' and {len(places) - 1} more' * (len(places) > 1)}: positions and torques "
        f"of joints besides those of the robot ({', '.join(joints)}) are not read; is the robot "
        "file that of these machines?"
        for joints, places in places_by_joints.items()
    ]
    return usable, left, notes
