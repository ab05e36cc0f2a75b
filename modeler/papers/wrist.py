"""Coefficient functions (PG, PJ, PS) that a robot file quotes from a paper, one line each."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.expression import Expression, ExpressionError, parse
from modeler.papers.compared import Compared, joined
from modeler.papers.derived import Derived
from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quotation import Amount, QuotationError, Sum, amount, read_sum, sum_text
from modeler.terms import CoefficientTable
from modeler.terms.checks import (
    check_independent,
    check_solutions,
    wrong_definitions,
    wrong_functions,
)
from modeler.terms.printed import Print
from modeler.terms.text import monomial_text

_PLACES = {"definition": "section 2.2", "function": "section 2.2", "solution": "section 4"}


def coefficient_quotations(paper: Paper, robots: Mapping[str, Derived]) -> list[PrintedLine]:
    """The quotations of the robot file, with what the paper's file says is wrong in them."""
    if not paper.coefficients:
        return []
    printed = robots[paper.coefficients].table.printed
    quotes = {f"definition {n}": f"{n} = {e.text}" for n, e in printed.definitions.items()}
    quotes |= {f"function {n}": f"{n} = {e.text}" for n, e in printed.functions.items()}
    for name, (above, below) in printed.solutions.items():
        under = "" if below.text == "1" else f" over {below.text}"
        quotes[f"solution {name}"] = f"{name} = {above.text}{under}"
    quotes["independent"] = ", ".join(printed.independent)
    lines = []
    for key, quote in quotes.items():
        kind, _, name = key.partition(" ")
        place = f"{_PLACES.get(kind, 'section 2.2')}, {name}".removesuffix(", ")
        slip: dict[str, Any] = dict(paper.slips.get(key, {}))
        lines.append(PrintedLine(paper.coefficients, place, kind, quote, **slip))
    return lines


def _only(table: CoefficientTable, **entries: object) -> CoefficientTable:
    """The table, its print holding these entries and nothing else."""
    kept = table.printed
    alone = Print(missing=kept.missing, monomials=kept.monomials, example=kept.example)
    return replace(table, printed=replace(alone, **entries))  # type: ignore[arg-type]


def _read(text: str) -> Expression:
    try:
        return parse(" ".join(text.split()))
    except ExpressionError as error:
        raise QuotationError(str(error)) from None


def _stated(line: PrintedLine, found: str, right: str) -> Compared:
    """Equal if what is found to differ is what the paper's file says."""
    different: Sum = {} if found == line.difference else {(("difference", 1),): Amount(Fraction(1))}
    return Compared(different, {}, f"derived - printed: {found}" if found else right)


def _function(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    name, _, text = line.quote.partition(" = ")
    printed = _read(text)
    table = _only(robots[line.robot].table, functions={name: printed})
    try:
        wrong = wrong_functions(table)
    except RobotError as error:
        raise QuotationError(str(error)) from None
    parts = [f"({v})*{k}" for c in wrong for k, v in c.difference.items()]
    found = "; ".join(parts + _of_others(table, name, printed))
    return _stated(line, found, "the same")


def _of_others(table: CoefficientTable, name: str, printed: Expression) -> list[str]:
    """Coefficients that number terms of other functions, equal in value or not."""
    own = {n: c.function for n, c in table.by_name.items() if n in printed.names}
    return [f"{n} is of {function}" for n, function in own.items() if function != name]


def _definition(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    name, _, text = line.quote.partition(" = ")
    table = _only(robots[line.robot].table, definitions={name: _read(text)})
    try:
        found = "; ".join(check.difference for check in wrong_definitions(table))
    except RobotError as error:
        raise QuotationError(str(error)) from None
    return _stated(line, found, "the same")


def _solution(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    name, _, text = line.quote.partition(" = ")
    above, _, below = text.partition(" over ")
    table = _only(
        robots[line.robot].table, solutions={name: (_read(above), _read(below or "1"))}
    )  # fmt: skip
    try:
        (check,) = check_solutions(table)
    except RobotError as error:
        raise QuotationError(str(error)) from None
    if check.verdict == "right":
        return _stated(line, "", f"returns {name}")
    found = check.verdict + (f", numerator {check.numerator}" if "0" in check.verdict else "")
    return replace(_stated(line, found, ""), text=found)


def _independent(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """The list of independent coefficients: those that are defined, and independent."""
    table, names = robots[line.robot].table, tuple(line.quote.split(", "))
    if names != tuple(table.printed.definitions):
        raise QuotationError("the list names others than the printed definitions")
    dependent = check_independent(_only(table, independent=names))
    found = "; ".join(f"{name} = {text}" for name, text in dependent.items())
    return replace(_stated(line, found, "independent"), text=found or "independent")


def _monomials(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`s2^2; c2 s2; 1`: the monomials of a function in the order of its coefficients."""
    derived = [at for _, at in _terms(robots[line.robot], line.gives[0])]
    printed = [read_sum(text, str) for text in line.quote.split(";")]
    return Compared(
        joined({str(i): part for i, part in enumerate(printed)}),
        joined({str(i): part for i, part in enumerate(derived)}),
        "; ".join(sum_text(part) for part in derived),
    )


def _values(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """A function with numbers for its coefficients, against the list that gives them by name."""
    name, _, text = line.quote.partition(" = ")
    values = {}
    for entry in ", ".join(line.given).split(","):
        key, _, number = entry.partition("=")
        values[key.strip()] = amount(number.strip())
    terms = _terms(robots[line.robot], name)
    if {key for key, _ in terms} != set(values):
        raise QuotationError(f"the list names others than the coefficients of {name}")
    derived = {
        monomial: Amount(values[key].value) for key, at in terms for monomial in at
    }  # fmt: skip
    return Compared(read_sum(text, str), derived, f"{name} = {sum_text(derived)}")


def _terms(derived: Derived, function: str) -> list[tuple[str, Sum]]:
    """(coefficient, its monomial) of a function, in order of the coefficients."""
    algebra = derived.table.closed.algebra
    names = algebra.names[: algebra.moving]
    found = [c for c in derived.table.coefficients if c.function == function]
    return [(c.name, read_sum(monomial_text(c.exponents, names), str)) for c in found]


WRIST_READINGS: Mapping[str, Callable[[Paper, PrintedLine, Mapping[str, Derived]], Compared]] = {
    "function": _function,
    "definition": _definition,
    "solution": _solution,
    "independent": _independent,
    "monomials": _monomials,
    "values": _values,
}
