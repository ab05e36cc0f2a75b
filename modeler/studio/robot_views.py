"""What the process of the viewer answers about robots: a text as a picture, or what is wrong in it.

Every function takes the text of a robot file; nothing is read from it but what the reader of robot
files reads.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from modeler.core.errors import ModelerError
from modeler.core.files import read_file
from modeler.core.json import parse_json
from modeler.report import page_content, relations_html, robot_html, show
from modeler.robot import (
    Robot,
    TableText,
    cell_of,
    read_robot,
    robot_from_text,
    table_text,
    written_limits,
)

BASIC_EFFECTS = ("rotor_inertia", "viscous", "coulomb", "offset")
"""Columns of the grid of effects."""


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
class RobotLook:
    """A text, looked at.

    Attributes:
        error: the line of the reader; "" where nothing is wrong.
        wrong: row and column of the cell that it is about, -1 for names of columns or all of a row.
        table: cells as they are written; None where no table is found.
        names: rows of the robot that each row of the table stands for.
        name: of the robot.
        notes: what reading it decided.
        joints: that move; empty where something is wrong.
        everyone: joints that "all" means in [effects].
        content: what the page draws; None where something is wrong.
    """

    error: str
    wrong: tuple[int, int] | None
    table: TableText | None
    names: tuple[tuple[str, ...], ...] = ()
    name: str = ""
    notes: tuple[str, ...] = ()
    joints: tuple[JointFacts, ...] = ()
    everyone: tuple[str, ...] = ()
    content: dict[str, Any] | None = field(default=None, repr=False)


def robot_look(text: str, where: str = "robot.toml") -> RobotLook:
    """The picture of a robot's text, or what is wrong and in which cell."""
    table = table_text(text)
    try:
        robot = robot_from_text(text, where)
        shown = show(robot)
        content = page_content(shown.skeleton, shown.posture)
    except ModelerError as error:
        return RobotLook(str(error), _wrong(str(error), text, table), table)
    rows = [joint.name for joint in robot.joints]
    return RobotLook(
        "", None, table, _names(table, rows), robot.name, robot.readings, _joints(robot),
        tuple(joint.name for joint in robot.moving if joint.actuated), content,
    )  # fmt: skip


def robot_page(text: str) -> str:
    """The page of `modeler show`."""
    shown = show(robot_from_text(text, "robot.toml"))
    return robot_html(shown.skeleton, shown.posture)


def relations_of(result: str, place: str) -> tuple[str, dict[str, Any]]:
    """The base parameters that `modeler derive --json` wrote, as HTML, and the rest of the result.

    Args:
        result: file of the result.
        place: of the robot file that was derived.
    """
    found = parse_json(read_file(Path(result)))
    told = {key: found[key] for key in ("rank", "counts", "proof", "rank_gap", "unidentifiable")}
    return relations_html(found, read_robot(place)), told


def _wrong(error: str, text: str, table: TableText | None) -> tuple[int, int] | None:
    found = cell_of(error, text)
    if found is None or table is None:
        return None
    row, column = found
    return row, table.columns.index(column) if column in table.columns else -1


def _names(table: TableText | None, rows: list[str]) -> tuple[tuple[str, ...], ...]:
    """Of each written row the rows that it stands for: one for each leg of `2{i}`."""
    if table is None or "j" not in table.columns:
        return ()
    place, found = table.columns.index("j"), []
    for cells in table.rows:
        pattern = re.escape(cells[place] if place < len(cells) else "").replace(r"\{i\}", r"\w+")
        found.append(tuple(name for name in rows if re.fullmatch(pattern, name)))
    return tuple(found)


def _joints(robot: Robot) -> tuple[JointFacts, ...]:
    limits = written_limits(robot.text)
    shown = [joint for joint in robot.moving if joint.name not in robot.platform]
    return tuple(
        JointFacts(
            joint.name, joint.actuated, joint.unit,
            tuple(effect for effect in BASIC_EFFECTS if robot.has_effect(effect, joint.name)),
            limits.get(joint.name, ("", "", "", "")),
        )
        for joint in shown
    )  # fmt: skip
