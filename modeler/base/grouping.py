"""All relations among the columns, and from them the base parameters."""

from collections.abc import Sequence
from dataclasses import dataclass

import sympy

from modeler.base.closures import closure_relations
from modeler.base.elimination import sparse_row_reduce
from modeler.base.field import Element, ExactField
from modeler.base.loops import loop_relations, on_link
from modeler.base.priority import priority_order
from modeler.base.result import BaseParameter, Term
from modeler.base.shafts import friction_relations
from modeler.base.tied import has_energy, tied_relations
from modeler.base.tree import group_tree
from modeler.base.units import Units, grouping_units
from modeler.effects import EnergyBlock
from modeler.symbolic import Geometry, StandardColumn, SymbolicModel, in_block


@dataclass(frozen=True)
class Relations:
    """Every linear relation among the columns, reduced: one row for each column that is not kept.

    Attributes:
        rows: sum of coefficient * column = 0; the coefficient of the dropped column is 1.
        dropped: that column of each row.
        kept: the others, in column order.
    """

    rows: tuple[dict[int, Element], ...]
    dropped: tuple[int, ...]
    kept: tuple[int, ...]


def column_relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField, seed: int
) -> Relations:
    """The reduced relations of a robot, first-come by the priority order."""
    units = grouping_units(geometry, model.columns)
    order = priority_order(model.names, model.robot.kept_first)
    if geometry.tied:
        rows = tied_relations(geometry, units.columns, K, units.order(order), seed)
    else:
        rows = _link_relations(geometry, K, units)
    rows += loop_relations(geometry, K, units.places)
    rows, auxiliary = units.merged(rows)
    rows += [
        {place: K.one * sympy.QQ(c.numerator, c.denominator) for place, c in relation.items()}
        for relation in friction_relations(model.columns)
    ]
    felt = {place for _, place in model.regressor}
    rows += [
        {place: K.one}
        for place, column in enumerate(model.columns)
        if in_block(column, EnergyBlock.OWN) and place not in felt
    ]
    reduced, pivots = sparse_row_reduce(rows, [*auxiliary, *order[::-1]])
    first = sum(pivot >= len(model.columns) for pivot in pivots)
    reduced, dropped = reduced[first:], pivots[first:]
    gone = set(dropped)
    kept = [place for place in range(len(model.columns)) if place not in gone]
    return Relations(tuple(reduced), tuple(dropped), tuple(kept))


def with_closure_relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField, relations: Relations, seed: int
) -> Relations:
    """The relations, and those among the kept columns that go around whole loops."""
    order = priority_order(model.names, model.robot.kept_first)
    kept = [i for i in order if i in relations.kept and has_energy(model.columns[i])]
    more = closure_relations(geometry, model.columns, K, kept, seed)
    reduced, dropped = sparse_row_reduce([*relations.rows, *more], order[::-1])
    left = [i for i in range(len(model.columns)) if i not in set(dropped)]
    return Relations(tuple(reduced), tuple(dropped), tuple(left))


def _link_relations(geometry: Geometry, K: ExactField, units: Units) -> list[dict[int, Element]]:
    """Relations of a tree whose rows all move freely."""
    relations = []
    places = units.places
    for k, grouping in enumerate(group_tree(geometry, K, places.keys())):
        if geometry.rows[k].index is None:
            continue
        for hidden, moved in zip(grouping.hidden, grouping.moved, strict=True):
            relation = {places[k, i]: x for i, x in enumerate(hidden) if x}
            parent, moved = on_link(geometry, K, geometry.rows[k].parent, moved)
            if parent is not None:
                for i, x in enumerate(moved):
                    if x:
                        relation[places[parent, i]] = -x
            relations.append(relation)
    return relations


def base_from_relations(
    columns: Sequence[StandardColumn], relations: Relations, K: ExactField
) -> tuple[tuple[BaseParameter, ...], tuple[str, ...]]:
    """Base parameters with their terms, and the parameters without effect.

    A relation col_d + sum r_b col_b = 0 gives beta_b = chi_b - r_b chi_d.
    """
    terms: dict[int, list[Term]] = {
        b: [Term(sympy.Integer(1), columns[b].name)] for b in relations.kept
    }
    unidentifiable = []
    for place, row in sorted(zip(relations.dropped, relations.rows, strict=True)):
        if len(row) == 1:
            unidentifiable.append(columns[place].name)
        for b, coefficient in row.items():
            if b != place:
                terms[b].append(Term(K.expression(-coefficient), columns[place].name))
    parameters = [
        BaseParameter(columns[b].name + ("R" if len(found) > 1 else ""), b, tuple(found))
        for b, found in terms.items()
    ]
    return tuple(parameters), tuple(unidentifiable)
