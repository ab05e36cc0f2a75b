"""What a motion must keep to."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError


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
        _check_box(box.frame, box.lower, box.upper)


def _check_box(frame: str, lower: Sequence[float], upper: Sequence[float]) -> None:
    if any(not low < high for low, high in zip(lower, upper, strict=True)):
        raise DataError(
            f"box of frame {frame}: got {_three(lower)} to {_three(upper)}; expected x, y and z "
            "each lower < upper, in m"
        )


def _three(values: Sequence[float]) -> str:
    return "(" + ", ".join(f"{value:g}" for value in values) + ")"
