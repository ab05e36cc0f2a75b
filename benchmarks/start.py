"""From a command typed to its answer: help, derivations; beside them what Python itself takes."""

import sys
from collections.abc import Mapping

from benchmarks.child import cost, least
from benchmarks.line import Key, Line

DERIVED: Mapping[str, tuple[float, float] | tuple[None, None]] = {
    "wrist": (0.45, 0.3),
    "puma560": (0.45, 0.3),
    "panda": (0.45, 0.3),
    "orthoglide-2003": (None, None),
    "evra": (0.9, 0.6),
}
"""Robots, with what must be reached and what would be best, s."""

_LIBRARIES = "import numpy, sympy, flint, casadi"
_TIMES, _FEW = 7, 2


def _help(quick: bool) -> Mapping[str, float]:
    times = _FEW if quick else _TIMES
    python = least([sys.executable, "-c", "pass"], times, cost).wall
    text = least(["--help"], times).wall
    return {
        "python_seconds": python,
        "help_seconds": text,
        "help_vs_python": text / python,
        "version_seconds": least(["--version"], times).wall,
    }


def _derive(quick: bool) -> Mapping[str, float]:
    times = _FEW if quick else _TIMES
    python = least([sys.executable, "-c", "pass"], times, cost).wall
    table = {"libraries_seconds": least([sys.executable, "-c", _LIBRARIES], times, cost).wall}
    for name in DERIVED:
        used = least(["derive", name], times)
        table[f"derive_seconds.{name}"] = used.wall
        table[f"derive_cpu_seconds.{name}"] = used.cpu
        table[f"derive_vs_python.{name}"] = used.wall / python
    return table


def _derive_keys() -> list[Key]:
    keys = [Key("libraries_seconds", "s", f"`python -c '{_LIBRARIES}'`: what derivations load.")]
    for name, (must, aim) in DERIVED.items():
        what = f"`modeler derive {name}`"
        keys += [
            Key(f"derive_seconds.{name}", "s", f"{what}.", must, aim),
            Key(f"derive_cpu_seconds.{name}", "s", "The same: processor time of all threads."),
            Key(f"derive_vs_python.{name}", "x", "The same over `python -c pass`."),
        ]
    return keys


LINES = (
    Line(
        (
            Key("python_seconds", "s", "`python -c pass`."),
            Key("help_seconds", "s", "`modeler --help`.", 0.25, 0.1),
            Key("help_vs_python", "x", "The same over `python -c pass`."),
            Key("version_seconds", "s", "`modeler --version`.", 0.25, 0.1),
        ),
        _help,
        3,
    ),
    Line(tuple(_derive_keys()), _derive, 30),
)
