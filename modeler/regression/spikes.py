"""Spikes of one to three samples in torques, velocities and accelerations: of wires, not motion."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.numerics.noise import (
    REACH,
    compute_local_threshold,
    compute_nearby_level,
    compute_outlier_threshold,
    estimate_lattice_step,
    find_isolated_outliers,
    subtract_running_median,
)

LONGEST = 3
"""Samples of a spike, at most; what lasts longer may be a blow, which a diagnosis looks for."""

SHARE = 0.2
"""Of a channel's range (1 % to 99 % of its values) that a spike exceeds: a smaller one vanishes in
the parallel filter."""

RARE = 1e-3
"""Share of a channel's values that may be spikes: a controller's kicks come again and again."""

TOGETHER = 3.0
"""Times its neighbourhood that another torque reaches when the machine itself was hit."""

_BACK = 0.3  # of the spike: by what the values on both sides of it differ, at most
_AROUND = 2  # samples between what two torques of one blow show
_MEAN = 5  # samples before and after a spike over which the speed is taken
_RARELY = 0.95  # quantile of the changes of the speed over that time
_STARTS = 2.0  # times the changes just before: something began
_SLOW = 0.05  # of the top speed: at a reversal and at rest, friction makes peaks of its own

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
    """The lone departures of channels from their running median, in runs of up to 3.

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
        here = compute_local_threshold(sizes, float(floor), RARE)
        pairs = zip(channel, sizes, strict=True)
        spikes.append([_find_lone_runs(values, part, here) for values, part in pairs])
    return spikes, floors


def _compute_floor(channel: Sequence[np.ndarray], departed: Sequence[np.ndarray]) -> float:
    """Departure below which no value of a whole channel is a spike."""
    whole = np.concatenate(channel)
    low, high = np.quantile(whole, [0.01, 0.99])
    lonely = compute_outlier_threshold(np.concatenate(departed), estimate_lattice_step(whole), RARE)
    return max(lonely, SHARE * float(high - low))


def _find_lone_runs(values: np.ndarray, departed: np.ndarray, floor: float) -> list[Defect]:
    places, spikes = find_isolated_outliers(departed, floor), list[Defect]()
    for run in np.split(places, np.flatnonzero(np.diff(places) > 1) + 1):
        if not 0 < len(run) <= LONGEST:
            continue
        size = float(departed[run[int(np.argmax(np.abs(departed[run])))]])
        start, stop = int(run[0]), int(run[-1]) + 1
        beside = values[[k for k in (start - 1, stop) if 0 <= k < len(values)]]
        if np.ptp(beside) < _BACK * abs(size):
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
    """Of the stretches (n, J) of a whole log, one at least."""
    low, high = np.quantile(np.concatenate(torques), [0.01, 0.99], axis=0)
    return TorqueScales(high - low, np.quantile(np.abs(np.concatenate(speeds)), 0.98, axis=0))


def select_unexplained(
    spikes_by_joint: Spikes,
    torques: Sequence[np.ndarray],
    speeds: Sequence[np.ndarray],
    torque_scales: TorqueScales,
) -> Spikes:
    """The spikes of torques that no motion and no blow explains.

    A torque that is real moves its joint, and a blow is felt in several joints. Where a joint
    turns back or sticks, friction makes peaks of its own, which stay within the range of the
    channel (1 % to 99 % of its values).

    Args:
        spikes_by_joint: by `find_spikes` of the torques.
        torques: (n, J) by stretch; a joint without a measured torque is all 0.
        speeds: (n, J) by stretch.
        torque_scales: in the whole log.
    """
    if not any(spikes for by_joint in spikes_by_joint for spikes in by_joint):
        return spikes_by_joint
    sizes = [
        np.abs(np.column_stack([subtract_running_median(column) for column in tau.T]))
        for tau in torques
    ]
    return [
        [
            [spike for spike in spikes
             if not _is_impact(size, j, spike) and not _is_corroborated(speed[:, j], spike)
             and (abs(spike.size) > torque_scales.range[j]
                  or _is_moving(speed[:, j], spike, _SLOW * torque_scales.top[j]))]
            for spikes, size, speed in zip(by_stretch, sizes, speeds, strict=True)
        ]
        for j, by_stretch in enumerate(spikes_by_joint)
    ]  # fmt: skip


def _is_impact(sizes: np.ndarray, j: int, spike: Defect) -> bool:
    """True if another torque departs too, around the same time."""
    first, last = max(0, spike.start - _AROUND), spike.stop + _AROUND
    for k in range(sizes.shape[1]):
        if k == j:
            continue
        place = first + int(np.argmax(sizes[first:last, k]))
        if sizes[place, k] > TOGETHER * compute_nearby_level(sizes[:, k], place):
            return True
    return False


def _is_corroborated(speed: np.ndarray, spike: Defect) -> bool:
    """True if the speed changes across a spike as it rarely does, or did not before."""
    mean = np.convolve(speed, np.ones(_MEAN) / _MEAN, mode="valid")
    change = np.abs(mean[_MEAN + 1 :] - mean[: -_MEAN - 1])  # centred on sample _MEAN + k
    first, last = spike.start - _AROUND - _MEAN, spike.stop + _AROUND - _MEAN
    across = float(np.max(change[max(0, first) : last], initial=0.0))
    earlier = change[max(0, first - REACH) : max(0, first - _MEAN)]
    before = float(np.max(earlier, initial=0.0)) if earlier.size else np.inf
    return across > float(np.quantile(change, _RARELY)) or across > _STARTS * before > 0.0


def _is_moving(speed: np.ndarray, spike: Defect, least: float) -> bool:
    """True if a joint moves one way, and not slowly, around a spike."""
    around = speed[max(0, spike.start - _AROUND) : spike.stop + _AROUND]
    return bool(np.min(around) > least or np.max(around) < -least)
