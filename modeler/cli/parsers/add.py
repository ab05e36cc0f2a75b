"""`modeler add MODEL EFFECT LOG... --out MODEL2`."""

from modeler.cli.parsers.options import (
    Commands,
    Run,
    add_json,
    add_map,
    add_page,
    add_several,
)
from modeler.cli.places import LogFile, ModelFile, Output, Word


def add_add(commands: Commands) -> None:
    """`modeler add`."""
    parser = commands.add_parser(
        "add",
        help="put a physical effect into a model and watch the error fall",
        description="Adds EFFECT to the robot of MODEL, derives and emits it anew, fits it to the "
        "logs and shows the error before and after. EFFECT may also be `auto`: all that `modeler "
        "diagnose` names, or `undo`: without the last one.",
        epilog="example: modeler add arm.model.json load_friction --joint 2 train.parquet "
        "--holdout other.parquet --out arm2.model.json",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "effect", metavar="EFFECT", type=Word, help="see `modeler effects`; auto; undo"
    )
    parser.add_argument("logs", metavar="LOG", nargs="+", type=LogFile, help="logs to fit to")
    parser.add_argument("--joint", metavar="J", type=Word, help="default: where it explains most")
    parser.add_argument(
        "--out", metavar="MODEL2", required=True, type=Output, help="model file to write"
    )
    add_several(parser, "--holdout", "LOG", LogFile, "logs of other motion to judge on")
    parser.add_argument("--robot", metavar="FILE", type=Output, help="write the new robot file too")
    add_map(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_add)


def _add() -> Run:
    from modeler.cli.add import run_add

    return run_add
