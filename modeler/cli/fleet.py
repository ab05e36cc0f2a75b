"""`modeler fleet ROBOT LOG...`: one robot kind, many machines and days."""

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

from modeler.api import compile_model, derive, generate
from modeler.api.fleets import reduce_logs, split_window
from modeler.cli.console import (
    Json,
    draw_page,
    draw_pictures,
    print_lines,
    show_activity,
    show_progress,
)
from modeler.cli.lists import resolve_robot
from modeler.cli.places import LOG_ENDINGS
from modeler.cli.thresholds import THRESHOLDS
from modeler.core.errors import DataError
from modeler.core.jobs import open_workers
from modeler.regression import Processing
from modeler.validation import LogName, analyse_fleet, format_fleet, name_logs, read_log_list
from modeler.views import build_fleet_page


def run_fleet(args: argparse.Namespace) -> Json:
    """Prints what drifts; writes the page."""
    if args.workers is not None and args.workers < 1:
        raise DataError(f"--workers: got {args.workers}; expected 1 or more")
    named_paths = _collect_named_logs(args)
    robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        emitted = generate(derive(robot))
        compiled = compile_model(emitted)
    processing = Processing(position_cutoff=args.cutoff, parallel_cutoff=args.parallel_cutoff)
    count = args.workers or (
        1 if len(named_paths) < THRESHOLDS.min_logs_for_processes else os.cpu_count() or 1
    )
    with (
        show_progress(f"reading {len(named_paths)} logs") as bar,
        open_workers(args.dask, min(count, len(named_paths))) as workers,
    ):
        summaries = reduce_logs(compiled, emitted, named_paths, workers, processing, args.map, bar)
    with show_activity("comparing machines and days"):
        fleet = analyse_fleet(emitted.spec, summaries)
    print_lines(format_fleet(fleet))
    if args.report is not None or args.picture is not None:
        page = build_fleet_page(fleet)
        draw_page(args.report, lambda: page)
        draw_pictures(args.picture, page.collect_pictures)
    return fleet.to_json()


def _collect_named_logs(args: argparse.Namespace) -> tuple[LogName, ...]:
    """The logs with their machines and periods."""
    if args.list is not None:
        if args.logs or args.name:
            raise DataError(
                f"--list {args.list}: got {args.logs[0] if args.logs else '--name'} besides; "
                "expected all logs in the list, or none"
            )
        return read_log_list(Path(args.list))
    if not args.logs:
        raise DataError("fleet: got no logs; name files or folders of logs, or a --list of them")
    return name_logs([split_window(place) for place in _collect_log_files(args.logs)], args.name)


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
