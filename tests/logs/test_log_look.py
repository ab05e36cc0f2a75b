"""`modeler log`: what is told of a log that somebody has spoilt in a known way."""

import json
import tomllib

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.errors import DataError
from modeler.logs.inspect import inspect_log
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import LogMap, map_from_table
from modeler.report.log import log_pictures
from modeler.simulation import SimulationSettings
from tests.logs import writers
from tests.logs.writers import parquet


@pytest.fixture
def table(case):
    """Positions and speeds in degrees, torques, a current in mA."""
    t = case.table["time"]
    found = {"time": t}
    for j in "123":
        found[f"pos_{j}"] = 4.0 * np.rad2deg(case.table[f"q{j}"])
    for j in "123":
        found[f"vel_{j}"] = np.gradient(found[f"pos_{j}"], t)
    for j in "123":
        found[f"tau_{j}"] = case.table[f"tau{j}"]
    return found


def seen(capsys, tmp_path, table, *words):
    path = parquet(tmp_path / "run.parquet", table)
    status = main(["log", str(path), *map(str, words), "--json", str(tmp_path / "log.json")])
    out, err = capsys.readouterr()
    assert (status, err) == (0, "")
    return json.loads((tmp_path / "log.json").read_text()), out


def test_what_is_in_a_log(capsys, tmp_path, table):
    raw, out = seen(capsys, tmp_path, table)
    assert raw["log"] == "run.parquet" and raw["rows"] == len(table["time"])
    assert raw["clock"]["rate"] == pytest.approx(1000.0)
    assert raw["clock"]["duration"] == pytest.approx(2.499)
    assert raw["clock"]["gaps"] == raw["clock"]["repeated"] == raw["clock"]["back"] == 0
    first = next(c for c in raw["channels"] if c["name"] == "pos_1")
    assert first["low"] == pytest.approx(table["pos_1"].min())
    assert (first["unit"], first["guessed"]) == ("deg", True)
    assert "even, no gaps, no time twice" in out
    assert raw["suggested"].splitlines()[1:] == [
        '"q<j>" = "pos_{j} [deg]"  # by its range',
        '"qd<j>" = "vel_{j}"',
        '"tau<j>" = "tau_{j}"',
    ]


def test_the_suggestion_serves_as_a_mapping(capsys, tmp_path, table):
    raw, _ = seen(capsys, tmp_path, table)
    (tmp_path / "map.toml").write_text(raw["suggested"])
    raw, _ = seen(capsys, tmp_path, table, "--map", tmp_path / "map.toml", "--robot", "demo-arm")
    names = [channel["name"] for channel in raw["channels"]]
    assert "pos_2 (q2)" in names and "tau_3 (tau3)" in names
    assert raw["suggested"] == ""


def doubts(capsys, tmp_path, table, *words):
    return seen(capsys, tmp_path, table, *words)[0]["doubts"]


def test_gaps_repeats_and_steps_back(capsys, tmp_path, table):
    kept = np.delete(np.arange(len(table["time"])), np.r_[100:103, 2000])
    gone = {name: values[kept] for name, values in table.items()}
    raw, _ = seen(capsys, tmp_path, gone)
    assert (raw["clock"]["gaps"], raw["clock"]["lost"]) == (2, 4)
    assert raw["clock"]["largest"] == pytest.approx(0.004)
    assert raw["clock"]["at"] == pytest.approx(0.099)
    table["time"] = table["time"].copy()
    table["time"][50] = table["time"][49]
    table["time"][70:] -= 0.5
    told = "\n".join(doubts(capsys, tmp_path, table))
    assert "time goes back in 1 rows" in told and "time repeats itself in 1 rows" in told


def test_jitter(capsys, tmp_path, table):
    rng = np.random.default_rng(1)
    table["time"] = table["time"] + 1e-4 * rng.standard_normal(len(table["time"]))
    raw, _ = seen(capsys, tmp_path, table)
    assert raw["clock"]["jitter"] == pytest.approx(0.1 * np.sqrt(2.0), rel=0.1)
    assert any("is uneven" in doubt for doubt in raw["doubts"])


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
def test_doubts_by_what_was_spoilt(capsys, tmp_path, table, name, change, words):
    before = doubts(capsys, tmp_path, table)
    assert before == ["pos_* looks like deg, by its range; say so in [log] or with --map"]
    table[name] = change(table)
    told = "\n".join(doubts(capsys, tmp_path, table))
    assert words in told


def test_resolution_limits_and_missing_values(capsys, tmp_path, table):
    step = 0.5
    table["pos_1"] = step * np.round(table["pos_1"] / step)
    top = np.quantile(table["tau_2"], 0.9)
    table["tau_2"] = np.minimum(table["tau_2"], top)
    table["tau_3"] = table["tau_3"].copy()
    table["tau_3"][40:47] = np.nan
    raw, _ = seen(capsys, tmp_path, table)
    by = {channel["name"]: channel for channel in raw["channels"]}
    assert by["pos_1"]["resolution"] == pytest.approx(step) and by["tau_1"]["resolution"] is None
    encoder = 4.0 * 360.0 / SimulationSettings().encoder_counts  # deg
    assert by["pos_2"]["resolution"] == pytest.approx(encoder, rel=1e-6)
    ((end, share),) = by["tau_2"]["limits"]
    assert end == pytest.approx(top) and share == pytest.approx(0.1, abs=0.03)
    assert by["tau_3"]["missing"] == 7 and by["tau_1"]["limits"] == by["tau_3"]["limits"] == []


MAP = ["--map", "q<j>=pos_{j}:deg", "--map", "qd<j>=vel_{j}:deg/s", "--map", "tau<j>=tau_{j}"]


def test_a_robot_tells_more(capsys, tmp_path, table):
    for j in "123":
        for what in ("pos", "vel"):
            table[f"{what}_{j}"] = table[f"{what}_{j}"] / 4.0
    assert doubts(capsys, tmp_path, table, *MAP, "--robot", "demo-arm") == []
    table["tau_2"] = -table["tau_2"]
    told = "\n".join(doubts(capsys, tmp_path, table, *MAP, "--robot", "demo-arm"))
    assert "joint 2" in told and "sign" in told


def test_a_log_that_lacks_what_the_robot_needs(capsys, tmp_path, table):
    del table["tau_3"]
    told = doubts(capsys, tmp_path, table, "--robot", "demo-arm")
    assert any("as a log of demo-arm it cannot be fitted: " in line for line in told)


def test_topics_are_listed_without_choosing(case, capsys, tmp_path):
    path = writers.bag(tmp_path / "run", case.table, extra_topic="/other/joint_states")
    assert main(["log", str(path), "--json", str(tmp_path / "log.json")]) == 0
    out = capsys.readouterr().out
    raw = json.loads((tmp_path / "log.json").read_text())
    assert [s["name"] for s in raw["streams"]] == ["/joint_states", "/other/joint_states"]
    assert [s["clock"] for s in raw["streams"]] == [True, False]
    assert "/joint_states  sensor_msgs/msg/JointState, 2500 messages, the clock" in out
    assert '"q<j>" = "joint_states.position[{name}]"' in out
    assert 'names = {1 = "waist", 2 = "shoulder", 3 = "elbow"}' in out


@pytest.mark.rotating("long tests of logs")
def test_page_pictures_and_windows(capsys, tmp_path, table):
    path = parquet(tmp_path / "run.parquet", table)
    argv = ["log", f"{path}@1:2", "--report", tmp_path / "page.html", "--picture", tmp_path / "p"]
    assert main([*map(str, argv)]) == 0
    out = capsys.readouterr().out
    assert out.startswith("run.parquet: 1000 rows") and "written: " in out
    page = (tmp_path / "page.html").read_text()
    assert "What is in run.parquet" in page and "pos_*" in page and len(page) < 1_000_000
    assert {p.name for p in (tmp_path / "p").iterdir()} >= {"clock.png", "clock.csv"}
    status = main(["log", f"{path}@90:91"])
    assert status == 1 and "fewer than two rows from 90 to 91 s" in capsys.readouterr().err


def test_a_name_with_markup_stays_text(capsys, tmp_path, table):
    table["<img src=x>_1"] = table["tau_1"]
    path = parquet(tmp_path / "run.parquet", table)
    assert main(["log", str(path), "--report", str(tmp_path / "page.html")]) == 0
    assert "<img src=x>" not in (tmp_path / "page.html").read_text()


NAMES = ("time", "t [ms]", "q1", "qd1", "pos_1", "pos[2]", "i_1", "x", "temp", 'a"b', "x\\y", "{j}")


def odd(rng, n):
    """A column as a broken logger leaves it."""
    t = np.arange(n) * 10.0 ** rng.integers(-9, 9)
    return (
        t, t[::-1], rng.normal(size=n), np.full(n, np.nan), np.full(n, 1.5),
        np.where(rng.random(n) < 0.5, np.nan, rng.normal(size=n)), 1e300 * rng.normal(size=n),
        np.full(n, np.inf), np.round(1e4 * rng.normal(size=n)), 1e-310 * np.sin(t),
    )[rng.integers(10)]  # fmt: skip


def test_whatever_is_in_it_is_told(tmp_path):
    """JSON without NaN, a suggestion that is TOML, pictures; or one line."""
    rng = np.random.default_rng(5)
    for _ in range(150):
        names = rng.choice(NAMES, size=rng.integers(1, 7), replace=False)
        n = int(rng.choice([10, 60]))
        path = parquet(tmp_path / "run.parquet", {str(name): odd(rng, n) for name in names})
        try:
            seen = inspect_log(LogTable(path), LogMap())
        except DataError as error:
            assert "\n" not in str(error)
            continue
        json.dumps(seen.to_json(), allow_nan=False)
        assert log_pictures(seen) or len(names) == 1
        if seen.suggested:
            map_from_table(tomllib.loads(seen.suggested)["log"], "suggested")
