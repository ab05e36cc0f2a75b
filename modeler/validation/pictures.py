"""Pictures of a comparison: torques and residual over time, over a coordinate, by joint."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from modeler.core import figure as fig
from modeler.core.table import WORDS, format_percent
from modeler.regression import MASKS, WHY, find_runs
from modeler.validation.comparison import METHODS, REGIONS, WINDOW, Comparison, JointComparison
from modeler.validation.prediction import Prediction, compute_residual
from modeler.validation.residual_structure import (
    COORDINATES,
    ResidualStructure,
    convert_orders,
    evaluate_coordinate,
    find_order_peaks,
    format_coordinate_unit,
    select_coordinates,
)
from modeler.validation.thresholds import THRESHOLDS

# Rows that do not count, and gaps between rows, as shaded segments of time.


GAP = "no rows"
OTHER = "left out"
_COLORS = {
    "low speed": fig.PALE["blue"],
    "torque at its limit": fig.PALE["orange"],
    "no good value": fig.PALE["pink"],
    "impossible derivative": fig.PALE["green"],
    "filter end": fig.PALE["yellow"],
    "loops open": fig.PALE["pink"],
    "push": fig.PALE["orange"],
    "unknown state": fig.PALE["blue"],
    GAP: fig.PALE["yellow"],
    OTHER: fig.PALE["brown"],
}
_WHY = WHY | {
    GAP: "a gap in the log, with the start-up of the filter on either side",
    OTHER: "left out of this comparison",
}
_CLOSE = 1.0 / 1500.0  # of the axis: segments that no screen shows apart are drawn as one


def find_masked_spans(
    prediction: Prediction, j: int, time: np.ndarray, rows: np.ndarray
) -> tuple[fig.Span, ...]:
    """Finds the time spans of joint j that do not count, by reason.

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
        ends = (
            _find_gaps(prediction, time, rows, half)
            if name == GAP
            else [
                (time[rows[first]] - half, time[rows[last]] + half)
                for first, last in _find_runs(reasons == name, whole)
            ]
        )
        if ends:
            spans.append(fig.Span(name, _join_intervals(np.array(ends), close), _COLORS[name]))
    return tuple(spans)


def describe_masks(prediction: Prediction, j: int) -> str:
    """Describes the reason of each colour and its number of rows; "" where every row counts."""
    reasons, rows = _find_mask_reasons(prediction, j), prediction.time.size
    sentences = [
        f"{fig.COLOR_NAMES[color]}, {name}: {_WHY[name]} ({int(np.sum(reasons == name))} of {rows} "
        "rows)"
        for name, color in _COLORS.items()
        if np.any(reasons == name)
    ]
    if _find_gaps(prediction, prediction.time, np.arange(rows), 0.0):
        sentences.append(f"{fig.COLOR_NAMES[_COLORS[GAP]]}, {GAP}: {_WHY[GAP]}")
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
    return [(int(rows[a]), int(rows[b - 1])) for rows in pieces for a, b in find_runs(flags[rows])]


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


_MEASURED = fig.Style(fig.BLACK, width=1.1)
_PREDICTED = fig.Style(fig.ORANGE, width=1.6, opacity=0.9)
_RESIDUAL = fig.Style(fig.VERMILLION, width=1.0)
_BAND = fig.Style(fig.SKY, opacity=0.45)


def draw_time_picture(prediction: Prediction, item: JointComparison) -> fig.Picture:
    """Draws torques above, residual below; all logs left, worst window right."""
    window, time = item.worst, prediction.time
    is_in_segment = prediction.segment == window.segment
    margin = 0.5 * WINDOW
    near = is_in_segment & (time >= window.start - margin) & (time <= window.end + margin)
    running, label, marks = concatenate_time(prediction)
    start = float(running[is_in_segment & (time == window.start)][0])
    title = "All logs" if len(np.unique(prediction.run)) > 1 else "Whole log"
    left = _build_column(prediction, item, np.arange(time.size), running, title, label)
    right = _build_column(
        prediction,
        item,
        np.flatnonzero(near),
        time,
        f"Worst {WINDOW} s",
        f"time in {window.log} [s]",
        banded=True,
    )
    here, close = (start, start + window.end - window.start), (window.start, window.end)
    name = item.joint.name
    return fig.Picture(
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
        f"{what}; where you see no {_MEASURED.description}, they agree. Below "
        f"({_RESIDUAL.description}): the difference, on its own, finer scale. Shaded "
        f"{fig.COLOR_NAMES[fig.SHADE]} from top to bottom: the {WINDOW} s with the largest squared "
        "residual, enlarged on the right."
    ]
    if prediction.sigma is not None:
        lines.append(
            f"Broad {_BAND.description} there: two standard deviations of the predicted {what} on "
            "either side, from the covariance of the fitted parameters alone: 95 % where the model "
            "is right; it knows nothing of effects that the model lacks."
        )
    masks = describe_masks(prediction, item.index)
    return [*lines, masks] if masks else lines


def concatenate_time(
    prediction: Prediction,
) -> tuple[np.ndarray, str, tuple[tuple[float, str], ...]]:
    """Returns the time of all rows on one axis, (n,) s, its label, and where each log begins.

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
    """Returns the curve with a NaN between segments, so that no line crosses a gap."""
    places = np.flatnonzero(np.diff(segment)) + 1
    return np.insert(x, places, x[places]), np.insert(y, places, np.nan)


def build_torque_panels(
    title: str,
    label: str,
    unit: str,
    above: Sequence[fig.Series],
    below: Sequence[fig.Series],
    **both: Any,
) -> tuple[fig.Panel, fig.Panel]:
    """Builds the panels of torques over time: measured and predicted above, residuals below.

    Args:
        title: of the panel above.
        label: of the time.
        unit: of the effort of the joint.
        above: what is drawn of the torques.
        below: what is drawn of the residuals.
        both: other fields of either panel.
    """
    return (
        fig.Panel(title, label, f"{WORDS[unit]} [{unit}]", tuple(above), **both),
        fig.Panel(
            f"{title}: residual" if title else "",
            label,
            f"residual [{unit}]",
            tuple(below),
            zero=True,
            **both,
        ),
    )


def build_time_curve(
    label: str, segment: np.ndarray, time: np.ndarray, values: np.ndarray, style: fig.Style
) -> fig.Curve:
    """Builds a curve over time that no line carries over a gap between segments."""
    return fig.Curve(label, *break_at_gaps(segment, time, values), style)


def _build_column(
    prediction: Prediction,
    item: JointComparison,
    rows: np.ndarray,
    time: np.ndarray,
    title: str,
    label: str,
    banded: bool = False,
) -> tuple[fig.Panel, fig.Panel]:
    joint = item.index
    curves = (
        prediction.measured[rows, joint].astype(float),
        prediction.predicted[rows, joint].astype(float),
        compute_residual(prediction)[rows, joint],
    )
    shown = fig.thin_curves(curves)
    segment, t = prediction.segment[rows][shown], time[rows][shown]
    labels = ("measured", "predicted", "residual")
    styles = (_MEASURED, _PREDICTED, _RESIDUAL)
    *above, below = (
        build_time_curve(text, segment, t, values[shown], style)
        for text, values, style in zip(labels, curves, styles, strict=True)
    )
    spans = find_masked_spans(prediction, joint, time, rows)
    bands = _build_bands(prediction, joint, rows[shown], time) if banded else ()
    torques: list[fig.Series] = [*bands[:1], *above]
    residuals: list[fig.Series] = [*bands[1:], below]
    unit = item.joint.effort_unit
    return build_torque_panels(title, label, unit, torques, residuals, spans=spans)


def _build_bands(
    prediction: Prediction, joint: int, rows: np.ndarray, time: np.ndarray
) -> tuple[fig.Band, ...]:
    """About the prediction, and about zero."""
    if prediction.sigma is None:
        return ()
    half = THRESHOLDS.band_deviations * prediction.sigma[rows, joint]
    bands = []
    for middle in (prediction.predicted[rows, joint], np.zeros(rows.size)):
        x, low = break_at_gaps(prediction.segment[rows], time[rows], middle - half)
        _, high = break_at_gaps(prediction.segment[rows], time[rows], middle + half)
        bands.append(fig.Band("95 % band of the prediction", x, low, high, _BAND))
    return tuple(bands)


# Pictures of a comparison: residuals against coordinates, overview, overlay, shares.


_DOTS = 700
_BINS = 24
_CLOUD = fig.Style(fig.GREY, width=2.6, opacity=0.45)
_MEAN = fig.Style(fig.BLUE, width=1.6)
_BACK = fig.Style(fig.VERMILLION, width=1.6)
_FLOOR = fig.Style(fig.ORANGE, width=1.2, dash=True)
_WAVES = fig.Style(fig.BLUE, width=0.8)
_ACROSS = 3  # panels side by side


def draw_residual_picture(prediction: Prediction, item: JointComparison) -> fig.Picture:
    """Draws a panel for each coordinate of the logs, then both spectra."""
    drawn = [
        _build_coordinate_panel(prediction, item, coordinate.id, coordinate.label)
        for coordinate in select_coordinates(prediction, item.index)
        if coordinate.id != "direction"
    ]
    drawn += [_build_spectrum_panel(item), _build_order_panel(item)]
    heated = any(panel.title.startswith("Temperature") for panel in drawn)
    drawn += [_EMPTY] * (-len(drawn) % _ACROSS)
    rows = [tuple(drawn[k : k + _ACROSS]) for k in range(0, len(drawn), _ACROSS)]
    name = item.joint.name
    return fig.Picture(
        name=f"joint_{name}_residual",
        title=f"Joint {name}: does the residual still have structure?",
        caption=f"{_FIRST}{_HEATED if heated else ''} {_LAST}",
        panels=tuple(rows),
        height=310 * len(rows),
    )


_EMPTY = fig.Panel("", "", "", ())


_FIRST = (
    f"{_CLOUD.description.capitalize()}: samples. {_MEAN.description.capitalize()}: mean of the "
    "residual in each bin, whiskers two standard errors (from the spread between separate passes "
    f"through the bin; none where there was only one). A {_MEAN.description} line that leaves zero "
    "by more than its whiskers is a pattern the model does not have: a step at zero velocity looks "
    "like Coulomb friction, a slope like viscous friction, a wave over position like gravity or "
    "ripple, a slope over acceleration like inertia, a curve that starts anew at every reversal "
    "(travel) like presliding."
)
_HEATED = (
    f" Over temperature, {_MEAN.description} is motion in the positive and {_BACK.description} in "
    "the negative direction: friction that changes moves them apart or together."
)
_LAST = (
    "The percentage is the share of the residual variance that such a curve predicts on motion not "
    "used to draw it; of a temperature, what it adds to the direction of motion. A flat spectrum "
    "is noise, a narrow peak over frequency an oscillation, a narrow peak over waves per turn "
    "something that turns: teeth, magnets, rollers. Waves per turn of the motor are those per turn "
    "of the joint over the gear ratio, which a robot file does not hold."
)


def compute_binned_means(x: np.ndarray, e: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Computes means of x and e and two standard errors in up to 24 bins of x.

    Consecutive samples share their noise, so the standard error comes from the spread between
    separate passes through the bin: s^2 = G/(G-1) sum_g (sum_{i in g} (e_i - mean))^2 / n^2 with
    G passes g. A bin with one pass has no whisker (NaN).

    Args:
        x: coordinate, (n,), in time order.
        e: residual, (n,).
    """
    even = np.linspace(x.min(), x.max(), _BINS // 2 + 1)
    dense = np.quantile(x, np.linspace(0.0, 1.0, _BINS // 2 + 1))
    edges = np.unique(np.concatenate((even, dense)))
    which = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, max(edges.size - 2, 0))
    count = np.bincount(which)
    filled = np.flatnonzero(count >= THRESHOLDS.min_bin_samples)
    count = np.maximum(count, 1)
    mean = np.bincount(which, e) / count
    starts = np.concatenate(([0], np.flatnonzero(np.diff(which)) + 1))
    deviation = np.add.reduceat(e - mean[which], starts)
    passes = np.bincount(which[starts], minlength=count.size)
    scatter = np.bincount(which[starts], deviation**2, minlength=count.size)
    correction = np.where(passes > 1, passes / np.maximum(passes - 1, 1), np.nan)
    error = 2.0 * np.sqrt(correction * scatter) / count
    centre = np.bincount(which, x) / count
    return centre[filled], mean[filled], error[filled]


def _build_coordinate_panel(
    prediction: Prediction, item: JointComparison, coordinate: str, label: str
) -> fig.Panel:
    rows = prediction.used[:, item.index]
    e = (prediction.measured - prediction.predicted)[rows, item.index]
    if coordinate == "time":
        whole, _, marks = concatenate_time(prediction)
        x, label = whole[rows], "time, all logs"
    else:
        x, marks = evaluate_coordinate(prediction, item.index, coordinate)[rows], ()
    title = label[0].upper() + label[1:]
    if item.structure is not None:
        title = f"{title}: {format_percent(item.structure.get_share(coordinate))}"
    if coordinate == "temperature":
        means = _average_by_direction(x, e, prediction.qd[rows, item.index])
    else:
        means = (build_means("", x, e, _MEAN),)
    return build_residual_panel(
        title,
        f"{label} [{format_coordinate_unit(prediction, item.index, coordinate)}]",
        item.joint.effort_unit,
        (build_cloud("samples", x, e, _CLOUD, _DOTS), *means),
        tuple((place, "") for place, _ in marks[1:]),
    )


def build_residual_panel(
    title: str,
    label: str,
    unit: str,
    series: Sequence[fig.Series],
    marks: tuple[tuple[float, str], ...] = (),
) -> fig.Panel:
    """Builds the panel of a residual over a coordinate, whose label has a unit."""
    return fig.Panel(title, label, f"residual [{unit}]", tuple(series), marks=marks, zero=True)


def build_cloud(
    label: str, x: np.ndarray, e: np.ndarray, style: fig.Style, most: int
) -> fig.Points:
    """Builds at most so many samples of a residual as dots."""
    shown = fig.thin_points(x, e, most)
    return fig.Points(label, x[shown], e[shown], style)


def build_means(label: str, x: np.ndarray, e: np.ndarray, style: fig.Style) -> fig.Means:
    """Builds the means of bins of a residual, with two standard errors."""
    return fig.Means(f"{label} mean, 2 standard errors".strip(), *compute_binned_means(x, e), style)


def _average_by_direction(x: np.ndarray, e: np.ndarray, qd: np.ndarray) -> tuple[fig.Means, ...]:
    """A line of means for either direction of motion that occurs."""
    ways = (
        ("moving in the positive direction", qd > 0.0, _MEAN),
        ("moving in the negative direction", qd < 0.0, _BACK),
    )
    return tuple(
        fig.Means(text, *compute_binned_means(x[direction_rows], e[direction_rows]), style)
        for text, direction_rows, style in ways
        if direction_rows.any()
    )


def _build_spectrum_panel(item: JointComparison) -> fig.Panel:
    unit = item.joint.effort_unit
    spectrum = item.spectrum
    title, shown = "Spectrum", (np.array([np.nan]), np.array([np.nan]))
    if spectrum is not None:
        shown = spectrum.frequency, spectrum.density
        title += f": {format_percent(spectrum.peak_share)} of the power near {spectrum.peak:.3g} Hz"
    return fig.Panel(
        title=title,
        x_label="frequency [Hz]",
        y_label=f"density [({unit})^2/Hz]",
        series=(fig.Curve("residual", *shown, _MEAN),),
        scale="log",
    )


def _build_order_panel(item: JointComparison) -> fig.Panel:
    unit, nothing = item.joint.effort_unit, np.array([np.nan])
    title, per = "Order spectrum", "turn" if item.joint.unit == "rad" else "m"
    if item.orders is None:
        x, y, floor = nothing, nothing, nothing
    else:
        x, _ = convert_orders(item.orders, item.joint.unit)
        y, floor = item.orders.amplitude, item.orders.floor
        plot_rows = fig.thin_curves((y,))
        x, y, floor = x[plot_rows], y[plot_rows], floor[plot_rows]
        order_peaks = find_order_peaks(item.orders, item.joint.unit)
        if order_peaks:
            title += f": {order_peaks[0].waves:.4g} waves per {per}"
    return fig.Panel(
        title=title,
        x_label=f"waves per {per} of the joint [1/{per}]",
        y_label=f"amplitude [{unit}]",
        series=(fig.Curve("residual", x, y, _WAVES), fig.Curve("floor", x, floor, _FLOOR)),
        scale="log",
    )


# All joints at once: how large the errors are, where, and what they follow.


_READABLE = 8.0  # percent: a shorter segment of a bar has no room for its number


def draw_overview_picture(comparison: Comparison) -> fig.Picture:
    """Draws relative errors, velocity regions, variance shares, coordinates and other joints."""
    names = tuple(item.joint.name for item in comparison.joints)
    errors = np.array([100.0 * item.relative_error for item in comparison.joints])
    bars = fig.Bars(
        "relative error", names, errors, tuple(f"{e:.1f}" for e in errors), fig.Style(fig.BLUE)
    )
    where, regions = "Where: share of squared residual [%]", (_build_region_heatmap(comparison),)
    error = fig.Panel("Relative error", "joint", "||residual|| / ||torque|| [%]", (bars,))
    panels = [(error, fig.Panel(where, "velocity", "joint", regions))]
    if any(item.shares is not None for item in comparison.joints):
        panels.append(build_share_panels(comparison))
    if any(item.structure is not None for item in comparison.joints):
        single, across = _build_share_heatmap(comparison), _build_cross_joint_heatmap(comparison)
        title = "Follows the velocity of ... [%]"
        first = fig.Panel("Follows its own ... [%]", "coordinate", "joint", (single,))
        panels.append((first, fig.Panel(title, "joint or motor moving", "joint", (across,))))
    return fig.Picture(
        name="overview",
        title="All joints",
        caption=_write_overview_caption(comparison),
        panels=tuple(panels),
        height=len(panels) * max(260, 120 + 44 * len(names)),
    )


def _write_overview_caption(comparison: Comparison) -> str:
    methods = {item.shares.method for item in comparison.joints if item.shares is not None}
    how = "; ".join(METHODS[name] for name in METHODS if name in methods)
    return (
        "Relative error: unexplained share of each joint's own torque or force. Variance: of it, "
        "and of what is left alone; without that panel, too few samples show. "
        + (f"Repeatable is {how}; noise is the rest. " if how else "")
        + "Where: in which velocity region the squared residual sits, and in brackets the share of "
        "the samples there; fast is beyond 40 %, around zero within 5 % of the joint's own top "
        "speed. Follows: share of the residual variance that a curve over that coordinate predicts "
        "on motion not used to fit it; noise gives 0. Coordinates move together: shares overlap. "
        "Where the velocity of another joint or motor beats that of the joint itself, look for a "
        "motor that turns with several joints: its friction follows the speed of the motor, and "
        "that is a sum of joint speeds."
    )


def _build_region_heatmap(comparison: Comparison) -> fig.Heat:
    energy = np.array([[r.energy_share for r in item.regions] for item in comparison.joints])
    texts = tuple(
        tuple(
            f"{format_percent(r.energy_share)} ({format_percent(r.time_share)})"
            for r in item.regions
        )
        for item in comparison.joints
    )
    names = tuple(item.joint.name for item in comparison.joints)
    return fig.Heat("share of squared residual", REGIONS, names, 100.0 * energy, texts, top=100.0)


def _build_share_heatmap(comparison: Comparison) -> fig.Heat:
    held = {
        coordinate.id
        for item in comparison.joints
        for coordinate in select_coordinates(comparison.prediction, item.index)
    }
    names = [coordinate.id for coordinate in COORDINATES if coordinate.id in held]
    columns = (*names, "all motion")
    return _build_heatmap(
        comparison,
        columns,
        lambda structure: [*(structure.get_share(name) for name in names), structure.own_motion],
    )


def _build_cross_joint_heatmap(comparison: Comparison) -> fig.Heat:
    prediction = comparison.prediction
    columns = (
        *(f"joint {info.name}" for info in prediction.joints),
        *(f"motor {motor.name}" for motor in prediction.motors),
    )
    return _build_heatmap(
        comparison,
        columns,
        lambda structure: [share for _, share in (*structure.other_joints, *structure.motors)],
    )


def _build_heatmap(
    comparison: Comparison,
    columns: tuple[str, ...],
    shares: Callable[[ResidualStructure], list[float]],
) -> fig.Heat:
    """Shares of each joint's residual; nothing where too few samples show."""
    joints = comparison.joints
    values = np.array(
        [
            [np.nan] * len(columns) if item.structure is None else shares(item.structure)
            for item in joints
        ]
    )
    texts = tuple(tuple("" if np.isnan(v) else f"{100 * v:.0f}" for v in row) for row in values)
    names = tuple(item.joint.name for item in joints)
    return fig.Heat("explained share", columns, names, 100.0 * values, texts, top=100.0)


def build_share_panels(comparison: Comparison) -> tuple[fig.Panel, fig.Panel]:
    """Builds the shares of the torque's variance, and those of the residual's."""
    items = [item for item in comparison.joints if item.shares is not None]
    names = tuple(item.joint.name for item in items)
    variance_shares = [item.shares for item in items if item.shares is not None]
    repeats = np.array([100.0 * each.repeatable_share for each in variance_shares])
    # a prediction worse than a constant explains nothing: the rest is then all there is
    explained = np.array([100.0 * max(0.0, each.explained_share) for each in variance_shares])
    left = 100.0 - explained
    systematic = left * repeats / 100.0
    repeatable, first = "repeatable, not explained", [("explained", explained, fig.BLUE)]
    whole = [(repeatable, systematic, fig.VERMILLION), ("noise", left - systematic, fig.SLATE)]
    rest = [(repeatable, repeats, fig.VERMILLION), ("noise", 100.0 - repeats, fig.SLATE)]
    title, label = "Variance of the torque [%]", "share of the variance [%]"
    return (
        fig.Panel(title, "joint", label, _build_stacked_bars(names, first + whole)),
        fig.Panel(
            "Variance that is not explained [%]",
            "joint",
            "share of the residual [%]",
            _build_stacked_bars(names, rest),
        ),
    )


def _build_stacked_bars(
    names: tuple[str, ...], parts: list[tuple[str, np.ndarray, str]]
) -> tuple[fig.Bars, ...]:
    series, base = [], np.zeros(len(names))
    for label, values, colour in parts:
        texts = tuple(f"{value:.1f}" if value >= _READABLE else "" for value in values)
        series.append(fig.Bars(label, names, values, texts, fig.Style(colour), base))
        base = base + values
    return tuple(series)


# The residuals of several models over each other, and who gains where.


_MOST = 2500  # points of a curve


def draw_overlay_picture(
    names: Sequence[str], predictions: Sequence[Prediction], j: int
) -> fig.Picture:
    """Draws residuals of all models against time for one joint, and their sums of squares so far.

    Args:
        names: of the models.
        predictions: of each, on the same rows.
        j: index of the joint.
    """
    first, joint = predictions[0], predictions[0].joints[j]
    time, label, marks = concatenate_time(first)
    left = tuple(compute_residual(prediction)[:, j] for prediction in predictions)
    sums = [np.cumsum(np.nan_to_num(e) ** 2) for e in left]
    whole = max(float(total[-1]) for total in sums) or 1.0
    plot_rows, segment = fig.thin_curves(left, _MOST), first.segment
    even = np.unique(np.linspace(0, time.size - 1, _MOST // 2).astype(int))
    styles = [
        fig.Style(fig.COLORS[k % len(fig.COLORS)], width=1.1, opacity=0.8)
        for k in range(len(names))
    ]
    residuals, gains = [], []
    for name, style, e, total in zip(names, styles, left, sums, strict=True):
        curve = break_at_gaps(segment[plot_rows], time[plot_rows], e[plot_rows])
        residuals.append(fig.Curve(name, *curve, style))
        gains.append(fig.Curve(name, time[even], 100.0 * total[even] / whole, style))
    spans = find_masked_spans(first, j, time, np.arange(time.size))
    unit = f"residual [{joint.effort_unit}]"
    above = fig.Panel(
        "Residual", label, unit, tuple(residuals), marks=marks, zero=True, spans=spans
    )
    below = fig.Panel("Squared residual so far", label, "sum [%]", tuple(gains), marks=marks)
    caption = _write_overlay_caption(names, styles, describe_masks(first, j))
    title = f"Joint {joint.name}: what each model leaves"
    return fig.Picture(
        f"joint_{joint.name}_models",
        title,
        caption,
        ((above,), (below,)),
        430,
        heights=(0.6, 0.4),
        shared_time=True,
    )


def _write_overlay_caption(names: Sequence[str], styles: Sequence[fig.Style], masks: str) -> str:
    pairs = zip(names, styles, strict=True)
    said = ", ".join(f"{style.description.capitalize()}: {name}" for name, style in pairs)
    return (
        f"{said}. Below: the squared residual summed up to that time, in percent of the largest "
        f"sum at the end; where one curve is steeper, that model is worse there. {masks}"
    ).strip()
