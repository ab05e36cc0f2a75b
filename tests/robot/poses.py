"""Poses of links by the definitions of `[frames]`: nothing of the reader's is in them."""

from collections.abc import Mapping

import numpy as np

from modeler.robot.robot import Robot
from tests.elementary_motions import frames, shift, turn


def origin_pose(position, angles) -> np.ndarray:
    """(4, 4) of x, y, z and of roll, pitch, yaw: T(position) Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = angles
    steps = [shift(k, x) for k, x in enumerate(position)]
    return np.linalg.multi_dot([*steps, turn(2, yaw), turn(1, pitch), turn(0, roll)])


def place_on_row(robot: Robot, link: str, values: Mapping[str, float]) -> np.ndarray:
    """Of the frame of a link on the row that carries it; values of symbols."""
    frame = robot.frames[link]
    cells = ([x.evaluate(values) for x in part] for part in (frame.position, frame.angles))
    return origin_pose(*cells)


def link_poses(robot: Robot, q) -> dict[str, np.ndarray]:
    """Of the frame of every link in frame 0."""
    rows, values = frames(robot, q), robot.evaluate_symbols()
    return {
        link: rows[frame.row] @ place_on_row(robot, link, values)
        for link, frame in robot.frames.items()
    }
