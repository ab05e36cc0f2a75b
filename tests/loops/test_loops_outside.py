"""Closed robots against Pinocchio, and against simulations by Lagrange multipliers.

Pinocchio knows the opened tree only. What ties it is written here once more, and its accelerations
under given motor torques are solved for together with the constraint forces.
"""

import numpy as np
import pytest

from modeler.derivation.columns import LinkColumn
from modeler.robot.read import read_robot
from modeler.robot.robot import INERTIAL
from modeler.simulation import SimulationSettings, simulate
from modeler.simulation.rigid import Body, standard_from_body
from tests.elementary_motions import placed
from tests.loops.closed_states import closed
from tests.modules import module, plain
from tests.rotation import ROTATING


class Outside:
    """The opened tree in Pinocchio, with bodies, and the equations of its ties."""

    def __init__(self, name: str, chi: np.ndarray) -> None:
        import pinocchio as pin

        from tests.symbolic.oracles import pinocchio_model

        self.pin, self.robot = pin, read_robot(name)
        self.model, ids = pinocchio_model(self.robot)
        self.moving = [joint.name for joint in self.robot.moving]
        self.ids = dict(zip(self.moving, ids, strict=True))
        self.rows = [self.model.idx_vs[i] for i in ids]
        values = dict(zip(module(name).model.names, chi, strict=True))
        for joint, index in self.ids.items():
            XX, XY, XZ, YY, YZ, ZZ, MX, MY, MZ, M = (
                values.get(f"{prefix}{joint}", 0.0) for prefix in INERTIAL
            )
            dynamic = np.array([M, MX, MY, MZ, XX, XY, YY, XZ, YZ, ZZ])
            if M:
                self.model.inertias[index] = pin.Inertia.FromDynamicParameters(dynamic)
        self.frames = {}
        values = self.robot.symbol_values()
        for row in self.robot.joints:
            placement = pin.SE3.Identity()
            at = row
            while not at.moves and at.name != "0":
                rotation, origin, _ = placed(at, values)
                placement = pin.SE3(rotation, origin) * placement
                if at.antecedent == "0":
                    break
                at = self.robot.joint(at.antecedent)
            parent = self.ids[at.name] if at.moves else 0
            self.frames[row.name] = self.model.addFrame(
                pin.Frame(row.name, parent, 0, placement, pin.FrameType.OP_FRAME)
            )
        self.data = self.model.createData()

    def tree(self, u: np.ndarray) -> np.ndarray:
        """Variables of all moving rows from the free ones, by the relations as written."""
        values = self.robot.symbol_values()
        values |= {f"q{j.name}": x for j, x in zip(self.robot.free, u, strict=True)}
        waiting = dict(self.robot.relations)
        while waiting:
            for name, relation in list(waiting.items()):
                if relation.names <= values.keys():
                    values[f"q{name}"] = relation.number(values)
                    del waiting[name]
        found = np.zeros(self.model.nv)
        found[self.rows] = [values[f"q{name}"] for name in self.moving]
        return found

    def ties(self, x: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(residual, A, A' v) of relations and loops; loops of points only."""
        pin, values = self.pin, self.robot.symbol_values()
        pin.forwardKinematics(self.model, self.data, x, v, 0 * v)
        pin.computeJointJacobians(self.model, self.data, x)
        pin.updateFramePlacements(self.model, self.data)
        world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        residual, A, bend = [], [], []
        for name, relation in self.robot.relations.items():
            line = np.zeros(self.model.nv)
            line[self.rows[self.moving.index(name)]] = 1.0
            zero = values | dict.fromkeys((n for n in relation.names if n not in values), 0.0)
            for other in relation.names - values.keys():
                slope = relation.number(zero | {other: 1.0}) - relation.number(zero)
                line[self.rows[self.moving.index(other[1:])]] -= slope
            A.append(line)
            bend.append(0.0)
            residual.append(line @ x - relation.number(zero))
        for loop in self.robot.loops:
            sides = []
            for frame in (self.frames[loop.frame], self.frames[loop.meets]):
                J = pin.getFrameJacobian(self.model, self.data, frame, world)[:3]
                a = pin.getFrameClassicalAcceleration(self.model, self.data, frame, world).linear
                sides.append((self.data.oMf[frame].translation, J, a))
            residual += list(sides[0][0] - sides[1][0])
            A += list(sides[0][1] - sides[1][1])
            bend += list(sides[0][2] - sides[1][2])
        return np.array(residual), np.array(A), np.array(bend)

    def accelerations(self, x: np.ndarray, v: np.ndarray, tau: np.ndarray) -> np.ndarray:
        """Tree accelerations and constraint forces together: M a + h = S tau + A^T f."""
        pin = self.pin
        _, A, bend = self.ties(x, v)
        # Not by crba, which needs the joints in depth-first order: rows are as in the table.
        h = pin.rnea(self.model, self.data, x, v, 0 * v)
        units = np.eye(self.model.nv)
        M = np.stack([pin.rnea(self.model, self.data, x, v, unit) - h for unit in units], axis=1)
        push = np.zeros(self.model.nv)
        for joint, value in zip(self.robot.coordinates, tau, strict=True):
            push[self.rows[self.moving.index(joint.name)]] = value
        left = np.block([[M, -A.T], [A, np.zeros((len(A), len(A)))]])
        solution = np.linalg.lstsq(left, np.concatenate([push - h, -bend]), rcond=1e-13)[0]
        return solution[: self.model.nv]


def physical(name: str) -> np.ndarray:
    """Random standard parameters that bodies can have; no friction."""
    rng = np.random.default_rng(4)
    model = module(name).model
    chi = np.zeros(len(model.columns))
    for row, joint in enumerate(model.robot.joints):
        if joint.moves and model.robot.inertial(joint.name):
            B = rng.normal(size=(3, 3))
            inertia = 0.01 * (B @ B.T + 3 * np.eye(3))
            body = Body(rng.uniform(0.5, 2), 0.1 * rng.normal(size=3), inertia)
            ten = standard_from_body(body)
            for i, column in enumerate(model.columns):
                if isinstance(column, LinkColumn) and column.row == row:
                    chi[i] = ten[column.prefix]
    return chi


@pytest.mark.parametrize(
    "name",
    [
        "five-bar", "orthoglide-2012", "stewart",
        *(pytest.param(name, marks=ROTATING) for name in ("3rrr", "delta", "evra")),
    ],
)  # fmt: skip
def test_pinocchio_accelerates_as_the_inverse_dynamics_says(name):
    pytest.importorskip("pinocchio", reason="Pinocchio (PyPI: pin) is not installed")
    chi = physical(name)
    outside, c = Outside(name, chi), plain(name)
    beta = c.base_parameters(chi)
    (q, qd, _), (u, _, _), _ = closed(name, 6, seed=8)
    names = [joint.name for joint in outside.robot.coordinates]
    rows = [outside.rows[outside.moving.index(n)] for n in names]
    rng = np.random.default_rng(6)
    for i in range(len(q)):
        x = outside.tree(u[i])
        residual, A, _ = outside.ties(x, 0 * x)
        np.testing.assert_allclose(residual, 0, atol=1e-9)
        v = np.zeros(outside.model.nv)
        v[rows] = qd[i]
        others = [k for k in range(outside.model.nv) if k not in rows]
        v[others] = -np.linalg.lstsq(A[:, others], A[:, rows] @ qd[i], rcond=1e-12)[0]
        tau = rng.normal(size=len(rows))
        a = outside.accelerations(x, v, tau)
        ours = c.inverse_dynamics(q[i : i + 1], qd[i : i + 1], a[None, rows], beta)[0]
        scale = np.abs(np.concatenate([tau, c.gravity(q[i : i + 1], beta)[0]])).max()
        np.testing.assert_allclose(ours, tau, atol=1e-7 * scale)


@pytest.mark.parametrize(
    "name",
    [
        "five-bar", "sr400", "orthoglide-2003",
        *(pytest.param(name, marks=ROTATING) for name in ("3rrr", "stewart", "evra")),
    ],
)  # fmt: skip
def test_simulated_torques_are_those_of_the_model(name):
    """The simulator closes whole frames by least squares and solves for multipliers."""
    robot, c = read_robot(name), plain(name)
    settings = SimulationSettings(duration=0.6, rate=1000, torque_noise=0.0)
    truth = simulate(robot, settings).truth
    chi = np.array([truth.parameters[column.name] for column in module(name).base.columns])
    tau = c.inverse_dynamics(truth.q, truth.qd, truth.qdd, c.base_parameters(chi))
    largest = np.abs(truth.tau).max()
    # Dry friction of the simulator has a smooth core: rows where a joint creeps are left out.
    wrong = np.sort(np.max(np.abs(tau - truth.tau), axis=1))
    assert np.median(wrong) < 1e-9 * largest
