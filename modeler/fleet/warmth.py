"""A temperature that moves along with what drifts may be its cause."""

from collections.abc import Sequence

import numpy as np

from modeler.fleet.result import Warmth
from modeler.fleet.summary import LogSummary

_SPAN = 2.0  # K; less is no warming
_ALONG = 0.5  # of the variance of the values that a straight line in the temperature explains


def warmth_of(logs: Sequence[LogSummary], joint: str | None, values: np.ndarray) -> Warmth | None:
    """The temperature beside the values of one machine; None where a log has none.

    Args:
        logs: of the machine.
        joint: whose; its own column `temperature<joint>` rules over `temperature`.
        values: (p,) of a quantity, log by log.
    """
    degrees = [_of_joint(log, joint) for log in logs]
    known = np.array([degree for degree in degrees if degree is not None])
    if len(known) < len(logs):
        return None
    span = float(np.ptp(known))
    both = span > 0.0 and float(np.ptp(values)) > 0.0
    correlation = float(np.corrcoef(known, values)[0, 1]) if both else 0.0
    along = span >= _SPAN and correlation**2 >= _ALONG
    return Warmth(float(known.min()), float(known.max()), correlation, along)


def _of_joint(log: LogSummary, joint: str | None) -> float | None:
    """Its temperature; of a robot with one column for all, that; else the mean of all."""
    found = log.temperatures
    if joint is not None and joint in found:
        return found[joint]
    if "" in found:
        return found[""]
    return float(np.mean(list(found.values()))) if found and joint is None else None
