"""Logs as programs write them give the numbers of the run."""

import re
from pathlib import Path

import numpy as np
import pytest
import scipy.io
from hypothesis import given, settings, strategies as st

from modeler.core.errors import DataError
from modeler.logs.blocks import open_blocks
from modeler.logs.columns import ColumnRequest
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import build_map
from modeler.logs.readers import read_columns
from tests.logs.programs import KINDS, lerobot, rows_of, sheet, text_of, written
from tests.logs.writers import START
from tests.rotation import rotating

TOLD = {
    "German Excel": "read with ; between columns, decimal commas, in latin-1",
    "LabVIEW": "read with tabs between columns, 22 lines before the names, units in line 18",
    "a controller without names": "read with blanks between columns, no names: columns are called "
    "c1 to c7",
    "TwinCAT Scope": "read with tabs between columns, 5 lines before the names, units in line 9, 2 "
    "lines between names and rows",
    "a recorder without time": "read with 2 lines before the names",
    "times of the day": "read with Clock counted from the first row",
    "a workbook": "read with sheet data, 1 line before the names, units in line 3",
    "a folder of joints": "joint1.tsv and 2 more: read with tabs between columns",
    "a folder of MAT files": "one motion in 3 files: q.mat, t.mat, tau.mat",
    "LeRobot": "time is that of the frames at 1000 Hz, as info.json says; every episode is a "
    "segment",
}
"""What is said of files of some kinds when they are read."""
SELDOM = ("RTDE of Universal Robots", "pandas with an ISO index", "a folder of quantities")
"""Which differ from others in their names only."""
BY_RANGE = ("LeRobot", "a folder of joints")
"""Whose degrees show by the range of a longer motion."""


@pytest.mark.parametrize("name", [*(n for n in KINDS if n not in SELDOM), *rotating(*SELDOM)])
def test_every_kind_gives_the_run_and_its_blocks_the_same_rows(name, case, short, tmp_path):
    kind, run = KINDS[name], case if name in BY_RANGE else short
    (tmp_path / "run").mkdir()
    place = kind.write(tmp_path / "run", run.table)
    whole, blocks = read_columns(place, ColumnRequest()), open_blocks(place)
    assert TOLD.get(name) in (None, *whole.reading_notes)
    run.check(place, kind.words, kind.digits)
    assert (blocks is None) == (place.is_dir() or place.suffix in (".xlsx", ".mcap"))
    if blocks is None:
        return
    parts = list(blocks.read_blocks(60))
    assert len(parts) > 5 and sum(part.rows for part in parts) == whole.rows
    assert abs(blocks.rows - whole.rows) < 0.1 * whole.rows
    for column, values in whole.columns:
        items = [dict(part.columns)[column] for part in parts]
        if values.is_numeric:
            numbers = np.concatenate([f.read_numbers() for f in items])
            assert np.array_equal(numbers, values.read_numbers())
    window = blocks.read_window(0.5, 60)
    assert window.rate == whole.rate
    assert window.units == whole.units and window.reading_notes == whole.reading_notes
    name, seen = window.columns[0][0], window.columns[0][1].read_numbers()
    within = np.isin(dict(whole.columns)[name].read_numbers(), seen)
    assert within.sum() >= len(seen) > 40
    assert 0.3 * whole.rows < np.flatnonzero(within).mean() < 0.7 * whole.rows
    assert blocks.read_window(0.99, 60).rows == pytest.approx(60, abs=12)
    assert [n for n, _ in next(blocks.read_blocks(60, [name])).columns] == [name]


def test_a_whole_number_among_floats_stays_one(tmp_path):
    stamps = [f"{START + k * 1000}" for k in range(20)] + [f"{float(START + 20000):.1f}"]
    path = written(tmp_path / "a.csv", "stamp,q1\n" + "".join(f"{s},1\n" for s in stamps))
    result = dict(read_columns(path, ColumnRequest()).columns)["stamp"].read_numbers()
    assert result == pytest.approx(np.arange(21) * 1000.0, abs=300)  # what a float keeps
    with pytest.raises(DataError, match='row 21: got "never"'):
        LogTable(written(path, path.read_text().replace(stamps[-1], "never"))).read_numbers("stamp")


def test_a_dataset_is_all_its_files(short, tmp_path):
    lerobot(tmp_path, short.table)
    result = read_columns(tmp_path, ColumnRequest())
    columns = dict(result.columns)
    assert result.rows == len(short.table["time"]) and result.rate == 1000
    assert columns["timestamp"].read_numbers() == pytest.approx(short.table["time"], abs=1e-9)
    assert set(columns["segment"].read_numbers()) == {0.0, 1.0}
    assert "action[elbow_flex]" in columns


# One log in several files.


@pytest.mark.parametrize("ending", ["_", ""])
def test_files_of_log_are_read_by_what_they_hold(ending, short, tmp_path):
    """`data/run` + `_q.csv`, or `data/run/` + `q.csv`; columns go by place or by their digits."""
    place = tmp_path / "run"
    if not ending:
        place.mkdir()
    head = str(place) + ("_" if ending else "/")
    rows = rows_of(short.table)
    written(Path(f"{head}q.csv"), "time j1 j2 j3\n" + text_of(rows[:, :4], " "))
    written(Path(f"{head}tau.csv"), text_of(rows[:, 4:], ";", ","))
    files = {"q": f"{ending}q.csv", "tau": f"{ending}tau.csv"}
    short.check(place, {"files": files})
    result = LogTable(place, build_map({"files": files}, "[log]"))
    assert result.names == ("time", "q1", "q2", "q3", "tau1", "tau2", "tau3")
    with pytest.raises(DataError, match=r"there is no file .*other_q\.csv; expected a log, or"):
        LogTable(tmp_path / "other", build_map({"files": {"q": "_q.csv"}}, "[log]"))


@pytest.mark.parametrize("files", [*({"q": end} for end in ("/etc/q", "../q", "_/../../q", 3)), 3])
def test_files_of_log_lie_beside_it(files):
    """A robot file of somebody else names no file elsewhere."""
    with pytest.raises(DataError, match=r"files: got .*expected how the names of the files"):
        build_map({"files": files}, "[log]")


def files(folder, **texts):
    """A folder of CSV files of these texts."""
    for name, text in texts.items():
        written(folder / f"{name}.csv", text)
    return folder


def clock(late=0.0):
    return "time,a\n" + "".join(f"{k * 1e-3 + late:.9f},{k}\n" for k in range(100))


def numbers(rows):
    return "a,b\n" + "".join(f"{k},{k % 7}\n" for k in range(rows))


def test_clocks_a_little_apart_are_one(tmp_path):
    result = read_columns(files(tmp_path, q=clock(), tau=clock(2e-4)), ColumnRequest())
    assert "up to 0.0002 apart: that of q.csv" in result.reading_notes[0]
    assert [name for name, _ in result.columns] == ["time", "q", "tau"]


def test_dates_of_files_are_compared(tmp_path):
    for name, second in (("q", 10), ("tau", 11)):
        lines = [f"2024-05-01 12:00:{second + k / 100:06.3f};{k}" for k in range(50)]
        written(tmp_path / f"{name}.csv", "stamp;a\n" + "\n".join(lines) + "\n")
    with pytest.raises(DataError, match=r"rows in common: q\.csv 0 to 0\.49, tau\.csv 1 to 1\.49"):
        read_columns(tmp_path, ColumnRequest())


NOON = "time,a\n" + "12:00:00,1\n" * 20 + "noon,1\n"
RUN = "time,q1,tau1\n" + "0,1,2\n1,2,3\n" * 20
BROKEN = [
    ({"q": numbers(100), "tau": numbers(90)}, "tau.csv has 90 rows and q.csv 100; expected the sa"),
    ({"q": clock(), "tau": clock(0.7)}, "rows in common: q.csv 0 to 0.099, tau.csv 0.7 to 0.79"),
    ({"mon": RUN, "tue": RUN}, "is in several files, mon"),
    ({"q": NOON, "tau": NOON}, 'column time, row 21: got "noon"; expected a time as in the other'),
    ({}, "is a folder without metadata.yaml, meta/info.json or logs"),
    ({"a": "q1;time\n" + "1;x\n" * 30}, "column time, row 1: got"),
    ({"a": NOON}, 'row 21: got "noon"'),
]


@pytest.mark.parametrize(("texts", "line"), BROKEN)
def test_what_cannot_be_read_is_one_line(tmp_path, texts, line):
    place = files(tmp_path, **texts)
    with pytest.raises(DataError, match=re.escape(line)) as result:
        LogTable(place).read_numbers("time")
    assert "\n" not in str(result.value)


def test_a_damaged_dataset_is_one_line(short, tmp_path):
    path = lerobot(tmp_path, short.table)
    (tmp_path / "meta" / "info.json").write_text("{")
    with pytest.raises(DataError, match=r"info\.json: cannot be read .*; copy the dataset again"):
        read_columns(path, ColumnRequest())


def test_sheets_are_chosen_by_name(short, tmp_path):
    path = sheet(tmp_path, short.table)
    result = read_columns(path, ColumnRequest())
    assert [(s.name, s.is_clock) for s in result.streams] == [("Sheet", False), ("data", True)]
    assert read_columns(path, ColumnRequest("data")).rows == result.rows
    with pytest.raises(DataError, match=r"topic x: no sheet of that name; the sheets are Sheet, d"):
        read_columns(path, ColumnRequest("x"))
    with pytest.raises(DataError, match="no sheet with rows of numbers"):
        read_columns(path, ColumnRequest("Sheet"))


# A rate that the file states.


RATES = [
    ("Sample rate: 2 kHz", 2000.0),
    ("Abtastrate;500,0;Hz", 500.0),
    ("fs = 250 Hz", 250.0),
    ("Delta_X\t0.004", 250.0),
    ("SampleTime[ms];2", 500.0),
    ("cycle time = 4 ms", 250.0),
    ("dt: 1e-3", 1000.0),
    ("Zykluszeit: 8 ms", 125.0),
    ("robot 500, run 3", None),
]


@pytest.mark.parametrize(("line", "rate"), RATES)
def test_a_line_above_tells_the_rate(line, rate, tmp_path):
    path = written(tmp_path / "a.txt", f"{line}\nq1;tau1;x\n" + "0.1;2.5;3\n" * 20)
    result = read_columns(path, ColumnRequest())
    assert result.rate == (None if rate is None else pytest.approx(rate))


@pytest.mark.parametrize(("name", "value"), [("fs", 500), ("dt", 2e-3), ("fps", 500.0)])
@pytest.mark.parametrize("ending", ["mat", "npz"])
def test_a_value_beside_arrays_tells_the_rate(ending, name, value, tmp_path):
    path = tmp_path / f"run.{ending}"
    content = {"q1": np.arange(50.0), "tau1": np.ones(50), name: np.asarray(value)}
    scipy.io.savemat(path, content) if ending == "mat" else np.savez(path, **content)
    table = LogTable(path)
    assert table.read_numbers("time") == pytest.approx(np.arange(50) / 500)
    assert "no time column: rows counted at 500 Hz, as the file says" in table.reading_notes
    stated = LogTable(path, build_map({"rate": 100}, "--map"))
    assert stated.read_numbers("time")[1] == pytest.approx(0.01)


HEADS = [
    (
        "time,Position,,Torque,\n,J1,J2,J1,J2\n",
        ",",
        "",
        ["time", "Position[J1]", "Position[J2]", "Torque[J1]", "Torque[J2]"],
    ),
    ("sep=;\nt;a;b;c;d\n", ";", "", ["t", "a", "b", "c", "d"]),
    ("t;a;b;c;d\n", ";", ";", ["t", "a", "b", "c", "d", "c6"]),
    ("t a   b c   d e   f g   h i\n", "  ", "", ["t a", "b c", "d e", "f g", "h i"]),
    ("0,1,2,3,4\n", ",", "", ["c1", "c2", "c3", "c4", "c5"]),
    ("", ",", "", ["c1", "c2", "c3", "c4", "c5"]),
]


@pytest.mark.parametrize(("head", "delimiter", "end", "names"), HEADS)
def test_heads_of_other_programs(head, delimiter, end, names, tmp_path):
    values = np.arange(100.0).reshape(20, 5) / 8.0
    body = text_of(values, delimiter).replace("\n", f"{end}\n")
    result = read_columns(written(tmp_path / "a.csv", head + body), ColumnRequest())
    assert [name for name, _ in result.columns] == names
    read = np.column_stack([column.read_numbers() for _, column in result.columns[:5]])
    assert (read == values).all()


# Habits of text files, drawn: what was written is what is read.


@settings(max_examples=60, deadline=None)
@given(
    delimiter=st.sampled_from([",", ";", "\t", "|", "  "]),
    comma=st.booleans(),
    title=st.sampled_from([[], ["# run 3"], ["Robot: arm", "Operator: me, myself"]]),
    names=st.sampled_from(["plain", "comment", "none"]),
    units=st.booleans(),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]),
    ends=st.sampled_from(["\n", "\r\n"]),
    width=st.integers(2, 9),
    seed=st.integers(0, 2**31),
)
def test_any_habit_is_read_back(
    tmp_path_factory, delimiter, comma, title, names, units, encoding, ends, width, seed
):
    numbers = np.random.default_rng(seed)
    values = np.round(numbers.normal(size=(40, width)) * 10.0 ** numbers.integers(-3, 4), 5)
    comma = comma and delimiter != ","
    lines = [*title]
    if names != "none":
        lines.append("# " * (names == "comment") + delimiter.join(f"ch{k}" for k in range(width)))
        lines += [delimiter.join(["rad"] * width)] * units
    body = text_of(values, delimiter, "," if comma else ".", 17)
    path = tmp_path_factory.mktemp("habit") / "a.txt"
    written(path, "\n".join([*lines, body]), encoding, ends)
    result = read_columns(path, ColumnRequest())
    first = "c1" if names == "none" else "ch0"
    assert result.columns[0][0] == first and result.rows == 40
    numbers = np.column_stack([c.read_numbers() for _, c in result.columns])
    assert numbers == pytest.approx(values, rel=1e-12)
    named = width if units and names != "none" else 0
    assert dict(result.units) == {f"ch{k}": "rad" for k in range(named)}
