"""A look at windows of long logs, by which all is chosen that must be one choice for all rows."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.numerics.filters import spacing
from modeler.observation.chunk import chunk_rows, margin
from modeler.observation.chunks import Chosen
from modeler.observation.log import FINGER, Log
from modeler.observation.low_speed import FrictionShaft, shafts
from modeler.observation.observation import Observation, observed
from modeler.observation.prepare import Prepared, prepare, with_floors
from modeler.observation.processing import Processing
from modeler.observation.read import Ranges, Source, windows_joined

if TYPE_CHECKING:
    from modeler.runtime.model import CompiledModel

WINDOWS = 8
"""Windows of all logs together, at least one of each log."""

MOST_WINDOWS = 64
"""Logs that are looked at; of more, every so many."""

WINDOW = 16_384
"""Rows of a window, at least ..."""

SECONDS = 8.0
"""... and seconds, so that a fast logger shows a motion too ..."""

LONGEST = 65_536
"""... but no more rows than these."""

UNIT = 100.0
"""Ratio of time steps of two motions in a log that another unit of time makes: it is 1000 or so."""

_PLACES = (0.5, 0.25, 0.75, 0.1, 0.9, 0.4, 0.6)  # of a window in its part of a log
_TRAVEL = 1e-3  # rad or m: less is rest

Extremes = tuple[tuple[float, float], ...]


class WholeNeeded(DataError):
    """Only a log that is in memory as a whole can be fitted."""


@dataclass(frozen=True, eq=False)
class Survey:
    """What the windows show.

    Attributes:
        observation: of the windows, for all that needs rows side by side.
        prepared: what else was seen in the windows; without their samples.
        chosen: by log.
        places: of each log among those that were prepared; that of another where none is.
        windows: how many.
        rows: of them.
    """

    observation: Observation
    prepared: Prepared
    chosen: tuple[Chosen, ...]
    places: tuple[int, ...]
    windows: int
    rows: int


@dataclass(frozen=True, eq=False)
class KnownFacts:
    """What an earlier pass over the logs found, that the windows did not show.

    Attributes:
        floors: speed floors, by shaft that stood still in the windows.
        extremes: (J,) smallest and largest torque by log; none before the first pass.
    """

    floors: Mapping[str, float] = dataclasses.field(default_factory=dict)
    extremes: Mapping[int, Extremes] = dataclasses.field(default_factory=dict)


def survey(
    model: "CompiledModel",
    sources: Sequence[Source],
    processing: Processing,
    known: KnownFacts,
    rows: int = FINGER,
) -> Survey:
    """Looks at windows of the logs and chooses.

    Args:
        model: the compiled robot.
        sources: of the logs.
        processing: what is given is kept.
        known: of an earlier pass.
        rows: of a chunk, at least.

    Raises:
        DataError: a log is damaged.
        WholeNeeded: `observe` refuses the windows.
    """
    windows = [_windows(source, _count(sources, k)) for k, source in enumerate(sources)]
    looked = [k for k, own in enumerate(windows) if own]
    logs = [windows_joined(own) if own else None for own in windows]
    seen = [log for log in logs if log is not None]
    try:
        prepared = prepare(model.spec, seen, processing)
        observation = observed(model, seen, prepared)
    except (DataError, LoopError) as error:  # what is wrong here may be right elsewhere
        where = f"the {sum(len(own) for own in windows)} windows"
        raise WholeNeeded(f"{error}; found in {where} by which long logs are judged") from None
    chosen, parts = observation.report.processing, shafts(model)
    chosen = with_floors(chosen, {**(chosen.speed_floors or {}), **known.floors})
    places = tuple(looked.index(k) if k in looked else 0 for k in range(len(sources)))
    every = []
    for k, (source, at) in enumerate(zip(sources, places, strict=True)):
        log = logs[k] or source.window(0.5, WINDOW)
        every.append(_chosen((k, log), (prepared, at), chosen, parts, known.extremes.get(k), rows))
    count, rows_seen = sum(len(own) for own in windows), sum(log.rows for log in seen)
    prepared = dataclasses.replace(prepared, segments=(), pieces=())  # memory for the chunks
    return Survey(observation, prepared, tuple(every), places, count, rows_seen)


def _count(sources: Sequence[Source], k: int) -> int:
    """Windows of a log."""
    if len(sources) > MOST_WINDOWS:
        return int(k % -(-len(sources) // MOST_WINDOWS) == 0)
    total = sum(source.rows for source in sources)
    return max(1, round(WINDOWS * sources[k].rows / max(1, total)))


def _windows(source: Source, count: int) -> list[Log]:
    """Windows of a log, increasing in time."""
    if not count:
        return []
    first = source.window(0.5 / count, WINDOW)
    size = int(np.clip(round(SECONDS / first.step), WINDOW, LONGEST)) if first.rows > 1 else WINDOW
    if count * size > 0.7 * source.rows:
        return [source.window(0.0, max(size, min(source.rows, count * size)))]
    found: list[Log] = []
    for k in range(count):
        log = _moving(source, (k / count, (k + 1) / count), size)
        if not found or log.time[0] > found[-1].time[-1]:
            found.append(log)
    _check_unit(found)
    return found


def _check_unit(windows: Sequence[Log]) -> None:
    """Refuse a log whose time changes its unit: at one rate, its second part is gaps or years.

    A logger may be slow while the robot rests; windows of motion count.

    Raises:
        DataError: rows of two windows come at rates that no logger has both of.
    """
    moving = [log for log in windows if log.rows > 1 and _moves(log)]
    for log in moving[1:]:
        first, ratio = moving[0], log.step / moving[0].step
        if max(ratio, 1.0 / ratio) > UNIT:
            raise DataError(
                f"{log.name}: column time: a row every {first.step:.3g} s at {first.time[0]:.6g} s "
                f"and every {log.step:.3g} s at {log.time[0]:.6g} s; expected one unit, seconds, "
                "and about one rate; write the time of all rows in seconds, or split the file "
                "where it changes"
            )


def _moving(source: Source, part: tuple[float, float], size: int) -> Log:
    """A window in which something moves, in a part of a log; that in its middle if none does."""
    middle: Log | None = None
    for place in _PLACES:
        log = source.window(part[0] + place * (part[1] - part[0]), size)
        if _moves(log):
            return log
        middle = middle or log
    assert middle is not None
    return middle


def _moves(log: Log) -> bool:
    there = log.q[np.isfinite(log.q).all(axis=1)]
    return bool(len(there) and np.ptp(there, axis=0).max() > _TRAVEL)


def _chosen(
    place: tuple[int, Log],
    prepared: tuple[Prepared, int],
    processing: Processing,
    parts: tuple[FrictionShaft, ...],
    extremes: Extremes | None,
    rows: int,
) -> Chosen:
    """What is chosen for one log: its place and its windows; what was prepared, and where."""
    run, log = place
    whole, at = prepared
    if log.rows < 2:
        raise DataError(
            f"{log.name}: {log.rows} rows where it was looked at; expected a motion; leave it out"
        )
    step, cutoff = log.step, processing.parallel_cutoff
    assert cutoff is not None
    decimation = spacing(step, cutoff, processing.decimation)
    ranges = Ranges.of(log)
    beside = margin(processing, step)
    seen = tuple(zip(ranges.low[1].tolist(), ranges.high[1].tolist(), strict=True))
    return Chosen(
        run=run,
        processing=dataclasses.replace(processing, decimation=decimation),
        logged=whole.checks[at] is not None,
        usual=whole.usual[at],
        extremes=seen if extremes is None else extremes,
        shafts=parts,
        step=step,
        own=chunk_rows(beside, rows),
        beside=beside,
    )
