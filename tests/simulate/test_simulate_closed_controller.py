"""Robots with loops under a controller: laws of the closed plant, tracking, identification."""

import dataclasses

import numpy as np
import pytest
from closed_robots import LOOPS, without_effects

from modeler import simulation
from modeler.robot.read import read_robot
from modeler.robot.robot import Robot
from modeler.simulation.closing import build_constraints, compute_closed_postures, evaluate_samples
from modeler.simulation.plant import build_plant, build_tick_function, compute_inner_states

DRIVEN = simulation.SimulationSettings(
    duration=1.5, rate=1000, encoder_counts=0, linear_resolution=0, torque_noise=0, controller=True
)


def plant_of(source: Robot):
    limits, constraints = simulation.collect_motion_limits(source), build_constraints(source)
    parameters = simulation.draw_plant_parameters(source, limits)
    return build_plant(source, parameters, limits, constraints=constraints), constraints


@pytest.mark.parametrize("name", LOOPS)
def test_the_plant_is_the_tree_with_multipliers(name: str) -> None:
    """Torques of the closed machine by projection and by multipliers; accelerations back."""
    source = read_robot(name)
    open_loop = dataclasses.replace(DRIVEN, rate=50, controller=False)
    truth = simulation.simulate(source, open_loop).truth
    plant, constraints = plant_of(source)
    postures = compute_closed_postures(source, constraints, truth.q)
    z = compute_inner_states(plant, constraints, postures)
    count = len(z)
    tau = plant.torque.map(count)(truth.q.T, truth.qd.T, truth.qdd.T, z.T).full().T
    np.testing.assert_allclose(tau, truth.tau, rtol=0, atol=1e-9 * np.abs(tau).max())
    qdd = plant.acceleration.map(count)(truth.q.T, truth.qd.T, z.T, truth.tau.T)[0].full().T
    np.testing.assert_allclose(qdd, truth.qdd, rtol=0, atol=1e-9 * np.abs(qdd).max())


@pytest.mark.parametrize("name", LOOPS)
def test_loops_stay_closed(name: str) -> None:
    """Along a push that nothing controls, and from a start at which they are open a little."""
    source = without_effects(read_robot(name))
    plant, constraints = plant_of(source)
    home = np.array([[source.home.get(joint.name, 0.0) for joint in source.coordinates]])
    v = compute_closed_postures(source, constraints, home)
    n = home.size
    x = np.concatenate([home[0], np.zeros(n), compute_inner_states(plant, constraints, v)[0]])
    x[2 * n :] += 1e-7
    advance = build_tick_function(plant, 2e-3, 1)
    hold = plant.torque(home[0], np.zeros(n), np.zeros(n), x[2 * n :]).full().ravel()
    push = 0.3 * np.abs(hold).max() * np.cos(np.arange(n))
    for k in range(60):
        x = advance(x, hold + push).full().ravel()
        v[0, constraints.coordinate_rows], v[0, constraints.passive_rows] = x[:n], x[2 * n :]
        assert k == 0 or np.abs(evaluate_samples(constraints.residual, v)).max() < 1e-10
    assert np.abs(x[:n] - home[0]).max() > 1e-3
    again = compute_closed_postures(source, constraints, x[None, :n])
    np.testing.assert_allclose(again, v, atol=1e-8)
