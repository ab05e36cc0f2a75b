"""What the process of the viewer answers about robots: a text as a picture, or what is wrong in it.

Every function takes the text of a robot file; nothing is read from it but what the reader of robot
files reads.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from modeler.api import Robot, open_robot, previews
from modeler.api.front_end import (
    ModelerError,
    Picture,
    TableText,
    find_table_text,
    locate_error_cell,
    parse_json,
    parse_robot_text,
    read_limit_texts,
    read_symbol_texts,
    read_text,
)


@dataclass(frozen=True)
class JointFacts:
    """A moving joint, for the tables beside the picture.

    Attributes:
        name: of the joint.
        actuated: True if it has a motor.
        unit: of its position.
        effects: ids that it has.
        limits: lower, upper, speed, acceleration, as they are written; empty where none are.
    """

    name: str
    actuated: bool
    unit: str
    effects: tuple[str, ...]
    limits: tuple[str, ...]


@dataclass(frozen=True)
class RobotPreview:
    """What was read from the text of a robot file, right or wrong.

    Attributes:
        error: the line of the reader; "" where nothing is wrong.
        wrong: row and column of the cell of the table that it is about, -1 for names of columns or
            all of a row.
        named: table of the file and entry that it is about, as ("limits", "2"); empty otherwise.
        table: cells as they are written; None where no table is found.
        names: rows of the robot that each row of the table stands for.
        name: of the robot.
        notes: what reading it decided.
        joints: that move; empty where something is wrong.
        everyone: joints that "all" means in [effects].
        symbols: letters and their values, as they are written.
        content: what the page draws; None where something is wrong.
    """

    error: str
    wrong_cell: tuple[int, int] | None
    table: TableText | None
    named: tuple[str, ...] = ()
    names: tuple[tuple[str, ...], ...] = ()
    name: str = ""
    notes: tuple[str, ...] = ()
    joints: tuple[JointFacts, ...] = ()
    everyone: tuple[str, ...] = ()
    symbols: tuple[tuple[str, str], ...] = ()
    content: dict[str, Any] | None = field(default=None, repr=False)


def robot_look(text: str, where: str = "robot.toml") -> RobotPreview:
    """Returns the preview of a robot text, or its error and the cell of it."""
    table = find_table_text(text)
    try:
        robot = parse_robot_text(text, where)
        content = previews.build_robot_content(robot)
    except ModelerError as error:
        match = re.search(r": \[(symbols|limits)\], \"?(\w+)", str(error))
        named_entry = match.groups() if match else ()
        return RobotPreview(str(error), _locate_error(str(error), text, table), table, named_entry)
    names = _find_row_names(table, [joint.name for joint in robot.joints])
    everyone = tuple(joint.name for joint in robot.moving_joints if joint.actuated)
    joints, symbols = _describe_joints(robot), tuple(read_symbol_texts(text).items())
    about = names, robot.name, robot.readings, joints, everyone, symbols
    return RobotPreview("", None, table, (), *about, content)


def robot_page(text: str) -> str:
    """Returns the page of `modeler show`."""
    return previews.render_robot(parse_robot_text(text, "robot.toml"))


def relations_of(result: str, place: str) -> tuple[str, dict[str, Any]]:
    """Returns the base parameters of a derivation as HTML, and the JSON.

    Args:
        result: file of the result.
        place: of the robot file that was derived.
    """
    derivation = parse_json(read_text(Path(result)))
    return previews.render_relations(derivation, open_robot(place)), derivation


# Motions that a robot is to drive.


@dataclass(frozen=True)
class MotionPreview:
    """A motion against its limits.

    Attributes:
        time: (n,) s.
        q: (n,) position of each joint, rad or m.
        picture: position, speed and acceleration of all joints, as shares of their limits.
    """

    time: np.ndarray
    q: dict[str, np.ndarray]
    picture: Picture


def motion_look(place: str, result: str) -> MotionPreview:
    """Returns a motion of `modeler excite` with its limits.

    Args:
        place: file of the motion.
        result: file of the result.
    """
    limits = _read_limits(result)
    motion = previews.read_motion(place, list(limits))
    q = {name: motion.q[:, j] for j, name in enumerate(limits)}
    return MotionPreview(motion.time, q, previews.draw_motion(motion, limits))


def motion_parquet(place: str, result: str) -> bytes:
    """Returns a motion as a Parquet file."""
    return previews.encode_motion(place, list(_read_limits(result)))


def _read_limits(result: str) -> dict[str, Any]:
    """Joints of a motion, with what it uses of their limits."""
    joints: dict[str, Any] = parse_json(read_text(Path(result)))["joints"]
    return joints


def _locate_error(error: str, text: str, table: TableText | None) -> tuple[int, int] | None:
    cell = locate_error_cell(error, text)
    if cell is None or table is None:
        return None
    row, column = cell
    return row, table.columns.index(column) if column in table.columns else -1


def _find_row_names(table: TableText | None, rows: list[str]) -> tuple[tuple[str, ...], ...]:
    """Of each written row the rows that it stands for: one for each leg of `2{i}`."""
    if table is None or "j" not in table.columns:
        return ()
    place, row_names = table.columns.index("j"), []
    for cells in table.rows:
        pattern = re.escape(cells[place] if place < len(cells) else "").replace(r"\{i\}", r"\w+")
        row_names.append(tuple(name for name in rows if re.fullmatch(pattern, name)))
    return tuple(row_names)


def _describe_joints(robot: Robot) -> tuple[JointFacts, ...]:
    limits = read_limit_texts(robot.text)
    shown = [joint for joint in robot.moving_joints if joint.name not in robot.platform]
    facts = []
    for joint in shown:
        effects = [u.effect for u in robot.effects if robot.has_effect(u.effect, joint.name)]
        own = limits.get(joint.name, ("", "", "", ""))
        facts.append(JointFacts(joint.name, joint.actuated, joint.unit, tuple(effects), own))
    return tuple(facts)
