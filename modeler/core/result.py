"""What every result says of itself: a line, a summary, tables, frames, figures, pages, files.

A result states what it holds; how it is shown stands in one package, `modeler.report.notebook`,
which is registered by `modeler.api`, and says it by a `Presentation` for each class when one is
first shown.
"""

import html
import io
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.json import ShortRepr, convert_to_plain

if TYPE_CHECKING:
    from modeler.core.table import Table

Tables = Mapping[str, "Callable[[], Table]"]
"""Tables by name, the main one first."""

Figures = Mapping[str, Callable[[], Any]]
"""Drawers of matplotlib Figures by name, the main one first."""


@dataclass(frozen=True)
class Presentation:
    """How the objects of a class are shown.

    Attributes:
        noun: what they are, as in "a model".
        summary: text of some lines; the first is a headline.
        tables: of an object.
        figures: of an object.
        page: names of the tables that a notebook shows; None: the first alone.
        document: of an object, with lines for its foot: what `str` makes an HTML page of; None:
            the page shows what a notebook shows.
        files: endings of files of its own, ".toml", and what writes one; "" is any other.
    """

    noun: str
    summary: Callable[[Any], str]
    tables: Callable[[Any], Tables] = lambda thing: {}
    figures: Callable[[Any], Figures] = lambda thing: {}
    page: tuple[str, ...] | None = None
    document: Callable[[Any, Sequence[str]], Any] | None = None
    files: Mapping[str, Callable[[Path, Any], Any]] = field(default_factory=dict)


_PRESENTATIONS: dict[type, Presentation] = {}
_LATER: dict[str, Callable[[], None]] = {}


def register_presentations(presentations: Mapping[type, Presentation]) -> None:
    """Says how the objects of classes are shown."""
    _PRESENTATIONS.update(presentations)


def register_lazily(names: Iterable[str], load: Callable[[], None]) -> None:
    """Says what calls `present` for classes of these names; it runs when one is first shown."""
    _LATER.update(dict.fromkeys(names, load))


def find_presentation(kind: type) -> Presentation | None:
    """Returns how the objects of a class, or of one that it derives from, are shown."""
    for name in (k.__name__ for k in kind.__mro__):
        if name in _LATER:
            _LATER.pop(name)()
    return next((_PRESENTATIONS[k] for k in kind.__mro__ if k in _PRESENTATIONS), None)


class Result(ShortRepr):
    """A base class of results."""

    def summary(self) -> str:
        """Returns in some lines of text what it is and what was found."""
        return _get_presentation(self).summary(self)

    def table(self, name: str = "") -> "Table":
        """Returns one of its tables.

        Args:
            name: which; the main one if left out. `docs/reference/python.md` lists them.

        Raises:
            DataError: it has no such table; says which it has.
        """
        return _select_item(self, "table", name, _get_presentation(self).tables(self))

    def to_frame(self, name: str = "") -> Any:
        """Returns that table as a pandas DataFrame.

        Raises:
            DataError: no such table, or pandas is not installed.
        """
        return self.table(name).to_frame()

    def plot(self, name: str = "") -> Any:
        """Returns one of its figures, a matplotlib Figure.

        A notebook draws it, `savefig` writes it.

        Args:
            name: which; the main one if left out. `docs/reference/python.md` lists them.

        Raises:
            DataError: it has no such figure; says which it has.
        """
        return _select_item(self, "plot", name, _get_presentation(self).figures(self))

    def to_dict(self) -> dict[str, Any]:
        """Returns plain data: what `--json` writes of it, or else its tables."""
        if hasattr(self, "to_json"):
            return dict(convert_to_plain(self.to_json()))
        tables = {
            name: table().to_dict() for name, table in _get_presentation(self).tables(self).items()
        }
        return dict(convert_to_plain(tables))

    def to_html(self) -> str:
        """Returns a page of HTML that needs no other file."""
        presentation = _get_presentation(self)
        if presentation.document is not None:
            return str(presentation.document(self, ()))
        title, *lines = map(html.escape, presentation.summary(self).splitlines())
        body = self._repr_html_() or "\n".join([f"<h1>{title}</h1>", "<pre>", *lines, "</pre>"])
        return (
            f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
            f"</head>\n<body>\n{body}\n</body></html>\n"
        )

    def save(self, path: str | Path) -> Path:
        """Writes the result to a file, in the way that its ending says.

        Args:
            path: .json for plain data, .html for its page, .csv .md .tex for its main table,
                .png .svg .pdf for its main figure, .txt for its summary; or the ending of files of
                its own: .json of a model is the model, .toml of a robot its file, .parquet of a
                simulated log the log.

        Raises:
            DataError: another ending; or it has no table, or no figure.
            ModelerError: the place cannot be written.
        """
        path, writers = Path(path), _get_presentation(self).files
        ending = path.suffix.lower()
        if ending in writers or ("" in writers and ending not in _WRITTEN):
            writers.get(ending, writers.get("", write_atomically))(path, self)
        elif ending in _WRITTEN:
            write_atomically(path, _WRITTEN[ending](self))
        else:
            raise DataError(
                f'{path}: got the ending "{ending}"; {_get_presentation(self).noun} is saved '
                "as one of "
                f"{' '.join(sorted({*writers, *_WRITTEN}))}"
            )
        return path

    def _repr_html_(self) -> str | None:
        presentation = find_presentation(type(self))
        tables = {} if presentation is None else presentation.tables(self)
        if presentation is None or not tables:
            return None
        first = presentation.summary(self).splitlines()[0]
        names = [next(iter(tables))] if presentation.page is None else presentation.page
        drawn = [tables[name]().to_html() for name in names if name in tables]
        return "\n".join([f"<p><b>{html.escape(first)}</b></p>", *drawn])


def _draw_figure(thing: Result, kind: str) -> bytes:
    drawn = io.BytesIO()
    thing.plot().savefig(drawn, format=kind, bbox_inches="tight")
    return drawn.getvalue()


_WRITTEN: Mapping[str, Callable[[Result], str | bytes]] = {
    ".json": lambda thing: json.dumps(thing.to_dict(), indent=1) + "\n",
    ".html": lambda thing: thing.to_html(),
    ".csv": lambda thing: thing.table().to_csv(),
    ".md": lambda thing: thing.table().to_markdown() + "\n",
    ".tex": lambda thing: thing.table().to_latex() + "\n",
    ".txt": lambda thing: thing.summary() + "\n",
    ".png": lambda thing: _draw_figure(thing, "png"),
    ".svg": lambda thing: _draw_figure(thing, "svg"),
    ".pdf": lambda thing: _draw_figure(thing, "pdf"),
}
"""What is written of any result, by the ending of the file."""


def _get_presentation(thing: Result) -> Presentation:
    presentation = find_presentation(type(thing))
    if presentation is None:
        raise DataError(
            f"{type(thing).__name__}: no presentation is registered; import modeler.api"
        )
    return presentation


def _select_item(
    thing: Result, what: str, name: str, offered: Mapping[str, Callable[[], Any]]
) -> Any:
    noun, names = _get_presentation(thing).noun, ", ".join(offered)
    if not offered:
        raise DataError(f"{what}: {noun} has none")
    if name and name not in offered:
        raise DataError(f"{what}: {noun} has no {name}; expected one of {names}")
    return offered[name or next(iter(offered))]()
