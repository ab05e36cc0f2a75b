"""Figures of plotly.js on a screen, and what it says of a zoom."""

from typing import TYPE_CHECKING, Any, Literal

from modeler.api.front_end import Picture, build_figure

if TYPE_CHECKING:
    from nicegui import ui

_CONFIG = {"displaylogo": False, "doubleClick": "autosize",
           "modeBarButtonsToRemove": ["lasso2d", "select2d", "autoScale2d"]}  # fmt: skip


def build_plot(picture: Picture, time: str = "") -> dict[str, Any]:
    """Builds data, layout and configuration for `ui.plotly`, as `views.build_figure`."""
    return build_figure(picture, time=time) | {"config": _CONFIG}


def draw_picture(picture: Picture, time: str = "") -> "ui.plotly":
    """Draws title, figure and caption, and returns the plot."""
    from nicegui import ui

    with ui.column().classes("picture w-full gap-1"):
        if picture.title:
            ui.label(picture.title).classes("picture-title")
        plot = ui.plotly(build_plot(picture, time)).classes("w-full")
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
