"""What no robot does, in the channels of a log: found, told, and mended or left out; leaps."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.manifest import ModuleSpec
from modeler.core.table import percent
from modeler.logs import repeats_line
from modeler.numerics.held import RESTS, Clip, clips_of, frozen_runs, longest_usual, repeated_rows
from modeler.numerics.noise import (
    LEAST,
    NEAR,
    STEPS,
    floor_here,
    lone,
    nearby,
    resolution,
    running_median,
    threshold,
)
from modeler.observation.log import Log
from modeler.observation.read import cut
from modeler.observation.segments import runs
from modeler.observation.spikes import Defect, Kind, Usual, glitches, unexplained, usual_of

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

RARE = 2e-2
"""Share of a joint's steps that may be leaps."""


@dataclass(frozen=True, eq=False)
class LeapWalk:
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
) -> LeapWalk:
    """The steps of one stretch without gaps.

    Args:
        time: (n,) s, more than `LEAST`: a shorter one does not tell.
        q: (n, J) rad or m, all finite.
        revolute: (J,) joints that may wrap.
        resolution: (J,) smallest step of each.
    """
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
    return LeapWalk(q, turns, speed, excess)


def floors(walks: Sequence[LeapWalk], resolution: np.ndarray) -> np.ndarray:
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


def floors_here(walks: Sequence[LeapWalk], known: np.ndarray) -> np.ndarray:
    """(J,) `floors` of a whole log for a part of it, higher where the part is rougher."""
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


def leaps_of(walk: LeapWalk, time: np.ndarray, j: int, floor: float) -> list[Defect]:
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
    rest, places = [], _sudden(walk.excess[:, j], lone(walk.excess[:, j], floor))
    while places:
        k = places.pop(0)
        held = _frozen_until(walk, time, j, k)
        if held:
            rest.append(Defect("frozen", k + 1 - held, k + 1, float(walk.excess[k, j])))
            continue
        there = _spike_leap(walk, j, k, places)
        if there is not None:
            places = [later for later in places if later > there.stop - 1]
            rest.append(there)
            continue
        kind: Kind = "lost" if _loses_rows(walk, k) else "zero"
        rest.append(Defect(kind, k + 1, k + 1, float(walk.excess[k, j])))
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


def _frozen_until(walk: LeapWalk, time: np.ndarray, j: int, k: int) -> int:
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


def _spike_leap(walk: LeapWalk, j: int, k: int, later: list[int]) -> Defect | None:
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


def _loses_rows(walk: LeapWalk, k: int) -> bool:
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
        held: (J,) samples for which each torque may stay the same.
    """

    steps: np.ndarray
    leaps: np.ndarray
    torque: Usual | None
    floors: Mapping[str, np.ndarray | None]
    repeats: bool
    clips: tuple[tuple[Clip, ...], ...]
    held: tuple[int, ...]


def defects(
    log: Log, spec: ModuleSpec, usual: ChannelScales | None = None
) -> tuple[Log, Defects, ChannelScales]:
    """The log without what no robot can have made; what that is; and what is usual in the log.

    Rows that repeat the one before them in all channels are dropped, so that the rate of what is
    left is the robot's. Wraps are counted on, and positions that begin to count from another zero
    are joined to the longest stretch. Spikes, frozen and clipped values become missing ones. Where
    rows are missing and the clock ran on, a new piece begins.

    Args:
        log: as it was read, or some consecutive rows of one.
        spec: the robot's manifest; it names the joints.
        usual: in the whole log of which this is a part; None: it is all of it.
    """
    again = _repeats(log, usual)
    kept = np.flatnonzero(~again)
    fresh = log
    if again.any():
        steps = np.diff(log.time[kept])
        longest = 1.5 * log.step + float(steps[steps <= RESTS * np.median(steps)].max())
        rate = float(np.quantile(steps, _WITHIN)), longest
        fresh = dataclasses.replace(cut(log, kept), robot_steps=rate)
    clips = tuple(clips_of(own) for own in fresh.q.T) if usual is None else usual.clips
    clipped = [_clipped(own, ends) for own, ends in zip(fresh.q.T, clips, strict=True)]
    q, segment, leaps, steps, least = _positions(
        dataclasses.replace(fresh, q=_without(fresh.q, clipped)), spec, usual
    )
    held = tuple(map(longest_usual, fresh.tau.T)) if usual is None else usual.held
    others, lonely, torque = _spikes(fresh, usual)
    for own, stuck in zip(others["tau"], _frozen(fresh, held), strict=True):
        own += stuck
    positions = [both[0] + both[1] for both in zip(clipped, leaps, strict=True)]
    new = segment if (segment != fresh.piece_number).any() else fresh.segment
    mended = dataclasses.replace(
        fresh,
        q=q,
        segment=new,
        tau=_without(fresh.tau, others["tau"]),
        qd=None if fresh.qd is None else _without(fresh.qd, others["qd"]),
        qdd=None if fresh.qdd is None else _without(fresh.qdd, others["qdd"]),
    )
    found = {
        name: [[_at(one, kept, log) for one in own] for own in by_joint]
        for name, by_joint in {"q": positions, **others}.items()
    }
    if again.any():
        every = [Defect("repeated", *run, 0.0, float(log.time[run[0]])) for run in runs(again)]
        found["rows"] = [every]
    scales = ChannelScales(steps, least, torque, lonely, bool(again.any()), clips, held)
    return mended, found, usual or scales


def _repeats(log: Log, usual: ChannelScales | None) -> np.ndarray:
    """(n,) True at rows that a recorder wrote again."""
    if usual is not None and not usual.repeats:
        return np.zeros(log.rows, dtype=bool)
    others = [values for values in (log.tau, log.qd, log.qdd) if values is not None]
    return repeated_rows(log.q, np.column_stack(others), always=usual is not None)


def _clipped(values: np.ndarray, ends: Sequence[Clip]) -> list[Defect]:
    """Stays at the ends of the range at which a position is cut off; none where it goes beyond."""
    found = []
    for end in ends:
        beyond = values > end.value if end.upper else values < end.value
        if not beyond.any():
            found += [Defect("clipped", *run, end.value) for run in runs(values == end.value)]
    return sorted(found, key=lambda one: one.start)


def _frozen(log: Log, held: Sequence[int]) -> list[list[Defect]]:
    """Torques that repeat a value while their joint moves, by joint."""
    found: list[list[Defect]] = []
    for j, (tau, q) in enumerate(zip(log.tau.T, log.q.T, strict=True)):
        rows = np.flatnonzero(np.isfinite(tau) & np.isfinite(q))
        stuck = frozen_runs(tau[rows], q[rows], held[j]) if rows.size else []
        every = [Defect("frozen", *run, 0.0) for run in stuck]
        found.append([_at(one, rows, log) for one in every])
    return found


def _positions(
    log: Log, spec: ModuleSpec, usual: ChannelScales | None
) -> tuple[np.ndarray, np.ndarray, list[list[Defect]], np.ndarray, np.ndarray]:
    """Mended positions, segments, what was found by joint; steps and floors of leaps."""
    q, segment = log.q.copy(), log.piece_number
    positions: list[list[Defect]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    steps = np.array([resolution(own) for own in log.q.T]) if usual is None else usual.steps
    there = np.isfinite(log.q).all(axis=1)
    stretches = [rows for rows in _stretches(log, there) if len(rows) > LEAST]
    walks = [walked(log.time[rows], log.q[rows], revolute, steps) for rows in stretches]
    least = floors(walks, steps) if usual is None else floors_here(walks, usual.leaps)
    for rows, walk in zip(stretches, walks, strict=True):
        for j in range(len(spec.joints)):
            leaps = leaps_of(walk, log.time[rows], j, least[j])
            if log.robot_steps is not None:  # rows of such a log come when they come
                leaps = [leap for leap in leaps if leap.kind != "lost"]
            q[rows, j] = _mended(walk, j, leaps)
            positions[j] += [_at(leap, rows, log) for leap in leaps]
            for leap in leaps:
                if leap.kind == "lost":
                    segment[rows[leap.start] :] += 1
    return q, segment, positions, steps, least


def _stretches(log: Log, there: np.ndarray) -> Iterator[np.ndarray]:
    """Rows (k,) of each stretch without a gap among those that are there (n,)."""
    rows = np.flatnonzero(there)
    cut = (np.diff(log.time[rows]) > log.gap) | (np.diff(log.piece_number[rows]) != 0)
    yield from np.split(rows, np.flatnonzero(cut) + 1)


def _at(found: Defect, rows: np.ndarray, log: Log) -> Defect:
    """What was found in a stretch, at rows (k,) of the log."""
    start = int(rows[found.start])
    stop = int(rows[found.stop - 1]) + 1 if found.stop > found.start else start
    return dataclasses.replace(found, start=start, stop=stop, time=float(log.time[start]))


def _placed(
    found: Sequence[Sequence[Defect]], stretches: Sequence[np.ndarray], log: Log
) -> list[Defect]:
    """What was found in some stretches, at rows of the log."""
    pairs = zip(found, stretches, strict=True)
    return [_at(one, rows, log) for own, rows in pairs for one in own]


def _mended(walk: LeapWalk, j: int, leaps: Sequence[Defect]) -> np.ndarray:
    """(n,) the positions of joint j: counted on, joined, and NaN where they are wrong."""
    q = walk.q[:, j].copy()
    offset, edges = np.zeros(len(q)), [0]
    for leap in leaps:
        if leap.kind in ("wrap", "zero"):
            offset[leap.start :] += leap.size
            edges.append(leap.start)
        q[leap.start : leap.stop] = np.nan
    longest = edges[int(np.argmax(np.diff([*edges, len(q)])))]
    return np.asarray(q - (offset - offset[longest]))


def _spikes(
    log: Log, usual: ChannelScales | None
) -> tuple[Defects, dict[str, np.ndarray | None], Usual | None]:
    """Spikes of torques, logged velocities and accelerations, by joint; and what is usual."""
    found: Defects = {}
    floors: dict[str, np.ndarray | None] = {}
    torque = None if usual is None else usual.torque
    for name in ("tau", "qd", "qdd"):
        values = getattr(log, name)
        if values is None:
            continue
        there = np.isfinite(values).all(axis=1)
        if name == "tau":
            there &= np.isfinite(log.q).all(axis=1)
        rows = [own for own in _stretches(log, there) if len(own) >= LEAST]
        parts = [values[own] for own in rows]
        spikes, floors[name] = glitches(parts, None if usual is None else usual.floors[name])
        if name == "tau" and parts:
            speeds = [np.gradient(log.q[own], log.time[own], axis=0) for own in rows]
            torque = torque or usual_of(parts, speeds)
            spikes = unexplained(spikes, parts, speeds, torque)
        found[name] = [_placed(own, rows, log) for own in spikes] or [[] for _ in log.joints]
    return found, floors, torque


def _without(values: np.ndarray, found: Sequence[Sequence[Defect]]) -> np.ndarray:
    kept = values.copy() if any(found) else values
    for j, own in enumerate(found):
        for one in own:
            kept[one.start : one.stop, j] = np.nan
    return kept


def damages(log: Log, rows: int, spec: ModuleSpec, found: Defects) -> tuple[Damage, ...]:
    """What was found in the rows of a log, in words.

    Args:
        log: it, or a part of it.
        rows: of the whole log.
        spec: the robot's manifest.
        found: in all rows.
    """
    told = [_recorded_again(log, rows, own) for own in found.get("rows", ()) if own]
    for name, by_joint in found.items():
        if name == "rows":
            continue
        for joint, own in zip(spec.joints, by_joint, strict=bool(by_joint)):
            column, unit = f"{name}{joint.name}", joint.effort_unit
            if name in _PER:
                unit = f"{joint.unit}{_PER[name]}"
            elif log.torque_source:
                column = log.torque_source[spec.joints.index(joint)].split()[0]
            for kind in dict.fromkeys(one.kind for one in own):
                same = [one for one in own if one.kind == kind]
                size = max(abs(one.size) for one in same)
                samples = sum(one.stop - one.start for one in same)
                first = f"at {same[0].time:.6g} s"
                words = _WORDS["torque" if kind == "spike" and column[0] != "q" else kind].format(
                    when=first if len(same) == 1 else f"{len(same)} times, first {first}",
                    size=f"{'up to ' * (len(same) > 1)}{size:.3g} {unit}",
                    unused=f"{samples} sample{'s' * (samples > 1)} "
                    f"({percent(samples / rows)} of the rows) not used",
                    part=f"{log.name}@{same[0].time:.6g}:",
                )
                line = f"{column}: {words}"
                when = _when(same, log.step)
                told.append(Damage(column, joint.name, kind, *when, samples, size, unit, line))
    return tuple(told)


def _when(found: Sequence[Defect], step: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """When each begins, and how long it is bad, s."""
    return tuple(one.time for one in found), tuple((one.stop - one.start) * step for one in found)


def _recorded_again(log: Log, rows: int, found: Sequence[Defect]) -> Damage:
    """Rows that were recorded more than once."""
    count = sum(one.stop - one.start for one in found)
    when, rate = _when(found[:1], log.step), 1.0 / log.step
    line = repeats_line(count, rows, rate)
    return Damage("all channels", "", "repeated", *when, count, rate, "Hz", line)


_PER = {"q": "", "qd": "/s", "qdd": "/s^2"}
_WORDS: Mapping[str, str] = {
    "wrap": "leaps by whole turns of 2 pi rad {when}; counted on from the longest stretch between "
    "two leaps: only what does not repeat with every turn, as a spring or a cable, is not served "
    "by that; log positions that do not wrap",
    "spike": "leaps by {size} and back {when}, which no joint can; {unused}; check the encoder and "
    "its cable",
    "torque": "a spike of {size} {when}, far above the noise, which no other joint feels; "
    "{unused}; check the wiring of that channel",
    "frozen": "repeats an old value while the joint moves, {when}; {unused}; the logger or the bus "
    "was late: log fewer columns, or slower",
    "clipped": "stays at an end of its range, {size}, {when}, though the joint moves on: the "
    "position is clipped; {unused}; check the range of the sensor and of the logger",
    "zero": "leaps by {size} {when} and goes on from there: the encoder found another zero; joined "
    "to the longest stretch between two leaps, whose zero is kept; if another is right, use that "
    "part alone, as in {part}",
    "lost": "leaps along its motion by {size} {when}: rows are missing there while the clock ran "
    "on; no filter runs across; log the true time of each row",
}
