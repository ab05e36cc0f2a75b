"""Tiles in single precision over those in double, and W by columns over W by rows; interleaved."""

import subprocess
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from benchmarks.line import Key, Line, ratio
from benchmarks.regressor import HERE
from benchmarks.robots import ROBOTS, compiled, lossy
from modeler.codegen import derive, generate, write_emitted
from modeler.runtime import find_toolchain

SAMPLES = 100_001
_REPEATS = 5


def _single(quick: bool) -> Mapping[str, float]:
    values, rounds = {}, "40" if quick else "300"
    for name in ROBOTS:
        derivation = derive(lossy(name))
        with tempfile.TemporaryDirectory() as scratch:
            programs = {p: _program(derivation, p, Path(scratch)) for p in ("double", "single")}
            least = dict.fromkeys(programs, float("inf"))
            for _ in range(_REPEATS):
                for precision, program in programs.items():
                    said = subprocess.run([program, rounds], capture_output=True, check=True)
                    least[precision] = min(least[precision], float(said.stdout))
        values[f"single_tile_ns.{name}"] = least["single"]
        values[f"single_tiles_vs_double.{name}"] = least["double"] / least["single"]
    return values


def _program(derivation, precision, scratch: Path) -> Path:
    module, folder = generate(derivation, precision=precision), scratch / precision
    write_emitted(module, folder)
    tools, spec = find_toolchain(), module.spec
    names = [
        f'-DHEADER="{spec.prefix}.h"',
        f'-DTILE_HEADER="{spec.prefix}_tile.h"',
        f"-DPREFIX={spec.prefix}",
        f"-DMACRO={spec.prefix.upper()}",
    ]
    units = [folder / n for n in (f"{spec.prefix}.c", f"{spec.prefix}_tile.c")]
    program = scratch / f"program-{precision}"
    subprocess.run(
        [
            *tools.command,
            *tools.flags,
            *names,
            "-I",
            folder,
            "-o",
            program,
            HERE / "tile.c",
            *units,
            "-lm",
        ],
        check=True,
    )
    return program


def _columns(quick: bool) -> Mapping[str, float]:
    values, rng = {}, np.random.default_rng(5)
    for name in ROBOTS:
        model = compiled(name)
        motion = list(rng.uniform(-2, 2, (3, SAMPLES, len(model.spec.joints))))
        shape, ratios = (SAMPLES * len(model.spec.joints), len(model.spec.base)), []
        places = [np.zeros(shape, order=order) for order in ("C", "F")]
        for _ in range(8 if quick else 31):
            times = []
            for W in places:
                start = time.perf_counter()
                model._tiles.fill_samples(motion, W, dense=True)
                times.append(time.perf_counter() - start)
            ratios.append(times[1] / times[0])
        values[f"columns_over_rows.{name}"] = float(np.median(ratios))
    return values


LINES = (
    Line(
        tuple(
            key
            for name in ROBOTS
            for key in (
                Key(f"single_tile_ns.{name}", "ns", "A sample of a tile in single precision."),
                ratio(
                    f"single_tiles_vs_double.{name}",
                    "Tile in double over it.",
                    *((1.7, 2.0) if name != "wrist" else ()),
                ),
            )
        ),
        _single,
        20,
    ),
    Line(
        tuple(
            Key(
                f"columns_over_rows.{name}",
                "x",
                "W by columns over W by rows, one thread, median of pairs.",
            )
            for name in ROBOTS
        ),
        _columns,
        20,
    ),
)
