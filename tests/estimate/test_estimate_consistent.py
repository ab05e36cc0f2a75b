"""Machines that could be built: positive definite, as near to the rows as they can be."""

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.estimation import THRESHOLDS, physical_consistency
from modeler.estimation.physical_consistency import (
    define_physical_parameters,
    extract_parameters,
    solve_consistent,
)
from modeler.robot.read import read_robot
from modeler.simulation.parameters import draw_plant_parameters, merge_shared_names
from modeler.simulation.trajectory import collect_motion_limits
from tests.bodies import buildable
from tests.modules import plain


def cloud(rng, places=8):
    """Second moments of point masses by their definition, (4, 4)."""
    mass = rng.uniform(0.2, 2.0, places)
    points = np.column_stack([0.3 * rng.normal(size=(places, 3)), np.ones(places)])
    return points.T * mass @ points


def rows_of(name, rng, samples, noise, wide=np.pi):
    """Triangle of weighted rows along random states, and the true base parameters."""
    model = plain(name)
    chi = buildable(model.spec, rng)
    shape = (samples, len(model.spec.joints))
    q, qd, qdd = (rng.uniform(-1.0, 1.0, shape) for _ in range(3))
    W = model.base_regressor(wide * q, qd, qdd).reshape(-1, len(model.spec.base))
    beta = model.base_parameters(chi)
    sigma = noise * np.sqrt(np.mean((W @ beta) ** 2))
    y = W @ beta + sigma * rng.normal(size=len(W))
    return model, np.linalg.qr(np.column_stack([W, y]) / sigma, mode="r"), beta


def about_centre(body):
    """Mass, centre and inertia about it of second moments."""
    mass, centre = body[3, 3], body[:3, 3] / body[3, 3]
    about = body[:3, :3] - mass * np.outer(centre, centre)
    return mass, centre, np.trace(about) * np.eye(3) - about


@pytest.mark.parametrize("name", ["two-link", pytest.param("ur10e", marks=pytest.mark.rotating)])
def test_pinocchio_gives_the_same_torques(name):
    from tests.oracles.pinocchio_dynamics import pin, pinocchio_model

    rng = np.random.default_rng(2)
    model, whole, _ = rows_of(name, rng, 60, 0.2)
    fit = solve_consistent(define_physical_parameters(model.spec), whole, {})
    robot = read_robot(name)
    theirs, ids = pinocchio_model(robot)
    for joint, index in zip(robot.moving_joints, ids, strict=True):
        theirs.inertias[index] = pin.Inertia(*about_centre(fit.bodies[joint.name]))
        assert np.linalg.eigvalsh(theirs.inertias[index].inertia)[0] > 0.0
    data = theirs.createData()
    for _ in range(5):
        q, qd, qdd = rng.uniform(-1.0, 1.0, (3, 1, len(ids)))
        expected = pin.rnea(theirs, data, q[0], qd[0], qdd[0])
        chi = fit.chi[: len(model.spec.standard)].copy()
        chi[[p.effect != "rigid_body" for p in model.spec.standard]] = 0.0
        tau = model.inverse_dynamics(q, qd, qdd, model.base_parameters(chi))[0]
        np.testing.assert_allclose(tau, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


def test_mujoco_takes_the_bodies_and_gives_the_same_torques():
    mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: MuJoCo is not installed")
    from modeler.api import compile_model, derive, generate
    from modeler.robot.read import parse_robot_text
    from tests.diagnose.mujoco_arm import Arm, Body, mjcf, random_arm, robot_text

    arm = random_arm(3)
    model = compile_model(generate(derive(parse_robot_text(robot_text(arm, {}), "outside"))))
    rng = np.random.default_rng(4)
    q, qd, qdd = (rng.uniform(-1.0, 1.0, (50, 3)) for _ in range(3))
    W = model.base_regressor(q, qd, qdd).reshape(150, -1)
    y = W @ model.base_parameters(buildable(model.spec, rng))
    sigma = 0.2 * np.sqrt(np.mean(y**2))
    y = y + sigma * rng.normal(size=150)
    whole = np.linalg.qr(np.column_stack([W, y]) / sigma, mode="r")
    fit = solve_consistent(define_physical_parameters(model.spec), whole, {})
    bodies = [Body(*about_centre(body)) for body in fit.bodies.values()]
    none = np.zeros(3)
    theirs = mujoco.MjModel.from_xml_string(mjcf(Arm(arm.table, tuple(bodies), none, none, none)))
    theirs.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data = mujoco.MjData(theirs)
    for k in range(10):
        data.qpos, data.qvel, data.qacc = q[k], qd[k], qdd[k]
        mujoco.mj_inverse(theirs, data)
        expected = np.array(data.qfrc_inverse)
        tau = model.inverse_dynamics(*(x[k : k + 1] for x in (q, qd, qdd)), fit.beta)[0]
        np.testing.assert_allclose(tau, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.rotating("sigmas of consistent values")
def test_values_that_the_data_tell_keep_their_least_squares_and_sigma():
    errors = []
    for seed in range(6):
        model, whole, beta = rows_of("two-link", np.random.default_rng(seed), 200, 0.02)
        fit = solve_consistent(define_physical_parameters(model.spec), whole, {})
        assert fit.zero_parameters or fit.excess_squares < 0.1
        errors.append((fit.beta - beta) / np.sqrt(np.diag(fit.covariance)))
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(1.0, abs=0.2)


@pytest.mark.rotating("sigmas of consistent values")
def test_sigmas_of_links_at_the_bound_are_what_repetition_shows():
    """Thin links lie near it. There the curvature is endless, and its inverse 4 to 10 sigma off."""
    model, robot, z = plain("wrist"), read_robot("wrist"), []
    for seed in range(4):
        drawn, _ = merge_shared_names(
            robot, draw_plant_parameters(robot, collect_motion_limits(robot, {}), seed)
        )
        beta = model.base_parameters(np.array([drawn[p.name] for p in model.spec.standard]))
        rng = np.random.default_rng([seed, 5])
        q, qd, qdd = (rng.uniform(-1.0, 1.0, (300, 3)) for _ in range(3))
        W = model.base_regressor(3.0 * q, qd, qdd)
        tau = W @ beta
        sigma = 0.015 * np.sqrt(np.mean(tau**2, axis=0))
        rows = np.dstack([W, tau + sigma * rng.normal(size=tau.shape)]) / sigma[:, None]
        whole = np.linalg.qr(rows.reshape(900, -1), mode="r")
        fit = solve_consistent(define_physical_parameters(model.spec), whole, {})
        assert fit.bounded_links
        z.append((fit.beta - beta) / np.sqrt(np.diag(fit.covariance)))
    assert np.abs(z).max() < 4.0 and 0.6 < np.sqrt(np.mean(np.square(z))) < 1.1


def test_no_machine_nearby_is_better():
    model, whole, _ = rows_of("two-link", np.random.default_rng(5), 30, 0.5, wide=0.3)
    machine = define_physical_parameters(model.spec)
    reference = {name: cloud(np.random.default_rng(6)) for name in machine.links}
    fit = solve_consistent(machine, whole, reference)

    def cost(bodies, others):
        chi = others.copy()
        for name, item in machine.links.items():
            chi[item] = extract_parameters(bodies[name])
        error = whole[:, :-1] @ machine.K @ chi - whole[:, -1]
        total = 0.5 * error @ error
        for name, P in bodies.items():
            ratio = np.linalg.solve(reference[name], P)
            total += THRESHOLDS.known_reference_weight * (
                np.trace(ratio) - np.linalg.slogdet(ratio)[1] - 4.0
            )
        return total

    least, rng = cost(fit.bodies, fit.chi), np.random.default_rng(7)
    for step in (1e-3, 1e-2, 0.1):
        for _ in range(20):
            others = fit.chi.copy()
            for place in machine.positive.values():
                others[place] = max(0.0, others[place] + step * rng.normal())
            bodies = {}
            for name, P in fit.bodies.items():
                root = np.linalg.cholesky(P)
                turn = np.eye(4) + step * rng.normal(size=(4, 4))
                bodies[name] = root @ turn @ turn.T @ root.T
            assert cost(bodies, others) > least - 1e-9 * abs(least)


def test_a_solver_that_fails_is_one_line(monkeypatch):
    monkeypatch.setattr(physical_consistency, "minimize_over_cones", lambda *args, **more: None)
    model, whole, _ = rows_of("two-link", np.random.default_rng(8), 50, 0.02)
    with pytest.raises(DataError, match="no physically consistent parameters"):
        solve_consistent(define_physical_parameters(model.spec), whole, {})
