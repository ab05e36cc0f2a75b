"""Hidden effects: each changes the torques as its physics says, by laws written here anew."""

import dataclasses
import json
from functools import cache

import casadi as ca
import numpy as np
import pytest

from modeler import simulation
from modeler.cli import main
from modeler.core.errors import DataError, ModelerError
from modeler.robot.read import read_robot
from modeler.simulation.closing import build_constraints, compute_closed_postures, compute_rates
from modeler.simulation.hidden_draw import complete_effects
from modeler.simulation.plant import apply_hidden_loads, build_plant, choose_steps_per_tick
from modeler.simulation.rigid import compute_gravity_vector, compute_world_frames
from modeler.simulation.shafts import compute_rest_states
from tests.oracles.complex_step import Oracle
from tests.robot_texts import TWO_LINK, robot
from tests.rotation import with_cases

SHORT = simulation.SimulationSettings(
    duration=3.0, encoder_counts=0, linear_resolution=0.0, torque_noise=0.0, rate=500.0
)
ARM = read_robot("demo-arm")
NAMES = [joint.name for joint in ARM.moving_joints]
TOP = np.array([limit.speed for limit in simulation.collect_motion_limits(ARM)])
SERIAL = [name for name, kind in simulation.HIDDEN.items() if kind.where != "passive"]

# A motor of 0.5 kg m2 and a link of 2 kg m2 on one axis, without gravity or friction.
SPINNER = """
name = "spinner"
gravity = [0, 0, 0]
[mdh]
columns = ["j", "a", "theta"]
rows = [["1", "0", "q1"]]
[effects]
rotor_inertia = "all"
[parameters]
Ia1 = 0.5
ZZ1 = 2.0
"""


def settings_of(text, settings=SHORT):
    return dataclasses.replace(settings, hidden=(simulation.parse_hidden_effect(text),))


def made(text, source=ARM):
    """The hidden effect with all its values, and the machine's plant."""
    limits = simulation.collect_motion_limits(source)
    parameters = simulation.draw_plant_parameters(source, limits)
    hidden = complete_effects(source, parameters, limits, settings_of(text))
    plant = build_plant(*apply_hidden_loads(source, parameters, hidden), limits, hidden)
    return hidden[0], plant


def plain_of(source):
    limits = simulation.collect_motion_limits(source)
    return build_plant(source, simulation.draw_plant_parameters(source, limits), limits)


@cache
def plain():
    """The plant of the arm without hidden effects."""
    return plain_of(ARM)


def without(source, *effects):
    rest = tuple(use for use in source.effects if use.effect not in effects)
    return dataclasses.replace(source, effects=rest)


def states(count=200, seed=0):
    """Random motion; no joint slower than a tenth of its top speed."""
    rng = np.random.default_rng(seed)
    limits = simulation.collect_motion_limits(ARM)
    low, high, lift = (
        np.array([getattr(limit, k) for limit in limits])
        for k in ("lower", "upper", "acceleration")
    )
    v = TOP * rng.uniform(0.1, 1.0, (count, 3)) * rng.choice([-1.0, 1.0], (count, 3))
    return rng.uniform(low, high, (count, 3)), v, lift * rng.uniform(-1, 1, (count, 3))


def torques(plant, q, v, a, z=None):
    z = np.zeros((len(q), plant.states)) if z is None else z
    return plant.torque.map(len(q))(q.T, v.T, a.T, z.T).full().T


def added(text, q, v, a):
    """The hidden effect, and (n, 3) torques it adds."""
    effect, plant = made(text)
    return effect, torques(plant, q, v, a) - torques(plain(), q, v, a)


LAWS = {
    "viscous": lambda p, q, v, a: p["Fv"] * v,
    "coulomb": lambda p, q, v, a: p["Fs"] * np.sign(v),
    "offset": lambda p, q, v, a: p["Off"] + 0 * v,
    "rotor_inertia": lambda p, q, v, a: p["Ia"] * a,
    "asymmetric_viscous": lambda p, q, v, a: p["coefficient"] * np.abs(v),
    "stribeck": lambda p, q, v, a: p["extra"] * np.exp(-((v / p["speed"]) ** 2)) * np.sign(v),
    "nonlinear_viscous": lambda p, q, v, a: p["coefficient"] * np.abs(v) ** p["power"] * np.sign(v),
    "position_friction": lambda p, q, v, a: p["level"] * (1 + np.cos(q - p["phase"])) * np.sign(v),
    "spring": lambda p, q, v, a: p["stiffness"] * (q - p["rest"]),
    "motor_ripple": lambda p, q, v, a: (
        p["amplitude"] * np.sin(p["order"] * p["gear"] * q + p["phase"])
    ),
    "joint_ripple": lambda p, q, v, a: p["amplitude"] * np.sin(p["order"] * q + p["phase"]),
}


@pytest.mark.parametrize("name", LAWS)
def test_torque_on_the_joint_and_on_no_other(name, joint="3"):
    q, v, a = states()
    v = v * (0.1 if name == "stribeck" else 1.0)
    effect, more = added(f"{name}@{joint}", q, v, a)
    j = NAMES.index(joint)
    expected = LAWS[name](effect.values, q[:, j], v[:, j], a[:, j])
    size = np.abs(expected).max()
    assert size > 1e-3
    # Signs and absolute values are rounded in a core of 1/1000 of the top speed.
    core = 1e-3 * TOP[j] * abs(effect.values.get("coefficient", 0.0))
    np.testing.assert_allclose(more[:, j], expected, rtol=1e-4, atol=1e-9 * size + core)
    assert np.abs(np.delete(more, j, axis=1)).max() < 1e-10


@pytest.mark.parametrize("name", ["counterbalance", "constant_force_spring"])
def test_springs_with_levers_do_the_work_of_their_length(name):
    """Their torque is the slope of the energy of a spring between two points."""
    q = np.zeros((400, 3))
    q[:, 1] = np.linspace(-0.6, 2.4, 400)
    effect, more = added(f"{name}@2", q, 0 * q, 0 * q)
    p = effect.values
    ends = p["base"] * np.array([1.0, 0.0])
    turn = q[:, 1] - p["angle"]
    tips = p["lever"] * np.column_stack([np.cos(turn), np.sin(turn)])
    length = np.linalg.norm(tips - ends, axis=1)
    if name == "counterbalance":
        energy = p["stiffness"] * (length - p["length"]) ** 2 / 2
        assert np.all(length > p["length"])  # drawn so that it always pulls
    else:
        energy = p["force"] * length
    slope = np.gradient(energy, q[:, 1])
    np.testing.assert_allclose(more[1:-1, 1], slope[1:-1], atol=1e-3 * np.abs(slope).max())


@pytest.mark.parametrize("ratio", [1.0, -0.5])
def test_coupled_motors_work_on_both_joints(ratio):
    q, v, a = states()
    effect, more = added(f"coupled_friction@2:ratio={ratio}", q, v, a)
    p, w = effect.values, v[:, 1] + ratio * v[:, 2]
    clear = np.abs(w) > 0.05
    level = (p["Fv"] * w + p["Fs"] * np.sign(w))[clear]
    np.testing.assert_allclose(more[clear, 1], level, rtol=1e-6)
    np.testing.assert_allclose(more[clear, 2], ratio * level, rtol=1e-6)
    effect, more = added(f"coupled_inertia@1:ratio={ratio}", q, v, a)
    rise = effect.values["Ia"] * (a[:, 0] + ratio * a[:, 1])
    np.testing.assert_allclose(more, np.column_stack([rise, ratio * rise, 0 * rise]), atol=1e-9)


def test_load_friction_is_a_share_of_what_the_links_ask():
    q, v, a = states()
    _, more = added("load_friction@2:coefficient=0.1", q, v, a)
    bare = without(ARM, "rotor_inertia", "viscous", "coulomb", "offset")
    load = torques(plain_of(bare), q, v, a)[:, 1]
    np.testing.assert_allclose(more[:, 1], 0.1 * np.abs(load) * np.sign(v[:, 1]), atol=1e-9)
    # The accelerations it leads to are those at which the torques balance.
    _, plant = made("load_friction@2:coefficient=0.1")
    tau = torques(plain(), q, v, a)
    got = plant.acceleration.map(len(q))(q.T, v.T, np.zeros((0, len(q))), tau.T)[0].full().T
    np.testing.assert_allclose(torques(plant, q, v, got), tau, atol=1e-3 * np.abs(tau).max())


def friction_along(text, effects, settings=SHORT, joint=1):
    """The effect, truth, and torque on the joint beyond a plain arm without these effects."""
    log = simulation.simulate(ARM, settings_of(text, settings))
    truth = log.truth
    rest = torques(plain_of(without(ARM, *effects)), truth.q, truth.qd, truth.qdd)
    return log, truth.hidden_effects[0].values, (truth.tau - rest)[:, joint]


def test_bristles_hold_at_reversals_and_slide_after():
    log, p, force = friction_along("presliding@2", ["coulomb"])
    q, v = log.truth.q[:, 1], log.truth.qd[:, 1]
    turns = np.flatnonzero(np.diff(np.sign(v)) != 0)
    begun = np.concatenate([[0], turns + 1])
    last = begun[np.searchsorted(begun, np.arange(len(q)), side="right") - 1]
    travel = np.abs(q - q[last])
    sliding = (travel > 8 * p["distance"]) & (np.abs(v) > 0.02)
    assert sliding.sum() > 200 and len(turns) > 2
    np.testing.assert_allclose((force * np.sign(v))[sliding], p["level"], rtol=0.02)
    # Bristles bent the other way still push forward just after a reversal from a long stroke.
    early = [k for k in turns[1:] if travel[k] > 8 * p["distance"] and abs(v[k + 2]) > 1e-4]
    assert early and all(force[k + 1] * np.sign(v[k + 2]) < 0.9 * p["level"] for k in early)


def test_hysteresis_of_a_cable_takes_work_in_closed_loops():
    log, p, force = friction_along("cable_hysteresis@2:width=0.05", [])
    q, v = log.truth.q[:, 1], log.truth.qd[:, 1]
    assert np.abs(force).max() < 1.001 * p["level"] and np.ptp(force) > 1.8 * p["level"]
    # Whatever the path, what it gives back is less than what a bent cable holds.
    work = np.cumsum((force * v)[:-1]) / log.settings.rate
    held = p["level"] * p["width"] * 2
    assert work[-1] > 3 * held and np.max(np.maximum.accumulate(work) - work) < held
    assert np.ptp(q) > 3 * p["width"]


def test_friction_falls_as_its_joint_warms():
    settings = dataclasses.replace(SHORT, duration=4.0, motion="point-to-point")
    heated = "temperature_friction@2:time=4,start=5"
    log, p, force = friction_along(heated, ["coulomb", "viscous"], settings)
    standard = simulation.draw_plant_parameters(ARM, simulation.collect_motion_limits(ARM)).standard
    assert (p["Fv"], p["Fs"]) == (standard["Fv2"], standard["Fs2"])
    warm, v = log.further["temperature2"], log.truth.qd[:, 1]
    assert warm[0] == 30.0 and np.ptp(warm) > 2
    clear = np.abs(v) > 0.02
    cold = (p["Fv"] * v + p["Fs"] * np.sign(v))[clear]
    np.testing.assert_allclose(force[clear], cold * 0.5 ** ((warm[clear] - 25) / 30), rtol=1e-3)
    heat = p["heating"] * force * v - (warm - 25)
    gained = np.cumsum((heat[1:] + heat[:-1]) / 2) / log.settings.rate / p["time"]
    np.testing.assert_allclose(warm[1:] - warm[0], gained, atol=0.05)


def slopes(name, point, q):
    """(n, 3, joints) of the place of a point of a link, and of its turning, by the oracle."""
    R, _, J, spin = Oracle(ARM).frames(q)[name]
    return J + np.cross(spin, (R @ point)[:, :, None], axis=1), spin


def test_a_payload_weighs_at_rest_and_has_ten_parameters():
    q, v, a = states()
    effect, more = added("payload:mass=2", q, 0 * v, 0 * a)
    J, turning = slopes("3", [effect.values[k] for k in "xyz"], q)
    np.testing.assert_allclose(more, 2 * 9.81 * J[:, 2], atol=1e-7)
    _, moving = added("payload:mass=2", q, 0 * v, a)
    turned = added("payload:mass=2,radius=0.5", q, 0 * v, a)[1] - moving
    pushed, spin = (np.einsum("nij,nik,nk->nj", x, x, a) for x in (J, turning))
    square = effect.values["radius"] ** 2
    np.testing.assert_allclose(moving - more, 2 * pushed + 2 * square * spin, atol=1e-5)
    np.testing.assert_allclose(turned, 2 * (0.5**2 - square) * spin, atol=1e-7)


def test_a_body_on_a_link_is_not_felt_beyond_it():
    q, v, a = states()
    effect, more = added("link_inertia@2", q, v, a)
    assert np.abs(more[:, 2]).max() < 1e-10 and np.abs(more[:, :2]).max(axis=0).min() > 0.1
    assert effect.values["mass"] > 0


@pytest.mark.parametrize("gravity", ["[0, 0, -9.81]", "[0.3, -9.7, 0.1]"])
def test_a_tilted_base_turns_gravity(gravity):
    source = robot(SPINNER.replace("[0, 0, 0]", gravity))
    parameters = simulation.draw_plant_parameters(source, simulation.collect_motion_limits(source))
    before, after = compute_gravity_vector(source), []
    for heading in (0.0, np.pi / 2):
        tilt = simulation.HiddenEffect("base_tilt", None, {"angle": 0.05, "heading": heading})
        after.append(compute_gravity_vector(apply_hidden_loads(source, parameters, [tilt])[0]))
        assert np.linalg.norm(after[-1]) == pytest.approx(np.linalg.norm(before))
        cosine = after[-1] @ before / (before @ before)
        assert np.arccos(cosine) == pytest.approx(0.05, rel=1e-6)
    shifts = [x - before * np.cos(0.05) for x in after]
    assert abs(shifts[0] @ shifts[1]) < 1e-10
    if source.gravity[2].evaluate({}) == -9.81:  # turned about x, weight falls towards -y or +y
        np.testing.assert_allclose(after[0], [0, 9.81 * np.sin(0.05), -9.81 * np.cos(0.05)])


def test_a_force_pushes_in_its_window_only():
    text = "external_force:fx=10,fy=-20,fz=5,start=1,length=0.5"
    log, p, _ = friction_along(text, [])
    truth = log.truth
    more = truth.tau - torques(plain(), truth.q, truth.qd, truth.qdd)
    J, _ = slopes("3", [p[k] for k in "xyz"], truth.q)
    pushed = -np.einsum("i,nij->nj", [10, -20, 5], J)
    inside, outside = np.abs(log.time - 1.25) < 0.22, np.abs(log.time - 1.25) > 0.28
    np.testing.assert_allclose(more[inside], pushed[inside], atol=1e-5 * np.abs(pushed).max())
    assert np.abs(more[outside]).max() < 1e-4 * np.abs(pushed).max()


def test_an_elastic_transmission_has_the_frequency_of_two_bodies_on_a_spring():
    """w^2 = K (1/Ia + 1/J), and on the motor alone acts a sudden torque."""
    source = robot(SPINNER)
    _, plant = made("elasticity:stiffness=8000,damping=1e-9", source)
    columns = []
    for unit in np.eye(4):  # q, qd, ahead, its rate
        qdd, z_rate = plant.acceleration(unit[0], unit[1], unit[2:], 0.0)
        columns.append([unit[1], float(qdd), *z_rate.full().ravel()])
    modes = np.linalg.eigvals(np.array(columns).T)
    assert np.abs(modes.imag).max() == pytest.approx(np.sqrt(8000 * (1 / 0.5 + 1 / 2.0)))
    qdd, z_rate = plant.acceleration(0.0, 0.0, [0.0, 0.0], 3.0)
    assert float(qdd) == pytest.approx(3.0 / 0.5)
    assert float(z_rate[1]) == pytest.approx(-3.0 / 0.5)  # the link stays where it is
    assert float(plant.inertia(0.0)) == pytest.approx(2.5)


def test_backlash_lets_the_motor_turn_alone_until_teeth_meet():
    source = robot(SPINNER)
    effect, plant = made("backlash:gap=0.01,stiffness=1e5,damping=50", source)
    for ahead, pull in ((0.0, 0.0), (0.0045, 0.0), (0.006, 1e5 * 1e-3), (-0.007, -1e5 * 2e-3)):
        qdd, z_rate = plant.acceleration(0.0, 0.0, [ahead, 0.0], 3.0)
        motor, link = float(qdd), float(qdd + z_rate[1])
        assert 0.5 * motor == pytest.approx(3.0 + pull, abs=0.2)
        assert 0.5 * motor + 2.0 * link == pytest.approx(3.0)  # the whole moment
    assert effect.joint == "1"


@pytest.mark.parametrize("name", ["elasticity", "backlash"])
def test_links_sag_on_their_transmissions_at_rest(name):
    effect, plant = made(f"{name}@2")
    q = np.array([0.2, 0.1, 0.3])
    z = compute_rest_states(plant.strain, q, np.zeros(plant.states))
    rest = np.zeros(3)
    tau = plant.torque(q, rest, rest, z).full().ravel()
    qdd, z_rate = plant.acceleration(q, rest, z, tau)
    assert np.abs(qdd.full()).max() < 1e-6 and np.abs(z_rate.full()).max() < 1e-6
    weight = torques(plain(), q[None], rest[None], rest[None])[0, 1] - ARM.parameters["Off2"]
    sag = weight / effect.values["stiffness"] + effect.values.get("gap", 0.0) / 2
    assert z[0] == pytest.approx(-sag, rel=0.05)


@pytest.fixture(scope="module")
def clean():
    return simulation.simulate(ARM, SHORT)


@pytest.mark.slow
def test_sensors_that_are_wrong_do_not_change_the_machine(clean):
    late = simulation.simulate(ARM, settings_of("time_delay:delay=0.006"))
    np.testing.assert_allclose(late.tau[4:], clean.tau[1:-3], atol=1e-9)
    part = simulation.simulate(ARM, settings_of("time_delay:delay=0.005")).tau[4:]
    means = (clean.tau[3:-2] + clean.tau[2:-3]) / 2
    np.testing.assert_allclose(part[1:], means, atol=0.02 * np.ptp(clean.tau))
    weak = simulation.simulate(ARM, settings_of("drive_gain@2:ratio=0.9"))
    np.testing.assert_allclose(weak.tau, clean.tau * [1, 0.9, 1], rtol=1e-12)
    lost = simulation.simulate(ARM, settings_of("drift@3:per_minute=6"))
    np.testing.assert_allclose(lost.tau - clean.tau, np.outer(lost.time, [0, 0, 0.1]), atol=1e-10)
    for log in (late, weak, lost):
        assert np.array_equal(log.q, clean.q)


def test_encoders_that_are_wrong_deceive_the_controller(clean):
    moved = simulation.simulate(ARM, settings_of("encoder_offset@2:angle=0.03"))
    np.testing.assert_allclose(moved.q - moved.truth.q, [[0, 0.03, 0]] * len(moved.q), atol=1e-12)
    assert np.abs(moved.q - moved.qc).max() < 1.2 * np.abs(clean.q - clean.qc).max()
    waved = simulation.simulate(ARM, settings_of("encoder_eccentricity@3:amplitude=0.01,phase=0.5"))
    error = 0.01 * np.sin(waved.truth.q[:, 2] + 0.5)
    np.testing.assert_allclose((waved.q - waved.truth.q)[:, 2], error, atol=1e-12)
    assert np.abs(waved.q - waved.qc).max() < 1.5 * np.abs(clean.q - clean.qc).max()
    for log in (moved, waved):  # read what determines them from the start
        np.testing.assert_allclose(log.q[0], log.qc[0], atol=1e-9)


def test_random_torques_on_the_machine(clean):
    log = simulation.simulate(ARM, dataclasses.replace(SHORT, duration=6.0, process_noise=0.05))
    truth = log.truth
    pushed = torques(plain(), truth.q, truth.qd, truth.qdd) - truth.tau
    share = pushed.std(axis=0) / np.sqrt(np.mean(truth.tau**2, axis=0))
    np.testing.assert_allclose(share, 0.05, rtol=0.3)
    lag = int(0.03 * log.settings.rate)
    subset = np.mean(pushed[lag:] * pushed[:-lag], axis=0) / pushed.var(axis=0)
    np.testing.assert_allclose(subset, np.exp(-1), atol=0.15)
    assert np.abs(truth.q - log.qc).max() < 0.05


@pytest.mark.rotating
@pytest.mark.parametrize("name", SERIAL)
def test_every_effect_is_drawn_seen_and_kept_under_control(name):
    settings = dataclasses.replace(SHORT, duration=0.8, rate=400.0)
    log = simulation.simulate(ARM, settings_of(name, settings))
    (effect,) = log.truth.hidden_effects
    assert effect.effect == name
    assert (effect.joint is None) == (simulation.HIDDEN[name].where == "system")
    assert np.abs(log.q - log.qc).max() < 0.05
    assert np.all(np.isfinite(log.tau))


def test_what_is_drawn_belongs_to_the_parameter_seed_alone():
    def values(**changes):
        settings = dataclasses.replace(SHORT, **changes)
        limits = simulation.collect_motion_limits(ARM)
        parameters = simulation.draw_plant_parameters(ARM, limits, settings.parameter_seed)
        return complete_effects(ARM, parameters, limits, settings)

    stribeck, spring = simulation.HiddenEffect("stribeck"), simulation.HiddenEffect("spring")
    (alone,) = values(hidden=(stribeck,))
    assert values(hidden=(spring, stribeck), seed=5)[1] == alone
    others = [values(hidden=(stribeck,), parameter_seed=k)[0] for k in range(1, 9)]
    assert all(other.values != alone.values for other in others)
    assert len({other.joint for other in others}) == 3
    (inputs,) = values(hidden=(simulation.HiddenEffect("stribeck", alone.joint, {"extra": 9.0}),))
    assert inputs.values == {**alone.values, "extra": 9.0}
    twice = values(
        hidden=(
            simulation.HiddenEffect("motor_ripple", "1"),
            simulation.HiddenEffect("motor_ripple", "1"),
        )
    )
    assert twice[0].values != twice[1].values


LOOPED = simulation.SimulationSettings(
    duration=1.0, rate=200.0, encoder_counts=0, linear_resolution=0.0, torque_noise=0.0
)


@pytest.fixture(scope="module")
def five_bar():
    source = read_robot("five-bar")
    return source, simulation.simulate(source, LOOPED)


def test_friction_in_passive_joints_costs_the_motors_its_power(five_bar):
    source, before = five_bar
    log = simulation.simulate(source, settings_of("passive_friction@22:Fv=0.2,Fs=0.1", LOOPED))
    truth, constraints = log.truth, build_constraints(source)
    v, _ = compute_rates(
        constraints, compute_closed_postures(source, constraints, truth.q), truth.qd, truth.qdd
    )
    w = v[:, [joint.name for joint in source.moving_joints].index("22")]
    power = np.sum((truth.tau - before.truth.tau) * truth.qd, axis=1)
    clear = np.abs(w) > 0.05
    expected = (0.2 * w**2 + 0.1 * np.abs(w))[clear]
    np.testing.assert_allclose(power[clear], expected, rtol=1e-6, atol=1e-9)


LAWS_IN_LOOPS = {
    "viscous@12:Fv=0.3": lambda q, v: 0.3 * v,
    "offset@12:Off=-0.2": lambda q, v: -0.2 + 0 * v,
    "coulomb@12:Fs=0.5": lambda q, v: 0.5 * np.tanh(v / 4e-3),
    "asymmetric_viscous@12:coefficient=0.1": lambda q, v: 0.1 * np.hypot(v, 4e-3) - 4e-4,
    "spring@12:stiffness=2,rest=0.5": lambda q, v: 2 * (q - 0.5),
}


@pytest.mark.rotating("long tests of simulate")
def test_effects_on_motors_of_robots_with_loops(five_bar):
    """All at once, of which each is larger than the bound by far."""
    source, before = five_bar
    hidden = tuple(map(simulation.parse_hidden_effect, LAWS_IN_LOOPS))
    log = simulation.simulate(source, dataclasses.replace(LOOPED, hidden=hidden))
    more = log.truth.tau - before.truth.tau
    q, v = log.truth.q[:, 1], log.truth.qd[:, 1]
    laws = sum(law(q, v) for law in LAWS_IN_LOOPS.values())
    np.testing.assert_allclose(more[:, 1], laws, atol=1e-9)
    assert np.abs(more[:, 0]).max() < 1e-9


@pytest.mark.rotating("long tests of simulate")
def test_sensors_and_loads_of_robots_with_loops(five_bar):
    source, before = five_bar
    late = simulation.simulate(source, settings_of("time_delay:delay=0.005", LOOPED))
    np.testing.assert_allclose(late.tau[1:], before.tau[:-1], atol=1e-9)
    platform = read_robot("orthoglide-2003")
    settings = dataclasses.replace(LOOPED, duration=0.3, rate=50.0)
    more = (
        simulation.simulate(platform, settings_of("payload:mass=2", settings)).truth.tau
        - simulation.simulate(platform, settings).truth.tau
    )
    # In the isotropic posture the platform moves along the axes of the motors, one to one.
    x = ca.SX.sym("x", len(platform.moving_joints))
    frames = compute_world_frames(platform, x)
    axes = ca.Function("axes", [x], [ca.horzcat(*(frames[f"1{i}"].axis for i in (1, 2, 3)))])
    axes = axes(np.zeros(len(platform.moving_joints))).full().T
    np.testing.assert_allclose(more[0], -2 * axes @ compute_gravity_vector(platform), atol=1e-6)
    assert np.abs(more[0]).max() == pytest.approx(2 * 9.81)


@with_cases(
    "source, texts, message",
    ("demo-arm", "rust", r"hidden effect rust: no such effect; expected one of rotor_inertia"),
    ("demo-arm", "stribeck@9", r"got joint 9; expected one of 1, 2, 3"),
    ("demo-arm", "coupled_friction@3", r"got joint 3; expected one of 1, 2"),
    ("demo-arm", "payload@3", r"payload: got joint 3; expected none"),
    ("demo-arm", "spring@1:k=3", r"got a value k; expected some of stiffness, rest"),
    ("demo-arm", "stribeck@1:speed=0", r"stribeck, speed: got 0; expected a number above 0"),
    ("demo-arm", "passive_friction", r"no place for it; expected a joint without motor"),
    ("five-bar", "elasticity", r"not simulated for robots with loops.*expected one of"),
    ("five-bar", "external_force", r"not simulated for robots with loops"),
    ("emps", "counterbalance", r"no place for it; expected a joint that turns"),
    ("wrist-coupled", "external_force", r"lies on every axis, where no force moves a joint"),
    ("demo-arm", "", r"got ''; expected EFFECT, EFFECT@JOINT"),
    ("demo-arm", "spring@", r"got 'spring@'"),
    ("demo-arm", "spring@1:", r"got 'spring@1:'"),
    ("demo-arm", "spring@1:stiffness", r"got 'stiffness'; expected each value once as name=v"),
    ("demo-arm", "spring@1:rest=1,rest=2", r"got 'rest=2'; expected each value once"),
    ("demo-arm", "spring@1:rest=far", r"rest: got 'far'; expected a number"),
    ("demo-arm", "spring@1:rest=inf", r"rest: got 'inf'; expected a number"),
    ("demo-arm", "presliding@1 temperature_friction@1", "both are its coulo"),
    ("demo-arm", "elasticity@2 backlash@2", "both are its transmission; hide them on differ"),
    ("demo-arm", "elasticity@2 elasticity@2:stiffness=100", "both are its transmission"),
    (SPINNER, "base_tilt", "base_tilt: the robot has no gravity"),
    (TWO_LINK, "elasticity", "elasticity: no place .* rotor_inertia in the robot"),
)
def test_effects_that_a_robot_cannot_have(source, texts, message):
    arm = robot(source) if "\n" in source else read_robot(source)
    with pytest.raises(ModelerError, match=message):
        hidden = tuple(simulation.parse_hidden_effect(text) for text in texts.split(" "))
        simulation.simulate(arm, dataclasses.replace(SHORT, hidden=hidden))


def test_bristles_too_short_for_any_step():
    limits = simulation.collect_motion_limits(ARM)
    _, plant = made("presliding@1:distance=1e-6")
    with pytest.raises(DataError, match=r"follows at .* 1/s at top speed; .* larger distance"):
        choose_steps_per_tick(plant, limits, 1e-3)


def test_the_command_and_its_files(tmp_path, capsys):
    out, lines, truth = (tmp_path / name for name in ("log.csv", "told.json", "truth.json"))
    argv = ["simulate", "two-link", "--duration", "2", "--rate", "200", "--out", str(out)]
    argv += ["--hide", "temperature_friction@2", "--hide", "spring@1:stiffness=3"]
    argv += ["--process-noise", "0.01", "--truth-out", str(truth), "--json", str(lines)]
    assert main(argv) == 0
    assert "hidden: spring on 1: stiffness = 3, rest" in capsys.readouterr().out
    hidden = json.loads(truth.read_text())["hidden_effects"]
    assert json.loads(lines.read_text())["hidden_effects"] == hidden
    effects = [(effect["effect"], effect["joint"]) for effect in hidden]
    assert effects == [("temperature_friction", "2"), ("spring", "1")]
    assert hidden[1]["values"]["stiffness"] == 3.0
    assert out.read_text().startswith("time,q1,q2,qc1,qc2,tau1,tau2,temperature2\n")
