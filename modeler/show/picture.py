"""The skeleton as a picture for papers: one column wide."""

from dataclasses import replace
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from modeler.show.closing import Posture
from modeler.show.names import Name, placed_names
from modeler.show.paper import SETTINGS, Sheet, arrow, draw_parts, outline, paper, saved
from modeler.show.pose import poses
from modeler.show.scene import Scene, gap_lines, scene_of
from modeler.show.skeleton import Skeleton
from modeler.show.view import good_view

_WIDTH, _LEAST, _MOST = 252.0, 130.0, 300.0  # points: a column, and heights
_MARGIN = 26.0
_HIDDEN = ("loop names", "masses")
_GREY, _GRAVITY = "#5c5c62", "#6b4fa0"


def picture_bytes(skeleton: Skeleton, posture: Posture, suffix: str) -> bytes:
    """The picture as a file of that kind, 3.5 inches wide, without a date or version.

    Args:
        skeleton: the robot.
        posture: as it stands.
        suffix: one of `PICTURE_KINDS`; ".png" has 400 dots per inch.
    """
    with matplotlib.rc_context(SETTINGS):
        return saved(_drawn(skeleton, posture), suffix)


def picture_figure(skeleton: Skeleton, posture: Posture, kind: type[Figure] = Figure) -> Any:
    """The picture as a figure of that kind, 3.5 inches wide."""
    with matplotlib.rc_context(SETTINGS):
        return _drawn(skeleton, posture, kind).figure


def _drawn(skeleton: Skeleton, posture: Posture, kind: type[Figure] = Figure) -> Any:
    """The axes with the picture."""
    scene = scene_of(skeleton, posture)
    scene = replace(scene, lines=(*scene.lines, *gap_lines(skeleton, posture.u))).without(_HIDDEN)
    sheet = _sheet(skeleton, posture, scene)
    axes = paper(sheet.size, kind)
    draw_parts(axes, scene, sheet, posture.size)
    _names(axes, scene, sheet)
    _gravity(axes, skeleton.gravity, sheet)
    _ruler(axes, sheet)
    return axes


def _sheet(skeleton: Skeleton, posture: Posture, scene: Scene) -> Sheet:
    """The paper: as wide as a column, as high as the robot needs."""
    view, frames = good_view(skeleton, posture), poses(skeleton, posture.u)
    points = outline(scene, Sheet(frames, view.rotation, 1.0, np.zeros(2), (0.0, 0.0)))
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    span = np.maximum(high - low, 1e-6 * posture.size)
    scale = float(min((_WIDTH - 2 * _MARGIN) / span[0], (_MOST - 2 * _MARGIN) / span[1]))
    height = float(np.clip(scale * span[1] + 2 * _MARGIN, _LEAST, _MOST))
    shift = np.array([_WIDTH, height]) / 2.0 - scale * (low + high) / 2.0
    return Sheet(frames, view.rotation, scale, shift, (_WIDTH, height))


def _names(axes: Any, scene: Scene, sheet: Sheet) -> None:
    names = [
        Name(label.text, label.color, sheet.point(label.at)[:2],
             0.0 if label.layer == "base" else 1.2 * scene.radius * sheet.scale)
        for label in scene.labels
    ]  # fmt: skip
    crossed, sleeves = ([np.array([sheet.point(end)[:2] for end in part.ends]) for part in parts]
                        for parts in (scene.lines, scene.sleeves))  # fmt: skip
    behind = {"facecolor": "white", "alpha": 0.6, "pad": 0.2, "linewidth": 0.0}
    for placed in placed_names(names, crossed, sleeves, sheet.size):
        axes.text(*placed.at, placed.text, color=placed.color, fontsize=7, fontweight="bold",
                  va="center", ha="left", zorder=8.0, bbox=behind)  # fmt: skip


def _gravity(axes: Any, gravity: np.ndarray, sheet: Sheet) -> None:
    size = float(np.linalg.norm(gravity))
    if size == 0.0:
        return
    way = sheet.rotation @ gravity / size
    middle = np.array([sheet.size[0] - 16.0, 20.0])
    if np.hypot(way[0], way[1]) < 0.08:  # straight at the viewer, or away
        axes.add_patch(Circle(tuple(middle), 3.0, fill=False, edgecolor=_GRAVITY, linewidth=1.0))
        mark = "." if way[2] > 0 else "x"
        axes.plot(*middle, mark, color=_GRAVITY, markersize=3.5)
    else:
        half = 11.0 * way[:2]
        axes.add_patch(arrow(middle - half, middle + half, _GRAVITY, 1.2, 8.0))
    axes.text(middle[0] + 5.0, middle[1], "g", color=_GRAVITY, fontsize=8, style="italic",
              va="center", zorder=8.0)  # fmt: skip


def _ruler(axes: Any, sheet: Sheet) -> None:
    """A bar of a round length."""
    most = 50.0 / sheet.scale
    ten = 10.0 ** np.floor(np.log10(most))
    length = max(n * ten for n in (1.0, 2.0, 5.0) if n * ten <= most)
    end = 8.0 + length * sheet.scale
    axes.plot([8.0, 8.0, end, end], [11.0, 8.0, 8.0, 11.0], color=_GREY, linewidth=0.8)
    text = f"{length:.1g} m" if length >= 0.0999 else f"{1000.0 * length:.0f} mm"
    axes.text(end + 3.0, 9.0, text, color=_GREY, fontsize=6.5, va="center")
