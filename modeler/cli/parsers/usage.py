"""The usage line of a command: arguments first, which works with every option after them."""

import argparse
from collections.abc import Sequence

from modeler.cli.parsers.words import arguments_of

_WIDTH = 96
_REPEATED = (argparse._AppendAction, argparse._ExtendAction)


def usage_of(parser: argparse.ArgumentParser) -> str:
    """`modeler COMMAND ARGUMENT... --required VALUE [--option VALUE]`, wrapped."""
    options = [
        action
        for action in parser._actions
        if action.option_strings and action.help != argparse.SUPPRESS
    ]
    parts = [
        *(_values(action) for action in arguments_of(parser)),
        *(_option(action) for action in options if action.required),
        *(f"[{_option(action)}]" for action in options if not action.required),
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
