"""Closed postures of a robot with loops."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from modeler.core.choices import OTHER_PROGRAMS, list_builtin_robots
from modeler.core.errors import DataError
from modeler.core.files import check_writable
from modeler.core.options import OptionError
from modeler.derivation import HomeModes, express_as_home, find_modes_near
from modeler.robot import Robot, TomlCell, parse_robot_text, read_home, replace_home


def home(
    robot: Robot, near: Mapping[str, float] | str | None = None, anew: bool = False
) -> HomeModes:
    """Finds the assembly modes of a robot, the best first; `table()` lists them.

    >>> home(load("five-bar")).table().column("mode")
    ['A', 'B']

    Args:
        robot: with loops.
        near: values that are meant, by row, rad or m; or as text, "q1=0.3,q2=pi"; None: [home] of
            the robot.
        anew: True to search as if the robot stated no [home].

    Raises:
        LoopError: no loops, or none that can be closed.
        DataError: a row that is not there.
    """
    stated = {} if anew else dict(robot.home)
    near = _parse_near(near, robot) if isinstance(near, str) else near
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


def _parse_near(text: str, robot: Robot) -> dict[str, float]:
    """The values of a text."""
    values: dict[str, str] = {}
    for entry in text.split(","):
        name, equals, value = (part.strip() for part in entry.partition("="))
        if not equals or not name or not value:
            raise OptionError(
                f"{{--near}} {text}: got {entry!r}; expected values as in q1=0.3,q2=pi"
            )
        values[name] = value
    moving = {joint.name: joint for joint in robot.moving_joints}
    return dict(read_home(TomlCell("--near", value=values), moving, robot.evaluate_symbols()))


def select_mode(modes: HomeModes, letter: str | None, best: bool = False) -> int:
    """Returns the index of the mode with that letter; by default the robot's own.

    Raises:
        DataError: no such mode.
    """
    if letter is None:
        return 0 if modes.stated_index is None or best else modes.stated_index
    letters = [mode.letter for mode in modes.modes]
    if letter.upper() not in letters:
        raise OptionError(
            f"{{--mode}} {letter}: there is no such mode; expected one of {', '.join(letters)}"
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


def check_own_file(robot: str, what: str) -> None:
    """Raises an error if nothing can be written into the robot file; `what` names it."""
    if robot in list_builtin_robots():
        raise OptionError(
            f"{{--write}}: {robot} is built in; save it with `modeler robots {robot}` "
            "as a file of your own, and write into that"
        )
    path = Path(robot)
    if path.suffix.lower() in OTHER_PROGRAMS:
        raise OptionError(
            f"{{--write}}: {path} is another program's file, which states no {what}; convert it "
            f"with `modeler convert {path} --out {path.with_suffix('.toml')}`, and write into that"
        )
    if path.is_file():
        check_writable(path)
