"""No number that means nothing in what is written for machines: null, in every command's JSON."""

import argparse
import json
import math

import numpy as np
import pytest

from modeler.api import load
from modeler.cli import main
from modeler.cli.console import run_command
from modeler.core.json import parse_json
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.json_schemas import check_schema


def test_what_is_not_finite_is_null_and_all_else_as_it_was(tmp_path):
    raw = {"a": [1.5, math.nan, (0.0, -math.inf)], "b": {"c": np.float64("nan"), "d": "nan"}}
    raw |= {"e": np.array([[1.0, np.inf]]), "f": np.int64(3), "g": True, "h": None}
    place = tmp_path / "x.json"
    run_command(argparse.Namespace(json=str(place), command="robots"), lambda args: raw)
    assert json.loads(place.read_text()) == {
        "schema": "urn:modeler:schema:robots:1",
        "a": [1.5, None, [0.0, None]],
        "b": {"c": None, "d": "nan"},
        "e": [[1.0, None]],
        "f": 3,
        "g": True,
        "h": None,
    }


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two runs, a model, and a run of which nobody measured the torque of joint 2."""
    logs = tmp_path_factory.mktemp("nulls")
    for name, seed in (("a", 1), ("b", 2)):
        log = simulate(load("two-link"), SimulationSettings(duration=6.0, rate=200.0, seed=seed))
        write_log(logs / f"{name}.csv", log)
    log.tau[:, 1] = 0.0
    write_log(logs / "silent.csv", log)
    assert main(["fit", "two-link", str(logs / "a.csv"), "--out", str(logs / "m.json")]) == 0
    return logs


LINES = (  # what they write is looked into, or they run what no other test runs
    "compare m.json silent.csv",
    "log silent.csv",
    "diagnose m.json a.csv --holdout silent.csv --report d.html",
    "compare m.json b.csv@0:2 --free-run --controller 20,0.25",
    "excite two-link --limit 1=-2,2,3,9 --limit 2=-2,2,3,9 --out e.csv --starts 1 --harmonics 3",
    "excite two-link --check a.csv",
    "excite two-link --from a.csv --out e.csv --starts 1 --harmonics 3 --family bspline "
    "--clearance 0.01",
    "excite two-link --choose 1 --from a.csv --from b.csv",
)


@pytest.mark.rotating("long tests of core")
@pytest.mark.parametrize("line", LINES)
def test_json_of_a_command_holds_no_number_that_is_none(line, folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    status = main([*line.split(), "--json", "out.json"])
    assert status == 0, capsys.readouterr().err
    raw = parse_json((folder / "out.json").read_bytes())  # refuses NaN and Infinity
    check_schema(line.split()[0], raw)
    out = capsys.readouterr().out
    assert "nan" not in out.replace("nance", "").lower().split()
    if line == LINES[0]:
        assert set(raw["joints"]) == {"1"} and raw["by_log"][0]["joints"]["2"] is None
    if line == LINES[1]:
        assert raw["clock"]["gaps"] == 0 and raw["clock"]["largest_gap_start"] is None
    if line == LINES[2]:
        joint = raw["joints"]["2"]
        assert joint["error_before"] is joint["error_after"] is None and joint["rms_before"] > 0.0
        assert "2 - -" in [" ".join(row.split()) for row in out.splitlines()]
        assert "nan %" not in (folder / "d.html").read_text()
