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

from modeler.cli import main, parser
from modeler.cli.completion import SCRIPTS, candidates
from modeler.core.builtin import builtin_names
from modeler.core.estimators import ABOUT
from modeler.effects.catalogue import CATALOGUE


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
    (["derive", "pa"], ["panda"]),
    (["derive", "a"], ["arm.toml"]),
    (["derive", "o"], [n for n in builtin_names() if n[0] == "o"] + ["old.par"]),
    (["derive", "wrist", "--format", ""], ["latex", "markdown", "text"]),
    (["derive", "wrist", "--format=l"], ["--format=latex"]),
    (["derive", "wrist", "--format", "=", "l"], ["latex"]),  # as bash cuts it
    (["derive", "wrist", "--format", "="], ["latex", "markdown", "text"]),
    (["derive", "wrist", "x"], []),
    (["derive", "wrist", "--effects", "viscous,cou"],
     [f"viscous,{e}" for e in EFFECTS if e.startswith("cou")]),
    (["fit", "emps", ""], LOGS),
    (["fit", "emps", "run2.csv", "r"], ["run 1.parquet", "run2.csv"]),
    (["fit", "emps", "logs/"], ["logs/one.parquet"]),
    (["fit", "emps", "logs/../r"], ["logs/../run 1.parquet", "logs/../run2.csv"]),
    (["fit", "emps", "--method", ""], [*ABOUT, "tls", "two-step", "all"]),
    (["fit", "emps", "--window", ""], []),
    (["compare", "arm"], ["arm.model.json", "arm.toml"]),
    (["diagnose", "arm.model.json", "--holdout", ""], LOGS),
    (["diagnose", "--holdout", ""], ["arm.model.json", *LOGS]),
    (["diagnose", "arm.model.json", "--without", "load"], ["load_friction"]),
    (["diagnose", "--", "--x"], []),
    (["add", "arm.model.json", "back"], ["backlash"]),
    (["simulate", "wrist", "--motion", "p"], ["point-to-point"]),
    (["simulate", "wrist", "--hide", "back"], ["backlash"]),
    (["generate", "wrist", "--out", ""], ["logs/"]),
    (["show", "wrist", "--out", "n"], ["note.txt"]),
    (["physical", "arm.m"], ["arm.model.json"]),
    (["robots", "wrist-"], ["wrist-coupled"]),
    (["reproduce", "gue"], ["guegan-2003"]),
    (["completion", ""], ["bash", "zsh", "fish"]),
    (["fit", "nowhere/"], []),
    (["nonsense", ""], []),
    ([], None),
]  # fmt: skip


@pytest.mark.parametrize(("words", "expected"), CASES, ids=lambda x: " ".join(x or [])[:40])
def test_what_may_come_next(folder: Path, words: list[str], expected: list[str] | None) -> None:
    found = candidates(words, parser())
    if expected is None:
        assert {"derive", "fit", "completion"} <= set(found)
    else:
        assert sorted(found) == sorted(expected)


def test_options_are_those_of_the_command(folder: Path) -> None:
    found = candidates(["diagnose", "arm.model.json", "--"], parser())
    assert {"--holdout", "--without", "--json", "--quiet"} <= set(found)
    assert "--method" not in found
    assert candidates(["completion", "--wo"], parser()) == []  # what only the scripts use


@pytest.mark.parametrize("shell", SCRIPTS)
def test_the_script_is_printed(capsys, shell: str) -> None:
    assert main(["completion", shell]) == 0
    assert capsys.readouterr().out.strip() == SCRIPTS[shell].strip()


def test_another_shell_is_wrong_usage(capsys) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["completion", "tcsh"])
    assert (
        stop.value.code == 2
        and "got tcsh; expected one of bash, zsh, fish" in capsys.readouterr().err
    )


def shell_of(name: str) -> str:
    found = shutil.which(name)
    if found is None:
        pytest.skip(f"NOT CHECKED: there is no {name} here; on Debian: apt install {name}")
    return found


class Typed:
    """A shell on a terminal, into which keys are typed."""

    def __init__(self, command: list[str], setup: str) -> None:
        ours, theirs = pty.openpty()
        self.ours = ours
        self.running = subprocess.Popen(
            command, stdin=theirs, stdout=theirs, stderr=theirs, start_new_session=True,
            env=os.environ | {"TERM": "dumb", "PS1": "> "},
        )  # fmt: skip
        os.close(theirs)
        self.type(f"{setup}; echo rea''dy\n", "ready")

    def type(self, keys: str, wanted: str) -> str:
        """What the shell shows until it shows what is wanted; at most 20 s."""
        os.write(self.ours, keys.encode())
        text, until = "", time.monotonic() + 20.0
        while wanted not in text and time.monotonic() < until:
            if select.select([self.ours], [], [], 0.2)[0]:
                text += os.read(self.ours, 10_000).decode(errors="replace").replace("\r", "")
        return text

    def close(self) -> None:
        self.running.kill()
        self.running.wait()
        os.close(self.ours)


@pytest.fixture(params=["bash", "zsh"])
def typed(request, folder: Path):
    name = request.param
    shell = shell_of(name)
    if name == "bash":
        found = Typed([shell, "--norc", "-i"], 'eval "$(modeler completion bash)"')
    else:
        setup = 'autoload -Uz compinit; compinit -u; eval "$(modeler completion zsh)"'
        found = Typed([shell, "-f", "-i"], setup)
    yield found
    found.close()


def test_bash_and_zsh_complete_what_is_typed(typed: Typed) -> None:
    """A Tab after each piece; the line is then turned into one that shows it as a whole."""
    keys = "modeler der\tpan\t--clo\t--report lo\to\t\x01echo LINE: \x05\n"
    wanted = "\nLINE: modeler derive panda --closed-form --report logs/one.parquet"
    assert wanted in typed.type(keys, wanted)


def test_fish_completes(folder: Path) -> None:
    shell = shell_of("fish")
    for line, expected in (
        ("modeler der", ["derive"]), ("modeler derive pan", ["panda"]),
        ("modeler diagnose arm.model.json --holdout ", LOGS),
        ("modeler fit emps logs/", ["logs/one.parquet"]),
    ):  # fmt: skip
        done = subprocess.run(
            [shell, "--no-config", "-c", f"modeler completion fish | source; complete -C '{line}'"],
            capture_output=True, text=True, timeout=60, check=True,
        )  # fmt: skip
        assert done.stdout.splitlines() == expected
