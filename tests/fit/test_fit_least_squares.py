"""Least squares against numpy, its covariance against repetition; friction by direction."""

import json
from functools import cache

import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.estimation import identify, judge_fit, solve_least_squares
from modeler.estimation.parameters import select_essential_parameters
from modeler.estimation.result import read_fit
from modeler.numerics.least_squares import compress_rows, find_independent_columns
from modeler.regression import Log, Processing, observe
from modeler.robot import replace_effects
from tests.chain import chain_of

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
    fit = solve_least_squares(compress_rows(W, y, joint, 2, NAMES), "ordinary")
    beta, squares, _, _ = np.linalg.lstsq(W, y, rcond=None)
    np.testing.assert_allclose(fit.beta, beta, rtol=1e-10)
    variance = squares[0] / (len(y) - 4)
    np.testing.assert_allclose(fit.covariance, variance * np.linalg.inv(W.T @ W), rtol=1e-9)
    assert fit.condition_number == pytest.approx(np.linalg.cond(W), rel=1e-9)
    assert fit.condition_scaled == pytest.approx(
        np.linalg.cond(W / np.linalg.norm(W, axis=0)), rel=1e-9
    )


def test_weights_are_a_fixed_point_and_the_weighted_normal_equations_hold():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(2))
    fit = solve_least_squares(compress_rows(W, y, joint, 2, NAMES), "weighted")
    assert fit.is_converged and 1 < fit.iterations < 100
    weight = 1.0 / fit.sigma[joint]
    X = W * weight[:, None]
    np.testing.assert_allclose(X.T @ (weight * (y - W @ fit.beta)), 0.0, atol=1e-6)
    covariance = np.linalg.inv(X.T @ X)
    np.testing.assert_allclose(fit.covariance, covariance, rtol=1e-8)
    leverage = np.einsum("ri,ij,rj->r", X, covariance, X)
    assert leverage.sum() == pytest.approx(4.0)
    for j in (0, 1):
        mask = joint == j
        expected = np.sum((y - W @ fit.beta)[mask] ** 2) / (mask.sum() - leverage[mask].sum())
        assert fit.sigma[j] ** 2 == pytest.approx(expected, rel=1e-6)
    np.testing.assert_allclose(fit.sigma, (0.1, 2.0), rtol=0.15)


@pytest.mark.parametrize("method", ["ordinary", "weighted"])
def test_exact_data_joints_without_rows_and_without_torque_are_no_trouble(method):
    W, clean, joint, _ = problem()
    silent = (joint == 0)[:, None]
    for data in (
        compress_rows(W, clean, joint, 2, NAMES),
        compress_rows(W, clean, joint * 2, 4, NAMES),
        compress_rows(W * silent, clean * silent[:, 0], joint, 2, NAMES),
    ):
        fit = solve_least_squares(data, method)
        np.testing.assert_allclose(fit.beta, (1.0, -20.0, 0.3, 5.0), rtol=1e-9)
        assert np.isfinite(fit.covariance).all() and fit.is_converged


def test_what_the_data_cannot_tell_is_set_aside_by_name():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(6))
    twin = np.column_stack([W, 3.0 * W[:, 1] - W[:, 0], np.zeros(len(y))])
    fit = solve_least_squares(compress_rows(twin, y, joint, 2, (*NAMES, "E", "F")))
    assert len(fit.rank.kept_columns) == 4 and len(fit.rank.dropped_columns) == 2
    idle, tangled = fit.rank.dropped_columns
    assert idle.name == "F" and "not excited" in idle.describe()
    assert tangled.name in "ABE" and set(tangled.into) == set("ABE") - {tangled.name}
    assert f"{tangled.name} cannot be distinguished from" in tangled.describe()
    assert fit.rank.last_kept > 1e-3 and fit.rank.first_dropped < 1e-12
    place = [*NAMES, "E", "F"].index(tangled.name)
    assert fit.beta[place] == 0.0 and fit.covariance[place, place] == 0.0
    plain = solve_least_squares(compress_rows(W, y, joint, 2, NAMES))
    np.testing.assert_allclose(twin @ fit.beta, W @ plain.beta, atol=1e-8)
    none = find_independent_columns(np.zeros((5, 2)), ("A", "B"))
    assert none.kept_columns == () and [t.name for t in none.dropped_columns] == ["A", "B"]


def test_units_do_not_decide_the_rank():
    W, _, joint, measured = problem()
    y = measured(np.random.default_rng(7))
    scale = np.array([1e-6, 1e6, 1.0, 1e-3])
    plain = solve_least_squares(compress_rows(W, y, joint, 2, NAMES))
    scaled = solve_least_squares(compress_rows(W * scale, y, joint, 2, NAMES))
    np.testing.assert_allclose(scaled.beta * scale, plain.beta, rtol=1e-7)


@pytest.mark.parametrize("method", ["ordinary", "weighted"])
def test_parameters_without_effect_are_not_essential(method):
    dropped, kept_always = [], 0
    for seed in range(30):
        W, _, joint, measured = problem(seed, beta=(1.0, 0.0, 0.3, 0.0), noise=(0.5, 0.6))
        data = compress_rows(W, measured(np.random.default_rng(100 + seed)), joint, 2, NAMES)
        full = solve_least_squares(data, method)
        essential = select_essential_parameters(data, full, method)
        dropped += essential.dropped
        kept_always += {"A", "C"} <= set(essential.names)
        before, after = essential.compute_errors(data, full.beta)
        assert after >= before - 1e-3
        assert essential.ratio < essential.limit
        np.testing.assert_array_equal(essential.beta != 0.0, np.isin(NAMES, essential.names))
    assert kept_always == 30
    # 95 % test: 60 chances, about 3 false alarms.
    assert len(dropped) >= 50 and set(dropped) == {"B", "D"}


EVERY = ("viscous", "coulomb", "asymmetric_viscous", "offset")


@cache
def fitted_friction(effects):
    text = replace_effects(read_builtin_robot("two-link"), dict.fromkeys(effects, "all"))
    compiled = chain_of(text).compiled
    t = np.arange(3000) / 150.0
    w = 2 * np.pi * np.array([0.31, 0.53])
    q, qd = np.sin(t[:, None] * w), w * np.cos(t[:, None] * w)
    qdd = -(w**2) * q
    beta = np.linspace(0.5, 1.5, len(compiled.spec.base))
    tau = compiled.base_regressor(q, qd, qdd) @ beta
    tau += 0.1 * np.random.default_rng(2).normal(size=tau.shape)
    seen = observe(
        compiled, [Log("run", ("1", "2"), t, q, tau, qd, qdd)], Processing(parallel_cutoff=0.0)
    )
    return compiled, seen, judge_fit(compiled, seen, identify(seen, "ordinary"))


@pytest.mark.digits
def test_the_values_are_those_of_columns_for_each_direction():
    """Houda et al., Table 1: qd and sign(qd) where qd > 0, and where qd < 0; the same law."""
    _, seen, fit = fitted_friction(EVERY)
    smooth = [i for i, name in enumerate(seen.names) if name[:2] not in ("Fv", "Fs", "Of")]
    qd = seen.qd[seen.row_sample, seen.row_joint]
    columns, names = [seen.W[:, i] for i in smooth], [seen.names[i] for i in smooth]
    for j, joint in enumerate(seen.joints):
        for sign, one in (("+", 1.0), ("-", -1.0)):
            there = (seen.row_joint == j) & (qd * one > 0.0)
            columns += [np.where(there, qd, 0.0), np.where(there, one, 0.0)]
            names += [f"Fv{joint.name}{sign}", f"Fs{joint.name}{sign}"]
    W = np.column_stack(columns)
    beta, squares, _, _ = np.linalg.lstsq(W, seen.y, rcond=None)
    C = squares[0] / (len(seen.y) - W.shape[1]) * np.linalg.inv(W.T @ W)
    table = {item.name: item for item in fit.directions}
    assert set(table) == {name for name in names if name[-1] in "+-"}
    for i, name in enumerate(names):
        if name in table:
            assert table[name].value == pytest.approx(beta[i], rel=1e-8)
            # The sigmas of the fit are raised for residuals with a memory, by a little.
            assert 0.99 < table[name].sigma / C[i, i] ** 0.5 < 1.3
    assert table["Fv1-"].relation == "Fv1- = Fv1 - Fva1" and table["Fv1-"].unit == "N m s/rad"
    assert table["Fs2+"].relation == "Fs2+ = Fs2 + Off2" and table["Fs2+"].unit == "N m"
    # they are printed and saved
    assert "Fv1+ = Fv1 + Fva1" in "\n".join(fit.format_lines())
    raw = json.loads(json.dumps(fit.to_json(), allow_nan=False))
    first = raw["directions"][0]
    assert {"name", "value", "sigma", "relative_sigma_percent", "unit", "relation"} == set(first)
    assert read_fit(raw, fit.covariance).directions == fit.directions


def test_where_friction_has_one_law_there_is_nothing_to_tell():
    _, _, fit = fitted_friction(("viscous", "coulomb", "offset"))
    assert fit.directions == () and "direction" not in "\n".join(fit.format_lines())
    _, _, fit = fitted_friction(("viscous", "coulomb", "asymmetric_viscous"))
    table = {item.name: item for item in fit.directions}
    assert table["Fs1+"].value == table["Fs1-"].value and table["Fs1+"].relation == "Fs1+ = Fs1"
    assert table["Fv1+"].value != table["Fv1-"].value
