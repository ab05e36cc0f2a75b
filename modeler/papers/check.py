"""Derived against printed: every count and every relation, line by line."""

import enum
import re
from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from modeler.base import BaseParameter, BaseParameters
from modeler.base.agreement import coefficient_value
from modeler.base.relation_text import relation_text
from modeler.papers.paper import Paper, PrintedCount, PrintedRelation
from modeler.symbolic.geometry import geometric_symbol

COUNTS = ("standard parameters", "base parameters", "parameters without effect", "inertial base")


class Verdict(enum.Enum):
    """How a printed line stands to the derived one."""

    EQUAL = "equal"
    ROUNDED = "equal to the printed digits"
    MISPRINT = "misprint in the paper"
    DIFFERENT = "DIFFERENT"


@dataclass(frozen=True)
class Line:
    """One printed line and its verdict.

    Attributes:
        robot: built-in robot that it is about.
        place: in the paper.
        printed: as printed, in our names.
        derived: what is derived.
        verdict: how they stand to each other.
        why: reason of a misprint, or a remark.
    """

    robot: str
    place: str
    printed: str
    derived: str
    verdict: Verdict
    why: str


@dataclass(frozen=True)
class Derived:
    """Base parameters of a robot, and the values of its symbols."""

    base: BaseParameters
    values: Mapping[str, float]


def check_paper(paper: Paper, derived: Mapping[str, Derived]) -> list[Line]:
    """All printed lines with their verdicts.

    Args:
        paper: as read.
        derived: base parameters of `paper.robots`, by name.
    """
    lines = []
    for robot in paper.robots:
        found = derived[robot]
        lines += [_count_line(c, found.base) for c in paper.counts if c.robot == robot]
        lines += [_relation_line(r, found) for r in paper.relations if r.robot == robot]
    return lines


def _count_line(count: PrintedCount, base: BaseParameters) -> Line:
    values = (
        len(base.columns), base.rank, len(base.unidentifiable), base.counts()["inertial"],
    )  # fmt: skip
    value = dict(zip(COUNTS, values, strict=True))[count.what]
    return Line(
        count.robot, count.place, f"{count.printed} {count.what}", str(value),
        _verdict(value == count.printed, count.right is not None and value == count.right),
        count.why,
    )  # fmt: skip


def _verdict(equal: bool, as_corrected: bool) -> Verdict:
    if equal:
        return Verdict.EQUAL
    return Verdict.MISPRINT if as_corrected else Verdict.DIFFERENT


def _relation_line(relation: PrintedRelation, derived: Derived) -> Line:
    found = next((p for p in derived.base.parameters if p.name == relation.base), None)
    printed = f"{relation.base} = {relation.printed}"
    if found is None:
        verdict = _verdict(False, relation.right == "")
        text = f"{relation.base} is no base parameter"
        return Line(relation.robot, relation.place, printed, text, verdict, relation.why)
    exact, rounded = _same(relation.printed, found, derived)
    if exact or rounded:
        verdict = Verdict.EQUAL if exact else Verdict.ROUNDED
    else:
        right = relation.right is not None and any(_same(relation.right, found, derived))
        verdict = _verdict(False, right)
    return Line(
        relation.robot, relation.place, printed, relation_text(found), verdict, relation.why
    )


def _same(text: str, found: BaseParameter, derived: Derived) -> tuple[bool, bool]:
    """(the relations are the same, they are the same to the printed digits)."""
    printed = terms_of(text, {column.name for column in derived.base.columns})
    terms = {term.parameter: term.coefficient for term in found.terms}
    if set(printed) != set(terms):
        return False, False
    exact = rounded = True
    for name, coefficient in printed.items():
        if re.fullmatch(r"[-+]?\d+\.\d+", coefficient):
            exact = False
            digits = len(coefficient.split(".")[1])
            value = coefficient_value(terms[name], derived.values)
            rounded &= abs(value - float(coefficient)) <= 0.5 * 10.0**-digits * (1 + 1e-9)
        else:
            symbols = {n: geometric_symbol(n) for n in derived.values}
            wanted = sympy.sympify(coefficient, locals=symbols)
            same = sympy.simplify(wanted - terms[name]) == 0
            exact, rounded = exact and same, rounded and same
    return exact, rounded


def terms_of(text: str, names: set[str]) -> dict[str, str]:
    """{parameter: coefficient text} of a sum such as `ZZ2 + D4**2*M4 - MX3/D4`."""
    terms: dict[str, str] = {}
    for sign, term in re.findall(r"([-+]?)\s*([^\s+-]+(?:\([^)]*\)[^\s+-]*)?)", text):
        factors = re.split(r"(?<!\*)\*(?!\*)", term)
        name = next((f.split("/")[0] for f in factors if f.split("/")[0] in names), None)
        if name is None:
            raise ValueError(f"{text}: {term} names no parameter")
        rest = [f for f in factors if f.split("/")[0] != name]
        over = next(("/" + f.split("/", 1)[1] for f in factors if f.startswith(name + "/")), "")
        terms[name] = sign.replace("+", "") + ("*".join(rest) or "1") + over
    return terms
