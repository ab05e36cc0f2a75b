"""Examples in docstrings as code; as text, `>>>` would be a quotation and `[1]` a link."""

from typing import Any

import griffe

from docsite.markdown import fenced


class Doctests(griffe.Extension):
    """What mkdocstrings loads: every docstring with its examples fenced."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Of every object, once it is read."""
        if obj.docstring is not None:
            obj.docstring.value = fenced(obj.docstring.value)
