"""`modeler demo`."""

from modeler.cli.parsers.options import Commands, Run, add_force, add_json, add_number
from modeler.cli.places import DemoFolder


def add_demo(commands: Commands) -> None:
    """`modeler demo`."""
    parser = commands.add_parser(
        "demo",
        help="the whole story on built-in robots with a hidden effect",
        description="Simulates an arm, then a robot with closed loops, each with a physical effect "
        "that its robot file lacks: derives, emits C, fits, compares, finds out which effect is "
        "missing, adds it, and shows the error falling on motion that was never fitted.",
        epilog="example: modeler demo --out demo",
    )
    parser.add_argument(
        "--out", metavar="DIR", default="demo", type=DemoFolder, help="folder (default %(default)s)"
    )
    add_force(parser)
    add_number(parser, "--duration", "S", float, "seconds of each simulated run", default=20.0)
    add_json(parser, "write the diagnoses for machines")
    parser.set_defaults(load=_demo)


def _demo() -> Run:
    from modeler.cli.demo import run_demo

    return run_demo
