"""Pinocchio's model of a robot of ours, built from the table alone."""

import numpy as np
import pytest

from modeler.robot.robot import Robot

pin = pytest.importorskip("pinocchio", reason="Pinocchio (PyPI: pin) is not installed")


def _turn(axis: int, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    if axis == 0:
        return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def pinocchio_model(robot: Robot):
    """Model and the joint ids in the order of `robot.moving`."""
    values = robot.symbol_values()
    model = pin.Model()
    model.gravity.linear = np.array([e.number(values) for e in robot.gravity])
    places = {"0": (0, pin.SE3.Identity())}
    ids = []
    for joint in robot.joints:
        parent, before = places[joint.antecedent]
        at_zero = values | {joint.variable: 0.0}
        at_one = values | {joint.variable: 1.0}
        e = {
            n: getattr(joint, n).number(at_zero) for n in ("gamma", "b", "alpha", "d", "theta", "r")
        }
        R = _turn(2, e["gamma"]) @ _turn(0, e["alpha"])
        p = _turn(2, e["gamma"]) @ (
            np.array([0, 0, e["b"]]) + _turn(0, e["alpha"]) @ [e["d"], 0, e["r"]]
        )
        placement = before * pin.SE3(R @ _turn(2, e["theta"]), p)
        if not joint.moves:
            places[joint.name] = (parent, placement)
            continue
        moving = joint.theta if joint.angular else joint.r
        sign = np.sign(moving.number(at_one) - moving.number(at_zero))
        axis = np.array([0.0, 0.0, sign])
        kind = (
            pin.JointModelRevoluteUnaligned if joint.angular else pin.JointModelPrismaticUnaligned
        )
        index = model.addJoint(parent, kind(axis), placement, f"joint {joint.name}")
        model.appendBodyToJoint(index, pin.Inertia.Zero(), pin.SE3.Identity())
        places[joint.name] = (index, pin.SE3.Identity())
        ids.append(index)
    return model, ids


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
