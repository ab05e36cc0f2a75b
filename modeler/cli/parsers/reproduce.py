"""`modeler reproduce PAPER`."""

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import Word
from modeler.papers.paper import paper_names


def add_reproduce(commands: Commands) -> None:
    """`modeler reproduce`."""
    parser = commands.add_parser(
        "reproduce",
        help="a paper's base parameters and relations beside the derived ones",
        description="Derives the robot of a paper and marks every printed line: equal, misprint "
        "in the paper, or different. Exit status 1 if a line differs unexpectedly.",
        epilog="example: modeler reproduce guegan-2003",
    )
    parser.add_argument(
        "paper", metavar="PAPER", type=Word, help=f"one of {', '.join(paper_names())}"
    )
    add_json(parser, "write the lines for machines")
    parser.set_defaults(load=_reproduce)


def _reproduce() -> Run:
    from modeler.cli.reproduce import run_reproduce

    return run_reproduce
