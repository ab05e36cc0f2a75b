"""Emitted C on a Cortex-M: compiled bare, looked into, run in qemu."""

import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest

from modeler.core.manifest import EmittedModule, FunctionSpec

HERE = Path(__file__).resolve().parent

FPU_4, FPU_5 = "-mfpu=fpv4-sp-d16", "-mfpu=fpv5-d16"
CPUS = {"cortex-m4": (FPU_4, "mps2-an386"), "cortex-m7": (FPU_5, "mps2-an500")}
"""Floating-point unit, and the machine of qemu that has it: that of the M4 knows no double."""

STRICT = tuple(
    """
    -std=c99 -Wall -Wextra -Wpedantic -Wshadow -Werror -Wdouble-promotion -Wfloat-conversion
""".split()
)


def tool(name: str) -> str:
    if shutil.which(name) is None:
        package = name if name.startswith("qemu") else "gcc-arm-none-eabi"
        pytest.skip(f"NOT CHECKED: {name} is not installed; on Debian: apt install {package}")
    return name


def command(cpu: str) -> list[str]:
    """The compiler for that processor, with the flags of `make count`."""
    flags = [f"-mcpu={cpu}", CPUS[cpu][0], "-mthumb", "-mfloat-abi=hard"]
    return [tool("arm-none-eabi-gcc"), *flags, "-Os", "-ffp-contract=fast"]


def library(emitted: EmittedModule, folder: Path, cpu: str, *more: str) -> list[Path]:
    """Objects of the library, compiled without a warning."""
    for name in emitted.spec.sources:
        (folder / name).write_text(emitted.files[name])
    units = [name for name in emitted.spec.sources if name.endswith(".c")]
    objects = [folder / f"{name}.{cpu}.o" for name in units]
    for name, made in zip(units, objects, strict=True):
        flags = [*STRICT, *more, "-ffunction-sections", "-c", folder / name, "-o", made]
        subprocess.run([*command(cpu), *flags], check=True)
    return objects


def undefined(objects: Sequence[Path]) -> set[str]:
    """What the objects want from other libraries."""
    text = output([tool("arm-none-eabi-nm"), *map(str, objects)])
    rows = [line.split() for line in text.splitlines()]
    defined = {words[2] for words in rows if len(words) == 3}
    return {words[1] for words in rows if len(words) == 2 and words[0] == "U"} - defined


def section_bytes(path: Path, *parts: str) -> int:
    """Bytes of the sections of an object whose names have one of these parts."""
    text = output([tool("arm-none-eabi-size"), "-A", str(path)])
    rows = [line.split() for line in text.splitlines()[2:] if line.startswith(".")]
    return sum(int(row[1]) for row in rows if any(part in row[0] for part in parts))


def run(emitted, folder, cpu, calls):
    """Outputs, (n, ...), of functions on that processor; inputs are (n, length)."""
    objects = library(emitted, folder, cpu)
    number = "float" if emitted.spec.precision == "single" else "double"
    body = [line for call in calls for line in call_lines(*call, number)]
    head = [f'#include "{emitted.spec.prefix}.h"', '#include "board.h"', "int main(void)", "{"]
    (folder / "main.c").write_text("\n".join([*head, *body, "    return 0;", "}", ""]))
    board = ["-nostartfiles", "-Wl,-emain", "-Wl,--section-start=.vectors=0"]
    board += ["-Wl,-Ttext=0x400", "-Wl,-Tdata=0x20000000", "-I", str(HERE)]
    program = folder / "main.elf"
    build = [*command(cpu), *board, "-o", program, folder / "main.c", *objects, "-lm"]
    subprocess.run(build, check=True)
    machine = [tool("qemu-system-arm"), "-M", CPUS[cpu][1], "-display", "none", "-serial", "none"]
    machine += ["-monitor", "none", "-chardev", "stdio,id=out"]
    machine += ["-semihosting-config", "enable=on,target=native,chardev=out"]
    said = output([*machine, "-kernel", str(program)])
    return arrays(said.split(), calls, np.dtype("<f4" if number == "float" else "<f8"))


def call_lines(function: FunctionSpec, inputs: Mapping[str, np.ndarray], number: str) -> list[str]:
    """C that calls a function for every sample and says the bytes of its output."""
    suffix = "f" if number == "float" else ""
    names = [argument.name for argument in function.inputs]
    lines = ["    {"]
    for name in names:
        values = ", ".join(f"{float(x).hex()}{suffix}" for x in inputs[name].ravel())
        lines.append(f"        static const {number} {name}[] = {{ {values} }};")
    size = int(np.prod(function.outputs[0].shape))
    samples = len(inputs[names[0]])
    at = ", ".join(f"{name} + {inputs[name].shape[1]}*i" for name in names)
    return [
        *lines,
        f"        static {number} out[{size}];",
        f"        for (int i = 0; i < {samples}; i++) {{",
        f"            {function.name}({at}, out);",
        "            say_bytes(out, sizeof out);",
        "        }",
        "    }",
    ]


def arrays(said, calls, kind):
    """What was said, as arrays in double precision."""
    lines = iter(said)
    values = []
    for function, inputs in calls:
        samples = len(next(iter(inputs.values())))
        numbers = [np.frombuffer(bytes.fromhex(next(lines)), kind) for _ in range(samples)]
        values.append(np.array(numbers, float).reshape(samples, *function.outputs[0].shape))
    return values


def output(words: Sequence[str]) -> str:
    return subprocess.run(words, check=True, capture_output=True, text=True, timeout=120).stdout
