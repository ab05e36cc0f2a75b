"""The emitted folder built by its own Makefile and CMakeLists.txt, against the project's flags."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from benchmarks.line import Line, Missing, ratio
from benchmarks.regressor import HERE
from benchmarks.robots import emitted
from modeler.codegen import write_emitted
from modeler.runtime import find_toolchain

ROBOT = "puma560"
_ROUNDS, _FEW = 200, 40
_REPEATS = 3


def _make(folder: Path, prefix: str, *words: str) -> Path:
    if shutil.which("make") is None:
        raise Missing("no make on this machine")
    command = ["make", "-s", "-C", str(folder), *words]
    subprocess.run(command, check=True, capture_output=True, env=_plain())
    return folder / f"lib{prefix}_model.a"


def _cmake(folder: Path, prefix: str) -> Path:
    if shutil.which("cmake") is None:
        raise Missing("no cmake on this machine")
    build = folder / "build"
    for words in (["-S", str(folder), "-B", str(build)], ["--build", str(build)]):
        subprocess.run(["cmake", *words], check=True, capture_output=True, env=_plain())
    return next(build.glob(f"lib{prefix}_model.*"))


def _native(folder: Path, prefix: str) -> Path:
    return _make(folder, prefix, "NATIVE=1")


WAYS = {"make": _make, "cmake": _cmake, "make_native": _native}


def _plain() -> dict[str, str]:
    """The environment of a user who has set no flags."""
    return {k: v for k, v in os.environ.items() if k not in ("CFLAGS", "CPPFLAGS", "LDFLAGS")}


def _measure(quick: bool) -> Mapping[str, float | Missing]:
    module, prefix = emitted(ROBOT), emitted(ROBOT).spec.prefix
    tools, values = find_toolchain(), dict[str, float | Missing]()
    with tempfile.TemporaryDirectory() as scratch:
        ours = Path(scratch) / "ours"
        write_emitted(module, ours)
        units = [str(ours / n) for n in module.spec.sources if n.endswith(".c")]
        programs = {"project": _program(Path(scratch) / "project", tools, ours, units)}
        for name, build in WAYS.items():
            actual = Path(scratch) / name
            write_emitted(module, actual)
            try:
                library = build(actual, prefix)
            except Missing as why:
                values[f"emitted_folder_vs_project_flags.{name}"] = why
                continue
            programs[name] = _program(
                Path(scratch) / f"{name}-program", tools, actual, [str(library)]
            )
        times = _interleaved(programs, _FEW if quick else _ROUNDS)
    for name in WAYS:
        if name in times:
            values[f"emitted_folder_vs_project_flags.{name}"] = times["project"] / times[name]
    return values


def _program(out: Path, tools, folder: Path, units: list[str]) -> Path:
    prefix = emitted(ROBOT).spec.prefix
    names = [f'-DHEADER="{prefix}.h"', f"-DPREFIX={prefix}", f"-DMACRO={prefix.upper()}"]
    subprocess.run(
        [
            *tools.command,
            *tools.flags,
            *names,
            "-I",
            str(folder),
            "-o",
            str(out),
            str(HERE / "regressor.c"),
            *units,
            "-lm",
            "-ldl",
        ],
        check=True,
    )
    return out


def _interleaved(programs: Mapping[str, Path], rounds: int) -> dict[str, float]:
    """Shortest ns of a sample, all entries, by program."""
    least = dict.fromkeys(programs, float("inf"))
    for _ in range(_REPEATS):
        for name, program in programs.items():
            said = subprocess.run(
                [program, str(rounds)], capture_output=True, text=True, check=True
            )
            scalar = float(said.stdout.splitlines()[0].split()[1])
            least[name] = min(least[name], scalar)
    return least


LINES = (
    Line(
        tuple(
            ratio(
                f"emitted_folder_vs_project_flags.{name}",
                f"Speed of the folder's own build, as a share of the project's flags ({ROBOT}, "
                "scalar).",
                0.95,
                1.0,
            )
            for name in WAYS
        ),
        _measure,
        15,
    ),
)
