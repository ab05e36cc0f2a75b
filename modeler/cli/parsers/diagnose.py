"""`modeler diagnose MODEL LOG...`."""

from modeler.cli.parsers.options import (
    Commands,
    Run,
    add_json,
    add_map,
    add_page,
    add_several,
)
from modeler.cli.places import LogFile, ModelFile, Word


def add_diagnose(commands: Commands) -> None:
    """`modeler diagnose`."""
    parser = commands.add_parser(
        "diagnose",
        help="which physical effect is missing",
        description="Looks for the physical effects that MODEL lacks on the logs: which, on which "
        "joint, how large, what adding them would gain on motion not used for the fit, what they "
        "could be mistaken for, and what these logs cannot show.",
        epilog="example: modeler diagnose arm.model.json train.parquet --holdout other.parquet",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "logs", metavar="LOG", nargs="+", type=LogFile,
        help="logs to explain; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    add_several(
        parser,
        "--holdout",
        "LOG",
        LogFile,
        "logs of other motion: errors come from them, nothing is fitted to them",
    )
    parser.add_argument(
        "--without", metavar="EFFECT[@J]", action="append", default=[], type=Word,
        help="an effect that this robot does not have, on one joint or at all",
    )  # fmt: skip
    add_map(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_diagnose)


def _diagnose() -> Run:
    from modeler.cli.diagnose import run_diagnose

    return run_diagnose
