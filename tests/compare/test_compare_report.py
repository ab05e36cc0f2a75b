import base64
import csv
import dataclasses
import io
import json
import os
import re
import threading
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from known_defects import first_joint, prediction

from modeler.cli.places import PictureFolder
from modeler.compare import Comparison, compare, report_html, write_pictures, write_report
from modeler.compare.draw_matplotlib import images
from modeler.compare.picture import Curve, Heat, Panel, Picture, picture_csv
from modeler.compare.pictures import all_pictures
from modeler.compare.residual_picture import binned_means
from modeler.compare.thinning import LIMIT, thin_curves, thin_points
from modeler.core.errors import ModelerError


@pytest.fixture(scope="module")
def found() -> Comparison:
    return compare(prediction(lambda q, qd, qdd, tau, t: 0.5 * qd))


@pytest.fixture(scope="module")
def small() -> Comparison:
    return compare(first_joint(prediction(rows=600)))


@pytest.fixture(scope="module")
def page(found: Comparison) -> str:
    return report_html(found, ["Filter: 20 Hz <both sides>."])


class Tags(HTMLParser):
    """Collects tags, what they load, and open tags, to see that the page is well formed."""

    EMPTY = frozenset({"meta", "br", "link", "img"})

    def __init__(self) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.ids: list[str] = []
        self.stack: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.loads += [value or "" for name, value in attrs if name in ("src", "href", "action")]
        self.ids += [value or "" for name, value in attrs if name == "id"]
        if tag not in self.EMPTY:
            self.stack.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.stack.pop() == tag


def tags(page: str) -> Tags:
    parser = Tags()
    parser.feed(page)
    parser.close()
    return parser


def figures(page: str) -> list[dict[str, Any]]:
    found = re.findall(r'<script type="application/json">(.*?)</script>', page, re.DOTALL)
    return [json.loads(text) for text in found]


def test_page_is_one_file_that_loads_nothing(page: str) -> None:
    parsed = tags(page)
    assert parsed.stack == []
    assert parsed.loads
    for target in parsed.loads:
        assert target.startswith(("#", "data:text/csv"))
    assert set(t[1:] for t in parsed.loads if t.startswith("#")) <= set(parsed.ids)
    assert "default-src 'none'" in page  # the browser itself refuses any network access
    ours = page.rpartition("<script>")[2]
    assert 'showSendToCloud: false, plotlyServerURL: ""' in ours  # no button that uploads
    assert "http" not in ours
    assert "@import" not in page.partition("<script>")[0]
    assert "Plotly" in page and len(page) > 1_000_000  # plotly.js is inside


def test_page_says_the_verdict_first(page: str) -> None:
    head = page.partition("<table>")[0]
    for text in ("How good?", "Where does it fail?", "still have structure?", "Joint 2"):
        assert text in head
    assert "repeatable function of velocity" in head
    assert 'class="noise"' in head and 'class="pattern"' in head


def test_page_escapes_text_and_tells_provenance(page: str) -> None:
    assert "Filter: 20 Hz &lt;both sides&gt;." in page
    assert "one.parquet, two.parquet" in page
    assert "6000 of 6000 count" in page


def test_page_has_every_picture_and_its_numbers(page: str, found: Comparison) -> None:
    pictures = all_pictures(found)
    assert len(pictures) == 1 + 2 * 3
    assert len(figures(page)) == len(pictures)
    links = [target for target in tags(page).loads if target.startswith("data:")]
    assert len(links) == len(pictures)
    for link, picture in zip(links, pictures, strict=True):
        text = base64.b64decode(link.partition("base64,")[2]).decode()
        rows = list(csv.DictReader(io.StringIO(text)))
        assert {row["panel"] for row in rows} == {
            panel.title.replace(",", ";") for row in picture.panels for panel in row if panel.series
        }
        assert all(len(row) == 5 and None not in row for row in rows)


def test_both_renderers_draw_every_series(found: Comparison, page: str) -> None:
    for picture, figure in zip(all_pictures(found), figures(page), strict=True):
        series = [s for row in picture.panels for panel in row for s in panel.series]
        assert len(figure["data"]) == len(series)
        for panel in (panel for row in picture.panels for panel in row):
            assert any(panel.title == note["text"] for note in figure["layout"]["annotations"])


def test_axes_carry_units(found: Comparison) -> None:
    for picture in all_pictures(found)[1:]:
        for panel in (panel for row in picture.panels for panel in row if panel.series):
            assert panel.x_label.endswith("]") and panel.y_label.endswith("]")
        assert len(picture.caption) > 100


def test_no_curve_has_too_many_points() -> None:
    drawn = all_pictures(compare(prediction(rows=20000)))
    for panel in (panel for picture in drawn for row in picture.panels for panel in row):
        for series in panel.series:
            if isinstance(series, Curve):
                assert series.x.size <= LIMIT + 10


def test_stacked_bars_fill_the_whole(found: Comparison, page: str) -> None:
    """Both stacks of every joint end at 100 %, in the picture and on the page."""
    torque, left = all_pictures(found)[0].panels[1]
    for panel in (torque, left):
        for k in range(3):
            assert sum(bars.values[k] for bars in panel.series) == pytest.approx(100.0)
        last = panel.series[-1]
        np.testing.assert_allclose(last.base + last.values, 100.0)
    item = found.joints[1]
    assert item.shares is not None
    assert torque.series[1].values[1] == pytest.approx(100 * item.shares.systematic)
    stacked = [trace for trace in figures(page)[0]["data"] if trace.get("base") is not None]
    assert len(stacked) == 5


def test_page_is_the_same_twice(small: Comparison) -> None:
    assert report_html(small) == report_html(small)


def test_page_without_a_judged_joint() -> None:
    p = prediction()
    empty = compare(dataclasses.replace(p, measured=np.zeros_like(p.measured)))
    page = report_html(empty)
    assert "no joint could be judged" in page and "not judged" in page
    assert tags(page).stack == []


def test_files_and_folders(small: Comparison, tmp_path: Path) -> None:
    assert write_report(tmp_path / "page.html", small) == tmp_path / "page.html"
    assert write_report(tmp_path / "folder", small) == tmp_path / "folder" / "compare.html"
    assert sorted(path.name for path in tmp_path.rglob("*.html")) == ["compare.html", "page.html"]
    (tmp_path / "plain").write_text("a file")
    with pytest.raises(ModelerError, match="cannot be written"):
        write_report(tmp_path / "plain", small)


def test_a_page_may_go_into_a_pipe(small: Comparison, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append((tmp_path / "pipe").read_text("utf-8")))
    reader.start()
    assert write_report(tmp_path / "pipe", small) == tmp_path / "pipe"
    reader.join(20)
    assert read == [report_html(small)] and (tmp_path / "pipe").is_fifo()


def test_pictures_as_files(small: Comparison, tmp_path: Path) -> None:
    done: list[float] = []
    written = write_pictures(tmp_path, small, done.append)
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
    panel = Panel(
        "t", "x [s]", "y [m]", (Heat("h", ("a",), ("b",), np.ones((1, 1)), (("1",),), 2),)
    )
    picture = Picture("p", "p", "c", ((panel,),), (1.0,), (1.0,), 200)
    assert images(picture) == images(picture)
    assert picture_csv(picture).splitlines()[1:] == ["t,h,a / b,1,"]


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


def test_short_curves_stay_whole() -> None:
    np.testing.assert_array_equal(thin_curves((np.arange(10.0),)), np.arange(10))
    np.testing.assert_array_equal(thin_points(np.arange(10.0), np.arange(10.0)), np.arange(10))


def test_scatter_keeps_its_extremes() -> None:
    rng = np.random.default_rng(0)
    x, y = rng.normal(size=(2, 50_000))
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
        centre, mean, error = binned_means(x, slow)
        inside += int(np.sum(np.abs(mean) <= error))
        bins += centre.size
    assert 0.9 < inside / bins < 0.985
