"""Elastic joints: torques, steps and feed-forward against mechanics written out by hand."""

import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from modeler.api import compare, derive, export, fleet, generate, load, simulate
from modeler.api.checks import prepare_models, simulate_positions
from modeler.api.motion import build_subject
from modeler.core.errors import DataError, RobotError, SolutionError
from modeler.core.options import CompareOptions
from modeler.robot import Robot
from modeler.robot.edit import replace_effects
from modeler.robot.read import parse_robot_text
from modeler.runtime.model import CompiledModel
from modeler.validation import FreeRunSettings
from tests.modules import loaded

PENDULUM = """
name = "pendulum"
gravity = [0, "-g", 0]
[symbols]
g = 9.81
[mdh]
columns = ["j", "theta"]
rows = [["1", "q1"]]
[effects]
rotor_inertia = ["1"]
viscous = ["1"]
offset = ["1"]
elasticity = [{joint = "1", K = 3000.0, D = 4.0}]
"""
VALUES = {"ZZ1": 1.1, "MX1": 2.0, "MY1": 0.3, "Ia1": 0.7, "Fv1": 3.0, "Off1": 0.5}
K, D, G = 3000.0, 4.0, 9.81


def compile_text(text: str) -> CompiledModel:
    return loaded(generate(derive(parse_robot_text(text, "elastic"))))


@pytest.fixture(scope="module")
def pendulum() -> CompiledModel:
    return compile_text(PENDULUM)


@pytest.fixture(scope="module")
def beta(pendulum: CompiledModel) -> np.ndarray:
    return pendulum.base_parameters([VALUES.get(p.name, 0.0) for p in pendulum.spec.standard])


def move_motor(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A motion with 1 and 4 Hz, and its derivatives; each (n, 1)."""
    parts = [(0.8, 2 * np.pi * 1.0, 0.3), (0.05, 2 * np.pi * 4.0, 1.1)]
    q = sum(a * np.sin(w * t + p) for a, w, p in parts)
    qd = sum(a * w * np.cos(w * t + p) for a, w, p in parts)
    qdd = sum(-a * w * w * np.sin(w * t + p) for a, w, p in parts)
    return q[:, None], qd[:, None], qdd[:, None]


def pull_link(e: float, rate: float, t: float) -> float:
    """e'' of the pendulum behind the motor: ZZ (qdd - e'') + gravity = K e + D e'."""
    q, _, qdd = (float(x[0, 0]) for x in move_motor(np.array([t])))
    gravity = G * (VALUES["MX1"] * np.cos(q - e) - VALUES["MY1"] * np.sin(q - e))
    return qdd - (K * e + D * rate - gravity) / VALUES["ZZ1"]


def integrate_link(t: np.ndarray, start: np.ndarray) -> np.ndarray:
    """(n, 3) e, e', e'' along the motor's motion."""

    def flow(at: float, x: np.ndarray) -> list[float]:
        return [x[1], pull_link(x[0], x[1], at)]

    path = solve_ivp(flow, (t[0], t[-1]), start, t_eval=t, rtol=1e-10, atol=1e-12).y
    acceleration = [pull_link(e, rate, at) for at, e, rate in zip(t, *path, strict=True)]
    return np.column_stack([*path, acceleration])


def test_torque_of_a_pendulum_is_that_of_two_bodies(pendulum, beta):
    """Motor: tau = Ia qdd + K e + D e' + Fv qd + Off, the link integrated by another method."""
    t = np.arange(4001) * 1e-3
    motion = move_motor(t)
    s = pendulum.compute_windup(*motion, 1e-3, beta)
    path = integrate_link(t, s[0, :2])
    torque = VALUES["Ia1"] * motion[2] + VALUES["Fv1"] * motion[1] + VALUES["Off1"]
    torque = torque[:, 0] + K * path[:, 0] + D * path[:, 1]
    exact = pendulum.inverse_dynamics(*motion, beta, path)[:, 0]
    np.testing.assert_allclose(exact, torque, rtol=0, atol=1e-8 * np.abs(torque).max())
    stepped = pendulum.inverse_dynamics(*motion, beta, s)[:, 0]
    rigid = pendulum.inverse_dynamics(*motion, beta, 0.0 * s)[:, 0]
    assert np.std(stepped - torque) < 0.01 * np.std(rigid - torque)


def test_steps_of_a_millisecond_and_of_four_follow_the_link(pendulum, beta):
    """Largest error of e: 1e-3 of its range at 1 ms, 1 % at 4 ms, for a joint of 8 Hz."""
    for step, share in ((1e-3, 1e-3), (4e-3, 1e-2)):
        t = np.arange(int(4.0 / step)) * step
        s = pendulum.compute_windup(*move_motor(t), step, beta)
        path = integrate_link(t, s[0, :2])
        assert np.abs(s[:, 0] - path[:, 0]).max() < share * np.ptp(path[:, 0])


def test_stiffness_and_damping_are_arguments(pendulum, beta):
    """Other values than those of the robot file need no other code."""
    t = np.arange(1000) * 1e-3
    motion = move_motor(t)
    soft = pendulum.compute_windup(*motion, 1e-3, beta, [1500.0, 2.0])
    other = compile_text(PENDULUM.replace("K = 3000.0, D = 4.0", "K = 1500.0, D = 2.0"))
    np.testing.assert_array_equal(soft, other.compute_windup(*motion, 1e-3, beta))
    assert pendulum.spec.code != "" and other.spec.elastic == (1500.0, 2.0)


def test_what_is_not_finite_has_a_status_and_a_reset_mends_it(pendulum, beta):
    q, qd, qdd = (x[0] for x in move_motor(np.zeros(1)))
    values = {"beta": beta, "elastic": [K, D]}
    motion = {"q": q, "qd": qd, "qdd": qdd}
    s = pendulum.evaluate("reset", **motion, **values)[0]
    bad = {"dt": [1e-3], "s": s, **motion, **values}
    assert pendulum.evaluate_status("advance", **bad | {"q": [np.nan]})[0] == 3
    assert pendulum.evaluate_status("advance", **bad | {"s": [np.inf, 0, 0]})[0] == 3
    assert pendulum.evaluate_status("advance", **bad)[0] == 0
    with pytest.raises(SolutionError, match="not finite"):
        pendulum.advance(None, 1e-3, s, [np.nan], qd, qdd, beta)
    after = pendulum.advance(None, 1e-3, s, q, qd, qdd, beta)
    assert np.isfinite(after).all() and after[0] == pytest.approx(s[0], abs=1e-4)
    broken = pendulum.compute_windup(*(np.tile(x, (5, 1)) for x in (q, qd, qdd)), np.nan, beta)
    assert np.isfinite(broken[0, 0]) and np.isnan(broken[2:]).all()


def test_at_rest_the_spring_carries_gravity(pendulum, beta):
    still, q = np.zeros(1), np.array([0.4])
    values = {"beta": beta, "elastic": [K, D]}
    e = pendulum.evaluate("reset", q=q, qd=still, qdd=still, **values)[0, 0]
    link = q[0] - e
    gravity = G * (VALUES["MX1"] * np.cos(link) - VALUES["MY1"] * np.sin(link))
    assert K * e == pytest.approx(gravity, rel=1e-4)


H = 1e-3  # s, of the control loop
SHAPE = np.polynomial.Polynomial([0, 0, 0, 0, 0, 126, -420, 540, -315, 70])  # smooth to the snap


def command(t: float) -> tuple[float, float, float]:
    """1.2 rad in .8 s: q, qd, qdd of the link."""
    x, time = min(t / 0.8, 1.0), 0.8
    return 1.2 * SHAPE(x), 1.2 * SHAPE.deriv()(x) / time, 1.2 * SHAPE.deriv(2)(x) / time**2


def move_two_masses(x: np.ndarray, tau: float) -> np.ndarray:
    """Rates of motor and link, (q, qd) each, written out by hand."""
    qm, vm, ql, vl = x
    pull = K * (qm - ql) + D * (vm - vl)
    gravity = G * (VALUES["MX1"] * np.cos(ql) - VALUES["MY1"] * np.sin(ql))
    motor = (tau - pull - VALUES["Fv1"] * vm - VALUES["Off1"]) / VALUES["Ia1"]
    return np.array([vm, motor, vl, (pull - gravity) / VALUES["ZZ1"]])


def follow_command(
    control: Callable[[np.ndarray, tuple[float, ...]], float], motor: float
) -> float:
    """Rms error of the link, rad, of a controller of the motor's q, qd and the command."""
    sag = G * VALUES["MX1"] / K
    x, errors = np.array([motor, 0.0, motor - sag, 0.0]), []
    for k in range(1200):
        tau = control(x[:2], command(k * H))
        for _ in range(10):
            rate = move_two_masses(x, tau)
            x = x + H / 10 * move_two_masses(x + H / 20 * rate, tau)
        errors.append(x[2] - command((k + 1) * H)[0])
    return float(np.sqrt(np.mean(np.square(errors))))


@pytest.fixture(scope="module")
def example(tmp_path_factory) -> Path:
    """The emitted example of a controller, compiled with all warnings."""
    folder = tmp_path_factory.mktemp("pendulum")
    values = "\n".join(f"{name} = {value}" for name, value in VALUES.items())
    robot = parse_robot_text(f"{PENDULUM}[parameters]\n{values}\n", "pendulum")
    generate(prepare_models([robot], CompareOptions())[0], folder)
    flags = "CFLAGS=-O2 -Wall -Wextra -Wpedantic -Werror"
    subprocess.run(["make", "-s", "check", "examples", flags], cwd=folder, check=True)
    return folder / "example_elastic"


@pytest.mark.parametrize("bandwidth", [2.0, 8.0])
def test_the_link_follows_ten_times_closer_with_the_example(pendulum, beta, example, bandwidth):
    """The emitted example against computed torque of the rigid joint in the same loop."""
    w, inertia = 2 * np.pi * bandwidth, VALUES["Ia1"] + VALUES["ZZ1"]

    def control_rigidly(state: np.ndarray, wanted: tuple[float, ...]) -> float:
        q, qd, qdd = wanted
        tau = pendulum.inverse_dynamics([[q]], [[qd]], [[qdd]], beta, [[0.0] * 3])[0, 0]
        return tau + inertia * (w * w * (q - state[0]) + 2 * w * (qd - state[1]))

    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True, "bufsize": 1}
    with subprocess.Popen([example, str(bandwidth)], **pipes) as program:

        def ask_program(state: np.ndarray, wanted: tuple[float, ...]) -> float:
            print(*state, *wanted, file=program.stdin)
            return float(program.stdout.readline())

        elastic = follow_command(ask_program, G * VALUES["MX1"] / K)
        program.stdin.close()
    assert elastic < 0.1 * follow_command(control_rigidly, 0.0)


def write_arm(joints: dict[str, tuple[float, float]]) -> Robot:
    """The demonstration arm, viscous friction alone, with these elastic joints."""
    effects: dict[str, object] = dict.fromkeys(("viscous", "rotor_inertia"), "all")
    if joints:
        rows = [{"joint": name, "K": k, "D": d} for name, (k, d) in joints.items()]
        effects["elasticity"] = rows
    text = replace_effects(load("demo-arm").text, effects)
    lines = [line for line in text.splitlines() if not line.startswith(("Fs", "Off"))]
    return parse_robot_text("\n".join(lines), "arm")


ARM = {"2": (3000.0, 4.0), "3": (800.0, 1.0)}


def test_torques_of_an_arm_are_those_of_mujoco():
    """MuJoCo has a second joint, less the windup, with stiffness and damping, in each body."""
    mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: no MuJoCo")
    robot = write_arm(ARM)
    model = mujoco.MjModel.from_xml_string(export(robot, to="mjcf").data.decode())
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    data = mujoco.MjData(model)
    motors = [model.joint(f"joint_{name}").dofadr[0] for name in "123"]
    behind = [model.joint(f"joint_{name}_windup").dofadr[0] for name in "23"]
    compiled = loaded(generate(derive(robot)))
    beta = compiled.base_parameters([p.nominal for p in compiled.spec.standard])
    nominal = {p.name: p.nominal for p in compiled.spec.standard}
    rotors, springs = np.array([nominal[f"Ia{j}"] for j in "123"]), np.array(list(ARM.values())).T
    rng = np.random.default_rng(1)
    for _ in range(5):
        motion, s = rng.normal(size=(3, 3)), rng.normal(size=6)
        for k, array in enumerate((data.qpos, data.qvel, data.qacc)):
            array[motors], array[behind] = motion[k], -s[[k, 3 + k]]
        mujoco.mj_inverse(model, data)
        tau = compiled.inverse_dynamics(*motion[:, None], beta, s[None])[0]
        np.testing.assert_allclose(
            data.qfrc_inverse[motors], tau, rtol=0, atol=1e-9 * abs(tau).max()
        )
        links = tau - compiled.friction(motion[None, 1], beta)[0] - rotors * motion[2]
        pull = springs[0] * s[[0, 3]] + springs[1] * s[[1, 4]]
        left = data.qfrc_inverse[behind] + pull
        np.testing.assert_allclose(left, links[1:], rtol=0, atol=1e-9 * abs(tau).max())


def test_base_and_standard_torques_of_elastic_joints_agree():
    derivation = derive(write_arm(ARM))
    assert derivation.base.proof.kind == "exact"
    assert derivation.base.proof.agreement < 1e-12
    names = [parameter.name for parameter in derivation.base.parameters]
    assert {"Ia2", "Ia3"} <= set(names)
    rigid = [parameter.name for parameter in derive(write_arm({})).base.parameters]
    assert set(names) == {*rigid, "Ia2"}


def test_other_stiffnesses_are_set_in_the_order_of_the_table():
    arm = write_arm(ARM).set_windups([1.0, 2.0, 3.0, 4.0])
    assert (arm.find_windup("2"), arm.find_windup("3")) == ((1.0, 3.0), (2.0, 4.0))
    assert arm.find_windup("1") is None and derive(arm).model.windups.keys() == {1, 2}


@pytest.mark.slow
def test_a_prismatic_joint_is_elastic_too():
    text = PENDULUM.replace('"theta"', '"sigma", "theta", "r"').replace('"q1"', '1, 0, "q1"')
    compiled = compile_text(text.replace('[0, "-g", 0]', '[0, 0, "-g"]'))
    assert [s.unit for s in compiled.spec.signals] == ["m", "m/s", "m/s2"]


def test_a_log_of_two_masses_is_predicted_to_the_noise(tmp_path):
    """The simulator has motor and link as two bodies; its noise is .1 % of the torque."""
    robot = write_arm({"2": (6000.0, 8.0)})
    rigid = write_arm({})
    log = tmp_path / "log.parquet"
    simulate(robot, log, duration=8.0, seed=2)
    errors = [compare(each, [log]).joints[1].relative_error for each in (robot, rigid)]
    assert errors[0] < 0.002 and errors[1] > 3.0 * errors[0]


def test_a_free_run_keeps_motor_and_link_apart(tmp_path):
    """Under the logged torques the arm stays five times closer to the log than a rigid one."""
    log = tmp_path / "log.parquet"
    simulate(write_arm({"2": (3000.0, 4.0)}), log, duration=2.5, seed=2)
    errors = []
    for elastic in (True, False):
        robot = write_arm({"2": (3000.0, 4.0)} if elastic else {})
        settings = FreeRunSettings(window=0.2)
        run = simulate_positions(robot, [log], CompareOptions(), settings)[0]
        apart = np.concatenate([path.simulated - path.measured for path in run.paths])
        errors.append(np.sqrt(np.mean(apart[:, 1] ** 2)))
        assert run.numerical < 1e-4
    assert errors[0] < errors[1] / 5.0


def test_what_goes_out_of_a_model_has_the_fitted_stiffness(tmp_path):
    values = "\n".join(f"{name} = {value}" for name, value in VALUES.items())
    robot = parse_robot_text(f"{PENDULUM}[parameters]\n{values}\n", "pendulum")
    (model,) = prepare_models([robot], CompareOptions())
    sizes = [("K1", "N m/rad", 2000.0), ("D1", "N m s/rad", 3.0)]
    fitted = [replace(model.fit.parameters[0], name=n, unit=u, value=x) for n, u, x in sizes]
    model = replace(model, fit=replace(model.fit, elastic=tuple(fitted)))
    generate(model, tmp_path)
    assert "stiffness 2000, damping 3." in (tmp_path / "pendulum_fitted.h").read_text()
    c = (tmp_path / "pendulum_fitted.c").read_text()
    assert "2000.0" in c and "3000.0" not in c
    assert b'stiffness="2000" damping="3"' in export(model, to="mjcf").data


def test_motions_are_designed_for_rigid_joints_and_fleets_refuse_elastic_ones():
    robot = parse_robot_text(PENDULUM, "pendulum")
    assert build_subject(robot).compiled.spec.windups == ()
    with pytest.raises(DataError, match="a joint is elastic, which a fleet is not fitted with"):
        fleet(robot, {"one": {"mon": {}, "tue": {}}})


REFUSED = {
    'elasticity = "all"': "got .all.; expected its shapes, as in elasticity",
    'elasticity = [{joint = "1", K = 0, D = 1}]': "K: got 0",
    'elasticity = [{joint = "1", f = 8}]': "got the shapes f; expected elasticity = ",
    'elasticity = [{joint = "1", K = 1, D = 1}, {joint = "1", K = 2, D = 1}]': "stands there twice",
}


@pytest.mark.parametrize("line", REFUSED)
def test_what_is_no_elastic_joint_is_refused(line):
    text = PENDULUM.replace('elasticity = [{joint = "1", K = 3000.0, D = 4.0}]', line)
    with pytest.raises(RobotError, match=REFUSED[line]):
        parse_robot_text(text, "pendulum")


def test_joints_of_loops_and_of_motors_that_turn_several_are_refused():
    effects = {"rotor_inertia": ["11"], "elasticity": [{"joint": "11", "K": 9.0, "D": 1.0}]}
    with pytest.raises(RobotError, match='"11" cannot be elastic in a robot with loops'):
        parse_robot_text(replace_effects(load("five-bar").text, effects), "five-bar")
    coupled = write_arm(ARM).text + '\n[coupling]\n3 = "q2 + q3"\n'
    with pytest.raises(RobotError, match='"2" turns with other joints'):
        parse_robot_text(coupled, "arm")


def test_an_elastic_joint_needs_its_motors_inertia():
    with pytest.raises(RobotError, match='joint "1" has no inertia of its motor; add "1" to rotor'):
        parse_robot_text(PENDULUM.replace('rotor_inertia = ["1"]\n', ""), "pendulum")
