"""The two-step fit: exact on exact logs, honest about its sigmas, plain where logs do not tell."""

import dataclasses

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.errors import DataError
from modeler.core.manifest import SignalSpec
from modeler.estimation.identify import identify
from modeler.estimation.two_step import (
    Directions,
    single_joint_motions,
    single_joint_moves,
    two_steps,
)
from modeler.estimation.two_step_result import identify_in_two_steps, inertia_rows
from modeler.observation.log import Log
from modeler.observation.observe import observe
from modeler.observation.settings import Processing
from modeler.robot.motors import joint_directions
from modeler.robot.read import read_robot
from modeler.robot.robot import Limits
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate
from modeler.simulation.trajectory import one_joint_reference, point_to_point_reference
from tests.modules import compiled, module
from tests.rotation import rotating

_AS_THEY_ARE = Processing(
    position_cutoff=0.0, parallel_cutoff=0.0, decimation=1, derivatives="log", edge=0.0,
    keep_contradicted=True, keep_damaged=True,
)  # fmt: skip
_LIMITS = (Limits(-1.4, 1.4, 4.0, 25.0),) * 3
_SEEDS = 10
_ROBOT = "wrist-coupled"


def _directions(name: str) -> Directions:
    return Directions(joint_directions(read_robot(name)))


def _beta(name: str) -> np.ndarray:
    """Base parameters of the made-up wrist."""
    nominal = read_robot("wrist-coupled").parameters
    names = [p.name for p in module(name).emitted.spec.standard]
    return compiled(name).base_parameters(np.array([nominal.get(p, 0.0) for p in names]))


def _log(name: str, duration=110.0, noise=0.0, seed=0, only=None, motion=None) -> Log:
    """Exact motion of the wrist, one joint at a time, with white noise on its logged torques."""
    ways = _directions(name).rows[slice(None) if only is None else only]
    make = motion or one_joint_reference
    further = (ways,) if motion is None else ()
    reference = make(_LIMITS, duration, 50.0, 5, *further)
    q, qd, qdd = reference.q, reference.qd, reference.qdd
    tau = compiled(name).inverse_dynamics(q, qd, qdd, _beta(name))
    white = np.random.default_rng(seed).normal(size=tau.shape)
    tau = tau + noise * np.sqrt(np.mean(tau**2, axis=0)) * white
    joints = tuple(joint.name for joint in module(name).emitted.spec.joints)
    return Log("one.csv", joints, reference.time, q, tau, qd=qd, qdd=qdd)


def _observed(name: str, *logs: Log):
    return observe(compiled(name), list(logs), _AS_THEY_ARE)


@pytest.fixture(scope="module")
def exact():
    observation = _observed(_ROBOT, _log(_ROBOT))
    return identify_in_two_steps(compiled(_ROBOT), observation, _directions(_ROBOT))


@pytest.mark.digits
def test_it_is_exact_without_noise(exact):
    assert exact.result.status == "ok"
    assert np.abs(exact.result.beta - _beta(_ROBOT)).max() < 1e-10


def test_step_one_finds_the_inertia_gravity_and_friction_of_the_paper(exact):
    """J11 and g1 by Hanssen's closed form, Coulomb friction sum |G_j1| C_j (virtual work)."""
    p = dict(zip(exact.steps.data.names, _beta(_ROBOT), strict=True))
    for c in exact.steps.configurations:
        if c.joint != 0:
            continue
        _, q2, q3 = c.pose
        s2, c2, s3, c3 = np.sin(q2), np.cos(q2), np.sin(q3), np.cos(q3)
        PJ1, PJ2, PJ3 = -p["XX3R"], -2 * p["XY3"], p["XX2R"] + p["XX3R"] - p["ZZ3"]
        PJ4 = -2 * p["YZ3"] + 2 * 0.1 * p["MY3"]
        PJ5, PJ6 = 2 * p["XZ3"] - 2 * 0.1 * p["MX3"], 2 * p["XY2"]
        J11 = PJ1 * s3**2 * s2**2 + PJ2 * s3 * c3 * s2**2 + PJ3 * s2**2 + PJ4 * s2 * c2 * s3
        J11 += PJ5 * c2 * s2 * c3 + PJ6 * c2 * s2 + p["ZZ1R"] + p["ZZ3"]
        J11 += 0.4**2 * p["Iam2"] + 0.2**2 * p["Iam3"]  # G21, G31; Jm1 is in ZZ1R
        found = dict(zip(c.felt[0].along.names, c.felt[0].theta, strict=True))
        assert set(found) == {"qdd", "sin", "cos", "sign qd", "qd"}
        assert found["qdd"] == pytest.approx(J11, rel=1e-9)
        assert found["sign qd"] == pytest.approx(3.0 + 0.4 * 2.0 + 0.2 * 1.2, rel=1e-9)
        assert found["qd"] == pytest.approx(4.0 + 0.4**2 * 2.5 + 0.2**2 * 1.2, rel=1e-9)
        g1_sin = p["MY2R"] * s2 + p["MY3"] * c2 * s3 - p["MX3"] * c2 * c3 - p["MX2"] * c2 - p["MX1"]
        assert found["sin"] == pytest.approx(9.81 * g1_sin, rel=1e-9)


@pytest.mark.rotating("long tests of fit")
def test_the_sigmas_of_both_fits_are_those_of_many_runs():
    """Monte Carlo with the truth: rms z about 1, and 95 % of |z| below 1.96."""
    model, ways, truth = (compiled(_ROBOT), _directions(_ROBOT), _beta(_ROBOT))
    z = np.empty((2, _SEEDS, len(truth)))
    for seed in range(_SEEDS):
        observation = _observed(_ROBOT, _log(_ROBOT, 70.0, 0.02, seed))
        estimate = two_steps(model, observation, ways).estimate
        z[0, seed] = (estimate.beta - truth) / np.sqrt(np.diag(estimate.covariance))
        one = identify(observation)
        z[1, seed] = (one.beta - truth) / np.sqrt(np.diag(one.covariance))
    for which in z:
        assert 0.85 < np.sqrt(np.mean(which**2)) < 1.15
        assert 0.91 < np.mean(np.abs(which) < 1.96) < 0.99


def test_moves_of_the_first_joint_tell_16_of_17():
    """Joint-1-only moves leave ZZ2R, the constant of J22 (PJ19); moves of joint 2 add it."""
    model, ways = compiled("wrist"), _directions("wrist")
    first = _observed("wrist", _log("wrist", only=[0]))
    estimate = two_steps(model, first, ways).estimate
    assert [tangle.name for tangle in estimate.rank.aside] == ["ZZ2R"]
    both = _observed(
        "wrist",
        _log("wrist", only=[0]),
        dataclasses.replace(_log("wrist", only=[1]), name="second.csv"),
    )
    estimate = two_steps(model, both, ways).estimate
    assert not estimate.rank.aside
    assert np.abs(estimate.beta - _beta("wrist")).max() < 1e-10


def test_the_inertias_have_the_rank_of_the_papers_functions(exact):
    """J11 is of 7 functions of (q2, q3), J22 of 3, J33 of 1; here with rotors, which are constant.

    The singular values of Phi in the paper's functions and in base parameters count alike.
    """
    assert [e.possible_rank for e in exact.excitation] == [7, 3, 1]
    q = np.random.default_rng(4).uniform(-np.pi, np.pi, (8, 3))
    s2, c2, s3, c3 = np.sin(q[:, 1]), np.cos(q[:, 1]), np.sin(q[:, 2]), np.cos(q[:, 2])
    paper = np.column_stack([
        s3**2 * s2**2, s3 * c3 * s2**2, s2**2, s2 * c2 * s3, c2 * s2 * c3, c2 * s2, np.ones(8),
    ])  # fmt: skip
    model, ways = compiled("wrist"), _directions("wrist")
    for count in range(1, 9):
        rows = inertia_rows(model, q[:count], ways.rows[0])
        assert np.linalg.matrix_rank(rows, 1e-8) == np.linalg.matrix_rank(paper[:count], 1e-8)


def test_too_few_configurations_are_not_persistently_exciting():
    observation = _observed(_ROBOT, _log(_ROBOT, 40.0))
    found = identify_in_two_steps(compiled(_ROBOT), observation, _directions(_ROBOT))
    assert found.excitation[0].rank < found.excitation[0].possible_rank
    assert any("not persistently exciting; move it at" in s for s in found.result.sentences)


def test_pieces_of_several_joints_are_left_out(exact):
    log = _log(_ROBOT)
    observation = _observed(_ROBOT, log)
    moves, several, total = single_joint_moves(observation, _directions(_ROBOT))
    speeds = np.abs(log.qd @ np.linalg.inv(_directions(_ROBOT).rows))
    for move in moves:
        others = np.delete(speeds[move.window], move.joint, axis=1)
        assert others.max() < 0.03 * speeds.max()
    assert 0.0 < several < 0.4 * total
    assert exact.steps.several == several


@pytest.mark.digits
@pytest.mark.parametrize("name", ["emps", *rotating("scara")])
def test_joints_that_feel_nothing_of_each_other(name):
    """A slider beside a turning column, a single joint: fewer functions, honest sigmas."""
    model, spec = compiled(name), module(name).emitted.spec
    reference = one_joint_reference(_LIMITS[:1] * len(spec.joints), 100.0, 50.0, 1)
    beta = np.random.default_rng(1).uniform(0.5, 2.0, len(spec.base))
    tau = model.inverse_dynamics(reference.q, reference.qd, reference.qdd, beta)
    tau += 0.1 * np.random.default_rng(2).normal(size=tau.shape)
    joints = tuple(joint.name for joint in spec.joints)
    log = Log("one.csv", joints, reference.time, reference.q, tau, reference.qd, reference.qdd)
    estimate = two_steps(model, _observed(name, log), _directions(name)).estimate
    assert not estimate.rank.aside
    z = (estimate.beta - beta) / np.sqrt(np.diag(estimate.covariance))
    assert 0.2 < np.sqrt(np.mean(z**2)) < 2.0


def test_links_that_turn_in_a_parallelogram_of_changing_inertia_are_left_out():
    robot = read_robot("orthoglide-2003")
    model, ways = compiled("orthoglide-2003"), _directions("orthoglide-2003")
    settings = SimulationSettings(motion="one-joint", duration=10.0, rate=100.0)
    run = simulate(robot, settings)
    log = Log("one.csv", run.joints, run.time, run.q, run.tau)
    with pytest.raises(DataError, match="other functions than those of one body that turns"):
        two_steps(model, observe(model, [log]), ways)


def test_logs_without_such_a_piece_are_refused():
    log = _log("wrist", 20.0, motion=point_to_point_reference)
    with pytest.raises(DataError, match=r"^one.csv: no piece in which one joint moves") as error:
        two_steps(compiled("wrist"), _observed("wrist", log), _directions("wrist"))
    assert "use --method weighted" in str(error.value) and "\n" not in str(error.value)


def test_effects_that_read_more_than_the_motion_are_refused():
    model = compiled("wrist")
    warm = dataclasses.replace(model.spec, signals=(SignalSpec("time", "", "s", 0.0),))
    warm_model = CompiledModel(warm, model._library)
    with pytest.raises(DataError, match="some effect of the robot reads time"):
        single_joint_motions(warm_model, np.zeros(3), 0.0, np.eye(3)[0], (-1.0, 1.0), np.eye(3))


def test_a_joint_without_a_motor_says_nothing():
    """Its pieces are left out, and where there are no others, that is told."""
    log = _log("wrist", only=[0])
    observation = _observed("wrist", log)
    idle = tuple(dataclasses.replace(joint, actuated=False) for joint in observation.joints)
    with pytest.raises(DataError, match="left out: the joint has no motor"):
        two_steps(
            compiled("wrist"), dataclasses.replace(observation, joints=idle), _directions("wrist")
        )


def test_missing_torques_are_left_out():
    """Rows without a measurement do not count; the fit stays exact."""
    log = _log(_ROBOT)
    tau = log.tau.copy()
    tau[1000:1100, 1] = np.nan
    observation = _observed(_ROBOT, dataclasses.replace(log, tau=tau))
    steps = two_steps(compiled(_ROBOT), observation, _directions(_ROBOT))
    assert np.abs(steps.estimate.beta - _beta(_ROBOT)).max() < 1e-9


def test_logs_of_joints_are_told_from_logs_of_motors(tmp_path, capsys):
    log = _log("wrist", 20.0)
    path = tmp_path / "joints.csv"
    names = ["time", *(f"q{j}" for j in log.joints), *(f"tau{j}" for j in log.joints)]
    np.savetxt(path, np.column_stack([log.time, log.q, log.tau]), delimiter=",",
               header=",".join(names), comments="")  # fmt: skip
    out = str(tmp_path / "x.json")
    assert main(["fit", "wrist-coupled", str(path), "--method", "two-step", "--out", out]) == 1
    assert "no column qm1" in capsys.readouterr().err


def test_loads_are_not_known_to_it(tmp_path, capsys):
    words = "fit wrist-coupled a.csv --payload-log b.csv --method two-step --out"
    assert main([*words.split(), str(tmp_path / "x.json")]) == 1
    assert "--payload-log: got it with --method two-step" in capsys.readouterr().err


SLIDE = """name = "pr"
gravity = [0, 0, "-g"]
[symbols]
g = 9.81
[mdh]
columns = ["j", "sigma", "alpha", "d", "theta", "r"]
rows = [["z", 1, 0, 0, 0, "qz"], ["e", 0, "pi/2", 0.2, "qe", 0]]
[effects]
viscous = "all"
coulomb = "all"
[limits]
z = [-0.2, 0.3, 1, 6]
e = [-2, 2, 3, 15]
"""


@pytest.mark.rotating("long tests of fit")
def test_a_joint_that_never_moves_alone_is_named(tmp_path, capsys):
    """12 s reach the slide only: that, and no unit or sign, is why the elbow is not described."""
    robot, log = tmp_path / "pr.toml", tmp_path / "a.parquet"
    robot.write_text(SLIDE)
    words = f"simulate {robot} --motion one-joint --duration 12 --seed 1 --out {log}"
    assert main(words.split()) == 0
    words = f"fit {robot} {log} --method two-step --out {tmp_path / 'm.json'}"
    assert main(words.split()) == 0
    out = capsys.readouterr().out
    assert "Not valid: joint e never moved alone for long enough" in out
    assert "check units, signs and columns" not in out
    assert main(words.replace("two-step", "weighted").split()) == 0
