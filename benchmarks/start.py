"""From a command typed to its answer: help, derivations."""

from collections.abc import Mapping

from benchmarks.child import least
from benchmarks.line import Key, Line

DERIVED = {"wrist": 0.5, "puma560": 0.5, "panda": 0.5, "orthoglide-2003": None, "evra": None}
_TIMES, _FEW = 7, 2


def _help(quick: bool) -> Mapping[str, float]:
    times = _FEW if quick else _TIMES
    return {
        "help_seconds": least(["--help"], times).wall,
        "version_seconds": least(["--version"], times).wall,
    }


def _derive(quick: bool) -> Mapping[str, float]:
    times = _FEW if quick else _TIMES
    return {f"derive_seconds.{name}": least(["derive", name], times).wall for name in DERIVED}


LINES = (
    Line(
        (
            Key("help_seconds", "s", "`modeler --help`, the whole process.", 0.25, 0.1),
            Key("version_seconds", "s", "`modeler --version`, the whole process.", 0.25, 0.1),
        ),
        _help,
        3,
    ),
    Line(
        tuple(
            Key(f"derive_seconds.{name}", "s", f"`modeler derive {name}`, the whole process.", must,
                0.3 if must else None)
            for name, must in DERIVED.items()
        ),
        _derive,
        30,
    ),
)  # fmt: skip
