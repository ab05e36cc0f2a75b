"""All relations among the columns, and from them the base parameters."""

from collections.abc import Sequence
from dataclasses import dataclass

import sympy

from modeler.base.elimination import sparse_row_reduce
from modeler.base.field import Element, ExactField
from modeler.base.priority import priority_order
from modeler.base.result import BaseParameter, Term
from modeler.base.shafts import friction_relations
from modeler.base.transfer import joint_constant, placement, transferred
from modeler.base.tree import INERTIA, OFFSET, group_tree
from modeler.robot import INERTIAL
from modeler.symbolic import Geometry, StandardColumn, SymbolicModel


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


def column_relations(model: SymbolicModel, geometry: Geometry, K: ExactField) -> Relations:
    """The reduced relations of a serial or tree robot, first-come by the priority order."""
    rows = _link_relations(model, geometry, K) + [
        {place: K.one * sympy.QQ(c.numerator, c.denominator) for place, c in relation.items()}
        for relation in friction_relations(model.columns)
    ]
    order = priority_order(model.names, model.robot.priority)
    reduced, dropped = sparse_row_reduce(rows, order[::-1])
    kept = [place for place in range(len(model.columns)) if place not in set(dropped)]
    return Relations(tuple(reduced), tuple(dropped), tuple(kept))


def _link_relations(
    model: SymbolicModel, geometry: Geometry, K: ExactField
) -> list[dict[int, Element]]:
    places = _places(model.columns)
    relations = []
    for k, grouping in enumerate(group_tree(geometry, K, places.keys())):
        if geometry.rows[k].index is None:
            continue
        for hidden, moved in zip(grouping.hidden, grouping.moved, strict=True):
            relation = {places[k, i]: x for i, x in enumerate(hidden) if x}
            parent, moved = _carrying(geometry, K, k, moved)
            if parent is not None:
                for i, x in enumerate(moved):
                    if x:
                        relation[places[parent, i]] = -x
            relations.append(relation)
    return relations


def _carrying(
    geometry: Geometry, K: ExactField, k: int, moved: list[Element]
) -> tuple[int | None, list[Element]]:
    """The link that takes over, below any fixed frames; None for the base."""
    rows = geometry.rows
    parent = rows[k].parent
    while parent is not None and rows[parent].index is None:
        for step in (joint_constant(rows[parent], K), placement(rows[parent], K)):
            moved = transferred(step, moved, K)
        parent = rows[parent].parent
    return parent, moved


def _places(columns: Sequence[StandardColumn]) -> dict[tuple[int, int], int]:
    """Column of (row, place among the link's ten, rotor inertia, offset)."""
    found = {}
    for place, column in enumerate(columns):
        if column.column is None:
            found[column.row, INERTIAL.index(column.prefix)] = place
        elif column.shaft is not None and len(column.shaft) == 1 and column.effect in _OWN:
            found[column.row, _OWN[column.effect]] = place
    return found


_OWN = {"rotor_inertia": INERTIA, "offset": OFFSET}


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
