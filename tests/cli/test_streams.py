"""Results and complaints on streams that are full, closed, or short of letters."""

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from modeler.cli import main
from tests.cli.running import program
from tests.forked import without_coverage
from tests.rotation import rotating, with_cases

ARM = """\
name = "arm"
title = "Mânipulateur à un axe \N{ROBOT FACE}"
gravity = ["-g", 0, 0]
[symbols]
g = 9.81
[mdh]
columns = ["j", "a", "sigma", "theta"]
rows = [["1", "0", 0, "q1"]]
"""

# A file system that is full: what stdout goes to may not grow beyond a few bytes.
_LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]), resource.RLIM_INFINITY))
sys.argv[:2] = ["modeler"]
from modeler.cli import main
sys.exit(main())
"""


@pytest.mark.parametrize(
    ("words", "buffering", "room"),
    [("--help", "", "3"), ("robots", "1", "0"), *rotating(("robots --json -", "", "3"))],
)
def test_a_full_disk_under_stdout_is_one_line(tmp_path, words, buffering, room):
    with (tmp_path / "out.txt").open("w") as out:
        done = subprocess.run(
            [sys.executable, "-c", _LIMITED, room, *words.split()],
            stdout=out,
            timeout=60,
            stderr=subprocess.PIPE,
            text=True,
            env=without_coverage()
            | {"PYTHONUNBUFFERED": buffering, "PYTHONDONTWRITEBYTECODE": "1"},
        )
    assert done.returncode == 1
    assert done.stderr.startswith("modeler: stdout: cannot be written (File too large); choose")
    assert done.stderr.count("\n") == 1
    assert (tmp_path / "out.txt").stat().st_size <= 3


class Full(io.StringIO):
    """A stream on a disk without room: takes what is written, and fails where it is flushed."""

    def flush(self) -> None:
        raise OSError(28, "No space left on device")


def test_what_is_only_told_at_the_end_is_told(monkeypatch, capsys) -> None:
    monkeypatch.setattr(sys, "stdout", Full())
    assert main(["robots"]) == 1
    err = capsys.readouterr().err
    assert err == (
        "modeler: stdout: cannot be written (No space left on device); choose another place for "
        "it\n"
    )


@with_cases(
    "words, status, shown",
    ("robots >&-", 0, ""),
    ("robots no-such-robot >&-", 1, "modeler: "),
    ("robots no-such-robot 2>&-", 1, ""),
    ("robots no-such-robot <&-", 1, "modeler: "),
    ("effects | head -1", 0, ""),
)
def test_closed_streams_and_a_reader_that_stops_are_no_error(words, status, shown) -> None:
    command = f'"{sys.executable}" -m modeler {words}'
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=60)
    assert done.returncode == status
    assert done.stderr.startswith(shown) and done.stderr.count("\n") == bool(shown)


ASCII = [
    {"PYTHONIOENCODING": "ascii:strict"},
    {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
]


@pytest.mark.parametrize("setting", ASCII, ids=str)
def test_letters_that_a_terminal_lacks_are_shown_as_codes(tmp_path: Path, setting) -> None:
    (tmp_path / "bräs.toml").write_text(ARM, encoding="utf-8")
    done = program("robots", "bräs.toml", cwd=tmp_path, env=os.environ | setting)
    assert done.returncode == 0 and done.stderr == "" and "nipulateur" in done.stdout
    if "PYTHONIOENCODING" in setting:
        assert r"M\xe2nipulateur \xe0 un axe \U0001f916" in done.stdout
        failed = program("robots", "bräs.tom", cwd=tmp_path, env=os.environ | setting)
        assert failed.returncode == 1 and r"br\xe4s.tom" in failed.stderr
