"""The Jinja environment; nothing else knows Jinja.

Templates lay out finished strings, with `for` and `if` and nothing more.
"""

from functools import cache
from typing import Any

import jinja2

from modeler.core.resources import resource_dir


@cache
def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(resource_dir("templates")),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # C, make and Markdown are no HTML
    )


def render(template: str, **values: Any) -> str:
    """Text of `templates/<template>.jinja` with these values."""
    return _environment().get_template(f"{template}.jinja").render(**values)
