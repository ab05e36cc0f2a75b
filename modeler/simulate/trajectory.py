"""Commanded motion that excites a robot: moves at several speeds, then a Fourier series."""

from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.robot import Limits
from modeler.simulate.elementary import sine_and_cosine, ten_digits

_MARGIN = 0.92  # of the limits: the joints overshoot the command a little
_SPEEDS = (1.0, 0.6, 0.25, 1.0, 0.4, 0.1)  # of the top speed, taken in turn
_LONGEST = 1.4  # s, of one move: slow moves are short ones
_PAUSE = 0.05  # s, between moves
_HARMONICS = 6
_LOWEST = 0.1  # Hz, fundamental of the series
_AS_FAST_AS_CAN_BE = (1.0,)
_REST = 0.2  # s, before and after a joint moves alone
_ALONE = (1.0, 0.5)  # of the top speed, of a joint that moves alone
_PEAK_SPEED = 15 / 8  # of a quintic move of unit length and duration
_PEAK_ACCELERATION = 10 / np.sqrt(3)


@dataclass(frozen=True, eq=False)
class Reference:
    """Commanded motion, sampled; twice continuously differentiable, at rest at both ends.

    Attributes:
        time: (n,) s.
        q, qd, qdd: (n, joints), SI; qd and qdd are the exact derivatives.
    """

    time: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray


def reference_motion(
    motion: str,
    limits: tuple[Limits, ...],
    duration: float,
    rate: float,
    seed: int,
    directions: np.ndarray | None = None,
) -> Reference:
    """The motion of that name: "exciting", "point-to-point" or "one-joint"."""
    if motion == "one-joint":
        return one_joint_reference(limits, duration, rate, seed, directions)
    make = point_to_point_reference if motion == "point-to-point" else exciting_reference
    return make(limits, duration, rate, seed)


def widened(limits: tuple[Limits, ...], motion: Reference) -> tuple[Limits, ...]:
    """Limits that hold the motion."""
    peaks = (motion.q.min(0), motion.q.max(0), np.abs(motion.qd).max(0), np.abs(motion.qdd).max(0))
    return tuple(
        Limits(min(li.lower, low), max(li.upper, high), max(li.speed, v), max(li.acceleration, a))
        for li, low, high, v, a in zip(limits, *(p.tolist() for p in peaks), strict=True)
    )


def point_to_point_reference(
    limits: tuple[Limits, ...], duration: float, rate: float, seed: int
) -> Reference:
    """Quintic moves of all joints between random points, as fast as the limits allow.

    The motion of Guegan, Khalil and Lemoine 2003 (ICRA, section 5). Arguments as those of
    `exciting_reference`.

    Raises:
        DataError: no time for a move there and back, or what `exciting_reference` refuses.
    """
    path, time = _at_rest(limits, duration, rate)
    rng = np.random.default_rng([seed, 4])
    if _add_moves(path, time, limits, float(time[-1]), rng, exciting=False) == 0.0:
        raise DataError(
            f"reference motion: got duration {duration} s, too short for a move and back; expected "
            "more, or faster [limits]"
        )
    return Reference(time, *path)


def one_joint_reference(
    limits: tuple[Limits, ...],
    duration: float,
    rate: float,
    seed: int,
    directions: np.ndarray | None = None,
) -> Reference:
    """One joint after the other moves alone, at ever new configurations of the others.

    For a two-step identification (Hanssen, Hovland and Brogardh 2000, section 5): all coordinates
    go to a random place, and one joint goes there and back over its range at several speeds.

    Args:
        limits: of the coordinates, in the order of q.
        duration: s.
        rate: samples per second.
        seed: of the places.
        directions: (joints, coordinates), the coordinates per joint; None: they are the joints.

    Raises:
        DataError: no time for one joint, or what `exciting_reference` refuses.
    """
    along = np.eye(len(limits)) if directions is None else directions
    path, time = _at_rest(limits, duration, rate)
    rng = np.random.default_rng([seed, 6])
    middle = path[0, 0].copy()
    now, here, turn = _PAUSE, middle.copy(), 0
    while True:
        steps, there = _there_and_back(limits, middle, here, along[turn % len(along)], rng)
        moves = [(step, _move_time(step, limits, level)) for step, level in steps]
        home = _move_time(middle - there, limits, 1.0)
        if now + sum(lasts + _REST for _, lasts in moves) + home + _PAUSE > time[-1]:
            break
        for step, lasts in moves:
            _add_move(path, time, now, lasts, step)
            now += lasts + _REST
        here, turn = there, turn + 1
    _check_moved(turn, duration)
    _add_move(path, time, now, _move_time(middle - here, limits, 1.0), middle - here)
    return Reference(time, *path)


def _check_moved(turns: int, duration: float) -> None:
    if not turns:
        raise DataError(
            f"reference motion: got duration {duration} s, too short for one joint to move there "
            "and back; expected more, or faster [limits]"
        )


def _there_and_back(
    limits: tuple[Limits, ...],
    middle: np.ndarray,
    here: np.ndarray,
    way: np.ndarray,
    rng: np.random.Generator,
) -> tuple[list[tuple[np.ndarray, float]], np.ndarray]:
    """Steps and their speeds: to a random place, then along `way` over its range; and the place."""
    reach = _MARGIN * np.array([(limit.upper - limit.lower) / 2 for limit in limits])
    place = middle + reach * np.round(rng.uniform(-1, 1, len(limits)), 10)
    first, last = _ends(place, way, middle - reach, middle + reach)
    there, along = place + first * way, (last - first) * way
    alone = [(sign * along, level) for level in _ALONE for sign in (1, -1)]
    return [(there - here, 1.0), *alone], there


def _ends(
    place: np.ndarray, way: np.ndarray, lower: np.ndarray, upper: np.ndarray
) -> tuple[float, float]:
    """How far along `way` one can go from `place`, back and forth, within the range."""
    moved = way != 0
    sides = np.stack([(lower - place)[moved] / way[moved], (upper - place)[moved] / way[moved]])
    return float(np.max(np.min(sides, axis=0))), float(np.min(np.max(sides, axis=0)))


def exciting_reference(
    limits: tuple[Limits, ...], duration: float, rate: float, seed: int
) -> Reference:
    """Point-to-point moves for the first half, a Fourier series for the rest, within the limits.

    The moves are quintic polynomials at 10 to 100 % of the top speed, of all joints or of some of
    them, so that friction is seen at several speeds and joints also move alone. The series
    (Swevers et al. 1997, IEEE Trans. Robotics and Automation 13(5)) is faded in and out with a
    quintic step.

    Args:
        limits: range of motion of each joint, in the order of q.
        duration: s.
        rate: samples per second.
        seed: another seed gives another motion within the same limits.

    Raises:
        DataError: duration too short for one sample, or a rate not above 0.
    """
    path, time = _at_rest(limits, duration, rate)
    rng = np.random.default_rng([seed, 2])
    start = _add_moves(path, time, limits, duration / 2, rng)
    _add_series(path, time, limits, start, float(time[-1]), rng)
    return Reference(time, *path)


def _at_rest(
    limits: tuple[Limits, ...], duration: float, rate: float
) -> tuple[np.ndarray, np.ndarray]:
    """(3, n, joints) positions in the middle of the range and their derivatives, and (n,) time."""
    if not rate > 0 or not duration > 0 or not np.isfinite(duration * rate):
        raise DataError(
            f"reference motion: got duration {duration} s at {rate} samples per second; "
            "expected both above 0"
        )
    count = round(duration * rate)
    if count < 2:
        raise DataError(
            f"reference motion: duration {duration} s holds {count} samples at {rate} per second; "
            "expected at least 2"
        )
    time = np.arange(count) / rate
    middle = np.array([(limit.lower + limit.upper) / 2 for limit in limits])
    path = np.zeros((3, count, len(limits)))
    path[0] = middle
    return path, time


def _add_moves(
    path: np.ndarray,
    time: np.ndarray,
    limits: tuple[Limits, ...],
    until: float,
    rng: np.random.Generator,
    exciting: bool = True,
) -> float:
    """Moves from the middle and back to it; gives the time at which they end, 0 without any.

    Exciting ones are of several speeds, some of only some joints, and none takes long.
    """
    speeds, longest = (_SPEEDS, _LONGEST) if exciting else (_AS_FAST_AS_CAN_BE, np.inf)
    middle = path[0, 0].copy()
    reach = _MARGIN * np.array([(limit.upper - limit.lower) / 2 for limit in limits])
    now, here, turn = _PAUSE, middle.copy(), 0
    while True:
        level = speeds[turn % len(speeds)]
        joins = rng.random(len(limits)) < (0.5 if exciting and turn % 3 == 2 else 1.1)
        joins[rng.integers(len(limits))] = True
        share = np.round(rng.uniform(-1, 1, len(limits)), 10)
        target = np.where(joins, middle + reach * share, here)
        needed = _move_time(target - here, limits, level)
        target = here + (target - here) * min(1.0, longest / max(needed, 1e-9))
        lasts = _move_time(target - here, limits, level)
        home = _move_time(middle - target, limits, 1.0)
        if now + lasts + home + 2 * _PAUSE > until:
            break
        _add_move(path, time, now, lasts, target - here)
        now, here, turn = now + lasts + _PAUSE, target, turn + 1
    back = _move_time(middle - here, limits, 1.0)
    _add_move(path, time, now, back, middle - here)
    return now + back + _PAUSE if turn else 0.0


def _move_time(distance: np.ndarray, limits: tuple[Limits, ...], level: float) -> float:
    """Duration of a quintic move of all joints together, none above level * top speed, s."""
    speed = _MARGIN * level * np.array([limit.speed for limit in limits])
    lift = _MARGIN * np.array([limit.acceleration for limit in limits])
    length = np.abs(distance)
    return float(
        max(
            np.max(_PEAK_SPEED * length / speed),
            np.max(np.sqrt(_PEAK_ACCELERATION * length / lift)),
        )
    )


def _add_move(
    path: np.ndarray, time: np.ndarray, begin: float, lasts: float, distance: np.ndarray
) -> None:
    if lasts > 0:
        step = _quintic_step((time - begin) / lasts)
        for order in range(3):
            path[order] += step[order][:, None] / lasts**order * distance


def _quintic_step(s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """0 before s = 0, 1 after s = 1, with two continuous derivatives between; and these."""
    x = np.clip(s, 0.0, 1.0)
    value = x * x * x * (10 - 15 * x + 6 * x**2)
    slope = 30 * x**2 * (1 - x) ** 2
    bend = 60 * x * (1 - x) * (1 - 2 * x)
    return value, slope, bend


def _add_series(
    path: np.ndarray,
    time: np.ndarray,
    limits: tuple[Limits, ...],
    begin: float,
    end: float,
    rng: np.random.Generator,
) -> None:
    """A sum of harmonics for each joint, faded in from `begin` and out to `end`."""
    lasts = end - begin
    fade = min(1.0, lasts / 3)
    lowest = max(_LOWEST, 1.0 / lasts)
    rise = _quintic_step((time - begin) / fade)
    fall = _quintic_step((time - (end - fade)) / fade)
    window = [(rise[k] - fall[k]) / fade**k for k in range(3)]
    for i, limit in enumerate(limits):
        series = np.zeros((3, time.size))
        for harmonic in range(1, _HARMONICS + 1):
            omega = 2 * np.pi * lowest * harmonic * ten_digits(rng.uniform(0.9, 1.1))
            phase = omega * (time - begin) + ten_digits(rng.uniform(0, 2 * np.pi))
            size = ten_digits(rng.uniform(0.5, 1.0)) / harmonic
            sine, cosine = sine_and_cosine(phase)
            series += size * np.array([sine, omega * cosine, -(omega**2) * sine])
        shaped = np.array([
            window[0] * series[0],
            window[1] * series[0] + window[0] * series[1],
            window[2] * series[0] + 2 * window[1] * series[1] + window[0] * series[2],
        ])  # fmt: skip
        bounds = ((limit.upper - limit.lower) / 2, limit.speed, limit.acceleration)
        peaks = np.max(np.abs(shaped), axis=1)
        shares = [bound / peak for bound, peak in zip(bounds, peaks, strict=True) if peak > 0]
        path[:, :, i] += shaped * _MARGIN * min(shares, default=0.0)
