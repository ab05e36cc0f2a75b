"""One rule for the arguments of all commands; what they were called before; pages that open."""

import argparse
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from modeler.cli import build_parser, main, parser, places
from tests.cli.running import refusal
from tests.rotation import with_cases

PARSERS = parser.collect_command_parsers(build_parser())


def options() -> Iterator[tuple[str, argparse.Action]]:
    """Every option of every command, with the name of the command."""
    for command, subparser in PARSERS.items():
        yield from ((command, action) for action in subparser._actions if action.option_strings)


def is_a(action: argparse.Action, *kinds: type) -> bool:
    return isinstance(action.type, type) and issubclass(action.type, kinds)


# The rule, over the table.


def test_what_is_written_is_named_alike() -> None:
    """--out, --report, --picture, --json; what is written besides ends in -out."""
    for command, action in options():
        name = action.option_strings[-1]
        written = is_a(action, places.Output, places.OutputFolder)
        known = name in ("--out", "--report", "--picture", "--json") or name.endswith("-out")
        assert written == known, f"{command} {name}"
        if name == "--report":
            assert action.metavar == "PAGE.html" and not is_a(action, places.OutputFolder)
        if name == "--json":
            assert action.type is places.JsonFile


def test_every_page_can_be_opened() -> None:
    for command, subparser in PARSERS.items():
        names = {name for action in subparser._actions for name in action.option_strings}
        assert ("--open" in names) == ("--report" in names or command in ("show", "demo")), command
        assert "--json" in names, command


def test_robot_or_model_first_logs_last() -> None:
    for command, subparser in PARSERS.items():
        kinds = [action.type for action in parser.collect_arguments(subparser)]
        read = (places.RobotFile, places.ModelFile, places.RobotOrModel)
        first = [i for i, kind in enumerate(kinds) if kind in read]
        logs = [i for i, k in enumerate(kinds) if k in (places.LogFile, places.parse_model_or_log)]
        assert first in ([], [0]) and logs in ([], [len(kinds) - 1]), command


def test_each_command_has_a_family_and_an_example_that_can_be_typed() -> None:
    families = "workbench describe measure identify understand use about".split()
    assert list(parser.read_families()) == families
    assert list(PARSERS) == list(parser.read_commands())
    for name, subparser in PARSERS.items():
        lines = re.findall(r"modeler ([^;>]+)", (subparser.epilog or "").replace(')"', ""))
        assert lines and any(line.startswith(f"{name} ") for line in lines), name
        for line in lines:
            assert parser.parse_words(shlex.split(line.strip()))[0].command, line


def test_the_help_lists_commands_by_family() -> None:
    text = build_parser().format_help()
    places_of = [text.index(f"\n{family}:\n") for family in parser.read_families()]
    assert places_of == sorted(places_of)
    for family, below in zip(
        parser.read_families(), [*list(parser.read_families())[1:], "options"], strict=True
    ):
        part = text.split(f"\n{family}:\n")[1].split(f"\n{below}:\n")[0]
        assert re.findall(r"^  (\S+)", part, re.M) == parser.read_families()[family]


@pytest.mark.parametrize("words", [[], ["compare"]])
def test_help_may_be_a_command(capsys, words: list[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["help", *words])
    usage = " ".join(["usage: modeler", *(words or ["[-h]"])])
    assert stop.value.code == 0 and capsys.readouterr().out.startswith(usage)


# Words that are none.


MISSPELT = {
    "derve wrist": "unknown command derve (did you mean derive?)",
    "simulated wrist": "unknown command simulated (did you mean simulate?)",
    "fit emps a.csv --otu m": "unknown option --otu (did you mean --out?)",
    "derive wrist --formt latex": "unknown option --formt (did you mean --format?)",
    "derive wrist --format latx": "argument --format: got latx (did you mean latex?)",
    "fit emps a.csv --out m --method weigted": "got weigted (did you mean weighted?)",
    "fit emps a.csv --method weighted,tls": "got tls; expected one of weighted, ",
    "--versoin": "unknown option --versoin (did you mean --version?)",
    "derive wrist --xyzzy": "unknown option --xyzzy; write it as",
    "derive wrist panda": "got panda as well; expected no more arguments",
    "completion tcsh": "got tcsh; expected one of bash, zsh, fish",
    "robots --progress line": "(did you mean lines?)",
    "-q robots -v": "got --quiet and --verbose; expected one of them",
}


@pytest.mark.parametrize("line", MISSPELT)
def test_what_is_misspelt_is_one_line(capsys, line: str) -> None:
    with pytest.raises(SystemExit) as stop:
        main(line.split())
    err = capsys.readouterr().err
    assert stop.value.code == 2 and MISSPELT[line] in err and err.count("\n") == 1


def test_an_option_may_be_cut_short() -> None:
    assert parser.parse_words(["--verbos", "derive", "wrist"])[0].robot == "wrist"


def test_methods_are_one_or_several() -> None:
    assert parser.Methods("all").is_several
    assert parser.Methods("iv,ridge").is_several and not parser.Methods("tls").is_several


@with_cases(
    "line, message",
    ("compare m.json a.csv --window 2", "--window: needs --free-run; give both"),
    ("compare m.json n.json a.csv --free-run", "--free-run: got n.json too; expected one"),
)
def test_free_run_has_its_own_options(capsys, line: str, message: str) -> None:
    assert message in refusal(capsys, *line.split())


# Pages that open.


@pytest.fixture
def opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A browser that notes what it is to show, and the folder of temporary files."""
    program = tmp_path / "browser"
    program.write_text(f'#!/bin/sh\necho "$1" >> "{tmp_path}/opened"\n')
    program.chmod(0o755)
    monkeypatch.setenv("BROWSER", str(program))
    monkeypatch.setattr("webbrowser._tryorder", None)  # it looks once a process
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "opened"


@with_cases(
    "line, page",
    ("derive two-link --open", "modeler-*/derive.html"),
    ("home five-bar --open --report h.html", "h.html"),
    ("show two-link --open --picture t.svg", "two-link.html"),
)
def test_open_shows_the_page_that_was_written(opened: Path, line: str, page: str) -> None:
    assert main([*line.split(), "--json", "-"]) == 0
    (written,) = opened.parent.glob(page)
    assert opened.read_text() == written.resolve().as_uri() + "\n"
    assert "<html" in written.read_text()[:500]


def test_a_refused_command_leaves_no_folder_for_its_page(opened: Path) -> None:
    assert main(["derive", "no-such-robot", "--open"]) == 1
    assert not [*opened.parent.glob("modeler-*")] and not opened.exists()


def test_without_a_browser_open_is_one_line(capsys, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("webbrowser.open", lambda place: False)
    assert main(["show", "two-link", "--out", str(tmp_path / "t.html"), "--open"]) == 0
    err = capsys.readouterr().err
    assert err == f"modeler: --open: no browser was found; open {tmp_path / 't.html'} in one\n"
