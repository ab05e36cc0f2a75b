"""A piece of a log by time."""

import dataclasses
from collections import Counter

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.observation.chunk import chunks
from modeler.observation.log import FINGER, Log, finger, fingerprint_of
from modeler.observation.read import FileSource, Ranges, cut, joined
from modeler.observation.tally import missing as missing_of


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


def read_part(source: FileSource, spec: ModuleSpec, start: float | None, end: float | None) -> Log:
    """What `window` makes of the whole log. All rows are read: a piece has the log's fingerprint.

    Args:
        source: of a log of more than `log.LONG` rows.
        spec: the robot's manifest.
        start: s; None leaves that side open.
        end: the same.

    Raises:
        DataError: the log is damaged, or has no rows there.
    """
    low, high = -np.inf if start is None else start, np.inf if end is None else end
    kept, fingers, missing = list[Log](), list[bytes](), Counter[str]()
    ranges: Ranges | None = None
    first, last = np.inf, -np.inf
    for chunk in chunks(source, FINGER, 0):
        log = cut(chunk.log, chunk.own)
        fingers.append(finger(log.time, log.q, log.tau))
        missing.update({name: count for name, count in missing_of(chunk).items() if count})
        ranges = Ranges.of(log) if ranges is None else ranges.over(Ranges.of(log))
        first, last = min(first, float(log.time[0])), float(log.time[-1])
        if low < high and log.time[0] < high and last >= low:
            kept.append(log)
    if low < high and not kept:
        raise DataError(
            f"{source.name}: no rows from {low:g} to {high:g} s; its times go from {first:g} to "
            f"{last:g} s"
        )
    assert ranges is not None
    ranges.check(source.place[0], spec)
    log = joined(kept) if kept else log
    notes = (*log.notes, *ranges.doubts(log.step, spec))
    whole = dataclasses.replace(
        log, notes=notes, content=fingerprint_of(fingers), missing=dict(missing)
    )
    return window(whole, start, end)
