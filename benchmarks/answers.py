"""Diagnosis, comparison and an effect added, the whole process: what a user waits for."""

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from benchmarks.child import Cost, modeler
from benchmarks.line import Key, Line

_SHORT = 20.0  # s, of a quick run


@dataclass(frozen=True)
class _Case:
    name: str
    robot: str
    hidden: str
    seconds: float
    must: float | None
    aim: float | None
    most: float | None = None


CASES = (
    _Case("3", "demo-arm", "load_friction@2", 40.0, 1.5, 0.75),
    _Case("7", "panda", "load_friction@4", 40.0, 3.0, 1.5),
    _Case("6x400s", "ur10e", "load_friction@3", 400.0, 6.0, 3.0, 600.0),
)

LOGS = {
    "fit": "of a log (demo-arm and panda 40 s, ur10e 400 s)",
    "compare": "with another",
    "diagnose": "of both",
}


def _measure(quick: bool) -> Mapping[str, float]:
    table = {}
    for case in CASES:
        with tempfile.TemporaryDirectory() as scratch:
            used = _told(case, Path(scratch), _SHORT if quick else case.seconds)
        for command, cost in used.items():
            table[f"{command}_seconds.{case.name}"] = cost.wall
            table[f"{command}_peak_mb.{case.name}"] = cost.peak
    return table


def _told(case: _Case, folder: Path, seconds: float) -> dict[str, Cost]:
    logs = [str(folder / f"{seed}.parquet") for seed in (1, 2)]
    model = str(folder / "model.json")
    for seed, log in enumerate(logs, 1):
        modeler(
            [
                "simulate",
                case.robot,
                "--out",
                log,
                "--duration",
                str(seconds),
                "--seed",
                str(seed),
                "--hide",
                case.hidden,
            ]
        )
    modeler(["fit", case.robot, logs[0], "--out", model])
    return {
        "fit": modeler(["fit", case.robot, logs[0], "--out", model]),
        "compare": modeler(["compare", model, logs[1]]),
        "diagnose": modeler(["diagnose", model, logs[0], "--holdout", logs[1]]),
    }


def _keys() -> tuple[Key, ...]:
    keys = []
    for case in CASES:
        for command in ("fit", "compare", "diagnose"):
            mask = command == "diagnose"
            keys += [
                Key(
                    f"{command}_seconds.{case.name}",
                    "s",
                    f"`modeler {command}` {LOGS[command]}.",
                    case.must if mask else None,
                    case.aim if mask else None,
                ),
                Key(
                    f"{command}_peak_mb.{case.name}",
                    "MB",
                    "The same: largest resident memory.",
                    case.most if mask else None,
                ),
            ]
    return tuple(keys)


LINES = (Line(_keys(), _measure, 60),)
