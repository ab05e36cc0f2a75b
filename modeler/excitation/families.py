"""Motions that are linear in their coefficients: Fourier series, B-splines, trapezoids."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, PPoly

from modeler.core.brief import ShortRepr
from modeler.excitation.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class MotionSeries(ShortRepr):
    """q_j(t) = V(t) x_j: from rest to rest in one posture, so that it may be repeated.

    Attributes:
        family: one of `FAMILIES`.
        duration: of a lap, s.
        harmonics: K, which says how many coefficients a joint has: 2 K - 1.
        time: (n,) s, evenly over the lap.
        values, slopes, bends: (n, 2 K - 1) V and its derivatives; the first column of V is 1.
        room: no value between the samples is larger than the largest at one over this.
    """

    family: str
    duration: float
    harmonics: int
    time: np.ndarray
    values: np.ndarray
    slopes: np.ndarray
    bends: np.ndarray
    room: float

    def evaluate_motion(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(n, joints) q, qd and qdd of (joints, 2 K - 1) coefficients."""
        return self.values @ x.T, self.slopes @ x.T, self.bends @ x.T

    def resample_at(self, times: np.ndarray) -> "MotionSeries":
        """The same at other times, s."""
        return build_series(self.duration, self.harmonics, times, family=self.family)

    def refine_samples(self, times: int) -> "MotionSeries":
        """The same with so many times as many samples."""
        count = times * len(self.time)
        return _sample_series(self.family, self.duration, self.harmonics, count)


def build_series(
    duration: float,
    harmonics: int,
    times: np.ndarray | None = None,
    dense: int = THRESHOLDS.samples_per_wave,
    family: str = "fourier",
) -> MotionSeries:
    """A family over a lap, at even times; at `times` (s) if given."""
    if times is None:
        return _sample_series(family, duration, harmonics, dense * harmonics)
    waves = FAMILIES[family](duration, harmonics, np.asarray(times, dtype=float))
    return MotionSeries(family, duration, harmonics, times, *waves, room=1.0)


def _sample_series(family: str, duration: float, harmonics: int, count: int) -> MotionSeries:
    """At `count` even times, at least."""
    room = float(np.cos(np.pi * harmonics / count))
    if family != "fourier":
        parts = count_pieces(harmonics)
        each = _EIGHT * -(-count // (_EIGHT * parts))
        count = each * parts
        room = (
            1.0
            if family == "trapezoid"
            else 1.0 - min(THRESHOLDS.markov_bound / each**2, THRESHOLDS.usual_excess)
        )
    times = np.arange(count) * (duration / count)
    return MotionSeries(
        family, duration, harmonics, times, *FAMILIES[family](duration, harmonics, times), room=room
    )


def count_pieces(harmonics: int) -> int:
    """Spans between knots of a B-spline, moves of a trapezoid."""
    return 2 * harmonics - 1


_Waves = tuple[np.ndarray, np.ndarray, np.ndarray]


def _build_fourier(duration: float, harmonics: int, times: np.ndarray) -> _Waves:
    """Finite Fourier series (Swevers et al. 1997, IEEE Trans. Robotics and Automation 13(5)).

    Two coefficients are given away: sum k b_k = 0 and sum k^2 a_k = 0, so there is no speed and no
    acceleration at the ends. A trigonometric polynomial of degree K is at least cos(pi K / n) of
    its largest value at one of n even places: it falls no faster than a cosine of its own degree
    from its peak.
    """
    k = np.arange(1, harmonics + 1)
    omega = 2.0 * np.pi * k / duration
    phase = np.outer(times, omega)
    cosine, sine, none = np.cos(phase) / k, np.sin(phase) / k, np.zeros((len(times), 1))
    resting = _build_rest_basis(harmonics)
    return (
        np.hstack([none + 1.0, cosine, sine]) @ resting,
        np.hstack([none, -omega * sine, omega * cosine]) @ resting,
        np.hstack([none, -(omega**2) * cosine, -(omega**2) * sine]) @ resting,
    )


def _build_rest_basis(harmonics: int) -> np.ndarray:
    """(2 K + 1, 2 K - 1) orthonormal coefficients with no speed and acceleration at 0."""
    k = np.arange(1.0, harmonics + 1)
    basis = np.zeros((2 * harmonics + 1, 2 * harmonics - 1))
    basis[0, 0] = 1.0
    for begin, row in ((1, k), (1 + harmonics, np.ones(harmonics))):  # of a_k / k and b_k / k
        free = np.linalg.svd(row[None, :])[2][1:].T
        at = 1 if begin == 1 else harmonics
        basis[begin : begin + harmonics, at : at + harmonics - 1] = free
    return basis


DEGREE = 5
"""Of B-splines: the jerk is continuous."""


def _build_bspline(duration: float, harmonics: int, times: np.ndarray) -> _Waves:
    """Quintic B-splines with even knots (Rackl, Lampariello and Hirzinger 2012, ICRA).

    The first three and the last three control points are one: rest at the ends, in one posture.
    """
    inside = np.linspace(0.0, duration, count_pieces(harmonics) + 1)
    knots = np.concatenate([np.zeros(DEGREE), inside, np.full(DEGREE, duration)])
    curve = BSpline(knots, np.eye(len(knots) - DEGREE - 1)[:, 3:-3], DEGREE)
    return _add_start_column([curve(times, order) for order in range(3)])


def _add_start_column(waves: list[np.ndarray]) -> _Waves:
    """Columns with their derivatives, and before them that of the posture at the start."""
    first = np.zeros((len(waves[0]), 1))
    q, qd, qdd = (np.hstack([first + (k == 0), wave]) for k, wave in enumerate(waves))
    return q, qd, qdd


SHAPE = (0.625, 0.25, 0.125)
"""Of a move: three averages over these shares of its time make a trapezoid of speed of a step."""

_EIGHT = 8  # parts of a move, at whose ends its speed and acceleration are largest


def _build_move() -> PPoly:
    """0 to 1 over a time of 1: speed a trapezoid, acceleration too, jerk constant by pieces."""
    cruise, ramp, jerk = SHAPE
    steps = np.zeros(_EIGHT)
    steps[[round(x * _EIGHT) for x in (0.0, cruise + ramp)]] = 1.0
    steps[[round(x * _EIGHT) for x in (ramp, cruise)]] = -1.0
    places = np.arange(_EIGHT + 1) / _EIGHT
    return PPoly(steps[None, :] / (cruise * ramp * jerk), places).antiderivative(3)


def _build_trapezoid(duration: float, harmonics: int, times: np.ndarray) -> _Waves:
    """Moves of all joints together from place to place, at rest at each; the last one goes back.

    Their speed is a trapezoid with rounded ramps (double S; Biagiotti and Melchiorri 2008, ch. 3).
    Coefficients are the places, from the first.
    """
    count, move = count_pieces(harmonics), _build_move()
    lasts = duration / count
    since = np.clip(times[:, None] / lasts - np.arange(count), 0.0, 1.0)
    gone = [np.asarray(move(since, order)) / lasts**order for order in range(3)]
    return _add_start_column([each[:, :-1] - each[:, 1:] for each in gone])


FAMILIES: dict[str, Callable[[float, int, np.ndarray], _Waves]] = {
    "fourier": _build_fourier,
    "bspline": _build_bspline,
    "trapezoid": _build_trapezoid,
}
"""By the name that a user gives."""


def export_coefficients(
    motion: MotionSeries, x: np.ndarray, joints: tuple[str, ...]
) -> dict[str, object]:
    """What a controller needs to compute the motion itself, by joint."""
    K, header = motion.harmonics, {"family": motion.family, "period": motion.duration}
    if motion.family != "fourier":
        spline = motion.family == "bspline"
        ends = np.repeat(x[:, :1], 3 if spline else 1, axis=1)
        points = np.hstack([ends, x[:, :1] + x[:, 1:], ends]).tolist()
        entry = {"degree": DEGREE} if spline else {"shape": list(SHAPE)}
        return {**header, **entry, "points": dict(zip(joints, points, strict=True))}
    count = 4 * K
    q = motion.resample_at(np.arange(count) * (motion.duration / count)).values @ x.T
    wave = 2.0 * np.fft.rfft(q, axis=0)[: K + 1].T / count
    waves = {
        name: {
            "constant": float(entry[0].real) / 2.0,
            "cos": entry.real[1:].tolist(),
            "sin": (-entry.imag[1:]).tolist(),
        }
        for name, entry in zip(joints, wave, strict=True)
    }
    return {**header, "coefficients": waves}
