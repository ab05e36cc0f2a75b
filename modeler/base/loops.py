"""Relations that closing a loop creates.

Where two frames meet in a joint, whatever body moves with one of them as it does with the other may
be counted to either side. Of a rigid joint that is every body; of a spherical one a point mass at
its centre; of a revolute one also a point mass anywhere on its axis and a rotor about it, which are
M, MZ and XX + YY at the meeting frames. These are exact statements on the parameters of the two
links that carry the frames; that there are no others is what the rank of the torques tells.
"""

from collections.abc import Mapping

from modeler.base.field import Element, ExactField
from modeler.base.transfer import joint_constant, placement, transferred
from modeler.robot import INERTIAL
from modeler.symbolic import Geometry

_POINT: tuple[tuple[str, ...], ...] = (("M",),)
_ROUND = ("XX", "YY")
_COMMON: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "position": _POINT,
    "spherical": _POINT,
    "universal": _POINT,
    "revolute": (("M",), ("MZ",), _ROUND),
    "cylindrical": (_ROUND,),
    "planar": (_ROUND,),
    "prismatic": tuple((name,) for name in INERTIAL[:6]),
    "rigid": tuple((name,) for name in INERTIAL),
}
"""Bodies at the meeting frames that move alike with both: parameters that are 1."""


def loop_relations(
    geometry: Geometry, K: ExactField, places: Mapping[tuple[int, int], int]
) -> list[dict[int, Element]]:
    """Relations among the units (see `modeler.base.units`) that the loops create.

    Args:
        geometry: the table.
        K: its field.
        places: unit of (row, place among the ten inertial parameters).
    """
    names = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    relations = []
    for loop in geometry.robot.loops:
        for body in _COMMON[loop.kind]:
            vector = [K.one if prefix in body else K.zero for prefix in INERTIAL]
            relation: dict[int, Element] = {}
            for frame, sign in ((loop.frame, 1), (loop.meets, -1)):
                row, moved = on_link(geometry, K, names.get(frame), list(vector))
                if row is None:
                    continue
                for i, value in enumerate(moved):
                    unit = places[row, i]
                    relation[unit] = relation.get(unit, K.zero) + sign * value
            relations.append({unit: value for unit, value in relation.items() if value})
    return relations


def on_link(
    geometry: Geometry, K: ExactField, row: int | None, parameters: list[Element]
) -> tuple[int | None, list[Element]]:
    """The link that carries a body fixed to frame `row` (None: the base), and its parameters."""
    rows = geometry.rows
    while row is not None and rows[row].index is None:
        for step in (joint_constant(rows[row], K), placement(rows[row], K)):
            parameters = transferred(step, parameters, K)
        row = rows[row].parent
    return row, parameters
