"""Samples whose positions do not close the loops: told, and left out.

Noise, a filter's start-up or a slipping encoder take a few postures beyond what the robot reaches.
No torque belongs to them. The nearest posture that closes stands in for theirs, so that everything
that is evaluated along a log goes through, and their rows do not count.
"""

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.errors import LoopError
from modeler.observation.log import Log
from modeler.observation.motion import CAUSES, OPEN, Segment
from modeler.observation.prepare import Prepared

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

FEWEST = 0.1
"""Where a smaller share of the samples closes, the model is of another machine or other units."""


def nearest_closed(model: "CompiledModel", *postures: np.ndarray) -> np.ndarray | None:
    """(n,) the nearest sample, in time, whose postures all close; its own place where its own do.

    Args:
        model: the compiled robot.
        postures: (n, joints) each.

    Returns:
        None if there is no such sample.
    """
    places = np.arange(len(postures[0]))
    if model.spec.closure is None:
        return places
    closes = np.all([model.closing_status(q) == 0 for q in postures], axis=0)
    good = np.flatnonzero(closes)
    if not good.size:
        return None
    after = np.minimum(np.searchsorted(good, places), len(good) - 1)
    before = np.maximum(after - 1, 0)
    nearer = places - good[before] < np.abs(good[after] - places)
    return np.asarray(np.where(nearer, good[before], good[after]))


def without_open(
    model: "CompiledModel", logs: Sequence[Log], prepared: Prepared
) -> tuple[Prepared, tuple[tuple[float, ...], ...]]:
    """The segments with another posture where theirs does not close, and those times of each log.

    Raises:
        LoopError: fewer than a tenth of the samples close; says how many, and where the first.
    """
    times: list[list[float]] = [[] for _ in logs]
    if model.spec.closure is None:
        return prepared, tuple(() for _ in logs)
    segments = []
    for segment in prepared.segments:
        mended, open_ = closed(model, segment)
        segments.append(mended)
        times[segment.run] += segment.time[open_ & segment.whole].tolist()
    whole = sum(int(segment.whole.sum()) for segment in segments)
    count = sum(len(own) for own in times)
    if count > (1.0 - FEWEST) * whole:
        raise LoopError(_none(model, logs, prepared, times, whole))
    return dataclasses.replace(prepared, segments=tuple(segments)), tuple(map(tuple, times))


def closed(model: "CompiledModel", segment: Segment) -> tuple[Segment, np.ndarray]:
    """The segment with postures that close the loops, and (n,) True where its own does not."""
    if model.spec.closure is None:
        return segment, np.zeros(segment.samples, dtype=bool)
    nearest = nearest_closed(model, segment.q)
    if nearest is None:
        home = np.asarray(model.spec.closure.home)[list(model.spec.closure.given)]
        q, open_ = np.tile(home, (segment.samples, 1)), np.ones(segment.samples, dtype=bool)
    else:
        q, open_ = segment.q[nearest], nearest != np.arange(segment.samples)
    if not open_.any():
        return segment, open_
    lost, valid, cause = dict(segment.lost), segment.valid & ~open_[:, None], segment.cause
    newly = segment.valid & open_[:, None]
    lost[OPEN] = lost[OPEN] + np.sum(newly, axis=0)
    if cause is not None:
        cause = np.where(newly, np.int8(CAUSES.index(OPEN)), cause)
    mended = dataclasses.replace(segment, q=q, valid=valid, lost=lost, cause=cause)
    return mended, open_


def _none(
    model: "CompiledModel",
    logs: Sequence[Log],
    prepared: Prepared,
    times: Sequence[Sequence[float]],
    whole: int,
) -> str:
    run = next(run for run, own in enumerate(times) if own)
    first = times[run][0]
    segment = next(s for s in prepared.segments if s.run == run and first in s.time)
    where = ", ".join(f"{value:.6g}" for value in segment.q[segment.time == first][0])
    count = sum(len(own) for own in times)
    return (
        f"{logs[run].name}: the loops of {model.spec.robot} cannot be closed at {count} of {whole} "
        f"samples, first at {first:.6g} s; got ({where}); expected positions that the robot "
        "reaches from [home], in SI units; check units, zeros and the order of the columns"
    )
