"""Closure equations of the loops, from the poses of the frames that meet."""

from collections.abc import Callable, Mapping, Sequence

from modeler.robot import Loop
from modeler.symbolic.algebra import Algebra
from modeler.symbolic.geometry import Geometry
from modeler.symbolic.graph import Expr
from modeler.symbolic.kinematics import Pose, dot, plus, poses_from, times

Frame = tuple[Sequence[list[Expr]], list[Expr]]
"""(axes x, y, z; origin) in one frame."""


def meeting(
    geometry: Geometry, loop: Loop, frames: Sequence[Pose], algebra: Algebra
) -> tuple[Frame, Frame]:
    """The two frames that meet, in the frame of the body that both their sides come from.

    There, and not in frame 0, components of a plane loop stay those of its plane however the body
    turns, and which equations are independent does not depend on it.

    Args:
        geometry: the table.
        loop: which frames meet, and how.
        frames: poses of the rows in their antecedent frames, in table order.
        algebra: of their entries.
    """
    places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    ends = [places.get(name) for name in (loop.frame, loop.meets)]
    sides = [[] if end is None else geometry.ancestors(end) for end in ends]
    root = next((k for k in sides[0] if k in sides[1]), None)
    posed = poses_from(geometry, frames, algebra, root, {k for k in ends if k is not None})
    return posed[ends[0]], posed[ends[1]]


def loop_equations(loop: Loop, one: Frame, other: Frame) -> list[Expr]:
    """Expressions that vanish where the loop is closed; some may be redundant.

    Lengths in m where positions are compared, cosines where directions are.

    Args:
        loop: how the frames meet.
        one: axes and origin of the first, as from `meeting`.
        other: those of the other.
    """
    return [value for value in _KINDS[loop.kind](one, other) if not value.is_zero]


def loop_alignments(loop: Loop, one: Frame, other: Frame) -> list[Expr]:
    """Expressions that are 1 where the loop is closed as meant, -1 with axes opposite.

    The equations compare directions by right angles, which opposite axes fulfil too.
    """
    return [dot(one[0][axis], other[0][axis]) for axis in _SAME_AXES[loop.kind]]


def _between(a: Frame, b: Frame) -> list[Expr]:
    return plus(a[1], times(-1, b[1]))


def _position(a: Frame, b: Frame) -> list[Expr]:
    return _between(a, b)


def _parallel(a: Frame, b: Frame) -> list[Expr]:
    return [dot(a[0][0], b[0][2]), dot(a[0][1], b[0][2])]


def _aligned(a: Frame, b: Frame) -> list[Expr]:
    return [*_parallel(a, b), dot(a[0][0], b[0][1])]


def _on_axis(a: Frame, b: Frame) -> list[Expr]:
    way = _between(b, a)
    return [dot(a[0][0], way), dot(a[0][1], way)]


_KINDS: Mapping[str, Callable[[Frame, Frame], list[Expr]]] = {
    "position": _position,
    "spherical": _position,
    "universal": lambda a, b: [*_position(a, b), dot(a[0][2], b[0][2])],
    "revolute": lambda a, b: [*_position(a, b), *_parallel(a, b)],
    "cylindrical": lambda a, b: [*_on_axis(a, b), *_parallel(a, b)],
    "prismatic": lambda a, b: [*_on_axis(a, b), *_aligned(a, b)],
    "planar": lambda a, b: [dot(a[0][2], _between(b, a)), *_parallel(a, b)],
    "rigid": lambda a, b: [*_position(a, b), *_aligned(a, b)],
}

MEETING = ("position", "spherical", "universal", "revolute", "rigid")
"""Kinds of loops whose origins coincide."""

_SAME_AXES: Mapping[str, tuple[int, ...]] = {
    "position": (), "spherical": (), "universal": (), "revolute": (2,), "cylindrical": (2,),
    "planar": (2,), "prismatic": (0, 2), "rigid": (0, 2),
}  # fmt: skip
