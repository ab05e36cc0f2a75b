"""Every command that takes logs reads a MAT file with names and units of its own."""

import json
import re

import numpy as np
import pytest
from scipy.signal import butter, sosfilt

from modeler.api import add, compare, remove_last
from modeler.core.choices import read_builtin_robot
from modeler.estimation.model_file import load_model
from tests.logs.conftest import MAT
from tests.rotation import rotating


def values(place):
    fit = json.loads(place.read_text())["fit"]
    return np.array([p["value"] for p in fit["parameters"]])


COMMANDS = [
    "compare {model} {b}",
    "add {model} asymmetric_viscous {a} --holdout {b} --out {out}",
    *rotating("diagnose {model} {a} --holdout {b}"),
]


@pytest.mark.parametrize("words", COMMANDS, ids=lambda words: words.split()[0])
def test_the_model_file_carries_the_names(slide, tmp_path, run, words):
    values = []
    for model, ending in (("m.json", "mat"), ("p.json", "parquet")):
        places = {
            "model": slide / model,
            "a": slide / f"a.{ending}",
            "b": slide / f"b.{ending}",
            "out": tmp_path / "out.json",
        }
        argv = [word.format(**places) for word in words.split()]
        status, _, err = run(*argv, "--json", tmp_path / "r.json")
        assert (status, err) == (0, "")
        values.append(numbers(json.loads((tmp_path / "r.json").read_text())))
    assert values[0] == pytest.approx(values[1], rel=1e-6, abs=1e-9)


def numbers(value):
    """Every number in a JSON value, in order."""
    if isinstance(value, dict):
        return [n for item in value.values() for n in numbers(item)]
    if isinstance(value, list):
        return [n for item in value for n in numbers(item)]
    return [float(value)] if isinstance(value, int | float) else []


def test_from_python_too(slide):
    assert values(slide / "m.json") == pytest.approx(values(slide / "p.json"), rel=1e-12)
    model = load_model(slide / "p.json")
    place = {"column": "run.x", "unit": "mm", "sign": -1}
    mapping = {"time": "run.t [ms]", "q1": place, "tau1": "run.F [kN]"}
    data = compare(model, [slide / "b.mat"], mapping).to_dict()
    twin = compare(model, [slide / "b.parquet"]).to_dict()
    assert data["relative_error"] == pytest.approx(twin["relative_error"], rel=1e-9)
    better = add(model, "asymmetric_viscous", [slide / "a.mat"], mapping=mapping)
    assert remove_last(better, [slide / "a.mat"], mapping).beta == pytest.approx(
        model.beta, rel=1e-9
    )


MAP = ["--map", "time=run.t:ms", "--map", "q1=-run.x:mm", "--map", "tau<j>=run.F:kN"]


def test_map_does_what_log_does(slide, tmp_path, run):
    status, _, err = run("fit", "emps", slide / "a.mat", *MAP, "--out", tmp_path / "f.json")
    assert (status, err) == (0, "")
    assert values(tmp_path / "f.json") == pytest.approx(values(slide / "p.json"), rel=1e-12)
    argv = ["fit", "emps", slide / "a.mat", "--holdout", slide / "b.mat", *MAP]
    status, _, err = run(*argv, "--method", "weighted,ordinary")
    assert (status, err) == (0, "")


def test_a_mistake_in_log_is_one_line(slide, tmp_path, run):
    bad = tmp_path / "bad.toml"
    bad.write_text(read_builtin_robot("emps") + MAT.replace("mm", "deg"))
    status, out, err = run("fit", bad, slide / "a.mat", "--out", tmp_path / "f.json")
    assert (status, out) == (1, "")
    assert (
        'emps: [log], q<j>: got unit "deg", which is an angle; q1 is a position of joint 1, ' in err
    )
    assert "which is prismatic: expected a unit such as mm, m, in" in err and err.count("\n") == 1


def test_an_output_is_not_named_like_a_log(slide, run):
    for ending in ("mat", "h5", "mcap"):
        status, _, err = run("fit", "emps", slide / "a.mat", "--out", f"x.{ending}")
        assert status == 1 and "this is a log; expected a name of its own" in err


@pytest.mark.parametrize("seed", [11, *rotating(12)])
def test_motion_that_a_controller_leaves_is_no_noise(seed, tmp_path, run):
    """It may be flat for octaves, and falls faster than the drift of a sensor then."""
    draw, t = np.random.default_rng(seed), np.arange(0.0, 20.0, 0.002)
    tones = 2.0 * np.pi * np.array([0.2, 0.35, 0.6])
    q = 0.4 * np.sin(tones * t[:, None] + draw.uniform(0.0, 6.0, 3)).sum(axis=1)
    low = butter(4, 8.0, fs=500.0, output="sos")
    q += 3e-3 * sosfilt(low, draw.normal(size=t.size)) + 2e-6 * draw.normal(size=t.size)
    rows = (f"{a:.3f},{b:.9f},{np.sin(a):.4f}\n" for a, b in zip(t, q, strict=True))
    (tmp_path / "log.csv").write_text("time,q1,tau1\n" + "".join(rows))
    [size] = re.findall(r"joint q1 ([\d.]+) mrad above \d+ Hz", run("log", tmp_path / "log.csv")[1])
    assert float(size) == pytest.approx(0.002, rel=0.2)
