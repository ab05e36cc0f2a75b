"""Least squares against numpy, its covariance against repetition, its weights against their law."""

import numpy as np
import pytest

from modeler.estimation.essential import essential_parameters
from modeler.estimation.least_squares import least_squares
from modeler.numerics.least_squares import compress, independent_columns

NAMES = ("A", "B", "C", "D")


def problem(seed=0, rows=(400, 300), noise=(0.1, 2.0), beta=(1.0, -20.0, 0.3, 5.0)):
    random = np.random.default_rng(seed)
    joint = np.repeat(np.arange(len(rows)), rows)
    W = random.normal(size=(len(joint), len(beta))) * [1.0, 0.1, 30.0, 1.0][: len(beta)]
    W[joint == 1, 0] = 0.0
    clean = W @ np.asarray(beta)
    return W, clean, joint, lambda r: clean + np.asarray(noise)[joint] * r.normal(size=len(joint))


def test_ordinary_is_numpys_and_its_covariance_is_the_textbooks():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(1))
    found = least_squares(compress(W, y, joint, 2, NAMES), "ordinary")
    beta, squares, _, _ = np.linalg.lstsq(W, y, rcond=None)
    np.testing.assert_allclose(found.beta, beta, rtol=1e-10)
    variance = squares[0] / (len(y) - 4)
    np.testing.assert_allclose(found.covariance, variance * np.linalg.inv(W.T @ W), rtol=1e-9)
    assert found.condition_number == pytest.approx(np.linalg.cond(W), rel=1e-9)
    assert found.condition_scaled == pytest.approx(
        np.linalg.cond(W / np.linalg.norm(W, axis=0)), rel=1e-9
    )


def test_weights_are_a_fixed_point_and_the_weighted_normal_equations_hold():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(2))
    found = least_squares(compress(W, y, joint, 2, NAMES), "weighted")
    assert found.settled and 1 < found.iterations < 100
    weight = 1.0 / found.sigma[joint]
    X = W * weight[:, None]
    np.testing.assert_allclose(X.T @ (weight * (y - W @ found.beta)), 0.0, atol=1e-6)
    covariance = np.linalg.inv(X.T @ X)
    np.testing.assert_allclose(found.covariance, covariance, rtol=1e-8)
    leverage = np.einsum("ri,ij,rj->r", X, covariance, X)
    assert leverage.sum() == pytest.approx(4.0)
    for j in (0, 1):
        own = joint == j
        expected = np.sum((y - W @ found.beta)[own] ** 2) / (own.sum() - leverage[own].sum())
        assert found.sigma[j] ** 2 == pytest.approx(expected, rel=1e-6)
    np.testing.assert_allclose(found.sigma, (0.1, 2.0), rtol=0.15)


def test_a_misfit_stays_on_its_joint():
    """Joint 2 reads 40 % too much and is noisier: iterated weights leave joint 1 alone."""
    random = np.random.default_rng(4)
    shared = random.normal(size=500)
    W = np.concatenate([shared, shared])[:, None]
    joint = np.repeat([0, 1], 500)
    y = np.where(joint == 0, 1.0, 1.4) * W[:, 0]
    y = y + np.where(joint == 0, 0.01, 0.3) * random.normal(size=1000)
    found = least_squares(compress(W, y, joint, 2, ("A",)))
    assert found.beta[0] == pytest.approx(1.0, abs=0.01)
    assert found.sigma[0] == pytest.approx(0.01, rel=0.2)
    ordinary = least_squares(compress(W, y, joint, 2, ("A",)), "ordinary")
    assert ordinary.beta[0] == pytest.approx(1.2, abs=0.03)


def test_exact_data_neither_divide_by_zero_nor_loop():
    W, clean, joint, _ = problem()
    for method in ("ordinary", "weighted"):
        found = least_squares(compress(W, clean, joint, 2, NAMES), method)
        np.testing.assert_allclose(found.beta, (1.0, -20.0, 0.3, 5.0), rtol=1e-9)
        assert np.isfinite(found.covariance).all() and found.settled


def test_a_joint_without_rows_or_torque_is_no_trouble():
    W, clean, joint, _ = problem()
    found = least_squares(compress(W, clean, joint * 2, 4, NAMES))
    np.testing.assert_allclose(found.beta, (1.0, -20.0, 0.3, 5.0), rtol=1e-9)
    W[joint == 1], clean[joint == 1] = 0.0, 0.0
    found = least_squares(compress(W, clean, joint, 2, NAMES))
    np.testing.assert_allclose(found.beta, (1.0, -20.0, 0.3, 5.0), rtol=1e-9)


def test_what_the_data_cannot_tell_is_set_aside_by_name():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(6))
    twin = np.column_stack([W, 3.0 * W[:, 1] - W[:, 0], np.zeros(len(y))])
    found = least_squares(compress(twin, y, joint, 2, (*NAMES, "E", "F")))
    assert len(found.rank.kept) == 4 and len(found.rank.aside) == 2
    idle, tangled = found.rank.aside
    assert idle.name == "F" and "not excited" in idle.sentence()
    assert tangled.name in "ABE" and set(tangled.into) == set("ABE") - {tangled.name}
    assert f"{tangled.name} cannot be told from" in tangled.sentence()
    assert found.rank.last_kept > 1e-3 and found.rank.first_dropped < 1e-12
    place = [*NAMES, "E", "F"].index(tangled.name)
    assert found.beta[place] == 0.0 and found.covariance[place, place] == 0.0
    plain = least_squares(compress(W, y, joint, 2, NAMES))
    np.testing.assert_allclose(twin @ found.beta, W @ plain.beta, atol=1e-8)
    none = independent_columns(np.zeros((5, 2)), ("A", "B"))
    assert none.kept == () and [t.name for t in none.aside] == ["A", "B"]


def test_units_do_not_decide_the_rank():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(7))
    scale = np.array([1e-6, 1e6, 1.0, 1e-3])
    plain = least_squares(compress(W, y, joint, 2, NAMES))
    scaled = least_squares(compress(W * scale, y, joint, 2, NAMES))
    np.testing.assert_allclose(scaled.beta * scale, plain.beta, rtol=1e-7)


@pytest.mark.parametrize("method", ["ordinary", "weighted"])
def test_parameters_without_effect_are_not_essential(method):
    dropped, kept_always = [], 0
    for seed in range(30):
        W, _, joint, measured = problem(seed, beta=(1.0, 0.0, 0.3, 0.0), noise=(0.5, 0.6))
        data = compress(W, measured(np.random.default_rng(100 + seed)), joint, 2, NAMES)
        full = least_squares(data, method)
        essential = essential_parameters(data, full, method)
        dropped += essential.dropped
        kept_always += {"A", "C"} <= set(essential.names)
        before, after = essential.errors(data, full.beta)
        assert after >= before - 1e-3
        assert essential.ratio < essential.limit
        np.testing.assert_array_equal(essential.beta != 0.0, np.isin(NAMES, essential.names))
    assert kept_always == 30
    # 95 % test: 60 chances, about 3 false alarms.
    assert len(dropped) >= 50 and set(dropped) == {"B", "D"}
