"""The room of pages: what is vendored is what it says, and pages stay small."""

import ast
import hashlib
import re

import pytest

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


_TAG = re.compile(
    r"(?<!\w)</?(?:!doctype|html|head|body|title|style|script|div|span|p|a|b|i|br|code|pre|h[1-6]|ul|ol|li|"
    r"table|thead|tbody|tr|t[dh]|caption|figure|figcaption|section|header|footer|button|sub|sup|"
    r"math|m[a-z]+)\b[^<]*>",
    re.I,
)


def tags_in(text: str) -> list[str]:
    """Strings of a module that hold a tag, docstrings left out; and what escapes by hand."""
    if not _TAG.search(text) and not re.search(r"\b(html|markupsafe)\b", text):
        return []  # most modules, without parsing them
    tree = ast.parse(text)
    told = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    found = [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in told
        if _TAG.search(node.value)
    ]
    found += [
        "import html"
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in ([node.module] if isinstance(node, ast.ImportFrom) else node.names)
        if (name if isinstance(name, str) else getattr(name, "name", "")) in ("html", "markupsafe")
    ]
    return found


NOTEBOOK = {"modeler/core/result.py", "modeler/core/table.py"}
"""Tables in a notebook are no pages: fragments of a few tags, and the core knows no jinja2."""


NEIGHBOURS = ("modeler/robot/xml_source.py", "modeler/robot/urdf.py", "modeler/robot/mjcf.py")
"""Readers of XML name its elements; `modeler/exports` writes such files, which are no pages."""


CONSTANT = {"modeler/studio/access.py", "modeler/studio/app.py", "modeler/studio/figures.py"}
"""A line that leads on, the links of a head, and the line break of plotly.js: no page, no name."""


def test_no_module_writes_a_tag_or_escapes_by_hand() -> None:
    """Templates do both: what one module forgets to escape is a hole in the page."""
    found = {
        path.relative_to(ROOT).as_posix(): tags
        for path in (ROOT / "modeler").rglob("*.py")
        if (tags := tags_in(path.read_text(encoding="utf-8")))
        and path.relative_to(ROOT).as_posix() not in NEIGHBOURS
        and path.parent.name != "exports"
    }
    assert found.keys() <= NOTEBOOK | CONSTANT, found


@pytest.mark.parametrize(
    "text", ['x = "<b>bold</b>"', 'x = f"<td>{y}</td>"', "import html", "from html import escape"]
)
def test_a_planted_tag_is_found(text: str) -> None:
    assert tags_in(text)


def test_only_what_we_made_is_printed_as_it_is() -> None:
    """`| safe` in templates: assets, packed scripts and numbers, JSON, and our own drawing."""
    own = {"asset(", "json(", "content", "drawings.block()", "drawings.content(", "plotly()", "svg"}
    for path in (ROOT / "templates" / "pages").glob("*.jinja"):
        text = path.read_text(encoding="utf-8")
        for expression in re.findall(r"\{\{-?\s*([^{}]*?)\s*\|\s*safe", text):
            assert any(expression.startswith(start) for start in own), (path.name, expression)
        assert "autoescape" not in text
