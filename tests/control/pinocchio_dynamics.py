"""What the unit for controllers computes, by Pinocchio: of robots whose rows may follow others."""

from dataclasses import dataclass

import numpy as np
import pytest

from modeler.robot import Robot
from tests.symbolic.oracles import pinocchio_model

pin = pytest.importorskip("pinocchio", reason="Pinocchio (PyPI: pin) is not installed")

_LETTERS = ("XX", "XY", "XZ", "YY", "YZ", "ZZ")


@dataclass
class Oracle:
    """One sample at a time; q, qd, ... are those of the free joints."""

    robot: Robot
    chi: dict[str, float]

    def __post_init__(self):
        self.model, ids = pinocchio_model(self.robot)
        self.rows = [self.model.idx_vs[i] for i in ids]
        for joint, index in zip(self.robot.moving, ids, strict=True):
            own = {p: self.chi.get(p + joint.name, 0.0) for p in (*_LETTERS, "MX", "MY", "MZ", "M")}
            xx, xy, xz, yy, yz, zz = (own[p] for p in _LETTERS)
            first, mass = np.array([own["MX"], own["MY"], own["MZ"]]), own["M"]
            c = first / mass
            about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            about -= mass * (c @ c * np.eye(3) - np.outer(c, c))
            self.model.inertias[index] = pin.Inertia(mass, c, about)
        self.frames = {}
        if self.robot.tool is not None:
            values = self.robot.symbol_values()
            x = [cell.number(values) for cell in self.robot.tool.position]
            turn = pin.rpy.rpyToMatrix(*[c.number(values) for c in self.robot.tool.angles])
            row = [joint.name for joint in self.robot.moving].index(self.robot.tool.row)
            self.frames["tool"] = self.add_frame(ids[row], pin.SE3(turn, np.array(x)))
        for joint, index in zip(self.robot.moving, ids, strict=True):
            self.frames[joint.name] = self.add_frame(index, pin.SE3.Identity())
        self.data = self.model.createData()
        self.F, self.shift = self.relations()

    def add_frame(self, joint, placement):
        frame = pin.Frame(f"frame {len(self.model.frames)}", joint, 0, placement, pin.OP_FRAME)
        return self.model.addFrame(frame)

    def relations(self):
        """q_rows = F q + shift."""
        free = [joint.name for joint in self.robot.free]

        def rows(q):
            values = self.robot.symbol_values() | {
                f"q{name}": x for name, x in zip(free, q, strict=True)
            }
            relations = self.robot.relations
            return np.array([
                relations[j.name].number(values) if j.name in relations else values[f"q{j.name}"]
                for j in self.robot.moving
            ])  # fmt: skip

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
        return np.array([self.chi.get(prefix + joint.name, 0.0) for joint in self.robot.moving])

    def friction(self, v):
        """Torques, and their slopes by v."""
        speed, Fv = self.F @ v, self.effects("Fv")
        f = Fv * speed + self.effects("Fs") * np.sign(speed) + self.effects("Off")
        return self.F.T @ f, self.F.T @ np.diag(Fv) @ self.F

    def at(self, q, qd, qdd, v, a):
        """Everything at one state, by role."""
        model, data = self.model, self.data
        x, speeds, rates = self.tree(q), self.tree(qd), self.tree(qdd)
        still = np.zeros(model.nv)
        x[self.rows] += self.shift
        rotors = self.F.T @ np.diag(self.effects("Ia")) @ self.F
        M = np.atleast_2d(pin.crba(model, data, x))
        M = self.projected(np.triu(M) + np.triu(M, 1).T) + rotors
        gravity = self.F.T @ np.atleast_1d(pin.rnea(model, data, x, still, still))[self.rows]
        tau = self.F.T @ np.atleast_1d(pin.rnea(model, data, x, speeds, rates))[self.rows]
        kinetic = pin.computeRNEADerivatives(model, data, x, speeds, still)[1]
        C = self.projected(kinetic) / 2  # d c/d qd = 2 C defines Christoffel's
        by_q, by_qd, _ = pin.computeRNEADerivatives(model, data, x, speeds, rates)
        slopes = self.friction(qd)[1]
        found = {
            "inertia_matrix": M,
            "coriolis_matrix": C,
            "coriolis_transpose": C.T @ qd,
            "momentum": M @ qd,
            "derivatives": np.array([self.projected(by_q), self.projected(by_qd) + slopes]),
            "slotine_li": M @ a + C @ v + gravity + self.friction(v)[0],
            "momentum_rest": gravity + self.friction(qd)[0] - C.T @ qd,
            "power": (tau + rotors @ qdd + self.friction(qd)[0]) @ qd,
        }
        pin.computeJointJacobiansTimeVariation(model, data, x, speeds)
        pin.forwardKinematics(model, data, x, speeds, still)
        pin.updateFramePlacements(model, data)
        world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        for name, frame in self.frames.items():
            J = pin.getFrameJacobian(model, data, frame, world).reshape(6, -1)[:, self.rows]
            a = pin.getFrameClassicalAcceleration(model, data, frame, world).vector
            found |= {
                f"pose {name}": data.oMf[frame].homogeneous[:3],
                f"jacobian {name}": J @ self.F,
                f"jacobian_dot_qd {name}": a,
                f"twist {name}": pin.getFrameVelocity(model, data, frame).vector,
            }
        return found
