"""How long a diagnosis takes, and one effect added and fitted: the demonstration arm, three joints.

Run from the top of the checkout: `python -m benchmarks.diagnosis [SECONDS]`. Logs of 40 s at 1 kHz
(or of SECONDS) with friction that grows with the load on joint 2. All from a warm process: modules
are loaded and the C is compiled. Below the line are the parts of `add`; `C, empty cache` is paid
once for every new robot file.
"""

import dataclasses
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.diagnosis import LogSplit, add_effect, analyse_logs, diagnose
from modeler.regression import Log, read_log
from modeler.robot import parse_robot_text
from modeler.simulation import SimulationSettings, parse_hidden_effect, simulate, write_log

EFFECT, JOINT = "load_friction", "2"


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def warm(work: Callable[[], Any]) -> float:
    """Seconds of the second call."""
    work()
    return timed(work)[0]


def logs_of(folder: Path, duration: float) -> list[Log]:
    """A log to fit and one to hold out."""
    robot = load("demo-arm")
    spec = generate(derive(robot)).spec
    settings = SimulationSettings(
        duration=duration, hidden=(parse_hidden_effect(f"{EFFECT}@{JOINT}"),)
    )
    values = []
    for seed in (1, 2):
        place = folder / f"{seed}.parquet"
        write_log(place, simulate(robot, dataclasses.replace(settings, seed=seed)))
        values.append(read_log(place, spec))
    return values


def measure(train: Log, other: Log) -> dict[str, float]:
    """Seconds by what was done."""
    derivation = derive(load("demo-arm"))
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    model = fit(derivation, emitted, observe(compiled, [train]))
    seconds = {
        "diagnose, training only": warm(lambda: diagnose(model, compiled, [train])),
        "diagnose, held-out log": warm(lambda: diagnose(model, compiled, [train], [other])),
    }
    for name, held in (("add, training only", ()), ("add, held-out log", (other,))):
        logs = LogSplit([train], held)
        seconds[name] = warm(lambda logs=logs: add_effect(model, compiled, EFFECT, JOINT, logs))
    better = add_effect(model, compiled, EFFECT, JOINT, LogSplit([train]))
    return seconds | parts(better.robot_text, train)


def parts(text: str, train: Log) -> dict[str, float]:
    """Seconds of what `add` is made of, for the robot file with the effect."""
    robot = parse_robot_text(text, "arm with the effect")
    derivation = derive(robot)
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    observation = observe(compiled, [train])
    processing = observation.report.processing
    seconds = {
        "- derive": warm(lambda: derive(robot)),
        "- emit C": warm(lambda: generate(derive(robot))) - warm(lambda: derive(robot)),
        "- C, cached": warm(lambda: compile_model(emitted)),
        "- rows in the wide band": warm(lambda: analyse_logs(compiled, [train], processing)),
        "- rows of the fit": warm(lambda: observe(compiled, [train], processing)),
        "- fit": warm(lambda: fit(derivation, emitted, observation)),
    }
    with tempfile.TemporaryDirectory() as scratch:
        before = os.environ.get("MODELER_CACHE")
        os.environ["MODELER_CACHE"] = scratch
        seconds["- C, empty cache"] = timed(lambda: compile_model(emitted))[0]
        if before is None:
            del os.environ["MODELER_CACHE"]
        else:
            os.environ["MODELER_CACHE"] = before
    return seconds


def diagnose_times(
    robots: tuple[str, ...] = ("demo-arm", "panda"), duration: float = 40.0
) -> dict[str, dict[str, float]]:
    """Of `modeler diagnose` as a process of its own, by robot: seconds, CPU seconds, peak MB.

    Args:
        robots: built-in ones.
        duration: of the log that a model is fitted to and asked about, s, at 1 kHz.
    """
    table = {}
    for name in robots:
        with tempfile.TemporaryDirectory() as folder:
            log, model = Path(folder) / "log.parquet", Path(folder) / "model.json"
            hide = SimulationSettings(
                duration=duration, hidden=(parse_hidden_effect(f"{EFFECT}@{JOINT}"),)
            )
            write_log(log, simulate(load(name), hide))
            _command("fit", name, log, "--out", model)
            table[name] = _command("diagnose", model, log)
    return table


def _command(*words: str | Path) -> dict[str, float]:
    """What a command of the program took."""
    start = time.perf_counter()
    child = subprocess.Popen(
        [sys.executable, "-m", "modeler", "-q", *map(str, words)], stdout=subprocess.DEVNULL
    )
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise RuntimeError(f"modeler {words[0]} ended with {child.returncode}")
    return {
        "seconds": time.perf_counter() - start,
        "cpu_seconds": used.ru_utime + used.ru_stime,
        "peak_mb": used.ru_maxrss / 1024.0,
    }


def main(words: list[str]) -> None:
    duration = float(words[0]) if words else 40.0
    with tempfile.TemporaryDirectory() as folder:
        train, other = logs_of(Path(folder), duration)
    print(f"{train.rows} and {other.rows} rows of {len(train.joints)} joints; seconds")
    for name, seconds in measure(train, other).items():
        print(f"{name:<28}{seconds:>8.2f}")


if __name__ == "__main__":
    main(sys.argv[1:])
