"""Every coefficient of every monomial: its name, what it is made of, how it depends on others."""

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import comb
from typing import Any

import numpy as np
from sympy.polys.polyerrors import ExactQuotientFailed

from modeler.core.errors import RobotError
from modeler.core.expression import Expression
from modeler.derivation.model import SymbolicModel
from modeler.derivation.result import BaseParameters
from modeler.formulas.closed_form import ClosedForm, Exponents, Form, Function, closed_form
from modeler.formulas.identifiability import (
    SEED,
    Identifiability,
    identifiability,
    random_point,
    value_modulo,
)
from modeler.formulas.physical import PhysicalParameters, physical_parameters
from modeler.formulas.printed import Print, read_print
from modeler.formulas.relations import BaseMap, Relations, base_map, independent_modulo, relations
from modeler.formulas.ring import Poly, TrigRing
from modeler.formulas.text import monomial_text

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
    printed: Print
    coefficients: tuple[Coefficient, ...]
    relations: Relations
    known_geometry: tuple[str, ...]
    identifiability: Identifiability
    map: BaseMap

    @cached_property
    def by_name(self) -> Mapping[str, Coefficient]:
        """Coefficients by name."""
        return {coefficient.name: coefficient for coefficient in self.coefficients}

    @cached_property
    def name_at(self) -> Mapping[tuple[str, Exponents], str]:
        """Name of the coefficient of a monomial of a function."""
        return {(c.function, c.exponents): c.name for c in self.coefficients}

    @property
    def base_names(self) -> tuple[str, ...]:
        """Names of the base parameters."""
        return tuple(parameter.name for parameter in self.base.parameters)


def coefficient_table(model: SymbolicModel, base: BaseParameters) -> CoefficientTable:
    """All coefficients of the closed form, named, defined and related.

    Raises:
        DerivationError: the robot has no closed form worth printing.
        RobotError: `[terms]` or `[physical]` of the robot file is wrong.
    """
    printed = read_print(model.robot)
    closed = closed_form(model)
    physical = physical_parameters(model, closed.algebra)
    names = _names(closed, printed)
    motion = closed.algebra.names[: closed.algebra.moving]
    coefficients = tuple(
        _coefficient(name, at, closed.by_name[function], physical, base, motion)
        for name, (function, at) in names
    )
    found = relations({c.name: vector_of(c.standard) for c in coefficients})
    by_name = {c.name: c for c in coefficients}
    known = _known_geometry(coefficients, closed.algebra)
    return CoefficientTable(
        closed,
        physical,
        base,
        printed,
        coefficients,
        found,
        known,
        identifiability(physical, [by_name[name].physical for name in found.independent]),
        base_map(
            known,
            [by_name[name].base for name in known],
            [parameter.name for parameter in base.parameters],
            closed.algebra.static_ring,
        ),
    )


def independent_coefficients(table: CoefficientTable) -> CoefficientTable:
    """The table with those coefficients only from which the others follow over Q."""
    kept = set(table.relations.independent)
    return replace(table, coefficients=tuple(c for c in table.coefficients if c.name in kept))


def vector_of(form: Form) -> dict[Any, Any]:
    """A linear form over Q: {(parameter, exponents of the geometry): rational number}."""
    return {(column, at): value for column, factor in form.items() for at, value in factor.items()}


def _coefficient(
    name: str,
    at: Exponents,
    function: Function,
    physical: PhysicalParameters,
    base: BaseParameters,
    motion: tuple[str, ...],
) -> Coefficient:
    form = function.terms[at]
    # phi chi = phi_b beta, where the columns phi_b are columns of phi: the factor of a base
    # parameter is that of the standard parameter whose column it has.
    grouped = {
        k: form[parameter.column]
        for k, parameter in enumerate(base.parameters)
        if parameter.column in form
    }
    return Coefficient(
        name, function.name, at, monomial_text(at, motion), form, grouped, physical.of(form)
    )


def _names(closed: ClosedForm, printed: Print) -> list[tuple[str, tuple[str, Exponents]]]:
    """Names in order of the functions; monomials that the paper lacks at the end."""
    orders = {name: _monomials(closed, name, cells) for name, cells in printed.monomials.items()}
    counts = dict.fromkeys(PREFIX, 0)
    named, missing = [], []
    for function in closed.functions:
        order = orders.get(function.name, ()) if orders else tuple(function.terms)
        for at in order:
            counts[function.kind] += 1
            named.append((f"{PREFIX[function.kind]}{counts[function.kind]}", (function.name, at)))
        missing += [(function.name, at) for at in function.terms if at not in order]
    return named + [(f"{printed.missing}{i}", at) for i, at in enumerate(missing, start=1)]


def _monomials(
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
    found: list[Exponents] = []
    for cell in cells:
        at = _exponents(cell, algebra)
        if at is None or at not in function.terms or at in found:
            have = ", ".join(monomial_text(t, motion) for t in function.terms)
            raise RobotError(f'{where}: got "{cell.text}"; expected each at most once: {have}')
        found.append(at)
    return tuple(found)


def _exponents(cell: Expression, algebra: TrigRing) -> Exponents | None:
    """Exponents of a monomial; None if it is none."""
    generators = dict(zip(algebra.names, algebra.ring.gens[: algebra.moving], strict=False))
    try:
        value = algebra.ring(cell.fold(generators, {}, None, _integer))
    except (KeyError, ValueError, TypeError, ZeroDivisionError, ExactQuotientFailed):
        return None
    if len(value) != 1 or value.LC != 1:
        return None
    return next(iter(value))[: algebra.moving]


def _integer(value: Fraction) -> int:
    if value.denominator != 1:
        raise ValueError
    return value.numerator


def _known_geometry(coefficients: tuple[Coefficient, ...], algebra: TrigRing) -> tuple[str, ...]:
    names = [str(symbol) for symbol in algebra.static_ring.symbols]
    prime, point = random_point(names, random.Random(SEED))
    vectors = [
        {column: value_modulo(factor, point, prime) for column, factor in c.standard.items()}
        for c in coefficients
    ]
    return tuple(coefficients[k].name for k in independent_modulo(vectors, prime))


def by_function(table: CoefficientTable) -> Iterator[tuple[Function, list[Coefficient]]]:
    """Functions with their coefficients, in order of names."""
    for function in table.closed.functions:
        yield function, [c for c in table.coefficients if c.function == function.name]


# Sets of columns of a matrix over a prime field that span its rows, many at once.


BLOCK = 4000  # sets reduced together


def components(kernel: np.ndarray) -> list[tuple[list[int], list[int]]]:
    """(rows, columns) of the parts that share no entry; a column of zeros is its own part."""
    label = list(range(len(kernel)))
    for k in range(kernel.shape[1]):
        merged = {label[r] for r in np.flatnonzero(kernel[:, k])}
        label = [min(merged) if x in merged else x for x in label]
    parts: list[tuple[list[int], list[int]]] = []
    for x in sorted(set(label)):
        rows = [r for r, y in enumerate(label) if y == x]
        parts.append((rows, [int(k) for k in np.flatnonzero(kernel[rows].any(axis=0))]))
    for k in np.flatnonzero(~kernel.any(axis=0)).tolist():
        parts.append(([], [k]))
    return parts


def spanning_sets(matrix: np.ndarray, size: int, prime: int) -> Iterator[tuple[float, np.ndarray]]:
    """(share done, sets of `size` columns that span the rows), in blocks.

    Elimination grows with the set: a column joins a set that comes before it, and the rest of the
    matrix is reduced by it; all sets of a block at once.
    """
    rows, n = matrix.shape
    start = (matrix[None], np.zeros((1, 0), dtype=np.int64), np.zeros(1, dtype=np.int64))
    stack = [start]
    done = 0.0
    total = float(comb(n, size))
    while stack:
        work, sets, rank = stack.pop()
        k = sets.shape[1]
        if k == size:
            done += len(sets)
            yield done / total, sets
            continue
        if k == size - 1 and rows:
            sets = _last(work, sets, rank, rows)
            done += len(sets)
            yield min(1.0, done / total), sets
            continue
        grown = _grown(work, sets, rank, size, prime)
        for at in range(0, len(grown[0]), BLOCK):
            part = slice(at, at + BLOCK)
            stack.append((grown[0][part], grown[1][part], grown[2][part]))


def _last(work: np.ndarray, sets: np.ndarray, rank: np.ndarray, rows: int) -> np.ndarray:
    """Sets made full by one column more, those that span."""
    n = work.shape[2]
    after = np.arange(n)[None] > (sets[:, -1:] if sets.shape[1] else -1)
    joins: np.ndarray = np.any(work, axis=1)
    fits = after & np.where((rank == rows)[:, None], True, joins & (rank == rows - 1)[:, None])
    which, column = np.nonzero(fits)
    return np.concatenate([sets[which], column[:, None]], axis=1)


def _grown(
    work: np.ndarray, sets: np.ndarray, rank: np.ndarray, size: int, prime: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Every set with every later column, if it can still span in the end."""
    rows, n = work.shape[1:]
    k = sets.shape[1]
    columns = np.arange(n)[None]
    after = (columns > (sets[:, -1:] if k else -1)) & (columns <= n - size + k)
    joins: np.ndarray = np.any(work, axis=1)
    reach = rank[:, None] + joins + (size - k - 1) >= rows
    which, column = np.nonzero(after & reach)
    joined = joins[which, column]
    grown = work[which]
    grown[joined] = reduced_by(grown[joined], column[joined], prime)
    return grown, np.concatenate([sets[which], column[:, None]], axis=1), rank[which] + joined


def reduced_by(work: np.ndarray, column: np.ndarray, prime: int) -> np.ndarray:
    """Matrices reduced by one of their columns, its pivot row set to zero."""
    if not len(work):
        return work
    at = np.arange(len(work))
    entries = work[at, :, column]
    pivot = (entries != 0).argmax(axis=1)
    row = work[at, pivot]
    # No inverse is needed: rows times the pivot have the same zeros.
    scale = entries[at, pivot]
    reduced = work * scale[:, None, None] % prime - entries[:, :, None] * row[:, None, :] % prime
    reduced %= prime
    reduced[at, pivot] = 0
    return reduced


def span(kernel: np.ndarray, sets: np.ndarray, prime: int) -> np.ndarray:
    """Which sets of columns have the rank of the matrix."""
    work = np.broadcast_to(kernel, (len(sets), *kernel.shape)).copy()
    rank = np.zeros(len(sets), dtype=np.int64)
    at = np.arange(len(sets))
    for k in range(sets.shape[1]):
        joins: np.ndarray = np.any(work[at, :, sets[:, k]], axis=1)
        work[joins] = reduced_by(work[joins], sets[joins, k], prime)
        rank += joins
    return np.asarray(rank == len(kernel))
