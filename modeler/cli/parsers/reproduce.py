"""`modeler reproduce PAPER`."""

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import Word
from modeler.papers.paper import paper_names

SECTIONS = ("print", "methods")


def add_reproduce(commands: Commands) -> None:
    """`modeler reproduce`."""
    parser = commands.add_parser(
        "reproduce",
        help="what a paper prints beside what is derived, its identification run again",
        description="Quotes what a paper prints, derives it, and says of every line: printed and "
        "equal, printed and different (a misprint, an omission, an error, or perhaps the scan), or "
        "our consequence, not printed. Then runs the paper's identification again in simulation "
        "and sets its tables beside ours. Exit status 1 if a line differs unexpectedly.",
        epilog="example: modeler reproduce guegan-2003 --section methods",
    )
    parser.add_argument(
        "paper", metavar="PAPER", type=Word, help=f"one of {', '.join(paper_names())}"
    )
    parser.add_argument(
        "--section", choices=SECTIONS, help="what is printed, or the methods; both by default"
    )
    add_json(parser, "write the lines for machines")
    parser.set_defaults(load=_reproduce)


def _reproduce() -> Run:
    from modeler.cli.reproduce import run_reproduce

    return run_reproduce
