"""A motion as a Fourier series, and what it must keep to: ranges, boxes, loops, torques."""

import math
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import DataError, LoopError
from modeler.runtime import CompiledModel

# What a motion must keep to.


@dataclass(frozen=True)
class Box:
    """Where the origin of a frame must stay, in frame 0.

    Attributes:
        frame: name of a moving row.
        row: its place among the moving rows, as `forward_kinematics` has them.
        lower, upper: x, y, z in m.
    """

    frame: str
    row: int
    lower: tuple[float, float, float]
    upper: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Bounds:
    """Limits of a motion, in the order of the manifest's joints, SI units.

    Attributes:
        joints: names.
        lower, upper: (J,) positions.
        speed, acceleration: (J,) largest ones.
        torque: (J,) largest ones, infinite where there is none.
        boxes: of frames.
        passive: places in u of joints that follow, with their lower and upper limits.
        home: (J,) where loops are closed from; None without loops.
    """

    joints: tuple[str, ...]
    lower: np.ndarray
    upper: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray
    torque: np.ndarray
    boxes: tuple[Box, ...] = ()
    passive: tuple[tuple[int, float, float], ...] = ()
    home: np.ndarray | None = None

    @property
    def middle(self) -> np.ndarray:
        """(J,) of the ranges."""
        return 0.5 * (self.lower + self.upper)

    @property
    def half(self) -> np.ndarray:
        """(J,) half of the ranges."""
        return 0.5 * (self.upper - self.lower)


def check_bounds(bounds: Bounds) -> None:
    """Nothing, if some motion may keep to them.

    Raises:
        DataError: names the joint, what was got and what is expected.
    """
    for j, joint in enumerate(bounds.joints):
        where = f"limits of joint {joint}"
        lower, upper = float(bounds.lower[j]), float(bounds.upper[j])
        if not (math.isfinite(lower) and math.isfinite(upper) and lower < upper):
            raise DataError(
                f"{where}: got lower {lower:g}, upper {upper:g}; expected two finite numbers, "
                "lower < upper"
            )
        for what in ("speed", "acceleration", "torque"):
            value = float(getattr(bounds, what)[j])
            if not value > 0.0 or (what != "torque" and not math.isfinite(value)):
                raise DataError(
                    f"{where}: got {what} {value:g}; expected a number above 0: a joint that may "
                    "not move excites nothing"
                )
        if bounds.home is not None and not lower <= bounds.home[j] <= upper:
            raise DataError(
                f"{where}: [home] {bounds.home[j]:g} is outside of {lower:g} to {upper:g}; loops "
                "are closed from home; expected limits around it"
            )
    for box in bounds.boxes:
        if any(not low < high for low, high in zip(box.lower, box.upper, strict=True)):
            ends = (", ".join(f"{value:g}" for value in end) for end in (box.lower, box.upper))
            raise DataError(
                f"box of frame {box.frame}: got ({') to ('.join(ends)}); expected x, y and z each "
                "lower < upper, in m"
            )


FARTHEST = 2.0
"""Times that of home: how fast the joints that follow may be, per speed of the motors."""

_STEP = 1e-5  # of the half ranges


@dataclass(frozen=True, eq=False)
class PostureLimits:
    """Shares of limits that hang on the positions alone.

    Loops stay away from singular postures by G of ud = G qd: near one, joints that follow are
    infinitely fast. Rows of G are taken together by unit, motors weighed by their ranges.

    Attributes:
        compiled: the robot.
        bounds: limits.
        kinds: (rows,) places of u by unit, those that follow.
        fastest: of the same groups, the size of G that counts as the limit.
    """

    compiled: CompiledModel
    bounds: Bounds
    kinds: tuple[np.ndarray, ...] = ()
    fastest: tuple[float, ...] = ()

    def shares(self, q: np.ndarray) -> np.ndarray:
        """(n, r) numbers that must stay between -1 and 1.

        Raises:
            LoopError: a posture does not close.
        """
        parts = []
        if self.kinds:
            parts.append(self.sizes(q) / np.array(self.fastest))
        if self.bounds.passive:
            u = self.compiled.close(q)
            for place, lower, upper in self.bounds.passive:
                parts.append((2.0 * u[:, place, None] - lower - upper) / (upper - lower))
        if self.bounds.boxes:
            poses = self.compiled.forward_kinematics(q)
            for box in self.bounds.boxes:
                low, high = np.array(box.lower), np.array(box.upper)
                parts.append((2.0 * poses[:, box.row, :, 3] - low - high) / (high - low))
        return np.hstack(parts) if parts else np.zeros((len(q), 0))

    def sizes(self, q: np.ndarray) -> np.ndarray:
        """(n, groups) sizes of G of the joints that follow."""
        G = self.compiled.coupling(q) * self.bounds.half
        return np.column_stack([
            np.sqrt(np.sum(G[:, places] ** 2, axis=(1, 2))) for places in self.kinds
        ])  # fmt: skip

    def pulled_back(self, q: np.ndarray, pull: np.ndarray) -> np.ndarray:
        """(n, J) derivative by q of a number whose derivative by `shares` is `pull`."""
        if pull.shape[1] == 0:
            return np.zeros_like(q)
        slope = np.empty_like(q)
        for j, size in enumerate((_STEP * self.bounds.half).tolist()):
            step = np.zeros(q.shape[1])
            step[j] = size
            try:
                change = self.shares(q + step) - self.shares(q - step)
            except LoopError:  # beyond the wall: the barrier has brought us as near as can be
                change = np.zeros_like(pull)
            slope[:, j] = np.sum(change * pull, axis=1) / (2.0 * size)
        return slope


def posture_of(compiled: CompiledModel, bounds: Bounds) -> PostureLimits:
    """What the positions of a robot must keep to.

    Raises:
        DataError: home itself is outside.
    """
    closure = compiled.spec.closure
    plain = PostureLimits(compiled, bounds)
    if closure is None or bounds.home is None:
        return plain
    driven = set(closure.given)
    places = [
        np.array([i for i, unit in enumerate(closure.units) if i not in driven and unit == kind])
        for kind in ("rad", "m")
    ]
    kinds = tuple(group for group in places if len(group))
    loops = PostureLimits(compiled, bounds, kinds, ())
    home = loops.sizes(bounds.home[None, :])[0]
    found = PostureLimits(compiled, bounds, kinds, tuple(FARTHEST * home))
    at_home = found.shares(bounds.home[None, :])
    if not np.abs(at_home).max(initial=0.0) < 1.0:
        raise DataError(
            f"{compiled.spec.robot}: [home] is outside of the boxes or of [limits] of joints that "
            "follow; expected limits around it"
        )
    return found


# Motions that are finite Fourier series, at rest where they begin and end.


DENSE = 32
"""Samples per period of the highest harmonic."""


@dataclass(frozen=True, eq=False)
class Series(Brief):
    """q_j(t) = V(t) x_j: periodic, and with no speed and no acceleration at t = 0.

    A finite Fourier series (Swevers et al. 1997, IEEE Trans. Robotics and Automation 13(5),
    eq. 8) of which two coefficients are given away: sum k b_k = 0 and sum k^2 a_k = 0. So it may be
    repeated, and a controller may also start it from rest and stop after it.

    Attributes:
        duration: of a period, s.
        harmonics: K, the highest.
        time: (n,) s, evenly over the period.
        values, slopes, bends: (n, 2 K - 1) V and its derivatives; the first column of V is 1.
    """

    duration: float
    harmonics: int
    time: np.ndarray
    values: np.ndarray
    slopes: np.ndarray
    bends: np.ndarray

    @property
    def room(self) -> float:
        """No value between the samples is larger than the largest at one over this.

        A trigonometric polynomial of degree K is at least cos(pi K / n) of its largest value at
        one of n even places: it falls no faster than a cosine of its own degree from its peak.
        """
        return float(np.cos(np.pi * self.harmonics / len(self.time)))

    def motion(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(n, joints) q, qd and qdd of (joints, 2 K - 1) coefficients."""
        return self.values @ x.T, self.slopes @ x.T, self.bends @ x.T


def series(
    duration: float, harmonics: int, times: np.ndarray | None = None, dense: int = DENSE
) -> Series:
    """The series over a period, at even times; at `times` (s) if given."""
    if times is None:
        count = dense * harmonics
        times = np.arange(count) * (duration / count)
    k = np.arange(1, harmonics + 1)
    omega = 2.0 * np.pi * k / duration
    phase = np.outer(times, omega)
    cosine, sine, none = np.cos(phase) / k, np.sin(phase) / k, np.zeros((len(times), 1))
    waves = (
        np.hstack([none + 1.0, cosine, sine]),
        np.hstack([none, -omega * sine, omega * cosine]),
        np.hstack([none, -(omega**2) * cosine, -(omega**2) * sine]),
    )
    resting = _resting(harmonics)
    return Series(duration, harmonics, times, *(wave @ resting for wave in waves))


def _resting(harmonics: int) -> np.ndarray:
    """(2 K + 1, 2 K - 1) orthonormal coefficients with no speed and acceleration at 0."""
    k = np.arange(1.0, harmonics + 1)
    basis = np.zeros((2 * harmonics + 1, 2 * harmonics - 1))
    basis[0, 0] = 1.0
    for begin, row in ((1, k), (1 + harmonics, np.ones(harmonics))):  # of a_k / k and b_k / k
        free = np.linalg.svd(row[None, :])[2][1:].T
        at = 1 if begin == 1 else harmonics
        basis[begin : begin + harmonics, at : at + harmonics - 1] = free
    return basis
