"""Mutants of a folder of a robot with loops: wrong signs, constants, terms and bounds of loops.

They stand wherever the library computes: in the robot's own files and in the runtime that closes
loops, solves, carries motion over and fills tiles. The programs of the folder are left alone.
"""

import re
from collections.abc import Iterator

from modeler.core.manifest import EmittedModule
from tests.csrc.test_mutants import Mutant, code_lines, constants, signs

RUNTIME = tuple(
    """
    modeler_closure.c modeler_closure_factor.c modeler_closure_motion.c modeler_closing.h
    modeler_solve.h modeler_tile.c modeler_sincos.h
""".split()
)

BOUND = re.compile(r"for \((?:int|size_t) (\w+) = (\d+); \1 (<) ([^;&]+?)(?: &&[^;]*)?;")
FACTOR = r"[\w.>\-]+(?:\[[^\]]*\])?"
TERM = re.compile(rf" [+-] {FACTOR}(?:\([^()]*\))?(?: \* {FACTOR})*(?=[;,) ])")
SUM = re.compile(r"[+-]=")


def mutants_of(emitted: EmittedModule) -> dict[str, list[Mutant]]:
    """By kind: sign, constant, term, bound."""
    table: dict[str, list[Mutant]] = {"sign": [], "constant": [], "term": [], "bound": []}
    for file, at, line, head in code_lines(emitted, *RUNTIME):
        if not line.startswith("#") and "static const int" not in head:
            for kind, mutant in _in_line(file, line, at):
                table[kind].append(mutant)
    return table


def _in_line(file: str, line: str, at: int) -> Iterator[tuple[str, Mutant]]:
    if "for (" in line:
        for m in BOUND.finditer(line):
            yield "bound", Mutant(file, at + m.end(4), at + m.end(4), " - 1")
            yield "bound", Mutant(file, at + m.start(2), at + m.end(2), f"{int(m[2]) + 1}")
        return
    yield from (("sign", mutant) for mutant in signs(file, line, at))
    for m in SUM.finditer(line):
        yield "sign", Mutant(file, at + m.start(), at + m.end(), {"+=": "-=", "-=": "+="}[m[0]])
    yield from (("constant", mutant) for mutant in constants(file, line, at))
    for m in TERM.finditer(line):
        yield "term", Mutant(file, at + m.start(), at + m.end(), "")
