"""Commands in processes of their own that load nothing: each is a fork of one that has loaded it.

What the interpreter itself reads when it starts (PYTHON..., the locale, closed streams) needs a
process that is really new.
"""

import contextlib
import gc
import importlib
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from modeler.cli import main
from modeler.cli.parser import parse_words
from tests.repository import ROOT

COMMANDS = (
    "compare m.json a.csv",
    "derive wrist",
    "fit wrist a.csv --out m.json",
    "generate wrist --out c",
    "simulate wrist --out a.csv",
)
PACKAGES = ("sympy", "cffi", "jinja2", "scipy.signal", "pyarrow.parquet", "pyarrow.csv")
"""What is loaded: no matplotlib, which reads the environment when it is loaded."""


def without_coverage() -> dict[str, str]:
    """The environment of a process that may write little: coverage would write its record there."""
    return {name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")}


class Forks:
    """A process that has loaded the program, and forks for every command."""

    def __init__(self) -> None:
        env = {**without_coverage(), "PYTHONPATH": str(ROOT)}
        self._server = subprocess.Popen(
            [sys.executable, "-m", "tests.forked"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=env,
        )

    def run(self, words, folder, env, seconds, file_limit=None):
        """The command as a program of its own; its status is that of SIGALRM after the seconds."""
        assert self._server.stdin is not None and self._server.stdout is not None
        with tempfile.TemporaryDirectory() as name:
            streams = [str(Path(name) / stream) for stream in ("out", "err")]
            asked = (words, streams, str(folder), dict(env), seconds, file_limit)
            self._server.stdin.write(json.dumps(asked) + "\n")
            self._server.stdin.flush()
            status = int(self._server.stdout.readline())
            out, err = (Path(place).read_text(errors="replace") for place in streams)
        return subprocess.CompletedProcess(words, status, out, err)

    def close(self) -> None:
        """End the process."""
        self._server.communicate()


def _child(words, streams, folder, env, seconds, file_limit):
    """What stands between a fork and the program: its folder, variables, streams and limits."""
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    for number, place in enumerate(streams, start=1):
        os.dup2(os.open(place, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
    sys.stdout, sys.stderr = os.fdopen(1, "w"), os.fdopen(2, "w", buffering=1)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(env)
    if file_limit is not None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))
        # Python itself has it ignored, and says so where it starts anew.
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    signal.alarm(int(seconds))
    sys.argv = ["modeler", *words]
    sys.exit(main())


def serve() -> None:
    """Answers every line with the exit status of what it asks for."""
    for command in COMMANDS:
        parse_words(command.split())[0].load()
    for name in PACKAGES:
        importlib.import_module(name)
    with contextlib.redirect_stdout(None):  # what sympy caches of a first derivation
        main(["derive", "two-link", "--no-terms"])
    gc.collect()
    gc.freeze()  # pages that no child looks at stay shared
    answers: Any = sys.stdout
    for line in sys.stdin:
        asked = json.loads(line)
        if (child := os.fork()) == 0:
            _child(*asked)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), file=answers, flush=True)


if __name__ == "__main__":
    serve()
