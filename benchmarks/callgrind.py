"""Instructions of one call, counted by valgrind: the same on every run, so a gate for changes."""

import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from benchmarks.line import Key, Line, Missing
from benchmarks.robots import ROBOTS, emitted
from modeler.codegen import write_emitted
from modeler.runtime import find_toolchain

MUST = {"wrist": None, "puma560": 1300.0, "panda": 1800.0}
AIM = {"wrist": None, "puma560": 1150.0, "panda": 1700.0}
_CALLS = 1000
_MAIN = """#include "{prefix}.h"
int main(void)
{{
    static double q[{macro}_JOINTS], qd[{macro}_JOINTS], qdd[{macro}_JOINTS];
    static double values[{macro}_NONZEROS];
    for (int j = 0; j < {macro}_JOINTS; j++) {{
        q[j] = 0.3 + 0.2*j; qd[j] = 1.0 - 0.1*j; qdd[j] = 0.5 + 0.3*j;
    }}
    for (int i = 0; i < CALLS; i++)
        {prefix}_base_regressor_nonzeros(q, qd, qdd, values);
    return values[0] > 1e300;
}}
"""


def _measure(quick: bool) -> Mapping[str, float]:
    return {f"instructions.{name}": instructions(name) for name in ROBOTS}


def instructions(name: str) -> float:
    """Of one sample's nonzero entries, compiled for a processor of 2013 with our own flags."""
    if shutil.which("valgrind") is None:
        raise Missing("no valgrind on this machine")
    module = emitted(name)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        write_emitted(module, folder / "module")
        prefix = module.spec.prefix
        main = folder / "main.c"
        main.write_text(_MAIN.format(prefix=prefix, macro=prefix.upper()), encoding="utf-8")
        counts = [_counted(folder, main, module.spec.sources, calls) for calls in (_CALLS, 0)]
    return (counts[0] - counts[1]) / _CALLS


def _counted(folder: Path, main: Path, sources: tuple[str, ...], calls: int) -> int:
    tools = find_toolchain()
    flags = [flag for flag in tools.flags if not flag.startswith(("-march", "-mcpu"))]
    program = folder / f"count-{calls}"
    units = [str(folder / "module" / name) for name in sources if name.endswith(".c")]
    made = subprocess.run(
        [
            *tools.command,
            *flags,
            "-march=haswell",
            f"-DCALLS={calls}",
            "-I",
            str(folder / "module"),
            "-o",
            str(program),
            str(main),
            *units,
            "-lm",
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    if made.returncode:
        raise Missing(f"no code for -march=haswell here: {made.stderr.partition(chr(10))[0]}")
    out = folder / "callgrind.out"
    said = subprocess.run(
        ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", str(program)],
        capture_output=True,
        text=True,
        check=True,
    )
    result = re.search(r"Collected : (\d+)", said.stderr)
    if result is None:
        raise Missing("valgrind gave no count")
    return int(result[1])


LINES = (
    Line(
        tuple(
            Key(
                f"instructions.{name}",
                "1",
                "Of a sample's nonzero entries, for Haswell (callgrind).",
                MUST[name],
                AIM[name],
            )
            for name in ROBOTS
        ),
        _measure,
        15,
    ),
)
