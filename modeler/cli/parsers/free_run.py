"""`modeler free-run MODEL LOG...`."""

from modeler.cli.parsers.options import Commands, Run, add_json, add_map, add_number
from modeler.cli.places import LogFile, ModelFile, PictureFolder, Word


def add_free_run(commands: Commands) -> None:
    """`modeler free-run`."""
    parser = commands.add_parser(
        "free-run",
        help="positions that the fitted robot takes under the logged torques",
        description="Simulates the robot of MODEL under the torques of the logs, window after "
        "window from the measured state, and compares positions: fit per joint, how long the error "
        "stays within a bound, and whether errors grow by the robot's nature whatever the model. "
        "Where commanded positions were logged, also under a controller that follows them.",
        epilog="example: modeler free-run ur10e.model.json held_out.parquet --pictures free_run",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "logs", metavar="LOG", nargs="+", type=LogFile,
        help="logs; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    add_number(parser, "--window", "S", float, "seconds from one measured state to the next", 1.0)
    add_number(
        parser, "--bound", "SHARE", float,
        "of a joint's range of motion: an error above it ends the horizon", 0.05,
    )  # fmt: skip
    parser.add_argument(
        "--controller", metavar="HZ,RATIO[,INTEGRAL[,FORWARD]]", type=Word,
        help="the controller that follows the commands: speed loop, ratio of the position loop to "
        "it, integral action and feedforward (1 or 0); default: the one that comes nearest",
    )  # fmt: skip
    parser.add_argument(
        "--pictures", metavar="DIR", type=PictureFolder,
        help="write every picture as PNG, SVG and CSV",
    )  # fmt: skip
    add_map(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_free_run)


def _free_run() -> Run:
    from modeler.cli.free_run import run_free_run

    return run_free_run
