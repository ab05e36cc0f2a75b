"""`modeler log`: warnings about a log that is spoilt in a known way, and no other warning."""

import json
import tomllib

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.logs.inspect import inspect_table
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import LogMap, build_map
from modeler.simulation import SimulationSettings
from modeler.views.log import draw_log_pictures
from tests.logs.writers import parquet


@pytest.fixture
def plain(case):
    """Time, positions, their speeds and torques in our names and SI units."""
    table = {"time": case.table["time"]}
    for j in "123":
        table[f"q{j}"] = case.table[f"q{j}"]
        table[f"qd{j}"] = np.gradient(table[f"q{j}"], table["time"])
        table[f"tau{j}"] = case.table[f"tau{j}"]
    return table


@pytest.fixture
def table(plain):
    """Four times as far: positions and speeds in degrees, torques."""
    table = {"time": plain["time"]}
    for items, name, factor in (("q", "pos", 4.0), ("qd", "vel", 4.0), ("tau", "tau", None)):
        for j in "123":
            values = plain[f"{items}{j}"]
            table[f"{name}_{j}"] = values.copy() if factor is None else factor * np.rad2deg(values)
    return table


@pytest.fixture
def inspected(tmp_path):
    """What is found in a table."""
    return lambda table: inspect_table(LogTable(parquet(tmp_path / "run.parquet", table)), LogMap())


@pytest.fixture
def log_output(run, tmp_path):
    """What the command shows of a table: as JSON, and on stdout."""

    def log_output(table, *words):
        path = parquet(tmp_path / "run.parquet", table)
        status, out, err = run("log", path, *words, "--json", tmp_path / "log.json")
        assert (status, err) == (0, "")
        return json.loads((tmp_path / "log.json").read_text()), out

    return log_output


def test_what_is_in_a_log_and_the_suggestion_serves_as_a_mapping(log_output, tmp_path, table):
    raw, out = log_output(table)
    assert raw["log"] == "run.parquet" and raw["rows"] == len(table["time"])
    assert raw["clock"]["rate"] == pytest.approx(1000.0)
    assert raw["clock"]["duration"] == pytest.approx(2.499)
    clock = raw["clock"]
    assert clock["gaps"] == clock["repeated_steps"] == clock["backward_steps"] == 0
    first = next(c for c in raw["channels"] if c["name"] == "pos_1")
    assert first["low"] == pytest.approx(table["pos_1"].min())
    assert (first["unit"], first["is_unit_guessed"]) == ("deg", True)
    assert "even, no gaps, no time twice" in out
    assert raw["warnings"] == ["pos_* looks like deg, by its range; say so in [log] or with --map"]
    assert raw["suggested_map"].splitlines()[1:] == [
        '"q<j>" = "pos_{j} [deg]"  # by its range',
        '"qd<j>" = "vel_{j}"',
        '"tau<j>" = "tau_{j}"',
    ]
    (tmp_path / "map.toml").write_text(raw["suggested_map"])
    raw, _ = log_output(table, "--map", tmp_path / "map.toml", "--robot", "demo-arm")
    names = [channel["name"] for channel in raw["channels"]]
    assert "pos_2 (q2)" in names and "tau_3 (tau3)" in names
    assert raw["suggested_map"] == ""


def test_gaps_repeats_and_steps_back(inspected, table):
    subset = np.delete(np.arange(len(table["time"])), np.r_[100:103, 2000])
    clock = inspected({name: values[subset] for name, values in table.items()}).clock
    assert (clock.gaps, clock.lost_rows) == (2, 4)
    assert (clock.largest_gap, clock.largest_gap_start) == pytest.approx((0.004, 0.099))
    table["time"] = table["time"].copy()
    table["time"][50] = table["time"][49]
    table["time"][70:] -= 0.5
    doubts = "\n".join(inspected(table).warnings)
    assert "time decreases in 1 rows" in doubts and "time is repeated in 1 rows" in doubts


def test_jitter_and_a_clock_that_ticks(inspected, table, plain):
    """Steps of 10 and 12 ms of a clock of 2 ms are as even as that clock can say."""
    rng, n = np.random.default_rng(1), len(table["time"])
    table["time"] = table["time"] + 1e-4 * rng.standard_normal(n)
    report = inspected(table)
    assert report.clock.jitter == pytest.approx(0.1 * np.sqrt(2.0), rel=0.1)
    assert any("is not uniform" in doubt for doubt in report.warnings)
    plain["time"] = np.cumsum(np.where(np.arange(n) % 3 == 0, 0.012, 0.010))
    report = inspected({k: v for k, v in plain.items() if not k.startswith("qd")})
    assert report.warnings == () and report.clock.jitter > 0.05
    assert report.clock.tick == pytest.approx(0.002)


SPOILT = [
    ("vel_2", lambda t: -t["vel_2"], "vel_2 has the other sign of the derivative of pos_2"),
    ("vel_2", lambda t: np.deg2rad(t["vel_2"]), "pos_2 in deg and vel_2 in rad/s?"),
    ("vel_2", lambda t: t["vel_2"] / 6.0, "pos_2 in deg and vel_2 in rpm?"),
    ("vel_2", lambda t: t["vel_3"], "vel_2 is the derivative of pos_3, not of pos_2"),
    ("vel_2", lambda t: np.sin(99.0 * t["time"]), "vel_2 is not the derivative of pos_2"),
    ("vel_2", lambda t: 3.0 * t["vel_2"], "vel_2 is 3 times the derivative of pos_2"),
    ("tau_1", lambda t: 0.0 * t["tau_1"], "tau_1 never changes: is it connected?"),
    ("tau_1", lambda t: 1e3 * t["tau_1"], "tau_1 looks like mN m, by its range"),
    ("time", lambda t: 1e3 * t["time"], "time looks like ms, by its range"),
    ("time", lambda t: 1e6 * t["time"], "time looks like us, by its range"),
    ("i_1", lambda t: 100.0 * t["tau_1"], "i_1 looks like mA, by its range"),
    ("pos_1", lambda t: np.round(1e4 * t["pos_1"]), "vel_1 is 0.0001 times the derivative"),
]


@pytest.mark.parametrize(("name", "change", "words"), SPOILT)
def test_doubts_by_what_was_spoilt(inspected, table, name, change, words):
    table[name] = change(table)
    assert words in "\n".join(inspected(table).warnings)


def test_resolution_limits_and_missing_values(inspected, table):
    step = 0.5
    table["pos_1"] = step * np.round(table["pos_1"] / step)
    top = np.quantile(table["tau_2"], 0.9)
    table["tau_2"] = np.minimum(table["tau_2"], top)
    table["tau_3"][40:47] = np.nan
    by = {channel["name"]: channel for channel in inspected(table).to_json()["channels"]}
    assert by["pos_1"]["resolution"] == pytest.approx(step) and by["tau_1"]["resolution"] is None
    encoder = 4.0 * 360.0 / SimulationSettings().encoder_counts  # deg
    assert by["pos_2"]["resolution"] == pytest.approx(encoder, rel=1e-6)
    ((end, share),) = by["tau_2"]["limits"]
    assert end == pytest.approx(top) and share == pytest.approx(0.1, abs=0.03)
    assert by["tau_3"]["missing_rows"] == 7 and by["tau_1"]["limits"] == by["tau_3"]["limits"] == []


def test_a_robot_tells_more(log_output, plain):
    assert log_output(plain, "--robot", "demo-arm")[0]["warnings"] == []
    plain["tau2"] = -plain["tau2"]
    doubts = "\n".join(log_output(plain, "--robot", "demo-arm")[0]["warnings"])
    assert "joint 2" in doubts and "sign" in doubts
    del plain["tau3"]
    doubts = log_output(plain, "--robot", "demo-arm")[0]["warnings"]
    assert any("as a log of demo-arm it cannot be fitted: " in line for line in doubts)


def test_a_guess_that_fits_worse_is_dropped(log_output, inspected, plain):
    """Without speeds a far way looks like degrees; the fit of the log as it stands clears it."""
    table = {name: v for name, v in plain.items() if not name.startswith("qd")}
    table["q1"] = table["q1"] + 4.0 * np.pi  # joint 1 turns about the vertical: gravity is blind
    assert "q1 looks like deg" in "\n".join(inspected(table).warnings)
    raw, _ = log_output(table, "--robot", "demo-arm")
    assert raw["warnings"] == [] and raw["suggested_map"] == ""


def test_a_joint_that_turns_on_is_in_rad_if_its_speed_agrees(inspected, plain):
    """12 rad is no degree where the speed is its derivative: units of both agree, and it turns."""
    factor = 4.0 / np.ptp(plain["q1"])
    plain["q1"], plain["qd1"] = factor * plain["q1"] + 9.0, factor * plain["qd1"]
    report = inspected(plain)
    assert report.warnings == () and report.suggested_map == ""


@pytest.mark.parametrize(("local", "unit"), [("q", "deg"), ("tau", "mN m")])
def test_only_the_joint_of_another_unit_is_named(inspected, plain, local, unit):
    table = {name: v for name, v in plain.items() if not name.startswith("qd")}
    table[f"{local}2"] = table[f"{local}2"] * (np.rad2deg(4.0) if local == "q" else 1e3)
    report = inspected(table)
    assert [line.split(" looks")[0] for line in report.warnings] == [f"{local}2"]
    assert tomllib.loads(report.suggested_map)["log"] == {f"{local}2": f"{local}2 [{unit}]"}


def test_a_joint_at_rest_is_no_doubt(inspected, plain):
    rng = np.random.default_rng(4)
    n = len(plain["time"])
    plain["q2"] = 1.0 + 1e-4 * rng.integers(-1, 2, n)
    plain["qd2"] = 1e-4 * np.round(10.0 * rng.standard_normal(n))
    plain["q3"], plain["qd3"] = 0.5 + 1e-4 * rng.integers(0, 2, n), np.zeros(n)
    assert inspected(plain).warnings == ()


def test_speeds_of_some_joints_are_checked(inspected, plain):
    del plain["qd1"]
    plain["qd3"] = -plain["qd3"]
    assert inspected(plain).warnings == ("qd3 has the other sign of the derivative of q3",)


def test_what_is_not_recognised_is_a_doubt(inspected, plain):
    report = inspected({"time": plain["time"], "foo": plain["q1"], 'b"ar': plain["tau1"]})
    assert "no columns look like positions or torques" in report.warnings[0]
    assert '"foo"' in report.suggested_map and '# "q<j>"' in report.suggested_map
    build_map(tomllib.loads(report.suggested_map)["log"], "suggested")


@pytest.mark.rotating("long tests of logs")
def test_page_pictures_and_windows(run, tmp_path, table):
    table["<img src=x>_1"] = table["tau_1"]
    path = parquet(tmp_path / "run.parquet", table)
    words = ["log", f"{path}@1:2", "--report", tmp_path / "page.html", "--picture", tmp_path / "p"]
    status, out, _ = run(*words)
    assert status == 0
    assert out.startswith("run.parquet: 1000 rows") and "written: " in out
    page = (tmp_path / "page.html").read_text()
    assert "What is in run.parquet" in page and "pos_*" in page and len(page) < 1_000_000
    assert "<img src=x>" not in page
    assert {p.name for p in (tmp_path / "p").iterdir()} >= {"clock.png", "clock.csv"}
    status, _, err = run("log", f"{path}@90:91")
    assert status == 1 and "fewer than two rows from 90 to 91 s" in err


NAMES = ("time", "t [ms]", "q1", "qd1", "pos_1", "pos[2]", "i_1", "x", "temp", 'a"b', "x\\y", "{j}")


def odd(rng, n):
    """A column as a broken logger leaves it."""
    t = np.arange(n) * 10.0 ** rng.integers(-9, 9)
    columns = (
        *(t, t[::-1], rng.normal(size=n), np.full(n, np.nan), np.full(n, 1.5)),
        *(np.where(rng.random(n) < 0.5, np.nan, rng.normal(size=n)), 1e300 * rng.normal(size=n)),
        *(np.full(n, np.inf), np.round(1e4 * rng.normal(size=n)), 1e-310 * np.sin(t)),
    )
    return columns[rng.integers(10)]


def test_whatever_is_in_it_is_told(tmp_path):
    """JSON without NaN, a suggestion that is TOML, pictures; or one line."""
    rng = np.random.default_rng(5)
    for _ in range(150):
        names = rng.choice(NAMES, size=rng.integers(1, 7), replace=False)
        n = int(rng.choice([10, 60]))
        path = parquet(tmp_path / "run.parquet", {str(name): odd(rng, n) for name in names})
        try:
            seen = inspect_table(LogTable(path), LogMap())
        except DataError as error:
            assert "\n" not in str(error)
            continue
        json.dumps(seen.to_json(), allow_nan=False)
        assert draw_log_pictures(seen) or len(names) == 1
        if seen.suggested_map:
            build_map(tomllib.loads(seen.suggested_map)["log"], "suggested")
