"""Rows of a table as numbers: where their frames are, what their variables follow."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from modeler.core.errors import DataError
from modeler.robot import (
    Joint,
    JointKind,
    LinkFrame,
    Loop,
    Pose,
    Robot,
    compute_axis_rotation,
    extract_linear_form,
)

BASE = "0"
"""Name of the frame that stands still."""

SAME_GRAVITY = 2e-3
"""Share of gravity: 9.80665 is 9.81 in other digits."""

_X, _Y, _Z = np.eye(3)
_CLOSED = 1e-9  # m, rad: what may be left of a loop


def compute_frame_pose(frame: LinkFrame, symbols: Mapping[str, float]) -> Pose:
    """Pose of a link's frame on its row."""
    position = np.array([cell.evaluate(symbols) for cell in frame.position])
    return Pose(position, compute_rpy_rotation([cell.evaluate(symbols) for cell in frame.angles]))


def compute_rpy_rotation(angles: Sequence[float]) -> np.ndarray:
    """(3, 3) Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = angles
    return (
        compute_axis_rotation(_Z, yaw)
        @ compute_axis_rotation(_Y, pitch)
        @ compute_axis_rotation(_X, roll)
    )


def compute_row_pose(joint: Joint, values: Mapping[str, float]) -> Pose:
    """T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r).

    Args:
        joint: the row.
        values: of the symbols, and of its variable if it has one.
    """
    gamma, b, alpha, d, theta, r = (
        cell.evaluate(values)
        for cell in (joint.gamma, joint.b, joint.alpha, joint.d, joint.theta, joint.r)
    )
    foot = Pose(b * _Z, compute_axis_rotation(_Z, gamma))
    return (
        foot
        @ Pose(d * (compute_axis_rotation(_X, alpha) @ _X), compute_axis_rotation(_X, alpha))
        @ Pose(r * _Z, compute_axis_rotation(_Z, theta))
    )


def compute_gravity(robot: Robot) -> np.ndarray:
    """(3,) acceleration of gravity in frame 0."""
    symbols = robot.evaluate_symbols()
    return np.array([cell.evaluate(symbols) for cell in robot.gravity])


def get_variable_sign(joint: Joint, symbols: Mapping[str, float]) -> float:
    """1.0, or -1.0 where the table has the variable of the row with a minus."""
    cell = joint.theta if joint.kind is JointKind.REVOLUTE else joint.r
    return float(np.sign(extract_linear_form(cell, symbols).coefficients[joint.variable]))


def evaluate_variables(robot: Robot, q: Mapping[str, float]) -> dict[str, float]:
    """Values of the symbols and of all joint variables, those that follow others included.

    Args:
        robot: its relations.
        q: by row; rows that are left out, and follow no other, stand at 0.
    """
    values = robot.evaluate_symbols()
    free = [joint for joint in robot.moving_joints if joint.name not in robot.relations]
    values |= {joint.variable: float(q.get(joint.name, 0.0)) for joint in free}
    waiting = dict(robot.relations)
    while waiting:
        ready = [row for row, cell in waiting.items() if cell.names <= values.keys()]
        for row in ready or list(waiting):
            values[f"q{row}"] = waiting.pop(row).evaluate(values)
    return values


def compute_row_poses(robot: Robot, q: Mapping[str, float]) -> dict[str, Pose]:
    """Pose of every row's frame in frame 0, and of frame 0, by row."""
    values, poses = evaluate_variables(robot, q), {BASE: Pose()}
    for joint in robot.joints:
        poses[joint.name] = poses[joint.antecedent] @ compute_row_pose(joint, values)
    return poses


# Loops.

CLOSED_BY = ("spherical", "position", "revolute", "rigid")
"""Kinds of loops that points which meet can state."""


def close_loops(robot: Robot) -> dict[str, float]:
    """Every joint variable at [home], by row, the passive ones moved until the loops close.

    Raises:
        DataError: a loop of another kind; the loops do not close near [home].
    """
    from scipy.optimize import least_squares  # a fit has no use for it

    names = [joint.name for joint in robot.moving_joints]
    if robot.loops:
        for loop in robot.loops:
            if loop.kind not in CLOSED_BY:
                raise DataError(
                    f"{robot.name}: loop {loop.name} is {loop.kind}, which is not written; "
                    f"expected one of {', '.join(CLOSED_BY)}, or cut the loops"
                )
        leading_rows = {joint.name for joint in robot.coordinates} | set(robot.relations)
        passive = [name for name in names if name not in leading_rows]

        def compute_gaps(x: np.ndarray) -> np.ndarray:
            at = compute_row_poses(robot, {**robot.home, **dict(zip(passive, x, strict=True))})
            return np.concatenate([_compute_gap(loop, at) for loop in robot.loops])

        start = np.array([robot.home.get(name, 0.0) for name in passive])
        solution = least_squares(compute_gaps, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if np.abs(solution.fun).max() > _CLOSED:
            raise DataError(
                f"{robot.name}: its loops do not close near [home]; find it with `modeler home`"
            )
        robot = replace(robot, home={**robot.home, **dict(zip(passive, solution.x, strict=True))})
    values = evaluate_variables(robot, robot.home)
    return {name: values[f"q{name}"] for name in names}


def _compute_gap(loop: Loop, at: Mapping[str, Pose]) -> np.ndarray:
    """What is left of a loop: the points apart, and the axes, m and rad."""
    apart = at[loop.frame].inverse() @ at[loop.meets]
    R = apart.rotation
    if loop.kind == "revolute":
        return np.array([*apart.position, R[0, 2], R[1, 2]])
    if loop.kind == "rigid":
        return np.array([*apart.position, R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return apart.position
