"""Which sines, cosines and travels the configuration of a robot is written in.

The free variables u of the table, or of a robot whose joints follow others by linear relations,
move every row: q_row = sum of coefficient * u[k] + constant. A *motion* is one angle, or one
travel, of which functions are polynomials. The angle of a free joint is its own motion; a row that
follows others is a sum of whole multiples of such angles, and the addition theorem says the rest.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from modeler.symbolic.geometry import Geometry, Row

_MOST_TURNS = 4
"""Whole multiples of angles in a sum; a longer sum is an angle of its own."""

_FINEST = 4
"""Parts of a free angle that a row may turn by: q2/2, q2/3, q2/4. Finer ones are angles of their
own: gear ratios are not worth multiplying out."""


@dataclass(frozen=True)
class Motion:
    """One angle with the places of its sine and cosine, or one travel with its place.

    Attributes:
        joint: whose variable it is, or the row that turns by it: the letter after s, c, q.
        sine: place of its sine among the generators; None for a travel.
        cosine: likewise.
        variable: place of the travel; None for an angle.
        form: {k: coefficient}: the angle or travel as a sum of coefficient * u[k].
    """

    joint: str
    sine: int | None
    cosine: int | None
    variable: int | None
    form: Mapping[int, Fraction]


@dataclass(frozen=True)
class Motions:
    """The motions of a geometry, and every row in them.

    Attributes:
        names: of the generators.
        each: the motions.
        turns: {index of a row that turns: {place of a motion: whole multiple}}.
    """

    names: tuple[str, ...]
    each: tuple[Motion, ...]
    turns: Mapping[int, Mapping[int, int]]

    def travel(self, k: int) -> int:
        """Place of the generator of the free variable u[k]."""
        return next(
            m.variable for m in self.each if m.variable is not None and m.form == {k: Fraction(1)}
        )


def motions_of(geometry: Geometry) -> Motions:
    """The motions of all rows, in table order."""
    parts = _parts(geometry)
    names: list[str] = []
    each: list[Motion] = []
    turns: dict[int, Mapping[int, int]] = {}
    for row in sorted(geometry.rows, key=lambda row: not _is_free(row, geometry)):
        if row.index is None:
            continue
        form = geometry.forms[row.index]
        if not row.joint.angular:
            _add_travels(form, geometry, names, each)
            continue
        found = _in_known(form, each)
        if found is None:
            divided = {k: c / parts.get(k, 1) if len(form) == 1 else c for k, c in form.items()}
            free = _is_free(row, geometry)
            whose = row.joint.name
            if free and parts.get(min(form), 1) > 1:
                whose, form = f"{whose}_{parts[min(form)]}", divided
            each.append(Motion(whose, len(names), len(names) + 1, None, form))
            names += [f"s{whose}", f"c{whose}"]
            found = _in_known(geometry.forms[row.index], each)
            assert found is not None, "an angle is a multiple of itself"
        turns[row.index] = found
    return Motions(tuple(names), tuple(each), turns)


def _is_free(row: Row, geometry: Geometry) -> bool:
    return row.joint.name not in geometry.robot.relations


def _add_travels(
    form: Mapping[int, Fraction], geometry: Geometry, names: list[str], each: list[Motion]
) -> None:
    """The free variables themselves, for rows that travel by them."""
    known = [motion.form for motion in each if motion.variable is not None]
    for k in form:
        if {k: Fraction(1)} not in known:
            joint = geometry.robot.free[k].name
            each.append(Motion(joint, None, None, len(names), {k: Fraction(1)}))
            names.append(f"q{joint}")


def _parts(geometry: Geometry) -> dict[int, int]:
    """{k: n}: rows turn by whole multiples of u[k] / n."""
    found: dict[int, int] = {}
    for row in geometry.rows:
        if row.index is not None and row.joint.angular:
            for k, coefficient in geometry.forms[row.index].items():
                if coefficient.denominator <= _FINEST:
                    found[k] = lcm(found.get(k, 1), coefficient.denominator)
    return found


def _in_known(form: Mapping[int, Fraction], each: list[Motion]) -> dict[int, int] | None:
    """The angle as whole multiples of known motions; None if it is none, or too many."""
    for place, motion in enumerate(each):
        if motion.sine is not None and motion.form == form:
            return {place: 1}
    found: dict[int, int] = {}
    for k, coefficient in form.items():
        single = [i for i, m in enumerate(each) if m.sine is not None and set(m.form) == {k}]
        ratios = {i: coefficient / each[i].form[k] for i in single}
        place = next((i for i, x in ratios.items() if x.denominator == 1), -1)
        if place < 0:
            return None
        found[place] = int(ratios[place])
    return found if sum(map(abs, found.values())) <= _MOST_TURNS else None
