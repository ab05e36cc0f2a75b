"""What no robot does, in the channels of a log: hypotheses, and the log as each would mend it."""

import dataclasses
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np
from scipy.ndimage import maximum_filter

from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.logs import describe_repeats
from modeler.numerics.noise import (
    LEAST,
    NEAR,
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
)
from modeler.regression.log import Log
from modeler.regression.read import cut_rows
from modeler.regression.segments import find_runs
from modeler.regression.spikes import (
    Defect,
    Kind,
    TorqueScales,
    compute_torque_scales,
    find_spikes,
    select_unexplained,
)

# Positions that leap from one sample to the next, as no joint can: wraps, spikes, new zeros.


SPIKE = 10
"""Samples between two leaps, at most, that are a spike; more are a stretch with another zero."""

FROZEN = 3
"""Equal samples before a leap, at least, that look like a logger that stood still."""

_WITHIN = 0.8  # quantile of the steps between rows that a recorder did not repeat
_TURN = 2.0 * np.pi
_TOP = 0.98  # quantile of the steps that is the top speed's
_RUNS_OUT = 0.1  # of a leap: what is left of it in the steps beside it, at most
_BACK = 0.3  # of the larger leap: what two leaps there and back may leave
_MADE_UP = 0.5  # share to which a leap makes up for the way of the frozen samples, or lost rows
_TURNED = 1e-3  # of a turn: what noise-free arithmetic may leave of a whole one
_LATE = 2.0  # median steps: across a longer one, a joint may have moved anywhere
_AROUND = 10  # samples in which a joint that jerks is seen to be as fast as its leap
_SIDES = 3  # samples either side of a leap over which that speed would carry it

RARE = 2e-2
"""Share of a joint's steps that may be leaps."""


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
    time: np.ndarray, q: np.ndarray, revolute: np.ndarray, resolution: np.ndarray,
    logged: np.ndarray,
) -> EncoderJumpScan:  # fmt: skip
    """The steps of one stretch without gaps.

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
    excess[dt > _LATE * usual] = 0.0
    speeds = np.fmax(np.abs(steps - _TURN * turns) / dt[:, None], np.abs(logged[1:]))
    beside = np.ones((2 * _AROUND + 1, 1), dtype=bool)
    beside[_AROUND] = False
    fastest = maximum_filter(speeds, footprint=beside, mode="nearest")
    return EncoderJumpScan(q, turns, speed, excess, fastest)


def compute_jump_floors(walks: Sequence[EncoderJumpScan], resolution: np.ndarray) -> np.ndarray:
    """(J,) rad or m that a step must have too much to be a leap, over all stretches of a log.

    What is lone, and more than the step that the joint makes at its top speed: a smaller leap is
    no more than a sample too late or too early.
    """
    if not walks:
        return np.full(len(resolution), np.inf)
    excess = np.concatenate([walk.excess for walk in walks])
    steps = np.concatenate([np.diff(walk.q, axis=0) - _TURN * walk.turns for walk in walks])
    top = np.quantile(np.abs(steps), _TOP, axis=0)
    lonely = [
        compute_outlier_threshold(joint_excess, one, RARE)
        for joint_excess, one in zip(excess.T, resolution, strict=True)
    ]
    return np.maximum(lonely, top)


def compute_local_floors(walks: Sequence[EncoderJumpScan], known: np.ndarray) -> np.ndarray:
    """(J,) `compute_jump_floors` of a whole log for a part of it.

    Higher where the part is " "rougher.
    """
    return np.array([
        compute_local_threshold([walk.excess[:, j] for walk in walks], floor, RARE)
        for j, floor in enumerate(known)
    ])  # fmt: skip


def _compute_excess(
    step: np.ndarray, speed: np.ndarray, dt: np.ndarray, usual: float
) -> np.ndarray:
    """What a step has beyond speed x time; a stamp that came late or early excuses it.

    The rows may have been sampled evenly and stamped unevenly, or the other way round.
    """
    stamped, even = speed * dt, speed * usual
    low, high = np.minimum(stamped, even), np.maximum(stamped, even)
    return np.asarray(step - np.minimum(np.maximum(step, low), high))


def _find_whole_turns(excess: np.ndarray, resolution: float) -> np.ndarray:
    """(n,) whole turns of each step, where they leave no more than its neighbours have."""
    turns = np.round(excess / _TURN)
    places = np.flatnonzero(turns)
    left = np.abs(excess - _TURN * turns)
    for k in places:
        tolerated = max(
            NEAR * compute_nearby_level(left, int(k)), STEPS * resolution, _TURNED * _TURN
        )
        if left[k] > min(tolerated, 0.25 * _TURN):
            turns[k] = 0.0
    return np.asarray(turns)


def find_jumps(walk: EncoderJumpScan, time: np.ndarray, j: int, floor: float) -> list[Defect]:
    """The leaps of joint j, increasing in time.

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
    rest, places = (
        [],
        _select_sudden(walk.excess[:, j], find_isolated_outliers(walk.excess[:, j], floor)),
    )
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
        first, last = max(0, k - _SIDES), min(len(time) - 1, k + 1 + _SIDES)
        way = walk.q[last, j] - walk.q[first, j] - _TURN * walk.turns[first:last, j].sum()
        if abs(way) > walk.fastest[k, j] * (time[last] - time[first]):
            rest.append(Defect(kind, k + 1, k + 1, float(walk.excess[k, j])))
    return sorted(wraps + rest, key=lambda leap: leap.start)


def _select_sudden(excess: np.ndarray, places: np.ndarray) -> list[int]:
    """The places whose neighbours, if they are no leaps themselves, go on as ever.

    Mass has to be moved: a motion that is fast for its sampling leaps too, and runs out beside it.
    """
    sudden = []
    for k in map(int, places):
        beside = [abs(excess[i]) for i in (k - 1, k + 1) if i not in places]
        tolerated = max(
            _RUNS_OUT * abs(excess[k]), NEAR * compute_nearby_level(np.abs(excess), k) / 2.0
        )
        if max(beside, default=0.0) < tolerated:
            sudden.append(k)
    return sudden


def _count_frozen(walk: EncoderJumpScan, time: np.ndarray, j: int, k: int) -> int:
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


def _find_spike(walk: EncoderJumpScan, j: int, k: int, later: list[int]) -> Defect | None:
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
            return Defect("spike", k + 1, place + 1, size)
    return None


def _is_row_loss(walk: EncoderJumpScan, k: int) -> bool:
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


@dataclass(frozen=True)
class Damage:
    """One kind of defect of one channel of a log.

    Attributes:
        column: of the log, "q2"; "all channels" of repeated rows.
        joint: its name; "" of repeated rows.
        kind: of `Defect`.
        times: when each begins, s.
        lasts: for how long each is bad, s; 0 of a leap.
        samples: that are not used for it.
        size: the largest, in `unit`.
        unit: of the channel.
        line: what it is, where and when, what was done and what to do.
        is_mended: False where the data are used as logged.
    """

    column: str
    joint: str
    kind: str
    times: tuple[float, ...]
    lasts: tuple[float, ...]
    samples: int
    size: float
    unit: str
    line: str
    is_mended: bool = True


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

ALWAYS = ("wrap", "repeated")
"""Kinds that are mended without a fit: nothing is measured otherwise then."""


def repair_log(
    log: Log,
    spec: ModuleSpec,
    channel_scales: ChannelScales | None = None,
    repairs: Repairs | None = None,
) -> tuple[Log, Defects, ChannelScales]:
    """The log mended; what looks like a defect; and what is usual in the log.

    Rows that repeat the one before them in all channels are dropped, so that the rate of what is
    left is the robot's. Wraps are counted on, and positions that begin to count from another zero
    are joined to the longest stretch. Spikes, frozen and clipped values become missing ones. Where
    rows are missing and the clock ran on, a new piece begins. Held values are interpolated.

    Args:
        log: as it was read, or some consecutive rows of one.
        spec: the robot's manifest; it names the joints.
        channel_scales: in the whole log of which this is a part; None: it is all of it.
        repairs: what is mended besides `ALWAYS`; None: all.
    """

    def mended_by(name: str, defects_by_joint: Sequence[Sequence[Defect]]) -> list[list[Defect]]:
        return [
            [one for one in channel
             if repairs is None or one.kind in ALWAYS or (name, j, one.kind) in repairs]
            for j, channel in enumerate(defects_by_joint)
        ]  # fmt: skip

    again = _find_repeats(log, channel_scales)
    kept_rows = np.flatnonzero(~again)
    fresh = log
    if again.any():
        steps = np.diff(log.time[kept_rows])
        longest = 1.5 * log.step + float(steps[steps <= RESTS * np.median(steps)].max())
        rate = float(np.quantile(steps, _WITHIN)), longest
        fresh = dataclasses.replace(cut_rows(log, kept_rows), robot_steps=rate)
    held = _count_held_rows(fresh) if channel_scales is None else channel_scales.held
    quick = [rows == 1 for rows in held["q"]]
    clips = (
        channel_scales.clips
        if channel_scales is not None
        else tuple(
            find_clips(channel) if is_quick else ()
            for channel, is_quick in zip(fresh.q.T, quick, strict=True)
        )
    )
    clipped = [_find_clipped(channel, ends) for channel, ends in zip(fresh.q.T, clips, strict=True)]
    q = _remove_defects(fresh.q, mended_by("q", clipped))
    leaps, parts, steps, least = _find_all_jumps(
        dataclasses.replace(fresh, q=q), spec, channel_scales, quick
    )
    stays = (
        tuple(map(find_longest_usual_run, fresh.tau.T))
        if channel_scales is None
        else channel_scales.stays
    )
    others, lonely, torque = _find_spikes(fresh, channel_scales)
    defects_by_channel = {"q": [sorted(both[0] + both[1], key=lambda one: one.start)
                   for both in zip(clipped, leaps, strict=True)], **others}  # fmt: skip
    for channel, stuck in zip(defects_by_channel["tau"], _find_frozen(fresh, stays), strict=True):
        channel += stuck
    segment, values = fresh.piece_number, dict[str, np.ndarray]()
    for name, by_joint in defects_by_channel.items():
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
                column[:] = interpolate_held_channel(
                    fresh.time, column, held[name][j], smooth=name == "q"
                )
        lost = [one.start for channel in ours for one in channel if one.kind == "lost"]
        segment = segment + (np.arange(fresh.rows)[:, None] >= np.array(lost, int)).sum(axis=1)
    new = segment if (segment != fresh.piece_number).any() else fresh.segment
    mended = dataclasses.replace(
        fresh, segment=new, q=values["q"], tau=values["tau"], qd=values.get("qd"),
        qdd=values.get("qdd"),
    )  # fmt: skip
    defects_by_channel = {
        name: [[_locate_defect(one, kept_rows, log) for one in channel] for channel in by_joint]
        for name, by_joint in defects_by_channel.items()
    }
    if again.any():
        every = [Defect("repeated", *run, 0.0, float(log.time[run[0]])) for run in find_runs(again)]
        defects_by_channel["rows"] = [every]
    scales = ChannelScales(steps, least, torque, lonely, bool(again.any()), clips, stays, held)
    return mended, defects_by_channel, channel_scales or scales


def _count_held_rows(log: Log) -> dict[str, tuple[int, ...]]:
    """(J,) rows for which the values of each channel are held; 1: they are not."""
    channels = {"q": log.q, "tau": log.tau, "qd": log.qd, "qdd": log.qdd}
    return {
        name: tuple(map(estimate_hold_length, x.T)) for name, x in channels.items() if x is not None
    }


def _find_repeats(log: Log, channel_scales: ChannelScales | None) -> np.ndarray:
    """(n,) True at rows that a recorder wrote again."""
    if channel_scales is not None and not channel_scales.repeats:
        return np.zeros(log.rows, dtype=bool)
    others = [values for values in (log.tau, log.qd, log.qdd) if values is not None]
    return find_repeated_rows(log.q, np.column_stack(others), always=channel_scales is not None)


def _find_clipped(values: np.ndarray, ends: Sequence[Clip]) -> list[Defect]:
    """Stays at the ends of the range at which a position is cut off; none where it goes beyond."""
    clipped = []
    for end in ends:
        beyond = values > end.value if end.upper else values < end.value
        if not beyond.any():
            clipped += [
                Defect("clipped", *run, end.value) for run in find_runs(values == end.value)
            ]
    return sorted(clipped, key=lambda one: one.start)


def _find_frozen(log: Log, held: Sequence[int]) -> list[list[Defect]]:
    """Torques that repeat a value while their joint moves, by joint."""
    frozen: list[list[Defect]] = []
    for j, (tau, q) in enumerate(zip(log.tau.T, log.q.T, strict=True)):
        rows = np.flatnonzero(np.isfinite(tau) & np.isfinite(q))
        stuck = find_frozen_runs(tau[rows], q[rows], held[j]) if rows.size else []
        every = [Defect("frozen", *run, 0.0) for run in stuck]
        frozen.append([_locate_defect(one, rows, log) for one in every])
    return frozen


def _find_all_jumps(
    log: Log, spec: ModuleSpec, channel_scales: ChannelScales | None, quick: Sequence[bool]
) -> tuple[list[list[Defect]], list[np.ndarray], np.ndarray, np.ndarray]:
    """Leaps of positions by joint, and stretches that they were sought in; steps and floors."""
    positions: list[list[Defect]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    steps = (
        np.array([estimate_lattice_step(column) for column in log.q.T])
        if channel_scales is None
        else channel_scales.steps
    )
    there = np.isfinite(log.q).all(axis=1)
    stretches = [rows for rows in _iterate_stretches(log, there) if len(rows) > LEAST]
    logged = np.zeros_like(log.q) if log.qd is None else log.qd
    walks = [scan_jumps(log.time[k], log.q[k], revolute, steps, logged[k]) for k in stretches]
    least = (
        compute_jump_floors(walks, steps)
        if channel_scales is None
        else compute_local_floors(walks, channel_scales.leaps)
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
    """Rows (k,) of each stretch without a gap among those that are there (n,)."""
    rows = np.flatnonzero(there)
    cut = (np.diff(log.time[rows]) > log.gap) | (np.diff(log.piece_number[rows]) != 0)
    yield from np.split(rows, np.flatnonzero(cut) + 1)


def _locate_defect(defect: Defect, rows: np.ndarray, log: Log) -> Defect:
    """What was found in a stretch, at rows (k,) of the log."""
    start = int(rows[defect.start])
    stop = int(rows[defect.stop - 1]) + 1 if defect.stop > defect.start else start
    return dataclasses.replace(defect, start=start, stop=stop, time=float(log.time[start]))


def _locate_defects(
    by_stretch: Sequence[Sequence[Defect]], stretches: Sequence[np.ndarray], log: Log
) -> list[Defect]:
    """What was found in some stretches, at rows of the log."""
    pairs = zip(by_stretch, stretches, strict=True)
    return [_locate_defect(one, rows, log) for defects, rows in pairs for one in defects]


def _join_positions(q: np.ndarray, leaps: Sequence[Defect], parts: Sequence[np.ndarray]) -> None:
    """Count positions (n,) on, in place, from the longest stretch between two leaps."""
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
    log: Log, channel_scales: ChannelScales | None
) -> tuple[Defects, dict[str, np.ndarray | None], TorqueScales | None]:
    """Spikes of torques, logged velocities and accelerations, by joint; and what is usual."""
    defects_by_channel: Defects = {}
    floors: dict[str, np.ndarray | None] = {}
    torque = None if channel_scales is None else channel_scales.torque
    for name in ("tau", "qd", "qdd"):
        values = getattr(log, name)
        if values is None:
            continue
        there = np.isfinite(values).all(axis=1)
        if name == "tau":
            there &= np.isfinite(log.q).all(axis=1)
        rows = [part for part in _iterate_stretches(log, there) if len(part) >= LEAST]
        parts = [values[part] for part in rows]
        spikes, floors[name] = find_spikes(
            parts, None if channel_scales is None else channel_scales.floors[name]
        )
        if name == "tau" and parts:
            speeds = [np.gradient(log.q[part], log.time[part], axis=0) for part in rows]
            torque = torque or compute_torque_scales(parts, speeds)
            spikes = select_unexplained(spikes, parts, speeds, torque)
        defects_by_channel[name] = [_locate_defects(part, rows, log) for part in spikes] or [
            [] for _ in log.joints
        ]
    return defects_by_channel, floors, torque


def _remove_defects(values: np.ndarray, defects: Sequence[Sequence[Defect]]) -> np.ndarray:
    cleaned = values.copy() if any(defects) else values
    for j, channel in enumerate(defects):
        for one in channel:
            cleaned[one.start : one.stop, j] = np.nan
    return cleaned


def find_column(log: Log, spec: ModuleSpec, name: str, j: int) -> str:
    """A channel as the log calls it."""
    if name == "tau" and log.torque_source:
        return log.torque_source[j].split()[0]
    return f"{name}{spec.joints[j].name}"


def describe_damages(
    log: Log, rows: int, spec: ModuleSpec, defects_by_channel: Defects, repairs: Mapping[str, float]
) -> tuple[Damage, ...]:
    """What was found in the rows of a log, in words.

    Args:
        log: it, or a part of it.
        rows: of the whole log.
        spec: the robot's manifest.
        defects_by_channel: in all rows.
        repairs: by column and kind, the held-out error mended over that as logged.
    """
    descriptions = [
        _describe_repeats(log, rows, channel)
        for channel in defects_by_channel.get("rows", ())
        if channel
    ]
    for name, by_joint in defects_by_channel.items():
        if name == "rows":
            continue
        for j, channel in enumerate(by_joint):
            joint, column = spec.joints[j], find_column(log, spec, name, j)
            unit = joint.effort_unit if name == "tau" else f"{joint.unit}{_PER[name]}"
            for kind in dict.fromkeys(one.kind for one in channel):
                same = [one for one in channel if one.kind == kind]
                size = max((one.size for one in same), key=abs)
                samples, many = sum(one.stop - one.start for one in same), len(same) > 1
                first, rate = f"at {same[0].time:.6g} s", 1.0 / log.step
                words = _WORDS["torque" if kind == "spike" and name == "tau" else kind].format(
                    when=f"{len(same)} times, first {first}" if many else first,
                    size=f"{'up to ' * many}{abs(size):.3g} {unit}",
                    value=f"{size:.3g} {unit}",
                    rows=f"{size:.0f} rows: sampled at {rate / max(size, 1.0):.3g} Hz, not "
                    f"{rate:.4g} Hz",
                )
                done, score = _DONE.get(kind, "not used"), repairs.get(f"{column} {kind}", np.nan)
                if done == "not used":
                    done = (
                        f"{samples} sample{'s' * (samples > 1)} "
                        f"({format_percent(samples / rows)} of "
                    )
                    done += "the rows) not used"
                is_mended = kind in ALWAYS or score < CONFIRMED
                if not is_mended:
                    done, samples = "used as logged", 0
                if np.isfinite(score):
                    done += f", held-out error x {score:.2f}"
                line = f"{column}: {words}; {done}"
                if is_mended and kind in _ADVICE:
                    line += f"; {_ADVICE[kind]}"
                when = _compute_times(same, log.step)
                seen = Damage(column, joint.name, kind, *when, samples, abs(size), unit, line)
                descriptions.append(dataclasses.replace(seen, is_mended=is_mended))
    return tuple(descriptions)


def parse_repairs(log: Log, spec: ModuleSpec, names: Collection[str]) -> set[tuple[str, int, str]]:
    """`Repairs` by names as "q2 zero"."""
    return {
        (name, j, kind)
        for name in _PER
        for j in range(len(spec.joints))
        for kind in get_args(Kind)
        if f"{find_column(log, spec, name, j)} {kind}" in names
    }


def select_confirmed(repairs: Mapping[str, float]) -> frozenset[str]:
    """Those that a fit confirmed."""
    return frozenset(name for name, score in repairs.items() if score < CONFIRMED)


CONFIRMED = 0.95
"""Held-out error of a fit to a mended log over that to the log as it is, below which it is mended:
false claims have 0.997 and more."""


def _compute_times(
    defects: Sequence[Defect], step: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """When each begins, and how long it is bad, s."""
    return tuple(one.time for one in defects), tuple(
        (one.stop - one.start) * step for one in defects
    )


def _describe_repeats(log: Log, rows: int, defects: Sequence[Defect]) -> Damage:
    """Rows that were recorded more than once."""
    count = sum(one.stop - one.start for one in defects)
    when, rate = _compute_times(defects[:1], log.step), 1.0 / log.step
    line = describe_repeats(count, rows, rate)
    return Damage("all channels", "", "repeated", *when, count, rate, "Hz", line)


_PER = {"q": "", "tau": "", "qd": "/s", "qdd": "/s^2"}
_WORDS: Mapping[str, str] = {
    "wrap": "wraps by 2 pi rad, {when}",
    "spike": "jumps by {size} and back, {when}",
    "torque": "spike of {size}, {when}, that no other joint shows",
    "frozen": "repeats one value while the joint moves, {when}",
    "clipped": "stays at {value} at the end of its range without slowing down before, {when}",
    "zero": "jumps by {size} {when} and goes on from there",
    "lost": "jumps along its motion by {size}, {when}",
    "held": "holds each value for {rows}",
}
_DONE: Mapping[str, str] = {
    "wrap": "unwrapped",
    "zero": "joined to the longest part",
    "lost": "no filter runs across",
    "held": "interpolated between new values",
}
_ADVICE: Mapping[str, str] = {
    "spike": "check the sensor and its cable",
    "frozen": "check the bus and the logger",
    "clipped": "check the ranges of sensor and logger",
    "zero": "check the encoder",
    "lost": "log the true time of each row",
}
