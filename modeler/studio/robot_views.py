"""What the process of the viewer answers about robots: a text as a picture, or what is wrong in it.

Every function takes the text of a robot file; nothing is read from it but what the reader of robot
files reads.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from modeler import excitation, simulation
from modeler.core.errors import ModelerError
from modeler.core.figure import COLORS, GREY, Curve, Panel, Picture, Style
from modeler.core.files import read_file
from modeler.core.json import parse_json
from modeler.formats import read_robot
from modeler.robot import (
    Robot,
    TableText,
    find_table_text,
    locate_error_cell,
    parse_robot_text,
    read_limit_texts,
    read_symbol_texts,
)
from modeler.views import build_page_content, render_relations, render_robot_page, show

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
        shown = show(robot)
        content = build_page_content(shown.skeleton, shown.posture)
    except ModelerError as error:
        match = re.search(r": \[(symbols|limits)\], \"?(\w+)", str(error))
        named_entry = match.groups() if match else ()
        return RobotPreview(str(error), _locate_error(str(error), text, table), table, named_entry)
    rows = [joint.name for joint in robot.joints]
    return RobotPreview(
        "",
        None,
        table,
        (),
        _find_row_names(table, rows),
        robot.name,
        robot.readings,
        _describe_joints(robot),
        tuple(joint.name for joint in robot.moving_joints if joint.actuated),
        tuple(read_symbol_texts(text).items()),
        content,
    )


def robot_page(text: str) -> str:
    """Returns the page of `modeler show`."""
    shown = show(parse_robot_text(text, "robot.toml"))
    return render_robot_page(shown.skeleton, shown.posture)


def relations_of(result: str, place: str) -> tuple[str, dict[str, Any]]:
    """Returns the base parameters of a derivation as HTML, and its other facts.

    Args:
        result: file of the result.
        place: of the robot file that was derived.
    """
    derivation = parse_json(read_file(Path(result)))
    facts = {
        key: derivation[key] for key in ("rank", "counts", "proof", "rank_gap", "unidentifiable")
    }
    return render_relations(derivation, read_robot(place)), facts


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
    joints, motion = _read_motion(place, result)
    panels = []
    for title, of, label in (
        ("position", motion.q, "of its range"),
        ("speed", motion.qd, "of the limit"),
        ("acceleration", motion.qdd, "of the limit"),
    ):
        curves = [
            Curve(
                f"joint {name}",
                motion.time,
                _normalise_to_limits(title, of[:, j], limits),
                _choose_style(j),
            )
            for j, (name, limits) in enumerate(joints.items())
        ]
        ends = motion.time[[0, -1]]
        edges = Curve("limits", np.array([*ends, np.nan, *ends]), _SIDES, _EDGE)
        label = f"{title}, {label}"
        series = (*curves, edges)
        panels.append((Panel("", "time [s]", label, series, y_range=(-1.1, 1.1), zero=True),))
    picture = Picture("motion", "", "Shares of the limits of each joint; the dashed lines are the "
                      "limits.", tuple(panels), 560, shared_time=True)  # fmt: skip
    q = {name: motion.q[:, j] for j, name in enumerate(joints)}
    return MotionPreview(motion.time, q, picture)


def motion_parquet(place: str, result: str) -> bytes:
    """Returns a motion as a Parquet file."""
    joints, motion = _read_motion(place, result)
    columns = {"time": motion.time}
    for name, of in (("q", motion.q), ("qd", motion.qd), ("qdd", motion.qdd)):
        columns |= {f"{name}{joint}": of[:, j] for j, joint in enumerate(joints)}
    return excitation.encode_parquet(columns)


_SIDES = np.array([1.0, 1.0, np.nan, -1.0, -1.0])
_EDGE = Style(GREY, 1.0, dash=True)


def _choose_style(number: int) -> Style:
    return Style(COLORS[number % len(COLORS)], dash=number >= len(COLORS))


def _read_motion(place: str, result: str) -> tuple[dict[str, Any], simulation.Reference]:
    joints = parse_json(read_file(Path(result)))["joints"]
    return joints, simulation.read_motion(place, list(joints))


def _normalise_to_limits(what: str, values: np.ndarray, limits: dict[str, Any]) -> np.ndarray:
    """-1 to 1 within the limits."""
    if what != "position":
        return values / float(limits[what]["limit"])
    lower, upper = limits["lower"]["limit"], limits["upper"]["limit"]
    return (2.0 * values - lower - upper) / (upper - lower)


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
    return tuple(
        JointFacts(
            joint.name, joint.actuated, joint.unit,
            tuple(effect for effect in BASIC_EFFECTS if robot.has_effect(effect, joint.name)),
            limits.get(joint.name, ("", "", "", "")),
        )
        for joint in shown
    )  # fmt: skip
