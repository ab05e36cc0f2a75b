"""Closure equations of the loops, from the poses of the frames that meet."""

from collections.abc import Callable, Mapping, Sequence

from modeler.robot import Loop
from modeler.symbolic.geometry import Geometry
from modeler.symbolic.graph import Expr
from modeler.symbolic.kinematics import dot, plus, times

Frame = tuple[Sequence[list[Expr]], list[Expr]]
"""(axes x, y, z; origin) in frame 0."""


def loop_equations(geometry: Geometry, loop: Loop, frames: Sequence[Frame]) -> list[Expr]:
    """Expressions that vanish where the loop is closed; some may be redundant.

    Lengths in m where positions are compared, cosines where directions are.

    Args:
        geometry: the table.
        loop: which frames meet, and how.
        frames: poses of the rows in frame 0, in table order.
    """
    places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    one = frames[places[loop.frame]]
    other = _base(one) if loop.meets == "0" else frames[places[loop.meets]]
    return [value for value in _KINDS[loop.kind](one, other) if not value.is_zero]


def loop_alignments(geometry: Geometry, loop: Loop, frames: Sequence[Frame]) -> list[Expr]:
    """Expressions that are 1 where the loop is closed as meant, -1 with axes opposite.

    The equations compare directions by right angles, which opposite axes fulfil too.
    """
    places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    one = frames[places[loop.frame]]
    other = _base(one) if loop.meets == "0" else frames[places[loop.meets]]
    return [dot(one[0][axis], other[0][axis]) for axis in _SAME_AXES[loop.kind]]


def _base(like: Frame) -> Frame:
    graph = like[1][0].graph
    zero, unit = graph.constant(0), graph.constant(1)
    axes = [[unit if i == j else zero for j in range(3)] for i in range(3)]
    return axes, [zero] * 3


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

_SAME_AXES: Mapping[str, tuple[int, ...]] = {
    "position": (), "spherical": (), "universal": (), "revolute": (2,), "cylindrical": (2,),
    "planar": (2,), "prismatic": (0, 2), "rigid": (0, 2),
}  # fmt: skip
