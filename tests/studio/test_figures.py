"""Figures of plotly.js: every kind of series, every setting of a panel, drawn once by a browser."""

import math
from typing import Any

import numpy as np

from modeler.core.figure import BLUE, Curve, Panel, Picture, Points, Style
from modeler.studio.figures import read_x_range
from modeler.views.figure_plotly import build_figure
from tests.studio.drawn import CLOUD, EVERY_KIND, SHARED, X, Y


def traces(picture: Picture) -> dict[str, dict[str, Any]]:
    """By name; of equal names the last."""
    return {trace["name"]: trace for trace in build_figure(picture)["data"]}


def test_every_kind_of_series_is_drawn_as_it_is() -> None:
    local = traces(EVERY_KIND)
    measured = local["measured"]
    assert measured["mode"] == "lines" and measured["line"]["color"] == "#000000"
    np.testing.assert_allclose(np.array(measured["y"], dtype=float), Y, atol=1e-6)
    assert measured["y"].count(None) == int(np.isnan(Y).sum()) > 0
    assert local["predicted"]["line"]["dash"] == "dash"
    assert local["samples"]["mode"] == "markers" and local["samples"]["type"] == "scatter"
    mean = local["mean"]
    assert mean["mode"] == "lines+markers" and mean["error_y"]["array"] == [0.05] * 7
    bars = local["left"]
    assert bars["type"] == "bar" and bars["base"] == [60.0, 80.0] and bars["y"] == [40.0, 20.0]
    assert bars["x"] == ["1", "two<br>lines"] and bars["text"] == ["40", "20"]
    cells = local["share"]
    assert cells["type"] == "heatmap" and cells["z"] == [[10.0, None], [0.0, 90.0], [55.0, 20.0]]
    assert cells["zmax"] == 100.0 and cells["y"] == ["1", "2", "3"]


def test_a_band_is_a_closed_piece_for_each_run() -> None:
    band = traces(EVERY_KIND)["band"]
    x, y = (np.array(band[axis], dtype=float) for axis in "xy")
    pieces = np.split(np.arange(x.size), np.flatnonzero(np.isnan(x)) + 1)
    areas = []
    for piece in (item[:-1] for item in pieces if item.size):
        u, v = x[piece], y[piece]
        areas.append(0.5 * abs(np.dot(u, np.roll(v, 1)) - np.dot(v, np.roll(u, 1))))
    held = X[~np.isnan(Y)]
    widths = [np.ptp(entry) for entry in np.split(held, np.flatnonzero(np.diff(held) > 0.15) + 1)]
    np.testing.assert_allclose(areas, 0.2 * np.array(widths), rtol=1e-6)  # of height 0.2
    assert band["fill"] == "toself" and band["opacity"] == 0.4


def test_a_panel_has_its_axes_lines_and_spans() -> None:
    made = build_figure(EVERY_KIND)
    layout = made["layout"]
    assert layout["xaxis"]["range"] == [0.0, 6.0] and layout["yaxis"]["range"] == [-1.0, 1.0]
    assert layout["xaxis"]["title"]["text"] == "time [s]"
    spectrum = layout["xaxis4"]
    assert spectrum["type"] == "log"
    np.testing.assert_allclose(spectrum["range"], [math.log10(0.1), math.log10(10.0)])
    rects = [shape for shape in layout["shapes"] if shape["type"] == "rect"]
    ends = [(shape["x0"], shape["x1"]) for shape in rects]
    assert ends == [(0.5, 1.0), (5.0, 5.5), (4.0, 4.5)]
    lines = [shape for shape in layout["shapes"] if shape["type"] == "line"]
    assert any(line.get("y0") == line.get("y1") == 0 for line in lines)
    assert any(line["x0"] == line["x1"] == 2.0 for line in lines)
    texts = [note["text"] for note in layout["annotations"]]
    assert "second log" in texts and "Torque &lt;b>&amp;&lt;/b>" in texts  # no tag of a name
    assert layout["paper_bgcolor"] == layout["plot_bgcolor"] == "rgba(0,0,0,0)"
    assert not any(trace.get("xaxis") == "x6" for trace in made["data"])  # an empty panel
    domains = [layout[f"xaxis{n}"]["domain"] for n in ("", "2")]
    assert domains[0][1] < domains[1][0]
    heights = [layout[f"yaxis{n}"]["domain"] for n in ("", "3", "5")]
    assert heights[0][0] > heights[1][1] > heights[1][0] > heights[2][1]


def test_rows_of_one_time_share_their_axis_and_their_legend() -> None:
    named = [trace["name"] for trace in build_figure(SHARED)["data"] if trace["showlegend"]]
    assert sorted(named) == ["band", "low speed", "measured", "predicted"]
    alone = Picture("one", "", "", ((Panel("", "x", "y", (CLOUD.series[0],)),),), 300)
    assert not build_figure(alone)["layout"]["showlegend"]
    layout = build_figure(SHARED, time="log")["layout"]
    assert layout["xaxis2"]["matches"] == "x" and "matches" not in layout["xaxis"]
    assert layout["xaxis"]["showticklabels"] is False
    assert layout["meta"] == {"time": "log"} and layout["uirevision"] == "shared"


def drawn(series: Curve | Points) -> dict[str, Any]:
    """A series of a picture of it alone, as it is drawn."""
    return build_figure(Picture("p", "", "", ((Panel("", "x", "y", (series,)),),), 300))["data"][0]


def test_many_dots_are_drawn_by_the_graphics_processor() -> None:
    x = np.random.default_rng(3).normal(size=20_000)
    assert drawn(Points("many", x, x, Style(BLUE)))["type"] == "scattergl"


def test_numbers_keep_what_a_zoom_of_a_thousand_shows() -> None:
    x = 1.7e9 + np.linspace(0.0, 100.0, 200)  # seconds since 1970
    actual = drawn(Curve("c", x, 1e-9 * np.sin(x), Style(BLUE)))
    assert np.abs(np.array(actual["x"]) - x).max() < 1e-6 * 100.0
    assert np.abs(np.array(actual["y"]) - 1e-9 * np.sin(x)).max() < 1e-6 * 2e-9 * 1.01


def test_what_a_relayout_says_of_time() -> None:
    assert read_x_range({"xaxis.range[0]": 1.5, "xaxis.range[1]": 2.5}) == (1.5, 2.5)
    assert read_x_range({"xaxis2.range": [0, 3]}) == (0.0, 3.0)
    assert read_x_range({"xaxis.autorange": True, "yaxis.autorange": True}) is None
    assert read_x_range({"yaxis.range[0]": 1.0, "yaxis.range[1]": 2.0}) is False
