"""y = W beta: the rows of all logs through the compiled model and the parallel filter."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler.core.contract import JointSpec
from modeler.core.errors import DataError
from modeler.observation.closable import without_open
from modeler.observation.dry_friction import Shaft, floors_of, moving, shafts, with_every_joint
from modeler.observation.evaluated import Evaluated
from modeler.observation.log import Log
from modeler.observation.motion import CAUSES, Segment
from modeler.observation.observation import Observation
from modeler.observation.prepare import Mending, Prepared, prepare, with_floors
from modeler.observation.processing import Processing
from modeler.observation.report import DataReport, JointReport, LogReport
from modeler.observation.row_filter import row_filter
from modeler.observation.stretch import Stretch, stretch

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel


def observe(
    model: "CompiledModel",
    logs: Sequence[Log],
    processing: Processing | None = None,
    every_joint: bool = False,
    mending: Mending | None = None,
) -> Observation:
    """The observation of logs: W, y, and which row is which.

    One parallel filter and decimation for the torque and every column (Guegan, Khalil and Lemoine
    2003, section 5.2). Samples below the speed floor, saturated or missing ones have no weight.

    Args:
        model: the compiled robot.
        logs: read with the same manifest.
        processing: None: automatic. For held-out logs `report.processing` of the fit.
        every_joint: mask low speeds also on joints whose dry friction the model lacks.
        mending: of the same logs, where it is shared.

    Raises:
        DataError: no logs, of another robot, or no usable row.
        LoopError: hardly a sample closes the loops.
    """
    prepared = prepare(model.spec, logs, processing or Processing(), mending)
    return observed(model, logs, prepared, every_joint)


def observed(
    model: "CompiledModel", logs: Sequence[Log], prepared: Prepared, every_joint: bool = False
) -> Observation:
    """The observation of logs that are prepared already, for this or a like robot.

    Raises:
        DataError: no usable row.
        LoopError: hardly a sample closes the loops.
    """
    prepared, open_times = without_open(model, logs, prepared)
    parts = with_every_joint(model) if every_joint else shafts(model)
    floors = floors_of(prepared.processing, parts, prepared.segments)
    chosen = with_floors(prepared.processing, floors)
    stretches = tuple(_stretch(segment, parts, chosen) for segment in prepared.segments)
    report = DataReport(
        processing=chosen,
        choices=prepared.choices,
        trembles=prepared.trembles,
        band=prepared.band,
        logs=tuple(
            dataclasses.replace(_log_report(log, run, prepared, stretches), open_times=times)
            for run, (log, times) in enumerate(zip(logs, open_times, strict=True))
        ),
        joints=joint_reports(model.spec.joints, parts, floors, _counts(stretches)),
    )
    if not any(part.used.any() for part in stretches):
        raise no_row_left(report, [f"{log.name}: {note}" for log in logs for note in log.notes])
    return stacked(model, [log.name for log in logs], stretches, report)


def no_row_left(report: DataReport, notes: Sequence[str] = ()) -> DataError:
    """What is told of logs without a usable row."""
    return DataError(
        f"{', '.join(log.name for log in report.logs)}: no usable row is left: "
        + "; ".join([*(joint.line() for joint in report.joints), *notes])
        + "; check these columns, or record longer and faster motion of every joint"
    )


def observed_alike(model: "CompiledModel", like: Observation) -> Observation:
    """What a robot makes of logs that another one has seen, which masks the same samples."""
    return dataclasses.replace(
        like,
        robot=model.spec.robot,
        joints=model.spec.joints,
        names=tuple(base.name for base in model.spec.base),
        units=tuple(base.unit for base in model.spec.base),
        regressor=Evaluated(model, like.stretches),
    )


def _stretch(segment: Segment, parts: Sequence[Shaft], processing: Processing) -> Stretch:
    assert processing.parallel_cutoff is not None
    assert processing.speed_floors is not None
    usable = segment.valid & moving(segment, parts, processing.speed_floors)
    rows = row_filter(
        segment.whole, segment.step, processing.parallel_cutoff, processing.decimation
    )
    return stretch(segment, usable, rows)


def stacked(
    model: "CompiledModel",
    logs: Sequence[str],
    stretches: tuple[Stretch, ...],
    report: DataReport,
) -> Observation:
    """The rows of some stretches of logs of these names, with what is told of them."""
    motion = np.concatenate([_motion(part) for part in stretches])
    counts = [len(part.rows.centres) for part in stretches]
    return Observation(
        robot=model.spec.robot,
        joints=model.spec.joints,
        names=tuple(base.name for base in model.spec.base),
        units=tuple(base.unit for base in model.spec.base),
        logs=tuple(logs),
        run=np.repeat([part.segment.run for part in stretches], counts),
        segment=np.repeat(np.arange(len(stretches)), counts),
        time=np.concatenate([part.segment.time[part.rows.centres] for part in stretches]),
        q=motion[:, 0],
        qd=motion[:, 1],
        qdd=motion[:, 2],
        torque=np.concatenate([part.filtered(torque_of(part.segment)) for part in stretches]),
        used=np.concatenate([part.used for part in stretches]),
        stretches=stretches,
        regressor=Evaluated(model, stretches),
        report=report,
    )


def _motion(part: Stretch) -> np.ndarray:
    """(rows, 3, joints) q, qd, qdd over all whole samples."""
    s = part.segment
    return np.concatenate(
        [
            rows.means(np.stack([s.q[w], s.qd[w], s.qdd[w]], axis=1), s.whole[w])
            for rows, w, _ in part.parts()
        ]
    )


def torque_of(segment: Segment) -> Callable[[slice], np.ndarray]:
    """What is filtered of a segment, a window at a time."""
    return lambda window: segment.tau[window]


def _log_report(log: Log, run: int, prepared: Prepared, stretches: Sequence[Stretch]) -> LogReport:
    own = [part for part in stretches if part.segment.run == run]
    check = prepared.checks[run]
    pieces, split = prepared.pieces[run], prepared.splits[run]
    clipped = (
        np.sum([np.sum(piece.clipped, axis=0) for piece in pieces], axis=0)
        if pieces
        else np.zeros(len(log.joints), dtype=int)
    )
    spacing = [int(part.rows.centres[1] - part.rows.centres[0]) for part in own
               if len(part.rows.centres) > 1]  # fmt: skip
    return LogReport(
        name=log.name,
        rows=log.rows,
        missing=dict(log.missing),
        saturated={n: int(k) for n, k in zip(log.joints, clipped, strict=True) if k},
        rate=1.0 / log.step,
        jitter=split.jitter,
        gaps=split.gaps,
        longest_gap=split.longest_gap,
        pieces=len(pieces),
        resampled=sum(piece.resampled for piece in pieces),
        short=split.short + prepared.dropped[run],
        derivatives=prepared.derivatives[run],
        decimation=spacing[0] if spacing else 1,
        samples=sum(len(part.rows.centres) for part in own),
        notes=log.notes + prepared.rings[run] + (check.notes if check else ()),
        contradictions=check.contradictions if check else (),
        contradicted=sum(int(bad.sum()) for bad in check.bad) if check else 0,
        damages=prepared.damages[run],
        content=log.content,
        span=(float(log.time[0]), float(log.time[-1])),
        torque_source=log.torque_source,
    )


def _counts(stretches: Sequence[Stretch]) -> dict[str, Any]:
    """Samples of all stretches, by joint, as a `Tally` has them of chunks."""
    return {
        "full": sum(part.segment.samples for part in stretches),
        "valid": sum(np.sum(part.segment.valid, axis=0) for part in stretches),
        "usable": sum(np.sum(part.usable, axis=0) for part in stretches),
        "used": sum(np.sum(part.used, axis=0) for part in stretches),
    } | {cause: sum(part.segment.lost[cause] for part in stretches) for cause in CAUSES}


def joint_reports(
    joints: Sequence[JointSpec],
    parts: Sequence[Shaft],
    floors: Mapping[str, float],
    counts: Mapping[str, Any],
) -> tuple[JointReport, ...]:
    """What became of the samples of each joint.

    Args:
        joints: of the robot.
        parts: its shafts.
        floors: speeds below which they do not count.
        counts: "full" samples, and by joint those "valid", "usable", "used" and lost by each cause.
    """
    reports = []
    for j, joint in enumerate(joints):
        own = [floors[part.name] for part in parts if j in part.joints]
        reports.append(
            JointReport(
                name=joint.name,
                used=int(counts["used"][j]),
                slow=float(1.0 - counts["usable"][j] / max(1, counts["valid"][j])),
                speed_floor=max(own) if own else None,
                unit=f"{joint.unit}/s",
                samples=int(counts["full"]),
                lost={cause: int(counts[cause][j]) for cause in CAUSES if counts[cause][j]},
            )
        )
    return tuple(reports)
