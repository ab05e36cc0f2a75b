"""What ties the joints of a simulated robot: relations and loops, as equations in all joints.

Whole frames are compared here (nine direction cosines where three would do): nothing is shared
with the loop equations of the modeling stages.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from modeler.robot import Robot
from modeler.simulate.geometry import FUNCTIONS, Frame, world_frames


@dataclass(frozen=True)
class Constraints:
    """c(v) = 0 for the variables v of all moving rows.

    Attributes:
        given: places in v of the coordinates that follow the commanded motion.
        others: places of the rest.
        value: v -> c.
        slope: v -> J = dc/dv.
        curvature: (v, vd) -> J' vd, so that J vdd + J' vd = 0.
        units: (moving rows,) 1 for an angle, the robot's size [m] for a travel.
    """

    given: list[int]
    others: list[int]
    value: ca.Function
    slope: ca.Function
    curvature: ca.Function
    units: np.ndarray


def constraints_of(robot: Robot) -> Constraints:
    """The equations of a robot's relations and loops; lengths in sizes of the robot."""
    moving = robot.moving
    v, vd = ca.SX.sym("v", len(moving)), ca.SX.sym("vd", len(moving))
    names = [joint.name for joint in moving]
    variables = {joint.variable: v[i] for i, joint in enumerate(moving)}
    values = {**robot.symbol_values(), **variables}
    rows = [
        v[names.index(name)] - relation.fold(values, FUNCTIONS, float(np.pi), float)
        for name, relation in robot.relations.items()
    ]
    size = _size(robot)
    frames = {
        name: Frame(frame.rotation, frame.position / size, frame.axis)
        for name, frame in world_frames(robot, v).items()
    }
    for loop in robot.loops:
        rows += _KINDS[loop.kind](frames[loop.frame], frames[loop.meets])
    c = ca.vertcat(*rows)
    slope = ca.jacobian(c, v)
    given = [names.index(joint.name) for joint in robot.coordinates]
    bend = ca.jtimes(slope @ vd, v, vd)
    return Constraints(
        given=given,
        others=[i for i in range(len(names)) if i not in given],
        value=ca.Function("c", [v], [ca.densify(ca.cse(c))]),
        slope=ca.Function("J", [v], [ca.densify(ca.cse(slope))]),
        curvature=ca.Function("k", [v, vd], [ca.densify(ca.cse(bend))]),
        units=np.array([1.0 if joint.angular else size for joint in moving]),
    )


def _size(robot: Robot) -> float:
    """The largest of the robot's lengths, m; 1 where none has a symbol."""
    values = robot.symbol_values().items()
    return max((abs(value) for name, value in values if name != "g"), default=1.0) or 1.0


def sampled(function: ca.Function, *samples: np.ndarray) -> np.ndarray:
    """(n, rows, columns) of a function of vectors, for samples (n, its length) of each."""
    rows, columns = function.size_out(0)
    count = len(samples[0])
    mapped: Any = function.map(count)
    values, inputs = np.zeros((count, columns, rows)), [np.ascontiguousarray(s) for s in samples]
    assert mapped.nnz_out(0) == values.size
    # Through the buffer: CasADi's own matrices are slow to turn into arrays.
    buffer, evaluate = mapped.buffer()
    for i, array in enumerate(inputs):
        buffer.set_arg(i, array.data)
    buffer.set_res(0, values.data)
    evaluate()
    return values.transpose(0, 2, 1)


def _position(a: Frame, b: Frame) -> list[ca.SX]:
    return [a.position - b.position]


def _same_axis(a: Frame, b: Frame) -> list[ca.SX]:
    return [a.rotation[:, 2] - b.rotation[:, 2]]


def _same_axes(a: Frame, b: Frame) -> list[ca.SX]:
    return [ca.vec(a.rotation - b.rotation)]


def _beside(a: Frame, b: Frame) -> list[ca.SX]:
    return [ca.cross(a.rotation[:, 2], b.position - a.position)]


_KINDS: Mapping[str, Callable[[Frame, Frame], list[ca.SX]]] = {
    "position": _position,
    "spherical": _position,
    "universal": lambda a, b: [*_position(a, b), ca.dot(a.rotation[:, 2], b.rotation[:, 2])],
    "revolute": lambda a, b: [*_position(a, b), *_same_axis(a, b)],
    "cylindrical": lambda a, b: [*_beside(a, b), *_same_axis(a, b)],
    "prismatic": lambda a, b: [*_beside(a, b), *_same_axes(a, b)],
    "planar": lambda a, b: [
        ca.dot(a.rotation[:, 2], b.position - a.position), *_same_axis(a, b)
    ],
    "rigid": lambda a, b: [*_position(a, b), *_same_axes(a, b)],
}  # fmt: skip
