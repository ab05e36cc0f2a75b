"""The parser of all commands, read from `templates/commands.toml`, and its errors of usage.

Nothing that takes long to load is imported here: `modeler --help`, and the answer to a wrong
usage, come at once.
"""

import argparse
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields
from difflib import get_close_matches
from functools import cache, partial
from importlib import import_module
from itertools import takewhile
from types import MappingProxyType, NoneType
from typing import Any, Literal, NoReturn, get_args, get_origin

from modeler import __version__
from modeler.cli import places
from modeler.cli.console import Verbosity, write_stdout
from modeler.core import options
from modeler.core.choices import ABOUT, CONVENTIONS, EFFECTS, SIMULATED, TEMPLATES, list_papers
from modeler.core.files import locate_resources
from modeler.core.options import METHODS, Options

Form = Literal["text", "latex", "markdown"]
"""How relations are printed."""

FEW_JOINTS = 3
"""Robots of as many joints get their coefficients printed unasked."""

ALL = "all"
"""`--method all`: every estimator of `ABOUT`, side by side."""

Run = Callable[[argparse.Namespace], Any]
"""A command: from its arguments to what `--json` writes."""


def suggest_name(got: str, known: Iterable[str]) -> str:
    """Returns ` (did you mean x?)` for a misspelt name, else ""."""
    near = get_close_matches(got.lower(), known, 1)
    return f" (did you mean {near[0]}?)" if near else ""


def describe_unknown(got: str, known: Sequence[str]) -> str:
    """Describes an unknown word and the expected ones."""
    return f"got {got}{suggest_name(got, known)}; expected one of {', '.join(known)}"


class Methods(places.Word):
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
        """Returns True if methods are compared and no model is written."""
        return self == ALL or "," in self


# The table of commands.


class Names(places.Word):
    """Names with commas between: a list of them."""

    def __new__(cls, text: str) -> Any:
        """Splits the text."""
        return [name for part in text.split(",") if (name := part.strip())]


_TYPES = {"int": int, "float": float, "Methods": Methods, "Names": Names}
_CHOICES = {"conventions": CONVENTIONS, "forms": sorted(get_args(Form)), "templates": TEMPLATES}
_IN_WRITTEN, _IN_LOGS = (places.Output, places.OutputFolder), (places.LogFile, places.MapWord)
_RULES = ("needs", "excludes", "required_without")
_WRITING = ("--json", "--open", "--force", "--write")


@cache
def _read_table() -> dict[str, Any]:
    file = locate_resources("templates") / "commands.toml"
    table = tomllib.loads(file.read_text(encoding="utf-8"))
    table["texts"] |= {
        "duration": SIMULATED["duration"],
        "effects": ", ".join(EFFECTS),
        "few_joints": FEW_JOINTS,
        "papers": ", ".join(list_papers()),
    }
    return table


def read_commands() -> dict[str, Any]:
    """Returns the table of commands by their names."""
    commands: dict[str, Any] = _read_table()["commands"]
    return commands


def read_families() -> dict[str, list[str]]:
    """Returns the names of the commands by family, in the order of `modeler --help`."""
    families: dict[str, list[str]] = {}
    for name, command in read_commands().items():
        families.setdefault(command["family"], []).append(name)
    return families


def _build_settings(name: str, entry: Any) -> dict[str, Any]:
    """Builds what argparse takes of an argument; True: as [shared] has it, a text: a flag."""
    table = _read_table()
    entry = table["shared"][name] if entry is True else entry
    if isinstance(entry, str):
        entry = {"action": "store_true", "help": entry}
    settings = {name: value for name, value in entry.items() if name not in _RULES}
    text = settings.pop("help", argparse.SUPPRESS)
    text = text if text == argparse.SUPPRESS else text.format(**table["texts"])
    if settings.pop("either", False):
        settings["action"] = argparse.BooleanOptionalAction
    if settings.pop("repeated", False):
        settings |= {"action": "append", "default": []}
        text += "; may be repeated"
    if isinstance(settings.get("choices"), str):
        settings["choices"] = _CHOICES[settings["choices"]]
    if "simulated" in settings:
        settings["default"] = SIMULATED[settings.pop("simulated")]
    if "type" in settings:
        kind = settings["type"]
        settings["type"] = _TYPES[kind] if kind in _TYPES else getattr(places, kind)
        numeric = settings["type"] in (int, float)
        text += " (default %(default)s)" * (numeric and settings.get("default") is not None)
    return {**settings, "help": text}


def _describe_fields(kind: type[Options]) -> dict[str, dict[str, Any]]:
    """Builds the options of a class as entries of the table, by the group of the help."""
    title, groups = "", dict[str, dict[str, Any]]({"": {}})
    for each in fields(kind):
        about, title = each.metadata, kind.groups.get(each.name, title)
        entry = {"help": about["help"], "needs": about["needs"], "dest": each.name}
        entry |= _describe_type(each.type)
        if about["kind"]:
            entry |= {"type": about["kind"], "repeated": False}
        if "type" in entry:
            entry["metavar"] = about["unit"]
        if not entry.get("repeated") and each.default is not False:
            entry["default"] = each.default
        word = about["word"] or "--" + each.name.replace("_", "-")
        groups.setdefault(title, {})[word] = entry
    return groups


def _describe_type(kind: Any) -> dict[str, Any]:
    """Builds what the table says of a type: a flag, words to choose from, a number, a text."""
    if NoneType in get_args(kind):
        kind = get_args(kind)[0]
    if kind is bool:
        return {"action": "store_true"}
    if get_origin(kind) is Literal:
        return {"choices": get_args(kind)}
    if get_origin(kind) is tuple:
        return {"type": "Word", "repeated": True}
    return {"type": kind.__name__ if kind in (int, float) else "Word"}


def _find_title(name: str, kind: Any) -> str | None:
    """Finds the title of the help that an argument stands under; None: the common one."""
    if name[0] != "-":
        return None
    kind = kind if isinstance(kind, type) else object
    if name in _WRITING or issubclass(kind, _IN_WRITTEN):
        return "what is written"
    return "logs" if issubclass(kind, _IN_LOGS) else None


def _add_command(commands: Any, name: str, command: Mapping[str, Any]) -> None:
    """Adds the parser of a command to those of all commands."""
    texts = _read_table()["texts"]
    parser = commands.add_parser(
        name,
        help=command["help"],
        description=command["description"].format(**texts),
        epilog=f"example: {command['example']}",
    )
    json = {"type": "JsonFile", "metavar": "FILE"}
    json["help"] = f"{command.get('json', 'write the result for machines')}; - for stdout"
    arguments = {**command.get("arguments", {}), "--json": json}
    groups = {title: dict(entries) for title, entries in command.get("groups", {}).items()}
    if "options" in command:
        declared = _describe_fields(getattr(options, command["options"]))
        arguments |= declared.pop("")
        for heading, entries in declared.items():
            groups[heading] = {**entries, **groups.get(heading, {})}
    titled: dict[str, dict[str, Any]] = {"logs": {}, "what is written": {}}
    for word, entry in arguments.items():
        settings = _build_settings(word, entry)
        title = _find_title(word, settings.get("type"))
        if title is None:
            parser.add_argument(word, **settings)
        else:
            titled[title][word] = entry
    order = {"logs": titled["logs"], **groups, "what is written": titled["what is written"]}
    for heading, entries in order.items():
        if entries:
            group = parser.add_argument_group(heading, entries.pop("text", None))
            for word, entry in entries.items():
                group.add_argument(word, **_build_settings(word, entry))
    merged = {word: entry for each in (arguments, *groups.values()) for word, entry in each.items()}
    _set_rules(parser, merged)
    parser.set_defaults(load=partial(import_run, command["run"]))


def _set_rules(parser: "_Parser", entries: Mapping[str, Any]) -> None:
    """Sets what the options of a command need and exclude, and how a message writes each."""
    by_word = parser._option_string_actions
    ruled = {
        by_word[word].dest: entry
        for word, entry in entries.items()
        if word in by_word and isinstance(entry, dict)
    }
    parser.required = {
        name: entry["required_without"]
        for name, entry in ruled.items()
        if "required_without" in entry
    }
    rules = [(name, e.get("needs", ()), e.get("excludes", ())) for name, e in ruled.items()]
    written = {
        a.dest: a.option_strings[0] if a.option_strings else a.metavar for a in parser._actions
    }
    parser.set_defaults(rules=rules, option_words=written)


def import_run(place: str) -> Run:
    """Returns the function of a command, by its place as `fit:run_fit`."""
    module, _, function = place.partition(":")
    run: Run = getattr(import_module(f"modeler.cli.{module}"), function)
    return run


# Parsers.


class _Parser(argparse.ArgumentParser):
    """Parses one command, or all of them; help is written as a result is."""

    required: Mapping[str, Sequence[str]] = MappingProxyType({})
    """Options that are required unless one of these others is given."""

    _stated: str | None = None
    _intermixed = False  # argparse parses twice: options, then arguments

    @property
    def usage(self) -> str | None:
        """Returns the usage line of a command; argparse writes that of all commands itself."""
        if self._stated is None and self._subparsers is None:
            return format_usage(self)
        return self._stated

    @usage.setter
    def usage(self, text: str | None) -> None:
        self._stated = text

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        if self._subparsers is not None:
            for word in takewhile(lambda word: word.startswith("--"), args):
                self._check_option(word)
            return super().parse_known_args(args, namespace)
        if self._intermixed or any(a.nargs == argparse.REMAINDER for a in self._actions):
            return super().parse_known_args(args, namespace)
        words = list(takewhile(lambda word: word != "--", args))
        for word in words:
            if word[:2] == "--":
                self._check_option(word)
        self._intermixed, self.usage = True, format_usage(self)  # its arguments are hidden then
        try:  # options and arguments in any order
            arguments, rest = self.parse_known_intermixed_args(args, namespace)
        finally:
            self._intermixed = False
        for word in rest:
            if word.startswith("-") and len(word) > 1:
                self._refuse_option(word)
        if rest:
            self.error(f"got {' '.join(rest)} as well; expected no more arguments")
        for name, others in self.required.items():
            given = (
                getattr(value, "is_several", value) for value in map(vars(arguments).get, others)
            )
            if getattr(arguments, name) is None and not any(given):
                self.error(f"the following arguments are required: --{name}")
        typed = (find_option(self, word) for word in words)
        arguments.typed = frozenset(action.dest for action in typed if action is not None)
        return arguments, rest

    def _check_option(self, word: str) -> None:
        name = word.partition("=")[0]
        if not any(option.startswith(name) for option in collect_options(self)):
            self._refuse_option(word)

    def _refuse_option(self, word: str) -> NoReturn:
        near = suggest_name(word.partition("=")[0], collect_options(self))
        self.error(f"unknown option {word}{near}")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is None or value in action.choices:
            return
        if isinstance(action, argparse._SubParsersAction):
            self.error(f"unknown command {value}{suggest_name(value, action.choices)}")
        raise argparse.ArgumentError(action, describe_unknown(value, [*map(str, action.choices)]))

    def format_help(self) -> str:
        """Returns the help; that of all commands shows them by family."""
        if self._subparsers is None:
            return super().format_help()
        (commands,) = (a for a in self._actions if isinstance(a, argparse._SubParsersAction))
        by_name = {action.dest: action for action in commands._choices_actions}
        text = self._get_formatter()
        text.add_usage(self.usage, self._actions, self._mutually_exclusive_groups)
        text.add_text(self.description)
        sections = [(title, [by_name[n] for n in each]) for title, each in read_families().items()]
        sections += [
            (group.title or "", [a for a in group._group_actions if a is not commands])
            for group in self._action_groups
        ]
        for title, actions in sections:
            text.start_section(title)
            text.add_arguments(actions)
            text.end_section()
        text.add_text(self.epilog)
        return text.format_help()

    def error(self, message: str) -> NoReturn:
        """Prints one line and exits."""
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


_EPILOG = """\
example: modeler derive wrist

exit status:
  0    done
  1    the input is at fault: one line says where, what it got, what it expects, what to do
  2    wrong usage: no such command or option, or an argument is missing
  130  interrupted (Ctrl-C)

results go to stdout; errors, notes and progress to stderr"""


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
    for name, command in read_commands().items():
        _add_command(commands, name, command)
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
    (commands,) = (a for a in top._actions if isinstance(a, argparse._SubParsersAction))
    return dict(commands.choices)


def _add_verbosity(parser: argparse.ArgumentParser) -> argparse._ArgumentGroup:
    """Adds -q and -v, before the command or after it."""
    group = parser.add_argument_group("output")
    for verbosity, short, text in (
        (Verbosity.QUIET, "-q", "results and errors only: no notes, no progress"),
        (Verbosity.VERBOSE, "-v", "every step with its seconds, versions, tracebacks"),
    ):
        group.add_argument(
            short, f"--{verbosity.value}", action="store_true", default=argparse.SUPPRESS, help=text
        )
    return group


def parse_words(words: Sequence[str]) -> tuple[argparse.Namespace, Verbosity]:
    """Parses a command line into arguments and verbosity; wrong usage exits with status 2."""
    top = build_parser()
    at = next((i for i, word in enumerate(words) if not word.startswith("-")), None)
    if at is not None and words[at] == "help":  # as other programs have it
        words = [*words[:at], *words[at + 1 :], "--help"]
    args = top.parse_args(words)
    verbosities = [each for each in Verbosity if vars(args).pop(each.value, False)]
    if len(verbosities) > 1:
        top.error("got --quiet and --verbose; expected one of them")
    return args, verbosities[0] if verbosities else Verbosity.NORMAL


def collect_options(parser: argparse.ArgumentParser) -> dict[str, argparse.Action]:
    """Returns every option by each of its names."""
    return {name: action for action in parser._actions for name in action.option_strings}


def collect_arguments(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    """Returns the positional arguments of a command, in order."""
    return [action for action in parser._actions if not action.option_strings]


def find_option(parser: argparse.ArgumentParser, word: str) -> argparse.Action | None:
    """Finds the option that a word names in full or cut short; None for none, or several."""
    known, name = collect_options(parser), word.partition("=")[0]
    if name in known:
        return known[name]
    full_names = [full for full in known if name.startswith("--") and full.startswith(name)]
    return known[full_names[0]] if len(full_names) == 1 else None


# The usage line of a command: arguments first, which works with every option after them.

_WIDTH = 96


def format_usage(parser: argparse.ArgumentParser) -> str:
    """Returns `modeler COMMAND ARGUMENT... --required VALUE [--option VALUE]`, wrapped."""
    options = [a for a in parser._actions if a.option_strings and a.help != argparse.SUPPRESS]
    options.sort(key=lambda action: (not action.required, action.dest != "out"))
    parts = [_format_values(action) for action in collect_arguments(parser)]
    for action in options:
        name = action.option_strings[0]
        text = name if action.nargs == 0 else f"{name} {_format_values(action)}"
        if isinstance(action, argparse.BooleanOptionalAction):
            text = " | ".join(action.option_strings)
        parts.append(text if action.required else f"[{text}]")
    indent = " " * len("usage: modeler ")
    lines = [parser.prog]
    for part in parts:
        if len(lines[-1]) + len(part) + 1 > _WIDTH - len("usage: ") * (len(lines) == 1):
            lines.append(indent + part)
        else:
            lines[-1] += f" {part}"
    return "\n".join(lines).replace("%", "%%")


def _format_values(action: argparse.Action) -> str:
    choices = "{" + ",".join(map(str, action.choices or ())) + "}"
    name = str(action.metavar or (choices if action.choices else action.dest.upper()))
    forms = {"?": f"[{name}]", "*": f"[{name} ...]", "+": f"{name} [{name} ...]"}
    return forms.get(str(action.nargs), name)
