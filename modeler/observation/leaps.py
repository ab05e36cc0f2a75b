"""Positions that leap from one sample to the next, as no joint can: wraps, spikes, new zeros."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.observation.isolated import (
    LEAST,
    NEAR,
    STEPS,
    floor_here,
    lone,
    nearby,
    running_median,
    spread,
    threshold,
)

SPIKE = 10
"""Samples between two leaps, at most, that are a spike; more are a stretch with another zero."""

FROZEN = 3
"""Equal samples before a leap, at least, that look like a logger that stood still."""

_TURN = 2.0 * np.pi
_TOP = 0.98  # quantile of the steps that is the top speed's
_RUNS_OUT = 0.1  # of a leap: what is left of it in the steps beside it, at most
_BACK = 0.3  # of the larger leap: what two leaps there and back may leave
_MADE_UP = 0.5  # share to which a leap makes up for the way of the frozen samples, or lost rows
_TURNED = 1e-3  # of a turn: what noise-free arithmetic may leave of a whole one

RARE = 2e-2
"""Share of a joint's steps that may be leaps."""

Kind = Literal["wrap", "spike", "frozen", "zero", "lost"]


@dataclass(frozen=True)
class Leap:
    """Something that happened to a position between two samples.

    Attributes:
        kind: "wrap" (by whole turns), "spike" (there and back), "frozen" (a value repeated while
            the joint moved), "zero" (for good), "lost" (rows are missing, and the clock ran on).
        start: first sample after it; of a spike or frozen values the first bad one.
        stop: sample after the last bad one; `start` if none is bad.
        size: rad or m.
    """

    kind: Kind
    start: int
    stop: int
    size: float


@dataclass(frozen=True, eq=False)
class Walk:
    """Steps of positions (n, J) with uniform time but for jitter, from each sample to the next.

    Attributes:
        q: (n, J).
        turns: (n - 1, J) whole turns that a step has too much, by joint.
        speed: (n - 1, J) running median of the slopes, per s.
        excess: (n - 1, J) step less turns and less what the speed makes of it.
    """

    q: np.ndarray
    turns: np.ndarray
    speed: np.ndarray
    excess: np.ndarray


def walked(
    time: np.ndarray, q: np.ndarray, revolute: np.ndarray, resolution: np.ndarray
) -> Walk | None:
    """The steps of one stretch without gaps; None if it is too short to tell.

    Args:
        time: (n,) s.
        q: (n, J) rad or m, all finite.
        revolute: (J,) joints that may wrap.
        resolution: (J,) smallest step of each.
    """
    if len(time) <= LEAST:
        return None
    steps, dt = np.diff(q, axis=0), np.diff(time)
    usual = float(np.median(dt))
    turns, speed, excess = np.zeros_like(steps), np.zeros_like(steps), np.zeros_like(steps)
    for j in range(q.shape[1]):
        speed[:, j] = running_median(steps[:, j] / dt)
        excess[:, j] = _excess(steps[:, j], speed[:, j], dt, usual)
        if revolute[j]:
            turns[:, j] = _whole_turns(excess[:, j], resolution[j])
            if turns[:, j].any():
                whole = steps[:, j] - _TURN * turns[:, j]
                speed[:, j] = running_median(whole / dt)
                excess[:, j] = _excess(whole, speed[:, j], dt, usual)
    return Walk(q, turns, speed, excess)


def floors(walks: Sequence[Walk], resolution: np.ndarray) -> np.ndarray:
    """(J,) rad or m that a step must have too much to be a leap, over all stretches of a log.

    What is lone, and more than the step that the joint makes at its top speed: a smaller leap is
    no more than a sample too late or too early.
    """
    if not walks:
        return np.full(len(resolution), np.inf)
    excess = np.concatenate([walk.excess for walk in walks])
    steps = np.concatenate([np.diff(walk.q, axis=0) - _TURN * walk.turns for walk in walks])
    top = np.quantile(np.abs(steps), _TOP, axis=0)
    lonely = [threshold(own, one, RARE) for own, one in zip(excess.T, resolution, strict=True)]
    return np.maximum(lonely, top)


def surely_none(time: np.ndarray, q: np.ndarray, known: np.ndarray) -> bool:
    """True if no step of a stretch can be a leap, as its slopes hardly change over 11 samples.

    Args:
        time: (n,) s.
        q: (n, J) rad or m, all finite.
        known: (J,) `floors` of the whole log.
    """
    if len(time) <= LEAST:
        return True
    dt = np.diff(time)[:, None]
    most = spread(np.diff(q, axis=0) / dt) * dt  # at least the excess of any step
    return bool(np.all(most.max(axis=0) <= np.minimum(known, 0.5 * _TURN)))


def floors_here(walks: Sequence[Walk], known: np.ndarray) -> np.ndarray:
    """(J,) `floors` of a whole log for a part of it, higher where the part is rougher."""
    if not walks:
        return known
    return np.array([
        floor_here([walk.excess[:, j] for walk in walks], floor, RARE)
        for j, floor in enumerate(known)
    ])  # fmt: skip


def _excess(step: np.ndarray, speed: np.ndarray, dt: np.ndarray, usual: float) -> np.ndarray:
    """What a step has beyond speed x time; a stamp that came late or early excuses it.

    The rows may have been sampled evenly and stamped unevenly, or the other way round.
    """
    stamped, even = speed * dt, speed * usual
    low, high = np.minimum(stamped, even), np.maximum(stamped, even)
    return np.asarray(step - np.minimum(np.maximum(step, low), high))


def _whole_turns(excess: np.ndarray, resolution: float) -> np.ndarray:
    """(n,) whole turns of each step, where they leave no more than its neighbours have."""
    turns = np.round(excess / _TURN)
    places = np.flatnonzero(turns)
    left = np.abs(excess - _TURN * turns)
    for k in places:
        tolerated = max(NEAR * nearby(left, int(k)), STEPS * resolution, _TURNED * _TURN)
        if left[k] > min(tolerated, 0.25 * _TURN):
            turns[k] = 0.0
    return np.asarray(turns)


def leaps_of(walk: Walk, time: np.ndarray, j: int, floor: float) -> list[Leap]:
    """The leaps of joint j, increasing in time.

    Args:
        walk: one stretch.
        time: (n,) s.
        j: index of the joint.
        floor: of that joint.
    """
    wraps = [
        Leap("wrap", int(k) + 1, int(k) + 1, float(_TURN * walk.turns[k, j]))
        for k in np.flatnonzero(walk.turns[:, j])
    ]
    rest, places = [], _sudden(walk.excess[:, j], lone(walk.excess[:, j], floor))
    while places:
        k = places.pop(0)
        held = _frozen(walk, time, j, k)
        if held:
            rest.append(Leap("frozen", k + 1 - held, k + 1, float(walk.excess[k, j])))
            continue
        there = _spike(walk, j, k, places)
        if there is not None:
            places = [later for later in places if later > there.stop - 1]
            rest.append(there)
            continue
        kind: Kind = "lost" if _lost_rows(walk, k) else "zero"
        rest.append(Leap(kind, k + 1, k + 1, float(walk.excess[k, j])))
    return sorted(wraps + rest, key=lambda leap: leap.start)


def _sudden(excess: np.ndarray, places: np.ndarray) -> list[int]:
    """The places whose neighbours, if they are no leaps themselves, go on as ever.

    Mass has to be moved: a motion that is fast for its sampling leaps too, and runs out beside it.
    """
    found = []
    for k in map(int, places):
        beside = [abs(excess[i]) for i in (k - 1, k + 1) if i not in places]
        tolerated = max(_RUNS_OUT * abs(excess[k]), NEAR * nearby(np.abs(excess), k) / 2.0)
        if max(beside, default=0.0) < tolerated:
            found.append(k)
    return found


def _frozen(walk: Walk, time: np.ndarray, j: int, k: int) -> int:
    """Samples up to k that repeat the one before them, if the leap after k makes up for them."""
    q = walk.q[:, j]
    start = k
    while start > 0 and q[start - 1] == q[k]:
        start -= 1
    held = k - start
    if held < FROZEN or start < 2 or k + 3 > len(q):
        return 0
    dt = time[k + 1] - time[start]
    before = (q[start] - q[start - 2]) / (time[start] - time[start - 2])
    after = (q[k + 3] - q[k + 1]) / (time[k + 3] - time[k + 1]) if k + 3 < len(q) else before
    way, leap = 0.5 * (before + after) * dt, q[k + 1] - q[k]
    return held if way != 0.0 and abs(leap - way) < _MADE_UP * abs(way) else 0


def _spike(walk: Walk, j: int, k: int, later: list[int]) -> Leap | None:
    """The samples after k that are elsewhere, if a leap leads back."""
    size = float(walk.excess[k, j])
    left, farthest = size, abs(size)
    for place in later:
        dropped = not np.ptp(walk.q[k + 1 : place + 1, j])  # one value all along: a dead channel
        if place - k > SPIKE and not dropped:
            break
        left += float(walk.excess[place, j])
        farthest = max(farthest, abs(float(walk.excess[place, j])))
        if abs(left) <= _BACK * farthest:
            return Leap("spike", k + 1, place + 1, size)
    return None


def _lost_rows(walk: Walk, k: int) -> bool:
    """True if one and the same lost time explains the leaps of all joints between two samples."""
    speed, excess = walk.speed[k], walk.excess[k]
    size = float(np.linalg.norm(excess))
    # Way is compared in each joint's own motion: a slider's metres and radians do not add.
    typical = np.sqrt(np.mean(walk.speed**2, axis=0))
    moving = typical > 0.0
    if size == 0.0 or not moving.any():
        return False
    v, e = speed[moving] / typical[moving], excess[moving] / typical[moving]
    lost = float(v @ e) / max(float(v @ v), 1e-300)
    return lost > 0.0 and float(np.linalg.norm(e - lost * v)) < _MADE_UP * float(np.linalg.norm(e))
