"""Repeatable part and noise of a residual, where both are known because they were put in."""

import dataclasses

import numpy as np
import pytest
from known_defects import Defect, judged_alone, prediction

from modeler.numerics.spectra import estimate_lap_period
from modeler.validation.comparison import compare, estimate_scale
from modeler.validation.prediction import JointInfo, Prediction
from modeler.validation.residual_structure import find_repetitions
from modeler.validation.verdict import write_joint_verdict
from tests.rotation import rotating, with_cases

STEP, NOISE, KNOWN = 0.01, 0.5, 0.9  # s; N m, standard deviation of the noise; amplitude
WAVES = np.array([20.0, 15.0])  # 1/rad
PERIOD = 6.28  # s, of a lap


def motion(time: np.ndarray, period: float) -> np.ndarray:
    """(n, 2) rad: three harmonics, different on both joints."""
    w = 2 * np.pi / period
    return np.column_stack(
        [
            np.sin(w * time) + 0.4 * np.cos(2 * w * time + 0.3),
            0.8 * np.cos(w * time + 1.0) + 0.3 * np.sin(3 * w * time),
        ]
    )


def wandering(time: np.ndarray) -> np.ndarray:
    """(n, 2) rad: no period."""
    return np.column_stack(
        [
            np.sin(0.7 * time) + 0.6 * np.sin(1.13 * np.sqrt(2) * time + 0.02 * time**1.5),
            np.cos(0.9 * time) + 0.5 * np.sin(1.9 * np.sqrt(3) * time),
        ]
    )


def measured(parts: list[tuple[np.ndarray, np.ndarray]], known: float, seed: int) -> Prediction:
    """Logs of (time, q): torque 4 cos q, `known` * sin(20 q1 + 15 q2) on top, and white noise.

    So many waves that no curve over a coordinate can follow them: only repetition shows them.
    """
    rng = np.random.default_rng(seed)
    time, q = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    run = np.repeat(np.arange(len(parts)), [len(part[0]) for part in parts])
    qd = np.concatenate([np.gradient(part[1], part[0], axis=0) for part in parts])
    predicted = 4.0 * np.cos(q)
    extra = known * np.sin(q @ WAVES)[:, None]
    return Prediction(
        robot="two",
        joints=(JointInfo("1", "rad", "N m"), JointInfo("2", "rad", "N m")),
        logs=tuple(f"{k}.csv" for k in range(len(parts))),
        run=run,
        segment=run.copy(),
        time=time,
        q=q,
        qd=qd,
        qdd=np.zeros_like(q),
        measured=predicted + extra + NOISE * rng.normal(size=q.shape),
        predicted=predicted,
        used=np.ones(q.shape, dtype=bool),
    )


def check(p: Prediction, method: str, known: float, tolerance: float) -> None:
    """The three shares of both joints against what was put in."""
    repeated = float(np.mean((known * np.sin(p.q @ WAVES)) ** 2))
    for item in compare(p).joints:
        total = float(np.var(p.measured[:, item.index]))
        one = item.shares
        assert one is not None and one.method == method
        assert one.explained_share + one.systematic_share + one.noise_share == pytest.approx(1.0)
        assert one.systematic_share == pytest.approx(repeated / total, abs=tolerance / total)
        assert one.noise_share == pytest.approx(NOISE**2 / total, abs=tolerance / total)


@pytest.mark.parametrize(
    ("laps", "period", "start", "known", "seed"),
    [(5, PERIOD, 3.3, KNOWN, 1), (25, 4.123, 0.0, KNOWN, 2), *rotating((5, PERIOD, 3.3, 0.0, 1))],
)
def test_laps_in_one_log(laps: int, period: float, start: float, known: float, seed: int) -> None:
    """Standard error of the mean product of 5 laps: NOISE^2 / sqrt(10 pairs of 628 rows).

    Of 25 laps, an error of the period of one step would shift the last by half a second.
    """
    time = np.arange(0.0, laps * period, STEP)
    p = measured([(time + start, motion(time, period))], known, seed)
    (matches,) = find_repetitions(p)
    assert matches.kind == "laps"
    assert matches.periods[0] == pytest.approx(period, abs=2e-3 if laps == 5 else 2e-4)
    check(p, "laps", known, 0.03)


@pytest.mark.parametrize("known", [KNOWN, *rotating(0.0)])
def test_several_logs_of_one_motion(known: float) -> None:
    """Three logs, one begins later, one has another clock."""
    time = np.arange(0.0, 24.0, STEP)
    q = wandering(time)
    parts = [(time, q), (time[90:], q[90:]), (time + 100.37, q)]
    p = measured(parts, known, 3)
    (matches,) = find_repetitions(p)
    assert matches.kind == "logs"
    shifts = {(each.run, each.other): each.shift for each in matches.partners}
    assert shifts[0, 1] == pytest.approx(0.0, abs=1e-3)
    assert shifts[1, 2] == pytest.approx(100.37, abs=1e-3)
    check(p, "logs", known, 0.03)


def test_logs_of_other_motion_do_not_repeat() -> None:
    time = np.arange(0.0, 24.0, STEP)
    p = measured([(time, wandering(time)), (time, wandering(time + 9.0))], 0.0, 4)
    assert find_repetitions(p) == ()
    check(p, "smooth", 0.0, 0.01)


@with_cases(
    "defect, tolerance",
    (lambda q, qd, qdd, tau, t: 0.5 * qd, 0.1),
    *rotating((lambda q, qd, qdd, tau, t: np.full(t.size, 1.0), 0.05)),
)
def test_without_repetition_smooth_functions_tell(defect: Defect, tolerance: float) -> None:
    """0.5 qd is missing, or an offset: their mean squares are known."""
    p = prediction(defect, seed=3)
    result = compare(p).joints[1].shares
    assert result is not None and result.method == "smooth" and result.sigma is None
    total = float(np.var(p.measured[:, 1]))
    known = float(np.mean(defect(*(x[:, 1] for x in (p.q, p.qd, p.qdd, p.predicted)), p.time) ** 2))
    assert result.systematic_share == pytest.approx(known / total, rel=tolerance)
    assert result.noise_share == pytest.approx(0.25 / total, rel=0.15)


def test_what_returns_is_told_and_noise_is_not() -> None:
    time = np.arange(0.0, 5 * PERIOD, STEP)
    telling = compare(measured([(time, motion(time, PERIOD))], KNOWN, 1)).joints[0]
    # 0.5 * 0.9^2 over that and 0.5^2: 62 %
    text = write_joint_verdict(telling)
    assert "% of it returns in every lap" in text
    share = float(text.split(" % of it returns")[0].rsplit(" ", 1)[1])
    assert share == pytest.approx(62.0, abs=5.0)
    for seed in range(2):
        short = time[: time.size // 2]
        quiet = measured([(short, motion(short, PERIOD))], 0.0, seed)
        assert all("returns" not in write_joint_verdict(item) for item in compare(quiet).joints)


def test_standard_error_of_the_repeatable_share() -> None:
    """Its scatter over seeds is what it says."""
    time = np.arange(0.0, 3 * PERIOD, STEP)
    logs = [measured([(time, motion(time, PERIOD))], KNOWN, seed) for seed in range(12)]
    values = [compare(judged_alone(log, 0)).joints[0].shares for log in logs]
    scatter = np.std([each.systematic_share for each in values if each is not None])
    value = np.mean([each.sigma for each in values if each is not None and each.sigma is not None])
    assert 0.5 < value / scatter < 2.5  # the known part's own products count as scatter too


def test_masked_rows_and_few_rows() -> None:
    time = np.arange(0.0, 5 * PERIOD, STEP)
    p = measured([(time, motion(time, PERIOD))], KNOWN, 1)
    used = np.random.default_rng(0).random(p.used.shape) < 0.8
    check(dataclasses.replace(p, used=np.repeat(used[:, :1], 2, axis=1)), "laps", KNOWN, 0.05)
    few = np.zeros_like(p.used)
    few[::120] = True
    flat = np.full_like(p.measured, 2.0)
    for none in (dataclasses.replace(p, used=few), dataclasses.replace(p, measured=flat)):
        assert all(item.shares is None for item in compare(none).joints)


def test_a_held_joint_may_wobble() -> None:
    """Joint 2 is held: its noise has no period, and hides none."""
    time = np.arange(0.0, 5 * PERIOD, STEP)
    q = motion(time, PERIOD)
    q[:, 1] = 1e-4 * np.random.default_rng(0).normal(size=time.size)
    (matches,) = find_repetitions(measured([(time, q)], 0.0, 1))
    assert matches.periods[0] == pytest.approx(PERIOD, abs=0.002)


def test_no_lap_in_a_motion_that_wanders() -> None:
    time = np.arange(0.0, 40.0, STEP)
    assert estimate_lap_period(time, wandering(time)) == 0.0
    assert estimate_lap_period(time, np.zeros((time.size, 2))) == 0.0
    assert estimate_lap_period(time[:5], wandering(time[:5])) == 0.0


@with_cases(
    "factor, words",
    (-1.0, "the prediction of joint 2 has the opposite sign: measured is -1"),
    *rotating(
        (1.4, "the prediction of joint 2 is off by a factor: measured is 1.4"),
        (57.29578, "off by a factor: measured is 57"),
    ),
)
def test_a_wrong_sign_or_scale_is_one_sentence(factor: float, words: str) -> None:
    p = prediction(rows=1500)
    measured = p.measured.copy()
    measured[:, 1] *= factor
    first, second, _ = compare(dataclasses.replace(p, measured=measured)).joints
    assert words in write_joint_verdict(second)
    assert "repeatable function" not in write_joint_verdict(second)  # all of that follows from it
    assert "times predicted" not in write_joint_verdict(first)


def test_a_missing_effect_is_no_wrong_scale() -> None:
    for lack in (lambda q, qd, qdd, tau, t: 3.0 * np.sign(qd), lambda q, qd, qdd, tau, t: 2.0 * qd):
        item = compare(prediction(lack, rows=1500)).joints[1]
        assert item.scale is not None
        assert not item.scale.has_wrong_factor and not item.scale.has_opposite_sign


def test_scale_by_hand() -> None:
    """m = -2 p exactly, and each block from the other four; nothing comes of nothing."""
    p = np.random.default_rng(1).normal(size=200)
    fit = estimate_scale(-2.0 * p, p)
    assert fit is not None and fit.has_opposite_sign and fit.has_wrong_factor
    assert (fit.factor, fit.variance_reduction) == pytest.approx((-2.0, 1.0))
    assert estimate_scale(p, np.zeros(200)) is None and estimate_scale(p[:5], p[:5]) is None


@pytest.mark.parametrize("seed", [0, *rotating(1, 2, 3)])
def test_a_factor_is_stated_only_where_applying_it_lowers_the_residual(seed: int) -> None:
    """Measured torques that are another slope and a constant of the predicted ones."""
    rng = np.random.default_rng(seed)
    p = prediction(rows=1500)
    actual = p.predicted[:, 1]
    slope, shift = rng.uniform(0.6, 1.6), rng.uniform(-3.0, 3.0) * actual.std()
    measured = p.measured.copy()
    measured[:, 1] = slope * actual + shift
    item = compare(dataclasses.replace(p, measured=measured)).joints[1]
    _, stated, tail = write_joint_verdict(item).partition("measured is ")
    if stated:
        factor = float(tail.split()[0])
        left = np.linalg.norm(measured[:, 1] - factor * actual)
        assert left < 0.6 * np.linalg.norm(measured[:, 1] - actual), (slope, shift, factor)
