"""The comparison as a table of plain text."""

import math
from typing import TYPE_CHECKING

from modeler.core.by_unit import WORDS
from modeler.core.table import aligned

if TYPE_CHECKING:
    from modeler.compare.comparison import Comparison, JointComparison

_HEAD = ("joint", "error", "rms", "largest", "at", "R2", "repeatable", "noise", "bias")
_LEFT = (0, 4)  # columns of text

METHODS = {
    "laps": "what returns in the other laps of the same log",
    "logs": "what returns in the other logs of the same motion",
    "smooth": "what smooth functions of the motion predict on stretches held out (no motion was "
    "made twice)",
}
"""How the repeatable part of a residual was found."""


def summary(comparison: "Comparison") -> str:
    """One line per joint, units in the table; then what the shares mean, and each log."""
    rows = [_HEAD, *(_row(item) for item in comparison.joints)]
    lines = aligned(rows, _LEFT)
    names = max((len(name) for name, _ in comparison.unjudged), default=0)
    width = max(7, names + 1, *(len(row[0]) + 2 for row in rows))
    lines += [f"{name:<{width}}not judged: {reason}" for name, reason in comparison.unjudged]
    if len(comparison.by_unit) == 1:
        lines.append(
            f"{'all':<{width}}{or_dash(comparison.relative_error, '.1%')}  of "
            f"{comparison.samples} samples"
        )
    else:  # N m and N add up to nothing
        lines += [
            f"{'all':<{width}}{or_dash(error, '.1%')}  of the {WORDS[unit]}s ({unit})"
            for unit, error in comparison.by_unit.items()
        ]
        lines.append(f"{comparison.samples} samples")
    lines += method_lines(comparison)
    if len(comparison.logs) > 1:
        lines += ["", *aligned(by_log(comparison), (0,))]
    return "\n".join(line.rstrip() for line in lines)


def share_text(share: float) -> str:
    """A share of the variance in percent, two digits and more: small ones matter here."""
    value = 100.0 * share
    if abs(value) >= 10.0:
        return f"{value:.1f}%"
    return f"{value:.2g}%" if abs(value) >= 1e-4 else "0%"


def method_lines(comparison: "Comparison") -> list[str]:
    """What the shares are of, and how they were found, by method."""
    methods = {item.shares.method for item in comparison.joints if item.shares is not None}
    text = "R2, repeatable, noise: shares of the torque's variance; repeatable is "
    return [f"{text}{METHODS[name]}" for name in METHODS if name in methods]


def or_dash(value: float, form: str) -> str:
    """A number, or a dash where it is not defined."""
    return format(value, form) if math.isfinite(value) else "-"


def _row(item: "JointComparison") -> tuple[str, ...]:
    unit, found = item.joint.effort_unit, item.shares
    return (
        item.joint.name,
        f"{item.relative_error:.1%}",
        f"{item.rms:.3g} {unit:<3}",
        f"{item.largest.value:.3g} {unit:<3}",
        f"{item.largest.time:.2f} s of {item.largest.log}",
        or_dash(item.r2, ".3f"),
        "-" if found is None else share_text(found.systematic),
        "-" if found is None else share_text(found.floor),
        f"{item.bias:.2g} {unit:<3}",
    )


def by_log(comparison: "Comparison", error: str = "error") -> list[list[str]]:
    """A head, and a row of each log; `error` is that of all joints together, by unit."""
    units = comparison.by_unit
    errors = [error] if len(units) == 1 else [f"{error} {unit}" for unit in units]
    names = [f"joint {name}" for name, _ in comparison.logs[0].joints]
    rows = [
        [
            item.log,
            str(item.samples),
            *(or_dash(error, ".1%") for error in item.by_unit.values()),
            *(or_dash(error, ".1%") for _, error in item.joints),
        ]
        for item in comparison.logs
    ]
    return [["log", "samples", *errors, *names], *rows]
