"""How arguments of commands are declared; the usage line."""

import argparse
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import partial
from importlib import import_module
from typing import Any, Literal, get_args

from modeler.cli.places import JsonFile, LogFile, MapWord, Output, OutputFolder, Word
from modeler.core import choices
from modeler.core.choices import ABOUT

Form = Literal["text", "latex", "markdown"]
"""How relations are printed."""

FEW_JOINTS = 3
"""Robots of as many joints get their coefficients printed unasked."""

METHODS = (*get_args(choices.Method), choices.GAIN_METHOD, choices.TWO_STEPS)
ALL = "all"
"""`--method all`: every estimator of `ABOUT`, side by side."""

Run = Callable[[argparse.Namespace], Any]
"""A command: from its arguments to what `--json` writes."""


@dataclass(frozen=True)
class Argument:
    """An argument or an option, as argparse takes it.

    Attributes:
        names: as typed.
        settings: of argparse.
    """

    names: tuple[str, ...]
    settings: Mapping[str, Any]

    def add_to(self, parser: argparse._ActionsContainer) -> None:
        """To the parser of a command, or a group in it."""
        parser.add_argument(*self.names, **self.settings)

    @property
    def group_title(self) -> str | None:
        """The group of the help that it stands in by itself; None: with all others."""
        kind, name = self.settings.get("type"), self.names[0]
        if name[0] != "-":
            return None
        if name in _OF_WRITING or (isinstance(kind, type) and issubclass(kind, _WRITTEN)):
            return "what is written"
        return "logs" if isinstance(kind, type) and issubclass(kind, _LOGS) else None


_WRITTEN, _LOGS = (Output, OutputFolder), (LogFile, MapWord)
_OF_WRITING = ("--json", "--open", "--force", "--write")


@dataclass(frozen=True)
class Group:
    """Options under a title of their own."""

    title: str
    text: str | None
    options: tuple[Argument, ...]

    def add_to(self, parser: argparse.ArgumentParser) -> None:
        """To the parser of a command."""
        group = parser.add_argument_group(self.title, self.text)
        for option in self.options:
            option.add_to(group)


@dataclass(frozen=True)
class Command:
    """What is typed, what `--help` says of it, and what carries it out.

    Attributes:
        name: of the command.
        run: "module:function" in this package; imported when the command runs.
        help: its line in `modeler --help`.
        description: begins its own help.
        example: ends it.
        arguments: in the order of the help; `--json` follows them.
        json: what that writes.
        lacks: what is wrong with a line that argparse takes; "" for nothing.
    """

    name: str
    run: str
    help: str
    description: str
    example: str
    arguments: tuple[Argument | Group, ...]
    json: str = "write the result for machines"
    lacks: Callable[[argparse.Namespace], str] = lambda args: ""

    def add_to(self, commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
        """Its parser, among those of all commands."""
        parser = commands.add_parser(
            self.name,
            help=self.help,
            description=self.description,
            epilog=f"example: {self.example}",
        )
        json = value("--json", "FILE", JsonFile, f"{self.json}; - for stdout")
        titled: dict[str, list[Argument]] = {"logs": [], "what is written": []}
        groups = [each for each in self.arguments if isinstance(each, Group)]
        for each in (*self.arguments, json):
            if isinstance(each, Argument):
                if each.group_title is None:
                    each.add_to(parser)
                else:
                    titled[each.group_title].append(each)
        titled_groups = [
            Group(title, None, tuple(options)) for title, options in titled.items() if options
        ]
        for group in (*titled_groups[:-1], *groups, titled_groups[-1]):
            group.add_to(parser)
        parser.set_defaults(load=partial(_import_run, self.run), lacks=self.lacks)


def _import_run(place: str) -> Run:
    module, _, function = place.partition(":")
    run: Run = getattr(import_module(f"modeler.cli.{module}"), function)
    return run


def value(
    name: str, metavar: str, kind: Callable[[str], Any], text: str, **further: Any
) -> Argument:
    """An argument, or an option with a value; the help of a number tells its default, if any."""
    if kind in (int, float) and further.get("default") is not None:
        text += " (default %(default)s)"
    return Argument((name,), {"metavar": metavar, "type": kind, "help": text, **further})


def repeated(name: str, metavar: str, kind: type[str], text: str, **further: Any) -> Argument:
    """An option with one value; a list is given by repeating it."""
    text += "; may be repeated"
    return value(name, metavar, kind, text, action="append", default=[], **further)


def choice(name: str, choices: Sequence[str], text: str, default: str | None = None) -> Argument:
    """An option that takes one of some words."""
    return Argument((name,), {"choices": choices, "default": default, "help": text})


def flag(name: str, text: str) -> Argument:
    """An option without a value."""
    return Argument((name,), {"action": "store_true", "help": text})


def suggest_name(got: str, known: Iterable[str]) -> str:
    """` (did you mean x?)` of a misspelt name, else nothing."""
    near = get_close_matches(got.lower(), known, 1)
    return f" (did you mean {near[0]}?)" if near else ""


def describe_unknown(got: str, known: Sequence[str]) -> str:
    """What is said of a word that is none of a few."""
    return f"got {got}{suggest_name(got, known)}; expected one of {', '.join(known)}"


class Methods(Word):
    """An estimator; several with commas between; or `ALL`."""

    def __new__(cls, text: str) -> "Methods":
        """Refuses a name that is none, as a wrong usage."""
        names = text.split(",")
        known = (*METHODS, ALL) if len(names) == 1 else tuple(ABOUT)
        for name in names:
            if name not in known:
                raise argparse.ArgumentTypeError(describe_unknown(name, known))
        return super().__new__(cls, text)

    @property
    def is_several(self) -> bool:
        """Whether they are compared, and no model is written."""
        return self == ALL or "," in self


def collect_options(parser: argparse.ArgumentParser) -> dict[str, argparse.Action]:
    """Every option by each of its names."""
    return {name: action for action in parser._actions for name in action.option_strings}


def collect_arguments(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    """What a command takes beside options, in order."""
    return [action for action in parser._actions if not action.option_strings]


def find_option(parser: argparse.ArgumentParser, word: str) -> argparse.Action | None:
    """The option that a word names, which may be cut short; None if it names none, or several."""
    known, name = collect_options(parser), word.partition("=")[0]
    if name in known:
        return known[name]
    meant = [known[full] for full in known if name.startswith("--") and full.startswith(name)]
    return meant[0] if len(meant) == 1 else None


# The usage line of a command: arguments first, which works with every option after them.


_WIDTH = 96


def format_usage(parser: argparse.ArgumentParser) -> str:
    """`modeler COMMAND ARGUMENT... --required VALUE [--option VALUE]`, wrapped."""
    options = [
        action
        for action in parser._actions
        if action.option_strings and action.help != argparse.SUPPRESS
    ]
    parts = [
        *(_format_values(action) for action in collect_arguments(parser)),
        *(
            _format_option(action) if action.required else f"[{_format_option(action)}]"
            for action in sorted(options, key=lambda a: (not a.required, a.dest != "out"))
        ),
    ]
    return _wrap_parts(parser.prog, parts).replace("%", "%%")


def _format_option(action: argparse.Action) -> str:
    if isinstance(action, argparse.BooleanOptionalAction):
        return " | ".join(action.option_strings)
    name = action.option_strings[0]
    return name if action.nargs == 0 else f"{name} {_format_values(action)}"


def _format_values(action: argparse.Action) -> str:
    choices = "{" + ",".join(map(str, action.choices or ())) + "}"
    name = str(action.metavar or (choices if action.choices else action.dest.upper()))
    forms = {"?": f"[{name}]", "*": f"[{name} ...]", "+": f"{name} [{name} ...]"}
    return forms.get(str(action.nargs), name)


def _wrap_parts(prog: str, parts: Sequence[str]) -> str:
    """Lines of `_WIDTH` at most, broken between parts."""
    indent = " " * len("usage: modeler ")
    lines = [prog]
    for part in parts:
        if len(lines[-1]) + len(part) + 1 > _WIDTH - len("usage: ") * (len(lines) == 1):
            lines.append(indent + part)
        else:
            lines[-1] += f" {part}"
    return "\n".join(lines)
