"""`modeler excite --check MOTION`: what exceeds [limits], leaps or starts in motion is refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import main
from modeler.excitation import MotionBounds, find_exceeded_limits

LIMITS = "[limits]\n1 = [-2.0, 2.0, 3.0, 12.0]\n2 = [-1.5, 1.5, 2.0, 8.0]\n"
ROBOT = """name = "pair"
gravity = [0, 0, "-9.81"]
[symbols]
D2 = 0.3
[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta"]
rows = [["1", "0", 1, 0, "pi/2", 0, "q1"], ["2", "1", 1, 0, 0, "D2", "q2"]]
"""
BOUNDS = MotionBounds(
    ("1", "2"),
    np.array([-2.0, -1.5]),
    np.array([2.0, 1.5]),
    np.array([3.0, 2.0]),
    np.array([12.0, 8.0]),
    np.array([np.inf, np.inf]),
)


def smooth(rng: np.random.Generator, rate: float) -> tuple[np.ndarray, np.ndarray]:
    """A motion from rest to rest that uses most of the limits of each joint, or all but nothing."""
    time = np.arange(round(8.0 * rate) + 1) / rate
    window = np.sin(np.pi * time / 8.0) ** 2
    tones = rng.uniform(0.2, 0.8, (2, 4))
    q = np.stack([np.sin(2 * np.pi * item * time[:, None]).sum(axis=1) for item in tones], axis=1)
    q = q * window[:, None]
    v = np.gradient(q, time, axis=0)
    a = np.gradient(v, time, axis=0)
    used = [np.abs(q) / BOUNDS.upper, np.abs(v) / BOUNDS.speed, np.abs(a) / BOUNDS.acceleration]
    share = np.max([each.max(axis=0) for each in used], axis=0)
    return time, q * rng.uniform(0.1, 0.98) / share


def kinds(time: np.ndarray, q: np.ndarray) -> set[tuple[str, str]]:
    matches = find_exceeded_limits(BOUNDS, ("rad", "rad"), time, q, None)
    return {(each.joint, each.quantity) for each in matches}


@pytest.mark.parametrize("rate", [100.0, 250.0, 1000.0])
@pytest.mark.parametrize("digits", [3, 4, 6, 15])
def test_a_motion_within_its_limits_is_not_accused(rate: float, digits: int) -> None:
    """However few digits its file has."""
    rng = np.random.default_rng()
    for _ in range(20):
        time, q = smooth(rng, rate)
        assert not kinds(time, q.round(digits))


def test_a_leap_is_found_whatever_its_place() -> None:
    rng = np.random.default_rng()
    for _ in range(50):
        time, q = smooth(rng, 200.0)
        at, way = int(rng.integers(10, len(time) - 10)), rng.choice([-1.0, 1.0])
        q[at:, 1] += way * rng.uniform(0.05, 1.37)
        matches = find_exceeded_limits(BOUNDS, ("rad", "rad"), time, q, None)
        first = next(each for each in matches if each.quantity in ("speed", "acceleration"))
        assert first.joint == "2" and first.time == pytest.approx(time[at], abs=0.05)
        if first.quantity == "speed":
            assert abs(first.value) > 2.0 and "in 5 ms), limit 2" in first.format_line()


def test_positions_and_ends_are_looked_at() -> None:
    time = np.arange(801) / 200.0
    q = np.zeros((801, 2))
    q[:, 0] = 2.3 * np.sin(np.pi * time / 4.0) ** 2
    assert ("1", "position") in kinds(time, q)
    q[:, 0] = 0.5 * np.sin(np.pi * time / 4.0)  # at rest nowhere but in the middle
    assert kinds(time, q) == {("1", "speed at the start"), ("1", "speed at the end")}


def write(place: Path, columns: dict[str, np.ndarray]) -> str:
    head, rows = ",".join(columns), np.column_stack([*columns.values()])
    np.savetxt(place, rows, fmt="%.12g", delimiter=",", header=head, comments="")
    return str(place)


@pytest.mark.rotating("long tests of excite")
def test_the_command_refuses_what_breaks_limits(tmp_path: Path, capsys) -> None:
    robot = tmp_path / "pair.toml"
    robot.write_text(ROBOT + LIMITS)
    motion = str(tmp_path / "m.csv")
    words = ["excite", str(robot), "--duration", "5", "--starts", "1", "--time-limit", "0.3"]
    assert main([*words, "--rate", "200", "--out", motion]) == 0
    check = ["excite", str(robot), "--check"]
    assert main([*check, motion, "--json", str(tmp_path / "m.json")]) == 0
    assert json.loads((tmp_path / "m.json").read_text())["exceeded_limits"] == []
    capsys.readouterr()

    table = np.genfromtxt(motion, delimiter=",", names=True)
    columns = {name: table[name].copy() for name in table.dtype.names}
    columns["q2"][500:] += 1.37
    assert main([*check, write(tmp_path / "leap.csv", columns)]) == 1
    out, err = capsys.readouterr()
    assert "joint 2, 2.5 s: speed 27" in out and "rad/s (1.37 rad in 5 ms), limit 2" in out
    assert err.count("\n") == 1 and "leap.csv, joint 2, 2." in err and "limits exceeded: " in err

    columns["q2"][500:] -= 1.37
    columns["qd1"][300] = 9.0  # what a controller reads of the speeds, though positions are smooth
    begun = {name: table[name][200:] for name in table.dtype.names}
    twice = begun | {
        "time": np.where(np.arange(len(begun["time"])) == 7, begun["time"][6], begun["time"])
    }
    for name, changed, words in (
        ("speed", columns, "joint 1, 1.5 s: "),
        ("begun", begun, "speed at the start"),
        ("time", twice, "row 9: time does not increase"),
    ):
        assert main([*check, write(tmp_path / f"{name}.csv", changed)]) == 1
        assert words in capsys.readouterr().err
    log = begun | {"tau1": begun["q1"], "tau2": begun["q2"]}  # a log may begin anywhere
    assert main([*check, write(tmp_path / "log.csv", log)]) == 0
    assert "speed at the start" in capsys.readouterr().out
    assert main([*check, motion, "--limit", "1=-2,2,0.1,12"]) == 1
    assert "limit 0.1" in capsys.readouterr().err


def test_limits_that_no_file_states_are_called_assumed(tmp_path: Path, capsys) -> None:
    robot = tmp_path / "pair.toml"
    robot.write_text(ROBOT + LIMITS.rpartition("2 =")[0])
    time = np.arange(401) / 100.0
    still = {"time": time, "q1": 0.0 * time, "q2": 0.0 * time}
    words = ["excite", str(robot), "--check", write(tmp_path / "m.csv", still)]
    assert main(words) == 0
    assert "joint 2: no [limits] in the robot file; these are assumed" in capsys.readouterr().out
