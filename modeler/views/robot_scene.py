"""What is drawn of a robot: parts and glyphs that hang on frames and move with them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from modeler.views.robot_skeleton import (
    BASE,
    Posture,
    Skeleton,
    SkeletonRow,
    compute_corner,
    compute_foot_pose,
    compute_gaps,
    compute_poses,
)
from modeler.views.thresholds import THRESHOLDS

# Shapes of joints: lists of flat polygons, (corners, 3) each, around the origin, axis along z.


_SIDES = 14


def build_cylinder(radius: float, length: float) -> list[np.ndarray]:
    """Builds a cylinder."""
    angle = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle], axis=1)
    half = np.array([0.0, 0.0, 0.5 * length])
    top, bottom = ring + half, ring - half
    sides = [np.array([bottom[k], bottom[k + 1], top[k + 1], top[k]]) for k in range(_SIDES)]
    return [*sides, top[:-1], bottom[-1:0:-1]]


def build_box(half: float, low: float, high: float) -> list[np.ndarray]:
    """Builds a square prism from z = low to high, 2 half wide."""
    ring = half * np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    top = np.column_stack([ring, np.full(4, high)])
    bottom = np.column_stack([ring, np.full(4, low)])
    sides = [np.array([bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]]) for k in range(4)]
    return [*sides, top, bottom[::-1]]


def build_ball(radius: float) -> list[np.ndarray]:
    """Builds a ball, as rings of polygons."""
    rings, turns = 5, 10
    polar = np.pi * np.arange(rings + 1) / rings
    angle = 2.0 * np.pi * np.arange(turns + 1) / turns

    def compute_point(i: int, k: int) -> np.ndarray:
        s, c = np.sin(polar[i]), np.cos(polar[i])
        return radius * np.array([s * np.cos(angle[k]), s * np.sin(angle[k]), c])

    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    return [
        np.array([compute_point(i + a, k + b) for a, b in corners])
        for i in range(rings)
        for k in range(turns)
    ]


def order_polygon(points: np.ndarray, size: float) -> np.ndarray | None:
    """Orders the points around their middle, in their best plane; None if they are a line."""
    if len(points) < 3:
        return None
    middle = points - points.mean(axis=0)
    _, lengths, axes = np.linalg.svd(middle)
    if lengths[1] < 1e-3 * size:
        return None
    angle = np.arctan2(middle @ axes[1], middle @ axes[0])
    return np.asarray(points[np.argsort(angle, kind="stable")])


BODIES = ("#3b5b7a", "#7d9cba", "#4f7f6d", "#93b8a4", "#7a6c9c", "#b3a8cc")
"""Of the links, by the number of joints below them."""

ACTUATED, PASSIVE, FIXED, LOOP, OPEN = "#d55e00", "#a9a9a9", "#555555", "#b0508a", "#e00000"
PLATFORM, GROUND, MASS = "#56b4e9", "#8a8a8a", "#000000"
AXES = ("#cc2222", "#2a8f2a", "#1f4fd0")

Point = tuple[int, tuple[float, float, float]]
"""A frame (`BASE` for frame 0) and coordinates in it, m."""


@dataclass(frozen=True)
class SceneLine:
    """A straight piece between two points.

    Attributes:
        row: that it belongs to, for the one who points at it.
        ends: of the piece.
        color: "#rrggbb".
        width: in units of a thin line.
        layer: that it is shown and hidden with.
        arrow: True with a head at the second end.
        dashed: True for what the table does not say, or what should not be there.
    """

    row: int
    ends: tuple[Point, Point]
    color: str
    width: float
    layer: str
    arrow: bool = False
    dashed: bool = False


@dataclass(frozen=True)
class Face:
    """A flat polygon that is fixed on one frame."""

    row: int
    frame: int
    points: np.ndarray
    color: str
    layer: str
    opacity: float = 1.0


@dataclass(frozen=True)
class Dot:
    """A point; its radius in units of a thin line."""

    row: int
    at: Point
    color: str
    radius: float
    layer: str


@dataclass(frozen=True)
class Label:
    """A name at a point; names at one place are written together."""

    row: int
    at: Point
    text: str
    color: str
    layer: str


@dataclass(frozen=True)
class Sleeve:
    """Where faces stand that are longer than wide: names keep off this line."""

    ends: tuple[Point, Point]


@dataclass(frozen=True)
class Scene:
    """All that is drawn of a robot, in no order; `radius` is that of its joints, m."""

    radius: float
    lines: tuple[SceneLine, ...]
    faces: tuple[Face, ...]
    dots: tuple[Dot, ...]
    labels: tuple[Label, ...]
    sleeves: tuple[Sleeve, ...]

    def drop_layers(self, layers: Sequence[str]) -> "Scene":
        """Returns the scene without these layers."""
        parts: Any = {
            kind: tuple(part for part in getattr(self, kind) if part.layer not in layers)
            for kind in ("lines", "faces", "dots", "labels")
        }
        return replace(self, **parts)


ORIGIN = (0.0, 0.0, 0.0)


Part = SceneLine | Face | Dot | Label | Sleeve


def build_scene(skeleton: Skeleton, posture: Posture, further: Sequence[Part] = ()) -> Scene:
    """Builds the parts of a robot, their sizes chosen for the posture, and further ones."""
    maker = _SceneBuilder(skeleton, posture)
    parts = [*further, *maker.build_base(), *maker.build_platform(), *maker.build_loops()]
    for i, row in enumerate(skeleton.rows):
        if not row.is_virtual:
            parts += [*maker.build_link(i, row), *maker.build_joint(i, row)]
            parts += [*maker.build_frame(i), *maker.build_end(i, row)]
        parts += maker.build_mass(i, row)

    kinds = (SceneLine, Face, Dot, Label, Sleeve)
    sorted_: Any = (tuple(part for part in parts if isinstance(part, kind)) for kind in kinds)
    return Scene(maker.radius, *sorted_)


class _SceneBuilder:
    """Parts of one robot.

    Attributes:
        size: a length of the robot, m.
        radius: of joints, m.
    """

    def __init__(self, skeleton: Skeleton, posture: Posture) -> None:
        self.skeleton, self.size = skeleton, posture.size
        self.r = [_compute_travel(row, posture.u) for row in skeleton.rows]
        self.frames = compute_poses(skeleton, posture.u)
        rows = [pair for pair in zip(skeleton.rows, self.r, strict=True) if not pair[0].is_virtual]
        lengths = [abs(x) for row, r in rows for x in (row.cells["b"], row.cells["d"], r)]
        lengths = [x for x in lengths if x > 1e-6 * self.size]
        typical = float(np.quantile(lengths, 0.25)) if lengths else self.size
        # small beside the robot, and beside most of its links
        self.radius = float(np.clip(0.3 * typical, 0.010 * self.size, 0.021 * self.size))

    def choose_color(self, body: int) -> str:
        """Returns the colour of a link."""
        if body == BASE:
            return GROUND
        if self.skeleton.rows[body].is_virtual:
            return PLATFORM
        return BODIES[(self.skeleton.count_depth(body) - 1) % len(BODIES)]

    def build_base(self) -> Iterator[Part]:
        """Builds the axes of frame 0."""
        yield from self._build_triad(BASE, 0.13 * self.size, 1.6, "base")
        for axis, name in enumerate("xyz"):
            tip = 0.15 * self.size * np.eye(3)[axis]
            yield Label(BASE, (BASE, _convert_to_tuple(tip)), f"{name}0", AXES[axis], "base")
        yield Dot(BASE, (BASE, ORIGIN), "#222222", 3.0, "base")

    def build_link(self, i: int, row: SkeletonRow) -> Iterator[Part]:
        """Builds the common normal from the antecedent, and the way along the joint's axis."""
        a, carrier = row.parent, self.skeleton.find_body_row(row.parent)
        turn, ankle = compute_corner(row), compute_foot_pose(row)[:3, 3]
        of = i if a == BASE else a
        for start, end in ((np.zeros(3), turn), (turn, ankle)):
            if np.linalg.norm(end - start) > 1e-9 * self.size:
                ends = ((a, _convert_to_tuple(start)), (a, _convert_to_tuple(end)))
                width = 2.5 if a == BASE else 5.0
                yield SceneLine(
                    of, ends, self.choose_color(carrier), width, self._choose_layer(carrier)
                )
        slides = row.joint.is_moving and not row.joint.is_revolute
        if not slides and abs(self.r[i]) <= 1e-9 * self.size:
            return
        carrier = i if slides else self.skeleton.find_body_row(i)
        for ends in self._build_axis_path(i, row, (a, _convert_to_tuple(ankle))):
            width = 3.0 if slides else 5.0
            yield SceneLine(i, ends, self.choose_color(carrier), width, self._choose_layer(carrier))

    def _choose_layer(self, body: int) -> str:
        """Of links: the ground lies behind what moves on it, the platform has a face."""
        if body == BASE:
            return "ground"
        return "platform" if self.skeleton.rows[body].is_virtual else "links"

    def _build_axis_path(self, i: int, row: SkeletonRow, ankle: Point) -> list[tuple[Point, Point]]:
        """The way along z of row j, without what is inside its joint."""
        r, place = self.r[i], compute_foot_pose(row)
        low, high = -1.3 * self.radius - 0.5 * r, 1.3 * self.radius - 0.5 * r
        inside: tuple[Point, Point] = ((i, (0.0, 0.0, low)), (i, (0.0, 0.0, high)))
        if row.joint.is_moving and not row.joint.is_revolute:
            low, high = self._compute_sleeve_range(r)
            inside = (
                self._compute_axis_point(row, place, low),
                self._compute_axis_point(row, place, high),
            )
        if not row.joint.is_moving or high - low >= abs(r):
            return [(ankle, (i, ORIGIN))]
        near, far = inside if r > 0.0 else inside[::-1]
        return [(ankle, near), (far, (i, ORIGIN))]

    def _compute_axis_point(self, row: SkeletonRow, place: np.ndarray, z: float) -> Point:
        """The point z along the axis of a row, on its antecedent."""
        return (row.parent, _convert_to_tuple((place @ [0.0, 0.0, z, 1.0])[:3]))

    def build_joint(self, i: int, row: SkeletonRow) -> Iterator[Part]:
        """Builds a cylinder along a revolute axis, a sleeve along a prismatic one, else a dot."""
        joint, name = row.joint, row.joint.name
        if not joint.is_moving:
            yield Dot(i, (i, ORIGIN), FIXED, 2.5, "joints")
            yield Label(i, (i, ORIGIN), name, FIXED, "fixed names")
            return
        color = ACTUATED if joint.actuated else PASSIVE
        ink = "#a34700" if joint.actuated else "#5a5a5a"
        if joint.is_revolute:
            at = (0.0, 0.0, -0.5 * self.r[i])
            for points in build_cylinder(self.radius, 2.6 * self.radius):
                yield Face(i, i, points + at, color, "joints")
            for side in (-1.3 * self.radius, 1.3 * self.radius):
                outside = tuple((i, (0.0, 0.0, at[2] + far * side)) for far in (1.0, 2.5))
                yield SceneLine(i, (outside[0], outside[1]), color, 1.0, "joints")
            yield Label(i, (i, at), name, ink, "names")
            return
        place = compute_foot_pose(row)
        low, high = self._compute_sleeve_range(self.r[i])
        for points in build_box(0.75 * self.radius, low, high):
            yield Face(i, row.parent, points @ place[:3, :3].T + place[:3, 3], color, "joints")
        yield Sleeve(
            (self._compute_axis_point(row, place, low), self._compute_axis_point(row, place, high))
        )
        yield Label(i, self._compute_axis_point(row, place, 0.5 * (low + high)), name, ink, "names")

    def _compute_sleeve_range(self, r: float) -> tuple[float, float]:
        """From where to where along the axis of a prismatic joint its sleeve reaches."""
        half = max(0.16 * abs(r), 2.2 * self.radius)
        return 0.5 * r - half, 0.5 * r + half

    def build_frame(self, i: int) -> Iterator[Part]:
        """Builds the axes of frame j."""
        length = min(0.075 * self.size, 4.5 * self.radius)
        yield from self._build_triad(i, length, 1.1, "frames")

    def _build_triad(self, frame: int, length: float, width: float, layer: str) -> Iterator[Part]:
        for axis, color in enumerate(AXES):
            ends = ((frame, ORIGIN), (frame, _convert_to_tuple(length * np.eye(3)[axis])))
            yield SceneLine(frame, ends, color, width, layer, arrow=True)

    def build_end(self, i: int, row: SkeletonRow) -> Iterator[Part]:
        """Builds a dashed stub at a last link, whose length the table does not state."""
        skeleton = self.skeleton
        followed = any(other.parent == i for other in skeleton.rows)
        met = any(row.joint.name in (loop.frame, loop.meets) for loop in skeleton.robot.loops)
        if followed or met or not row.joint.is_moving:
            return
        ends = (
            (i, ORIGIN),
            (i, _convert_to_tuple(self._choose_end_direction(row) * 0.13 * self.size)),
        )
        yield SceneLine(i, ends, self.choose_color(i), 3.0, "links", dashed=True)

    def _choose_end_direction(self, row: SkeletonRow) -> np.ndarray:
        """The axis of frame j that the link's mass lies along; else what the table suggests."""
        centre = self._find_centre_of_mass(row)
        if centre is not None and np.any(np.abs(centre) > 1e-9 * self.size):
            k = int(np.argmax(np.abs(centre)))
            return np.asarray(np.eye(3)[k] * np.sign(centre[k]))
        parallel = abs(np.sin(row.cells["alpha"])) < 1e-6 and row.joint.is_revolute
        return np.eye(3)[0 if parallel else 2]

    def build_mass(self, i: int, row: SkeletonRow) -> Iterator[Part]:
        """Builds a dot at the centre of mass, where the file states it."""
        centre = self._find_centre_of_mass(row)
        if centre is not None:
            yield Dot(i, (i, _convert_to_tuple(centre)), MASS, 3.4, "masses")

    def _find_centre_of_mass(self, row: SkeletonRow) -> np.ndarray | None:
        """(3,) centre of mass in frame j, m; None where the file does not state it."""
        values, name = self.skeleton.robot.parameters, row.joint.name
        mass, moments = values.get(f"M{name}", 0.0), [f"M{axis}{name}" for axis in "XYZ"]
        if mass <= 0.0 or not any(moment in values for moment in moments):
            return None
        return np.array([values.get(moment, 0.0) for moment in moments]) / mass

    def build_platform(self) -> Iterator[Part]:
        """Builds the body between the points where legs meet it; a block at one point."""
        skeleton = self.skeleton
        if not skeleton.robot.platform:
            return
        i = skeleton.find_row(skeleton.robot.platform[-1])
        inverse = np.linalg.inv(self.frames[i])
        met = {f for loop in skeleton.robot.loops for f in (loop.frame, loop.meets)}
        points = [ORIGIN] + [
            _convert_to_tuple((inverse @ self.frames[k])[:3, 3])
            for k, row in enumerate(skeleton.rows)
            if skeleton.find_body_row(k) == i and row.joint.name in met and k != i
        ]
        outline = order_polygon(np.array(points[1:]), self.size)
        if outline is not None:
            yield Face(i, i, outline, PLATFORM, "platform", 0.45)
            for point in outline:
                yield SceneLine(
                    i, ((i, ORIGIN), (i, _convert_to_tuple(point))), PLATFORM, 2.0, "platform"
                )
        else:
            for face in build_box(1.3 * self.radius, -1.3 * self.radius, 1.3 * self.radius):
                yield Face(i, i, face, PLATFORM, "platform")
        yield Label(i, (i, ORIGIN), skeleton.robot.platform[-1], "#0b6aa5", "names")
        yield from self.build_frame(i)

    def build_loops(self) -> Iterator[Part]:
        """Builds the joints that close loops."""
        skeleton = self.skeleton
        for loop in skeleton.robot.loops:
            one, other = skeleton.find_row(loop.frame), skeleton.find_row(loop.meets)
            faces: Sequence[np.ndarray]
            if loop.kind in ("revolute", "cylindrical"):
                faces = build_cylinder(1.15 * self.radius, 2.0 * self.radius)
            elif loop.kind in ("prismatic", "planar", "rigid"):
                faces = build_box(self.radius, -self.radius, self.radius)
            else:
                faces = build_ball(1.05 * self.radius)
            for face in faces:
                yield Face(one, one, face, LOOP, "loops")
            yield Dot(other, (other, ORIGIN), LOOP, 3.0, "loops")
            yield Label(one, (one, ORIGIN), loop.name, LOOP, "loop names")


def build_gap_lines(skeleton: Skeleton, u: np.ndarray) -> list[SceneLine]:
    """Builds the free travel and, in red, the gap between the frames of every loop."""
    lines = []
    for gap in compute_gaps(skeleton, u):
        row = skeleton.find_row(gap.loop.frame)
        start, bend, end = ((BASE, _convert_to_tuple(point)) for point in gap.path)
        lines.append(SceneLine(row, (start, bend), LOOP, 1.0, "gap"))
        lines.append(SceneLine(row, (bend, end), OPEN, 2.0, "gap", dashed=True))
    return lines


def _compute_travel(row: SkeletonRow, u: np.ndarray) -> float:
    """r of the row, m."""
    r = row.cells["r"]
    if row.joint.is_moving and not row.joint.is_revolute:
        r += row.rate * float(row.constant + row.coefficients @ u)
    return r


def _convert_to_tuple(point: Sequence[float] | np.ndarray) -> tuple[float, float, float]:
    return (float(point[0]), float(point[1]), float(point[2]))


# Views of a robot, gravity down, and where its names are written.


_AZIMUTHS = (-60.0, -30.0, -45.0, 30.0, 45.0, 60.0, 120.0, 135.0, 150.0, -120.0, -135.0, -150.0)
_ELEVATION = 24.0
_ASIDE, _ABOVE = np.radians(25.0), np.radians(16.0)


@dataclass(frozen=True)
class ViewDirection:
    """How a robot is seen.

    Attributes:
        rotation: (3, 3) rows are right, up and towards the viewer, in frame 0.
        up: (3,) what is up: against gravity; z0 without gravity.
    """

    rotation: np.ndarray
    up: np.ndarray


def choose_view(skeleton: Skeleton, posture: Posture) -> ViewDirection:
    """Chooses a view in which few frames hide each other.

    Straight on for planar mechanisms; nearly so for others that stand in a plane.
    """
    pull = float(np.linalg.norm(skeleton.gravity))
    up = -skeleton.gravity / pull if pull > 0.0 else np.array([0.0, 0.0, 1.0])
    points = collect_joint_points(skeleton, posture.u)
    frames = compute_poses(skeleton, posture.u)
    turning = [
        i for i, row in enumerate(skeleton.rows) if row.joint.is_moving and row.joint.is_revolute
    ]
    axes = np.array([frames[i][:3, 2] for i in turning]).reshape(-1, 3)
    normal = _fit_plane_normal(points, axes, posture.size)
    if normal is not None:
        return ViewDirection(_compute_plane_view(normal, axes, up), up)
    best, best_score = None, -np.inf
    for azimuth in _AZIMUTHS:
        rotation = compute_view_rotation(up, np.radians(azimuth), np.radians(_ELEVATION))
        score = _compute_spread(points @ rotation[:2].T, posture.size)
        if best is None or score > best_score * THRESHOLDS.min_view_gain:
            best, best_score = rotation, score
    assert best is not None
    return ViewDirection(best, up)


def _compute_plane_view(normal: np.ndarray, axes: np.ndarray, up: np.ndarray) -> np.ndarray:
    """(3, 3) a view of a robot that stands in a plane."""
    across = abs(normal @ up) > 0.99  # gravity across the plane: up says nothing in it
    vertical = next(a for a in np.eye(3)[[1, 2, 0]] if abs(a @ normal) < 0.1) if across else up
    vertical = vertical - (vertical @ normal) * normal
    vertical /= np.linalg.norm(vertical)
    right = np.cross(vertical, normal)
    if right[np.argmax(np.abs(right) > 0.3)] < 0 and not across:
        right, normal = -right, -normal
    straight = np.array([right, vertical, normal])
    if _are_parallel(axes, normal):
        return straight
    c, s = np.cos(_ASIDE), np.sin(_ASIDE)
    level = c * straight[2] - s * straight[0]
    towards = np.cos(_ABOVE) * level + np.sin(_ABOVE) * straight[1]
    right = c * straight[0] + s * straight[2]
    return np.array([right, np.cross(towards, right), towards])


def compute_view_rotation(up: np.ndarray, azimuth: float, elevation: float) -> np.ndarray:
    """Returns (3, 3) rows right, up, towards the viewer at these angles [rad] about `up`."""
    start = next(axis for axis in np.eye(3) if abs(axis @ up) < 0.6)
    east = start - (start @ up) * up
    east /= np.linalg.norm(east)
    north = np.cross(up, east)
    level = np.cos(azimuth) * east + np.sin(azimuth) * north
    towards = np.cos(elevation) * level + np.sin(elevation) * up
    right = np.cos(azimuth) * north - np.sin(azimuth) * east
    return np.array([right, np.cross(towards, right), towards])


def collect_joint_points(skeleton: Skeleton, u: np.ndarray) -> np.ndarray:
    """Returns (n, 3) origins of frames and feet of axes without platform motions, unique."""
    frames = compute_poses(skeleton, u)
    points = [np.zeros(3)]
    for i, row in enumerate(skeleton.rows):
        if row.is_virtual and row.joint.name != skeleton.robot.platform[-1]:
            continue
        points.append(frames[i][:3, 3])
        if not row.is_virtual:
            before = np.eye(4) if row.parent == BASE else frames[row.parent]
            points.append((before @ compute_foot_pose(row))[:3, 3])
    return np.unique(np.round(np.array(points), 9), axis=0)


def _are_parallel(axes: np.ndarray, normal: np.ndarray) -> bool:
    return bool(np.all(np.abs(axes @ normal) > 1.0 - 1e-6))


def _fit_plane_normal(points: np.ndarray, axes: np.ndarray, size: float) -> np.ndarray | None:
    """Of the plane that all points lie in; None if there is none.

    Where points are a line, the plane that the joints turn in.
    """
    if (
        len(axes)
        and _are_parallel(axes, axes[0])
        and np.ptp(points @ axes[0]) < THRESHOLDS.max_flatness * size
    ):
        return np.asarray(axes[0] if axes[0][np.argmax(np.abs(axes[0]))] > 0 else -axes[0])
    if len(points) < 3:
        return None
    _, lengths, directions = np.linalg.svd(points - points.mean(axis=0))
    if lengths[1] < THRESHOLDS.max_flatness * size or lengths[2] > THRESHOLDS.max_flatness * size:
        return None
    normal = directions[2]
    return np.asarray(normal if normal[np.argmax(np.abs(normal))] > 0 else -normal)


def _compute_spread(flat: np.ndarray, size: float) -> float:
    """How well points are distinguished on the paper: mean distance, near pairs count most."""
    away = np.linalg.norm(flat[:, None] - flat[None], axis=2)[np.triu_indices(len(flat), 1)]
    return float(np.mean(np.minimum(away / size, 0.15))) if away.size else 0.0
