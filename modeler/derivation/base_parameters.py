"""All relations among the columns, and from them the base parameters."""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property, partial
from typing import Any

import numpy as np
import sympy

from modeler.derivation import link_relations, modular, numeric_rank
from modeler.derivation.field import (
    CoefficientTooLarge,
    Element,
    ExactField,
    build_geometry_field,
    find_linear_relations,
    reduce_sparse_rows,
)
from modeler.derivation.geometry import Geometry, build_exact_geometry
from modeler.derivation.link_relations import INERTIA, OFFSET
from modeler.derivation.model import (
    LinkColumn,
    StandardColumn,
    SymbolicModel,
    build_link_column,
    is_in_block,
)
from modeler.derivation.modular import PRIME, ModularState
from modeler.derivation.numeric_rank import NumericRank, Sample, prove_rank
from modeler.derivation.relations import (
    BallRank,
    BaseParameter,
    BaseParameters,
    Certificate,
    ModularRank,
    Proof,
    SampledRank,
    Sampling,
    Term,
    build_named_parameters,
    sort_by_priority,
)
from modeler.derivation.thresholds import THRESHOLDS
from modeler.effects import EnergyBlock
from modeler.robot import INERTIAL

# The units of grouping: every inertial parameter of every link, whether the robot has it or not.
#
# Relations pass through links that the robot states as massless, and hold for each link of similar
# legs on its own. So they are found among units, one per row and parameter, and then restricted to
# the robot's columns: what it does not have is eliminated, and what legs share must occur alike.


_OWN = {"rotor_inertia": INERTIA, "offset": OFFSET}


@dataclass(frozen=True)
class GroupingUnits:
    """All units of a robot that are grouped to base parameters: one single-row column each.

    Attributes:
        columns: one single-row column per unit.
        owner: by unit, the robot's column that it is a part of; None if the robot has none.
        places: unit of (row, place among the ten, rotor inertia, offset).
        standard: number of the robot's columns.
    """

    columns: tuple[StandardColumn, ...]
    owner: tuple[int | None, ...]
    places: Mapping[tuple[int, int], int]
    standard: int

    def merge_rows(
        self, rows: Sequence[Mapping[int, Element]]
    ) -> tuple[list[dict[int, Element]], list[int]]:
        """Returns rows over units as rows over columns, with auxiliary ones that have to vanish.

        Returns:
            Rows over the robot's columns and auxiliary columns; the numbers of these, all above
            the robot's: coefficients of absent units, and differences within shared parameters.
        """
        merged_rows = []
        for row in rows:
            new: dict[int, Element] = {}
            for unit, value in row.items():
                column = self.owner[unit]
                if column is not None and self._column_units[column][0] == unit:
                    new[column] = value
                    for other in (u for u in self._column_units[column] if u != unit):
                        _add_entry(new, self.standard + other, -value)
                else:
                    _add_entry(new, self.standard + unit, value)
            merged_rows.append({place: value for place, value in new.items() if value})
        used = sorted({place for row in merged_rows for place in row if place >= self.standard})
        return merged_rows, used

    def sort_units(self, columns: Sequence[int]) -> list[int]:
        """Returns units in the order of the columns that own them, those without owner last."""
        places = {column: i for i, column in enumerate(columns)}
        last = len(places)
        ranks = [last if owner is None else places[owner] for owner in self.owner]
        return sorted(range(len(ranks)), key=ranks.__getitem__)

    @cached_property
    def _column_units(self) -> dict[int, list[int]]:
        """The units of each column."""
        column_units: dict[int, list[int]] = {}
        for unit, column in enumerate(self.owner):
            if column is not None:
                column_units.setdefault(column, []).append(unit)
        return column_units


def _add_entry(row: dict[int, Element], place: int, value: Element) -> None:
    row[place] = row[place] + value if place in row else value


def build_grouping_units(geometry: Geometry, columns: Sequence[StandardColumn]) -> GroupingUnits:
    """Returns the units of a robot with these columns."""
    unit_columns: list[StandardColumn] = []
    owner: list[int | None] = []
    places: dict[tuple[int, int], int] = {}
    for column, standard in enumerate(columns):
        for part in standard.parts:
            if isinstance(part, LinkColumn):
                places[part.row, INERTIAL.index(part.prefix)] = len(unit_columns)
            elif part.effect in _OWN and part.block is not EnergyBlock.OWN:
                places[part.row, _OWN[part.effect]] = len(unit_columns)
            unit_columns.append(part)
            owner.append(column)
    for k, row in enumerate(geometry.rows):
        if row.index is not None:
            for i, prefix in enumerate(INERTIAL):
                if (k, i) not in places:
                    places[k, i] = len(unit_columns)
                    unit_columns.append(build_link_column(prefix, k, row.joint))
                    owner.append(None)
    return GroupingUnits(tuple(unit_columns), tuple(owner), places, len(columns))


# Grouping of friction columns: exact, from the speeds of their shafts alone.
#
# Viscous columns are dependent iff their Rayleigh functions, sums of v**2, are, which is linear
# algebra on the products of independent speeds. Coulomb columns are sums of weight * |direction|,
# where a direction is a speed up to a factor; the functions |v| of different directions are
# independent, since each has its kink where the others have none. So they are dependent iff their
# weights are; no sampling of sign() is needed.


Relation = dict[int, Fraction]
"""sum of coefficient * column = 0, by column."""

Shaft = Mapping[int, Fraction]
"""Speed of a shaft: sum of coefficient * speed of a free variable."""


def find_friction_relations(columns: Sequence[StandardColumn]) -> list[Relation]:
    """Returns all relations among the viscous and among the Coulomb columns."""
    return _find_block_relations(
        columns, EnergyBlock.RAYLEIGH, expand_square
    ) + _find_block_relations(columns, EnergyBlock.COULOMB, _normalise_direction)


def expand_square(shaft: Shaft) -> dict[Hashable, Fraction]:
    """Returns v**2 as a polynomial in the speeds: {(i, j): coefficient}, i <= j."""
    products: dict[Hashable, Fraction] = {}
    for i, ci in shaft.items():
        for j, cj in shaft.items():
            key = (min(i, j), max(i, j))
            products[key] = products.get(key, Fraction(0)) + ci * cj
    return products


def _normalise_direction(shaft: Shaft) -> dict[Hashable, Fraction]:
    """|v| as {direction: weight}; the direction has the coefficient 1 at its first speed."""
    first = shaft[min(shaft)]
    direction = tuple(sorted((k, c / first) for k, c in shaft.items()))
    return {direction: abs(first)}


def _find_block_relations(
    columns: Sequence[StandardColumn],
    block: EnergyBlock,
    function: Callable[[Shaft], dict[Hashable, Fraction]],
) -> list[Relation]:
    vectors: dict[int, dict[Hashable, Any]] = {}
    for place, column in enumerate(columns):
        if is_in_block(column, block):
            total = vectors.setdefault(place, {})
            for part in column.parts:
                for key, c in function(part.shaft).items() if part.shaft else ():
                    total[key] = total.get(key, 0) + sympy.QQ(c.numerator, c.denominator)
    relations = find_linear_relations(vectors)
    rows = ((k, c) for k, c in relations.combinations.items() if k not in relations.independent)
    return [{k: Fraction(1), **{place: -x for place, x in c.items()}} for k, c in rows]


# Which parameters are kept first when they group: the user's order, else the table's.


@dataclass(frozen=True)
class GroupingRelations:
    """Every linear relation among the columns, reduced: one row for each column that is not kept.

    Attributes:
        rows: sum of coefficient * column = 0; the coefficient of the dropped column is 1.
        dropped: that column of each row.
        kept: the others, in column order.
    """

    rows: tuple[dict[int, Element], ...]
    dropped_columns: tuple[int, ...]
    kept_columns: tuple[int, ...]


def derive_column_relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField, seed: int
) -> GroupingRelations:
    """Returns the reduced relations of a robot, first-come by the priority order."""
    units = build_grouping_units(geometry, model.columns)
    order = sort_by_priority(model.names, model.robot.priority_parameters)
    if geometry.has_relations:
        rows = modular.derive_tied_relations(
            geometry, units.columns, K, units.sort_units(order), seed
        )
    else:
        rows = _derive_link_relations(geometry, K, units)
    rows += link_relations.derive_loop_relations(geometry, K, units.places)
    rows, auxiliary = units.merge_rows(rows)
    for relation in find_friction_relations(model.columns):
        rows.append({k: K.one * sympy.QQ(c.numerator, c.denominator) for k, c in relation.items()})
    effective_columns = {place for _, place in model.regressor}
    own = (k for k, column in enumerate(model.columns) if is_in_block(column, EnergyBlock.OWN))
    rows += [{place: K.one} for place in own if place not in effective_columns]
    reduced, pivots = reduce_sparse_rows(rows, [*auxiliary, *order[::-1]])
    first = sum(pivot >= len(model.columns) for pivot in pivots)
    reduced, dropped = reduced[first:], pivots[first:]
    dropped_set = set(dropped)
    kept_columns = [place for place in range(len(model.columns)) if place not in dropped_set]
    return GroupingRelations(tuple(reduced), tuple(dropped), tuple(kept_columns))


def add_closure_relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField, relations: GroupingRelations, seed: int
) -> GroupingRelations:
    """Adds the relations among the kept columns that go around whole loops."""
    order = sort_by_priority(model.names, model.robot.priority_parameters)
    independent = {i for i in relations.kept_columns if modular.has_energy(model.columns[i])}
    kept_columns = [i for i in order if i in independent]
    more = link_relations.derive_closure_relations(geometry, model.columns, K, kept_columns, seed)
    reduced, dropped = reduce_sparse_rows([*relations.rows, *more], order[::-1])
    left = [i for i in range(len(model.columns)) if i not in set(dropped)]
    return GroupingRelations(tuple(reduced), tuple(dropped), tuple(left))


def _derive_link_relations(
    geometry: Geometry, K: ExactField, units: GroupingUnits
) -> list[dict[int, Element]]:
    """Relations of a tree whose rows all move freely."""
    relations = []
    places = units.places
    for k, grouping in enumerate(link_relations.group_tree(geometry, K, places.keys())):
        if geometry.rows[k].index is None:
            continue
        for hidden, moved in zip(grouping.hidden, grouping.moved, strict=True):
            relation = {places[k, i]: x for i, x in enumerate(hidden) if x}
            parent, moved = link_relations.move_to_link(geometry, K, geometry.rows[k].parent, moved)
            if parent is not None:
                for i, x in enumerate(moved):
                    if x:
                        relation[places[parent, i]] = -x
            relations.append(relation)
    return relations


def build_base_parameters(
    columns: Sequence[StandardColumn], relations: GroupingRelations, K: ExactField, halves: bool
) -> tuple[tuple[BaseParameter, ...], tuple[str, ...]]:
    """Returns base parameters with their terms, and the parameters without effect.

    A relation col_d + sum r_b col_b = 0 gives beta_b = chi_b - r_b chi_d.
    """
    one = sympy.Integer(1)
    terms: dict[int, list[Term]] = {b: [Term(one, columns[b].name)] for b in relations.kept_columns}
    unidentifiable = []
    for place, row in sorted(zip(relations.dropped_columns, relations.rows, strict=True)):
        if len(row) == 1:
            unidentifiable.append(columns[place].name)
        for b, coefficient in row.items():
            value = K.expression(-coefficient)
            if b != place and value:  # 0 where roots of numbers, letters in K, cancel
                terms[b].append(Term(value, columns[place].name))
    return build_named_parameters(columns, terms, halves), tuple(unidentifiable)


# From the symbolic model to the base parameters and their proof.


_EXACT = (
    "Relations: energy rows (kinetic energy, power of gravity), link by link over the exact field; "
    "they are checked modulo a prime at random states and geometry. Independence: the energy rows "
    "of the base columns have full rank modulo the prime, which is a lower bound of the true rank."
)
_TIED = (
    "Relations: energy rows (kinetic energy, power of gravity) of the tied joints modulo "
    "2**127 - 1; coefficients interpolated as functions of the lengths and angles and checked at "
    "fresh ones; then checked again modulo another prime at random states and geometry. "
    "Independence: the energy rows of the base columns have full rank modulo that prime, which is "
    "a lower bound of the true rank."
)
_LOOPS = (
    "Relations: those of the opened tree ({tree}), for every joint that closes a loop those of the "
    "bodies that move alike with both its sides, and around loops those whose energies are "
    "multiples of the closure equations; all exact in the symbols."
)
_IN_BALLS = (
    " Independence: at {where}, a minor of the torques of the base columns is not 0, for all "
    "numbers that rounding leaves possible (ball arithmetic)."
)
_WHERE = {
    True: "closed postures, proven to exist next to those of the walk (Krawczyk)",
    False: "states of few digits",
}
_SAMPLED = (
    " Independence is not proven: {why}. At random states the torques of the base columns have "
    "full rank; the last singular value kept is {margin:.0e} times the rounding, and a "
    "perturbation must be as large as a singular value to lower a rank (Weyl)."
)
_OPEN = {
    False: "link by link over the exact field",
    True: "interpolated modulo 2**127 - 1 and checked at fresh lengths and angles",
}
_AT_NOMINAL = (
    " This rank belongs to the lengths and angles as given: {why}; so they stand as numbers."
)
_UNPROVEN = " Joints that seemed to follow others, but not provably, are solved for: {joints}."
_NUMERIC = (
    "No exact proof: {why}. Rank and coefficients come from the torques at random states in "
    "floating point; every relation holds there to {bound:.1e} of its column."
)


def derive_base_parameters(
    model: SymbolicModel, seed: int = THRESHOLDS.proof_seed
) -> BaseParameters:
    """Returns base parameters of a serial or tree robot, with their relations and proof.

    The relations are exact in the symbols of the robot file. Where the given values make more
    parameters group than general ones would, the relations are exact in those values; where
    the exact answer cannot be had or does not stand the checks, they are numbers, and the proof
    says so.

    Raises:
        DerivationError: a priority pattern matches nothing.
    """
    if model.windups:
        model = replace(model, columns=tuple(map(partial(_separate_motor, model), model.columns)))
    samples = max(60, 3 * len(model.columns) // max(1, len(model.robot.coordinates)))
    sample = numeric_rank.draw_sample(model, samples, seed)
    attempt = _Attempt(
        model, sample, numeric_rank.compute_numeric_rank(sample, range(len(model.columns))), seed
    )
    try:
        if model.special:  # loops that close at the given values only
            joints = f"joint{'s' if len(model.special) > 1 else ''} {', '.join(model.special)}"
            raise ProofError(f"the loops tie {joints} to others at the given values only")
        return attempt.derive_exact(model.geometry, "")
    except (ProofError, CoefficientTooLarge) as error:
        why = str(error)
    try:
        nominal = build_exact_geometry(model.robot, at_nominal=True)
        return attempt.derive_exact(nominal, _AT_NOMINAL.format(why=why))
    except (ProofError, CoefficientTooLarge) as error:
        if str(error) != why:
            why += f"; with these, {error}" if model.special else f"; in numbers, {error}"
        return attempt.derive_numeric(why)


def _separate_motor(model: SymbolicModel, column: StandardColumn) -> StandardColumn:
    """The column as one that never groups, if it is of a motor behind which an elastic joint is.

    Such a motor moves by itself, whatever its link does.
    """
    rows = {signal.row for signals in model.windups.values() for signal in signals}
    if isinstance(column, LinkColumn) or column.row not in rows:
        return column
    return replace(column, block=EnergyBlock.OWN)


@dataclass(frozen=True)
class _Attempt:
    """A model with its sampled regressor, whose rank any relations must have."""

    model: SymbolicModel
    sample: Sample
    numeric: NumericRank
    seed: int

    def derive_exact(self, geometry: Geometry, statement: str) -> BaseParameters:
        """Raises ProofError or CoefficientTooLarge unless everything agrees."""
        model, K = self.model, build_geometry_field(geometry)
        relations = self._derive_relations(geometry, K)
        independence: Certificate
        if model.closure is not None:
            independence = prove_rank(model, relations.kept_columns, self.sample, self.seed)
        else:
            independence = certify_relations(geometry, model.columns, K, relations, self.seed)
        halves = model.robot.has_binary_fractions
        grouping = build_base_parameters(model.columns, relations, K, halves)
        kind = "exact at the given values" if statement else "exact"
        if isinstance(independence, SampledRank):
            kind = f"relations {kind}, rank sampled"
        tied = model.geometry.has_relations
        argument = _TIED if tied else _EXACT
        if model.closure is not None:
            argument = _LOOPS.format(tree=_OPEN[tied])
        statement = argument + self._describe_independence(independence) + statement
        base = self._attach_proof(*grouping, kind, statement, independence)
        if base.proof.agreement > THRESHOLDS.max_torque_difference:
            raise ProofError(f"base and standard torque differ by {base.proof.agreement:.1e}")
        return base

    def _derive_relations(self, geometry: Geometry, K: ExactField) -> GroupingRelations:
        """All relations; raises ProofError where they are not as many as the torques say."""
        relations = derive_column_relations(self.model, geometry, K, self.seed)
        rank, sampled_rank = len(relations.kept_columns), self.numeric.rank
        if self.model.closure is not None and rank > sampled_rank:
            relations = add_closure_relations(self.model, geometry, K, relations, self.seed)
            rank = len(relations.kept_columns)
        if rank != sampled_rank:
            raise ProofError(
                f"the symbols give rank {rank}, the torques at the given values {sampled_rank}"
            )
        return relations

    def derive_numeric(self, why: str) -> BaseParameters:
        """Derives the base parameters in floating point, for the reason `why`."""
        exact = partial(numeric_rank.enclose_factors, self.model, self.sample, self.seed)
        parameters, unidentifiable, bound = numeric_rank.derive_numeric_grouping(
            self.model, self.sample, self.numeric, exact
        )
        columns = [p.column for p in parameters]
        independence = prove_rank(self.model, columns, self.sample, self.seed)
        statement = _NUMERIC.format(why=why, bound=bound)
        statement += self._describe_independence(independence)
        return self._attach_proof(parameters, unidentifiable, "numeric", statement, independence)

    def _describe_independence(self, independence: Certificate) -> str:
        """The argument of the independence, where relations and independence have two."""
        if isinstance(independence, BallRank):
            return _IN_BALLS.format(where=_WHERE[self.model.closure is not None])
        if isinstance(independence, SampledRank):
            margin = self.numeric.gap[0] / max(self.numeric.gap[1], float(np.finfo(float).eps))
            return _SAMPLED.format(why=independence.why, margin=margin)
        return ""

    def _attach_proof(
        self,
        parameters: tuple[BaseParameter, ...],
        unidentifiable: tuple[str, ...],
        kind: str,
        statement: str,
        independence: Certificate,
    ) -> BaseParameters:
        """The base parameters and those without effect, with their proof."""
        model, numeric, walk, sampling = self.model, self.numeric, self.sample.walk, None
        if model.unproven:
            statement += _UNPROVEN.format(joints=", ".join(model.unproven))
        if walk is not None:
            assert model.closure is not None
            moved = walk.postures[:, list(model.closure.actuated)]
            ends = zip(model.robot.coordinates, moved.min(axis=0), moved.max(axis=0), strict=True)
            ranges = {joint.name: (float(low), float(high)) for joint, low, high in ends}
            sampling = Sampling(len(walk.postures), ranges, walk.distance)
        agreement = numeric_rank.compare_torques(model, parameters, self.seed)
        rank = (numeric.rank, numeric.gap, numeric.tolerance, numeric.scale)
        proof = Proof(kind, statement, independence, self.seed, *rank, agreement, sampling)
        return BaseParameters(model.columns, parameters, unidentifiable, proof)


# The proof of a grouping modulo a prime.


class ProofError(Exception):
    """The certificate contradicts the relations; says how."""


def certify_relations(
    geometry: Geometry,
    columns: tuple[StandardColumn, ...],
    K: ExactField,
    relations: GroupingRelations,
    seed: int,
) -> ModularRank:
    """Proves that the relations hold and that the kept columns are independent.

    Raises:
        ProofError: a relation does not hold, or the kept columns are dependent.
    """
    # Without gravity only the kinetic row of each point counts.
    kept_columns = list(relations.kept_columns)
    points = len(kept_columns) + 8
    for check in range(THRESHOLDS.proof_checks):
        try:
            state = ModularState(geometry, K, points, seed + check)
            energy = state.compute_energy_rows(columns)
            rayleigh = state.compute_rayleigh_rows(columns)
            _check_relations(columns, K, relations, np.vstack([energy, rayleigh]), state.residues)
        except ValueError as error:  # a constant whose denominator is a multiple of the prime
            raise ProofError(f"a constant has no value modulo {PRIME} ({error})") from None
    left = [columns[i] for i in kept_columns]
    coulomb = [column for column in left if is_in_block(column, EnergyBlock.COULOMB)]
    # Columns |v| of pairwise non-proportional speeds are independent; see the friction relations.
    rank = len(coulomb) - len(find_friction_relations(coulomb))
    rank += sum(is_in_block(column, EnergyBlock.OWN) for column in left)
    rank += sum(modular.compute_modular_rank(rows[:, kept_columns]) for rows in (energy, rayleigh))
    if rank != len(left):
        raise ProofError(f"of {len(left)} columns kept only {rank} are independent")
    return ModularRank(rank, PRIME, THRESHOLDS.proof_checks * points, seed)


def _check_relations(
    columns: Sequence[StandardColumn],
    K: ExactField,
    relations: GroupingRelations,
    rows: np.ndarray,
    residues: Mapping[sympy.Expr, int],
) -> None:
    residue = cache(partial(K.compute_residue, values=residues, prime=PRIME))
    for relation, dropped in zip(relations.rows, relations.dropped_columns, strict=True):
        total = np.zeros(len(rows), dtype=np.int64)
        for place, coefficient in relation.items():
            total = (total + rows[:, place] * residue(coefficient)) % PRIME
        if np.any(total) and not is_in_block(columns[dropped], EnergyBlock.COULOMB):
            raise ProofError(f"the relation of {columns[dropped].name} does not hold")
