"""`modeler fleet ROBOT LOG...`: one robot kind, many machines and days."""

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

from modeler.api import compile_model, derive, generate
from modeler.api.fleets import file_and_at, reduce_logs
from modeler.cli.console import Json, draw_page, draw_pictures, progress, say_lines, working
from modeler.cli.lists import robot_of
from modeler.cli.places import LOG_ENDINGS
from modeler.core.errors import DataError
from modeler.core.jobs import open_workers
from modeler.fleet import Named, fleet_lines, fleet_of, listed_logs, named_logs
from modeler.observation import Processing
from modeler.report import fleet_page

_MANY = 32  # logs from which several processes are worth their start


def run_fleet(args: argparse.Namespace) -> Json:
    """Prints what drifts; writes the page."""
    if args.workers is not None and args.workers < 1:
        raise DataError(f"--workers: got {args.workers}; expected 1 or more")
    named = _named(args)
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        emitted = generate(derive(robot))
        compiled = compile_model(emitted)
    processing = Processing(position_cutoff=args.cutoff, parallel_cutoff=args.parallel_cutoff)
    count = args.workers or (1 if len(named) < _MANY else os.cpu_count() or 1)
    with (
        progress(f"reading {len(named)} logs") as bar,
        open_workers(args.dask, min(count, len(named))) as workers,
    ):
        given = reduce_logs(compiled, emitted, named, workers, processing, args.map, bar)
    with working("comparing machines and days"):
        found = fleet_of(emitted.spec, given)
    say_lines(fleet_lines(found))
    if args.report is not None or args.picture is not None:
        page = fleet_page(found)
        draw_page(args.report, lambda: page)
        draw_pictures(args.picture, page.pictures)
    return found.to_json()


def _named(args: argparse.Namespace) -> tuple[Named, ...]:
    """The logs with their machines and periods."""
    if args.list is not None:
        if args.logs or args.name:
            raise DataError(
                f"--list {args.list}: got {args.logs[0] if args.logs else '--name'} besides; "
                "expected all logs in the list, or none"
            )
        return listed_logs(Path(args.list))
    if not args.logs:
        raise DataError("fleet: got no logs; name files or folders of logs, or a --list of them")
    return named_logs([file_and_at(place) for place in _files(args.logs)], args.name)


def _files(places: Sequence[str]) -> list[str]:
    """Logs as they are; of a folder, all in it and in its folders."""
    found = []
    for place in places:
        folder = Path(place)
        if not Path(file_and_at(place)[0]).exists():
            raise DataError(f"{place}: no such file or folder; expected logs, or folders of logs")
        if not folder.is_dir() or (folder / "metadata.yaml").is_file():  # a ROS 2 bag is a log
            found.append(place)
            continue
        inside = [str(p) for p in sorted(folder.rglob("*")) if p.suffix.lower() in LOG_ENDINGS]
        if not inside:
            raise DataError(f"{place}: a folder without logs; expected {', '.join(LOG_ENDINGS)}")
        found += inside
    return found
