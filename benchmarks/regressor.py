"""The base regressor beside Pinocchio's C++ regressor, interleaved in one process, in cache.

Robots carry rotor inertia, viscous and Coulomb friction at every joint. Pinocchio computes ten
standard columns per link and no friction; it is compiled from its headers by gcc and by clang.
"""

import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from benchmarks.line import Key, Line, Missing, ratio
from benchmarks.peers import pinocchio
from benchmarks.robots import ROBOTS, emitted, lossy
from modeler.codegen import write_emitted
from modeler.runtime import find_toolchain

HERE = Path(__file__).resolve().parent
_ROUNDS, _FEW = 400, 40
_WAYS = ("scalar", "nonzeros", "tile")


def _measure(quick: bool) -> Mapping[str, float | Missing]:
    table: dict[str, float | Missing] = {}
    for name in ROBOTS:
        times, missing = nanoseconds(name, _FEW if quick else _ROUNDS)
        for kind, why in missing.items():
            keys = (f"{way}_vs_pinocchio_{kind}.{name}" for way in ("scalar", "nonzeros", "batch"))
            table |= dict.fromkeys((*keys, f"pinocchio_ns.{kind}.{name}"), why)
        ways = {"scalar": "scalar", "nonzeros": "nonzeros", "batch": "tile"}
        ways = {way: times[item] for way, item in ways.items() if times[item]}
        table |= {f"regressor_ns.{way}.{name}": entry for way, entry in ways.items()}
        for kind in pinocchio.COMPILERS:
            if (local := times.get(kind)) is None:
                continue
            table[f"pinocchio_ns.{kind}.{name}"] = local
            table |= {f"{way}_vs_pinocchio_{kind}.{name}": local / ns for way, ns in ways.items()}
    return table


def nanoseconds(name: str, rounds: int) -> tuple[dict[str, float], dict[str, Missing]]:
    """ns per sample of every way and of the peers; why some of these cannot be built."""
    module, kinds, missing = emitted(name), [], dict[str, Missing]()
    with tempfile.TemporaryDirectory() as scratch:
        folder, model = Path(scratch), Path(scratch) / "model.txt"
        write_emitted(module, folder / "module")
        pinocchio.write_model(lossy(name), model)
        for kind in pinocchio.COMPILERS:
            try:
                pinocchio.check(kind, name, model)
            except Missing as why:
                missing[kind] = why
                continue
            kinds.append(kind)
        program = program_of(name, folder)
        peers = [str(pinocchio.library(kind)) for kind in kinds]
        said = subprocess.run(
            [program, str(rounds), str(model), *peers], capture_output=True, text=True, check=True
        )
    times = [float(line.rpartition(" ")[2]) for line in said.stdout.splitlines()]
    return dict(zip((*_WAYS, *kinds), times, strict=True)), missing


def program_of(name: str, folder: Path) -> Path:
    """regressor.c with the module in `folder`, by the flags of this project."""
    spec = emitted(name).spec
    tools, prefix = find_toolchain(), spec.prefix
    names = [f'-DHEADER="{prefix}.h"', f"-DPREFIX={prefix}", f"-DMACRO={prefix.upper()}"]
    if spec.tile_sources:
        names.append(f'-DTILE_HEADER="{prefix}_tile.h"')
    files = dict.fromkeys((*spec.sources, *spec.tile_sources))
    units = [str(folder / "module" / unit) for unit in files if unit.endswith(".c")]
    program = folder / "regressor"
    made = subprocess.run(
        [
            *tools.command,
            *tools.flags,
            *names,
            "-I",
            str(folder / "module"),
            "-o",
            str(program),
            str(HERE / "regressor.c"),
            *units,
            "-lm",
            "-ldl",
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    if made.returncode:
        raise Missing(f"the C of {name} does not compile: {made.stderr.partition(chr(10))[0]}")
    return program


def _keys() -> list[Key]:
    must = {
        "scalar": {"puma560": (15.0, 16.0), "panda": (13.0, 14.0)},
        "batch": {"puma560": (80.0, 107.0), "panda": (70.0, 94.0)},
    }
    keys = []
    for name in ROBOTS:
        keys += [
            Key(f"regressor_ns.{way}.{name}", "ns", f"A sample of the base regressor, {text}.")
            for way, text in (
                ("scalar", "all entries"),
                ("nonzeros", "nonzero entries"),
                ("batch", "nonzero entries, 8 samples a call"),
            )
        ]
        for kind in pinocchio.COMPILERS:
            peer = f"Pinocchio's regressor ({kind})"
            keys.append(Key(f"pinocchio_ns.{kind}.{name}", "ns", f"{peer}, a sample."))
            for way, text in (
                ("scalar", "dense"),
                ("nonzeros", "nonzero entries"),
                ("batch", "by tiles of 8"),
            ):
                goals = must.get(way, {}).get(name, (None, None)) if kind == "gcc" else (None, None)
                keys.append(
                    ratio(f"{way}_vs_pinocchio_{kind}.{name}", f"It over ours, {text}.", *goals)
                )
    return keys


LINES = (Line(tuple(_keys()), _measure, 60),)
