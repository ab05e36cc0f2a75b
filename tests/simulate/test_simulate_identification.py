"""From a log of ideal sensors, a regressor that is not ours finds the robot again."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.signal import butter, decimate, filtfilt
from simulated_robots import ARM, pinocchio_model, robot

from modeler.simulation import SimulationSettings, motion_limits, plant_parameters, simulate

RATE, FACTOR = 1000.0, 12


def columns_and_torques(model: pin.Model, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Decimated W (samples, joints, columns), tau, and True where a joint moves throughout."""
    settings = SimulationSettings(
        duration=10.0, rate=RATE, seed=seed, encoder_counts=0, torque_noise=0.0
    )
    log = simulate(robot(ARM), settings)
    q = filtfilt(*butter(4, 40 / (RATE / 2)), log.q, axis=0)
    qd = np.gradient(q, 1 / RATE, axis=0)
    qdd = np.gradient(qd, 1 / RATE, axis=0)
    data = model.createData()
    rigid = [
        pin.computeJointTorqueRegressor(model, data, *state).copy()
        for state in zip(q, qd, qdd, strict=True)
    ]
    local = np.stack([qdd, qd, np.sign(qd), np.ones_like(qd)], axis=2)
    blocks = np.einsum("nje,jk->njke", local, np.eye(3)).reshape(len(q), 3, 12)
    wanted = np.concatenate([np.array(rigid), blocks], axis=2)
    thinned = [decimate(x, FACTOR, axis=0) for x in (wanted, log.tau, np.abs(qd))]
    inner = slice(20, -20)
    return thinned[0][inner], thinned[1][inner], thinned[2][inner] > 0.03


@pytest.mark.slow
def test_another_regressor_finds_the_true_friction_and_predicts_other_motion():
    source = robot(ARM)
    truth = plant_parameters(source, motion_limits(source))
    model = pinocchio_model(source, truth)
    model.armature[:] = 0  # a column of its own
    W, tau, moves = columns_and_torques(model, seed=0)
    weight = 1 / tau.std(axis=0)
    A = (W * weight[:, None])[moves]
    scale = np.linalg.norm(A, axis=0)
    scale[scale == 0] = 1
    found = np.linalg.lstsq(A / scale, (tau * weight)[moves], rcond=1e-7)[0] / scale
    for j, joint in enumerate("123"):
        viscous, coulomb, offset = found[30 + 4 * j + 1 : 30 + 4 * j + 4]
        for value, name in ((viscous, "Fv"), (coulomb, "Fs")):
            expected = truth.standard[name + joint]
            assert abs(value - expected) < 0.01 * expected, name + joint
        level = truth.standard["Fs" + joint]
        # Axis 1 is nearly vertical: its offset is nearly the same column as its gravity torque.
        assert abs(offset - truth.standard["Off" + joint]) < 0.03 * level
    W, tau, moves = columns_and_torques(model, seed=1)
    error = np.where(moves, tau - W @ found, 0.0)
    share = np.linalg.norm(error, axis=0) / np.linalg.norm(np.where(moves, tau, 0.0), axis=0)
    # What is left is the smeared step of dry friction: measured 0.1 %.
    assert np.all(share < 0.003)
