import dataclasses
import math

import numpy as np
import pytest
from known_defects import NOISE, PERIOD, Defect, judged_alone, prediction
from scipy.signal import lfilter

from modeler.core.table import percent
from modeler.numerics.splines import curve, flexible
from modeler.validation.comparison import JointComparison, compare
from modeler.validation.verdict import (
    best_pattern,
    headline,
    joint_verdict,
    kind_of_residual,
    looks_like_noise,
    verdict,
)


def second_joint(defect: Defect | None, noise: float = NOISE, rows: int = 6000) -> JointComparison:
    (item,) = compare(judged_alone(prediction(defect, noise=noise, rows=rows))).joints
    return item


@pytest.mark.parametrize(
    ("coordinate", "defect"),
    [
        ("velocity", lambda q, qd, qdd, tau, t: 0.5 * qd),
        ("velocity", lambda q, qd, qdd, tau, t: 1.5 * np.sign(qd) * np.exp(-((qd / 0.4) ** 2))),
        ("direction", lambda q, qd, qdd, tau, t: 1.0 * np.sign(qd)),
        ("position", lambda q, qd, qdd, tau, t: 0.5 * q),
        ("acceleration", lambda q, qd, qdd, tau, t: 0.2 * qdd),
        ("load", lambda q, qd, qdd, tau, t: 0.1 * np.abs(tau) * np.sign(qd)),
        ("time", lambda q, qd, qdd, tau, t: 0.06 * (t % 30.0 - 15.0)),
    ],
)
def test_a_missing_effect_is_named_and_measured(coordinate: str, defect: Defect) -> None:
    p = prediction(defect)
    (item,) = compare(judged_alone(p)).joints
    missing = defect(p.q[:, 1], p.qd[:, 1], p.qdd[:, 1], p.predicted[:, 1], p.time)
    share = np.var(missing) / (np.var(missing) + NOISE**2)  # noise is independent of motion
    found = best_pattern(item)
    assert found is not None
    assert found[0].id == coordinate
    assert found[1] == pytest.approx(share, abs=0.08)
    assert kind_of_residual(item) == "pattern"
    assert "repeatable function of " + found[0].phrase in joint_verdict(item)


def test_white_noise_has_no_structure() -> None:
    """The share is 0 within the chance of 3000 samples."""
    for seed in range(3):
        for item in compare(prediction(seed=seed, rows=3000)).joints:
            assert item.structure is not None
            assert item.structure.together < 0.01
            assert max(share for _, share in item.structure.shares) < 0.01
            assert max(share for _, share in item.structure.across) < 0.01
            assert looks_like_noise(item)
            assert "the residual looks like noise" in joint_verdict(item)


def coloured(memory: float, seed: int) -> np.ndarray:
    """First-order noise of unit variance with autocorrelation exp(-t / memory), (6000,)."""
    pole = np.exp(-PERIOD / memory)
    white = np.random.default_rng(seed).normal(size=6500)
    return np.asarray(lfilter([np.sqrt(1 - pole**2)], [1, -pole], white))[500:]


@pytest.mark.parametrize("memory", [0.05, 0.2])
def test_coloured_noise_is_neither_structure_nor_white(memory: float) -> None:
    for seed in range(2):
        item = second_joint(lambda q, qd, qdd, tau, t, s=seed: 3.0 * coloured(memory, s))
        assert item.structure is not None and item.spectrum is not None
        assert item.structure.together < 0.05
        assert not looks_like_noise(item)
        assert "yet it is not noise" in joint_verdict(item)
        # exp(-t / memory) falls to 0.2 at 1.6 memories
        assert item.spectrum.memory == pytest.approx(1.6 * memory, rel=0.35)


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
    assert "oscillates near 11 Hz" in joint_verdict(item)
    assert kind_of_residual(item) == "other"


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
    assert item.spectrum.memory == pytest.approx(PERIOD)


def test_long_logs_are_looked_at_sparsely_and_alike() -> None:
    item = second_joint(lambda q, qd, qdd, tau, t: 0.5 * qd, rows=60_000)
    found = best_pattern(item)
    assert found is not None and found[0].id == "velocity"


def test_another_joint_is_named() -> None:
    p = prediction()
    measured = p.measured.copy()
    measured[:, 1] += 1.0 * np.sign(p.qd[:, 2])
    (item,) = compare(judged_alone(dataclasses.replace(p, measured=measured))).joints
    assert "follows the velocity of joint 3 more than its own" in joint_verdict(item)
    assert kind_of_residual(item) == "pattern"


def test_an_offset_is_named() -> None:
    item = second_joint(lambda q, qd, qdd, tau, t: np.full(t.size, -0.7))
    assert "off by -0.7" in joint_verdict(item)
    assert not looks_like_noise(item)


def test_a_burst_is_told_with_its_moment() -> None:
    text = joint_verdict(second_joint(lambda q, qd, qdd, tau, t: 20.0 * (np.abs(t - 41.0) < 0.1)))
    assert (
        "s of two.parquet, 8" in text and "of the squared residual in 0.833 % of the time" in text
    )


def test_too_few_samples_are_admitted() -> None:
    item = second_joint(None, rows=150)
    assert item.structure is None
    assert "too few samples (150) to tell" in joint_verdict(item)
    assert kind_of_residual(item) == "other"


def test_a_perfect_prediction_is_said_so() -> None:
    item = second_joint(None, noise=0.0)
    assert "agree to rounding" in joint_verdict(item)
    assert item.relative_error == 0.0


def test_headline_and_unjudged() -> None:
    p = prediction(lambda q, qd, qdd, tau, t: 2.0 * qd)
    used = p.used.copy()
    used[:, 0] = False
    found = compare(dataclasses.replace(p, used=used))
    assert headline(found).endswith("(joint 2).")
    assert verdict(found)[-1] == "Joint 1 is not judged: no sample counts (all masked)."
    zero = dataclasses.replace(p, measured=np.zeros_like(p.measured))
    assert headline(compare(zero)) == "three: no joint could be judged."


def test_share_is_that_of_unseen_blocks() -> None:
    """A function that holds in the first half only is not repeatable."""
    x = np.tile(np.linspace(-1.0, 1.0, 500), 8)
    everywhere = np.sin(3.0 * x)
    reversing = everywhere * np.where(np.arange(x.size) < 2000, 1.0, -1.0)
    fold = np.arange(x.size) * 8 // x.size
    assert flexible([("x", curve(x))], everywhere, fold).share > 0.98
    assert flexible([("x", curve(x))], reversing, fold).share == 0.0


def test_a_joint_that_never_moves() -> None:
    p = prediction()
    still = {name: getattr(p, name).copy() for name in ("q", "qd", "qdd")}
    for values in still.values():
        values[:, 1] = 0.0
    (item,) = compare(judged_alone(dataclasses.replace(p, **still))).joints
    assert item.structure is not None
    assert item.structure.share("velocity") < 0.01
    assert item.regions[2].samples == 6000


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.033, "3.3 %"), (0.4123, "41.2 %"), (1e-9, "0 %"), (15.26, "1526 %"), (math.nan, "-")],
)
def test_percent(share: float, text: str) -> None:
    assert percent(share) == text
