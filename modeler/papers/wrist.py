"""Coefficient functions (PG, PJ, PS) that a robot file quotes from a paper, one line each."""

import itertools
import re
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from modeler.core.expression import Expression, parse_expression
from modeler.formulas import (
    CoefficientTable,
    PrintedTerms,
    check_friction,
    check_independent,
    check_solutions,
    find_wrong_definitions,
    find_wrong_functions,
    format_monomial,
)
from modeler.papers import quotation
from modeler.papers.paper import (
    DerivedRobot,
    LineComparison,
    Paper,
    PrintedLine,
    Reading,
    Robots,
    join_in_order,
    join_numbers,
    join_sums,
)
from modeler.papers.quotation import Amount, QuotationError, Sum, format_sum, read_sum

_PLACES = {"definition": "section 2.2", "function": "section 2.2", "solution": "section 4"}


def collect_coefficient_quotations(paper: Paper, robots: Robots) -> list[PrintedLine]:
    """Collects the quotations of the robot file, with the known slips of the paper's file."""
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


def _restrict_print(table: CoefficientTable, **entries: object) -> CoefficientTable:
    """The table, its print holding these entries and nothing else."""
    full_print = table.printed
    alone = PrintedTerms(
        missing=full_print.missing, monomials=full_print.monomials, example=full_print.example
    )
    return replace(table, printed=replace(alone, **entries))  # type: ignore[arg-type]


def _parse_formula(text: str) -> Expression:
    return parse_expression(" ".join(text.split()))


def _compare_difference(line: PrintedLine, difference: str, right: str) -> LineComparison:
    """Equal if what is found to differ is what the paper's file says."""
    one: Sum = {(("difference", 1),): Amount(Fraction(1))}
    different: Sum = {} if difference == line.difference else one
    text = f"derived - printed: {difference}" if difference else right
    return LineComparison(different, {}, text, is_difference_included=True)


def _compare_function(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    name, _, text = line.quote.partition(" = ")
    printed = _parse_formula(text)
    table = _restrict_print(robots[line.robot].table, functions={name: printed})
    parts = [f"({v})*{k}" for c in find_wrong_functions(table) for k, v in c.difference.items()]
    # Coefficients that number terms of other functions, equal in value or not.
    functions_by_name = {n: c.function for n, c in table.by_name.items() if n in printed.names}
    others = (item for item in functions_by_name.items() if item[1] != name)
    parts += [f"{n} is of {function}" for n, function in others]
    return _compare_difference(line, "; ".join(parts), "the same")


def _compare_definition(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    name, _, text = line.quote.partition(" = ")
    table = _restrict_print(robots[line.robot].table, definitions={name: _parse_formula(text)})
    difference = "; ".join(check.difference for check in find_wrong_definitions(table))
    return _compare_difference(line, difference, "the same")


def _compare_solution(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    name, _, text = line.quote.partition(" = ")
    above, _, below = text.partition(" over ")
    table = _restrict_print(
        robots[line.robot].table,
        solutions={name: (_parse_formula(above), _parse_formula(below or "1"))},
    )
    (check,) = check_solutions(table)
    if check.verdict == "right":
        return _compare_difference(line, "", f"returns {name}")
    difference = check.verdict + (f", numerator {check.numerator}" if "0" in check.verdict else "")
    return replace(_compare_difference(line, difference, ""), text=difference)


def _compare_independent(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """The list of independent coefficients: those that are defined, and independent."""
    table, names = robots[line.robot].table, tuple(line.quote.split(", "))
    if names != tuple(table.printed.definitions):
        raise QuotationError("the list names others than the printed definitions")
    dependent = check_independent(_restrict_print(table, independent=names))
    difference = "; ".join(f"{name} = {text}" for name, text in dependent.items())
    compared = _compare_difference(line, difference, "independent")
    return replace(compared, text=difference or "independent")


def _compare_monomials(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`s2^2; c2 s2; 1`: the monomials of a function in the order of its coefficients."""
    derived = [at for _, at in _collect_terms(robots[line.robot], line.expected[0])]
    printed = [read_sum(text, str) for text in line.quote.split(";")]
    text = "; ".join(format_sum(part) for part in derived)
    return LineComparison(join_in_order(printed), join_in_order(derived), text)


def _compare_values(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """A function with numbers for its coefficients, against the list that gives them by name."""
    name, _, text = line.quote.partition(" = ")
    values = {}
    for entry in ", ".join(line.assumptions).split(","):
        key, _, number = entry.partition("=")
        values[key.strip()] = quotation.read_amount(number.strip())
    terms = _collect_terms(robots[line.robot], name)
    if {key for key, _ in terms} != set(values):
        raise QuotationError(f"the list names others than the coefficients of {name}")
    derived = {monomial: Amount(values[key].value) for key, at in terms for monomial in at}
    return LineComparison(read_sum(text, str), derived, f"{name} = {format_sum(derived)}")


def _collect_terms(derived: DerivedRobot, function: str) -> list[tuple[str, Sum]]:
    """(coefficient, its monomial) of a function, in order of the coefficients."""
    algebra = derived.table.closed.algebra
    names = algebra.names[: algebra.moving]
    coefficients = [c for c in derived.table.coefficients if c.function == function]
    return [(c.name, read_sum(format_monomial(c.exponents, names), str)) for c in coefficients]


_TERM = re.compile(r"[*\s]*\b(?:([nabc])_?([123])|v\^?(CM)([abc]))$")


def _read_components(text: str) -> dict[str, Sum]:
    """{vector: factor} of `-at3 qd1 a2 + at2 qd1 a3`, whose terms end with unit vectors or vCMa."""
    components: dict[str, Sum] = {}
    for term in re.findall(r"[+-]?(?:[^-+()]|\((?:[^()]|\([^()]*\))*\))+", text.strip()):
        axis = _TERM.search(term.rstrip())
        if axis is None:
            raise QuotationError(f'"{term}" ends with no unit vector')
        factors = term[: axis.start()]
        size = read_sum(f"{factors}{' ' if factors[-1:].isalnum() else ' 1'}", str)
        name = "".join(filter(None, axis.groups()))
        components[name] = quotation.add_sums(components.get(name, {}), size)
    return components


def _compare_kane(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """Rows of Kane's form, those of `gives`, along unit vectors, `;` between; with g = 1."""
    formulas = [robots[line.robot].kane[name] for name in line.expected]
    printed, derived = (
        join_in_order(join_sums(_read_components(x)) for x in v)
        for v in (line.text.split(";"), formulas)
    )
    unit: Sum = {(): Amount(Fraction(1))}
    return LineComparison(
        printed, quotation.replace_names(derived, {"g": unit}), "; ".join(formulas)
    )


def _compare_indices(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`Jij ddotqi + Sijk qdj qdk + gi = taui`: the index of each term that no summation takes.

    `gives` are the terms of the equation, `Jddotq`; an index that stands three times is doubled.
    """
    printed: dict[str, Sum] = {}
    for term in re.split(r"[+=]", line.text):
        letters = "".join(re.findall(r"[A-Za-z]+?([ijk]+)\b", term))
        free = [x * (letters.count(x) // 2 + 1) for x in "ijk" if letters.count(x) % 2]
        name = re.sub(r"([A-Za-z]+?)[ijk]+\b|[ ()]", r"\1", term)
        printed[name] = read_sum("*".join(free) or "0", str)
    derived = {name: read_sum("i", str) for name in line.expected}
    return LineComparison(join_sums(printed), join_sums(derived), "i in every term")


def _compare_friction(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`Gii Cik sgn(qdk)` at the robot file's motion, against G' C sgn(G qd)."""
    match = re.fullmatch(r"G([ijk]{2}) C([ijk]{2}) sgn\(qd([ijk])\)", line.text)
    coupling = robots[line.robot].table.printed.coupling
    if match is None or coupling is None:
        raise QuotationError(f'"{line.text}" is no friction of coupled motors')
    G, C = coupling.motor_from_joint, coupling.coulomb
    printed = dict.fromkeys(range(3), Fraction(0))
    used = sorted({*"i", *match[1], *match[2], *match[3]})
    for at in itertools.product(range(3), repeat=len(used)):
        index = dict(zip(used, at, strict=True))
        (a, b), (c, d) = ([index[x] for x in pair] for pair in (match[1], match[2]))
        speed = coupling.speed[index[match[3]]]
        printed[index["i"]] += G[a][b] * C[c] * (c == d) * ((speed > 0) - (speed < 0))
    derived = check_friction(coupling).derived
    text = ", ".join(f"{float(value):g}" for value in derived)
    return LineComparison(
        join_numbers(map(Amount, printed.values())),
        join_numbers(map(Amount, derived)),
        f"G' C sgn(G qd); at the motion of docs/robots/wrist.md {text} N m",
    )


WRIST_READINGS: Mapping[str, Reading] = {
    "function": _compare_function,
    "definition": _compare_definition,
    "solution": _compare_solution,
    "independent": _compare_independent,
    "monomials": _compare_monomials,
    "values": _compare_values,
    "velocity": _compare_kane,
    "applied": _compare_kane,
    "indices": _compare_indices,
    "friction": _compare_friction,
}
