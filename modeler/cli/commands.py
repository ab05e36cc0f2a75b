"""The parser: one for each command of the table, and what it says of a wrong usage."""

import argparse
from collections.abc import Sequence
from functools import cache
from itertools import takewhile
from typing import Any, NoReturn

from modeler import __version__
from modeler.cli.command_table import COMMANDS, FAMILIES
from modeler.cli.console import Verbosity, write_stdout
from modeler.cli.options import (
    collect_options,
    describe_unknown,
    find_option,
    format_usage,
    suggest_name,
)

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
    _intermixed = False  # argparse parses twice: options, then arguments

    @property
    def usage(self) -> str | None:
        """Of a command; argparse writes that of all commands itself."""
        if self._stated is None and self._subparsers is None:
            return format_usage(self)
        return self._stated

    @usage.setter
    def usage(self, text: str | None) -> None:
        self._stated = text

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        if self._subparsers is not None:
            for word in takewhile(lambda word: word.startswith("--"), args):
                if not any(name.startswith(word) for name in collect_options(self)):
                    self.error(self._describe_unknown(word))
            return super().parse_known_args(args, namespace)
        if self._intermixed or any(a.nargs == argparse.REMAINDER for a in self._actions):
            return super().parse_known_args(args, namespace)
        words = list(takewhile(lambda word: word != "--", args))
        for word in words:
            name = word.partition("=")[0]
            if name[:2] == "--" and not any(
                full.startswith(name) for full in collect_options(self)
            ):
                self.error(self._describe_unknown(word))
        self._intermixed, self.usage = (
            True,
            format_usage(self),
        )  # its arguments are hidden meanwhile
        try:  # options and arguments in any order
            arguments, rest = self.parse_known_intermixed_args(args, namespace)
        finally:
            self._intermixed = False
        if rest:
            options = [word for word in rest if word.startswith("-") and len(word) > 1]
            self.error(
                self._describe_unknown(options[0])
                if options
                else f"got {' '.join(rest)} as well; expected no more arguments"
            )
        if lacks := arguments.lacks(arguments):
            self.error(lacks)
        typed = (find_option(self, word) for word in words)
        arguments.given = frozenset(action.dest for action in typed if action is not None)
        return arguments, rest

    def _describe_unknown(self, option: str) -> str:
        """What is said of an option that is none."""
        name = option.partition("=")[0]
        return f"unknown option {option}{suggest_name(name, collect_options(self))}"

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is None or value in action.choices:
            return
        if isinstance(action, argparse._SubParsersAction):
            near = suggest_name(value, COMMANDS)
            self.error(f"unknown command {value}{near}")
        raise argparse.ArgumentError(action, describe_unknown(value, [*map(str, action.choices)]))

    def format_help(self) -> str:
        """Of all commands: those that belong together under their title."""
        if self._subparsers is None:
            return super().format_help()
        (listed,) = (a for a in self._actions if isinstance(a, argparse._SubParsersAction))
        actions_by_name = {action.dest: action for action in listed._choices_actions}
        text = self._get_formatter()
        text.add_usage(self.usage, self._actions, self._mutually_exclusive_groups)
        text.add_text(self.description)
        sections = [
            (title, [actions_by_name[c.name] for c in each]) for title, each in FAMILIES.items()
        ]
        sections += [
            (group.title or "", [a for a in group._group_actions if a is not listed])
            for group in self._action_groups
        ]
        for title, actions in sections:
            text.start_section(title)
            text.add_arguments(actions)
            text.end_section()
        text.add_text(self.epilog)
        return text.format_help()

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


@cache
def build_parser() -> argparse.ArgumentParser:
    """Builds the parser of all commands; it is cached, so nothing may be added to it."""
    top: argparse.ArgumentParser = _Parser(
        prog="modeler",
        description="From the MDH table of a robot to exact base parameters, C, a fit and a "
        "comparison with measurements.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action=_Version, nargs=0, help="print it and stop")
    commands = top.add_subparsers(metavar="COMMAND", required=True, dest="command")
    for command in COMMANDS.values():
        command.add_to(commands)
    commands.choices["completion"].set_defaults(top=top)
    _add_verbosity(top)
    for each in commands.choices.values():
        _add_verbosity(each).add_argument(
            "--progress",
            choices=("bar", "lines"),
            default="bar",
            help="on a terminal a bar; lines: on stderr, for a program that reads "
            "`progress SHARE TITLE`, SHARE 0 to 1 or -",
        )
    return top


def collect_command_parsers(top: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Returns the parser of each command by its name."""
    (listed,) = (a for a in top._actions if isinstance(a, argparse._SubParsersAction))
    return dict(listed.choices)


def _add_verbosity(parser: argparse.ArgumentParser) -> argparse._ArgumentGroup:
    """Before the command or after it; a command that is not told keeps what was said before."""
    group = parser.add_argument_group("what is told")
    for verbosity, short, text in (
        (Verbosity.QUIET, "-q", "results and errors only: no notes, no progress"),
        (
            Verbosity.VERBOSE,
            "-v",
            "every step with its seconds, versions, where an error came from",
        ),
    ):
        group.add_argument(
            short, f"--{verbosity.value}", action="store_true", default=argparse.SUPPRESS, help=text
        )
    return group


def parse_words(words: Sequence[str]) -> tuple[argparse.Namespace, Verbosity]:
    """Parses a command line into arguments and verbosity.

    Wrong usage ends the program with status 2.
    """
    top = build_parser()
    at = next((i for i, word in enumerate(words) if not word.startswith("-")), None)
    if at is not None and words[at] == "help":  # as other programs have it
        words = [*words[:at], *words[at + 1 :], "--help"]
    args = top.parse_args(words)
    verbosities = [verbosity for verbosity in Verbosity if vars(args).pop(verbosity.value, False)]
    if len(verbosities) > 1:
        top.error("got --quiet and --verbose; expected one of them")
    return args, verbosities[0] if verbosities else Verbosity.NORMAL
