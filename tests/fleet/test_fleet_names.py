"""Which machine and period a log is of, and when that was."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.validation.fleet_drift import arrange_by_time, parse_date
from modeler.validation.fleet_logs import make_natural_key, name_logs, read_log_list
from tests.fleet.machines import Scene, summaries
from tests.rotation import with_cases


def named(*places: str, name: str | None = None) -> list[tuple[str, str]]:
    result = name_logs([(place, "") for place in places], name)
    return [(log.machine, log.period) for log in result]


def test_the_folder_is_the_machine_and_the_file_the_period() -> None:
    places = ("plant/r10/day2.csv", "plant/r2/day10.csv", "plant/r2/day9.parquet")
    assert named(*places) == [("r2", "day9"), ("r2", "day10"), ("r10", "day2")]
    here = Path.cwd().name
    assert named("a.csv") == [(here, "a")] == named("./a.csv")


def test_windows_of_one_file_are_periods() -> None:
    result = name_logs([("r1/a.csv", "0:5"), ("r1/a.csv", "5:10")])
    assert [log.period for log in result] == ["a@0:5", "a@5:10"]
    assert [log.place for log in result] == ["r1/a.csv@0:5", "r1/a.csv@5:10"]


def test_patterns() -> None:
    for pattern, place, machine, period in (
        ("{machine}-{period}.csv", "x/r1-3.csv", "r1", "3"),
        ("{period}/{machine}.*", "2026-03-01/r1.parquet", "r1", "2026-03-01"),
        ("{machine}/logs/*_{period}.csv", "p/r1/logs/run_7.csv", "r1", "7"),
        ("/{machine}/{period}.csv", "/r1/3.csv", "r1", "3"),
        ("day{period}.csv", "r5/day3.csv", "r5", "3"),
    ):
        assert named(place, name=pattern) == [(machine, period)]


@with_cases(
    "pattern, text",
    ("{robot}.csv", "--name {robot}.csv: got {robot}, which says nothing; expected {machine}"),
    ("{machine}{machine}", "got {machine}, twice; expected {machine} and {period}, each once"),
    ("{machine}.csv", "--name {machine}.csv: no {period} stands in it; expected one, as in"),
    ("run.csv", "--name run.csv: neither {machine} nor {period} stands in it; expected"),
    ("{machine}_{period}.csv", "r1/a.csv: does not fit --name {machine}_{period}.csv"),
)
def test_bad_patterns(pattern: str, text: str) -> None:
    with pytest.raises(DataError, match=re.escape(text)):
        named("r1/a.csv", name=pattern)


def test_two_logs_of_one_machine_and_period() -> None:
    text = "x/r1/a.csv: machine r1, period a, which r1/a.csv is too; expected one log each; rename"
    with pytest.raises(DataError, match=re.escape(text)):
        named("r1/a.csv", "x/r1/a.csv")


def test_lists(tmp_path: Path) -> None:
    tables = [
        f'[[log]]\nmachine = "r1"\nperiod = "{p}"\nlog = "{log}"\n'
        for p, log in (("b", "x/1.csv"), ("a", "2.csv"))
    ]
    rows = "machine, period, log\nr1, b, x/1.csv\nr1, a, 2.csv\n"
    for name, text in (("logs.csv", rows), ("logs.toml", "".join(tables))):
        (tmp_path / name).write_text(text)
        result = read_log_list(tmp_path / name)
        assert [(log.machine, log.period) for log in result] == [("r1", "a"), ("r1", "b")]
        assert [log.place for log in result] == [str(tmp_path / p) for p in ("2.csv", "x/1.csv")]


@with_cases(
    "name, text, message",
    ("l.csv", "machine,log\nr1,a.csv\n", "l.csv: no column period in its first line"),
    ("l.csv", "machine,period,log\nr1,,a.csv\n", "l.csv, line 2: no period; expected machine"),
    ("l.csv", "machine,period,log\n", "l.csv: no logs in it; expected rows of machine"),
    ("l.csv", "machine,period,log\nr1,a,x\nr1,a,y\n", "y: machine r1, period a, which"),
    ("l.toml", "log = 3\n", "l.toml: log is no list of tables; expected [[log]]"),
    ("l.toml", "[[log]\n", "expected TOML with [[log]] tables"),
    ("l.toml", '[[log]]\nmachine = "a"\n', "l.toml, log 1: no period"),
    ("l.csv", b"\xff\xfe\x00", "l.csv: no text; expected a list of logs"),
    ("l.csv", None, "l.csv: cannot be read (No such file or directory)"),
)
def test_bad_lists(tmp_path: Path, name: str, text: str | bytes | None, message: str) -> None:
    if text is not None:
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(DataError, match=re.escape(message)):
        read_log_list(tmp_path / name)


def test_natural_order() -> None:
    assert sorted(["d10", "d9", "d", "c11"], key=make_natural_key) == ["c11", "d", "d9", "d10"]


def test_dates_in_names() -> None:
    for period, text in {
        "2026-03-01": "2026-03-01 00:00",
        "run_20260301_0930": "2026-03-01 09:30",
        "2026.03.01 at x": "2026-03-01 00:00",
        "2026-13-01": None,
        "day3": None,
        "120260301": None,
    }.items():
        result = parse_date(period)
        assert (None if result is None else f"{result:%Y-%m-%d %H:%M}") == text


def test_periods_are_in_time() -> None:
    """Dates, else clocks that do not overlap, else names."""
    plain = summaries(Scene(machines=1, periods=3), 2)
    logs, at, unit = arrange_by_time(plain)  # day1 ..., all clocks from 0
    assert unit == "periods" and at.tolist() == [0.0, 1.0, 2.0]
    dated = [
        replace(log, log_name=replace(log.log_name, period=f"2026-03-{day:02d}"))
        for log, day in zip(plain, (9, 2, 1), strict=True)
    ]
    logs, at, unit = arrange_by_time(dated)
    assert unit == "days" and at.tolist() == [0.0, 1.0, 8.0] and [*logs] == dated[::-1]
    clocked = [
        replace(log, span=(86400.0 * day, 86400.0 * day + 12.0))
        for log, day in zip(plain, (3, 0, 1), strict=True)
    ]
    logs, at, unit = arrange_by_time(clocked)
    assert unit == "days" and np.allclose(at, [0.0, 1.0, 3.0]) and logs[0] is clocked[1]
