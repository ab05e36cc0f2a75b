"""Pieces of logs in which one joint moves alone, and what the model says of its torque there."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.estimation.thresholds import THRESHOLDS
from modeler.regression import Observation, find_runs
from modeler.runtime import CompiledModel

# Where one joint moves and the others stand: the pieces of logs that a two-step fit uses.


_SEVERAL, _NONE = -2, -1


class JointDirections:
    """Describes how the coordinates move with each joint: q = a D, a the positions of the joints.

    For logs of the joints D is the identity; for logs of motors its rows are the columns of G,
    q_m = G q_a (Hanssen, Hovland and Brogardh 2000, section 5).

    Attributes:
        names: (n,) of the joints.
        rows: (n, n) D; row i is the speed of the coordinates at speed 1 of joint i alone.
    """

    def __init__(self, ways: Mapping[str, tuple[float, ...]]) -> None:
        self.names = tuple(ways)
        self.rows = np.array([*ways.values()])
        self._inverse = np.linalg.inv(self.rows)

    def convert_to_joints(self, coordinates: np.ndarray) -> np.ndarray:
        """Returns (..., n) positions, speeds or accelerations of the joints."""
        return coordinates @ self._inverse


@dataclass(frozen=True)
class SingleJointMove:
    """Describes a piece of motion of one joint alone.

    Attributes:
        joint: its index.
        part: index of the segment of the observation.
        window: samples of that segment.
    """

    joint: int
    part: int
    window: slice


def find_single_joint_moves(
    observation: Observation, directions: JointDirections
) -> tuple[list[SingleJointMove], float, float]:
    """Returns all pieces in which one joint moves and the others stand, in order of time.

    And for how long several move at a time, of all the time, s.

    A joint stands while its speed is below a share of the top speed of the fastest joint of
    its unit. A piece begins and ends at standstill of all; its joint may pause and turn back in
    between, and any motion of another one ends it.

    Args:
        observation: of the logs.
        directions: of its joints.
    """
    segments = [part.segment for part in observation.stretches]
    speeds = np.concatenate([directions.convert_to_joints(s.qd[s.whole]) for s in segments])
    tops = np.ones(speeds.shape[1])
    if speeds.size:
        tops = np.quantile(np.abs(speeds), THRESHOLDS.top_speed_quantile, axis=0)
    main = np.argmax(np.abs(directions.rows), axis=1)
    units = np.array([observation.joints[k].unit for k in main])
    fastest = np.array([tops[units == unit].max() for unit in units])
    moves: list[SingleJointMove] = []
    several = total = 0.0
    for number, segment in enumerate(segments):
        speed = np.abs(directions.convert_to_joints(segment.qd))
        is_moving = speed > THRESHOLDS.standstill_share * fastest
        count = is_moving.sum(axis=1)
        labels = np.where(count == 0, _NONE, is_moving.argmax(axis=1))
        labels = np.where((count > 1) | ~segment.whole, _SEVERAL, labels)
        several += segment.step * float(np.sum((labels == _SEVERAL) & segment.whole))
        total += segment.step * float(np.sum(segment.whole))
        moves += [SingleJointMove(i, number, window) for i, window in _find_episodes(labels)]
    return moves, several, total


def _find_episodes(labels: np.ndarray) -> list[tuple[int, slice]]:
    """Returns (joint, samples) from standstill to standstill in which one joint moves alone.

    Those of one joint that follow each other are one. Joints that come to rest together do so one
    after the other, and the last is not alone: where several move at any time, all is left out.
    """
    episodes: list[tuple[int, slice]] = []
    before = _SEVERAL
    for start, stop in find_runs(labels != _NONE):
        joint = int(labels[start]) if np.ptp(labels[start:stop]) == 0 else _SEVERAL
        if joint != _SEVERAL:
            first = episodes.pop()[1].start if joint == before else start
            episodes.append((joint, slice(first, stop)))
        before = joint
    return episodes


# What a model says of one joint that moves alone: known functions of its motion, and weights.
#
# While joint i moves alone, with position a, speed v and acceleration u, the torque of any joint k
# is a sum of the functions u, v^2 and 1, each times 1, sin a or cos a, and of friction: what turns
# about one axis is one rigid body. For joint i itself that is J u + A sin a + B cos a + friction,
# four or five columns; for the others it holds J_ki and the centrifugal S_kii too (Hanssen, Hovland
# and Brogardh 2000, sections 2.2 and 5). Their weights are linear in the base parameters.


_SEED = 1788

_Function = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]

FUNCTIONS: dict[str, _Function] = {
    "qdd": lambda a, v, u: u,
    "qdd sin": lambda a, v, u: u * np.sin(a),
    "qdd cos": lambda a, v, u: u * np.cos(a),
    "qd^2": lambda a, v, u: v**2,
    "qd^2 sin": lambda a, v, u: v**2 * np.sin(a),
    "qd^2 cos": lambda a, v, u: v**2 * np.cos(a),
    "sin": lambda a, v, u: np.sin(a),
    "cos": lambda a, v, u: np.cos(a),
    "1": lambda a, v, u: np.ones_like(a),
    "sign qd": lambda a, v, u: np.sign(v),
    "qd": lambda a, v, u: v,
    "|qd|": lambda a, v, u: np.abs(v),
}
"""Of position, speed and acceleration of the joint that moves; the first is its inertia."""


@dataclass(frozen=True, eq=False)
class SingleJointMotion:
    """Describes the torque of one joint while one moves alone: theta * functions, theta = V beta.

    Attributes:
        names: (p,) of `FUNCTIONS`, those that occur.
        weights: (p, c) V.
    """

    names: tuple[str, ...]
    weights: np.ndarray

    def evaluate_columns(self, a: np.ndarray, v: np.ndarray, u: np.ndarray) -> np.ndarray:
        """Returns (samples, p) of position, speed and acceleration of the joint that moves."""
        return np.column_stack([FUNCTIONS[name](a, v, u) for name in self.names])


def fit_single_joint_motions(
    model: CompiledModel,
    q: np.ndarray,
    a: float,
    way: np.ndarray,
    span: tuple[float, float],
    directions: np.ndarray,
) -> list[SingleJointMotion | None]:
    """Returns the torques of some joints while one moves alone; None for what is no such sum.

    None also for a torque that is 0.

    Args:
        model: the robot.
        q: (n,) coordinates at some place of the motion.
        a: position of the joint there.
        way: (n,) speed of the coordinates at its speed 1.
        span: range of its positions, for robots with loops.
        directions: (k, n) of the joints with these torques.

    Raises:
        DataError: the model has effects that read more than the motion.
    """
    if model.spec.signals:
        raise DataError(
            f"{model.spec.robot}: an effect of the robot reads time, temperature or travel, which "
            "the two-step fit cannot; use --method weighted"
        )
    rng, count = np.random.default_rng(_SEED), THRESHOLDS.sampled_points
    if model.spec.closure is None:
        span = (a - THRESHOLDS.sampled_range, a + THRESHOLDS.sampled_range)
    places = rng.uniform(*span, count)
    v, u = rng.uniform(-1.0, 1.0, (2, count))
    moved = q + (places - a)[:, None] * way
    rows = model.base_regressor(moved, v[:, None] * way, u[:, None] * way)
    matrix = np.column_stack([function(places, v, u) for function in FUNCTIONS.values()])
    motions: list[SingleJointMotion | None] = []
    for direction in directions:
        values = np.einsum("tjc,j->tc", rows, direction)
        weights = np.linalg.lstsq(matrix, values, rcond=None)[0]
        size = np.abs(values).max()
        least = THRESHOLDS.min_singular_share * size
        if size == 0.0 or np.abs(matrix @ weights - values).max() > least:
            motions.append(None)
            continue
        used = np.flatnonzero(np.abs(weights).max(axis=1) > least)
        names = tuple(np.array([*FUNCTIONS])[used].tolist())
        motions.append(SingleJointMotion(names, weights[used]))
    return motions
