"""Elastic joints in a fit: slopes against differences, values against the windup of the C."""

import dataclasses

import numpy as np
import pytest

from modeler.estimation.windup import Motion, WindupProblem, read_windup
from tests.effects.test_elastic_joints import compile_text

ARM = """
name = "two-elastic"
gravity = [0, "-g", 0]
[symbols]
g = 9.81
l = 0.5
[mdh]
columns = ["j", "d", "theta"]
rows = [["1", 0, "q1"], ["2", "l", "q2"]]
[effects]
rotor_inertia = "all"
viscous = "all"
elasticity = [{joint = "1", K = 4000.0, D = 9.0}, {joint = "2", K = 900.0, D = 2.0}]
"""
CHI = {"ZZ1": 0.5, "MX1": 1.5, "Ia1": 0.6, "Fv1": 3.0, "ZZ2": 0.3, "MX2": 0.9, "MY2": 0.1}
SETTLED = 1000  # samples after which the start, where the two differ, has faded
CHI |= {"Ia2": 0.2, "Fv2": 1.0, "M2": 2.0}


def swing(joints: int, step: float, seconds: float) -> Motion:
    """Sines up to 9 Hz on every joint, from rest."""
    rng, t = np.random.default_rng(5), np.arange(round(seconds / step)) * step
    q = np.zeros((len(t), joints))
    for j in range(joints):
        for f in (0.4, 0.9, 2.1, 4.3, 6.7, 9.1):
            phase = 2 * np.pi * (f + 0.17 * j) * t + rng.uniform(0, 6.28)
            q[:, j] += 0.3 / f**1.5 * np.sin(phase)
    q *= 1.0 - np.exp(-((t / 0.4) ** 4))[:, None]
    qd = np.gradient(q, step, axis=0)
    return Motion(q, qd, np.gradient(qd, step, axis=0), step)


@pytest.fixture(scope="module")
def arm():
    model = compile_text(ARM)
    return model, model.base_parameters([CHI.get(p.name, 0.0) for p in model.spec.standard])


def as_problem(model, beta, motion, noise=0.0):
    """The rows are the samples; torques of the model itself with its own C."""
    s = model.compute_windup(motion.q, motion.qd, motion.qdd, motion.step, beta)
    tau = model.inverse_dynamics(motion.q, motion.qd, motion.qdd, beta, s)
    tau = tau + noise * np.random.default_rng(1).normal(size=tau.shape)
    seen, joints = dataclasses.replace(motion, signals=np.zeros_like(s)), tau.shape[1]
    known = np.zeros((0, len(beta) + 1))
    return WindupProblem(
        [seen],
        lambda values: [values[0][:, j] for j in range(joints)],
        list(tau.T),
        [np.arange(len(tau)) // 100] * joints,
        np.arange(len(beta)),
        [np.zeros((len(tau), 0))] * joints,
        known,
    )


def test_the_windup_is_that_of_the_c(arm):
    """Newmark of fourth order over all steps at once, and the second order of the C."""
    model, beta = arm
    motion, windup = swing(2, 2.5e-4, 2.0), read_windup(model, beta)
    seen = dataclasses.replace(motion, signals=np.zeros((len(motion.q), 6)))
    s = windup.integrate(seen)[0].transpose(0, 2, 1).reshape(-1, 6)
    stepped = model.compute_windup(motion.q, motion.qd, motion.qdd, 2.5e-4, beta)
    for k in range(6):
        assert np.std(s[:, k] - stepped[:, k]) < 6e-3 * np.std(s[:, k])


def test_slopes_are_those_of_differences(arm):
    model, beta = arm
    problem, windup = as_problem(model, beta, swing(2, 1e-3, 2.0)), read_windup(model, 1.02 * beta)
    turn = problem.start_turn(windup)

    def torque(changed):
        return -problem.evaluate(changed, turn.states, np.zeros(0)).residual

    def compare(column, slope):
        apart = (column - slope).reshape(2, -1)[:, SETTLED:]
        assert np.abs(apart).max() < 2e-3 * np.abs(slope).max()

    h = 1e-4
    for i in range(len(beta)):
        by = h * max(1.0, abs(beta[i])) * np.eye(len(beta))[i]
        ends = [torque(dataclasses.replace(windup, beta=windup.beta + x)) for x in (by, -by)]
        slope = (ends[0] - ends[1]) / (2 * by[i])
        compare(turn.jacobian[:, i], slope)
    for k, name in enumerate(("stiffness", "stiffness", "damping", "damping")):
        factor = np.where(np.arange(2) == k % 2, np.exp(h), 1.0)
        both = (factor, 1 / factor)
        moved = [dataclasses.replace(windup, **{name: getattr(windup, name) * f}) for f in both]
        slope = (torque(moved[0]) - torque(moved[1])) / (2 * h)
        compare(turn.jacobian[:, turn.jacobian.shape[1] - 4 + k], slope)


@pytest.mark.parametrize("factor", [0.5, 1.3])
def test_two_elastic_joints_are_found_from_another_stiffness(arm, factor):
    model, beta = arm
    problem = as_problem(model, beta, swing(2, 1e-3, 6.0), noise=0.01)
    right = read_windup(model, beta)
    wrong = dataclasses.replace(right, stiffness=factor * right.stiffness, beta=0.9 * beta)
    fitted = problem.fit(wrong)
    np.testing.assert_allclose(fitted.stiffness, right.stiffness, rtol=1e-2)
    np.testing.assert_allclose(fitted.damping, right.damping, rtol=3e-2)
    assert (np.sqrt(np.diag(fitted.spread)) < 0.01).all()


def test_what_cannot_be_integrated_is_no_fit(arm):
    model, beta = arm
    problem = as_problem(model, beta, swing(2, 1e-3, 1.0))
    assert problem.fit(read_windup(model, -beta)) is None
