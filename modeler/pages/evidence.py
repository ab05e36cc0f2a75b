"""The picture of an effect: the residual without it, the effect's curve, and what is left."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.compare.band import DEVIATIONS
from modeler.diagnose.judge import Judged
from modeler.diagnose.search import Step
from modeler.pages.bins import bins_of
from modeler.pages.sheet import Cell, Table
from modeler.pages.shown import Shown
from modeler.pages.view import View, view_of
from modeler.pictures.picture import (
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
from modeler.scoring.orders import order_spectrum
from modeler.scoring.score import percent

ROWS = Style(GREY, 2.0, 0.35)
MEANS = Style(BLACK, 0.0)
EFFECT = Style(VERMILLION, 2.2)
RIVAL = Style(BLUE, 1.4, dash=True)
LAW_BAND = Style(SKY, opacity=0.45)
LINES, LINES_AFTER = Style(BLACK, 1.0), Style(GREEN, 1.4)
_DOTS = 1500


def evidence_picture(item: Shown) -> Picture:
    """Residual on the axis where the effect shows itself, without the effect and with it."""
    pick, view = item.step.pick, view_of(item)
    panels = [_without(item, view), _with(item, view)]
    if item.axis.shows == "waves":
        panels.insert(0, _orders(item))
    elif item.own is not None:
        panels.append(_law(item, item.own, view))
    name = f"joint {pick.joint}" if pick.joint is not None else "the whole robot"
    drawn = item.without.data.compiled.spec.joints[item.j].name
    seen = "" if drawn == pick.joint else f", seen on joint {drawn}"
    return Picture(
        name=f"evidence_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"{pick.effect.title}: {name}{seen}",
        caption=" ".join(_caption(item, view)),
        panels=(tuple(panels),),
        heights=(1.0,),
        widths=tuple(1.0 / len(panels) for _ in panels),
        height=400,
    )


def _without(item: Shown, view: View) -> Panel:
    axis, bins = item.axis, item.bins
    curves = [(item.step.pick.effect.id, item.adds, EFFECT)]
    if item.rival is not None:
        curves.append(("flexible rival", item.rival, RIVAL))
    lines = [
        Curve(name, *_pieces(item, bins.means(axis.turned(y))), style) for name, y, style in curves
    ]
    series = (*_cloud(item, view, item.before), *lines)
    return _panel("without the effect", item, view, series)


def _with(item: Shown, view: View) -> Panel:
    return _panel("with it", item, view, _cloud(item, view, item.after))


def _law(item: Shown, own: np.ndarray, view: View) -> Panel:
    """Torque that is left to the effect with all else in the model, and its equation."""
    y = item.bins.means(item.axis.turned(own))
    series = [*_cloud(item, view, own + item.after)]
    if item.own_sigma is not None:
        half = DEVIATIONS * item.own_sigma
        x, low = _pieces(item, y - half)
        series.append(Band("95 % band of its law", x, low, _pieces(item, y + half)[1], LAW_BAND))
    series.append(Curve(item.step.pick.effect.id, *_pieces(item, y), EFFECT))
    panel = _panel("its law", item, view, tuple(series))
    label = panel.y_label.replace("residual", "torque laid to it")
    return dataclasses.replace(panel, y_label=label, y_range=view.law)


def _panel(title: str, item: Shown, view: View, series: tuple[Series, ...]) -> Panel:
    y_label = f"residual{item.axis.times} [{item.unit}]"
    return Panel(title, item.axis.label, y_label, series, zero=True, x_range=view.x, y_range=view.y)


def _cloud(item: Shown, view: View, y: np.ndarray) -> tuple[Series, ...]:
    x, turned = item.axis.x, item.axis.turned(y)
    inside = np.flatnonzero((x >= view.x[0]) & (x <= view.x[1]))
    kept = inside[:: max(1, len(inside) // _DOTS)]
    return (
        Points("rows", x[kept], turned[kept], ROWS),
        Means("mean of bin, 95 %", item.bins.centre, item.bins.means(turned), item.errors(), MEANS),
    )


def _pieces(item: Shown, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A curve over the centres of the bins; over velocities it may leap at 0."""
    if item.axis.shows != "v":
        return item.bins.centre, y
    at = [edge for edge in item.bins.edges if edge > 0]
    return np.insert(item.bins.centre, at, np.nan), np.insert(y, at, np.nan)


def _orders(item: Shown) -> Panel:
    order = item.step.pick.shapes["m"]
    series = []
    for label, state, style in (
        ("without", item.without, LINES), ("with the effect", item.full, LINES_AFTER),
    ):  # fmt: skip
        spectrum = order_spectrum(state, item.j)
        if spectrum is not None:
            near = (spectrum.order > 0.5 * order) & (spectrum.order < 1.5 * order)
            series.append(Curve(label, spectrum.order[near], spectrum.amplitude[near], style))
    return Panel(
        "order spectrum", "waves per turn", f"amplitude [{item.unit}]", tuple(series),
        marks=((order, f"{order:.4g}"),),
    )  # fmt: skip


def _caption(item: Shown, view: View) -> list[str]:
    lines = [
        f"Look for: {item.step.pick.effect.signature}. Without the effect, all other parameters "
        "are fitted anew; with it, the scale is the same.",
        f"{ROWS.named.capitalize()}: filtered rows; {MEANS.named}: means of bins with 95 % "
        f"intervals, from blocks of time, of what scatters about the effect; {EFFECT.named}: "
        "what the effect adds, as far as the model's other parameters cannot imitate it.",
    ]
    if item.axis.shows == "waves":
        lines.append(
            f"In the spectrum {LINES.named} is without the effect, {LINES_AFTER.named} with it. "
            "Rows of fast motion show less of the wave: the filter takes it."
        )
    elif item.own is None:
        lines.append(
            "No single quantity shows this effect, so the axis is what it adds itself: where it "
            "describes the residual, the means lie on its line."
        )
    else:
        lines.append("Its law: measured torque less all else in the model, and the equation.")
        if item.own_sigma is not None:
            lines.append(
                f"Broad {LAW_BAND.named}: two standard deviations of the law on either side, by "
                "the scatter between blocks of time, its shapes taken as known."
            )
    if item.rival is not None:
        lines.append(
            f"{RIVAL.named.capitalize()}: the flexible rival, any smooth law of what was "
            "measured, fitted to other blocks."
        )
    if item.axis.way is not None:
        lines.append(
            "Residuals are multiplied by the sign of the velocity: friction turns with it."
        )
    if len(item.without.picks):
        lines.append("The other effects found here are in the model on both sides.")
    return [*lines, *view.outside]


def rivals_of(step: Step) -> list[Judged]:
    """The effects that could stand for it: those of the same joint, or of the whole robot."""
    return [rival for rival in step.rivals if rival.candidate.joint == step.pick.joint]


def rivals_table(step: Step) -> Table:
    """What the best effects on the same joint explain within the logs, below one another."""
    items = [step.judged, *rivals_of(step)[:7]]
    rows: list[list[str | Cell]] = [
        [item.candidate.effect.id, Cell(percent(gain), "bar", gain)]
        for item in items
        for gain in [max(0.0, item.gain)]
    ]
    return Table(
        ["Why not another effect", Cell("explains", "bar")], rows,
        "Share of the error variance of its own joints that each effect explains within these "
        "logs, cross-validated. Only effects on the same joint are rivals; one on another joint is "
        "perhaps the next to be found.",
    )  # fmt: skip


def scatter(
    title: str, x_label: str, y_label: str, x: np.ndarray, y: np.ndarray, block: np.ndarray
) -> Panel:
    """Rows as dots, and the means of bins with 95 % intervals."""
    bins = bins_of(x, np.zeros(len(x)), block, np.ones(len(x), dtype=bool))
    every = max(1, len(x) // _DOTS)
    series: Sequence[Series] = (
        Points("rows", x[::every], y[::every], ROWS),
        Means("mean of bin, 95 %", bins.centre, bins.means(y), bins.errors(y, block), MEANS),
    )
    return Panel(title, x_label, y_label, tuple(series), zero=True)
