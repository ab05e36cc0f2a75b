"""The one module that knows jinja2 for pages: everything that a template prints is escaped."""

import functools
import json
from typing import Any

import jinja2

from modeler.core.resources import resource_dir
from modeler.pictures.drawn import cells, drawn, keys, plotted
from modeler.pictures.numbers import Numbers, packed
from modeler.pictures.picture import Picture

PLOTLY = "plotly/plotly-basic.min.js"
"""Where plotly.js lies in `templates/`; see docs/pages.md for version and checksum."""


class Drawings:
    """The pictures of one page, as its template asks for them."""

    def __init__(self) -> None:
        self.numbers = Numbers()
        self.any = False

    def content(self, picture: Picture) -> str:
        """What the script draws it from."""
        self.any = True
        return script_json(drawn(picture, self.numbers))

    def block(self) -> str:
        """The numbers of all pictures so far."""
        return script_json(self.numbers.block())

    def has_axes(self, picture: Picture) -> bool:
        """False for a picture of cells alone, which is a table."""
        return bool(plotted(picture)[0])


def render(template: str, **values: Any) -> str:
    """Text of `templates/pages/<template>.html.jinja` with these values."""
    made = _environment().get_template(f"{template}.html.jinja")
    return made.render(drawings=Drawings(), **values)


def script_json(content: Any) -> str:
    """JSON that may stand inside a script element."""
    text = json.dumps(content, allow_nan=False, separators=(",", ":"), ensure_ascii=False)
    return text.replace("<", "\\u003c")


@functools.cache
def _environment() -> jinja2.Environment:
    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(resource_dir("templates") / "pages"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=True,
    )
    made.globals.update(
        asset=_asset, plotly=_plotly, cells=cells, keys=keys, json=script_json, about=None
    )
    made.filters["share"] = _share
    return made


@functools.cache
def _asset(name: str) -> str:
    """A style or a script of our own as it is."""
    return (resource_dir("templates") / "pages" / name).read_text(encoding="utf-8")


@functools.cache
def _plotly() -> str:
    return packed((resource_dir("templates") / PLOTLY).read_bytes())


def _share(value: float, top: float) -> str:
    """0 to 1, as a style may say it."""
    return f"{min(1.0, max(0.0, value / top)) if value == value and top > 0.0 else 0.0:.3f}"
