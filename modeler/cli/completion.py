"""`modeler completion SHELL`: the scripts, and what they ask for."""

import argparse
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from modeler.cli import places
from modeler.cli.console import print_lines, print_result
from modeler.cli.documents import CompletionScript
from modeler.cli.parser import (
    ALL,
    collect_arguments,
    collect_command_parsers,
    collect_options,
    find_option,
)
from modeler.core.choices import ABOUT, list_papers
from modeler.core.options import METHODS
from modeler.effects import CATALOGUE as EFFECTS

_BASH = """\
_modeler() {
    local IFS=$'\\n'
    COMPREPLY=($(modeler completion bash --words "${COMP_WORDS[@]:0:COMP_CWORD+1}" 2>/dev/null))
    if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == */ ]]; then
        compopt -o nospace
    fi
}
complete -F _modeler modeler
"""

_ZSH = """\
#compdef modeler
_modeler() {
    local -a found
    found=("${(@f)$(modeler completion zsh --words "${(@Q)words[1,CURRENT]}" 2>/dev/null)}")
    compadd -S '' -- ${(M)found:#*/}
    compadd -- ${found:#*/}
}
if [[ $funcstack[1] == _modeler ]]; then
    _modeler "$@"
else
    compdef _modeler modeler
fi
"""

_FISH = """\
complete -c modeler -f -a \
'(modeler completion fish --words (commandline -opc) (commandline -ct) 2>/dev/null)'
"""

SCRIPTS = {"bash": _BASH, "zsh": _ZSH, "fish": _FISH}


def run_completion(args: argparse.Namespace) -> CompletionScript | list[str]:
    """Prints the script, or what the last word may become."""
    if args.words is None:
        print_result(SCRIPTS[args.shell].rstrip())
        return {"shell": args.shell, "script": SCRIPTS[args.shell]}
    completions = complete_words(args.words[1:], args.top)
    print_lines(completions)
    return completions


def complete_words(words: Sequence[str], top: argparse.ArgumentParser) -> list[str]:
    """Completes the last word, given the words before it.

    Args:
        words: after the name of the program; bash cuts `--out=x` into three of them.
        top: the parser of all commands.
    """
    words, before = _split_at_equals(words)
    names = collect_command_parsers(top)
    *typed, last = words or [""]
    command = next((word for word in typed if not word.startswith("-")), None)
    if command is None:
        return _select_beginning(
            last, [*names, *collect_options(top)] if last[:1] == "-" else names
        )
    if command not in names:
        return []
    completions = _complete_command(names[command], typed[typed.index(command) + 1 :], last)
    return [before + each for each in completions]


def _split_at_equals(words: Sequence[str]) -> tuple[list[str], str]:
    """Words with `--option=value` as two, and what stands before the value in the last word."""
    parts: list[str] = []
    cut = False
    for word in words:
        if word == "=" and parts and parts[-1].startswith("--"):
            cut = True
            continue
        parts.append(word)
    if cut and words[-1] == "=":
        parts.append("")
    if not parts:
        return [], ""
    name, equals, value = parts[-1].partition("=")
    if equals and name.startswith("--"):
        return [*parts[:-1], name, value], f"{name}="
    return parts, ""


def _complete_command(
    parser: argparse.ArgumentParser, typed: Sequence[str], last: str
) -> list[str]:
    if last.startswith("-") and "--" not in typed:
        option_items = collect_options(parser).items()
        return _select_beginning(
            last, [name for name, a in option_items if a.help != argparse.SUPPRESS]
        )
    option, count = _find_position(parser, typed)
    if option is None:
        return _complete_argument(parser, count, last)
    completions = _complete_values(parser, option, last)
    if option.nargs != "?":
        return completions
    return sorted({*completions, *_complete_argument(parser, count, last)})


def _find_position(
    parser: argparse.ArgumentParser, typed: Sequence[str]
) -> tuple[argparse.Action | None, int]:
    """The option whose value the next word would be, and how many arguments there are."""
    option, count, ended = None, 0, False
    for word in typed:
        action = None if ended else find_option(parser, word)
        if word == "--" and not ended:
            option, ended = None, True
        elif action is not None:
            option = action if "=" not in word and action.nargs != 0 else None
        elif option is not None:
            option = None
        else:
            count += 1
    return option, count


def _complete_argument(parser: argparse.ArgumentParser, count: int, last: str) -> list[str]:
    """Values of the argument after so many."""
    arguments = collect_arguments(parser)
    if count >= len(arguments):
        if not arguments or arguments[-1].nargs not in ("+", "*"):
            return []
        count = len(arguments) - 1
    return _complete_values(parser, arguments[count], last)


def _complete_values(
    parser: argparse.ArgumentParser, action: argparse.Action, last: str
) -> list[str]:
    if action.choices is not None:
        return _select_beginning(last, map(str, action.choices))
    listed = _LISTED.get(action.dest)
    if listed is not None:
        earlier, comma, current = last.rpartition(",")
        return [earlier + comma + each for each in _select_beginning(current, listed)]
    return _complete_places(action.type, last)


def _complete_places(kind: object, last: str) -> list[str]:
    """Names and files that an argument of that type takes."""
    if kind is places.parse_model_or_log:
        return _complete_files(last, (".json", *places.LOG_ENDINGS))
    if isinstance(kind, type) and issubclass(kind, places.OutputFolder):
        return _complete_files(last, ())
    if isinstance(kind, type) and issubclass(kind, places.FilePlace):
        return [*_select_beginning(last, kind.names()), *_complete_files(last, kind.endings)]
    return []


def _complete_files(last: str, endings: tuple[str, ...]) -> list[str]:
    """Folders, with / at the end, and files that end so."""
    folder, name = os.path.split(last)
    paths = []
    try:
        with os.scandir(Path(folder).expanduser() if folder else ".") as entries:
            for entry in entries:
                if not entry.name.startswith(name) or (entry.name[0] == "." and name[:1] != "."):
                    continue
                place = os.path.join(folder, entry.name)  # noqa: PTH118  keeps ./ and ~ as typed
                if entry.is_dir():
                    paths.append(f"{place}/")
                elif entry.name.lower().endswith(endings):
                    paths.append(place)
    except OSError:
        return []
    return sorted(paths)


def _select_beginning(start: str, names: Iterable[str]) -> list[str]:
    return [name for name in names if name.startswith(start)]


_EFFECT_IDS = tuple(effect.id for effect in EFFECTS)
_LISTED: dict[str, Iterable[str]] = {
    **dict.fromkeys(("effect", "effects", "without", "between", "hide"), _EFFECT_IDS),
    "method": (*METHODS, ALL),
    "methods": ABOUT,
    "paper": list_papers(),
}
"""Words that are names, by what the argument is called in the code."""
