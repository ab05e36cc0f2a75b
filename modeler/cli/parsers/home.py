"""`modeler home ROBOT`."""

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import Output, RobotFile, Word


def add_home(commands: Commands) -> None:
    """`modeler home`."""
    parser = commands.add_parser(
        "home",
        help="closed postures of a robot with loops, and its assembly modes",
        description="Finds the ways in which the loops of ROBOT can be put together with its "
        "actuated joints where [home] says, else in the middle of their [limits], else far from "
        "singularities; each gets a letter, A the best to start from. What [home] or --near say "
        "of passive joints ranks them: one near to it comes first.",
        epilog="example: modeler home crank.toml --pictures modes.html --mode B --write",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    parser.add_argument(
        "--near", metavar="q1=0.3,...", type=Word,
        help="values to stay near, rad and m, in place of the passive joints' in [home]",
    )  # fmt: skip
    parser.add_argument("--anew", action="store_true", help="as if the file had no [home]")
    parser.add_argument(
        "--mode", metavar="LETTER", type=Word, help="the mode that is meant (default A)"
    )
    parser.add_argument(
        "--write", action="store_true", help="write it into the robot file as [home]"
    )
    parser.add_argument(
        "--pictures", metavar="FILE", type=Output,
        help="a small picture of every mode: .png, .svg or .pdf, or a page (.html)",
    )  # fmt: skip
    add_json(parser, "write the modes for machines")
    parser.set_defaults(load=_home)


def _home() -> Run:
    from modeler.cli.home import run_home

    return run_home
