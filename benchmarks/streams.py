"""Fits of long logs, the whole process: seconds and memory.

`python -m benchmarks.streams 100000000` measures one of that length, in a folder with 12 GB.
"""

import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from benchmarks.child import modeler
from benchmarks.line import Key, Line
from modeler.api import compile_model, derive, generate, load
from modeler.simulation import collect_motion_limits, draw_plant_parameters

ROBOT = "ur10e"
_STEP, _PIECE = 1e-3, 200_000
_WAVES, _NOISE, _TREMBLE = 5, 0.5, 1e-5
LENGTHS = {"1e6": (1_000_000, 2.0, 1.2, 500.0, 300.0), "1e7": (10_000_000, 12.0, 6.0, 600.0, None)}
_QUICK = 10  # times shorter


def write_log(place: Path, samples: int) -> None:
    """A log of smooth motion at 1 kHz, positions and torques with noise, in row groups."""
    model = compile_model(generate(derive(load(ROBOT))))
    names = [joint.name for joint in model.spec.joints]
    writer = None
    for piece in _pieces(model, names, samples):
        writer = writer or pq.ParquetWriter(place, piece.schema)
        writer.write_table(piece)
    assert writer is not None
    writer.close()


def _pieces(model, names: list[str], samples: int) -> Iterator[pa.Table]:
    rng = np.random.default_rng(1)
    n = len(names)
    robot = load(ROBOT)  # a machine that can be built: the verdict does not search for one
    drawn = draw_plant_parameters(robot, collect_motion_limits(robot)).standard
    beta = np.array([sum(t.value * drawn[t.parameter] for t in b.terms) for b in model.spec.base])
    w = 2.0 * np.pi * rng.uniform(0.05, 0.5, (n, _WAVES))
    a, phase = rng.uniform(0.1, 0.5, (n, _WAVES)), rng.uniform(0.0, 6.28, (n, _WAVES))
    for first in range(0, samples, _PIECE):
        t = np.arange(first, min(first + _PIECE, samples)) * _STEP
        angle = t[:, None, None] * w + phase
        q, qd = (a * np.sin(angle)).sum(2), (a * w * np.cos(angle)).sum(2)
        qdd = -(a * w * w * np.sin(angle)).sum(2)
        tau = model.inverse_dynamics(q, qd, qdd, beta) + rng.normal(0.0, _NOISE, q.shape)
        q = q + rng.normal(0.0, _TREMBLE, q.shape)
        columns = {"time": t}
        columns |= {f"q{name}": q[:, j] for j, name in enumerate(names)}
        columns |= {f"tau{name}": tau[:, j] for j, name in enumerate(names)}
        yield pa.table(columns)


def _measure(quick: bool) -> Mapping[str, float]:
    table = {}
    modeler(["derive", ROBOT])  # the compiled model is in the cache from here on
    with tempfile.TemporaryDirectory() as scratch:
        log, model = Path(scratch) / "log.parquet", str(Path(scratch) / "model.json")
        for name, (samples, *_) in LENGTHS.items():
            write_log(log, samples // _QUICK if quick else samples)
            words = ["fit", ROBOT, str(log), "--out", model]
            if name == "1e6":
                modeler(words)
            used = modeler(words)
            table[f"fit_seconds.{name}"] = used.wall
            table[f"fit_cpu_seconds.{name}"] = used.cpu
            table[f"fit_peak_mb.{name}"] = used.peak
            if name == "1e7":
                used = modeler(["diagnose", model, str(log)])
                table |= {"diagnose_seconds.1e7": used.wall, "diagnose_peak_mb.1e7": used.peak}
            log.unlink()
    return table | {"fit_seconds_per_1e6": table["fit_seconds.1e6"]}


def _keys() -> tuple[Key, ...]:
    keys = [Key("fit_seconds_per_1e6", "s", "As fit_seconds.1e6.", 2.0, 1.2)]
    for name, (_, must, aim, most, least) in LENGTHS.items():
        what = f"`modeler fit {ROBOT}` of {name} samples of 6 joints (Parquet)"
        keys += [
            Key(f"fit_seconds.{name}", "s", f"{what}.", must, aim),
            Key(f"fit_cpu_seconds.{name}", "s", "The same: processor time of all threads."),
            Key(f"fit_peak_mb.{name}", "MB", "The same: largest resident memory.", most, least),
        ]
    what = "`modeler diagnose` of the model and the log of 1e7 samples"
    return (
        *keys,
        Key("diagnose_seconds.1e7", "s", f"{what}."),
        Key("diagnose_peak_mb.1e7", "MB", "The same: largest resident memory.", 1000.0),
    )


def _unfiltered(quick: bool) -> Mapping[str, float]:
    with tempfile.TemporaryDirectory() as scratch:
        log, model = Path(scratch) / "log.parquet", str(Path(scratch) / "model.json")
        write_log(log, 300_000 // (_QUICK if quick else 1))
        used = modeler(
            ["fit", ROBOT, str(log), "--out", model, "--parallel-cutoff", "0", "--decimate", "1"]
        )
    return {"unfiltered_fit_cpu_seconds": used.cpu, "unfiltered_fit_peak_mb": used.peak}


LINES = (
    Line(_keys(), _measure, 60),
    Line(
        (
            Key(
                "unfiltered_fit_cpu_seconds",
                "s",
                "`modeler fit` of 3e5 samples of 6 joints, every sample a row: processor time.",
            ),
            Key("unfiltered_fit_peak_mb", "MB", "The same: largest resident memory."),
        ),
        _unfiltered,
        30,
    ),
)


def _once(samples: int) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch) / "log.parquet"
        write_log(log, samples)
        used = modeler(["fit", ROBOT, str(log), "--out", str(Path(scratch) / "model.json")])
        size = log.stat().st_size / 1e9
    print(
        f"{samples} samples, {size:.1f} GB: {used.wall:.1f} s, {used.cpu:.1f} s of processors, "
        f"{used.peak:.0f} MB"
    )


if __name__ == "__main__":
    _once(int(sys.argv[1]))
