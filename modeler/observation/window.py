"""A piece of a log by time."""

import dataclasses

import numpy as np

from modeler.core.errors import DataError
from modeler.observation.log import Log


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

    def cut(values: np.ndarray | None) -> np.ndarray | None:
        return None if values is None else values[rows]

    return dataclasses.replace(
        log,
        name=f"{log.name}@{_side(start)}:{_side(end)}",
        time=log.time[rows],
        q=log.q[rows],
        tau=log.tau[rows],
        qd=cut(log.qd),
        qdd=cut(log.qdd),
        commanded=cut(log.commanded),
        segment=cut(log.segment),
        extra={name: values[rows] for name, values in log.extra.items()},
    )


def _side(time: float | None) -> str:
    return "" if time is None else f"{time:g}"
