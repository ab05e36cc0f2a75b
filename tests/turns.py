"""Long tests that repeat what quicker ones show: some of them each day."""

import time
from collections import defaultdict
from collections.abc import Collection, Mapping
from typing import Any
from zlib import crc32

import pytest

IN_TURN = (pytest.mark.slow, pytest.mark.in_turn)
"""Marks of a case of `parametrize`, where one of these runs each day.

Where the function has quick cases, `slow` alone says the same.
"""


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

    A slow case of a function that has quick ones takes turns without a mark.
    """
    quick = {_function(i.nodeid) for i in items if i.get_closest_marker("slow") is None}
    found: dict[str, str] = {}
    for item in items:
        mark = item.get_closest_marker("in_turn")
        if mark is not None and mark.args:
            found[item.nodeid] = mark.args[0]
        elif mark is not None or (
            item.get_closest_marker("slow") and _function(item.nodeid) in quick
        ):
            found[item.nodeid] = _function(item.nodeid)
    return found


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
