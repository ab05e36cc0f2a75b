"""How long a regressor takes: to derive, to compile, to call; beside Pinocchio's Python binding.

Run from the top of the checkout: `python -m benchmarks.regressor [ROBOT...]`. Robots carry rotor
inertia, viscous and Coulomb friction at every joint. Pinocchio computes ten standard columns per
link and no friction; its time is that of the call from Python, as most people use it.
"""

import dataclasses
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from modeler.base import base_parameters
from modeler.codegen import Emitted, emit, write_emitted
from modeler.compiled.build import build_library
from modeler.compiled.toolchain import find_toolchain
from modeler.robot import EffectUse, Robot, read_robot
from modeler.symbolic import derive_model

ROBOTS = ("wrist", "puma560", "panda")
HERE = Path(__file__).resolve().parent


def with_losses(robot: Robot) -> Robot:
    names = tuple(joint.name for joint in robot.moving)
    effects = ("rotor_inertia", "viscous", "coulomb")
    return dataclasses.replace(robot, effects=tuple(EffectUse(e, names) for e in effects))


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def call_times(emitted: Emitted, folder: Path) -> tuple[float, float]:
    """Nanoseconds per call: (dense, compact), medians, the loop inside C."""
    write_emitted(emitted, folder)
    tools, prefix = find_toolchain(), emitted.spec.prefix
    names = [f'-DHEADER="{prefix}.h"', f"-DPREFIX={prefix}", f"-DMACRO={prefix.upper()}"]
    sources = [folder / name for name in emitted.spec.sources if name.endswith(".c")]
    program = folder / "benchmark"
    command = [*tools.command, *tools.flags, *names, "-I", str(folder), "-o", str(program)]
    subprocess.run([*command, str(HERE / "regressor.c"), *map(str, sources), "-lm"], check=True)
    out = subprocess.run([program, "101"], capture_output=True, text=True, check=True).stdout
    dense, compact = (float(word) for word in out.split())
    return dense, compact


def pinocchio_time(robot: Robot) -> float:
    """Nanoseconds per call of computeJointTorqueRegressor from Python, median; nan without it."""
    try:
        import pinocchio as pin

        from tests.symbolic.oracles import pinocchio_model
    except ImportError:
        return float("nan")
    model, _ = pinocchio_model(robot)
    data = model.createData()
    rng = np.random.default_rng(0)
    states = rng.uniform(-2, 2, (200, 3, model.nv))

    def work() -> None:
        for q, qd, qdd in states:
            pin.computeJointTorqueRegressor(model, data, q, qd, qdd)

    work()
    return 1e9 * median(timed(work)[0] for _ in range(15)) / len(states)


def measure(name: str) -> dict[str, Any]:
    robot = with_losses(read_robot(name))
    derive, model = timed(lambda: derive_model(robot))
    regressor, _ = timed(lambda: model.regressor)
    group, base = timed(lambda: base_parameters(model))
    generate, emitted = timed(lambda: emit(model, base))
    with tempfile.TemporaryDirectory() as scratch:
        os.environ["MODELER_CACHE"] = scratch
        sources = {name: emitted.files[name] for name in emitted.spec.sources}
        compiling, _ = timed(lambda: build_library(sources))
        dense, compact = call_times(emitted, Path(scratch) / "module")
    function = next(f for f in emitted.spec.functions if f.name.endswith("_base_regressor"))
    return {
        "robot": name,
        "columns": len(emitted.spec.base),
        "add+mul": f"{function.additions}+{function.multiplications}",
        "derive s": derive + regressor,
        "base s": group,
        "emit s": generate,
        "compile s": compiling,
        "C dense ns": dense,
        "C compact ns": compact,
        "Pinocchio Python ns": (pinocchio := pinocchio_time(robot)),
        "ratio": pinocchio / dense,
    }


def main(names: list[str]) -> None:
    derive_model(read_robot("two-link")).regressor  # noqa: B018  imports and caches
    base_parameters(derive_model(read_robot("two-link")))
    find_toolchain()
    rows = [measure(name) for name in names or ROBOTS]
    heads = list(rows[0])
    texts = [[f"{v:.3g}" if isinstance(v, float) else str(v) for v in r.values()] for r in rows]
    widths = [max(len(line[k]) for line in (heads, *texts)) for k in range(len(heads))]
    for line in (heads, *texts):
        print("  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)))


if __name__ == "__main__":
    main(sys.argv[1:])
