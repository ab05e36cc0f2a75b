"""The robots of the papers, each derived once per test run."""

from functools import cache

from modeler.papers.paper import DerivedPaper, derived_robot, read_paper
from modeler.robot.read import read_robot
from tests.modules import module


@cache
def robots_of(name: str) -> dict[str, DerivedPaper]:
    """All robots that the lines of a paper speak of."""
    paper = read_paper(name)
    return {robot: _robot(name, robot) for robot in paper.robots}


@cache
def _robot(paper: str, robot: str) -> DerivedPaper:
    variant = read_paper(paper).variants.get(robot)
    if variant is not None:
        return derived_robot(robot, variant)
    found = module(robot)
    return DerivedPaper(read_robot(robot), found.model, found.base)
