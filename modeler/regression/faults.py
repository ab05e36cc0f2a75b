"""What no robot does, in the channels of a log: faults, and the log as each would be repaired."""

import dataclasses
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np

from modeler.core.manifest import ModuleSpec
from modeler.numerics import noise
from modeler.numerics.channels import (
    RESTS,
    ChannelModel,
    find_frozen_runs,
    find_repeated_rows,
    interpolate_held_channel,
)
from modeler.regression.defects import (
    Defect,
    Defects,
    Kind,
    can_jump,
    compute_jump_floor,
    find_jumps,
    find_spikes,
    scan_jumps,
    select_unexplained,
)
from modeler.regression.log import ChannelModels, Log, find_runs
from modeler.regression.read import cut_rows
from modeler.regression.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class ChannelScales:
    """What is usual in a log, beside which a defect stands out.

    Attributes:
        channels: how each was sampled.
        repeats: True if rows repeat, as the recorder is faster than the robot.
    """

    channels: ChannelModels
    repeats: bool


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
        longest = 1.5 * log.step + float(steps[steps <= RESTS * np.median(steps)].max())
        rate = float(np.quantile(steps, THRESHOLDS.step_quantile)), longest
        fresh = dataclasses.replace(cut_rows(log, kept_rows), robot_steps=rate)
    once = cut_rows(log, ~again) if again.any() else log
    models = once.channel_models if scales is None else scales.channels
    fresh = dataclasses.replace(fresh, channels=models)
    clipped = [_find_clipped(*of) for of in zip(fresh.q.T, models["q"], strict=True)]
    q = _remove_defects(fresh.q, mended_by("q", clipped))
    leaps, parts = _find_all_jumps(dataclasses.replace(fresh, q=q), spec, bool(again.any()))
    pairs = zip(clipped, leaps, strict=True)
    in_order = [sorted(ends + jumps, key=lambda one: one.start) for ends, jumps in pairs]
    by_channel = {"q": in_order, **_find_spikes(fresh)}
    for channel, stuck in zip(by_channel["tau"], _find_frozen(fresh), strict=True):
        channel += stuck
    segment, values = fresh.piece_number, dict[str, np.ndarray]()
    for name, by_joint in by_channel.items():
        for j, model in enumerate(models[name]):
            if model.is_held:
                by_joint[j] = [one for one in by_joint[j] if one.kind == "wrap"]
                by_joint[j].append(Defect("held", 0, 0, model.hold, float(fresh.time[0])))
        ours = mended_by(name, by_joint)
        values[name] = _remove_defects(q if name == "q" else getattr(fresh, name), ours)
        for j, channel in enumerate(ours):
            if name == "q" and channel:
                _join_positions(values[name][:, j], channel, parts)
            if any(one.kind == "held" for one in channel):
                column, hold = values[name][:, j], models[name][j].hold
                column[:] = interpolate_held_channel(fresh.time, column, hold, smooth=name == "q")
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
    return mended, by_channel, scales or ChannelScales(models, bool(again.any()))


def _find_repeats(log: Log, scales: ChannelScales | None) -> np.ndarray:
    """Returns (n,) True at rows that a recorder wrote again."""
    if scales is not None and not scales.repeats:
        return np.zeros(log.rows, dtype=bool)
    others = [values for values in (log.tau, log.qd, log.qdd) if values is not None]
    return find_repeated_rows(log.q, np.column_stack(others), always=scales is not None)


def _find_clipped(values: np.ndarray, model: ChannelModel) -> list[Defect]:
    """Returns runs at the ends of the range of a position; none where it goes beyond."""
    clipped = []
    for end in model.clips:
        beyond = values > end.value if end.upper else values < end.value
        if not beyond.any():
            stays = find_runs(values == end.value)
            clipped += [Defect("clipped", *run, end.value) for run in stays]
    return sorted(clipped, key=lambda one: one.start)


def _find_frozen(log: Log) -> list[list[Defect]]:
    """Returns torques that repeat a value while their joint moves, by joint."""
    frozen: list[list[Defect]] = []
    models = zip(log.channels["tau"], log.channels["q"], strict=True)
    for tau, q, (torque, position) in zip(log.tau.T, log.q.T, models, strict=True):
        rows = np.flatnonzero(np.isfinite(tau) & np.isfinite(q))
        known = tau[rows], torque, q[rows], position.noise
        stuck = find_frozen_runs(*known) if rows.size else []
        every = [Defect("frozen", *run, 0.0) for run in stuck]
        frozen.append([_locate_defect(one, rows, log) for one in every])
    return frozen


def _find_all_jumps(
    log: Log, spec: ModuleSpec, repeats: bool
) -> tuple[list[list[Defect]], list[np.ndarray]]:
    """Returns jumps of positions by joint, and the segments that were scanned."""
    positions: list[list[Defect]] = [[] for _ in spec.joints]
    revolute = np.array([joint.kind == "revolute" for joint in spec.joints])
    there = np.isfinite(log.q).all(axis=1)
    stretches = [rows for rows in _iterate_stretches(log, there) if len(rows) > noise.LEAST]
    logged = np.zeros_like(log.q) if log.qd is None else log.qd
    floors = np.array([compute_jump_floor(model) for model in log.channels["q"]])
    for rows in stretches:
        if not can_jump(log.time[rows], log.q[rows], floors):
            continue
        walk = scan_jumps(log.time[rows], log.q[rows], revolute, logged[rows])
        for j, model in enumerate(log.channels["q"]):
            jumps = find_jumps(walk, log.time[rows], j, model)
            if repeats:  # rows of such a log come when they come
                jumps = [leap for leap in jumps if leap.kind not in ("lost", "frozen")]
            positions[j] += [_locate_defect(leap, rows, log) for leap in jumps]
    return positions, stretches


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


def _find_spikes(log: Log) -> Defects:
    """Returns spikes of torques, logged velocities and accelerations, by joint."""
    by_channel: Defects = {}
    integrals = {"qd": ("q", log.q), "qdd": ("qd", log.qd)}
    for name, values in log.measured.items():
        if name == "q":
            continue
        there = np.isfinite(values).all(axis=1)
        if name == "tau":
            there &= np.isfinite(log.q).all(axis=1)
        rows = [part for part in _iterate_stretches(log, there) if len(part) >= noise.LEAST]
        parts = [values[part] for part in rows]
        spikes = find_spikes(parts, log.channels[name])
        if name == "tau" and any(map(any, spikes)):
            speeds = [np.gradient(log.q[part], log.time[part], axis=0) for part in rows]
            spikes = select_unexplained(spikes, parts, speeds)
        by_channel[name] = [_locate_defects(part, rows, log) for part in spikes]
        lower, integral = integrals.get(name, ("", None))
        if integral is not None:
            models = zip(by_channel[name], integral.T, log.channels[lower], strict=True)
            by_channel[name] = [
                [one for one in channel if not _is_shared(one, log.time, x, model.resolution)]
                for channel, x, model in models
            ]
    return by_channel


def _is_shared(spike: Defect, time: np.ndarray, lower: np.ndarray, resolution: float) -> bool:
    """Returns True if what a logged derivative (n,) derives from leaps there too."""
    near = slice(max(0, spike.start - 2), spike.stop + 2)
    steps = np.abs(np.diff(lower[near])) + resolution
    return bool(np.any(steps > 0.5 * abs(spike.size) * np.diff(time[near])))


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
