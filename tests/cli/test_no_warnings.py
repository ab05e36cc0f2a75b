"""Logs with a joint at rest, no torque, missing torques, short pieces: numpy warns of nothing."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from modeler import identify, open_robot, save, simulate
from modeler.cli import main

NAMES = ["time", "q1", "q2", "tau1", "tau2"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("logs")
    run = simulate(open_robot("two-link"), duration=6.0, rate=250.0, seed=1)
    columns = np.column_stack([run.time, run.q, run.tau])

    def write(name: str, change) -> None:
        own = columns.copy()
        change(own)
        np.savetxt(
            place / name, own, fmt="%.9g", delimiter=",", header=",".join(NAMES), comments=""
        )

    write("train.csv", lambda own: None)
    write("rest.csv", lambda own: own.__setitem__((slice(None), 2), 0.3))
    write("idle.csv", lambda own: own.__setitem__((slice(None), 4), 0.0))
    write("missing.csv", lambda own: own.__setitem__((slice(400, 500), 3), np.nan))
    gaps = np.cumsum((np.arange(len(columns)) % 170 == 0) | (np.arange(len(columns)) == 700)) * 3.0
    write("pieces.csv", lambda own: own.__setitem__((slice(None), 0), own[:, 0] + gaps))
    save(open_robot("two-link"), place / "arm.toml")
    model = identify(place / "arm.toml", place / "train.csv")
    save(model, place / "arm.model.json")
    return place


def check_runs(folder: Path, monkeypatch, capsys, commands: list[list[str]]) -> None:
    monkeypatch.chdir(folder)
    for words in commands:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            assert main(words) in (0, 1)
        assert "Warning" not in capsys.readouterr().err, words


LOGS = pytest.mark.parametrize("log", ["rest.csv", "idle.csv", "missing.csv", "pieces.csv"])


@LOGS
def test_no_command_warns(folder: Path, monkeypatch, capsys, log: str) -> None:
    fit, compare = ["fit", "arm.toml", log, "--out", f"{log}.json"], ["compare", "arm.model.json"]
    look = ["log", log, "--robot", "arm.toml"]
    check_runs(folder, monkeypatch, capsys, [look, fit, [*compare, log]])


@pytest.mark.slow
@LOGS
def test_no_diagnosis_or_motion_warns(folder: Path, monkeypatch, capsys, log: str) -> None:
    diagnose, excite = ["diagnose", "arm.model.json"], ["excite", "arm.toml"]
    commands = [
        [*diagnose, log], [*diagnose, "train.csv", "--holdout", log], [*excite, "--check", log],
    ]  # fmt: skip
    check_runs(folder, monkeypatch, capsys, commands)
