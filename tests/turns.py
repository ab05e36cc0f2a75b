"""Long tests that repeat what quicker ones show: some of them each day."""

import time
from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
from typing import Any
from zlib import crc32

import pytest

IN_TURN = (pytest.mark.slow, pytest.mark.in_turn)
"""Marks of a case of `parametrize`; the function has quick cases, or one of these runs each day."""


def in_turn(group: str) -> Any:
    """Decorator of a long test beside quick ones of its subject; the group takes turns."""

    def marked(function: Any) -> Any:
        return pytest.mark.slow(pytest.mark.in_turn(group)(function))

    return marked


def today() -> int:
    """Days since 1970, UTC."""
    return int(time.time() // 86400)


def turns(items: Collection[pytest.Item]) -> dict[str, str]:
    """Test -> its group, of those that take turns: what its mark says, else its function.

    A slow case of `parametrize` takes turns without a mark.
    """
    found: dict[str, str] = {}
    for item in items:
        mark = item.get_closest_marker("in_turn")
        if mark is not None and mark.args:
            found[item.nodeid] = mark.args[0]
        elif mark is not None or ("[" in item.nodeid and item.get_closest_marker("slow")):
            found[item.nodeid] = _function(item.nodeid)
    return found


SWEEP = 5
"""Of a function with cases of so many robots, beside one of each kind, the robots take turns."""


def resting_robots(
    items: Collection[pytest.Item],
    kinds: Collection[str],
    others: Sequence[str],
    every: int,
    day: int,
) -> set[str]:
    """The tests of functions that run over many robots, where the robot's day is another one.

    All cases of a robot have the same day, so that what they share is made on it alone.

    Args:
        items: all tests.
        kinds: robots that stand for the others: they have every day.
        others: the others; neighbours have neighbouring days.
        every: days.
        day: any integer.
    """
    cases: dict[str, dict[str, set[str]]] = defaultdict(dict)
    for item in items:
        if robots := _texts(item) & {*kinds, *others}:
            cases[_function(item.nodeid)][item.nodeid] = robots
    absent = {robot for k, robot in enumerate(others) if (k + day) % every}
    found: set[str] = set()
    for of_function in cases.values():
        beside = set().union(*of_function.values())
        if len(beside - {*kinds}) >= SWEEP and any(r <= {*kinds} for r in of_function.values()):
            found |= {name for name, robots in of_function.items() if robots & absent}
    return found


def _texts(item: pytest.Item) -> set[str]:
    """The texts among the parameters of a case."""
    case = getattr(item, "callspec", None)
    values = case.params.values() if case is not None else ()
    return {value for value in values if isinstance(value, str)}


def resting(names: Collection[str], groups: Mapping[str, str], every: int, day: int) -> set[str]:
    """The tests whose turn is not on this day: each has one day of `every`, or more.

    A group none of whose tests runs every day has one of them on any day.

    Args:
        names: of all tests, `file::function[case]`.
        groups: those that take turns, in their order -> their group.
        every: days; neighbours of a group have neighbouring ones.
        day: any integer; other groups begin on other days.
    """
    members: dict[str, list[str]] = defaultdict(list)
    for name, group in groups.items():
        members[group].append(name)
    quick = {_function(name) for name in names if name not in groups}
    return {
        name
        for group, known in members.items()
        for k, name in enumerate(known)
        if (k + crc32(group.encode()) + day) % (every if group in quick else min(every, len(known)))
    }


def _function(name: str) -> str:
    return name.partition("[")[0]
