"""Two sums, printed and derived, in our names, and the difference that is known between them."""

import re
import string
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from modeler.papers.paper import DerivedPaper, Paper, PrintedLine
from modeler.papers.quotation import Amount, Monomial, Sum, added, read_sum, times

_SLACK = 1 + 1e-9


@dataclass(frozen=True)
class Compared:
    """What a line prints and what is derived.

    Attributes:
        printed: as read from the quotation, our names.
        derived: the same, derived.
        text: the derived one as people read it.
        values: of the names that stand in coefficients, for decimals.
        settled: the difference that the paper's file states is taken into account already.
        weak: something is only larger or smaller, nothing says that it is equal.
    """

    printed: Sum
    derived: Sum
    text: str
    values: Mapping[str, float] = field(default_factory=dict)
    settled: bool = False
    weak: bool = False


Robots = Mapping[str, DerivedPaper]
Reading = Callable[[Paper, PrintedLine, Robots], Compared]


def joined(parts: Mapping[str, Sum]) -> Sum:
    """Sums of several places as one: every term carries its place as a factor `in<place>`."""
    return {
        times(monomial, ((f"in{place}", 1),)): value
        for place, part in parts.items()
        for monomial, value in part.items()
    }


def in_order(parts: Iterable[Sum]) -> Sum:
    """Sums by their place: each term of the second has the factor `in2`."""
    return joined({str(k): part for k, part in enumerate(parts, 1)})


def numbered(values: Iterable[Amount | int]) -> Sum:
    """Numbers by their place: the second is called `in2`."""
    amounts = (v if isinstance(v, Amount) else Amount(Fraction(v)) for v in values)
    return added(in_order({(): value} for value in amounts))


def same(found: Compared, line: PrintedLine) -> tuple[bool, bool]:
    """(printed + known difference is what is derived, all of it exactly and not only as rounded).

    A coefficient that is printed with a point is compared as a number, to half a unit of its last
    digit; all others exactly.
    """
    # Derived minus printed, as the paper's file states it in our names.
    difference = "" if found.settled else line.difference.replace("{i}", line.legs[0])
    known = read_sum(difference, str) if difference else {}
    printed = _by_name(added(found.printed, known), found.values)
    derived = _by_name(found.derived, found.values)
    if printed.keys() != derived.keys():
        return False, False
    exact = True
    for name, parts in printed.items():
        if any(value.half for value in parts.values()):
            exact = False
            wanted, left = (_number(p, found.values) for p in (derived[name], parts))
            if abs(wanted.value - left.value) > left.half * Fraction(_SLACK):
                return False, False
        elif {m: v.value for m, v in parts.items()} != {
            m: v.value for m, v in derived[name].items()
        }:
            return False, False
    return True, exact


def _by_name(whole: Sum, values: Mapping[str, float]) -> dict[Monomial, dict[Monomial, Amount]]:
    """{names that are no symbols: {symbols: coefficient}}."""
    found: dict[Monomial, dict[Monomial, Amount]] = {}
    for monomial, value in whole.items():
        name = tuple(part for part in monomial if part[0] not in values)
        rest = tuple(part for part in monomial if part[0] in values)
        found.setdefault(name, {})[rest] = value
    return found


def _number(parts: Mapping[Monomial, Amount], values: Mapping[str, float]) -> Amount:
    total = Amount(Fraction(0))
    for monomial, value in parts.items():
        factor = 1.0
        for name, power in monomial:
            factor *= values[name] ** power
        total = total + value * Amount(Fraction(factor))
    return total


def renamer(paper: Paper, line: PrintedLine, leg: str = "") -> Callable[[str], str]:
    """The function from a printed name to ours.

    `i` at the end is the leg; the index of a leg that follows R goes in front of it
    (`ZZ2R1` is our `ZZ21R`); letters that the paper's file names are exchanged, in quotations.
    """

    def rename(name: str) -> str:
        if name.endswith("i") and name != "pi":
            name = name[:-1] + leg
        if not line.ours:
            letters = name[: len(name) - len(name.lstrip(string.ascii_letters))]
            name = paper.names.get(name) or paper.names.get(letters, letters) + name[len(letters) :]
        name = re.sub(r"^([A-Za-z]+\d+)R(\d)$", r"\1\2R", name)
        if line.strip:
            name = re.sub(rf"^([A-Za-z]+\d){line.strip}(R?)$", r"\1\2", name)
        return name

    return rename
