"""The page of a robot where two of its links come nearest: its capsules, and these two in red."""

from collections.abc import Iterator

import numpy as np

from modeler.excitation import BASE as STILL, ClosestApproach, CollisionGeometry, MotionBounds
from modeler.robot import Robot
from modeler.views.robot_closing import Posture
from modeler.views.robot_page import render_robot_page
from modeler.views.robot_scene import (
    BODIES,
    OPEN,
    Face,
    Label,
    Part,
    SceneLine,
    build_ball,
    build_cylinder,
)
from modeler.views.robot_skeleton import BASE, Skeleton, build_skeleton, estimate_robot_size

_CLEAR = 0.22  # opacity


def render_nearest_page(robot: Robot, bounds: MotionBounds, near: ClosestApproach) -> str:
    """The page as text, the joints as they stand there.

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


def _mark_gap(near: ClosestApproach) -> Iterator[Part]:
    """The way between the two."""
    one, other = ((BASE, (float(p[0]), float(p[1]), float(p[2]))) for p in near.points)
    yield SceneLine(BASE, (one, other), OPEN, 3.0, "gap")
    yield Label(BASE, one, f"{1e3 * near.distance:.1f} mm", OPEN, "names")


def _build_capsules(
    skeleton: Skeleton, solids: CollisionGeometry, pair: tuple[str, str]
) -> Iterator[Face]:
    """All capsules, each on its link; planes are not drawn."""
    moving = [i for i, row in enumerate(skeleton.rows) if row.joint.is_moving]
    for k, name in enumerate(solids.names[: len(solids.ends)]):
        carrier = int(solids.carriers[k])
        frame = BASE if carrier == STILL else moving[carrier]
        color = OPEN if name in pair else BODIES[k % len(BODIES)]
        for points in _build_capsule(solids.ends[k], float(solids.radius[k])):
            yield Face(frame, frame, points, color, "capsules", _CLEAR)


def _build_capsule(ends: np.ndarray, radius: float) -> Iterator[np.ndarray]:
    """Polygons of it."""
    way = ends[1] - ends[0]
    length = float(np.linalg.norm(way))
    for end in ends if length else ends[:1]:
        yield from (points + end for points in build_ball(radius))
    if length:
        # A turn that takes z along the way: columns of a QR factorisation that begins with it.
        turn = np.linalg.qr(np.column_stack([way, np.eye(3)]))[0][:, [1, 2, 0]]
        for points in build_cylinder(radius, length)[:-2]:
            yield points @ turn.T + ends.mean(axis=0)
