"""What a page says, as plain data: first screen, sections, how it was made."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.core.files import page_place, write_atomically
from modeler.core.formula import Formula
from modeler.pages.index import write_index
from modeler.pages.render import render
from modeler.pictures.picture import Picture


@dataclass(frozen=True)
class Cell:
    """Of a table.

    Attributes:
        text: what stands there.
        kind: "number" to the right, "text" to the left and wrapped, "bar" with a bar before it.
        share: length of the bar, 0 to 1.
        link: id of a section of this page.
    """

    text: str
    kind: str = "number"
    share: float = 0.0
    link: str = ""


@dataclass(frozen=True)
class Table:
    """Head and rows; a plain string is a number, or the text of the first column."""

    head: Sequence[str | Cell]
    rows: Sequence[Sequence[str | Cell]]
    caption: str = ""
    block: str = "table"


@dataclass(frozen=True)
class Lead:
    """A paragraph."""

    text: str
    block: str = "lead"


@dataclass(frozen=True)
class Items:
    """A list; each line with a word before it that is set bold, or none."""

    lines: Sequence[tuple[str, str]]
    block: str = "items"


@dataclass(frozen=True)
class Judged:
    """One line of a verdict.

    Attributes:
        kind: "noise" (good), "pattern" (bad), "other" (unclear), "" (none of them).
        tag: a word or two.
        head: what it is about.
        text: what is said of it.
        link: id of a section of this page, or nothing.
    """

    kind: str
    tag: str
    head: str
    text: str
    link: str = ""


@dataclass(frozen=True)
class Verdicts:
    """A list of judgements."""

    lines: Sequence[Judged]
    block: str = "verdicts"


@dataclass(frozen=True)
class Figure:
    """A picture with its caption, legend, maps of cells as tables, and its numbers to download."""

    picture: Picture
    titled: bool = True
    block: str = "figure"


@dataclass(frozen=True)
class Formulas:
    """Formulas below one another, each in pieces between which a line may break, and its unit."""

    rows: Sequence[tuple[Sequence[Formula], str]]
    block: str = "formulas"


@dataclass(frozen=True)
class Code:
    """Commands or text to copy, as it is."""

    text: str
    block: str = "code"


Block = Table | Lead | Items | Verdicts | Figure | Formulas | Code


@dataclass(frozen=True)
class Section:
    """A title and what stands below it; `id` is what links lead to."""

    title: str
    blocks: Sequence[Block]
    id: str = ""


@dataclass(frozen=True)
class Origin:
    """Where a page comes from, for its first screen.

    Attributes:
        model: file or robot that it is about.
        logs: names of logs.
        held_out: True if what is judged was never fitted, False for training data, None if a page
            judges no fit.
    """

    model: str = ""
    logs: Sequence[str] = ()
    held_out: bool | None = None


@dataclass(frozen=True)
class Sheet:
    """One page.

    Attributes:
        title: plain text.
        headline: a figure, and what it is.
        sections: in order.
        origin: model, logs, badge.
        facts: names and what stands below them.
        next: commands to go on with.
        provenance: how it was made, in lines.
        command: of `modeler`, that makes such pages.
    """

    title: str
    headline: tuple[str, str]
    sections: Sequence[Section]
    origin: Origin = dataclasses.field(default_factory=Origin)
    facts: Sequence[tuple[str, str]] = ()
    next: Sequence[str] = ()
    provenance: Sequence[str] = ()
    command: str = ""


def page(sheet: Sheet) -> str:
    """The page as text; its security policy forbids any network access."""
    return render("sheet", sheet=sheet, about=_about(sheet))


def _about(sheet: Sheet) -> dict[str, Any]:
    """What the index of a folder says of the page."""
    return {
        "command": sheet.command,
        "title": sheet.title,
        "figure": sheet.headline[0],
        "verdict": sheet.headline[1],
        "model": sheet.origin.model,
        "logs": list(sheet.origin.logs),
        "held_out": sheet.origin.held_out,
    }


def write_page(path: Path, sheet: Sheet, name: str) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `name` and an index of its pages.
        sheet: what it says.
        name: of the file in a folder.

    Raises:
        ModelerError: the place cannot be written.
    """
    place = page_place(Path(path), name)
    write_atomically(place, page(sheet))
    if place != Path(path):
        write_index(place.parent)
    return place
