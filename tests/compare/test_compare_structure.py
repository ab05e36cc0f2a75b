"""What a residual follows: effects, noise, orders, temperature, motors, known because put in."""

import dataclasses
import math

import numpy as np
import pytest
from known_defects import NOISE, PERIOD, Defect, judged_alone, prediction
from scipy.signal import lfilter

from modeler.core.figure import BLACK, BLUE, GREY, ORANGE, SLATE, VERMILLION
from modeler.core.table import format_percent
from modeler.numerics.spectra import compute_order_spectrum
from modeler.numerics.splines import build_hat_functions, fit_nonparametric_baseline
from modeler.regression.motion import compute_travel_since_reversal
from modeler.validation import verdict
from modeler.validation.comparison import JointComparison, compare
from modeler.validation.prediction import FullRate, JointInfo, Motor, Prediction
from modeler.views.comparison import build_comparison_page, draw_all_pictures
from modeler.views.page import render_page
from tests.rotation import rotating, with_cases
from tests.texts import read_matrix


def second_joint(defect: Defect | None, noise: float = NOISE, rows: int = 6000) -> JointComparison:
    (item,) = compare(judged_alone(prediction(defect, noise=noise, rows=rows))).joints
    return item


@with_cases(
    "coordinate, defect",
    ("velocity", lambda q, qd, qdd, tau, t: 0.5 * qd),
    ("direction", lambda q, qd, qdd, tau, t: 1.0 * np.sign(qd)),
    ("time", lambda q, qd, qdd, tau, t: 0.06 * (t % 30.0 - 15.0)),
    *rotating(
        ("load", lambda q, qd, qdd, tau, t: 0.1 * np.abs(tau) * np.sign(qd)),
        ("velocity", lambda q, qd, qdd, tau, t: 1.5 * np.sign(qd) * np.exp(-((qd / 0.4) ** 2))),
        ("position", lambda q, qd, qdd, tau, t: 0.5 * q),
        ("acceleration", lambda q, qd, qdd, tau, t: 0.2 * qdd),
    ),
)
def test_a_missing_effect_is_named_and_measured(coordinate: str, defect: Defect) -> None:
    p = prediction(defect)
    (item,) = compare(judged_alone(p)).joints
    missing = defect(p.q[:, 1], p.qd[:, 1], p.qdd[:, 1], p.predicted[:, 1], p.time)
    share = np.var(missing) / (np.var(missing) + NOISE**2)  # noise is independent of motion
    matches = verdict.find_best_pattern(item)
    assert matches is not None
    assert matches[0].id == coordinate
    assert matches[1] == pytest.approx(share, abs=0.08)
    assert verdict.classify_residual(item) == "pattern"
    assert "repeatable function of " + matches[0].phrase in verdict.write_joint_verdict(item)


def test_white_noise_has_no_structure() -> None:
    """The share is 0 within the chance of 3000 samples."""
    for item in compare(prediction(rows=3000)).joints:
        assert item.structure is not None and item.structure.own_motion < 0.01
        assert max(share for _, share in item.structure.shares) < 0.01
        assert max(share for _, share in item.structure.other_joints) < 0.01
        assert verdict.is_noise_like(item)
        assert "the residual looks like noise" in verdict.write_joint_verdict(item)
        assert "ripple of" not in verdict.write_joint_verdict(item)


def coloured(memory: float, seed: int) -> np.ndarray:
    """First-order noise of unit variance with autocorrelation exp(-t / memory), (6000,)."""
    pole = np.exp(-PERIOD / memory)
    white = np.random.default_rng(seed).normal(size=6500)
    return np.asarray(lfilter([np.sqrt(1 - pole**2)], [1, -pole], white))[500:]


@pytest.mark.parametrize("memory", [0.05, *rotating(0.2)])
def test_coloured_noise_is_neither_structure_nor_white(memory: float) -> None:
    for seed in range(2):
        item = second_joint(lambda q, qd, qdd, tau, t, s=seed: 3.0 * coloured(memory, s))
        assert item.structure is not None and item.spectrum is not None
        assert item.structure.own_motion < 0.05
        assert not verdict.is_noise_like(item)
        assert "yet it is not noise" in verdict.write_joint_verdict(item)
        # exp(-t / memory) falls to 0.2 at 1.6 memories
        assert item.spectrum.correlation_time == pytest.approx(1.6 * memory, rel=0.35)


@pytest.mark.parametrize(("share", "tolerance"), [(1.0, 0.08), (0.5, 0.12)])
def test_autocorrelation_of_first_order_noise(share: float, tolerance: float) -> None:
    """Masked rows are ignored."""
    p = prediction(lambda q, qd, qdd, tau, t: coloured(0.1, 3), noise=0.0)
    used = np.random.default_rng(0).random(p.used.shape) < share
    item = compare(dataclasses.replace(p, used=used)).joints[1]
    assert item.spectrum is not None
    expected = np.exp(-np.arange(8) * PERIOD / 0.1)
    np.testing.assert_allclose(item.spectrum.correlation[:8], expected, atol=tolerance)


def test_an_oscillation_is_found_at_its_frequency() -> None:
    item = second_joint(lambda q, qd, qdd, tau, t: np.sin(2 * np.pi * 11.0 * t))
    assert item.spectrum is not None
    assert item.spectrum.peak == pytest.approx(11.0, abs=0.2)
    # sine of unit amplitude: power 1/2, beside the noise
    assert item.spectrum.peak_share == pytest.approx(0.5 / (0.5 + NOISE**2), abs=0.08)
    assert "oscillates near 11 Hz" in verdict.write_joint_verdict(item)
    assert verdict.classify_residual(item) == "other"


@pytest.mark.parametrize("share", [1.0, 0.6])
def test_spectrum_keeps_the_power(share: float) -> None:
    """Parseval: the density sums to the variance, also when rows are masked."""
    p = prediction()
    used = np.random.default_rng(1).random(p.used.shape) < share
    (item,) = compare(judged_alone(dataclasses.replace(p, used=used))).joints
    assert item.spectrum is not None
    step = item.spectrum.frequency[0]
    assert item.spectrum.density.sum() * step == pytest.approx(NOISE**2, rel=0.08)


def test_nothing_is_correlated_across_segments() -> None:
    """Segments of 16 samples, each beginning with the value the one before ended with.

    Inside the segments the noise is white; correlating across them would give 1/16 at lag one.
    """
    rows = 24_000
    e = np.random.default_rng(2).normal(size=rows)
    e[16::16] = e[15:-1:16]
    p = prediction(lambda q, qd, qdd, tau, t: e, noise=0.0, rows=rows)
    (item,) = compare(judged_alone(dataclasses.replace(p, segment=np.arange(rows) // 16))).joints
    assert item.spectrum is not None
    assert abs(item.spectrum.correlation[1]) < 0.02
    assert item.spectrum.correlation_time == pytest.approx(PERIOD)


def test_long_logs_are_looked_at_sparsely_and_alike() -> None:
    item = second_joint(lambda q, qd, qdd, tau, t: 0.5 * qd, rows=60_000)
    matches = verdict.find_best_pattern(item)
    assert matches is not None and matches[0].id == "velocity"


@with_cases(
    "defect, noise, rows, words",
    (lambda q, qd, qdd, tau, t: np.full(t.size, -0.7), NOISE, 6000, "off by -0.7"),
    (None, NOISE, 150, "too few samples (150) to show"),
    (None, 0.0, 6000, "agree to rounding"),
)
def test_what_else_is_said_of_a_residual(defect, noise: float, rows: int, words: str) -> None:
    item = second_joint(defect, noise, rows)
    assert words in verdict.write_joint_verdict(item)
    assert (item.structure is None) == (rows == 150)
    if noise:
        assert not verdict.is_noise_like(item)


def test_share_is_that_of_unseen_blocks() -> None:
    """A function that holds in the first half only is not repeatable."""
    x = np.tile(np.linspace(-1.0, 1.0, 500), 8)
    whole = np.sin(3.0 * x)
    reversing = whole * np.where(np.arange(x.size) < 2000, 1.0, -1.0)
    fold = np.arange(x.size) * 8 // x.size
    assert fit_nonparametric_baseline([("x", build_hat_functions(x))], whole, fold).share > 0.98
    assert fit_nonparametric_baseline([("x", build_hat_functions(x))], reversing, fold).share == 0.0


def test_a_joint_that_never_moves() -> None:
    p = prediction()
    still = {name: getattr(p, name).copy() for name in ("q", "qd", "qdd")}
    for values in still.values():
        values[:, 1] = 0.0
    (item,) = compare(judged_alone(dataclasses.replace(p, **still))).joints
    assert item.structure is not None
    assert item.structure.get_share("velocity") < 0.01
    assert item.regions[2].samples == 6000


@pytest.mark.parametrize(
    ("share", "text"), [(0.033, "3.3 %"), (1e-9, "0 %"), (15.26, "1526 %"), (math.nan, "-")]
)
def test_percent(share: float, text: str) -> None:
    assert format_percent(share) == text


def test_travel_ignores_the_noise_of_the_encoder() -> None:
    t = np.linspace(0.0, 4 * np.pi, 200_001)
    noise = 1e-4 * np.random.default_rng(0).uniform(-1.0, 1.0, t.size)
    clean = compute_travel_since_reversal(np.sin(t))
    actual = compute_travel_since_reversal(np.sin(t) + noise, 1e-3)
    assert np.quantile(np.abs(actual - clean), 0.95) < 1e-3
    assert (
        compute_travel_since_reversal(np.sin(t) + noise).mean() < 0.01
    )  # every wiggle would be a turn


def test_travel_by_hand() -> None:
    actual = compute_travel_since_reversal(np.array([0.0, 2.0, 3.0, 3.0, 1.0, 0.0, 0.0, 4.0]))
    np.testing.assert_array_equal(actual, [0.0, 2.0, 3.0, 0.0, 2.0, 3.0, 0.0, 4.0])
    np.testing.assert_array_equal(compute_travel_since_reversal(np.ones(3)), np.zeros(3))


def test_what_follows_the_travel_is_named() -> None:
    p = prediction(seed=5)
    travel = [compute_travel_since_reversal(p.q[p.run == run, 1]) for run in (0, 1)]
    p = dataclasses.replace(p, travel=np.repeat(np.concatenate(travel)[:, None], 3, axis=1))
    extra = 2.0 * np.exp(-p.travel[:, 1] / 0.3) * np.sign(p.qd[:, 1])
    measured = p.measured.copy()
    measured[:, 1] += extra
    (item,) = compare(judged_alone(dataclasses.replace(p, measured=measured))).joints
    matches = verdict.find_best_pattern(item)
    assert matches is not None and matches[0].id == "travel"
    known = float(np.var(extra))
    assert matches[1] == pytest.approx(known / (known + NOISE**2), abs=0.08)
    assert "repeatable function of travel since the last reversal" in verdict.write_joint_verdict(
        item
    )


def with_temperature(p: Prediction, slope: float) -> Prediction:
    """20 to 40 degrees over each log; friction of joint 2 changes by `slope` N m per degree."""
    each = 20.0 + 20.0 * (p.time % 30.0) / 30.0
    measured = p.measured.copy()
    measured[:, 1] += slope * (each - 30.0) * np.sign(p.qd[:, 1])
    return dataclasses.replace(p, measured=measured, temperature=np.repeat(each[:, None], 3, 1))


def test_friction_that_changes_with_temperature() -> None:
    p = with_temperature(prediction(seed=5), 0.15)
    assert p.temperature is not None
    result = compare(p)
    share = result.joints[1].structure
    assert share is not None
    known = float(np.var(0.15 * (p.temperature[:, 1] - 30.0)))
    assert share.get_share("temperature") == pytest.approx(known / (known + NOISE**2), abs=0.08)
    assert "repeatable function of temperature" in verdict.write_joint_verdict(result.joints[1])
    rows = [row for picture in draw_all_pictures(result) for row in picture.panels]
    titles = [panel.title for row in rows for panel in row]
    assert sum(title.startswith("Temperature") for title in titles) == 3
    heat = draw_all_pictures(result)[0].panels[2][0].series[0]
    assert "temperature" in heat.columns
    part = np.where(p.run[:, None] == 1, np.nan, p.temperature)  # one log lacks it
    result = compare(dataclasses.replace(p, temperature=part))
    share = result.joints[1].structure
    assert share is not None and np.isnan(share.get_share("temperature"))
    assert "temperature" not in result.to_json()["joints"]["1"]["structure"]["shares"]
    assert "temperature [" not in render_page(build_comparison_page(result))


def test_friction_of_one_temperature_is_no_function_of_it() -> None:
    """Missing Coulomb friction: the direction explains it, and temperature adds nothing."""
    p = with_temperature(prediction(lambda q, qd, qdd, tau, t: np.sign(qd), seed=5), 0.0)
    share = compare(judged_alone(p)).joints[0].structure
    assert share is not None
    assert share.get_share("direction") > 0.7 and share.get_share("temperature") < 0.02


def at_full_rate(p: Prediction, joint: int, waves: float, amplitude: float) -> Prediction:
    """20 000 samples behind the rows, with a ripple that the rows are too few to show."""
    rng = np.random.default_rng(1)
    time = np.arange(20_000) * 0.001
    q = np.column_stack([np.sin(2 * np.pi * 0.11 * (k + 1) * time) for k in range(3)])
    left = NOISE * rng.normal(size=q.shape)
    left[:, joint] += amplitude * np.cos(waves * q[:, joint] + 0.4)
    run = np.repeat([0, 1], 10_000)
    return dataclasses.replace(p, full=FullRate(run, time, q, left, left))


@pytest.mark.parametrize(
    ("unit", "per", "shown"), [("rad", "turn", 47.0), *rotating(("m", "m", 47 / 6.283185))]
)
def test_a_known_order_is_found(unit: str, per: str, shown: float) -> None:
    p = at_full_rate(prediction(rows=1500), 1, 47.0, 0.6)
    p = dataclasses.replace(p, joints=tuple(JointInfo(n, unit, "N m") for n in "123"))
    result = compare(p)
    line = result.to_json()["joints"]["2"]["orders"][0]
    assert line["waves"] == pytest.approx(shown, rel=0.02)
    assert line["amplitude"] == pytest.approx(0.6, rel=0.25)  # the sine dwells at its ends
    # 0.6^2 / 2 over that and the noise
    assert line["share"] == pytest.approx(0.18 / (0.18 + 0.25), abs=0.15)
    assert f"waves per {per}, 0." in verdict.write_joint_verdict(result.joints[1])
    assert verdict.classify_residual(result.joints[1]) == "pattern"
    assert "ripple of" not in verdict.write_joint_verdict(result.joints[0])
    orders = draw_all_pictures(result)[4].panels[-1]
    panel = next(panel for panel in orders if panel.title.startswith("Order spectrum"))
    assert f"waves per {per}" in panel.title


def test_amplitude_of_a_wave_passed_evenly() -> None:
    q = np.linspace(0.0, 6.0, 50_000)
    result = compute_order_spectrum(q, 0.3 * np.sin(33.0 * q), "rad", np.inf)
    assert result is not None
    assert result.peaks[0] == pytest.approx(33.0, abs=0.3)
    assert result.amplitude.max() == pytest.approx(0.3, rel=0.02)
    assert compute_order_spectrum(np.ones(500), np.zeros(500), "rad", np.inf) is None


def coupled(motors: tuple[Motor, ...]) -> Prediction:
    """The motor of joints 2 and 3 rubs: on joint 2 with the sign of the sum of both speeds."""
    p = prediction(seed=2)
    measured = p.measured.copy()
    measured[:, 1] += 2.0 * np.sign(p.qd[:, 1] + 2.0 * p.qd[:, 2])
    return dataclasses.replace(p, measured=measured, motors=motors)


def test_the_speed_of_a_motor_is_told_from_that_of_a_joint() -> None:
    (item,) = compare(judged_alone(coupled((Motor("2+3", (0.0, 1.0, 2.0)),)))).joints
    text = verdict.write_joint_verdict(item)
    assert "follows the velocity of the motor that turns with joints 2 and 3" in text
    assert item.structure is not None
    assert dict(item.structure.motors)["2+3"] == pytest.approx(4.0 / 4.25, abs=0.06)


def test_without_a_coupling_the_other_joint_is_named_and_where_to_write_one() -> None:
    text = verdict.write_joint_verdict(compare(judged_alone(coupled(()))).joints[0])
    assert "follows the velocity of joint 3 more than its own, as where one motor turns" in text
    assert "[coupling] in the robot file" in text


def test_errors_of_each_log() -> None:
    p = prediction(rows=1500)
    p = dataclasses.replace(p, logs=("a_log_with_a_name_much_longer_than_most.parquet", "b"))
    result = compare(p)
    text = result.to_json()["by_log"]
    e = p.measured - p.predicted
    for run, log in enumerate(text):
        rows = p.run == run
        assert log["log"] == p.logs[run] and log["samples"] == 750
        assert log["relative_error"] == pytest.approx(
            np.linalg.norm(e[rows]) / np.linalg.norm(p.measured[rows])
        )
        for j, name in enumerate("123"):
            assert log["joints"][name] == pytest.approx(
                np.linalg.norm(e[rows, j]) / np.linalg.norm(p.measured[rows, j])
            )
    assert format_percent(text[1]["relative_error"]) in result.summary().splitlines()[-1]
    assert "Relative error by log" in render_page(build_comparison_page(result))


# Machado, Oliveira and Fernandes 2009, severity 1.0, for linear RGB.
_SEEN = {
    "all": np.eye(3),
    "protan": read_matrix("""
            0.152286 1.052583 -0.204868; 0.114503 0.786281 0.099216; -0.003882 -0.048116 1.051998
        """),
    "deutan": read_matrix("""
            0.367322 0.860646 -0.227968; 0.280085 0.672501 0.047413; -0.011820 0.042940 0.968881
        """),
    "tritan": read_matrix("""
            1.255528 -0.076749 -0.178779; -0.078411 0.930809 0.147602; 0.004733 0.691367 0.303900
        """),
}


def lab(colour: str, eye: str) -> np.ndarray:
    """CIE L*a*b* of an sRGB colour as that eye sees it."""
    srgb = np.array([int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)])
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    linear = np.clip(_SEEN[eye] @ linear, 0.0, 1.0)
    to_xyz = read_matrix("""
            0.4124564 0.3575761 0.1804375; 0.2126729 0.7151522 0.0721750;
            0.0193339 0.1191920 0.9503041
        """)
    xyz = to_xyz @ linear / np.array([0.95047, 1.0, 1.08883])
    f = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("eye", list(_SEEN))
def test_colours_of_one_panel_are_told_apart_by_every_eye(eye: str) -> None:
    """A difference of 20 in L*a*b* is seen at a glance; just noticeable is about 2."""
    shared = [(BLUE, VERMILLION, SLATE), (BLUE, VERMILLION, GREY), (BLACK, ORANGE), (BLUE, ORANGE)]
    for colours in shared:
        for k, one in enumerate(colours):
            for other in colours[k + 1 :]:
                assert np.linalg.norm(lab(one, eye) - lab(other, eye)) > 20.0, (one, other)
