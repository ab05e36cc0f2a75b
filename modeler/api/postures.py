"""Closed postures of a robot with loops."""

import dataclasses
from collections.abc import Mapping

from modeler.core.errors import DataError
from modeler.derivation import HomeModes, modes_near, written
from modeler.robot import Robot, robot_from_text, with_home_text


def home(robot: Robot, near: Mapping[str, float] | None = None, anew: bool = False) -> HomeModes:
    """The assembly modes of a robot, the best first; its `table()` lists them.

    >>> home(load("five-bar")).table().column("mode")
    ['A', 'B']

    Args:
        robot: with loops.
        near: values that are meant, by row, rad or m; None: [home] of the robot.
        anew: True to search as if the robot stated no [home].

    Raises:
        LoopError: no loops, or none that can be closed.
        DataError: a row that is not there.
    """
    stated = {} if anew else dict(robot.home)
    if near is not None:
        moving = [joint.name for joint in robot.moving]
        for name in near:
            if name not in moving:
                raise DataError(
                    f"home: near names joint {name}; expected some of {', '.join(moving)}"
                )
        names = {joint.name for joint in robot.coordinates}
        stated = {name: value for name, value in stated.items() if name in names} | dict(near)
    return modes_near(dataclasses.replace(robot, home={}) if anew else robot, stated)


def chosen_mode(found: HomeModes, letter: str | None, best: bool = False) -> int:
    """The place of the mode with that letter; without one, the robot's own, unless `best`.

    Raises:
        DataError: no such mode.
    """
    if letter is None:
        return 0 if found.own is None or best else found.own
    letters = [mode.letter for mode in found.modes]
    if letter.upper() not in letters:
        raise DataError(
            f"--mode {letter}: there is no such mode; expected one of {', '.join(letters)}"
        )
    return letters.index(letter.upper())


def at_home(robot: Robot, found: HomeModes, letter: str | None = None) -> Robot:
    """The robot with an assembly mode as its [home], in its file's text too.

    >>> at_home(load("five-bar"), home(load("five-bar")), "B").name
    'five-bar'

    Raises:
        DataError: no such mode.
    """
    posture = found.modes[chosen_mode(found, letter)].posture
    text = with_home_text(robot.text, robot.home, written(found.linkage, posture))
    return robot_from_text(text, f"{robot.name} with its [home]")
