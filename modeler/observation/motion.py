"""Velocities and accelerations of a piece, and which of its samples may be used."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.signal import butter, sosfiltfilt

from modeler.observation.processing import Processing
from modeler.observation.segments import Piece

HIGHEST = 0.4
"""A cut-off is at most this share of the sampling rate: above, Butterworth has no room to fall."""

# The slowest poles fade as exp(-2.4 t cutoff): after 2.5 periods, 0.5 % of the kink in the
# acceleration that the extension beyond the ends makes is left (1.5 periods: 3 %).
_EDGE_PERIODS = 2.5


@dataclass(frozen=True, eq=False)
class Segment:
    """One uniform stretch of motion, ready for the model; n samples.

    Attributes:
        run: index of its log.
        time: (n,) s.
        step: s.
        q, qd, qdd: (n, joints) filtered motion.
        tau: (n, joints) torque as measured (missing values bridged).
        extra: further columns of the log, (n,).
        whole: (n,) False within the edge of the position filter.
        valid: (n, joints) True where the torque is a measurement that counts.
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
    valid: np.ndarray

    @property
    def samples(self) -> int:
        """Number of samples, n."""
        return len(self.time)


def segment_of(piece: Piece, processing: Processing) -> Segment | None:
    """The piece with its velocities and accelerations; None if it is all edge.

    q is filtered by a zero-phase Butterworth low-pass of order 4 (forwards and backwards), then
    qd(k) = (q(k+1) - q(k-1)) / 2h and qdd(k) = (q(k+1) - 2 q(k) + q(k-1)) / h^2 (Guegan, Khalil
    and Lemoine 2003, section 5.2). Logged velocities are filtered alike and differentiated once;
    logged accelerations are used as they are.

    Args:
        piece: a uniform stretch; its qd, qdd are None where they must come from q.
        processing: with `position_cutoff` chosen.
    """
    assert processing.position_cutoff is not None, "resolve() comes first"
    cutoff = min(processing.position_cutoff, HIGHEST / piece.step)
    if piece.qd is not None and piece.qdd is not None:
        q, qd, qdd, edge = piece.q, piece.qd, piece.qdd, 0
    else:
        edge = _edge(piece.step, cutoff, processing.edge)
        if piece.step * (len(piece.time) - 1) <= 2 * edge * piece.step:
            return None
        q = low_pass(piece.q, piece.step, cutoff)
        if piece.qd is not None:
            qd = low_pass(piece.qd, piece.step, cutoff)
            qdd = np.gradient(qd, piece.step, axis=0)
        else:
            qd = np.gradient(q, piece.step, axis=0)
            qdd = np.zeros_like(q)
            qdd[1:-1] = (q[2:] - 2.0 * q[1:-1] + q[:-2]) / piece.step**2
    whole = np.ones(len(piece.time), dtype=bool)
    if edge:
        whole[:edge] = whole[-edge:] = False
    valid = piece.valid if processing.keep_saturated else piece.valid & ~piece.clipped
    if edge and piece.bridged.any():
        # The bend of a bridge reaches as far as the start-up of the filter.
        near = np.convolve(piece.bridged, np.ones(2 * edge + 1), mode="full")[edge:-edge] > 0.5
        valid = valid & ~near[:, None]
    return Segment(
        piece.run, piece.time, piece.step, q, qd, qdd, piece.tau, piece.extra, whole,
        valid & whole[:, None],
    )  # fmt: skip


def _edge(step: float, cutoff: float, seconds: float | None) -> int:
    if seconds is None:
        seconds = _EDGE_PERIODS / cutoff if cutoff > 0.0 else 0.0
    return max(1, round(seconds / step))  # the outermost second difference does not exist


def low_pass(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    """`values` (n, ...) through the zero-phase Butterworth low-pass; as they are for cutoff 0."""
    if cutoff == 0.0:
        return values
    sections = butter(4, cutoff, fs=1.0 / step, output="sos")
    # Odd extension over the start-up time; scipy's default is too short for a low cut-off.
    padding = min(len(values) - 1, max(15, round(2.0 / (cutoff * step))))
    return sosfiltfilt(sections, values, axis=0, padlen=padding)
