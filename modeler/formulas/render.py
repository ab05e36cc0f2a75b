"""The table of coefficients as text, LaTeX, and Markdown."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from modeler.core.formula import DisplayedEquation, format_display
from modeler.derivation import convert_to_fraction
from modeler.formulas.closed_form import ClosedForm, ConfigurationFunction
from modeler.formulas.coefficients import CoefficientTable
from modeler.formulas.function_sheet import (
    format_sheet_latex,
    format_sheet_lines,
    format_sheet_markdown,
)
from modeler.formulas.ring import invert_base_map
from modeler.formulas.text import (
    LATEX,
    TEXT,
    TextStyle,
    format_combination,
    format_linear_form,
    format_monomial,
    format_physical,
    format_polynomial,
    format_signed_sum,
)

# A closed form as text, LaTeX and Markdown.


EQUATION = "tau_i = sum_j J_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k"


def closed_form_text(closed: ClosedForm) -> str:
    """Every function as a sum, one monomial per line."""
    lines = [f"{closed.robot.name}: {format_equation(closed)}"]
    for function in closed.functions:
        lines += ["", f"{function.name} ="]
        for sign, coefficient, monomial in _separate_signs(closed, function, TEXT):
            lines.append(f"  {sign} {_format_product(coefficient, monomial, TEXT)}")
    return "\n".join([*lines, "", *format_sheet_lines(closed.effects)]).rstrip() + "\n"


def closed_form_latex(closed: ClosedForm) -> str:
    """Every function in an `align*` of LaTeX, each monomial on a line of its own."""
    out = []
    for function in closed.functions:
        lines = [
            f"{sign} {_format_product(coefficient, monomial, LATEX)}"
            for sign, coefficient, monomial in _separate_signs(closed, function, LATEX)
        ]
        out.append(
            format_display([DisplayedEquation(format_latex_function(function.name), tuple(lines))])
            + "\n"
        )
    return "".join(out) + format_sheet_latex(closed.effects)


def _separate_signs(
    closed: ClosedForm, function: ConfigurationFunction, style: TextStyle
) -> list[tuple[str, str, str]]:
    """(sign, coefficient, monomial); sums stand in brackets behind a plus."""
    signed_terms = []
    for form, monomial in _format_terms(closed, function, style):
        if " + " in form or " - " in form:
            signed_terms.append(("+", style.add_brackets(form), monomial))
        else:
            signed_terms.append(("-" if form.startswith("-") else "+", form.lstrip("-"), monomial))
    return signed_terms


def _format_product(coefficient: str, monomial: str, style: TextStyle) -> str:
    return coefficient if monomial == "1" else f"{coefficient}{style.times}{monomial}"


def closed_form_markdown(closed: ClosedForm) -> str:
    """One table per function: monomial and its coefficient."""
    lines = [f"# Closed form of {closed.robot.title}", "", f"`{format_equation(closed)}`", ""]
    for function in closed.functions:
        lines += [f"## {function.name}", "", "| monomial | coefficient |", "|---|---|"]
        lines += [f"| `{m}` | `{form}` |" for form, m in _format_terms(closed, function, TEXT)] + [
            ""
        ]
    return "\n".join([*lines, format_sheet_markdown(closed.effects)])


def format_equation(closed: ClosedForm) -> str:
    """What the functions mean: the equation of motion."""
    factor = f"{closed.gravity_factor}*" if closed.gravity_factor else ""
    return f"{EQUATION} + {factor}g_i" + (" + e_i" if closed.effects.definitions else "")


def _format_terms(
    closed: ClosedForm, function: ConfigurationFunction, style: TextStyle
) -> list[tuple[str, str]]:
    algebra, style = closed.algebra, style.adjust_to_robot(closed.robot)
    motion, static = algebra.names[: algebra.moving], algebra.names[algebra.moving :]
    return [
        (
            format_linear_form(form, closed.parameters, static, style),
            format_monomial(at, motion, style),
        )
        for at, form in function.terms.items()
    ]


def format_latex_function(name: str) -> str:
    """`S1_12` as `S_{1,12}`."""
    return f"{name[0]}_{{{name[1:].strip('_').replace('_', ',')}}}"


def format_table_lines(table: CoefficientTable, style: TextStyle = TEXT) -> list[tuple[str, ...]]:
    """(name, function, monomial, relation, base, physical) of every coefficient, in order."""
    algebra, physical, style = (
        table.closed.algebra,
        table.physical,
        style.adjust_to_robot(table.closed.robot),
    )
    motion, static = algebra.names[: algebra.moving], algebra.names[algebra.moving :]
    return [
        (
            style.format_name(c.name),
            c.function,
            format_monomial(c.exponents, motion, style),
            format_combination(table.relations.combinations[c.name], style),
            format_linear_form(c.base, table.base_names, static, style),
            format_physical(c.physical, physical.names, physical.masses, style),
        )
        for c in table.coefficients
    ]


def coefficients_text(table: CoefficientTable) -> str:
    """Aligned columns for a terminal."""
    rows: list[tuple[str, ...]] = [
        ("name", "in", "monomial", "relation", "base parameters", "physical parameters")
    ]
    rows += format_table_lines(table)
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
    for name, function, monomial, relation, base, physical in format_table_lines(table):
        relation_cell = "independent" if relation == name else f"`{relation}`"
        lines.append(
            f"| {name} | {function} | `{monomial}` | {relation_cell} | `{base}` | `{physical}` |"
        )
    return "\n".join(lines) + "\n"


def coefficients_latex(table: CoefficientTable) -> str:
    """An `align*` of LaTeX: every coefficient, of which monomial in which function it is."""
    equations = []
    for name, function, monomial, relation, _, physical in format_table_lines(table, LATEX):
        where = rf"\text{{of }} {monomial} \text{{ in }} {format_latex_function(function)}"
        right = relation if relation != name else physical
        equations.append(DisplayedEquation(name, (rf"{right} \quad {where}",)))
    return format_display(equations) + "\n" if equations else ""


# The map between independent coefficients and base parameters, as lines of text.


def _get_static_names(table: CoefficientTable) -> tuple[str, ...]:
    return tuple(table.closed.algebra.names[table.closed.algebra.moving :])


def format_forward_map(table: CoefficientTable) -> list[str]:
    """`PJ3 = XX2R + XX3R - ZZ3`, one line per coefficient that is independent."""
    names, style = table.base_names, TEXT.adjust_to_robot(table.closed.robot)
    return [
        f"{name} = "
        f"{format_linear_form(table.by_name[name].base, names, _get_static_names(table), style)}"
        for name in table.map.rows
    ]


def format_determinant(table: CoefficientTable) -> str | None:
    """Determinant of the map; None if it is not square."""
    if table.map.determinant is None:
        return None
    return format_polynomial(
        table.map.determinant, _get_static_names(table), TEXT.adjust_to_robot(table.closed.robot)
    )


def format_backward_map(table: CoefficientTable) -> list[str]:
    """`ZZ1R = PJ7 - PJ16`, one line per base parameter; none if the map has no inverse."""
    inverse = invert_base_map(table.map, table.closed.algebra.static_ring) or {}
    static, style = _get_static_names(table), TEXT.adjust_to_robot(table.closed.robot)
    return [f"{name} = {_format_row(row, static, style)}" for name, row in inverse.items()]


def _format_row(row: Mapping[str, Any], static: tuple[str, ...], style: TextStyle) -> str:
    """A row of the inverse: each factor is a quotient of polynomials of the geometry."""
    terms: list[tuple[Fraction, str]] = []
    for name, factor in row.items():
        above, below = factor.numer, factor.denom
        if len(above) == 1 and below.is_ground:
            number = convert_to_fraction(above.LC) / convert_to_fraction(below.LC)
            letters = format_polynomial(above.monic(), static, style)
            terms.append((number, name if letters == "1" else f"{letters}*{name}"))
        else:
            quotient = f"({format_polynomial(above, static, style)})"
            if below != 1:
                quotient += f"/({format_polynomial(below, static, style)})"
            terms.append((Fraction(1), f"{quotient}*{name}"))
    return format_signed_sum(terms, style)
