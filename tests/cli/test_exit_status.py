"""Every exit status that the help and docs/reference/commands.md name, provoked."""

import os
import re
import resource
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import main
from tests.cli.running import program, refusal
from tests.repository import ROOT
from tests.rotation import with_cases

DOCUMENTED = {0, 1, 2, 130}


def test_help_and_docs_name_the_same(capsys) -> None:
    with pytest.raises(SystemExit):
        main(["--help"])
    printed = capsys.readouterr().out.partition("exit status:")[2]
    assert {int(n) for n in re.findall(r"^  (\d+)  ", printed, re.MULTILINE)} == DOCUMENTED
    text = (ROOT / "docs" / "reference" / "commands.md").read_text(encoding="utf-8")
    assert {int(n) for n in re.findall(r"^\| (\d+) \|", text, re.MULTILINE)} == DOCUMENTED


@pytest.mark.rotating("long tests of cli")
def test_memory_runs_out_in_a_log(tmp_path: Path) -> None:
    """A log of 4 GB (holes, no disk) for a process of 2 GB."""
    with (tmp_path / "x.npy").open("wb") as file:
        shape = {"descr": "<f8", "fortran_order": False, "shape": (2**29,)}
        np.lib.format.write_array_header_1_0(file, shape)
        file.truncate(2**32 + 1024)

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (2**31, 2**31))

    done = program("log", "x.npy", cwd=tmp_path, preexec_fn=limited)
    assert done.returncode == 1 and re.fullmatch(r"modeler: x.npy: .*ulimit -v.*\n", done.stderr)


@with_cases(
    "error",
    MemoryError(),
    ImportError("x.so: failed to map segment from shared object"),
    RuntimeError("can't start new thread"),
    OSError(12, os.strerror(12)),
)
def test_memory_runs_out_in_any_words(error: Exception, monkeypatch, capsys) -> None:
    import modeler.cli.program as program

    def fails(*_: object) -> None:
        raise error

    monkeypatch.setattr(program, "_execute_command", fails)
    assert main(["robots"]) == 1
    assert re.fullmatch(r"modeler: memory: .*\n", capsys.readouterr().err)


def test_what_the_system_refuses_of_a_path_is_one_line(capsys) -> None:
    name = "x" * 300
    assert refusal(capsys, "fit", "demo-arm", name, "--out", "m.json").startswith(
        f"modeler: {name}: cannot be"
    )


@pytest.mark.rotating("long tests of cli")
def test_interrupted(tmp_path: Path) -> None:
    """In the midst of the work, which `--verbose` shows."""
    words = ("-v", "simulate", "panda", "--duration", "600", "--out", str(tmp_path / "x.parquet"))
    running = subprocess.Popen(
        [sys.executable, "-m", "modeler", *words],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),  # a shell's & ignores it
    )
    assert running.stderr is not None
    for line in running.stderr:
        if line == "modeler: simulating panda ...\n":
            break
    time.sleep(0.1)
    running.send_signal(signal.SIGINT)
    with running.stderr:
        *_, last = running.stderr.read().splitlines()
    assert running.wait(timeout=60) == 130 and last == "modeler: interrupted"
    assert list(tmp_path.iterdir()) == []
