"""Closed-loop measurements: laws, sensors, controller, seeds, files, mistakes."""

import dataclasses
import json
import shutil

import casadi as ca
import numpy as np
import pyarrow.parquet as pq
import pytest
from closed_robots import LOOPS, RELATIONS, energies, without_effects

import modeler.simulation
from modeler.core.choices import EFFECTS, MOTIONS, SIMULATED
from modeler.core.errors import DataError, ModelerError
from modeler.effects.catalogue import CATALOGUE
from modeler.robot.read import read_robot
from modeler.robot.robot import Limits
from modeler.simulation import (
    HIDDEN,
    SimulatedLog,
    SimulationSettings,
    closing,
    collect_motion_limits,
    draw_plant_parameters,
    plant as native,
    run as controlling,
    simulate,
    write_log,
    write_truth,
)
from modeler.simulation.plant import build_plant
from modeler.simulation.run import quantise_position
from tests.robot_texts import ARM, PENDULUM, SIX, TREE, TWO_LINK, robot
from tests.rotation import rotating, with_cases

SHORT = SimulationSettings(duration=2.5)
TEXTS = {"tree": TREE, "two-link": TWO_LINK, "six": SIX}
IN_TURN = ["tree", *rotating("two-link", "six")]


@pytest.fixture(scope="module")
def arm_log() -> SimulatedLog:
    return simulate(robot(ARM), SHORT)


def parameters_of(source, settings):
    return draw_plant_parameters(
        source, collect_motion_limits(source, settings.limits), settings.parameter_seed
    )


def plant_of(source, settings):
    limits = collect_motion_limits(source, settings.limits)
    return build_plant(source, parameters_of(source, settings), limits)


@pytest.mark.parametrize("name", [*IN_TURN, *RELATIONS, *LOOPS])
def test_the_motors_work_is_what_the_energy_gains(name):
    """Without friction; exact for torques held over each tick, but for the integration's steps."""
    source = without_effects(robot(TEXTS[name]) if name in TEXTS else read_robot(name))
    if source.relations:  # rotors that no effect gives an inertia would have none: light links
        source = dataclasses.replace(source, links={})
    seconds = 0.8 if source.loops else 2.5
    settings = dataclasses.replace(SHORT, duration=seconds, controller=True)
    truth = simulate(source, settings).truth
    if source.loops:
        constraints = closing.build_constraints(source)
        v = closing.compute_closed_postures(source, constraints, truth.q)
        vd, _ = closing.compute_rates(constraints, v, truth.qd, truth.qdd)
    else:
        turns, offset = closing.compute_tree_map(source)
        v, vd = truth.q @ turns.T + offset, truth.qd @ turns.T
    total = energies(source, parameters_of(source, SHORT), v, vd)
    work = np.cumsum(np.sum(truth.tau[:-1] * np.diff(truth.q, axis=0), axis=1))
    swing = np.ptp(total)
    assert swing > (0.1 if name in TEXTS else 0.01)
    near = (1e-8 if name in TEXTS else 1e-7) * swing
    np.testing.assert_allclose(total[1:] - total[0], work, rtol=0, atol=near)


def test_true_motion_is_consistent(arm_log):
    truth, rate = arm_log.truth, SHORT.rate
    middle = (truth.q[2:] - truth.q[:-2]) * rate / 2
    assert np.abs(middle - truth.qd[1:-1]).max() < 2e-3
    ahead = np.diff(truth.qd, axis=0) * rate
    moving = np.all(np.abs(truth.qd[:-1]) > 0.02, axis=1)  # outside the core of dry friction
    assert np.abs(ahead - truth.qdd[:-1])[moving].max() < 0.1


def test_measured_torque_is_centred_at_the_sample():
    """A log whose torque lagged by half a tick would be diagnosed as a delay of half a tick."""
    log = simulate(robot(TWO_LINK), dataclasses.replace(SHORT, torque_noise=0.0))
    plant, truth = plant_of(robot(TWO_LINK), SHORT), log.truth
    qdd = np.gradient(truth.qd, 1 / SHORT.rate, axis=0)  # central differences
    count = log.time.size
    torque = plant.torque.map(count)(truth.q.T, truth.qd.T, qdd.T, np.zeros((0, count))).full().T
    inner = slice(50, -50)
    errors = {}
    for shift in (-1, 0, 1):
        moved = (log.tau + np.roll(log.tau, shift, axis=0)) / 2
        errors[shift] = np.linalg.norm((moved - torque)[inner])
    assert errors[0] < 0.2 * min(errors[-1], errors[1])


@pytest.mark.parametrize("name", IN_TURN)
def test_the_controller_tracks(name):
    log = simulate(robot(TEXTS[name]), dataclasses.replace(SHORT, duration=4.0))
    error = log.truth.q - log.qc
    spans = np.ptp(log.qc, axis=0)
    assert np.all(spans > 0.1)
    assert np.all(np.abs(error).max(axis=0) < 0.01 * spans)
    assert np.all(error.std(axis=0) > 0)


def test_encoders_and_torque_sensors():
    coarse = {"encoder_counts": 4096, "linear_resolution": 1e-5, "torque_noise": 0.03}
    settings = dataclasses.replace(SHORT, **coarse)
    log = simulate(robot(TREE), settings)
    steps = np.array([2 * np.pi / 4096, 1e-5, 2 * np.pi / 4096, 2 * np.pi / 4096])
    counts = log.q / steps
    np.testing.assert_allclose(counts, np.round(counts), atol=1e-6)
    assert np.all(np.abs(log.q - log.truth.q) <= steps / 2 * (1 + 1e-9))
    assert np.all(np.abs(log.q - log.truth.q).max(axis=0) > 0.9 * steps / 2)
    held = log.truth.tau
    mean = (held[1:] + held[:-1]) / 2
    noise = (log.tau[1:] - mean) / np.sqrt(np.mean(mean**2, axis=0))
    np.testing.assert_allclose(noise.std(axis=0), 0.03, rtol=0.05)
    assert np.abs(np.corrcoef(noise.T) - np.eye(4)).max() < 0.08


def test_ideal_sensors():
    exact = {"encoder_counts": 0, "linear_resolution": 0, "torque_noise": 0}
    settings = dataclasses.replace(SHORT, duration=0.5, **exact)
    log = simulate(robot(TREE), settings)
    assert np.array_equal(log.q, log.truth.q)
    assert np.array_equal(log.tau[1:], (log.truth.tau[1:] + log.truth.tau[:-1]) / 2)
    np.testing.assert_array_equal(
        quantise_position(np.array([0.26, 0.26]), np.array([0.1, 0.0])), [0.1 * 3, 0.26]
    )


def test_saturation_is_respected_and_shows(arm_log):
    free = np.abs(arm_log.truth.tau).max(axis=0)
    settings = dataclasses.replace(SHORT, torque_limits={"1": 0.8 * free[0]})
    tau = simulate(robot(ARM), settings).truth.tau
    assert np.abs(tau[:, 0]).max() == 0.8 * free[0]
    assert np.sum(np.abs(tau[:, 0]) == 0.8 * free[0]) > 5


def test_the_integral_does_not_wind_up():
    gains = controlling.tune_gains(1000.0, 20.0, True, np.array([1.0]))
    state = controlling.ControllerState(np.zeros(1), np.zeros(1), np.zeros(1))
    far, still = np.array([10.0]), np.zeros(1)
    for _ in range(100):
        state, torque = controlling.update_controller(
            gains, state, np.eye(1), still, (far, still, still)
        )
        assert torque == 1.0
    assert state.effort == 0.0
    state, torque = controlling.update_controller(
        gains, state, np.eye(1), still, (-far, still, still)
    )
    assert torque == -1.0


def test_slow_ticks_lower_the_bandwidth():
    fast, slow = (controlling.tune_gains(r, 20.0, True, np.ones(1)).speed for r in (1000, 100))
    assert fast == pytest.approx(2 * np.pi * 20)
    assert slow < fast / 3
    log = simulate(robot(ARM), dataclasses.replace(SHORT, rate=200.0))
    assert np.abs(log.truth.q - log.qc).max() < 0.05


def test_a_joint_without_motor_swings_freely():
    text = TWO_LINK.replace('"j", "a", ', '"j", "a", "mu", ')
    text = text.replace('"0", 0', '"0", 1, 0').replace('"1", 0.5', '"1", 0, 0.5')
    log = simulate(robot(text), SHORT)
    assert list(log.driven) == [True, False]
    assert np.all(log.truth.tau[:, 1] == 0) and np.ptp(log.truth.q[:, 1]) > 0.5
    assert np.abs(log.truth.q - log.qc)[:, 0].max() < 0.02
    assert list(modeler.simulation.log.build_log_columns(log)) == "time q1 q2 qc1 tau1".split()


def test_seeds_reproduce_every_bit(arm_log):
    again = simulate(robot(ARM), SHORT)
    other = simulate(robot(ARM), dataclasses.replace(SHORT, seed=1))
    for name in ("q", "qc", "tau"):
        assert np.array_equal(getattr(arm_log, name), getattr(again, name))
        assert not np.array_equal(getattr(arm_log, name), getattr(other, name))
    assert arm_log.truth.parameters == again.truth.parameters == other.truth.parameters


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_the_same_bits_with_a_compiler(arm_log, compiled_plants):
    made = native.compile_if_possible(ca.Function("f", [ca.SX.sym("x")], [ca.SX(1)]))
    assert made.class_name() == "External"
    assert np.array_equal(simulate(robot(ARM), SHORT).tau, arm_log.tau)


def test_a_compiler_that_fails_is_done_without(monkeypatch, compiled_plants):
    fails = shutil.which("false")
    monkeypatch.setattr(native.shutil, "which", lambda name: fails)
    x = ca.SX.sym("x")
    function = native.FastFunction(ca.Function("f", [x], [2 * x]))
    assert function(np.array([3.0])) == 6.0


def test_progress_ends_at_one():
    shares: list[float] = []
    simulate(robot(PENDULUM), dataclasses.replace(SHORT, duration=1.2), shares.append)
    assert shares == sorted(shares) and shares[-1] == 1.0 and len(shares) > 2


def test_files(arm_log, tmp_path):
    names = ["time", "q1", "q2", "q3", "qc1", "qc2", "qc3", "tau1", "tau2", "tau3"]
    write_log(tmp_path / "log.parquet", arm_log)
    table = pq.read_table(tmp_path / "log.parquet")
    assert table.column_names == names
    assert np.array_equal(table["q2"].to_numpy(), arm_log.q[:, 1])
    write_log(tmp_path / "log.csv", arm_log)
    with (tmp_path / "log.csv").open() as stream:
        assert stream.readline().strip().split(",") == names
        values = np.loadtxt(stream, delimiter=",")
    assert np.array_equal(values[:, 0], arm_log.time)
    assert np.array_equal(values[:, 7:], arm_log.tau)
    write_truth(tmp_path / "truth.json", arm_log)
    truth = json.loads((tmp_path / "truth.json").read_text())
    assert truth["robot"] == "arm" and truth["seed"] == 0
    assert truth["parameters"] == arm_log.truth.parameters
    assert (
        truth["random_parameters"] == list(arm_log.truth.random_parameters)
        and truth["hidden_effects"] == []
    )


def test_files_that_cannot_be_written(arm_log, tmp_path):
    with pytest.raises(DataError, match=r"got suffix \.xls; expected \.parquet or \.csv"):
        write_log(tmp_path / "log.xls", arm_log)
    with pytest.raises(DataError, match=r"got suffix \(none\)"):
        write_log(tmp_path / "log", arm_log)
    (tmp_path / "file").write_text("")
    for write in (write_log, write_truth):
        with pytest.raises(ModelerError, match="cannot be written"):
            write(tmp_path / "file" / "log.csv", arm_log)


@with_cases(
    "change, message",
    ({"duration": 0.0}, r"duration: got 0\.0; expected a number above 0"),
    ({"duration": float("nan")}, r"duration: got nan"),
    ({"duration": 1e9}, r"duration: got 1e\+09 s at 1000 samples .* expected at most 2e\+07"),
    ({"duration": 1e300, "rate": 1e300}, r"duration: got 1e\+300 s .* expected at most"),
    ({"rate": -1.0}, r"rate: got -1\.0; expected a number above 0"),
    ({"bandwidth": 0.0}, r"bandwidth: got 0\.0"),
    ({"seed": -1}, r"seed: got -1; expected 0 or more"),
    ({"encoder_counts": -5}, r"encoder_counts: got -5"),
    ({"torque_noise": -0.1}, r"torque_noise: got -0\.1"),
    ({"torque_noise": 1e300}, r"torque_noise: got 1e.300; expected 0 or more, at"),
    ({"process_noise": -1}, r"process_noise: got -1"),
    ({"process_noise": 1e300}, r"process_noise: got 1e.300; expected 0 or more, at"),
    ({"encoder_counts": 1e300}, r"encoder_counts: got 1e.300; expected 0 or more, at"),
    ({"torque_limits": {"x": 1.0}}, r"torque_limits: no moving joint x; expected one of 1"),
    ({"torque_limits": {"1": 0.0}}, r"torque_limits of joint 1: got 0\.0"),
    ({"limits": {"x": Limits(0, 1, 1, 1)}}, r"limits of joint x: no such moving joint"),
)
def test_settings_that_make_no_sense(change, message):
    with pytest.raises(ModelerError, match=message):
        simulate(robot(PENDULUM), dataclasses.replace(SHORT, **change))


def test_a_robot_too_heavy_for_its_motor_is_lost():
    settings = dataclasses.replace(SHORT, torque_limits={"1": 1e-3})
    with pytest.raises(DataError, match=r"lost joint 1 at .* raise the torque limit"):
        simulate(robot(PENDULUM, parameters="M1 = 5\nMX1 = 2"), settings)


def test_friction_too_stiff_for_any_step_is_named():
    source = robot(TWO_LINK, effects='coulomb = ["2"]', parameters="Fs2 = 5e4")
    with pytest.raises(DataError, match="joint 2: friction stops it within"):
        simulate(source, SHORT)


@pytest.mark.rotating("long tests of simulate")
def test_stiff_friction_is_still_integrated():
    """Ten times the drawn Coulomb friction; the joint still follows, and nothing rings."""
    limits = collect_motion_limits(robot(ARM))
    drawn = draw_plant_parameters(robot(ARM), limits).standard["Fs3"]
    settings = dataclasses.replace(SHORT, duration=1.2)
    log = simulate(robot(ARM, parameters=f"Fs3 = {10 * drawn}"), settings)
    assert np.abs(log.truth.q - log.qc)[:, 2].max() < 0.05
    assert np.all(np.abs(log.truth.qdd) < 500)


def test_what_the_command_line_says_of_settings_and_effects_is_so() -> None:
    settings = SimulationSettings()
    assert MOTIONS[0] == settings.motion
    assert {name: getattr(settings, name) for name in SIMULATED} == dict(SIMULATED)
    assert tuple(effect.id for effect in CATALOGUE if effect.id in HIDDEN) == EFFECTS
