"""The robots that every test of every stage runs over: a new built-in is tested by being there."""

from collections.abc import Iterable
from typing import Any

import pytest

from modeler.core.builtin import builtin_names
from modeler.robot.read import read_robot

ROBOTS = builtin_names()

TREES = tuple(name for name in ROBOTS if not (read_robot(name).loops or read_robot(name).relations))
"""Robots whose rows all move on their own."""

TIED = tuple(name for name in ROBOTS if name not in TREES)
"""Robots with relations or loops."""

KINDS = ("demo-arm", "emps", "dvrk-psm", "sr400", "five-bar", "orthoglide-2003", "wrist-coupled")
"""One of each kind: serial, prismatic, tree, parallelogram, closed, spatial loops, coupled."""


def kinds_first(names: Iterable[str]) -> list[Any]:
    """Names for parametrize: one robot of each kind always, the others in the long tests."""
    slow = pytest.mark.slow
    return [name if name in KINDS else pytest.param(name, marks=slow) for name in names]
