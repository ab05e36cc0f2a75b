"""A notebook as a page: its words, its programs, and their results."""

import hashlib
import importlib.util
import json
import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

from docsite.days import every
from docsite.markdown import block

ROOT = Path(__file__).resolve().parents[1]
RUNS_WITH = ("nbclient", "ipykernel", "pandas")
"""Packages without which a notebook is shown, but not run."""


KEPT = ROOT / "build" / "notebooks"
"""Where results of runs are kept, by notebook and program."""


def executed(path: Path) -> str:
    """The notebook with the results of a fresh run; as it is kept where it cannot be run."""
    if any(importlib.util.find_spec(package) is None for package in RUNS_WITH):
        return path.read_text(encoding="utf-8")
    result = _run(path)
    KEPT.mkdir(parents=True, exist_ok=True)
    _place(path).write_text(result, encoding="utf-8")
    return result


def last_run(path: Path) -> str:
    """The results of the last run of this notebook by this program; of a fresh one if none is.

    Where runs take turns it is shown as it is kept instead: the tests run it on its day.
    """
    place = _place(path)
    if place.is_file():
        return place.read_text(encoding="utf-8")
    return executed(path) if every() == 1 else path.read_text(encoding="utf-8")


def _place(path: Path) -> Path:
    actual = hashlib.sha256(path.read_bytes() + program_text()).hexdigest()[:16]
    return KEPT / f"{path.stem}-{actual}.ipynb"


@cache
def program_text() -> bytes:
    """All that can change what a notebook shows, but for other packages."""
    folders = ("modeler", "templates", "csrc")
    paths = sorted(path for name in folders for path in (ROOT / name).rglob("*.*"))
    rest = (path for path in paths if path.is_file() and "__pycache__" not in path.parts)
    return b"".join(path.read_bytes() for path in rest)


def _run(path: Path) -> str:
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    inputs = os.environ.get("PYTHONPATH", "")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT), inputs]))}
    with tempfile.TemporaryDirectory() as folder:
        client = NotebookClient(notebook, resources={"metadata": {"path": folder}}, timeout=240)
        client.execute(env=environment, stderr=subprocess.DEVNULL)  # it speaks of sockets
    return str(nbformat.writes(notebook))


def notebook_page(text: str) -> str:
    """The cells of a notebook (format 4) one after the other."""
    return "\n".join(_cell(item) for item in json.loads(text)["cells"])


def _cell(cell: dict[str, Any]) -> str:
    source = _joined(cell["source"])
    if cell["cell_type"] == "markdown":
        return source + "\n"
    if cell["cell_type"] != "code":
        return ""
    shown = [_output(output) for output in cell.get("outputs", [])]
    return "\n".join([block(source, "python"), *shown])


def _output(cell: dict[str, Any]) -> str:
    """The richest form that a page can hold."""
    if cell["output_type"] == "stream":
        return block(_joined(cell["text"]), "text")
    data = cell.get("data", {})
    if "image/png" in data:
        return (
            f'<img alt="figure" src="data:image/png;base64,{"".join(data["image/png"].split())}">\n'
        )
    if "text/html" in data:
        # A blank line would end the HTML and begin Markdown.
        lines = [line for line in _joined(data["text/html"]).splitlines() if line.strip()]
        return "\n".join(['<div class="result">', *lines, "</div>\n"])
    if "text/latex" in data:
        return block(_joined(data["text/latex"]), "latex")
    return block(_joined(data["text/plain"]), "text") if "text/plain" in data else ""


def _joined(text: str | list[str]) -> str:
    return text if isinstance(text, str) else "".join(text)
