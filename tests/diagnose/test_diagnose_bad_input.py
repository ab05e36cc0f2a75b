"""`modeler diagnose` on bad logs: one clear line, or an answer that says what cannot be known."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.api import compile
from modeler.estimation.model_file import load_model
from tests.diagnose.conftest import RATE, Run, Table, columns_of, written


def with_gap(values: np.ndarray, what: float) -> np.ndarray:
    values = values.copy()
    values[800:830] = what
    return values


@pytest.mark.rotating("long tests of diagnose")
def test_logs_that_cannot_be_used_are_refused_in_one_line(arm, run, tmp_path):
    log = columns_of(arm / "other.parquet")
    timeless = log | {"time": with_gap(log["time"], np.nan)}
    creeping = log | {f"q{j}": 1e-3 * log[f"q{j}"] for j in (1, 2, 3)}
    bad = written(tmp_path / "bad.parquet", timeless)
    lines = [
        ("diagnose", arm / "m.json", bad),
        ("diagnose", arm / "m.json", arm / "train.parquet", "--holdout", bad),
        ("add", arm / "m.json", "spring", "--joint", "3", bad, "--out", tmp_path / "m2.json"),
    ]
    refused = [(run(*line), "column time, row 801: no value; every row needs") for line in lines]
    written(bad, creeping)
    refused.append((run(*lines[0]), "no usable row is left: joint 1: 0 rows; 100 % of the samples"))
    for (status, _, err), words in refused:
        assert status == 1 and err.startswith("modeler: ") and err.count("\n") == 1
        assert words in err and "bad.parquet" in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.parquet"]


@pytest.mark.rotating("long tests of diagnose")
def test_a_log_too_short_is_no_evidence_of_anything(arm: Path, run: Run, tmp_path: Path) -> None:
    short = {n: v[: int(2.0 * RATE)] for n, v in columns_of(arm / "other.parquet").items()}
    place = written(tmp_path / "short.parquet", short)
    status, out, _ = run("diagnose", arm / "m.json", place, "--report", tmp_path / "p.html")
    assert status == 0
    assert out.startswith("cannot tell: too few rows; record longer motions of all joints\n")
    assert "s of motion in all; expected 20 s or more: record longer" in out
    page = (tmp_path / "p.html").read_text(encoding="utf-8")
    assert "cannot tell" in page and "too few rows" in page


@pytest.mark.rotating("diagnoses of simulated runs")
def test_without_held_out_motion_or_with_fitted_one_the_answer_says_so(arm: Path, run: Run) -> None:
    train = arm / "train.parquet"
    status, out, _ = run("diagnose", arm / "m.json", train)
    assert status == 0
    assert "no held-out logs: errors are cross-validated within the logs, which flatters" in out
    assert "(cross-validated error, up to" in out
    status, out, _ = run("diagnose", arm / "m.json", arm / "other.parquet", "--holdout", train)
    assert status == 0
    assert "data: held out: the model was fitted to train.parquet; " in out


def test_channels_that_contradict_the_model_are_named_and_no_physics_is(arm, run, tmp_path):
    """In the logs that are diagnosed, and in held-out ones."""
    log, to = columns_of(arm / "other.parquet"), tmp_path / "d.json"
    exchanged = written(tmp_path / "bad.parquet", log | {"q1": log["q2"], "q2": log["q1"]})
    log = columns_of(arm / "train.parquet")
    degrees = {f"q{j}": np.degrees(log[f"q{j}"]) for j in (1, 2, 3)}
    held_out = written(tmp_path / "held_out.parquet", log | degrees)
    words = ("diagnose", arm / "m.json", exchanged, "--holdout", held_out, "--json", to)
    status, out, _ = run(*words)
    assert status == 0 and out.startswith("cannot tell: channels of the logs contradict the model")
    assert "\ndata: joints 1 and 2: their positions look exchanged; check the order of" in out
    assert "\ndata: held out: the positions look like degrees; expected rad and m; convert" in out
    content = json.loads(to.read_text())
    assert content["verdict"] == "cannot tell" and content["effects"] == []
    assert content["has_contradictions"] is True


def late(joint: int, samples: int, columns: Table) -> Table:
    q = columns[f"q{joint}"]
    return {**columns, f"q{joint}": np.concatenate([np.full(samples, q[0]), q[:-samples]])}


@pytest.mark.rotating("diagnoses of simulated runs")
@pytest.mark.parametrize(
    ("samples", "words"), [(2, " ms late, by a fit at other times"), (1, " ms too late beside")]
)
def test_a_late_position_is_found_with_its_delay(samples, words, arm, run, tmp_path):
    """Samples of 4 ms; the other joints are in time. A short delay shows in a wide band only."""
    bad = written(tmp_path / "bad.parquet", late(2, samples, columns_of(arm / "other.parquet")))
    _, out, _ = run("diagnose", arm / "m.json", bad)
    (line,) = [line for line in out.splitlines() if "its position comes" in line]
    assert line.startswith("data: joint 2: its position comes ") and words in line
    assert float(line.split("comes ")[1].split(" ms")[0]) == pytest.approx(4.0 * samples, rel=0.2)


def test_missing_and_clipped_values_are_counted(arm: Path, run: Run, tmp_path: Path) -> None:
    t = columns_of(arm / "other.parquet")
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
    tau = compile(model).inverse_dynamics(q, v, np.gradient(v, 1.0 / RATE, axis=0), model.beta)
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


def test_what_a_motion_cannot_show_is_a_blind_spot(arm: Path, run: Run, tmp_path: Path) -> None:
    """At one speed |v| is a constant and exp(-(v/vs)^2) sign(v) is sign(v)."""
    q = np.column_stack([np.full(5000, 0.3), to_and_fro(4.0, 1.0), sweep(0.27, 0.6)])
    log = planned(arm, q, tmp_path / "still.parquet")
    status, out, _ = run("diagnose", arm / "m.json", log, "--json", tmp_path / "d.json")
    assert status == 0
    assert "data: joint 1 never moves: nothing can be said of its effects; move it" in out
    assert "data: joint 2 moves at one speed only (1 rad/s): friction laws cannot be" in out
    assert "any effect of joint 1" in out.splitlines()[-2]  # the last names the next command
    content: dict[str, Any] = json.loads((tmp_path / "d.json").read_text())
    blind = {(spot["effect"], spot["joint"]) for spot in content["undetectable"]}
    laws = {"stribeck", "asymmetric_viscous", "nonlinear_viscous"}
    for joint, unseen in ("1", laws | {"spring", "position_friction", "drift"}), ("2", laws):
        assert {(effect, joint) for effect in unseen} <= blind
    assert not {(law, "3") for law in laws} & blind and ("spring", "2") not in blind


@pytest.mark.rotating("diagnoses of simulated runs")
def test_slow_motion_only(arm: Path, run: Run, tmp_path: Path) -> None:
    """Joints 2 and 3 carry gravity and friction, next to no inertia."""
    q = np.column_stack([sweep(0.05, 0.5, 40.0), sweep(0.055, 0.5, 40.0), sweep(0.061, 0.5, 40.0)])
    status, out, _ = run("diagnose", arm / "m.json", planned(arm, q, tmp_path / "slow.parquet"))
    assert status == 0
    lines = [line for line in out.splitlines() if "inertia makes less" in line]
    (line,) = (line for line in lines if "joint 3 (up to " in line)
    assert "rad/s): inertia makes less than 1 % of its torque" in line
    assert line.endswith("are not identifiable; accelerate more")


def test_what_is_ruled_out_must_exist(arm: Path, run: Run) -> None:
    for text, message in (
        ("sprng@3", '--without sprng@3: no such effect (did you mean "spring"'),
        ("spring@9", "--without spring@9: no joint 9; expected one of 1, 2, 3"),
    ):
        status, _, err = run("diagnose", arm / "m.json", arm / "train.parquet", "--without", text)
        assert status == 1 and err.count("\n") == 1 and message in err
