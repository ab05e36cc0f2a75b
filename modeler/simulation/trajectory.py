"""Commanded motion: moves at several speeds, Fourier series, files; its limits."""

import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.parquet as pq
from scipy.interpolate import BPoly, make_interp_spline

from modeler.core.choices import MOST_SAMPLES
from modeler.core.errors import DataError, RobotError
from modeler.core.files import check_unpacked_size, read_file
from modeler.robot import Limits, Robot
from modeler.simulation.portable_math import compute_sine_and_cosine, round_to_ten_digits
from modeler.simulation.thresholds import THRESHOLDS

_AS_FAST_AS_CAN_BE = (1.0,)
_PEAK_SPEED = 15 / 8  # of a quintic move of unit length and duration
_PEAK_ACCELERATION = 10 / np.sqrt(3)


@dataclass(frozen=True, eq=False)
class Reference:
    """Commanded motion, sampled; twice continuously differentiable, at rest at both ends.

    Attributes:
        time: (n,) s.
        q, qd, qdd: (n, joints), SI; qd and qdd are the exact derivatives.
        is_complete: True of a file that states speeds and accelerations too.
        is_measured: True of a log, which has torques or currents.
    """

    time: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    is_complete: bool = False
    is_measured: bool = False


def widen_limits(limits: tuple[Limits, ...], motion: Reference) -> tuple[Limits, ...]:
    """Returns limits that hold the motion."""
    peaks = (motion.q.min(0), motion.q.max(0), np.abs(motion.qd).max(0), np.abs(motion.qdd).max(0))
    return tuple(
        Limits(min(li.lower, low), max(li.upper, high), max(li.speed, v), max(li.acceleration, a))
        for li, low, high, v, a in zip(limits, *(p.tolist() for p in peaks), strict=True)
    )


def build_point_to_point_reference(
    limits: tuple[Limits, ...], duration: float, rate: float, seed: int
) -> Reference:
    """Returns quintic moves of all joints between random points, as fast as the limits allow.

    The motion of Guegan, Khalil and Lemoine 2003 (ICRA, section 5). Arguments as those of
    `build_exciting_reference`.

    Raises:
        DataError: no time for a move there and back, or what `build_exciting_reference` refuses.
    """
    path = _ReferenceBuilder(limits, duration, rate)
    until = float(path.time[-1])
    if path.add_moves(until, np.random.default_rng([seed, 4]), exciting=False) == 0.0:
        raise DataError(
            f"reference motion: got duration {duration} s, too short for a move and back; expected "
            "more, or faster [limits]"
        )
    return path.build_reference()


def build_one_joint_reference(
    limits: tuple[Limits, ...],
    duration: float,
    rate: float,
    seed: int,
    directions: np.ndarray | None = None,
) -> Reference:
    """Returns one joint after the other moves alone, at ever new configurations of the others.

    For a two-step identification (Hanssen, Hovland and Brogardh 2000, section 5): all coordinates
    go to a random place, and one joint goes there and back over its range at several speeds.

    Args:
        limits: of the coordinates, in the order of q.
        duration: s.
        rate: samples per second.
        seed: of the places.
        directions: (joints, coordinates), the coordinates per joint; None: they are the joints.

    Raises:
        DataError: no time for one joint, or what `build_exciting_reference` refuses.
    """
    directions = np.eye(len(limits)) if directions is None else directions
    path, rng = _ReferenceBuilder(limits, duration, rate), np.random.default_rng([seed, 6])
    lower, upper = path.middle - path.reach, path.middle + path.reach
    now, here, turn = THRESHOLDS.pause_time, path.middle, 0
    while True:
        direction = directions[turn % len(directions)]
        place = path.draw_position(rng)
        # How far one can go along `direction` from there, back and forth, within the range.
        on = direction != 0
        sides = np.stack([(edge - place)[on] / direction[on] for edge in (lower, upper)])
        first = float(np.max(np.min(sides, axis=0)))
        last = float(np.min(np.max(sides, axis=0)))
        start_point, along = place + first * direction, (last - first) * direction
        steps = [(start_point - here, 1.0)]
        levels = THRESHOLDS.single_joint_speeds
        steps += [(sign * along, level) for level in levels for sign in (1, -1)]
        moves = [(step, path.compute_move_time(step, level)) for step, level in steps]
        home = path.compute_move_time(path.middle - start_point)
        last = now + sum(lasts + THRESHOLDS.rest_time for _, lasts in moves) + home
        if last + THRESHOLDS.pause_time > path.time[-1]:
            break
        for step, lasts in moves:
            path.add_move(now, lasts, step)
            now += lasts + THRESHOLDS.rest_time
        here, turn = start_point, turn + 1
    if not turn:
        raise DataError(
            f"reference motion: got duration {duration} s, too short for one joint to move there "
            "and back; expected more, or faster [limits]"
        )
    path.add_move(now, path.compute_move_time(path.middle - here), path.middle - here)
    return path.build_reference()


def build_exciting_reference(
    limits: tuple[Limits, ...], duration: float, rate: float, seed: int
) -> Reference:
    """Builds moves for the first half and a Fourier series for the rest, within the limits.

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
        DataError: duration too short for two samples.
    """
    path, rng = _ReferenceBuilder(limits, duration, rate), np.random.default_rng([seed, 2])
    path.add_series(path.add_moves(duration / 2, rng), rng)
    return path.build_reference()


class _ReferenceBuilder:
    """A motion in the making: at rest in the middle of the range, until moves are added.

    Attributes:
        limits: in the order of q.
        time: (n,) s.
        values: (3, n, joints) positions and their derivatives.
        middle: (joints,) of the range.
        reach: (joints,) how far a joint may go from there.
    """

    def __init__(self, limits: tuple[Limits, ...], duration: float, rate: float) -> None:

        count = round(duration * rate)
        if count < 2:
            raise DataError(
                f"reference motion: duration {duration} s holds {count} samples at {rate} per "
                "second; expected at least 2"
            )
        self.limits, self.time = limits, np.arange(count) / rate
        self.middle = np.array([(limit.lower + limit.upper) / 2 for limit in limits])
        half = np.array([(limit.upper - limit.lower) / 2 for limit in limits])
        self.reach = THRESHOLDS.range_margin * half
        self.values = np.zeros((3, count, len(limits)))
        self.values[0] = self.middle

    def build_reference(self) -> Reference:
        return Reference(self.time, *self.values)

    def draw_position(self, rng: np.random.Generator) -> np.ndarray:
        """Returns (joints,) positions within reach."""
        return self.middle + self.reach * np.round(rng.uniform(-1, 1, len(self.limits)), 10)

    def compute_move_time(self, distance: np.ndarray, level: float = 1.0) -> float:
        """Computes the duration of a quintic move of all joints, below level * top speed, s."""
        speed = THRESHOLDS.range_margin * level * np.array([limit.speed for limit in self.limits])
        lift = THRESHOLDS.range_margin * np.array([limit.acceleration for limit in self.limits])
        length = np.abs(distance)
        times = [_PEAK_SPEED * length / speed, np.sqrt(_PEAK_ACCELERATION * length / lift)]
        return float(np.max(times))

    def add_move(self, begin: float, lasts: float, distance: np.ndarray) -> None:
        if lasts > 0:
            step = _evaluate_quintic_step((self.time - begin) / lasts)
            for order in range(3):
                self.values[order] += step[order][:, None] / lasts**order * distance

    def add_moves(self, until: float, rng: np.random.Generator, exciting: bool = True) -> float:
        """Adds moves from the middle and back to it; returns when they end, 0 without any.

        Exciting ones are of several speeds, some of only some joints, and none takes long.
        """
        speeds = THRESHOLDS.move_speeds if exciting else _AS_FAST_AS_CAN_BE
        longest = THRESHOLDS.max_move_time if exciting else np.inf
        now, here, turn = THRESHOLDS.pause_time, self.middle, 0
        while True:
            level = speeds[turn % len(speeds)]
            joins = rng.random(len(here)) < (0.5 if exciting and turn % 3 == 2 else 1.1)
            joins[rng.integers(len(here))] = True
            target = np.where(joins, self.draw_position(rng), here)
            needed = self.compute_move_time(target - here, level)
            target = here + (target - here) * min(1.0, longest / max(needed, 1e-9))
            lasts = self.compute_move_time(target - here, level)
            home = self.compute_move_time(self.middle - target)
            if now + lasts + home + 2 * THRESHOLDS.pause_time > until:
                break
            self.add_move(now, lasts, target - here)
            now, here, turn = now + lasts + THRESHOLDS.pause_time, target, turn + 1
        back = self.compute_move_time(self.middle - here)
        self.add_move(now, back, self.middle - here)
        return now + back + THRESHOLDS.pause_time if turn else 0.0

    def add_series(self, begin: float, rng: np.random.Generator) -> None:
        """Returns a sum of harmonics for each joint, faded in from `begin` and out to the end."""
        time, end = self.time, float(self.time[-1])
        lasts = end - begin
        fade = min(1.0, lasts / 3)
        lowest = max(THRESHOLDS.min_fundamental_hz, 1.0 / lasts)
        rise = _evaluate_quintic_step((time - begin) / fade)
        fall = _evaluate_quintic_step((time - (end - fade)) / fade)
        window = [(rise[k] - fall[k]) / fade**k for k in range(3)]
        for i, limit in enumerate(self.limits):
            series = np.zeros((3, time.size))
            for harmonic in range(1, THRESHOLDS.harmonics + 1):
                omega = 2 * np.pi * lowest * harmonic * round_to_ten_digits(rng.uniform(0.9, 1.1))
                phase = omega * (time - begin) + round_to_ten_digits(rng.uniform(0, 2 * np.pi))
                size = round_to_ten_digits(rng.uniform(0.5, 1.0)) / harmonic
                sine, cosine = compute_sine_and_cosine(phase)
                series += size * np.array([sine, omega * cosine, -(omega**2) * sine])
            (w, w1, w2), (x, x1, x2) = window, series
            shaped = np.array([w * x, w1 * x + w * x1, w2 * x + 2 * w1 * x1 + w * x2])
            bounds = ((limit.upper - limit.lower) / 2, limit.speed, limit.acceleration)
            peaks = np.max(np.abs(shaped), axis=1)
            shares = [bound / peak for bound, peak in zip(bounds, peaks, strict=True) if peak > 0]
            self.values[:, :, i] += shaped * THRESHOLDS.range_margin * min(shares, default=0.0)


def _evaluate_quintic_step(s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """0 before s = 0, 1 after s = 1, with two continuous derivatives between; and these."""
    x = np.clip(s, 0.0, 1.0)
    value = x * x * x * (10 - 15 * x + 6 * x**2)
    slope = 30 * x**2 * (1 - x) ** 2
    curvature = 60 * x * (1 - x) * (1 - 2 * x)
    return value, slope, curvature


# A commanded motion from a file: what `modeler excite` writes, or a log's commands.


_DEGREE = 5  # of the spline through positions where derivatives are not given
_FEWEST = _DEGREE + 1  # samples


def read_motion(path: str | Path, joints: Sequence[str]) -> Reference:
    """Returns the motion of a CSV or Parquet file, with its own samples.

    Columns by name: time, positions qc1.. (commanded) or else q1.., and qd1.., qdd1.. where all
    joints have them; else the derivatives of a spline of degree five through the positions.

    Args:
        path: .csv or .parquet.
        joints: names, in the order of the columns that are given back.

    Raises:
        DataError: no such file, a column that is missing or not a finite number, time that does
            not increase, too few samples.
    """
    path = Path(path)
    table = _read_table(path)
    time = _read_column(table, path, "time")
    if len(time) < _FEWEST:
        raise DataError(f"{path}: got {len(time)} samples; expected {_FEWEST} or more")
    if not np.all(np.diff(time) > 0.0):
        row = int(np.argmin(np.diff(time) > 0.0)) + 3
        raise DataError(f"{path}, row {row}: time does not increase; expected seconds in order")
    prefix = "qc" if all(f"qc{joint}" in table.column_names for joint in joints) else "q"
    path_of = {
        p: np.column_stack([_read_column(table, path, f"{p}{joint}") for joint in joints])
        for p in (prefix, "qd", "qdd")
        if p == prefix or (prefix == "q" and f"{p}{joints[0]}" in table.column_names)
    }
    q = path_of[prefix]
    measured = any(f"{p}{j}" in table.column_names for p in ("tau", "current") for j in joints)
    if {"qd", "qdd"} <= path_of.keys():
        return Reference(time - time[0], q, path_of["qd"], path_of["qdd"], True, measured)
    spline = make_interp_spline(time, q, k=_DEGREE)
    derivatives = spline.derivative()(time), spline.derivative(2)(time)
    return Reference(time - time[0], q, *derivatives, is_measured=measured)


def build_curve(motion: Reference) -> BPoly:
    """Builds polynomials of degree five through all that is given, from time 0."""
    ends = np.stack([motion.q, motion.qd, motion.qdd], axis=1)
    return BPoly.from_derivatives(motion.time, ends)


def resample_motion(motion: Reference, rate: float) -> Reference:
    """Returns motion at other samples: polynomials of degree five that meet all that is given."""
    curve = build_curve(motion)
    if motion.time[-1] * rate > MOST_SAMPLES:
        raise DataError(
            f"--motion: lasts {motion.time[-1]:.4g} s, {motion.time[-1] * rate:.3g} samples; "
            f"expected at most {MOST_SAMPLES:.0e}; take out its pauses, or lower --rate"
        )
    count = int(np.floor(motion.time[-1] * rate + 1e-9)) + 1
    time = np.arange(count) / rate
    at = np.minimum(time, motion.time[-1])
    return Reference(time, curve(at), curve.derivative()(at), curve.derivative(2)(at))


def _read_table(path: Path) -> pa.Table:
    try:
        content = read_file(path, THRESHOLDS.max_motion_bytes)
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); expected the file of a motion, or "
            "exciting or point-to-point"
        ) from None
    if path.suffix not in (".parquet", ".csv"):
        raise DataError(f"{path}: got suffix {path.suffix or '(none)'}; expected .csv or .parquet")
    try:
        if path.suffix == ".parquet":
            file = pq.ParquetFile(io.BytesIO(content))
            check_unpacked_size(path, 8 * file.metadata.num_rows * file.metadata.num_columns)
            return file.read()
        one_by_one = pacsv.ReadOptions(use_threads=False)  # which knows the row of an error
        return pacsv.read_csv(io.BytesIO(content), one_by_one)
    except (pa.ArrowException, OSError) as error:
        first = str(error).splitlines()[0]
        table = "CSV" if path.suffix == ".csv" else "Parquet file"
        raise DataError(
            f"{path}: cannot be read as a table of columns ({first}); correct it, or write the "
            f"{table} again"
        ) from None


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _read_column(table: pa.Table, path: Path, name: str) -> np.ndarray:
    if name not in table.column_names:
        raise DataError(
            f"{path}: no column {name}; got {', '.join(table.column_names[:12])}; expected time "
            "and q of every joint of the robot"
        )
    column = table[name].combine_chunks()
    if not len(column):
        raise DataError(f"{path}: got no rows; expected a motion of 6 samples or more")
    if pa.types.is_string(column.type):
        row = next((i for i, text in enumerate(column.to_pylist()) if not _is_number(text)), 0)
        raise DataError(
            f"{path}, row {row + 2}: {name} is {str(column[row])[:40]!r}; expected a number"
        )
    if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type)):
        raise DataError(f"{path}, column {name}: got {column.type}; expected numbers")
    values = column.cast(pa.float64()).to_numpy(zero_copy_only=False)
    if not np.all(np.abs(values) < THRESHOLDS.max_motion_number):
        row = int(np.argmax(~(np.abs(values) < THRESHOLDS.max_motion_number))) + 2
        raise DataError(
            f"{path}, row {row}: {name} is empty, or not below "
            f"{THRESHOLDS.max_motion_number:g}; expected a number"
        )
    return values


# The range of motion a simulated robot is given.


REVOLUTE = Limits(lower=-1.5, upper=1.5, speed=2.0, acceleration=8.0)
"""Where the robot file says nothing: rad, rad/s, rad/s2."""

PRISMATIC = Limits(lower=-0.3, upper=0.3, speed=0.5, acceleration=3.0)
"""Where the robot file says nothing: m, m/s, m/s2."""


def collect_motion_limits(
    robot: Robot, changes: Mapping[str, Limits] | None = None
) -> tuple[Limits, ...]:
    """Collects limits in the order of `robot.moving_joints`: `changes`, file, defaults.

    A robot with loops moves around its home by default, and less: it could not close far away.

    Raises:
        RobotError: limits of a joint that is not there, or an empty range.
    """
    stated = {**robot.limits, **(changes or {})}
    names = [joint.name for joint in robot.moving_joints]
    for name, limits in stated.items():
        where = f"robot {robot.name}, limits of joint {name}"
        if name not in names:
            raise RobotError(f"{where}: no such moving joint; expected one of {', '.join(names)}")
        values = (limits.lower, limits.upper, limits.speed, limits.acceleration)
        if not all(math.isfinite(value) for value in values):
            raise RobotError(f"{where}: got {values}; expected finite numbers")
        if limits.lower >= limits.upper:
            raise RobotError(
                f"{where}: got lower {limits.lower}, upper {limits.upper}; expected lower < upper"
            )
        if limits.speed <= 0 or limits.acceleration <= 0:
            raise RobotError(
                f"{where}: got speed {limits.speed}, acceleration {limits.acceleration}; "
                "expected both above 0"
            )
    joint_limits = []
    for joint in robot.moving_joints:
        usual = REVOLUTE if joint.is_revolute else PRISMATIC
        if robot.loops:
            home, reach = robot.home.get(joint.name, 0.0), THRESHOLDS.loop_range_share * usual.upper
            usual = Limits(home - reach, home + reach, usual.speed, usual.acceleration)
        joint_limits.append(stated.get(joint.name, usual))
    return tuple(joint_limits)
