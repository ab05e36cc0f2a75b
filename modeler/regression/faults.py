"""What no robot does, in the channels of a log: faults, and the log as each would be repaired."""

import dataclasses
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np

from modeler.core.manifest import ModuleSpec
from modeler.numerics import noise
from modeler.regression.defects import (
    Defect,
    Defects,
    Kind,
    TorqueScales,
    can_leap,
    compute_jump_floors,
    compute_local_floors,
    compute_torque_scales,
    find_jumps,
    find_spikes,
    scan_jumps,
    select_unexplained,
)
from modeler.regression.log import Log, find_runs
from modeler.regression.read import cut_rows
from modeler.regression.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class ChannelScales:
    """What is usual in the channels of a log, beside which a defect stands out; J joints.

    Attributes:
        steps: (J,) smallest step of each position.
        leaps: (J,) what a step must have too much to be a leap.
        torque: and the speeds; None where no torque is measured.
        floors: (J,) departure below which no value is a spike, of "tau" and logged "qd" and "qdd";
            None where the log has no segment of them.
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
    clips: tuple[tuple[noise.Clip, ...], ...]
    stays: tuple[int, ...]
    held: Mapping[str, tuple[int, ...]]


Repairs = Collection[tuple[str, int, str]]
"""Channel, joint and kind of the defects that are mended."""

CHANNELS = ("q", "tau", "qd", "qdd")
REPEATED = ("rows", 0, "repeated")
ALWAYS = ("wrap",)
"""Kinds that are mended without a fit: nothing is measured otherwise then."""


def repair_log(
    log: Log, spec: ModuleSpec, scales: ChannelScales | None = None, repairs: Repairs | None = None
) -> tuple[Log, Defects, ChannelScales]:
    """Returns the log mended; what looks like a defect; and what is usual in the log.

    Rows that repeat the one before them in all channels are dropped, so that the rate of what is
    left is the robot's. Wraps are counted on, and positions that begin to count from another zero
    are joined to the longest segment. Spikes, frozen and clipped values become missing ones. Where
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
    is_thinned = again.any() and (repairs is None or REPEATED in repairs)
    kept_rows = np.flatnonzero(~again) if is_thinned else np.arange(log.rows)
    fresh = log
    if is_thinned:
        steps = np.diff(log.time[kept_rows])
        longest = 1.5 * log.step + float(steps[steps <= noise.RESTS * np.median(steps)].max())
        rate = float(np.quantile(steps, THRESHOLDS.step_quantile)), longest
        fresh = dataclasses.replace(cut_rows(log, kept_rows), robot_steps=rate)
    held = _count_held_rows(fresh) if scales is None else scales.held
    quick = [rows == 1 for rows in held["q"]]
    if scales is not None:
        clips, stays = scales.clips, scales.stays
    else:
        sampled = zip(fresh.q.T, quick, strict=True)
        clips = tuple(noise.find_clips(x) if is_quick else () for x, is_quick in sampled)
        stays = tuple(map(noise.find_longest_usual_run, fresh.tau.T))
    clipped = [_find_clipped(channel, ends) for channel, ends in zip(fresh.q.T, clips, strict=True)]
    q = _remove_defects(fresh.q, mended_by("q", clipped))
    unclipped = dataclasses.replace(fresh, q=q)
    leaps, parts, steps, least = _find_all_jumps(unclipped, spec, scales, quick)
    others, lonely, torque = _find_spikes(fresh, scales)
    pairs = zip(clipped, leaps, strict=True)
    in_order = [sorted(ends + jumps, key=lambda one: one.start) for ends, jumps in pairs]
    by_channel = {"q": in_order, **others}
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
                column, known = values[name][:, j], (fresh.time, values[name][:, j], held[name][j])
                column[:] = noise.interpolate_held_channel(*known, smooth=name == "q")
        lost = [one.start for channel in ours for one in channel if one.kind == "lost"]
        segment = segment + (np.arange(fresh.rows)[:, None] >= np.array(lost, int)).sum(axis=1)
    new = segment if (segment != fresh.piece_number).any() else fresh.segment
    mended = dataclasses.replace(fresh, segment=new, q=values["q"], tau=values["tau"])
    mended = dataclasses.replace(mended, qd=values.get("qd"), qdd=values.get("qdd"))
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
    return {name: tuple(map(noise.estimate_hold_length, x)) for name, x in logged.items()}


def _find_repeats(log: Log, scales: ChannelScales | None) -> np.ndarray:
    """Returns (n,) True at rows that a recorder wrote again."""
    if scales is not None and not scales.repeats:
        return np.zeros(log.rows, dtype=bool)
    others = [values for values in (log.tau, log.qd, log.qdd) if values is not None]
    return noise.find_repeated_rows(log.q, np.column_stack(others), always=scales is not None)


def _find_clipped(values: np.ndarray, ends: Sequence[noise.Clip]) -> list[Defect]:
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
        stuck = noise.find_frozen_runs(tau[rows], q[rows], held[j]) if rows.size else []
        every = [Defect("frozen", *run, 0.0) for run in stuck]
        frozen.append([_locate_defect(one, rows, log) for one in every])
    return frozen


def _find_all_jumps(
    log: Log, spec: ModuleSpec, scales: ChannelScales | None, quick: Sequence[bool]
) -> tuple[list[list[Defect]], list[np.ndarray], np.ndarray, np.ndarray]:
    """Returns jumps of positions by joint, the segments that were scanned, steps and floors."""
    positions: list[list[Defect]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    steps = (
        np.array([noise.estimate_lattice_step(column) for column in log.q.T])
        if scales is None
        else scales.steps
    )
    there = np.isfinite(log.q).all(axis=1)
    stretches = [rows for rows in _iterate_stretches(log, there) if len(rows) > noise.LEAST]
    if scales is not None and not any(
        can_leap(log.time[k], log.q[k], scales.leaps) for k in stretches
    ):
        return positions, stretches, steps, scales.leaps
    logged = np.zeros_like(log.q) if log.qd is None else log.qd
    walks = [scan_jumps(log.time[k], log.q[k], revolute, steps, logged[k]) for k in stretches]
    if scales is None:
        least = compute_jump_floors(walks, steps)
    else:
        least = compute_local_floors(walks, scales.leaps)
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
    """Yields rows (k,) of each segment without a gap among those that are there (n,)."""
    rows = np.flatnonzero(there)
    cut = (np.diff(log.time[rows]) > log.gap) | (np.diff(log.piece_number[rows]) != 0)
    yield from np.split(rows, np.flatnonzero(cut) + 1)


def _locate_defect(defect: Defect, rows: np.ndarray, log: Log) -> Defect:
    """Returns what was found in a segment, at rows (k,) of the log."""
    start = int(rows[defect.start])
    stop = int(rows[defect.stop - 1]) + 1 if defect.stop > defect.start else start
    return dataclasses.replace(defect, start=start, stop=stop, time=float(log.time[start]))


def _locate_defects(
    by_stretch: Sequence[Sequence[Defect]], stretches: Sequence[np.ndarray], log: Log
) -> list[Defect]:
    """Returns what was found in some segments, at rows of the log."""
    pairs = zip(by_stretch, stretches, strict=True)
    return [_locate_defect(one, rows, log) for defects, rows in pairs for one in defects]


def _join_positions(q: np.ndarray, leaps: Sequence[Defect], parts: Sequence[np.ndarray]) -> None:
    """Counts positions (n,) on, in place, from the longest segment between two leaps."""
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
        rows = [part for part in _iterate_stretches(log, there) if len(part) >= noise.LEAST]
        parts = [values[part] for part in rows]
        spikes, floors[name] = find_spikes(parts, None if scales is None else scales.floors[name])
        if name == "tau" and parts and (torque is None or any(map(any, spikes))):
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
    if name == "rows":
        return "all channels"
    if name == "tau" and log.torque_source:
        return log.torque_source[j].split()[0]
    return f"{name}{spec.joints[j].name}"


def parse_repairs(log: Log, spec: ModuleSpec, names: Collection[str]) -> set[tuple[str, int, str]]:
    """Returns `Repairs` by names as "q2 zero"."""
    channels = [("rows", 0), *((name, j) for name in CHANNELS for j in range(len(spec.joints)))]
    columns = {key: find_column(log, spec, *key) for key in channels}
    every = [(key, kind) for key in channels for kind in get_args(Kind)]
    return {(*key, kind) for key, kind in every if f"{columns[key]} {kind}" in names}


def select_confirmed(repairs: Mapping[str, float]) -> frozenset[str]:
    """Returns the repairs that a fit confirmed."""
    return frozenset(name for name, score in repairs.items() if score < THRESHOLDS.max_repair_ratio)
