"""The notebooks in docs/ run from their first cell to their last, and show what they say."""

import importlib.util
import json
import re
from pathlib import Path
from typing import Any

import pytest

from docsite.notebook import RUNS_WITH, _place, executed, last_run

pytestmark = pytest.mark.slow  # docs/reference/python.md is run with the other pages

TUTORIALS = Path(__file__).resolve().parents[2] / "docs" / "tutorials"
NOTEBOOKS = sorted(path.stem for path in TUTORIALS.glob("*.ipynb"))

TEXTS = ("text/plain", "text/html", "text/latex")
SHOWN: dict[str, dict[str, str]] = {
    "paper": {
        "leg": "theta",
        "derived.relations": r"\begin{align",
        "alike.base.rank": "23",
        "model": "MPR",
    },
    "csv-to-c": {"arm": "theta", "model": "relative_sigma_percent", "comparison": "repeatable"},
    "what-is-missing": {
        "model": "relative_sigma_percent",
        "comparison": "repeatable",
        "found": "load_friction",
        'better.table("waterfall")': "load_friction",
        "better.missing()": "nothing",
    },
    "urdf": {"model": "relative_sigma_percent", "exported": "friction"},
    "fleet": {"found": "viscous"},
}
"""Of each notebook: lines that end a cell, and a word in what they show."""


def cells(name: str) -> list[tuple[str, dict[str, str]]]:
    """The last line of each cell that shows something, and what it shows by kind."""
    if any(importlib.util.find_spec(package) is None for package in RUNS_WITH):
        pytest.skip(f"NOT CHECKED: without all of {', '.join(RUNS_WITH)} no notebook is run")
    values = []
    path = TUTORIALS / f"{name}.ipynb"
    run = last_run if _place(path).is_file() else executed  # by this very program
    for cell in json.loads(run(path))["cells"]:
        for output in cell.get("outputs", ()):
            assert output["output_type"] != "error", output
            assert output.get("name") != "stderr", output["text"]
            line = "".join(cell["source"]).splitlines()[-1]
            data = output.get("data") or {"text/plain": output["text"]}
            values.append((line, {kind: "".join(text) for kind, text in data.items()}))
    return values


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_the_notebooks_are_kept_without_outputs(name: str) -> None:
    data = json.loads((TUTORIALS / f"{name}.ipynb").read_text(encoding="utf-8"))
    assert data["nbformat"] == 4
    for cell in data["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None


@pytest.mark.rotating
@pytest.mark.parametrize("name", NOTEBOOKS)
def test_no_cell_fails_and_each_shows_what_it_says(name: str) -> None:
    shown = cells(name)
    for line, words in SHOWN[name].items():
        texts = [data.get(kind, "") for last, data in shown if last == line for kind in TEXTS]
        assert any(words in text for text in texts), line
    for line, data in shown:
        if ".plot(" in line and data.keys() != {"text/plain"}:  # what it printed before
            assert len(data["image/png"]) > 5000, line
        assert len(data["text/plain"]) < 4000
    printed = "\n".join(data["text/plain"] for _, data in shown if data.keys() == {"text/plain"})
    TRUE[name](printed)


def _paper(printed: str) -> None:
    assert "163 standard, 43 base parameters" in printed and "MPR = MP + MX31/D41" in printed
    assert float(re.findall(r"([\d.]+) % off", printed)[0]) < 1.0


def _csv_to_c(printed: str) -> None:
    """The C and Python say the same torques."""
    assert "decimal commas" in printed and "no warnings" in printed
    c, python = re.search(r"^([\d. ]{20,})$", printed, re.M), re.search(r"array\((.*)\)", printed)
    assert c is not None and python is not None
    assert json.loads(python[1])[0] == pytest.approx([float(x) for x in c[1].split()], abs=1e-5)


def _what_is_missing(printed: str) -> None:
    before, after = re.findall(r"([\d.]+) % -> ([\d.]+) % of the torque", printed)[0]
    assert float(after) < 0.3 * float(before)


def _urdf(printed: str) -> None:
    """Friction is that of the robot as it is: 1.8 N m."""
    value, sigma = re.findall(r"Fs2 = ([\d.]+) \+- ([\d.]+) N m", printed)[0]
    assert abs(float(value) - 1.8) < 5 * float(sigma)
    assert "armature=" in printed and '<mass value="3.0"/>' in printed


def _fleet(printed: str) -> None:
    assert re.search(r"machine c, joint 2: viscous friction \(Fv2\) rises by 4\d", printed)
    assert re.search(r"machine d, joint 1: drive gain leaps down by [56]\.\d+ % at 20", printed)
    assert printed.count("machine c") == printed.count("machine d") == 2  # it, what changed


TRUE = {
    "paper": _paper,
    "csv-to-c": _csv_to_c,
    "what-is-missing": _what_is_missing,
    "urdf": _urdf,
    "fleet": _fleet,
}
"""The story that each notebook shows is true."""


def test_the_site_shows_the_last_run_of_the_same_program(tmp_path: Path, monkeypatch: Any) -> None:
    import docsite.notebook as notebook

    monkeypatch.delenv("EVERY", raising=False)
    monkeypatch.setattr(notebook, "KEPT", tmp_path)
    runs: list[Path] = []
    monkeypatch.setattr(notebook, "_run", lambda path: runs.append(path) or f"run {len(runs)}")
    path = TUTORIALS / "paper.ipynb"
    assert notebook.last_run(path) == notebook.last_run(path) == "run 1"
    assert executed(path) == notebook.last_run(path) == "run 2"
    monkeypatch.setattr(notebook, "program_text", lambda: b"another program")
    monkeypatch.setenv("EVERY", "3")
    assert notebook.last_run(path) == path.read_text(encoding="utf-8")
    monkeypatch.setenv("EVERY", "1")
    assert notebook.last_run(path) == "run 3"
