"""Rows that do not count, and gaps between rows, as shaded stretches of time."""

import numpy as np

from modeler.compare.prediction import Prediction
from modeler.observation.masks import MASKS, WHY
from modeler.observation.segments import runs
from modeler.pictures.picture import (
    COLOR_NAMES,
    PALE_BLUE,
    PALE_BROWN,
    PALE_GREEN,
    PALE_ORANGE,
    PALE_PINK,
    PALE_YELLOW,
    Span,
)

GAP = "no rows"
OTHER = "left out"
_COLORS = {
    "low speed": PALE_BLUE,
    "torque at its limit": PALE_ORANGE,
    "no good value": PALE_PINK,
    "impossible derivative": PALE_GREEN,
    "filter end": PALE_YELLOW,
    "loops open": PALE_PINK,
    GAP: PALE_YELLOW,
    OTHER: PALE_BROWN,
}
_WHY = WHY | {
    GAP: "a gap in the log, with the start-up of the filter on either side",
    OTHER: "left out of this comparison",
}
_CLOSE = 1.0 / 1500.0  # of the axis: stretches that no screen shows apart are drawn as one


def masked_spans(
    prediction: Prediction, j: int, time: np.ndarray, rows: np.ndarray
) -> tuple[Span, ...]:
    """The stretches of time of joint j that do not count, by reason.

    Args:
        prediction: with its masks.
        j: index of the joint.
        time: (n,) s, of all rows on the axis that is drawn.
        rows: numbers of the rows that are drawn, ascending.
    """
    if rows.size < 2:
        return ()
    half = 0.5 * _spacing(prediction, time)
    close = _CLOSE * float(np.ptp(time[rows]))
    reasons = _reasons(prediction, j)[rows]
    whole = prediction.segment[rows]
    found = []
    for name in _COLORS:
        ends = _gaps(prediction, time, rows, half) if name == GAP else [
            (time[rows[first]] - half, time[rows[last]] + half)
            for first, last in _runs(reasons == name, whole)
        ]  # fmt: skip
        if ends:
            found.append(Span(name, _joined(np.array(ends), close), _COLORS[name]))
    return tuple(found)


def told_masks(prediction: Prediction, j: int) -> str:
    """Which colour means what, and how many rows it takes; "" where every row counts."""
    reasons, rows = _reasons(prediction, j), prediction.time.size
    told = [
        f"{COLOR_NAMES[color]}, {name}: {_WHY[name]} ({int(np.sum(reasons == name))} of {rows} "
        "rows)"
        for name, color in _COLORS.items()
        if np.any(reasons == name)
    ]
    if _gaps(prediction, prediction.time, np.arange(rows), 0.0):
        told.append(f"{COLOR_NAMES[_COLORS[GAP]]}, {GAP}: {_WHY[GAP]}")
    return f"Shaded rows do not count: {'; '.join(told)}." if told else ""


def _reasons(prediction: Prediction, j: int) -> np.ndarray:
    """(n,) names; "" where a row counts."""
    used, masks = prediction.used[:, j], prediction.masks
    if masks is None:
        return np.where(used, "", OTHER)
    names = np.array([*MASKS, OTHER])  # -1, a row that counts for its model, is the last
    return np.where(used, "", names[masks[:, j]])


def _runs(flags: np.ndarray, whole: np.ndarray) -> list[tuple[int, int]]:
    """First and last of each run of True within one segment."""
    pieces = np.split(np.arange(len(flags)), np.flatnonzero(np.diff(whole)) + 1)
    return [(int(own[a]), int(own[b - 1])) for own in pieces for a, b in runs(flags[own])]


def _gaps(
    prediction: Prediction, time: np.ndarray, rows: np.ndarray, half: float
) -> list[tuple[float, float]]:
    """Between segments of one log."""
    segment, run = prediction.segment[rows], prediction.run[rows]
    at = np.flatnonzero((np.diff(segment) != 0) & (np.diff(run) == 0))
    ends = [(time[rows[k]] + half, time[rows[k + 1]] - half) for k in at]
    return [(start, end) for start, end in ends if end > start]


def _spacing(prediction: Prediction, time: np.ndarray) -> float:
    steps = np.diff(time)[np.diff(prediction.segment) == 0]
    return float(np.median(steps)) if steps.size else 0.0


def _joined(ends: np.ndarray, close: float) -> np.ndarray:
    """(k, 2) intervals, those nearer than `close` made one."""
    apart = np.flatnonzero(ends[1:, 0] - ends[:-1, 1] > close) + 1
    first = np.concatenate([[0], apart])
    last = np.concatenate([apart - 1, [len(ends) - 1]])
    return np.column_stack([ends[first, 0], ends[last, 1]])
