"""Pages that the site makes from the program say what the program says, and none is forgotten."""

import argparse
import importlib
import json
import re
import subprocess
import sys

import pytest

import modeler.api
from docsite.commands import command_pages, commands
from docsite.gallery import coefficients, exhibit, gallery_index
from docsite.hooks import BESIDE, notebooks
from docsite.interface import exported, interface_pages
from docsite.markdown import cell, code, fenced, table
from docsite.notebook import executed, notebook_page
from docsite.packages import draw_packages
from modeler.api import derive, generate, load
from modeler.cli import main
from tests.repository import ROOT

DOCS = ROOT / "docs"
WRITTEN = sorted(path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md"))


def listed() -> list[str]:
    """The pages of `nav` in mkdocs.yml."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    return re.findall(r"- (?:\w+: )?([\w/-]+\.md)$", text[text.index("\nnav:") :], re.MULTILINE)


def test_every_page_has_its_place_and_every_place_its_page() -> None:
    made = {*BESIDE.values(), *notebooks(), "gallery/robots/index.md", "gallery/effects/index.md"}
    made |= {f"{section}/index.md" for section in ("gallery", "commands", "python")}
    assert sorted(listed()) == sorted(made | set(WRITTEN)), "mkdocs.yml: nav has other pages"


@pytest.mark.rotating("pages of the site")
def test_the_picture_of_the_packages_matches_the_imports(regenerate: bool) -> None:
    picture = ROOT / "docs" / "explanation" / "packages.svg"
    drawn = draw_packages(ROOT / "modeler")
    if regenerate:
        picture.write_text(drawn, encoding="utf-8")
    assert picture.read_text(encoding="utf-8") == drawn, "run `make regenerate`"


def test_files_that_the_architecture_page_names_exist() -> None:
    text = (ROOT / "docs" / "explanation" / "architecture.md").read_text(encoding="utf-8")
    for paragraph in text.split("\n\n"):
        room = ""
        for name in re.findall(r"`((?:[a-z_]+/)?[a-z_]+\.py)`", paragraph):
            room = name.rpartition("/")[0] or room
            path = ROOT / name if room in ("docsite", "tests") else ROOT / "modeler" / room
            assert (path / name.rpartition("/")[2]).exists() or path.is_file(), name


def test_every_command_has_its_page(capsys) -> None:
    pages = command_pages()
    assert set(pages) == {f"commands/{name}.md" for name in (*commands(), "index")}
    for name, parser in commands().items():
        page = pages[f"commands/{name}.md"]
        assert page.startswith(f"# modeler {name}\n") and "Example:\n\n```sh\n" in page
        for action in parser._actions:
            assert action.help
            if action.help == argparse.SUPPRESS:
                continue
            for option in action.option_strings:
                assert f"`{option}" in page, (name, option)
        with pytest.raises(SystemExit):
            main([name, "--help"])
        words = "".join(capsys.readouterr().out.split())
        assert "".join(page.split("```text\n")[1].split("```")[0].split()) == words
        assert f"[`modeler {name}`]({name}.md)" in pages["commands/index.md"]


def test_the_interface_has_every_name_once() -> None:
    pages = interface_pages()
    shown = re.findall(r"^::: (.+)$", "\n".join(pages.values()), re.MULTILINE)
    assert len(set(shown)) == len(shown) > 100
    for path in shown:
        module, _, name = path.rpartition(".")
        assert getattr(importlib.import_module(module), name).__doc__, path
    for name in ("fit", "compare", "derive", "load"):
        assert getattr(modeler.api, name).__name__ in {path.rpartition(".")[2] for path in shown}
    assert dict(exported("modeler.simulation"))["simulate"] == "modeler.simulation.run.simulate"
    for stage in (page[:-3] for page in pages if page != "python/index.md"):
        assert f"]({stage.removeprefix('python/')}.md)" in pages["python/index.md"]


def test_an_exhibit_says_what_the_robot_has() -> None:
    result, derivation = exhibit("scara"), derive(load("scara"))
    emitted = generate(derivation)
    assert result.picture.startswith(b"\x89PNG")
    assert exhibit("emps").page.startswith("# emps\n\n**EMPS, one prismatic axis")
    assert (result.joints, result.base) == (4, derivation.base.rank)
    sources = [text for name, text in emitted.files.items() if name[-2:] in (".c", ".h")]
    assert result.lines == sum(len(text.splitlines()) for text in sources)
    size = sum(len(text.encode()) for text in sources)
    assert f"{result.lines} lines, {size} bytes" in result.page
    for function in emitted.spec.functions:
        row = f"| `{function.name}` | {function.additions} | {function.multiplications} |"
        assert row in result.page
    for parameter in derivation.base.parameters:
        assert f"| {parameter.name} | " in result.page
    assert "| `3` | `2` | `1` | `D3` | `0` | `q3` |" in result.page
    index = gallery_index([result])
    assert "[scara](scara.md)" in index and f"| 4 | {result.base} | {result.lines} |" in index


@pytest.mark.rotating("pages of the site")
def test_coefficients_that_a_paper_numbers() -> None:
    assert coefficients(derive(load("scara"))) == []
    rows = "\n".join(coefficients(derive(load("wrist")))).splitlines()
    assert sum(row.startswith("| P") for row in rows) == 101
    assert "| PX5 | S223 | `1` | `PJ2` | `-2*XY3` | `2*cJ23 - 2*cm*ct2*ct3` |" in rows


def test_signs_of_markdown_are_escaped() -> None:
    assert cell("a_b [x] <joint> |a| & *") == r"a\_b \[x\] &lt;joint> \|a\| &amp; \*"
    assert code("a|b") == r"`a\|b`" and code("") == ""
    assert table(("a", "b"), [("1", "2")]) == "| a | b |\n| --- | --- |\n| 1 | 2 |\n"
    result = fenced('First.\n\n>>> a["1"]\n[1, 2]\n\nArgs:\n    a: b')  # no links in brackets
    assert result == 'First.\n\n```python\n>>> a["1"]\n[1, 2]\n```\n\nArgs:\n    a: b'
    assert fenced(">>> 1\n1") == "```python\n>>> 1\n1\n```" and fenced("None.") == "None."


def test_a_notebook_becomes_a_page(tmp_path, monkeypatch) -> None:
    outputs = [
        {"output_type": "stream", "text": ["fit\n", "done\n"]},
        {"output_type": "display_data", "data": {"image/png": "iVBO\nRw0=\n", "text/plain": "f"}},
        {"output_type": "execute_result", "data": {"text/html": "<p>\n\n1</p>", "text/plain": "1"}},
        {"output_type": "execute_result", "data": {"text/latex": "$x$", "text/plain": "x"}},
        {"output_type": "execute_result", "data": {"text/plain": ["2"]}},
    ]
    cells = [
        {"cell_type": "markdown", "source": ["# Title\n", "words"]},
        {"cell_type": "code", "source": "x = 1", "outputs": outputs},
        {"cell_type": "raw", "source": "left out"},
    ]
    page = notebook_page(json.dumps({"cells": cells}))
    assert page.startswith("# Title\nwords\n\n```python\nx = 1\n```\n\n```text\nfit\ndone\n```\n")
    assert 'src="data:image/png;base64,iVBORw0="' in page and "```text\n2\n```" in page
    assert '<div class="result">\n<p>\n1</p>\n</div>\n' in page and "```latex\n$x$\n```" in page
    assert "left out" not in page
    path = tmp_path / "a.ipynb"
    path.write_text('{"cells": []}')
    monkeypatch.setattr("docsite.notebook.RUNS_WITH", ("no_such_package",))
    assert executed(path) == '{"cells": []}'  # one that cannot be run is shown as it is


@pytest.mark.rotating("pages of the site")
def test_these_tests_need_no_package_of_the_site() -> None:
    """`make test` installs none of them."""
    without = "import sys; sys.modules.update(mkdocs=None, griffe=None); import docsite.hooks"
    ran = subprocess.run([sys.executable, "-c", without], cwd=ROOT, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
