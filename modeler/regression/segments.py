"""Pieces of a log on a uniform time grid: filters never run across a gap."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.numerics.noise import (
    estimate_channel_noise,
    estimate_hold_length,
    estimate_lattice_step,
)
from modeler.regression.log import Log

JITTER = 0.01
"""Time stamps off the uniform grid by more than this share of a step are resampled."""

_NEAR = 0.75  # of a step: a grid point farther than this from any measured row is a bridge
_USUAL = 0.95  # quantile of the steps of an uneven clock ...
_HALF = 0.51  # ... of which a grid point in the middle of one is no farther
SHORT = 3
"""A bridge of up to so many samples is a cubic, as smooth as the motion beside it."""

_LEAST = 4  # samples; the second difference and its neighbours

LEAST_RUN = 5
QUANTA = 3.0
SWITCHES = 3
"""Values of a drive that knows full torque, none, and full torque back: a step is its limit."""
MOVES = 10.0
"""Standard deviations of a position's noise that a joint moves while its torque is at a limit."""


@dataclass(frozen=True, eq=False)
class RawSegment:
    """One uniform stretch of a log, before differentiation; n samples.

    Attributes:
        run: index of its log.
        time: (n,) s, uniform.
        step: s.
        q, tau: (n, joints).
        qd, qdd: (n, joints) as logged, or None.
        extra: further columns, (n,).
        valid: (n, joints) False where torque or motion was missing and is bridged.
        bridged: (n,) True where the motion was missing.
        contradicted: (n,) True where a logged derivative cannot be.
        clipped: (n, joints) True where the torque was at the drive's limit.
        resampled: True if the rows were moved to the grid.
        commanded: (n, joints) positions, or None.
        induced: (joints,) as of the log.
        q_step, qd_step: (joints,) steps of resolution as logged; resampling hides them.
    """

    run: int
    time: np.ndarray
    step: float
    q: np.ndarray
    tau: np.ndarray
    qd: np.ndarray | None
    qdd: np.ndarray | None
    extra: Mapping[str, np.ndarray]
    valid: np.ndarray
    bridged: np.ndarray
    contradicted: np.ndarray
    clipped: np.ndarray
    resampled: bool
    commanded: np.ndarray | None = None
    induced: tuple[float, ...] = ()
    q_step: tuple[float, ...] = ()
    qd_step: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class SplitReport:
    """Where splitting cut one log.

    Attributes:
        gaps: (g,) s, of the rows that a time gap of more than 5 steps ends at.
        widths: (g,) of those gaps, s.
        jitter: largest deviation of a step from the median step, as a share of it, gaps apart.
        short: (k,) s, of rows in pieces too short to differentiate, left out.
    """

    gaps: np.ndarray
    widths: np.ndarray
    jitter: float
    short: np.ndarray


def split_log(
    log: Log,
    run: int,
    logged_motion: bool,
    extremes: Sequence[tuple[float, float] | None] | None = None,
    logged: np.ndarray | None = None,
) -> tuple[tuple[RawSegment, ...], SplitReport]:
    """The uniform pieces of a log.

    Cut where `segment` changes and where a step exceeds 5 median steps; rows without a position
    (or, where used, a logged velocity) are gaps too, bridged when shorter than that. Irregular
    time stamps are resampled: motion by monotone cubics, which do not overshoot; torque linearly.
    Bridges of up to 3 samples are cubic splines: a monotone cubic flattens the tops of a motion.

    Args:
        log: one log.
        run: its index.
        logged_motion: logged velocities and accelerations are used.
        extremes: of each torque in the whole log, of which this is a part; None: it is all of it.
        logged: (n, joints) torques before they were mended; None: they were not.
    """
    motion = [log.q, *(m for m in (log.qd, log.qdd) if logged_motion and m is not None)]
    rows = np.flatnonzero(np.all([np.isfinite(m).all(axis=1) for m in motion], axis=0))
    ends = [None] * log.tau.shape[1] if extremes is None else extremes
    clipped = np.column_stack(
        [
            find_saturated(*part)
            for part in zip(
                log.tau.T, log.q.T, ends, (log.tau if logged is None else logged).T, strict=True
            )
        ]
    )
    steps, stamps = np.diff(log.time[rows]), np.diff(log.time)
    cut = gap = steps > log.gap
    inside = stamps[stamps <= log.gap]
    if log.segment is not None:
        cut = cut | (np.diff(log.segment[rows]) != 0)
    groups = np.split(rows, np.flatnonzero(cut) + 1)
    long_groups = [group for group in groups if len(group) >= _LEAST]
    report = SplitReport(
        gaps=log.time[rows[1:][gap]],
        widths=steps[gap],
        jitter=float(np.max(np.abs(inside / log.step - 1.0))) if inside.size else 0.0,
        short=log.time[np.concatenate([rows[:0], *(g for g in groups if len(g) < _LEAST)])],
    )
    q_step = tuple(map(estimate_lattice_step, log.q.T))
    qd_step = () if log.qd is None else tuple(map(estimate_lattice_step, log.qd.T))
    pieces = (_build_piece(log, run, group, clipped, logged_motion) for group in long_groups)
    return tuple(
        dataclasses.replace(part, q_step=q_step, qd_step=qd_step) for part in pieces
    ), report


def _build_piece(
    log: Log, run: int, rows: np.ndarray, clipped: np.ndarray, logged_motion: bool
) -> RawSegment:
    measured = log.time[rows]
    samples = max(_LEAST, round((measured[-1] - measured[0]) / log.step) + 1)
    time = np.linspace(measured[0], measured[-1], samples)
    step = float(measured[-1] - measured[0]) / (samples - 1)  # of large times, two are too coarse
    uniform = samples == len(rows) and bool(np.all(np.abs(measured - time) <= JITTER * step))
    near = np.arange(samples)  # the measured row nearest to each sample
    if not uniform:
        near = np.searchsorted(measured, time).clip(1, len(measured) - 1)
        near -= time - measured[near - 1] < measured[near] - time
    # Where rows come when they come, what lies between two is no bridge.
    steps = np.diff(measured)
    usual = float(np.quantile(steps, _USUAL)) if len(steps) else 0.0
    beside = max(_NEAR * step, 0.5 * (log.robot_steps or (0.0, 0.0))[1], _HALF * usual)
    bridged = np.abs(time - measured[near]) > beside
    short = bridged & ~select_long_runs(bridged, SHORT)

    def on_grid(values: np.ndarray) -> np.ndarray:
        return values[rows] if uniform else _resample_values(measured, values[rows], time, short)

    def smooth(values: np.ndarray | None, wanted: bool) -> np.ndarray | None:
        return on_grid(values) if values is not None and wanted else None

    tau, valid = _bridge_torque(time, measured, log.tau[rows], bridged, beside)
    asked = log.commanded
    return RawSegment(
        run=run,
        time=time,
        step=step,
        q=on_grid(log.q),
        tau=tau,
        qd=smooth(log.qd, logged_motion),
        qdd=smooth(log.qdd, logged_motion),
        extra={name: np.interp(time, measured, v[rows]) for name, v in log.extra.items()},
        valid=valid,
        bridged=bridged,
        contradicted=np.zeros(samples, dtype=bool),
        clipped=clipped[rows][near],
        resampled=not uniform,
        commanded=smooth(asked, asked is not None and bool(np.isfinite(asked[rows]).all())),
        induced=log.induced,
    )


def _resample_values(
    measured: np.ndarray, values: np.ndarray, time: np.ndarray, short: np.ndarray
) -> np.ndarray:
    """Values at other times: monotone cubics, and within short bridges cubic splines."""
    from scipy.interpolate import CubicSpline, PchipInterpolator  # they take long to load

    moved = PchipInterpolator(measured, values)(time)
    if short.any():
        moved[short] = CubicSpline(measured, values)(time[short])
    return np.asarray(moved)


def select_long_runs(flags: np.ndarray, length: int) -> np.ndarray:
    """The flags (n,) that stand in runs of more than `length`."""
    is_long = np.zeros(len(flags), dtype=bool)
    for start, stop in find_runs(flags):
        is_long[start:stop] = stop - start > length
    return is_long


def _bridge_torque(
    time: np.ndarray, measured: np.ndarray, tau: np.ndarray, bridged: np.ndarray, beside: float
) -> tuple[np.ndarray, np.ndarray]:
    """Torque on the grid, missing entries bridged linearly; and where it and all else is measured.

    Args:
        time: (n,) the grid.
        measured: (m,) time stamps.
        tau: (m, joints) as measured.
        bridged: (n,) True where no row was measured near.
        beside: s, within which a measured value stands for one of the grid.
    """
    values = np.zeros((len(time), tau.shape[1]))
    valid = np.repeat(~bridged[:, None], tau.shape[1], axis=1)
    for j in range(tau.shape[1]):
        there = np.isfinite(tau[:, j])
        if not there.any():
            valid[:, j] = False
            continue
        stamps = measured[there]
        values[:, j] = np.interp(time, stamps, tau[there, j])
        if not there.all():
            right = np.searchsorted(stamps, time).clip(0, len(stamps) - 1)
            left = (right - 1).clip(0)
            distance = np.minimum(np.abs(time - stamps[left]), np.abs(time - stamps[right]))
            valid[:, j] &= distance <= beside
    return values, valid


def find_saturated(
    values: np.ndarray, position: np.ndarray, extremes: tuple[float, float] | None = None,
    logged: np.ndarray | None = None,
) -> np.ndarray:  # fmt: skip
    """Samples at which a torque is clipped; (n,) bool.

    A run counts when the torque is exactly its largest or smallest value of the whole log for at
    least 5 samples in a row, and leaps into or out of that run by more than 3 steps of its own
    resolution. A clean quantised signal rounds its crest one step at a time and is not caught;
    a torque at rest, which is constant all along, has no leap and is not caught either, and the
    joint moves in one run at least. A torque that is held is sampled more slowly.

    Args:
        values: (n,) torque of one joint, NaN where missing.
        position: (n,) of the joint.
        extremes: smallest and largest value of the log elsewhere, of which these are a part.
        logged: (n,) the torque before it was mended: between held samples it is interpolated.
    """
    is_saturated = np.zeros(len(values), dtype=bool)
    if not len(values):
        return is_saturated
    low, high = float(np.fmin.reduce(values)), float(np.fmax.reduce(values))
    if not low < high:
        return is_saturated
    ends = [low, high]
    if extremes is not None:
        ends = [low] * (low <= extremes[0]) + [high] * (high >= extremes[1])
    found_runs = [
        (end, (start, stop))
        for end in ends
        for start, stop in find_runs(values == end)
        if stop - start >= LEAST_RUN
    ]
    least = MOVES * estimate_channel_noise(position[np.isfinite(position)]) if found_runs else 0.0
    moved = {
        end for end, (start, stop) in found_runs
        if abs(position[stop - 1] - position[start]) > least
    }  # fmt: skip
    if not moved or estimate_hold_length(values if logged is None else logged) >= LEAST_RUN:
        return is_saturated
    found_runs = [(end, run) for end, run in found_runs if end in moved]
    step = estimate_lattice_step(values)
    resolution = step if len(np.unique(values[np.isfinite(values)])) > SWITCHES else 0.0
    for extreme, (start, stop) in found_runs:
        beside = [values[i] for i in (start - 1, stop) if 0 <= i < len(values)]
        leap = max((abs(extreme - v) for v in beside if np.isfinite(v)), default=0.0)
        if leap > QUANTA * resolution:
            is_saturated[start:stop] = True
    return is_saturated


def find_runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """[start, stop) of each stretch of True in flags (n,)."""
    edges = np.flatnonzero(np.diff(flags.astype(np.int8), prepend=0, append=0)).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))
