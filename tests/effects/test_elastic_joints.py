"""Elastic joints: torque, steps and feed-forward against mechanics written out by hand."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from modeler.api import derive, generate
from modeler.robot.read import parse_robot_text
from modeler.runtime.model import CompiledModel
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
