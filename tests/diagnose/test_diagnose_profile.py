"""Sigmas and intervals of an effect hold for its shapes too: Monte Carlo, and limits known."""

import dataclasses

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate, identified, load, observe
from modeler.diagnosis.add import add_effect, undone
from modeler.diagnosis.added_model import Logs, added
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.profile import profile_of
from modeler.diagnosis.search import extended, scan_catalogue
from modeler.diagnosis.state import SearchData, analysed, state_of
from modeler.estimation.identify import identify
from modeler.estimation.model_file import load_model, save_model
from modeler.estimation.parameter import spread_text
from modeler.observation.read import read_log
from modeler.simulation import SimulationSettings, hidden_from_text, simulate, write_log


@pytest.fixture(scope="module")
def arm():
    derivation = derive(load("demo-arm"))
    emitted = generate(derivation)
    return derivation, emitted, compile_model(emitted)


def simulated(arm, folder, hide, seed):
    """A log of a machine with a hidden effect, and the effect's true values."""
    derivation, emitted, _ = arm
    settings = SimulationSettings(
        duration=15.0, rate=500.0, seed=seed, parameter_seed=seed, torque_noise=0.02,
        hidden=(hidden_from_text(hide),),
    )  # fmt: skip
    log = simulate(derivation.robot, settings)
    path = folder / f"{seed}.parquet"
    write_log(path, log)
    return read_log(path, emitted.spec), log.truth.hidden[0].values


def fitted(arm, log):
    derivation, emitted, compiled = arm
    observation = observe(compiled, [log])
    return identified(derivation, emitted, observation, identify(observation))


def found(arm, log, effect, joint):
    """The state with an effect put in at its best shapes."""
    model = fitted(arm, log)
    robot = arm[0].robot
    data = SearchData(
        arm[2], analysed(arm[2], [log], model.processing), None,
        StatedEffects(robot.catalogue, robot.coupling),
    )  # fmt: skip
    state = state_of(data, (), model.beta)
    return extended(
        state, scan_catalogue(state, only=effect, joint=joint).judged().ranked[0].candidate
    )


CASES = {
    # The dip in the sample's own law; presliding undamped, as Dahl wrote it.
    "stribeck": ("stribeck@2", lambda v: [v["extra"]]),
    "presliding": ("presliding@2:damping=0.5", lambda v: [v["level"]]),
    "load_friction": ("load_friction@3", lambda v: [v["coefficient"]]),
    "joint_ripple": (
        "joint_ripple@2",
        lambda v: [v["amplitude"] * np.sin(v["phase"]), v["amplitude"] * np.cos(v["phase"])],
    ),
}


@pytest.mark.slow
@pytest.mark.rotating
@pytest.mark.parametrize("effect", CASES)
def test_the_truth_is_where_the_interval_says(arm, tmp_path, effect):
    hide, true_values = CASES[effect]
    z, inside, blind = [], [], []
    for seed in range(30_400, 30_404):
        log, values = simulated(arm, tmp_path, hide, seed)
        along = profile_of(found(arm, log, effect, hide.partition("@")[2][0]), 0)
        truth = np.array(true_values(values))
        low, high = along.intervals().T
        z += list((along.told.values - truth) / along.deviations())
        inside += list((low <= truth) & (truth <= high))
        blind += list(np.abs(along.told.values - truth) < 1.96 * along.told.deviations)
    assert np.sum(np.logical_not(inside)) <= max(1.0, len(inside) / 6)
    assert 0.2 < np.sqrt(np.mean(np.square(z))) < 1.6
    assert np.mean(inside) >= np.mean(blind)


def test_two_exponents_that_do_as_well_are_both_in_the_interval(arm, tmp_path):
    log, truth = simulated(arm, tmp_path, "stribeck@2", 901)
    along = profile_of(found(arm, log, "stribeck", "2"), 0)
    # the simulated dip has the exponent 2; these logs hold too few slow rows to tell
    assert along.shape_intervals()["d"] == (1.0, 2.0)
    (low, high) = along.intervals()[0]
    assert low < truth["extra"] < high
    assert abs(along.told.values[0] - truth["extra"]) < 3.0 * along.deviations()[0]
    low, high = along.shape_intervals()["vs"]
    assert low < truth["speed"] < high


def test_a_narrow_likelihood_gives_the_delta_method(arm, tmp_path):
    # g(theta) linear, S(theta) quadratic: var g = s^2 + (dg/dtheta)^2 var theta.
    log, _ = simulated(arm, tmp_path, "stribeck@2", 902)
    along = profile_of(found(arm, log, "stribeck", "2"), 0)
    told = along.told.shapes
    near = [(p, r) for p, r in zip(along.points, along.rise, strict=True)
            if p.shapes["d"] == told["d"] and r < 9.0]  # fmt: skip
    x = np.log([p.shapes["vs"] for p, _ in near])
    rise = np.array([r for _, r in near])
    g = np.array([p.values[0] for p, _ in near])
    curvature = np.polyfit(x, rise, 2)[0]
    slope = np.polyfit(x, g, 1)[0]
    own = along.told.deviations[0] * along.factor[0]
    delta = np.sqrt(own**2 + slope**2 / curvature)
    assert along.deviations()[0] == pytest.approx(delta, rel=0.3)
    assert along.deviations()[0] > 1.15 * own  # the shape counts
    low, high = along.intervals()[0]
    assert high - low == pytest.approx(2.0 * 1.96 * delta, rel=0.3)


def test_an_effect_without_shapes_has_no_profile(arm, tmp_path):
    log, _ = simulated(arm, tmp_path, "asymmetric_viscous@2", 903)
    assert profile_of(found(arm, log, "asymmetric_viscous", "2"), 0) is None


def test_what_is_added_is_stored_and_told_with_it(arm, tmp_path):
    log, truth = simulated(arm, tmp_path, "stribeck@2", 901)
    model = fitted(arm, log)
    better = add_effect(model, arm[2], "stribeck", "2", Logs([log]))
    names = [p.name for p in better.fit.parameters]
    extra = better.fit.parameters[names.index("Fst2")]
    low, high = extra.interval
    assert low < truth["extra"] < high and low < extra.value < high
    np.testing.assert_allclose(
        np.sqrt(np.diag(better.covariance)), [p.sigma for p in better.fit.parameters]
    )
    assert np.linalg.eigvalsh(better.covariance / np.outer(*2 * [
        np.sqrt(np.diag(better.covariance))]))[0] > -1e-9  # fmt: skip
    step = better.history[-1]
    assert list(step.shape_intervals["d"]) == [1.0, 2.0]
    told = added(better)
    assert told[0].startswith("Fst2 = ") and (" to " in told[0] or "+-" in told[0])
    assert "d = " in told[-1] and "(1 to 2)" in told[-1]
    save_model(tmp_path / "m.json", better)
    again = load_model(tmp_path / "m.json")
    assert again.fit.parameters == better.fit.parameters
    assert again.history[-1].to_json() == step.to_json()
    before = undone(better, Logs([log]))
    assert all(p.interval is None for p in before.fit.parameters)


def test_shapes_widen_what_stands_beside_them(arm, tmp_path):
    # Coulomb friction trades with a dip of unknown width: its sigma knows.
    log, _ = simulated(arm, tmp_path, "stribeck@2", 901)
    better = add_effect(fitted(arm, log), arm[2], "stribeck", "2", Logs([log]))
    sigma = {p.name: p.sigma for p in better.fit.parameters}
    observation = observe(compile_model(dataclasses.replace(arm[1], spec=better.spec,
                          files=better.sources)), [log], better.processing)  # fmt: skip
    fixed = {p.name: p.sigma for p in identify(observation).parameters}
    assert sigma["Fst2"] > 2.0 * fixed["Fst2"]
    assert all(sigma[name] >= 0.999 * fixed[name] for name in fixed)


@pytest.mark.parametrize(
    ("value", "sigma", "interval", "text"),
    [
        (2.0, 0.1, None, " +- 0.1"),
        (2.0, 0.1, (1.8, 2.2), " +- 0.1"),
        (2.0, 0.5, (1.9, 4.0), " (1.9 to 4)"),
        (2.0, 0.5, (2.0, 4.0), " (2 to 4)"),
        (2.0, 0.0, (2.0, 2.0), ""),
    ],
)
def test_an_interval_is_told_where_one_sigma_says_little(value, sigma, interval, text):
    assert spread_text(value, sigma, interval) == text
