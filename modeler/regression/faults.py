"""What no robot does, in the channels of a log: faults, and the log as each would be repaired."""

import dataclasses
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from scipy.ndimage import maximum_filter

from modeler.core.manifest import ModuleSpec
from modeler.numerics.noise import (
    LEAST,
    NEAR,
    REACH,
    RESTS,
    STEPS,
    Clip,
    compute_local_threshold,
    compute_nearby_level,
    compute_outlier_threshold,
    compute_running_median,
    estimate_hold_length,
    estimate_lattice_step,
    find_clips,
    find_frozen_runs,
    find_isolated_outliers,
    find_longest_usual_run,
    find_repeated_rows,
    interpolate_held_channel,
    subtract_running_median,
)
from modeler.regression.log import Log, find_runs
from modeler.regression.read import cut_rows
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
        time: s, of the start, once that is a row of the log and no sample of a stretch.
    """

    kind: Kind
    start: int
    stop: int
    size: float
    time: float = float("nan")


Spikes = list[list[list[Defect]]]
"""By joint and stretch."""


def find_spikes(
    stretches: Sequence[np.ndarray], floors: np.ndarray | None = None
) -> tuple[Spikes, np.ndarray | None]:
    """Returns the lone departures of channels from their running median, in runs of up to 3.

    Runs are gone as they came; what stays is a step, and no spike.

    Args:
        stretches: (n, J) of values without gaps.
        floors: (J,) of the whole log, of which these are a part; None: they are all of it.

    Returns:
        The spikes, and departures (J,) below which no value is one; None without stretches.
    """
    if not stretches:
        return [], floors
    channels = [[part[:, j] for part in stretches] for j in range(stretches[0].shape[1])]
    departed = [[subtract_running_median(part) for part in channel] for channel in channels]
    if floors is None:
        floors = np.array(list(map(_compute_floor, channels, departed)))
    spikes = []
    for channel, sizes, floor in zip(channels, departed, floors, strict=True):
        here = compute_local_threshold(sizes, float(floor), THRESHOLDS.max_spike_rate)
        pairs = zip(channel, sizes, strict=True)
        spikes.append([_find_lone_runs(values, part, here) for values, part in pairs])
    return spikes, floors


def _compute_floor(channel: Sequence[np.ndarray], departed: Sequence[np.ndarray]) -> float:
    """Returns departure below which no value of a whole channel is a spike."""
    whole = np.concatenate(channel)
    low, high = np.quantile(whole, [0.01, 0.99])
    lonely = compute_outlier_threshold(
        np.concatenate(departed), estimate_lattice_step(whole), THRESHOLDS.max_spike_rate
    )
    return max(lonely, THRESHOLDS.min_spike_share * float(high - low))


def _find_lone_runs(values: np.ndarray, departed: np.ndarray, floor: float) -> list[Defect]:
    places, spikes = find_isolated_outliers(departed, floor), list[Defect]()
    for run in np.split(places, np.flatnonzero(np.diff(places) > 1) + 1):
        if not 0 < len(run) <= THRESHOLDS.max_spike:
            continue
        size = float(departed[run[int(np.argmax(np.abs(departed[run])))]])
        start, stop = int(run[0]), int(run[-1]) + 1
        beside = values[[k for k in (start - 1, stop) if 0 <= k < len(values)]]
        if np.ptp(beside) < THRESHOLDS.max_spike_step * abs(size):
            spikes.append(Defect("spike", start, stop, size))
    return spikes


@dataclass(frozen=True, eq=False)
class TorqueScales:
    """What is usual in the torques and speeds of a log; J joints.

    Attributes:
        range: (J,) of the torques, between 1 % and 99 % of their values.
        top: (J,) speed that 98 % of the samples stay below.
    """

    range: np.ndarray
    top: np.ndarray


def compute_torque_scales(
    torques: Sequence[np.ndarray], speeds: Sequence[np.ndarray]
) -> TorqueScales:
    """Returns the scales of the stretches (n, J) of a whole log, one at least."""
    low, high = np.quantile(np.concatenate(torques), [0.01, 0.99], axis=0)
    return TorqueScales(high - low, np.quantile(np.abs(np.concatenate(speeds)), 0.98, axis=0))


def select_unexplained(
    spikes_by_joint: Spikes,
    torques: Sequence[np.ndarray],
    speeds: Sequence[np.ndarray],
    scales: TorqueScales,
) -> Spikes:
    """Returns the spikes of torques that no motion and no blow explains.

    A torque that is real moves its joint, and a blow is felt in several joints. Where a joint
    turns back or sticks, friction makes peaks of its own, which stay within the range of the
    channel (1 % to 99 % of its values).

    Args:
        spikes_by_joint: by `find_spikes` of the torques.
        torques: (n, J) by stretch; a joint without a measured torque is all 0.
        speeds: (n, J) by stretch.
        scales: in the whole log.
    """
    if not any(spikes for by_joint in spikes_by_joint for spikes in by_joint):
        return spikes_by_joint
    departed = ([subtract_running_median(column) for column in tau.T] for tau in torques)
    sizes = [np.abs(np.column_stack(columns)) for columns in departed]
    return [
        [
            [
                spike
                for spike in spikes
                if not _is_impact(size, j, spike)
                and not _is_corroborated(speed[:, j], spike)
                and (
                    abs(spike.size) > scales.range[j]
                    or _is_moving(speed[:, j], spike, THRESHOLDS.slow_speed_share * scales.top[j])
                )
            ]
            for spikes, size, speed in zip(by_stretch, sizes, speeds, strict=True)
        ]
        for j, by_stretch in enumerate(spikes_by_joint)
    ]


def _is_impact(sizes: np.ndarray, j: int, spike: Defect) -> bool:
    """Returns True if another torque departs too, around the same time."""
    around = THRESHOLDS.impact_samples
    first, last = max(0, spike.start - around), spike.stop + around
    for k in range(sizes.shape[1]):
        if k == j:
            continue
        place = first + int(np.argmax(sizes[first:last, k]))
        if sizes[place, k] > THRESHOLDS.impact_ratio * compute_nearby_level(sizes[:, k], place):
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
    earlier = change[max(0, first - REACH) : max(0, first - THRESHOLDS.speed_samples)]
    before = float(np.max(earlier, initial=0.0)) if earlier.size else np.inf
    return (
        across > float(np.quantile(change, THRESHOLDS.speed_change_quantile))
        or across > THRESHOLDS.speed_change_ratio * before > 0.0
    )


def _is_moving(speed: np.ndarray, spike: Defect, least: float) -> bool:
    """Returns True if a joint moves one way, and not slowly, around a spike."""
    count = THRESHOLDS.impact_samples
    around = speed[max(0, spike.start - count) : spike.stop + count]
    return bool(np.min(around) > least or np.max(around) < -least)


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
    time: np.ndarray,
    q: np.ndarray,
    revolute: np.ndarray,
    resolution: np.ndarray,
    logged: np.ndarray,
) -> EncoderJumpScan:
    """Returns the steps of one stretch without gaps.

    Args:
        time: (n,) s, more than `LEAST`: a shorter one does not tell.
        q: (n, J) rad or m, all finite.
        revolute: (J,) joints that may wrap.
        resolution: (J,) smallest step of each.
        logged: (n, J) speeds; 0 where there are none.
    """
    steps, dt = np.diff(q, axis=0), np.diff(time)
    usual = float(np.median(dt))
    turns, speed, excess = np.zeros_like(steps), np.zeros_like(steps), np.zeros_like(steps)
    for j in range(q.shape[1]):
        speed[:, j] = compute_running_median(steps[:, j] / dt)
        excess[:, j] = _compute_excess(steps[:, j], speed[:, j], dt, usual)
        if revolute[j]:
            turns[:, j] = _find_whole_turns(excess[:, j], resolution[j])
            if turns[:, j].any():
                whole = steps[:, j] - _TURN * turns[:, j]
                speed[:, j] = compute_running_median(whole / dt)
                excess[:, j] = _compute_excess(whole, speed[:, j], dt, usual)
    excess[dt > THRESHOLDS.late_steps * usual] = 0.0
    speeds = np.fmax(np.abs(steps - _TURN * turns) / dt[:, None], np.abs(logged[1:]))
    beside = np.ones((2 * THRESHOLDS.jerk_samples + 1, 1), dtype=bool)
    beside[THRESHOLDS.jerk_samples] = False
    fastest = maximum_filter(speeds, footprint=beside, mode="nearest")
    return EncoderJumpScan(q, turns, speed, excess, fastest)


def compute_jump_floors(walks: Sequence[EncoderJumpScan], resolution: np.ndarray) -> np.ndarray:
    """Returns (J,) rad or m that a step must have too much to be a jump, over all stretches.

    What is lone, and more than the step that the joint makes at its top speed: a smaller leap is
    no more than a sample too late or too early.
    """
    if not walks:
        return np.full(len(resolution), np.inf)
    excess = np.concatenate([walk.excess for walk in walks])
    steps = np.concatenate([np.diff(walk.q, axis=0) - _TURN * walk.turns for walk in walks])
    top = np.quantile(np.abs(steps), THRESHOLDS.top_speed_quantile, axis=0)
    lonely = [
        compute_outlier_threshold(joint_excess, one, THRESHOLDS.max_jump_share)
        for joint_excess, one in zip(excess.T, resolution, strict=True)
    ]
    return np.maximum(lonely, top)


def compute_local_floors(walks: Sequence[EncoderJumpScan], known: np.ndarray) -> np.ndarray:
    """Returns (J,) `compute_jump_floors` of a whole log for a part of it, higher if rougher."""
    share = THRESHOLDS.max_jump_share
    excess = [[walk.excess[:, j] for walk in walks] for j in range(len(known))]
    return np.array([compute_local_threshold(*of, share) for of in zip(excess, known, strict=True)])


def _compute_excess(
    step: np.ndarray, speed: np.ndarray, dt: np.ndarray, usual: float
) -> np.ndarray:
    """Returns what a step has beyond speed x time; a stamp that came late or early excuses it.

    The rows may have been sampled evenly and stamped unevenly, or the other way round.
    """
    stamped, even = speed * dt, speed * usual
    low, high = np.minimum(stamped, even), np.maximum(stamped, even)
    return np.asarray(step - np.minimum(np.maximum(step, low), high))


def _find_whole_turns(excess: np.ndarray, resolution: float) -> np.ndarray:
    """Returns (n,) whole turns of each step, where they leave no more than its neighbours have."""
    turns = np.round(excess / _TURN)
    places = np.flatnonzero(turns)
    left = np.abs(excess - _TURN * turns)
    for k in places:
        tolerated = max(
            NEAR * compute_nearby_level(left, int(k)),
            STEPS * resolution,
            THRESHOLDS.turn_tolerance * _TURN,
        )
        if left[k] > min(tolerated, 0.25 * _TURN):
            turns[k] = 0.0
    return np.asarray(turns)


def find_jumps(walk: EncoderJumpScan, time: np.ndarray, j: int, floor: float) -> list[Defect]:
    """Returns the leaps of joint j, increasing in time.

    Args:
        walk: one stretch.
        time: (n,) s.
        j: index of the joint.
        floor: of that joint.
    """
    wraps = [
        Defect("wrap", int(k) + 1, int(k) + 1, float(_TURN * walk.turns[k, j]))
        for k in np.flatnonzero(walk.turns[:, j])
    ]
    rest, excess = [], walk.excess[:, j]
    places = _select_sudden(excess, find_isolated_outliers(excess, floor))
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


def _select_sudden(excess: np.ndarray, places: np.ndarray) -> list[int]:
    """Returns the places whose neighbours, if they are no leaps themselves, go on as ever.

    Mass has to be moved: a motion that is fast for its sampling leaps too, and runs out beside it.
    """
    sudden = []
    for k in map(int, places):
        beside = [abs(excess[i]) for i in (k - 1, k + 1) if i not in places]
        tolerated = max(
            THRESHOLDS.max_neighbour_share * abs(excess[k]),
            NEAR * compute_nearby_level(np.abs(excess), k) / 2.0,
        )
        if max(beside, default=0.0) < tolerated:
            sudden.append(k)
    return sudden


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
    """Returns True if the same lost time explains the jumps of all joints between two samples."""
    speed, excess = walk.speed[k], walk.excess[k]
    size = float(np.linalg.norm(excess))
    # Way is compared in each joint's own motion: a slider's metres and radians do not add.
    typical = np.sqrt(np.mean(walk.speed**2, axis=0))
    moving = typical > 0.0
    if size == 0.0 or not moving.any():
        return False
    v, e = speed[moving] / typical[moving], excess[moving] / typical[moving]
    lost = float(v @ e) / max(float(v @ v), 1e-300)
    return lost > 0.0 and float(np.linalg.norm(e - lost * v)) < THRESHOLDS.catch_up_share * float(
        np.linalg.norm(e)
    )


Defects = dict[str, list[list[Defect]]]
"""By channel, "q", "tau", "qd" or "qdd", and joint; of "rows", repeated ones, one list for all."""


@dataclass(frozen=True, eq=False)
class ChannelScales:
    """What is usual in the channels of a log, beside which a defect stands out; J joints.

    Attributes:
        steps: (J,) smallest step of each position.
        leaps: (J,) what a step must have too much to be a leap.
        torque: and the speeds; None where no torque is measured.
        floors: (J,) departure below which no value is a spike, of "tau" and logged "qd" and "qdd";
            None where the log has no stretch of them.
        repeats: True if rows repeat, as the recorder is faster than the robot.
        clips: (J,) ends of the range at which each position is cut off.
        stays: (J,) samples for which each torque may stay the same.
        held: (J,) rows for which values are held, of "q", "tau", "qd" and "qdd".
    """

    steps: np.ndarray
    leaps: np.ndarray
    torque: TorqueScales | None
    floors: Mapping[str, np.ndarray | None]
    repeats: bool
    clips: tuple[tuple[Clip, ...], ...]
    stays: tuple[int, ...]
    held: Mapping[str, tuple[int, ...]]


Repairs = Collection[tuple[str, int, str]]
"""Channel, joint and kind of the defects that are mended."""

CHANNELS = ("q", "tau", "qd", "qdd")
ALWAYS = ("wrap", "repeated")
"""Kinds that are mended without a fit: nothing is measured otherwise then."""


def repair_log(
    log: Log, spec: ModuleSpec, scales: ChannelScales | None = None, repairs: Repairs | None = None
) -> tuple[Log, Defects, ChannelScales]:
    """Returns the log mended; what looks like a defect; and what is usual in the log.

    Rows that repeat the one before them in all channels are dropped, so that the rate of what is
    left is the robot's. Wraps are counted on, and positions that begin to count from another zero
    are joined to the longest stretch. Spikes, frozen and clipped values become missing ones. Where
    rows are missing and the clock ran on, a new piece begins. Held values are interpolated.

    Args:
        log: as it was read, or some consecutive rows of one.
        spec: the robot's manifest; it names the joints.
        scales: in the whole log of which this is a part; None: it is all of it.
        repairs: what is mended besides `ALWAYS`; None: all.
    """

    def mended_by(name: str, defects_by_joint: Sequence[Sequence[Defect]]) -> list[list[Defect]]:
        def is_mended(j: int, kind: str) -> bool:
            return repairs is None or kind in ALWAYS or (name, j, kind) in repairs

        return [
            [one for one in channel if is_mended(j, one.kind)]
            for j, channel in enumerate(defects_by_joint)
        ]

    again = _find_repeats(log, scales)
    kept_rows = np.flatnonzero(~again)
    fresh = log
    if again.any():
        steps = np.diff(log.time[kept_rows])
        longest = 1.5 * log.step + float(steps[steps <= RESTS * np.median(steps)].max())
        rate = float(np.quantile(steps, THRESHOLDS.step_quantile)), longest
        fresh = dataclasses.replace(cut_rows(log, kept_rows), robot_steps=rate)
    held = _count_held_rows(fresh) if scales is None else scales.held
    quick = [rows == 1 for rows in held["q"]]
    clips = (
        scales.clips
        if scales is not None
        else tuple(
            find_clips(channel) if is_quick else ()
            for channel, is_quick in zip(fresh.q.T, quick, strict=True)
        )
    )
    clipped = [_find_clipped(channel, ends) for channel, ends in zip(fresh.q.T, clips, strict=True)]
    q = _remove_defects(fresh.q, mended_by("q", clipped))
    leaps, parts, steps, least = _find_all_jumps(
        dataclasses.replace(fresh, q=q), spec, scales, quick
    )
    stays = tuple(map(find_longest_usual_run, fresh.tau.T)) if scales is None else scales.stays
    others, lonely, torque = _find_spikes(fresh, scales)
    by_channel = {
        "q": [
            sorted(both[0] + both[1], key=lambda one: one.start)
            for both in zip(clipped, leaps, strict=True)
        ],
        **others,
    }
    for channel, stuck in zip(by_channel["tau"], _find_frozen(fresh, stays), strict=True):
        channel += stuck
    segment, values = fresh.piece_number, dict[str, np.ndarray]()
    for name, by_joint in by_channel.items():
        for j, rows in enumerate(held[name]):
            if rows > 1:
                size, time = float(rows), float(fresh.time[0])
                by_joint[j] = [one for one in by_joint[j] if one.kind == "wrap"]
                by_joint[j].append(Defect("held", 0, 0, size, time))
        ours = mended_by(name, by_joint)
        values[name] = _remove_defects(q if name == "q" else getattr(fresh, name), ours)
        for j, channel in enumerate(ours):
            if name == "q" and channel:
                _join_positions(values[name][:, j], channel, parts)
            if any(one.kind == "held" for one in channel):
                column = values[name][:, j]
                rows, is_smooth = held[name][j], name == "q"
                column[:] = interpolate_held_channel(fresh.time, column, rows, smooth=is_smooth)
        lost = [one.start for channel in ours for one in channel if one.kind == "lost"]
        segment = segment + (np.arange(fresh.rows)[:, None] >= np.array(lost, int)).sum(axis=1)
    new = segment if (segment != fresh.piece_number).any() else fresh.segment
    mended = dataclasses.replace(
        fresh,
        segment=new,
        q=values["q"],
        tau=values["tau"],
        qd=values.get("qd"),
        qdd=values.get("qdd"),
    )
    by_channel = {
        name: [[_locate_defect(one, kept_rows, log) for one in channel] for channel in by_joint]
        for name, by_joint in by_channel.items()
    }
    if again.any():
        every = [Defect("repeated", *run, 0.0, float(log.time[run[0]])) for run in find_runs(again)]
        by_channel["rows"] = [every]
    new_scales = ChannelScales(steps, least, torque, lonely, bool(again.any()), clips, stays, held)
    return mended, by_channel, scales or new_scales


def _count_held_rows(log: Log) -> dict[str, tuple[int, ...]]:
    """Returns (J,) rows for which the values of each channel are held; 1: they are not."""
    channels = {"q": log.q, "tau": log.tau, "qd": log.qd, "qdd": log.qdd}
    logged = {name: x.T for name, x in channels.items() if x is not None}
    return {name: tuple(map(estimate_hold_length, x)) for name, x in logged.items()}


def _find_repeats(log: Log, scales: ChannelScales | None) -> np.ndarray:
    """Returns (n,) True at rows that a recorder wrote again."""
    if scales is not None and not scales.repeats:
        return np.zeros(log.rows, dtype=bool)
    others = [values for values in (log.tau, log.qd, log.qdd) if values is not None]
    return find_repeated_rows(log.q, np.column_stack(others), always=scales is not None)


def _find_clipped(values: np.ndarray, ends: Sequence[Clip]) -> list[Defect]:
    """Returns runs at the ends of the range of a position; none where it goes beyond."""
    clipped = []
    for end in ends:
        beyond = values > end.value if end.upper else values < end.value
        if not beyond.any():
            stays = find_runs(values == end.value)
            clipped += [Defect("clipped", *run, end.value) for run in stays]
    return sorted(clipped, key=lambda one: one.start)


def _find_frozen(log: Log, held: Sequence[int]) -> list[list[Defect]]:
    """Returns torques that repeat a value while their joint moves, by joint."""
    frozen: list[list[Defect]] = []
    for j, (tau, q) in enumerate(zip(log.tau.T, log.q.T, strict=True)):
        rows = np.flatnonzero(np.isfinite(tau) & np.isfinite(q))
        stuck = find_frozen_runs(tau[rows], q[rows], held[j]) if rows.size else []
        every = [Defect("frozen", *run, 0.0) for run in stuck]
        frozen.append([_locate_defect(one, rows, log) for one in every])
    return frozen


def _find_all_jumps(
    log: Log, spec: ModuleSpec, scales: ChannelScales | None, quick: Sequence[bool]
) -> tuple[list[list[Defect]], list[np.ndarray], np.ndarray, np.ndarray]:
    """Returns jumps of positions by joint, the stretches that were scanned, steps and floors."""
    positions: list[list[Defect]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    steps = (
        np.array([estimate_lattice_step(column) for column in log.q.T])
        if scales is None
        else scales.steps
    )
    there = np.isfinite(log.q).all(axis=1)
    stretches = [rows for rows in _iterate_stretches(log, there) if len(rows) > LEAST]
    logged = np.zeros_like(log.q) if log.qd is None else log.qd
    walks = [scan_jumps(log.time[k], log.q[k], revolute, steps, logged[k]) for k in stretches]
    least = (
        compute_jump_floors(walks, steps)
        if scales is None
        else compute_local_floors(walks, scales.leaps)
    )
    for rows, walk in zip(stretches, walks, strict=True):
        for j in range(len(spec.joints)):
            jumps = find_jumps(walk, log.time[rows], j, least[j])
            if not quick[j]:
                jumps = [leap for leap in jumps if leap.kind == "wrap"]
            if log.robot_steps is not None:  # rows of such a log come when they come
                jumps = [leap for leap in jumps if leap.kind != "lost"]
            positions[j] += [_locate_defect(leap, rows, log) for leap in jumps]
    return positions, stretches, steps, least


def _iterate_stretches(log: Log, there: np.ndarray) -> Iterator[np.ndarray]:
    """Yields rows (k,) of each stretch without a gap among those that are there (n,)."""
    rows = np.flatnonzero(there)
    cut = (np.diff(log.time[rows]) > log.gap) | (np.diff(log.piece_number[rows]) != 0)
    yield from np.split(rows, np.flatnonzero(cut) + 1)


def _locate_defect(defect: Defect, rows: np.ndarray, log: Log) -> Defect:
    """Returns what was found in a stretch, at rows (k,) of the log."""
    start = int(rows[defect.start])
    stop = int(rows[defect.stop - 1]) + 1 if defect.stop > defect.start else start
    return dataclasses.replace(defect, start=start, stop=stop, time=float(log.time[start]))


def _locate_defects(
    by_stretch: Sequence[Sequence[Defect]], stretches: Sequence[np.ndarray], log: Log
) -> list[Defect]:
    """Returns what was found in some stretches, at rows of the log."""
    pairs = zip(by_stretch, stretches, strict=True)
    return [_locate_defect(one, rows, log) for defects, rows in pairs for one in defects]


def _join_positions(q: np.ndarray, leaps: Sequence[Defect], parts: Sequence[np.ndarray]) -> None:
    """Counts positions (n,) on, in place, from the longest stretch between two leaps."""
    for rows in parts:
        offset, edges = np.zeros(len(rows)), [0]
        for leap in leaps:
            place = int(np.searchsorted(rows, leap.start))
            if leap.kind in ("wrap", "zero") and place < len(rows) and rows[place] == leap.start:
                offset[place:] += leap.size
                edges.append(place)
        longest = edges[int(np.argmax(np.diff([*edges, len(rows)])))]
        q[rows] -= offset - offset[longest]


def _find_spikes(
    log: Log, scales: ChannelScales | None
) -> tuple[Defects, dict[str, np.ndarray | None], TorqueScales | None]:
    """Returns spikes of torques, logged velocities and accelerations, by joint; and the scales."""
    by_channel: Defects = {}
    floors: dict[str, np.ndarray | None] = {}
    torque = None if scales is None else scales.torque
    for name in ("tau", "qd", "qdd"):
        values = getattr(log, name)
        if values is None:
            continue
        there = np.isfinite(values).all(axis=1)
        if name == "tau":
            there &= np.isfinite(log.q).all(axis=1)
        rows = [part for part in _iterate_stretches(log, there) if len(part) >= LEAST]
        parts = [values[part] for part in rows]
        spikes, floors[name] = find_spikes(parts, None if scales is None else scales.floors[name])
        if name == "tau" and parts:
            speeds = [np.gradient(log.q[part], log.time[part], axis=0) for part in rows]
            torque = torque or compute_torque_scales(parts, speeds)
            spikes = select_unexplained(spikes, parts, speeds, torque)
        defects = [_locate_defects(part, rows, log) for part in spikes]
        by_channel[name] = defects or [[] for _ in log.joints]
    return by_channel, floors, torque


def _remove_defects(values: np.ndarray, defects: Sequence[Sequence[Defect]]) -> np.ndarray:
    cleaned = values.copy() if any(defects) else values
    for j, channel in enumerate(defects):
        for one in channel:
            cleaned[one.start : one.stop, j] = np.nan
    return cleaned


def find_column(log: Log, spec: ModuleSpec, name: str, j: int) -> str:
    """Returns a channel as the log calls it."""
    if name == "tau" and log.torque_source:
        return log.torque_source[j].split()[0]
    return f"{name}{spec.joints[j].name}"


def parse_repairs(log: Log, spec: ModuleSpec, names: Collection[str]) -> set[tuple[str, int, str]]:
    """Returns `Repairs` by names as "q2 zero"."""
    return {
        (name, j, kind)
        for name in CHANNELS
        for j in range(len(spec.joints))
        for kind in get_args(Kind)
        if f"{find_column(log, spec, name, j)} {kind}" in names
    }


def select_confirmed(repairs: Mapping[str, float]) -> frozenset[str]:
    """Returns the repairs that a fit confirmed."""
    return frozenset(name for name, score in repairs.items() if score < THRESHOLDS.max_repair_ratio)
