"""The table of coefficients as text, LaTeX, Markdown and JSON."""

import json
from dataclasses import dataclass

from modeler.core.json_text import nulled
from modeler.core.latex_lines import Equation, display
from modeler.terms.coefficients import Coefficient, CoefficientTable
from modeler.terms.render import equation, latex_function
from modeler.terms.text import (
    LATEX,
    TEXT,
    Style,
    combination_text,
    form_text,
    monomial_text,
    physical_text,
    polynomial_text,
)


@dataclass(frozen=True)
class Line:
    """One coefficient, printed but not yet laid out."""

    name: str
    function: str
    monomial: str
    relation: str
    base: str
    physical: str


def table_lines(table: CoefficientTable, style: Style = TEXT) -> list[Line]:
    """All coefficients as strings, in order."""
    return [_line(table, coefficient, style) for coefficient in table.coefficients]


def _line(table: CoefficientTable, coefficient: Coefficient, style: Style) -> Line:
    algebra = table.closed.algebra
    motion, static = algebra.names[: algebra.moving], algebra.names[algebra.moving :]
    combination = table.relations.combinations[coefficient.name]
    return Line(
        style.name(coefficient.name),
        coefficient.function,
        monomial_text(coefficient.exponents, motion, style),
        combination_text(combination, style),
        form_text(coefficient.base, table.base_names, static, style),
        physical_text(coefficient.physical, table.physical.names, table.physical.masses, style),
    )


def coefficients_text(table: CoefficientTable) -> str:
    """Aligned columns for a terminal."""
    rows = [("name", "in", "monomial", "relation", "base parameters", "physical parameters")]
    rows += [
        (x.name, x.function, x.monomial, x.relation, x.base, x.physical) for x in table_lines(table)
    ]
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
    lines += [
        f"| {x.name} | {x.function} | `{x.monomial}` | "
        f"{'independent' if x.relation == x.name else f'`{x.relation}`'} | `{x.base}` | "
        f"`{x.physical}` |"
        for x in table_lines(table)
    ]
    return "\n".join(lines) + "\n"


def coefficients_latex(table: CoefficientTable) -> str:
    """An `align*` of LaTeX: every coefficient, of which monomial in which function it is."""
    equations = [
        Equation(
            x.name,
            (
                f"{x.relation if x.relation != x.name else x.physical}"
                rf" \quad \text{{of }} {x.monomial} \text{{ in }} {latex_function(x.function)}",
            ),
        )
        for x in table_lines(table, LATEX)
    ]
    return display(equations) + "\n" if equations else ""


def coefficients_json(table: CoefficientTable) -> str:
    """{"robot", "equation", "coefficients", "rank", "independent", "physical", "map"}."""
    found = table.identifiability
    static = table.closed.algebra.names[table.closed.algebra.moving :]
    determinant = table.map.determinant
    content = {
        "robot": table.closed.robot.name,
        "equation": equation(table.closed),
        "gravity_factor": table.closed.gravity_factor,
        "coefficients": [
            {
                "name": line.name,
                "function": line.function,
                "monomial": line.monomial,
                "combination": {
                    k: str(v) for k, v in table.relations.combinations[line.name].items()
                },
                "base": line.base,
                "physical": line.physical,
            }
            for line in table_lines(table)
        ],
        "rank": table.relations.rank,
        "independent": list(table.relations.independent),
        "independent_known_geometry": list(table.known_geometry),
        "physical": {
            "parameters": list(found.letters),
            "vanishing": list(found.vanishing),
            "only_together": [dict(group) for group in found.sums],
            "jacobian_rank": found.jacobian_rank,
        },
        "map": {
            "rows": list(table.map.rows),
            "columns": list(table.map.columns),
            "determinant": None if determinant is None else polynomial_text(determinant, static),
        },
    }
    return json.dumps(nulled(content), indent=1, allow_nan=False) + "\n"
