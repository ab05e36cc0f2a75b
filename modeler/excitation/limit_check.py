"""Does a motion of a file keep to the limits of its joints?"""

import math
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.json import select_attributes
from modeler.excitation.motion import MotionBounds
from modeler.excitation.thresholds import THRESHOLDS


@dataclass(frozen=True)
class LimitExcess(ShortRepr):
    """Where a joint exceeds a limit most.

    Attributes:
        joint: name.
        what: "position" | "speed" | "acceleration" | "speed at the start" | "speed at the end".
        time: s, from the first sample on.
        value, limit: SI.
        unit: of them.
        step: (rad or m, s) of the largest step between two samples there; None for others.
    """

    joint: str
    what: str
    time: float
    value: float
    limit: float
    unit: str
    step: tuple[float, float] | None = None

    def format_line(self) -> str:
        """As a sentence."""
        step = ""
        if self.step is not None:
            distance, seconds = self.step
            step = f" ({distance:.3g} {self.unit.partition('/')[0]} in {1e3 * seconds:.3g} ms)"
        expected = "expected rest" if "speed at" in self.what else f"limit {self.limit:.4g}"
        return (
            f"joint {self.joint}, {self.time:.4g} s: {self.what} {self.value:.4g} {self.unit}"
            f"{step}, {expected}"
        )

    def to_json(self) -> dict[str, object]:
        """Plain data."""
        return select_attributes(self, "joint what time value limit unit")


def find_exceeded_limits(
    bounds: MotionBounds,
    units: tuple[str, ...],
    time: np.ndarray,
    q: np.ndarray,
    stated: tuple[np.ndarray, np.ndarray] | None,
) -> list[LimitExcess]:
    """Where each joint exceeds each of its limits most, first by time.

    Mean speeds over a window, and their mean change, are never above the largest ones between. A
    motion that begins or ends faster than its acceleration reaches in a window is not at rest.

    Args:
        bounds: limits.
        units: (J,) "rad" or "m".
        time: (n,) s.
        q: (n, J).
        stated: speeds and accelerations (n, J) of the file; None: it has none.
    """
    step = float(np.median(np.diff(time)))
    k = min(math.ceil(THRESHOLDS.derivative_window / step), (len(time) - 1) // 2)
    rounded = (
        10.0**-n
        for n in range(THRESHOLDS.max_file_digits)
        if np.allclose(q, q.round(n), 0.0, 1e-12)
    )
    digit = next(rounded, 0.0)
    v = (q[k:] - q[:-k]) / (time[k:] - time[:-k])[:, None]
    a = 2.0 * (v[k:] - v[:-k]) / (time[2 * k :] - time[: -2 * k])[:, None]
    excesses = []

    def check_limit(
        what: str, at: np.ndarray, values: np.ndarray, most: np.ndarray, per: str, slack: float
    ) -> None:
        for j in np.flatnonzero(
            np.abs(values).max(axis=0) > (1.0 + THRESHOLDS.limit_tolerance) * most + slack
        ):
            i = int(np.abs(values[:, j]).argmax())
            place, step, value = at[i], None, float(values[i, j])
            if values is v:
                ways = np.abs(np.diff(q[i : i + k + 1, j]))
                m = i + int(ways.argmax())
                place, step = time[m + 1], (float(ways.max()), float(time[m + 1] - time[m]))
                value = math.copysign(step[0] / step[1], value)
            excess = float(place), value, float(most[j]), units[j] + per, step
            excesses.append(LimitExcess(bounds.joints[j], what, *excess))

    reach = bounds.half_range
    for j in np.flatnonzero(
        (np.abs(q - bounds.mid_range) > (1.0 + THRESHOLDS.limit_tolerance) * reach).any(axis=0)
    ):
        i = int(np.abs(q[:, j] - bounds.mid_range[j]).argmax())
        limit = bounds.upper[j] if q[i, j] > bounds.mid_range[j] else bounds.lower[j]
        details = float(time[i]), float(q[i, j]), float(limit), units[j]
        excesses.append(LimitExcess(bounds.joints[j], "position", *details))
    speed, acceleration = bounds.speed, bounds.acceleration
    digits = digit / (k * step), 2.0 * digit / (k * step) ** 2
    check_limit("speed", time[k:], v, speed, "/s", digits[0])
    check_limit("acceleration", time[k:-k], a, acceleration, "/s2", digits[1])
    if stated is not None:
        change = np.diff(stated[0], axis=0) / np.diff(time)[:, None]
        check_limit("speed", time, stated[0], speed, "/s", 0.0)
        check_limit("acceleration", time, stated[1], acceleration, "/s2", 0.0)
        check_limit("acceleration", time[1:], change, acceleration, "/s2", digit / step)
    for end, at, value in (("start", time[:1], v[:1]), ("end", time[-1:], v[-1:])):
        check_limit(f"speed at the {end}", at, value, acceleration * k * step, "/s", digits[0])
    first = {(each.joint, each.what): each for each in reversed(excesses)}
    return sorted(first.values(), key=lambda each: each.time)
