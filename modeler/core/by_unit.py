"""Relative errors of joints whose efforts have different units: N m and N are never one number."""

import math
from collections.abc import Iterable, Mapping

WORDS = {"N m": "torque", "N": "force"}
"""What an effort is called, by its unit."""

Part = tuple[str, float, float]
"""Of one joint: unit of its effort, summed squared residual, summed squared measured effort."""


def errors_by_unit(parts: Iterable[Part]) -> dict[str, float]:
    """||residual|| / ||effort|| over all joints of one unit, by unit; N m first, NaN without any.

    Args:
        parts: of the joints.
    """
    sums: dict[str, tuple[float, float]] = {}
    for unit, left, size in parts:
        before = sums.get(unit, (0.0, 0.0))
        sums[unit] = (before[0] + left, before[1] + size)
    return {
        unit: math.sqrt(left / size) if size > 0.0 else math.nan
        for unit, (left, size) in sorted(sums.items(), reverse=True)
    }


def effort(errors: Mapping[str, float]) -> str:
    """What the joints of these units exert: "torque", "force", or "torque and force"."""
    return " and ".join(WORDS[unit] for unit in errors) or "torque"


def told_by_unit(errors: Mapping[str, float], form: str = "{:.3f} %") -> str:
    """Errors as text: "2.1 % of the torques (N m), 3 % of the forces (N)"; of one unit: "2.1 %".

    Args:
        errors: from `errors_by_unit`.
        form: of a percentage.
    """
    told = {
        unit: form.format(100.0 * error) if math.isfinite(error) else "-"
        for unit, error in errors.items()
    }
    if len(told) == 1:
        return next(iter(told.values()))
    return ", ".join(f"{text} of the {WORDS[unit]}s ({unit})" for unit, text in told.items())


POOLED = (
    "relative_error pools all rows as numbers, N m and N alike: ||measured - predicted|| / "
    "||measured||; by_unit holds one error per unit"
)
"""How the pooled error of a robot with both units comes about."""
