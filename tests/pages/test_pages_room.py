"""The package of pages: what is vendored is what it says; the index of a folder."""

import hashlib
import re
from pathlib import Path

import pytest

from modeler.views.page import Origin, Page, Paragraph, Section, find_pages, write_index, write_page
from tests.repository import ROOT

# plotly.js-basic-dist-min of the npm registry
VENDORED = {
    "plotly-basic.min.js": "99784e3abfb07b142a15e521a439e6d9addceadb3f79553fd24c72774f0649ba",
    "LICENSE": "8c45d9eaf50c2f72dd9c7ab9ef440788ba58a3538484b5c51c1f17d5128752e7",
}


def test_plotly_js_is_the_one_that_is_named() -> None:
    folder = ROOT / "templates" / "plotly"
    assert {path.name for path in folder.iterdir()} == VENDORED.keys()
    for name, checksum in VENDORED.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == checksum, name
    docs = (ROOT / "docs" / "reference" / "pages.md").read_text(encoding="utf-8")
    assert all(checksum in docs for checksum in VENDORED.values()) and "| 4.1.1 |" in docs
    head = (folder / "plotly-basic.min.js").read_text(encoding="utf-8")[:200]
    assert "basic - minified) v4.1.1" in head and "MIT license" in head


def test_only_what_we_made_is_printed_as_it_is() -> None:
    """`| safe` in templates: assets, packed scripts and numbers, JSON, and our own drawing."""
    own = {"asset(", "json(", "content", "drawings.encode()", "plotly()", "svg"}
    for path in (ROOT / "templates" / "pages").glob("*.jinja"):
        text = path.read_text(encoding="utf-8")
        for expression in re.findall(r"\{\{-?\s*([^{}]*?)\s*\|\s*safe", text):
            assert any(expression.startswith(start) for start in own), (path.name, expression)
        assert "autoescape" not in text


def sheet(command: str, figure: str = "3 %", held_out: bool | None = None) -> Page:
    body = [Section("s", [Paragraph("text")])]
    origin = Origin("a <b>.json", ["x & y.csv"], held_out)
    return Page(f"page of {command}", (figure, "left </script>"), body, origin, command=command)


def test_a_folder_gets_an_index_and_a_file_does_not(tmp_path: Path) -> None:
    write_page(tmp_path / "alone.html", sheet("compare"))
    assert [path.name for path in tmp_path.iterdir()] == ["alone.html"]
    write_page(tmp_path, sheet("diagnose", held_out=True))
    write_page(tmp_path / "sub", sheet("fit"))
    assert {path.name for path in tmp_path.iterdir()} == {
        *"alone.html diagnosis.html index.html sub".split()
    }
    assert (tmp_path / "sub" / "index.html").exists()


def test_it_says_what_each_page_says(tmp_path: Path) -> None:
    for command, held in (("diagnose", True), ("compare", False), ("derive", None)):
        write_page(tmp_path / f"{command}.html", sheet(command, held_out=held))
        write_page(tmp_path / "sub" / f"{command}.html", sheet(command))
    place = write_index(tmp_path, "all <of> it")
    assert place == tmp_path / "index.html"
    found = find_pages(tmp_path)
    assert [entry.place for entry in found] == [
        *(f"{name}.html" for name in ("derive", "compare", "diagnose")),
        *(f"sub/{name}.html" for name in ("derive", "compare", "diagnose")),
    ]
    first = found[2]
    assert (first.figure, first.verdict, first.held_out) == ("3 %", "left </script>", True)
    assert (first.model, first.logs) == ("a <b>.json", ("x & y.csv",))
    text = place.read_text(encoding="utf-8")
    links = re.findall(r'<a href="([^"]+)"', text)
    assert links == [entry.place for entry in found]
    assert all((tmp_path / link).is_file() for link in links)
    assert "all &lt;of&gt; it" in text and "left &lt;/script&gt;" in text
    assert text.count("held-out motion") == 1 and text.count("training only") == 1
    assert 'id="plotly"' not in text and len(text) < 30_000
    assert write_index(tmp_path, "all <of> it") == place  # its own index is written anew
    assert place.read_text(encoding="utf-8") == text


@pytest.mark.parametrize("content", ["mine", "", '<script type="application/json" id="about">no'])
def test_somebody_elses_index_stays(tmp_path: Path, content: str) -> None:
    (tmp_path / "index.html").write_text(content)
    (tmp_path / "other.html").write_bytes(b"\xff\xfe no page of ours")
    write_page(tmp_path, sheet("compare"))
    assert write_index(tmp_path) is None
    assert (tmp_path / "index.html").read_text() == content
    assert [entry.place for entry in find_pages(tmp_path)] == ["compare.html"]


def test_what_a_page_says_wrongly_does_no_harm(tmp_path: Path) -> None:
    said = '{"logs": "abc", "held_out": "yes", "title": 5, "command": null}'
    block = f'<script type="application/json" id="about">{said}</script>'
    (tmp_path / "odd.html").write_text(block)
    (entry,) = find_pages(tmp_path)
    assert (entry.title, entry.logs, entry.held_out, entry.command) == ("5", (), None, "")
