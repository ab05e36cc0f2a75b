"""The compiled C against Pinocchio, without anything of ours in between."""

import numpy as np
import pytest

from modeler.robot.read import read_robot
from tests.modules import plain

ROBOTS = (
    *(pytest.param("wrist", marks=pytest.mark.digits), "puma560", "sr400-tree"),
    *(pytest.param(name, marks=pytest.mark.rotating) for name in ("rx90", "panda", "scara")),
)


@pytest.mark.parametrize("name", ROBOTS)
def test_standard_regressor_and_base_torque(name):
    from tests.oracles.pinocchio_dynamics import pinocchio_regressor

    robot, model = read_robot(name), plain(name)
    rng = np.random.default_rng(21)
    q, qd, qdd = rng.uniform(-1.5, 1.5, (3, 20, len(robot.moving_joints)))
    theirs = pinocchio_regressor(robot, q, qd, qdd)
    bound = 1e-12 * np.abs(theirs).max()
    np.testing.assert_allclose(model.regressor(q, qd, qdd), theirs, rtol=0, atol=bound)
    chi = rng.normal(size=theirs.shape[2])
    tau = model.inverse_dynamics(q, qd, qdd, model.base_parameters(chi))
    expected = theirs @ chi
    np.testing.assert_allclose(tau, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
