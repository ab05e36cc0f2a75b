"""Completion: what may come next, and the scripts in the shells themselves."""

import os
import pty
import select
import shutil
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from modeler.cli import build_parser
from modeler.cli.completion import complete_words
from modeler.core.choices import ABOUT, list_builtin_robots
from modeler.effects.catalogue import CATALOGUE
from tests.rotation import with_cases


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    """A folder as of a user, and the program on the path."""
    for name in ("arm.toml", "arm.model.json", "run 1.parquet", "run2.csv", "note.txt", "old.par"):
        (tmp_path / name).touch()
    (tmp_path / "logs").mkdir()
    (tmp_path / "logs" / "one.parquet").touch()
    program = tmp_path / ".bin" / "modeler"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m modeler "$@"\n')
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


LOGS = ["logs/", "run 1.parquet", "run2.csv"]
EFFECTS = [effect.id for effect in CATALOGUE]

CASES = [
    (["di"], ["diagnose"]),
    (["--qu"], ["--quiet"]),
    (["-q", "der"], ["derive"]),
    (["derive", "o"], [n for n in list_builtin_robots() if n[0] == "o"] + ["old.par"]),
    (["derive", "wrist", "--format", ""], ["latex", "markdown", "text"]),
    (["derive", "wrist", "--format=l"], ["--format=latex"]),
    (["derive", "wrist", "--format", "=", "l"], ["latex"]),  # as bash cuts it
    (["derive", "wrist", "x"], []),
    (
        ["derive", "wrist", "--effects", "viscous,cou"],
        [f"viscous,{e}" for e in EFFECTS if e.startswith("cou")],
    ),
    (["fit", "emps", ""], LOGS),
    (["fit", "emps", "run2.csv", "r"], ["run 1.parquet", "run2.csv"]),
    (["fit", "emps", "logs/"], ["logs/one.parquet"]),
    (["fit", "emps", "--method", ""], [*ABOUT, "tls", "two-step", "all"]),
    (["fit", "emps", "--window", ""], []),
    (["compare", "arm"], ["arm.model.json", "arm.toml"]),
    (["diagnose", "arm.model.json", "--holdout", ""], LOGS),
    (["diagnose", "--holdout", ""], LOGS),
    (["diagnose", "--holdout", "run2.csv", ""], ["arm.model.json", "logs/"]),
    (["diagnose", "arm.model.json", "--without", "load"], ["load_friction"]),
    (["diagnose", "--", "--x"], []),
    (["simulate", "wrist", "--hide", "back"], ["backlash"]),
    (["generate", "wrist", "--out", ""], ["logs/"]),
    (["show", "wrist", "--out", "n"], ["note.txt"]),
    (["physical", "arm.m"], ["arm.model.json"]),
    (["completion", ""], ["bash", "zsh", "fish"]),
    (["fit", "nowhere/"], []),
    (["nonsense", ""], []),
]


@pytest.mark.parametrize(("words", "expected"), CASES, ids=lambda x: " ".join(x)[:40])
def test_what_may_come_next(folder: Path, words: list[str], expected: list[str]) -> None:
    assert sorted(complete_words(words, build_parser())) == sorted(expected)


def test_options_are_those_of_the_command(folder: Path) -> None:
    assert {"derive", "fit", "completion"} <= set(complete_words([], build_parser()))
    options = complete_words(["diagnose", "arm.model.json", "--"], build_parser())
    assert {"--holdout", "--without", "--json", "--quiet"} <= set(options)
    assert "--method" not in options
    assert complete_words(["completion", "--wo"], build_parser()) == []  # what only the scripts use


def shell_of(name: str) -> str:
    place = shutil.which(name)
    if place is None:
        pytest.skip(f"NOT CHECKED: there is no {name} here; on Debian: apt install {name}")
    return place


@with_cases(
    "name, options, setup",
    ("bash", ["--norc", "-i"], ""),
    pytest.param(
        "zsh", ["-f", "-i"], "autoload -Uz compinit; compinit -u; ", marks=pytest.mark.rotating
    ),
)
def test_bash_and_zsh_complete_what_is_typed(folder: Path, name, options, setup) -> None:
    """A Tab after each piece; the line is then turned into one that shows it as a whole."""
    ours, theirs = pty.openpty()
    running = subprocess.Popen(
        [shell_of(name), *options],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        start_new_session=True,
        env=os.environ | {"TERM": "dumb", "PS1": "> "},
    )
    os.close(theirs)

    def shown(keys: str, wanted: str) -> str:
        """What the shell shows until it shows what is wanted; at most 20 s."""
        os.write(ours, keys.encode())
        text, until = "", time.monotonic() + 20.0
        while wanted not in text and time.monotonic() < until:
            if select.select([ours], [], [], 0.2)[0]:
                text += os.read(ours, 10_000).decode(errors="replace").replace("\r", "")
        return text

    try:
        shown(f"{setup}eval \"$(modeler completion {name})\"; echo rea''dy\n", "ready")
        wanted = "\nLINE: modeler derive wrist --report logs/one.parquet"
        keys = "modeler der\twrist --rep\tlo\to\t\x01echo LINE: \x05\n"
        assert wanted in shown(keys, wanted)
    finally:
        running.kill()
        running.wait()
        os.close(ours)


@pytest.mark.rotating("long tests of cli")
def test_fish_completes(folder: Path) -> None:
    shell = shell_of("fish")
    for line, expected in (
        ("modeler der", ["derive"]),
        ("modeler diagnose arm.model.json --holdout ", LOGS),
    ):
        done = subprocess.run(
            [shell, "--no-config", "-c", f"modeler completion fish | source; complete -C '{line}'"],
            capture_output=True,
            text=True,
            timeout=60,
            check=True,
        )
        assert done.stdout.splitlines() == expected
