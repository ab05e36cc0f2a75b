"""Times in two columns, times that are coarser than rows, a rate over a time column."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import inspect_log
from modeler.core.errors import DataError
from modeler.logs.blocks import open_blocks
from modeler.logs.columns import ColumnRequest, describe_coarse_clock, find_stamp_pairs
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import parse_map_options
from modeler.logs.readers import read_columns
from modeler.regression.read import open_source
from tests.logs.writers import START, joined, stamps
from tests.texts import read_rows

PAIRS = read_rows("""
    sec nanosec time; secs nsecs time; header.stamp.sec header.stamp.nanosec header.stamp;
    stamp_sec stamp_nanosec stamp; tv_sec tv_nsec tv.time;
    /js/header/stamp/sec /js/header/stamp/nanosec /js/header/stamp; stampSec stampNsec stamp
""")


@pytest.mark.parametrize(("seconds", "fraction", "name"), PAIRS)
def test_names_of_seconds_and_nanoseconds(seconds, fraction, name):
    assert find_stamp_pairs(["q1", seconds, fraction]) == {name: (seconds, fraction, 1e-9)}


def test_names_that_are_no_pair():
    assert find_stamp_pairs(["sec", "q_s", "positions", "time_ns", "time", "t_ms", "t_s"]) == {}


def two_columns(table, kind=int):
    """The table with its time in whole seconds, of that kind, and nanoseconds."""
    moments = np.array(stamps(table))
    seconds = (moments // 10**9).astype(kind)
    time = {"header.stamp.sec": seconds, "header.stamp.nanosec": moments % 10**9}
    return time | {name: v for name, v in table.items() if name != "time"}


def csv(path, table, show=repr):
    rows = zip(*(v.tolist() for v in table.values()), strict=True)
    lines = [",".join(table), *(",".join(map(show, row)) for row in rows)]
    path.write_text("\n".join(lines) + "\n")
    return path


def file_of(path, table):
    if path.suffix == ".csv":
        return csv(path, table)
    if path.suffix == ".parquet":
        pq.write_table(pa.table(table), path)
    else:
        np.savez(path, **table)
    return path


@pytest.mark.parametrize("ending", ["csv", "parquet", "npz"])
def test_time_in_two_columns_is_exact(ending, short, tmp_path):
    path = file_of(tmp_path / f"run.{ending}", two_columns(short.table))
    mapping = ["time=header.stamp"]
    time = LogTable(path, parse_map_options(mapping)).read_numbers("time")
    expected = (np.array(stamps(short.table)) - START // 10**9 * 10**9) * 1e-9
    assert np.abs(time - expected).max() < 1e-12  # of a float of 1.7e9 s: 2e-7
    for words in (mapping, ["auto"]):
        short.check(path, words)


@pytest.mark.parametrize("ending", ["csv", "parquet"])
@pytest.mark.parametrize("kind", [int, float])
def test_blocks_of_a_file_count_from_its_first_second(ending, kind, case, tmp_path):
    path = file_of(tmp_path / f"run.{ending}", two_columns(case.table, kind))
    source = open_source(path, case.compiled.spec, parse_map_options(["time=header.stamp"]))
    time = np.concatenate([log.time for log in source.read_blocks(500)])
    assert time[0] == pytest.approx(START % 10**9 * 1e-9, abs=1e-12) and len(time) > 1000
    assert np.diff(time) == pytest.approx(np.diff(case.table["time"]), abs=1e-9)
    window = open_blocks(path).read_window(0.5, 100, ["header.stamp"])
    assert np.isfinite(window.columns[0][1].read_numbers()).all()


def test_two_whole_clocks_are_no_pair(tmp_path):
    rows = np.arange(3000)
    path = csv(tmp_path / "a.csv", {"sec": rows // 1000, "nsec": rows * 10**6, "q1": rows * 1.0})
    with pytest.raises(DataError, match=r"row 1001: got 1 s beside whole seconds; expected less"):
        LogTable(path).read_numbers("time")
    assert LogTable(path, parse_map_options(["time=nsec:ns"])).read_numbers("time")[-1] == 2.999


def test_messages_echoed_without_names(short, tmp_path):
    """`ros2 topic echo --csv`: stamp, frame, names in the order of the driver, numbers."""
    order, moments = (2, 0, 1), np.array(stamps(short.table))
    q, tau = joined(short.table, "q")[:, order], joined(short.table, "tau")[:, order]
    lines = [
        f"{m // 10**9},{m % 10**9},base,{','.join(str(k + 1) + '_joint' for k in order)},"
        + ",".join(map(repr, [*a.tolist(), 0.0, 0.0, 0.0, *b.tolist()]))
        for m, a, b in zip(moments, q, tau, strict=True)
    ]
    path = tmp_path / "echo.csv"
    path.write_text("\n".join(lines) + "\n")
    mapping = ["time=header.stamp", "q<j>=position[{j}_joint]", "tau<j>=effort[{j}_joint]"]
    short.check(path, mapping)
    path.write_text("\n".join(line.partition("base")[0] + "1.5,2.5" for line in lines) + "\n")
    assert [n for n, _ in read_columns(path, ColumnRequest()).columns][-2:] == ["c3", "c4"]


COARSE = [(250.0, 0.01), (250.0, 1.0), (150.0, 0.01), (333.0, 0.1), (1000.0, 0.016), (100.0, 1.0)]


@pytest.mark.parametrize(("rate", "step"), COARSE)
@pytest.mark.parametrize("rounded", [np.floor, np.round])
def test_the_rate_of_a_coarse_clock(rate, step, rounded):
    k, chance = np.arange(int(20 * rate)), np.random.default_rng(3)
    time = step * rounded((k / rate + 0.3712) / step)
    actual = describe_coarse_clock(time, [chance.normal(size=k.size)])
    assert f"to {step:g} s" in actual and actual.endswith(f"give --map rate={rate:g}")


def test_rows_that_are_not_even_have_no_rate():
    chance = np.random.default_rng(4)
    time = np.floor(np.cumsum(chance.exponential(0.004, 3000)) / 0.01) * 0.01
    assert "rows are not even" in describe_coarse_clock(time, [chance.normal(size=3000)])
    twice = np.repeat(np.arange(300), 2)
    assert describe_coarse_clock(0.01 * twice, [twice]) == ""


@pytest.mark.parametrize("step", [0.01, 0.1])
def test_a_coarse_log_is_told_and_its_rate_works(step, case, tmp_path):
    table = {**case.table, "time": step * np.floor(case.table["time"] / step + 1e-9)}
    path = csv(tmp_path / "coarse.csv", table)
    words = rf"times are rounded to {step:g} s and repeat; .* even: give --map rate=1000$"
    for mapping in ((), ["auto"]):
        with pytest.raises(DataError, match=words):
            case.check(path, mapping)
    doubts = inspect_log(path).warnings
    assert any("rows are even" in line for line in doubts)
    assert not any("delete" in line for line in doubts)
    for mapping in (["rate=1000"], ["auto", "rate=1000"], ["time=time", "rate=1000"]):
        log = case.check(path, mapping)
    assert "column time is not used: rows counted at 1000 Hz" in log.reading_notes


def test_a_log_without_times_says_how_to_give_a_rate(tmp_path):
    path = csv(tmp_path / "a.csv", {"q1": np.arange(20.0), "tau1": np.arange(20.0)})
    with pytest.raises(
        DataError, match=r"no column time; .*of even rows their rate, --map rate=HZ"
    ):
        LogTable(path).read_numbers("time")
