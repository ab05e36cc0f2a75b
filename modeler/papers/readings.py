"""How the statements of a paper are read and compared: one function for each kind."""

import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from modeler.papers.compared import Compared, Reading, Robots, difference_of, numbered, renamer
from modeler.papers.derived import Derived
from modeler.papers.mechanics import MECHANICS_READINGS
from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quantities import evaluate, quantities
from modeler.papers.quotation import (
    Amount,
    Monomial,
    QuotationError,
    Sum,
    numbers_of,
    read_sum,
    replaced,
    sides,
    sum_text,
)
from modeler.papers.wrist import WRIST_READINGS

_LEGS = "123456"
_ONE = Amount(Fraction(1))


def relation_reading(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """`ZZ2Ri = ZZ2i + ...`: a base parameter, or a combination of them, as a sum."""
    found, leg = robots[line.robot], line.legs[0]
    left, right = sides(line.text)
    rename = renamer(paper, line, leg)
    puts = _assumed(paper, line)
    printed = read_sum(right, rename, _LEGS[:3])
    if line.through:
        printed = replaced(printed, _of_a_leg(robots[line.through], found))
    target = rename(left)
    own, _, combination = line.of.partition(" = ")
    wanted = read_sum(combination if own == target else target, str)
    lost = {name for m in wanted for name, _ in m} - set(found.relations) - set(found.standard)
    if lost - set(found.values) or (own != target and target not in found.relations):
        return Compared(printed, {}, f"{target} is no base parameter", difference_of(line))
    derived = replaced(wanted, found.relations)
    return Compared(
        replaced(printed, puts), replaced(derived, puts),
        f"{target} = {sum_text(derived)}", difference_of(line), found.values,
    )  # fmt: skip


def _assumed(paper: Paper, line: PrintedLine) -> dict[str, Sum]:
    """What the quotations of `given` put in for a name, for every leg."""
    puts: dict[str, Sum] = {}
    for text in line.given:
        left, right = sides(text)
        for leg in _LEGS:
            rename = renamer(paper, line, leg)
            puts[rename(left)] = read_sum(right, rename)
    return puts


def _of_a_leg(leg: Derived, whole: Derived) -> dict[str, Sum]:
    """Base parameters of an isolated leg, written for every leg of the robot."""
    found: dict[str, Sum] = {}
    for index in _LEGS[:3]:
        for name, terms in leg.relations.items():
            if not name.endswith("R"):
                continue
            found[f"{name[:-1]}{index}R"] = {
                tuple(sorted((_indexed(n, index, leg, whole), p) for n, p in m)): value
                for m, value in terms.items()
            }
    return found


def _indexed(name: str, index: str, leg: Derived, whole: Derived) -> str:
    return name if name in leg.values and name in whole.values else name + index


def numbers_reading(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """Every number of the quotation, in order, against an expression of `gives`."""
    numbers = numbers_of(line.text)
    if len(numbers) != len(line.gives):
        raise QuotationError(f"{len(numbers)} numbers are quoted, {len(line.gives)} are derived")
    known = quantities(robots[line.robot])
    values = [Fraction(evaluate(text, known)) for text in line.gives]
    text = ", ".join(str(value) for value in values)
    derived = numbered(Amount(value) for value in values)
    return Compared(numbered(numbers), derived, text, difference_of(line))


def names_reading(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """The names of the quotation, over all legs, against a set."""
    if any(number.value for number in numbers_of(line.text)):
        raise QuotationError(f'"{line.text}" is no list of names, nor of names that are 0')
    printed: dict[Monomial, Amount] = {}
    for leg in line.legs:
        rename = renamer(paper, line, leg)
        for name in re.findall(r"\b(?!and\b)[A-Za-z][A-Za-z0-9]*", line.text):
            printed[((rename(name), 1),)] = _ONE
    names = evaluate(line.gives[0], quantities(robots[line.robot]))
    derived: Sum = {((name, 1),): _ONE for name in sorted(names)}
    return Compared(printed, derived, ", ".join(sorted(names)), difference_of(line))


def arithmetic_reading(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """Numbers of the quotation, called a, b, c, ..., that follow from each other.

    Each entry of `gives` is `c = 100*b/abs(a)`, to half a unit of the last digit of c, or a
    comparison that must hold.
    """
    text = "; ".join((line.text, *line.given))
    numbers = {chr(ord("a") + i): n for i, n in enumerate(numbers_of(text))}
    known = quantities(robots[line.robot])
    printed: dict[Monomial, Amount] = {}
    derived: dict[Monomial, Amount] = {}
    texts = []
    for entry in line.gives:
        letter, equal, formula = entry.partition(" = ")
        if equal:
            number = numbers.get(letter)
            if number is None:
                raise QuotationError(f"the quotation has no number {letter}")
            value = _rounded(formula, numbers, known)
            half = (number.half or Fraction(1, 2)) + value.half
            printed[((letter, 1),)] = Amount(number.value, half)
            derived[((letter, 1),)] = Amount(value.value)
            texts.append(f"{letter} = {float(value.value):.4g}")
        else:
            holds = evaluate(entry, known | _floats(numbers))
            printed[((entry, 1),)] = _ONE
            derived = derived | ({((entry, 1),): _ONE} if holds else {})
            texts.append(f"{entry}: {'yes' if holds else 'no'}")
    weak = any(re.search("[<>]", entry) for entry in line.gives)
    return Compared(printed, derived, ", ".join(texts), difference_of(line), weak=weak)


def _floats(numbers: Mapping[str, Amount]) -> dict[str, Any]:
    return {name: float(number.value) for name, number in numbers.items()}


def _rounded(formula: str, numbers: Mapping[str, Amount], known: dict[str, Any]) -> Amount:
    """The formula's value, and how far the rounding of its numbers may move it."""
    values = _floats(numbers)
    value = Fraction(evaluate(formula, known | values))
    half = Fraction(0)
    for name, number in numbers.items():
        moved = values | {name: float(number.value + number.half)}
        half += abs(Fraction(evaluate(formula, known | moved)) - value)
    return Amount(value, half)


READINGS: Mapping[str, Reading] = {
    "relation": relation_reading,
    "numbers": numbers_reading,
    "names": names_reading,
    "arithmetic": arithmetic_reading,
    **MECHANICS_READINGS,
    **WRIST_READINGS,
}
