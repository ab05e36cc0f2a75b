"""Logs: what one run of the robot left behind; their pieces on a uniform time grid."""

import dataclasses
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from modeler.core.errors import DataError
from modeler.core.result import Result
from modeler.numerics.channels import ChannelModel, model_channel
from modeler.regression.thresholds import THRESHOLDS

ChannelModels = Mapping[str, tuple[ChannelModel, ...]]
"""(joints,) by name: "q", "tau", and "qd" and "qdd" where they are logged."""


class LogRows(Protocol):
    """Rows of a file: a log, or what is kept of it."""

    @property
    def name(self) -> str:
        """Returns the name of the file."""

    @property
    def content(self) -> str:
        """Returns a fingerprint of the whole file; "" if there is none."""

    @property
    def span(self) -> tuple[float, float]:
        """Returns the first and the last time, s."""


@dataclass(frozen=True, eq=False)
class Log(Result):
    """One measured run; n rows, joints in the order of the manifest, SI units.

    A missing measurement is NaN and stays in its row; nothing has been filtered or left out.

    Attributes:
        name: file name without its folder.
        joints: joint names, the order of the columns below.
        time: (n,) s, strictly increasing.
        q: (n, joints) rad or m.
        tau: (n, joints) N m or N; 0 for passive joints without a column. Where it comes of a duty,
            what the motor induces is not taken from it yet: that needs the filtered speed.
        qd: (n, joints) logged velocities, or None.
        qdd: (n, joints) logged accelerations, or None.
        commanded: (n, joints) commanded positions, or None.
        segment: (n,) number of the piece of motion each row belongs to, or None.
        extra: further numeric columns, (n,) each.
        torque_source: where each joint's torque comes from, in words.
        notes: doubtful but usable things seen while reading, one sentence each.
        told: how it was read, one sentence each.
        content: fingerprint of the whole file's measurements, whatever its name; a piece of the
            log keeps it. Empty if the log came from no file.
        robot_steps: usual and longest step, s, of the rows that are left where a recorder wrote
            some again; else None.
        induced: (joints,) torque per speed that is still to be taken from tau; empty for none.
        path: of its file as it was given, `@START:END` of a piece of it too; "" if none was.
        channels: how each was sampled, by name and joint, where that is known of the whole log.
    """

    name: str
    joints: tuple[str, ...]
    time: np.ndarray
    q: np.ndarray
    tau: np.ndarray
    qd: np.ndarray | None = None
    qdd: np.ndarray | None = None
    commanded: np.ndarray | None = None
    segment: np.ndarray | None = None
    extra: Mapping[str, np.ndarray] = field(default_factory=dict)
    torque_source: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    content: str = ""
    robot_steps: tuple[float, float] | None = None
    induced: tuple[float, ...] = ()
    path: str = ""
    reading_notes: tuple[str, ...] = ()
    channels: ChannelModels = field(default_factory=dict)

    @property
    def rows(self) -> int:
        """Returns the number of rows, n."""
        return len(self.time)

    @property
    def span(self) -> tuple[float, float]:
        """Returns the first and the last time, s."""
        return float(self.time[0]), float(self.time[-1])

    @property
    def missing(self) -> dict[str, int]:
        """Returns {column: number of rows without a value}; only columns that have any."""
        kinds = {"q": self.q, "qd": self.qd, "qdd": self.qdd, "qc": self.commanded}
        missing_rows = dict[str, int]()
        for prefix, values in kinds.items():
            counts = () if values is None else np.isnan(values).sum(axis=0).tolist()
            missing_rows |= {f"{prefix}{n}": x for n, x in zip(self.joints, counts, strict=False)}
        sources = self.torque_source or [f"tau{name}" for name in self.joints]
        for source, values in zip(sources, self.tau.T, strict=True):
            missing_rows[source.split()[0]] = int(np.isnan(values).sum())
        return {column: count for column, count in missing_rows.items() if count}

    @property
    def piece_number(self) -> np.ndarray:
        """Returns (n,) whole numbers from 0 that grow where a piece of motion begins."""
        if self.segment is None:
            return np.zeros(self.rows, dtype=int)
        return np.concatenate([[0], np.cumsum(np.diff(self.segment) != 0)])

    @cached_property
    def step(self) -> float:
        """Returns the median time step, s.

        Large times are coarse: seconds since 1970 come in steps of 2.4e-7 s. Where the median is
        such a step, it is the mean of those that differ from it by no more than that.
        """
        if self.robot_steps is not None:
            return self.robot_steps[0]
        steps = np.diff(self.time)
        step = float(np.median(steps))
        resolution = float(np.spacing(np.abs(self.time).max()))
        if resolution < THRESHOLDS.time_resolution_share * step:
            return step
        return float(np.mean(steps[np.abs(steps - step) <= 1.5 * resolution]))

    @property
    def measured(self) -> dict[str, np.ndarray]:
        """Returns the channels (n, joints) by name, but for those that are not logged."""
        every = {"q": self.q, "tau": self.tau, "qd": self.qd, "qdd": self.qdd}
        return {name: values for name, values in every.items() if values is not None}

    @cached_property
    def channel_models(self) -> ChannelModels:
        """Returns how each channel was sampled; of a part of a log what is known of the whole."""
        if self.channels:
            return self.channels
        columns = {name: values.T for name, values in self.measured.items()}
        return {n: tuple(model_channel(self.time, v) for v in x) for n, x in columns.items()}

    @property
    def gap(self) -> float:
        """Returns the length, s, of a time step beyond which a piece of motion ends."""
        return max(THRESHOLDS.gap_steps * self.step, *(self.robot_steps or (0.0,)))


FINGER = 32_768
"""Rows of which a long log keeps one fingerprint; that of the log is theirs together."""

LONG = 250_000
"""Rows above which a log is long: it need not be in memory at once."""

MOST_WHOLE = 5_000_000
"""Rows of a file that is read at once: about 5 GB with six joints."""


def compute_fingerprint(*measurements: np.ndarray) -> str:
    """Returns a text that equal arrays share and others do not: SHA-256 of their numbers.

    The numbers and not the bytes of the file: a copy as CSV of a Parquet log is the same run. A
    long log has the fingerprint of those of its blocks, which are taken one by one.

    Args:
        measurements: (n, ...) each.
    """
    if len(measurements[0]) > LONG:
        return combine_hashes(compute_block_hashes(*measurements))
    return compute_block_hash(*measurements).hex()


def compute_block_hashes(*measurements: np.ndarray) -> tuple[bytes, ...]:
    """Returns the hashes of the blocks of a long log: rows from a multiple of `FINGER` on."""
    starts = range(0, len(measurements[0]), FINGER)
    blocks = ([values[k : k + FINGER] for values in measurements] for k in starts)
    return tuple(compute_block_hash(*block) for block in blocks)


def combine_hashes(hashes: Sequence[bytes]) -> str:
    """Returns the fingerprint of a long log from those of its blocks."""
    return hashlib.sha256(b"".join(hashes)).hexdigest()


def compute_block_hash(*measurements: np.ndarray) -> bytes:
    """Returns the hash of one block of rows."""
    content = hashlib.sha256()
    for values in measurements:
        # Adding 0 makes -0 into 0: writers differ there, and no fit does.
        numbers = np.add(values, 0.0, order="C", dtype="<f8")
        numbers[np.isnan(numbers)] = np.nan
        content.update(f"{numbers.shape}".encode())
        content.update(numbers.tobytes())
    return content.digest()


def has_shared_rows(log: LogRows, content: str, start: float, end: float) -> bool:
    """Returns True if `log` holds rows of the file of that fingerprint from `start` to `end`, s."""
    same = log.content != "" and log.content == content
    return same and log.span[0] <= end and start <= log.span[1]


# Logs that are used together: every row has one part, fitted, explained or held out.


def check_no_overlap(
    logs: Sequence[LogRows], holdout: Sequence[LogRows] = (), places: Sequence[str] = ()
) -> None:
    """Refuses rows that are given twice, and held-out rows that are also explained.

    Args:
        logs: as they were read, or their reports.
        holdout: of which errors are to be reported.
        places: what the user typed for `logs`; none: their names.

    Raises:
        DataError: names the two logs.
    """
    for group, typed in ((logs, places), (holdout, ())):
        names = typed or [log.name for log in group]
        for index, log in enumerate(group):
            for first, other in zip(names, group[:index], strict=False):
                if has_shared_rows(log, other.content, *other.span):
                    raise DataError(
                        f"{names[index]}: got rows of {first} again; rows that repeat count "
                        "twice, and their noise looks like something that returns; give each row "
                        "once"
                    )
    for other in holdout:
        for log in logs:
            if has_shared_rows(other, log.content, *log.span):
                raise DataError(
                    f"--holdout {other.name}: shares rows with {log.name}; expected other motion; "
                    "leave it out, or split the log with FILE@START:END"
                )


@dataclass(frozen=True, eq=False)
class RawSegment:
    """One uniform segment of a log, before differentiation; n samples.

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
        pushes: windows, s, in which something pushed on the robot.
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
    pushes: tuple[tuple[float, float], ...] = ()


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
) -> tuple[tuple[RawSegment, ...], SplitReport]:
    """Returns the uniform pieces of a log.

    Cut where `segment` changes and where a step exceeds 5 median steps; rows without a position
    (or, where used, a logged velocity) are gaps too, bridged when shorter than that. Irregular
    time stamps are resampled: motion by monotone cubics, which do not overshoot; torque linearly.
    Bridges of up to 3 samples are cubic splines: a monotone cubic flattens the tops of a motion.

    Args:
        log: one log.
        run: its index.
        logged_motion: logged velocities and accelerations are used.
        extremes: of each torque in the whole log, of which this is a part; None: it is all of it.
    """
    motion = [log.q, *(m for m in (log.qd, log.qdd) if logged_motion and m is not None)]
    rows = np.flatnonzero(np.all([np.isfinite(m).all(axis=1) for m in motion], axis=0))
    ends = [None] * log.tau.shape[1] if extremes is None else extremes
    models = log.channel_models
    pairs = zip(models["tau"], models["q"], strict=True)
    parts = zip(log.tau.T, log.q.T, pairs, ends, strict=True)
    late = np.diff(log.time, prepend=log.time[0]) > THRESHOLDS.late_steps * log.step
    clipped = np.column_stack([find_saturated(*part, late) for part in parts])
    steps, stamps = np.diff(log.time[rows]), np.diff(log.time)
    cut = gap = steps > log.gap
    inside = stamps[stamps <= log.gap]
    if log.segment is not None:
        cut = cut | (np.diff(log.segment[rows]) != 0)
    groups = np.split(rows, np.flatnonzero(cut) + 1)
    long_groups = [group for group in groups if len(group) >= THRESHOLDS.min_piece_rows]
    short = [group for group in groups if len(group) < THRESHOLDS.min_piece_rows]
    jitter = float(np.max(np.abs(inside / log.step - 1.0), initial=0.0))
    few = log.time[np.concatenate([rows[:0], *short])]
    report = SplitReport(log.time[rows[1:][gap]], steps[gap], jitter, few)
    q_step, qd_step = (tuple(one.step for one in models.get(name, ())) for name in ("q", "qd"))
    pieces = (_build_piece(log, run, group, clipped, logged_motion) for group in long_groups)
    stepped = (dataclasses.replace(part, q_step=q_step, qd_step=qd_step) for part in pieces)
    return tuple(stepped), report


def _build_piece(
    log: Log, run: int, places: np.ndarray, clipped: np.ndarray, logged_motion: bool
) -> RawSegment:
    measured, first, last = log.time[places], int(places[0]), int(places[-1])
    is_whole = last - first == len(places) - 1
    rows = slice(first, last + 1) if is_whole else places  # views, where no row is left out
    samples = max(THRESHOLDS.min_piece_rows, round((measured[-1] - measured[0]) / log.step) + 1)
    time = np.linspace(measured[0], measured[-1], samples)
    step = float(measured[-1] - measured[0]) / (samples - 1)  # of large times, two are too coarse
    uniform = samples == len(measured)
    uniform = uniform and bool(np.all(np.abs(measured - time) <= THRESHOLDS.max_jitter * step))
    near = np.arange(samples)  # the measured row nearest to each sample
    if not uniform:
        near = np.searchsorted(measured, time).clip(1, len(measured) - 1)
        near -= time - measured[near - 1] < measured[near] - time
    # Where rows come when they come, what lies between two is no bridge.
    steps = np.diff(measured)
    usual = float(np.quantile(steps, THRESHOLDS.uneven_quantile)) if len(steps) else 0.0
    apart = 0.5 * (log.robot_steps or (0.0, 0.0))[1]
    beside = max(THRESHOLDS.bridge_distance * step, apart, THRESHOLDS.uneven_distance * usual)
    bridged = np.abs(time - measured[near]) > beside
    short = bridged & ~select_long_runs(bridged, THRESHOLDS.short_bridge)

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
    """Returns values at other times: monotone cubics, and within short bridges cubic splines."""
    from scipy.interpolate import CubicSpline, PchipInterpolator  # they take long to load

    moved = PchipInterpolator(measured, values)(time)
    if short.any():
        moved[short] = CubicSpline(measured, values)(time[short])
    return np.asarray(moved)


def select_long_runs(flags: np.ndarray, length: int) -> np.ndarray:
    """Returns the flags (n,) that stand in runs of more than `length`."""
    is_long = np.zeros(len(flags), dtype=bool)
    for start, stop in find_runs(flags):
        is_long[start:stop] = stop - start > length
    return is_long


def _bridge_torque(
    time: np.ndarray, measured: np.ndarray, tau: np.ndarray, bridged: np.ndarray, beside: float
) -> tuple[np.ndarray, np.ndarray]:
    """Returns the torque on the grid, missing entries interpolated, and where it is measured.

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
    values: np.ndarray,
    position: np.ndarray,
    models: tuple[ChannelModel, ChannelModel],
    extremes: tuple[float, float] | None = None,
    late: np.ndarray | None = None,
) -> np.ndarray:
    """Returns samples at which a torque is clipped; (n,) bool.

    A run counts when the torque is exactly its largest or smallest value of the whole log, and not
    0, for at least 5 samples in a row, and leaps into or out of that run by more than 3 steps of
    its own resolution; one such run, if it is the only one, lasts 20. A clean quantised signal
    rounds its crest one step at a time and is not caught; a torque at rest, which is constant all
    along, has no leap and is not caught either, and the joint moves in one run at least. A torque
    that is held is sampled more slowly.

    Args:
        values: (n,) torque of one joint, NaN where missing.
        position: (n,) of the joint.
        models: of the torque and of the position.
        extremes: smallest and largest value of the log elsewhere, of which these are a part.
        late: (n,) True at samples that follow a gap, across which nothing leaps; None: none.
    """
    is_saturated = np.zeros(len(values), dtype=bool)
    low = float(np.fmin.reduce(values, initial=np.inf))
    high = float(np.fmax.reduce(values, initial=-np.inf))
    shortest = THRESHOLDS.min_saturated_run
    if not low < high or models[0].hold >= shortest:
        return is_saturated
    ends = [low, high]
    if extremes is not None:
        ends = [low] * (low <= extremes[0]) + [high] * (high >= extremes[1])
    runs = [(end, run) for end in ends if end != 0.0 for run in find_runs(values == end)]
    runs = [(end, (start, stop)) for end, (start, stop) in runs if stop - start >= shortest]
    least = THRESHOLDS.min_saturated_travel * models[1].noise
    travels = ((end, position[stop - 1] - position[start]) for end, (start, stop) in runs)
    moved = {end for end, travel in travels if abs(travel) > least}
    if extremes is None and len(runs) == 1 and np.ptp(runs[0][1]) < THRESHOLDS.min_single_limit:
        return is_saturated
    several = len(np.unique(values[np.isfinite(values)])) > THRESHOLDS.max_switched_values
    resolution = models[0].step if several else 0.0
    for extreme, (start, stop) in [(end, run) for end, run in runs if end in moved]:
        sides = [(start, start - 1), (stop, stop)]
        inside = [(after, at) for after, at in sides if 0 <= at < len(values)]
        beside = [values[at] for after, at in inside if late is None or not late[after]]
        leap = max((abs(extreme - v) for v in beside if np.isfinite(v)), default=0.0)
        if leap > THRESHOLDS.min_saturated_jump * resolution:
            is_saturated[start:stop] = True
    return is_saturated


def find_runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """Returns [start, stop) of each segment of True in flags (n,)."""
    edges = np.flatnonzero(np.diff(flags.astype(np.int8), prepend=0, append=0)).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))
