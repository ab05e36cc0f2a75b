"""The units of grouping: every inertial parameter of every link, whether the robot has it or not.

Relations pass through links that the robot states as massless, and hold for each link of similar
legs on its own. So they are found among units, one per row and parameter, and then restricted to
the robot's columns: what it does not have is eliminated, and what legs share must occur alike.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from modeler.base.field import Element
from modeler.base.tree import INERTIA, OFFSET
from modeler.robot import INERTIAL
from modeler.symbolic import Geometry, LinkColumn, StandardColumn, link_column

_OWN = {"rotor_inertia": INERTIA, "offset": OFFSET}


@dataclass(frozen=True)
class Units:
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

    def merged(
        self, rows: Sequence[Mapping[int, Element]]
    ) -> tuple[list[dict[int, Element]], list[int]]:
        """Rows over units as rows over columns, with auxiliary ones that have to vanish.

        Returns:
            Rows over the robot's columns and auxiliary columns; the numbers of these, all above
            the robot's: coefficients of absent units, and differences within shared parameters.
        """
        first: dict[int, int] = {}
        for unit, column in enumerate(self.owner):
            if column is not None:
                first.setdefault(column, unit)
        found = []
        for row in rows:
            new: dict[int, Element] = {}
            for unit, value in row.items():
                column = self.owner[unit]
                if column is not None and first[column] == unit:
                    new[column] = value
                    for other in self._others(column, unit):
                        _add(new, self.standard + other, -value)
                else:
                    _add(new, self.standard + unit, value)
            found.append({place: value for place, value in new.items() if value})
        used = sorted({place for row in found for place in row if place >= self.standard})
        return found, used

    def order(self, columns: Sequence[int]) -> list[int]:
        """Units in the order of the columns that own them, those without owner last."""
        places = {column: i for i, column in enumerate(columns)}
        last = len(places)
        return sorted(
            range(len(self.owner)),
            key=lambda unit: last if (own := self.owner[unit]) is None else places[own],
        )

    def _others(self, column: int, unit: int) -> list[int]:
        return [u for u in self._parts[column] if u != unit]

    @cached_property
    def _parts(self) -> dict[int, list[int]]:
        """The units of each column."""
        found: dict[int, list[int]] = {}
        for unit, column in enumerate(self.owner):
            if column is not None:
                found.setdefault(column, []).append(unit)
        return found


def _add(row: dict[int, Element], place: int, value: Element) -> None:
    row[place] = row[place] + value if place in row else value


def grouping_units(geometry: Geometry, columns: Sequence[StandardColumn]) -> Units:
    """The units of a robot with these columns."""
    found: list[StandardColumn] = []
    owner: list[int | None] = []
    places: dict[tuple[int, int], int] = {}
    for column, standard in enumerate(columns):
        for part in standard.parts:
            if isinstance(part, LinkColumn):
                places[part.row, INERTIAL.index(part.prefix)] = len(found)
            elif part.effect in _OWN:
                places[part.row, _OWN[part.effect]] = len(found)
            found.append(part)
            owner.append(column)
    for k, row in enumerate(geometry.rows):
        if row.index is not None:
            for i, prefix in enumerate(INERTIAL):
                if (k, i) not in places:
                    places[k, i] = len(found)
                    found.append(link_column(prefix, k, row.joint))
                    owner.append(None)
    return Units(tuple(found), tuple(owner), places, len(columns))
