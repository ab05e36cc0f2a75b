"""Sigmas and bands hold the truth as often as they say, residuals white or not; masks say why."""

import dataclasses
from functools import cache

import numpy as np
import pytest
from scipy.signal import lfilter
from stand_in import planar_arm
from test_observation_rows import exact_log, some_beta

from modeler.estimation.covariance import autocorrelation
from modeler.estimation.identify import identify
from modeler.estimation.result import FitResult
from modeler.observation.observation import MASKS, WHY, masks_of
from modeler.observation.observe import observe
from modeler.observation.settings import Processing
from modeler.validation.prediction import DEVIATIONS, sigma_of

RUNS = 25


@cache
def repeated(memory: float) -> tuple[np.ndarray, np.ndarray, FitResult]:
    """Fits of runs whose noise has that time constant, s.

    (RUNS, c) errors in standard deviations; (RUNS,) share of the rows of other motion whose
    noiseless torque lies in the band; the last fit.
    """
    arm, cut = planar_arm(), Processing(parallel_cutoff=10.0)
    beta = some_beta(arm)
    other = observe(arm, [exact_log(arm, beta, seed=99, seconds=10.0, rate=100)], cut)
    log = exact_log(arm, beta, seed=1, seconds=30.0, rate=100)
    truth = other.predicted(beta)
    errors, inside = [], []
    for seed in range(RUNS):
        white = np.random.default_rng(500 + seed).normal(size=log.tau.shape)
        pole = np.exp(-log.step / memory) if memory else 0.0
        noise = 0.3 * np.sqrt(1.0 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)
        fit = identify(observe(arm, [dataclasses.replace(log, tau=log.tau + noise)], cut))
        errors.append((fit.beta - beta) / [parameter.sigma for parameter in fit.parameters])
        band = DEVIATIONS * sigma_of(other.columns, fit.covariance)
        missed = np.abs(other.predicted(fit.beta) - truth) > band
        inside.append(1.0 - np.mean(missed[other.used]))
    return np.array(errors), np.array(inside), fit


@pytest.mark.parametrize(("memory", "within"), [(0.0, 0.15), (0.2, 0.25)])
def test_sigmas_and_band_cover_the_truth(memory: float, within: float) -> None:
    """White noise and noise that lasts: rms 1 in units of sigma, two deviations hold 95 %.

    Noise that lasts needs motion that is long beside it: of 15 s the band holds 89 %.
    """
    errors, inside, fit = repeated(memory)
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(1.0, abs=within)
    assert 0.90 < np.mean(np.abs(errors) < 2.0) < 0.99
    assert 0.90 < np.mean(inside) < 0.99
    assert any("no white noise" in s for s in fit.sentences) is (memory > 0.0)


def test_the_band_is_the_spread_of_draws() -> None:
    """Against 4000 draws from N(beta, C), with units eight decades apart."""
    random = np.random.default_rng(3)
    columns = random.normal(size=(20, 2, 5)) * np.array([1e-6, 1.0, 1e3, 1.0, 1e5])
    root = random.normal(size=(5, 5)) / np.array([1e-6, 1.0, 1e3, 1.0, 1e5])[:, None]
    root[3] = 0.0  # set aside
    draws = columns @ (root @ random.normal(size=(5, 4000)))
    np.testing.assert_allclose(sigma_of(columns, root @ root.T), draws.std(axis=2), rtol=0.06)


def test_rows_say_why_they_do_not_count() -> None:
    """A torque at its limit for a second, one missing for half a second, and slow motion."""
    arm = planar_arm()
    log = exact_log(arm, some_beta(arm), seed=4, seconds=20.0, rate=100)
    tau = log.tau.copy()
    clipped = (log.time > 5.0) & (log.time < 6.0)
    tau[clipped, 0] = 1.05 * np.abs(tau).max()
    tau[(log.time > 12.0) & (log.time < 12.5), 1] = np.nan
    seen = observe(arm, [dataclasses.replace(log, tau=tau)], Processing(parallel_cutoff=10.0))
    masks = masks_of(seen)
    assert ((masks < 0) == seen.used).all()
    of = {name: masks == k for k, name in enumerate(MASKS)}
    middle = (seen.time > 5.1) & (seen.time < 5.9)
    assert of["torque at its limit"][middle, 0].all()
    assert not of["torque at its limit"][~clipped_near(seen.time), 0].any()
    assert of["no good value"][(seen.time > 12.1) & (seen.time < 12.4), 1].all()
    slow = of["low speed"][:, 0]
    floor = seen.report.processing.speed_floors["1"]
    assert slow.any() and np.abs(seen.qd[slow, 0]).max() < 3.0 * floor
    assert set(WHY) == set(MASKS)


def clipped_near(time: np.ndarray) -> np.ndarray:
    return (time > 4.8) & (time < 6.2)


def test_autocorrelation_ends_at_segments_gaps_and_where_white():
    random = np.random.default_rng(4)
    e = lfilter([1.0], [1.0, -0.8], random.normal(size=4000))
    whole = np.zeros(4000, dtype=int)
    r = autocorrelation(e, np.arange(4000), whole)
    np.testing.assert_allclose(r[:4], 0.8 ** np.arange(4), atol=0.06)
    white = autocorrelation(random.normal(size=4000), np.arange(4000), whole)
    assert len(white) <= 2
    alone = autocorrelation(e, np.arange(4000), np.arange(4000))
    np.testing.assert_array_equal(alone, [1.0])
    every_other = autocorrelation(e[::2], np.arange(0, 4000, 2), whole)
    np.testing.assert_array_equal(every_other, [1.0])  # no pair is one sample apart
    np.testing.assert_array_equal(autocorrelation(np.zeros(9), np.arange(9), whole), [1.0])
