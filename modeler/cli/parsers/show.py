"""`modeler show ROBOT`."""

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import Output, RobotFile


def add_show(commands: Commands) -> None:
    """`modeler show`."""
    parser = commands.add_parser(
        "show",
        help="the robot in 3-D: a page with sliders, a picture for papers",
        description="Draws the skeleton of ROBOT at home: frames, joint axes, links, loops, "
        "platform, gravity. The page stands alone, its sliders move the actuated joints and the "
        "loops follow. Loops that do not close are drawn open, with the gap.",
        epilog="example: modeler show orthoglide-2003 --png orthoglide.pdf",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="PAGE", type=Output,
        help="page to write (default NAME.html, if no picture is asked for)",
    )  # fmt: skip
    parser.add_argument(
        "--png", metavar="FILE", type=Output,
        help="write a picture one column wide: .png, .svg or .pdf",
    )  # fmt: skip
    add_json(parser, "write poses at home and gaps of loops for machines")
    parser.set_defaults(load=_show)


def _show() -> Run:
    from modeler.cli.show import run_show

    return run_show
