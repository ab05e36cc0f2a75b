"""Logs with a joint at rest, no torque, missing torques, short pieces: numpy warns of nothing."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from modeler import identify, simulate
from modeler.api.model import open_robot
from modeler.api.workflow import save
from modeler.cli import main
from tests.rotation import with_cases

NAMES = ("rest", "idle", "missing", "pieces")


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("logs")
    run = simulate(open_robot("two-link"), duration=6.0, rate=250.0, seed=1)
    logs = {name: np.column_stack([run.time, run.q, run.tau]) for name in ("train", *NAMES)}
    logs["rest"][:, 2] = 0.3
    logs["idle"][:, 4] = 0.0
    logs["missing"][400:500, 3] = np.nan
    row = np.arange(len(run.time))
    logs["pieces"][:, 0] += 3.0 * np.cumsum((row % 170 == 0) | (row == 700))
    for name, columns in logs.items():
        header = "time,q1,q2,tau1,tau2"
        np.savetxt(place / f"{name}.csv", columns, "%.9g", ",", header=header, comments="")
    save(open_robot("two-link"), place / "arm.toml")
    model = identify(place / "arm.toml", place / "train.csv")
    save(model, place / "arm.model.json")
    return place


@with_cases(
    "commands",
    (
        "log {0}.csv --robot arm.toml",
        "fit arm.toml {0}.csv --out {0}.json",
        "compare arm.model.json {0}.csv",
    ),
    pytest.param(
        (
            "diagnose arm.model.json {0}.csv",
            "excite arm.toml --check {0}.csv",
            "diagnose arm.model.json train.csv --holdout {0}.csv",
        ),
        marks=pytest.mark.slow,
    ),
)
@pytest.mark.parametrize("log", NAMES)
def test_no_command_warns(folder: Path, monkeypatch, capsys, log: str, commands) -> None:
    monkeypatch.chdir(folder)
    for line in commands:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            assert main(line.format(log).split()) in (0, 1)
        assert "Warning" not in capsys.readouterr().err, line
