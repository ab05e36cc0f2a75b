"""Shapes of joints: lists of flat polygons, (corners, 3) each, around the origin, axis along z."""

import numpy as np

_SIDES = 14


def cylinder(radius: float, length: float) -> list[np.ndarray]:
    """A cylinder."""
    angle = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle], axis=1)
    half = np.array([0.0, 0.0, 0.5 * length])
    top, bottom = ring + half, ring - half
    sides = [np.array([bottom[k], bottom[k + 1], top[k + 1], top[k]]) for k in range(_SIDES)]
    return [*sides, top[:-1], bottom[-1:0:-1]]


def box(half: float, low: float, high: float) -> list[np.ndarray]:
    """A square prism from z = low to high, 2 half wide."""
    ring = half * np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    top = np.column_stack([ring, np.full(4, high)])
    bottom = np.column_stack([ring, np.full(4, low)])
    sides = [np.array([bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]]) for k in range(4)]
    return [*sides, top, bottom[::-1]]


def ball(radius: float) -> list[np.ndarray]:
    """A ball, as rings of polygons."""
    rings, turns = 5, 10
    polar = np.pi * np.arange(rings + 1) / rings
    angle = 2.0 * np.pi * np.arange(turns + 1) / turns

    def point(i: int, k: int) -> np.ndarray:
        s, c = np.sin(polar[i]), np.cos(polar[i])
        return radius * np.array([s * np.cos(angle[k]), s * np.sin(angle[k]), c])

    return [
        np.array([point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)])
        for i in range(rings)
        for k in range(turns)
    ]


def ordered_polygon(points: np.ndarray, size: float) -> np.ndarray | None:
    """The points in the order around their middle, in their best plane; None if they are a line."""
    if len(points) < 3:
        return None
    middle = points - points.mean(axis=0)
    _, lengths, axes = np.linalg.svd(middle)
    if lengths[1] < 1e-3 * size:
        return None
    angle = np.arctan2(middle @ axes[1], middle @ axes[0])
    return np.asarray(points[np.argsort(angle, kind="stable")])
