"""A robot as it looks: what the scripts of its page work on, its table, its lines for people."""

import dataclasses
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError, DerivationError, LoopError
from modeler.core.files import write_atomically
from modeler.core.json import ShortRepr, select_attributes
from modeler.core.table import align_columns
from modeler.excitation import BASE as STILL, ClosestApproach, CollisionGeometry, MotionBounds
from modeler.robot import JointKind, Robot, build_written_table, get_written_letter
from modeler.views import robot_scene
from modeler.views.page import encode_script_json, render_template
from modeler.views.robot_skeleton import (
    BASE,
    LoopGap,
    Posture,
    Skeleton,
    SkeletonRow,
    build_skeleton,
    compute_gaps,
    compute_poses,
    estimate_robot_size,
    find_home_posture,
    format_joint_kind,
)
from modeler.views.thresholds import THRESHOLDS

_DIGITS = 7  # of coordinates of drawn points: finer than any screen


def build_page_content(
    skeleton: Skeleton, posture: Posture, further: Sequence[robot_scene.Part] = ()
) -> dict[str, Any]:
    """Builds the data of the page's scripts: the table in numbers, loops, ranges, drawn parts."""
    view = robot_scene.choose_view(skeleton, posture)
    ranges = [_choose_slider_range(skeleton, posture, k) for k in range(len(skeleton.free))]
    return {
        "name": skeleton.robot.name,
        "size": posture.size,
        "has_stated_home": bool(skeleton.robot.home),
        "note": posture.note,
        **select_attributes(posture, "is_closed is_as_stated"),
        "loose_joints": list(posture.loose_joints),
        "rows": [_describe_row(row, skeleton.robot) for row in skeleton.rows],
        "variables": list(skeleton.free),
        "actuated_variables": list(skeleton.independent_places),
        "ranges": ranges,
        "home": posture.u.tolist(),
        "loops": [
            {
                "name": loop.name,
                "frame": skeleton.find_row(loop.frame),
                "meets": skeleton.find_row(loop.meets),
                "kind": loop.kind,
            }
            for loop in skeleton.robot.loops
        ],
        "gravity": skeleton.gravity.tolist(),
        "view": view.rotation.tolist(),
        "up": view.up.tolist(),
        **_describe_parts(robot_scene.build_scene(skeleton, posture, further)),
    }


def _describe_row(row: SkeletonRow, robot: Robot) -> dict[str, Any]:
    joint = row.joint
    used = np.flatnonzero(row.coefficients)
    return {
        **select_attributes(joint, "name antecedent"),
        "parent": row.parent,
        "kind": format_joint_kind(joint),
        "actuated": joint.actuated,
        "is_virtual": row.is_virtual,
        "unit": joint.unit,
        "cells": dict(row.cells),
        "texts": {name: getattr(joint, name).text for name in row.cells},
        "letters": {name: get_written_letter(robot, joint, name) for name in row.cells},
        **select_attributes(row, "rate constant"),
        "terms": [[int(k), float(row.coefficients[k])] for k in used],
    }


def _choose_slider_range(skeleton: Skeleton, posture: Posture, k: int) -> list[float]:
    """Of a slider: [limits]; else a turn, or as far as the robot is large."""
    name, home = skeleton.free[k], float(posture.u[k])
    limits = skeleton.robot.limits.get(name)
    if limits is not None:
        return [min(limits.lower, home), max(limits.upper, home)]
    reach = 0.5 * posture.size if skeleton.is_travel[k] else np.pi
    return [home - reach, home + reach]


def _describe_parts(scene: robot_scene.Scene) -> dict[str, Any]:
    """Every part as an object with its fields; points are lists [frame, x, y, z]."""
    return {
        "bulk": scene.radius,
        "sleeves": [_convert_ends(sleeve.ends) for sleeve in scene.sleeves],
        "lines": [vars(line) | {"ends": _convert_ends(line.ends)} for line in scene.lines],
        "faces": [
            vars(face) | {"points": np.round(face.points, _DIGITS).tolist()} for face in scene.faces
        ],
        "dots": [vars(dot) | {"at": _convert_point(dot.at)} for dot in scene.dots],
        "labels": [vars(label) | {"at": _convert_point(label.at)} for label in scene.labels],
    }


def _convert_ends(ends: tuple[robot_scene.Point, robot_scene.Point]) -> list[list[float]]:
    return [_convert_point(end) for end in ends]


def _convert_point(point: robot_scene.Point) -> list[float]:
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


def build_table_head(robot: Robot) -> tuple[str, ...]:
    """Returns the names of the columns; those that are zero everywhere are left out."""
    table = build_written_table(robot)
    letters = (_LETTERS.get(letter, letter) for letter in table.units)
    return ("j", *([table.antecedent] if table.antecedent else []), "μ", "σ", *letters, "q")


def build_table_rows(robot: Robot) -> tuple[TableRow, ...]:
    """Returns the rows in table order, the platform's last."""
    table, rows = build_written_table(robot), []
    numbers = {joint.name: str(i) for i, joint in enumerate(robot.joints)}
    for i, (joint, row_cells) in enumerate(table.rows):
        kind = "fixed" if not joint.is_moving else "actuated" if joint.actuated else "passive"
        antecedent = [joint.antecedent] if table.antecedent else []
        cells = (joint.name, *antecedent, f"{joint.actuated:d}", f"{JointKind(joint.kind):d}")
        columns = tuple(
            (c.column, _typeset_cell(c.expression.text), numbers[c.joint.name] if c.joint else "")
            for c in row_cells.values()
        )
        rows.append(TableRow(i, kind, cells, columns, joint.name in robot.platform))
    return tuple(sorted(rows, key=lambda row: row.platform))


def _typeset_cell(cell: str) -> str:
    """`pi/2` as it is printed; a minus as long as a minus."""
    return re.sub(r"\bpi\b", "π", cell).replace("-", "−")


def describe_gravity(skeleton: Skeleton) -> str:
    """Describes gravity: `gravity 9.81 m/s² along −z0`."""
    length = float(np.linalg.norm(skeleton.gravity))
    if length == 0.0:
        return "no gravity"
    along = skeleton.gravity / length
    k = int(np.argmax(np.abs(along)))
    if abs(along[k]) > 1.0 - 1e-12:
        return f"gravity {length:.4g} m/s² along {'−' if along[k] < 0 else '+'}{'xyz'[k]}0"
    return f"gravity {length:.4g} m/s² along ({', '.join(f'{x:.3g}' for x in along)})"


def format_relations(robot: Robot) -> str:
    """Formats the relations: `q4 = -q3, q7 = q3`; nothing without any."""
    return ", ".join(f"q{name} = {relation.text}" for name, relation in robot.relations.items())


# What is shown, in words and for machines.


_HEAD = ("j", "a", "joint", "q", "x", "y", "z", "axis")


def describe_posture(skeleton: Skeleton, posture: Posture) -> list[str]:
    """Describes where every frame stands at home, and whether the loops close."""
    robot = skeleton.robot
    frames = compute_poses(skeleton, posture.u)
    cells = [
        _HEAD,
        *(_format_frame_row(row, frames[i], posture) for i, row in enumerate(skeleton.rows)),
    ]
    table = [line.rstrip() for line in align_columns(cells, (0, 1, 2, 7))]
    plain = describe_gravity(skeleton).replace("\u2212", "-").replace("\u00b2", "2")
    lines = [robot.heading, plain]
    lines += ["frames at home: origin in frame 0 [m], direction of the joint's axis", *table]
    return [*lines, *_describe_loops(skeleton, posture)]


def _format_frame_row(row: SkeletonRow, frame: np.ndarray, posture: Posture) -> tuple[str, ...]:
    joint = row.joint
    kind = format_joint_kind(joint)
    if joint.is_moving:
        kind += ", actuated" if joint.actuated else ", platform" if row.is_virtual else ", passive"
    q = _format_number(row.constant + row.coefficients @ posture.u) if joint.is_moving else ""
    return (
        joint.name,
        joint.antecedent,
        kind,
        q,
        *map(_format_number, frame[:3, 3]),
        _format_direction(frame[:3, 2]),
    )


def _describe_loops(skeleton: Skeleton, posture: Posture) -> list[str]:
    lines = []
    for gap in compute_gaps(skeleton, posture.u):
        loop = gap.loop
        state = "closed"
        if not _is_closed(gap, posture):
            angle = (
                f" and {np.degrees(gap.angle):.3g} degrees"
                if gap.angle > THRESHOLDS.max_loop_residual
                else ""
            )
            state = f"OPEN by {gap.distance:.3g} m{angle}"
        lines.append(f'loop "{loop.name}": {loop.frame} meets {loop.meets} ({loop.kind}): {state}')
    if not posture.is_closed:
        where = "near [home]: drawn as it is stated"
        if not skeleton.robot.home:
            where = "near all joints at 0: drawn so"
        lines.append(
            f"the loops do not close {where}; move the joints by hand on the page, close the "
            "loops there, and copy [home]"
        )
    elif not posture.is_as_stated:
        lines.append(
            "the loops do not close with the actuated joints as [home] states them: drawn nearby"
        )
    if posture.note:
        lines.append(posture.note)
    elif posture.loose_joints:
        lines.append(
            f"joints {', '.join(posture.loose_joints)} could move there with the actuated joints "
            "locked: [home] is singular, or the loops determine too little"
        )
    return lines


def serialise_posture(skeleton: Skeleton, posture: Posture) -> dict[str, Any]:
    """Returns the posture as plain data: poses are 4x4 matrices, rows first, in frame 0, m."""
    frames = compute_poses(skeleton, posture.u)
    return {
        "robot": skeleton.robot.name,
        "title": skeleton.robot.title,
        "coordinates": [skeleton.free[k] for k in skeleton.independent_places],
        "home": {
            row.joint.variable: float(row.constant + row.coefficients @ posture.u)
            for row in skeleton.rows
            if row.joint.is_moving
        },
        "frames": [
            {**select_attributes(row.joint, "name antecedent")}
            | {"joint": format_joint_kind(row.joint), "actuated": row.joint.actuated}
            | {"pose": frame.tolist()}
            for row, frame in zip(skeleton.rows, frames, strict=True)
        ],
        "loops": [
            {"loop": gap.loop.name, **select_attributes(gap.loop, "frame meets")}
            | {"joint": gap.loop.kind, "gap": gap.distance, "angle": gap.angle}
            | {"is_closed": _is_closed(gap, posture)}
            for gap in compute_gaps(skeleton, posture.u)
        ],
        "is_closed": posture.is_closed,
        "is_as_stated": posture.is_as_stated,
        "loose_joints": list(posture.loose_joints),
        "note": posture.note,
        "gravity": skeleton.gravity.tolist(),
    }


def _is_closed(gap: LoopGap, posture: Posture) -> bool:
    return (
        gap.distance < 10.0 * THRESHOLDS.max_loop_residual * posture.size
        and gap.angle < 10.0 * THRESHOLDS.max_loop_residual
    )


def _format_number(x: float) -> str:
    return f"{0.0 if abs(x) < 5e-5 else x:.4f}"


def _format_direction(z: np.ndarray) -> str:
    """`+z`, `-y`, or its three components."""
    k = int(np.argmax(np.abs(z)))
    if abs(z[k]) > 1.0 - 1e-9:
        return f"{'-' if z[k] < 0 else '+'}{'xyz'[k]}0"
    return " ".join(f"{0.0 if abs(x) < 5e-4 else x:.3f}" for x in z)


def render_robot_page(
    skeleton: Skeleton, posture: Posture, further: Sequence[robot_scene.Part] = ()
) -> str:
    """Renders the page with further parts; its security policy forbids any network access."""
    robot = skeleton.robot
    return render_template(
        "robot",
        title=f"{robot.name}: skeleton",
        about={"command": "show", "title": f"{robot.name}: skeleton", "verdict": robot.title},
        robot=robot,
        notes=" ".join(robot.notes.split()),
        posture=posture.note,
        gravity=describe_gravity(skeleton),
        head=build_table_head(robot),
        rows=build_table_rows(robot),
        relations=format_relations(robot),
        step=build_written_table(robot).step,
        content=encode_script_json(build_page_content(skeleton, posture, further)),
    )


def render_modes_page(name: str, title: str, count: int, svg: str) -> str:
    """Renders the page of a robot's assembly modes.

    Args:
        name: of the robot.
        title: of the robot.
        count: of modes.
        svg: the picture of them all, as our own drawer makes it.
    """
    drawn = svg[svg.index("<svg") :]
    return render_template(
        "modes", title=f"{name}: assembly modes", robot=title, count=count, svg=drawn
    )


# A robot as it looks in the posture that every other command starts from.


PICTURE_KINDS = (".png", ".svg", ".pdf")
"""Of the picture of a robot."""


@dataclass(frozen=True)
class ShownRobot(ShortRepr):
    """A robot as it is drawn: its table in numbers, and where its joints stand."""

    skeleton: Skeleton
    posture: Posture


def show(
    robot: Robot, page: str | Path | None = None, picture: str | Path | None = None
) -> ShownRobot:
    """Draws a robot at its [home], which is solved where it is missing or poor.

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
    kind = "" if picture is None else _check_picture_kind(Path(picture))
    shown_robot = _prepare_robot(robot)
    contents: list[tuple[str | Path, str | bytes]] = []
    if page is not None:
        contents.append((page, render_robot_page(shown_robot.skeleton, shown_robot.posture)))
    if picture is not None:
        from modeler.views.robot_drawing import render_picture

        contents.append((picture, render_picture(shown_robot.skeleton, shown_robot.posture, kind)))
    for place, content in contents:
        write_atomically(Path(place), content)
    return shown_robot


def render_robot(robot: Robot) -> str:
    """Renders the page of a robot."""
    shown_robot = _prepare_robot(robot)
    return render_robot_page(shown_robot.skeleton, shown_robot.posture)


def _check_picture_kind(picture: Path) -> str:
    kind = picture.suffix.lower()
    if kind not in PICTURE_KINDS:
        raise DataError(
            f"{picture}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(PICTURE_KINDS)}"
        )
    return kind


def _prepare_robot(robot: Robot) -> ShownRobot:
    note = ""
    if robot.loops:
        from modeler.derivation import complete_home  # only loops need symbols

        try:
            home = complete_home(robot)
            robot, note = home.robot, home.message
        except (LoopError, DerivationError) as error:
            note = str(error)
    skeleton = build_skeleton(robot)
    return ShownRobot(skeleton, dataclasses.replace(find_home_posture(skeleton), note=note))


# The page of a robot where two of its links come nearest: its capsules, and these two in red.


_CLEAR = 0.22  # opacity


def render_nearest_page(robot: Robot, bounds: MotionBounds, near: ClosestApproach) -> str:
    """Renders the page of the posture where two links are nearest.

    Args:
        robot: as read.
        bounds: with a clearance.
        near: where two come nearest.
    """
    assert bounds.clearance is not None
    skeleton = build_skeleton(robot)
    stated = zip(skeleton.free, skeleton.stated.tolist(), strict=True)
    u = np.array([near.posture.get(name, otherwise) for name, otherwise in stated])
    line = bounds.clearance.format_line(near)
    posture = Posture(
        u, estimate_robot_size(skeleton, u), True, True, note=f"{line[0].upper()}{line[1:]}."
    )
    parts = [*_build_capsules(skeleton, bounds.clearance.solids, near.pair), *_mark_gap(near)]
    return render_robot_page(skeleton, posture, parts)


def _mark_gap(near: ClosestApproach) -> Iterator[robot_scene.Part]:
    """The way between the two."""
    one, other = ((BASE, (float(p[0]), float(p[1]), float(p[2]))) for p in near.points)
    yield robot_scene.SceneLine(BASE, (one, other), robot_scene.OPEN, 3.0, "gap")
    yield robot_scene.Label(BASE, one, f"{1e3 * near.distance:.1f} mm", robot_scene.OPEN, "names")


def _build_capsules(
    skeleton: Skeleton, solids: CollisionGeometry, pair: tuple[str, str]
) -> Iterator[robot_scene.Face]:
    """All capsules, each on its link; planes are not drawn."""
    moving = [i for i, row in enumerate(skeleton.rows) if row.joint.is_moving]
    for k, name in enumerate(solids.names[: len(solids.ends)]):
        carrier = int(solids.carriers[k])
        frame = BASE if carrier == STILL else moving[carrier]
        color = (
            robot_scene.OPEN if name in pair else robot_scene.BODIES[k % len(robot_scene.BODIES)]
        )
        for points in _build_capsule(solids.ends[k], float(solids.radius[k])):
            yield robot_scene.Face(frame, frame, points, color, "capsules", _CLEAR)


def _build_capsule(ends: np.ndarray, radius: float) -> Iterator[np.ndarray]:
    """Polygons of it."""
    way = ends[1] - ends[0]
    length = float(np.linalg.norm(way))
    for end in ends if length else ends[:1]:
        yield from (points + end for points in robot_scene.build_ball(radius))
    if length:
        # A turn that takes z along the way: columns of a QR factorisation that begins with it.
        turn = np.linalg.qr(np.column_stack([way, np.eye(3)]))[0][:, [1, 2, 0]]
        for points in robot_scene.build_cylinder(radius, length)[:-2]:
            yield points @ turn.T + ends.mean(axis=0)
