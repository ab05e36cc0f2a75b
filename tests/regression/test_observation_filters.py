"""Plain filters are taken where they predict better, and nowhere else; a prior bounds the rest."""

import dataclasses

import numpy as np
import pytest

from modeler.estimation.identify import identify
from modeler.regression import compute_prior_weights
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.observe import _compute_change, observe
from tests.fleet.machines import compiled, motion, parameters
from tests.rotation import rotating

NOISE = 0.01  # of the rms torque


def measured(seed, seconds=20.0):
    """A log of the two-link arm with all its derivatives, and its base parameters."""
    model, rng = compiled(), np.random.default_rng([48, seed])
    beta = parameters(seed, model)
    time, q, qd, qdd = motion(rng, 2, seconds)
    tau = model.base_regressor(q, qd, qdd) @ beta
    tau += NOISE * np.std(tau, axis=0) * rng.normal(size=tau.shape)
    return Log("a", ("1", "2"), time, q, tau, qd=qd, qdd=qdd), beta


def sentence(seen):
    return [line for line in seen.report.choices if line.startswith("plain filters")]


@pytest.mark.parametrize("seed", [1, *rotating(2, 3)])
def test_noisy_accelerations_lose_to_positions_that_are_differentiated(seed):
    log, beta = measured(seed)
    noisy = log.qdd + 2.0 * np.random.default_rng(seed).normal(size=log.qdd.shape)
    log = dataclasses.replace(log, qdd=noisy)
    plain, logged = (
        observe(compiled(), [log]),
        observe(compiled(), [log], Processing(derivatives="log")),
    )
    (line,) = sentence(plain)
    before, after = (
        float(part.split()[0])
        for part in (line.split("filters above with ")[1], line.split("predicted with ")[1])
    )
    assert after < 0.97 * before
    chosen = plain.report.processing
    assert (chosen.derivatives, chosen.low_speed) == ("position", 0.0)
    assert chosen.position_cutoff == chosen.parallel_cutoff
    assert sentence(logged) == []
    errors = [
        np.abs(identify(seen, "weighted", compiled()).beta - beta) for seen in (plain, logged)
    ]
    assert np.median(errors[0] / errors[1]) < 0.5


@pytest.mark.parametrize("seed", [1, *rotating(2, 3)])
def test_a_sound_log_keeps_the_filters_that_were_chosen(seed):
    seen = observe(compiled(), [measured(seed)[0]])
    assert sentence(seen) == [] and seen.report.processing.derivatives == "auto"


def test_what_the_user_states_of_filters_rules():
    log = measured(1)[0]
    noisy = log.qdd + 2.0 * np.random.default_rng(1).normal(size=log.qdd.shape)
    log = dataclasses.replace(log, qdd=noisy)
    assert sentence(observe(compiled(), [log]))
    for stated in ({"parallel_cutoff": 5.0}, {"low_speed": 0.03}, {"decimation": 4}):
        assert sentence(observe(compiled(), [log], Processing(**stated))) == []
    assert sentence(observe(compiled(), [log], None, is_compared=False)) == []


def prior_free(seen):
    """The fit of the same rows without the prior."""
    loose = dataclasses.replace(seen, regressor=lambda segment, w: seen.regressor(segment, w))
    assert not compute_prior_weights(loose).any()
    return identify(loose, "weighted", compiled())


@pytest.mark.parametrize("seed", [1, *rotating(2, 3)])
def test_the_prior_moves_nothing_that_the_log_determines(seed):
    seen = observe(compiled(), [measured(seed)[0]])
    with_prior, without = identify(seen, "weighted", compiled()), prior_free(seen)
    sigma = np.array([parameter.sigma for parameter in without.parameters])
    assert np.abs((with_prior.beta - without.beta) / sigma).max() < 0.02


def creeping(seed):
    """A short log in which joint 2 creeps, with a thousandth of the accelerations of joint 1."""
    model, rng = compiled(), np.random.default_rng([48, seed])
    beta, (time, q, qd, qdd) = parameters(seed, model), motion(rng, 2, 5.0)
    for order, x in enumerate((q, qd, qdd)):
        x[:, 1] = (q[0, 1] if order == 0 else 0.0) + 0.01 * 0.6**order * np.sin(
            0.6 * time + 0.5 * np.pi * order
        )
    tau = model.base_regressor(q, qd, qdd) @ beta
    tau += 0.05 * np.std(tau, axis=0) * rng.normal(size=tau.shape)
    return Log("a", ("1", "2"), time, q, tau, qd=qd, qdd=qdd)


def test_what_a_motion_hardly_shows_does_not_run_away():
    """Other motion of five arms, predicted by fits in which one joint crept."""
    errors = []
    for seed in range(1, 6):
        seen = observe(compiled(), [creeping(seed)])
        other, beta = measured(seed, seconds=8.0)
        W = compiled().base_regressor(other.q, other.qd, other.qdd)
        fits = identify(seen, "weighted", compiled()), prior_free(seen)
        errors.append([np.linalg.norm(W @ (fit.beta - beta)) for fit in fits])
        errors[-1] /= np.linalg.norm(W @ beta)
    assert np.max(errors, axis=0)[0] < 1.0 and np.max(errors, axis=0)[1] > 5.0


def test_what_one_block_of_time_gains_alone_is_no_gain():
    before = np.zeros((2, 5))
    once, always = before.copy(), before - 0.1
    once[:, 3] = -0.5
    assert _compute_change(once, before) == 0.0
    assert _compute_change(always, before) == pytest.approx(-0.1)
    once[:, 3] = np.nan  # no rows there
    assert _compute_change(once, before) == 0.0
