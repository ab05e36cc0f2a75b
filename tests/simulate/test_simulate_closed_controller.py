"""Robots with loops under a controller: laws of the closed plant, tracking, identification."""

import dataclasses

import numpy as np
import pytest
from closed_robots import LOOPS, energies, without_effects

from modeler.api import compile_model, derive, fit, generate, observe
from modeler.core.errors import DataError
from modeler.robot.read import read_robot
from modeler.robot.robot import Robot
from modeler.simulation import (
    HiddenEffect,
    SimulationSettings,
    motion_limits,
    plant_parameters,
    simulate,
    write_log,
)
from modeler.simulation.closing import constraints_of, followed, rates, sampled
from modeler.simulation.plant import build_plant, inner_states, tick_function
from tests.rotation import ROTATING

DRIVEN = SimulationSettings(
    duration=1.5, rate=1000, encoder_counts=0, linear_resolution=0, torque_noise=0, controller=True
)


def plant_of(source: Robot):
    limits, constraints = motion_limits(source), constraints_of(source)
    parameters = plant_parameters(source, limits)
    return build_plant(source, parameters, limits, constraints=constraints), constraints


@pytest.mark.parametrize("name", LOOPS)
def test_the_plant_is_the_tree_with_multipliers(name: str) -> None:
    """Torques of the closed machine by projection and by multipliers; accelerations back."""
    source = read_robot(name)
    truth = simulate(source, dataclasses.replace(DRIVEN, rate=50, controller=False)).truth
    plant, constraints = plant_of(source)
    z = inner_states(plant, constraints, followed(source, constraints, truth.q))
    count = len(z)
    tau = plant.torque.map(count)(truth.q.T, truth.qd.T, truth.qdd.T, z.T).full().T
    np.testing.assert_allclose(tau, truth.tau, rtol=0, atol=1e-9 * np.abs(tau).max())
    qdd = plant.acceleration.map(count)(truth.q.T, truth.qd.T, z.T, truth.tau.T)[0].full().T
    np.testing.assert_allclose(qdd, truth.qdd, rtol=0, atol=1e-9 * np.abs(qdd).max())


@pytest.mark.parametrize("name", LOOPS)
def test_the_motors_work_is_what_the_energy_gains(name: str) -> None:
    """Exact for torques held over each tick, but for the steps of the integration."""
    source = without_effects(name)
    truth = simulate(source, dataclasses.replace(DRIVEN, duration=0.8)).truth
    constraints = constraints_of(source)
    v = followed(source, constraints, truth.q)
    vd, _ = rates(constraints, v, truth.qd, truth.qdd)
    total = energies(source, plant_parameters(source, motion_limits(source)), v, vd)
    work = np.cumsum(np.sum(truth.tau[:-1] * np.diff(truth.q, axis=0), axis=1))
    assert np.ptp(total) > 0.01
    np.testing.assert_allclose(total[1:] - total[0], work, rtol=0, atol=1e-7 * np.ptp(total))


@pytest.mark.parametrize("name", LOOPS)
def test_loops_stay_closed(name: str) -> None:
    """Along a push that nothing controls, and from a start at which they are open a little."""
    source = without_effects(name)
    plant, constraints = plant_of(source)
    home = np.array([[source.home.get(joint.name, 0.0) for joint in source.coordinates]])
    v = followed(source, constraints, home)
    n = home.size
    x = np.concatenate([home[0], np.zeros(n), inner_states(plant, constraints, v)[0]])
    x[2 * n :] += 1e-7
    advance = tick_function(plant, 2e-3, 1)
    hold = plant.torque(home[0], np.zeros(n), np.zeros(n), x[2 * n :]).full().ravel()
    push = 0.3 * np.abs(hold).max() * np.cos(np.arange(n))
    for k in range(60):
        x = advance(x, hold + push).full().ravel()
        v[0, constraints.given], v[0, constraints.others] = x[:n], x[2 * n :]
        assert k == 0 or np.abs(sampled(constraints.value, v)).max() < 1e-10
    assert np.abs(x[:n] - home[0]).max() > 1e-3
    again = followed(source, constraints, x[None, :n])
    np.testing.assert_allclose(again, v, atol=1e-8)


@pytest.mark.parametrize("name", ["five-bar", pytest.param("sr400", marks=ROTATING)])
def test_a_stiffer_controller_keeps_nearer_to_the_command(name: str) -> None:
    errors = []
    for bandwidth in (4.0, 16.0):
        log = simulate(
            read_robot(name), dataclasses.replace(DRIVEN, duration=0.8, bandwidth=bandwidth)
        )
        errors.append(np.sqrt(np.mean((log.truth.q - log.qc) ** 2)))
    assert errors[1] < 0.5 * errors[0]
    exact = simulate(read_robot(name), dataclasses.replace(DRIVEN, controller=False))
    assert np.array_equal(exact.truth.q, exact.qc)


@pytest.mark.slow
def test_the_settings_of_other_robots_hold() -> None:
    source = read_robot("five-bar")
    free = simulate(source, DRIVEN)
    blind = simulate(source, dataclasses.replace(DRIVEN, feedforward=False))
    assert np.abs(blind.truth.q - blind.qc).max() > 3 * np.abs(free.truth.q - free.qc).max()
    most = 0.9 * float(np.abs(free.truth.tau[:, 0]).max())
    capped = simulate(source, dataclasses.replace(DRIVEN, torque_limits={"11": most}))
    assert np.abs(capped.truth.tau[:, 0]).max() == pytest.approx(most)
    with pytest.raises(DataError, match=r"the controller lost joint 11 at .* raise the torque"):
        simulate(source, dataclasses.replace(DRIVEN, duration=4.0, torque_limits={"11": 1e-3}))
    hidden = (HiddenEffect("coulomb", "12", {"Fs": 1.0}),)
    rubbing = simulate(source, dataclasses.replace(DRIVEN, hidden=hidden))
    assert np.abs(rubbing.tau - free.tau)[:, 1].max() > 0.5


def test_a_log_under_a_controller_gives_the_true_parameters(tmp_path) -> None:
    source = read_robot("five-bar")
    settings = SimulationSettings(duration=6.0, rate=500.0, controller=True, torque_noise=0.005)
    log = simulate(source, settings)
    write_log(tmp_path / "a.parquet", log)
    derivation = derive(source)
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    model = fit(derivation, emitted, observe(compiled, [str(tmp_path / "a.parquet")]))
    chi = np.array([log.truth.parameters[c.name] for c in derivation.base.columns])
    true = compiled.base_parameters(chi)
    found = np.array([p.value for p in model.fit.parameters])
    sigma = np.array([p.sigma for p in model.fit.parameters])
    assert np.all(np.abs(found - true) < 5 * sigma + 0.01 * np.abs(true))
    assert np.median(sigma / np.abs(true)) < 0.05
