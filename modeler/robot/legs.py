"""Legs that are alike: what holds {i} is written once and stands for every leg."""

import re
from collections.abc import Sequence
from typing import Any

from modeler.robot.cells import list_at, name_of
from modeler.robot.place import Place, shown

MARK = "{i}"
MOST_LEGS = 50
"""Legs of three rows fill the longest table."""
_NAME = re.compile(r"[A-Za-z0-9]+")
_UNTOUCHED = ("legs", "shared", "notes", "title", "name", "log")


def expanded(document: dict[str, Any], place: Place) -> dict[str, Any]:
    """The document with every {i} replaced by the names of the legs.

    Consecutive rows of a table with {i} are repeated leg after leg; so is an entry of a list, and
    a line `key = value`.

    Raises:
        RobotError: {i} without `legs`, wrong names of legs, another mark in braces.
    """
    legs = leg_names(document.get("legs"), place.at("legs"))
    return {
        key: value if key in _UNTOUCHED else _expanded(value, legs, place.at(key))
        for key, value in document.items()
    }


def leg_names(value: Any, place: Place) -> tuple[str, ...]:
    """Names of the legs; empty if the file has no `legs`.

    Raises:
        RobotError: not a list of different letters and digits.
    """
    if value is None:
        return ()
    legs = [name_of(leg) for leg in list_at(value, place, '["1", "2", "3"]')]
    if len(legs) > MOST_LEGS:
        raise place.error(
            f"got {len(legs)} legs; expected at most {MOST_LEGS}: model a few of them, or parts of "
            "the robot in files of their own"
        )
    for leg in legs:
        if not isinstance(leg, str) or not _NAME.fullmatch(leg) or not leg.isascii():
            raise place.error(
                f'got {shown(leg)}; expected names of letters and digits, as in ["1", "2", "3"]'
            )
        if legs.count(leg) > 1:
            raise place.error(f"{shown(leg)} stands there twice; give each leg its own name")
    if not legs:
        raise place.error('got no legs; expected their names, as in ["1", "2", "3"]')
    return tuple(legs)


def _expanded(value: Any, legs: Sequence[str], place: Place) -> Any:
    if isinstance(value, dict):
        found: dict[str, Any] = {}
        for key, entry in value.items():
            if MARK in key:
                _need(legs, key, place)
                found |= {_filled(key, leg): _filled(entry, leg) for leg in legs}
            else:
                found[_checked(key, place)] = _expanded(entry, legs, place.at(key))
        return found
    if isinstance(value, list):
        return _expanded_list(value, legs, place)
    return _checked(value, place)


def _expanded_list(value: list[Any], legs: Sequence[str], place: Place) -> list[Any]:
    found: list[Any] = []
    block: list[Any] = []
    for entry in [*value, None]:
        marked = entry is not None and _marked(entry)
        if marked:
            _need(legs, entry, place)
            block.append(entry)
        # Rows of a table go leg by leg; single entries each for itself.
        if block and not (marked and isinstance(entry, list)):
            found += [_filled(one, leg) for leg in legs for one in block]
            block = []
        if not marked and entry is not None:
            found.append(_expanded(entry, legs, place))
    return found


def _marked(value: Any) -> bool:
    if isinstance(value, list):
        return any(_marked(entry) for entry in value)
    return isinstance(value, str) and MARK in value


def _filled(value: Any, leg: str) -> Any:
    if isinstance(value, list):
        return [_filled(entry, leg) for entry in value]
    return value.replace(MARK, leg) if isinstance(value, str) else value


def _need(legs: Sequence[str], value: Any, place: Place) -> None:
    if not legs:
        raise place.error(
            f"got {shown(value)}: {MARK} stands for the legs, and the file names none; write "
            'legs = ["1", "2", "3"] at its top'
        )


def _checked(value: Any, place: Place) -> Any:
    if isinstance(value, str) and (mark := re.search(r"\{[^}]*\}?", value)):
        raise place.error(
            f"got {shown(value)} with {shown(mark[0])}; the only mark is {MARK}, "
            "for the legs; correct it"
        )
    return value
