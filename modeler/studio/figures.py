"""A picture as a figure of plotly.js: one translation for all that the studio draws."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from modeler.api.front_end import SHADE, Band, Bars, Curve, Heat, Panel, Picture, Points, Series
from modeler.studio.thresholds import THRESHOLDS

if TYPE_CHECKING:
    from nicegui import ui

_WIDTH = 1150  # pixels that gaps between panels are thought for
_LEFT, _RIGHT, _TOP, _TITLE, _BOTTOM, _LEGEND = 64, 16, 12, 26, 48, 26
_BETWEEN, _BESIDE, _SHARED = 84, 84, 42
_DIGITS = 6  # of the range of an axis: finer than a pixel at any zoom of thinned points
_GRID, _FAINT = "rgba(128,128,128,0.25)", "rgba(128,128,128,0.8)"
_NONE = "rgba(0,0,0,0)"
_CLEAR_TO_BLUE = [[0.0, "rgba(0,114,178,0)"], [1.0, "rgba(0,114,178,0.75)"]]


def build_figure(picture: Picture, time: str = "") -> dict[str, Any]:
    """Builds data, layout and configuration for `ui.plotly`.

    Grounds are transparent, texts are coloured by the style sheet of the page, which follows the
    system into the dark. Zoom survives when the figure is drawn again.

    Args:
        picture: what to draw.
        time: a name that pictures whose x is the time of one log share: the page gives them one
            cursor and one zoom.
    """
    rows, columns = len(picture.panels), len(picture.panels[0])
    titled = any(panel.title for panel in picture.panels[0])
    top = _TOP + _TITLE * titled + _LEGEND * _needs_legend(picture)
    layout: dict[str, Any] = {
        "height": picture.height,
        "margin": {"l": _LEFT, "r": _RIGHT, "t": top, "b": _BOTTOM + _compute_name_height(picture)},
        "paper_bgcolor": _NONE, "plot_bgcolor": _NONE, "hovermode": "closest",
        "barmode": "overlay", "uirevision": picture.name, "meta": {"time": time},
        "font": {"family": "system-ui, sans-serif", "size": 12, "color": "#333333"},
        "legend": {"orientation": "h", "x": 0, "xanchor": "left", "yref": "container", "y": 1,
                   "yanchor": "top", "bgcolor": _NONE},
        "shapes": [], "annotations": [],
    }  # fmt: skip
    data: list[dict[str, Any]] = []
    across = _divide_range(picture.widths, (_WIDTH - _LEFT - _RIGHT), _BESIDE)
    between = _SHARED if picture.shared_time else _BETWEEN + _compute_name_height(picture)
    inner = layout["height"] - layout["margin"]["t"] - layout["margin"]["b"]
    down = [(1.0 - b, 1.0 - a) for a, b in _divide_range(picture.heights, inner, between)]
    known: set[str] = set()
    for i, row in enumerate(picture.panels):
        for j, panel in enumerate(row):
            if not panel.series:
                continue
            n = _format_axis_number(i * columns + j)
            axes = _build_axes(panel, n, across[j], down[i])
            if picture.shared_time:
                if i < rows - 1:
                    axes[f"xaxis{n}"] |= {"showticklabels": False, "title": None}
                if i:
                    axes[f"xaxis{n}"]["matches"] = f"x{_format_axis_number(j)}"
            layout.update(axes)
            data += _build_traces(panel, n, known)
            layout["shapes"] += _build_shapes(panel, n)
            layout["annotations"] += _build_annotations(panel, n)
    layout["showlegend"] = _needs_legend(picture)
    return {"data": data, "layout": layout, "config": _CONFIG}


_CONFIG = {"displaylogo": False, "doubleClick": "autosize",
           "modeBarButtonsToRemove": ["lasso2d", "select2d", "autoScale2d"]}  # fmt: skip


def draw_picture(picture: Picture, time: str = "") -> "ui.plotly":
    """Draws title, figure and caption, and returns the plot."""
    from nicegui import ui

    with ui.column().classes("picture w-full gap-1"):
        if picture.title:
            ui.label(picture.title).classes("picture-title")
        plot = ui.plotly(build_figure(picture, time)).classes("w-full")
        if picture.caption:
            ui.label(picture.caption).classes("picture-caption")
    return plot


def read_x_range(change: dict[str, Any]) -> tuple[float, float] | Literal[False] | None:
    """Reads the range of x from a `plotly_relayout`; None: all, False: unchanged."""
    for key, value in change.items():
        if key.startswith("xaxis") and key.endswith("autorange") and value:
            return None
        if key.startswith("xaxis") and key.endswith(".range"):
            return float(value[0]), float(value[1])
        if key.startswith("xaxis") and key.endswith(".range[0]"):
            return float(value), float(change[key[:-2] + "1]"])
    return False


def _needs_legend(picture: Picture) -> bool:
    """Whether it needs a legend."""
    panels = (panel for row in picture.panels for panel in row)
    return any(panel.spans or len(panel.series) > 1 for panel in panels)


def _format_axis_number(place: int) -> str:
    """Of a pair of axes, as plotly.js counts them: the first has none."""
    return str(place + 1) if place else ""


def _compute_name_height(picture: Picture) -> int:
    """Pixels for names of bars in more than one line."""
    every = (s for row in picture.panels for panel in row for s in panel.series)
    names = (name for s in every if isinstance(s, Bars) for name in s.names)
    return 15 * max((name.count("\n") for name in names), default=0)


def _divide_range(shares: Sequence[float], room: float, gap: float) -> list[tuple[float, float]]:
    """Ends of so many segments of 0 to 1, with gaps between."""
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


def _convert_numbers(values: np.ndarray, log: bool = False) -> list[float | None]:
    """What a screen shows of an array; what is not finite is a gap."""
    exact = np.asarray(values, dtype=float)
    is_finite = np.isfinite(exact)
    span = float(np.ptp(exact[is_finite])) if is_finite.any() else 0.0
    if span > 0.0 and not log:
        exact = np.round(exact, max(0, _DIGITS - math.floor(math.log10(span))))
    numbers = exact.tolist()
    return (
        numbers
        if is_finite.all()
        else [v if ok else None for v, ok in zip(numbers, is_finite, strict=True)]
    )


def _build_traces(panel: Panel, n: str, known: set[str]) -> Iterator[dict[str, Any]]:
    """The series of a panel; each label stands in the legend once."""
    log, several = panel.scale == "log", len(panel.series) > 1
    axes = {"xaxis": f"x{n}", "yaxis": f"y{n}"}
    for span in panel.spans:
        fresh = span.label not in known
        known.add(span.label)
        if fresh:
            mark = {"symbol": "square", "size": 11, "color": span.color}
            yield {"type": "scatter", "mode": "markers", "x": [None], "y": [None], **axes,
                   "name": escape_text(span.label), "showlegend": True, "marker": mark,
                   "legendgroup": span.label}  # fmt: skip
    for series in panel.series:
        fresh = several and series.label not in known and not isinstance(series, Heat)
        if fresh:
            known.add(series.label)
        common = {"name": escape_text(series.label), "legendgroup": series.label,
                  "showlegend": fresh, **axes}  # fmt: skip
        yield common | _build_trace(series, log)


def _build_trace(series: Series, log: bool) -> dict[str, Any]:
    if isinstance(series, Heat):
        return {
            "type": "heatmap", "x": [escape_text(name) for name in series.columns],
            "y": [escape_text(name) for name in series.rows],
            "z": [_convert_numbers(row, log=True) for row in series.values],
            "text": [[escape_text(text) for text in row] for row in series.texts],
            "texttemplate": "%{text}", "zmin": 0.0, "zmax": series.top, "showscale": False,
            "colorscale": _CLEAR_TO_BLUE, "xgap": 2, "ygap": 2, "hoverongaps": False,
            "hovertemplate": "%{y}, %{x}: %{z:.4g}<extra></extra>",
        }  # fmt: skip
    style = series.style
    if isinstance(series, Bars):
        bars: dict[str, Any] = {
            "type": "bar",
            "x": [escape_text(name) for name in series.names],
            "y": _convert_numbers(series.values),
            "text": [escape_text(text) for text in series.texts],
            "textposition": "outside" if series.base is None else "inside",
            "textangle": 0,
            "cliponaxis": False,
            "constraintext": "none",
            "marker": {"color": style.color},
            "opacity": style.opacity,
        }
        return bars if series.base is None else bars | {"base": _convert_numbers(series.base)}
    if isinstance(series, Band):
        x, y = _outline_band(series)
        return {
            "type": "scatter",
            "mode": "lines",
            "x": _convert_numbers(x, log),
            "y": _convert_numbers(y, log),
            "line": {"width": 0},
            "fill": "toself",
            "hoverinfo": "skip",
            "fillcolor": style.color,
            "opacity": style.opacity,
        }
    kind = (
        "scattergl"
        if isinstance(series, Points) and series.x.size > THRESHOLDS.min_webgl_points
        else "scatter"
    )
    drawn = {
        "type": kind,
        "x": _convert_numbers(series.x, log),
        "y": _convert_numbers(series.y, log),
        "opacity": style.opacity,
    }
    line = {"color": style.color, "width": style.width, "dash": "dash" if style.dash else "solid"}
    if isinstance(series, Curve):
        return drawn | {"mode": "lines", "line": line}
    if isinstance(series, Points):
        return drawn | {
            "mode": "markers",
            "marker": {"color": style.color, "size": style.width + 1},
        }
    whiskers = {"array": _convert_numbers(series.error, log), "thickness": 1, "width": 2}
    return drawn | {"mode": "lines+markers" if style.width else "markers", "line": line,
                    "marker": {"color": style.color, "size": 5}, "error_y": whiskers}  # fmt: skip


def _outline_band(band: Band) -> tuple[np.ndarray, np.ndarray]:
    """Round what lies between the curves, a closed piece for each run without a gap."""
    is_finite = np.isfinite(band.low) & np.isfinite(band.high)
    x, y = [], []
    for run in np.split(
        np.arange(is_finite.size), np.flatnonzero(np.diff(is_finite.astype(int))) + 1
    ):
        if run.size and is_finite[run[0]]:
            x += [band.x[run], band.x[run[::-1]], [np.nan]]
            y += [band.high[run], band.low[run[::-1]], [np.nan]]
    return (np.concatenate(x), np.concatenate(y)) if x else (np.empty(0), np.empty(0))


def _build_axes(
    panel: Panel, n: str, across: tuple[float, float], down: tuple[float, float]
) -> dict[str, dict[str, Any]]:
    log = panel.scale == "log"
    common: dict[str, Any] = {"gridcolor": _GRID, "zeroline": False, "linecolor": _FAINT}
    x = common | {"anchor": f"y{n}", "domain": list(across),
                  "title": {"text": escape_text(panel.x_label), "standoff": 4}}  # fmt: skip
    y = common | {"anchor": f"x{n}", "domain": list(down),
                  "title": {"text": escape_text(panel.y_label), "standoff": 4}}  # fmt: skip
    if log:
        x |= {"type": "log", "dtick": 1}
        y |= {"type": "log", "dtick": 1, "exponentformat": "e"}
    if any(isinstance(s, Bars | Heat) for s in panel.series):
        x["type"] = "category"
    if any(isinstance(s, Heat) for s in panel.series):
        x |= {"showgrid": False, "automargin": True, "tickangle": -35}
        y |= {"type": "category", "autorange": "reversed", "showgrid": False, "automargin": True}
    for axis, ends in ((x, panel.x_range), (y, panel.y_range)):
        if ends is not None:
            axis["range"] = [math.log10(end) if log else float(end) for end in ends]
    return {f"xaxis{n}": x, f"yaxis{n}": y}


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


def _build_annotations(panel: Panel, n: str) -> Iterator[dict[str, Any]]:
    place = {"xref": f"x{n}", "yref": f"y{n} domain", "showarrow": False, "y": 1}
    if panel.title:
        yield place | {"text": escape_text(panel.title), "xref": f"x{n} domain", "x": 0,
                       "xanchor": "left", "yanchor": "bottom", "align": "left", "yshift": 4,
                       "font": {"size": 13}}  # fmt: skip
    for at, text in panel.marks:
        if text:
            yield place | {"text": escape_text(text), "x": float(at), "xanchor": "left",
                           "yanchor": "top", "font": {"size": 11}}  # fmt: skip
