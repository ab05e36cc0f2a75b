"""`modeler log FILE`."""

from modeler.cli.parsers.options import Commands, Run, add_json, add_map
from modeler.cli.places import LogFile, LogPictures, Output, RobotFile


def add_log(commands: Commands) -> None:
    """`modeler log`."""
    parser = commands.add_parser(
        "log",
        help="what is in a log: channels, rates, gaps, doubts, pictures",
        description="Lists what FILE holds: topics and columns, rate, jitter, gaps, ranges, "
        "resolution, missing values, limits. Names doubts, and suggests a [log] to start from, "
        "guessed from names and ranges. With a robot: fits it, and says what contradicts it.",
        epilog="example: modeler log run1.mat --robot arm.toml --page run1.html",
    )
    parser.add_argument(
        "log", metavar="FILE", type=LogFile,
        help="Parquet, CSV, MAT, HDF5, numpy or MCAP file, or ROS bag; FILE@START:END takes the "
        "rows between these seconds",
    )  # fmt: skip
    parser.add_argument(
        "--robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot: its [log], its joints, and doubts "
        "that a fit shows",
    )  # fmt: skip
    add_map(parser)
    parser.add_argument("--page", metavar="PAGE.html", type=Output, help="write one page")
    parser.add_argument(
        "--pictures", metavar="DIR", type=LogPictures,
        help="write every picture as PNG, SVG and CSV",
    )  # fmt: skip
    add_json(parser, "write what is in it for machines")
    parser.set_defaults(load=_log)


def _log() -> Run:
    from modeler.cli.log import run_log

    return run_log
