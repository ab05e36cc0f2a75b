"""One robot kind, many machines and days."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from modeler.api.log_maps import Mapped, build_log_maps, parse_time_range
from modeler.api.workflow import AnyLog, compile_model, convert_to_list, read_logs
from modeler.codegen import derive, generate
from modeler.core.errors import DataError, LoopError, split_time_range
from modeler.core.jobs import Workers, ignore_progress, open_workers
from modeler.core.manifest import EmittedModule
from modeler.regression import Processing
from modeler.robot import Robot
from modeler.runtime import CompiledModel
from modeler.validation import (
    Fleet,
    LogJob,
    LogName,
    LogSummary,
    SkippedLog,
    analyse_fleet,
    arrange_logs,
    name_logs,
    reduce_log,
    summarise_log,
)

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
    """Estimates the drift of friction, offsets and gains of many machines of one kind.

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
        pairs = {
            LogName(machine, period, f"{machine}, {period}"): log
            for machine, period_logs in logs.items()
            for period, log in period_logs.items()
        }
        return analyse_fleet(
            emitted.spec, _reduce_in_memory(compiled, pairs, processing, mapping, progress)
        )
    named_paths = name_logs([split_window(str(place)) for place in convert_to_list(logs)], name)
    with open_workers(dask, processes) as workers:
        summaries = reduce_logs(
            compiled, emitted, named_paths, workers, processing, mapping, progress
        )
    return analyse_fleet(emitted.spec, summaries)


def split_window(place: str) -> tuple[str, str]:
    """Splits a place into the file and the time range after it, "" without."""
    path, at = split_time_range(place)
    return path, at or ""


def reduce_logs(
    compiled: CompiledModel,
    emitted: EmittedModule,
    named_logs: Sequence[LogName],
    workers: Workers,
    processing: Processing | None = None,
    mapping: Mapped = (),
    progress: Progress | None = None,
) -> list[LogSummary | SkippedLog]:
    """Reduces all logs to summaries, each with the cut-offs of its own noise."""
    jobs = []
    maps = build_log_maps(compiled, [each.place for each in named_logs], mapping)
    for each, names in zip(named_logs, maps, strict=True):
        path, span = parse_time_range(each.place)
        jobs.append(LogJob(each, str(Path(path).absolute()), span, processing, names))
    code = dataclasses.replace(emitted, files=emitted.code)
    return workers.map_jobs(reduce_log, code, jobs, progress or ignore_progress)


def _reduce_in_memory(
    compiled: CompiledModel,
    logs: Mapping[LogName, AnyLog],
    processing: Processing | None,
    mapping: Mapped,
    progress: Progress | None,
) -> list[LogSummary | SkippedLog]:
    """The same of logs at hand, in this process."""
    summaries: list[LogSummary | SkippedLog] = []
    for named in arrange_logs(logs):
        try:
            [log] = read_logs(compiled, [logs[named]], mapping)
            summaries.append(summarise_log(compiled, log, named, processing))
        except (DataError, LoopError) as error:
            summaries.append(SkippedLog(named, str(error)))
        if progress is not None:
            progress(len(summaries) / len(logs))
    return summaries
