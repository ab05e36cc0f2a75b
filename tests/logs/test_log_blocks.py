"""Parquet and CSV files read block by block: the same rows, and one line for what is wrong."""

import dataclasses
import os
import sys
from decimal import Decimal

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest

from modeler.core.errors import DataError
from modeler.logs.blocks import _TextFile, build_arrow_columns
from modeler.logs.mapping import build_map
from modeler.regression.chunk import cut_window, read_part
from modeler.regression.read import join_logs, open_source, read_log

SIZE = 150


def written(path, columns, group=400):
    table = pa.table(columns)
    if path.suffix == ".csv":
        pa.csv.write_csv(table, path)
    else:
        pa.parquet.write_table(table, path, row_group_size=group)
    return path


COLUMNS = {
    "whole": pa.array([1, -2, 3, 4, 5], pa.int32()),
    "large": pa.array([2**62, 1, 2, 3, 4], pa.int64()),
    "single": pa.array([0.1, 0.2, float("nan"), 0.4, 0.5], pa.float32()),
    "double": pa.array([0.1, float("inf"), 0.3, 0.4, -0.0], pa.float64()),
    "decimal": pa.array([Decimal("1.25"), Decimal("2.50"), None, Decimal("4.00"), None]),
    "missing": pa.array([0.1, None, 0.3, None, 0.5], pa.float64()),
    "none": pa.nulls(5, pa.float64()),
    "no rows": pa.array([], pa.float64()),
}


@pytest.mark.parametrize("name", COLUMNS)
def test_numbers_are_those_of_the_column(name):
    column = COLUMNS[name]
    true = [float("nan") if value is None else float(value) for value in column.to_pylist()]
    for pieces in ([column], [column[:2], column[2:3], column[3:]], [column[:0], column]):
        result = values(build_arrow_columns(pa.table({"x": pa.chunked_array(pieces)})), "x")
        assert result.dtype == float and result.flags.writeable and result.flags.c_contiguous
        np.testing.assert_array_equal(result, true)


def values(columns, name):
    (result,) = [column for item, column in columns.columns if item == name]
    return result.read_numbers()


def log_columns(compiled, rows=3000, seed=1):
    random = np.random.default_rng(seed)
    names = [joint.name for joint in compiled.spec.joints]
    time = np.arange(rows) * 0.01
    return {
        "time": time,
        **{f"q{n}": np.sin(time + k) for k, n in enumerate(names)},
        **{f"tau{n}": random.normal(size=rows) for n in names},
        "temperature": np.where(np.arange(rows) % 700 == 0, 20.0 + time, np.nan),
        "note": random.normal(size=rows),
    }


@pytest.mark.parametrize("ending", [".parquet", ".csv"])
def test_a_source_gives_the_log_that_is_read_whole(ending, tmp_path, case):
    spec = case.compiled.spec
    columns = log_columns(case.compiled)
    columns["tau1"][5:9] = np.nan
    columns["segment"] = np.repeat(np.arange(30.0), 100)
    for name in [joint.name for joint in spec.joints]:
        columns[f"qd{name}"] = columns[f"qdd{name}"] = columns[f"qc{name}"] = columns[f"q{name}"]
    path = written(tmp_path / f"run{ending}", columns)
    whole = read_log(path, spec)
    source = open_source(path, spec)
    parts = list(source.read_blocks(SIZE))
    log = join_logs(parts)
    assert len(parts) > 10 and source.name == whole.name
    for field in dataclasses.fields(whole):
        one, other = getattr(whole, field.name), getattr(log, field.name)
        if isinstance(one, np.ndarray):
            np.testing.assert_array_equal(one, other)
    assert log.torque_source == whole.torque_source and set(log.extra) == {"temperature"}
    assert log.missing["tau1"] == 4
    slow, true = log.extra["temperature"], whole.extra["temperature"]
    assert np.abs(slow - true).max() < 7.1  # a block without a value keeps the last


@pytest.mark.parametrize("ending", [".parquet", ".csv"])
def test_units_rates_and_names_are_mapped_in_blocks(ending, tmp_path, case):
    spec = case.compiled.spec
    columns = log_columns(case.compiled)
    columns = {k: v for k, v in columns.items() if k not in ("time", "temperature", "note")}
    path = written(
        tmp_path / f"run{ending}",
        {
            f"pos{k[1:]}" if k[0] == "q" else k: np.degrees(v) if k[0] == "q" else v
            for k, v in columns.items()
        },
    )
    mapping = build_map({"q<j>": "pos{j} [deg]", "rate": 100.0}, "here")
    whole, log = (
        read_log(path, spec, mapping),
        join_logs(list(open_source(path, spec, mapping).read_blocks(200))),
    )
    np.testing.assert_array_equal(log.time, whole.time)
    np.testing.assert_array_equal(log.q, whole.q)
    np.testing.assert_allclose(log.q[:, 0], columns["q1"], atol=1e-12)


def broken(kind, path, columns):
    """A log with something wrong far behind its beginning."""
    if kind == "time":
        columns["time"][1200] = columns["time"][1199]
    if kind == "border":
        columns["time"][SIZE * 8 :] -= 1.0
    if kind == "temperature":
        columns["temperature"][:2500] = np.nan
    if kind == "no time":
        columns["time"][1500] = np.nan
    path = written(path, columns)
    if kind == "group":
        content = bytearray(path.read_bytes())
        place = len(content) // 2
        content[place : place + 4000] = bytes(range(250)) * 16
        path.write_bytes(content)
    if kind == "entries":
        lines = path.read_text().splitlines()
        lines[2000] = lines[2000].rsplit(",", 2)[0]
        path.write_text("\n".join(lines) + "\n")
    if kind == "word":
        lines = path.read_text().splitlines()
        lines[2000] = ",".join(["oops", *lines[2000].split(",")[1:]])
        path.write_text("\n".join(lines) + "\n")
    return path


WRONG = [
    (".parquet", "time", r"run\.parquet: column time, row 1201: 11\.99 s after 11\.99 s; expected"),
    (".csv", "time", r"run\.csv: column time, row 1201: 11\.99 s after 11\.99 s; expected"),
    (".parquet", "border", r"column time, row 1201: 11 s after 11\.99 s; expected increasing"),
    (".parquet", "no time", r"column time, row 1501: no value"),
    (".parquet", "group", r"run\.parquet: cannot be read as PARQUET beyond row \d+ \(.*; copy it"),
    (".csv", "entries", r"run\.csv: row 2000: got \d+ entries for \d+ columns"),
    (".parquet", "temperature", r"temperature has no values from 0 to 1\.49 s; record"),
    (".csv", "word", r'run\.csv: column time, row 2000: got "oops"; expected a number'),
]


@pytest.mark.parametrize(("ending", "kind", "line"), WRONG)
def test_what_is_wrong_in_the_middle_is_one_line_that_names_the_row(
    ending, kind, line, tmp_path, case
):
    path = broken(kind, tmp_path / f"run{ending}", log_columns(case.compiled))
    source = open_source(path, case.compiled.spec)
    with pytest.raises(DataError, match=line) as result:
        list(source.read_blocks(SIZE))
    assert "\n" not in str(result.value)


@pytest.mark.parametrize("ending", [".parquet", ".csv"])
@pytest.mark.parametrize("what", ["shrinks", "grows", "goes"])
def test_a_file_that_changes_while_it_is_read_is_refused(ending, what, tmp_path, case):
    path = written(tmp_path / f"run{ending}", log_columns(case.compiled))
    blocks = open_source(path, case.compiled.spec).read_blocks(SIZE)
    next(blocks)
    size = path.stat().st_size
    if what == "goes":
        path.unlink()
    else:
        with path.open("r+b") as file:
            os.ftruncate(file.fileno(), size // 2 if what == "shrinks" else size)
            file.seek(0, 2)
            file.write(b"\n" if what == "grows" else b"")
    expected = "was removed while it was read" if what == "goes" else "was written to while it was"
    with pytest.raises(DataError, match=expected):
        list(blocks)


@pytest.mark.parametrize("span", [(3.0, 9.0), (None, 2.0), (25.0, None), (2.0, 2.005)])
def test_a_piece_of_a_long_log_is_that_of_the_whole(span, tmp_path, case, monkeypatch):
    columns = log_columns(case.compiled)
    columns["tau2"][100:104] = np.nan
    del columns["note"], columns["temperature"]
    path = written(tmp_path / "run.parquet", columns)
    for where in ("chunk", "log"):
        monkeypatch.setattr(sys.modules[f"modeler.regression.{where}"], "FINGER", 256)
    monkeypatch.setattr("modeler.regression.log.LONG", 500)
    spec = case.compiled.spec
    whole = cut_window(read_log(path, spec), *span)
    piece = read_part(open_source(path, spec), spec, *span)
    for name in ("name", "content", "notes", "missing", "torque_source"):
        assert getattr(piece, name) == getattr(whole, name), name
    for name in ("time", "q", "tau"):
        np.testing.assert_array_equal(getattr(piece, name), getattr(whole, name))
    with pytest.raises(DataError, match=r"no rows from 50 to 60 s; its times go from 0 to 29\.99"):
        read_part(open_source(path, spec), spec, 50.0, 60.0)
    with pytest.raises(DataError, match="window 5:4, which ends before it starts"):
        read_part(open_source(path, spec), spec, 5.0, 4.0)


def test_the_text_may_go_while_arrow_parses_it(tmp_path, monkeypatch):
    """What is Python's, a thread of Arrow lets go at the end of the process, which that aborts."""
    place, text = tmp_path / "a.csv", bytearray(b"1,2\n3,4\n")
    place.write_text("time,q1\n1,2\n")
    read = pa.csv.read_csv

    def gone(source, *how):
        text.clear()  # BufferError where the source is this memory
        return read(source, *how)

    monkeypatch.setattr(pa.csv, "read_csv", gone)
    table = _TextFile(place).parse_columns(text)
    np.testing.assert_array_equal(values(table, "q1"), [2.0, 4.0])
