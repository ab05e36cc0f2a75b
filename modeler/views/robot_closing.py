"""Loops: how far they are open, and postures in which they are closed.

Axes are compared as vectors, not by right angles, so that axes that are opposite are not taken for
closed; Gauss-Newton in the sense of least squares, derivatives by complex steps. The page does the
same in JavaScript (closing.js).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.robot import Loop
from modeler.views.robot_skeleton import BASE, Skeleton, compute_poses, estimate_robot_size

CLOSED = 1e-9
"""Largest residual of a closed loop: of the robot's size, and of direction cosines."""

_ENOUGH = 1e-13
_ITERATIONS = 100
_LONGEST = 0.3  # rad or robot sizes, of one step
_RANK = 1e-9
_SINGULAR = 1e-6  # of the largest singular value; a residual of 1e-13 leaves its square root
_COMPLEX_STEP = 1e-30


@dataclass(frozen=True)
class LoopGap:
    """How far a loop is open.

    Attributes:
        loop: which.
        distance: m, between what should meet: points, axes, or planes.
        angle: rad, between directions that should agree; 0 where none should.
        way: (3, 3) from the origin of one frame, along what the joint lets free, to that of the
            other: three points in frame 0, the gap between the last two.
    """

    loop: Loop
    distance: float
    angle: float
    path: np.ndarray


@dataclass(frozen=True)
class Posture:
    """A posture to look at.

    Attributes:
        u: (free,) variables.
        size: a length of the robot there, m.
        closed: True if all loops are closed.
        held: True if the actuated joints stand where [home] states them.
        loose: joints that could move there with the actuated joints locked: the posture is
            singular, or the loops determine too little.
        note: a line on where the posture comes from; "" for [home] as the file states it.
    """

    u: np.ndarray
    size: float
    closed: bool
    held: bool
    loose: tuple[str, ...] = ()
    note: str = ""


def find_home_posture(skeleton: Skeleton) -> Posture:
    """[home] with its loops closed by the passive joints, else by all; else as it is stated."""
    stated = skeleton.stated
    size = estimate_robot_size(skeleton, stated)
    for places, held in ((skeleton.dependent_places, True), (tuple(range(len(stated))), False)):
        closed_u = solve_closure(skeleton, stated, places, size)
        if closed_u is not None:
            return Posture(
                closed_u,
                estimate_robot_size(skeleton, closed_u),
                True,
                held,
                _find_loose_joints(skeleton, closed_u),
            )
    return Posture(stated, size, False, True)


def _find_loose_joints(skeleton: Skeleton, u: np.ndarray) -> tuple[str, ...]:
    """Names of the joints that the loops leave undetermined at u to first order."""
    places = skeleton.dependent_places
    if not places or not skeleton.robot.loops:
        return ()
    size = estimate_robot_size(skeleton, u)
    J = (
        compute_jacobian(skeleton, u, size, places)
        * np.where(skeleton.is_travel, size, 1.0)[list(places)]
    )
    _, sizes, turned = np.linalg.svd(J)
    idle = turned[int(np.sum(sizes > _SINGULAR * sizes[0])) :]
    if not len(idle):
        return ()
    share = np.max(np.abs(idle), axis=0)
    return tuple(
        skeleton.free[k] for k, s in zip(places, share, strict=True) if s > 0.1 * np.max(share)
    )


def solve_closure(
    skeleton: Skeleton, start: np.ndarray, places: Sequence[int], size: float
) -> np.ndarray | None:
    """The closed posture that is found from `start` by moving `places`; None if none is.

    Args:
        skeleton: the robot.
        start: (free,) where to begin.
        places: in u, of what may move.
        size: a length of the robot, m.
    """
    u = np.array(start, dtype=float)
    scale = np.where(skeleton.is_travel, size, 1.0)[list(places)]
    for _ in range(_ITERATIONS):
        f = compute_residuals(skeleton, u, size)
        if np.max(np.abs(f), initial=0.0) < _ENOUGH or not places:
            break
        J = compute_jacobian(skeleton, u, size, places) * scale
        step = np.linalg.lstsq(J, -f, rcond=_RANK)[0]
        step *= min(1.0, _LONGEST / max(float(np.max(np.abs(step))), 1e-300))
        u[list(places)] += step * scale
        if np.max(np.abs(step)) < 1e-15:
            break
    f = compute_residuals(skeleton, u, size)
    return u if np.max(np.abs(f), initial=0.0) < CLOSED else None


def compute_jacobian(
    skeleton: Skeleton, u: np.ndarray, size: float, places: Sequence[int]
) -> np.ndarray:
    """(equations, places) derivatives of `compute_residuals`."""
    columns = []
    for k in places:
        moved = u.astype(complex)
        moved[k] += 1j * _COMPLEX_STEP
        columns.append(compute_residuals(skeleton, moved, size).imag / _COMPLEX_STEP)
    return np.array(columns).T


def compute_residuals(skeleton: Skeleton, u: np.ndarray, size: float) -> np.ndarray:
    """What vanishes where the loops are closed: lengths in robot sizes, direction cosines."""
    frames = compute_poses(skeleton, u)
    parts = [
        np.atleast_1d(value)
        for loop in skeleton.robot.loops
        for value in _KINDS[loop.kind](*_select_loop_frames(skeleton, frames, loop), size)
    ]
    return np.concatenate(parts) if parts else np.zeros(0)


def _select_loop_frames(
    skeleton: Skeleton, frames: np.ndarray, loop: Loop
) -> tuple[np.ndarray, np.ndarray]:
    numbers = (skeleton.find_row(loop.frame), skeleton.find_row(loop.meets))
    one, other = (np.eye(4) if i == BASE else frames[i] for i in numbers)
    return one, other


def _compute_offset(a: np.ndarray, b: np.ndarray, size: float) -> np.ndarray:
    return np.asarray((b[:3, 3] - a[:3, 3]) / size)


def _compute_axis_difference(a: np.ndarray, b: np.ndarray, number: int) -> np.ndarray:
    return np.asarray(a[:3, number] - b[:3, number])


def _compute_lateral_offset(a: np.ndarray, b: np.ndarray, size: float) -> np.ndarray:
    return np.cross(a[:3, 2], _compute_offset(a, b, size))


_KINDS: Mapping[str, Callable[[np.ndarray, np.ndarray, float], list[np.ndarray]]] = {
    "position": lambda a, b, s: [_compute_offset(a, b, s)],
    "spherical": lambda a, b, s: [_compute_offset(a, b, s)],
    "universal": lambda a, b, s: [_compute_offset(a, b, s), a[:3, 2] @ b[:3, 2]],
    "revolute": lambda a, b, s: [_compute_offset(a, b, s), _compute_axis_difference(a, b, 2)],
    "cylindrical": lambda a, b, s: [
        _compute_lateral_offset(a, b, s),
        _compute_axis_difference(a, b, 2),
    ],
    "prismatic": lambda a, b, s: [
        _compute_lateral_offset(a, b, s),
        _compute_axis_difference(a, b, 2),
        _compute_axis_difference(a, b, 0),
    ],
    "planar": lambda a, b, s: [
        a[:3, 2] @ _compute_offset(a, b, s),
        _compute_axis_difference(a, b, 2),
    ],
    "rigid": lambda a, b, s: [
        _compute_offset(a, b, s),
        _compute_axis_difference(a, b, 2),
        _compute_axis_difference(a, b, 0),
    ],
}


def compute_gaps(skeleton: Skeleton, u: np.ndarray) -> tuple[LoopGap, ...]:
    """How far every loop is open at u."""
    frames = compute_poses(skeleton, u)
    gaps = []
    for loop in skeleton.robot.loops:
        a, b = _select_loop_frames(skeleton, frames, loop)
        way, z = b[:3, 3] - a[:3, 3], a[:3, 2]
        allowed = np.zeros(3)
        if loop.kind in ("cylindrical", "prismatic"):
            allowed = z * (z @ way)
        elif loop.kind == "planar":
            allowed = way - z * (z @ way)
        points = np.array([a[:3, 3], a[:3, 3] + allowed, b[:3, 3]])
        distance = float(np.linalg.norm(way - allowed))
        gaps.append(LoopGap(loop, distance, _compute_gap_angle(loop.kind, a, b), points))
    return tuple(gaps)


def _compute_gap_angle(kind: str, a: np.ndarray, b: np.ndarray) -> float:
    """The largest angle between directions that should agree."""
    if kind in ("position", "spherical"):
        return 0.0
    if kind == "universal":
        return float(abs(np.arcsin(np.clip(a[:3, 2] @ b[:3, 2], -1.0, 1.0))))
    axes = (0, 2) if kind in ("rigid", "prismatic") else (2,)
    chords = [float(np.linalg.norm(_compute_axis_difference(a, b, k))) for k in axes]
    return 2.0 * float(np.arcsin(min(1.0, max(chords) / 2.0)))
