"""A picture as PNG or SVG, by matplotlib; no window, no global state."""

import io
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from modeler.core import figure as fig

_BESIDE = 4  # entries of a legend that leave room for the title
_SETTINGS: Any = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "svg.hashsalt": "modeler",  # the same picture gives the same file
    "svg.fonttype": "none",
}


def render_images(picture: fig.Picture) -> dict[str, bytes]:
    """Renders the picture as PNG (150 dpi) and SVG, 12 inches wide, without a date or version."""
    with matplotlib.rc_context(_SETTINGS):
        figure = _build_figure(picture)
        png = _save_figure(figure, "png", {"Software": None})
        figure.set_layout_engine("none")  # laid out by now; the layout is the slow part
        return {"png": png, "svg": _save_figure(figure, "svg", {"Date": None, "Creator": None})}


class Drawing(Figure):
    """A figure that a notebook shows by itself, whatever backend it has."""

    def _repr_png_(self) -> bytes:
        stream = io.BytesIO()
        self.savefig(stream, format="png", dpi=100)
        return stream.getvalue()


def draw_figure(picture: fig.Picture) -> Drawing:
    """Draws the picture as a figure of matplotlib, 12 inches wide."""
    with matplotlib.rc_context(_SETTINGS):
        return _build_figure(picture)


def _save_figure(figure: Figure, kind: str, metadata: dict[str, None]) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format=kind, dpi=150, metadata=metadata)
    return stream.getvalue()


def _build_figure(picture: fig.Picture) -> Drawing:
    figure = Drawing(figsize=(12.0, picture.height / 100.0), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(picture.title, x=0.01, ha="left", fontsize=11, fontweight="bold")
    axes = figure.subplots(
        len(picture.panels),
        len(picture.panels[0]),
        squeeze=False,
        sharex="col" if picture.shared_time else False,
        gridspec_kw={"height_ratios": picture.heights, "width_ratios": picture.widths},
    )
    last = len(picture.panels) - 1
    for row, panels in enumerate(picture.panels):
        for column, panel in enumerate(panels):
            _draw_panel(axes[row, column], panel)
            if not picture.shared_time or row == last:
                axes[row, column].set_xlabel(panel.x_label)
    _draw_legend(figure, picture, axes)
    return figure


def _draw_legend(figure: Figure, picture: fig.Picture, axes: Any) -> None:
    """One legend for the picture: the series of panels that have several."""
    handles: dict[str, Any] = {}
    for row, panels in enumerate(picture.panels):
        for column, panel in enumerate(panels):
            if len(panel.series) > 1 or panel.spans:
                drawn, labels = axes[row, column].get_legend_handles_labels()
                handles |= dict(zip(labels, drawn, strict=True))
    if handles:
        figure.legend(
            list(handles.values()),
            list(handles),
            loc="outside upper right",
            ncols=len(handles) if len(handles) <= _BESIDE else -(-len(handles) // 2),
            frameon=False,
        )


def _draw_panel(axes: Any, panel: fig.Panel) -> None:
    if not panel.series:
        axes.set_axis_off()
        return
    axes.set_title(panel.title)
    axes.set_ylabel(panel.y_label)
    if panel.scale == "log" and any(
        np.isfinite(s.y).any() for s in panel.series if isinstance(s, fig.Curve)
    ):
        axes.set_xscale("log")
        axes.set_yscale("log")
    for span in panel.spans:
        for k, (start, end) in enumerate(span.ends):
            label = "_nolegend_" if k else span.label
            axes.axvspan(start, end, color=span.color, lw=0, zorder=-1, label=label)
    if panel.shade is not None:
        axes.axvspan(*panel.shade, color=fig.SHADE, lw=0, zorder=0)
    if panel.zero:
        axes.axhline(0.0, color="0.4", lw=0.7, zorder=1)
    for place, text in panel.marks:
        axes.axvline(place, color="0.5", lw=0.7, ls=":", zorder=1)
        axes.annotate(
            f" {text}", (place, 1.0), xycoords=("data", "axes fraction"), fontsize=7, va="top"
        )
    for series in panel.series:
        _draw_series(axes, series)
    if panel.x_range is not None:
        axes.set_xlim(panel.x_range)
    if panel.y_range is not None:
        axes.set_ylim(panel.y_range)


def _draw_series(axes: Any, series: fig.Series) -> None:
    if isinstance(series, fig.Heat):
        _draw_heat(axes, series)
    elif isinstance(series, fig.Bars):
        _draw_bars(axes, series)
    elif isinstance(series, fig.Band):
        style = series.style
        axes.fill_between(
            series.x,
            series.low,
            series.high,
            color=style.color,
            alpha=style.opacity,
            lw=0,
            label=series.label,
        )
    elif isinstance(series, fig.Means):
        axes.errorbar(
            series.x,
            series.y,
            yerr=series.error,
            color=series.style.color,
            lw=series.style.width,
            elinewidth=1.0,
            marker="o",
            ms=3,
            label=series.label,
            zorder=3,
        )
    else:
        style, line = series.style, isinstance(series, fig.Curve)
        axes.plot(
            series.x,
            series.y,
            color=style.color,
            alpha=style.opacity,
            lw=style.width if line else 0.0,
            ls="--" if style.dash else "-",
            marker="" if line else ".",
            ms=style.width,
            label=series.label,
            rasterized=isinstance(series, fig.Points),
        )


def _draw_bars(axes: Any, series: fig.Bars) -> None:
    stacked = series.base is not None
    drawn = axes.bar(
        series.names,
        series.values,
        bottom=series.base,
        color=series.style.color,
        width=0.6,
        label=series.label,
    )
    place: Any = {"label_type": "center", "color": "white"} if stacked else {"padding": 2}
    axes.bar_label(drawn, labels=list(series.texts), **place)


def _draw_heat(axes: Any, heat: fig.Heat) -> None:
    colours = LinearSegmentedColormap.from_list("share", ["#ffffff", fig.BLUE])
    axes.imshow(heat.values, cmap=colours, vmin=0.0, vmax=heat.top, aspect="auto")
    axes.set_xticks(range(len(heat.columns)), heat.columns)
    axes.set_yticks(range(len(heat.rows)), heat.rows)
    axes.tick_params(length=0)
    for i, row in enumerate(heat.texts):
        for j, text in enumerate(row):
            dark = heat.values[i, j] > 0.55 * heat.top
            axes.text(j, i, text, ha="center", va="center", color="white" if dark else "black")
