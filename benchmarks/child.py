"""Whole processes: what a user waits for, start of Python included."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.line import Missing

_TAIL = 3

_BETWEEN = """
import resource, subprocess, sys, time
start = time.perf_counter()
status = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL)
wall, used = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
print(wall, used.ru_utime + used.ru_stime, used.ru_maxrss)
sys.exit(status)
"""


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
    return cost([sys.executable, "-m", "modeler", *words])


def cost(command: Sequence[str]) -> Cost:
    """Run it once, output thrown away.

    Raises:
        Missing: it fails; quotes its last words.
    """
    # A process begins with the memory of the one that starts it: a small one stands between.
    between = [sys.executable, "-S", "-c", _BETWEEN, *command]
    done = subprocess.run(
        between, capture_output=True, text=True, cwd=_top(), env=_installed(), check=False
    )
    if done.returncode:
        words = " | ".join(done.stderr.strip().splitlines()[-_TAIL:])
        raise Missing(f"{' '.join(command)} ended with {done.returncode}: {words}")
    wall, cpu, peak = (float(word) for word in done.stdout.split())
    return Cost(wall, cpu, peak / (1e6 if sys.platform == "darwin" else 1e3))


def _installed() -> dict[str, str]:
    """As where the package was installed: its bytecode is there, from the second run on."""
    table = dict(os.environ)
    if table.pop("PYTHONDONTWRITEBYTECODE", ""):
        table["PYTHONPYCACHEPREFIX"] = str(Path(tempfile.gettempdir()) / "modeler-bytecode")
    return table


def least(
    command: Sequence[str], times: int, run: Callable[[Sequence[str]], Cost] = modeler
) -> Cost:
    """The smallest of each figure over several runs."""
    costs = [run(command) for _ in range(times)]
    return Cost(*(min(getattr(c, name) for c in costs) for name in ("wall", "cpu", "peak")))


def _top() -> Path:
    return Path(__file__).resolve().parents[1]
