"""Poses from the compiled C against elementary motions multiplied in numpy."""

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.read import parse_robot_text, read_robot
from tests.codegen.fitted_library import robot_text
from tests.elementary_motions import frames
from tests.modules import loaded, plain, states
from tests.robots import TREES

# Without gravity; a branch, a fixed frame between joints and one at the end, joints that count
# backwards, oblique angles, a slide that is turned and offset.
TREE = robot_text("odd-tree")


def expected(robot, q):
    """(samples, joints, 3, 4)."""
    moving = [joint.name for joint in robot.moving_joints]
    values = [frames(robot, sample) for sample in q]
    return np.array([[poses[name][:3] for name in moving] for poses in values])


@pytest.mark.parametrize("name", TREES)
def test_poses_are_the_product_of_elementary_motions(name):
    robot = read_robot(name)
    q = states(len(robot.moving_joints), 8)[0]
    poses = plain(name).forward_kinematics(q)
    np.testing.assert_allclose(poses, expected(robot, q), rtol=0, atol=1e-13)


@pytest.mark.digits
def test_a_row_may_hold_anything():
    robot = parse_robot_text(TREE, "odd-tree")
    model = derive_model(robot)
    emitted = emit(model, derive_base_parameters(model))
    q = states(4, 25)[0]
    T = loaded(emitted).forward_kinematics(q)
    np.testing.assert_allclose(T, expected(robot, q), rtol=0, atol=1e-13)
