"""The parser: one for each command of the table, and what it says of a wrong usage."""

import argparse
from collections.abc import Sequence
from difflib import get_close_matches
from typing import NoReturn

from modeler import __version__
from modeler.cli.command_table import COMMANDS
from modeler.cli.console import Loudness, write_stdout
from modeler.cli.options import arguments_of, sorted_words, usage_of

_EPILOG = """\
example: modeler derive wrist

exit status:
  0    done
  1    the input is at fault: one line says where, what it got, what it expects, what to do
  2    wrong usage: no such command or option, or an argument is missing
  130  interrupted (Ctrl-C)

results go to stdout; errors, notes and progress to stderr"""


class _Parser(argparse.ArgumentParser):
    """One command, or all of them.

    Help that cannot be written is told, as any result; argparse would drop it unsaid.
    """

    _stated: str | None = None

    @property
    def usage(self) -> str | None:
        """Of a command; argparse writes that of all commands itself."""
        return self._stated if self._subparsers is not None else usage_of(self)

    @usage.setter
    def usage(self, text: str | None) -> None:
        self._stated = text

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        if self._subparsers is not None:
            return super().parse_known_args(args, namespace)
        if any(action.nargs == argparse.REMAINDER for action in self._actions):
            found, rest = super().parse_known_args(args, namespace)
            found.read_as = ""
            return found, rest
        read = sorted_words(self, args)
        words = read.words if arguments_of(self) else [w for w in read.words if w != "--"]
        found, rest = super().parse_known_args(words, namespace)
        if rest:
            self.error(self._unknown(rest))
        found.read_as = read.told
        return found, rest

    def _unknown(self, rest: Sequence[str]) -> str:
        """What is said of words that no argument takes."""
        for word in rest:
            if word.startswith("-") and len(word) > 1:
                near = get_close_matches(word.partition("=")[0], self._option_string_actions, 1)
                return f"unknown option {word}" + "".join(f" (did you mean {n}?)" for n in near)
        return f"got {' '.join(rest)} as well; expected no more arguments"

    def error(self, message: str) -> NoReturn:
        """One line, and the end."""
        self.exit(2, f"{self.prog}: {message}; write it as `{self.prog} --help` shows\n")

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
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action=_Version, nargs=0, help="print it and stop")
    commands = top.add_subparsers(metavar="COMMAND", required=True, dest="command")
    for command in COMMANDS:
        command.add_to(commands)
    commands.choices["completion"].set_defaults(top=top)
    for each in (top, *commands.choices.values()):
        _add_loudness(each)
    return top


def _add_loudness(parser: argparse.ArgumentParser) -> None:
    """Before the command or after it; a command that is not told keeps what was said before."""
    group = parser.add_argument_group("what is told")
    for loudness, short, text in (
        (Loudness.QUIET, "-q", "results and errors only: no notes, no progress"),
        (Loudness.VERBOSE, "-v", "every step with its seconds, versions, where an error came from"),
    ):
        group.add_argument(
            short, f"--{loudness.value}", action="store_true", default=argparse.SUPPRESS, help=text
        )


def parsed(words: Sequence[str]) -> tuple[argparse.Namespace, Loudness]:
    """The arguments of a command, and how much it tells.

    Wrong usage ends the program with status 2.
    """
    top = parser()
    args = top.parse_args(list(words))
    wanted = [loudness for loudness in Loudness if vars(args).pop(loudness.value, False)]
    if len(wanted) > 1:
        top.error("got --quiet and --verbose; expected one of them")
    return args, wanted[0] if wanted else Loudness.USUAL
