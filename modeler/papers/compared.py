"""Two sums, printed and derived, in our names, and the difference that is known between them."""

import re
import string
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from modeler.papers.paper import DerivedRobot, Paper, PrintedLine
from modeler.papers.quotation import Amount, Monomial, Sum, add_sums, multiply_monomials, read_sum

_SLACK = 1 + 1e-9


@dataclass(frozen=True)
class LineComparison:
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
    is_difference_included: bool = False
    is_inequality: bool = False


Robots = Mapping[str, DerivedRobot]
Reading = Callable[[Paper, PrintedLine, Robots], LineComparison]


def join_sums(parts: Mapping[str, Sum]) -> Sum:
    """Sums of several places as one: every term carries its place as a factor `in<place>`."""
    return {
        multiply_monomials(monomial, ((f"in{place}", 1),)): value
        for place, part in parts.items()
        for monomial, value in part.items()
    }


def join_in_order(parts: Iterable[Sum]) -> Sum:
    """Sums by their place: each term of the second has the factor `in2`."""
    return join_sums({str(k): part for k, part in enumerate(parts, 1)})


def join_numbers(values: Iterable[Amount | int]) -> Sum:
    """Numbers by their place: the second is called `in2`."""
    amounts = (v if isinstance(v, Amount) else Amount(Fraction(v)) for v in values)
    return add_sums(join_in_order({(): value} for value in amounts))


def compare_line(comparison: LineComparison, line: PrintedLine) -> tuple[bool, bool]:
    """(printed + known difference is what is derived, all of it exactly and not only as rounded).

    A coefficient that is printed with a point is compared as a number, to half a unit of its last
    digit; all others exactly.
    """
    # Derived minus printed, as the paper's file states it in our names.
    difference = (
        "" if comparison.is_difference_included else line.difference.replace("{i}", line.legs[0])
    )
    known = read_sum(difference, str) if difference else {}
    printed = _group_by_name(add_sums(comparison.printed, known), comparison.values)
    derived = _group_by_name(comparison.derived, comparison.values)
    if printed.keys() != derived.keys():
        return False, False
    exact = True
    for name, parts in printed.items():
        if any(value.half for value in parts.values()):
            exact = False
            wanted, left = (_evaluate_amount(p, comparison.values) for p in (derived[name], parts))
            if abs(wanted.value - left.value) > left.half * Fraction(_SLACK):
                return False, False
        elif {m: v.value for m, v in parts.items()} != {
            m: v.value for m, v in derived[name].items()
        }:
            return False, False
    return True, exact


def _group_by_name(
    whole: Sum, values: Mapping[str, float]
) -> dict[Monomial, dict[Monomial, Amount]]:
    """{names that are no symbols: {symbols: coefficient}}."""
    groups: dict[Monomial, dict[Monomial, Amount]] = {}
    for monomial, value in whole.items():
        name = tuple(part for part in monomial if part[0] not in values)
        rest = tuple(part for part in monomial if part[0] in values)
        groups.setdefault(name, {})[rest] = value
    return groups


def _evaluate_amount(parts: Mapping[Monomial, Amount], values: Mapping[str, float]) -> Amount:
    total = Amount(Fraction(0))
    for monomial, value in parts.items():
        factor = 1.0
        for name, power in monomial:
            factor *= values[name] ** power
        total = total + value * Amount(Fraction(factor))
    return total


def build_renamer(paper: Paper, line: PrintedLine, leg: str = "") -> Callable[[str], str]:
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
