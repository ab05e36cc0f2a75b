"""Where the frames are: poses from the table, and what a joint moves."""

import numpy as np

from modeler.show.skeleton import BASE, Row, Skeleton


def poses(skeleton: Skeleton, u: np.ndarray) -> np.ndarray:
    """(rows, 4, 4) poses of all frames in frame 0.

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) (Khalil and Kleinfinger 1986).

    Args:
        skeleton: the table.
        u: (free,) variables; may be complex, for derivatives.
    """
    found = np.empty((len(skeleton.rows), 4, 4), dtype=np.result_type(u, float))
    for i, row in enumerate(skeleton.rows):
        before = np.eye(4) if row.parent == BASE else found[row.parent]
        q = row.constant + row.coefficients @ u
        found[i] = before @ foot(row) @ _screw_z(*_moved(row, q))
    return found


def foot(row: Row) -> np.ndarray:
    """(4, 4) pose of the foot of the joint axis in the antecedent frame: before theta and r."""
    cells = row.cells
    tilt = np.eye(4)
    c, s = np.cos(cells["alpha"]), np.sin(cells["alpha"])
    tilt[1:3, 1:3] = [[c, -s], [s, c]]
    tilt[0, 3] = cells["d"]
    return np.asarray(_screw_z(cells["gamma"], cells["b"]) @ tilt)


def corner(row: Row) -> np.ndarray:
    """(3,) where the common normal leaves the antecedent's z axis, in the antecedent frame."""
    return np.array([0.0, 0.0, row.cells["b"]])


def _moved(row: Row, q: complex | float) -> tuple[complex | float, complex | float]:
    theta, r = row.cells["theta"], row.cells["r"]
    if row.joint.angular:
        return theta + row.rate * q, r
    return theta, r + row.rate * q


def _screw_z(angle: complex | float, travel: complex | float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, travel], [0, 0, 0, 1]])


def size_of(skeleton: Skeleton, u: np.ndarray) -> float:
    """A length of the robot, m: the diagonal of the box around its frames; 1 without any extent."""
    frames = poses(skeleton, u)
    points = [np.zeros(3)]
    for i, row in enumerate(skeleton.rows):
        before = np.eye(4) if row.parent == BASE else frames[row.parent]
        points += [frames[i][:3, 3], (before @ foot(row))[:3, 3]]
    span = np.ptp(np.array(points), axis=0)
    size = float(np.linalg.norm(span))
    return 1.0 if size <= 1e-9 else size
