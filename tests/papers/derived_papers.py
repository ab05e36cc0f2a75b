"""The robots of the papers, each derived once per test run."""

from functools import cache
from typing import Any

import pytest

from modeler.core.choices import list_papers
from modeler.papers.paper import DerivedRobot, derive_robot, read_paper
from modeler.robot.read import read_robot
from tests.modules import module


def each_paper(*always: str) -> Any:
    """The test for every paper, as `name`: these in every run, the others in turn."""
    turn = pytest.mark.rotating
    names = [n if n in always else pytest.param(n, marks=turn) for n in list_papers()]
    return pytest.mark.parametrize("name", names)


@cache
def robots_of(name: str) -> dict[str, DerivedRobot]:
    """All robots that the lines of a paper speak of."""
    paper = read_paper(name)
    return {robot: _robot(name, robot) for robot in paper.robots}


@cache
def _robot(paper: str, robot: str) -> DerivedRobot:
    variant = read_paper(paper).variants.get(robot)
    if variant is not None:
        return derive_robot(robot, variant)
    result = module(robot)
    return DerivedRobot(read_robot(robot), result.model, result.base)
