"""The table of coefficients as text, LaTeX, and Markdown."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from modeler.core.latex_display import DisplayedEquation, display
from modeler.derivation import as_fraction
from modeler.formulas.closed_form import ClosedForm, Function
from modeler.formulas.coefficients import CoefficientTable
from modeler.formulas.function_sheet import sheet_latex, sheet_lines, sheet_markdown
from modeler.formulas.ring import inverse_map
from modeler.formulas.text import (
    LATEX,
    TEXT,
    TextStyle,
    combination_text,
    form_text,
    monomial_text,
    physical_text,
    polynomial_text,
    signed_sum,
)

# A closed form as text, LaTeX and Markdown.


EQUATION = "tau_i = sum_j J_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k"


def closed_form_text(closed: ClosedForm) -> str:
    """Every function as a sum, one monomial per line."""
    lines = [f"{closed.robot.name}: {equation(closed)}"]
    for function in closed.functions:
        lines += ["", f"{function.name} ="]
        for sign, coefficient, monomial in _signed(closed, function, TEXT):
            lines.append(f"  {sign} {_product(coefficient, monomial, TEXT)}")
    return "\n".join([*lines, "", *sheet_lines(closed.effects)]).rstrip() + "\n"


def closed_form_latex(closed: ClosedForm) -> str:
    """Every function in an `align*` of LaTeX, each monomial on a line of its own."""
    out = []
    for function in closed.functions:
        lines = [
            f"{sign} {_product(coefficient, monomial, LATEX)}"
            for sign, coefficient, monomial in _signed(closed, function, LATEX)
        ]
        out.append(display([DisplayedEquation(latex_function(function.name), tuple(lines))]) + "\n")
    return "".join(out) + sheet_latex(closed.effects)


def _signed(closed: ClosedForm, function: Function, style: TextStyle) -> list[tuple[str, str, str]]:
    """(sign, coefficient, monomial); sums stand in brackets behind a plus."""
    found = []
    for form, monomial in _terms(closed, function, style):
        if " + " in form or " - " in form:
            found.append(("+", style.bracket(form), monomial))
        else:
            found.append(("-" if form.startswith("-") else "+", form.lstrip("-"), monomial))
    return found


def _product(coefficient: str, monomial: str, style: TextStyle) -> str:
    return coefficient if monomial == "1" else f"{coefficient}{style.times}{monomial}"


def closed_form_markdown(closed: ClosedForm) -> str:
    """One table per function: monomial and its coefficient."""
    lines = [f"# Closed form of {closed.robot.title}", "", f"`{equation(closed)}`", ""]
    for function in closed.functions:
        lines += [f"## {function.name}", "", "| monomial | coefficient |", "|---|---|"]
        lines += [f"| `{m}` | `{form}` |" for form, m in _terms(closed, function, TEXT)] + [""]
    return "\n".join([*lines, sheet_markdown(closed.effects)])


def equation(closed: ClosedForm) -> str:
    """What the functions mean: the equation of motion."""
    factor = f"{closed.gravity_factor}*" if closed.gravity_factor else ""
    return f"{EQUATION} + {factor}g_i" + (" + e_i" if closed.effects.definitions else "")


def _terms(closed: ClosedForm, function: Function, style: TextStyle) -> list[tuple[str, str]]:
    algebra, style = closed.algebra, style.of(closed.robot)
    motion, static = algebra.names[: algebra.moving], algebra.names[algebra.moving :]
    return [
        (form_text(form, closed.parameters, static, style), monomial_text(at, motion, style))
        for at, form in function.terms.items()
    ]


def latex_function(name: str) -> str:
    """`S1_12` as `S_{1,12}`."""
    return f"{name[0]}_{{{name[1:].strip('_').replace('_', ',')}}}"


def table_lines(table: CoefficientTable, style: TextStyle = TEXT) -> list[tuple[str, ...]]:
    """(name, function, monomial, relation, base, physical) of every coefficient, in order."""
    algebra, physical, style = table.closed.algebra, table.physical, style.of(table.closed.robot)
    motion, static = algebra.names[: algebra.moving], algebra.names[algebra.moving :]
    return [
        (
            style.name(c.name),
            c.function,
            monomial_text(c.exponents, motion, style),
            combination_text(table.relations.combinations[c.name], style),
            form_text(c.base, table.base_names, static, style),
            physical_text(c.physical, physical.names, physical.masses, style),
        )
        for c in table.coefficients
    ]


def coefficients_text(table: CoefficientTable) -> str:
    """Aligned columns for a terminal."""
    rows: list[tuple[str, ...]] = [
        ("name", "in", "monomial", "relation", "base parameters", "physical parameters")
    ]
    rows += table_lines(table)
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    lines = [
        "  ".join([*(cell.ljust(w) for cell, w in zip(row, widths, strict=False)), row[5]]).rstrip()
        for row in rows
    ]
    return "\n".join(lines) + "\n"


def coefficients_markdown(table: CoefficientTable) -> str:
    """A Markdown table."""
    lines = [
        "| name | function | monomial | relation | base parameters | physical parameters |",
        "|---|---|---|---|---|---|",
    ]
    for name, function, monomial, relation, base, physical in table_lines(table):
        told = "independent" if relation == name else f"`{relation}`"
        lines.append(f"| {name} | {function} | `{monomial}` | {told} | `{base}` | `{physical}` |")
    return "\n".join(lines) + "\n"


def coefficients_latex(table: CoefficientTable) -> str:
    """An `align*` of LaTeX: every coefficient, of which monomial in which function it is."""
    equations = []
    for name, function, monomial, relation, _, physical in table_lines(table, LATEX):
        where = rf"\text{{of }} {monomial} \text{{ in }} {latex_function(function)}"
        right = relation if relation != name else physical
        equations.append(DisplayedEquation(name, (rf"{right} \quad {where}",)))
    return display(equations) + "\n" if equations else ""


# The map between independent coefficients and base parameters, as lines of text.


def _static(table: CoefficientTable) -> tuple[str, ...]:
    return tuple(table.closed.algebra.names[table.closed.algebra.moving :])


def forward_lines(table: CoefficientTable) -> list[str]:
    """`PJ3 = XX2R + XX3R - ZZ3`, one line per coefficient that is independent."""
    names, style = table.base_names, TEXT.of(table.closed.robot)
    return [
        f"{name} = {form_text(table.by_name[name].base, names, _static(table), style)}"
        for name in table.map.rows
    ]


def determinant_text(table: CoefficientTable) -> str | None:
    """Determinant of the map; None if it is not square."""
    if table.map.determinant is None:
        return None
    return polynomial_text(table.map.determinant, _static(table), TEXT.of(table.closed.robot))


def backward_lines(table: CoefficientTable) -> list[str]:
    """`ZZ1R = PJ7 - PJ16`, one line per base parameter; none if the map has no inverse."""
    inverse = inverse_map(table.map, table.closed.algebra.static_ring) or {}
    static, style = _static(table), TEXT.of(table.closed.robot)
    return [f"{name} = {_row_text(row, static, style)}" for name, row in inverse.items()]


def _row_text(row: Mapping[str, Any], static: tuple[str, ...], style: TextStyle) -> str:
    """A row of the inverse: each factor is a quotient of polynomials of the geometry."""
    terms: list[tuple[Fraction, str]] = []
    for name, factor in row.items():
        above, below = factor.numer, factor.denom
        if len(above) == 1 and below.is_ground:
            number = as_fraction(above.LC) / as_fraction(below.LC)
            letters = polynomial_text(above.monic(), static, style)
            terms.append((number, name if letters == "1" else f"{letters}*{name}"))
        else:
            quotient = f"({polynomial_text(above, static, style)})"
            if below != 1:
                quotient += f"/({polynomial_text(below, static, style)})"
            terms.append((Fraction(1), f"{quotient}*{name}"))
    return signed_sum(terms, style)
