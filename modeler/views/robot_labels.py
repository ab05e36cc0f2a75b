"""Views of a robot, gravity down, and where its names are written."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.views.robot_closing import Posture
from modeler.views.robot_skeleton import BASE, Skeleton, compute_foot_pose, compute_poses

_AZIMUTHS = (-60.0, -30.0, -45.0, 30.0, 45.0, 60.0, 120.0, 135.0, 150.0, -120.0, -135.0, -150.0)
_ELEVATION = 24.0
_BETTER = 1.02  # by which another azimuth has to be better than those before it
_ASIDE, _ABOVE = np.radians(25.0), np.radians(16.0)
_FLAT = 1e-4  # of the robot's size


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
    """A view in which few frames hide each other.

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
        if best is None or score > best_score * _BETTER:
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
    """(3, 3) rows right, up, towards the viewer, who stands at these angles [rad] about `up`."""
    start = next(axis for axis in np.eye(3) if abs(axis @ up) < 0.6)
    east = start - (start @ up) * up
    east /= np.linalg.norm(east)
    north = np.cross(up, east)
    level = np.cos(azimuth) * east + np.sin(azimuth) * north
    towards = np.cos(elevation) * level + np.sin(elevation) * up
    right = np.cos(azimuth) * north - np.sin(azimuth) * east
    return np.array([right, np.cross(towards, right), towards])


def collect_joint_points(skeleton: Skeleton, u: np.ndarray) -> np.ndarray:
    """(n, 3) origins of frames and feet of axes, platform motions apart, each place once."""
    frames = compute_poses(skeleton, u)
    points = [np.zeros(3)]
    for i, row in enumerate(skeleton.rows):
        if row.virtual and row.joint.name != skeleton.robot.platform[-1]:
            continue
        points.append(frames[i][:3, 3])
        if not row.virtual:
            before = np.eye(4) if row.parent == BASE else frames[row.parent]
            points.append((before @ compute_foot_pose(row))[:3, 3])
    return np.unique(np.round(np.array(points), 9), axis=0)


def _are_parallel(axes: np.ndarray, normal: np.ndarray) -> bool:
    return bool(np.all(np.abs(axes @ normal) > 1.0 - 1e-6))


def _fit_plane_normal(points: np.ndarray, axes: np.ndarray, size: float) -> np.ndarray | None:
    """Of the plane that all points lie in; None if there is none.

    Where points are a line, the plane that the joints turn in.
    """
    if len(axes) and _are_parallel(axes, axes[0]) and np.ptp(points @ axes[0]) < _FLAT * size:
        return np.asarray(axes[0] if axes[0][np.argmax(np.abs(axes[0]))] > 0 else -axes[0])
    if len(points) < 3:
        return None
    _, lengths, directions = np.linalg.svd(points - points.mean(axis=0))
    if lengths[1] < _FLAT * size or lengths[2] > _FLAT * size:
        return None
    normal = directions[2]
    return np.asarray(normal if normal[np.argmax(np.abs(normal))] > 0 else -normal)


def _compute_spread(flat: np.ndarray, size: float) -> float:
    """How well points are told apart on the paper: mean distance, near pairs count most."""
    away = np.linalg.norm(flat[:, None] - flat[None], axis=2)[np.triu_indices(len(flat), 1)]
    return float(np.mean(np.minimum(away / size, 0.15))) if away.size else 0.0


# Where names stand in a picture: beside what they name, on nothing else.


_SIZE, _HIGH, _BLANK = 7.0, 7.5, 4.0  # points
_SAME = 4.0  # points: names nearer to each other are written together


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
    """The names where they are written: `at` is the left end of the text, at half its height.

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
        near = next((g for g in groups if np.hypot(*(g[0].at - name.at)) < _SAME), None)
        if near is None:
            groups.append([name])
        else:
            near.append(name)
    steps = np.linspace(0.0, 1.0, 60)[:, None]
    dense, bars = ([line[0] + steps * (line[1] - line[0]) for line in these]
                   for these in (lines, sleeves))  # fmt: skip
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
