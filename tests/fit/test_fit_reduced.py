"""Sigmas and bands hold the truth as often as they say; the reduced model has values of its own."""

import dataclasses
import json
import sys
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter
from test_observation_rows import exact_log, some_beta

from modeler.core.errors import DataError
from modeler.estimation import (
    IdentifiedModel,
    estimate_autocorrelation,
    identify,
    load_model,
    solve_least_squares,
)
from modeler.estimation.model_file import collect_provenance, keep_essential, save_model
from modeler.estimation.parameters import select_essential_parameters
from modeler.estimation.result import FitResult, read_fit
from modeler.numerics.least_squares import compress_rows
from modeler.regression import MASKS, WHY, Processing, classify_rows, observe
from modeler.validation.prediction import propagate_covariance
from modeler.validation.thresholds import THRESHOLDS
from tests.modules import compiled
from tests.oracles.numpy_model import planar_arm
from tests.rotation import rotating

NOISE = 0.3


@pytest.fixture(scope="module")
def robot():
    """An arm with some parameters of 0."""
    arm = planar_arm()
    beta = some_beta(arm)
    beta[[2, 5, 9]] = 0.0
    return arm, beta


def seen_and_fit(robot, seed=0):
    arm, beta = robot
    log = exact_log(arm, beta, seed=seed, seconds=10)
    noise = NOISE * np.random.default_rng(70 + seed).normal(size=log.tau.shape)
    seen = observe(arm, [dataclasses.replace(log, tau=log.tau + noise)])
    return seen, identify(seen, "ordinary")


@pytest.fixture(scope="module")
def fitted(robot):
    return seen_and_fit(robot)


def test_it_is_the_fit_of_the_smaller_table(fitted):
    seen, fit = fitted
    reduced = fit.essential
    assert 0 < len(reduced.dropped_parameters) <= 5
    names = [p.name for p in reduced.parameters]
    assert names == [p.name for p in fit.parameters if p.essential]
    W = seen.W[:, [seen.names.index(name) for name in names]]
    beta, squares, _, _ = np.linalg.lstsq(W, seen.y, rcond=None)
    assert_allclose([p.value for p in reduced.parameters], beta, rtol=1e-8)
    sigma = np.sqrt(squares[0] / (len(W) - len(names)) * np.diag(np.linalg.inv(W.T @ W)))
    ratio = [p.sigma for p in reduced.parameters] / sigma
    assert np.all((ratio > 0.99) & (ratio < 1.5))  # raised where residuals have a memory
    assert reduced.condition_number == pytest.approx(np.linalg.cond(W), rel=1e-8)
    assert reduced.condition_number < fit.condition_number
    assert reduced.relative_error == fit.essential_error
    assert reduced.f_statistic < reduced.f_limit


@pytest.mark.rotating("long tests of fit")
def test_its_sigmas_cover_the_truth_and_are_smaller(robot):
    arm, beta = robot
    truth = dict(zip((base.name for base in arm.spec.base), beta, strict=True))
    z, shrunk = [], []
    for seed in range(12):
        _, fit = seen_and_fit(robot, seed)
        if set(fit.essential.dropped_parameters) <= {
            name for name, value in truth.items() if value == 0.0
        }:
            full = {p.name: p.sigma for p in fit.parameters}
            z += [(p.value - truth[p.name]) / p.sigma for p in fit.essential.parameters]
            shrunk += [p.sigma / full[p.name] for p in fit.essential.parameters]
    assert len(z) > 50 and np.sqrt(np.mean(np.square(z))) == pytest.approx(1.0, abs=0.2)
    # Each is raised for the memory of its own residuals, which scatters by a tenth.
    assert max(shrunk) < 1.2 and np.mean(shrunk) < 0.97


def test_it_is_told_and_saved(fitted):
    _, fit = fitted
    lines = fit.format_lines()
    (told,) = (line for line in lines if line.startswith("reduced model: "))
    assert f"{len(fit.essential.parameters)} of 13 parameters; cross-validated error" in told
    rows = {line.split()[0]: line.split() for line in lines[:14]}
    assert rows["parameter"] == ["parameter", "value", "sigma", "%sigma", "reduced", "unit"]
    values = {p.name: f"{p.value:.6g}" for p in fit.essential.parameters}
    values |= dict.fromkeys(fit.essential.dropped_parameters, "-")
    assert {name: rows[name][4] for name in values} == values
    raw = json.loads(json.dumps(fit.to_json(), allow_nan=False))
    assert read_fit(raw, fit.covariance).essential == fit.essential
    raw["essential"] = None
    assert read_fit(raw, fit.covariance).essential is None


def test_a_model_predicts_with_it(robot, fitted, tmp_path):
    (arm, _), (seen, fit) = robot, fitted
    model = IdentifiedModel("name = 'arm'\n", arm.spec, {}, fit, collect_provenance(seen.report))
    save_model(tmp_path / "m.json", model)
    small = keep_essential(load_model(tmp_path / "m.json"), "m.json")
    values = {p.name: p.value for p in fit.essential.parameters}
    assert list(small.beta) == [values.get(name, 0.0) for name in seen.names]
    assert small.fit.relative_error == fit.essential_error
    old = dataclasses.replace(model, fit=dataclasses.replace(fit, essential=None))
    with pytest.raises(DataError, match=r"m.json: holds no reduced model .*; fit it again"):
        keep_essential(old, "m.json")


def test_a_reduced_model_is_offered_only_where_it_describes_every_joint(robot):
    """A quiet joint beside a loud one, whose prior or weights hide what it loses."""
    arm, beta = robot
    names = tuple(base.name for base in arm.spec.base)
    raised = []
    for seed in range(6):
        rng = np.random.default_rng(seed)
        q, qd, qdd = rng.normal(size=(3, 60, 2))
        W = arm.base_regressor(q, qd, qdd).reshape(-1, len(names))
        joint = np.tile([0, 1], 60)
        small = beta * rng.uniform(0.0, 0.4, len(names))
        y = W @ small + np.where(joint == 0, 3.0, 0.3) * rng.normal(size=120)
        data = compress_rows(W, y, joint, 2, names)
        full = solve_least_squares(data, "ordinary")
        essential = select_essential_parameters(data, full, "ordinary")
        raised += list(
            data.compute_residual_norms(essential.beta) / data.compute_residual_norms(full.beta)
        )
    assert max(raised) < 1.06


def test_a_reduced_model_that_predicts_worse_is_not_offered(fitted, monkeypatch):
    seen, fit = fitted
    assert fit.essential.dropped_parameters and "cross-validated error" in " ".join(fit.sentences)
    module = sys.modules["modeler.estimation.identify"]
    monkeypatch.setattr(module, "compute_held_out_errors", lambda *_: ((0.01, 0.02), False))
    refused = identify(seen, "ordinary")
    assert not refused.essential.dropped_parameters and refused.essential.f_limit is None
    assert all(p.essential for p in refused.parameters)
    assert not any(line.startswith("reduced model: ") for line in refused.format_lines())
    assert any(
        "no reduced model: one by an F-test; cross-validated error 2 % (full model: 1 %)" in s
        for s in refused.sentences
    )


def known_set(arm, seed):
    """Rows along a motion of an Orthoglide, of values of which ten are 0, and those ten.

    The least certain of the others is 5 to 10 times its sigma, were the ten known.
    """
    rng, names = np.random.default_rng(1000 + seed), tuple(base.name for base in arm.spec.base)
    joints, home = len(arm.spec.joints), np.array(arm.spec.closure.home)
    time = np.linspace(0.0, 10.0, 400)[:, None]
    q, qd, qdd = (np.zeros((400, joints)) for _ in range(3))
    for w in 2.0 * np.pi * np.arange(1, 6) / 10.0:
        a, b = rng.normal(size=(2, joints)) / w
        q += a * np.cos(w * time) + b * np.sin(w * time)
        qd += w * (b * np.cos(w * time) - a * np.sin(w * time))
        qdd -= w**2 * (a * np.cos(w * time) + b * np.sin(w * time))
    size = 0.06 / np.abs(q).max(axis=0)
    W = arm.observation(home[list(arm.spec.closure.actuated)] + size * q, size * qd, size * qdd)
    beta = rng.uniform(0.3, 2.0, len(names)) * rng.choice([-1, 1], len(names))
    none = rng.choice(len(names), 10, replace=False)
    beta[none] = 0.0
    kept = np.flatnonzero(beta)
    sigma = np.sqrt(np.diag(np.linalg.inv(W[:, kept].T @ W[:, kept])))
    least = np.min(np.abs(beta[kept]) / sigma) / (5, 7, 10)[seed % 3]
    joint = np.tile(np.arange(joints), len(time))
    y = W @ beta + least * rng.normal(size=len(W))
    return compress_rows(W, y, joint, joints, names), {names[k] for k in none}


def test_known_sets_are_found_among_columns_that_are_alike():
    """Backward selection alone finds 10 of these 24."""
    orthoglide, found, better = compiled("orthoglide-2003-similar-legs"), 0, 0
    for seed in range(24):
        data, none = known_set(orthoglide, seed)
        picks = select_essential_parameters(data, solve_least_squares(data, "ordinary"), "ordinary")
        found += set(picks.dropped) == none
        kept = [data.names.index(name) for name in picks.names]
        out = [data.names.index(name) for name in picks.dropped]
        better += any(some_exchange_is_better(data, kept, out))
    assert found >= 12 and better == 0


def some_exchange_is_better(data, kept, out):
    """Whether the least squares fall with one of `out` in place of each column that is kept."""
    R = data.combine_joints(np.ones(len(data.rows)))

    def left(columns, of):
        Q = np.linalg.qr(R[:, columns])[0]
        return of - Q @ (Q.T @ of)

    least = np.sum(left(kept, R[:, -1]) ** 2) * (1.0 - 1e-9)
    for old in kept:
        *others, error = left([k for k in kept if k != old], R[:, [*out, -1]]).T
        gains = [(other @ error) ** 2 / (other @ other) for other in others]
        yield error @ error - max(gains, default=0.0) < least


def test_a_share_of_the_value_that_sigmas_stay_below_may_rule_instead(robot):
    """Every one that stays is below; every one left out, were it added, is not."""
    seen, fit = seen_and_fit(robot)
    for below in (1.0, 4.0, 15.0, 60.0):
        small = identify(seen, "ordinary", below=below)
        at = [seen.names.index(p.name) for p in small.essential.parameters]
        assert max(least_squares_shares(seen, at)) < below
        for name in small.essential.dropped_parameters:
            assert least_squares_shares(seen, [*at, seen.names.index(name)])[-1] >= below
        assert [p.value for p in small.parameters] == [p.value for p in fit.parameters]
    assert len(identify(seen, "ordinary", below=1.0).essential.dropped_parameters) > len(
        fit.essential.dropped_parameters
    )
    with pytest.raises(DataError, match="got sigmas below 0 %; expected a number above 0"):
        identify(seen, below=0.0)


def least_squares_shares(seen, at):
    """Percent of sigma of a fit with these columns, the noise that of the fit with all."""
    W = seen.W[:, at]
    value = np.linalg.lstsq(W, seen.y)[0]
    noise = np.linalg.lstsq(seen.W, seen.y)[1][0] / (len(seen.y) - seen.W.shape[1])
    return 100.0 * np.sqrt(noise * np.diag(np.linalg.inv(W.T @ W))) / np.abs(value)


RUNS = 15


@cache
def repeated(memory: float) -> tuple[np.ndarray, np.ndarray, FitResult]:
    """Fits of runs whose noise has that time constant, s.

    (RUNS, c) errors in standard deviations; (RUNS,) share of the rows of other motion whose
    noiseless torque lies in the band; the last fit.
    """
    arm, cut = compiled("two-link"), Processing(parallel_cutoff=10.0)
    beta = some_beta(arm)
    other = observe(arm, [exact_log(arm, beta, seed=99, seconds=10.0, rate=100)], cut)
    log = exact_log(arm, beta, seed=1, seconds=30.0, rate=100)
    truth = other.predict(beta)
    errors, inside = [], []
    for seed in range(RUNS):
        white = np.random.default_rng(500 + seed).normal(size=log.tau.shape)
        pole = np.exp(-log.step / memory) if memory else 0.0
        noise = 0.3 * np.sqrt(1.0 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)
        fit = identify(observe(arm, [dataclasses.replace(log, tau=log.tau + noise)], cut))
        errors.append((fit.beta - beta) / [parameter.sigma for parameter in fit.parameters])
        band = THRESHOLDS.band_deviations * propagate_covariance(other.columns, fit.covariance)
        missed = np.abs(other.predict(fit.beta) - truth) > band
        inside.append(1.0 - np.mean(missed[other.used]))
    return np.array(errors), np.array(inside), fit


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize(("memory", "within"), [*rotating((0.0, 0.15)), (0.2, 0.25)])
def test_sigmas_and_band_cover_the_truth(memory: float, within: float) -> None:
    """White noise and noise that lasts: rms 1 in units of sigma, two deviations hold 95 %.

    Noise that lasts needs motion that is long beside it: of 15 s the band holds 89 %.
    """
    errors, inside, fit = repeated(memory)
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(1.0, abs=within)
    assert 0.90 < np.mean(np.abs(errors) < 2.0) < 0.99
    assert 0.90 < np.mean(inside) < 0.99
    assert any("Residuals are autocorrelated" in s for s in fit.sentences) is (memory > 0.0)


def test_the_band_is_the_spread_of_draws() -> None:
    """Against 4000 draws from N(beta, C), with units eight decades apart."""
    random = np.random.default_rng(3)
    columns = random.normal(size=(20, 2, 5)) * np.array([1e-6, 1.0, 1e3, 1.0, 1e5])
    root = random.normal(size=(5, 5)) / np.array([1e-6, 1.0, 1e3, 1.0, 1e5])[:, None]
    root[3] = 0.0  # set aside
    draws = columns @ (root @ random.normal(size=(5, 4000)))
    assert_allclose(propagate_covariance(columns, root @ root.T), draws.std(axis=2), rtol=0.06)


def test_rows_say_why_they_do_not_count() -> None:
    """A torque at its limit for a second, one missing for half a second, and slow motion."""
    arm = compiled("two-link")
    log = exact_log(arm, some_beta(arm), seed=4, seconds=20.0, rate=100)
    tau = log.tau.copy()
    clipped = (log.time > 5.0) & (log.time < 6.0)
    tau[clipped, 0] = 1.05 * np.abs(tau).max()
    tau[(log.time > 12.0) & (log.time < 12.5), 1] = np.nan
    seen = observe(arm, [dataclasses.replace(log, tau=tau)], Processing(parallel_cutoff=10.0))
    masks = classify_rows(seen)
    assert ((masks < 0) == seen.used).all()
    of = {name: masks == k for k, name in enumerate(MASKS)}
    middle = (seen.time > 5.1) & (seen.time < 5.9)
    assert of["torque at its limit"][middle, 0].all()
    near = (seen.time > 4.8) & (seen.time < 6.2)
    assert not of["torque at its limit"][~near, 0].any()
    assert of["no good value"][(seen.time > 12.1) & (seen.time < 12.4), 1].all()
    slow = of["low speed"][:, 0]
    floor = seen.report.processing.speed_floors["1"]
    assert slow.any() and np.abs(seen.qd[slow, 0]).max() < 3.0 * floor
    assert set(WHY) == set(MASKS)


def test_autocorrelation_ends_at_segments_gaps_and_where_white():
    random = np.random.default_rng(4)
    e = lfilter([1.0], [1.0, -0.8], random.normal(size=4000))
    whole = np.zeros(4000, dtype=int)
    r = estimate_autocorrelation(e, np.arange(4000), whole)
    assert_allclose(r[:4], 0.8 ** np.arange(4), atol=0.06)
    white = estimate_autocorrelation(random.normal(size=4000), np.arange(4000), whole)
    assert len(white) <= 2
    alone = estimate_autocorrelation(e, np.arange(4000), np.arange(4000))
    np.testing.assert_array_equal(alone, [1.0])
    every_other = estimate_autocorrelation(e[::2], np.arange(0, 4000, 2), whole)
    np.testing.assert_array_equal(every_other, [1.0])  # no pair is one sample apart
    np.testing.assert_array_equal(estimate_autocorrelation(np.zeros(9), np.arange(9), whole), [1.0])
