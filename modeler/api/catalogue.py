"""What is built in: robots, effects, estimators; each as a table."""

from modeler.core.estimators import ABOUT
from modeler.core.table import Table
from modeler.effects import CATALOGUE
from modeler.robot import Robot, builtin_names, read_robot


def robots() -> Table:
    """The built-in robots; `load(name)` gives one.

    >>> "ur10e" in robots().column("name")
    True
    """
    every = [read_robot(name) for name in builtin_names()]
    rows = tuple(
        (robot.name, robot.title, len(robot.coordinates), len(robot.moving), len(robot.loops),
         ", ".join(use.effect for use in robot.effects))
        for robot in every
    )  # fmt: skip
    names = ("name", "title", "coordinates", "joints", "loops", "effects")
    return Table("built-in robots", tuple((name, "") for name in names), rows)


def effects(robot: Robot | None = None) -> Table:
    """The catalogue of physical effects; with a robot, its own ones too.

    `modeler effects ID` says more of each.

    >>> dict(zip(effects().column("effect"), effects().column("parameters")))["coulomb"]
    'Fs'
    """
    known = CATALOGUE if robot is None else robot.catalogue
    rows = tuple(
        (effect.id, effect.title, effect.equation,
         ", ".join(column.prefix for column in effect.columns), ", ".join(effect.aliases))
        for effect in known
    )  # fmt: skip
    names = ("effect", "title", "equation", "parameters", "also called")
    return Table("physical effects", tuple((name, "") for name in names), rows)


def estimators() -> Table:
    """The estimators that `fit` takes as `method`."""
    rows = tuple((a.id, a.title, a.law, a.source, a.avoid) for a in ABOUT.values())
    names = ("method", "title", "law", "source", "when not to use it")
    return Table("estimators", tuple((name, "") for name in names), rows)
