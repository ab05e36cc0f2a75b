"""Parts of a scene painted on paper, from far to near, by matplotlib without a window."""

import io
import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Polygon

from modeler.show.scene import BASE, Dot, Face, Line, Point, Scene

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
class Sheet:
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

    def world(self, frame: int, points: np.ndarray) -> np.ndarray:
        """(n, 3) in frame 0."""
        if frame == BASE:
            return points
        pose = self.frames[frame]
        return np.asarray(points @ pose[:3, :3].T + pose[:3, 3])

    def seen(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) x and y on the paper, and depth in m, of points in frame 0."""
        turned = points @ self.rotation.T
        return np.column_stack([turned[:, :2] * self.scale + self.shift, turned[:, 2]])

    def point(self, point: Point) -> np.ndarray:
        """(3,) of a point that hangs on a frame."""
        return np.asarray(self.seen(self.world(point[0], np.array([point[1]])))[0])


def paper(size: tuple[float, float], kind: type[Figure] = Figure) -> Any:
    """Axes over a whole sheet of that size, a figure of that kind; their units are points."""
    figure = kind(figsize=(size[0] / 72.0, size[1] / 72.0))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, size[0])
    axes.set_ylim(0.0, size[1])
    return axes


def saved(axes: Any, suffix: str) -> bytes:
    """The sheet as a file, without a date or version; ".png" has 400 dots per inch."""
    stream = io.BytesIO()
    axes.figure.savefig(stream, format=suffix[1:], dpi=400, metadata=_METADATA[suffix])
    return stream.getvalue()


def draw_parts(axes: Any, scene: Scene, sheet: Sheet, size: float) -> None:
    """All parts but the names; `size` is a length of the robot, m."""
    parts = [*_faces(scene, sheet), *_lines(scene, sheet, size), *_dots(scene, sheet)]
    for order, (_, draw) in enumerate(sorted(parts, key=lambda part: part[0])):
        draw(axes, 2.0 + 1e-3 * order)


def outline(scene: Scene, sheet: Sheet) -> np.ndarray:
    """(n, 2) corners of the parts on the paper."""
    points = [sheet.point(end)[:2] for line in scene.lines for end in line.ends]
    points += [xy for f in scene.faces for xy in sheet.seen(sheet.world(f.frame, f.points))[:, :2]]
    return np.array(points)


def _faces(scene: Scene, sheet: Sheet) -> list[Any]:
    light = np.array([0.35, 0.6, 0.72]) @ sheet.rotation
    found = []
    for face in scene.faces:
        corners = sheet.world(face.frame, face.points)
        away = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
        normal = away / max(float(np.linalg.norm(away)), 1e-300)
        if face.opacity == 1.0 and normal @ sheet.rotation[2] <= 0.0:
            continue
        bright = 0.74 + 0.42 * max(0.0, float(normal @ light)) if face.opacity == 1.0 else 1.0
        points = sheet.seen(corners)
        found.append((float(points[:, 2].mean()), _polygon(face, points[:, :2], bright)))
    return found


def _polygon(face: Face, points: np.ndarray, bright: float) -> Any:
    color = _shaded(face.color, bright)

    def draw(axes: Any, order: float) -> None:
        axes.add_patch(
            Polygon(points, facecolor=color, edgecolor=color, linewidth=0.3,
                    alpha=face.opacity, zorder=order)
        )  # fmt: skip

    return draw


def _shaded(color: str, bright: float) -> tuple[float, ...]:
    parts = [int(color[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    if bright <= 1.0:
        return tuple(part * bright for part in parts)
    return tuple(part + (1.0 - part) * (bright - 1.0) for part in parts)


def _lines(scene: Scene, sheet: Sheet, size: float) -> list[Any]:
    found = []
    for line in scene.lines:
        start, end = (sheet.world(e[0], np.array([e[1]]))[0] for e in line.ends)
        length = float(np.linalg.norm(end - start))
        if length < 1e-7 * size:
            continue
        front = size * _FRONT.get(line.layer, 0.0)
        count = 1 if line.arrow or line.dashed else max(1, int(np.ceil(length / (0.06 * size))))
        cuts = np.linspace(0.0, 1.0, count + 1)[:, None]
        points = sheet.seen(start + cuts * (end - start))
        for a, b in itertools.pairwise(points):
            found.append((float(a[2] + b[2]) / 2.0 + front, _piece(line, a[:2], b[:2])))
    return found


def _piece(line: Line, a: np.ndarray, b: np.ndarray) -> Any:
    width = line.width * _UNIT
    x, y = [a[0], b[0]], [a[1], b[1]]

    def draw(axes: Any, order: float) -> None:
        if line.layer != "platform":  # which lies in a face
            axes.plot(x, y, color="white", linewidth=width + 1.3, solid_capstyle="butt",
                      zorder=order)  # fmt: skip
        if line.dashed:
            axes.plot(x, y, color=line.color, linewidth=width, dashes=(2.2, 1.8), zorder=order)
        elif not line.arrow:
            axes.plot(x, y, color=line.color, linewidth=width, solid_capstyle="round", zorder=order)
        elif np.hypot(*(b - a)) > 1.5:
            axes.add_patch(arrow(a, b, line.color, width, order))

    return draw


def arrow(a: np.ndarray, b: np.ndarray, color: str, width: float, order: float) -> Any:
    """From a to b, points."""
    head = min(2.2 + 1.6 * width, 0.7 * float(np.hypot(*(b - a))))
    style = f"-|>,head_length={head},head_width={0.4 * head}"
    return FancyArrowPatch(
        tuple(a), tuple(b), arrowstyle=style, mutation_scale=1.0, color=color, linewidth=width,
        shrinkA=0.0, shrinkB=0.0, joinstyle="miter", zorder=order,
    )  # fmt: skip


def _dots(scene: Scene, sheet: Sheet) -> list[Any]:
    return [(float(sheet.point(dot.at)[2]), _spot(dot, sheet.point(dot.at)[:2]))
            for dot in scene.dots]  # fmt: skip


def _spot(dot: Dot, at: np.ndarray) -> Any:
    def draw(axes: Any, order: float) -> None:
        axes.add_patch(
            Circle(tuple(at), dot.radius * _UNIT, facecolor=dot.color, edgecolor="white",
                   linewidth=0.4, zorder=order)
        )  # fmt: skip

    return draw
