"""Every coefficient of every monomial: its name, what it is made of, how it depends on others."""

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.expression import Expression
from modeler.core.formula import DisplayedEquation, format_display
from modeler.derivation import (
    BaseParameters,
    LinearRelations,
    SymbolicModel,
    convert_to_fraction,
    evaluate_modulo,
    find_linear_relations,
)
from modeler.formulas import closed_form
from modeler.formulas.closed_form import ClosedForm, ConfigurationFunction, Exponents, Form
from modeler.formulas.function_sheet import FormulaForm, format_sheet
from modeler.formulas.physical import (
    Identifiability,
    PhysicalParameters,
    PrintedTerms,
    analyse_identifiability,
    derive_physical_parameters,
    draw_random_point,
    read_printed_terms,
)
from modeler.formulas.ring import (
    LATEX,
    TEXT,
    BaseMap,
    Poly,
    TextStyle,
    TrigRing,
    build_base_map,
    convert_to_polynomial,
    find_independent_modulo,
    format_combination,
    format_linear_form,
    format_monomial,
    format_physical,
    format_polynomial,
    format_signed_sum,
    invert_base_map,
)
from modeler.formulas.thresholds import THRESHOLDS

PREFIX = {"gravity": "PG", "inertia": "PJ", "christoffel": "PS"}


@dataclass(frozen=True)
class Coefficient:
    """Factor of one monomial of one function.

    Attributes:
        name: "PG1", "PJ7", "PS40"; another prefix for those that a paper lacks.
        function: "S213".
        exponents: of the motion generators.
        monomial: the same as text, "c3**2*s2".
        standard: {column of a standard parameter: factor}.
        base: {index of a base parameter: factor}.
        physical: polynomial of masses, mass centres, inertias, lengths.
    """

    name: str
    function: str
    exponents: Exponents
    monomial: str
    standard: Form
    base: Form
    physical: Poly


@dataclass(frozen=True)
class CoefficientTable:
    """The coefficients of a robot's closed form.

    Attributes:
        closed: the functions.
        physical: the physical parameters.
        base: base parameters.
        printed: what the robot file says of a paper.
        coefficients: in order of names; those that the paper lacks last.
        relations: over Q, all lengths unknown.
        known_geometry: names of coefficients that stay independent when the geometry is known,
            first come first kept; generic lengths.
        identifiability: of the physical parameters.
        map: from base parameters to `known_geometry`.
    """

    closed: ClosedForm
    physical: PhysicalParameters
    base: BaseParameters
    printed: PrintedTerms
    coefficients: tuple[Coefficient, ...]
    relations: LinearRelations
    known_geometry: tuple[str, ...]
    identifiability: Identifiability
    map: BaseMap

    @cached_property
    def by_name(self) -> Mapping[str, Coefficient]:
        """Returns coefficients by name."""
        return {coefficient.name: coefficient for coefficient in self.coefficients}

    @property
    def base_names(self) -> tuple[str, ...]:
        """Returns names of the base parameters."""
        return tuple(parameter.name for parameter in self.base.parameters)


def build_coefficient_table(model: SymbolicModel, base: BaseParameters) -> CoefficientTable:
    """Returns all coefficients of the closed form, named, defined and related.

    Raises:
        DerivationError: the robot has no closed form worth printing.
        RobotError: `[terms]` or `[physical]` of the robot file is wrong.
    """
    printed = read_printed_terms(model.robot)
    closed = closed_form.derive_closed_form(model)
    physical = derive_physical_parameters(model, closed.algebra)
    motion = closed.algebra.names[: closed.algebra.moving]
    numbered = [(k, parameter.column) for k, parameter in enumerate(base.parameters)]
    listed = []
    for name, (function, at) in _assign_names(closed, printed):
        form = closed.by_name[function].terms[at]
        grouped = {k: form[column] for k, column in numbered if column in form}
        text = format_monomial(at, motion)
        letters = physical.convert_form(form)
        listed.append(Coefficient(name, function, at, text, form, grouped, letters))
    coefficients = tuple(listed)
    relations = find_linear_relations({c.name: flatten_form(c.standard) for c in coefficients})
    by_name = {c.name: c for c in coefficients}
    known = _find_known_geometry(coefficients, closed.algebra)
    polys = [by_name[name].physical for name in relations.independent]
    seen = analyse_identifiability(physical, polys)
    names, ring = [parameter.name for parameter in base.parameters], closed.algebra.static_ring
    of_base = build_base_map(known, [by_name[name].base for name in known], names, ring)
    return CoefficientTable(
        closed, physical, base, printed, coefficients, relations, known, seen, of_base
    )


def select_independent_coefficients(table: CoefficientTable) -> CoefficientTable:
    """Returns the table with those coefficients only from which the others follow over Q."""
    names = set(table.relations.independent)
    return replace(table, coefficients=tuple(c for c in table.coefficients if c.name in names))


def flatten_form(form: Form) -> dict[Any, Any]:
    """Returns a linear form over Q: {(parameter, exponents of the geometry): rational number}."""
    return {(column, at): value for column, factor in form.items() for at, value in factor.items()}


def _assign_names(
    closed: ClosedForm, printed: PrintedTerms
) -> list[tuple[str, tuple[str, Exponents]]]:
    """Names in order of the functions; monomials that the paper lacks at the end."""
    monomials = printed.monomials.items()
    orders = {name: _read_monomials(closed, name, cells) for name, cells in monomials}
    counts = dict.fromkeys(PREFIX, 0)
    named, missing = [], []
    for function in closed.functions:
        order = orders.get(function.name, ()) if orders else tuple(function.terms)
        for at in order:
            counts[function.kind] += 1
            named.append((f"{PREFIX[function.kind]}{counts[function.kind]}", (function.name, at)))
        missing += [(function.name, at) for at in function.terms if at not in order]
    return named + [(f"{printed.missing}{i}", at) for i, at in enumerate(missing, start=1)]


def _read_monomials(
    closed: ClosedForm, name: str, cells: tuple[Expression, ...]
) -> tuple[Exponents, ...]:
    where = f"robot {closed.robot.name}, [terms], monomials, {name}"
    function = closed.by_name.get(name)
    if function is None:
        raise RobotError(
            f"{where}: no such function; the functions are {', '.join(closed.by_name)}"
        )
    algebra = closed.algebra
    motion = algebra.names[: algebra.moving]
    monomials: list[Exponents] = []
    for cell in cells:
        at = _read_exponents(cell, algebra)
        if at is None or at not in function.terms or at in monomials:
            have = ", ".join(format_monomial(t, motion) for t in function.terms)
            raise RobotError(f'{where}: got "{cell.text}"; expected each at most once: {have}')
        monomials.append(at)
    return tuple(monomials)


def _read_exponents(cell: Expression, algebra: TrigRing) -> Exponents | None:
    """Exponents of a monomial; None if it is none."""
    generators = dict(zip(algebra.names, algebra.ring.gens[: algebra.moving], strict=False))
    value = convert_to_polynomial(cell, generators, algebra.ring)
    if value is None or len(value) != 1 or value.LC != 1:
        return None
    return next(iter(value))[: algebra.moving]


def _find_known_geometry(
    coefficients: tuple[Coefficient, ...], algebra: TrigRing
) -> tuple[str, ...]:
    names = [str(symbol) for symbol in algebra.static_ring.symbols]
    prime, point = draw_random_point(names, random.Random(THRESHOLDS.seed))
    forms = [c.standard.items() for c in coefficients]
    vectors = [{k: evaluate_modulo(factor, point, prime) for k, factor in form} for form in forms]
    return tuple(coefficients[k].name for k in find_independent_modulo(vectors, prime))


def collect_by_function(
    table: CoefficientTable,
) -> Iterator[tuple[ConfigurationFunction, list[Coefficient]]]:
    """Returns functions with their coefficients, in order of names."""
    for function in table.closed.functions:
        yield function, [c for c in table.coefficients if c.function == function.name]


# A closed form and its coefficients as text, LaTeX and Markdown.


EQUATION = "tau_i = sum_j J_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k"


def format_closed_form(closed: ClosedForm, form: FormulaForm = "text") -> str:
    """Returns every function of a closed form, one monomial a line or a row."""
    style, parts = LATEX if form == "latex" else TEXT, list[str]()
    if form != "latex":
        title = f"# Closed form of {closed.robot.title}\n\n`{format_equation(closed)}`\n\n"
        text = f"{closed.robot.name}: {format_equation(closed)}\n"
        parts.append(title if form == "markdown" else text)
    for function in closed.functions:
        terms = _format_terms(closed, function, style)
        if form == "markdown":
            rows = "".join(f"| `{monomial}` | `{factor}` |\n" for factor, monomial in terms)
            parts.append(f"## {function.name}\n\n| monomial | coefficient |\n|---|---|\n{rows}\n")
            continue
        lines = [_format_signed_product(*term, style) for term in terms]
        if form == "text":
            parts.append("\n".join([f"\n{function.name} =", *(f"  {line}" for line in lines), ""]))
        else:
            equation = DisplayedEquation(format_latex_function(function.name), tuple(lines))
            parts.append(format_display([equation]) + "\n")
    effects = format_sheet(closed.effects, form)
    text = "".join(parts)
    return f"{text}\n{effects}".rstrip() + "\n" if form == "text" else text + effects


def _format_signed_product(factor: str, monomial: str, style: TextStyle) -> str:
    """The sign, then the product; sums stand in brackets behind a plus."""
    sign = "-" if factor.startswith("-") else "+"
    if " + " in factor or " - " in factor:
        sign, factor = "+", style.add_brackets(factor)
    else:
        factor = factor.lstrip("-")
    return f"{sign} {factor}" + ("" if monomial == "1" else f"{style.times}{monomial}")


def format_equation(closed: ClosedForm) -> str:
    """Returns what the functions mean: the equation of motion."""
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
            format_monomial(x, motion, style),
        )
        for x, form in function.terms.items()
    ]


def format_latex_function(name: str) -> str:
    """Returns `S1_12` as `S_{1,12}`."""
    return f"{name[0]}_{{{name[1:].strip('_').replace('_', ',')}}}"


def format_table_lines(table: CoefficientTable, style: TextStyle = TEXT) -> list[tuple[str, ...]]:
    """Returns (name, function, monomial, relation, base, physical) of every coefficient."""
    algebra, physical = table.closed.algebra, table.physical
    style = style.adjust_to_robot(table.closed.robot)
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


def format_coefficients(table: CoefficientTable, form: FormulaForm = "text") -> str:
    """Returns the coefficients in aligned columns, as a table or as equations."""
    rows = format_table_lines(table, LATEX if form == "latex" else TEXT)
    heads = ["relation", "base parameters", "physical parameters"]
    if form == "text":
        rows = [("name", "in", "monomial", *heads), *rows]
        widths = [max(len(row[i]) for row in rows) for i in range(5)]
        cells = ([c.ljust(w) for c, w in zip(row, [*widths, 0], strict=True)] for row in rows)
        return "\n".join("  ".join(line).rstrip() for line in cells) + "\n"
    if form == "markdown":
        lines = [f"| name | function | monomial | {' | '.join(heads)} |", "|---" * 6 + "|"]
        for name, function, monomial, relation, base, physical in rows:
            cell = "independent" if relation == name else f"`{relation}`"
            lines.append(
                f"| {name} | {function} | `{monomial}` | {cell} | `{base}` | `{physical}` |"
            )
        return "\n".join(lines) + "\n"
    equations = []
    for name, function, monomial, relation, _, physical in rows:
        where = rf"\text{{of }} {monomial} \text{{ in }} {format_latex_function(function)}"
        right = relation if relation != name else physical
        equations.append(DisplayedEquation(name, (rf"{right} \quad {where}",)))
    return format_display(equations) + "\n" if equations else ""


# The map between independent coefficients and base parameters, as lines of text.


def _get_static_names(table: CoefficientTable) -> tuple[str, ...]:
    return tuple(table.closed.algebra.names[table.closed.algebra.moving :])


def format_forward_map(table: CoefficientTable) -> list[str]:
    """Returns `PJ3 = XX2R + XX3R - ZZ3`, one line per coefficient that is independent."""
    names, style = table.base_names, TEXT.adjust_to_robot(table.closed.robot)
    static, forms = _get_static_names(table), {x: table.by_name[x].base for x in table.map.rows}
    return [f"{x} = {format_linear_form(form, names, static, style)}" for x, form in forms.items()]


def format_determinant(table: CoefficientTable) -> str | None:
    """Returns determinant of the map; None if it is not square."""
    if table.map.determinant is None:
        return None
    return format_polynomial(
        table.map.determinant, _get_static_names(table), TEXT.adjust_to_robot(table.closed.robot)
    )


def format_backward_map(table: CoefficientTable) -> list[str]:
    """Returns `ZZ1R = PJ7 - PJ16`, one line per base parameter; none if the map has no inverse."""
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
