"""`modeler robots` and `modeler effects`."""

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import RobotFile, Word


def add_robots(commands: Commands) -> None:
    """`modeler robots`."""
    parser = commands.add_parser(
        "robots",
        help="the built-in robots",
        description="Lists the built-in robots: names to use wherever a command asks for ROBOT.",
        epilog="example: modeler robots --json robots.json",
    )
    parser.add_argument(
        "--show", metavar="NAME", type=RobotFile, help="print that robot's file, to start your own"
    )
    add_json(parser, "write the list for machines")
    parser.set_defaults(load=_robots)


def _robots() -> Run:
    from modeler.cli.robots import run_robots

    return run_robots


def add_effects(commands: Commands) -> None:
    """`modeler effects`."""
    parser = commands.add_parser(
        "effects",
        help="the catalogue of physical effects",
        description="Lists the physical effects that a robot file may name under [effects].",
        epilog="example: modeler effects coulomb",
    )
    parser.add_argument(
        "effect", metavar="EFFECT", nargs="?", type=Word, help="one effect, in full"
    )
    parser.add_argument(
        "--robot", metavar="ROBOT", type=RobotFile,
        help="with the effects that this robot file defines",
    )  # fmt: skip
    add_json(parser, "write the catalogue for machines")
    parser.set_defaults(load=_effects)


def _effects() -> Run:
    from modeler.cli.robots import run_effects

    return run_effects
