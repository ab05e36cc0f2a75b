"""The index of a folder of pages: what each is about and what it found, read from the pages."""

import json
import re
from dataclasses import dataclass
from pathlib import Path

from modeler.core.files import write_atomically
from modeler.pages.render import render

NAME = "index.html"
_ABOUT = re.compile(r'id="about">([^<]*)<')
_HEAD = 200_000  # characters within which a page says what it is about
_ORDER = ("derive", "show", "home", "fit", "estimators", "compare", "diagnose", "add")


@dataclass(frozen=True)
class Entry:
    """A page of the folder.

    Attributes:
        place: relative to the folder.
        command: of `modeler`, that made it.
        title: of the page.
        figure: of its headline.
        verdict: the rest of the headline.
        model: what it is about.
        logs: names.
        held_out: True, False, or None where no fit is judged.
    """

    place: str
    command: str
    title: str
    figure: str
    verdict: str
    model: str
    logs: tuple[str, ...]
    held_out: bool | None

    @property
    def folder(self) -> str:
        """Of the page; "" for the folder itself."""
        return self.place.rpartition("/")[0]

    @property
    def rank(self) -> tuple[int, str]:
        """Where it stands among the pages of its folder."""
        known = _ORDER.index(self.command) if self.command in _ORDER else len(_ORDER)
        return known, self.place


def write_index(folder: Path, title: str = "") -> Path | None:
    """Write `index.html` of a folder and its own folders; the path, None if it is not ours.

    An `index.html` that no earlier call wrote is left alone.

    Args:
        folder: of the pages.
        title: of the index; the name of the folder if it is left out.

    Raises:
        ModelerError: the place cannot be written.
    """
    place = Path(folder) / NAME
    if place.exists() and (_about(place) or {}).get("command") != "index":
        return None
    found = entries(Path(folder))
    name = title or Path(folder).resolve().name
    write_atomically(place, render("index", title=name, entries=found, about={"command": "index"}))
    return place


def entries(folder: Path) -> list[Entry]:
    """Our pages in a folder and in its folders, in the order in which one reads them."""
    pages = [*folder.glob("*.html"), *folder.glob("*/*.html")]
    found = []
    for path in pages:
        about = _about(path)
        if about is not None and about.get("command") != "index":
            found.append(_entry(path.relative_to(folder).as_posix(), about))
    return sorted(found, key=lambda entry: (entry.folder, entry.rank))


def _entry(place: str, about: dict[str, object]) -> Entry:
    def text(name: str) -> str:
        return str(about.get(name) or "")

    logs, held = about.get("logs"), about.get("held_out")
    return Entry(
        place=place,
        command=text("command"),
        title=text("title") or place,
        figure=text("figure"),
        verdict=text("verdict"),
        model=text("model"),
        logs=tuple(map(str, logs)) if isinstance(logs, list) else (),
        held_out=held if isinstance(held, bool) else None,
    )


def _about(path: Path) -> dict[str, object] | None:
    """What a page says of itself; None for a page of somebody else."""
    try:
        with path.open(encoding="utf-8") as file:
            match = _ABOUT.search(file.read(_HEAD))
        about = json.loads(match[1]) if match else None
    except (OSError, ValueError):
        return None
    return about if isinstance(about, dict) else None
