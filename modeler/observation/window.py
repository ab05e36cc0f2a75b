"""A piece of a log by time."""

import dataclasses

import numpy as np

from modeler.core.errors import DataError
from modeler.observation.log import Log
from modeler.observation.source import cut


def window(log: Log, start: float | None, end: float | None) -> Log:
    """The rows of `log` with start <= time < end, s; None leaves that side open.

    Raises:
        DataError: the window ends before it starts, or no rows are left.
    """
    low = -np.inf if start is None else start
    high = np.inf if end is None else end
    if high <= low:
        raise DataError(
            f"{log.name}: got the window {low:g}:{high:g}, which ends before it starts; expected "
            "START:END in seconds, START first"
        )
    rows = (log.time >= low) & (log.time < high)
    if not rows.any():
        raise DataError(
            f"{log.name}: no rows from {low:g} to {high:g} s; its times go from "
            f"{log.time[0]:g} to {log.time[-1]:g} s"
        )
    return dataclasses.replace(cut(log, rows), name=f"{log.name}@{_side(start)}:{_side(end)}")


def _side(time: float | None) -> str:
    return "" if time is None else f"{time:g}"
