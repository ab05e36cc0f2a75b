"""A temperature that moves along with what drifts may be its cause."""

from collections.abc import Sequence

import numpy as np

from modeler.fleet.result import Warmth
from modeler.fleet.summary import LogSummary

_SPAN = 2.0  # K; less is no warming
_ALONG = 0.8  # of what the shape of a finding explains, that a line in the temperature explains too
_LEAST = 0.5  # of the variance of the values
_OTHERS = 3  # machines that warmed too, from which they say whether warmth does it
_ENOUGH = 0.5  # of the change, that others must show over the same warming

Machine = tuple[Sequence[LogSummary], np.ndarray]
"""Logs of a machine, and (p,) values of a quantity."""


def warmth_of(
    own: Machine, joint: str | None, line: np.ndarray, others: Sequence[Machine]
) -> Warmth | None:
    """The temperature beside the values of one machine; None where a log has none.

    It moves along if a straight line in it explains nearly as much as the shape that was found. If
    other machines warm too, it may be the cause only if they change with it.

    Args:
        own: the machine.
        joint: whose; its own column `temperature<joint>` rules over `temperature`.
        line: (p,) what the finding says that its values do.
        others: the same quantity of other machines.
    """
    degrees, values = _degrees(own[0], joint), own[1]
    if degrees is None:
        return None
    span, total = float(np.ptp(degrees)), float(np.var(values))
    told = span > 0.0 and total > 0.0
    correlation = float(np.corrcoef(degrees, values)[0, 1]) if told else np.nan
    shape = 1.0 - float(np.var(values - line)) / total if told else 1.0
    along = span >= _SPAN and correlation**2 >= max(_LEAST, _ALONG * shape)
    slopes = [slope for other in others if (slope := _slope(other, joint, 0.5 * span)) is not None]
    shared = None
    if along and len(slopes) >= _OTHERS:
        change = float(np.polyfit(degrees, values, 1)[0])
        shared = bool(np.median(slopes) / change >= _ENOUGH)
    return Warmth(float(degrees.min()), float(degrees.max()), correlation, along, shared)


def _slope(machine: Machine, joint: str | None, least: float) -> float | None:
    """Change a kelvin of a machine that warms so much."""
    degrees = _degrees(machine[0], joint)
    if degrees is None or float(np.ptp(degrees)) < max(least, _SPAN):
        return None
    return float(np.polyfit(degrees, machine[1], 1)[0])


def _degrees(logs: Sequence[LogSummary], joint: str | None) -> np.ndarray | None:
    """(p,) temperatures of the logs; None if one has none."""
    found = [_of_joint(log, joint) for log in logs]
    known = [degree for degree in found if degree is not None]
    return np.array(known) if len(known) == len(found) else None


def _of_joint(log: LogSummary, joint: str | None) -> float | None:
    """Its temperature; of a robot with one column for all, that; of no joint, the mean of all."""
    found = log.temperatures
    if joint is not None and joint in found:
        return found[joint]
    if "" in found:
        return found[""]
    return float(np.mean(list(found.values()))) if found and joint is None else None
