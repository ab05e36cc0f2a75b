"""A paper that prints coefficient functions (PG, PJ, PS): each printed line and its verdict.

The robot file quotes the print (`[terms]`), the paper's file says which lines are known to be
wrong; a line that is wrong and not among them, or among them and right, is a difference.
"""

from collections.abc import Collection, Iterable

from modeler.base import BaseParameters
from modeler.papers.check import Line, Verdict
from modeler.symbolic import SymbolicModel
from modeler.terms import coefficient_table
from modeler.terms.checks import (
    check_independent,
    check_solutions,
    wrong_definitions,
    wrong_functions,
)


def coefficient_lines(
    model: SymbolicModel, base: BaseParameters, known: Collection[str]
) -> list[Line]:
    """Definitions, functions, solutions and independent coefficients, as printed and as derived.

    Args:
        model: of a robot whose file quotes a paper.
        base: its base parameters.
        known: names of the lines that are wrong in the print.
    """
    table = coefficient_table(model, base)
    printed, robot = table.printed, model.robot.name
    definitions = {c.name: f"derived - printed = {c.difference}" for c in wrong_definitions(table)}
    functions = {
        c.name: "derived - printed has " + "; ".join(f"({v})*{k}" for k, v in c.difference.items())
        for c in wrong_functions(table)
    }
    solutions = {c.letter: c.verdict for c in check_solutions(table) if c.verdict != "right"}
    dependent = check_independent(table)
    lines: list[Line] = []
    for place, names, wrong in (
        ("definition", printed.definitions, definitions),
        ("function", printed.functions, functions),
        ("solution", printed.solutions, solutions),
        ("independent", printed.independent, dependent),
    ):
        lines += _lines(robot, place, names, wrong, known)
    return lines


def _lines(
    robot: str, place: str, names: Iterable[str], wrong: dict[str, str], known: Collection[str]
) -> list[Line]:
    found = []
    for name in names:
        expected = f"{place} {name}" in known
        if name in wrong:
            verdict = Verdict.MISPRINT if expected else Verdict.DIFFERENT
        else:
            verdict = Verdict.DIFFERENT if expected else Verdict.EQUAL
        found.append(Line(robot, place, name, wrong.get(name, name), verdict, ""))
    return found
