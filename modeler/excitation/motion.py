"""What a motion must keep to: ranges, boxes, loops, torques, distances of links."""

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.errors import DataError, LoopError
from modeler.excitation.clearance import Clearance
from modeler.excitation.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel


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
class MotionBounds(ShortRepr):
    """Limits of a motion, in the order of the manifest's joints, SI units.

    Attributes:
        joints: names.
        lower, upper: (J,) positions.
        speed, acceleration: (J,) largest ones.
        torque: (J,) largest ones, infinite where there is none.
        boxes: of frames.
        passive: places in u of joints that follow, with their lower and upper limits.
        home: (J,) where loops are closed from; None without loops.
        clearance: what links keep from each other; None: it is not looked at.
        assumed: joints of which nobody has stated limits.
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
    clearance: Clearance | None = None
    assumed: tuple[str, ...] = ()

    @property
    def mid_range(self) -> np.ndarray:
        """(J,) of the ranges."""
        return 0.5 * (self.lower + self.upper)

    @property
    def half_range(self) -> np.ndarray:
        """(J,) half of the ranges."""
        return 0.5 * (self.upper - self.lower)


def check_bounds(bounds: MotionBounds) -> None:
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
    bounds: MotionBounds
    kinds: tuple[np.ndarray, ...] = ()
    fastest: tuple[float, ...] = ()

    def compute_shares(self, q: np.ndarray) -> np.ndarray:
        """(n, r) numbers that must stay between -1 and 1.

        Raises:
            LoopError: a posture does not close.
        """
        parts = [self.compute_stated_shares(q)]
        if self.bounds.clearance is not None:
            parts.append(self.bounds.clearance.compute_shares(self.compiled, q))
        return np.hstack(parts)

    def compute_stated_shares(self, q: np.ndarray) -> np.ndarray:
        """(n, r) those of loops, joints that follow and boxes."""
        parts = []
        if self.kinds:
            parts.append(self.compute_coupling_sizes(q) / np.array(self.fastest))
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

    def compute_coupling_sizes(self, q: np.ndarray) -> np.ndarray:
        """(n, groups) sizes of G of the joints that follow."""
        G = self.compiled.coupling(q) * self.bounds.half_range
        return np.column_stack(
            [np.sqrt(np.sum(G[:, places] ** 2, axis=(1, 2))) for places in self.kinds]
        )

    def pull_back_gradient(self, q: np.ndarray, pull: np.ndarray) -> np.ndarray:
        """(n, J) derivative by q of a number whose derivative by `compute_shares` is `pull`."""
        slope, steps, clearance = (
            np.zeros_like(q),
            THRESHOLDS.posture_step * self.bounds.half_range,
            self.bounds.clearance,
        )
        if clearance is not None:
            first = pull.shape[1] - len(clearance.solids.pairs)
            clearance_pull, pull = pull[:, first:], pull[:, :first]
            with suppress(LoopError):  # as below
                slope += clearance.pull_back_gradient(self.compiled, q, clearance_pull, steps)
        for j, size in enumerate(steps.tolist() if pull.shape[1] else ()):
            step = np.zeros(q.shape[1])
            step[j] = size
            try:
                change = self.compute_stated_shares(q + step) - self.compute_stated_shares(q - step)
            except LoopError:  # beyond the wall: the barrier has brought us as near as can be
                change = np.zeros_like(pull)
            slope[:, j] += np.sum(change * pull, axis=1) / (2.0 * size)
        return slope


def build_posture_limits(compiled: CompiledModel, bounds: MotionBounds) -> PostureLimits:
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
    home = loops.compute_coupling_sizes(bounds.home[None, :])[0]
    limits = PostureLimits(compiled, bounds, kinds, tuple(THRESHOLDS.max_coupling_ratio * home))
    at_home = limits.compute_shares(bounds.home[None, :])
    if not np.abs(at_home).max(initial=0.0) < 1.0:
        raise DataError(
            f"{compiled.spec.robot}: [home] is outside of the boxes or of [limits] of joints that "
            "follow; expected limits around it"
        )
    return limits
