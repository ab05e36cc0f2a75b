"""The two-step fit: exact on exact logs, honest about its sigmas, plain where logs do not show."""

import dataclasses

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.errors import DataError
from modeler.estimation import two_step
from modeler.estimation.identify import identify
from modeler.estimation.single_joint import JointDirections
from modeler.estimation.verdict import judge_fit
from modeler.regression import Log, Processing, observe
from modeler.robot import Limits, compute_joint_directions, read_robot
from modeler.simulation import SimulationSettings, simulate
from modeler.simulation.trajectory import build_one_joint_reference, build_point_to_point_reference
from tests.modules import compiled, module
from tests.rotation import rotating

_AS_THEY_ARE = Processing(
    position_cutoff=0.0,
    parallel_cutoff=0.0,
    decimation=1,
    derivatives="log",
    edge=0.0,
    keep_contradicted=True,
    keep_damaged=True,
)
_LIMITS = (Limits(-1.4, 1.4, 4.0, 25.0),) * 3
_SEEDS = 10
_ROBOT = "wrist-coupled"


def _directions(name: str) -> JointDirections:
    return JointDirections(compute_joint_directions(read_robot(name)))


def _beta(name: str) -> np.ndarray:
    """Base parameters of the made-up wrist."""
    nominal = read_robot("wrist-coupled").parameters
    names = [p.name for p in module(name).emitted.spec.standard]
    return compiled(name).base_parameters(np.array([nominal.get(p, 0.0) for p in names]))


def _log(name: str, duration=110.0, noise=0.0, seed=0, only=None, motion=None) -> Log:
    """Exact motion of the wrist, one joint at a time, with white noise on its logged torques."""
    ways = _directions(name).rows[slice(None) if only is None else only]
    make = motion or build_one_joint_reference
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
    """Of exact logs, some of whose torques are missing."""
    log = _log(_ROBOT)
    log.tau[1000:1100, 1] = np.nan
    observation = _observed(_ROBOT, log)
    return two_step.identify_in_two_steps(compiled(_ROBOT), observation, _directions(_ROBOT))


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
        first = c.first_steps[0]
        found = dict(zip(first.along.names, np.linalg.solve(first.R, first.projected), strict=True))
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
        estimate = two_step.estimate_two_steps(model, observation, ways).estimate
        z[0, seed] = (estimate.beta - truth) / np.sqrt(np.diag(estimate.covariance))
        one = identify(observation)
        z[1, seed] = (one.beta - truth) / np.sqrt(np.diag(one.covariance))
    for which in z:
        assert 0.85 < np.sqrt(np.mean(which**2)) < 1.15
        assert 0.91 < np.mean(np.abs(which) < 1.96) < 0.99


def test_moves_of_the_first_joint_tell_16_of_17():
    """Joint-1-only moves leave ZZ2R, the constant of J22 (PJ19); moves of joint 2 add it."""
    model, ways = compiled("wrist"), _directions("wrist")
    first = _log("wrist", only=[0])
    estimate = two_step.estimate_two_steps(model, _observed("wrist", first), ways).estimate
    assert [tangle.name for tangle in estimate.rank.dropped_columns] == ["ZZ2R"]
    second = dataclasses.replace(_log("wrist", only=[1]), name="second.csv")
    estimate = two_step.estimate_two_steps(model, _observed("wrist", first, second), ways).estimate
    assert not estimate.rank.dropped_columns
    assert np.abs(estimate.beta - _beta("wrist")).max() < 1e-10


def test_the_inertias_have_the_rank_of_the_papers_functions(exact):
    """J11 is of 7 functions of (q2, q3), J22 of 3, J33 of 1; here with rotors, which are constant.

    The singular values of Phi in the paper's functions and in base parameters count alike.
    """
    assert [e.max_rank for e in exact.excitation] == [7, 3, 1]
    q = np.random.default_rng(4).uniform(-np.pi, np.pi, (8, 3))
    s2, c2, s3, c3 = np.sin(q[:, 1]), np.cos(q[:, 1]), np.sin(q[:, 2]), np.cos(q[:, 2])
    paper = np.column_stack(
        [s3**2 * s2**2, s3 * c3 * s2**2, s2**2, s2 * c2 * s3, c2 * s2 * c3, c2 * s2, np.ones(8)]
    )
    model, ways = compiled("wrist"), _directions("wrist")
    for count in range(1, 9):
        rows = two_step.build_inertia_rows(model, q[:count], ways.rows[0])
        assert np.linalg.matrix_rank(rows, 1e-8) == np.linalg.matrix_rank(paper[:count], 1e-8)


@pytest.mark.digits
@pytest.mark.parametrize("name", ["emps", *rotating("scara")])
def test_joints_that_feel_nothing_of_each_other(name):
    """A slider beside a turning column, a single joint: fewer functions, honest sigmas."""
    model, spec = compiled(name), module(name).emitted.spec
    reference = build_one_joint_reference(_LIMITS[:1] * len(spec.joints), 100.0, 50.0, 1)
    beta = np.random.default_rng(1).uniform(0.5, 2.0, len(spec.base))
    tau = model.inverse_dynamics(reference.q, reference.qd, reference.qdd, beta)
    tau += 0.1 * np.random.default_rng(2).normal(size=tau.shape)
    joints = tuple(joint.name for joint in spec.joints)
    log = Log("one.csv", joints, reference.time, reference.q, tau, reference.qd, reference.qdd)
    estimate = two_step.estimate_two_steps(model, _observed(name, log), _directions(name)).estimate
    assert not estimate.rank.dropped_columns
    z = (estimate.beta - beta) / np.sqrt(np.diag(estimate.covariance))
    assert 0.2 < np.sqrt(np.mean(z**2)) < 2.0


def test_links_that_turn_in_a_parallelogram_of_changing_inertia_are_left_out():
    model = compiled("five-bar")
    settings = SimulationSettings(motion="one-joint", duration=10.0, rate=100.0)
    run = simulate(read_robot("five-bar"), settings)
    log = Log("one.csv", run.joints, run.time, run.q, run.tau)
    with pytest.raises(DataError, match="other functions than those of one body that turns"):
        two_step.estimate_two_steps(model, observe(model, [log]), _directions("five-bar"))


def test_logs_without_such_a_piece_are_refused(tmp_path, capsys):
    log = _log("wrist", 20.0, motion=build_point_to_point_reference)
    with pytest.raises(DataError, match=r"^one.csv: no piece in which one joint moves") as error:
        two_step.estimate_two_steps(
            compiled("wrist"), _observed("wrist", log), _directions("wrist")
        )
    assert "use --method weighted" in str(error.value) and "\n" not in str(error.value)
    path = tmp_path / "joints.csv"  # of joints, not of motors
    names = ["time", *(f"q{j}" for j in log.joints), *(f"tau{j}" for j in log.joints)]
    rows = np.column_stack([log.time, log.q, log.tau])
    np.savetxt(path, rows, delimiter=",", header=",".join(names), comments="")
    out = str(tmp_path / "x.json")
    assert main(["fit", "wrist-coupled", str(path), "--method", "two-step", "--out", out]) == 1
    assert "no column qm1" in capsys.readouterr().err


def test_a_joint_without_a_motor_says_nothing():
    """Its pieces are left out, and where there are no others, that is reported."""
    log = _log("wrist", only=[0])
    observation = _observed("wrist", log)
    idle = tuple(dataclasses.replace(joint, actuated=False) for joint in observation.joints)
    without = dataclasses.replace(observation, joints=idle)
    with pytest.raises(DataError, match="left out: the joint has no motor"):
        two_step.estimate_two_steps(compiled("wrist"), without, _directions("wrist"))


def test_too_few_configurations_and_joints_that_never_move_alone_are_named():
    """That, and no unit or sign, is why joint 1 is not described in the second log."""
    short, second = (_observed(_ROBOT, _log(_ROBOT, 40.0, only=only)) for only in (None, [1]))
    few = two_step.identify_in_two_steps(compiled(_ROBOT), short, _directions(_ROBOT))
    assert few.excitation[0].rank < few.excitation[0].max_rank
    assert any("not persistently exciting; move it at" in s for s in few.result.sentences)
    steps = two_step.identify_in_two_steps(compiled(_ROBOT), second, _directions(_ROBOT))
    told = steps.collect_warnings()
    line = judge_fit(compiled(_ROBOT), second, steps.result, log_warnings=told).verdict.line
    assert line.startswith("Valid for prediction on joints m2, m3; joint m1 undetermined: ")
    assert "joint 1, 3 never moved alone for long enough" in line
    assert "check units, signs and columns" not in line
