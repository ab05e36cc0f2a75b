"""Closed robots against MuJoCo: our torques, replayed open loop, carry out our motion there.

It knows neither our projection nor our closing.
"""

import numpy as np
import pytest

from modeler.robot.read import read_robot
from modeler.robot.robot import INERTIAL
from modeler.simulation import collect_motion_limits, draw_plant_parameters
from modeler.simulation.closing import build_constraints, compute_closed_postures
from tests.modules import module, plain
from tests.oracles.mujoco_machine import STEP, mujoco, mujoco_model
from tests.rotation import ROTATING, rotating

STEPS = 1500
ROBOTS = [
    "five-bar",
    *rotating("sr400", "orthoglide-2003"),
    *(pytest.param(name, marks=ROTATING) for name in ("3rrr", "delta", "stewart", "evra")),
]


def smooth_motion(robot, time):
    """q, qd, qdd that start at rest at home; other joints, other frequencies and ways."""
    reach = np.array([0.4 if joint.is_revolute else 0.04 for joint in robot.coordinates])
    omega = 2 * np.pi * (1.5 + 0.5 * np.arange(len(reach)))
    way = reach * np.resize([1.0, -0.7, 0.5], len(reach))
    home = np.array([robot.home.get(joint.name, 0.0) for joint in robot.coordinates])
    phase = time[:, None] * omega
    return (
        home + way * (phase - np.sin(phase)) / np.pi,
        way * omega * (1 - np.cos(phase)) / np.pi,
        way * omega**2 * np.sin(phase) / np.pi,
    )


def replayed(robot, standard, tau, start):
    """(STEPS + 1, moving rows) positions under torques held over each step."""
    model = mujoco_model(robot, standard)
    data = mujoco.MjData(model)
    places = [model.joint(joint.name).qposadr[0] for joint in robot.moving_joints]
    motors = [model.joint(joint.name).dofadr[0] for joint in robot.coordinates]
    data.qpos[places] = start
    values = [start]
    for torque in tau:
        data.qfrc_applied[motors] = torque
        mujoco.mj_step(model, data)
        values.append(data.qpos[places].copy())
    return np.array(values)


@pytest.mark.parametrize("name", ROBOTS)
def test_our_torques_carry_out_our_motion(name):
    robot, c = read_robot(name), plain(name)
    standard = draw_plant_parameters(robot, collect_motion_limits(robot)).standard
    columns = module(name).model.names
    felt = (*INERTIAL, "Ia")
    chi = np.array([standard[n] if n.startswith(felt) else 0.0 for n in columns])
    time = STEP * np.arange(STEPS + 1)
    q, _, _ = smooth_motion(robot, time)
    middle = smooth_motion(robot, time[:-1] + STEP / 2)
    tau = c.inverse_dynamics(*middle, c.base_parameters(chi))
    start = compute_closed_postures(robot, build_constraints(robot), q[:1])[0]
    names = [joint.name for joint in robot.moving_joints]
    inputs = [names.index(joint.name) for joint in robot.coordinates]
    right = replayed(robot, standard, tau, start)[:, inputs]
    moved = np.ptp(q, axis=0)
    assert np.all(moved > 0.02)
    error = np.abs(right - q).max(axis=0) / moved
    assert np.all(error < 2e-4)  # falls with the square of the step: 1e-6 to 1e-4 here
    if name == "five-bar":  # what is compared is sharp: a hundredth of the torque shows
        wrong = replayed(robot, standard, 1.01 * tau, start)[:, inputs]
        assert np.max(np.abs(wrong - q).max(axis=0) / moved) > 2e-3
