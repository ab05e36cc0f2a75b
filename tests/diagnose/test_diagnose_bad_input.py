"""`modeler diagnose` on bad logs: one clear line, or an answer that says what cannot be known."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import recompile
from modeler.estimation.model_file import load_model
from tests.diagnose.conftest import Run

Table = dict[str, np.ndarray]

RATE = 250.0


def table(place: Path) -> Table:
    read = pq.read_table(place)
    return {name: read[name].to_numpy().copy() for name in read.column_names}


def written(place: Path, columns: Table) -> Path:
    pq.write_table(pa.table(columns), place)
    return place


def with_gap(values: np.ndarray, what: float) -> np.ndarray:
    values = values.copy()
    values[800:830] = what
    return values


REFUSED: dict[str, tuple[Callable[[Table], Table], str]] = {
    "no time": (
        lambda t: t | {"time": with_gap(t["time"], np.nan)},
        "column time, row 801: no value; every row needs its time",
    ),
    "time back": (
        lambda t: t | {"time": with_gap(t["time"], 1.0)},
        "column time, row 801: 1 s after 3.196 s; expected increasing time",
    ),
    "creep": (
        lambda t: t | {f"q{j}": 1e-3 * t[f"q{j}"] for j in (1, 2, 3)},
        "no usable row is left: joint 1: 0 rows; 100 % of the samples masked below",
    ),
}  # fmt: skip


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize("mistake", REFUSED)
def test_logs_that_cannot_be_used_are_refused_in_one_line(
    arm: Path, run: Run, tmp_path: Path, mistake: str
) -> None:
    change, words = REFUSED[mistake]
    bad = written(tmp_path / "bad.parquet", change(table(arm / "other.parquet")))
    lines = [
        ("diagnose", arm / "m.json", bad),
        ("diagnose", arm / "m.json", arm / "train.parquet", "--holdout", bad),
        ("add", arm / "m.json", "spring", "--joint", "3", bad, "--out", tmp_path / "m2.json"),
    ]
    for line in lines if mistake == "no time" else lines[:1]:
        status, _, err = run(*line)
        assert status == 1
        assert err.startswith("modeler: ") and err.count("\n") == 1
        assert words in err and "bad.parquet" in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.parquet"]


@pytest.mark.rotating("long tests of diagnose")
def test_a_log_too_short_is_no_evidence_of_anything(arm: Path, run: Run, tmp_path: Path) -> None:
    short = {n: v[: int(2.0 * RATE)] for n, v in table(arm / "other.parquet").items()}
    place = written(tmp_path / "short.parquet", short)
    status, out, _ = run("diagnose", arm / "m.json", place, "--report", tmp_path / "p.html")
    assert status == 0
    assert out.startswith("cannot tell: too few rows; record longer motions of all joints\n")
    assert "s of motion in all; expected 20 s or more: record longer" in out
    page = (tmp_path / "p.html").read_text(encoding="utf-8")
    assert "cannot tell" in page and "too few rows" in page


@pytest.mark.rotating("diagnoses of simulated runs")
def test_without_held_out_motion_the_answer_says_what_that_costs(arm: Path, run: Run) -> None:
    status, out, _ = run("diagnose", arm / "m.json", arm / "train.parquet")
    assert status == 0
    assert "no held-out logs: errors are cross-validated within the logs, which flatters" in out
    assert "(cross-validated error, up to" in out


def degrees(*joints: int) -> Callable[[Table], Table]:
    return lambda t: t | {f"q{j}": np.degrees(t[f"q{j}"]) for j in joints}


def late(joint: int, samples: int) -> Callable[[Table], Table]:
    def change(t: Table) -> Table:
        q = t[f"q{joint}"]
        return t | {f"q{joint}": np.concatenate([np.full(samples, q[0]), q[:-samples]])}

    return change


CONTRADICT: dict[str, tuple[Callable[[Table], Table], str]] = {
    "degrees": (degrees(1, 2, 3), "the positions look like degrees; expected rad and m; convert"),
    "one in degrees": (degrees(2), "joint 2: its position looks like degrees"),
    "current": (
        lambda t: t | {"tau2": t["tau2"] / 37.0},
        "joint 2: the measured torque is 0.027 times what it should be; check unit and",
    ),
    "torques exchanged": (
        lambda t: t | {"tau1": t["tau2"], "tau2": t["tau1"]},
        "joints 1 and 2: their torques look exchanged; check the order of the columns",
    ),
    "torque reversed": (
        lambda t: t | {"tau3": -t["tau3"]},
        "joint 3: the measured torque has the other sign of what a machine that can be built",
    ),
    "position reversed": (
        lambda t: t | {"q2": -t["q2"]},
        "joint 2: its position seems to be counted the other way; check its sign",
    ),
    "positions exchanged": (
        lambda t: t | {"q1": t["q2"], "q2": t["q1"]},
        "joints 1 and 2: their positions look exchanged; check the order of the columns",
    ),
}


@pytest.mark.parametrize(
    "mistake",
    [
        name
        if name in ("degrees", "torque reversed", "positions exchanged")
        else pytest.param(name, marks=pytest.mark.rotating)
        for name in CONTRADICT
    ],
)
def test_channels_that_contradict_the_model_are_named_and_no_physics_is(
    arm: Path, run: Run, tmp_path: Path, mistake: str
) -> None:
    change, words = CONTRADICT[mistake]
    bad = written(tmp_path / "bad.parquet", change(table(arm / "other.parquet")))
    status, out, _ = run("diagnose", arm / "m.json", bad, "--json", tmp_path / "d.json")
    assert status == 0
    assert out.startswith("cannot tell: channels of the logs contradict the model")
    assert f"\ndata: {words}" in out
    content = json.loads((tmp_path / "d.json").read_text())
    assert content["verdict"] == "cannot tell" and content["effects"] == []
    assert content["contradicted"] is True
    if mistake == "degrees":  # held-out logs are checked too
        _, out, _ = run("diagnose", arm / "m.json", arm / "train.parquet", "--holdout", bad)
        assert out.startswith("cannot tell: channels of the logs contradict the model")
        assert "\ndata: held out: the positions look like degrees" in out


@pytest.mark.parametrize(
    ("samples", "words"),
    [
        (2, " ms late, by a fit at other times"),
        pytest.param(1, " ms too late beside", marks=pytest.mark.rotating),
    ],
)
def test_a_late_position_is_found_with_its_delay(
    samples: int, words: str, arm: Path, run: Run, tmp_path: Path
) -> None:
    """Samples of 4 ms; the other joints are in time. A short delay shows in a wide band only."""
    bad = written(tmp_path / "bad.parquet", late(2, samples)(table(arm / "other.parquet")))
    _, out, _ = run("diagnose", arm / "m.json", bad)
    (line,) = [line for line in out.splitlines() if "its position comes" in line]
    assert line.startswith("data: joint 2: its position comes ") and words in line
    assert float(line.split("comes ")[1].split(" ms")[0]) == pytest.approx(4.0 * samples, rel=0.2)


def test_missing_and_clipped_values_are_counted(arm: Path, run: Run, tmp_path: Path) -> None:
    t = table(arm / "other.parquet")
    t["q2"], t["tau1"] = with_gap(t["q2"], np.nan), with_gap(t["tau1"], np.inf)
    limit = float(np.quantile(np.abs(t["tau3"]), 0.8))
    stuck = np.abs(t["tau3"]) > limit
    t["tau3"] = np.clip(t["tau3"], -limit, limit)
    bad = written(tmp_path / "bad.parquet", t)
    status, out, _ = run("diagnose", arm / "m.json", bad)
    assert status == 0
    for column in ("q2", "tau1"):
        assert f"data: bad.parquet: {column} has no value in 30 of {len(stuck)} rows; they" in out
    line = next(line for line in out.splitlines() if "is clipped in" in line)
    count = int(line.split("clipped in ")[1].split(" of")[0])
    assert count == pytest.approx(int(stuck.sum()), rel=0.1)
    assert line.endswith("they are not used, but drive slower or with less load")


def planned(arm: Path, q: np.ndarray, place: Path) -> Path:
    """A log of the motion q (n, 3) with the torques of the model and white noise."""
    model = load_model(arm / "m.json")
    v = np.gradient(q, 1.0 / RATE, axis=0)
    tau = recompile(model).inverse_dynamics(q, v, np.gradient(v, 1.0 / RATE, axis=0), model.beta)
    rng = np.random.default_rng(1)
    columns = {"time": np.arange(len(q)) / RATE}
    for j in range(3):
        columns[f"q{j + 1}"] = q[:, j]
        columns[f"tau{j + 1}"] = tau[:, j] + rng.normal(scale=0.01, size=len(q))
    return written(place, columns)


def sweep(f: float, size: float, duration: float = 20.0) -> np.ndarray:
    t = np.arange(int(duration * RATE)) / RATE
    waves = ((1.0, 1.0, 0.0), (0.6, 1.7, 1.0), (0.4, 2.63, 2.0))
    return size * sum(a * np.sin(2.0 * np.pi * k * f * t + p) for a, k, p in waves)


def to_and_fro(period: float, size: float) -> np.ndarray:
    """Constant speed, with reversals of 0.1 s."""
    t = np.arange(int(20.0 * RATE)) / RATE
    edges = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * t / period))
    window = np.hanning(int(0.1 * RATE))
    return size * np.convolve(np.pad(edges, 50, "edge"), window / window.sum(), "same")[50:-50]


def blind(place: Path) -> set[tuple[str, str | None]]:
    content: dict[str, Any] = json.loads(place.read_text())
    return {(spot["effect"], spot["joint"]) for spot in content["blind_spots"]}


def test_a_joint_that_never_moves_is_a_blind_spot(arm: Path, run: Run, tmp_path: Path) -> None:
    q = np.column_stack([np.full(5000, 0.3), sweep(0.21, 0.5), sweep(0.27, 0.6)])
    log = planned(arm, q, tmp_path / "still.parquet")
    status, out, _ = run("diagnose", arm / "m.json", log, "--json", tmp_path / "d.json")
    assert status == 0
    assert "data: joint 1 never moves: nothing can be said of its effects; move it" in out
    assert "any effect of joint 1" in out.splitlines()[-2]  # the last names the next command
    unseen = {(effect, "1") for effect in ("stribeck", "spring", "position_friction", "drift")}
    assert unseen <= blind(tmp_path / "d.json")
    assert ("stribeck", "2") not in blind(tmp_path / "d.json")


@pytest.mark.rotating("diagnoses of simulated runs")
def test_at_one_speed_laws_of_the_speed_are_blind_spots(
    arm: Path, run: Run, tmp_path: Path
) -> None:
    """|v| is a constant and exp(-(v/vs)^2) sign(v) is sign(v): offset and Coulomb friction."""
    q = np.column_stack([to_and_fro(4.0, 1.0), sweep(0.21, 0.5), sweep(0.27, 0.6)])
    log = planned(arm, q, tmp_path / "steady.parquet")
    status, out, _ = run("diagnose", arm / "m.json", log, "--json", tmp_path / "d.json")
    assert status == 0
    assert "data: joint 1 moves at one speed only (1 rad/s): friction laws cannot be told" in out
    laws = ("stribeck", "asymmetric_viscous", "nonlinear_viscous")
    assert {(law, "1") for law in laws} <= blind(tmp_path / "d.json")
    assert not {(law, "2") for law in laws} & blind(tmp_path / "d.json")


@pytest.mark.rotating("diagnoses of simulated runs")
def test_slow_motion_only(arm: Path, run: Run, tmp_path: Path) -> None:
    """Joints 2 and 3 feel gravity and friction, next to no inertia."""
    q = np.column_stack([sweep(0.05, 0.5, 40.0), sweep(0.055, 0.5, 40.0), sweep(0.061, 0.5, 40.0)])
    status, out, _ = run("diagnose", arm / "m.json", planned(arm, q, tmp_path / "slow.parquet"))
    assert status == 0
    lines = [line for line in out.splitlines() if "inertia makes less" in line]
    (line,) = (line for line in lines if "joint 3 (up to " in line)
    assert "rad/s): inertia makes less than 1 % of its torque" in line
    assert line.endswith("are not identifiable; accelerate more")


def test_rows_have_one_part(arm: Path, run: Run) -> None:
    train = arm / "train.parquet"
    status, _, err = run("diagnose", arm / "m.json", train, "--holdout", train)
    assert status == 1 and err.count("\n") == 1
    assert "--holdout train.parquet: shares rows with train.parquet" in err


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_held_out_log_that_was_fitted_is_told(arm: Path, run: Run) -> None:
    words = ("diagnose", arm / "m.json", arm / "other.parquet", "--holdout", arm / "train.parquet")
    status, out, _ = run(*words)
    assert status == 0
    assert "data: held out: the model was fitted to train.parquet; " in out


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("sprng@3", '--without sprng@3: no such effect (did you mean "spring"'),
        ("spring@9", "--without spring@9: no joint 9; expected one of 1, 2, 3"),
    ],
)
def test_what_is_ruled_out_must_exist(arm: Path, run: Run, text: str, message: str) -> None:
    status, _, err = run("diagnose", arm / "m.json", arm / "train.parquet", "--without", text)
    assert status == 1 and err.count("\n") == 1 and message in err
