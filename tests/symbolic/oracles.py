"""Pinocchio's model of a robot of ours, built from the table alone."""

import numpy as np
import pytest

from modeler.robot.robot import Joint, Robot
from tests.elementary_motions import placed

pin = pytest.importorskip("pinocchio", reason="Pinocchio (PyPI: pin) is not installed")


def pinocchio_model(robot: Robot):
    """Model and the joint ids in the order of `robot.moving`."""
    values = robot.symbol_values()
    model = pin.Model()
    model.gravity.linear = np.array([e.number(values) for e in robot.gravity])
    places = {"0": (0, pin.SE3.Identity())}
    ids = {}
    for joint in depth_first(robot):
        parent, before = places[joint.antecedent]
        rotation, origin, sign = placed(joint, values)
        placement = before * pin.SE3(rotation, origin)
        if not joint.moves:
            places[joint.name] = (parent, placement)
            continue
        axis = np.array([0.0, 0.0, sign])
        kind = (
            pin.JointModelRevoluteUnaligned if joint.angular else pin.JointModelPrismaticUnaligned
        )
        index = model.addJoint(parent, kind(axis), placement, f"joint {joint.name}")
        model.appendBodyToJoint(index, pin.Inertia.Zero(), pin.SE3.Identity())
        places[joint.name] = (index, pin.SE3.Identity())
        ids[joint.name] = index
    return model, [ids[joint.name] for joint in robot.moving]


def depth_first(robot: Robot) -> list[Joint]:
    """Rows, branch after branch: Pinocchio wants what a joint carries to follow it at once."""
    carried: dict[str, list[Joint]] = {}
    for joint in robot.joints:
        carried.setdefault(joint.antecedent, []).append(joint)
    found, waiting = [], carried["0"][::-1]
    while waiting:
        found.append(waiting.pop())
        waiting += carried.get(found[-1].name, [])[::-1]
    return found


# Pinocchio: [m, mcx, mcy, mcz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz] per body, about the joint origin.
_ORDER = [4, 5, 7, 6, 8, 9, 1, 2, 3, 0]


def pinocchio_regressor(robot: Robot, q, qd, qdd) -> np.ndarray:
    """(samples, joints, 10 links) in our order of parameters."""
    model, ids = pinocchio_model(robot)
    data = model.createData()
    rows = [model.idx_vs[i] for i in ids]
    found = np.zeros((*q.shape, 10 * len(ids)))
    for sample in range(len(q)):
        x, v, a = (np.zeros(model.nv) for _ in range(3))
        x[rows], v[rows], a[rows] = q[sample], qd[sample], qdd[sample]
        Y = pin.computeJointTorqueRegressor(model, data, x, v, a)
        for link, index in enumerate(ids):
            block = np.atleast_2d(Y)[rows][:, 10 * (index - 1) : 10 * index]
            found[sample][:, 10 * link : 10 * link + 10] = block[:, _ORDER]
    return found
