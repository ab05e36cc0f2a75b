"""Printed quaternions and axes, and the turns by multiples of pi/12 that they round.

Quaternions are w x y z, as MuJoCo has them.
"""

import itertools
import math
from decimal import Decimal
from functools import cache

import numpy as np

from modeler.robot.angles import compute_cosine_sine
from modeler.robot.body_tree import Roundings

HIDDEN = 4e-6
"""What 1.5708 instead of pi/2 leaves in the components of a quaternion with more digits."""
ALIKE, EXACT = 1e-9, 1e-15


def snap_quaternion(quaternion: np.ndarray, rounded: Roundings) -> np.ndarray:
    """The quaternion of a turn by multiples of pi/12 that the printed one rounds, or itself."""
    return _snap_to_known(quaternion, _build_known_rotations(), rounded)


def snap_direction(direction: np.ndarray, rounded: Roundings) -> np.ndarray:
    """The direction in a coordinate plane that the printed axis rounds, or itself."""
    return _snap_to_known(direction, _build_known_directions(), rounded)


def compute_quaternion_rotation(quaternion: np.ndarray) -> np.ndarray:
    """(3, 3) of a quaternion of any length; what ought to be 0 or 1 is."""
    w, v = quaternion[0], quaternion[1:]
    across = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    turn = (w * w - v @ v) * np.eye(3) + 2.0 * (np.outer(v, v) + w * across)
    turn /= quaternion @ quaternion
    whole = np.round(turn)
    return np.where(np.abs(turn - whole) < EXACT, whole, turn) + 0.0


def _snap_to_known(vector: np.ndarray, known: np.ndarray, rounded: Roundings) -> np.ndarray:
    """The unit vector among the known ones that the printed one rounds; itself if there is none."""
    length = float(np.linalg.norm(vector))
    if not 0.99 < length < 1.01:
        return vector
    digits = max(-int(Decimal(repr(float(x))).as_tuple().exponent) for x in vector)
    if digits < 3:
        return vector
    allowed = 0.51 * 10.0**-digits if digits < 5 else max(10.0**-digits, HIDDEN)
    best: np.ndarray = known[np.argmax(known @ vector)]
    if np.max(np.abs(best - vector)) > allowed:
        return vector
    if np.max(np.abs(best - vector / length)) > ALIKE:
        rounded.angles[" ".join(f"{x:g}" for x in vector)] = "of multiples of pi/12"
    return best


@cache
def _build_known_rotations() -> np.ndarray:
    """(n, 4) quaternions of turns about three different axes by multiples of pi/12, both signs."""
    turns = np.zeros((3, 48, 4))
    for count, axis in itertools.product(range(48), range(3)):
        turns[axis, count, 0], turns[axis, count, axis + 1] = compute_cosine_sine(
            count * math.pi / 24
        )
    middle = [*range(7), *range(42, 48)]  # to a right angle
    return np.concatenate(
        [
            _multiply_quaternions(
                _multiply_quaternions(turns[i][:, None], turns[j][None, middle]).reshape(-1, 1, 4),
                turns[k][None, :24],
            ).reshape(-1, 4)
            for i, j, k in itertools.permutations(range(3))
        ]
    )


def _multiply_quaternions(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Quaternions a b, along the last axis."""
    head = a[..., :1] * b[..., :1] - np.sum(a[..., 1:] * b[..., 1:], axis=-1, keepdims=True)
    tail = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + np.cross(a[..., 1:], b[..., 1:])
    return np.concatenate([head, tail], axis=-1)


@cache
def _build_known_directions() -> np.ndarray:
    """(72, 3) unit vectors in the coordinate planes at multiples of pi/12."""
    plane = np.array([[*compute_cosine_sine(count * math.pi / 12), 0.0] for count in range(24)])
    return np.concatenate([np.roll(plane, k, axis=1) for k in range(3)])
