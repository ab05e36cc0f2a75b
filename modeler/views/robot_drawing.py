"""A robot on paper: parts, arrows and names beside what they name."""

import io
import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Patch, Polygon

from modeler.views import robot_scene
from modeler.views.robot_skeleton import Posture, Skeleton, compute_poses
from modeler.views.thresholds import THRESHOLDS

_SIZE, _HIGH, _BLANK = 7.0, 7.5, 4.0  # points


@dataclass(frozen=True)
class NameLabel:
    """A text, and what it names.

    Attributes:
        text: as it is written.
        color: of the text.
        at: (2,) what it names, points.
        bulk: radius of what it names, points.
    """

    text: str
    color: str
    at: np.ndarray
    bulk: float = 0.0


def place_names(
    names: Sequence[NameLabel],
    lines: Sequence[np.ndarray],
    sleeves: Sequence[np.ndarray],
    paper: tuple[float, float],
) -> list[NameLabel]:
    """Places the names: `at` is the left end of the text, at half its height.

    Names at one place come one after the other in one line. Each such line takes, of 36 places
    around it, the one that covers fewest names and lines.

    Args:
        names: with what they name.
        lines: (2, 2) straight lines in the picture, points.
        sleeves: the same of bars that are as thick as what is named.
        paper: width and height, points.
    """
    groups: list[list[NameLabel]] = []
    for name in names:
        near = next(
            (g for g in groups if np.hypot(*(g[0].at - name.at)) < THRESHOLDS.same_place_points),
            None,
        )
        if near is None:
            groups.append([name])
        else:
            near.append(name)
    steps = np.linspace(0.0, 1.0, 60)[:, None]
    dense, bars = (
        [line[0] + steps * (line[1] - line[0]) for line in these] for these in (lines, sleeves)
    )
    taken: list[np.ndarray] = []
    labels = []
    for group in groups:
        widths = [_compute_text_width(name.text) for name in group]
        width = sum(widths) + _BLANK * (len(group) - 1)
        others = [each[0] for each in groups if each is not group]
        box = _choose_box(group, np.array([width, _HIGH]), taken, dense, bars, others, paper)
        taken.append(box)
        x = box[0, 0]
        for name, wide in zip(group, widths, strict=True):
            labels.append(NameLabel(name.text, name.color, np.array([x, box[:, 1].mean()])))
            x += wide + _BLANK
    return labels


def _compute_text_width(text: str) -> float:
    from matplotlib.font_manager import FontProperties  # matplotlib takes long to load
    from matplotlib.textpath import TextPath

    font = FontProperties(weight="bold", size=_SIZE)
    return float(TextPath((0, 0), text, prop=font).get_extents().width)


def _choose_box(
    group: Sequence[NameLabel],
    size: np.ndarray,
    taken: Sequence[np.ndarray],
    lines: Sequence[np.ndarray],
    bars: Sequence[np.ndarray],
    others: Sequence[NameLabel],
    paper: tuple[float, float],
) -> np.ndarray:
    """(2, 2) lower left and upper right corner of a text of that size.

    It should not cover names that stand, points of lines and bars, and what others name.
    """
    bulk = max(name.bulk for name in group)
    best, best_cost = None, np.inf
    for ring in range(3):
        for k in range(12):
            angle = np.pi * (k - 1) / 6.0
            reach = 4.0 + 5.0 * ring + bulk
            way = np.array([np.cos(angle) * (reach + size[0] / 2), np.sin(angle) * (reach + 2.0)])
            low = group[0].at + way - size / 2
            box = np.array([low, low + size])
            cost = 8.0 * sum(_is_overlapping(box, other) for other in taken) + 0.7 * ring
            cost += min(4, sum(_has_point_inside(points, box) for points in lines))
            cost += 2.0 * sum(_is_covering(box, name) for name in others)
            wide = box + np.array([[-0.7], [0.7]]) * bulk
            cost += 2.0 * sum(_has_point_inside(points, wide) for points in bars)
            cost += 20.0 * (np.any(box[0] < 3.0) or np.any(box[1] > np.array(paper) - 3.0))
            if best is None or cost < best_cost - 1e-9:
                best, best_cost = box, cost
    assert best is not None
    return best


def _is_covering(box: np.ndarray, name: NameLabel) -> bool:
    return bool(np.hypot(*(name.at - np.clip(name.at, box[0], box[1]))) < 0.7 * name.bulk)


def _is_overlapping(a: np.ndarray, b: np.ndarray) -> bool:
    return bool(np.all(a[0] < b[1] + 0.8) and np.all(b[0] < a[1] + 0.8))


def _has_point_inside(points: np.ndarray, box: np.ndarray) -> bool:
    return bool(np.any(np.all((points > box[0]) & (points < box[1]), axis=1)))


# Parts of a scene painted on paper, from far to near, by matplotlib without a window.


SETTINGS: Any = {"svg.hashsalt": "modeler", "svg.fonttype": "none", "font.size": 7}
"""Of matplotlib, while it draws."""

_FRONT = {"frames": 0.03, "base": 0.03, "gap": 1.0, "ground": -0.03}
"""Of the robot's size, by which lines of a layer are painted as if they were nearer."""

_UNIT = 0.62  # points, of a thin line
_METADATA: dict[str, Any] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


@dataclass(frozen=True)
class PaperSheet:
    """Where points of the robot lie on the paper.

    Attributes:
        frames: poses.
        rotation: rows right, up, towards the viewer.
        scale: points of the paper per m.
        shift: (2,) of the robot's frame 0 on the paper, points.
        size: of the paper, points.
    """

    frames: np.ndarray
    rotation: np.ndarray
    scale: float
    shift: np.ndarray
    size: tuple[float, float]

    def convert_to_world(self, frame: int, points: np.ndarray) -> np.ndarray:
        """Returns points (n, 3) in frame 0."""
        if frame == robot_scene.BASE:
            return points
        pose = self.frames[frame]
        return np.asarray(points @ pose[:3, :3].T + pose[:3, 3])

    def project_points(self, points: np.ndarray) -> np.ndarray:
        """Returns (n, 3) x and y on the paper, and depth in m, of points in frame 0."""
        turned = points @ self.rotation.T
        return np.column_stack([turned[:, :2] * self.scale + self.shift, turned[:, 2]])

    def project_point(self, point: robot_scene.Point) -> np.ndarray:
        """Returns (3,) of a point that is fixed to a frame."""
        return np.asarray(
            self.project_points(self.convert_to_world(point[0], np.array([point[1]])))[0]
        )


def create_paper(size: tuple[float, float], kind: type[Figure] = Figure) -> Any:
    """Creates axes over a whole sheet of that size and kind of figure; units are points."""
    figure = kind(figsize=(size[0] / 72.0, size[1] / 72.0))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, size[0])
    axes.set_ylim(0.0, size[1])
    return axes


def save_sheet(axes: Any, suffix: str) -> bytes:
    """Returns the sheet as a file, without a date or version; ".png" has 400 dots per inch."""
    stream = io.BytesIO()
    axes.figure.savefig(stream, format=suffix[1:], dpi=400, metadata=_METADATA[suffix])
    return stream.getvalue()


def draw_parts(axes: Any, scene: robot_scene.Scene, sheet: PaperSheet, size: float) -> None:
    """Draws all parts but the names; `size` is a length of the robot, m."""
    parts = [
        *_collect_faces(scene, sheet),
        *_collect_lines(scene, sheet, size),
        *_collect_dots(scene, sheet),
    ]
    for order, (_, draw) in enumerate(sorted(parts, key=lambda part: part[0])):
        draw(axes, 2.0 + 1e-3 * order)


def compute_outline(scene: robot_scene.Scene, sheet: PaperSheet) -> np.ndarray:
    """Returns (n, 2) corners of the parts on the paper."""
    points = [sheet.project_point(end)[:2] for line in scene.lines for end in line.ends]
    points += [
        xy
        for f in scene.faces
        for xy in sheet.project_points(sheet.convert_to_world(f.frame, f.points))[:, :2]
    ]
    return np.array(points)


def _collect_faces(scene: robot_scene.Scene, sheet: PaperSheet) -> list[Any]:
    light = np.array([0.35, 0.6, 0.72]) @ sheet.rotation
    faces = []
    for face in scene.faces:
        corners = sheet.convert_to_world(face.frame, face.points)
        away = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
        normal = away / max(float(np.linalg.norm(away)), 1e-300)
        if face.opacity == 1.0 and normal @ sheet.rotation[2] <= 0.0:
            continue
        bright = 0.74 + 0.42 * max(0.0, float(normal @ light)) if face.opacity == 1.0 else 1.0
        points, color = sheet.project_points(corners), _shade_color(face.color, bright)
        patch = Polygon(
            points[:, :2], facecolor=color, edgecolor=color, linewidth=0.3, alpha=face.opacity
        )
        faces.append((float(points[:, 2].mean()), partial(_add_patch, patch)))
    return faces


def _add_patch(patch: Patch, axes: Any, order: float) -> None:
    patch.set_zorder(order)
    axes.add_patch(patch)


def _shade_color(color: str, bright: float) -> tuple[float, ...]:
    parts = [int(color[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    if bright <= 1.0:
        return tuple(part * bright for part in parts)
    return tuple(part + (1.0 - part) * (bright - 1.0) for part in parts)


def _collect_lines(scene: robot_scene.Scene, sheet: PaperSheet, size: float) -> list[Any]:
    segments = []
    for line in scene.lines:
        start, end = (sheet.convert_to_world(e[0], np.array([e[1]]))[0] for e in line.ends)
        length = float(np.linalg.norm(end - start))
        if length < 1e-7 * size:
            continue
        front = size * _FRONT.get(line.layer, 0.0)
        count = 1 if line.arrow or line.dashed else max(1, int(np.ceil(length / (0.06 * size))))
        cuts = np.linspace(0.0, 1.0, count + 1)[:, None]
        points = sheet.project_points(start + cuts * (end - start))
        for a, b in itertools.pairwise(points):
            segments.append(
                (float(a[2] + b[2]) / 2.0 + front, _build_line_drawer(line, a[:2], b[:2]))
            )
    return segments


def _build_line_drawer(line: robot_scene.SceneLine, a: np.ndarray, b: np.ndarray) -> Any:
    width = line.width * _UNIT
    x, y = [a[0], b[0]], [a[1], b[1]]

    def draw_line(axes: Any, order: float) -> None:
        if line.layer != "platform":  # which lies in a face
            axes.plot(
                x, y, color="white", linewidth=width + 1.3, solid_capstyle="butt", zorder=order
            )
        if line.dashed:
            axes.plot(x, y, color=line.color, linewidth=width, dashes=(2.2, 1.8), zorder=order)
        elif not line.arrow:
            axes.plot(x, y, color=line.color, linewidth=width, solid_capstyle="round", zorder=order)
        elif np.hypot(*(b - a)) > 1.5:
            axes.add_patch(build_arrow(a, b, line.color, width, order))

    return draw_line


def build_arrow(a: np.ndarray, b: np.ndarray, color: str, width: float, order: float) -> Any:
    """Builds an arrow from a to b, points."""
    head = min(2.2 + 1.6 * width, 0.7 * float(np.hypot(*(b - a))))
    style = f"-|>,head_length={head},head_width={0.4 * head}"
    return FancyArrowPatch(
        tuple(a),
        tuple(b),
        arrowstyle=style,
        mutation_scale=1.0,
        color=color,
        linewidth=width,
        shrinkA=0.0,
        shrinkB=0.0,
        joinstyle="miter",
        zorder=order,
    )


def _collect_dots(scene: robot_scene.Scene, sheet: PaperSheet) -> list[Any]:
    dots = []
    for dot in scene.dots:
        at = sheet.project_point(dot.at)
        patch = Circle(
            tuple(at[:2]), dot.radius * _UNIT, facecolor=dot.color, edgecolor="white", linewidth=0.4
        )
        dots.append((float(at[2]), partial(_add_patch, patch)))
    return dots


# The skeleton as a picture for papers: one column wide.


_WIDTH, _LEAST, _MOST = 252.0, 130.0, 300.0  # points: a column, and heights
_MARGIN = 26.0
_HIDDEN = ("loop names", "masses")
_GREY, _GRAVITY = "#5c5c62", "#6b4fa0"


def render_picture(skeleton: Skeleton, posture: Posture, suffix: str) -> bytes:
    """Renders the picture as a file of that kind, 3.5 inches wide, without a date or version.

    Args:
        skeleton: the robot.
        posture: as it stands.
        suffix: one of `PICTURE_KINDS`; ".png" has 400 dots per inch.
    """
    with matplotlib.rc_context(SETTINGS):
        return save_sheet(_draw_skeleton_axes(skeleton, posture), suffix)


def draw_skeleton(skeleton: Skeleton, posture: Posture, kind: type[Figure] = Figure) -> Any:
    """Draws the picture as a figure of that kind, 3.5 inches wide."""
    with matplotlib.rc_context(SETTINGS):
        return _draw_skeleton_axes(skeleton, posture, kind).figure


def _draw_skeleton_axes(skeleton: Skeleton, posture: Posture, kind: type[Figure] = Figure) -> Any:
    """The axes with the picture."""
    scene = robot_scene.build_scene(skeleton, posture)
    scene = replace(
        scene, lines=(*scene.lines, *robot_scene.build_gap_lines(skeleton, posture.u))
    ).drop_layers(_HIDDEN)
    sheet = _arrange_sheet(skeleton, posture, scene)
    axes = create_paper(sheet.size, kind)
    draw_parts(axes, scene, sheet, posture.size)
    _draw_names(axes, scene, sheet)
    _draw_gravity(axes, skeleton.gravity, sheet)
    _draw_ruler(axes, sheet)
    return axes


def _arrange_sheet(skeleton: Skeleton, posture: Posture, scene: robot_scene.Scene) -> PaperSheet:
    """The paper: as wide as a column, as high as the robot needs."""
    view, frames = robot_scene.choose_view(skeleton, posture), compute_poses(skeleton, posture.u)
    points = compute_outline(scene, PaperSheet(frames, view.rotation, 1.0, np.zeros(2), (0.0, 0.0)))
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    span = np.maximum(high - low, 1e-6 * posture.size)
    scale = float(min((_WIDTH - 2 * _MARGIN) / span[0], (_MOST - 2 * _MARGIN) / span[1]))
    height = float(np.clip(scale * span[1] + 2 * _MARGIN, _LEAST, _MOST))
    shift = np.array([_WIDTH, height]) / 2.0 - scale * (low + high) / 2.0
    return PaperSheet(frames, view.rotation, scale, shift, (_WIDTH, height))


def _draw_names(axes: Any, scene: robot_scene.Scene, sheet: PaperSheet) -> None:
    names = [
        NameLabel(
            label.text,
            label.color,
            sheet.project_point(label.at)[:2],
            0.0 if label.layer == "base" else 1.2 * scene.radius * sheet.scale,
        )
        for label in scene.labels
    ]
    crossed, sleeves = (
        [np.array([sheet.project_point(end)[:2] for end in part.ends]) for part in parts]
        for parts in (scene.lines, scene.sleeves)
    )
    behind = {"facecolor": "white", "alpha": 0.6, "pad": 0.2, "linewidth": 0.0}
    for placed in place_names(names, crossed, sleeves, sheet.size):
        axes.text(
            *placed.at,
            placed.text,
            color=placed.color,
            fontsize=7,
            fontweight="bold",
            va="center",
            ha="left",
            zorder=8.0,
            bbox=behind,
        )


def _draw_gravity(axes: Any, gravity: np.ndarray, sheet: PaperSheet) -> None:
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
        axes.add_patch(build_arrow(middle - half, middle + half, _GRAVITY, 1.2, 8.0))
    axes.text(
        middle[0] + 5.0,
        middle[1],
        "g",
        color=_GRAVITY,
        fontsize=8,
        style="italic",
        va="center",
        zorder=8.0,
    )


def _draw_ruler(axes: Any, sheet: PaperSheet) -> None:
    """A bar of a round length."""
    most = 50.0 / sheet.scale
    ten = 10.0 ** np.floor(np.log10(most))
    length = max(n * ten for n in (1.0, 2.0, 5.0) if n * ten <= most)
    end = 8.0 + length * sheet.scale
    axes.plot([8.0, 8.0, end, end], [11.0, 8.0, 8.0, 11.0], color=_GREY, linewidth=0.8)
    text = f"{length:.1g} m" if length >= 0.0999 else f"{1000.0 * length:.0f} mm"
    axes.text(end + 3.0, 9.0, text, color=_GREY, fontsize=6.5, va="center")


# Several postures of a robot side by side, as the assembly modes of its loops.


# Points, of one posture: half a column, and heights.
_WIDE, _LEAST_MODE, _MOST_MODE = 126.0, 60.0, 150.0
_MODE_MARGIN, _TITLE = 8.0, 14.0
_ACROSS = 4
_HIDDEN_IN_MODES = ("frames", "masses", "names", "fixed names", "loop names")


def render_modes(
    skeleton: Skeleton, postures: Sequence[Posture], titles: Sequence[str], suffix: str
) -> bytes:
    """Renders the postures as one picture, of one view and one scale.

    Two are as wide as a column of a paper (3.5 inches), four as wide as its page.

    Args:
        skeleton: the robot.
        postures: at least one.
        titles: what stands above each.
        suffix: one of `PICTURE_KINDS`; ".png" has 400 dots per inch.
    """
    rotation = robot_scene.choose_view(skeleton, postures[0]).rotation
    scenes = [
        robot_scene.build_scene(skeleton, posture).drop_layers(_HIDDEN_IN_MODES)
        for posture in postures
    ]
    frames = [compute_poses(skeleton, posture.u) for posture in postures]
    plain = [PaperSheet(each, rotation, 1.0, np.zeros(2), (0.0, 0.0)) for each in frames]
    points = np.concatenate([compute_outline(*pair) for pair in zip(scenes, plain, strict=True)])
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    span = np.maximum(high - low, 1e-6 * postures[0].size)
    room = np.array([_WIDE, _MOST_MODE]) - 2.0 * _MODE_MARGIN - [0.0, _TITLE]
    scale = float(np.min(room / span))
    wanted = scale * span[1] + 2.0 * _MODE_MARGIN + _TITLE
    high_one = float(np.clip(wanted, _LEAST_MODE, _MOST_MODE))
    across = min(_ACROSS, len(postures))
    down = -(-len(postures) // across)
    size = (_WIDE * across, high_one * down)
    with matplotlib.rc_context(SETTINGS):
        axes = create_paper(size)
        for k, (scene, each) in enumerate(zip(scenes, frames, strict=True)):
            corner = np.array([_WIDE * (k % across), high_one * (down - 1 - k // across)])
            middle = corner + np.array([_WIDE, high_one - _TITLE]) / 2.0
            sheet = PaperSheet(each, rotation, scale, middle - scale * (low + high) / 2.0, size)
            draw_parts(axes, scene, sheet, postures[k].size)
            x, y = corner + np.array([_MODE_MARGIN, high_one - _TITLE])
            axes.text(x, y, titles[k], fontsize=8, fontweight="bold", va="bottom", zorder=9.0)
        return save_sheet(axes, suffix)
