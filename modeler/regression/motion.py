"""Choices of the processing; velocities and accelerations of a piece, and its usable samples."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, get_args

import numpy as np
from scipy.ndimage import maximum_filter1d

from modeler.core.choices import LOW_SPEED, Derivatives
from modeler.core.errors import DataError
from modeler.core.json import ShortRepr
from modeler.numerics.filters import apply_zero_phase_lowpass
from modeler.regression.log import Log, RawSegment, select_long_runs
from modeler.regression.thresholds import THRESHOLDS


@dataclass(frozen=True)
class Processing(ShortRepr):
    """Choices of the processing; None is chosen from the logs and stated in the report.

    Attributes:
        position_cutoff: low-pass of measured positions before they are differentiated, Hz;
            zero-phase Butterworth, order 4, forwards and backwards. 0: none.
        parallel_cutoff: the one low-pass that y and all columns of W go through alike, Hz at
            -3 dB. 0: none.
        decimation: samples per row after the parallel filter; None: rows at 2.5 times
            `parallel_cutoff`, where neighbouring rows are all but independent.
        derivatives: "log" takes logged qd (and qdd); "position" differentiates q; "auto" takes
            what is logged.
        low_speed: rows below this fraction of a shaft's top speed are left out where the shaft
            has dry friction: sign(qd) means nothing there.
        speed_floors: those speeds, rad/s or m/s, by shaft; None: `low_speed` times the top speed
            over the logs.
        keep_saturated: use rows whose torque is stuck at the drive's limit.
        keep_contradicted: use samples whose logged qd or qdd is not the derivative of q or qd,
            and do not refuse columns that are wrong throughout.
        keep_damaged: use values that no robot can have made (leaps, spikes, repeated positions) as
            they were logged.
        repairs: held-out error of a fit to a mended log over that to the log as it is, by log,
            column and kind of the defect; None: not tried yet.
        delay: s by which torques are logged before the motion that they belong to; they are moved
            later by it.
        edge: seconds left out at both ends of a differentiated piece; None: 2.5 periods of
            `position_cutoff`, where the filter's start-up has faded below 1 %.
        automatic_cutoffs: names of the cut-offs that were chosen from the logs; what is given rules
            all that is made of a model.
        pushes: windows, s, in which something pushed and that are left out, by the content of the
            log, or by its name where it came from no file.
    """

    position_cutoff: float | None = None
    parallel_cutoff: float | None = None
    decimation: int | None = None
    derivatives: Derivatives = "auto"
    low_speed: float = LOW_SPEED
    speed_floors: Mapping[str, float] | None = None
    keep_saturated: bool = False
    edge: float | None = None
    keep_contradicted: bool = False
    keep_damaged: bool = False
    delay: float = 0.0
    automatic_cutoffs: tuple[str, ...] = ()
    repairs: Mapping[str, float] | None = None
    pushes: Mapping[str, tuple[tuple[float, float], ...]] | None = None

    def __post_init__(self) -> None:
        for name in ("position_cutoff", "parallel_cutoff", "edge", "low_speed"):
            value = getattr(self, name)
            if value is not None and not (_is_number(value) and 0.0 <= value < float("inf")):
                raise DataError(f"{name} is {value}; expected a number that is not negative")
        if not (_is_number(self.delay) and abs(self.delay) < 1.0):
            raise DataError(f"delay is {self.delay}; expected less than 1 s either way")
        if self.low_speed >= 1.0:
            raise DataError(f"low_speed is {self.low_speed}; expected a fraction below 1")
        decimation = 1 if self.decimation is None else self.decimation
        if not (isinstance(decimation, int) and decimation >= 1):
            raise DataError(f"decimation is {self.decimation}; expected a whole number from 1")
        if not isinstance(self.speed_floors, Mapping | None):
            expected = 'expected a speed by joint, as in {"1": 0.1}'
            raise DataError(f"speed_floors is {self.speed_floors}; {expected}")
        if not isinstance(self.repairs, Mapping | None):
            raise DataError(f"repairs is {self.repairs}; expected a ratio by column and defect")
        if self.derivatives not in get_args(Derivatives):
            possible = ", ".join(get_args(Derivatives))
            raise DataError(f'derivatives is "{self.derivatives}"; expected {possible}')

    def repairs_of(self, log: str) -> dict[str, float]:
        """Returns a log's repairs, by column and kind of the defect; a held channel is in all."""
        return {
            key.rpartition(": ")[2]: score
            for key, score in (self.repairs or {}).items()
            if key.startswith(f"{log}: ") or key.endswith(" held")
        }

    def get_pushes(self, log: Log) -> tuple[tuple[float, float], ...]:
        """Returns the windows of a log that are left out, s."""
        return (self.pushes or {}).get(log.content or log.name, ())

    def add_push(self, log: Log, start: float, end: float) -> "Processing":
        """Returns the processing that leaves out one more window of a log, s."""
        windows = (*self.get_pushes(log), (start, end))
        pushes = {**(self.pushes or {}), log.content or log.name: windows}
        return dataclasses.replace(self, pushes=pushes)

    def to_json(self) -> dict[str, Any]:
        """Returns the processing as plain data for a model file."""
        raw = dataclasses.asdict(self)
        if self.speed_floors is not None:  # JSON has no infinity: null is a shaft that stood still
            raw["speed_floors"] = {
                name: None if floor == float("inf") else floor
                for name, floor in self.speed_floors.items()
            }
        return raw


@dataclass(frozen=True)
class ChosenProcessing(Processing):
    """A processing with every choice made: both cut-offs, and the speed floors of all shafts."""

    position_cutoff: float = 0.0
    parallel_cutoff: float = 0.0
    speed_floors: Mapping[str, float] = field(default_factory=dict)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def read_processing(raw: Mapping[str, Any]) -> Processing:
    """Reads `Processing.to_json` back.

    Raises:
        DataError: an unknown or impossible entry.
    """
    names = sorted(entry.name for entry in dataclasses.fields(Processing))
    unknown = sorted(set(raw) - set(names))
    if unknown:
        raise DataError(f"processing has no setting {unknown[0]}; there are {', '.join(names)}")
    values = dict(raw)
    choices = ("position_cutoff", "parallel_cutoff", "speed_floors")
    open_ = any(values.get(name) is None for name in choices)
    try:
        names = values.get("automatic_cutoffs", ())
        values["automatic_cutoffs"] = tuple(str(name) for name in names)
        if values.get("speed_floors") is not None:
            values["speed_floors"] = {
                name: float("inf") if floor is None else float(floor)
                for name, floor in values["speed_floors"].items()
            }
        if values.get("pushes") is not None:
            windows = values["pushes"].items()
            values["pushes"] = {
                log: tuple((float(a), float(b)) for a, b in w) for log, w in windows
            }
        return Processing(**values) if open_ else ChosenProcessing(**values)
    except (TypeError, ValueError, AttributeError) as error:
        raise DataError(f"processing: {error}; expected numbers") from None


# The slowest poles fade as exp(-2.4 t cutoff): after 2.5 periods, 0.5 % of the kink in the
# acceleration that the extension beyond the ends makes is left (1.5 periods: 3 %).


EDGE = "lie within the start-up of the position filter at the ends of a piece"
MISSING = "have no measured position or torque, or a damaged one"
BRIDGES = "lie beside missing positions, as near as the position filter reaches"
CONTRADICTED = "have impossible derivatives, or lie as near to them as the position filter reaches"
SATURATED = "have a torque at its limit"
OPEN = "have positions with which the loops cannot be closed"
PUSHED = "lie in a window in which something pushed on the robot"
UNSETTLED = "lie at a start, where the state of a bristle or cable is unknown"
CAUSES = (EDGE, MISSING, BRIDGES, CONTRADICTED, SATURATED, OPEN, PUSHED, UNSETTLED)
"""In this order; the first that applies counts."""


@dataclass(frozen=True, eq=False)
class Segment(ShortRepr):
    """One uniform segment of motion, ready for the model; n samples.

    Attributes:
        run: index of its log.
        time: (n,) s.
        step: s.
        q, qd, qdd: (n, joints) filtered motion.
        tau: (n, joints) torque as measured (missing values bridged).
        extra: further columns of the log, (n,).
        whole: (n,) False within the edge of the position filter.
        cause: (n, joints) place in CAUSES of why a sample does not count, the first that applies;
            -1 where it counts.
        commanded: (n, joints) commanded positions, filtered like q; None where none were logged.
        read: (n, m) what effects of the model read, made of more samples; None: made of these.
        every: how many samples of the log there are from one to the next.
        rests: joints whose speeds were set to 0, as they rest.
    """

    run: int
    time: np.ndarray
    step: float
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    tau: np.ndarray
    extra: Mapping[str, np.ndarray]
    whole: np.ndarray
    cause: np.ndarray
    commanded: np.ndarray | None = None
    read: np.ndarray | None = None
    every: int = 1
    rests: tuple[int, ...] = ()

    @property
    def samples(self) -> int:
        """Returns the number of samples, n."""
        return len(self.time)

    @property
    def logged_step(self) -> float:
        """Returns the time, s, between samples of the log."""
        return self.step / self.every

    def thin_samples(self, every: int, read: np.ndarray | None) -> "Segment":
        """Returns every n-th sample of a segment, and of what effects of its model read (n, m)."""
        arrays: dict[str, Any] = {n: getattr(self, n)[::every].copy() for n in _SAMPLED}
        extra = {name: values[::every].copy() for name, values in self.extra.items()}
        return dataclasses.replace(
            self,
            **arrays,
            extra=extra,
            step=self.step * every,
            every=every,
            commanded=None,
            read=None if read is None else np.ascontiguousarray(read[::every]),
        )

    @cached_property
    def valid(self) -> np.ndarray:
        """Returns (n, joints) flags, True where the torque is a measurement that counts."""
        return np.asarray(self.cause < 0)


_SAMPLED = ("time", "q", "qd", "qdd", "tau", "whole", "cause")


def build_segment(piece: RawSegment, processing: Processing) -> Segment | None:
    """Returns the piece with its velocities and accelerations; None if it is all edge.

    q is filtered by a zero-phase Butterworth low-pass of order 4 (forwards and backwards), then
    qd(k) = (q(k+1) - q(k-1)) / 2h and qdd(k) = (q(k+1) - 2 q(k) + q(k-1)) / h^2 (Guegan, Khalil
    and Lemoine 2003, section 5.2). Logged velocities are filtered alike and differentiated once;
    logged accelerations are used as they are.

    Args:
        piece: a uniform segment; its qd, qdd are None where they must come from q.
        processing: with `position_cutoff` chosen.
    """
    cutoff = min(processing.position_cutoff or 0.0, THRESHOLDS.max_cutoff_share / piece.step)
    edge = compute_edge(piece, processing)
    if piece.qd is not None and piece.qdd is not None:
        q, qd, qdd = piece.q, piece.qd, piece.qdd
    else:
        if piece.step * (len(piece.time) - 1) <= 2 * edge * piece.step:
            return None
        q = apply_low_pass(piece.q, piece.step, cutoff)
        if piece.qd is not None:
            qd = apply_low_pass(piece.qd, piece.step, cutoff)
            qdd = np.gradient(qd, piece.step, axis=0)
        else:
            _, qd, qdd = differentiate_positions(q, piece.step)
    whole = np.ones(len(piece.time), dtype=bool)
    if edge:
        whole[:edge] = whole[-edge:] = False
    cause = _classify_samples(piece, whole, edge, cutoff, processing.keep_saturated)
    tau, wanted = piece.tau, piece.commanded
    if processing.delay != 0.0:
        earlier = piece.time - processing.delay
        tau = np.column_stack([np.interp(earlier, piece.time, column) for column in tau.T])
    if any(piece.induced):
        speed = qd if piece.qd is not None else _differentiate_wide(q, piece.step)
        tau = tau - np.multiply(piece.induced, speed)
    if wanted is not None:
        wanted = apply_low_pass(wanted, piece.step, cutoff)
    where = piece.run, piece.time, piece.step
    return Segment(*where, q, qd, qdd, tau, piece.extra, whole, cause, wanted)


def _classify_samples(
    piece: RawSegment, whole: np.ndarray, edge: int, cutoff: float, keep_saturated: bool
) -> np.ndarray:
    """Returns (n, joints) why samples do not count, as places in CAUSES; -1 where they do.

    The bend of a bridge, or of a wrong velocity, reaches as far as the start-up of the filter; a
    few missing samples that take less than 0.4 periods of the cut-off leave no bend.
    """
    periods = THRESHOLDS.short_bridge_periods
    few = min(THRESHOLDS.short_bridge, int(periods / (cutoff * piece.step)) - 1) if cutoff else 0
    bent = select_long_runs(piece.bridged, few) if few > 0 else piece.bridged
    inside = [(piece.time > start) & (piece.time < end) for start, end in piece.pushes]
    pushed = np.any([np.zeros(len(whole), dtype=bool), *inside], axis=0)
    flags = {
        EDGE: ~whole[:, None],
        MISSING: piece.bridged[:, None] | ~piece.valid,
        BRIDGES: dilate_flags(bent, edge)[:, None],
        CONTRADICTED: dilate_flags(piece.contradicted, edge)[:, None],
        SATURATED: piece.clipped & (not keep_saturated),
        PUSHED: pushed[:, None],
    }
    cause = np.full(piece.valid.shape, -1, dtype=np.int8)
    for name, flagged in flags.items():
        cause[(cause < 0) & flagged] = CAUSES.index(name)
    return cause


def dilate_flags(flags: np.ndarray, reach: int) -> np.ndarray:
    """Returns (n,) True within so many samples of a flagged one."""
    if not reach or not flags.any():
        return flags
    return np.asarray(maximum_filter1d(flags.view(np.uint8), 2 * reach + 1) > 0)


def compute_edge(piece: RawSegment, processing: Processing) -> int:
    """Returns samples at either end of a piece that are lost to the low-pass of its positions."""
    if piece.qd is not None and piece.qdd is not None:
        return 0
    cutoff, seconds = processing.position_cutoff or 0.0, processing.edge
    cutoff = min(cutoff, THRESHOLDS.max_cutoff_share / piece.step)
    if seconds is None:
        seconds = THRESHOLDS.edge_periods / cutoff if cutoff > 0.0 else 0.0
    return max(1, round(seconds / piece.step))  # the outermost second difference does not exist


def differentiate_positions(q: np.ndarray, step: float) -> np.ndarray:
    """Returns (3, n, joints) positions, velocities and accelerations by central differences."""
    qdd = np.zeros_like(q)
    qdd[1:-1] = (q[2:] - 2.0 * q[1:-1] + q[:-2]) / step**2
    return np.stack([q, np.gradient(q, step, axis=0), qdd])


def _differentiate_wide(q: np.ndarray, step: float) -> np.ndarray:
    """Returns velocities (n, joints) over five samples, of error (omega step)^4 / 30.

    What a motor induces is many times the friction that is requested: at 30 Hz, the half percent
    that differences over three samples lose of a motion of 1 Hz would be a tenth of it.
    """
    qd = np.gradient(q, step, axis=0)
    qd[2:-2] = (8.0 * (q[3:-1] - q[1:-3]) - (q[4:] - q[:-4])) / (12.0 * step)
    return np.asarray(qd)


def apply_low_pass(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """Returns `values` (n, ...) behind the zero-phase Butterworth low-pass; of cutoff 0 as is."""
    if cutoff == 0.0:
        return values
    # Odd extension over the start-up time; scipy's default is too short for a low cut-off.
    padding = min(len(values) - 1, max(15, round(2.0 / (cutoff * step))))
    flat = values.reshape(len(values), -1)
    return apply_zero_phase_lowpass(flat, step, cutoff, padding).reshape(values.shape)


# How far a joint has come since it last turned back.


def compute_travel_since_reversal(q: np.ndarray, least: float = 0.0) -> np.ndarray:
    """Returns (n,) |q - q at the last turning point|; before the first one, from the first sample.

    Args:
        q: (n,) positions of one joint without a gap, rad or m.
        least: rad or m; a way back of no more than this is noise of the encoder, and no turn.
    """
    turns = np.array([0, *_find_turning_points(q, least)])
    last = turns[np.searchsorted(turns, np.arange(len(q)), side="right") - 1]
    return np.abs(q - q[last])


def _find_turning_points(q: np.ndarray, least: float) -> list[int]:
    """Returns samples at which the joint turns back by more than `least`, increasing."""
    moving = np.flatnonzero(np.diff(q))
    leaps = np.sign(np.diff(q)[moving])
    corners = [*(moving[1:][np.diff(leaps) != 0]), len(q) - 1]
    turning_points: list[int] = []
    way, farthest = 0.0, 0
    for corner in map(int, corners):
        step = q[corner] - q[farthest]
        if step * way >= 0.0 and (way != 0.0 or abs(step) > least):
            way, farthest = way or float(np.sign(step)), corner
        elif step * way < 0.0 and abs(step) > least:
            turning_points.append(farthest)
            way, farthest = -way, corner
    return turning_points
