"""All relations among the columns, and from them the base parameters."""

import fnmatch
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import sympy

from modeler.core.errors import DerivationError
from modeler.derivation.columns import LinkColumn, StandardColumn, build_link_column, is_in_block
from modeler.derivation.field import Element, ExactField, find_linear_relations, reduce_sparse_rows
from modeler.derivation.geometry import Geometry
from modeler.derivation.loop_relations import (
    derive_closure_relations,
    derive_loop_relations,
    move_to_link,
)
from modeler.derivation.model import SymbolicModel
from modeler.derivation.result import BaseParameter, Term
from modeler.derivation.tied import derive_tied_relations, has_energy
from modeler.derivation.tree import INERTIA, OFFSET, group_tree
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
    """All units of a robot.

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
        return sorted(
            range(len(self.owner)),
            key=lambda unit: (
                last if (owner_column := self.owner[unit]) is None else places[owner_column]
            ),
        )

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
            elif part.effect in _OWN:
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
    return [
        {place: Fraction(1), **{kept_place: -factor for kept_place, factor in combination.items()}}
        for place, combination in relations.combinations.items()
        if place not in relations.independent
    ]


# Which parameters are kept first when they group: the user's order, else the table's.


def sort_by_priority(names: Sequence[str], patterns: Sequence[str]) -> list[int]:
    """Returns the columns in the order of keeping: those of the patterns first.

    Raises:
        DerivationError: a pattern matches no parameter.
    """
    order: list[int] = []
    for pattern in patterns:
        matching = [i for i, name in enumerate(names) if fnmatch.fnmatchcase(name, pattern)]
        if not matching:
            raise DerivationError(
                f'priority: "{pattern}" matches no parameter; expected names or patterns such as '
                f'"{names[0]}" or "{names[0][:2]}*"'
            )
        order += [i for i in matching if i not in order]
    return order + [i for i in range(len(names)) if i not in order]


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
        rows = derive_tied_relations(geometry, units.columns, K, units.sort_units(order), seed)
    else:
        rows = _derive_link_relations(geometry, K, units)
    rows += derive_loop_relations(geometry, K, units.places)
    rows, auxiliary = units.merge_rows(rows)
    rows += [
        {place: K.one * sympy.QQ(c.numerator, c.denominator) for place, c in relation.items()}
        for relation in find_friction_relations(model.columns)
    ]
    effective_columns = {place for _, place in model.regressor}
    rows += [
        {place: K.one}
        for place, column in enumerate(model.columns)
        if is_in_block(column, EnergyBlock.OWN) and place not in effective_columns
    ]
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
    kept_columns = [
        i for i in order if i in relations.kept_columns and has_energy(model.columns[i])
    ]
    more = derive_closure_relations(geometry, model.columns, K, kept_columns, seed)
    reduced, dropped = reduce_sparse_rows([*relations.rows, *more], order[::-1])
    left = [i for i in range(len(model.columns)) if i not in set(dropped)]
    return GroupingRelations(tuple(reduced), tuple(dropped), tuple(left))


def _derive_link_relations(
    geometry: Geometry, K: ExactField, units: GroupingUnits
) -> list[dict[int, Element]]:
    """Relations of a tree whose rows all move freely."""
    relations = []
    places = units.places
    for k, grouping in enumerate(group_tree(geometry, K, places.keys())):
        if geometry.rows[k].index is None:
            continue
        for hidden, moved in zip(grouping.hidden, grouping.moved, strict=True):
            relation = {places[k, i]: x for i, x in enumerate(hidden) if x}
            parent, moved = move_to_link(geometry, K, geometry.rows[k].parent, moved)
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
    terms: dict[int, list[Term]] = {
        b: [Term(sympy.Integer(1), columns[b].name)] for b in relations.kept_columns
    }
    unidentifiable = []
    for place, row in sorted(zip(relations.dropped_columns, relations.rows, strict=True)):
        if len(row) == 1:
            unidentifiable.append(columns[place].name)
        for b, coefficient in row.items():
            value = K.expression(-coefficient)
            if b != place and value:  # 0 where roots of numbers, letters in K, cancel
                terms[b].append(Term(value, columns[place].name))
    return build_named_parameters(columns, terms, halves), tuple(unidentifiable)


def build_named_parameters(
    columns: Sequence[StandardColumn], terms: Mapping[int, Sequence[Term]], halves: bool
) -> tuple[BaseParameter, ...]:
    """Builds base parameters of {column: terms}; names of grouped ones end in R."""
    return tuple(
        BaseParameter(
            columns[b].name + ("R" if len(parameter_terms) > 1 else ""),
            b,
            tuple(parameter_terms),
            halves,
        )
        for b, parameter_terms in terms.items()
    )
