"""`--progress lines`: how far a command is, on stderr, for a program that started it."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from modeler.cli import console, main
from modeler.cli.console import Loudness, clock, progress, using_loudness, working

LINE = re.compile(r"progress (-|\d\.\d\d) (\S.*)")


def told(capsys) -> list[tuple[str, str]]:
    err = capsys.readouterr().err
    assert all(LINE.fullmatch(line) for line in err.splitlines()), err
    return [(found[1], found[2]) for found in map(LINE.fullmatch, err.splitlines()) if found]


def test_shares_and_titles_in_order(capsys, monkeypatch) -> None:
    monkeypatch.setattr(console, "_PAUSE", 0.0)
    with using_loudness(Loudness.USUAL, for_programs=True):
        with clock("loading"):
            pass
        with progress("first\nstep") as tell:
            for share in (0.0, 0.25, 0.251, 0.5, 1.2):
                tell(share)
        with working("second"), progress("inside") as tell:  # one voice, not two
            tell(0.5)
    assert told(capsys) == [
        ("-", "loading"), ("0.00", "first step"), ("0.25", "first step"), ("0.50", "first step"),
        ("1.00", "first step"), ("-", "second"),
    ]  # fmt: skip


def test_a_thousand_shares_in_a_moment_are_few_lines(capsys) -> None:
    with using_loudness(Loudness.USUAL, for_programs=True), progress("counting") as tell:
        for i in range(100_000):
            tell(i / 100_000)
    assert 1 <= len(told(capsys)) < 50


def test_what_is_not_asked_for_is_not_told(capsys) -> None:
    with using_loudness(Loudness.USUAL), progress("counting") as tell:
        tell(0.5)
    assert told(capsys) == []


@pytest.mark.rotating
@pytest.mark.parametrize(
    "words", ["--progress lines", "--progress=lines -q", "-q --progress lines"]
)
def test_a_command_tells_its_steps_and_the_same_result(tmp_path: Path, words: str) -> None:
    """Quiet or not: it is asked for. An error stays the last line."""
    command = [sys.executable, "-m", "modeler", "simulate", "two-link", "--duration", "2"]
    out = tmp_path / "a.csv"
    done = subprocess.run(
        [*command, *words.split(), "--out", str(out), "--json", "-"], capture_output=True, text=True
    )
    assert done.returncode == 0 and json.loads(done.stdout)["robot"] == "two-link"
    found = [LINE.fullmatch(line) for line in done.stderr.splitlines()]
    assert all(found) and {"loading", "simulating two-link"} <= {f[2] for f in found if f}
    failed = subprocess.run(
        [*command, *words.split(), "--out", str(tmp_path)], capture_output=True, text=True
    )
    assert failed.returncode == 1 and failed.stderr.splitlines()[-1].startswith("modeler: ")


def test_another_word_is_wrong_usage(capsys) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["robots", "--progress", "line"])
    assert stop.value.code == 2 and "(did you mean lines?)" in capsys.readouterr().err
