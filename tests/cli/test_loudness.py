"""`--quiet`, `--verbose`, `--progress lines`: what is reported beside the results, which stay."""

import json
import os
import pty
import re
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import console, main
from modeler.cli.console import Verbosity, apply_verbosity, show_activity, show_clock, show_progress
from modeler.cli.thresholds import Thresholds
from modeler.robot import read_robot
from tests.cli.running import run


@pytest.mark.parametrize("words", ["-v {}", "{} --verbose"])
def test_verbose_tells_steps_seconds_and_versions(capsys, words: str) -> None:
    usual = run(capsys, "derive", "two-link", "--no-terms")
    status, out, err = run(capsys, *words.format("derive two-link --no-terms").split())
    assert (status, out) == usual[:2] and usual[2] == ""
    assert f"numpy {np.__version__}" in err and "Python 3." in err
    assert "modeler: deriving two-link ...\n" in err
    assert re.search(r"^modeler: deriving two-link: done after \d+\.\d\d s$", err, re.MULTILINE)
    assert all(line.startswith("modeler: ") for line in err.splitlines())


def test_verbose_tells_where_an_error_came_from(capsys) -> None:
    status, out, err = run(capsys, "derive", "no-such-robot", "-v")
    assert (status, out) == (1, "")
    assert "Traceback (most recent call last)" in err and "modeler.core.errors.RobotError" in err
    assert err.splitlines()[-1].startswith('modeler: "no-such-robot" is neither')
    assert "modeler: derive: stopped after" in err


def test_verbose_shows_warnings_of_libraries_and_quiet_does_not(monkeypatch, recwarn) -> None:
    import warnings

    import modeler.cli.lists as command

    def warned(args):
        warnings.warn("a library says this", DeprecationWarning, stacklevel=1)
        return []

    monkeypatch.setattr(command, "run_robots", warned)
    assert main(["robots", "--quiet"]) == 0 and not len(recwarn)
    with pytest.warns(DeprecationWarning, match="a library says this"):
        assert main(["robots", "--verbose"]) == 0


@pytest.mark.parametrize("words", ["-q {}", "{} --quiet"])
def test_quiet_leaves_results_and_errors(capsys, tmp_path: Path, words: str) -> None:
    """A note is reported, unless quiet; an error always."""
    robot = read_robot("two-link").text + '\n[fit]\nmethod = "robust"\n'
    (tmp_path / "arm.toml").write_text(robot)
    (tmp_path / "a.csv").write_text("no log\n")
    line = f"fit {tmp_path / 'arm.toml'} {tmp_path / 'a.csv'} --out {tmp_path / 'm.json'}"
    _, _, usual = run(capsys, *line.split())
    _, _, err = run(capsys, *words.format(line).split())
    assert usual.startswith("modeler: by [fit] of the robot file: ")
    assert usual.count("\n") == 2 and err.count("\n") == 1 and usual.endswith(err)
    assert run(capsys, *words.format("robots").split()) == run(capsys, "robots")


class Terminal:
    """A terminal in place of stderr; what was written on it."""

    def __init__(self, monkeypatch) -> None:
        self.ours, theirs = pty.openpty()
        self.stream = os.fdopen(theirs, "w")
        self.parts: list[bytes] = []
        self.reader = threading.Thread(target=self.read)
        self.reader.start()
        monkeypatch.setattr(sys, "stderr", self.stream)
        monkeypatch.setenv("TERM", "xterm")

    def read(self) -> None:
        try:
            while part := os.read(self.ours, 10_000):
                self.parts.append(part)
        except OSError:  # the other end was closed
            pass

    def written(self) -> str:
        self.stream.close()
        self.reader.join()
        os.close(self.ours)
        return b"".join(self.parts).decode()


@pytest.mark.parametrize("loudness", Verbosity)
def test_work_shows_its_seconds_on_a_terminal(monkeypatch, loudness: Verbosity) -> None:
    terminal = Terminal(monkeypatch)
    with (
        apply_verbosity(loudness),
        show_activity("closing [/b]"),
        show_activity("inside"),
    ):  # one bar, not two
        threading.Event().wait(0.3)
    text = terminal.written()
    assert ("closing [/b]" in text) == (loudness is not Verbosity.QUIET)  # which is no markup
    assert ("0:00:00" in text) == (loudness is not Verbosity.QUIET)
    assert ("inside" in text) == (loudness is Verbosity.VERBOSE)


def test_loading_shows_its_seconds_on_a_terminal(monkeypatch) -> None:
    terminal = Terminal(monkeypatch)
    with show_clock("loading"):
        threading.Event().wait(0.7)
    assert re.search(r"\rloading 0\.\d s\r +\r$", terminal.written())


LINE = re.compile(r"progress (-|\d\.\d\d) (\S.*)")


def lines_of(err: str) -> list[tuple[str, str]]:
    """Share and title of each line, all of which are of progress."""
    lines = [LINE.fullmatch(line) for line in err.splitlines()]
    assert all(lines), err
    return [(line[1], line[2]) for line in lines if line]


def test_shares_and_titles_in_order(capsys, monkeypatch) -> None:
    with apply_verbosity(Verbosity.NORMAL), show_progress("not requested") as tell:
        tell(0.5)
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(console, "THRESHOLDS", Thresholds(progress_interval=0.0))
    with apply_verbosity(Verbosity.NORMAL, for_programs=True):
        with show_clock("loading"):
            pass
        with show_progress("first\nstep") as tell:
            for share in (0.0, 0.25, 0.251, 0.5, 1.2):
                tell(share)
        with show_activity("second"), show_progress("inside") as tell:  # one voice, not two
            tell(0.5)
    assert lines_of(capsys.readouterr().err) == [
        ("-", "loading"),
        ("0.00", "first step"),
        ("0.25", "first step"),
        ("0.50", "first step"),
        ("1.00", "first step"),
        ("-", "second"),
    ]


def test_a_thousand_shares_in_a_moment_are_few_lines(capsys) -> None:
    with apply_verbosity(Verbosity.NORMAL, for_programs=True), show_progress("counting") as tell:
        for i in range(100_000):
            tell(i / 100_000)
    assert 1 <= len(lines_of(capsys.readouterr().err)) < 50


@pytest.mark.parametrize("words", ["--progress lines", "-q --progress=lines"])
def test_a_command_tells_its_steps_and_the_same_result(capsys, tmp_path: Path, words: str) -> None:
    """Quiet or not: it is requested. An error stays the last line."""
    command = ["simulate", "two-link", "--duration", "1", "--json", "-", *words.split(), "--out"]
    status, out, err = run(capsys, *command, tmp_path / "a.csv")
    assert status == 0 and json.loads(out)["robot"] == "two-link"
    assert "simulating two-link" in {title for _, title in lines_of(err)}
    status, _, err = run(capsys, *command, tmp_path)
    assert status == 1 and err.splitlines()[-1].startswith("modeler: ")
