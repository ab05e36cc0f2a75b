"""Every coefficient of every monomial: its name, what it is made of, how it depends on others."""

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.expression import Expression
from modeler.derivation import (
    BaseParameters,
    LinearRelations,
    SymbolicModel,
    evaluate_modulo,
    find_linear_relations,
)
from modeler.formulas.closed_form import (
    ClosedForm,
    ConfigurationFunction,
    Exponents,
    Form,
    derive_closed_form,
)
from modeler.formulas.physical import (
    Identifiability,
    PhysicalParameters,
    analyse_identifiability,
    derive_physical_parameters,
    draw_random_point,
)
from modeler.formulas.printed import PrintedTerms, read_printed_terms
from modeler.formulas.ring import (
    BaseMap,
    Poly,
    TrigRing,
    build_base_map,
    convert_to_polynomial,
    find_independent_modulo,
)
from modeler.formulas.text import format_monomial
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
    closed = derive_closed_form(model)
    physical = derive_physical_parameters(model, closed.algebra)
    motion = closed.algebra.names[: closed.algebra.moving]
    numbered = [(k, parameter.column) for k, parameter in enumerate(base.parameters)]
    listed = []
    for name, (function, at) in _assign_names(closed, printed):
        form = closed.by_name[function].terms[at]
        grouped = {k: form[column] for k, column in numbered if column in form}
        text = format_monomial(at, motion)
        listed.append(
            Coefficient(name, function, at, text, form, grouped, physical.convert_form(form))
        )
    coefficients = tuple(listed)
    relations = find_linear_relations({c.name: flatten_form(c.standard) for c in coefficients})
    by_name = {c.name: c for c in coefficients}
    known = _find_known_geometry(coefficients, closed.algebra)
    seen = analyse_identifiability(
        physical, [by_name[name].physical for name in relations.independent]
    )
    names, ring = [parameter.name for parameter in base.parameters], closed.algebra.static_ring
    of_base = build_base_map(known, [by_name[name].base for name in known], names, ring)
    return CoefficientTable(
        closed, physical, base, printed, coefficients, relations, known, seen, of_base
    )


def select_independent_coefficients(table: CoefficientTable) -> CoefficientTable:
    """Returns the table with those coefficients only from which the others follow over Q."""
    independent_names = set(table.relations.independent)
    return replace(
        table, coefficients=tuple(c for c in table.coefficients if c.name in independent_names)
    )


def flatten_form(form: Form) -> dict[Any, Any]:
    """Returns a linear form over Q: {(parameter, exponents of the geometry): rational number}."""
    return {(column, at): value for column, factor in form.items() for at, value in factor.items()}


def _assign_names(
    closed: ClosedForm, printed: PrintedTerms
) -> list[tuple[str, tuple[str, Exponents]]]:
    """Names in order of the functions; monomials that the paper lacks at the end."""
    orders = {
        name: _read_monomials(closed, name, cells) for name, cells in printed.monomials.items()
    }
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
    vectors = [
        {column: evaluate_modulo(factor, point, prime) for column, factor in c.standard.items()}
        for c in coefficients
    ]
    return tuple(coefficients[k].name for k in find_independent_modulo(vectors, prime))


def collect_by_function(
    table: CoefficientTable,
) -> Iterator[tuple[ConfigurationFunction, list[Coefficient]]]:
    """Returns functions with their coefficients, in order of names."""
    for function in table.closed.functions:
        yield function, [c for c in table.coefficients if c.function == function.name]
