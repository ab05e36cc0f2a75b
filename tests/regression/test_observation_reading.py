"""Logs from files: what is read, and what is said of a wrong one."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.regression.chunk import cut_window
from modeler.regression.log import has_shared_rows
from modeler.regression.read import read_log
from tests.logs.writers import parquet
from tests.oracles.numpy_model import planar_arm, slider
from tests.rotation import rotating


def columns(n=50, joints=2):
    t = np.arange(n) / 100.0
    table = {"time": t}
    for j in range(1, joints + 1):
        table[f"q{j}"] = np.sin(j * t)
        table[f"tau{j}"] = np.cos(j * t) + j
    return table


def write(path, table):
    table = {name: np.asarray(values) for name, values in table.items()}
    if path.suffix == ".parquet":
        return parquet(path, table)
    path.write_text("\n".join(csv_lines(table)) + "\n")
    return path


def csv_lines(table, comma=",", quote=""):
    """Header and rows; as many spreadsheets and loggers write them."""
    rows = [comma.join(str(v) for v in row) for row in zip(*table.values(), strict=True)]
    return [comma.join(f"{quote}{name}{quote}" for name in table), *rows]


@pytest.fixture
def spec():
    return planar_arm().spec


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_the_values_arrive_in_joint_order(tmp_path, spec, suffix):
    table = columns()
    shuffled = {name: table[name] for name in ("tau2", "q2", "time", "q1", "tau1")}
    shuffled["temperature1"] = np.linspace(20, 30, 50)
    log = read_log(write(tmp_path / f"run{suffix}", shuffled), spec)
    np.testing.assert_allclose(log.q, np.column_stack([table["q1"], table["q2"]]))
    np.testing.assert_allclose(log.tau, np.column_stack([table["tau1"], table["tau2"]]))
    np.testing.assert_allclose(log.extra["temperature1"], shuffled["temperature1"])
    assert log.name == f"run{suffix}" and log.rows == 50 and log.qd is None and not log.missing
    assert log.step == pytest.approx(0.01)


def test_torque_goes_before_current_and_current_needs_the_gain(tmp_path):
    table = columns(joints=1) | {"current1": np.arange(50.0)}
    gained = slider(gain=35.0).spec
    both = read_log(write(tmp_path / "both.csv", table), gained)
    np.testing.assert_allclose(both.tau[:, 0], table["tau1"])
    np.testing.assert_allclose(both.extra["current1"], table["current1"])
    del table["tau1"]
    path = write(tmp_path / "current.csv", table)
    log = read_log(path, gained)
    np.testing.assert_allclose(log.tau[:, 0], 35.0 * table["current1"])
    assert log.torque_source == ("current1 x 35",)
    with pytest.raises(DataError, match=r"current\.csv: current1 .*\[drive_gains\] 1 = "):
        read_log(path, slider().spec)


def test_a_passive_joint_needs_its_position_but_no_torque(tmp_path):
    passive = planar_arm(passive=(1,)).spec
    table = columns()
    del table["tau2"]
    log = read_log(write(tmp_path / "a.csv", table), passive)
    assert np.all(log.tau[:, 1] == 0.0) and log.torque_source[1] == "0 (passive)"
    del table["q2"]
    with pytest.raises(DataError, match=r"no column q2: joint 2 .* is passive"):
        read_log(write(tmp_path / "b.csv", table), passive)


def test_missing_values_stay_in_their_rows_and_are_counted(tmp_path, spec):
    table = columns()
    table["q1"][3:6] = np.nan
    table["tau2"][10] = np.inf
    for suffix in (".csv", ".parquet"):
        log = read_log(write(tmp_path / f"gappy{suffix}", table), spec)
        assert log.missing == {"q1": 3, "tau2": 1}
        assert cut_window(log, float(log.time[5]), None).missing == {"q1": 1, "tau2": 1}
        assert log.rows == 50 and np.isnan(log.q[3:6, 0]).all() and np.isnan(log.tau[10, 1])


def test_temperatures_between_logged_values_lie_on_a_line(tmp_path, spec):
    table = columns() | {"temperature1": np.linspace(20.0, 30.0, 50), "current9": np.ones(50)}
    table["temperature1"][np.arange(50) % 10 != 0] = np.nan
    log = read_log(write(tmp_path / "run.csv", table), spec)
    assert np.allclose(log.extra["temperature1"][:41], np.linspace(20.0, 30.0, 50)[:41])
    assert any("temperature1 has no value in 45 of 50 rows" in line for line in log.reading_notes)
    table["temperature1"][:] = np.nan
    with pytest.raises(DataError, match="temperature1 has no values; record it, or drop"):
        read_log(write(tmp_path / "none.parquet", table), spec)


def test_partly_logged_velocities_are_not_used_and_it_is_said(tmp_path, spec):
    table = columns() | {"qd1": np.ones(50), "qc1": np.ones(50), "qc2": np.ones(50)}
    log = read_log(write(tmp_path / "a.csv", table), spec)
    assert log.qd is None and log.commanded is not None
    assert any("qd2 missing" in line for line in log.reading_notes)


def test_doubts_are_noted(tmp_path, spec):
    table = columns()
    table["time"] = table["time"] * 1000.0
    table["q1"] = np.linspace(0, 180, 50)
    table["tau2"] = np.full(50, 2.5)
    table["comment"] = np.array(["x"] * 50)
    log = read_log(write(tmp_path / "a.csv", table), spec)
    notes = " | ".join(log.notes)
    for words in ("in seconds", "q1 spans 180", "joint 2 never changes"):
        assert words in notes
    assert any("comment not numeric" in line for line in log.reading_notes)


def changed(**new):
    table = columns() | new
    return {name: values for name, values in table.items() if values is not None}


BAD = {
    "no time": (changed(time=None), "no column time"),
    "no position": (changed(q2=None), "no column q2; the columns are time, q1"),
    "no torque": (changed(tau2=None), "no column tau2 or current2: joint 2"),
    "text": (changed(q1=["zero", *[0.5] * 49]), 'column q1, row 1: got "zero"; expected a number'),
    "text torque": (changed(tau1=[*["1"] * 9, "n/a?", *["1"] * 40]), 'tau1, row 10: got "n/a?"'),
    "text segment": (changed(segment=["a"] * 50), 'column segment, row 1: got "a"'),
    "back": (changed(time=[*range(30), 29, *range(31, 50)]), "time, row 31: 29 s after 29 s"),
    "no time value": (changed(time=[0.0, np.nan, *range(2, 50)]), "column time, row 2: no value"),
    "no segment": (changed(segment=[np.nan] * 50), "column segment, row 1: no value"),
    "all missing": (changed(tau1=[np.nan] * 50), "torque of joint 1 has no values"),
    "no positions": (changed(q1=[np.nan] * 50), "q1 has no values"),
    "no effort": (changed(tau1=[0.0] * 50, tau2=[0.0] * 50), "every measured torque is 0"),
    "few": ({n: v[:6] for n, v in columns().items()}, "6 rows; expected at least 10"),
}


@pytest.mark.parametrize("case", BAD)
@pytest.mark.parametrize("suffix", [".csv", *rotating(".parquet")])
def test_wrong_tables_say_file_column_and_row(tmp_path, spec, case, suffix):
    table, words = BAD[case]
    path = write(tmp_path / f"bad{suffix}", table)
    with pytest.raises(DataError) as error:
        read_log(path, spec)
    assert words in str(error.value) and str(path) in str(error.value)


def test_wrong_files(tmp_path, spec):
    with pytest.raises(DataError, match=r"a log ends in \.parquet or \.csv, .*got \"\.xyz\""):
        read_log(tmp_path / "run.xyz", spec)
    with pytest.raises(DataError, match=r"none\.csv: there is no such file"):
        read_log(tmp_path / "none.csv", spec)
    (tmp_path / "not.parquet").write_text("time,q1\n")
    with pytest.raises(DataError, match="cannot be read as PARQUET"):
        read_log(tmp_path / "not.parquet", spec)
    (tmp_path / "ragged.csv").write_text("time,q1\n1,2\n1,2,3\n")
    with pytest.raises(DataError, match="row 2: got 3 entries for 2 columns"):
        read_log(tmp_path / "ragged.csv", spec)
    (tmp_path / "twice.csv").write_text("time,q1,q1\n" + "1,2,3\n" * 20)
    with pytest.raises(DataError, match="column q1 appears 2 times"):
        read_log(tmp_path / "twice.csv", spec)


def test_a_column_of_another_kind_is_named_with_its_kind(tmp_path, spec):
    table = columns()
    table["q1"] = np.array(["2020-01-01"] * 50, dtype="datetime64[D]")
    with pytest.raises(DataError, match="column q1 holds dates or times of day"):
        read_log(write(tmp_path / "a.parquet", table), spec)


FOREIGN = {
    "commas for both": (
        b"time,q1,tau1\n" + b"0,1,2,5,3,5\n" * 20,
        r"row 1: got 6 entries for 3 columns; .* decimal points",
    ),
    "quoted decimal commas": (
        b"time,q1,tau1\n" + b'"0,1","2,5","3,5"\n' * 20,
        r'column time, row 1: got "0,1"; expected a number with a decimal point',
    ),
    "zeros": (
        b"time,q1,tau1\n" + b"1,2,3\n" * 20 + bytes(4),
        "line 22 holds bytes that are not text",
    ),
}


@pytest.mark.parametrize("case", FOREIGN)
def test_csv_of_other_habits_says_what_to_change(tmp_path, spec, case):
    content, words = FOREIGN[case]
    path = tmp_path / "foreign.csv"
    path.write_bytes(content)
    with pytest.raises(DataError, match=words) as error:
        read_log(path, spec)
    assert str(error.value).startswith(f"{path}: ")


@pytest.mark.parametrize(
    ("comma", "quote", "before"), [(", ", '"', "\n\n"), (" , ", "'", "\ufeff")]
)
def test_quotes_and_blanks_around_names_do_not_matter(tmp_path, spec, comma, quote, before):
    table, path = columns(), tmp_path / "a.csv"
    path.write_text(before + "\n".join(csv_lines(table, comma, quote)), encoding="utf-8")
    log = read_log(path, spec)
    np.testing.assert_array_equal(log.q, np.column_stack([table["q1"], table["q2"]]))
    assert not log.extra


def test_a_text_column_in_another_encoding_is_left_out(tmp_path, spec):
    head, *rows = csv_lines(columns())
    text = "\n".join([f"{head},note", *(f"{row},gr\u00fcn" for row in rows)])
    (tmp_path / "a.csv").write_bytes(text.encode("latin-1"))
    assert any(
        "note not numeric" in line for line in read_log(tmp_path / "a.csv", spec).reading_notes
    )


def test_the_fingerprint_tells_measurements_and_not_files(tmp_path, spec):
    table = columns() | {"temperature": np.linspace(20, 30, 50)}
    table["q1"][3] = np.nan
    first = read_log(write(tmp_path / "a.csv", table), spec)
    copy = read_log(write(tmp_path / "b.parquet", table), spec)
    assert copy.content == first.content and len(first.content) == 64
    piece = cut_window(copy, 0.1, 0.2)
    assert piece.content == first.content
    seen = {first.content}
    for name in ("time", "q1", "q2", "tau1", "tau2"):
        other = {column: values.copy() for column, values in table.items()}
        other[name][-1] += 1e-9
        seen.add(read_log(write(tmp_path / "c.parquet", other), spec).content)
    assert len(seen) == 6
    assert has_shared_rows(piece, first.content, 0.15, 0.16)
    assert not has_shared_rows(piece, first.content, 0.2, 0.3)
    assert not has_shared_rows(piece, "another", 0.15, 0.16)
    nameless = dataclasses.replace(piece, content="")
    assert not has_shared_rows(nameless, "", 0.15, 0.16)


def test_a_speck_is_nothing(tmp_path, spec):
    """The squares of such numbers underflow, and their inverses overflow."""
    table = columns()
    table["tau1"] = 3.5e-177 * table["tau1"]
    assert not read_log(write(tmp_path / "run.parquet", table), spec).tau[:, 0].any()
