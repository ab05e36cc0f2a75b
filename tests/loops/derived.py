"""Derivations and compiled models of robots with loops, each once per worker."""

from functools import cache
from pathlib import Path

import pytest

from modeler.codegen.workflow import Derivation, derive, generate
from modeler.robot.read import parse_robot_text, read_robot
from modeler.runtime.model import CompiledModel
from tests.loops.drawn_robots import DRAWN, drawn
from tests.modules import loaded
from tests.rotation import ROTATING

TURN = pytest.mark.rotating

ALWAYS = ("rscr",)
LONG = ("stephenson", "rssr_universal", "rccc")
WEIGHED = [
    kind if kind in ALWAYS else pytest.param(kind, marks=ROTATING if kind in LONG else TURN)
    for kind in DRAWN
]
"""All kinds that are drawn: one in space always, some slow."""


@cache
def of_file(path: Path) -> Derivation:
    return derive(read_robot(path))


@cache
def of_drawing(kind: str) -> Derivation:
    return derive(parse_robot_text(drawn(kind, 1), kind))


def compiled_plainly(derivation: Derivation) -> CompiledModel:
    return loaded(generate(derivation))
