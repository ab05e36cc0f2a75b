"""Closed postures of a robot with loops."""

import dataclasses
from collections.abc import Mapping

from modeler.core.errors import DataError
from modeler.derivation import HomeModes, express_as_home, find_modes_near
from modeler.robot import Robot, parse_robot_text, replace_home


def home(robot: Robot, near: Mapping[str, float] | None = None, anew: bool = False) -> HomeModes:
    """Finds the assembly modes of a robot, the best first; `table()` lists them.

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
        moving = [joint.name for joint in robot.moving_joints]
        for name in near:
            if name not in moving:
                raise DataError(
                    f"home: near names joint {name}; expected some of {', '.join(moving)}"
                )
        names = {joint.name for joint in robot.coordinates}
        stated = {name: value for name, value in stated.items() if name in names} | dict(near)
    return find_modes_near(dataclasses.replace(robot, home={}) if anew else robot, stated)


def select_mode(modes: HomeModes, letter: str | None, best: bool = False) -> int:
    """Returns the index of the mode with that letter; by default the robot's own.

    Raises:
        DataError: no such mode.
    """
    if letter is None:
        return 0 if modes.stated_index is None or best else modes.stated_index
    letters = [mode.letter for mode in modes.modes]
    if letter.upper() not in letters:
        raise DataError(
            f"--mode {letter}: there is no such mode; expected one of {', '.join(letters)}"
        )
    return letters.index(letter.upper())


def home_posture(robot: Robot, modes: HomeModes, letter: str | None = None) -> Robot:
    """Returns the robot with an assembly mode as its [home], in its text too.

    >>> home_posture(load("five-bar"), home(load("five-bar")), "B").name
    'five-bar'

    Raises:
        DataError: no such mode.
    """
    posture = modes.modes[select_mode(modes, letter)].posture
    text = replace_home(robot.text, robot.home, express_as_home(modes.linkage, posture))
    return parse_robot_text(text, f"{robot.name} with its [home]")
