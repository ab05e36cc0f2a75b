"""Whole processes: what a user waits for, start of Python included."""

import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.line import Missing

_TAIL = 3


@dataclass(frozen=True)
class Cost:
    """Of one process.

    Attributes:
        wall: s.
        cpu: s, of all its threads.
        peak: largest resident set, MB.
    """

    wall: float
    cpu: float
    peak: float


def modeler(words: Sequence[str]) -> Cost:
    """`modeler WORDS` in this Python."""
    return cost([sys.executable, "-m", "modeler.cli", *words])


def cost(command: Sequence[str]) -> Cost:
    """Run it once, output thrown away.

    Raises:
        Missing: it fails; quotes its last words.
    """
    import time

    with subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, cwd=_top()
    ) as process:
        start = time.perf_counter()
        assert process.stderr is not None
        said = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        words = " | ".join(said.decode(errors="replace").strip().splitlines()[-_TAIL:])
        raise Missing(f"{' '.join(command)} ended with {process.returncode}: {words}")
    scale = 1e6 if sys.platform == "darwin" else 1e3
    return Cost(wall, used.ru_utime + used.ru_stime, used.ru_maxrss / scale)


def least(command: Sequence[str], times: int) -> Cost:
    """The smallest of each figure over several runs."""
    costs = [modeler(command) for _ in range(times)]
    return Cost(*(min(getattr(c, name) for c in costs) for name in ("wall", "cpu", "peak")))


def _top() -> Path:
    return Path(__file__).resolve().parents[1]
