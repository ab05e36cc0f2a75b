"""What was typed until now, in the words of now: old names of commands and options work still."""

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from modeler.cli.command_table import COMMANDS
from modeler.cli.options import ALL, options_of, sorted_words

STAY_BEFORE = "0.3.0"
"""Version that knows these words no more; they work in the one that replaces them and the next."""

OLD_COMMANDS = {"free-run": "compare --free-run"}
"""Commands that are an option of another now."""


@dataclass
class Renewed:
    """A line in the words of now.

    Attributes:
        words: of it.
        told: what is said of old ones.
    """

    words: list[str]
    told: list[str] = field(default_factory=list)


def renewed(words: Sequence[str], parsers: Mapping[str, argparse.ArgumentParser]) -> Renewed:
    """The line with the names that commands and options have now.

    Args:
        words: after the name of the program.
        parsers: of every command.
    """
    at = next((i for i, word in enumerate(words) if not word.startswith("-")), None)
    if at is None:
        return Renewed(list(words))
    name, rest = words[at], list(words[at + 1 :])
    if name == "help":  # as other programs have it
        return renewed([*words[:at], *rest, "--help"], parsers)
    told: list[str] = []
    if name in OLD_COMMANDS:
        told = [f"`{name}` is called `{OLD_COMMANDS[name]}` now"]
        name, option = OLD_COMMANDS[name].split()
        rest = [option, *rest]
    elif name == "estimators":
        name, rest, told = _estimators(rest, parsers)
    if name not in COMMANDS:
        return Renewed([*words[: at + 1], *rest], told)
    if name == "derive":
        rest, told = _derive(rest)
    if name == "robots" and rest:
        rest, told = _without(rest, "--show")
    own = options_of(parsers[name])
    old = COMMANDS[name].old
    for i, word in enumerate(rest[: rest.index("--") if "--" in rest else None]):
        typed, equals, value = word.partition("=")
        meant = _meant(typed, old, own)
        if meant is not None:
            rest[i] = old[meant] + equals + value
            told.append(f"{meant} is called {old[meant]} now")
    return Renewed([*words[:at], name, *rest], list(dict.fromkeys(told)))


def _meant(typed: str, old: Mapping[str, str], own: Mapping[str, object]) -> str | None:
    """The old name that is typed, perhaps cut short; None if it is one of now."""
    if typed in old:
        return typed
    if len(typed) < 3 or any(name.startswith(typed) for name in own):
        return None
    found = [name for name in old if name.startswith(typed)]
    return found[0] if len(found) == 1 else None


def _estimators(
    rest: list[str], parsers: Mapping[str, argparse.ArgumentParser]
) -> tuple[str, list[str], list[str]]:
    """With a robot, `estimators` was what `fit` of several methods is."""
    rest = [word.replace("--methods", "--method", 1) if word.split("=")[0] == "--methods" else word
            for word in rest]  # fmt: skip
    free = sorted_words(parsers["fit"], rest).arguments
    if len(free) > 1 or "--holdout" in rest:
        if not any(word.split("=")[0] == "--method" for word in rest):
            rest = [*rest[:1], "--method", ALL, *rest[1:]] if rest[0] != "--" else rest
        return "fit", rest, [f"`estimators ROBOT LOG...` is `fit ROBOT LOG... --method {ALL}` now"]
    rest, _ = _without(rest, "--method")
    return "estimators", rest, []


def _without(rest: list[str], option: str) -> tuple[list[str], list[str]]:
    """The value of an option as an argument, which it is now."""
    found: list[str] = []
    for word in rest:
        if word.startswith(f"{option}="):
            found.append(word.partition("=")[2])
        elif word != option:
            found.append(word)
    return found, [f"{option} may be left out now"] if found != rest else []


def _derive(rest: list[str]) -> tuple[list[str], list[str]]:
    """`--report` was the page of the coefficients, `--open` cut the loops."""
    told: list[str] = []
    found: list[str] = []
    old_page = any("--page".startswith(w.split("=")[0]) and w[:4] == "--pa" for w in rest)
    for i, word in enumerate(rest):
        name, equals, value = word.partition("=")
        if name == "--report" and (value or "".join(rest[i + 1 : i + 2])).endswith(
            (".md", ".markdown")
        ):
            told.append("the page of the coefficients is --coefficients-out FILE.md now")
            word = "--coefficients-out" + equals + value
        elif name == "--open" and old_page:
            told.append(OPEN_CUT)
            word = "--cut-loops"
        found.append(word)
    return found, told


OPEN_CUT = (
    "--open is read as --cut-loops, which it was until now; to see the page, say where it is "
    "written: --report PAGE.html --open"
)
