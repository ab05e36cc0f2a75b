"""What a call costs where it is compiled for: bytes of stack and of flash, instructions.

The stack is the deepest way through the call graph that gcc writes (`-fcallgraph-info=su`), in
which a call by address may reach every function whose address is taken; flash is what a linker
keeps for one function alone (`--gc-sections`). Functions of the C library are named beside, not
counted.
"""

import json
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from modeler.codegen.package import render
from modeler.core.choices import Machine
from modeler.core.errors import BuildError
from modeler.core.manifest import EmittedModule

COST = "cost.json"
"""Name of the file that holds the figures."""

_CORTEX = ("-mthumb", "-mfloat-abi=hard", "-Os", "-ffp-contract=fast")
_MACHINES: Mapping[Machine, tuple[str, tuple[str, ...]]] = {
    "cortex-m7": ("arm-none-eabi-", ("-mcpu=cortex-m7", "-mfpu=fpv5-d16", *_CORTEX)),
    "cortex-m4": ("arm-none-eabi-", ("-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", *_CORTEX)),
    "host": (
        "",
        (
            "-O3",
            "-fno-tree-slp-vectorize",
            "-fno-math-errno",
            "-fno-trapping-math",
            "-ffp-contract=fast",
            "-fno-asynchronous-unwind-tables",
        ),
    ),
}
"""Start of the names of the tools, and the flags of the folder's Makefile."""

_SECTIONS = ("-std=c99", "-ffunction-sections", "-fdata-sections", "-fcallgraph-info=su")
_NODE = re.compile(r'node: \{ title: "([^"]+)" label: "[^"]*\\n(\d+) bytes \((\w+)')
_EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
_RELOCATION = re.compile(r"^[0-9a-f]+ (R_\S+)\s+(?:\.text\.)?(\w+)(?:-0x\S+)?$", re.MULTILINE)
"""A reference to the start of a function; those into the middle are tables of a switch."""

_CALLS = ("_PLT32", "_CALL", "_JUMP24", "_CALL26", "_JUMP26")
_INDIRECT = "__indirect_call"
_INSTRUCTIONS = re.compile(r"#define (\w+)_INSTRUCTIONS (\d+)")


@dataclass(frozen=True)
class _CallGraph:
    """The call graph of a library: bytes of each function's frame, and whom it calls."""

    frames: Mapping[str, int]
    edges: Mapping[str, frozenset[str]]

    def find_deepest(self, name: str) -> tuple[int | None, frozenset[str]]:
        """Returns the bytes of stack of a call at most, and the functions outside it may reach.

        None where the graph has no body of that name.
        """

        @cache
        def measure(each: str) -> tuple[int, frozenset[str]]:
            if each not in self.frames:
                return 0, frozenset() if each == _INDIRECT else frozenset([each])
            callees = [measure(callee) for callee in self.edges.get(each, ())]
            deepest = max((stack for stack, _ in callees), default=0)
            return self.frames[each] + deepest, frozenset().union(*(out for _, out in callees))

        return measure(name) if name in self.frames else (None, frozenset())


def add_cost(emitted: EmittedModule, machine: Machine) -> EmittedModule:
    """Returns the module with `cost.json` and a table in its README.

    Args:
        emitted: as it will be written.
        machine: what it is compiled for: this one, or a Cortex-M by arm-none-eabi-gcc.

    Raises:
        BuildError: a tool is missing, or the compiler refuses the C.
    """
    prefix, flags = _MACHINES[machine]
    tools = {each: _find_tool(prefix + each) for each in ("gcc", "ld", "nm", "size", "objdump")}
    with tempfile.TemporaryDirectory() as directory:
        folder = Path(directory)
        for name, text in emitted.files.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(text)
        sources = [name for name in emitted.spec.controller_sources if name.endswith(".c")]
        _run_command(folder, tools["gcc"], *_SECTIONS, *flags, "-c", *sources)
        objects = [name.replace(".c", ".o") for name in sources]
        calls = _read_call_graph(folder, tools["objdump"], objects)
        counts = _count_instructions(folder, machine, emitted)
        rows = []
        for function in emitted.spec.every_function:
            stack, outside = calls.find_deepest(function.name)
            rows.append(
                {
                    "name": function.name,
                    "stack": stack,
                    "outside": sorted(outside),
                    "flash": _measure_flash(folder, tools, objects, function.name),
                    "instructions": counts.get(function.name.upper()),
                }
            )
        compiler = _run_command(folder, tools["gcc"], "--version").splitlines()[0]
    spec = emitted.spec
    figures = {
        "robot": spec.robot,
        "signature": spec.compute_signature(),
        "precision": spec.precision,
        "machine": machine,
        "compiler": compiler,
        "flags": list(flags),
        "evaluations": 5000 if spec.closure is not None else None,
        "functions": rows,
    }
    return _add_files(emitted, figures)


def _add_files(emitted: EmittedModule, figures: Mapping[str, Any]) -> EmittedModule:
    readme = emitted.files["README.md"] + render("cost.md", **figures)
    more = {COST: json.dumps(figures, indent=1) + "\n", "README.md": readme}
    return EmittedModule(emitted.spec, {**emitted.files, **more}, emitted.log)


def _find_tool(name: str) -> str:
    path = shutil.which(name)
    if path is None:
        package = "gcc-arm-none-eabi" if name.startswith("arm") else "gcc binutils"
        raise BuildError(
            f"--measure: {name} is not installed; install it (Debian: apt install {package}), or "
            "measure for another machine"
        )
    return path


def _run_command(folder: Path, *command: str) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        first = (done.stderr.strip().splitlines() or ["no message"])[0]
        raise BuildError(
            f"--measure: {Path(command[0]).name} failed: {first}; check that it is a gcc of "
            "version 10 or later"
        )
    return done.stdout


def _read_call_graph(folder: Path, objdump: str, objects: Sequence[str]) -> _CallGraph:
    frames: dict[str, int] = {}
    edges: dict[str, set[str]] = {}
    for name in objects:
        text = (folder / name).with_suffix(".ci").read_text()
        frames |= {node: int(size) for node, size, _ in _NODE.findall(text)}
        for caller, callee in _EDGE.findall(text):
            edges.setdefault(caller, set()).add(callee)
    for node in [*frames]:  # versions for several processors: `file.c:name.fma`
        name, _, version = node.rpartition(":")[2].partition(".")
        if version and version != "resolver" and (name not in frames or not frames[name]):
            frames[name] = 0
            edges.setdefault(name, set()).add(node)
    relocations = _RELOCATION.findall(_run_command(folder, objdump, "-r", *objects))
    taken = {symbol for kind, symbol in relocations if not kind.endswith(_CALLS)}
    tables = {symbol for kind, symbol in relocations if kind.endswith(("_64", "_ABS32", "_ABS64"))}
    # A function of one file is called `file.c:name` in the graph; a call of it is relative too.
    local_functions = {name for name in frames if ":" in name and name.rpartition(":")[2] in tables}
    edges[_INDIRECT] = (taken & frames.keys()) | local_functions
    frames[_INDIRECT] = 0
    return _CallGraph(frames, {caller: frozenset(callees) for caller, callees in edges.items()})


def _measure_flash(
    folder: Path, tools: Mapping[str, str], objects: Sequence[str], name: str
) -> int:
    """Bytes of code and constants that are linked for one function alone."""
    alone = "alone.o"
    link = [tools["ld"], "-r", "--gc-sections", "-u", name, "-e", name]
    _run_command(folder, *link, *objects, "-o", alone)
    text, data = _run_command(folder, tools["size"], alone).splitlines()[1].split()[:2]
    return int(text) + int(data)


def _count_instructions(folder: Path, machine: Machine, emitted: EmittedModule) -> dict[str, int]:
    """{NAME: most of one call}, counted in qemu; {} where it is missing, or nothing is counted."""
    counted = "programs/count_instructions.c" in emitted.files
    if machine == "host" or not counted or shutil.which("qemu-system-arm") is None:
        return {}
    text = _run_command(folder, _find_tool("make"), "count", f"CPU={machine}")
    return {name: int(count) for name, count in _INSTRUCTIONS.findall(text)}
