"""No number that means nothing in what is written for machines: null, in every command's JSON."""

import argparse
import json
import math
import shutil

import numpy as np
import pytest

from modeler.api import load
from modeler.cli import main
from modeler.cli.command_table import COMMANDS as TABLE
from modeler.cli.console import run_command
from modeler.core.json import nulled, parse_json
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.json_schemas import check_schema
from tests.robot.par_files import par_text

ROBOT = "two-link"


def test_what_is_not_finite_is_null_and_all_else_as_it_was():
    raw = {"a": [1.5, math.nan, (0.0, -math.inf)], "b": {"c": np.float64("nan"), "d": "nan"}}
    raw |= {"e": np.array([[1.0, np.inf]]), "f": np.int64(3), "g": True, "h": None}
    assert nulled(raw) == {
        "a": [1.5, None, [0.0, None]], "b": {"c": None, "d": "nan"},
        "e": [[1.0, None]], "f": 3, "g": True, "h": None,
    }  # fmt: skip


def test_whatever_a_command_returns_is_json(tmp_path):
    place = tmp_path / "x.json"
    args = argparse.Namespace(json=str(place), command="robots")
    run_command(args, lambda args: {"x": math.nan, "y": [np.inf]})
    schema = "urn:modeler:schema:robots:1"
    assert json.loads(place.read_text()) == {"schema": schema, "x": None, "y": [None]}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two runs, a model, and a run of which nobody measured the torque of joint 2."""
    found = tmp_path_factory.mktemp("nulls")
    for name, seed in (("a", 1), ("b", 2)):
        log = simulate(load(ROBOT), SimulationSettings(duration=6.0, rate=200.0, seed=seed))
        write_log(found / f"{name}.csv", log)
    head, *rows = (found / "b.csv").read_text().splitlines()
    place = head.split(",").index("tau2")
    silent = [row.split(",") for row in rows]
    for row in silent:
        row[place] = "0"
    (found / "silent.csv").write_text("\n".join([head, *(",".join(row) for row in silent), ""]))
    assert main(["fit", ROBOT, str(found / "a.csv"), "--out", str(found / "m.json")]) == 0
    shutil.copy(found / "m.json", found / "same.json")
    par = par_text({"Ant": "0,1", "d": "0,L", "Theta": "t1,t2", "G": "-9.81,0,0"}, "arm")
    (found / "old.par").write_text(par)
    return found


KEPT = [  # which run each time: what they write is looked into, or they run what no other test runs
    "compare m.json silent.csv",
    "log silent.csv",
    "diagnose m.json a.csv --holdout silent.csv --report d.html",
    "compare m.json b.csv@0:2 --free-run --controller 20,0.25",
    "excite two-link --limit 1=-2,2,3,9 --limit 2=-2,2,3,9 --out e.csv --starts 1 --harmonics 3",
    "excite two-link --check a.csv",
    "excite two-link --from a.csv --out e.csv --starts 1 --harmonics 3 --family bspline "
    "--clearance 0.01",
    "excite two-link --choose 1 --from a.csv b.csv",
]
COMMANDS = [
    "derive two-link",
    "derive two-link --closed-form --regressor --energy --kane",
    "fit two-link a.csv --out f.json",
    "fit two-link a.csv --method weighted,ridge --holdout b.csv",
    "compare m.json same.json b.csv",
    "physical two-link",
    "physical two-link --sets",
    "home five-bar",
    "effects",
    "robots",
    "robots wrist",
    "estimators",
    "simulate two-link --duration 2 --rate 100 --out s.csv --truth-out t.json",
    "show five-bar --out p.html",
    "new begun.toml --joints RPR",
    "convert old.par --out new.toml",
    "generate m.json --out c",
    "export m.json --out arm.urdf",
    "add m.json asymmetric_viscous --joint 1 a.csv --holdout b.csv --out n.json",
    "reproduce hanssen-2000 --section print",
    "completion bash",
    "demo --duration 6",
    "fleet two-link a.csv b.csv",
]


def test_every_command_is_tried_here():
    served = {"studio"}  # which goes on after it: tests/studio/test_command.py
    assert {line.split()[0] for line in (*KEPT, *COMMANDS)} == set(TABLE) - served


def marked(line):
    slow = [pytest.mark.slow] * line.startswith("demo")
    return pytest.param(line, marks=[pytest.mark.rotating, *slow])


@pytest.mark.rotating("long tests of core")
@pytest.mark.parametrize("line", [*KEPT, *map(marked, COMMANDS)])
def test_json_of_a_command_holds_no_number_that_is_none(line, folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    status = main([*line.split(), "--json", "out.json"])
    assert status == 0, capsys.readouterr().err
    raw = parse_json((folder / "out.json").read_bytes())  # refuses NaN and Infinity
    check_schema(line.split()[0], raw)
    out = capsys.readouterr().out
    assert "nan" not in out.replace("nance", "").lower().split()
    if line == KEPT[0]:
        assert set(raw["joints"]) == {"1"} and raw["by_log"][0]["joints"]["2"] is None
    if line == KEPT[1]:
        assert raw["clock"]["gaps"] == 0 and raw["clock"]["at"] is None
    if line == KEPT[2]:
        joint = raw["joints"]["2"]
        assert joint["error_before"] is joint["error_after"] is None and joint["rms_before"] > 0.0
        (line,) = (line for line in out.splitlines() if line.startswith("2 "))
        assert line.split() == ["2", "-", "-"]
        assert "nan %" not in (folder / "d.html").read_text()
