"""When the periods of a fleet are: days by their names or clocks, or just their order."""

import datetime
import re
from collections.abc import Sequence
from typing import Literal

import numpy as np

from modeler.fleet.naming import natural
from modeler.fleet.summary import LogSummary

Unit = Literal["days", "periods"]

_DATE = re.compile(
    r"(?<!\d)(\d{4})[-_.]?(\d{2})[-_.]?(\d{2})(?:[T _-](\d{2})[-:_h]?(\d{2})(?:[-:_m]?(\d{2}))?)?"
    r"(?!\d)"
)
_DAY = 86400.0  # s


def in_time(summaries: Sequence[LogSummary]) -> tuple[list[LogSummary], np.ndarray, Unit]:
    """The logs machine after machine in order of time, when each is, and in what that counts.

    Dates in the names of all periods rule; else the clocks of the logs, where those of each machine
    do not overlap (logs that each begin at 0 do); else the names in natural order.
    """
    dates = [date_of(each.named.period) for each in summaries]
    if all(date is not None for date in dates):
        days = np.array([0.0 if date is None else date.timestamp() for date in dates]) / _DAY
        if _apart(summaries, days, days):
            return _ordered(summaries, days, "days")
    starts, ends = (np.array([each.span[k] for each in summaries]) / _DAY for k in (0, 1))
    if _several(summaries) and _apart(summaries, starts, ends):
        return _ordered(summaries, starts, "days")
    keys = sorted({each.named.period for each in summaries}, key=natural)
    places = np.array([float(keys.index(each.named.period)) for each in summaries])
    return _ordered(summaries, places, "periods")


def date_of(period: str) -> datetime.datetime | None:
    """The day, and hour if it is there, that a name says, as 2026-03-01 or 20260301_0930."""
    found = _DATE.search(period)
    if found is None:
        return None
    parts = [int(part) for part in found.groups() if part is not None]
    try:
        year, month, day, hour, minute, second = (*parts, 0, 0, 0)[:6]
        return datetime.datetime(year, month, day, hour, minute, second, tzinfo=datetime.UTC)
    except ValueError:
        return None


def _several(summaries: Sequence[LogSummary]) -> bool:
    machines = [each.named.machine for each in summaries]
    return len(set(machines)) < len(machines)


def _apart(summaries: Sequence[LogSummary], starts: np.ndarray, ends: np.ndarray) -> bool:
    """True if no two logs of a machine overlap, or begin together."""
    machines = np.array([each.named.machine for each in summaries])
    for machine in set(machines):
        own = np.flatnonzero(machines == machine)
        order = own[np.argsort(starts[own], kind="stable")]
        later, earlier = starts[order][1:], ends[order][:-1]
        if np.any(later <= starts[order][:-1]) or np.any(later < earlier):
            return False
    return True


def _ordered(
    summaries: Sequence[LogSummary], at: np.ndarray, unit: Unit
) -> tuple[list[LogSummary], np.ndarray, Unit]:
    order = sorted(
        range(len(summaries)), key=lambda k: (natural(summaries[k].named.machine), at[k])
    )
    return [summaries[k] for k in order], at[order] - at.min(), unit
