"""Robots in Pinocchio, built from the table alone, and what a controller calls of trees there."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import pytest

from modeler.robot.robot import Joint, Robot
from tests.elementary_motions import placed

pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: Pinocchio (PyPI: pin) is not installed")

NOTHING: Mapping[str, float] = MappingProxyType({})
_ORDER = ("M", "MX", "MY", "MZ", "XX", "XY", "YY", "XZ", "YZ", "ZZ")
"""Parameters of a body as Pinocchio has them, about the origin of its joint."""
_OURS = [4, 5, 7, 6, 8, 9, 1, 2, 3, 0]
"""Places there of XX, XY, XZ, YY, ..."""


def pinocchio_model(robot: Robot, chi: Mapping[str, float] = NOTHING):
    """Model and the joint ids in the order of `robot.moving`; bodies and rotors of chi."""
    values = robot.evaluate_symbols()
    model = pin.Model()
    model.gravity.linear = np.array([e.evaluate(values) for e in robot.gravity])
    places = {"0": (0, pin.SE3.Identity())}
    ids = {}
    for joint in depth_first(robot):
        parent, before = places[joint.antecedent]
        rotation, origin, sign = placed(joint, values)
        placement = before * pin.SE3(rotation, origin)
        if not joint.is_moving:
            places[joint.name] = (parent, placement)
            continue
        axis = np.array([0.0, 0.0, sign])
        kind = (
            pin.JointModelRevoluteUnaligned
            if joint.is_revolute
            else pin.JointModelPrismaticUnaligned
        )
        index = model.addJoint(parent, kind(axis), placement, f"joint {joint.name}")
        ten = np.array([chi.get(f"{prefix}{joint.name}", 0.0) for prefix in _ORDER])
        body = pin.Inertia.FromDynamicParameters(ten) if ten[0] else pin.Inertia.Zero()
        model.appendBodyToJoint(index, body, pin.SE3.Identity())
        model.armature[model.idx_vs[index]] = chi.get(f"Ia{joint.name}", 0.0)
        places[joint.name] = (index, pin.SE3.Identity())
        ids[joint.name] = index
    return model, [ids[joint.name] for joint in robot.moving_joints]


def depth_first(robot: Robot) -> list[Joint]:
    """Rows, branch after branch: Pinocchio needs what a joint carries to follow it at once."""
    carried: dict[str, list[Joint]] = {}
    for joint in robot.joints:
        carried.setdefault(joint.antecedent, []).append(joint)
    values, waiting = [], carried["0"][::-1]
    while waiting:
        values.append(waiting.pop())
        waiting += carried.get(values[-1].name, [])[::-1]
    return values


def places_of(robot: Robot, chi: Mapping[str, float] = NOTHING):
    """Model, and the places of our moving joints in its vectors."""
    model, ids = pinocchio_model(robot, chi)
    return model, [model.idx_vs[i] for i in ids]


def pinocchio_regressor(robot: Robot, q, qd, qdd) -> np.ndarray:
    """(samples, joints, 10 links) in our order of parameters."""
    model, ids = pinocchio_model(robot)
    data = model.createData()
    rows = [model.idx_vs[i] for i in ids]
    actual = np.zeros((*q.shape, 10 * len(ids)))
    for sample in range(len(q)):
        x, v, a = (np.zeros(model.nv) for _ in range(3))
        x[rows], v[rows], a[rows] = q[sample], qd[sample], qdd[sample]
        Y = pin.computeJointTorqueRegressor(model, data, x, v, a)
        for link, index in enumerate(ids):
            block = np.atleast_2d(Y)[rows][:, 10 * (index - 1) : 10 * index]
            actual[sample][:, 10 * link : 10 * link + 10] = block[:, _OURS]
    return actual


@dataclass
class PinocchioDynamics:
    """What the unit for controllers computes, of robots whose rows may follow others.

    One sample at a time; q, qd, ... are those of the free joints.
    """

    robot: Robot
    chi: dict[str, float]

    def __post_init__(self):
        self.model, ids = pinocchio_model(self.robot, self.chi)
        self.rows = [self.model.idx_vs[i] for i in ids]
        self.frames = {}
        if self.robot.tool is not None:
            values = self.robot.evaluate_symbols()
            x = [cell.evaluate(values) for cell in self.robot.tool.position]
            turn = pin.rpy.rpyToMatrix(*[c.evaluate(values) for c in self.robot.tool.angles])
            row = [joint.name for joint in self.robot.moving_joints].index(self.robot.tool.row)
            self.frames["tool"] = self.add_frame(ids[row], pin.SE3(turn, np.array(x)))
        for joint, index in zip(self.robot.moving_joints, ids, strict=True):
            self.frames[joint.name] = self.add_frame(index, pin.SE3.Identity())
        self.data = self.model.createData()
        self.F, self.shift = self.relations()

    def add_frame(self, joint, placement):
        frame = pin.Frame(f"frame {len(self.model.frames)}", joint, 0, placement, pin.OP_FRAME)
        return self.model.addFrame(frame)

    def relations(self):
        """q_rows = F q + shift."""
        free = [joint.name for joint in self.robot.free_joints]

        def rows(q):
            symbols = self.robot.evaluate_symbols()
            values = symbols | {f"q{name}": x for name, x in zip(free, q, strict=True)}
            relations = self.robot.relations
            return np.array(
                [
                    relations[j.name].evaluate(values)
                    if j.name in relations
                    else values[f"q{j.name}"]
                    for j in self.robot.moving_joints
                ]
            )

        shift = rows(np.zeros(len(free)))
        return np.array([rows(e) - shift for e in np.eye(len(free))]).T, shift

    def tree(self, v):
        """Speeds of the free joints as Pinocchio's."""
        out = np.zeros(self.model.nv)
        out[self.rows] = self.F @ v
        return out

    def projected(self, A):
        return self.F.T @ np.atleast_2d(A)[np.ix_(self.rows, self.rows)] @ self.F

    def effects(self, prefix):
        """{row: value} of an effect's parameter."""
        return np.array([self.chi.get(prefix + j.name, 0.0) for j in self.robot.moving_joints])

    def friction(self, v):
        """Torques, and their slopes by v."""
        speed, Fv = self.F @ v, self.effects("Fv")
        f = Fv * speed + self.effects("Fs") * np.sign(speed) + self.effects("Off")
        return self.F.T @ f, self.F.T @ np.diag(Fv) @ self.F

    def at(self, q, qd, qdd, v, a):
        """Everything at one state, by role; "tau" is what the accelerations ask for."""
        model, data = self.model, self.data
        x, speeds, rates = self.tree(q), self.tree(qd), self.tree(qdd)
        still = np.zeros(model.nv)
        x[self.rows] += self.shift
        M = np.atleast_2d(pin.crba(model, data, x))
        M = self.projected(np.triu(M) + np.triu(M, 1).T)
        gravity = self.F.T @ np.atleast_1d(pin.rnea(model, data, x, still, still))[self.rows]
        tau = self.F.T @ np.atleast_1d(pin.rnea(model, data, x, speeds, rates))[self.rows]
        kinetic = pin.computeRNEADerivatives(model, data, x, speeds, still)[1]
        C = self.projected(kinetic) / 2  # d c/d qd = 2 C defines Christoffel's
        by_q, by_qd, _ = pin.computeRNEADerivatives(model, data, x, speeds, rates)
        friction, slopes = self.friction(qd)
        by_q, by_qd = self.projected(by_q), self.projected(by_qd) + slopes
        inverse = np.linalg.inv(M)
        if not self.robot.relations:  # by articulated bodies
            push = np.zeros(model.nv)
            push[self.rows] = tau
            qdd = pin.aba(model, data, x, speeds, push)[self.rows]
        table = {
            "tau": tau + friction,
            "forward_dynamics": qdd,
            "forward_derivatives": np.array([-inverse @ by_q, -inverse @ by_qd, inverse]),
            "inertia_matrix": M,
            "coriolis_matrix": C,
            "coriolis_transpose": C.T @ qd,
            "momentum": M @ qd,
            "derivatives": np.array([by_q, by_qd]),
            "slotine_li": M @ a + C @ v + gravity + self.friction(v)[0],
            "momentum_rest": gravity + friction - C.T @ qd,
            "power": (tau + friction) @ qd,
        }
        pin.computeJointJacobiansTimeVariation(model, data, x, speeds)
        pin.forwardKinematics(model, data, x, speeds, still)
        pin.updateFramePlacements(model, data)
        world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        for name, frame in self.frames.items():
            J = pin.getFrameJacobian(model, data, frame, world).reshape(6, -1)[:, self.rows]
            a = pin.getFrameClassicalAcceleration(model, data, frame, world).vector
            table |= {
                f"pose {name}": data.oMf[frame].homogeneous[:3],
                f"jacobian {name}": J @ self.F,
                f"jacobian_dot_qd {name}": a,
                f"twist {name}": pin.getFrameVelocity(model, data, frame).vector,
            }
        return table

    @staticmethod
    def operational(M: np.ndarray, J: np.ndarray, damping: float) -> dict[str, np.ndarray]:
        """Of a frame with that Jacobian, by dense algebra."""
        L = np.linalg.inv(J @ np.linalg.solve(M, J.T) + damping**2 * np.eye(6))
        return {"operational_inertia": L, "operational_inverse": np.linalg.solve(M, J.T) @ L}
