"""What the parsers of several commands share."""

import argparse


def add_number(
    parser: argparse._ActionsContainer,
    option: str,
    metavar: str,
    kind: type[float] | type[int],
    text: str,
    default: float | None = None,
) -> None:
    """An option that takes a number; its help tells the default if there is one."""
    told = text if default is None else f"{text} (default %(default)s)"
    parser.add_argument(option, metavar=metavar, type=kind, default=default, help=told)
