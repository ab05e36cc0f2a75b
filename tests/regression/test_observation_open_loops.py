"""Samples with which loops cannot be closed: reported, and left out of fit and judgement."""

import dataclasses
import json

import numpy as np
import pytest

from modeler.cli import main
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.observation import MASKS, classify_rows
from modeler.regression.observe import observe
from modeler.regression.prepare import find_nearest_closed
from tests.modules import compiled
from tests.regression.motions import some_beta, write
from tests.rotation import ROTATING

OUTWARD = np.array([-1.0, 1.0])
"""The arms of the five-bar part until both distal ones are stretched."""


def motion(reach, seconds=12.0):
    """(t, q, qd, qdd) of the five-bar; beyond about 0.945 rad it comes to where it cannot go."""
    t = np.arange(0.0, seconds, 0.005)
    waves = ((reach, 4.4, 0.0, OUTWARD), (0.12, 8.2, 0.3, np.ones(2)))
    q, qd, qdd = (
        sum(np.outer(a * w**k * np.sin(w * t + p + 0.5 * k * np.pi), d) for a, w, p, d in waves)
        for k in range(3)
    )
    return t, home() + q, qd, qdd


def home():
    """(2,) positions at home."""
    closure = compiled("five-bar").spec.closure
    return np.asarray(closure.home)[list(closure.actuated)]


def log_of(reach, noise=0.0):
    """A log, noise in N m, and (n,) True where the loops cannot be closed."""
    model = compiled("five-bar")
    t, q, qd, qdd = motion(reach)
    there = model.closing_status(q) == 0
    tau = np.zeros_like(q)
    phi = model.base_regressor(q[there], qd[there], qdd[there])
    tau[there] = phi @ some_beta(model)
    tau += np.random.default_rng(1).normal(scale=noise, size=tau.shape)
    return Log("run", ("11", "12"), t, q, tau, qd, qdd), ~there


def test_the_fit_does_without_the_samples_that_cannot_close():
    model = compiled("five-bar")
    log, open_ = log_of(0.95)
    assert 5 < open_.sum() < 40
    as_logged = Processing(
        parallel_cutoff=0.0,
        decimation=1,
        low_speed=0.0,
        keep_saturated=True,
        keep_contradicted=True,
        keep_damaged=True,
    )
    seen = observe(model, [log], as_logged)
    assert not seen.used[open_].any()
    assert seen.used[~open_].all()
    assert (classify_rows(seen)[open_] == MASKS.index("loops open")).all()
    assert np.isfinite(seen.columns).all()
    actual = np.linalg.lstsq(seen.W, seen.y, rcond=None)[0]
    np.testing.assert_allclose(actual, some_beta(model), rtol=1e-7)
    (line,) = (line for line in seen.report.collect_warnings() if "closed" in line)
    assert f"at {open_.sum()} of {len(log.time)} samples" in line
    assert f"first at {log.time[open_][0]:.6g} s" in line


def test_the_nearest_posture_that_closes_stands_in():
    model = compiled("five-bar")
    log, open_ = log_of(0.95)
    places = find_nearest_closed(model, log.q)
    all_places, good = np.arange(len(open_)), np.flatnonzero(~open_)
    assert (places[good] == good).all() and not open_[places].any()
    gaps = np.abs(all_places[:, None] - good).min(axis=1)
    np.testing.assert_array_equal(np.abs(places - all_places), gaps)
    assert find_nearest_closed(model, log.q[open_]) is None


@pytest.mark.rotating("long tests of observation")
@pytest.mark.parametrize("further", [False, pytest.param(True, marks=ROTATING)])
def test_fit_compare_diagnose_and_free_run_go_through(further, tmp_path, capsys):
    log, open_ = log_of(0.955, noise=0.3)
    data, model = write(tmp_path / "run.csv", log), str(tmp_path / "model.json")
    text = f"cannot be closed at {open_.sum()} of {len(log.time)} samples"
    assert main(["fit", "five-bar", data, "--out", model]) == 0
    assert text in capsys.readouterr().out
    report = tmp_path / "report.json"
    assert main(["compare", model, data, "--json", str(report)]) == 0
    if not further:
        return
    assert main(["diagnose", model, data, "--json", str(report)]) == 0
    assert json.loads(report.read_text())["verdict"] == "nothing significant"
    assert main(["compare", model, data, "--free-run"]) == 0


@pytest.mark.rotating("long tests of observation")
def test_all_samples_open_is_one_line(tmp_path, capsys):
    log, _ = log_of(0.5)
    q = home() + np.outer(2.0 + 0.5 * np.sin(4.4 * log.time), OUTWARD)
    apart = dataclasses.replace(log, q=q, qd=None, qdd=None)
    data = write(tmp_path / "run.csv", apart)
    assert main(["fit", "five-bar", data, "--out", str(tmp_path / "model.json")]) == 1
    said = capsys.readouterr().err.strip()
    assert ": run.csv: the loops of five-bar cannot be closed at" in said
    assert len(said.splitlines()) == 1 and "check units" in said
