"""What a robot file knows beforehand, against Bayes' rule on all standard parameters."""

import dataclasses
import sys

import numpy as np
import pytest
from scipy.signal import lfilter

from modeler.api import Load, fit_gains
from modeler.api.fitting import run_estimator
from modeler.codegen import derive, generate
from modeler.core.errors import DataError
from modeler.core.options import FitOptions
from modeler.estimation import PREFIXES, build_prior, compute_body_covariance, solve_least_squares
from modeler.estimation.covariance import HalvesComparison
from modeler.estimation.identify import build_base_equations, fit_equations, identify
from modeler.estimation.payload import Payload, identify_with_payloads
from modeler.estimation.result import read_fit
from modeler.numerics.least_squares import compress_rows, merge_compressed
from modeler.regression import Log, observe, read_log
from modeler.robot import parse_robot_text
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.bodies import ten_of_points
from tests.link_data import buildable, compiled, drawn, links, text

NOMINAL = links()
FRICTION = {f"F{kind}{j}": 2.0 for kind in "vs" for j in "123"}
NOISE = 0.5  # N m


@pytest.fixture(scope="module")
def model():
    known = {"inertial": 0.1, "Fv1": 0.2, "Fv2": 0.2, "Fs3": 0.3}
    return compiled(text(NOMINAL | FRICTION, known, held=("Fv3",)))


def rows(model, seed, chi, noise=NOISE, samples=60):
    """Random states, weighted W of one unit of noise, and torques of these standard parameters."""
    rng = np.random.default_rng(seed)
    q, qd, qdd = rng.normal(size=(3, samples, 3))
    phi = model.regressor(q, qd, qdd)
    W = model.base_regressor(q, qd, qdd)
    values = [chi[p.name] for p in model.spec.standard]
    y = phi @ values + noise * rng.normal(size=(samples, 3))
    joint = np.tile(np.arange(3), samples)
    return phi.reshape(-1, phi.shape[2]), W.reshape(-1, W.shape[2]), y.ravel(), joint


def base_names(model):
    return tuple(base.name for base in model.spec.base)


def estimated_beside(model, seed, chi, **how):
    """The posterior of white rows, with the least squares and the data it came from."""
    _, W, y, joint = rows(model, seed, chi, **how)
    data = compress_rows(W, y, joint, 3, base_names(model))
    white = solve_least_squares(data, "weighted")
    return build_prior(model.spec).combine_with_data(white, data, white.covariance), white, data


def true_chi(seed):
    rng = np.random.default_rng([seed, 7])
    chi = drawn(0.1, rng, NOMINAL) | FRICTION
    shifts = {"Fv1": 0.2, "Fv2": 0.2, "Fs3": 0.3}
    return chi | {name: FRICTION[name] + s * rng.normal() for name, s in shifts.items()}


def base_values(model, chi):
    return np.array([sum(t.value * chi[t.parameter] for t in b.terms) for b in model.spec.base])


def test_the_posterior_is_bayes_rule_on_all_standard_parameters(model):
    fit, white, data = estimated_beside(model, 3, true_chi(3), noise=5.0)
    phi, _, y, joint = rows(model, 3, true_chi(3), noise=5.0)
    assert not fit.contradicted
    prior, names = build_prior(model.spec), [p.name for p in model.spec.standard]
    count = len(names)
    # free parameters: a flat prior; held: an all but certain one
    S = prior.S[:count, :count] + 1e-12 * np.diag(np.diag(prior.S)[:count])
    free = [i for i, name in enumerate(names) if name in ("Fs1", "Fs2")]
    S[free, free], S[names.index("Fv3"), names.index("Fv3")] = 1e8, 1e-12
    weighted = phi / white.sigma[joint][:, None]
    information = weighted.T @ weighted + np.linalg.inv(S)
    right = weighted.T @ (y / white.sigma[joint]) + np.linalg.solve(S, prior.mean[:count])
    K = prior.K[:, :count]
    np.testing.assert_allclose(fit.beta, K @ np.linalg.solve(information, right), rtol=1e-4)
    sigma = np.sqrt(np.diag(K @ np.linalg.solve(information, K.T)))
    value = np.array([name != "Fv3" for name in prior.names])
    np.testing.assert_allclose(np.sqrt(np.diag(fit.covariance))[value], sigma[value], rtol=1e-3)
    # what halves disagree about stays in the standard deviations and moves no value
    more = 30.0 * np.diag(white.covariance)
    raised = prior.combine_with_data(white, data, white.covariance, more)
    np.testing.assert_allclose(raised.beta, fit.beta, rtol=1e-6)
    assert np.all(np.diag(raised.covariance)[value] >= more[value])


def test_z_scores_are_those_of_the_prior_and_the_noise(model):
    z = []
    for seed in range(30):
        chi = true_chi(seed)
        fit, *_ = estimated_beside(model, seed, chi, noise=5.0)
        free = np.array([name != "Fv3" for name in build_prior(model.spec).names])
        apart = fit.beta - base_values(model, chi)
        z.append((apart / np.sqrt(np.diag(fit.covariance)))[free])
    assert 0.9 < np.sqrt(np.mean(np.square(z))) < 1.1
    assert 0.93 < np.mean(np.abs(z) < 1.96) < 0.97


def test_a_body_moves_as_its_mass_centre_and_inertia_do():
    rng, share = np.random.default_rng(5), 1e-4
    ten = np.array([NOMINAL[f"{p}2"] for p in PREFIXES])
    why, value = compute_body_covariance(ten, share)
    every = [drawn(share, rng, NOMINAL) for _ in range(1000)]
    many = [[one[f"{p}2"] for p in PREFIXES] for one in every]
    seen, size = np.cov(np.array(many).T), np.sqrt(np.diag(value))
    assert not why
    np.testing.assert_allclose(seen / np.outer(size, size), value / np.outer(size, size), atol=0.1)


def spec_of(*stated):
    return generate(derive(parse_robot_text(text(*stated), "stated.toml"))).spec


def test_placeholders_have_no_prior_and_are_told_by_name():
    zero, identity, odd = links(), links(), links()
    zero |= {f"{p}1": 0.0 for p in PREFIXES}
    values = zero | {f"{p}2": float(p in ("XX", "YY", "ZZ", "M")) for p in PREFIXES}
    values |= {"XX3": 5.0 * odd["XX3"], "YY3": 0.1 * odd["YY3"]}
    prior = build_prior(spec_of(values, {"inertial": 0.1}))
    assert prior.skipped_bodies == {
        "link 1": "mass of 0",
        "link 2": "identity inertia",
        "link 3": "not physically possible",
    }
    assert not prior.groups and build_prior(spec_of(NOMINAL)) is None
    value = " ".join(prior.format_sentences(np.zeros(3)))
    assert "link 1 (mass of 0), link 2 (identity inertia), link 3 (not phys" in value
    assert compute_body_covariance(-np.array([identity[f"{p}1"] for p in PREFIXES]), 0.1)[0]
    del values["YY3"]
    prior = build_prior(spec_of(values, {"inertial": 0.1}))
    assert prior.skipped_bodies["link 3"] == "its ten parameters are not all stated"
    point = zero | {"M1": 3.0}
    assert build_prior(spec_of(point, {"inertial": 0.1})).skipped_bodies["link 1"] == "inertia of 0"


def test_a_body_that_the_data_contradict_is_told_and_left_out(model):
    text = 0
    for seed in range(20):
        chi = true_chi(seed)
        chi |= {p + "3": 2.2 * NOMINAL[p + "3"] for p in PREFIXES}
        fit, white, _ = estimated_beside(model, seed, chi)
        text += len(fit.contradicted) == 1 and fit.contradicted[0].startswith("link 3: the dat")
        free = [i for i, base in enumerate(model.spec.base) if base.name.endswith("3")]
        np.testing.assert_allclose(fit.beta[free], white.beta[free], rtol=0.2, atol=0.3)
    assert text >= 19


def test_a_true_prior_is_not_told_as_contradicted(model):
    lines = [estimated_beside(model, s, true_chi(s))[0].contradicted for s in range(100, 160)]
    assert sum(map(bool, lines)) <= 2


def log_of(model, chi, seed=0, seconds=6.0, noise=None, name="made.csv"):
    rng = np.random.default_rng([seed, 1])
    t = np.arange(0.0, seconds, 0.002)
    w = 2.0 * np.pi * np.outer(t, [0.3, 0.7, 1.1])
    a = rng.normal(size=(3, 3)) * 0.5
    f = 2.0 * np.pi * np.array([0.3, 0.7, 1.1])
    q, qd, qdd = np.sin(w) @ a, np.cos(w) * f @ a, -np.sin(w) * f**2 @ a
    tau = model.inverse_dynamics(q, qd, qdd, base_values(model, chi))
    tau = tau + (NOISE * rng.normal(size=tau.shape) if noise is None else noise)
    return Log(name, ("1", "2", "3"), t, q, tau)


def seen_of(model, chi, *how):
    return observe(model, [log_of(model, chi, *how)])


@pytest.fixture(scope="module")
def seen(model):
    return seen_of(model, true_chi(1))


@pytest.mark.parametrize("method", ["weighted", "ordinary", "robust"])
def test_held_values_hold_and_the_table_says_what_came_from_the_prior(model, seen, method):
    fit = identify(seen, method, model)
    by_name = {p.name: p for p in fit.parameters}
    assert by_name["Fv3"].value == pytest.approx(2.0, rel=1e-6)
    assert by_name["Fv3"].status == "held"
    shares = [p.prior for p in fit.parameters]
    assert all(0.0 <= share <= 1.0 for share in shares) and by_name["Fs1"].prior < 0.2
    pairs = zip(fit.parameters, identify(seen, method).parameters, strict=True)
    assert all(item.sigma <= 1.02 * alone.sigma for item, alone in pairs)
    text = "\n".join(fit.format_lines())
    assert "  prior  unit" in text and "held" in text
    assert "prior of the robot file on link 1, link 2, link 3, Fv1, Fs1" not in text
    assert "prior of the robot file on link 1, link 2, link 3, Fv1, Fv2" in text
    again = read_fit(fit.to_json(), fit.covariance)
    assert [p.prior for p in again.parameters] == shares


def remembering(seed):
    """(6000, 3) N m, of 0.2 s at 500 Hz."""
    white, a = np.random.default_rng([seed, 3]).normal(size=(6000, 3)), np.exp(-0.002 / 0.2)
    return lfilter([2.0 * (1.0 - a * a) ** 0.5], [1.0, -a], white, axis=0)


def test_windows_of_long_logs_raise_the_sigmas_as_all_rows_do(model):
    """All rows twice, of which the windows are half: as white noise, sigmas fall by a root of 2."""
    seen = seen_of(model, true_chi(1), 1, 12.0, remembering(1))
    data = build_base_equations(seen).compress_rows(np.ones(len(seen.y), dtype=bool))
    every = {"data": merge_compressed(data, data), "share": 0.5}
    once, twice = (
        fit_equations(seen, build_base_equations(seen), "weighted", model, **how)
        for how in ({}, every)
    )
    for item, other in zip(twice.parameters, once.parameters, strict=True):
        assert item.name not in ("XZ2R", "MX2R") or 0.68 < item.sigma / other.sigma < 0.78, item


def test_rows_that_repeat_each_other_weigh_less(model):
    """Noise correlated over 0.2 s: sigmas of data and prior together stay honest."""
    z = []
    for seed in range(4):
        chi = true_chi(200 + seed)
        fit = identify(seen_of(model, chi, seed, 12.0, remembering(seed)), "weighted", model)
        sigma = np.array([p.sigma for p in fit.parameters])
        free = np.array([p.status != "held" for p in fit.parameters])
        z.append(((fit.beta - base_values(model, chi)) / sigma)[free])
    assert 0.8 < np.sqrt(np.mean(np.square(z))) < 1.25


def test_a_load_is_found_beside_the_prior_of_the_robot(model):
    """Its own parameters have none: what is known of link 3 is of the bare one."""
    z, rng = [], np.random.default_rng(8)
    for seed in range(3):
        chi = true_chi(300 + seed)
        body = ten_of_points(rng.uniform(0.5, 1.5, 6), rng.uniform(0.1, 0.5, (6, 3)))
        loaded = chi | {f"{p}3": chi[f"{p}3"] + value for p, value in body.items()}
        logs = [
            log_of(model, values, seed, name=name)
            for values, name in ((chi, "bare.csv"), (loaded, "loaded.csv"))
        ]
        carried = [Payload(("loaded.csv",))]
        fit = identify_with_payloads(model, observe(model, logs), carried)
        assert not fit.prior_conflicts and max(p.prior for p in fit.parameters) > 0.5
        assert all(p.prior < 0.5 for p in fit.loads) and len(fit.loads) == 10
        truth = np.append(base_values(model, chi), [body[p.name[:-6]] for p in fit.loads])
        free = [p.status != "held" for p in (*fit.parameters, *fit.loads)]
        every = [(p.value, p.sigma) for p in (*fit.parameters, *fit.loads)]
        value, sigma = np.array(every).T
        z.append(((value - truth) / sigma)[free])
    assert 0.75 < np.sqrt(np.mean(np.square(z))) < 1.3


@pytest.mark.parametrize("method", ["ridge", "consistent", "energy"])
def test_an_estimator_without_this_prior_says_so_and_cannot_hold_single_values(
    model, seen, method, bodies
):
    """It takes the stated values of the bodies, or does without them."""
    robot, compiled_bodies = bodies
    asked = FitOptions(model="energy") if method == "energy" else FitOptions(method)
    who = "the energy model" if asked.model == "energy" else f"method {method}"
    text = f"{who} cannot hold parameters.*; got Fv1, Fv2, Fv3, Fs3"
    with pytest.raises(DataError, match=text):
        run_estimator(asked, robot, model, seen)
    chi = NOMINAL | FRICTION
    observation = observe(compiled_bodies, [log_of(compiled_bodies, chi, 4)])
    fit = run_estimator(asked, robot, compiled_bodies, observation).result
    assert sum("does not use inertial = 0.1 of [param" in line for line in fit.sentences) == 1
    apart = fit.beta - base_values(compiled_bodies, chi)
    assert np.abs(apart / np.sqrt(np.diag(fit.covariance))).max() < 5.0


@pytest.fixture(scope="module")
def bodies():
    """A robot of whose parameters no single one is held or has a deviation."""
    stated = text(NOMINAL, {"inertial": 0.1})
    return parse_robot_text(stated, "stated.toml"), compiled(stated)


def test_other_ways_to_fit_cannot_hold_single_values(model, seen, bodies):
    with pytest.raises(DataError, match=r"cannot hold parameters .*; got Fv1, Fv2, Fv3, Fs3"):
        run_estimator(FitOptions("two-step"), bodies[0], model, seen)
    held = parse_robot_text(text(NOMINAL | FRICTION, {}, held=("Fv3",)), "stated.toml")
    with pytest.raises(DataError, match=r"method tls cannot hold parameters .*; got Fv3"):
        fit_gains(derive(held), [], Load(["none.csv"], 3.0))


def test_a_prior_that_raises_the_error_of_a_joint_is_named(model, monkeypatch):
    _, W, y, joint = rows(model, 3, true_chi(3), noise=0.05)
    data = compress_rows(W, y, joint, 3, base_names(model))
    white = solve_least_squares(data, "weighted")
    prior = build_prior(model.spec)
    assert prior.combine_with_data(white, data, white.covariance, joints="123").contradicted == ()
    wrong = dataclasses.replace(prior, mean=2.0 * prior.mean)
    monkeypatch.setattr(type(prior), "find_contradictions", lambda *_: {})
    result = wrong.combine_with_data(white, data, 100.0 * white.covariance, joints="123")
    assert "the prior of the robot file raises its fit error from" in " ".join(result.contradicted)


def test_bodies_that_predict_worse_than_nothing_are_left_out(model):
    """Where rows repeat each other, data never contradict: the prior of another build would win."""
    light = {name: 0.05 * value for name, value in NOMINAL.items()} | FRICTION
    prior = build_prior(model.spec)
    for chi, is_left_out in ((light, True), (true_chi(5), False)):
        _, white, data = estimated_beside(model, 5, chi)
        vague, none = 1e6 * white.covariance, np.zeros(len(white.beta))
        assert prior.combine_with_data(white, data, vague).contradicted == ()
        both, used, lines = prior.combine_if_useful(white, data, vague, none, "123")
        errors = data.compute_residual_norms(both.beta) / data.compute_torque_norms()
        assert errors.max() < 1.0 and bool(lines) is is_left_out
        assert used.has_bodies is not is_left_out and set(used.groups) >= {"Fv1", "Fs3"}
        for line in lines:
            assert line.startswith("prior of the robot file on link 1, link 2, link 3: left out")


def test_values_that_halves_disagree_about_do_not_leave_their_sums(tmp_path, monkeypatch):
    """Standard deviations that are raised one by one part an offset and a weight whose sum is
    known: with a prior the fit would leave more of the torque than without."""
    effects = '[effects]\nrotor_inertia = "all"\noffset = "all"'
    local = text(NOMINAL | FRICTION, {"inertial": 0.3}).replace("[effects]", effects)
    truth = buildable(0.3, np.random.default_rng(1), NOMINAL) | FRICTION
    machine = parse_robot_text(text(truth).replace("[effects]", effects), "arm")
    run = simulate(machine, SimulationSettings(duration=8.0, rate=200.0))
    write_log(tmp_path / "a.parquet", run)
    model = compiled(local)
    seen = observe(model, [read_log(tmp_path / "a.parquet", model.spec)])
    errors = []
    for raised in (1.0, 30.0):
        factors = 1.0 + (raised - 1.0) * np.random.default_rng(2).uniform(size=len(seen.names))
        module = sys.modules["modeler.estimation.identify"]
        monkeypatch.setattr(module, "compare_halves", lambda *_, f=factors: HalvesComparison(f))
        fit = identify(seen, "weighted", model)
        errors.append([joint.relative_error for joint in fit.joints])
    assert np.all(np.array(errors[1]) < 1.05 * np.array(errors[0])), errors
