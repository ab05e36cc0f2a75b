"""Robust, ridge, ordinary and instruments on made-up rows of known noise, against repetition.

Rows without a robot: 200 repetitions take a second, and the noise is exactly what it is said to be.
"""

from types import SimpleNamespace

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.estimation.instrumental import estimate_with_instruments
from modeler.estimation.least_squares import (
    Problem,
    estimate_ordinary,
    estimate_ridge,
    estimate_robust,
    solve_least_squares,
)
from modeler.numerics.least_squares import compress_rows

BETA = np.array([1.0, -2.0, 0.3, 5.0])
NOISE = np.array([0.5, 0.05])
ROWS = (120, 80)


def problem_of(W, y, joint):
    """As much of an observation as these estimators look at, and its rows."""
    seen = SimpleNamespace(
        row_joint=joint,
        joints=[SimpleNamespace(name=name) for name in "12"],
        names=("A", "B", "C", "D"),
        logs=("made up",),
    )
    data = compress_rows(W, y, joint, len(ROWS), seen.names)
    return Problem(seen, W, y, np.ones(len(y), dtype=bool), seen.names, data)


def rows(random):
    joint = np.repeat([0, 1], ROWS)
    W = random.normal(size=(len(joint), 4)) * [1.0, 0.2, 3.0, 1.0]
    W[joint == 1, 0] = 0.0
    return W, joint, NOISE[joint] * random.normal(size=len(joint))


def scores(estimate, truth=BETA):
    return (estimate.beta - truth) / np.sqrt(np.diag(estimate.covariance))


def repeated(make, count=150, seed=0):
    """(count, c) z, of estimates that `make` returns, from a random generator each."""
    return np.array([scores(*make(np.random.default_rng([seed, k]))) for k in range(count)])


def assert_standard(z, bias=0.35, low=0.88, high=1.15):
    rms = np.sqrt(np.mean(z**2, axis=0))
    assert np.all(np.abs(z.mean(axis=0)) < bias), z.mean(axis=0)
    assert np.all((rms > low) & (rms < high)), rms
    assert 0.90 < np.mean(np.abs(z) < 2) < 0.99


@pytest.mark.parametrize(
    "estimator", [estimate_robust, estimate_ordinary], ids=["robust", "ordinary"]
)
def test_sigmas_are_what_repetition_shows_where_joints_differ(estimator):
    def make(random):
        W, joint, noise = rows(random)
        return (estimator(problem_of(W, W @ BETA + noise, joint)),)

    assert_standard(repeated(make))


def test_robust_stands_rows_that_are_wrong_and_weighted_does_not():
    def make(estimator):
        def made(random):
            W, joint, noise = rows(random)
            bad = random.random(len(noise)) < 0.08
            noise = np.where(bad, 20 * NOISE[joint] * (1 + random.random(len(noise))), noise)
            return (estimator(problem_of(W, W @ BETA + noise, joint)),)

        return made

    z = repeated(make(estimate_robust))
    assert_standard(z, bias=0.5, high=1.25)
    spread = {
        name: np.std([make(e)(np.random.default_rng(k))[0].beta for k in range(30)], axis=0)
        for name, e in (
            ("robust", estimate_robust),
            ("weighted", lambda p: solve_least_squares(p.data)),
        )
    }
    assert np.all(spread["robust"] < 0.3 * spread["weighted"])


def test_robust_loses_five_per_cent_of_efficiency_on_gaussian_noise():
    table = {"robust": [], "weighted": []}
    for k in range(100):
        W, joint, noise = rows(np.random.default_rng([7, k]))
        problem = problem_of(W, W @ BETA + noise, joint)
        table["robust"].append(estimate_robust(problem).beta - BETA)
        table["weighted"].append(solve_least_squares(problem.data).beta - BETA)
    variance = {name: np.var(values, axis=0) for name, values in table.items()}
    assert np.mean(variance["weighted"] / variance["robust"]) == pytest.approx(0.93, abs=0.08)


def test_robust_tells_rows_that_lie_far_off_and_nothing_on_clean_ones():
    W, joint, noise = rows(np.random.default_rng(4))
    y = W @ BETA + noise
    assert estimate_robust(problem_of(W, y, joint)).sentences == ()
    y[:15] += 30.0
    (said,) = estimate_robust(problem_of(W, y, joint)).sentences
    assert "joint 1: 13.3 % of its rows" in said
    assert np.all(estimate_robust(problem_of(W, W @ BETA, joint)).covariance.diagonal() < 1e-12)


def test_ridge_holds_its_sigma_where_values_scatter_as_the_prior_says():
    """Values drawn about 0 as wide as the columns are short: the model that lambda stands for."""

    def make(random):
        W, joint, noise = rows(random)
        W[:, 3] = W[:, 2] * 3.0 + 0.05 * random.normal(size=len(W))  # all but one column
        lengths = np.linalg.norm(W / NOISE[joint][:, None], axis=0)
        truth = 300.0 * random.normal(size=4) / lengths
        return estimate_ridge(problem_of(W, W @ truth + noise, joint)), truth

    assert_standard(repeated(make), bias=0.4, high=1.2)


def test_ridge_shares_out_what_cannot_be_told_and_sets_columns_of_zeros_aside():
    W, joint, noise = rows(np.random.default_rng(8))
    W[:, 3] = 2.0 * W[:, 2]
    W[:, 1] = 0.0
    fit = estimate_ridge(problem_of(W, W @ [1.0, 0.0, 1.0, 0.0] + noise, joint))
    assert fit.rank.kept_columns == (0, 2, 3) and fit.covariance[1, 1] == 0.0
    assert fit.beta[2] + 2.0 * fit.beta[3] == pytest.approx(1.0, abs=0.02)
    assert fit.beta[2] / fit.beta[3] == pytest.approx(2.0, abs=0.01)
    assert any("is not identifiable apart from" in said for said in fit.sentences)


def noisy(random, strength=0.5, shift=0.0):
    """Rows whose W is measured with noise, and instruments that it does not touch."""
    clean, joint, noise = rows(random)
    W = clean + strength * clean.std(axis=0) * random.normal(size=clean.shape) * (clean != 0.0)
    Z = clean + 0.3 * clean.std(axis=0) * random.normal(size=clean.shape) + shift
    return problem_of(W, clean @ BETA + noise, joint), Z


def test_instruments_are_right_where_noise_of_the_regressor_bends_least_squares():
    usual = [solve_least_squares(noisy(np.random.default_rng(k))[0].data).beta for k in range(80)]
    assert np.all(np.mean(usual, axis=0) / BETA < 0.9)  # 1 / (1 + 0.5^2) = 0.8

    def make(random):
        problem, Z = noisy(random)
        return (estimate_with_instruments(problem, Z, "iv"),)

    assert_standard(repeated(make), bias=0.3, low=0.85, high=1.2)


def test_instruments_that_are_the_columns_themselves_give_the_weighted_fit():
    W, joint, noise = rows(np.random.default_rng(3))
    problem = problem_of(W, W @ BETA + noise, joint)
    result = estimate_with_instruments(problem, W, "iv")
    weighted = solve_least_squares(problem.data)
    np.testing.assert_allclose(result.beta, weighted.beta, rtol=1e-7)
    np.testing.assert_allclose(result.covariance, weighted.covariance, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(result.sigma, weighted.sigma, rtol=1e-6)


def test_weak_instruments_are_told_and_blind_ones_refused():
    W, joint, noise = rows(np.random.default_rng(3))
    problem = problem_of(W, W @ BETA + noise, joint)
    random = np.random.default_rng(9)
    weak = estimate_with_instruments(
        problem, W + 12 * W.std(axis=0) * random.normal(size=W.shape), "iv"
    )
    assert any("instruments are weak" in said for said in weak.sentences)
    blind = W.copy()
    blind[:, 2] = blind[:, 3]
    with pytest.raises(
        DataError, match=r'method "iv": [CD] is not identifiable by the instruments;'
    ):
        estimate_with_instruments(problem, blind, "iv")
