"""Long cases that repeat what quicker ones of their function show: some of them each day."""

import time
from collections import defaultdict
from collections.abc import Iterable
from zlib import crc32

import pytest

IN_TURN = (pytest.mark.slow, pytest.mark.in_turn)
"""Marks of a case of `parametrize`."""


def today() -> int:
    """Days since 1970, UTC."""
    return int(time.time() // 86400)


def resting(names: Iterable[str], turns: Iterable[str], every: int, day: int) -> set[str]:
    """The cases whose turn is not on this day: each has one day of `every`, or more.

    A function all of whose cases take turns has one of them on any day.

    Args:
        names: of all tests, `file::function[case]`.
        turns: those that take turns, in their order.
        every: days; neighbours of a function have neighbouring ones.
        day: any integer; other functions begin on other days.
    """
    cases: dict[str, list[str]] = defaultdict(list)
    for name in turns:
        cases[_function(name)].append(name)
    taking = {name for known in cases.values() for name in known}
    quick = {_function(name) for name in names if name not in taking}
    return {
        name
        for function, known in cases.items()
        for k, name in enumerate(known)
        if (k + crc32(function.encode()) + day)
        % (every if function in quick else min(every, len(known)))
    }


def _function(name: str) -> str:
    return name.partition("[")[0]
