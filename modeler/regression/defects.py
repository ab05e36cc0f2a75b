"""Defects of a channel: spikes, wraps, new zeros, lost rows, found where no joint can move so."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.ndimage import maximum_filter

from modeler.numerics import noise
from modeler.numerics.channels import ChannelModel
from modeler.regression.thresholds import THRESHOLDS

Kind = Literal["wrap", "spike", "frozen", "zero", "lost", "clipped", "repeated", "held"]


@dataclass(frozen=True)
class Defect:
    """Something that happened to a channel, which no robot does.

    Attributes:
        kind: "wrap" (by whole turns), "spike" (there and back), "frozen" (a value repeated while
            the joint moved), "zero" (for good), "lost" (rows are missing, and the clock ran on),
            "clipped" (at an end of the range), "repeated" (rows that were recorded again), "held"
            (each value for `size` rows).
        start: first sample after it; of a spike or frozen values the first bad one.
        stop: sample after the last bad one; `start` if none is bad.
        size: in the channel's unit, with its sign; of a spike the largest departure.
        time: s, of the start, once that is a row of the log and no sample of a segment.
    """

    kind: Kind
    start: int
    stop: int
    size: float
    time: float = float("nan")


Spikes = list[list[list[Defect]]]
"""By joint and segment."""


def find_spikes(stretches: Sequence[np.ndarray], models: Sequence[ChannelModel]) -> Spikes:
    """Returns the lone departures of channels from their running median, in runs of up to 3.

    Runs are gone as they came; what stays is a step, and no spike. What happens again and again is
    no lone value.

    Args:
        stretches: (n, J) of values without gaps.
        models: of the J channels.
    """
    spikes: Spikes = []
    for j, model in enumerate(models):
        floor = max(THRESHOLDS.min_spike_share * model.spread, model.resolution)
        values = [part[:, j] for part in stretches]
        if not any(noise.can_depart(part, floor) for part in values):
            spikes.append([[] for _ in stretches])
            continue
        departed = [noise.subtract_running_median(part) for part in values]
        beyond = sum(np.count_nonzero(np.abs(part) > floor) for part in departed)
        most = max(THRESHOLDS.max_spikes, THRESHOLDS.max_spike_rate * sum(map(len, values)))
        if beyond > most:
            spikes.append([[] for _ in stretches])
        else:
            pairs = zip(values, departed, strict=True)
            spikes.append([_find_lone_runs(*pair, floor) for pair in pairs])
    return spikes


def _find_lone_runs(values: np.ndarray, departed: np.ndarray, floor: float) -> list[Defect]:
    places, spikes = noise.find_isolated_outliers(departed, floor), list[Defect]()
    for run in np.split(places, np.flatnonzero(np.diff(places) > 1) + 1):
        if not 0 < len(run) <= THRESHOLDS.max_spike:
            continue
        size = float(departed[run[int(np.argmax(np.abs(departed[run])))]])
        start, stop = int(run[0]), int(run[-1]) + 1
        beside = values[[k for k in (start - 1, stop) if 0 <= k < len(values)]]
        if np.ptp(beside) < THRESHOLDS.max_spike_step * abs(size):
            spikes.append(Defect("spike", start, stop, size))
    return spikes


def select_unexplained(
    spikes_by_joint: Spikes, torques: Sequence[np.ndarray], speeds: Sequence[np.ndarray]
) -> Spikes:
    """Returns the spikes of torques that no motion and no impact explains.

    A torque that is real moves its joint, and an impact shows in several joints.

    Args:
        spikes_by_joint: by `find_spikes` of the torques.
        torques: (n, J) by segment; a joint without a measured torque is all 0.
        speeds: (n, J) by segment.
    """
    if not any(spikes for by_joint in spikes_by_joint for spikes in by_joint):
        return spikes_by_joint
    departed = ([noise.subtract_running_median(column) for column in tau.T] for tau in torques)
    sizes = [np.abs(np.column_stack(columns)) for columns in departed]
    every: Spikes = []
    for j, by_stretch in enumerate(spikes_by_joint):
        each = zip(by_stretch, sizes, speeds, strict=True)
        every.append(
            [
                [s for s in spikes if not _is_impact(x, j, s) and not _is_corroborated(v[:, j], s)]
                for spikes, x, v in each
            ]
        )
    return every


def _is_impact(sizes: np.ndarray, j: int, spike: Defect) -> bool:
    """Returns True if another torque departs too, around the same time."""
    around = THRESHOLDS.impact_samples
    first, last = max(0, spike.start - around), spike.stop + around
    for k in range(sizes.shape[1]):
        if k == j:
            continue
        place = first + int(np.argmax(sizes[first:last, k]))
        if sizes[place, k] > THRESHOLDS.impact_ratio * noise.compute_nearby_level(
            sizes[:, k], place
        ):
            return True
    return False


def _is_corroborated(speed: np.ndarray, spike: Defect) -> bool:
    """Returns True if the speed changes across a spike as it rarely does, or did not before."""
    count = THRESHOLDS.speed_samples
    mean = np.convolve(speed, np.ones(count) / count, mode="valid")
    change = np.abs(
        mean[THRESHOLDS.speed_samples + 1 :] - mean[: -THRESHOLDS.speed_samples - 1]
    )  # centred on sample _MEAN + k
    first, last = (
        spike.start - THRESHOLDS.impact_samples - THRESHOLDS.speed_samples,
        spike.stop + THRESHOLDS.impact_samples - THRESHOLDS.speed_samples,
    )
    across = float(np.max(change[max(0, first) : last], initial=0.0))
    earlier = change[max(0, first - noise.REACH) : max(0, first - THRESHOLDS.speed_samples)]
    before = float(np.max(earlier, initial=0.0)) if earlier.size else np.inf
    return (
        across > float(np.quantile(change, THRESHOLDS.speed_change_quantile))
        or across > THRESHOLDS.speed_change_ratio * before > 0.0
    )


# Positions that leap from one sample to the next, as no joint can: wraps, spikes, new zeros.


_TURN = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class EncoderJumpScan:
    """Steps of positions (n, J) with uniform time but for jitter, from each sample to the next.

    Attributes:
        q: (n, J).
        turns: (n - 1, J) whole turns that a step has too much, by joint.
        speed: (n - 1, J) running median of the slopes, per s.
        excess: (n - 1, J) step less turns and less what the speed makes of it.
        fastest: (n - 1, J) largest speed around each step, without it, by steps or as logged.
    """

    q: np.ndarray
    turns: np.ndarray
    speed: np.ndarray
    excess: np.ndarray
    fastest: np.ndarray


def scan_jumps(
    time: np.ndarray, q: np.ndarray, revolute: np.ndarray, logged: np.ndarray
) -> EncoderJumpScan:
    """Returns the steps of one segment without gaps.

    Args:
        time: (n,) s, more than `LEAST`: a shorter one does not show.
        q: (n, J) rad or m, all finite.
        revolute: (J,) joints that may wrap.
        logged: (n, J) speeds; 0 where there are none.
    """
    steps, dt = np.diff(q, axis=0), np.diff(time)
    usual = float(np.median(dt))
    turns, speed, excess = np.zeros_like(steps), np.zeros_like(steps), np.zeros_like(steps)
    for j in range(q.shape[1]):
        speed[:, j] = noise.compute_running_median(steps[:, j] / dt)
        excess[:, j] = _compute_excess(steps[:, j], speed[:, j], dt, usual)
        if revolute[j]:
            turns[:, j] = _find_whole_turns(excess[:, j])
            if turns[:, j].any():
                whole = steps[:, j] - _TURN * turns[:, j]
                speed[:, j] = noise.compute_running_median(whole / dt)
                excess[:, j] = _compute_excess(whole, speed[:, j], dt, usual)
    excess[dt > THRESHOLDS.late_steps * usual] = 0.0
    speeds = np.fmax(np.abs(steps - _TURN * turns) / dt[:, None], np.abs(logged[1:]))
    beside = np.ones((2 * THRESHOLDS.jerk_samples + 1, 1), dtype=bool)
    beside[THRESHOLDS.jerk_samples] = False
    fastest = maximum_filter(speeds, footprint=beside, mode="nearest")
    return EncoderJumpScan(q, turns, speed, excess, fastest)


def compute_jump_floor(model: ChannelModel) -> float:
    """Returns the step of a position, rad or m, below which it is no jump."""
    return max(model.top_step, model.resolution)


def can_jump(time: np.ndarray, q: np.ndarray, floors: np.ndarray) -> bool:
    """Returns False if `scan_jumps` of a segment has no excess above floors (J,), and no turn."""
    dt = np.diff(time)
    least, slopes = np.minimum(floors, 0.4 * _TURN) / dt.max(), np.diff(q.T) / dt
    return any(noise.can_depart(*pair) for pair in zip(slopes, least, strict=True))


def _compute_excess(
    step: np.ndarray, speed: np.ndarray, dt: np.ndarray, usual: float
) -> np.ndarray:
    """Returns what a step has beyond speed x time; a stamp that came late or early excuses it.

    The rows may have been sampled evenly and stamped unevenly, or the other way round.
    """
    stamped, even = speed * dt, speed * usual
    low, high = np.minimum(stamped, even), np.maximum(stamped, even)
    return np.asarray(step - np.minimum(np.maximum(step, low), high))


def _find_whole_turns(excess: np.ndarray) -> np.ndarray:
    """Returns (n,) whole turns of each step, where they leave little."""
    turns = np.round(excess / _TURN)
    return np.where(np.abs(excess / _TURN - turns) < THRESHOLDS.turn_tolerance, turns, 0.0)


def find_jumps(
    walk: EncoderJumpScan, time: np.ndarray, j: int, model: ChannelModel
) -> list[Defect]:
    """Returns the leaps of joint j, increasing in time.

    They are lone, and more than the step that the joint makes at its top speed: a smaller one is no
    more than a sample too late or too early.

    Args:
        walk: one segment.
        time: (n,) s.
        j: index of the joint.
        model: of its position.
    """
    wraps = [
        Defect("wrap", int(k) + 1, int(k) + 1, float(_TURN * walk.turns[k, j]))
        for k in np.flatnonzero(walk.turns[:, j])
    ]
    rest, floor = [], compute_jump_floor(model)
    places = noise.find_isolated_outliers(walk.excess[:, j], floor).tolist()
    while places:
        k = places.pop(0)
        held = _count_frozen(walk, time, j, k)
        if held:
            rest.append(Defect("frozen", k + 1 - held, k + 1, float(walk.excess[k, j])))
            continue
        there = _find_spike(walk, j, k, places)
        if there is not None:
            places = [later for later in places if later > there.stop - 1]
            rest.append(there)
            continue
        kind: Kind = "lost" if _is_row_loss(walk, k) else "zero"
        first, last = (
            max(0, k - THRESHOLDS.jump_samples),
            min(len(time) - 1, k + 1 + THRESHOLDS.jump_samples),
        )
        way = walk.q[last, j] - walk.q[first, j] - _TURN * walk.turns[first:last, j].sum()
        if abs(way) > walk.fastest[k, j] * (time[last] - time[first]):
            rest.append(Defect(kind, k + 1, k + 1, float(walk.excess[k, j])))
    return sorted(wraps + rest, key=lambda leap: leap.start)


def _count_frozen(walk: EncoderJumpScan, time: np.ndarray, j: int, k: int) -> int:
    """Returns how many samples up to k repeat the one before, if a jump makes up for them."""
    q = walk.q[:, j]
    start = k
    while start > 0 and q[start - 1] == q[k]:
        start -= 1
    held = k - start
    if held < THRESHOLDS.min_frozen or start < 2 or k + 3 > len(q):
        return 0
    dt = time[k + 1] - time[start]
    before = (q[start] - q[start - 2]) / (time[start] - time[start - 2])
    after = (q[k + 3] - q[k + 1]) / (time[k + 3] - time[k + 1]) if k + 3 < len(q) else before
    way, leap = 0.5 * (before + after) * dt, q[k + 1] - q[k]
    return held if way != 0.0 and abs(leap - way) < THRESHOLDS.catch_up_share * abs(way) else 0


def _find_spike(walk: EncoderJumpScan, j: int, k: int, later: list[int]) -> Defect | None:
    """Returns the samples after k that are elsewhere, if a leap leads back."""
    size = float(walk.excess[k, j])
    left, farthest = size, abs(size)
    for place in later:
        dropped = not np.ptp(walk.q[k + 1 : place + 1, j])  # one value all along: a dead channel
        if place - k > THRESHOLDS.max_position_spike and not dropped:
            break
        left += float(walk.excess[place, j])
        farthest = max(farthest, abs(float(walk.excess[place, j])))
        if abs(left) <= THRESHOLDS.max_return_share * farthest:
            return Defect("spike", k + 1, place + 1, size)
    return None


def _is_row_loss(walk: EncoderJumpScan, k: int) -> bool:
    """Returns True if the same lost time explains the jumps of all joints between two samples.

    Of several joints two leap at least: one that leaps alone has another zero.
    """
    # Way is compared in each joint's own motion: a slider's metres and radians do not add.
    typical = np.sqrt(np.mean(walk.speed**2, axis=0))
    moving = typical > 0.0
    v, e = walk.speed[k, moving] / typical[moving], walk.excess[k, moving] / typical[moving]
    size = float(np.linalg.norm(e))
    leaping = np.count_nonzero(np.abs(e) > THRESHOLDS.min_shared_leap * size)
    if size == 0.0 or leaping < min(2, len(e)):
        return False
    lost = float(v @ e) / max(float(v @ v), 1e-300)
    return lost > 0.0 and float(np.linalg.norm(e - lost * v)) < THRESHOLDS.catch_up_share * size


Defects = dict[str, list[list[Defect]]]
"""By channel, "q", "tau", "qd" or "qdd", and joint; of "rows", repeated ones, one list for all."""
