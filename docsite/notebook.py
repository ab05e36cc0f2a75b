"""A notebook as a page: its words, its programs, and the results that it keeps."""

import json
from html import escape
from typing import Any

from docsite.markdown import block


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
        # A page of its own: what it says of styles stays in it.
        page = escape(_joined(data["text/html"]), quote=True)
        return f'<iframe class="result" title="result" srcdoc="{page}"></iframe>\n'
    return block(_joined(data["text/plain"]), "text") if "text/plain" in data else ""


def _joined(text: str | list[str]) -> str:
    return text if isinstance(text, str) else "".join(text)
