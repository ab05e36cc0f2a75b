"""Where one joint moves and the others stand: the pieces of logs that a two-step fit uses."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.observation import Observation
from modeler.observation.motion import Segment

STANDS = 0.02
"""A joint stands below this share of the top speed of the fastest joint of its unit."""

_TOP = 0.98  # quantile of the speeds that is the top speed
_SEVERAL, _NONE = -2, -1


class Directions:
    """How the coordinates move with each joint: q = a D, a the positions of the joints.

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

    def joints(self, coordinates: np.ndarray) -> np.ndarray:
        """(..., n) positions, speeds or accelerations of the joints."""
        return coordinates @ self._inverse


@dataclass(frozen=True)
class Move:
    """A piece of motion of one joint alone.

    Attributes:
        joint: its index.
        part: index of the stretch of the observation.
        window: samples of that stretch.
    """

    joint: int
    part: int
    window: slice


@dataclass(frozen=True)
class Moves:
    """What the logs hold.

    Attributes:
        alone: pieces in which one joint moves, in order of time.
        several: s, motion of several joints at a time.
        total: s, of all pieces.
    """

    alone: tuple[Move, ...]
    several: float
    total: float


def moves_alone(observation: Observation, directions: Directions) -> Moves:
    """All pieces in which one joint moves and the others stand.

    A joint stands while its speed is below `STANDS` times the top speed of the fastest joint of
    its unit. A piece begins and ends at standstill of all; its joint may pause and turn back in
    between, and any motion of another one ends it.

    Args:
        observation: of the logs.
        directions: of its joints.
    """
    segments = [part.segment for part in observation.stretches]
    floors = _floors(observation, segments, directions)
    found: list[Move] = []
    several = total = 0.0
    for number, segment in enumerate(segments):
        labels = _labels(segment, floors, directions)
        several += segment.step * float(np.sum((labels == _SEVERAL) & segment.whole))
        total += segment.step * float(np.sum(segment.whole))
        found += [Move(i, number, window) for i, window in _merged(_episodes(labels))]
    return Moves(tuple(found), several, total)


def _episodes(labels: np.ndarray) -> list[tuple[int, slice]]:
    """(joint, samples) from standstill to standstill; several where they move at any time of it.

    Joints that come to rest together do so one after the other, and the last is not alone.
    """
    moving = np.flatnonzero(labels != _NONE)
    cuts = np.flatnonzero(np.diff(moving) > 1) + 1
    found = []
    for run in np.split(moving, cuts) if moving.size else []:
        joint = int(labels[run[0]]) if np.ptp(labels[run]) == 0 else _SEVERAL
        found.append((joint, slice(int(run[0]), int(run[-1]) + 1)))
    return found


def _merged(episodes: list[tuple[int, slice]]) -> list[tuple[int, slice]]:
    """Episodes of one joint alone, those that follow each other as one."""
    found: list[tuple[int, slice]] = []
    before = _SEVERAL
    for joint, window in episodes:
        if joint != _SEVERAL and joint == before:
            found[-1] = (joint, slice(found[-1][1].start, window.stop))
        elif joint != _SEVERAL:
            found.append((joint, window))
        before = joint
    return found


def _floors(
    observation: Observation, segments: list[Segment], directions: Directions
) -> np.ndarray:
    """(n,) speed below which each joint stands."""
    speeds = np.concatenate([directions.joints(s.qd[s.whole]) for s in segments])
    tops = np.quantile(np.abs(speeds), _TOP, axis=0) if speeds.size else np.ones(speeds.shape[1])
    main = np.argmax(np.abs(directions.rows), axis=1)
    units = np.array([observation.joints[k].unit for k in main])
    return STANDS * np.array([tops[units == unit].max() for unit in units])


def _labels(segment: Segment, floors: np.ndarray, directions: Directions) -> np.ndarray:
    """(samples,) index of the joint that moves alone, or that none or several do."""
    moves = np.abs(directions.joints(segment.qd)) > floors
    count = moves.sum(axis=1)
    labels = np.where(count == 0, _NONE, np.where(count == 1, np.argmax(moves, axis=1), _SEVERAL))
    return np.where(segment.whole, labels, _SEVERAL)
