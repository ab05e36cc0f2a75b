"""The page about a robot's coefficients, computed while it is written."""

import dataclasses
from fractions import Fraction

from modeler.base import BaseParameters
from modeler.base.relation_text import relation_text
from modeler.symbolic import SymbolicModel
from modeler.terms.closed_form import closed_form
from modeler.terms.coefficients import CoefficientTable, by_function, coefficient_table
from modeler.terms.map_render import backward_lines, determinant_text, forward_lines
from modeler.terms.print_report import print_sections
from modeler.terms.relations import classes
from modeler.terms.render import equation
from modeler.terms.table_render import coefficients_markdown
from modeler.terms.text import signed_sum

_WIDTH = 96


def terms_report(model: SymbolicModel, base: BaseParameters) -> str:
    """The page as Markdown: functions, relations, map, a paper's print checked, all coefficients.

    Raises:
        DerivationError: the robot has no closed form worth printing.
        RobotError: `[terms]` or `[physical]` of the robot file is wrong.
    """
    table = coefficient_table(model, base)
    parts = [_head(table), _functions(table), _relations(model, table), _map(table)]
    parts += print_sections(model, table)
    parts.append("## All coefficients\n\n" + coefficients_markdown(table))
    return "\n".join(parts)


def _head(table: CoefficientTable) -> str:
    closed = table.closed
    factor = ""
    if closed.gravity_factor:
        factor = f" Gravity torques are {closed.gravity_factor} times g_i."
    lines = [
        f"# Coefficients of the closed form: {closed.robot.title}",
        "",
        "All formulas and numbers below are computed from the robot file when this page is made; "
        "only what is called printed is quoted.",
        "",
        f"`{equation(closed)}`",
        "",
        "J is the inertia matrix (symmetric), S_ijk (j <= k) the full coefficient of qd_j qd_k; s "
        f"and c are sine and cosine of a joint angle.{factor} Functions not listed are zero.",
        "",
    ]
    if table.printed.source:
        lines += [f"Source of the print: {table.printed.source}.", ""]
    return "\n".join(lines)


def _functions(table: CoefficientTable) -> str:
    lines = ["## The functions", "", "```text"]
    for function, coefficients in by_function(table):
        terms = [c.name if c.monomial == "1" else f"{c.name}*{c.monomial}" for c in coefficients]
        lines += _wrapped(f"{function.name} = ", terms)
    return "\n".join([*lines, "```", ""])


def _wrapped(head: str, terms: list[str]) -> list[str]:
    lines, line = [], head
    for index, term in enumerate(terms):
        piece = term if index == 0 else f" + {term}"
        if len(line) + len(piece) > _WIDTH:
            lines.append(line)
            line = "     "
        line += piece
    return [*lines, line]


def _fewest(model: SymbolicModel, table: CoefficientTable) -> list[str]:
    """How many monomials the free choice of squares needs, where a paper's choice is followed."""
    if "keep_sine_squares" not in model.robot.terms:
        return []
    robot = dataclasses.replace(model.robot, terms={})
    count = closed_form(dataclasses.replace(model, robot=robot)).monomials
    return [
        f"* The squares of sines and cosines are those of the print; the best choice per function "
        f"and joint needs {count} monomials."
    ]


def _relations(model: SymbolicModel, table: CoefficientTable) -> str:
    found, relations = table.identifiability, table.relations
    kinds = {"gravity": 0, "inertia": 0, "christoffel": 0}
    for function in table.closed.functions:
        kinds[function.kind] += len(function.terms)
    appearing, rank = len(found.appearing), found.jacobian_rank
    lines = [
        "## Relations",
        "",
        f"* {kinds['gravity']} + {kinds['inertia']} + {kinds['christoffel']} = "
        f"**{len(table.coefficients)}** coefficients (gravity, inertia matrix, Christoffel). Up to "
        f"constant factors they are {len(classes(relations))} different functions of the "
        "parameters.",
        *_fewest(model, table),
        f"* Rank over Q, exact, with all lengths unknown: **{relations.rank}**. Independent, first "
        f"come first kept: {', '.join(relations.independent)}.",
        f"* Rank with the geometry known: {len(table.known_geometry)}; base parameters: "
        f"{table.base.rank}.",
        f"* {len(found.letters)} physical parameters, of which {appearing} appear. The "
        f"{len(found.vanishing)} without effect on any torque: "
        f"**{', '.join(found.vanishing) or 'none'}**.",
    ]
    if found.sums:
        sums = (signed_sum((Fraction(v), k) for k, v in group.items()) for group in found.sums)
        lines.append(f"* Only together: {', '.join(f'`{text}`' for text in sums)}.")
    lines += [
        f"* Generic rank of d coefficients / d parameters, over the {appearing} that appear: "
        f"**{rank}** (modulo a prime at {found.points} random points, seed {found.seed}). So at "
        f"least {appearing - rank} of the {appearing} must be known to find the others.",
        "",
    ]
    return "\n".join(lines)


def _map(table: CoefficientTable) -> str:
    lines = ["## Map to the base parameters", ""]
    grouped = [relation_text(p) for p in table.base.parameters if p.terms[1:]]
    if grouped:
        lines += ["Grouped parameters:", "", "```text", *grouped, "```", ""]
    lines += ["```text", *forward_lines(table), "```", ""]
    determinant, size = determinant_text(table), len(table.map.rows)
    if determinant is None:
        why = (
            "not square" if size != len(table.map.columns) else "its determinant too long to print"
        )
        lines.append(f"This map is {size} x {len(table.map.columns)}, {why}.")
    else:
        lines.append(f"Determinant of this {size} x {size} map: **{determinant}**.")
        lines += ["", "Backwards:", "", "```text", *backward_lines(table), "```"]
    return "\n".join([*lines, ""])
