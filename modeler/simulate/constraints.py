"""What ties the joints of a simulated robot: relations and loops, as equations in all joints.

Whole frames are compared here (nine direction cosines where three would do) and closed by least
squares, and torques come from Lagrange multipliers: nothing is shared with the modeling stages.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.core.errors import DataError
from modeler.robot import Robot
from modeler.simulate.geometry import FUNCTIONS, Frame, world_frames

_CLOSED = 1e-11
_ITERATIONS = 40
_LONGEST = 0.2  # rad or m, of one Newton step
_RANK = 1e-10


@dataclass(frozen=True)
class Constraints:
    """c(v) = 0 for the variables v of all moving rows.

    Attributes:
        given: places in v of the coordinates that follow the commanded motion.
        others: places of the rest.
        value: v -> c.
        slope: v -> dc/dv.
        curvature: (v, vd) -> d/dt(dc/dv) vd.
    """

    given: list[int]
    others: list[int]
    value: ca.Function
    slope: ca.Function
    curvature: ca.Function


def constraints_of(robot: Robot) -> Constraints:
    """The equations of a robot's relations and loops."""
    moving = robot.moving
    v, vd = ca.SX.sym("v", len(moving)), ca.SX.sym("vd", len(moving))
    names = [joint.name for joint in moving]
    variables = {joint.variable: v[i] for i, joint in enumerate(moving)}
    values = {**robot.symbol_values(), **variables}
    rows = [
        v[names.index(name)] - relation.fold(values, FUNCTIONS, float(np.pi), float)
        for name, relation in robot.relations.items()
    ]
    frames = world_frames(robot, v)
    for loop in robot.loops:
        rows += _KINDS[loop.kind](frames[loop.frame], frames[loop.meets])
    c = ca.vertcat(*rows)
    slope = ca.jacobian(c, v)
    given = [names.index(joint.name) for joint in robot.coordinates]
    return Constraints(
        given=given,
        others=[i for i in range(len(names)) if i not in given],
        value=ca.Function("c", [v], [c]),
        slope=ca.Function("J", [v], [ca.densify(slope)]),
        curvature=ca.Function("k", [v, vd], [ca.jtimes(slope @ vd, v, vd)]),
    )


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


def followed(
    robot: Robot,
    constraints: Constraints,
    q: np.ndarray,
    progress: Callable[[float], None] | None = None,
) -> np.ndarray:
    """(n, moving rows) closed postures along (n, coordinates) positions, each near the one before.

    Raises:
        DataError: the loops do not close on the way; says where.
    """
    names = [joint.name for joint in robot.moving]
    v = np.array([robot.home.get(name, 0.0) for name in names])
    v = _solved(constraints, v)
    if v is None:
        raise DataError(f"simulation: {robot.name} does not close at [home]; correct the posture")
    way = np.linspace(0.0, 1.0, 60)[1:, None]
    for step in v[constraints.given] + way * (q[0] - v[constraints.given]):
        v = _moved(robot, constraints, v, step, "on the way from [home] to the first sample")
    out = np.empty((len(q), len(names)))
    for i, position in enumerate(q):
        out[i] = v = _moved(robot, constraints, v, position, f"at sample {i + 1}")
        if progress is not None and i % 500 == 0:
            progress(i / len(q))
    return out


def _moved(
    robot: Robot, constraints: Constraints, v: np.ndarray, q: np.ndarray, where: str
) -> np.ndarray:
    start = v.copy()
    start[constraints.given] = q
    found = _solved(constraints, start)
    if found is None or np.max(np.abs(found - v)) > 4 * _LONGEST:
        joints = ", ".join(joint.name for joint in robot.coordinates)
        values = ", ".join(f"{x:.4g}" for x in q)
        raise DataError(
            f"simulation: the loops of {robot.name} do not close {where}, joints {joints} at "
            f"{values}; shrink [limits]"
        )
    return found


def _solved(constraints: Constraints, v: np.ndarray) -> np.ndarray | None:
    """Newton on the rows that are not given, by least squares; None if it does not converge."""
    v = v.copy()
    for _ in range(_ITERATIONS):
        c = constraints.value(v).full().ravel()
        if np.max(np.abs(c), initial=0.0) < _CLOSED:
            return v
        J = constraints.slope(v).full()[:, constraints.others]
        step = np.linalg.lstsq(J, -c, rcond=_RANK)[0]
        v[constraints.others] += step * min(1.0, _LONGEST / np.max(np.abs(step)))
    return None


def rates(
    constraints: Constraints, v: np.ndarray, qd: np.ndarray, qdd: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """(n, moving rows) speeds and accelerations that the constraints allow."""
    given, others = constraints.given, constraints.others
    vd, vdd = np.zeros_like(v), np.zeros_like(v)
    vd[:, given], vdd[:, given] = qd, qdd
    for i, posture in enumerate(v):
        J = constraints.slope(posture).full()
        inverse = np.linalg.pinv(J[:, others], rcond=_RANK)
        vd[i, others] = -inverse @ (J[:, given] @ qd[i])
        bend = constraints.curvature(posture, vd[i]).full().ravel()
        vdd[i, others] = -inverse @ (J[:, given] @ qdd[i] + bend)
    return vd, vdd


def motor_torques(constraints: Constraints, v: np.ndarray, load: np.ndarray) -> np.ndarray:
    """(n, coordinates) motor torques that, with constraint forces, make up the joints' load.

    M vdd + h = S tau + J^T lambda: solved for tau and the multipliers lambda together.

    Args:
        constraints: the equations.
        v: (n, moving rows) postures.
        load: (n, moving rows) M vdd + h, friction included.
    """
    count = len(constraints.given)
    S = np.zeros((v.shape[1], count))
    S[constraints.given, np.arange(count)] = 1.0
    tau = np.empty((len(v), count))
    for i, posture in enumerate(v):
        J = constraints.slope(posture).full()
        tau[i] = np.linalg.lstsq(np.hstack([S, J.T]), load[i], rcond=_RANK)[0][:count]
    return tau
