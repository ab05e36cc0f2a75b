"""Where a joint fails: velocity regions and the worst moment."""

import math
from dataclasses import dataclass

import numpy as np

from modeler.compare.prediction import Prediction
from modeler.core.brief import Brief
from modeler.residuals.spectrum import spans

AROUND_ZERO = 0.05  # of the joint's own largest speed
FAST = 0.4
WINDOW = 0.5  # s

REGIONS = ("fast -", "slow -", "around zero", "slow +", "fast +")


@dataclass(frozen=True)
class Region(Brief):
    """Residual of one joint in one region of its velocity."""

    name: str
    low: float  # rad/s or m/s
    high: float  # rad/s or m/s
    samples: int
    time_share: float  # of the samples that count
    energy_share: float  # of the summed squared residual
    rms: float  # N m or N; 0 without samples
    bias: float  # mean residual, N m or N; 0 without samples


@dataclass(frozen=True)
class Window:
    """The stretch of one log with the largest summed squared residual."""

    log: str
    segment: int
    start: float  # s, as in the log
    end: float  # s
    energy_share: float  # of the joint's summed squared residual
    time_share: float  # of the joint's samples that count
    rms: float  # N m or N


def velocity_regions(qd: np.ndarray, e: np.ndarray) -> tuple[Region, ...]:
    """The five regions of REGIONS, thresholds as fractions of the largest speed.

    Args:
        qd: velocity of the rows that count, (n,).
        e: residual of the same rows, (n,).
    """
    top = float(np.abs(qd).max())
    edges = np.array([-FAST, -AROUND_ZERO, AROUND_ZERO, FAST]) * top
    which = np.searchsorted(edges, qd, side="right")
    which[np.abs(qd) <= AROUND_ZERO * top] = 2  # also a joint that never moves
    limits = np.array([-top, *edges, top])
    total = float(e @ e)
    regions = []
    for index, name in enumerate(REGIONS):
        part = e[which == index]
        energy = float(part @ part)
        regions.append(
            Region(
                name=name,
                low=float(limits[index]),
                high=float(limits[index + 1]),
                samples=part.size,
                time_share=part.size / e.size,
                energy_share=energy / total if total else 0.0,
                rms=float(np.sqrt(energy / part.size)) if part.size else math.nan,
                bias=float(part.mean()) if part.size else math.nan,
            )
        )
    return tuple(regions)


def worst_window(prediction: Prediction, e: np.ndarray, width: float = WINDOW) -> Window:
    """The window of `width` seconds, inside one segment, with the largest residual energy.

    Args:
        prediction: for log, segment and time of the rows.
        e: residual of one joint on all rows, (n,), NaN where the row does not count.
        width: s; a shorter segment is one window.
    """
    square = np.nan_to_num(e) ** 2
    energy = np.concatenate(([0.0], np.cumsum(square)))
    counted = np.concatenate(([0], np.cumsum(np.isfinite(e))))
    best, first, last = -1.0, 0, 0
    for span in spans(prediction.segment):
        time = prediction.time[span]
        # half a sample of slack, so that rounding of the time stamps does not cost a row
        slack = 0.5 * float(np.median(np.diff(time))) if time.size > 1 else 0.0
        stop = span.start + np.searchsorted(time, time + width - slack, side="right")
        inside = energy[stop] - energy[span.start : span.stop]
        top = int(np.argmax(inside))
        if inside[top] > best:
            best, first, last = float(inside[top]), span.start + top, int(stop[top])
    rows = int(counted[last] - counted[first])
    total = float(energy[-1])
    return Window(
        log=prediction.logs[prediction.run[first]],
        segment=int(prediction.segment[first]),
        start=float(prediction.time[first]),
        end=float(prediction.time[last - 1]),
        energy_share=best / total if total else 0.0,
        time_share=rows / int(counted[-1]),
        rms=float(np.sqrt(best / rows)) if rows else 0.0,
    )
