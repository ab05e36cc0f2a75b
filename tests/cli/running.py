"""A command: its status and what it says."""

import subprocess
import sys
from typing import Any

import pytest

from modeler.cli import main


def run(capsys: pytest.CaptureFixture[str], *words: object) -> tuple[int, str, str]:
    """Status, stdout and stderr of a command."""
    capsys.readouterr()
    status = main([str(word) for word in words])
    return status, *capsys.readouterr()


def answer(capsys: pytest.CaptureFixture[str], *words: object) -> str:
    """What a command prints that has nothing to complain of."""
    status, out, err = run(capsys, *words)
    assert (status, err) == (0, ""), err
    return out


def complaint(capsys: pytest.CaptureFixture[str], *words: object) -> str:
    """The one line of a command that ends with status 1, whatever it has printed before."""
    status, _, err = run(capsys, *words)
    assert status == 1 and err.startswith("modeler: ") and err.count("\n") == 1, err
    return err


def refusal(capsys: pytest.CaptureFixture[str], *words: object) -> str:
    """The one line of a command that is refused and prints nothing else."""
    status, out, err = run(capsys, *words)
    assert (status, out) == (1, "") and err.startswith("modeler: ") and err.count("\n") == 1, err
    return err


def program(*words: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """A command in a process of its own."""
    command = [sys.executable, "-m", "modeler", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, **options)
