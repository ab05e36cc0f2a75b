"""The robots that every test of every stage runs over: a new built-in is tested by being there.

Known by the text of their files: nothing is derived or read when a test module is imported.
"""

import re
from collections.abc import Iterable
from typing import Any

import pytest

from modeler.core.choices import list_builtin_robots, read_builtin_robot
from tests.rotation import ROTATING

ROBOTS = list_builtin_robots()


def _with(*tables: str) -> tuple[str, ...]:
    head = re.compile(rf"^\[(?:{'|'.join(tables)})\]", re.M)
    return tuple(name for name in ROBOTS if head.search(read_builtin_robot(name)))


def _follows(text: str) -> bool:
    """Whether a cell of the table holds the variable of another row."""
    rows = re.findall(r'^\s*\["([\w{}]+)",([^#\n]*)', text, re.M)
    return any(set(re.findall(r"\bq([\w{}]+)", cells)) - {name} for name, cells in rows)


_TOLD = _with("loops", "relations", "motors")

TIED = tuple(name for name in ROBOTS if name in _TOLD or _follows(read_builtin_robot(name)))
"""Robots with relations or loops."""

TREES = tuple(name for name in ROBOTS if name not in TIED)
"""Robots whose rows all move on their own."""

LOOPED = _with("loops")

CLOSED = tuple(name for name in LOOPED if name != "sr400")
"""Those that C closes by iteration: for the others relations say all that their loops do."""

KINDS = ("emps", "puma560", "sr400-tree", "wrist-coupled", "sr400", "five-bar", "orthoglide-2003")
"""One of each structure: slide, chain, tree, motors of several joints, parallelogram, loops."""

OTHERS = tuple(name for name in ROBOTS if name not in KINDS)


def one_always(names: Iterable[str], *always: str) -> list[Any]:
    """Names for parametrize: some always, one robot of each other kind in turn, the rest long."""
    turns = {name: pytest.mark.rotating if name in KINDS else ROTATING for name in names}
    return [n if n in always else pytest.param(n, marks=mark) for n, mark in turns.items()]


def kinds_first(names: Iterable[str]) -> list[Any]:
    """Names for parametrize: one robot of each kind always, the others long, in turn."""
    return [name if name in KINDS else pytest.param(name, marks=ROTATING) for name in names]
