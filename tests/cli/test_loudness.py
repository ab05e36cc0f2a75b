"""`--quiet` and `--verbose`: what is told beside the results, which stay the same."""

import argparse
import os
import pty
import re
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import main, parser
from modeler.cli.console import Loudness, clock, using_loudness, working
from tests.cli.running import run


def names() -> list[str]:
    (sub,) = (a for a in parser()._actions if isinstance(a, argparse._SubParsersAction))
    return list(sub.choices)


@pytest.mark.parametrize("name", names())
def test_every_command_has_both(capsys, name: str) -> None:
    with pytest.raises(SystemExit):
        main([name, "--help"])
    text = capsys.readouterr().out
    assert "-q, --quiet" in text and "-v, --verbose" in text


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
    _, _, usual = run(capsys, "derive", "no-such-robot")
    assert usual.count("\n") == 1


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
    """A line that was read in one way of two is told, unless quiet; an error always."""
    (tmp_path / "m.json").write_text("{}")
    line = f"diagnose {tmp_path / 'm.json'} --holdout b.csv a.csv"
    _, _, usual = run(capsys, *line.split())
    _, _, err = run(capsys, *words.format(line).split())
    assert usual.count("\n") == 2 and err.count("\n") == 1 and usual.endswith(err)
    assert run(capsys, *words.format("robots").split()) == run(capsys, "robots")


@pytest.mark.parametrize("words", ["-q -v robots", "-q robots -v", "robots --quiet --verbose"])
def test_both_are_wrong_usage(capsys, words: str) -> None:
    with pytest.raises(SystemExit) as stop:
        main(words.split())
    assert stop.value.code == 2
    assert "got --quiet and --verbose; expected one of them" in capsys.readouterr().err


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


@pytest.mark.parametrize("loudness", Loudness)
def test_work_shows_its_seconds_on_a_terminal(monkeypatch, loudness: Loudness) -> None:
    terminal = Terminal(monkeypatch)
    with using_loudness(loudness), working("closing loops"), working("inside"):  # one bar, not two
        threading.Event().wait(0.3)
    text = terminal.written()
    assert ("closing loops" in text) == (loudness is not Loudness.QUIET)
    assert ("0:00:00" in text) == (loudness is not Loudness.QUIET)
    assert ("inside" in text) == (loudness is Loudness.VERBOSE)


def test_loading_shows_its_seconds_on_a_terminal(monkeypatch) -> None:
    terminal = Terminal(monkeypatch)
    with clock("loading"):
        threading.Event().wait(0.7)
    assert re.search(r"\rloading 0\.\d s\r +\r$", terminal.written())


def test_what_once_lasted_in_silence_is_a_step(capsys, two_link: Path, tmp_path: Path) -> None:
    """Loading, estimating by simulation, drawing: seconds in which nothing moved."""
    for step, line in (
        ("estimating", f"fit two-link {two_link}/a.parquet --out {tmp_path}/m.json"),
        ("drawing", f"home five-bar --report {tmp_path}/modes.html"),
    ):
        _, _, err = run(capsys, "-v", *line.split())
        for each in ("loading", step):
            assert f"modeler: {each}: done after" in err
