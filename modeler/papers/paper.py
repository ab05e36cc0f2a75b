"""What a paper prints, as short quotations, and what we conclude from it.

One file per paper in `library/`. A quotation is the print letter by letter, without the marks of
typesetting: subscripts stand on the line, `^` is a power. What is compared is read from the
quotation itself. Where the print is not what is derived, the file states the difference, derived
minus printed, and the reason; nothing else passes.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.plain import built

_FOLDER = Path(__file__).parent / "library"

SLIPS = {
    "misprint": "a misprint",
    "omission": "an omission",
    "error": "the statement is wrong",
    "count": "counted otherwise, no error",
    "scan": "the scanned text may be at fault, not the paper",
}
"""Why a print differs, as it is told."""


@dataclass(frozen=True)
class PrintedLine:
    """One statement about a robot: quoted, or ours.

    Attributes:
        robot: built-in robot, or one of `Paper.variants`; that of the file's head if it has none.
        place: in the paper: section, equation or table.
        quote: the print; "" if the statement is our consequence.
        ours: our consequence, in our names; "" if it is printed.
        check: how it is compared: one of `modeler.papers.readings.READINGS`.
        given: further quotations that it rests on: assumptions, or sums put in.
        legs: what stands for i; one line each.
        gives: what is derived, one expression per number, or the expression of a set.
        difference: derived minus printed, in our names; "" if they are to be the same.
        slip: one of `SLIPS`, where there is a difference.
        why: reason of the difference, or a remark.
        of: "M13R = Off13/g - Off13R/g": what a left side is that the robot does not have, in base
            parameters or in joint variables.
        through: robot whose base parameters stand on the right side of a relation, leg by leg.
        strip: ending of names that the robot lacks, a leg that stands alone.
        seal: fingerprint of a quotation that holds measured numbers.
        measured: nothing derives its numbers; `gives` says what must hold of them.
    """

    robot: str
    place: str
    check: str
    quote: str = ""
    ours: str = ""
    given: tuple[str, ...] = ()
    legs: tuple[str, ...] = ("",)
    gives: tuple[str, ...] = ()
    difference: str = ""
    slip: str = ""
    why: str = ""
    of: str = ""
    through: str = ""
    strip: str = ""
    seal: str = ""
    measured: bool = False

    @property
    def text(self) -> str:
        """What is stated."""
        return self.quote or self.ours


@dataclass(frozen=True)
class Variant:
    """A built-in robot with gravity along another axis, or as its virtual tree."""

    of: str
    gravity: tuple[str, ...] = ()
    open: bool = False


@dataclass(frozen=True)
class Paper:
    """A paper and what it prints.

    Attributes:
        name: of the command, "guegan-2003".
        title: authors, title, year.
        robots: in the order in which they are shown.
        variants: robots that no file describes, by name.
        lines: all statements, in the order of the paper.
        names: the paper's names where they are not ours with another index: print -> ours.
        coefficients: robot whose file quotes the paper's coefficient functions, or "".
        slips: of these quotations: "function S112" -> kind, difference, reason.
        unchecked: what nothing here computes: place -> why.
    """

    name: str
    title: str
    robots: tuple[str, ...]
    variants: Mapping[str, Variant]
    lines: tuple[PrintedLine, ...]
    names: Mapping[str, str]
    coefficients: str = ""
    slips: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    unchecked: Mapping[str, str] = field(default_factory=dict)


def paper_names() -> tuple[str, ...]:
    """Names of the papers that there are."""
    return tuple(sorted(path.stem for path in _FOLDER.glob("*.toml")))


def read_paper(name: str) -> Paper:
    """The paper of that name.

    Raises:
        RobotError: there is none; lists those there are.
    """
    if name not in paper_names():
        raise RobotError(f'there is no paper "{name}"; expected one of {", ".join(paper_names())}')
    document = tomllib.loads((_FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    lines = tuple(
        line for entry in document["line"] for line in _lines({"robot": document["robot"]} | entry)
    )
    coefficients = document.get("coefficients", "")
    named = [name for line in lines for name in (line.robot, line.through) if name]
    robots = dict.fromkeys(named + [coefficients] * bool(coefficients))
    return Paper(
        name=name,
        title=document["title"],
        robots=tuple(robots),
        variants={
            key: built(Variant, entry) for key, entry in document.get("variants", {}).items()
        },
        lines=lines,
        names=document.get("names", {}),
        coefficients=coefficients,
        slips=document.get("slips", {}),
        unchecked=document.get("unchecked", {}),
    )


def _lines(entry: dict[str, Any]) -> list[PrintedLine]:
    """One line, or one for each of `quotes`: quotation -> its seal, or "" without one."""
    quotes = entry.pop("quotes", None)
    if quotes is None:
        return [_line(entry)]
    return [_line(entry | {"quote": quote, "seal": seal}) for quote, seal in quotes.items()]


def _line(entry: Mapping[str, Any]) -> PrintedLine:
    assert bool(entry.get("quote")) != bool(entry.get("ours")), f"{entry} is quoted or ours"
    assert entry.get("slip", "scan") in SLIPS, f"{entry['slip']} is no slip"
    return built(PrintedLine, entry)
