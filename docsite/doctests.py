"""Examples in docstrings as code; as text, `>>>` would be a quotation and `[1]` a link."""

from typing import Any

import griffe


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


class Doctests(griffe.Extension):
    """What mkdocstrings loads: every docstring with its examples fenced."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Of every object, once it is read."""
        if obj.docstring is not None:
            obj.docstring.value = fenced(obj.docstring.value)
