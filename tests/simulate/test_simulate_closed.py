"""Simulated robots with relations and loops: laws, ties, limits, mistakes."""

import dataclasses
import re

import numpy as np
import pytest
from closed_robots import LOOPS, RELATIONS

from modeler.core.choices import read_builtin_robot
from modeler.core.errors import DataError, RobotError
from modeler.robot.read import parse_robot_text, read_robot
from modeler.simulation import (
    SimulationSettings,
    closing,
    collect_motion_limits,
    draw_plant_parameters,
    simulate,
)
from tests.modules import compiled, module
from tests.robot_texts import CRANK, robot
from tests.rotation import with_cases

EXACT = {"encoder_counts": 0, "linear_resolution": 0, "torque_noise": 0}
IDEAL = SimulationSettings(duration=1.5, rate=400, **EXACT)


@pytest.mark.parametrize("name", LOOPS)
def test_loops_stay_closed_and_rates_are_those_of_the_positions(name):
    source, rate = read_robot(name), 2000.0
    truth = simulate(source, dataclasses.replace(IDEAL, rate=rate, duration=1.0)).truth
    constraints = closing.build_constraints(source)
    v = closing.compute_closed_postures(source, constraints, truth.q)
    assert np.array_equal(v[:, constraints.coordinate_rows], truth.q)
    assert np.abs(closing.evaluate_samples(constraints.residual, v)).max() < 1e-10
    vd, vdd = closing.compute_rates(constraints, v, truth.qd, truth.qdd)
    for low, high in ((v, vd), (vd, vdd)):
        difference = (low[2:] - low[:-2]) * rate / 2
        # The jerk jumps where a move begins or ends.
        assert np.abs(difference - high[1:-1]).max() < 0.01 * np.abs(high).max()


@pytest.mark.parametrize("name", LOOPS)
@pytest.mark.parametrize("motion", ["exciting", "point-to-point"])
def test_the_limits_are_kept(name, motion):
    source = read_robot(name)
    log = simulate(source, dataclasses.replace(IDEAL, motion=motion, duration=6.0, rate=50))
    names = (j.name for j in source.moving_joints)
    limits = dict(zip(names, collect_motion_limits(source), strict=True))
    assert log.joints == tuple(joint.name for joint in source.coordinates)
    assert np.all(log.driven)
    for i, joint in enumerate(log.joints):
        limit, truth = limits[joint], log.truth
        assert limit.lower <= truth.q[:, i].min() and truth.q[:, i].max() <= limit.upper
        assert np.ptp(truth.q[:, i]) > 0.1 * (limit.upper - limit.lower)
        assert np.abs(truth.qd[:, i]).max() <= limit.speed
        assert np.abs(truth.qdd[:, i]).max() <= limit.acceleration


@pytest.mark.parametrize("name", RELATIONS)
def test_relations_are_kept_by_the_controlled_robot(name):
    """Torques as the model's wherever no joint creeps; joints without motor swing."""
    source = read_robot(name)
    log = simulate(source, dataclasses.replace(IDEAL, duration=3.0, rate=1000))
    truth, c = log.truth, compiled(name)
    assert log.joints == tuple(joint.name for joint in source.free_joints)
    assert list(log.driven) == [joint.actuated for joint in source.free_joints]
    assert np.all(truth.tau[:, ~log.driven] == 0)
    assert np.all(np.sqrt(np.mean(truth.tau[:, log.driven] ** 2, axis=0)) > 0)
    chi = np.array([truth.parameters[column.name] for column in module(name).base.columns])
    tau = c.inverse_dynamics(truth.q, truth.qd, truth.qdd, c.base_parameters(chi))
    turns, _ = closing.compute_tree_map(source)
    free = [j.name for j in source.free_joints]
    couplings = [[row.get(name, 0.0) for name in free] for row in source.coupling.values()]
    shafts = truth.qd @ np.vstack([turns, *([couplings] if couplings else [])]).T
    core = 1e-3 * 2.0 * 20
    moving = np.all(np.abs(shafts) > core, axis=1)
    assert moving.mean() > 0.15
    error = np.abs(tau - truth.tau)[moving]
    assert error.max() < 1e-9 * np.abs(truth.tau).max()


def test_relations_of_relations():
    text = """
    name = "chain"
    gravity = [0, 0, -9.81]
    [mdh]
    columns = ["j", "a", "mu", "d", "theta"]
    rows = [["1", "0", 1, 0, "q1"], ["2", "1", 0, 0.3, "2*q1 - q3 + 0.1"],
            ["3", "2", 0, 0.2, "q3"], ["4", "3", 1, 0.2, "q4"], ["5", "4", 0, 0.1, "q5"]]
    [relations]
    q3 = "q5/2 + 0.4"
    q5 = "-q4 + q1 + pi"
    """
    source = parse_robot_text(re.sub(r"^ {4}", "", text, flags=re.M), "chain")
    turns, offset = closing.compute_tree_map(source)
    q1, q4 = 0.3, -0.7
    q5 = -q4 + q1 + np.pi
    q3 = q5 / 2 + 0.4
    expected = [q1, 2 * q1 - q3 + 0.1, q3, q4, q5]
    np.testing.assert_allclose(turns @ [q1, q4] + offset, expected, atol=1e-14)


def test_sensors_seeds_and_progress():
    source, step, shares = read_robot("five-bar"), 2 * np.pi / 4096, []
    coarse = {"rate": 1500, "encoder_counts": 4096, "torque_noise": 0.03}
    settings = dataclasses.replace(IDEAL, **coarse, duration=2.0)
    log = simulate(source, settings, shares.append)
    np.testing.assert_allclose(log.q / step, np.round(log.q / step), atol=1e-6)
    assert 0.9 * step / 2 < np.abs(log.q - log.truth.q).max() <= step / 2 * (1 + 1e-9)
    noise = (log.tau - log.truth.tau) / np.sqrt(np.mean(log.truth.tau**2, axis=0))
    np.testing.assert_allclose(noise.std(axis=0), 0.03, rtol=0.06)
    assert shares == sorted(shares) and shares[-1] == 1.0 and len(shares) > 1
    again, ideal, other = (
        simulate(source, changed)
        for changed in (settings, IDEAL, dataclasses.replace(IDEAL, seed=1, parameter_seed=1))
    )
    assert np.array_equal(log.tau, again.tau) and np.array_equal(log.q, again.q)
    assert np.array_equal(ideal.q, ideal.truth.q) and np.array_equal(ideal.tau, ideal.truth.tau)
    assert np.abs(ideal.truth.q - other.truth.q).max() > 0.01
    drawn = ideal.truth.random_parameters
    assert drawn == other.truth.random_parameters and "ZZ11" not in drawn
    assert all(ideal.truth.parameters[n] != other.truth.parameters[n] for n in drawn)


@pytest.mark.rotating("long tests of simulate")
def test_legs_that_share_parameters_are_alike_and_told_once():
    source = read_robot("orthoglide-2003-similar-legs")
    parameters = draw_plant_parameters(source, collect_motion_limits(source))
    for shared in source.shared:
        assert len({parameters.standard[member] for member in shared.members}) == 1
    for row in ("21", "22", "23"):
        assert np.array_equal(parameters.bodies[row].inertia, parameters.bodies["21"].inertia)
    truth = simulate(source, dataclasses.replace(IDEAL, duration=0.2)).truth
    names = list(truth.parameters)
    assert "M2" in names and not {"M21", "M22", "M23"} & set(names)
    assert len(names) == len(set(names)) and set(truth.random_parameters) <= set(names)
    stated = dataclasses.replace(source, parameters={"M2": 0.7, "M3": 0.2})
    values = draw_plant_parameters(stated, collect_motion_limits(stated)).standard
    assert [values[f"M2{leg}"] for leg in "123"] == [0.7] * 3


def test_a_motor_that_turns_joints_by_gears_has_friction_and_inertia():
    source = read_robot("dvrk-psm")
    standard = draw_plant_parameters(source, collect_motion_limits(source)).standard
    assert all(standard[f"{p}{row}"] > 0 for p in ("Ia", "Fv", "Fs") for row in "567")
    assert standard["Ia5"] < 1.0


def test_without_limits_a_closed_robot_moves_around_home():
    source = robot(CRANK)
    limit = collect_motion_limits(source)[0]
    assert (limit.lower, limit.upper) == pytest.approx((np.pi / 2 - 0.3, np.pi / 2 + 0.3))
    assert collect_motion_limits(dataclasses.replace(source, loops=()))[0].lower == -1.5


LOOSE = CRANK.replace('["3", "0"', '["4", "1", 0, 0, 0, 0, 0.2, "q4", 0],\n  ["3", "0"')
SHORT_ROD = CRANK.replace("L = 0.35", "L = 0.09").replace('q1 = "pi/2"', "q1 = 0.5")
SHORT_ROD = SHORT_ROD.replace("q2 = -1.86", "q2 = -1.1").replace("q3 = 0.33", "q3 = 0.16")
MISTAKES = [
    (
        robot(CRANK.replace("L = 0.35", "L = 0.095")),
        RobotError,
        r"loops of crank do not close at \[home\]; state values near a closed posture",
    ),
    (
        robot(SHORT_ROD, limits="1 = [1.2, 1.4, 2, 8]"),
        DataError,
        r"no motion of joints 1 of crank keeps .* around \[home\]",
    ),
    (
        robot(LOOSE),
        RobotError,
        r"joints 4 of crank can move at \[home\] with the actuated joints locked; actuate one",
    ),
]


@pytest.mark.parametrize(("source", "error", "message"), MISTAKES)
def test_mistakes(source, error, message):
    with pytest.raises(error, match=message):
        simulate(source, dataclasses.replace(IDEAL, duration=2.0, rate=100))


def test_the_assembly_mode_is_kept_where_modes_meet():
    """Rod shorter than crank: the slider's two places meet where R sin(q1) = L, and end there."""
    source = robot(SHORT_ROD, limits="1 = [0.5, 1.1, 2, 8]")
    constraints = closing.build_constraints(source)
    q = np.linspace(0.5, np.arcsin(0.9) - 1e-3, 50)
    right = closing.compute_closed_postures(source, constraints, q[:, None])
    rod = -np.arcsin(0.1 * np.sin(q) / 0.09)
    np.testing.assert_allclose(right[:, 1], rod - q, atol=1e-9)
    np.testing.assert_allclose(right[:, 2], 0.1 * np.cos(q) + 0.09 * np.cos(rod), atol=1e-9)
    left = right[-1].copy()
    left[1:] = -np.pi - rod[-1] - q[-1], 0.1 * np.cos(q[-1]) - 0.09 * np.cos(rod[-1])
    assert np.abs(constraints.residual(left).full()).max() < 1e-9
    assert np.abs(left - right[-1]).max() < 0.2  # near, and another mode all the same
    assert not closing._is_same_mode(constraints, right[-1], left)
    assert closing._is_same_mode(constraints, right[-2], right[-1])
    with pytest.raises(DataError, match=r"do not close at sample \d+, joints 1 at 1\.\d+; shrink"):
        closing.compute_closed_postures(source, constraints, np.linspace(0.5, 1.5, 50)[:, None])


def test_moments_without_mass_are_refused():
    text = read_builtin_robot("five-bar").replace(
        "[limits]", '[links]\n21 = ["ZZ", "MX"]\n\n[limits]'
    )
    text = text.replace("M21 = 0.6\n", "")
    source = parse_robot_text(text, "five-bar")
    with pytest.raises(RobotError, match=r"link 21: MX21 without a mass, .*; add M21 under"):
        simulate(source, IDEAL)


@with_cases(
    "change, message",
    ({"motion": "fast"}, "motion: got fast; expected one of exciting, point-to-po"),
    ({"motion": "point-to-point", "duration": 0.05}, "0.05 s, too short for a move and back"),
)
def test_motions_by_name(change, message):
    with pytest.raises(DataError, match=message):
        simulate(read_robot("five-bar"), dataclasses.replace(IDEAL, **change))
