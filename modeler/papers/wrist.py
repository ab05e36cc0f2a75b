"""Coefficient functions (PG, PJ, PS) that a robot file quotes from a paper, one line each."""

import itertools
import re
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from modeler.core.expression import Expression, parse
from modeler.formulas import (
    CoefficientTable,
    Print,
    check_friction,
    check_independent,
    check_solutions,
    monomial_text,
    wrong_definitions,
    wrong_functions,
)
from modeler.papers.compared import Compared, Reading, Robots, in_order, joined, numbered
from modeler.papers.paper import DerivedPaper, Paper, PrintedLine
from modeler.papers.quotation import (
    Amount,
    QuotationError,
    Sum,
    added,
    amount,
    read_sum,
    replaced,
    sum_text,
)

_PLACES = {"definition": "section 2.2", "function": "section 2.2", "solution": "section 4"}


def coefficient_quotations(paper: Paper, robots: Robots) -> list[PrintedLine]:
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
    return parse(" ".join(text.split()))


def _stated(line: PrintedLine, found: str, right: str) -> Compared:
    """Equal if what is found to differ is what the paper's file says."""
    different: Sum = {} if found == line.difference else {(("difference", 1),): Amount(Fraction(1))}
    text = f"derived - printed: {found}" if found else right
    return Compared(different, {}, text, settled=True)


def _function(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    name, _, text = line.quote.partition(" = ")
    printed = _read(text)
    table = _only(robots[line.robot].table, functions={name: printed})
    parts = [f"({v})*{k}" for c in wrong_functions(table) for k, v in c.difference.items()]
    # Coefficients that number terms of other functions, equal in value or not.
    own = {n: c.function for n, c in table.by_name.items() if n in printed.names}
    parts += [f"{n} is of {function}" for n, function in own.items() if function != name]
    return _stated(line, "; ".join(parts), "the same")


def _definition(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    name, _, text = line.quote.partition(" = ")
    table = _only(robots[line.robot].table, definitions={name: _read(text)})
    found = "; ".join(check.difference for check in wrong_definitions(table))
    return _stated(line, found, "the same")


def _solution(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    name, _, text = line.quote.partition(" = ")
    above, _, below = text.partition(" over ")
    table = _only(
        robots[line.robot].table, solutions={name: (_read(above), _read(below or "1"))}
    )  # fmt: skip
    (check,) = check_solutions(table)
    if check.verdict == "right":
        return _stated(line, "", f"returns {name}")
    found = check.verdict + (f", numerator {check.numerator}" if "0" in check.verdict else "")
    return replace(_stated(line, found, ""), text=found)


def _independent(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """The list of independent coefficients: those that are defined, and independent."""
    table, names = robots[line.robot].table, tuple(line.quote.split(", "))
    if names != tuple(table.printed.definitions):
        raise QuotationError("the list names others than the printed definitions")
    dependent = check_independent(_only(table, independent=names))
    found = "; ".join(f"{name} = {text}" for name, text in dependent.items())
    return replace(_stated(line, found, "independent"), text=found or "independent")


def _monomials(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """`s2^2; c2 s2; 1`: the monomials of a function in the order of its coefficients."""
    derived = [at for _, at in _terms(robots[line.robot], line.gives[0])]
    printed = [read_sum(text, str) for text in line.quote.split(";")]
    text = "; ".join(sum_text(part) for part in derived)
    return Compared(in_order(printed), in_order(derived), text)


def _values(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
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


def _terms(derived: DerivedPaper, function: str) -> list[tuple[str, Sum]]:
    """(coefficient, its monomial) of a function, in order of the coefficients."""
    algebra = derived.table.closed.algebra
    names = algebra.names[: algebra.moving]
    found = [c for c in derived.table.coefficients if c.function == function]
    return [(c.name, read_sum(monomial_text(c.exponents, names), str)) for c in found]


_TERM = re.compile(r"[*\s]*\b(?:([nabc])_?([123])|v\^?(CM)([abc]))$")


def _along(text: str) -> dict[str, Sum]:
    """{vector: factor} of `-at3 qd1 a2 + at2 qd1 a3`, whose terms end with unit vectors or vCMa."""
    found: dict[str, Sum] = {}
    for term in re.findall(r"[+-]?(?:[^-+()]|\((?:[^()]|\([^()]*\))*\))+", text.strip()):
        axis = _TERM.search(term.rstrip())
        if axis is None:
            raise QuotationError(f'"{term}" ends with no unit vector')
        factors = term[: axis.start()]
        size = read_sum(f"{factors}{' ' if factors[-1:].isalnum() else ' 1'}", str)
        name = "".join(filter(None, axis.groups()))
        found[name] = added(found.get(name, {}), size)
    return found


def _kane(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """Rows of Kane's form, those of `gives`, along unit vectors, `;` between; with g = 1."""
    own = [robots[line.robot].kane[name] for name in line.gives]
    printed, derived = (in_order(joined(_along(x)) for x in v) for v in (line.text.split(";"), own))
    unit: Sum = {(): Amount(Fraction(1))}
    return Compared(printed, replaced(derived, {"g": unit}), "; ".join(own))


def _indices(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """`Jij ddotqi + Sijk qdj qdk + gi = taui`: the index of each term that no summation takes.

    `gives` are the terms of the equation, `Jddotq`; an index that stands three times is doubled.
    """
    printed: dict[str, Sum] = {}
    for term in re.split(r"[+=]", line.text):
        letters = "".join(re.findall(r"[A-Za-z]+?([ijk]+)\b", term))
        free = [x * (letters.count(x) // 2 + 1) for x in "ijk" if letters.count(x) % 2]
        name = re.sub(r"([A-Za-z]+?)[ijk]+\b|[ ()]", r"\1", term)
        printed[name] = read_sum("*".join(free) or "0", str)
    derived = {name: read_sum("i", str) for name in line.gives}
    return Compared(joined(printed), joined(derived), "i in every term")


def _friction(paper: Paper, line: PrintedLine, robots: Robots) -> Compared:
    """`Gii Cik sgn(qdk)` at the robot file's motion, against G' C sgn(G qd)."""
    found = re.fullmatch(r"G([ijk]{2}) C([ijk]{2}) sgn\(qd([ijk])\)", line.text)
    coupling = robots[line.robot].table.printed.coupling
    if found is None or coupling is None:
        raise QuotationError(f'"{line.text}" is no friction of coupled motors')
    G, C = coupling.motor_from_joint, coupling.coulomb
    printed = dict.fromkeys(range(3), Fraction(0))
    used = sorted({*"i", *found[1], *found[2], *found[3]})
    for at in itertools.product(range(3), repeat=len(used)):
        index = dict(zip(used, at, strict=True))
        (a, b), (c, d) = ([index[x] for x in pair] for pair in (found[1], found[2]))
        speed = coupling.speed[index[found[3]]]
        printed[index["i"]] += G[a][b] * C[c] * (c == d) * ((speed > 0) - (speed < 0))
    derived = check_friction(coupling).derived
    text = ", ".join(f"{float(value):g}" for value in derived)
    return Compared(
        numbered(map(Amount, printed.values())), numbered(map(Amount, derived)),
        f"G' C sgn(G qd); at the motion of docs/robots/wrist.md {text} N m",
    )  # fmt: skip


WRIST_READINGS: Mapping[str, Reading] = {
    "function": _function,
    "definition": _definition,
    "solution": _solution,
    "independent": _independent,
    "monomials": _monomials,
    "values": _values,
    "velocity": _kane,
    "applied": _kane,
    "indices": _indices,
    "friction": _friction,
}
