"""One robot kind, many machines and days."""

import dataclasses
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from modeler.api.log_maps import Mapped, build_log_maps, parse_time_range
from modeler.api.thresholds import THRESHOLDS
from modeler.api.workflow import AnyLog, compile_model, convert_to_list, read_logs
from modeler.codegen import derive, generate
from modeler.core.choices import LOG_ENDINGS
from modeler.core.errors import DataError, LoopError, split_time_range
from modeler.core.jobs import SILENT, Done, Reporter, Workers, ignore_progress, open_workers
from modeler.core.manifest import EmittedModule
from modeler.core.options import OptionError
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
    read_log_list,
    reduce_log,
    summarise_log,
)


def fleet(
    robot: Robot,
    logs: str | Path | Sequence[str | Path] | Mapping[str, Mapping[str, AnyLog]],
    name: str | None = None,
    *,
    listed: str | Path | None = None,
    processing: Processing | None = None,
    mapping: Mapped = (),
    workers: int | None = 1,
    dask: str | None = None,
    reporter: Reporter = SILENT,
) -> Fleet:
    """Estimates the drift of friction, offsets and gains of many machines of one kind.

    >>> fleet(robot, {"one": {"mon": "mon.parquet", "tue": "tue.parquet"}}).machines
    {'one': ('mon', 'tue')}

        fleet(load("arm.toml"), {"r1": {"monday": "a.csv", "tuesday": "b.csv"}})

    All machines share their inertial parameters; see docs/how-to/fleet.md.

    Args:
        robot: of all machines; with the effects that are to be followed.
        logs: files, or folders of such, machine and period by their names; or logs by machine and
            period.
        name: pattern of files, as "{machine}-{period}.csv"; None: folder and file.
        listed: file with a list of logs, in place of these.
        processing: None: chosen for each log, from its own noise.
        mapping: as of `read_logs`.
        workers: processes that read logs at once; only files are read by others than this one;
            None: one for few logs, all processors for many.
        dask: address of a scheduler, or "local".
        reporter: of the progress.

    Raises:
        DataError: no usable logs, two of one machine and period, too few to compare.
    """
    if workers is not None and workers < 1:
        raise OptionError(f"{{--workers}}: got {workers}; expected 1 or more")
    named_paths = () if isinstance(logs, Mapping) else _name_files(logs, name, listed)
    if robot.rigid.effects != robot.effects:
        raise DataError(
            f"{robot.name}: a joint is elastic, which a fleet is not fitted with; expected rigid "
            "joints; take elasticity out of [effects]"
        )
    with reporter.report_step(f"deriving {robot.name}"):
        emitted = generate(derive(robot))
        compiled = compile_model(emitted)
    if isinstance(logs, Mapping):
        pairs = {
            LogName(machine, period, f"{machine}, {period}"): log
            for machine, period_logs in logs.items()
            for period, log in period_logs.items()
        }
        with reporter.show_progress(f"reading {len(pairs)} logs") as bar:
            summaries = _reduce_in_memory(compiled, pairs, processing, mapping, bar)
        return analyse_fleet(emitted.spec, summaries)
    few = len(named_paths) < THRESHOLDS.min_logs_for_processes
    count = workers or (1 if few else os.cpu_count() or 1)
    with (
        reporter.show_progress(f"reading {len(named_paths)} logs") as bar,
        open_workers(dask, min(count, len(named_paths))) as pool,
    ):
        summaries = reduce_logs(compiled, emitted, named_paths, pool, processing, mapping, bar)
    with reporter.report_step("comparing machines and days"):
        return analyse_fleet(emitted.spec, summaries)


def _name_files(
    logs: str | Path | Sequence[str | Path], name: str | None, listed: str | Path | None
) -> tuple[LogName, ...]:
    """The logs with their machines and periods."""
    if listed is not None:
        return read_log_list(Path(listed))
    places = [str(place) for place in convert_to_list(logs)]
    if not places:
        raise OptionError("fleet: got no logs; name files or folders of logs, or {--listed} FILE")
    return name_logs([split_window(place) for place in _collect_log_files(places)], name)


def _collect_log_files(places: Sequence[str]) -> list[str]:
    """Logs as they are; of a folder, all in it and in its folders."""
    log_files = []
    for place in places:
        folder = Path(place)
        if not Path(split_window(place)[0]).exists():
            raise DataError(f"{place}: no such file or folder; expected logs, or folders of logs")
        if not folder.is_dir() or (folder / "metadata.yaml").is_file():  # a ROS 2 bag is a log
            log_files.append(place)
            continue
        inside = [str(p) for p in sorted(folder.rglob("*")) if p.suffix.lower() in LOG_ENDINGS]
        if not inside:
            raise DataError(f"{place}: a folder without logs; expected {', '.join(LOG_ENDINGS)}")
        log_files += inside
    return log_files


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
    progress: Done = ignore_progress,
) -> list[LogSummary | SkippedLog]:
    """Reduces all logs to summaries, each with the cut-offs of its own noise."""
    jobs = []
    maps = build_log_maps(compiled, [each.place for each in named_logs], mapping)
    for each, names in zip(named_logs, maps, strict=True):
        path, span = parse_time_range(each.place)
        jobs.append(LogJob(each, str(Path(path).absolute()), span, processing, names))
    code = dataclasses.replace(emitted, files=emitted.code)
    return workers.map_jobs(reduce_log, code, jobs, progress)


def _reduce_in_memory(
    compiled: CompiledModel,
    logs: Mapping[LogName, AnyLog],
    processing: Processing | None,
    mapping: Mapped,
    progress: Done,
) -> list[LogSummary | SkippedLog]:
    """The same of logs at hand, in this process."""
    summaries: list[LogSummary | SkippedLog] = []
    for named in arrange_logs(logs):
        try:
            [log] = read_logs(compiled, [logs[named]], mapping)
            summaries.append(summarise_log(compiled, log, named, processing))
        except (DataError, LoopError) as error:
            summaries.append(SkippedLog(named, str(error)))
        progress(len(summaries) / len(logs))
    return summaries
