"""The pages of commands in a real browser: whole, readable, drawn, without network."""

import csv
import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from modeler.cli import main
from modeler.views.page import write_index
from tests.browser.chromium import Chromium
from tests.rotation import rotating, with_cases

WIDE, NARROW = (1400, 900), (400, 800)
OKABE_ITO = {"#000000", "#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7"}
GREYS = {"#9a9a9a"}
COMMANDS = {
    "compare": "compare m.json other.parquet",
    "diagnose": "diagnose m.json train.parquet --holdout other.parquet",
    "add": "add m.json load_friction --joint 2 train.parquet --holdout other.parquet --out m2.json",
}


@pytest.fixture(scope="module")
def page_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Makes the page of a command about an arm with a hidden load friction; its JSON is beside."""
    folder = tmp_path_factory.mktemp("pages")

    def run(words: str) -> None:
        files = (".json", ".parquet", ".html")
        assert main([str(folder / w) if w.endswith(files) else w for w in words.split()]) == 0

    for seed, log in ((4, "train.parquet"), (5, "other.parquet")):
        run(
            f"simulate demo-arm --hide load_friction@2 --duration 15 --rate 200 --seed {seed} "
            f"--out {log}"
        )
    run("fit demo-arm train.parquet --out m.json")

    @cache
    def made(name: str) -> Path:
        run(f"{COMMANDS[name]} --report {name}.html --json {name}.json")
        return folder / f"{name}.html"

    return made


def shown(browser: Chromium, page: Path, size: tuple[int, int]) -> str:
    """The rendered text of a page whose pictures have all been drawn."""
    browser.open(page, *size)
    browser.until("[...document.querySelectorAll('a[download]')].every((link) => !link.hidden)")
    browser.value("window.dispatchEvent(new Event('beforeprint'))")  # which draws them all
    browser.until(
        "[...document.querySelectorAll('.plot')].every((p) => p.querySelector('.main-svg'))"
    )
    browser.value("window.scrollTo(0, 0)")
    return text_of(browser)


def text_of(browser: Chromium) -> str:
    return " ".join(str(browser.value("document.body.innerText")).split())


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
_COLOURS = (  # of each text, and of what it stands on
    f"{_TEXTS}.filter((e) => !e.closest('svg') && !e.closest('.cells')).map((e) => {{"
    " let b = e; while (b && /, 0\\)$/.test(getComputedStyle(b).backgroundColor))"
    " b = b.parentElement;"
    " return [getComputedStyle(e).color, getComputedStyle(b || document.body).backgroundColor]; })"
)


@with_cases(
    "name, size",
    ("compare", NARROW),
    *rotating(("compare", WIDE), *((n, s) for n in ("diagnose", "add") for s in (NARROW, WIDE))),
)
def test_a_page_is_whole_and_works_alone_at_any_width(browser, page_of, tmp_path, name, size):
    page = page_of(name)
    result = json.loads(page.with_suffix(".json").read_text())
    text = shown(browser, page, size)
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
    assert drawn and all(marks > 0 and width >= 320 for marks, width in drawn)
    for word in ("p-value", "p value", "hypothes", "null ", "confidence"):
        assert word not in f"{text} {browser.value('document.title')}".lower()
    check_colours(browser)
    numbers = downloaded(browser, tmp_path, len(drawn))
    if name == "diagnose":
        check_diagnosis(text, result)
    elif name == "add":
        check_waterfall(browser, text, result["waterfall"], numbers)


def luminance(color: str) -> float:
    """Relative luminance of "rgb(r, g, b)", WCAG 2.1."""
    parts = [int(part) / 255 for part in color.partition("(")[2].rstrip(")").split(",")[:3]]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def check_colours(browser: Chromium) -> None:
    """Series in colours of Okabe and Ito, or grey; every text at least 4.5 : 1, in the dark too."""
    series = browser.value(
        "[...document.querySelectorAll('.plot')].flatMap((p) => p.data)"
        ".flatMap((t) => [t.marker && t.marker.color, t.line && t.line.color])"
        ".filter((c) => typeof c === 'string')"
    )
    assert series and {color.lower() for color in series} <= OKABE_ITO | GREYS
    fills = browser.value(
        "[...document.querySelectorAll('.plot text')].filter((e) => e.textContent.trim())"
        ".map((e) => getComputedStyle(e).fill)"
    )
    pairs = [(fill, "rgb(255, 255, 255)") for fill in fills]  # pictures stay on white
    for scheme, darkest in (("dark", 0.1), ("light", 1.1)):
        browser.page.emulate_media(color_scheme=scheme)
        value = browser.value(_COLOURS)
        assert len(value) > 20 and any(luminance(reference) < darkest for _, reference in value)
        pairs += map(tuple, value)
    for color, base in {*pairs}:
        high, low = sorted((luminance(color), luminance(base)), reverse=True)
        assert (high + 0.05) / (low + 0.05) >= 4.5, (color, base)


def downloaded(browser: Chromium, folder: Path, pictures: int) -> list[dict[str, str]]:
    """The numbers of every picture."""
    assert pictures == browser.value("document.querySelectorAll('figure a[download]').length")
    every = []
    for link in range(pictures):
        with browser.download(folder, link).open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        assert rows and list(rows[0]) == ["panel", "series", "x", "y", "error"]
        assert all(float(row["y"]) == float(row["y"]) for row in rows)
        every += rows
    return every


def check_diagnosis(text: str, diagnosed: dict[str, Any]) -> None:
    """It is all there."""
    for sentence in diagnosed["sentences"]:
        assert " ".join(sentence.split()) in text
    assert "missing: friction that grows with the load on the gear, joint 2" in text
    for effect in diagnosed["effects"]:
        row = f"{effect['effect']} ({effect['status']}) {effect['joint']}"
        ties = (f"{tie['effect']} on joint {tie['joint']}" for tie in effect["ties"])
        values = (f"{name} = {value:.4g}" for name, value in effect["parameters"].items())
        assert all(words in text for words in (row, *ties, *values))
    assert diagnosed["undetectable"]
    for spot in diagnosed["undetectable"]:
        assert spot["effect"] + (f"@{spot['joint']}:" if spot["joint"] else ":") in text
    for words in (
        "model: demo-arm, 25 base parameters, fitted on train.parquet",
        "logs explained: train.parquet",
        "Held-out motion other.parquet",
    ):
        assert words in text


def check_waterfall(browser, text, waterfall, numbers):
    """It is all there, in the picture, in the table and in the numbers."""
    errors = [100.0 * step["error"] for step in waterfall]
    assert errors[-1] < 0.5 * errors[0]
    drawn = str(browser.value("document.querySelector('.plot').textContent"))
    assert all(f"{error:.4g}"[:4] in drawn for error in errors)
    assert "as fitted" in drawn and "@2" in drawn
    held = [float(row["y"]) for row in numbers if row["panel"] == "On held-out logs"]
    assert held == pytest.approx(errors, rel=1e-3)
    for words in (
        "as fitted + load_friction @2",
        "judged on other.parquet",
        "modeler add MODEL load_friction --joint 2 LOG... --out MODEL",
    ):
        assert words in text


def test_a_browser_that_cannot_unpack_says_so(browser: Chromium, page_of) -> None:
    browser.open(page_of("compare"), *NARROW, "delete window.DecompressionStream")
    browser.until("document.querySelector('.plot').textContent.trim() !== ''")
    text = text_of(browser)
    assert "This browser cannot draw the picture: it lacks DecompressionStream" in text
    assert "other.parquet" in text and browser.complaints == []


@pytest.mark.parametrize("size", [NARROW, pytest.param(WIDE, marks=pytest.mark.rotating)])
def test_pages_without_pictures_are_legible(browser, tmp_path, size):
    """Formulas, the index and the robot; the verdict and the next command on the first screen."""
    assert main(["show", "wrist", "--out", str(tmp_path / "show.html")]) == 0
    assert main(["derive", "wrist", "--report", str(tmp_path / "derive.html")]) == 0
    write_index(tmp_path)
    for name in ("show.html", "index.html", "derive.html"):
        browser.open(tmp_path / name, *size)
        width = browser.value("document.documentElement.scrollWidth")
        assert width <= size[0] and browser.complaints == []
        assert browser.requests == [(tmp_path / name).resolve().as_uri()]
        assert browser.value(_SMALL) == []
        if name == "index.html":
            assert browser.value("document.querySelectorAll('.pages a').length") == 2
    last = browser.value("document.querySelector('.next code').getBoundingClientRect().bottom")
    assert 0 < last < size[1]
    high = browser.value("document.querySelector('mfrac, msub').getBoundingClientRect().height")
    assert high > 10  # the browser sets formulas
