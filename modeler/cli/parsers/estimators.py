"""`modeler estimators [ROBOT LOG...]`."""

from modeler.cli.parsers.options import (
    Commands,
    Run,
    add_json,
    add_map,
    add_page,
    add_several,
)
from modeler.cli.places import LogFile, RobotFile, Word


def add_estimators(commands: Commands) -> None:
    """`modeler estimators`."""
    parser = commands.add_parser(
        "estimators",
        help="the ways to estimate, and all of them on the same logs",
        description="Lists the estimators of `modeler fit --method`: law, source, and when not to "
        "use each. With ROBOT and logs, fits all of them to the same rows and shows values, "
        "errors, seconds and warnings side by side; no model is written.",
        epilog="example: modeler estimators emps train.parquet --holdout pulses.parquet",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", nargs="?", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    parser.add_argument(
        "logs", metavar="LOG", nargs="*", type=LogFile,
        help="logs to fit; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    parser.add_argument(
        "--effects", metavar="LIST", type=Word,
        help='effects instead of those of the file, for all joints: "viscous,coulomb"',
    )  # fmt: skip
    add_several(
        parser, "--holdout", "LOG", LogFile, "logs of other motion, not fitted: their error"
    )
    parser.add_argument(
        "--methods", metavar="LIST", type=Word,
        help="some of them, with commas between; default: all",
    )  # fmt: skip
    add_map(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_estimators)


def _estimators() -> Run:
    from modeler.cli.estimators import run_estimators

    return run_estimators
