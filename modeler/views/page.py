"""Pages: blocks as plain data, their rendering, the index of a folder."""

import base64
import dataclasses
import functools
import gzip
import json
import re
import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jinja2

from modeler.core.figure import Picture
from modeler.core.files import locate_resources, resolve_page_path, write_atomically
from modeler.core.formula import Formula
from modeler.core.table import Column
from modeler.views.figure_plotly import (
    build_page_figure,
    collect_legend,
    find_heat_maps,
    remove_heat_maps,
)


@dataclass(frozen=True)
class PageCell:
    """A cell of a table, where a text alone is not enough.

    Attributes:
        text: what stands there.
        share: length of the bar of a column of bars, 0 to 1.
        link: id of a section of this page.
    """

    text: str
    share: float = 0.0
    link: str = ""


@dataclass(frozen=True)
class PageTable:
    """A table of a page: its head and its rows.

    Attributes:
        head: names of the columns.
        rows: texts, or cells.
        caption: below it.
        kinds: by column: "text" to the left and wrapped, as the first one is without a kind; "bar"
            with a bar before it; others for widths of their own. Without one: numbers.
    """

    head: Sequence[str]
    rows: Sequence[Sequence[str | PageCell]]
    caption: str = ""
    kinds: Mapping[str, str] = field(default_factory=dict)
    block: str = "table"


def tabulate(
    columns: Sequence[Column],
    things: Sequence[Any],
    caption: str = "",
    link: Callable[[Any], str] | None = None,
) -> PageTable:
    """Builds the table of a page from columns that a result states.

    Bars are in parts of the longest of the table.

    Args:
        columns: those that are shown.
        things: one a row.
        caption: below it.
        link: of the first cell of a row, the id of a section.
    """
    shown = [column for column in columns if column.show is not None]
    bars = [c for c in shown if c.kind == "bar"]
    top = max((c.get_value(thing) or 0.0 for c in bars for thing in things), default=0.0) or 1.0
    rows = [
        [
            PageCell(
                c.format(thing),
                (c.get_value(thing) or 0.0) / top if c.kind == "bar" else 0.0,
                link(thing) if link is not None and not k else "",
            )
            for k, c in enumerate(shown)
        ]
        for thing in things
    ]
    heads = [c.short if c.short and callable(c.show) else c.head for c in shown]  # unit in the text
    kinds = dict(zip(heads, (c.kind for c in shown), strict=True))
    return PageTable(heads, rows, caption, kinds)


@dataclass(frozen=True)
class Paragraph:
    """A paragraph."""

    text: str
    block: str = "lead"


@dataclass(frozen=True)
class Items:
    """A list; each line with a word before it that is set bold, or none."""

    lines: Sequence[tuple[str, str]]
    block: str = "items"


@dataclass(frozen=True)
class JudgedLine:
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
class Verdict:
    """Judgements below one another."""

    lines: Sequence[JudgedLine]
    block: str = "verdicts"


@dataclass(frozen=True)
class Figure:
    """A picture with its caption, legend, maps of cells as tables, and its numbers to download."""

    picture: Picture
    titled: bool = True
    block: str = "figure"


@dataclass(frozen=True)
class FormulaBlock:
    """Formulas below one another, each in pieces between which a line may break, and its unit."""

    rows: Sequence[tuple[Sequence[Formula], str]]
    block: str = "formulas"


@dataclass(frozen=True)
class Code:
    """Commands or text to copy, as it is."""

    text: str
    block: str = "code"


Block = PageTable | Paragraph | Items | Verdict | Figure | FormulaBlock | Code


# What a page says, as plain data: first screen, sections, how it was made.


if TYPE_CHECKING:
    from modeler.diagnosis import Diagnosis
    from modeler.estimation import FitResult


# The one module that knows jinja2 for pages: everything that a template prints is escaped.


PLOTLY = "plotly/plotly-basic.min.js"
"""Where plotly.js lies in `templates/`; see docs/reference/pages.md for version and checksum."""


class Drawings:
    """The figures of one page, as its template asks for them."""

    def __init__(self) -> None:
        self.figures: list[dict[str, Any]] = []

    def add(self, picture: Picture) -> dict[str, Any]:
        """Takes a picture, and returns the figure that the script draws."""
        self.figures.append(build_page_figure(picture))
        return self.figures[-1]

    def encode(self) -> str:
        """Returns the figures so far, compressed."""
        return compress_base64(json.dumps(self.figures, separators=(",", ":")).encode())


def compress_base64(content: bytes) -> str:
    """Compresses by gzip and encodes as base64, reproducibly."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")


def render_template(template: str, **values: Any) -> str:
    """Renders `templates/pages/<template>.html.jinja` with these values."""
    made = _build_environment().get_template(f"{template}.html.jinja")
    return made.render(drawings=Drawings(), **values)


def encode_script_json(content: Any) -> str:
    """Encodes JSON that may stand inside a script element."""
    text = json.dumps(content, allow_nan=False, separators=(",", ":"), ensure_ascii=False)
    return text.replace("<", "\\u003c")


@functools.cache
def _build_environment() -> jinja2.Environment:
    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(locate_resources("templates") / "pages"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=True,
    )
    made.globals.update(
        asset=_read_asset,
        plotly=_read_plotly,
        without_maps=remove_heat_maps,
        cells=find_heat_maps,
        keys=collect_legend,
        json=encode_script_json,
        about=None,
    )
    made.filters["share"] = _format_share
    return made


@functools.cache
def _read_asset(name: str) -> str:
    """A style or a script of our own as it is."""
    return (locate_resources("templates") / "pages" / name).read_text(encoding="utf-8")


@functools.cache
def _read_plotly() -> str:
    return compress_base64((locate_resources("templates") / PLOTLY).read_bytes())


def _format_share(value: float, top: float) -> str:
    """0 to 1, as a style may say it."""
    return f"{min(1.0, max(0.0, value / top)) if value == value and top > 0.0 else 0.0:.3f}"


# The index of a folder of pages: what each is about and what it found, read from the pages.


NAME = "index.html"
_ABOUT = re.compile(r'id="about">([^<]*)<')
_HEAD = 200_000  # characters within which a page says what it is about
_TEXTS = ("command", "title", "figure", "verdict", "model")
_ORDER = ("derive", "show", "home", "fit", "estimators", "compare", "diagnose", "add")


@dataclass(frozen=True)
class PageEntry:
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
        """Returns the folder of the page; "" for the index's own folder."""
        return self.place.rpartition("/")[0]

    @property
    def rank(self) -> tuple[int, str]:
        """Returns the sort key of the page within its folder."""
        known = _ORDER.index(self.command) if self.command in _ORDER else len(_ORDER)
        return known, self.place


def write_index(folder: Path, title: str = "") -> Path | None:
    """Writes `index.html` of a folder and its folders; returns its path, None if it is not ours.

    An `index.html` that no earlier call wrote is left alone.

    Args:
        folder: of the pages.
        title: of the index; the name of the folder if it is left out.

    Raises:
        ModelerError: the place cannot be written.
    """
    place = Path(folder) / NAME
    if place.exists() and (_read_about(place) or {}).get("command") != "index":
        return None
    page_entries = find_pages(Path(folder))
    name = title or Path(folder).resolve().name
    write_atomically(
        place,
        render_template("index", title=name, entries=page_entries, about={"command": "index"}),
    )
    return place


def find_pages(folder: Path) -> list[PageEntry]:
    """Finds our pages in a folder and its folders, in reading order."""
    pages = [*folder.glob("*.html"), *folder.glob("*/*.html")]
    page_entries = []
    for path in pages:
        about = _read_about(path)
        if about is not None and about.get("command") != "index":
            place = path.relative_to(folder).as_posix()
            texts = {name: str(about.get(name) or "") for name in _TEXTS}
            logs, held = about.get("logs"), about.get("held_out")
            page_entries.append(
                PageEntry(
                    place=place,
                    logs=tuple(map(str, logs)) if isinstance(logs, list) else (),
                    held_out=held if isinstance(held, bool) else None,
                    **texts | {"title": texts["title"] or place},
                )
            )
    return sorted(page_entries, key=lambda entry: (entry.folder, entry.rank))


def _read_about(path: Path) -> dict[str, object] | None:
    """What a page says of itself; None for a page of somebody else."""
    try:
        with path.open(encoding="utf-8") as file:
            match = _ABOUT.search(file.read(_HEAD))
        about = json.loads(match[1]) if match else None
    except (OSError, ValueError):
        return None
    return about if isinstance(about, dict) else None


@dataclass(frozen=True)
class Section:
    """A title and what stands below it; `id` is what links lead to."""

    title: str
    blocks: Sequence[Block]
    id: str = ""


@dataclass(frozen=True)
class Origin:
    """Where a page comes from, for its first screen, and what to go on with from there.

    Attributes:
        model: file or robot that it is about.
        logs: names of logs.
        held_out: True if what is judged was never fitted, False for training data, None if a page
            judges no fit.
        next: commands to go on with.
    """

    model: str = ""
    logs: Sequence[str] = ()
    held_out: bool | None = None
    next: Sequence[str] = ()


@dataclass(frozen=True)
class Page:
    """One page of results, by what stands on it.

    Attributes:
        title: plain text.
        headline: a figure, and what it is.
        sections: in order.
        origin: model, logs, badge.
        facts: names and what stands below them.
        provenance: how it was made, in lines.
        command: of `modeler`, that makes such pages.
    """

    title: str
    headline: tuple[str, str]
    sections: Sequence[Section]
    origin: Origin = dataclasses.field(default_factory=Origin)
    facts: Sequence[tuple[str, str]] = ()
    provenance: Sequence[str] = ()
    command: str = ""

    def __str__(self) -> str:
        """The HTML."""
        return render_page(self)

    def collect_pictures(self) -> list[Picture]:
        """Collects all pictures in order, each under a name of its own."""
        blocks = (block for section in self.sections for block in section.blocks)
        pictures: dict[str, Picture] = {}
        for picture in (block.picture for block in blocks if isinstance(block, Figure)):
            name = picture.name
            alike = sum(other == name or other.startswith(f"{name}_again_") for other in pictures)
            name = f"{name}_again_{alike}" if name in pictures else name
            pictures[name] = dataclasses.replace(picture, name=name)
        return list(pictures.values())


def render_page(sheet: Page) -> str:
    """Renders the page as text; its security policy forbids any network access."""
    return render_template("sheet", sheet=sheet, about=_collect_page_facts(sheet))


def _collect_page_facts(sheet: Page) -> dict[str, Any]:
    """What the index of a folder says of the page."""
    texts = (sheet.command, sheet.title, *sheet.headline, sheet.origin.model)
    logs, held = list(sheet.origin.logs), sheet.origin.held_out
    return dict(zip(_TEXTS, texts, strict=True)) | {"logs": logs, "held_out": held}


_FILES = {"diagnose": "diagnosis.html", "add": "improved.html"}
"""Name of a page in a folder, by command; of others it is the command's."""


def write_page(path: Path, sheet: Page) -> Path:
    """Writes the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets the page and an index of its pages.
        sheet: what it says.

    Raises:
        ModelerError: the place cannot be written.
    """
    place = resolve_page_path(Path(path), _FILES.get(sheet.command, f"{sheet.command}.html"))
    write_atomically(place, render_page(sheet))
    if place != Path(path):
        write_index(place.parent)
    return place


# The command to go on with, after each page, with the files of the one that was given.


def suggest_after_fit(
    model: str, logs: Sequence[str], robot: str, fit: "FitResult", mapped: Sequence[str] = ()
) -> list[str]:
    """Suggests to compare the model with logs, and to diagnose it; first what the fit requires.

    Args:
        model: its file.
        logs: that were fitted.
        robot: as it was given.
        fit: judged.
        mapped: what `--map` was given; the model keeps it, the robot file does not.
    """
    judge = f"modeler compare {_quote_words([model, *logs])} --report compare.html"
    look = f"modeler diagnose {_quote_words([model, *logs])} --report diagnosis.html"
    following = [look, judge] if _is_effect_missing(fit) else [judge, look]
    if fit.verdict is None or fit.verdict.is_valid_everywhere:
        return following
    if fit.verdict.needs_motion:
        return [_suggest_motion(model, logs), *following]
    causes = {joint.cause for joint in fit.verdict.by_joint.values()}
    if fit.verdict.valid and "lack_of_fit" in causes:
        return following
    words = "".join(f" --map {_quote_words([word])}" for word in mapped)
    return [f"modeler log {_quote_words(logs[:1])} --robot {_quote_words([robot])}{words}", look]


def _suggest_motion(model: str, logs: Sequence[str]) -> str:
    """Suggests to record what the logs lack."""
    beside = "".join(f" --from {_quote_words([log])}" for log in logs)
    motion = f"{Path(model).name.partition('.')[0]}-motion.csv"
    return f"modeler excite {_quote_words([model])}{beside} --out {_quote_words([motion])}"


def _is_effect_missing(fit: "FitResult") -> bool:
    """True if an effect seems to be missing."""
    if fit.verdict is not None and fit.verdict.valid_for != "parameters":
        return True
    return any("`modeler diagnose`" in line for line in fit.sentences)


def suggest_after_compare(
    model: str, fitted: Sequence[str], logs: Sequence[str], held_out: bool, noise: bool = False
) -> str:
    """Suggests to diagnose the model; if nothing is missing, to generate the controller.

    Args:
        model: file of the model.
        fitted: logs that it was fitted on.
        logs: logs that were compared.
        held_out: False if some of them were fitted.
        noise: True if nothing else is left on any joint.
    """
    if noise:
        return _suggest_generate(model)
    if not held_out:
        return f"modeler diagnose {_quote_words([model, *logs])}"
    return f"modeler diagnose {_quote_words([model, *fitted])}{_format_holdout(logs)}"


def suggest_after_stated(robot: str, logs: Sequence[str], mapped: Sequence[str] = ()) -> str:
    """Suggests to fit what a robot file states."""
    words = "".join(f" --map {_quote_words([word])}" for word in mapped)
    stem = Path(robot).name.partition(".")[0]
    return (
        f"modeler fit {_quote_words([robot, *logs])}{words} --out "
        f"{_quote_words([f'{stem}.model.json'])}"
    )


def suggest_after_diagnosis(
    model: str,
    logs: Sequence[str],
    holdout: Sequence[str],
    diagnosis: "Diagnosis",
    effects_from: str | None = None,
    needs_motion: bool = False,
) -> list[str]:
    """Suggests to add the effects that have columns; else to record, to compare or to generate."""
    named = diagnosis.addable_findings
    needs_motion |= bool(diagnosis.unjudged_joints)
    is_same = not (diagnosis.machine_changed or diagnosis.unexplained_change)
    if not named and needs_motion and is_same:
        return [_suggest_motion(model, logs)]
    if not named and diagnosis.verdict == "nothing significant" and is_same:
        return [_suggest_generate(model)]
    if not named:
        return [
            f"modeler compare {_quote_words([model, *(holdout or logs)])} --report compare.html"
        ]
    first = named[0]
    effect = shlex.quote(first.effect) + (
        f" --joint {shlex.quote(first.joint)}" if first.joint else ""
    )
    effect = "auto" if sum(not f.warning for f in named) > 1 else effect
    path = Path(model)
    better = path.with_name(f"{path.name.partition('.')[0]}-improved{''.join(path.suffixes)}")
    words = (
        f"modeler add {_quote_words([model])} {effect} "
        f"{_quote_words(logs)}{_format_holdout(holdout)}"
    )
    words += f" --effects-from {shlex.quote(effects_from)}" if effects_from else ""
    return [f"{words} --out {_quote_words([str(better)])}"]


def suggest_after_add(
    model: str, logs: Sequence[str], holdout: Sequence[str], fit: "FitResult"
) -> list[str]:
    """Suggests to compare the new model with held-out logs, and to generate the controller.

    First see what it lacks still, if it does.
    """
    model_word = _quote_words([model])
    look = f"modeler diagnose {model_word} {_quote_words(logs)}{_format_holdout(holdout)}"
    judge = f"modeler compare {_quote_words([model, *(holdout or logs)])}"
    return [*([look] if _is_effect_missing(fit) else []), judge, _suggest_generate(model)]


def _format_holdout(holdout: Sequence[str]) -> str:
    return "".join(f" --holdout {_quote_words([log])}" for log in holdout)


def _suggest_generate(model: str) -> str:
    """To the controller."""
    folder = f"{Path(model).name.partition('.')[0]}_c"
    return f"modeler generate {_quote_words([model])} --out {_quote_words([folder])}"


def _quote_words(words: Sequence[str]) -> str:
    return " ".join(shlex.quote(word) for word in words)
