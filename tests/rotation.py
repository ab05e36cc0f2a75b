"""Cases that repeat what others show run in rotation: each run has a share, and all are recorded.

A case runs at the latest in the N-th run of `--every N`; one that failed runs until it passes.
The record is kept in pytest's cache folder (`modeler/rotation`): case -> runs it has waited.
"""

import argparse
import time
from collections import Counter, defaultdict
from typing import Any
from zlib import crc32

import pytest

ROTATING = (pytest.mark.slow, pytest.mark.rotating)
"""Marks of a long case of `parametrize`; the function has quick cases, or one runs each time."""

RECORD = "modeler/rotation"
SWEEP = 5
"""Of a function with cases of so many robots, beside one of each kind, the robots rotate."""


def rotating(*cases: Any) -> list[Any]:
    """Quick cases of `parametrize` that repeat others; a tuple is a case of several parameters."""
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.rotating)
        for case in cases
    ]


def with_cases(names: str, *cases: Any, **options: Any) -> Any:
    """Decorator of a test: `parametrize` by names, separated by commas, and a case each."""
    return pytest.mark.parametrize(names, cases, **options)


def slow_rotating(group: str) -> Any:
    """Decorator of a long test beside quick ones of its subject; those of a group rotate."""

    def marked(function: Any) -> Any:
        return pytest.mark.slow(pytest.mark.rotating(group)(function))

    return marked


def number_of_runs(text: str) -> int:
    """Type of `--every`: a whole number from 1 on."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"got {text}; expected 1 or more runs")
    return int(text)


def today() -> int:
    """Days since 1970, UTC."""
    return int(time.time() // 86400)


class Rotation:
    """Plugin of pytest: leaves out the cases that rest in this run, and records all.

    Args:
        config: of pytest, with `--every` and `--day`.
        kinds: robots that stand for the others: their cases do not rotate.
        others: the other robots; neighbours have neighbouring runs.
    """

    def __init__(self, config, kinds, others):
        self._config, self._kinds, self._others = config, kinds, others
        self._waits: dict[str, int] = {}
        self._ran: set[str] = set()

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Leaves out what rests; of what -m and -k leave, so that no other case counts a run."""
        every, day = self._config.getoption("every"), self._config.getoption("day")
        if every == 1:
            return
        cases = rotating_cases(items, self._kinds, self._others, every)
        failed = self._config.cache.get("cache/lastfailed", {})
        self._waits = plan_run(cases, self._config.cache.get(RECORD, {}), failed, day)
        rest = [item for item in items if self._waits.get(item.nodeid)]
        self._config.hook.pytest_deselected(items=rest)
        items[:] = [item for item in items if not self._waits.get(item.nodeid)]

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self._ran.add(report.nodeid)

    def pytest_sessionfinish(self) -> None:
        if hasattr(self._config, "workeroutput"):
            self._config.workeroutput["rotation"] = self._waits
        elif self._waits and not self._config.getoption("collectonly"):
            self._keep()

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """What a process of pytest-xdist has selected; all select the same."""
        self._waits = getattr(node, "workeroutput", {}).get("rotation", self._waits)

    def _keep(self) -> None:
        known = self._config.cache.get(RECORD, {})
        new = {name: n for name, n in self._waits.items() if n or name in self._ran}
        self._config.cache.set(RECORD, {**known, **new})

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        if self._waits:
            rest = Counter(map(bool, self._waits.values()))
            terminalreporter.write_line(
                f"in rotation (--every {self._config.getoption('every')}): {rest[False]} cases "
                f"ran, {rest[True]} rested, none longer than {max(self._waits.values())} runs"
            )


def rotating_cases(items, kinds, others, every):
    """The cases that rotate -> phase and period, in runs.

    A group none of whose cases runs each time has one of them in every run.
    """
    groups = {item.nodeid: group for item in items if (group := _group(item))}
    quick = {_function(item.nodeid) for item in items if item.nodeid not in groups}
    members: dict[str, list[str]] = defaultdict(list)
    for name, group in groups.items():
        members[group].append(name)
    cases = _robots([item for item in items if item.nodeid not in groups], kinds, others, every)
    for group, names in members.items():
        period = every if group in quick else min(every, len(names))
        first = crc32(group.encode())
        cases |= {name: ((k + first) % period, period) for k, name in enumerate(names)}
    return cases


def plan_run(cases, record, failed, day):
    """Case -> the runs it has waited after this one; 0: it runs.

    Args:
        cases: case -> phase and period.
        record: the same of the last run; a case that it lacks begins with a wait by the day.
        failed: cases that have failed and not passed since.
        day: any integer.
    """
    waits = {}
    for name, (phase, period) in cases.items():
        waited = record.get(name, (phase + day) % period)
        waits[name] = 0 if waited + 1 >= period or name in failed else waited + 1
    return waits


def _group(item: pytest.Item) -> str:
    """What a test rotates with: what its mark says, else its function; empty: it does not.

    A slow case of `parametrize` rotates without a mark.
    """
    mark = item.get_closest_marker("rotating")
    if mark is not None and mark.args:
        return str(mark.args[0])
    slow_case = "[" in item.nodeid and item.get_closest_marker("slow")
    return _function(item.nodeid) if mark is not None or slow_case else ""


def _robots(items, kinds, others, every):
    """Of functions over many robots, the cases of those that stand for no kind.

    All cases of a robot have the same phase, so that what they share is made in that run alone.
    """
    cases: dict[str, dict[str, set[str]]] = defaultdict(dict)
    for item in items:
        if robots := _texts(item) & {*kinds, *others}:
            cases[_function(item.nodeid)][item.nodeid] = robots
    phase = {robot: k for k, robot in enumerate(others)}
    rotating_robots = {}
    for of_function in cases.values():
        beside = set().union(*of_function.values())
        if len(beside - {*kinds}) >= SWEEP and any(r <= {*kinds} for r in of_function.values()):
            for name, robots in of_function.items():
                if robots - {*kinds}:
                    rotating_robots[name] = (min(phase[r] for r in robots - {*kinds}), every)
    return rotating_robots


def _texts(item: pytest.Item) -> set[str]:
    """The texts among the parameters of a case."""
    case = getattr(item, "callspec", None)
    values = case.params.values() if case is not None else ()
    return {value for value in values if isinstance(value, str)}


def _function(name: str) -> str:
    return name.partition("[")[0]
