"""Cases in rotation: none is forgotten, one that failed comes again, no run has them all."""

import random
from types import SimpleNamespace
from typing import Any

import pytest

from tests.conftest import LONGEST, ROOT, pytest_collection_modifyitems
from tests.rotation import SWEEP, plan_run, rotating_cases


class Item:
    """What the selection asks of a test."""

    def __init__(self, nodeid: str, *marks: str, group: str = "", **parameters: Any) -> None:
        self.nodeid, self.callspec = nodeid, SimpleNamespace(params=parameters)
        self._marks = {name: pytest.Mark(name, (), {}, _ispytest=True) for name in marks}
        if group:
            self._marks["rotating"] = pytest.Mark("rotating", (group,), {}, _ispytest=True)

    def get_closest_marker(self, name: str) -> pytest.Mark | None:
        return self._marks.get(name)


def draw_items(kinds: tuple[str, ...] = (), others: tuple[str, ...] = ()) -> list[Any]:
    items = [Item("a.py::quick"), Item("a.py::mixed[quick]"), Item("a.py::long", "slow")]
    items += [Item(f"a.py::mixed[{k}]", "slow") for k in range(7)]
    items += [Item(f"a.py::all[{k}]", "slow", "rotating") for k in range(3)]
    items += [Item(f"b.py::one{k}", "slow", group="together") for k in range(6)]
    items += [Item(f"c.py::sweep[{r}]", name=r) for r in (*kinds, *others)]
    items += [Item(f"c.py::few[{r}]", name=r) for r in (*kinds, *others[: SWEEP - 1])]
    return items


def simulate_runs(cases, count, failed=""):
    record: dict[str, int] = {}
    runs, day = [], random.Random().randrange(10**6)
    for _ in range(count):
        record = plan_run(cases, record, {failed}, day)
        runs.append({name for name, waited in record.items() if not waited})
    return runs


@pytest.mark.parametrize("every", [2, 3, 5])
def test_each_case_has_run_after_so_many_runs(every: int) -> None:
    others = tuple(f"R{k}" for k in range(SWEEP + 2))
    cases = rotating_cases(draw_items(("K",), others), ("K",), others, every)
    assert {name.partition("[")[0][6:] for name in cases} >= {"mixed", "all", "sweep"}
    assert not {"a.py::quick", "a.py::mixed[quick]", "a.py::long", "c.py::sweep[K]"} & {*cases}
    assert not any("few" in name for name in cases)
    runs = simulate_runs(cases, every)
    assert set().union(*runs) == {*cases}
    for run in runs:
        assert any("all" in name for name in run)  # none of its cases is quick
        assert sum("mixed" in name for name in run) <= 7 // every + 1
        assert sum("sweep" in name for name in run) <= len(others) // every + 1


def test_a_case_that_failed_runs_until_it_passes() -> None:
    cases = rotating_cases(draw_items(), (), (), 5)
    assert all("a.py::mixed[3]" in run for run in simulate_runs(cases, 5, "a.py::mixed[3]"))


PROJECT = """
import pytest

MORE = [pytest.param(k, marks=pytest.mark.rotating) for k in range(1, 9)]

@pytest.mark.parametrize("k", [0, *MORE])
def test_number(k):
    assert k != 5

@pytest.mark.rotating
@pytest.mark.parametrize("k", range(4))
def test_quick(k):
    pass
"""


def test_the_record_is_kept_between_runs(pytester: pytest.Pytester) -> None:
    """Real runs of pytest, alone and by pytest-xdist; to collect, or to leave all out, is none."""
    pytester.makeconftest(
        f"import sys\nsys.path.insert(0, {str(ROOT)!r})\n"
        "from tests.rotation import Rotation\n"
        "def pytest_addoption(parser):\n"
        "    parser.addoption('--every', type=int)\n"
        "    parser.addoption('--day', type=int, default=0)\n"
        "def pytest_configure(config):\n"
        "    config.pluginmanager.register(Rotation(config, (), ()), 'rotation')\n"
    )
    pytester.makepyprojecttoml('[tool.pytest.ini_options]\nmarkers = ["rotating"]\n')
    pytester.makepyfile(PROJECT)
    ran: list[set[str]] = []
    for words in ([], ["-n", "2"], ["--collect-only"], ["-k", "absent"], [], []):
        result = pytester.runpytest_subprocess("-v", "--every", "3", *words)
        if {"--collect-only", "-k"} & {*words}:
            continue
        ran.append({word for line in result.outlines for word in line.split() if "::test_" in word})
    assert len(set().union(*ran[:3])) == 13
    assert all(len(names) < 9 for names in ran)
    failed = [any("[5]" in name for name in names) for names in ran]
    assert failed == sorted(failed) and failed[-1]  # never left out once it has failed
    result.stdout.fnmatch_lines(["in rotation (--every 3): * cases ran, * rested, none longer*"])


def test_what_is_longest_is_begun_first() -> None:
    items: list[Any] = [Item(f"tests/{file}::test") for file in ("a.py", LONGEST[0], "b.py")]
    config: Any = SimpleNamespace(getoption=lambda name: None)
    pytest_collection_modifyitems(config, items)
    assert all(any((ROOT / "tests").rglob(file)) for file in LONGEST)
    assert [item.nodeid[6:-6] for item in items] == [LONGEST[0], "a.py", "b.py"]
