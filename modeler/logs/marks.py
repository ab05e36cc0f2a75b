"""Where in a log what is doubtful lies: stretches of its time."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from modeler.logs.guess import guess_role
from modeler.logs.inspect import GAP, HELD, LogInspection, find_usual_step

MOST = 100
"""Marks of one kind in one channel; of more, the longest."""

DRIVEN = ("tau", "current", "duty")
"""What has a limit of the drive; that a position stays at an end is as a rule rest."""

_NEAR = 5  # steps between two that are one


@dataclass(frozen=True)
class Mark:
    """A stretch of a log of which something is said.

    Attributes:
        kind: "gap", "back", "repeated", "missing", "limit" of what drives; of a robot also what
            none does: "spike", "frozen", "clipped", "wrap", "zero", "lost", "open".
        channel: that it is seen in.
        start, end: s; alike where it is one row.
        line: what it is.
    """

    kind: str
    channel: str
    start: float
    end: float
    line: str


def find_marks(seen: LogInspection) -> list[Mark]:
    """Gaps and faults of the clock, missing values, ends of a range at which a channel stays.

    Of a long log, of which not all rows are kept, the clock alone.
    """
    if seen.clock is None:
        return []
    marks = [*_mark_clock(seen)]
    if seen.time.size == seen.rows:
        marks += _mark_channels(seen)
    return keep_longest(marks)


def _mark_clock(seen: LogInspection) -> Iterator[Mark]:
    assert seen.clock is not None
    time, step = seen.steps
    usual, name = 1.0 / seen.clock.rate if seen.clock.rate > 0.0 else np.inf, seen.clock.column
    if seen.time.size == seen.rows:
        usual = find_usual_step(step, usual)
    for k in np.flatnonzero(step > GAP * usual):
        line = f"{name}: no rows for {step[k]:.4g} s"
        yield Mark("gap", name, float(time[k] - step[k]), float(time[k]), line)
    for k in np.flatnonzero(step < 0.0):
        line = f"{name} goes back by {-step[k]:.4g} s: sort or split the log"
        yield Mark("back", name, float(time[k]), float(time[k] - step[k]), line)
    for k in np.flatnonzero(step == 0.0):
        yield Mark("repeated", name, float(time[k]), float(time[k]), f"{name} stands twice")


def _mark_channels(seen: LogInspection) -> Iterator[Mark]:
    for channel, (name, values) in zip(seen.channels, seen.values.items(), strict=True):
        for start, end in _find_runs(np.isnan(values) & np.isfinite(seen.time), seen.time, 1):
            line = f"{channel.name} has no value for {end - start:.4g} s"
            yield Mark("missing", channel.name, start, end, line)
        for value, _ in channel.limits if guess_role(name) in DRIVEN else ():
            for start, end in _find_runs(values == value, seen.time, HELD):
                what = f"{value:.4g} {channel.unit}".rstrip()
                line = f"{channel.name} stays at its limit {what} for {end - start:.4g} s: clipped?"
                yield Mark("limit", channel.name, start, end, line)


def _find_runs(flags: np.ndarray, time: np.ndarray, least: int) -> Iterator[tuple[float, float]]:
    """First and last time of so many flagged rows one after the other; near ones are one."""
    rows = np.flatnonzero(flags)
    for run in np.split(rows, np.flatnonzero(np.diff(rows) > _NEAR) + 1):
        if run.size >= least:
            yield float(time[run[0]]), float(time[run[-1]])


def keep_longest(marks: Iterable[Mark]) -> list[Mark]:
    """In the order of time; of a kind in a channel the longest ones."""
    by: dict[tuple[str, str], list[Mark]] = {}
    for mark in marks:
        by.setdefault((mark.kind, mark.channel), []).append(mark)
    longest = (
        sorted(channel_marks, key=lambda one: one.start - one.end)[:MOST]
        for channel_marks in by.values()
    )
    return sorted(
        (one for channel_marks in longest for one in channel_marks), key=lambda one: one.start
    )
