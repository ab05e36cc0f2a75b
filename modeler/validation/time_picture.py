"""One joint against time: measured, predicted, residual, and a close look at the worst window."""

from dataclasses import replace

import numpy as np

from modeler.core.figure import (
    BLACK,
    COLOR_NAMES,
    ORANGE,
    PALE,
    SHADE,
    SKY,
    VERMILLION,
    Band,
    Curve,
    Panel,
    Picture,
    Series,
    Span,
    Style,
    thin_curves,
)
from modeler.core.table import WORDS
from modeler.regression import MASKS, WHY, find_runs
from modeler.validation.comparison import WINDOW, JointComparison
from modeler.validation.prediction import DEVIATIONS, Prediction, compute_residual

# Rows that do not count, and gaps between rows, as shaded stretches of time.


GAP = "no rows"
OTHER = "left out"
_COLORS = {
    "low speed": PALE["blue"],
    "torque at its limit": PALE["orange"],
    "no good value": PALE["pink"],
    "impossible derivative": PALE["green"],
    "filter end": PALE["yellow"],
    "loops open": PALE["pink"],
    GAP: PALE["yellow"],
    OTHER: PALE["brown"],
}
_WHY = WHY | {
    GAP: "a gap in the log, with the start-up of the filter on either side",
    OTHER: "left out of this comparison",
}
_CLOSE = 1.0 / 1500.0  # of the axis: stretches that no screen shows apart are drawn as one


def find_masked_spans(
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
    steps = np.diff(time)[np.diff(prediction.segment) == 0]
    half = 0.5 * float(np.median(steps)) if steps.size else 0.0
    close = _CLOSE * float(np.ptp(time[rows]))
    reasons = _find_mask_reasons(prediction, j)[rows]
    whole = prediction.segment[rows]
    spans = []
    for name in _COLORS:
        ends = _find_gaps(prediction, time, rows, half) if name == GAP else [
            (time[rows[first]] - half, time[rows[last]] + half)
            for first, last in _find_runs(reasons == name, whole)
        ]  # fmt: skip
        if ends:
            spans.append(Span(name, _join_intervals(np.array(ends), close), _COLORS[name]))
    return tuple(spans)


def describe_masks(prediction: Prediction, j: int) -> str:
    """Which colour means what, and how many rows it takes; "" where every row counts."""
    reasons, rows = _find_mask_reasons(prediction, j), prediction.time.size
    sentences = [
        f"{COLOR_NAMES[color]}, {name}: {_WHY[name]} ({int(np.sum(reasons == name))} of {rows} "
        "rows)"
        for name, color in _COLORS.items()
        if np.any(reasons == name)
    ]
    if _find_gaps(prediction, prediction.time, np.arange(rows), 0.0):
        sentences.append(f"{COLOR_NAMES[_COLORS[GAP]]}, {GAP}: {_WHY[GAP]}")
    return f"Shaded rows do not count: {'; '.join(sentences)}." if sentences else ""


def _find_mask_reasons(prediction: Prediction, j: int) -> np.ndarray:
    """(n,) names; "" where a row counts."""
    used, masks = prediction.used[:, j], prediction.masks
    if masks is None:
        return np.where(used, "", OTHER)
    names = np.array([*MASKS, OTHER])  # -1, a row that counts for its model, is the last
    return np.where(used, "", names[masks[:, j]])


def _find_runs(flags: np.ndarray, whole: np.ndarray) -> list[tuple[int, int]]:
    """First and last of each run of True within one segment."""
    pieces = np.split(np.arange(len(flags)), np.flatnonzero(np.diff(whole)) + 1)
    return [
        (int(piece[a]), int(piece[b - 1])) for piece in pieces for a, b in find_runs(flags[piece])
    ]


def _find_gaps(
    prediction: Prediction, time: np.ndarray, rows: np.ndarray, half: float
) -> list[tuple[float, float]]:
    """Between segments of one log."""
    segment, run = prediction.segment[rows], prediction.run[rows]
    at = np.flatnonzero((np.diff(segment) != 0) & (np.diff(run) == 0))
    ends = [(time[rows[k]] + half, time[rows[k + 1]] - half) for k in at]
    return [(start, end) for start, end in ends if end > start]


def _join_intervals(ends: np.ndarray, close: float) -> np.ndarray:
    """(k, 2) intervals, those nearer than `close` made one."""
    apart = np.flatnonzero(ends[1:, 0] - ends[:-1, 1] > close) + 1
    first = np.concatenate([[0], apart])
    last = np.concatenate([apart - 1, [len(ends) - 1]])
    return np.column_stack([ends[first, 0], ends[last, 1]])


_MEASURED = Style(BLACK, width=1.1)
_PREDICTED = Style(ORANGE, width=1.6, opacity=0.9)
_RESIDUAL = Style(VERMILLION, width=1.0)
_BAND = Style(SKY, opacity=0.45)


def draw_time_picture(prediction: Prediction, item: JointComparison) -> Picture:
    """Two rows sharing time: torques above, residual below; all logs left, worst window right."""
    window, time = item.worst, prediction.time
    is_in_segment = prediction.segment == window.segment
    margin = 0.5 * WINDOW
    near = is_in_segment & (time >= window.start - margin) & (time <= window.end + margin)
    running, label, marks = concatenate_time(prediction)
    start = float(running[is_in_segment & (time == window.start)][0])
    title = "All logs" if len(np.unique(prediction.run)) > 1 else "Whole log"
    left = _build_column(prediction, item, np.arange(time.size), running, title, label)
    right = _build_column(
        prediction, item, np.flatnonzero(near), time, f"Worst {WINDOW} s",
        f"time in {window.log} [s]", banded=True,
    )  # fmt: skip
    here, close = (start, start + window.end - window.start), (window.start, window.end)
    name = item.joint.name
    return Picture(
        name=f"joint_{name}_time",
        title=f"Joint {name}: measured and predicted torque",
        caption=" ".join(_write_caption(prediction, item)),
        panels=tuple(
            (replace(all_logs, marks=marks, shade=here), replace(worst, shade=close))
            for all_logs, worst in zip(left, right, strict=True)
        ),
        heights=(0.58, 0.42),
        widths=(0.68, 0.32),
        height=440,
        shared_time=True,
    )


def _write_caption(prediction: Prediction, item: JointComparison) -> list[str]:
    what = WORDS[item.joint.effort_unit]
    lines = [
        f"Above: measured ({_MEASURED.description}) and predicted ({_PREDICTED.description}) "
        f"{what}; where you "
        f"see no {_MEASURED.description}, they agree. Below ({_RESIDUAL.description}): the "
        "difference, on its "
        f"own, finer scale. Shaded {COLOR_NAMES[SHADE]} from top to bottom: the {WINDOW} s "
        "with the largest squared residual, enlarged on the right."
    ]
    if prediction.sigma is not None:
        lines.append(
            f"Broad {_BAND.description} there: two standard deviations of the predicted {what} on "
            "either "
            "side, from the covariance of the fitted parameters alone: 95 % where the model is "
            "right; it knows nothing of effects that the model lacks."
        )
    masks = describe_masks(prediction, item.index)
    return [*lines, masks] if masks else lines


def concatenate_time(
    prediction: Prediction,
) -> tuple[np.ndarray, str, tuple[tuple[float, str], ...]]:
    """Time of all rows on one axis, (n,) s, its label, and where each log begins.

    One log keeps its own time; several are put one after the other, each starting where the
    one before ended.
    """
    if len(np.unique(prediction.run)) == 1:
        return prediction.time, f"time in {prediction.logs[prediction.run[0]]} [s]", ()
    whole = np.empty_like(prediction.time, dtype=float)
    marks, offset = [], 0.0
    for run in np.unique(prediction.run):
        rows = prediction.run == run
        log_time = prediction.time[rows]
        whole[rows] = log_time - log_time.min() + offset
        marks.append((offset, prediction.logs[run]))
        offset += float(log_time.max() - log_time.min())
    return whole, "time, logs one after the other [s]", tuple(marks)


def break_at_gaps(
    segment: np.ndarray, x: np.ndarray, y: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The curve with a NaN between segments, so that no line is drawn across a gap."""
    places = np.flatnonzero(np.diff(segment)) + 1
    return np.insert(x, places, x[places]), np.insert(y, places, np.nan)


def _build_column(
    prediction: Prediction,
    item: JointComparison,
    rows: np.ndarray,
    time: np.ndarray,
    title: str,
    label: str,
    banded: bool = False,
) -> tuple[Panel, Panel]:
    unit, joint = item.joint.effort_unit, item.index
    curves = (
        prediction.measured[rows, joint].astype(float),
        prediction.predicted[rows, joint].astype(float),
        compute_residual(prediction)[rows, joint],
    )
    plot_rows = thin_curves(curves)
    labels = ("measured", "predicted", "residual")
    styles = (_MEASURED, _PREDICTED, _RESIDUAL)
    series: list[Series] = []
    for text, values, style in zip(labels, curves, styles, strict=True):
        x, y = break_at_gaps(
            prediction.segment[rows][plot_rows], time[rows][plot_rows], values[plot_rows]
        )
        series.append(Curve(text, x, y, style))
    spans = find_masked_spans(prediction, joint, time, rows)
    bands = _build_bands(prediction, joint, rows[plot_rows], time) if banded else ()
    return (
        Panel(title, label, f"{WORDS[unit]} [{unit}]", (*bands[:1], *series[:2]), spans=spans),
        Panel(f"{title}: residual", label, f"residual [{unit}]", (*bands[1:], series[2]), zero=True,
              spans=spans),
    )  # fmt: skip


def _build_bands(
    prediction: Prediction, joint: int, rows: np.ndarray, time: np.ndarray
) -> tuple[Band, ...]:
    """About the prediction, and about zero."""
    if prediction.sigma is None:
        return ()
    half = DEVIATIONS * prediction.sigma[rows, joint]
    bands = []
    for middle in (prediction.predicted[rows, joint], np.zeros(rows.size)):
        x, low = break_at_gaps(prediction.segment[rows], time[rows], middle - half)
        _, high = break_at_gaps(prediction.segment[rows], time[rows], middle + half)
        bands.append(Band("95 % band of the prediction", x, low, high, _BAND))
    return tuple(bands)
