"""What a paper prints, as data: counts and relations, each with its place in the paper.

One file per paper in `library/`. Relations are written in the robot file's names; where the print
is wrong, the file says so, with the right relation and the reason.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.core.errors import RobotError

_FOLDER = Path(__file__).parent / "library"


@dataclass(frozen=True)
class PrintedCount:
    """A number that the paper prints.

    Attributes:
        robot: built-in robot that it is about.
        place: in the paper.
        what: one of `modeler.papers.check.COUNTS`.
        printed: the number.
        right: what it should be; None if the print is right.
        why: reason of a misprint, or a remark.
    """

    robot: str
    place: str
    what: str
    printed: int
    right: int | None
    why: str


@dataclass(frozen=True)
class PrintedRelation:
    """A grouping relation that the paper prints, in the robot file's names.

    Attributes:
        robot: built-in robot that it is about.
        place: in the paper.
        base: name of the base parameter.
        printed: its right side; decimals stand for values rounded to their last digit.
        right: what it should be; None if the print is right, "" if it is no base parameter.
        why: reason of a misprint, or a remark.
    """

    robot: str
    place: str
    base: str
    printed: str
    right: str | None
    why: str


@dataclass(frozen=True)
class Paper:
    """A paper and what it prints.

    Attributes:
        name: of the command, "guegan-2003".
        title: authors, title, year.
        robots: built-in robots in the order in which they are shown.
        counts: printed numbers.
        relations: printed relations.
        coefficients: robots whose files quote the paper's coefficient functions.
        misprints: lines of these that are wrong in the print, as "function S112".
        notes: other slips of the print, one text each.
    """

    name: str
    title: str
    robots: tuple[str, ...]
    counts: tuple[PrintedCount, ...]
    relations: tuple[PrintedRelation, ...]
    coefficients: tuple[str, ...]
    misprints: tuple[str, ...]
    notes: tuple[str, ...]


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
    counts = [_count(entry) for entry in document.get("count", [])]
    relations = [r for entry in document.get("relation", []) for r in _relations(entry)]
    robots = dict.fromkeys([c.robot for c in counts] + [r.robot for r in relations])
    return Paper(
        name=name,
        title=document["title"],
        robots=tuple(robots),
        counts=tuple(counts),
        relations=tuple(relations),
        coefficients=tuple(document.get("coefficients", [])),
        misprints=tuple(document.get("misprints", [])),
        notes=tuple(document.get("notes", [])),
    )


def _count(entry: Mapping[str, Any]) -> PrintedCount:
    return PrintedCount(
        entry["robot"], entry["place"], entry["what"], entry["printed"], entry.get("right"),
        entry.get("why", ""),
    )  # fmt: skip


def _relations(entry: Mapping[str, Any]) -> list[PrintedRelation]:
    """One relation, or one for each leg where {i} stands in it."""
    legs = entry.get("legs", [""])

    def text(key: str, leg: str) -> str:
        return entry[key].replace("{i}", leg)

    return [
        PrintedRelation(
            robot=entry["robot"],
            place=entry["place"],
            base=text("base", leg),
            printed=text("printed", leg),
            right=text("right", leg) if "right" in entry else None,
            why=entry.get("why", ""),
        )
        for leg in legs
    ]
