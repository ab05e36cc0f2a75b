"""What the scripts of a robot's page work on, as plain data."""

from typing import Any

import numpy as np

from modeler.show.closing import Posture
from modeler.show.scene import Face, Line, Point, Scene, scene_of
from modeler.show.skeleton import Row, Skeleton, kind_word
from modeler.show.view import good_view

_DIGITS = 7  # of coordinates of drawn points: finer than any screen


def page_content(skeleton: Skeleton, posture: Posture) -> dict[str, Any]:
    """What the scripts of the page work on: the table in numbers, loops, ranges, drawn parts."""
    view = good_view(skeleton, posture)
    ranges = [_range(skeleton, posture, k) for k in range(len(skeleton.free))]
    return {
        "name": skeleton.robot.name,
        "size": posture.size,
        "stated": bool(skeleton.robot.home),
        "closed": posture.closed,
        "held": posture.held,
        "loose": list(posture.loose),
        "rows": [_row(row) for row in skeleton.rows],
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
        **_parts(scene_of(skeleton, posture)),
    }


def _row(row: Row) -> dict[str, Any]:
    joint = row.joint
    used = np.flatnonzero(row.coefficients)
    return {
        "name": joint.name,
        "antecedent": joint.antecedent,
        "parent": row.parent,
        "kind": kind_word(joint),
        "actuated": joint.actuated,
        "virtual": row.virtual,
        "unit": joint.unit,
        "cells": dict(row.cells),
        "texts": {name: getattr(joint, name).text for name in row.cells},
        "rate": row.rate,
        "constant": row.constant,
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
    return {
        "bulk": scene.radius,
        "sleeves": [[_point(end) for end in sleeve.ends] for sleeve in scene.sleeves],
        "lines": [_line(line) for line in scene.lines],
        "faces": [_face(face) for face in scene.faces],
        "dots": [
            {"row": d.row, "at": _point(d.at), "color": d.color, "radius": d.radius,
             "layer": d.layer}
            for d in scene.dots
        ],
        "labels": [
            {"row": x.row, "at": _point(x.at), "text": x.text, "color": x.color, "layer": x.layer}
            for x in scene.labels
        ],
    }  # fmt: skip


def _line(line: Line) -> dict[str, Any]:
    return {
        "row": line.row,
        "ends": [_point(end) for end in line.ends],
        "color": line.color,
        "width": line.width,
        "layer": line.layer,
        "arrow": line.arrow,
        "dashed": line.dashed,
    }


def _face(face: Face) -> dict[str, Any]:
    return {
        "row": face.row,
        "frame": face.frame,
        "points": np.round(face.points, _DIGITS).tolist(),
        "color": face.color,
        "layer": face.layer,
        "opacity": face.opacity,
    }


def _point(point: Point) -> list[float]:
    return [point[0], *(round(x, _DIGITS) for x in point[1])]
