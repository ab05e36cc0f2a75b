"""One robot kind, many machines and days."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from modeler.api.log_maps import Mapped, file_and_span, log_maps
from modeler.api.workflow import AnyLog, compile_model, listed, read_logs
from modeler.codegen import derive, generate
from modeler.core.errors import DataError, LoopError, file_and_window
from modeler.core.jobs import Workers, open_workers, untold
from modeler.core.manifest import Emitted
from modeler.fleet import (
    Fleet,
    LogJob,
    LogSummary,
    Named,
    SkippedLog,
    fleet_of,
    in_order,
    named_logs,
    reduce_log,
    summary,
)
from modeler.observation import Processing
from modeler.robot import Robot
from modeler.runtime import CompiledModel

Progress = Callable[[float], None]


def fleet(
    robot: Robot,
    logs: str | Path | Sequence[str | Path] | Mapping[str, Mapping[str, AnyLog]],
    name: str | None = None,
    *,
    processing: Processing | None = None,
    mapping: Mapped = (),
    processes: int = 1,
    dask: str | None = None,
    progress: Progress | None = None,
) -> Fleet:
    """What drifts where: friction, offsets and gains of many machines of one kind over their days.

    >>> fleet(robot, {"one": {"mon": "mon.parquet", "tue": "tue.parquet"}}).machines
    {'one': ('mon', 'tue')}

        fleet(load("arm.toml"), {"r1": {"monday": "a.csv", "tuesday": "b.csv"}})

    All machines share their inertial parameters; see docs/how-to/fleet.md.

    Args:
        robot: of all machines; with the effects that are to be followed.
        logs: files, machine and period by their names; or logs by machine and period.
        name: pattern of files, as "{machine}-{period}.csv"; None: folder and file.
        processing: None: chosen for each log, from its own noise.
        mapping: as of `read_logs`.
        processes: that read logs at once; only files are read by others than this one.
        dask: address of a scheduler, or "local".
        progress: called with the share done, 0 to 1.

    Raises:
        DataError: no usable logs, two of one machine and period, too few to compare.
    """
    emitted = generate(derive(robot))
    compiled = compile_model(emitted)
    if isinstance(logs, Mapping):
        pairs = {Named(machine, period, f"{machine}, {period}"): log
                 for machine, own in logs.items() for period, log in own.items()}  # fmt: skip
        return fleet_of(emitted.spec, _reduced(compiled, pairs, processing, mapping, progress))
    named = named_logs([file_and_at(str(place)) for place in listed(logs)], name)
    with open_workers(dask, processes) as workers:
        given = reduce_logs(compiled, emitted, named, workers, processing, mapping, progress)
    return fleet_of(emitted.spec, given)


def file_and_at(place: str) -> tuple[str, str]:
    """A file and the window after it, "" without."""
    path, at = file_and_window(place)
    return path, at or ""


def reduce_logs(
    compiled: CompiledModel,
    emitted: Emitted,
    named: Sequence[Named],
    workers: Workers,
    processing: Processing | None = None,
    mapping: Mapped = (),
    progress: Progress | None = None,
) -> list[LogSummary | SkippedLog]:
    """The summaries of all logs, each with the cut-offs that its own noise asks for."""
    jobs = []
    maps = log_maps(compiled, [each.place for each in named], mapping)
    for each, names in zip(named, maps, strict=True):
        path, span = file_and_span(each.place)
        jobs.append(LogJob(each, str(Path(path).absolute()), span, processing, names))
    code = dataclasses.replace(emitted, files=emitted.code)
    return workers.each(reduce_log, code, jobs, progress or untold)


def _reduced(
    compiled: CompiledModel,
    logs: Mapping[Named, AnyLog],
    processing: Processing | None,
    mapping: Mapped,
    progress: Progress | None,
) -> list[LogSummary | SkippedLog]:
    """The same of logs at hand, in this process."""
    found: list[LogSummary | SkippedLog] = []
    for named in in_order(logs):
        try:
            [log] = read_logs(compiled, [logs[named]], mapping)
            found.append(summary(compiled, log, named, processing))
        except (DataError, LoopError) as error:
            found.append(SkippedLog(named, str(error)))
        if progress is not None:
            progress(len(found) / len(logs))
    return found
