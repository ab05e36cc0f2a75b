"""Markdown written by programs: cells, tables, blocks."""

import re
from collections.abc import Iterable, Sequence


def cell(text: str) -> str:
    """Text as a cell of a table; signs that Markdown or HTML would read are escaped."""
    return re.sub(r"([|*_`\[\]\\])", r"\\\1", text).replace("&", "&amp;").replace("<", "&lt;")


def code(text: str) -> str:
    """Text as code in a cell of a table; nothing for nothing."""
    return f"`{text.replace('|', chr(92) + '|')}`" if text else ""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; its cells are Markdown already."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def block(text: str, language: str = "") -> str:
    """A fenced block."""
    return f"```{language}\n{text.rstrip()}\n```\n"


def fenced(docstring: str) -> str:
    """The docstring with a fence around every run of lines from `>>>` to the next blank line.

    Args:
        docstring: without the indentation of its code.
    """
    lines: list[str] = []
    inside = False
    for line in [*docstring.splitlines(), ""]:
        if not inside and line.startswith(">>>"):
            lines.append("```python")
            inside = True
        elif inside and not line.strip():
            lines.append("```")
            inside = False
        lines.append(line)
    return "\n".join(lines[:-1])
