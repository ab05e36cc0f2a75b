"""Options before and after the arguments that they stand beside; lists."""

import argparse
import re
import shlex

import pytest

from modeler.cli import build_parser, main, parser
from tests.rotation import with_cases

# What each argument of a command takes here; no file has to be there.
WORDS = {
    "model": ["m.json"],
    "logs": ["a.parquet", "b.csv"],
    "robot": ["wrist"],
    "effect": ["coulomb"],
    "source": ["wrist"],
    "file": ["x.par"],
    "paper": ["guegan-2003"],
    "shell": ["bash"],
    "log": ["run.csv"],
    "folder": ["arm"],
}
VALUES = {"sets": ["3"], "cad": ["cad.toml"]}
PARSERS = parser.collect_command_parsers(build_parser())


def required(subparser: argparse.ArgumentParser) -> list[str]:
    values = []
    for action in subparser._actions:
        out = action.dest in getattr(subparser, "required", {})  # unless another is given
        if action.option_strings and (action.required or out):
            values += [action.option_strings[-1], "out.toml" if "TOML" in str(action) else "out"]
    return values


WITH_VALUE = [
    (name, option)
    for name, subparser in PARSERS.items()
    for option, action in parser.collect_options(subparser).items()
    if isinstance(action, argparse._AppendAction) or action.nargs == "?"
]


def read(words: list[str]) -> dict[str, object]:
    result = vars(parser.parse_words(words)[0])
    return {name: value for name, value in result.items() if name != "load"}


@pytest.mark.parametrize(("name", "option"), WITH_VALUE)
def test_the_order_does_not_matter(name: str, option: str) -> None:
    """After the arguments, before them, in their midst, repeated: the same is read."""
    subparser = PARSERS[name]
    action = parser.collect_options(subparser)[option]
    values = VALUES.get(action.dest, ["c.parquet", "d.parquet"])
    arguments = [WORDS[argument.dest][0] for argument in parser.collect_arguments(subparser)]
    rest = required(subparser)
    typed = [word for value in values for word in (option, value)]
    after = read([name, *arguments, *rest, *typed])
    assert after[action.dest] in (values, values[0], 3)
    orders = [
        [*rest, *typed, *arguments],
        [*typed, *rest, *arguments],
        [*rest, *arguments[:1], *typed, *arguments[1:]],
        [*typed[:2], *rest, *arguments, *typed[2:]],
        [*typed, *rest, "--", *arguments],
    ]
    for words in orders:
        assert read([name, *words]) == after, words


def test_a_list_is_given_by_repeating_the_option(capsys) -> None:
    result, _ = parser.parse_words(shlex.split("diagnose --holdout b m.json a --holdout=c e"))
    assert (result.model, result.logs, result.holdout) == ("m.json", ["a", "e"], ["b", "c"])
    assert "holdout" in result.typed and "logs" not in result.typed
    cut = parser.parse_words(shlex.split("fit emps a --meth robust --out m"))[0]
    assert cut.method == "robust" and cut.typed == {"method", "out"}


@with_cases(
    "words, missing",
    ("diagnose m.json --holdout b", "LOG"),
    ("add m.json --out x --holdout b", "EFFECT, LOG"),
    ("diagnose --holdout b", "MODEL, LOG"),
    ("physical --cad", "ROBOT|MODEL"),
    ("excite --from a", "ROBOT|MODEL"),
    ("fit emps --payload-log a --out m", "LOG"),
    ("fit emps a", "--out"),
)
def test_what_is_missing_is_missed(capsys, words: str, missing: str) -> None:
    with pytest.raises(SystemExit) as stop:
        main(words.split())
    assert stop.value.code == 2
    assert f"the following arguments are required: {missing}; write it" in capsys.readouterr().err


@pytest.mark.parametrize("name", PARSERS)
def test_the_usage_tells_an_order_that_works(name: str) -> None:
    """Arguments stand first in it; all options are in it; it fits a line of 100 letters."""
    subparser = PARSERS[name]
    usage = subparser.format_usage()
    assert all(len(line) <= 100 or line.count(" [") == 1 for line in usage.splitlines())
    flat = " ".join(usage.split())
    first = next(re.finditer(r"[ \[]-", flat)).start()
    for action in parser.collect_arguments(subparser):
        assert 0 < flat.find(str(action.metavar)) < first
    for option, action in parser.collect_options(subparser).items():
        if option.startswith("--") and action.help != argparse.SUPPRESS:
            named = any(name in flat for name in action.option_strings)  # by one of its names
            assert named or option in ("--help", "--quiet", "--verbose"), option


def test_the_help_tells_which_arguments_are_several(capsys) -> None:
    """While options are read, argparse hides the arguments."""
    for name, shown in (("fit", "fit ROBOT LOG [LOG ...] [--out"), ("studio", "studio [FOLDER]")):
        with pytest.raises(SystemExit):
            main([name, "--help"])
        assert f"usage: modeler {shown}" in capsys.readouterr().out
