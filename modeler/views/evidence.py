"""The picture of an effect: the residual without it, the effect's curve, and what is left."""

import dataclasses
import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeler import diagnosis, validation
from modeler.core import figure as fig
from modeler.core.table import WORDS, format_percent
from modeler.validation import WINDOW, build_time_curve, build_torque_panels
from modeler.views.effect_evidence import Evidence, build_bins
from modeler.views.page import PageCell, PageTable
from modeler.views.thresholds import THRESHOLDS

# How much of the axes a picture shows: where the effect acts and most means are.


@dataclass(frozen=True)
class AxisRanges:
    """Ranges of the axes, y of residuals, law of the effect's torque; what lies outside."""

    x: tuple[float, float]
    y: tuple[float, float]
    law: tuple[float, float]
    outside: tuple[str, ...]


def choose_axis_ranges(item: Evidence) -> AxisRanges:
    """Chooses the same axis ranges for both panels, so that they can be compared.

    The ends are quantiles: neither one spike nor a few rows may flatten everything else. The curve
    of the effect is always inside.
    """
    x = _choose_x_range(item)
    y = _choose_y_range(item, x, item.contribution, (item.before, item.after))
    effect_torque = item.contribution if item.effect_torque is None else item.effect_torque
    law = _choose_y_range(item, x, effect_torque, (effect_torque + item.after,))
    return AxisRanges(x, y, law, tuple(_describe_outside(item, x, y)))


def _choose_x_range(item: Evidence) -> tuple[float, float]:
    """Most of the rows, and no more than the neighbourhood of the place where the effect acts."""
    x, adds = (
        item.axis.x[item.is_inlier],
        (item.contribution if item.effect_torque is None else item.effect_torque)[item.is_inlier],
    )
    low, high = np.quantile(x, (THRESHOLDS.tail_share, 1.0 - THRESHOLDS.tail_share))
    order = np.argsort(x)
    share = np.cumsum(adds[order] ** 2)
    if share[-1] > 0.0 and item.axis.shows not in ("t", "waves"):
        ends = np.searchsorted(
            share, np.array((THRESHOLDS.tail_share, 1.0 - THRESHOLDS.tail_share)) * share[-1]
        )
        near, far = x[order[np.minimum(ends, len(x) - 1)]]
        first, last = _widen_range(x, near, far)
        low, high = max(low, first), min(high, last)
    pad = 0.5 * THRESHOLDS.axis_padding * (high - low) or 1.0
    return float(low - pad), float(high + pad)


def _widen_range(x: np.ndarray, near: float, far: float) -> tuple[float, float]:
    """As wide on either side of a place as the place itself, or wider: many rows are inside."""
    beside = far - near
    while (
        beside > 0.0
        and np.mean((x >= near - beside) & (x <= far + beside)) < THRESHOLDS.min_shown_rows
    ):
        beside *= 2.0
    return near - beside, far + beside


def _choose_y_range(
    item: Evidence, x: tuple[float, float], effect: np.ndarray, drawn: Sequence[np.ndarray]
) -> tuple[float, float]:
    inside = (item.bins.centre >= x[0]) & (item.bins.centre <= x[1])
    ends, error = [], np.nan_to_num(item.compute_errors())
    for y in drawn:
        turned = item.axis.apply_direction(y)
        means = item.bins.compute_means(turned)
        ends += [(means - error)[inside], (means + error)[inside]]
    curve = item.bins.compute_means(item.axis.apply_direction(effect))[inside]
    every = np.concatenate(ends)
    low = min(float(np.quantile(every, THRESHOLDS.cut_interval_share)), float(curve.min()), 0.0)
    high = max(
        float(np.quantile(every, 1.0 - THRESHOLDS.cut_interval_share)), float(curve.max()), 0.0
    )
    pad = THRESHOLDS.axis_padding * (high - low) or 1.0
    return low - pad, high + pad


def _describe_outside(item: Evidence, x: tuple[float, float], y: tuple[float, float]) -> list[str]:
    """What the picture does not show."""
    beside = (item.axis.x < x[0]) | (item.axis.x > x[1])
    turned = item.axis.apply_direction(item.before)
    above = ~beside & ((turned < y[0]) | (turned > y[1]))
    count = len(turned)
    lines = [
        f"{int(rows.sum())} of {count} rows lie {where}."
        for rows, where in ((beside, "left or right of the axes"), (above, "above or below"))
        if rows.any()
    ]
    means = item.bins.compute_means(turned)
    shown = (item.bins.centre >= x[0]) & (item.bins.centre <= x[1])
    lost = shown & ((means < y[0]) | (means > y[1]))
    if lost.any():
        farthest = float(means[lost][np.argmax(np.abs(means[lost]))])
        lines.append(
            f"{int(lost.sum())} of {int(shown.sum())} means without the effect lie above or "
            f"below, the farthest at {farthest:.3g} {item.unit}."
        )
    wild = int((~item.is_inlier).sum())
    if wild:
        what = "wild row counts" if wild == 1 else "wild rows count"
        lines.append(f"{wild} {what} in no mean.")
    return lines


ROWS = fig.Style(fig.GREY, 2.0, 0.35)
MEANS = fig.Style(fig.BLACK, 0.0)
EFFECT = fig.Style(fig.VERMILLION, 2.2)
RIVAL = fig.Style(fig.BLUE, 1.4, dash=True)
LAW_BAND = fig.Style(fig.SKY, opacity=0.45)
LINES, LINES_AFTER = fig.Style(fig.BLACK, 1.0), fig.Style(fig.GREEN, 1.4)


def draw_evidence_picture(item: Evidence) -> fig.Picture:
    """Draws the residual on the axis of the effect, without the effect and with it."""
    pick, view = item.step.candidate, choose_axis_ranges(item)
    panels = [
        _build_residual_panel(item, view),
        _build_panel("with it", item, view, _build_cloud(item, view, item.after)),
    ]
    if item.axis.shows == "waves":
        panels.insert(0, _build_order_panel(item))
    elif item.effect_torque is not None:
        panels.append(_build_law_panel(item, item.effect_torque, view))
    name = f"joint {pick.joint}" if pick.joint is not None else "the whole robot"
    drawn = item.without.data.compiled.spec.joints[item.j].name
    seen = "" if drawn == pick.joint else f", seen on joint {drawn}"
    return fig.Picture(
        name=f"evidence_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"{pick.effect.title}: {name}{seen}",
        caption=" ".join(_write_caption(item, view)),
        panels=(tuple(panels),),
        height=400,
    )


def _build_residual_panel(item: Evidence, view: AxisRanges) -> fig.Panel:
    axis, bins = item.axis, item.bins
    curves = [(item.step.candidate.effect.id, item.contribution, EFFECT)]
    if item.baseline is not None:
        curves.append(("nonparametric fit", item.baseline, RIVAL))
    lines = [
        fig.Curve(name, *_break_at_zero(item, bins.compute_means(axis.apply_direction(y))), style)
        for name, y, style in curves
    ]
    series = (*_build_cloud(item, view, item.before), *lines)
    return _build_panel("without the effect", item, view, series)


def _build_law_panel(item: Evidence, effect_torque: np.ndarray, view: AxisRanges) -> fig.Panel:
    """Torque that is left to the effect with all else in the model, and its equation."""
    y = item.bins.compute_means(item.axis.apply_direction(effect_torque))
    series = [*_build_cloud(item, view, effect_torque + item.after)]
    if item.effect_torque_sigma is not None:
        half = validation.THRESHOLDS.band_deviations * item.effect_torque_sigma
        x, low = _break_at_zero(item, y - half)
        series.append(
            fig.Band("95 % band of the model", x, low, _break_at_zero(item, y + half)[1], LAW_BAND)
        )
    series.append(fig.Curve(item.step.candidate.effect.id, *_break_at_zero(item, y), EFFECT))
    panel = _build_panel("model of the effect", item, view, tuple(series))
    label = panel.y_label.replace("residual", "torque attributed to it")
    return dataclasses.replace(panel, y_label=label, y_range=view.law)


def _build_panel(
    title: str, item: Evidence, view: AxisRanges, series: tuple[fig.Series, ...]
) -> fig.Panel:
    y_label = f"residual{item.axis.label_suffix} [{item.unit}]"
    return fig.Panel(
        title, item.axis.label, y_label, series, zero=True, x_range=view.x, y_range=view.y
    )


def _build_cloud(item: Evidence, view: AxisRanges, y: np.ndarray) -> tuple[fig.Series, ...]:
    x, turned = item.axis.x, item.axis.apply_direction(y)
    inside = np.flatnonzero((x >= view.x[0]) & (x <= view.x[1]))
    plot_rows = inside[:: max(1, len(inside) // THRESHOLDS.max_dots)]
    return (
        fig.Points("rows", x[plot_rows], turned[plot_rows], ROWS),
        fig.Means(
            "mean of bin, 95 %",
            item.bins.centre,
            item.bins.compute_means(turned),
            item.compute_errors(),
            MEANS,
        ),
    )


def _break_at_zero(item: Evidence, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A curve over the centres of the bins; over velocities it may leap at 0."""
    if item.axis.shows != "v":
        return item.bins.centre, y
    at = [edge for edge in item.bins.edges if edge > 0]
    return np.insert(item.bins.centre, at, np.nan), np.insert(y, at, np.nan)


def _build_order_panel(item: Evidence) -> fig.Panel:
    order = item.step.candidate.nonlinear_parameters["m"]
    series = []
    for label, state, style in (
        ("without", item.without, LINES),
        ("with the effect", item.full, LINES_AFTER),
    ):
        spectrum = diagnosis.compute_joint_order_spectrum(state, item.j)
        if spectrum is not None:
            near = (spectrum.order > 0.5 * order) & (spectrum.order < 1.5 * order)
            series.append(fig.Curve(label, spectrum.order[near], spectrum.amplitude[near], style))
    return fig.Panel(
        "order spectrum",
        "waves per turn",
        f"amplitude [{item.unit}]",
        tuple(series),
        marks=((order, f"{order:.4g}"),),
    )


def _write_caption(item: Evidence, view: AxisRanges) -> list[str]:
    lines = [
        f"Look for: {item.step.candidate.effect.signature}. Without the effect, all other "
        "parameters are fitted anew; with it, the scale is the same.",
        f"{ROWS.description.capitalize()}: filtered rows; {MEANS.description}: means of bins with "
        "95 % "
        f"intervals, from blocks of time, of what scatters about the effect; {EFFECT.description}: "
        "what the effect adds, as far as the model's other parameters cannot imitate it.",
    ]
    if item.axis.shows == "waves":
        lines.append(
            f"In the spectrum {LINES.description} is without the effect, {LINES_AFTER.description} "
            "with it. Rows of fast motion show less of the wave: the filter takes it."
        )
    elif item.effect_torque is None:
        lines.append(
            "No single quantity shows this effect, so the axis is what it adds itself: where it "
            "describes the residual, the means lie on its line."
        )
    else:
        lines.append("Its law: measured torque less all else in the model, and the equation.")
        if item.effect_torque_sigma is not None:
            lines.append(
                f"Broad {LAW_BAND.description}: two standard deviations of the law on either side, "
                "by the scatter between blocks of time, its shapes taken as known."
            )
    if item.baseline is not None:
        lines.append(
            f"{RIVAL.description.capitalize()}: the nonparametric fit, any smooth law of what was "
            "measured, fitted to other blocks."
        )
    if item.axis.direction is not None:
        lines.append(
            "Residuals are multiplied by the sign of the velocity: friction turns with it."
        )
    if len(item.without.picks):
        lines.append("The other effects found here are in the model on both sides.")
    return [*lines, *view.outside]


def select_alternatives(step: diagnosis.SearchStep) -> list[diagnosis.ScoredCandidate]:
    """Selects the alternative effects on the same joint, or of the whole robot."""
    return [rival for rival in step.alternatives if rival.candidate.joint == step.candidate.joint]


def tabulate_alternatives(step: diagnosis.SearchStep) -> PageTable:
    """Tabulates what the best effects on the same joint explain within the logs."""
    gains = [
        (item.candidate.effect.id, max(0.0, item.variance_reduction))
        for item in (step.score, *select_alternatives(step)[:7])
    ]
    return PageTable(
        ("Why not another effect", "explains"),
        [(name, PageCell(format_percent(gain), gain)) for name, gain in gains],
        "Share of the error variance of its own joints that each effect explains within these "
        "logs, cross-validated. Only effects on one joint are alternatives; one on another is "
        "possibly the next to be found.",
        {"explains": "bar"},
    )


def build_scatter_panel(
    title: str, x_label: str, y_label: str, x: np.ndarray, y: np.ndarray, block: np.ndarray
) -> fig.Panel:
    """Builds a panel of rows as dots, and means of bins with 95 % intervals."""
    bins = build_bins(x, np.zeros(len(x)), block, np.ones(len(x), dtype=bool))
    every = max(1, len(x) // THRESHOLDS.max_dots)
    series: Sequence[fig.Series] = (
        fig.Points("rows", x[::every], y[::every], ROWS),
        fig.Means(
            "mean of bin, 95 %",
            bins.centre,
            bins.compute_means(y),
            bins.compute_errors(y, block),
            MEANS,
        ),
    )
    return fig.Panel(title, x_label, y_label, tuple(series), zero=True)


# Torque and residual before and after an effect, where the model without it is worst.


MEASURED = fig.Style(fig.BLACK, width=1.2)
BEFORE = fig.Style(fig.VERMILLION, width=1.6, dash=True)
AFTER_STYLE = fig.Style(fig.GREEN, width=1.6)
LEFT = fig.Style(fig.VERMILLION, width=1.2, dash=True)
STAYS = fig.Style(fig.GREEN, width=1.2)


def draw_torque_picture(item: Evidence) -> fig.Picture:
    """Draws measured torque, the model without and with the effect; below, the residuals."""
    rows = item.without.rows
    joint = item.without.data.compiled.spec.joints[item.j]
    log, start, end = find_worst_window(item)
    time, pieces = rows.time[item.j], _find_pieces(item)
    near = (
        (rows.run[item.j] == log)
        & (time >= start - THRESHOLDS.torque_margin)
        & (time <= end + THRESHOLDS.torque_margin)
    )
    measured, what = rows.y[item.j], WORDS[joint.effort_unit]
    curves = (
        ("measured", measured, MEASURED),
        ("model before", measured - item.before, BEFORE),
        ("model after", measured - item.after, AFTER_STYLE),
        ("residual before", item.before, LEFT),
        ("residual after", item.after, STAYS),
    )
    drawn = [build_time_curve(n, pieces[near], time[near], y[near], s) for n, y, s in curves]
    name, pick = item.without.data.observation.logs[log], item.step.candidate
    above, below = build_torque_panels(
        what.capitalize(), f"time in {name} [s]", joint.effort_unit, drawn[:3], drawn[3:],
        shade=(start, end),
    )  # fmt: skip
    return fig.Picture(
        name=f"torque_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"Joint {joint.name} where it is worst: before and after",
        caption=_write_torque_caption(item, what, (start, end), name),
        panels=((above,), (below,)),
        heights=(0.58, 0.42),
        height=430,
        shared_time=True,
    )


def find_worst_window(item: Evidence) -> tuple[int, float, float]:
    """Returns log, start and end in s of the half second where the model is worst.

    By its squared residual without the effect, on the joint where the effect is seen.
    """
    rows, j = item.without.rows, item.j
    time, run, square = rows.time[j], rows.run[j], np.where(item.is_inlier, item.before, 0.0) ** 2
    best = (-1.0, 0, 0.0, 0.0)
    for log in np.unique(run):
        is_of_log = run == log
        t, energy = time[is_of_log], np.concatenate([[0.0], np.cumsum(square[is_of_log])])
        stop = np.searchsorted(t, t + WINDOW, side="right")
        inside = energy[stop] - energy[:-1]
        k = int(np.argmax(inside))
        if inside[k] > best[0]:
            best = (float(inside[k]), int(log), float(t[k]), float(t[stop[k] - 1]))
    return best[1], best[2], best[3]


def _find_pieces(item: Evidence) -> np.ndarray:
    """(rows_j,) number of the piece of each row: no line is drawn over rows that do not count."""
    time, segment = item.without.rows.time[item.j], item.without.rows.segment[item.j]
    steps = np.diff(time)
    inside = steps[np.diff(segment) == 0]
    longest = 1.5 * float(np.median(inside)) if inside.size else np.inf
    return np.concatenate([[0], np.cumsum((np.diff(segment) != 0) | (steps > longest))])


def _write_torque_caption(item: Evidence, what: str, window: tuple[float, float], log: str) -> str:
    rows, j = item.without.rows, item.j
    time = rows.time[j]
    number = item.without.data.observation.logs.index(log)
    inside = (rows.run[j] == number) & (time >= window[0]) & (time <= window[1])
    before, after = (float(np.sqrt(np.mean(e[inside] ** 2))) for e in (item.before, item.after))
    return (
        f"Above, {MEASURED.description}: measured {what}; {BEFORE.description}: the model without "
        f"the effect, fitted to the same rows; {AFTER_STYLE.description}: with it. Below, what "
        f"they leave: {LEFT.description} before, {STAYS.description} after. Shaded "
        f"{fig.COLOR_NAMES[fig.SHADE]}: the {WINDOW} s with the largest squared residual before, "
        f"{window[0]:.2f} to {window[1]:.2f} s; the rms residual there falls from {before:.3g} to "
        f"{after:.3g} {item.unit}. Filtered rows of the logs that are explained; rows that do not "
        "count are left out."
    )


# Pictures of what is no column: impacts of play around the moments they follow, a push in time.


def draw_play_picture(state: diagnosis.State, j: int) -> fig.Picture:
    """Draws |residual| of joint j against the time to the nearest change of its load's sign.

    Args:
        state: with the effects that are columns.
        j: index of the joint.
    """
    joint = state.data.compiled.spec.joints[j]
    since = _compute_time_since_reversal(state, j)
    near = np.abs(since) < THRESHOLDS.reversal_margin
    panel = build_scatter_panel(
        "",
        "time since the load changed its sign [s]",
        f"|residual| [{joint.effort_unit}]",
        since[near],
        np.abs(state.residual[j][near]),
        state.gram_blocks.block[j][near],
    )
    panel = replace(panel, shade=(0.0, diagnosis.THRESHOLDS.burst_duration))
    return fig.Picture(
        f"evidence_backlash_{joint.name}",
        f"Play in the gear: joint {joint.name}",
        "The teeth hit when the load pushes them to the other side. "
        f"{ROWS.description.capitalize()}: rows; {MEANS.description}: means of bins with 95 % "
        "intervals; "
        "shaded: where the impacts are looked for. Friction and springs do not know these moments.",
        ((panel,),),
        380,
    )


def _compute_time_since_reversal(state: diagnosis.State, j: int) -> np.ndarray:
    """(rows_j,) s since the nearest change of sign, negative before it; infinite without any."""
    since = np.full(len(state.residual[j]), np.inf)
    for number, (signals, turns) in enumerate(
        zip(state.rows.signals, diagnosis.find_load_reversals(state, j), strict=True)
    ):
        at = signals.segment.time[turns]
        is_of_segment = state.rows.segment[j] == number
        if at.size and is_of_segment.any():
            time = state.rows.time[j][is_of_segment]
            after = np.clip(np.searchsorted(at, time), 1, max(1, len(at) - 1))
            pairs = time[:, None] - at[np.column_stack([after - 1, np.minimum(after, len(at) - 1)])]
            since[is_of_segment] = pairs[np.arange(len(time)), np.argmin(np.abs(pairs), axis=1)]
    return since


def draw_push_picture(state: diagnosis.State, window: diagnosis.PushWindow) -> fig.Picture:
    """Draws residuals of all joints around a push, in parts of the joint's rms torque.

    Args:
        state: without the rows of the push.
        window: when it pushed.
    """
    seen = state.data.observation
    left = seen.torque - seen.predict(state.beta)
    shown = (seen.run == window.log) & (seen.time > window.start - THRESHOLDS.push_margin)
    shown &= seen.time < window.end + THRESHOLDS.push_margin
    masked = (seen.time > window.start - diagnosis.THRESHOLDS.push_margin) & (
        seen.time < window.end + diagnosis.THRESHOLDS.push_margin
    )
    left[~(seen.used | masked[:, None])] = np.nan  # reversals of a joint: nobody looks at them
    size = np.sqrt(np.mean(seen.torque**2, axis=0))
    curves = tuple(
        fig.Curve(
            f"joint {joint.name}", seen.time[shown], left[shown, j] / size[j], fig.Style(color)
        )
        for j, (joint, color) in enumerate(
            zip(seen.joints, itertools.cycle(fig.COLORS), strict=False)
        )
        if size[j] > 0.0
    )
    name = seen.logs[window.log]
    panel = fig.Panel(
        name,
        "time [s]",
        "residual over rms torque",
        curves,
        shade=(window.start, window.end),
        zero=True,
    )
    return fig.Picture(
        "evidence_external_force",
        "Something pushed",
        "What the model leaves of the torques; shaded: while it pushed. These rows are left out of "
        "everything else.",
        ((panel,),),
        380,
    )
