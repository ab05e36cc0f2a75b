"""The energy model: honest sigmas, the verdict beside the torque model, what is refused."""

import dataclasses
import json

import numpy as np
import pytest
from test_observation_rows import exact_log, some_beta

from modeler.estimation.energy_fit import identify_energy, solve_heteroscedastic
from modeler.estimation.identify import build_base_equations, cross_validate, identify
from modeler.estimation.result import read_fit
from modeler.regression.observe import observe
from tests.modules import compiled

NOISE = np.array([0.2, 0.5])
SEEDS = 16


@pytest.fixture(scope="module")
def arm():
    return compiled("two-link")


def noisy_log(arm, seed, noise=NOISE, **kw):
    log = exact_log(arm, some_beta(arm), seed=seed, rate=100, **kw)
    return dataclasses.replace(
        log, tau=log.tau + noise * np.random.default_rng(500 + seed).normal(size=log.tau.shape)
    )


@pytest.fixture(scope="module")
def repeated(arm):
    """Observations and fits, and the scores (beta - truth) / sigma by method."""
    truth, fits = some_beta(arm), []
    scores = {"weighted": [], "ordinary": []}
    for seed in range(SEEDS):
        seen = observe(arm, [noisy_log(arm, seed, seconds=10)])
        fits.append((seen, identify_energy(arm, seen)))
        ordinary = fits[-1][1].rows.estimate(seen.names, "ordinary")
        for method, result in (("weighted", fits[-1][1].result), ("ordinary", ordinary)):
            scores[method].append((result.beta - truth) / np.sqrt(np.diag(result.covariance)))
    return fits, {method: np.array(values) for method, values in scores.items()}


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize("method", ["weighted", "ordinary"])
def test_the_sigmas_cover_the_truth(repeated, method):
    z = repeated[1][method]
    assert 0.85 < np.sqrt(np.mean(z**2)) < 1.12
    assert 0.9 < np.mean(np.abs(z) < 2.0) < 0.99
    assert np.all(np.abs(z.mean(axis=0)) < 4.0 / SEEDS**0.5)


def test_windows_at_rest_do_not_weigh_without_bound():
    """A robot that waits between moves, its drive noisy while it waits: 0 = 0 must not rule."""
    random = np.random.default_rng(3)
    shares = np.concatenate([np.full(60, 1e-12), random.uniform(0.5, 1.5, 60)])[:, None]
    W = random.normal(size=(120, 3))
    beta, z = np.array([1.0, -2.0, 0.5]), []
    for _ in range(40):
        y = W @ beta + np.sqrt(shares[:, 0] + 0.01) * random.normal(size=120)
        fit = solve_heteroscedastic(W, y, shares, ("A", "B", "C"), np.zeros(120, dtype=int))
        z.append((fit.beta - beta) / np.sqrt(np.diag(fit.covariance)))
    assert np.sqrt(np.mean(np.square(z))) == pytest.approx(1.0, abs=0.25)


def test_neighbours_that_repeat_each_other_raise_the_sigmas():
    random = np.random.default_rng(4)
    t = np.arange(400)
    W = np.column_stack([np.sin(t / 15.0), np.cos(t / 22.0)])
    z, raised = [], []
    for _ in range(30):
        white = random.normal(size=406)
        noise = np.convolve(white, np.ones(7), mode="valid")  # correlated over seven windows
        fit = solve_heteroscedastic(
            W, W @ [1.0, 2.0] + noise, np.ones((400, 1)), ("A", "B"), np.zeros(400, dtype=int)
        )
        z.append((fit.beta - [1.0, 2.0]) / np.sqrt(np.diag(fit.covariance)))
        raised.append(fit.autocorrelation_factor)
    assert np.median(raised) > 1.8 and np.sqrt(np.mean(np.square(z))) < 1.4


@pytest.fixture(scope="module")
def fitted(arm):
    seen = observe(arm, [noisy_log(arm, 7, seconds=20)])
    return seen, identify_energy(arm, seen)


def test_the_result_says_how_it_compares_with_the_torque_model(arm, fitted):
    fit = fitted[1]
    report = fit.result.energy
    torque, energy, coarse = report.figures
    assert [f.model for f in report.figures] == ["torque", "energy, Simpson", "energy, trapezoid"]
    assert torque.condition_scaled < energy.condition_scaled
    assert torque.torque_sigma < energy.torque_sigma and torque.rows > energy.rows
    (first, *_) = report.sentences
    assert report.uncertainty_ratio > 1.2 and "times the uncertainty of the torque model" in first
    assert "(torque model: " in first
    assert energy.imbalance < 0.1 * coarse.imbalance and energy.bias < coarse.bias
    assert fit.result.relative_error == pytest.approx(energy.torque_error)
    text = "\n".join(fit.result.format_lines())
    assert "energy, Simpson" in text and "integrals by Simpson's rule" in text
    alike = dataclasses.replace(energy, joint_sigma=torque.joint_sigma)
    like = dataclasses.replace(report, figures=(torque, alike, coarse)).sentences[0]
    assert "the energy model has at most " in like


def test_a_quiet_joint_beside_a_loud_one_is_not_overlooked(arm):
    """All torques together are as sure as before; those of the quiet joint are not."""
    truth, noise = some_beta(arm), np.array([1.0, 1e-3])
    seen = observe(arm, [noisy_log(arm, 7, noise, seconds=20)])
    fit = identify_energy(arm, seen)
    report, quiet = fit.result.energy, seen.row_joint == 1
    missed = [
        np.linalg.norm((seen.W @ (beta - truth))[quiet])
        for beta in (identify(seen).beta, fit.result.beta)
    ]
    torque, energy, _ = report.figures
    name = seen.joints[1].name
    assert report.uncertainty_ratio == energy.joint_sigma[name] / torque.joint_sigma[name]
    assert report.uncertainty_ratio > 5 * energy.torque_sigma / torque.torque_sigma
    assert 0.2 < report.uncertainty_ratio / (missed[1] / missed[0]) < 5  # the truth says the same
    assert f"the torques of joint {name} " in report.sentences[0]


@pytest.mark.rotating("long tests of fit")
def test_the_stated_uncertainty_of_the_torques_is_the_true_one(arm, repeated):
    """sqrt(tr(W C W^T)): mean square of the true error of predicted torques, over all fits."""
    truth, errors, stated = some_beta(arm), {0: [], 1: []}, {0: [], 1: []}
    for seen, fit in repeated[0]:
        for k, beta in enumerate((identify(seen).beta, fit.result.beta)):
            miss = np.linalg.norm(seen.W @ (beta - truth)) / np.linalg.norm(seen.y)
            errors[k].append(miss**2)
            stated[k].append(fit.result.energy.figures[k].torque_sigma ** 2)
    for k in (0, 1):
        assert np.mean(errors[k]) == pytest.approx(np.mean(stated[k]), rel=0.3)


def test_a_log_too_slow_for_the_rule_is_told(arm):
    log = exact_log(arm, some_beta(arm), seconds=60, rate=12)
    seen = observe(arm, [log])
    report = identify_energy(arm, seen).result.energy
    assert report.figures[1].bias > 0.5 and report.sentences[1].endswith("or move more slowly")


def test_it_is_saved_and_read_and_judged_by_its_own_errors(arm, fitted):
    seen, fit = fitted
    raw = json.loads(json.dumps(fit.result.to_json(), allow_nan=False))
    assert raw["model"] == "energy" and raw["energy"]["window"] == fit.rows.window
    assert set(raw["energy"]["figures"][1]) >= {"torque_error", "torque_sigma", "condition_scaled"}
    again = read_fit(raw, fit.result.covariance)
    assert again.energy == fit.result.energy and again.essential == fit.result.essential
    assert identify(seen).to_json()["model"] == "torque"
    assert identify(seen).to_json()["energy"] is None

    every, sigma = np.ones(len(seen.y), dtype=bool), NOISE
    items, torque = (
        cross_validate(build_base_equations(seen), every, sigma, refit).errors
        for refit in (fit.fit_without, None)
    )
    assert np.all(items > torque)  # segments are left out of the energies, not of the torques


def test_left_out_stretches_are_left_out_of_the_energies(arm, fitted):
    seen, fit = fitted
    held = (seen.time > 5.0) & (seen.time < 9.0)
    spoilt = fit.rows.y.copy()
    spoilt[(fit.rows.time[:, 0] > 5.1) & (fit.rows.time[:, 1] < 8.9)] += 1e3
    other = dataclasses.replace(fit, rows=dataclasses.replace(fit.rows, y=spoilt))
    np.testing.assert_array_equal(other.fit_without(held), fit.fit_without(held))
    assert not np.allclose(other.fit_without(held & False), fit.fit_without(held & False))
