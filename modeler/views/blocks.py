"""What stands on a page, block after block, as plain data."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from modeler.core.figure import Picture
from modeler.core.formula import Formula


@dataclass(frozen=True)
class PageCell:
    """Of a table, where a text alone is not enough.

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
    """Head and rows.

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
