"""Bytes of a base regressor on a Cortex-M7, compiled bare by arm-none-eabi-gcc."""

import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from benchmarks.line import Key, Line, Missing
from benchmarks.robots import lossy
from modeler.codegen import derive, generate

ROBOTS = {"puma560": (4600.0, 4300.0), "panda": (7400.0, 7000.0)}
COMPILER = "arm-none-eabi-gcc"
FLAGS = (
    "-mcpu=cortex-m7",
    "-mfpu=fpv5-d16",
    "-mthumb",
    "-mfloat-abi=hard",
    "-std=c99",
    "-Os",
    "-ffp-contract=fast",
    "-ffunction-sections",
    "-fdata-sections",
)


def _measure(quick: bool) -> Mapping[str, float]:
    if shutil.which(COMPILER) is None:
        raise Missing(f"no {COMPILER} on this machine (Debian: apt install gcc-arm-none-eabi)")
    return {
        f"cortex_m7_bytes.{precision}.{name}": bytes_of(name, precision)
        for name in ROBOTS
        for precision in ("single", "double")
    }


def bytes_of(name: str, precision: str) -> float:
    """Code and constants of the base regressor's nonzero entries, sines and cosines included.

    That is all a program needs for the call; in double also the sine and cosine of the C library.
    """
    module = generate(derive(lossy(name)), precision=precision)  # type: ignore[arg-type]
    prefix = module.spec.prefix
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for file in module.spec.sources:
            (folder / file).write_text(module.files[file], encoding="utf-8")
        unit = folder / f"{prefix}_base_regressor.c"
        made = unit.with_suffix(".o")
        subprocess.run([COMPILER, *FLAGS, "-c", str(unit), "-o", str(made)], check=True)
        said = subprocess.run(
            ["arm-none-eabi-size", "-A", str(made)], capture_output=True, text=True, check=True
        )
    rows = [line.split() for line in said.stdout.splitlines() if line.startswith(".")]
    dense = f".text.{prefix}_base_regressor"
    rest = [row for row in rows if row[0].startswith((".text", ".rodata")) and row[0] != dense]
    return float(sum(int(row[1]) for row in rest))


LINES = (
    Line(
        tuple(
            Key(
                f"cortex_m7_bytes.{precision}.{name}",
                "B",
                "Base regressor (nonzero entries), -Os, sines included.",
                ROBOTS[name][0] if precision == "single" else None,
                ROBOTS[name][1] if precision == "single" else None,
            )
            for name in ROBOTS
            for precision in ("single", "double")
        ),
        _measure,
        10,
    ),
)
