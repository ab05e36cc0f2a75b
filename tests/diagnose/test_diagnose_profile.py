"""Sigmas and intervals of an effect hold for its shapes too: Monte Carlo, and limits known."""

from functools import cache

import numpy as np
import pytest

from modeler.api import observe
from modeler.diagnosis.add import add_effect, remove_last_effect
from modeler.diagnosis.added_model import LogSplit, describe_last_addition
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.profile import compute_effect_profile
from modeler.diagnosis.search import extend_state, scan_catalogue
from modeler.diagnosis.state import SearchData, analyse_logs, build_state
from modeler.estimation.identify import identify
from modeler.estimation.model_file import load_model, save_model
from modeler.estimation.parameters import format_spread
from modeler.runtime.model import load_module
from modeler.simulation import SimulationSettings, parse_hidden_effect, simulate
from tests.chain import chain_of
from tests.rotation import with_cases


@cache
def simulated(hide, seed):
    """A log of a machine with a hidden effect, its model, and the effect's true values."""
    arm, hidden = chain_of("demo-arm"), (parse_hidden_effect(hide),)
    settings = dict(
        duration=15.0, rate=500.0, seed=seed, parameter_seed=seed, torque_noise=0.02, hidden=hidden
    )
    truth = simulate(arm.derivation.robot, SimulationSettings(**settings)).truth
    log = arm.log(str(seed), **settings)
    return log, arm.fit([log]), truth.hidden_effects[0].values


def found(hide, seed):
    """The profile of an effect put in at its best shapes, and its true values."""
    log, model, truth = simulated(hide, seed)
    arm, robot = chain_of("demo-arm"), chain_of("demo-arm").derivation.robot
    seen = analyse_logs(arm.compiled, [log], model.processing)
    data = SearchData(arm.compiled, seen, None, StatedEffects(robot.catalogue, robot.coupling))
    state = build_state(data, (), model.beta)
    effect, _, joint = hide.partition(":")[0].partition("@")
    best = scan_catalogue(state, only=effect, joint=joint).judge_candidates().ranked[0].candidate
    return compute_effect_profile(extend_state(state, best), 0), truth


@cache
def added_to(hide, seed):
    """The log, and its model with the effect added."""
    log, model, _ = simulated(hide, seed)
    arm, (effect, _, joint) = chain_of("demo-arm"), hide.partition("@")
    return log, add_effect(model, arm.compiled, effect, joint, LogSplit([log]))


CASES = {
    # The dip in the sample's own law; presliding undamped, as Dahl wrote it.
    "stribeck": ("stribeck@2", lambda v: [v["extra"]]),
    "presliding": ("presliding@2:damping=0.5", lambda v: [v["level"], v["damping"]]),
    "load_friction": ("load_friction@3", lambda v: [v["coefficient"]]),
    "joint_ripple": (
        "joint_ripple@2",
        lambda v: [v["amplitude"] * np.sin(v["phase"]), v["amplitude"] * np.cos(v["phase"])],
    ),
}


@pytest.mark.slow
@pytest.mark.rotating
@pytest.mark.parametrize("effect", CASES)
def test_the_truth_is_where_the_interval_says(effect):
    hide, true_values = CASES[effect]
    z, inside, blind = [], [], []
    for seed in range(30_400, 30_404):
        along, values = found(hide, seed)
        truth = np.array(true_values(values))
        low, high = along.compute_intervals().T
        z += list((along.reported_point.values - truth) / along.compute_deviations())
        inside += list((low <= truth) & (truth <= high))
        blind += list(
            np.abs(along.reported_point.values - truth) < 1.96 * along.reported_point.deviations
        )
    assert np.sum(np.logical_not(inside)) <= max(1.0, len(inside) / 6)
    assert 0.2 < np.sqrt(np.mean(np.square(z))) < 1.6
    assert np.mean(inside) >= np.mean(blind)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_narrow_likelihood_gives_the_delta_method():
    # g(theta) linear, S(theta) quadratic: var g = s^2 + (dg/dtheta)^2 var theta.
    along, _ = found("stribeck@2", 902)
    text = along.reported_point.nonlinear_parameters
    near = [
        (p, r)
        for p, r in zip(along.points, along.squares_rise, strict=True)
        if p.nonlinear_parameters["d"] == text["d"] and r < 9.0
    ]
    x = np.log([p.nonlinear_parameters["vs"] for p, _ in near])
    rise = np.array([r for _, r in near])
    g = np.array([p.values[0] for p, _ in near])
    curvature = np.polyfit(x, rise, 2)[0]
    slope = np.polyfit(x, g, 1)[0]
    actual = along.reported_point.deviations[0] * along.factor[0]
    delta = np.sqrt(actual**2 + slope**2 / curvature)
    assert along.compute_deviations()[0] == pytest.approx(delta, rel=0.3)
    assert along.compute_deviations()[0] > 1.15 * actual  # the shape counts
    low, high = along.compute_intervals()[0]
    assert high - low == pytest.approx(2.0 * 1.96 * delta, rel=0.3)


@pytest.mark.rotating("long tests of diagnose")
def test_what_is_added_is_stored_and_told_with_it(tmp_path):
    """The dip has the exponent 2; these logs hold too few slow rows to distinguish it from 1."""
    truth, (log, better) = simulated("stribeck@2", 901)[2], added_to("stribeck@2", 901)
    (extra,) = (p for p in better.fit.parameters if p.name == "Fst2")
    low, high = extra.interval
    assert low < truth["extra"] < high and low < extra.value < high
    sigmas = [p.sigma for p in better.fit.parameters]
    np.testing.assert_allclose(np.sqrt(np.diag(better.covariance)), sigmas)
    assert np.linalg.eigvalsh(better.covariance / np.outer(sigmas, sigmas))[0] > -1e-9
    step = better.history[-1]
    assert list(step.nonlinear_intervals["d"]) == [1.0, 2.0]
    low, high = step.nonlinear_intervals["vs"]
    assert low < truth["speed"] < high
    text = describe_last_addition(better)
    assert text[0].startswith("Fst2 = ") and (" to " in text[0] or "+-" in text[0])
    assert "d = " in text[-1] and "(1 to 2)" in text[-1]
    save_model(tmp_path / "m.json", better)
    again = load_model(tmp_path / "m.json")
    assert again.fit.parameters == better.fit.parameters
    assert again.history[-1].to_json() == step.to_json()
    before = remove_last_effect(better, LogSplit([log]))
    assert all(p.interval is None for p in before.fit.parameters)


@pytest.mark.rotating("long tests of diagnose")
def test_shapes_widen_what_stands_beside_them():
    """Coulomb friction trades with a dip of unknown width: its sigma knows."""
    log, better = added_to("stribeck@2", 901)
    sigma = {p.name: p.sigma for p in better.fit.parameters}
    observation = observe(load_module(better.spec, better.sources), [log], better.processing)
    fixed = {p.name: p.sigma for p in identify(observation).parameters}
    assert sigma["Fst2"] > 2.0 * fixed["Fst2"]
    assert all(sigma[name] >= 0.999 * fixed[name] for name in fixed)


@with_cases(
    "value, sigma, interval, text",
    (2.0, 0.1, None, " +- 0.1"),
    (2.0, 0.1, (1.8, 2.2), " +- 0.1"),
    (2.0, 0.5, (1.9, 4.0), " (1.9 to 4)"),
    (2.0, 0.5, (2.0, 4.0), " (2 to 4)"),
    (2.0, 0.0, (2.0, 2.0), ""),
)
def test_an_interval_is_told_where_one_sigma_says_little(value, sigma, interval, text):
    assert format_spread(value, sigma, interval) == text
