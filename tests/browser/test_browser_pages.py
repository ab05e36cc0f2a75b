"""The pages of `diagnose` and `add` in a real browser: whole, readable, drawn, without network."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from modeler.cli import main
from modeler.report.page import write_index
from tests.browser.chromium import Chromium

WIDE, NARROW = (1400, 900), (400, 800)
SIZES = [NARROW, pytest.param(WIDE, marks=pytest.mark.rotating)]
NAMES = [
    "diagnosis",
    *(pytest.param(name, marks=pytest.mark.rotating) for name in ("added", "compared")),
]
OKABE_ITO = {"#000000", "#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7"}
GREYS = {"#9a9a9a"}


@dataclass(frozen=True)
class Pages:
    """The two pages and what they should say."""

    diagnosis: Path
    diagnosed: dict[str, Any]
    added: Path
    waterfall: list[dict[str, Any]]
    compared: Path


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Pages:
    """An arm with a hidden load friction, diagnosed; the effect added."""
    folder = tmp_path_factory.mktemp("pages")
    place = {n: str(folder / n) for n in ("m.json", "d.html", "d.json", "a.html", "a.json", "m2")}
    logs = [str(folder / "train.parquet"), "--holdout", str(folder / "other.parquet")]
    for seed, log in ((4, logs[0]), (5, logs[2])):
        words = ["simulate", "demo-arm", "--hide", "load_friction@2", "--duration", "15"]
        assert main([*words, "--rate", "200", "--seed", str(seed), "--out", log]) == 0
    assert main(["fit", "demo-arm", logs[0], "--out", place["m.json"]]) == 0
    words = ["diagnose", place["m.json"], *logs]
    assert main([*words, "--report", place["d.html"], "--json", place["d.json"]]) == 0
    words = ["add", place["m.json"], "load_friction", "--joint", "2", *logs, "--out", place["m2"]]
    assert main([*words, "--report", place["a.html"], "--json", place["a.json"]]) == 0
    words = ["compare", place["m.json"], logs[2], "--report", str(folder / "c.html")]
    assert main(words) == 0
    diagnosed = json.loads((folder / "d.json").read_text())
    waterfall = json.loads((folder / "a.json").read_text())["waterfall"]
    return Pages(folder / "d.html", diagnosed, folder / "a.html", waterfall, folder / "c.html")


def shown(browser: Chromium, page: Path, size: tuple[int, int]) -> str:
    """The rendered text of a page whose pictures have all been drawn."""
    browser.open(page, *size)
    browser.until("[...document.querySelectorAll('a[download]')].every((link) => !link.hidden)")
    browser.value("window.dispatchEvent(new Event('beforeprint'))")  # which draws them all
    browser.until(
        "[...document.querySelectorAll('.plot')].every((p) => p.querySelector('.main-svg'))"
    )
    browser.value("window.scrollTo(0, 0)")
    return " ".join(str(browser.value("document.body.innerText")).split())


@pytest.mark.rotating("long tests of browser")
@pytest.mark.parametrize("size", SIZES)
def test_the_diagnosis_is_all_there(browser: Chromium, pages: Pages, size: tuple[int, int]) -> None:
    text = shown(browser, pages.diagnosis, size)
    diagnosed = pages.diagnosed
    for sentence in diagnosed["sentences"]:
        assert " ".join(sentence.split()) in text
    assert "missing: friction that grows with the load on the gear, joint 2" in text
    for effect in diagnosed["effects"]:
        assert (
            f"{effect['effect']} ({effect['status']}) {effect['joint']}" in text
        )  # a row of the table
        for tie in effect["ties"]:
            assert f"{tie['effect']} on joint {tie['joint']}" in text
        for name, value in effect["parameters"].items():
            assert f"{name} = {value:.4g}" in text
    assert diagnosed["blind_spots"]
    for spot in diagnosed["blind_spots"]:
        joint = f"@{spot['joint']}" if spot["joint"] else ""
        assert f"{spot['effect']}{joint}:" in text
    for words in ("model: demo-arm, 25 base parameters, fitted on train.parquet",
                  "logs explained: train.parquet", "Held-out motion other.parquet"):  # fmt: skip
        assert words in text


@pytest.mark.parametrize("size", SIZES)
def test_the_waterfall_is_all_there(browser: Chromium, pages: Pages, size: tuple[int, int]) -> None:
    text = shown(browser, pages.added, size)
    first, last = pages.waterfall[0]["error"], pages.waterfall[-1]["error"]
    assert last < 0.5 * first
    drawn = str(browser.value("document.querySelector('.plot').textContent"))
    for step in pages.waterfall:
        assert f"{100.0 * step['error']:.4g}"[:4] in drawn
    assert "as fitted" in drawn and "@2" in drawn
    assert "as fitted + load_friction @2" in text  # the head of the table joint by joint
    assert "judged on other.parquet" in text
    assert "modeler add MODEL load_friction --joint 2 LOG... --out MODEL" in text


_TEXTS = (
    "[...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().width > 0 &&"
    " !['SCRIPT', 'STYLE'].includes(e.tagName) &&"
    " [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim()))"
)
_SMALL = (  # letters of less than 12 pixels
    f"{_TEXTS}.filter((e) => parseFloat(getComputedStyle(e).fontSize) < 12)"
    ".map((e) => e.textContent.slice(0, 30))"
)
_COVERED = (  # titles of panels and keys that lie on one another
    "[...document.querySelectorAll('figure')].flatMap((figure) => {"
    " const boxes = [...figure.querySelectorAll('.annotation-text, .keys button')]"
    ".map((e) => [e.textContent, e.getBoundingClientRect()]);"
    " return boxes.flatMap(([a, p], i) => boxes.slice(i + 1).filter(([, q]) =>"
    " p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1)"
    ".map(([b]) => `${a} / ${b}`)); })"
)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", NAMES)
def test_a_page_works_alone_at_any_width(
    browser: Chromium, pages: Pages, name: str, size: tuple[int, int]
) -> None:
    page: Path = getattr(pages, name)
    shown(browser, page, size)
    assert browser.complaints == []
    assert browser.requests == [page.resolve().as_uri()]
    wide, room = browser.value(
        "[document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    assert wide <= room == size[0]  # tables and pictures are pushed aside, never the page
    headline = browser.value("document.querySelector('.headline').getBoundingClientRect().bottom")
    assert 0 < headline < size[1]  # the verdict is on the first screen
    command = browser.value("document.querySelector('.next code').getBoundingClientRect().bottom")
    assert headline < command < size[1]  # and so is the next command
    assert browser.value(_SMALL) == []
    assert browser.value(_COVERED) == []
    assert page.stat().st_size < 1_000_000
    drawn = browser.value(
        "[...document.querySelectorAll('.plot')].map((p) => ["
        "p.querySelectorAll('.main-svg .trace path').length,"
        "p.querySelector('.main-svg').getBoundingClientRect().width])"
    )
    assert drawn
    for marks, width in drawn:
        assert marks > 0 and width >= 320


@pytest.mark.parametrize("size", SIZES)
def test_a_page_is_legible_in_the_dark(
    browser: Chromium, pages: Pages, size: tuple[int, int]
) -> None:
    """Every text at least 4.5 : 1 against what it stands on; pictures stay on white."""
    dark = {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
    browser.ask("Emulation.setEmulatedMedia", dark)
    try:
        shown(browser, pages.compared, size)
        found = browser.value(
            f"{_TEXTS}.filter((e) => !e.closest('svg') && !e.closest('.cells')).map((e) => {{"
            " let b = e; while (b && /, 0\\)$/.test(getComputedStyle(b).backgroundColor))"
            " b = b.parentElement;"
            " return [getComputedStyle(e).color, getComputedStyle(b || document.body)"
            ".backgroundColor]; })"
        )
    finally:
        browser.ask("Emulation.setEmulatedMedia", {"features": []})
    assert len(found) > 50 and any(luminance(ground) < 0.1 for _, ground in found)
    for color, ground in {tuple(pair) for pair in found}:
        high, low = sorted((luminance(color), luminance(ground)), reverse=True)
        assert (high + 0.05) / (low + 0.05) >= 4.5, (color, ground)


@pytest.mark.parametrize("name", NAMES)
def test_the_numbers_of_every_picture_can_be_downloaded(
    browser: Chromium, pages: Pages, tmp_path: Path, name: str
) -> None:
    shown(browser, getattr(pages, name), WIDE)
    pictures = browser.value("document.querySelectorAll('.plot').length")
    assert pictures == browser.value("document.querySelectorAll('figure a[download]').length") > 0
    every = []
    for link in range(pictures):
        with browser.download(tmp_path, link).open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        every += rows
        assert rows and list(rows[0]) == ["panel", "series", "x", "y", "error"]
        assert all(float(row["y"]) == float(row["y"]) for row in rows)
    if name == "added":
        held = [float(row["y"]) for row in every if row["panel"] == "On held-out logs"]
        assert held == pytest.approx([100.0 * s["error"] for s in pages.waterfall], rel=1e-3)


def test_a_browser_that_cannot_unpack_says_so(browser: Chromium, pages: Pages) -> None:
    script = {"source": "delete window.DecompressionStream"}
    added = browser.ask("Page.addScriptToEvaluateOnNewDocument", script)
    try:
        browser.open(pages.added, *NARROW)
        browser.until("document.querySelector('.plot').textContent.trim() !== ''")
        text = " ".join(str(browser.value("document.body.innerText")).split())
    finally:
        browser.ask("Page.removeScriptToEvaluateOnNewDocument", added)
    assert "This browser cannot draw the picture: it lacks DecompressionStream" in text
    assert "judged on other.parquet" in text and browser.complaints == []


@pytest.mark.parametrize("size", SIZES)
def test_pages_without_pictures_are_legible(
    browser: Chromium, tmp_path: Path, size: tuple[int, int]
) -> None:
    """Formulas, the index and the robot; the verdict and the next command on the first screen."""
    assert main(["derive", "wrist", "--report", str(tmp_path / "derive.html")]) == 0
    assert main(["show", "wrist", "--out", str(tmp_path / "show.html")]) == 0
    write_index(tmp_path)
    for name in ("derive.html", "show.html", "index.html"):
        page = tmp_path / name
        browser.open(page, *size)
        width = browser.value("document.documentElement.scrollWidth")
        assert width <= size[0] and browser.complaints == []
        assert browser.requests == [page.resolve().as_uri()]
        assert browser.value(_SMALL) == []
    assert browser.value("document.querySelectorAll('.pages a').length") == 2
    browser.open(tmp_path / "derive.html", *size)
    last = browser.value("document.querySelector('.next code').getBoundingClientRect().bottom")
    assert 0 < last < size[1]
    high = browser.value("document.querySelector('mfrac, msub').getBoundingClientRect().height")
    assert high > 10  # the browser sets formulas


def luminance(color: str) -> float:
    """Relative luminance of "rgb(r, g, b)", WCAG 2.1."""
    parts = [int(part) / 255 for part in color.partition("(")[2].rstrip(")").split(",")[:3]]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("name", NAMES)
def test_colours_are_told_apart_and_words_are_plain(
    browser: Chromium, pages: Pages, name: str
) -> None:
    """Series in colours of Okabe and Ito, or grey; text at least 4.5 : 1 on white."""
    text = shown(browser, getattr(pages, name), WIDE).lower()
    text += str(browser.value("document.title")).lower()
    for word in ("p-value", "p value", "significan", "hypothes", "null ", "confidence"):
        assert word not in text
    series = browser.value(
        "[...document.querySelectorAll('.plot')].flatMap((p) => p.data)"
        ".flatMap((t) => [t.marker && t.marker.color, t.line && t.line.color])"
        ".filter((c) => typeof c === 'string')"
    )
    assert series and {color.lower() for color in series} <= OKABE_ITO | GREYS
    texts = browser.value(
        "[...document.querySelectorAll('h1,h2,h3,p,li,b,table:not(.cells) td,th,caption,figcaption,"
        "a,.plot text')]"
        ".filter((e) => e.textContent.trim() && e.getBoundingClientRect().width > 0)"
        ".map((e) => { const s = getComputedStyle(e);"
        " return e.closest('svg') ? s.fill : s.color; })"
    )
    assert len(texts) > 20
    assert min(1.05 / (luminance(color) + 0.05) for color in set(texts)) >= 4.5
