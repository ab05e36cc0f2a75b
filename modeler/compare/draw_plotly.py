"""A picture as a plotly figure."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from modeler.compare.picture import BLUE, Bars, Curve, Heat, Means, Panel, Picture, Points, Series

_GRID = "#e4e4e4"


def figure_json(picture: Picture) -> str:
    """The figure (data and layout) as JSON that plotly.js draws; safe inside a script element."""
    return str(_figure(picture).to_json()).replace("<", "\\u003c")


def _figure(picture: Picture) -> go.Figure:
    rows, columns = len(picture.panels), len(picture.panels[0])
    figure = make_subplots(
        rows=rows,
        cols=columns,
        row_heights=list(picture.heights),
        column_widths=list(picture.widths),
        subplot_titles=[panel.title for row in picture.panels for panel in row],
        horizontal_spacing=0.07,
        vertical_spacing=(0.11 if picture.shared_time else 0.17) * 500 / picture.height,
    )
    labelled: set[str] = set()
    for i, row in enumerate(picture.panels, start=1):
        for j, panel in enumerate(row, start=1):
            _add_panel(figure, panel, (i, j), labelled)
            if not picture.shared_time or i == rows:
                figure.update_xaxes(title_text=panel.x_label, row=i, col=j)
            if picture.shared_time and i < rows:
                below = (rows - 1) * columns + j
                figure.update_xaxes(matches=f"x{below}", showticklabels=False, row=i, col=j)
    figure.update_annotations(font_size=13)
    figure.update_xaxes(gridcolor=_GRID, zeroline=False, title_standoff=4)
    figure.update_yaxes(gridcolor=_GRID, zeroline=False, title_standoff=4)
    figure.update_layout(
        template="none",
        height=picture.height,
        margin={"l": 62, "r": 14, "t": 54, "b": 48},
        font={"family": "system-ui, sans-serif", "size": 12, "color": "#222"},
        legend={"orientation": "h", "x": 0, "y": 1, "yref": "container", "yanchor": "top"},
        hovermode="closest",
        barmode="overlay",
    )
    return figure


def _add_panel(figure: go.Figure, panel: Panel, at: tuple[int, int], labelled: set[str]) -> None:
    place = {"row": at[0], "col": at[1]}
    for series in panel.series:
        trace = _trace(series)
        if not isinstance(series, Heat):
            several = len(panel.series) > 1
            trace.update(showlegend=several and series.label not in labelled)
            trace.update(legendgroup=series.label)
            if several:
                labelled.add(series.label)
        figure.add_trace(trace, **place)
        if isinstance(series, Heat):
            figure.update_yaxes(autorange="reversed", type="category", **place)
            figure.update_xaxes(type="category", **place)
        if isinstance(series, Bars):
            figure.update_xaxes(type="category", **place)
    if panel.zero:
        figure.add_hline(0.0, line={"color": "#666", "width": 0.8}, layer="below", **place)
    if panel.shade is not None:
        figure.add_vrect(*panel.shade, fillcolor="#d0d0d0", line_width=0, layer="below", **place)
    for position, text in panel.marks:
        figure.add_vline(
            position,
            line={"color": "#888", "width": 0.8, "dash": "dot"},
            annotation={"text": text, "font": {"size": 10}},
            annotation_position="top right",
            **place,
        )
    figure.update_yaxes(title_text=panel.y_label, **place)
    if panel.x_range is not None:
        figure.update_xaxes(range=panel.x_range, **place)
    if panel.y_range is not None:
        figure.update_yaxes(range=panel.y_range, **place)
    if not panel.series:
        figure.update_xaxes(visible=False, **place)
        figure.update_yaxes(visible=False, **place)
    if panel.scale == "log":
        figure.update_xaxes(type="log", **place)
        figure.update_yaxes(type="log", exponentformat="power", **place)


def _trace(series: Series) -> Any:
    if isinstance(series, Heat):
        return _cells(series)
    if isinstance(series, Bars):
        return go.Bar(
            x=series.names,
            y=_compact(series.values),
            text=series.texts,
            base=None if series.base is None else _compact(series.base),
            textposition="outside" if series.base is None else "inside",
            cliponaxis=False,
            marker_color=series.style.color,
            name=series.label,
        )
    return go.Scatter(
        x=_compact(series.x),
        y=_compact(series.y),
        name=series.label,
        opacity=series.style.opacity,
        **_look(series),
    )


def _cells(heat: Heat) -> go.Heatmap:
    return go.Heatmap(
        x=heat.columns,
        y=heat.rows,
        z=_compact(heat.values),
        text=heat.texts,
        texttemplate="%{text}",
        colorscale=[[0, "#ffffff"], [1, BLUE]],
        zmin=0.0,
        zmax=heat.top,
        showscale=False,
        xgap=2,
        ygap=2,
    )


def _look(series: Curve | Points | Means) -> dict[str, Any]:
    """What tells lines, dots and means apart."""
    style = series.style
    line = {"color": style.color, "width": style.width}
    if isinstance(series, Curve):
        return {"mode": "lines", "line": line | {"dash": "dash" if style.dash else "solid"}}
    if isinstance(series, Points):
        return {"mode": "markers", "marker": {"color": style.color, "size": style.width + 1}}
    return {
        "mode": "lines+markers" if style.width else "markers",
        "line": line,
        "marker": {"color": style.color, "size": 5},
        "error_y": {"array": _compact(series.error), "thickness": 1, "width": 2},
    }


def _compact(values: np.ndarray) -> np.ndarray:
    """Single precision: half the page, and finer than any screen."""
    return np.asarray(values, dtype=np.float32)
