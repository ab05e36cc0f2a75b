"""Velocities and accelerations of a piece, and which of its samples may be used."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.ndimage import maximum_filter1d

from modeler.core.brief import ShortRepr
from modeler.numerics.filters import apply_zero_phase_lowpass
from modeler.regression.segments import SHORT, RawSegment, select_long_runs
from modeler.regression.settings import Processing

HIGHEST = 0.4
"""A cut-off is at most this share of the sampling rate: above, Butterworth has no room to fall."""

_SHORT_PERIODS = 0.4  # of the cut-off: a shorter bridge follows the motion that passes the filter

# The slowest poles fade as exp(-2.4 t cutoff): after 2.5 periods, 0.5 % of the kink in the
# acceleration that the extension beyond the ends makes is left (1.5 periods: 3 %).
_EDGE_PERIODS = 2.5


EDGE = "lie within the start-up of the position filter at the ends of a piece"
MISSING = "have no measured position or torque, or a damaged one"
BRIDGES = "lie beside missing positions, as near as the position filter reaches"
CONTRADICTED = "have impossible derivatives, or lie as near to them as the position filter reaches"
SATURATED = "have a torque at its limit"
OPEN = "have positions with which the loops cannot be closed"
CAUSES = (EDGE, MISSING, BRIDGES, CONTRADICTED, SATURATED, OPEN)
"""In this order; the first that applies counts."""


@dataclass(frozen=True, eq=False)
class Segment(ShortRepr):
    """One uniform stretch of motion, ready for the model; n samples.

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
        """Number of samples, n."""
        return len(self.time)

    @property
    def logged_step(self) -> float:
        """Between samples of the log, s."""
        return self.step / self.every

    def thin_samples(self, every: int, read: np.ndarray | None) -> "Segment":
        """Every so manieth sample of a segment, and of what effects of its model read (n, m)."""
        arrays: dict[str, Any] = {n: getattr(self, n)[::every].copy() for n in _SAMPLED}
        extra = {name: values[::every].copy() for name, values in self.extra.items()}
        return dataclasses.replace(
            self, **arrays, extra=extra, step=self.step * every, every=every, commanded=None,
            read=None if read is None else np.ascontiguousarray(read[::every]),
        )  # fmt: skip

    @cached_property
    def valid(self) -> np.ndarray:
        """(n, joints) True where the torque is a measurement that counts."""
        return np.asarray(self.cause < 0)


_SAMPLED = ("time", "q", "qd", "qdd", "tau", "whole", "cause")


def build_segment(piece: RawSegment, processing: Processing) -> Segment | None:
    """The piece with its velocities and accelerations; None if it is all edge.

    q is filtered by a zero-phase Butterworth low-pass of order 4 (forwards and backwards), then
    qd(k) = (q(k+1) - q(k-1)) / 2h and qdd(k) = (q(k+1) - 2 q(k) + q(k-1)) / h^2 (Guegan, Khalil
    and Lemoine 2003, section 5.2). Logged velocities are filtered alike and differentiated once;
    logged accelerations are used as they are.

    Args:
        piece: a uniform stretch; its qd, qdd are None where they must come from q.
        processing: with `position_cutoff` chosen.
    """
    cutoff = min(processing.position_cutoff or 0.0, HIGHEST / piece.step)
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
    return Segment(
        piece.run, piece.time, piece.step, q, qd, qdd, tau, piece.extra, whole, cause, wanted
    )


def _classify_samples(
    piece: RawSegment, whole: np.ndarray, edge: int, cutoff: float, keep_saturated: bool
) -> np.ndarray:
    """(n, joints) why samples do not count, as places in CAUSES; -1 where they do.

    The bend of a bridge, or of a wrong velocity, reaches as far as the start-up of the filter; a
    few missing samples that take less than 0.4 periods of the cut-off leave no bend.
    """
    few = min(SHORT, int(_SHORT_PERIODS / (cutoff * piece.step)) - 1) if cutoff else 0
    bent = select_long_runs(piece.bridged, few) if few > 0 else piece.bridged
    flags = {
        EDGE: ~whole[:, None],
        MISSING: piece.bridged[:, None] | ~piece.valid,
        BRIDGES: dilate_flags(bent, edge)[:, None],
        CONTRADICTED: dilate_flags(piece.contradicted, edge)[:, None],
        SATURATED: piece.clipped & (not keep_saturated),
    }
    cause = np.full(piece.valid.shape, -1, dtype=np.int8)
    for name, flagged in flags.items():
        cause[(cause < 0) & flagged] = CAUSES.index(name)
    return cause


def dilate_flags(flags: np.ndarray, reach: int) -> np.ndarray:
    """(n,) True within so many samples of a flagged one."""
    if not reach or not flags.any():
        return flags
    return np.asarray(maximum_filter1d(flags.view(np.uint8), 2 * reach + 1) > 0)


def compute_edge(piece: RawSegment, processing: Processing) -> int:
    """Samples at either end of a piece that are lost to the low-pass of its positions."""
    if piece.qd is not None and piece.qdd is not None:
        return 0
    cutoff, seconds = processing.position_cutoff or 0.0, processing.edge
    cutoff = min(cutoff, HIGHEST / piece.step)
    if seconds is None:
        seconds = _EDGE_PERIODS / cutoff if cutoff > 0.0 else 0.0
    return max(1, round(seconds / piece.step))  # the outermost second difference does not exist


def differentiate_positions(q: np.ndarray, step: float) -> np.ndarray:
    """(3, n, joints) positions (n, joints), velocities and accelerations: central differences."""
    qdd = np.zeros_like(q)
    qdd[1:-1] = (q[2:] - 2.0 * q[1:-1] + q[:-2]) / step**2
    return np.stack([q, np.gradient(q, step, axis=0), qdd])


def _differentiate_wide(q: np.ndarray, step: float) -> np.ndarray:
    """Velocities (n, joints) by differences over five samples, of error (omega step)^4 / 30.

    What a motor induces is many times the friction that is asked for: at 30 Hz, the half percent
    that differences over three samples lose of a motion of 1 Hz would be a tenth of it.
    """
    qd = np.gradient(q, step, axis=0)
    qd[2:-2] = (8.0 * (q[3:-1] - q[1:-3]) - (q[4:] - q[:-4])) / (12.0 * step)
    return np.asarray(qd)


def apply_low_pass(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """`values` (n, ...) through the zero-phase Butterworth low-pass; as they are for cutoff 0."""
    if cutoff == 0.0:
        return values
    # Odd extension over the start-up time; scipy's default is too short for a low cut-off.
    padding = min(len(values) - 1, max(15, round(2.0 / (cutoff * step))))
    flat = values.reshape(len(values), -1)
    return apply_zero_phase_lowpass(flat, step, cutoff, padding).reshape(values.shape)


# How far a joint has come since it last turned back.


def compute_travel_since_reversal(q: np.ndarray, least: float = 0.0) -> np.ndarray:
    """(n,) |q - q at the last turning point|; before the first one, from the first sample.

    Args:
        q: (n,) positions of one joint without a gap, rad or m.
        least: rad or m; a way back of no more than this is noise of the encoder, and no turn.
    """
    turns = np.array([0, *_find_turning_points(q, least)])
    last = turns[np.searchsorted(turns, np.arange(len(q)), side="right") - 1]
    return np.abs(q - q[last])


def _find_turning_points(q: np.ndarray, least: float) -> list[int]:
    """Samples at which the joint turns back by more than `least`, increasing."""
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
