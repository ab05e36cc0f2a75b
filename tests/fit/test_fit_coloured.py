"""Standard deviations against repetition, residuals white and coloured."""

import dataclasses

import numpy as np
import pytest
from scipy.signal import lfilter
from stand_in import planar_arm
from test_observation_rows import exact_log, some_beta

from modeler.estimation.covariance import autocorrelation
from modeler.estimation.identify import identify
from modeler.observation.observation import observe
from modeler.observation.settings import Processing

RUNS = 40


def scores(memory):
    """(RUNS, c) errors in standard deviations, noise with that time constant, s; the last fit."""
    arm = planar_arm()
    beta = some_beta(arm)
    found = []
    for seed in range(RUNS):
        log = exact_log(arm, beta, seed=seed, seconds=20.0, rate=100)
        white = np.random.default_rng(900 + seed).normal(size=log.tau.shape)
        pole = np.exp(-log.step / memory) if memory else 0.0
        noise = 0.2 * np.sqrt(1.0 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)
        noisy = dataclasses.replace(log, tau=log.tau + noise)
        fit = identify(observe(arm, [noisy], Processing(parallel_cutoff=10.0)))
        found.append((fit.beta - beta) / [parameter.sigma for parameter in fit.parameters])
    return np.array(found), fit


def test_white_noise_sigmas_cover_the_truth():
    """rms 1 in units of sigma: 40 runs of 11 parameters leave 5 % of chance."""
    errors, fit = scores(0.0)
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(1.0, abs=0.15)
    assert 0.90 < np.mean(np.abs(errors) < 2.0) < 0.99
    assert not any("no white noise" in s for s in fit.sentences)


def test_coloured_noise_raises_them():
    errors, fit = scores(0.2)
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(1.0, abs=0.25)
    assert any("no white noise" in s for s in fit.sentences)


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
