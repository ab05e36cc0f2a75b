"""A picture as a figure of plotly.js: one translation for the pages and for the studio."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from modeler.core.figure import SHADE, Band, Bars, Curve, Heat, Panel, Picture, Points, Series
from modeler.views.thresholds import THRESHOLDS

WIDTH = 1150
"""Pixels that the gaps between panels are meant for."""

_LEFT, _RIGHT, _TOP, _TITLE, _BOTTOM, _BAR = 64, 16, 12, 26, 48, 26
_BETWEEN, _BESIDE, _SHARED, _LINE = 84, 84, 42, 16
_LETTER = 7.2  # pixels of a letter of a title
_LEAST = 280  # pixels of a panel, below which panels stand below one another
_PHONE = 700  # pixels of a page, below which titles are broken as on a phone
_TALL = (190, 260)  # pixels of a panel that stands below another
_STEP = 2e-6  # of the range of an axis: finer than a pixel at any zoom of thinned points
_GRID, _FAINT = "rgba(128,128,128,0.25)", "rgba(128,128,128,0.8)"
_NONE = "rgba(0,0,0,0)"
_CLEAR_TO_BLUE = [[0.0, "rgba(0,114,178,0)"], [1.0, "rgba(0,114,178,0.75)"]]

Mark = tuple[str, str]
"""Colour of an entry of a legend, and its kind: line, dashes, dots, bar or span."""


def build_figure(picture: Picture, legend: bool = True, time: str = "") -> dict[str, Any]:
    """Builds data and layout of plotly.js.

    Grounds are transparent, texts are coloured by the style sheet, which in the studio follows the
    system into the dark. Zoom survives when the figure is drawn again.

    Args:
        picture: what to draw.
        legend: inside the figure; a page has keys above it.
        time: a name that pictures whose x is the time of one log share: the page gives them one
            cursor and one zoom.
    """
    entries = collect_legend(picture) if legend else {}
    layout = _build_layout(picture, WIDTH) | {"showlegend": bool(entries), "meta": {"time": time}}
    data: list[dict[str, Any]] = []
    for n, (panel, _, _) in _number_panels(picture):
        data += _build_traces(panel, n, entries)
    return {"data": data, "layout": layout}


def build_page_figure(picture: Picture) -> dict[str, Any]:
    """Builds what the script of a page draws.

    Returns:
        As `build_figure`, and a second layout for widths of less than `below` pixels, where panels
        stand below one another.
    """
    columns, share = len(picture.widths), min(picture.widths) / sum(picture.widths)
    below = _LEFT + _RIGHT + (columns - 1) * _BESIDE + _LEAST / share
    narrow = _build_layout(_stack_panels(picture), _LEAST + _LEFT + _RIGHT)
    return build_figure(picture, False) | {"narrow": narrow, "below": max(_PHONE, round(below))}


def _stack_panels(picture: Picture) -> Picture:
    """One column, in the order in which plotly.js counts the axes."""
    if len(picture.panels[0]) == 1:
        return picture
    panels = tuple((panel,) for _, (panel, _, _) in _number_panels(picture))
    tall = min(max(0.55 * picture.height, _TALL[0]), _TALL[1]) + _BETWEEN
    height = round(len(panels) * (tall + _compute_name_height(picture))) + _TOP + _TITLE
    return Picture(picture.name, picture.title, picture.caption, panels, height)


def _number_panels(picture: Picture) -> Iterator[tuple[str, tuple[Panel, int, int]]]:
    """Panels with axes, their row and column, by number: the first pair of axes has none."""
    places = [
        (panel, i, j)
        for i, row in enumerate(picture.panels)
        for j, panel in enumerate(row)
        if panel.series
    ]
    return ((str(k) if k > 1 else "", place) for k, place in enumerate(places, start=1))


def _build_layout(picture: Picture, width: float) -> dict[str, Any]:
    rows, inner = len(picture.panels), width - _LEFT - _RIGHT
    across = _divide_range(picture.widths, inner, _BESIDE)
    titles = {
        n: _break_title(panel.title, (across[j][1] - across[j][0]) * inner)
        for n, (panel, _, j) in _number_panels(picture)
    }
    lines = max((title.count("\n") for title in titles.values()), default=0) * _LINE
    name_height = _compute_name_height(picture)
    top = _TOP + _BAR + lines + _TITLE * any(panel.title for panel in picture.panels[0])
    between = _SHARED if picture.shared_time else _BETWEEN + name_height
    height = picture.height + lines * rows
    layout: dict[str, Any] = {
        "height": height,
        "margin": {"l": _LEFT, "r": _RIGHT, "t": top, "b": _BOTTOM + name_height},
        "paper_bgcolor": _NONE, "plot_bgcolor": _NONE, "hovermode": "closest",
        "barmode": "overlay", "uirevision": picture.name, "showlegend": False,
        "modebar": {"bgcolor": _NONE, "color": _FAINT, "activecolor": "#333333"},
        "font": {"family": "system-ui, sans-serif", "size": 12, "color": "#333333"},
        "legend": {"orientation": "h", "x": 0, "xanchor": "left", "yref": "container", "y": 1,
                   "yanchor": "top", "bgcolor": _NONE},
        "shapes": [], "annotations": [],
    }  # fmt: skip
    plotted_height = height - top - layout["margin"]["b"]
    down = [(1.0 - b, 1.0 - a) for a, b in
            _divide_range(picture.heights, plotted_height, between + lines)]  # fmt: skip
    first: dict[int, str] = {}
    for n, (panel, i, j) in _number_panels(picture):
        x, y = _build_axes(panel, n, across[j], down[i])
        if picture.shared_time:
            if i < rows - 1:
                x |= {"showticklabels": False, "title": None}
            if first.setdefault(j, f"x{n}") != f"x{n}":
                x["matches"] = first[j]
        layout |= {f"xaxis{n}": x, f"yaxis{n}": y}
        layout["shapes"] += _build_shapes(panel, n)
        layout["annotations"] += _build_annotations(panel, n, titles[n])
    return layout


def _break_title(title: str, width: float) -> str:
    return textwrap.fill(title, max(12, int(width / _LETTER)), break_long_words=False)


def _compute_name_height(picture: Picture) -> int:
    """Pixels for names of bars in more than one line."""
    every = (s for row in picture.panels for panel in row for s in panel.series)
    names = (name for s in every if isinstance(s, Bars) for name in s.names)
    return 15 * max((name.count("\n") for name in names), default=0)


def _divide_range(shares: Sequence[float], room: float, gap: float) -> list[tuple[float, float]]:
    """Ends of so many intervals of 0 to 1, with gaps between."""
    inner = max(0.3, 1.0 - (len(shares) - 1) * gap / room)
    between = (1.0 - inner) / max(1, len(shares) - 1)
    intervals, at = [], 0.0
    for share in shares:
        wide = inner * share / sum(shares)
        intervals.append((at, min(1.0, at + wide)))
        at += wide + between
    return intervals


def escape_text(text: str) -> str:
    """Escapes the tags of a text; line breaks stay."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace("\n", "<br>")


def _convert_numbers(values: np.ndarray, exact: bool = False) -> list[float | None]:
    """What a screen shows, of logarithms and bars each value to 8 digits; not finite is a gap."""
    shown = np.asarray(values, dtype=float)
    is_finite = np.isfinite(shown)
    span = float(np.ptp(shown[is_finite])) if is_finite.any() else 0.0
    if exact:
        shown = np.array([float(f"{value:.8g}") for value in shown])
    elif span > 0.0:
        shown = np.round(shown, max(0, math.ceil(-math.log10(_STEP * span))))
    pairs = zip(shown.tolist(), is_finite.tolist(), strict=True)
    return [value if finite else None for value, finite in pairs]


def _build_traces(panel: Panel, n: str, legend: dict[str, Mark]) -> Iterator[dict[str, Any]]:
    """The series of a panel; takes out of the legend what stands in it by now."""
    axes = {"xaxis": f"x{n}", "yaxis": f"y{n}"}
    for span in panel.spans:
        if legend.pop(span.label, None):
            mark = {"symbol": "square", "size": 11, "color": span.color}
            yield {"type": "scatter", "mode": "markers", "x": [None], "y": [None], **axes,
                   "name": escape_text(span.label), "showlegend": True, "marker": mark,
                   "legendgroup": span.label}  # fmt: skip
    for series in panel.series:
        shown = len(panel.series) > 1 and legend.pop(series.label, None) is not None
        common = {"name": escape_text(series.label), "legendgroup": series.label,
                  "showlegend": shown, "meta": panel.title, **axes}  # fmt: skip
        yield common | _build_trace(series, panel.scale == "log")


def _build_trace(series: Series, log: bool) -> dict[str, Any]:
    if isinstance(series, Heat):
        return {
            "type": "heatmap", "x": [*map(escape_text, series.columns)],
            "y": [*map(escape_text, series.rows)],
            "z": [_convert_numbers(row, True) for row in series.values],
            "text": [[*map(escape_text, row)] for row in series.texts],
            "texttemplate": "%{text}", "zmin": 0.0, "zmax": series.top, "showscale": False,
            "colorscale": _CLEAR_TO_BLUE, "xgap": 2, "ygap": 2, "hoverongaps": False,
            "hovertemplate": "%{y}, %{x}: %{z:.4g}<extra></extra>",
        }  # fmt: skip
    style = series.style
    drawn: dict[str, Any] = {"opacity": style.opacity}
    if isinstance(series, Bars):
        stacked = series.base is not None
        if series.base is not None:
            drawn["base"] = _convert_numbers(series.base, True)
        return drawn | {
            "type": "bar", "x": [*map(escape_text, series.names)],
            "y": _convert_numbers(series.values, True), "text": [*map(escape_text, series.texts)],
            "textposition": "inside" if stacked else "outside", "textangle": 0,
            "cliponaxis": False, "constraintext": "none", "marker": {"color": style.color},
        }  # fmt: skip
    x, y = _outline_band(series) if isinstance(series, Band) else (series.x, series.y)
    drawn |= {"type": "scatter", "x": _convert_numbers(x, log), "y": _convert_numbers(y, log)}
    if isinstance(series, Band):
        return drawn | {"mode": "lines", "line": {"width": 0}, "fill": "toself",
                        "hoverinfo": "skip", "fillcolor": style.color}  # fmt: skip
    line = {"color": style.color, "width": style.width, "dash": "dash" if style.dash else "solid"}
    if isinstance(series, Curve):
        return drawn | {"mode": "lines", "line": line}
    if isinstance(series, Points):
        dots = {"mode": "markers", "marker": {"color": style.color, "size": style.width + 1}}
        many = series.x.size > THRESHOLDS.min_webgl_points
        return drawn | dots | ({"type": "scattergl"} if many else {})
    whiskers = {"array": _convert_numbers(series.error, log), "thickness": 1, "width": 2}
    return drawn | {"mode": "lines+markers" if style.width else "markers", "line": line,
                    "marker": {"color": style.color, "size": 5}, "error_y": whiskers}  # fmt: skip


def _outline_band(band: Band) -> tuple[np.ndarray, np.ndarray]:
    """Round what lies between the curves, a closed piece for each run without a gap."""
    is_finite = np.isfinite(band.low) & np.isfinite(band.high)
    x, y = [np.empty(0)], [np.empty(0)]
    changes = np.flatnonzero(np.diff(is_finite.astype(int))) + 1
    for run in np.split(np.arange(is_finite.size), changes):
        if run.size and is_finite[run[0]]:
            x += [band.x[run], band.x[run[::-1]], np.array([np.nan])]
            y += [band.high[run], band.low[run[::-1]], np.array([np.nan])]
    return np.concatenate(x), np.concatenate(y)


def _build_axes(
    panel: Panel, n: str, across: tuple[float, float], down: tuple[float, float]
) -> tuple[dict[str, Any], dict[str, Any]]:
    log = panel.scale == "log"
    x, y = (
        {"gridcolor": _GRID, "zeroline": False, "linecolor": _FAINT, "anchor": f"{other}{n}",
         "domain": list(ends), "title": {"text": escape_text(label), "standoff": 4}}
        | ({"type": "log", "dtick": 1} if log else {})
        | ({} if view is None else {"range": [math.log10(e) if log else float(e) for e in view]})
        for other, ends, label, view in (("y", across, panel.x_label, panel.x_range),
                                         ("x", down, panel.y_label, panel.y_range))
    )  # fmt: skip
    if log:
        y["exponentformat"] = "e"
    if any(isinstance(s, Bars | Heat) for s in panel.series):
        x["type"] = "category"
    if any(isinstance(s, Heat) for s in panel.series):
        x |= {"showgrid": False, "automargin": True, "tickangle": -35}
        y |= {"type": "category", "autorange": "reversed", "showgrid": False, "automargin": True}
    return x, y


def _build_shapes(panel: Panel, n: str) -> Iterator[dict[str, Any]]:
    """Lines and shaded intervals of a panel; whole heights are in parts of it."""
    whole = {"xref": f"x{n}", "yref": f"y{n} domain", "y0": 0, "y1": 1, "layer": "below"}
    if panel.zero:
        yield {"type": "line", "xref": f"x{n} domain", "yref": f"y{n}", "x0": 0, "x1": 1, "y0": 0,
               "y1": 0, "layer": "below", "line": {"color": _FAINT, "width": 1}}  # fmt: skip
    shaded = [(span.color, ends) for span in panel.spans for ends in span.ends]
    shaded += [] if panel.shade is None else [(SHADE, np.array(panel.shade))]
    for color, (start, end) in shaded:
        yield {"type": "rect", "x0": float(start), "x1": float(end), "fillcolor": color,
               "line": {"width": 0}, **whole}  # fmt: skip
    for place, _ in panel.marks:
        yield {"type": "line", "x0": float(place), "x1": float(place), **whole,
               "line": {"color": _FAINT, "width": 1, "dash": "dot"}}  # fmt: skip


def _build_annotations(panel: Panel, n: str, title: str) -> Iterator[dict[str, Any]]:
    place = {"xref": f"x{n}", "yref": f"y{n} domain", "showarrow": False, "y": 1,
             "xanchor": "left"}  # fmt: skip
    if title:
        yield place | {"text": escape_text(title), "xref": f"x{n} domain", "x": 0,
                       "yanchor": "bottom", "align": "left", "yshift": 4,
                       "font": {"size": 13}}  # fmt: skip
    for at, text in panel.marks:
        if text:
            yield place | {"text": escape_text(text), "x": float(at), "yanchor": "top",
                           "font": {"size": 12}}  # fmt: skip


# What a page shows beside the figure: keys, and maps of cells as tables.


def remove_heat_maps(picture: Picture) -> Picture | None:
    """Returns the picture without its maps of cells, its other panels side by side.

    None where nothing is left to draw.
    """
    if not find_heat_maps(picture):
        return picture
    panels = tuple(
        panel
        for row in picture.panels
        for panel in row
        if not any(isinstance(s, Heat) for s in panel.series)
        and any(len(s.values if isinstance(s, Bars | Heat) else s.x) for s in panel.series)
    )
    if not panels:
        return None
    height = round(picture.height * picture.heights[0] / sum(picture.heights))
    return Picture(picture.name, picture.title, picture.caption, (panels,), height)


def find_heat_maps(picture: Picture) -> list[tuple[Panel, Heat]]:
    """Finds the maps of cells of a picture, each with its panel."""
    panels = [panel for row in picture.panels for panel in row]
    return [(panel, s) for panel in panels for s in panel.series if isinstance(s, Heat)]


def collect_legend(picture: Picture) -> dict[str, Mark]:
    """Collects the legend of shaded spans, and of panels with several series, by label."""
    legend: dict[str, Mark] = {}
    for panel in (panel for row in picture.panels for panel in row):
        for series in panel.series if len(panel.series) > 1 else ():
            if not isinstance(series, Heat):
                legend.setdefault(series.label, (_mix_colour(series), _choose_mark(series)))
        for span in panel.spans:
            legend.setdefault(span.label, (span.color, "span"))
    return legend


def _mix_colour(series: Any) -> str:
    """The colour; of a band, whose ground shines through, mixed with white."""
    style = series.style
    if not isinstance(series, Band):
        return str(style.color)
    parts = (int(style.color[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(255 - style.opacity * (255 - part)):02x}" for part in parts)


def _choose_mark(series: Series) -> str:
    if isinstance(series, Curve):
        return "dashes" if series.style.dash else "line"
    return "bar" if isinstance(series, Bars | Band) else "dots"
