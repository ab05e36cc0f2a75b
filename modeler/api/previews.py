"""A robot and its motions as a front end shows them: page, base parameters, shares of limits."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.figure import COLORS, GREY, Curve, Panel, Picture, Style
from modeler.excitation import encode_parquet
from modeler.robot import Robot
from modeler.simulation import Reference, read_motion as read_motion
from modeler.views import (
    build_page_content,
    render_relations as render_relations,
    render_robot_page,
    show,
)

_EDGES = np.array([1.0, 1.0, np.nan, -1.0, -1.0])
_OF_LIMITS = (("position", "its range"), ("speed", "the limit"), ("acceleration", "the limit"))


def build_robot_content(robot: Robot) -> dict[str, Any]:
    """Builds what the scripts of a robot's page draw."""
    shown = show(robot)
    return build_page_content(shown.skeleton, shown.posture)


def render_robot(robot: Robot) -> str:
    """Returns the page of a robot, as `modeler show` writes it."""
    shown = show(robot)
    return render_robot_page(shown.skeleton, shown.posture)


def draw_motion(motion: Reference, joints: Mapping[str, Any]) -> Picture:
    """Draws position, speed and acceleration of all joints, as shares of their limits.

    Args:
        motion: columns in the order of the joints.
        joints: by name, their limits as the JSON of `modeler excite` has them.
    """
    panels = []
    for values, (title, whole) in zip((motion.q, motion.qd, motion.qdd), _OF_LIMITS, strict=True):
        curves = []
        for j, (name, limits) in enumerate(joints.items()):
            style = Style(COLORS[j % len(COLORS)], dash=j >= len(COLORS))
            share = _normalise_to_limits(title, values[:, j], limits)
            curves.append(Curve(f"joint {name}", motion.time, share, style))
        ends = motion.time[[0, -1]]
        edges = np.array([*ends, np.nan, *ends])
        curves.append(Curve("limits", edges, _EDGES, Style(GREY, 1.0, dash=True)))
        label, drawn = f"{title}, of {whole}", tuple(curves)
        panels.append((Panel("", "time [s]", label, drawn, y_range=(-1.1, 1.1), zero=True),))
    caption = "Shares of the limits of each joint; the dashed lines are the limits."
    return Picture("motion", "", caption, tuple(panels), 560, shared_time=True)


def _normalise_to_limits(what: str, values: np.ndarray, limits: Mapping[str, Any]) -> np.ndarray:
    """-1 to 1 within the limits."""
    if what != "position":
        return values / float(limits[what]["limit"])
    lower, upper = limits["lower"]["limit"], limits["upper"]["limit"]
    return (2.0 * values - lower - upper) / (upper - lower)


def encode_motion(path: str | Path, joints: list[str]) -> bytes:
    """Returns the motion of a file as Parquet: time, and q, qd, qdd of each joint."""
    motion = read_motion(path, joints)
    columns = {"time": motion.time}
    for name, values in (("q", motion.q), ("qd", motion.qd), ("qdd", motion.qdd)):
        columns |= {f"{name}{joint}": values[:, j] for j, joint in enumerate(joints)}
    return encode_parquet(columns)
