"""`modeler completion SHELL`."""

import argparse

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import Word

SHELLS = ("bash", "zsh", "fish")


def add_completion(commands: Commands) -> None:
    """`modeler completion`."""
    parser = commands.add_parser(
        "completion",
        help="a script that lets a shell complete what you type",
        description="Prints a script for bash, zsh or fish: with it, the Tab key completes "
        "commands, options, built-in robots, effects, and files of the right kind.",
        epilog='example: eval "$(modeler completion bash)"',
    )
    parser.add_argument("shell", metavar="SHELL", choices=SHELLS, help=", ".join(SHELLS))
    parser.add_argument(
        "--words", nargs=argparse.REMAINDER, type=Word, help=argparse.SUPPRESS
    )  # what the scripts call: the line so far, its last word unfinished
    add_json(parser, "write the script for machines")
    parser.set_defaults(load=_completion)


def _completion() -> Run:
    from modeler.cli.completion import run_completion

    return run_completion
