"""The picture of an effect: the residual without it, the effect's curve, and what is left."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.figure import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    SKY,
    VERMILLION,
    Band,
    Curve,
    Means,
    Panel,
    Picture,
    Points,
    Series,
    Style,
)
from modeler.core.table import format_percent
from modeler.diagnosis import ScoredCandidate, SearchStep, compute_joint_order_spectrum
from modeler.validation import DEVIATIONS
from modeler.views.blocks import PageCell, PageTable
from modeler.views.effect_evidence import Evidence
from modeler.views.evidence_axes import build_bins

# How much of the axes a picture shows: where the effect acts and most means are.


_TAIL = 0.005  # of the rows, and of the square of the effect, beyond either end of the x axis
_LEAST = 0.25  # of the rows that are shown, however small the place is where the effect acts
_MEANS = 0.05  # of the ends of all intervals beyond either end of the y axis
_PAD = 0.08  # of a range, on either side


@dataclass(frozen=True)
class AxisRanges:
    """Ranges of the axes, y of residuals, law of the effect's torque; what lies outside."""

    x: tuple[float, float]
    y: tuple[float, float]
    law: tuple[float, float]
    outside: tuple[str, ...]


def choose_axis_ranges(item: Evidence) -> AxisRanges:
    """Of both panels, alike, so that they can be compared.

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
    low, high = np.quantile(x, (_TAIL, 1.0 - _TAIL))
    order = np.argsort(x)
    share = np.cumsum(adds[order] ** 2)
    if share[-1] > 0.0 and item.axis.shows not in ("t", "waves"):
        ends = np.searchsorted(share, np.array((_TAIL, 1.0 - _TAIL)) * share[-1])
        near, far = x[order[np.minimum(ends, len(x) - 1)]]
        first, last = _widen_range(x, near, far)
        low, high = max(low, first), min(high, last)
    pad = 0.5 * _PAD * (high - low) or 1.0
    return float(low - pad), float(high + pad)


def _widen_range(x: np.ndarray, near: float, far: float) -> tuple[float, float]:
    """As wide on either side of a place as the place itself, or wider: many rows are inside."""
    beside = far - near
    while beside > 0.0 and np.mean((x >= near - beside) & (x <= far + beside)) < _LEAST:
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
    low = min(float(np.quantile(every, _MEANS)), float(curve.min()), 0.0)
    high = max(float(np.quantile(every, 1.0 - _MEANS)), float(curve.max()), 0.0)
    pad = _PAD * (high - low) or 1.0
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


ROWS = Style(GREY, 2.0, 0.35)
MEANS = Style(BLACK, 0.0)
EFFECT = Style(VERMILLION, 2.2)
RIVAL = Style(BLUE, 1.4, dash=True)
LAW_BAND = Style(SKY, opacity=0.45)
LINES, LINES_AFTER = Style(BLACK, 1.0), Style(GREEN, 1.4)
_DOTS = 1500


def draw_evidence_picture(item: Evidence) -> Picture:
    """Residual on the axis where the effect shows itself, without the effect and with it."""
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
    return Picture(
        name=f"evidence_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"{pick.effect.title}: {name}{seen}",
        caption=" ".join(_write_caption(item, view)),
        panels=(tuple(panels),),
        height=400,
    )


def _build_residual_panel(item: Evidence, view: AxisRanges) -> Panel:
    axis, bins = item.axis, item.bins
    curves = [(item.step.candidate.effect.id, item.contribution, EFFECT)]
    if item.baseline is not None:
        curves.append(("flexible rival", item.baseline, RIVAL))
    lines = [
        Curve(name, *_break_at_zero(item, bins.compute_means(axis.apply_direction(y))), style)
        for name, y, style in curves
    ]
    series = (*_build_cloud(item, view, item.before), *lines)
    return _build_panel("without the effect", item, view, series)


def _build_law_panel(item: Evidence, effect_torque: np.ndarray, view: AxisRanges) -> Panel:
    """Torque that is left to the effect with all else in the model, and its equation."""
    y = item.bins.compute_means(item.axis.apply_direction(effect_torque))
    series = [*_build_cloud(item, view, effect_torque + item.after)]
    if item.effect_torque_sigma is not None:
        half = DEVIATIONS * item.effect_torque_sigma
        x, low = _break_at_zero(item, y - half)
        series.append(
            Band("95 % band of its law", x, low, _break_at_zero(item, y + half)[1], LAW_BAND)
        )
    series.append(Curve(item.step.candidate.effect.id, *_break_at_zero(item, y), EFFECT))
    panel = _build_panel("its law", item, view, tuple(series))
    label = panel.y_label.replace("residual", "torque laid to it")
    return dataclasses.replace(panel, y_label=label, y_range=view.law)


def _build_panel(title: str, item: Evidence, view: AxisRanges, series: tuple[Series, ...]) -> Panel:
    y_label = f"residual{item.axis.label_suffix} [{item.unit}]"
    return Panel(title, item.axis.label, y_label, series, zero=True, x_range=view.x, y_range=view.y)


def _build_cloud(item: Evidence, view: AxisRanges, y: np.ndarray) -> tuple[Series, ...]:
    x, turned = item.axis.x, item.axis.apply_direction(y)
    inside = np.flatnonzero((x >= view.x[0]) & (x <= view.x[1]))
    plot_rows = inside[:: max(1, len(inside) // _DOTS)]
    return (
        Points("rows", x[plot_rows], turned[plot_rows], ROWS),
        Means(
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


def _build_order_panel(item: Evidence) -> Panel:
    order = item.step.candidate.nonlinear_parameters["m"]
    series = []
    for label, state, style in (
        ("without", item.without, LINES), ("with the effect", item.full, LINES_AFTER),
    ):  # fmt: skip
        spectrum = compute_joint_order_spectrum(state, item.j)
        if spectrum is not None:
            near = (spectrum.order > 0.5 * order) & (spectrum.order < 1.5 * order)
            series.append(Curve(label, spectrum.order[near], spectrum.amplitude[near], style))
    return Panel(
        "order spectrum", "waves per turn", f"amplitude [{item.unit}]", tuple(series),
        marks=((order, f"{order:.4g}"),),
    )  # fmt: skip


def _write_caption(item: Evidence, view: AxisRanges) -> list[str]:
    lines = [
        f"Look for: {item.step.candidate.effect.signature}. Without the effect, all other "
        "parameters "
        "are fitted anew; with it, the scale is the same.",
        f"{ROWS.description.capitalize()}: filtered rows; {MEANS.description}: means of bins with "
        "95 % "
        f"intervals, from blocks of time, of what scatters about the effect; {EFFECT.description}: "
        "what the effect adds, as far as the model's other parameters cannot imitate it.",
    ]
    if item.axis.shows == "waves":
        lines.append(
            f"In the spectrum {LINES.description} is without the effect, {LINES_AFTER.description} "
            "with it. "
            "Rows of fast motion show less of the wave: the filter takes it."
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
                "by "
                "the scatter between blocks of time, its shapes taken as known."
            )
    if item.baseline is not None:
        lines.append(
            f"{RIVAL.description.capitalize()}: the flexible rival, any smooth law of what was "
            "measured, fitted to other blocks."
        )
    if item.axis.direction is not None:
        lines.append(
            "Residuals are multiplied by the sign of the velocity: friction turns with it."
        )
    if len(item.without.picks):
        lines.append("The other effects found here are in the model on both sides.")
    return [*lines, *view.outside]


def select_alternatives(step: SearchStep) -> list[ScoredCandidate]:
    """The effects that could stand for it: those of the same joint, or of the whole robot."""
    return [rival for rival in step.alternatives if rival.candidate.joint == step.candidate.joint]


def tabulate_alternatives(step: SearchStep) -> PageTable:
    """What the best effects on the same joint explain within the logs, below one another."""
    gains = [(item.candidate.effect.id, max(0.0, item.variance_reduction))
             for item in (step.score, *select_alternatives(step)[:7])]  # fmt: skip
    return PageTable(
        ("Why not another effect", "explains"),
        [(name, PageCell(format_percent(gain), gain)) for name, gain in gains],
        "Share of the error variance of its own joints that each effect explains within these "
        "logs, cross-validated. Only effects on the same joint are rivals; one on another joint is "
        "perhaps the next to be found.",
        {"explains": "bar"},
    )


def build_scatter_panel(
    title: str, x_label: str, y_label: str, x: np.ndarray, y: np.ndarray, block: np.ndarray
) -> Panel:
    """Rows as dots, and the means of bins with 95 % intervals."""
    bins = build_bins(x, np.zeros(len(x)), block, np.ones(len(x), dtype=bool))
    every = max(1, len(x) // _DOTS)
    series: Sequence[Series] = (
        Points("rows", x[::every], y[::every], ROWS),
        Means(
            "mean of bin, 95 %",
            bins.centre,
            bins.compute_means(y),
            bins.compute_errors(y, block),
            MEANS,
        ),
    )
    return Panel(title, x_label, y_label, tuple(series), zero=True)
