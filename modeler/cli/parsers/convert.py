"""`modeler convert FILE --out ROBOT.toml`."""

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import Output, RobotFile


def add_convert(commands: Commands) -> None:
    """`modeler convert`."""
    parser = commands.add_parser(
        "convert",
        help="another program's robot file as ours",
        description="Writes the robot of a SYMORO file (.par) as a robot file, and says what was "
        "decided and what has no place there. Every command reads a .par as well; converted, it "
        "can be edited.",
        epilog="example: modeler convert rx90.par --out rx90.toml",
    )
    parser.add_argument("file", metavar="FILE", type=RobotFile, help="a SYMORO file (.par)")
    parser.add_argument(
        "--out", metavar="ROBOT.toml", required=True, type=Output, help="robot file to write"
    )
    parser.add_argument("--force", action="store_true", help="write over a file that is there")
    add_json(parser, "write what was converted for machines")
    parser.set_defaults(load=_convert)


def _convert() -> Run:
    from modeler.cli.convert import run_convert

    return run_convert
