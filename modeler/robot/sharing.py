"""Links that have not all ten parameters, and parameters that similar legs share."""

import fnmatch
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.robot.cells import list_at, name_of, table_at, text_at
from modeler.robot.joint import Joint
from modeler.robot.legs import MARK
from modeler.robot.place import Place, listed, near, shown
from modeler.robot.robot import INERTIAL, SharedParameter


def read_links(value: Any, moving: Mapping[str, Joint], place: Place) -> dict[str, tuple[str, ...]]:
    """Inertial parameters of the rows that have not all ten: `[links] 5 = []`, `P = ["M"]`.

    Raises:
        RobotError: unknown rows or parameters.
    """
    links = {}
    for name, cell in table_at(value, place, '[links] 5 = [], P = ["M"]').items():
        here = place.at(shown(name))
        if name not in moving:
            raise here.error(
                f"there is no moving row {shown(name)}{near(name, moving)}; expected one of "
                f"{listed(moving)}"
            )
        entries = list_at(cell, here, '["M"]')
        for entry in entries:
            if entry not in INERTIAL:
                raise here.error(f"got {shown(entry)}; expected some of {listed(INERTIAL)}")
        links[name] = tuple(prefix for prefix in INERTIAL if prefix in entries)
    return links


def read_shared(
    value: Any, known: Sequence[str], legs: Sequence[str], place: Place
) -> tuple[SharedParameter, ...]:
    """Parameters that the legs have in common: `shared = ["*2{i}"]` makes XX2 of XX21, XX22, XX23.

    Raises:
        RobotError: patterns without {i} or without a parameter, a name that is taken.
    """
    found: dict[str, SharedParameter] = {}
    for pattern in list_at(value, place, '["*2{i}", "*3{i}"]'):
        pattern = text_at(name_of(pattern), place, '"*2{i}"')
        if MARK not in pattern or not legs:
            raise place.error(
                f'got {shown(pattern)}; expected {MARK} in it and legs = ["1", "2"] at the top'
            )
        first = pattern.replace(MARK, legs[0])
        stem = pattern.split(MARK)[0].rsplit("*", 1)[-1]
        matching = [name for name in known if fnmatch.fnmatchcase(name, first)]
        if not matching:
            raise place.error(
                f"{shown(pattern)} matches no parameter of leg {legs[0]}; expected names or "
                f"patterns of {listed(known[:12])} ..."
            )
        for name in matching:
            head = name[: len(name) - len(first.rsplit("*", 1)[-1])]
            own = head + stem + pattern.split(MARK)[1]
            members = tuple(head + stem + leg + pattern.split(MARK)[1] for leg in legs)
            _check_members(own, members, known, place)
            found[own] = SharedParameter(own, members)
    return tuple(found.values())


def _check_members(name: str, members: Sequence[str], known: Sequence[str], place: Place) -> None:
    for member in members:
        if member not in known:
            raise place.error(
                f"{shown(members[0])} has no counterpart {shown(member)}; share what all legs have"
            )
    if name in known:
        raise place.error(
            f"{shown(name)} would be shared by the legs and is a parameter already; rename that row"
        )


def shared_names(known: Sequence[str], shared: Sequence[SharedParameter]) -> tuple[str, ...]:
    """The parameters' names with shared ones once, where their first member stood."""
    first = {parameter.members[0]: parameter.name for parameter in shared}
    gone = {member for parameter in shared for member in parameter.members[1:]}
    return tuple(first.get(name, name) for name in known if name not in gone)
