"""How arguments of commands are declared; the order of words; the usage line."""

import argparse
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import partial
from importlib import import_module
from typing import Any, Literal, get_args

from modeler.cli.places import JsonFile, LogFile, MapWord, Output, OutputFolder, Word
from modeler.core import errors
from modeler.core.estimators import ABOUT

Form = Literal["text", "latex", "markdown"]
"""How relations are printed."""

FEW_JOINTS = 3
"""Robots of as many joints get their coefficients printed unasked."""

METHODS = (*get_args(errors.Method), errors.GAIN_METHOD, errors.TWO_STEPS)
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
    def title(self) -> str | None:
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
                if each.title is None:
                    each.add_to(parser)
                else:
                    titled[each.title].append(each)
        own = [Group(title, None, tuple(options)) for title, options in titled.items() if options]
        for group in (*own[:-1], *groups, own[-1]):
            group.add_to(parser)
        parser.set_defaults(load=partial(_imported, self.run), lacks=self.lacks)


def _imported(place: str) -> Run:
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


def repeated(name: str, metavar: str, kind: type[str], text: str) -> Argument:
    """An option with one value, which may be given several times."""
    return value(name, metavar, kind, text, action="append", default=[])


def several(name: str, metavar: str, kind: type[str], text: str, **further: Any) -> Argument:
    """An option that takes several words, and may be repeated; see below on where it ends."""
    text = f"{text}; all words up to the next option or --; may be repeated"
    return value(name, metavar, kind, text, nargs="+", action="extend", default=[], **further)


def choice(name: str, choices: Sequence[str], text: str, default: str | None = None) -> Argument:
    """An option that takes one of some words."""
    return Argument((name,), {"choices": choices, "default": default, "help": text})


def flag(name: str, text: str) -> Argument:
    """An option without a value."""
    return Argument((name,), {"action": "store_true", "help": text})


def did_you_mean(got: str, known: Iterable[str]) -> str:
    """` (did you mean x?)` of a misspelt name, else nothing."""
    near = get_close_matches(got.lower(), known, 1)
    return f" (did you mean {near[0]}?)" if near else ""


def unknown(got: str, known: Sequence[str]) -> str:
    """What is said of a word that is none of a few."""
    return f"got {got}{did_you_mean(got, known)}; expected one of {', '.join(known)}"


class Methods(Word):
    """An estimator; several with commas between; or `ALL`."""

    def __new__(cls, text: str) -> "Methods":
        """Refuses a name that is none, as a wrong usage."""
        names = text.split(",")
        known = (*METHODS, ALL) if len(names) == 1 else tuple(ABOUT)
        for name in names:
            if name not in known:
                raise argparse.ArgumentTypeError(unknown(name, known))
        return super().__new__(cls, text)

    @property
    def several(self) -> bool:
        """Whether they are compared, and no model is written."""
        return self == ALL or "," in self


# Words in any order: options before or after what they stand beside.
#
# By itself, argparse lets `--holdout LOG...` take every word up to the next option, and then misses
# the arguments that these words were. Here such an option takes them too, but the last words go
# back to arguments that would have none: `diagnose m.json --holdout b a` is `diagnose m.json a
# --holdout b`. `--` ends every option.


_NUMBER = re.compile(r"-\d+$|-\d*\.\d+$")  # what argparse takes for a negative number


@dataclass
class _Typed:
    """An option as typed, and the places of the words that are its values."""

    word: int
    action: argparse.Action | None
    values: list[int] = field(default_factory=list)
    attached: bool = False

    @property
    def spare(self) -> int:
        """Values that it can do without."""
        if self.action is None or self.attached or self.action.nargs not in ("+", "?"):
            return 0
        return len(self.values) - (self.action.nargs == "+")


@dataclass(frozen=True)
class Sorted:
    """Words as argparse understands them in one way only.

    Attributes:
        words: options with their values, `--`, then the arguments in order.
        arguments: those.
        told: how a doubtful line was read; "" where nothing was given back.
        open: the option whose value the next word would be; None: it is an argument or an option.
        unknown: what looks like an option and is none.
        given: options that were typed, by the names of their values.
    """

    words: list[str]
    arguments: list[str]
    told: str
    open: argparse.Action | None
    unknown: list[str]
    given: frozenset[str]


def sorted_words(parser: argparse.ArgumentParser, words: Sequence[str]) -> Sorted:
    """Options first, then what is no option; see above for options with several values.

    Args:
        parser: of one command.
        words: as typed after the command.
    """
    taken, free, ended = _split(parser, words)
    back = _given_back(parser, taken, len(free)) if not ended else []
    free = sorted([*free, *back])
    known = options_of(parser)
    options = [
        word
        for each in taken
        for word in (_whole(words[each.word], each.action, known), *(words[i] for i in each.values))
    ]
    arguments = [words[i] for i in free]
    last = taken[-1] if taken else None
    opened = last if last is not None and _may_take(last, words) and not ended else None
    return Sorted(
        words=[*options, *(["--", *arguments] if arguments or ended else [])],
        arguments=arguments,
        told=_told(parser, taken, words, arguments) if back else "",
        open=None if opened is None else opened.action,
        unknown=[
            words[each.word]
            for each in taken
            if words[each.word].startswith("--")
            and not any(name.startswith(words[each.word].partition("=")[0]) for name in known)
        ],
        given=frozenset(each.action.dest for each in taken if each.action is not None),
    )


def _whole(word: str, action: argparse.Action | None, known: Mapping[str, argparse.Action]) -> str:
    """An option that was cut short, in full."""
    name, equals, value = word.partition("=")
    if action is None or name in known:
        return word
    full = next(full for full, each in known.items() if each is action and full.startswith(name))
    return full + equals + value


def options_of(parser: argparse.ArgumentParser) -> dict[str, argparse.Action]:
    """Every option by each of its names."""
    return {name: action for action in parser._actions for name in action.option_strings}


def arguments_of(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    """What a command takes beside options, in order."""
    return [action for action in parser._actions if not action.option_strings]


def _split(
    parser: argparse.ArgumentParser, words: Sequence[str]
) -> tuple[list[_Typed], list[int], bool]:
    """Options with their values, places of all else, and whether `--` was among them."""
    taken: list[_Typed] = []
    free: list[int] = []
    for i, word in enumerate(words):
        if word == "--":
            return taken, [*free, *range(i + 1, len(words))], True
        if _is_option(word):
            name, equals, _ = word.partition("=")
            taken.append(_Typed(i, _action(parser, name), attached=bool(equals)))
        elif taken and _may_take(taken[-1], words[:i]):
            taken[-1].values.append(i)
        else:
            free.append(i)
    return taken, free, False


def _is_option(word: str) -> bool:
    return len(word) > 1 and word[0] == "-" and not _NUMBER.match(word) and " " not in word


def _action(parser: argparse.ArgumentParser, name: str) -> argparse.Action | None:
    """The option of that name, or of names that begin so, if it is one option."""
    known = options_of(parser)
    if name in known:
        return known[name]
    meant = [known[full] for full in known if name.startswith("--") and full.startswith(name)]
    return meant[0] if meant and all(action is meant[0] for action in meant) else None


def _may_take(option: _Typed, words: Sequence[str]) -> bool:
    """Whether the word after `words` is a value of this, the last option in them."""
    if option.action is None or option.attached:
        return False
    if option.word + len(option.values) + 1 != len(words):
        return False
    nargs = option.action.nargs
    most = nargs if isinstance(nargs, int) else {None: 1, "?": 1, "+": len(words)}.get(nargs, 0)
    return len(option.values) < most


def _given_back(parser: argparse.ArgumentParser, taken: Sequence[_Typed], free: int) -> list[int]:
    """Takes from options what arguments would lack; one word is enough for each argument."""
    missing = len(arguments_of(parser)) - free
    back: list[int] = []
    for option in reversed(taken):
        for _ in range(min(option.spare, missing - len(back))):
            back.append(option.values.pop())
    return back


def _told(
    parser: argparse.ArgumentParser,
    taken: Sequence[_Typed],
    words: Sequence[str],
    arguments: Sequence[str],
) -> str:
    several = [
        " ".join([words[each.word], *(words[i] for i in each.values)])
        for each in taken
        if each.action is not None and each.action.nargs in ("+", "?")
    ]
    names = " ".join(str(action.metavar) for action in arguments_of(parser))
    return (
        f"read as {names} = {' '.join(arguments)} and {', '.join(several)}; for another reading "
        f"put {names} first, or -- before it"
    )


# The usage line of a command: arguments first, which works with every option after them.


_WIDTH = 96


def usage_of(parser: argparse.ArgumentParser) -> str:
    """`modeler COMMAND ARGUMENT... --required VALUE [--option VALUE]`, wrapped."""
    options = [
        action
        for action in parser._actions
        if action.option_strings and action.help != argparse.SUPPRESS
    ]
    parts = [
        *(_values(action) for action in arguments_of(parser)),
        *(
            _option(action) if action.required else f"[{_option(action)}]"
            for action in sorted(options, key=lambda a: (not a.required, a.dest != "out"))
        ),
    ]
    return _wrapped(parser.prog, parts).replace("%", "%%")


def _option(action: argparse.Action) -> str:
    if isinstance(action, argparse.BooleanOptionalAction):
        return " | ".join(action.option_strings)
    name = action.option_strings[0]
    return name if action.nargs == 0 else f"{name} {_values(action)}"


def _values(action: argparse.Action) -> str:
    choices = "{" + ",".join(map(str, action.choices or ())) + "}"
    name = str(action.metavar or (choices if action.choices else action.dest.upper()))
    forms = {"?": f"[{name}]", "*": f"[{name} ...]", "+": f"{name} [{name} ...]"}
    return forms.get(str(action.nargs), name)


def _wrapped(prog: str, parts: Sequence[str]) -> str:
    """Lines of `_WIDTH` at most, broken between parts."""
    indent = " " * len("usage: modeler ")
    lines = [prog]
    for part in parts:
        if len(lines[-1]) + len(part) + 1 > _WIDTH - len("usage: ") * (len(lines) == 1):
            lines.append(indent + part)
        else:
            lines[-1] += f" {part}"
    return "\n".join(lines)
