"""A robot as it looks: what the scripts of its page work on, its table, its lines for people."""

import dataclasses
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import DataError, DerivationError, LoopError
from modeler.core.files import write_atomically
from modeler.core.json import entries
from modeler.core.table import aligned
from modeler.report.page import render, script_json
from modeler.report.robot_closing import CLOSED, Gap, Posture, gaps_of, home_posture
from modeler.report.robot_labels import good_view
from modeler.report.robot_scene import Part, Point, Scene, scene_of
from modeler.report.robot_skeleton import Skeleton, SkeletonRow, kind_word, poses, skeleton_of
from modeler.robot import JointKind, Robot, written_letter, written_table

_DIGITS = 7  # of coordinates of drawn points: finer than any screen


def page_content(
    skeleton: Skeleton, posture: Posture, further: Sequence[Part] = ()
) -> dict[str, Any]:
    """What the scripts of the page work on: the table in numbers, loops, ranges, drawn parts."""
    view = good_view(skeleton, posture)
    ranges = [_range(skeleton, posture, k) for k in range(len(skeleton.free))]
    return {
        "name": skeleton.robot.name,
        "size": posture.size,
        "stated": bool(skeleton.robot.home),
        "note": posture.note,
        **entries(posture, "closed held"),
        "loose": list(posture.loose),
        "rows": [_row(row, skeleton.robot) for row in skeleton.rows],
        "free": list(skeleton.free),
        "given": list(skeleton.given),
        "ranges": ranges,
        "home": posture.u.tolist(),
        "loops": [
            {
                "name": loop.name,
                "frame": skeleton.number(loop.frame),
                "meets": skeleton.number(loop.meets),
                "kind": loop.kind,
            }
            for loop in skeleton.robot.loops
        ],
        "gravity": skeleton.gravity.tolist(),
        "view": view.rotation.tolist(),
        "up": view.up.tolist(),
        **_parts(scene_of(skeleton, posture, further)),
    }


def _row(row: SkeletonRow, robot: Robot) -> dict[str, Any]:
    joint = row.joint
    used = np.flatnonzero(row.coefficients)
    return {
        **entries(joint, "name antecedent"),
        "parent": row.parent,
        "kind": kind_word(joint),
        "actuated": joint.actuated,
        "virtual": row.virtual,
        "unit": joint.unit,
        "cells": dict(row.cells),
        "texts": {name: getattr(joint, name).text for name in row.cells},
        "letters": {name: written_letter(robot, joint, name) for name in row.cells},
        **entries(row, "rate constant"),
        "terms": [[int(k), float(row.coefficients[k])] for k in used],
    }


def _range(skeleton: Skeleton, posture: Posture, k: int) -> list[float]:
    """Of a slider: [limits]; else a turn, or as far as the robot is large."""
    name, home = skeleton.free[k], float(posture.u[k])
    limits = skeleton.robot.limits.get(name)
    if limits is not None:
        return [min(limits.lower, home), max(limits.upper, home)]
    reach = 0.5 * posture.size if skeleton.travels[k] else np.pi
    return [home - reach, home + reach]


def _parts(scene: Scene) -> dict[str, Any]:
    """Every part as an object with its fields; points are lists [frame, x, y, z]."""
    return {
        "bulk": scene.radius,
        "sleeves": [_ends(sleeve.ends) for sleeve in scene.sleeves],
        "lines": [vars(line) | {"ends": _ends(line.ends)} for line in scene.lines],
        "faces": [
            vars(face) | {"points": np.round(face.points, _DIGITS).tolist()} for face in scene.faces
        ],
        "dots": [vars(dot) | {"at": _point(dot.at)} for dot in scene.dots],
        "labels": [vars(label) | {"at": _point(label.at)} for label in scene.labels],
    }


def _ends(ends: tuple[Point, Point]) -> list[list[float]]:
    return [_point(end) for end in ends]


def _point(point: Point) -> list[float]:
    return [point[0], *(round(x, _DIGITS) for x in point[1])]


# The table of a robot for people, and what stands beside it.


_LETTERS = {"gamma": "γ", "alpha": "α", "theta": "θ"}


@dataclass(frozen=True)
class TableRow:
    """One row of the table, as it is printed.

    Attributes:
        number: index of the joint.
        kind: "fixed", "actuated" or "passive".
        cells: joint, antecedent (if the table has it), mu, sigma.
        entries: (column of Khalil's, text, number of the row of Khalil's) of the columns that are
            used; the number is empty where there is no such row.
        platform: True for a row of the platform.
    """

    number: int
    kind: str
    cells: tuple[str, ...]
    entries: tuple[tuple[str, str, str], ...]
    platform: bool


def table_head(robot: Robot) -> tuple[str, ...]:
    """The names of the columns; those that are zero everywhere are left out."""
    table = written_table(robot)
    letters = (_LETTERS.get(letter, letter) for letter in table.units)
    return ("j", *([table.antecedent] if table.antecedent else []), "μ", "σ", *letters, "q")


def table_rows(robot: Robot) -> tuple[TableRow, ...]:
    """The rows in table order, the platform's last."""
    table, rows = written_table(robot), []
    numbers = {joint.name: str(i) for i, joint in enumerate(robot.joints)}
    for i, (joint, given) in enumerate(table.rows):
        kind = "fixed" if not joint.moves else "actuated" if joint.actuated else "passive"
        antecedent = [joint.antecedent] if table.antecedent else []
        cells = (joint.name, *antecedent, f"{joint.actuated:d}", f"{JointKind(joint.kind):d}")
        columns = tuple(
            (c.column, _typeset(c.expression.text), numbers[c.joint.name] if c.joint else "")
            for c in given.values()
        )
        rows.append(TableRow(i, kind, cells, columns, joint.name in robot.platform))
    return tuple(sorted(rows, key=lambda row: row.platform))


def _typeset(cell: str) -> str:
    """`pi/2` as it is printed; a minus as long as a minus."""
    return re.sub(r"\bpi\b", "π", cell).replace("-", "−")


def gravity_text(skeleton: Skeleton) -> str:
    """`gravity 9.81 m/s² along −z0`."""
    length = float(np.linalg.norm(skeleton.gravity))
    if length == 0.0:
        return "no gravity"
    along = skeleton.gravity / length
    k = int(np.argmax(np.abs(along)))
    if abs(along[k]) > 1.0 - 1e-12:
        return f"gravity {length:.4g} m/s² along {'−' if along[k] < 0 else '+'}{'xyz'[k]}0"
    return f"gravity {length:.4g} m/s² along ({', '.join(f'{x:.3g}' for x in along)})"


def relations_text(robot: Robot) -> str:
    """`q4 = -q3, q7 = q3`; nothing without relations."""
    return ", ".join(f"q{name} = {relation.text}" for name, relation in robot.relations.items())


# What is shown, in words and for machines.


_HEAD = ("j", "a", "joint", "q", "x", "y", "z", "axis")


def posture_lines(skeleton: Skeleton, posture: Posture) -> list[str]:
    """Lines for people: where every frame stands at home, and whether the loops close."""
    robot = skeleton.robot
    frames = poses(skeleton, posture.u)
    cells = [_HEAD, *(_cells(row, frames[i], posture) for i, row in enumerate(skeleton.rows))]
    table = [line.rstrip() for line in aligned(cells, (0, 1, 2, 7))]
    plain = gravity_text(skeleton).replace("\u2212", "-").replace("\u00b2", "2")
    lines = [robot.heading, plain]
    lines += ["frames at home: origin in frame 0 [m], direction of the joint's axis", *table]
    return [*lines, *_loop_lines(skeleton, posture)]


def _cells(row: SkeletonRow, frame: np.ndarray, posture: Posture) -> tuple[str, ...]:
    joint = row.joint
    kind = kind_word(joint)
    if joint.moves:
        kind += ", actuated" if joint.actuated else ", platform" if row.virtual else ", passive"
    q = _number(row.constant + row.coefficients @ posture.u) if joint.moves else ""
    return (joint.name, joint.antecedent, kind, q, *map(_number, frame[:3, 3]),
            _direction(frame[:3, 2]))  # fmt: skip


def _loop_lines(skeleton: Skeleton, posture: Posture) -> list[str]:
    lines = []
    for gap in gaps_of(skeleton, posture.u):
        loop = gap.loop
        state = "closed"
        if not _is_closed(gap, posture):
            angle = f" and {np.degrees(gap.angle):.3g} degrees" if gap.angle > CLOSED else ""
            state = f"OPEN by {gap.distance:.3g} m{angle}"
        lines.append(f'loop "{loop.name}": {loop.frame} meets {loop.meets} ({loop.kind}): {state}')
    if not posture.closed:
        where = "near [home]: drawn as it is stated"
        if not skeleton.robot.home:
            where = "near all joints at 0: drawn so"
        lines.append(
            f"the loops do not close {where}; move the joints by hand on the page, close the "
            "loops there, and copy [home]"
        )
    elif not posture.held:
        lines.append(
            "the loops do not close with the actuated joints as [home] states them: drawn nearby"
        )
    if posture.note:
        lines.append(posture.note)
    elif posture.loose:
        lines.append(
            f"joints {', '.join(posture.loose)} could move there with the actuated joints locked: "
            "[home] is singular, or the loops determine too little"
        )
    return lines


def posture_json(skeleton: Skeleton, posture: Posture) -> dict[str, Any]:
    """The same for machines: poses are 4x4 matrices, rows first, in frame 0, m."""
    frames = poses(skeleton, posture.u)
    return {
        "robot": skeleton.robot.name,
        "title": skeleton.robot.title,
        "coordinates": [skeleton.free[k] for k in skeleton.given],
        "home": {
            row.joint.variable: float(row.constant + row.coefficients @ posture.u)
            for row in skeleton.rows
            if row.joint.moves
        },
        "frames": [
            {**entries(row.joint, "name antecedent"), "joint": kind_word(row.joint),
             "actuated": row.joint.actuated, "pose": frames[i].tolist()}
            for i, row in enumerate(skeleton.rows)
        ],
        "loops": [
            {"loop": gap.loop.name, "frame": gap.loop.frame, "meets": gap.loop.meets,
             "joint": gap.loop.kind, "gap": gap.distance, "angle": gap.angle,
             "closed": _is_closed(gap, posture)}
            for gap in gaps_of(skeleton, posture.u)
        ],
        "closed": posture.closed,
        "as_stated": posture.held,
        "loose": list(posture.loose),
        "note": posture.note,
        "gravity": skeleton.gravity.tolist(),
    }  # fmt: skip


def _is_closed(gap: Gap, posture: Posture) -> bool:
    return gap.distance < 10.0 * CLOSED * posture.size and gap.angle < 10.0 * CLOSED


def _number(x: float) -> str:
    return f"{0.0 if abs(x) < 5e-5 else x:.4f}"


def _direction(z: np.ndarray) -> str:
    """`+z`, `-y`, or its three components."""
    k = int(np.argmax(np.abs(z)))
    if abs(z[k]) > 1.0 - 1e-9:
        return f"{'-' if z[k] < 0 else '+'}{'xyz'[k]}0"
    return " ".join(f"{0.0 if abs(x) < 5e-4 else x:.3f}" for x in z)


def robot_html(skeleton: Skeleton, posture: Posture, further: Sequence[Part] = ()) -> str:
    """The page as text, with further parts; its security policy forbids any network access."""
    robot = skeleton.robot
    return render(
        "robot",
        title=f"{robot.name}: skeleton",
        about={"command": "show", "title": f"{robot.name}: skeleton", "verdict": robot.title},
        robot=robot,
        notes=" ".join(robot.notes.split()),
        posture=posture.note,
        gravity=gravity_text(skeleton),
        head=table_head(robot),
        rows=table_rows(robot),
        relations=relations_text(robot),
        step=written_table(robot).step,
        content=script_json(page_content(skeleton, posture, further)),
    )


def modes_html(name: str, title: str, count: int, svg: str) -> str:
    """The page of a robot's assembly modes.

    Args:
        name: of the robot.
        title: of the robot.
        count: of modes.
        svg: the picture of them all, as our own drawer makes it.
    """
    drawn = svg[svg.index("<svg") :]
    return render("modes", title=f"{name}: assembly modes", robot=title, count=count, svg=drawn)


# A robot as it looks in the posture that every other command starts from.


PICTURE_KINDS = (".png", ".svg", ".pdf")
"""Of the picture of a robot."""


@dataclass(frozen=True)
class ShownRobot(Brief):
    """A robot as it is drawn: its table in numbers, and where its joints stand."""

    skeleton: Skeleton
    posture: Posture


def show(
    robot: Robot, page: str | Path | None = None, picture: str | Path | None = None
) -> ShownRobot:
    """Draw a robot at its [home], found where that is missing or poor.

    >>> show(robot, "arm.html").skeleton.robot.name
    'two-link'

    What cannot be derived (loops that do not close, or are singular at [home]) is drawn as it is
    stated; `posture.note` says so.

    Args:
        robot: as read.
        page: HTML file to write, with sliders; it needs no other file.
        picture: file to write, .png, .svg or .pdf, as wide as a column of a paper.

    Raises:
        DataError: the picture's name ends in something else.
        ModelerError: a file cannot be written.
    """
    kind = "" if picture is None else _kind(Path(picture))
    found = _shown(robot)
    contents: list[tuple[str | Path, str | bytes]] = []
    if page is not None:
        contents.append((page, robot_html(found.skeleton, found.posture)))
    if picture is not None:
        from modeler.report.robot_drawing import picture_bytes

        contents.append((picture, picture_bytes(found.skeleton, found.posture, kind)))
    for place, content in contents:
        write_atomically(Path(place), content)
    return found


def robot_text(robot: Robot) -> str:
    """The page of a robot."""
    found = _shown(robot)
    return robot_html(found.skeleton, found.posture)


def _kind(picture: Path) -> str:
    kind = picture.suffix.lower()
    if kind not in PICTURE_KINDS:
        raise DataError(
            f"{picture}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(PICTURE_KINDS)}"
        )
    return kind


def _shown(robot: Robot) -> ShownRobot:
    note = ""
    if robot.loops:
        from modeler.derivation import with_home  # only loops need symbols

        try:
            home = with_home(robot)
            robot, note = home.robot, home.told
        except (LoopError, DerivationError) as error:
            note = str(error)
    skeleton = skeleton_of(robot)
    return ShownRobot(skeleton, dataclasses.replace(home_posture(skeleton), note=note))
