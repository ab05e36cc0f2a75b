"""Long cases in turns: none is forgotten, and no day has them all."""

import random
from types import SimpleNamespace
from typing import Any

import pytest

from tests.conftest import LONGEST, ROOT, pytest_collection_modifyitems
from tests.turns import IN_TURN, SWEEP, resting, resting_robots

FUNCTIONS = [f"tests/{name}.py::test_{name}" for name in "abcdefghijkl"]
QUICK = FUNCTIONS[::2]
"""Those with a case that takes no turn."""
GROUPS = {f"{function}[{k}]": function for n, function in enumerate(FUNCTIONS) for k in range(n)}
GROUPS |= {f"tests/z.py::test_{k}": "together" for k in range(4)}
ALL = [*GROUPS, *(f"{function}[quick]" for function in QUICK)]


def run(every: int, day: int) -> set[str]:
    return set(GROUPS) - resting(ALL, GROUPS, every, day)


@pytest.mark.parametrize("every", [1, 2, 3, 5])
def test_each_has_its_turn(every: int) -> None:
    day = random.Random().randrange(10**6)
    days = [run(every, day + k) for k in range(every)]
    assert set().union(*days) == set(GROUPS)
    for name, group in GROUPS.items():
        if group in QUICK:
            assert sum(name in names for names in days) == 1


def test_a_day_has_a_share_of_each_group() -> None:
    left = run(3, random.Random().randrange(10**6))
    for group in set(GROUPS.values()):
        mine = [name for name in GROUPS if GROUPS[name] == group]
        n = len(mine)
        least = n // 3 if group in QUICK else max(n // 3, 1)
        assert least <= sum(name in left for name in mine) <= n // 3 + 1


class Told:
    """What the hook of pytest asks of a test, and of the command line."""

    def __init__(self, nodeid: str = "", **options: Any) -> None:
        self.nodeid, self.options = nodeid, options
        self.callspec = SimpleNamespace(params=options)
        self.hook: Any = self
        self.left: list[Any] = []

    def get_closest_marker(self, name: str) -> pytest.Mark | None:
        slow, turn = (mark.name for mark in IN_TURN)
        group = GROUPS.get(self.nodeid, "")
        # Of every second case it is said that it is slow, and no more.
        told = (slow, turn)[: 1 if "::" in group and int(self.nodeid[:-1].split("[")[1]) % 2 else 2]
        if not group or name not in told:
            return None
        return pytest.Mark(
            name, (group,) if name == turn and "::" not in group else (), {}, _ispytest=True
        )

    def getoption(self, name: str) -> Any:
        return self.options.get(name.lstrip("-"))

    def pytest_deselected(self, items: list[Any]) -> None:
        self.left += items


@pytest.mark.parametrize("every", [1, 3, 5])
def test_robots_of_a_sweep_have_their_day(every: int) -> None:
    """One of each kind has all days; a function of a few robots has all of them on all days."""
    kinds, others = ("K1", "K2"), [f"R{k}" for k in range(7)]
    swept = [Told(f"tests/a.py::test_{f}[{r}]", name=r) for f in "ab" for r in (*kinds, *others)]
    other = [Told(f"tests/a.py::test_{c}[{r}]", name=r) for c, own in {
        "few": [*kinds, *others[: SWEEP - 1]], "no_kind": others}.items() for r in own
    ]  # fmt: skip
    plain = [Told("tests/a.py::test_plain"), Told("tests/a.py::test_number[1]", count=1)]
    items: list[Any] = [*swept, *other, *plain]
    day = random.Random().randrange(10**6)
    runs = [
        {i.nodeid for i in items} - resting_robots(items, kinds, others, every, day + k)
        for k in range(every)
    ]
    for item in items:
        days = sum(item.nodeid in run for run in runs)
        daily = item not in swept or item.callspec.params["name"] in kinds
        assert days == (every if daily else 1)
    for run in runs:
        assert len({item.callspec.params["name"] for item in swept if item.nodeid in run}) < 6 or (
            every == 1
        )
        for robot in others:  # on the same day in every function
            assert len({item.nodeid in run for item in swept if item.nodeid[-3:-1] == robot}) == 1


def test_what_takes_no_turn_runs_every_day() -> None:
    items: list[Any] = [Told(name) for name in ALL]
    config: Any = Told(every=3, day=20000)
    pytest_collection_modifyitems(config, items)
    assert {item.nodeid for item in items} == run(3, 20000) | set(ALL) - set(GROUPS)
    assert {item.nodeid for item in config.left} == resting(ALL, GROUPS, 3, 20000)


def test_what_is_longest_is_begun_first() -> None:
    items: list[Any] = [Told(f"tests/{file}::test") for file in ("a.py", LONGEST[0], "b.py")]
    pytest_collection_modifyitems(Told(every=1, day=0), items)  # type: ignore[arg-type]
    assert all(any((ROOT / "tests").rglob(file)) for file in LONGEST)
    assert [item.nodeid[6:-6] for item in items] == [LONGEST[0], "a.py", "b.py"]
