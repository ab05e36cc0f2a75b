"""Pages of comparisons: all that is drawn is in them, captions name colours that are there."""

import base64
import dataclasses
import gzip
import html
import itertools
import json
import os
import re
import threading
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from known_defects import first_joint, prediction

from modeler.cli.places import PictureFolder
from modeler.core.figure import (
    BLUE,
    LIMIT,
    SHADE,
    Band,
    Bars,
    Curve,
    Heat,
    Panel,
    Picture,
    Style,
    thin_curves,
    thin_points,
)
from modeler.regression.observation import MASKS
from modeler.validation.comparison import Comparison, compare
from modeler.validation.pictures import (
    compute_binned_means,
    draw_overlay_picture,
    draw_time_picture,
    find_masked_spans,
)
from modeler.validation.prediction import Prediction
from modeler.views.comparison import build_comparison_page, draw_all_pictures
from modeler.views.figure_plotly import build_figure, build_page_figure, collect_legend
from modeler.views.figures import format_csv, write_files
from modeler.views.page import Figure, Page, Section, render_page, write_page
from tests.captions import assert_named, colours_drawn, colours_said
from tests.when_used import WhenUsed

figure_matplotlib = WhenUsed("modeler.views.figure_matplotlib")


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    return compare(prediction(lambda q, qd, qdd, tau, t: 0.5 * qd))


@pytest.fixture(scope="module")
def small() -> Comparison:
    return compare(first_joint(prediction(rows=600)))


@pytest.fixture(scope="module")
def page(comparison: Comparison) -> str:
    return render_page(build_comparison_page(comparison, ["Filter: 20 Hz <both sides>."]))


def outside_scripts(page: str) -> str:
    return re.sub(r"(<(script|style)\b[^>]*>).*?(?=</\2>)", r"\1", page, flags=re.DOTALL)


def still_open(page: str) -> list[str]:
    """Tags that are not closed; those that are, in the order in which they were opened."""
    stack: list[str] = []
    for closes, name in re.findall(r"<(/?)([a-z]\w*)[^>]*>", outside_scripts(page)):
        if closes:
            assert stack.pop() == name
        elif name not in ("meta", "br", "link", "img"):
            stack.append(name)
    return stack


def figures(page: str) -> list[dict[str, Any]]:
    """The figures of a page, unpacked as its script does it."""
    match = re.search(r'<script type="text/plain" id="figures">(.*?)</script>', page)
    assert match
    return list(json.loads(gzip.decompress(base64.b64decode(match[1]))))


def test_page_is_one_file_that_loads_nothing_and_says_the_verdict_first(page: str) -> None:
    head = page.partition("<table")[0]
    for text in ("How good?", "Where does it fail?", "still have structure?", "Joint 2",
                 "function of velocity", 'class="noise"', 'class="pattern"'):  # fmt: skip
        assert text in head
    for text in ("20 Hz &lt;both sides&gt;.", "one.parquet, two.parquet", "6000 of 6000 count"):
        assert text in page
    assert still_open(page) == []
    loads = re.findall(r'\b(?:src|href|action)="([^"]*)"', outside_scripts(page))
    assert loads and all(target.startswith("#") for target in loads)
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert {target[1:] for target in loads if target != "#"} <= set(ids)
    assert "default-src 'none'" in page  # the browser itself refuses any network access
    ours = page.partition("<script>")[2]
    assert 'showSendToCloud: false, plotlyServerURL: ""' in ours  # no button that uploads
    assert "http" not in ours
    assert "@import" not in page.partition("<script>")[0]
    assert 'id="plotly"' in page and 400_000 < len(page) < 800_000  # plotly.js is inside, packed


def test_page_has_every_picture_and_its_numbers(page: str, comparison: Comparison) -> None:
    """All that is drawn is in the page; maps of cells are tables."""
    pictures = draw_all_pictures(comparison)
    assert len(pictures) == 1 + 2 * 3 == len(figures(page)) == page.count("<a download=")
    for picture, figure in zip(pictures, figures(page), strict=True):
        panels = [panel for row in picture.panels for panel in row]
        drawn = [s for panel in panels for s in panel.series if not isinstance(s, Heat)]
        for series, trace in zip(drawn, figure["data"], strict=True):
            assert trace["name"] == series.label
            if isinstance(series, Bars):
                np.testing.assert_allclose(trace["y"], series.values, rtol=1e-6)
                continue
            if isinstance(series, Band):
                continue  # an outline: tests/studio/test_figures.py
            for key, values in (("x", series.x), ("y", series.y)):
                held = values[np.isfinite(values)]
                span = np.ptp(held) if held.size else 0.0
                numbers = np.array(trace[key], dtype=float)
                np.testing.assert_allclose(numbers, values, rtol=1e-7, atol=1e-6 * span)
        titles = {trace["meta"] for trace in figure["data"]}
        maps = {p.title for p in panels for s in p.series if isinstance(s, Heat)}
        assert titles | maps == {panel.title for panel in panels if panel.series}
        assert all(f"<caption>{html.escape(title)}</caption>" in page for title in maps)


def test_numbers_of_any_size_come_through() -> None:
    clock = 1.7e9 + 0.002 * np.arange(7)  # that single precision would stop
    odd = np.array([np.nan, np.inf, 0.0, -1e-3, 1e30, 1.0, 2.0])
    decades, still = np.geomspace(1e-12, 1e3, 7), np.full(7, 2.5)

    def kept(x: np.ndarray, y: np.ndarray, scale: Any = "linear") -> list[np.ndarray]:
        panel = Panel("", "", "", (Curve("c", x, y, Style(BLUE)),), scale)
        page = render_page(Page("t", ("", ""), [Section("s", [page_figure(panel)])]))
        return [np.array(figures(page)[0]["data"][0][axis], dtype=float) for axis in "xy"]

    x, y = kept(clock, odd)
    np.testing.assert_allclose(x, clock, rtol=0, atol=1e-8)
    np.testing.assert_allclose(y, [np.nan, np.nan, 0.0, 0.0, 1e30, 0.0, 0.0], atol=1e25)
    x, y = kept(decades, still, "log")
    np.testing.assert_allclose(x, decades, rtol=1e-7)
    np.testing.assert_array_equal(y, still)


def page_figure(panel: Panel) -> Figure:
    return Figure(Picture("p", "p", "c", ((panel,),), 200))


def test_a_narrow_page_has_its_panels_below_one_another(comparison: Comparison) -> None:
    """By the same axes: the traces are those of the wide one."""
    figure = build_page_figure(draw_time_picture(comparison.prediction, comparison.joints[0]))
    wide, narrow = figure["layout"], figure["narrow"]
    assert wide["xaxis2"]["domain"][0] > wide["xaxis"]["domain"][1]
    axes = [name for name in wide if name.startswith("xaxis")]
    assert [name for name in narrow if name.startswith("xaxis")] == axes
    assert all(narrow[name]["domain"] == [0.0, 1.0] for name in axes)
    heights = [narrow[name.replace("x", "y", 1)]["domain"] for name in axes]
    assert all(low[1] < high[0] for high, low in itertools.pairwise(heights))
    assert narrow["height"] > 2 * wide["height"] and figure["below"] > 700


def test_stacked_bars_fill_the_whole(comparison: Comparison, page: str) -> None:
    """Both stacks of every joint end at 100 %, in the picture and on the page."""
    torque, left = draw_all_pictures(comparison)[0].panels[1]
    for panel in (torque, left):
        for k in range(3):
            assert sum(bars.values[k] for bars in panel.series) == pytest.approx(100.0)
        last = panel.series[-1]
        np.testing.assert_allclose(last.base + last.values, 100.0)
    item = comparison.joints[1]
    assert item.shares is not None
    assert torque.series[1].values[1] == pytest.approx(100 * item.shares.systematic_share)
    stacked = [trace for trace in figures(page)[0]["data"] if "base" in trace]
    assert len(stacked) == 5


def test_page_without_a_judged_joint() -> None:
    p = prediction()
    empty = compare(dataclasses.replace(p, measured=np.zeros_like(p.measured)))
    page = render_page(build_comparison_page(empty))
    assert "no joint could be judged" in page and "not judged" in page
    assert still_open(page) == []


def test_a_page_may_go_into_a_pipe(small: Comparison, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append((tmp_path / "pipe").read_text("utf-8")))
    reader.start()
    assert write_page(tmp_path / "pipe", build_comparison_page(small)) == tmp_path / "pipe"
    reader.join(20)
    assert read == [render_page(build_comparison_page(small))] and (tmp_path / "pipe").is_fifo()


@pytest.mark.slow
def test_pictures_as_files(small: Comparison, tmp_path: Path) -> None:
    done: list[float] = []
    written = write_files(tmp_path, draw_all_pictures(small), done.append)
    assert done == pytest.approx([1 / 3, 2 / 3, 1.0])
    assert {path.suffix for path in written} == {".png", ".svg", ".csv"}
    for path in written:  # the command line keeps these names free of its other files
        assert any(path.match(pattern) for pattern in PictureFolder.writes)
    assert len(written) == 3 * 3
    for path in written:
        data = path.read_bytes()
        if path.suffix == ".png":
            assert data.startswith(b"\x89PNG")
        elif path.suffix == ".svg":
            assert ET.fromstring(data).tag.endswith("svg")
            assert b"<dc:date>" not in data and b"Matplotlib v" not in data


def test_svg_is_the_same_twice() -> None:
    heat = Panel("t", "x [s]", "y [m]", (Heat("h", ("a",), ("b",), np.ones((1, 1)), (("1",),), 2),))
    picture = Picture("p", "p", "c", ((heat,),), 200)
    assert figure_matplotlib.render_images(picture) == figure_matplotlib.render_images(picture)
    assert format_csv(picture).splitlines()[1:] == ["t,h,a / b,1,"]


def test_thinning_keeps_the_extremes_and_the_ends() -> None:
    rng = np.random.default_rng(0)
    for rows in (4001, 10_000, 123_457):
        curves = tuple(rng.normal(size=rows) for _ in range(3))
        curves[1][rows // 3 : rows // 2] = np.nan
        for values, place in zip(curves, (17, 0, rows - 2), strict=True):
            values[place] = 50.0
            values[place + 1] = -50.0
        kept = thin_curves(curves)
        assert kept.size <= LIMIT and np.all(np.diff(kept) > 0)
        assert kept[0] == 0 and kept[-1] == rows - 1
        for values in curves:
            assert np.nanmax(values[kept]) == 50.0 and np.nanmin(values[kept]) == -50.0
        assert np.isnan(curves[1][kept]).any()  # the gap is still to be seen


def test_scatter_keeps_its_extremes() -> None:
    rng = np.random.default_rng(0)
    x, y = rng.normal(size=(2, 50_000))
    np.testing.assert_array_equal(thin_points(x[:10], y[:10]), np.arange(10))
    np.testing.assert_array_equal(thin_curves((x[:10],)), np.arange(10))
    kept = thin_points(x, y, 1000)
    assert kept.size <= 1000
    assert {np.argmax(y), np.argmin(y), np.argmax(x), np.argmin(x)} <= set(kept.tolist())


def test_binned_means_cover_the_truth() -> None:
    """Two standard errors hold the true mean in about 95 % of the bins, also for slow noise."""
    rng = np.random.default_rng(0)
    inside, bins = 0, 0
    for _ in range(20):
        x = np.sin(np.arange(6000) * 0.02 + rng.uniform(0, 6))
        slow = np.repeat(rng.normal(size=600), 10)  # alike for ten samples
        centre, mean, error = compute_binned_means(x, slow)
        inside += int(np.sum(np.abs(mean) <= error))
        bins += centre.size
    assert 0.9 < inside / bins < 0.985


@pytest.fixture(scope="module")
def made() -> Prediction:
    """Every reason on joint 1, a gap in the first log, and a band."""
    whole = prediction(lambda q, qd, qdd, tau, t: 0.5 * qd, rows=4800)
    masks = np.full(whole.used.shape, -1, dtype=np.int8)
    for k in range(len(MASKS)):
        masks[300 * k + 100 : 300 * k + 160, 0] = k
    used = masks < 0
    used[2300:2350, 0] = False  # for no reason of its own
    piece = whole.segment.copy()
    piece[1500:] += 1
    time = whole.time.copy()
    time[1500:] += 0.7
    sigma = 0.05 + 0.02 * np.abs(whole.qd)
    return dataclasses.replace(whole, masks=masks, used=used, segment=piece, time=time, sigma=sigma)


@pytest.fixture(scope="module")
def compared(made: Prediction) -> Comparison:
    return compare(made)


def test_every_picture_names_colours_that_are_there(compared: Comparison) -> None:
    plain = compare(first_joint(prediction(rows=900)))
    heated = first_joint(prediction(rows=900))
    heat = 20.0 + heated.time[:, None]
    for whole in (compared, plain, compare(dataclasses.replace(heated, temperature=heat))):
        for picture in draw_all_pictures(whole):
            assert_named(picture)


def test_several_models_are_named_by_their_colours(made: Prediction) -> None:
    others = [dataclasses.replace(made, predicted=made.predicted + k) for k in range(3)]
    picture = draw_overlay_picture(["a", "b", "c"], others, 0)
    assert colours_said(picture) == colours_drawn(picture)
    assert all(name in picture.caption for name in ("a", "b", "c"))


def test_what_is_shaded_is_what_does_not_count(made: Prediction) -> None:
    rows = np.arange(made.time.size)
    spans = {span.label: span.ends for span in find_masked_spans(made, 0, made.time, rows)}
    assert set(spans) == {*MASKS, "no rows", "left out"}
    shaded = np.zeros(made.time.size, dtype=bool)
    for label, ends in spans.items():
        for start, end in ends:
            shaded |= (made.time > start) & (made.time < end) & (label != "no rows")
    np.testing.assert_array_equal(shaded, ~made.used[:, 0])
    for k, name in enumerate(MASKS):
        (start, end) = spans[name][0]
        assert made.time[300 * k + 100] - start == pytest.approx(0.005)
        assert end - made.time[300 * k + 159] == pytest.approx(0.005)
    gap = spans["no rows"]
    assert gap.shape == (1, 2) and np.ptp(gap) == pytest.approx(0.7)
    assert (
        find_masked_spans(made, 1, made.time, rows)[0].label == "no rows"
    )  # all rows of joint 2 count


def test_both_drawers_draw_what_is_shaded_and_the_band(
    made: Prediction, compared: Comparison
) -> None:
    picture = draw_time_picture(made, compared.joints[0])
    whole, worst = picture.panels[0]
    band = next(s for s in worst.series if isinstance(s, Band))
    assert not any(isinstance(s, Band) for s in whole.series)
    labels = collect_legend(picture)
    for span in whole.spans:
        assert labels[span.label] == (span.color, "span")
    plotly = build_figure(picture)
    filled = {s["fillcolor"] for s in plotly["layout"]["shapes"] if s["type"] == "rect"}
    assert filled == {SHADE, *(s.color for s in whole.spans)}
    assert any(trace.get("fill") == "toself" for trace in plotly["data"])
    svg = figure_matplotlib.render_images(picture)["svg"].decode()
    for span in whole.spans:
        assert span.color.lower() in svg.lower() and span.label in svg
    assert band.label in svg and f"{band.label}," in format_csv(picture)


def test_the_band_is_two_deviations_of_the_prediction(
    made: Prediction, compared: Comparison
) -> None:
    item = compared.joints[0]
    worst = draw_time_picture(made, item).panels[0][1]
    band = next(s for s in worst.series if isinstance(s, Band))
    at = np.searchsorted(made.time, band.x)
    np.testing.assert_allclose(band.high - band.low, 4.0 * made.sigma[at, 0], rtol=1e-9)
    middle = 0.5 * (band.high + band.low)
    np.testing.assert_allclose(middle, made.predicted[at, 0], atol=1e-9)
    rows = made.used[:, 0]
    rms = float(np.sqrt(np.mean(made.sigma[rows, 0] ** 2)))
    assert item.predicted_sigma == pytest.approx(rms)
    assert compared.to_json()["joints"]["1"]["predicted_sigma"] == pytest.approx(rms)
