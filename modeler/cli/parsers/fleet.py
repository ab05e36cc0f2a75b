"""`modeler fleet ROBOT LOG...`."""

import argparse

from modeler.cli.parsers.options import (
    Commands,
    Run,
    add_dask,
    add_json,
    add_map,
    add_number,
    add_page,
    add_robot,
)
from modeler.cli.places import ListFile, LogFile, Word


def add_fleet(commands: Commands) -> None:
    """`modeler fleet`."""
    parser = commands.add_parser(
        "fleet",
        help="one robot kind, many machines and days: what drifts where",
        description="Fits all logs of machines of one kind together: inertial parameters in "
        "common, friction, offset and drive gain of every joint log by log. Says which of them "
        "drifts, leaps, or is apart from those of the other machines, beyond doubt.",
        epilog="example: modeler fleet ur10e plant/*/*.parquet --page fleet.html",
    )
    add_robot(parser)
    parser.add_argument(
        "logs", metavar="LOG", nargs="*", type=LogFile,
        help="logs, or folders of logs; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    _add_names(parser)
    add_map(parser)
    group = parser.add_argument_group("processing", "chosen from the first log, for all alike")
    add_number(group, "--cutoff", "HZ", float, "low-pass of the positions")
    add_number(
        group, "--parallel-cutoff", "HZ", float, "the one low-pass of torques and all columns"
    )
    add_workers(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_fleet)


def _add_names(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("names", "which machine and period a log is of")
    group.add_argument(
        "--name", metavar="PATTERN", type=Word,
        help="how paths end, as '{machine}-{period}.csv'; left out: the folder is the machine, the "
        "file the period",
    )  # fmt: skip
    group.add_argument(
        "--list", metavar="FILE", type=ListFile,
        help="logs by name, in place of LOG: .csv with machine, period, log in its first line, or "
        ".toml with [[log]] tables",
    )  # fmt: skip


def add_workers(parser: argparse.ArgumentParser) -> None:
    """`--workers` and `--dask`, of commands that read many logs."""
    group = parser.add_argument_group("workers")
    add_number(
        group, "--workers", "N", int,
        "processes that read logs; left out: one for few logs, all processors for many",
    )  # fmt: skip
    add_dask(group)


def _fleet() -> Run:
    from modeler.cli.fleet import run_fleet

    return run_fleet
