"""B-splines and trapezoids beside Fourier series; what to record next, beside logs."""

import json
from dataclasses import replace

import numpy as np
import pytest

from modeler.api.motion import excite as next_to
from modeler.cli import main
from modeler.estimation import identify
from modeler.excitation.search import MotionRequest, build_task, design_motion, draw_random_motion
from modeler.excitation.series import CRITERIA, FAMILIES, PriorInformation, build_series
from modeler.excitation.thresholds import THRESHOLDS
from modeler.regression import Log, observe
from modeler.robot import read_robot
from modeler.simulation import build_curve, read_motion
from tests.chain import chain_of
from tests.excite.robots_to_excite import limits_of
from tests.rotation import rotating

NEW = sorted({*FAMILIES} - {"fourier"})


@pytest.mark.parametrize("family", FAMILIES)
def test_a_family_rests_at_its_ends_and_its_slopes_are_derivatives(family):
    rng = np.random.default_rng()
    x, t = rng.normal(size=(2, 9)), np.linspace(0.0, 3.0, 30001)
    q, qd, qdd = build_series(3.0, 5, t, family=family).evaluate_motion(x)
    assert np.allclose(qd[[0, -1]], 0.0) and np.allclose(qdd[[0, -1]], 0.0)
    assert np.allclose(q[0], q[-1]) and (family == "fourier" or np.allclose(q[0], x[:, 0]))
    for value, slope in ((q, qd), (qd, qdd)):
        middle = 0.5 * (slope[1:] + slope[:-1])
        assert np.allclose(np.diff(value, axis=0) / t[1], middle, atol=1e-3 * np.abs(slope).max())


@pytest.mark.parametrize("family", [NEW[0], *rotating(*NEW[1:])])
def test_no_limit_is_broken_between_samples(family):
    """Of a random motion as large as may be, and of the best one: twenty thousand places."""
    compiled, bounds = limits_of("scara")
    wish = MotionRequest(6.0, 3, "information", 1, family=family)
    motion = design_motion(compiled, bounds, wish)
    task, rng = build_task(compiled, bounds, wish, None, None, None), np.random.default_rng()
    even = task.series.refine_samples(10)
    fine = task.series.resample_at(np.linspace(0.0, 6.0, 20001))
    for x in (motion.x, *(draw_random_motion(task, rng) for _ in range(20))):
        for order, (coarse, seen) in enumerate(
            zip(even.evaluate_motion(x), fine.evaluate_motion(x), strict=True)
        ):
            middle = 0.0 if order else x[:, 0]
            assert np.all(
                np.abs(seen - middle).max(0) <= np.abs(coarse - middle).max(0) / even.room + 1e-12
            )
    q, qd, qdd = fine.evaluate_motion(motion.x)
    assert np.all(q <= bounds.upper) and np.all(q >= bounds.lower)
    assert np.all(np.abs(qd) <= bounds.speed) and np.all(np.abs(qdd) <= bounds.acceleration)
    assert (np.abs(qd) / bounds.speed).max() > 0.8  # they are used, too
    assert motion.quality.log_det > motion.random_log_det


def test_a_trapezoid_stops_at_its_places_and_its_jerk_is_constant_by_pieces():
    x, moves = np.random.default_rng().normal(size=(2, 7)), 7
    stops = build_series(7.0, 4, np.arange(moves + 1.0), family="trapezoid")
    q, qd, qdd = stops.evaluate_motion(x)
    assert np.allclose(q[1:-1], (x[:, :1] + x[:, 1:]).T) and np.allclose([qd, qdd], 0.0)
    t = np.arange(0.0, 1.0, 1.0 / 800.0) + 1.0 / 1600.0
    _, qd, qdd = build_series(7.0, 4, t + 2.0, family="trapezoid").evaluate_motion(x)
    jerk = np.diff(qdd[:, 0]) * 800.0
    levels = np.unique(np.round(jerk[np.abs(np.diff(jerk, prepend=jerk[0])) < 1e-6], 5) + 0.0)
    assert len(levels) == 3 and levels[1] == 0.0 and np.isclose(levels[0], -levels[2], rtol=1e-6)
    top = np.abs(qd[:, 0]) > (1 - 1e-9) * np.abs(qd[:, 0]).max()
    assert 0.2 < top.mean() < 0.3  # a quarter of its time at one speed


@pytest.mark.parametrize("family", [NEW[0], *rotating(*NEW[1:])])
def test_the_command_writes_a_family_in_the_same_columns(family, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(
        "modeler.excitation.search.THRESHOLDS", replace(THRESHOLDS, random_motions=7)
    )
    place, result = tmp_path / "m.csv", tmp_path / "m.json"
    words = ["excite", "two-link", "--family", family, "--duration", "4", "--starts", "1"]
    words += ["--harmonics", "3", "--laps", "2", "--picture", tmp_path / "m.svg"]
    words += ["--json", result, "--out", place]
    assert main([str(word) for word in words]) == 0, capsys.readouterr().err
    motion, raw = read_motion(place, ["1", "2"]), json.loads(result.read_text())
    assert raw["family"] == raw["series"]["family"] == family
    assert raw["random_motions"]["count"] == 7
    assert "best of 7 random" in (tmp_path / "m.svg").read_text()
    curve, t = build_curve(motion), np.linspace(0.0, 4.0, 1001)
    assert np.allclose(curve(t), curve(t + 4.0), atol=1e-6)
    for j, name in enumerate("12"):
        points = raw["series"]["points"][name]
        assert motion.q[0, j] == pytest.approx(points[0]) == pytest.approx(points[-1])
        assert raw["joints"][name]["speed"]["slack"] >= 0.0
        assert np.ptp(motion.q[:, j]) <= np.ptp(points) + 1e-9  # inside the hull of its points


# What to record next.


def test_the_slope_of_a_criterion_beside_logs_is_its_derivative():
    rng = np.random.default_rng()
    W, way = rng.normal(size=(2, 30, 5))
    known = PriorInformation(np.linalg.qr(rng.normal(size=(20, 5)), mode="r"), 50.0)
    value, h = known.extend_criterion(CRITERIA["information"], 2.0), 1e-6
    difference = (value(W + h * way)[0] - value(W - h * way)[0]) / (2 * h)
    assert np.sum(value(W)[1] * way) == pytest.approx(difference, rel=1e-5)
    stated = -np.linalg.slogdet(2.0 * W.T @ W + known.triangle.T @ known.triangle)[1] / 10
    assert value(W)[0] == pytest.approx(stated)


NOISE, RATE, STEP = np.array([0.3, 0.2, 0.1]), 250.0, 2 * np.pi / 2**16


@pytest.fixture(scope="module")
def recordings():
    """A function that records a motion of the demonstration arm, and its log of two joints."""
    robot, rng = read_robot("demo-arm"), np.random.default_rng()
    compiled = chain_of(robot).compiled
    beta = rng.uniform(0.5, 2.0, len(compiled.spec.base))

    def record(name: str, time, q, qd, qdd) -> Log:
        tau = compiled.inverse_dynamics(q, qd, qdd, beta) + NOISE * rng.normal(size=q.shape)
        return Log(name, ("1", "2", "3"), time, np.floor(q / STEP) * STEP, tau)

    t = np.arange(0.0, 12.0, 1.0 / RATE)
    waves = [(1.0, 2.1, 0.3, 0.9, 3.7), (0.7, 1.7, 1.0, 0.2, 4.1), (0.02, 2.3, 0.1, 0.02, 3.1)]
    parts = [
        [
            a * np.sin(w * t + p) + b * np.sin(v * t),
            a * w * np.cos(w * t + p) + b * v * np.cos(v * t),
            -a * w**2 * np.sin(w * t + p) - b * v**2 * np.sin(v * t),
        ]
        for a, w, p, b, v in waves
    ]
    old = record("old", t, *(np.column_stack([part[k] for part in parts]) for k in range(3)))
    return robot, compiled, record, old


def test_expected_sigmas_are_those_of_a_fit_of_old_and_new_logs(recordings):
    """Its third joint hardly moved: that is what the motion makes up for."""
    robot, compiled, record, old = recordings
    motion = next_to(robot, [old], rate=RATE, duration=8.0, starts=1, harmonics=4)
    gain, columns = motion.information_gain, motion.sample_motion(RATE)
    parts = (np.column_stack([columns[p + j] for j in "123"]) for p in ("q", "qd", "qdd"))
    new = record("new", columns["time"], *parts)
    real = identify(observe(compiled, [old, new]), "weighted", compiled)
    ratio = np.array(gain.after) / np.array([p.sigma for p in real.parameters])
    # A few sigmas are raised by chance, here or there, where speeds change sign.
    assert 0.8 < np.median(ratio) < 1.25 and np.mean((ratio > 0.7) & (ratio < 1.4)) > 0.7
    before = np.array([np.inf if a is None else a for a in gain.before])
    assert np.mean(np.array(gain.after) < before) > 0.7
    third = [name.endswith("3") for name in gain.names]
    assert np.median((before / gain.after)[third]) > 1.5
    assert "Fv3" in "".join(gain.format_lines()[2:8])
    assert gain.condition[1] < gain.condition[0]
