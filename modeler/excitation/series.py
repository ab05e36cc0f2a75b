"""Motions that are linear in coefficients, and the columns of a model along them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, PPoly

from modeler.core.json import ShortRepr
from modeler.excitation.thresholds import THRESHOLDS
from modeler.regression import compute_signals_along
from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class MotionColumns:
    """phi of tau = phi beta along motions of a robot.

    Attributes:
        compiled: the robot.
        half_range: (J,) half of the range of each joint, rad or m.
        speed: (J,) its top speed.
        half_jumps: (J, J, c) half the jump of phi at reversals of a joint (first index).
        softness: of the top speed, over which `evaluate_smooth` spreads a jump.
    """

    compiled: CompiledModel
    half_range: np.ndarray
    speed: np.ndarray
    half_jumps: np.ndarray
    softness: float = 0.03

    def read_signals(self, motion: Sequence[np.ndarray], time: np.ndarray) -> np.ndarray | None:
        """Reads what effects of the model need besides q, qd, qdd, (n, m)."""
        return compute_signals(self.compiled, motion, time)

    def evaluate_exact(
        self, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, s: np.ndarray | None
    ) -> np.ndarray:
        """Evaluates phi (n, J, c) as it is."""
        return self.compiled.base_regressor(q, qd, qdd, s)

    def evaluate_smooth(
        self,
        q: np.ndarray,
        qd: np.ndarray,
        qdd: np.ndarray,
        s: np.ndarray | None,
        out: np.ndarray | None = None,
    ) -> np.ndarray:
        """Evaluates phi (n, J, c) with every jump at rest made a slope; in `out` if given."""
        phi = self.compiled.observation(q, qd, qdd, out, s).reshape(*q.shape, -1)
        for j in np.flatnonzero(self.half_jumps.any(axis=(1, 2))):
            v = qd[:, j] / (self.softness * self.speed[j])
            rest = np.flatnonzero(np.abs(v) < 20.0)
            over = (np.sign(v) - np.tanh(v))[rest]
            for row, column in np.argwhere(self.half_jumps[j]):
                phi[rest, row, column] -= over * self.half_jumps[j, row, column]
        return phi

    def pull_back_gradient(
        self,
        motion: tuple[np.ndarray, np.ndarray, np.ndarray],
        s: np.ndarray | None,
        pull: np.ndarray,
    ) -> list[np.ndarray]:
        """Computes derivatives by q, qd, qdd, (n, J), of a number with derivative `pull` by phi.

        By differences: central ones, one-sided where loops are closed for each.
        """
        n, joints = motion[0].shape
        central = self.compiled.spec.closure is None
        sides = (1.0, -1.0) if central else (1.0,)
        sizes = (
            THRESHOLDS.difference_step * self.half_range,
            THRESHOLDS.difference_step * self.speed,
            np.ones(joints),
        )
        count = 3 * len(sides)
        repeated_signals = None if s is None else np.vstack([s] * count)
        # One place for all of phi: fresh memory takes longer than what is written into it.
        place = np.empty((count * n * joints, pull.shape[2]))
        here = 0.0
        if not central:
            here = np.einsum(
                "njc,njc->n", self.evaluate_smooth(*motion, s, place[: n * joints]), pull
            )
        slopes = [np.empty((n, joints)) for _ in range(3)]
        for j in range(joints):
            moved = [np.vstack([values] * count) for values in motion]
            for k in range(count):
                order, sign = divmod(k, len(sides))
                moved[order][k * n : (k + 1) * n, j] += sides[sign] * sizes[order][j]
            phi = self.evaluate_smooth(moved[0], moved[1], moved[2], repeated_signals, place)
            along = np.einsum("knjc,njc->kn", phi.reshape(count, *pull.shape), pull)
            for order in range(3):
                if central:
                    change = 0.5 * (along[2 * order] - along[2 * order + 1])
                else:
                    change = along[order] - here
                slopes[order][:, j] = change / sizes[order][j]
        return slopes


def build_motion_columns(
    compiled: CompiledModel, middle: np.ndarray, half: np.ndarray, speed: np.ndarray
) -> MotionColumns:
    """Builds the columns of a robot, with the jumps at rest."""
    joints, wide = len(half), len(compiled.spec.base)
    rng = np.random.default_rng(0)
    near = middle + 0.1 * half * rng.uniform(-1, 1, (THRESHOLDS.jump_states, joints))
    flips = np.zeros((joints, joints, wide))
    read = compute_signals(
        compiled, (near, 0.0 * near, 0.0 * near), np.zeros(THRESHOLDS.jump_states)
    )
    for j in range(joints):
        qd = 0.5 * speed * rng.uniform(0.2, 1.0, (THRESHOLDS.jump_states, joints))
        sides = []
        for sign in (1.0, -1.0):
            qd[:, j] = sign * THRESHOLDS.rest_speed * speed[j]
            sides.append(compiled.base_regressor(near, qd, np.zeros_like(qd), read))
        jump = 0.5 * (sides[0] - sides[1])
        # A jump that hangs on the posture, as of joints without motor, is left as it is.
        if np.ptp(jump, axis=0).max() < THRESHOLDS.jump_tolerance:
            flips[j] = np.where(np.abs(jump[0]) > THRESHOLDS.jump_tolerance, jump[0], 0.0)
    return MotionColumns(compiled, half, speed, flips)


def compute_signals(
    compiled: CompiledModel, motion: Sequence[np.ndarray], time: np.ndarray
) -> np.ndarray | None:
    """Computes what effects read besides the motion, (n, m), at their reference temperature."""
    return compute_signals_along(compiled, motion, time, lambda joint: np.zeros(len(time)))


# What makes an observation matrix good, as a number to minimise, and its slope by the matrix.


Criterion = Callable[[np.ndarray], tuple[float, np.ndarray]]
"""From W (rows, c) to a value and its derivative by W; infinite if W lacks rank."""


def compute_log_condition(W: np.ndarray) -> tuple[float, np.ndarray]:
    """Computes a smooth bound of log cond(W) with columns of length one.

    The p-norms of the singular values and of their inverses, p = 8, stand for the largest and the
    inverse of the smallest: log cond <= value <= log cond + log(c) / 4.
    """
    lengths = np.linalg.norm(W, axis=0)
    if len(W) < W.shape[1] or not lengths.min() > 0.0:
        return np.inf, W
    scaled = W / lengths
    sizes, turn = _compute_singular_values(scaled)
    if not sizes[-1] > THRESHOLDS.rank_tolerance * sizes[0]:
        return np.inf, W
    large = np.sum(sizes**THRESHOLDS.norm_power)
    small = np.sum((sizes[-1] / sizes) ** THRESHOLDS.norm_power)
    value = (np.log(large) + np.log(small)) / THRESHOLDS.norm_power - np.log(sizes[-1])
    slope = sizes ** (THRESHOLDS.norm_power - 1) / large - (
        sizes[-1] / sizes
    ) ** THRESHOLDS.norm_power / (sizes * small)
    pull = scaled @ (turn * (slope / sizes)) @ turn.T
    # Lengths are one whatever W is: what changes them has no effect.
    return value, (pull - scaled * np.sum(pull * scaled, axis=0)) / lengths


def compute_lost_information(W: np.ndarray) -> tuple[float, np.ndarray]:
    """Computes -log det(W^T W) / (2 c): the mean log sigma, but for a constant."""
    columns = W.shape[1]
    if len(W) < columns:
        return np.inf, W
    R = np.linalg.qr(W, mode="r")
    diagonal = np.abs(np.diagonal(R))
    if not diagonal.min() > THRESHOLDS.rank_tolerance * diagonal.max():
        return np.inf, W
    inverse = np.linalg.solve(R, np.eye(columns))
    value = -float(np.sum(np.log(diagonal))) / columns
    return value, -(W @ inverse) @ inverse.T / columns


def compute_balanced_criterion(W: np.ndarray) -> tuple[float, np.ndarray]:
    """Computes the sum of both: well conditioned, and not by small motion."""
    (first, pull), (second, more) = compute_log_condition(W), compute_lost_information(W)
    return first + second, pull + more


CRITERIA: dict[str, Criterion] = {
    "both": compute_balanced_criterion,
    "condition": compute_log_condition,
    "information": compute_lost_information,
}
"""By the name that a user gives."""


@dataclass(frozen=True, eq=False)
class PriorInformation:
    """What logs determine already, in the weights of their fit.

    Attributes:
        triangle: (r, c) R, R^T R = W^T S^-1 W of their rows.
        rate: rows of each joint that a second of a log gives.
    """

    triangle: np.ndarray
    rate: float

    def extend_criterion(self, criterion: Criterion, each: float) -> Criterion:
        """Extends the criterion to R and the rows of a motion, each of which counts `each` times.

        Of the information that is a sum: W'S^-1 W of the logs, and that of the motion.
        """

        def evaluate_rows(W: np.ndarray) -> tuple[float, np.ndarray]:
            size = np.sqrt(each)
            criterion_value, pull = criterion(np.vstack([size * W, self.triangle]))
            return criterion_value, size * pull[: len(W)]

        return evaluate_rows


def compute_condition(W: np.ndarray, scaled: bool = True) -> float:
    """Computes cond(W), with columns of length one if `scaled`."""
    lengths = np.linalg.norm(W, axis=0) if scaled else np.ones(W.shape[1])
    if len(W) < W.shape[1] or not lengths.min() > 0.0:
        return float("inf")
    sizes = np.linalg.svd(np.linalg.qr(W, mode="r") / lengths, compute_uv=False)
    return float(sizes[0] / sizes[-1]) if sizes[-1] > 0.0 else float("inf")


def compute_log_det(W: np.ndarray) -> float:
    """Computes log det(W^T W) of the information matrix; rows are divided by their sigma."""
    with np.errstate(divide="ignore"):
        return 2.0 * float(np.sum(np.log(np.abs(np.diagonal(np.linalg.qr(W, mode="r"))))))


def _compute_singular_values(W: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Singular values and right singular vectors, as columns."""
    _, sizes, turned = np.linalg.svd(np.linalg.qr(W, mode="r"))
    return sizes, turned.T


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
        """Evaluates q, qd and qdd, (n, joints), of (joints, 2 K - 1) coefficients."""
        return self.values @ x.T, self.slopes @ x.T, self.bends @ x.T

    def resample_at(self, times: np.ndarray) -> "MotionSeries":
        """Returns the series at other times, s."""
        return build_series(self.duration, self.harmonics, times, family=self.family)

    def refine_samples(self, times: int) -> "MotionSeries":
        """Returns the series with so many times as many samples."""
        count = times * len(self.time)
        return _sample_series(self.family, self.duration, self.harmonics, count)


def build_series(
    duration: float,
    harmonics: int,
    times: np.ndarray | None = None,
    dense: int = THRESHOLDS.samples_per_wave,
    family: str = "fourier",
) -> MotionSeries:
    """Builds a family over a lap, at even times; at `times` (s) if given."""
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
    """Counts spans between knots of a B-spline, or moves of a trapezoid."""
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
    """Exports what a controller needs to compute the motion, by joint."""
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
