"""What can be typed: one parser for each command, without what the command runs.

Nothing that takes long to load is imported here: `modeler --help`, and the answer to a wrong
usage, come at once.
"""

import argparse

from modeler import __version__
from modeler.cli.console import write_stdout
from modeler.cli.parsers.add import add_add
from modeler.cli.parsers.convert import add_convert
from modeler.cli.parsers.demo import add_demo
from modeler.cli.parsers.derive import add_derive, add_generate
from modeler.cli.parsers.diagnose import add_diagnose
from modeler.cli.parsers.estimators import add_estimators
from modeler.cli.parsers.excite import add_excite
from modeler.cli.parsers.fit import add_compare, add_fit
from modeler.cli.parsers.home import add_home
from modeler.cli.parsers.lists import add_effects, add_robots
from modeler.cli.parsers.physical import add_physical
from modeler.cli.parsers.reproduce import add_reproduce
from modeler.cli.parsers.show import add_show
from modeler.cli.parsers.simulate import add_simulate

_COMMANDS = (
    add_derive, add_show, add_home, add_generate, add_fit, add_compare, add_diagnose, add_add,
    add_physical, add_simulate, add_excite, add_convert, add_robots, add_effects, add_estimators,
    add_reproduce, add_demo,
)  # fmt: skip


class _Parser(argparse.ArgumentParser):
    """Help that cannot be written is told, as any result; argparse would drop it unsaid."""

    def print_help(self, file=None) -> None:  # type: ignore[no-untyped-def]
        if file is None:
            write_stdout(self.format_help())
        else:
            super().print_help(file)


class _Version(argparse.Action):
    """`--version`."""

    def __call__(self, parser, namespace, values, option_string=None) -> None:  # type: ignore[no-untyped-def]
        write_stdout(f"modeler {__version__}\n")
        parser.exit()


def parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    top: argparse.ArgumentParser = _Parser(
        prog="modeler",
        description="From the MDH table of a robot to exact base parameters, C, a fit and a "
        "comparison with measurements.",
        epilog="example: modeler derive wrist",
    )
    top.add_argument("--version", action=_Version, nargs=0, help="print it and stop")
    commands = top.add_subparsers(metavar="COMMAND", required=True)
    for add in _COMMANDS:
        add(commands)
    return top
