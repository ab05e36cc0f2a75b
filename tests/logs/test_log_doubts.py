"""`modeler log` doubts what is wrong, joint by joint, and leaves good logs alone."""

import json
import tomllib

import numpy as np
import pytest

from modeler.cli import main
from modeler.logs.inspect import inspect_log
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import LogMap, map_from_table
from tests.logs.writers import parquet


@pytest.fixture
def plain(case):
    """Time, positions, their speeds and torques in our names and SI units."""
    found = {"time": case.table["time"]}
    for j in "123":
        found[f"q{j}"] = case.table[f"q{j}"]
        found[f"qd{j}"] = np.gradient(found[f"q{j}"], found["time"])
        found[f"tau{j}"] = case.table[f"tau{j}"]
    return found


def seen(tmp_path, table):
    return inspect_log(LogTable(parquet(tmp_path / "run.parquet", table)), LogMap())


def told(capsys, tmp_path, table, *words):
    path = parquet(tmp_path / "run.parquet", table)
    assert main(["log", str(path), *words, "--json", str(tmp_path / "log.json")]) == 0
    capsys.readouterr()
    return json.loads((tmp_path / "log.json").read_text())


def test_a_joint_that_turns_on_is_in_rad_if_its_speed_agrees(tmp_path, plain):
    """12 rad is no degree where the speed is its derivative: units of both agree, and it turns."""
    plain["q1"], plain["qd1"] = (
        4.0 * plain["q1"] / np.ptp(plain["q1"]) + 9.0,
        (4.0 * plain["qd1"] / np.ptp(plain["q1"])),
    )
    found = seen(tmp_path, plain)
    assert found.doubts == () and found.suggested == ""


def test_a_speed_says_what_its_position_is_in(tmp_path, plain):
    plain["q2"] = np.rad2deg(plain["q2"])
    found = seen(tmp_path, plain)
    assert "q2 in deg and qd2 in rad/s?" in "\n".join(found.doubts)
    assert tomllib.loads(found.suggested)["log"] == {"q2": "q2 [deg]"}


def test_a_guess_that_fits_worse_is_dropped(capsys, tmp_path, plain):
    """Without speeds a far way looks like degrees; the fit of the log as it stands clears it."""
    table = {name: v for name, v in plain.items() if not name.startswith("qd")}
    table["q1"] = table["q1"] + 4.0 * np.pi  # joint 1 turns about the vertical: gravity is blind
    assert "q1 looks like deg" in "\n".join(seen(tmp_path, table).doubts)
    raw = told(capsys, tmp_path, table, "--robot", "demo-arm")
    assert raw["doubts"] == [] and raw["suggested"] == ""


def test_exchanged_torques_are_told(capsys, tmp_path, plain):
    plain["tau1"], plain["tau2"] = plain["tau2"], plain["tau1"]
    lines = told(capsys, tmp_path, plain, "--robot", "demo-arm")["doubts"]
    assert any("Not valid" in line for line in lines)


@pytest.mark.parametrize(("own", "factor", "unit"), [("q", 1.0, "deg"), ("tau", 1e3, "mN m")])
def test_only_the_joint_of_another_unit_is_named(tmp_path, plain, own, factor, unit):
    table = {name: v for name, v in plain.items() if not name.startswith("qd")}
    factor = np.rad2deg(4.0) if own == "q" else 1e3 * factor
    table[f"{own}2"] = factor * table[f"{own}2"]
    found = seen(tmp_path, table)
    assert [line.split(" looks")[0] for line in found.doubts] == [f"{own}2"]
    assert tomllib.loads(found.suggested)["log"] == {f"{own}2": f"{own}2 [{unit}]"}


def test_a_joint_at_rest_is_no_doubt(tmp_path, plain):
    rng = np.random.default_rng(4)
    n = len(plain["time"])
    plain["q2"] = 1.0 + 1e-4 * rng.integers(-1, 2, n)
    plain["qd2"] = 1e-4 * np.round(10.0 * rng.standard_normal(n))
    plain["q3"], plain["qd3"] = 0.5 + 1e-4 * rng.integers(0, 2, n), np.zeros(n)
    assert seen(tmp_path, plain).doubts == ()


def test_a_clock_that_ticks_is_even_enough(tmp_path, plain):
    """Steps of 10 and 12 ms of a clock of 2 ms are as even as that clock can say."""
    n = len(plain["time"])
    plain["time"] = np.cumsum(np.where(np.arange(n) % 3 == 0, 0.012, 0.010))
    found = seen(tmp_path, {k: v for k, v in plain.items() if not k.startswith("qd")})
    assert found.doubts == () and found.clock.jitter > 0.05
    assert found.clock.tick == pytest.approx(0.002)


def test_one_gap_is_one(tmp_path, plain):
    table = {name: np.delete(v, np.r_[100:110]) for name, v in plain.items()}
    assert "time has 1 gap, " in "\n".join(seen(tmp_path, table).doubts)


def test_speeds_of_some_joints_are_checked(tmp_path, plain):
    del plain["qd1"]
    plain["qd3"] = -plain["qd3"]
    assert seen(tmp_path, plain).doubts == ("qd3 has the other sign of the derivative of q3",)


def test_names_with_units_and_letters(tmp_path, plain):
    table = {"Zeit": plain["time"]}
    for letter, j in zip("ABC", "123", strict=True):
        table[f"Joint {letter} [°]"] = np.rad2deg(plain[f"q{j}"])
        table[f"T {letter}"] = plain[f"tau{j}"]
    found = seen(tmp_path, table)
    assert found.doubts == ()
    mapping = tomllib.loads(found.suggested)["log"]
    assert mapping["q<j>"] == "Joint {name} [°]" and mapping["tau<j>"] == "T {name}"
    named = LogTable(tmp_path / "run.parquet", map_from_table(mapping, "log"))
    assert named.rows == len(plain["time"])


def test_what_is_not_recognised_is_a_doubt(tmp_path, plain):
    table = {"time": plain["time"], "foo": plain["q1"], 'b"ar': plain["tau1"]}
    found = seen(tmp_path, table)
    assert "no columns look like positions or torques" in found.doubts[0]
    assert '"foo"' in found.suggested and '# "q<j>"' in found.suggested
    map_from_table(tomllib.loads(found.suggested)["log"], "suggested")
