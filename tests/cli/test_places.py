"""Nothing that a command reads is written over, nothing is written twice: of every command."""

import argparse
import os
import sys
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

from modeler.cli import build_parser, main, places
from modeler.cli.demonstrations import _STORIES
from modeler.cli.parser import collect_command_parsers
from modeler.codegen.package import write_emitted
from modeler.core.choices import locate_builtin_robot
from tests.cli.running import refusal
from tests.modules import module
from tests.rotation import with_cases

FILES = tuple(
    "arm.toml arm.par m.json a.parquet b.csv other.parquet load.parquet names.toml".split()
)

READING = {  # what each command reads; outputs come after it
    "derive": "derive arm.toml",
    "home": "home arm.toml",
    "generate": "generate arm.toml --out new_c",
    "export": "export arm.toml --out new.urdf",
    "convert": "convert arm.par --out new.toml",
    "new": "new new.toml",
    "simulate": "simulate arm.toml --out new.csv",
    "excite": "excite arm.toml --choose 1 --from a.parquet --from b.csv",
    "log": "log a.parquet --robot arm.toml --map names.toml",
    "fit": "fit arm.toml a.parquet b.csv@0:4 --payload-log load.parquet --out new.json",
    "compare": "compare m.json a.parquet@2:",
    "diagnose": "diagnose m.json a.parquet --holdout other.parquet",
    "add": "add m.json spring a.parquet --holdout other.parquet@:3 --out new.json",
    "effects": "effects --robot arm.toml",
    "estimators": "estimators",
    "robots": "robots arm.toml",
    "reproduce": "reproduce houda",
    "demo": "demo --out new",
    "physical": "physical arm.toml",
    "show": "show arm.toml",
    "completion": "completion bash",
    "studio": "studio arm",
    "fleet": "fleet arm.toml a.parquet b.csv@0:4 --map names.toml",
}


@pytest.fixture
def workdir(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with files that say nothing: what is refused here is refused before they are read;
    afterwards they are as they were, and nothing has come.
    """
    monkeypatch.chdir(tmp_path)
    for name in FILES:
        (tmp_path / name).write_text(f"contents of {name}\n")
    yield tmp_path
    assert [(tmp_path / name).read_text() for name in FILES] == [
        f"contents of {name}\n" for name in FILES
    ]
    left = {p.name for p in tmp_path.iterdir() if not p.name.startswith("alias")}
    assert left - {"folder"} == set(FILES)


def actions() -> Iterator[tuple[str, argparse.Action]]:
    """Every argument of every command."""
    for command, of_command in collect_command_parsers(build_parser()).items():
        yield from ((command, action) for action in of_command._actions)


def is_a(action: argparse.Action, *kinds: type) -> bool:
    return isinstance(action.type, type) and issubclass(action.type, kinds)


def test_every_argument_says_what_it_is() -> None:
    """A new one cannot be forgotten: a bare text might be the name of a file."""
    for command, action in actions():
        types = (int, float, places.parse_model_or_log)
        plain = action.nargs == 0 or action.choices or action.type in types
        assert plain or is_a(
            action, places.Word, places.Input, places.Output, places.OutputFolder
        ), (command, action.dest)
    assert not [c for c, a in actions() if a.dest == "json" and a.type is not places.JsonFile]
    assert {command for command, _ in actions()} == set(READING)


def cases() -> Iterator[tuple[str, str, str, str]]:
    """Command, output, input that it is given, and what the refusal calls that."""
    read = "the robot file that is read"
    whats = {
        "arm.toml": read,
        "arm.par": read,
        "m.json": "the model that is read",
        "names.toml": "the mapping that is read",
    }
    for command, action in actions():
        if is_a(action, places.Output):
            words = READING[command].replace("@", " ").split()
            for name in FILES:
                if name in words:
                    yield command, action.option_strings[0], name, whats.get(name, "a log")


def ways() -> list[tuple[str, str, str, str, str]]:
    """Every case by its name; one of every command and option by other ways to the same file."""
    first = {case[:2]: case for case in reversed(list(cases()))}.values()
    return [(*case, "itself") for case in cases()] + [
        (*case, way) for case in first for way in ("./", "symlink", "hard link")
    ]


@pytest.mark.parametrize(("command", "option", "name", "what", "way"), ways())
def test_an_input_is_never_an_output(workdir, capsys, command, option, name, what, way) -> None:
    place = {"itself": name, "./": f"../{workdir.name}/./{name}"}.get(way, "alias")
    if way == "symlink":
        Path("alias").symlink_to(name)
    elif way == "hard link":
        os.link(name, "alias")
    if option == "--out" and command == "simulate" and "link" in way:
        place = "alias.csv"
        Path("alias").rename(place)
    err = refusal(capsys, *READING[command].split(), option, place)
    assert f"{option} {place}: this is {what}; expected a name of its own" in err


@pytest.mark.parametrize("command", ["fit", "compare", "derive"])
def test_two_outputs_are_two_files(workdir, capsys, command) -> None:
    outputs = [entry for name, entry in actions() if name == command and is_a(entry, places.Output)]
    first, second = (entry.option_strings[0] for entry in outputs[:2])
    Path("alias").symlink_to("same.html")  # which is not there yet
    words = READING[command].split()
    if first in words:
        at = words.index(first)
        del words[at : at + 2]
    err = refusal(capsys, *words, first, "same.html", second, "alias")
    assert f"{second} alias: {first} writes this file too; expected a name of its own" in err


def test_stdout_may_go_to_that_file(workdir, capsys, monkeypatch) -> None:
    with Path("folder").open("w") as out:
        monkeypatch.setattr(sys, "stdout", out)
        status = main(["robots", "--json", "folder"])
        monkeypatch.undo()
    assert status == 1
    assert "--json folder: stdout writes this file too" in capsys.readouterr().err


def test_a_built_in_robot_is_an_input_too(workdir, capsys) -> None:
    place = locate_builtin_robot("wrist")
    before = place.read_bytes()
    err = refusal(capsys, "derive", "wrist", "--report", str(place))
    assert "this is the robot file that is read" in err and place.read_bytes() == before


@pytest.mark.parametrize(
    ("command", "option", "place"),
    [("fit", "--out", "new.csv"), ("derive", "--json", "NEW.PARQUET")],
)
def test_what_is_no_log_is_not_named_like_one(workdir, capsys, command, option, place) -> None:
    err = refusal(capsys, *READING[command].split(), option, place)
    assert f"{option} {place}: this is a log; expected a name of its own" in err


@pytest.mark.parametrize("command", READING)
def test_places_that_cannot_be_written_are_refused_first(workdir, capsys, command) -> None:
    Path("folder").write_text("a file")
    words = READING[command].split()
    for option, place in (("--json", "folder/below/x.json"), ("--json", "/proc/nowhere/x.json")):
        assert f"{place}: cannot be written" in refusal(capsys, *words, option, place)
    if "--out" in words:
        ends = ".csv" if command == "simulate" else ""
        err = refusal(capsys, *words, "--out", f"folder/below{ends}")
        assert f"folder/below{ends}: cannot be written" in err


def test_a_dash_is_for_json(workdir, capsys) -> None:
    err = refusal(capsys, "derive", "arm.toml", "--report", "-")
    assert "--report -: only --json takes - for stdout; expected the name of a file" in err


@with_cases(
    "words, message",
    ("generate wrist --out folder --json folder/manifest.json", "manifest.json in it is what"),
    ("generate wrist --out folder --json alias", "Makefile in it is what --json writes"),
    ("demo --out folder --json folder/demo-arm/model.json", "demo-arm/model.json in it is"),
    ("compare m.json folder/overview.csv --picture folder", "overview.csv in it is a log"),
)
def test_a_folder_keeps_its_names(workdir, capsys, words, message) -> None:
    Path("folder").mkdir()
    Path("folder/overview.csv").write_text("time,q1\n")
    Path("alias").symlink_to("folder/Makefile")
    option = "--picture" if "--picture" in words else "--out"
    err = refusal(capsys, *words.split())
    assert f"{option} folder: " in err and message in err
    assert "expected a folder of its own" in err
    assert [path.name for path in Path("folder").iterdir()] == ["overview.csv"]


def test_folders_declare_what_they_get(tmp_path: Path) -> None:
    for name in ("wrist", "five-bar"):
        folder = tmp_path / name
        write_emitted(module(name).emitted, folder)
        files = [p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()]
        assert len(files) > 10
        for file in files:
            assert any(fnmatchcase(file, pattern) for pattern in places.ModuleFolder.writes), file
    assert {f"{story.robot}/*" for story in _STORIES} == set(places.DemoFolder.writes)


@pytest.mark.parametrize(("ending", "there_is_one"), [(".PAR", False), (".mjcf", True)])
def test_nothing_is_written_into_another_programs_robot_file(
    tmp_path, monkeypatch, capsys, ending, there_is_one
) -> None:
    """Of every command, whatever the option; before anything is read."""
    monkeypatch.chdir(tmp_path)
    place = Path(f"other{ending}")
    if there_is_one:
        place.write_text("theirs")
    for command, action in actions():
        if (
            not is_a(action, places.Output) or action.type is places.OtherProgramsFile
        ):  # what `export` writes
            continue
        words = READING[command].split()
        option = action.option_strings[0] if action.option_strings else command
        if option == command:
            words = [command, str(place)]
        elif option in words:
            words[words.index(option) + 1] = str(place)
        else:
            words += [option, str(place)]
        err = refusal(capsys, *words)
        assert f"{option} {place}: got {ending.lower()}, which is another program's" in err, words
        assert place.read_text() == "theirs" if there_is_one else not place.exists()
