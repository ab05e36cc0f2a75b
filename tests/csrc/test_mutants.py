"""`make check` of an emitted folder notices a wrong sign or constant wherever one may stand."""

import dataclasses
import random
import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.manifest import EmittedModule
from tests.codegen.fitted_library import Functions, motion, robot_module, with_values
from tests.modules import compiler, module
from tests.rotation import ROTATING, with_cases

FOLDERS = {
    "wrist": lambda: module("wrist").emitted,
    "puma560 with values": lambda: with_values("puma560"),
    "slow-arm with values": lambda: with_values("slow-arm"),
    "sr400": lambda: module("sr400").emitted,
    "five-bar with values": lambda: with_values("five-bar"),
    "orthoglide-2003": lambda: module("orthoglide-2003").emitted,
    "wrist in single precision": lambda: single("wrist"),
}
"""Chains, one with effects of all kinds, a tied one, loops, a platform; floats."""

SIGN = re.compile(r"(?<=[\w)\]]) ([+-]) (?=[\w(-])|(?<== )(-)(?=[\w(])")
CONSTANT = re.compile(r"(?<![\w.\"])\d+\.\d+(?:e[-+]?\d+)?(?=f?\b)")

STEERING = r"_tree_(platform_)?(turned|spread|residual)\("
"""Functions that say how far a step may go, or where Newton starts: whether loops close, never
where. Their mutants are left out; of all others that pass, `same_results` has to say why."""


def single(name: str) -> EmittedModule:
    made = robot_module(name)
    return emit(made.model, made.base, precision="single")


@dataclass(frozen=True)
class Mutant:
    """One place of one file, and what stands there instead."""

    file: str
    start: int
    end: int
    text: str


def changed(emitted: EmittedModule, mutant: Mutant) -> EmittedModule:
    """The folder with the mutant."""
    text = emitted.files[mutant.file]
    text = text[: mutant.start] + mutant.text + text[mutant.end :]
    return dataclasses.replace(emitted, files={**emitted.files, mutant.file: text})


def told(emitted: EmittedModule, mutant: Mutant) -> str:
    text = emitted.files[mutant.file]
    line = text[: mutant.start].rpartition("\n")[2] + ">"
    return f"{mutant.file}: {line}{text[mutant.start :].partition(chr(10))[0]} -> {mutant.text}"


def code_lines(emitted: EmittedModule, *runtime: str) -> Iterator[tuple[str, int, str, str]]:
    """Of the robot's own C and of these files: file, place, line, head of its function or table.

    Comments are blank.
    """
    for file, text in emitted.files.items():
        mask = file.startswith(emitted.spec.prefix) and file.endswith(".c")
        if not mask and file not in runtime:
            continue
        plain = re.sub(r"/\*.*?\*/|//[^\n]*", lambda m: re.sub(".", " ", m[0]), text, flags=re.S)
        at, head = 0, ""
        for line in plain.splitlines(keepends=True):
            head = line if re.match(r"[A-Za-z]", line) else head
            yield file, at, line, head
            at += len(line)


def mutants_of(emitted: EmittedModule) -> list[Mutant]:
    """All of the robot's own files, and of sine and cosine."""
    lines = code_lines(emitted, "modeler_sincos.h")
    return [
        m
        for file, at, line, head in lines
        if not re.search(STEERING, head)
        for m in in_line(file, line, at)
    ]


def in_line(file: str, line: str, at: int) -> list[Mutant]:
    if line.startswith(("#include", "#if", "#error")) or "for (" in line:
        return []
    return [*signs(file, line, at), *constants(file, line, at)]


def signs(file: str, line: str, at: int) -> list[Mutant]:
    return [
        Mutant(file, at + m.start(), at + m.end(), {"+": " - ", "-": " + "}.get(m[1] or "", ""))
        for m in SIGN.finditer(line)
    ]


def constants(file: str, line: str, at: int) -> list[Mutant]:
    return [
        Mutant(file, at + m.start(), at + m.end(), repr(float(m[0]) * 1.01 or 0.01))
        for m in CONSTANT.finditer(line)
    ]


def same_results(emitted: EmittedModule, changed: EmittedModule, name: str) -> bool:
    """Whether the mutant is the same function: so it is at twelve further states, to rounding.

    There are terms that cancel (w x of a vector along w), vanish wherever the loops are closed, or
    are read for their sign alone; lengths that a file does not use; limits that nothing reaches.
    """
    inputs = motion(name)
    random = np.random.default_rng(3)
    spec, n = emitted.spec, len(inputs["q"])
    rounding = 1e-5 if spec.precision == "single" else 1e-12
    inputs["beta"] = random.normal(size=len(spec.base))
    inputs["chi"] = random.normal(size=len(spec.standard))
    inputs |= {"dq": 0.01 * inputs["qd"], "dt": np.full((n, 1), 0.002)}
    both = [Functions(each) for each in (emitted, changed)]
    if spec.closure is not None:
        inputs["start"] = both[0]("close", inputs)[::-1]
    for role in both[0].every:
        try:
            right, values = (each(role, inputs) for each in both)
        except AssertionError:  # a status
            return False
        if not np.all(np.abs(values - right) <= rounding * np.abs(right).max()):
            return False
    return True


class Folder:
    """An emitted folder with its objects; a mutant compiles what it has changed."""

    def __init__(self, emitted: EmittedModule, place: Path) -> None:
        self.emitted, self.place = emitted, place
        write_emitted(emitted, place)
        self.units = [n for n in emitted.files if n.endswith(".c") and "/" not in n]
        self.units.append("programs/self_check.c")
        for unit in self.units:
            self.compile(unit, place, place)

    def compile(self, unit: str, source: Path, target: Path) -> bool:
        out = target / f"{Path(unit).stem}.o"
        flags = ["-std=c99", "-O0", "-w", "-I", source, "-I", self.place]
        command = [compiler("gcc"), *flags, "-c", source / unit, "-o", out]
        return subprocess.run(command, capture_output=True).returncode == 0

    def passes(self, changed: Path, units: list[str]) -> bool:
        """Whether the check still passes with these units compiled in that folder."""
        if not all(self.compile(unit, changed, changed) for unit in units):
            return False
        places = {unit: changed if unit in units else self.place for unit in self.units}
        objects = [place / f"{Path(unit).stem}.o" for unit, place in places.items()]
        link = [compiler("gcc"), *objects, "-lm", "-o", changed / "check"]
        if subprocess.run(link, capture_output=True).returncode != 0:
            return False
        try:
            ran = subprocess.run([changed / "check"], capture_output=True, timeout=20)
        except subprocess.TimeoutExpired:
            return False
        return ran.returncode == 0

    def survives(self, mutant: Mutant) -> bool:
        place = self.place / "mutant"
        (place / "programs").mkdir(parents=True, exist_ok=True)
        new = changed(self.emitted, mutant).files
        header = mutant.file.endswith(".h")
        units = self.units if header else [mutant.file]
        for name in (*units, mutant.file, *(n for n in new if n.endswith(".h"))):
            (place / name).write_text(new[name])
        return self.passes(place, units)


@cache
def all_mutants(name: str) -> tuple[EmittedModule, list[Mutant]]:
    emitted = FOLDERS[name]()
    return emitted, mutants_of(emitted)


@with_cases(
    "name, count",
    ("five-bar with values", 3),
    pytest.param("slow-arm with values", 3, marks=pytest.mark.rotating),
    *(pytest.param(name, 12, marks=ROTATING) for name in FOLDERS),
)
def test_the_check_of_a_folder_notices_a_wrong_sign_or_constant(name, count, tmp_path):
    emitted, every = all_mutants(name)
    robot = name.split()[0]
    folder = Folder(emitted, tmp_path)
    (tmp_path / "right").mkdir()
    assert folder.passes(tmp_path / "right", []), "the check of the folder as it is"
    survived = []
    for mutant in random.Random(count).sample(every, count):
        if folder.survives(mutant) and not same_results(emitted, changed(emitted, mutant), robot):
            survived.append(told(emitted, mutant))
    assert not survived, "\n".join(survived)
