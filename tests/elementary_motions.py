"""Poses of frames, written from the definition of the table: one elementary motion after another.

Shares nothing with the tool but the numbers in the cells.
"""

import numpy as np

from modeler.robot.read import read_robot


def turn(axis, angle):
    """Homogeneous rotation about a coordinate axis."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    pose = np.eye(4)
    pose[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    return pose


def shift(axis, length):
    pose = np.eye(4)
    pose[axis, 3] = length
    return pose


def row_pose(gamma=0.0, b=0.0, alpha=0.0, d=0.0, theta=0.0, r=0.0):
    """Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r)."""
    motions = [turn(2, gamma), shift(2, b), turn(0, alpha)]
    motions += [shift(0, d), turn(2, theta), shift(2, r)]
    return np.linalg.multi_dot(motions)


def placed(row, values):
    """Rotation and origin of a row in its antecedent, its variable at 0, and its sign."""
    at_zero = values | {row.variable: 0.0}
    columns = ("gamma", "b", "alpha", "d", "theta", "r")
    pose = row_pose(**{column: getattr(row, column).evaluate(at_zero) for column in columns})
    moving = row.theta if row.is_revolute else row.r
    sign = (
        moving.evaluate(values | {row.variable: 1.0}) - moving.evaluate(at_zero)
        if row.is_moving
        else 0
    )
    return pose[:3, :3], pose[:3, 3], sign


def frames(robot, q):
    """Poses of all frames in frame 0, by row; robot or its name, q by joint or in table order."""
    robot = read_robot(robot) if isinstance(robot, str) else robot
    if not isinstance(q, dict):
        q = {joint.name: value for joint, value in zip(robot.moving_joints, q, strict=True)}
    values = robot.evaluate_symbols() | {f"q{joint}": value for joint, value in q.items()}
    poses = {"0": np.eye(4)}
    for joint in robot.joints:
        cells = {
            column: getattr(joint, column).evaluate(values)
            for column in ("gamma", "b", "alpha", "d", "theta", "r")
        }
        poses[joint.name] = poses[joint.antecedent] @ row_pose(**cells)
    return poses
