"""A notebook as a page: its words, its programs, and their results."""

import importlib.util
import json
import os
import tempfile
from pathlib import Path
from typing import Any

from docsite.markdown import block

ROOT = Path(__file__).resolve().parents[1]
RUNS_WITH = ("nbclient", "ipykernel", "pandas")
"""Packages without which a notebook is shown, but not run."""


def executed(path: Path) -> str:
    """The notebook with the results of a fresh run; as it is kept where it cannot be run."""
    if any(importlib.util.find_spec(package) is None for package in RUNS_WITH):
        return path.read_text(encoding="utf-8")
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    os.environ["PYTHONPATH"] = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    with tempfile.TemporaryDirectory() as folder:
        client = NotebookClient(notebook, resources={"metadata": {"path": folder}}, timeout=240)
        client.execute()
    return str(nbformat.writes(notebook))


def notebook_page(text: str) -> str:
    """The cells of a notebook (format 4) one after the other."""
    return "\n".join(_cell(found) for found in json.loads(text)["cells"])


def _cell(found: dict[str, Any]) -> str:
    source = _joined(found["source"])
    if found["cell_type"] == "markdown":
        return source + "\n"
    if found["cell_type"] != "code":
        return ""
    shown = [_output(output) for output in found.get("outputs", [])]
    return "\n".join([block(source, "python"), *shown])


def _output(found: dict[str, Any]) -> str:
    """The richest form that a page can hold."""
    if found["output_type"] == "stream":
        return block(_joined(found["text"]), "text")
    data = found.get("data", {})
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
