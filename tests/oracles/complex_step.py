"""Mechanics of robots, with loops too, and all that a controller calls, from the table alone.

An oracle in plain numpy: nothing of the package but the reading of the robot file. Frames,
Jacobians and the motion of frames by the rules of rigid bodies; kinetic energy and potential from
the standard parameters; derivatives by complex steps, so exact to rounding. Everything of the
theory then is its definition: Christoffel symbols are derivatives of M, gravity the slope of the
potential, C^T qd that of the kinetic energy, and loops are reduced to q by G, whose derivative is
taken along the closed postures.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from modeler.robot.robot import INERTIAL, LinkFrame, Robot

STEP = 1e-30  # of complex steps
NEWTON = 40  # rounds of closing
CLOSED = 1e-13  # of the robot's size


class Singular(ArithmeticError):
    """The loops do not determine the passive joints here."""


class Oracle:
    """A robot with values of its standard parameters.

    Postures are `u`, the variables of `robot.free`; speeds and torques those of the coordinates q.
    Every method but `closed` takes complex numbers, and `u` of several postures, (m, f).
    """

    def __init__(self, robot: Robot, chi: Mapping[str, float] = MappingProxyType({})) -> None:
        self.robot, self.symbols = robot, robot.evaluate_symbols()
        names = [joint.name for joint in robot.free_joints]
        self.given = [names.index(joint.name) for joint in robot.coordinates]
        self.solved = [k for k in range(len(names)) if k not in self.given]
        self.n = len(self.given)
        shared = {member: s.name for s in robot.shared for member in s.members}
        self._chi, self._shared = dict(chi), shared
        self.follow = self._following(names)
        self.rows = {joint.name: self._row(joint) for joint in robot.joints}
        self.gravity = np.array([e.evaluate(self.symbols) for e in robot.gravity])
        lengths = [abs(x) for A, *_ in self.rows.values() for x in A[:3, 3]]
        self.size = max(lengths, default=1.0) or 1.0
        self.scale = np.array([1.0 if j.is_revolute else self.size for j in robot.free_joints])
        self.width = 0.0  # of friction that turns around gradually, rad/s or m/s
        self.constant: dict[str, float] = {}  # weights by row that count as offsets, not as gravity

    def value(self, name: str) -> float:
        """Of a standard parameter, 0 if the robot has none of that name."""
        return self._chi.get(name, self._chi.get(self._shared.get(name, ""), 0.0))

    # The table.

    def _following(self, names: list[str]) -> dict[str, tuple[float, np.ndarray]]:
        """{row: (constant, slopes)}: its variable is constant + slopes @ u."""
        robot = self.robot

        def variables(u: np.ndarray) -> dict[str, float]:
            values = {f"q{name}": x for name, x in zip(names, u, strict=True)}
            waiting = dict(robot.relations)
            while waiting:
                known = self.symbols | values
                ready = [k for k, e in waiting.items() if e.names <= known.keys()]
                values |= {f"q{k}": waiting.pop(k).evaluate(known) for k in ready}
            return values

        origin = variables(np.zeros(len(names)))
        slopes = [variables(unit) for unit in np.eye(len(names))]
        return {
            row.name: (
                origin[row.variable],
                np.array([one[row.variable] - origin[row.variable] for one in slopes]),
            )
            for row in robot.moving_joints
        }

    def _row(self, row) -> tuple:
        """(A, (theta, slope), (r, slope)): constant placement, then the cells that may move."""

        def cell(expression) -> tuple[float, float]:
            at = [
                expression.evaluate(self.symbols | ({row.variable: x} if row.is_moving else {}))
                for x in (0.0, 1.0)
            ]
            return at[0], at[1] - at[0]

        gamma, b, alpha, d = (cell(e)[0] for e in (row.gamma, row.b, row.alpha, row.d))
        A = _moved(rotation(2, gamma), [0, 0, b]) @ _moved(rotation(0, alpha), [0, 0, 0])
        return A @ _moved(np.eye(3), [d, 0, 0]), cell(row.theta), cell(row.r)

    def variables(self, u: np.ndarray) -> dict[str, np.ndarray]:
        """{row: its variable}, by the relations as written."""
        return {row: constant + u @ slopes for row, (constant, slopes) in self.follow.items()}

    # Kinematics.

    def frames(self, u: np.ndarray) -> dict[str, tuple]:
        """{row: (R, p, Jv, Jw)} in frame 0; J by the free variables, (m, 3, f)."""
        u = np.atleast_2d(u)
        m, f = u.shape
        none = np.zeros((m, 3, f), u.dtype)
        table = {"0": (np.tile(np.eye(3, dtype=u.dtype), (m, 1, 1)), none[:, :, 0], none, none)}
        for row in self.robot.joints:
            R, p, Jv, Jw = table[row.antecedent]
            A, theta, r = self.rows[row.name]
            constant, slopes = self.follow.get(row.name, (0.0, np.zeros(f)))
            y = constant + u @ slopes
            z = R @ A[:3, 2]
            way = R @ A[:3, 3] + z * (r[0] + r[1] * y)[:, None]
            turn = _rotations(theta[0] + theta[1] * y)
            by = z[:, :, None] * slopes
            table[row.name] = (
                R @ A[:3, :3] @ turn,
                p + way,
                Jv + np.cross(Jw, way[:, :, None], axis=1) + by * r[1],
                Jw + by * theta[1],
            )
        return table

    def motion(self, u: np.ndarray, ud: np.ndarray, udd: np.ndarray) -> dict[str, tuple]:
        """{row: (w, v, dw, a)}: angular and linear speed and acceleration, in frame 0."""
        frames = self.frames(u)
        none = np.zeros((len(np.atleast_2d(u)), 3))
        result = {"0": (none,) * 4}
        for row in self.robot.joints:
            w, v, dw, a = result[row.antecedent]
            _, theta, r = self.rows[row.name]
            slopes = self.follow[row.name][1] if row.is_moving else np.zeros(u.shape[-1])
            z = frames[row.name][0][:, :, 2]
            way = frames[row.name][1] - frames[row.antecedent][1]
            rate, gain = (z * np.atleast_1d(x @ slopes)[:, None] for x in (ud, udd))
            result[row.name] = (
                w + theta[1] * rate,
                v + np.cross(w, way) + r[1] * rate,
                dw + theta[1] * (gain + np.cross(w, rate)),
                a
                + np.cross(dw, way)
                + np.cross(w, np.cross(w, way))
                + 2 * r[1] * np.cross(w, rate)
                + r[1] * gain,
            )
        return result

    # Loops.

    def errors(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(m, e) what is open, and its slopes by the free variables (m, e, f)."""
        frames, items, slopes = self.frames(u), [], []
        for loop in self.robot.loops:
            (A, a, Av, Aw), (B, b, Bv, Bw) = frames[loop.frame], frames[loop.meets]
            way, Jway = (b - a) / self.size, (Bv - Av) / self.size
            z, Jz = A[:, :, 2], _turning(Aw, A[:, :, 2])
            other, Jother = B[:, :, 2], _turning(Bw, B[:, :, 2])
            if loop.kind in ("cylindrical", "prismatic"):
                items.append(np.cross(way, z))
                turned = np.cross(Jway, z[:, :, None], axis=1)
                slopes.append(turned + np.cross(way[:, :, None], Jz, axis=1))
            elif loop.kind == "planar":
                items.append(_dot(way, z))
                slopes.append(_across(way, Jz) + _across(z, Jway))
            else:
                items.append(way)
                slopes.append(Jway)
            if loop.kind in ("revolute", "cylindrical", "planar", "prismatic", "rigid"):
                items.append(z - other)
                slopes.append(Jz - Jother)
            if loop.kind in ("prismatic", "rigid"):
                items.append(A[:, :, 0] - B[:, :, 0])
                slopes.append(_turning(Aw, A[:, :, 0]) - _turning(Bw, B[:, :, 0]))
            if loop.kind == "universal":
                items.append(_dot(z, other))
                slopes.append(_across(z, Jother) + _across(other, Jz))
        return np.concatenate(items, axis=1), np.concatenate(slopes, axis=1)

    def drift(self, u: np.ndarray, ud: np.ndarray) -> np.ndarray:
        """(m, e): second derivatives of the errors by time where udd is 0."""
        frames, motion, actual = self.frames(u), self.motion(u, ud, np.zeros_like(ud)), []

        def direction(row: str, axis: int) -> tuple:
            w, _, dw, _ = motion[row]
            x = frames[row][0][:, :, axis]
            return x, np.cross(w, x), np.cross(dw, x) + np.cross(w, np.cross(w, x))

        for loop in self.robot.loops:
            way = [
                (y - x) / self.size
                for x, y in (
                    (frames[loop.frame][1], frames[loop.meets][1]),
                    (motion[loop.frame][1], motion[loop.meets][1]),
                    (motion[loop.frame][3], motion[loop.meets][3]),
                )
            ]
            z, other = direction(loop.frame, 2), direction(loop.meets, 2)
            if loop.kind in ("cylindrical", "prismatic"):
                actual.append(_second(np.cross, way, z))
            elif loop.kind == "planar":
                actual.append(_second(_dot, way, z))
            else:
                actual.append(way[2])
            if loop.kind in ("revolute", "cylindrical", "planar", "prismatic", "rigid"):
                actual.append(z[2] - other[2])
            if loop.kind in ("prismatic", "rigid"):
                actual.append(direction(loop.frame, 0)[2] - direction(loop.meets, 0)[2])
            if loop.kind == "universal":
                actual.append(_second(_dot, z, other))
        return np.concatenate(actual, axis=1)

    def _solve(self, slopes: np.ndarray, right: np.ndarray) -> np.ndarray:
        """The solved variables x of slopes x = right, by normal equations: analytic in both."""
        A = slopes[:, :, self.solved]
        T = A.transpose(0, 2, 1)
        return np.linalg.solve(T @ A, T @ right)

    def closed(self, q: np.ndarray, near: np.ndarray) -> np.ndarray:
        """The free variables at q, by Newton's method from a posture; NaN if it does not arrive."""
        u = np.array(near, float)
        u[self.given] = q
        if not self.solved:
            return u
        for _ in range(NEWTON):
            open_, slopes = self.errors(u)
            if np.max(np.abs(open_)) < CLOSED:
                break
            step = np.linalg.lstsq(slopes[0][:, self.solved], open_[0], rcond=None)[0]
            u[self.solved] -= step * min(1.0, 0.3 / np.max(np.abs(step)))
        good = np.max(np.abs(self.errors(u)[0])) < 1e3 * CLOSED
        return u if good else np.full_like(u, np.nan)

    def regular(self, u: np.ndarray) -> float:
        """The smallest singular value by which the loops determine the passive joints."""
        if not self.solved:
            return 1.0
        return np.linalg.svd(self.errors(u)[1][0][:, self.solved], compute_uv=False)[-1]

    def G(self, u: np.ndarray) -> np.ndarray:
        """(m, f, n): ud = G qd."""
        u = np.atleast_2d(u)
        G = np.zeros((len(u), u.shape[1], self.n), u.dtype)
        G[:, self.given] = np.eye(self.n)
        if self.solved:
            _, slopes = self.errors(u)
            G[:, self.solved] = -self._solve(slopes, slopes[:, :, self.given])
        return G

    def accelerations(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
        """(m, f): of the free variables."""
        u = np.atleast_2d(u)
        G = self.G(u)
        udd = _apply(G, qdd)
        if self.solved:
            drift = self.drift(u, _apply(G, qd))
            udd = udd + 0 * drift[:, :1]
            udd[:, self.solved] -= self._solve(self.errors(u)[1], drift[:, :, None])[:, :, 0]
        return udd

    def slopes(self, f, u: np.ndarray) -> np.ndarray:
        """(n, ...): derivatives of f(postures) by q, along the closed ones."""
        ways = self.G(u)[0].T
        return f(u + 1j * STEP * ways).imag / STEP

    # Bodies.

    def _body(self, name: str) -> tuple[np.ndarray, np.ndarray, float]:
        XX, XY, XZ, YY, YZ, ZZ, MX, MY, MZ, M = (self.value(f"{x}{name}") for x in INERTIAL)
        return np.array([[XX, XY, XZ], [XY, YY, YZ], [XZ, YZ, ZZ]]), np.array([MX, MY, MZ]), M

    def _motors(self) -> list[tuple[np.ndarray, dict[str, float]]]:
        """(slopes by u, parameters) of everything that turns with friction or a rotor."""
        item = []
        for row in self.robot.moving_joints:
            local = {x: self.value(f"{x}{row.name}") for x in ("Ia", "Fv", "Fs", "Off", "Fva")}
            local |= {"Fst": self.value(f"Fst{row.name}")}
            local["shape"] = next(
                (
                    i.nonlinear_parameters
                    for e, _, i in self.robot.find_joint_effects(row.name)
                    if e.id == "stribeck"
                ),
                {},
            )
            item.append((self.follow[row.name][1], local))
        for row, sum_ in self.robot.coupling.items():
            slopes = sum(k * self.follow[joint][1] for joint, k in sum_.items())
            local = {"Ia": "Iam", "Fv": "Fvm", "Fs": "Fsm"}
            item.append((slopes, {x: self.value(f"{y}{row}") for x, y in local.items()}))
        return item

    def _inertia_u(self, u: np.ndarray) -> np.ndarray:
        frames = self.frames(u)
        total = 0.0
        for row in self.robot.moving_joints:
            R, _, Jv, Jw = frames[row.name]
            I, s, m = self._body(row.name)
            s = R @ s
            mixed = Jv.transpose(0, 2, 1) @ _turning(Jw, s)
            total = total + m * Jv.transpose(0, 2, 1) @ Jv + mixed + mixed.transpose(0, 2, 1)
            total = total + Jw.transpose(0, 2, 1) @ (R @ I @ R.transpose(0, 2, 1)) @ Jw
        for slopes, entry in self._motors():
            total = total + entry["Ia"] * np.outer(slopes, slopes)
        return total

    def M(self, u: np.ndarray) -> np.ndarray:
        """(m, n, n): T = qd^T M qd / 2."""
        u = np.atleast_2d(u)
        G = self.G(u)
        return G.transpose(0, 2, 1) @ self._inertia_u(u) @ G

    def potential(self, u: np.ndarray) -> np.ndarray:
        """(m,): of gravity."""
        frames = self.frames(u)
        total = 0.0
        for row in self.robot.moving_joints:
            R, p, *_ = frames[row.name]
            _, s, m = self._body(row.name)
            total = total - (m * p + R @ s) @ self.gravity
        return total - np.atleast_2d(u) @ self._constant()

    def _constant(self) -> np.ndarray:
        """(f,): torques of the free variables."""
        rows = self.constant.items()
        still = np.zeros(len(self.robot.free_joints))
        return sum((x * self.follow[row][1] for row, x in rows), still)

    def energies(self, u: np.ndarray, ud: np.ndarray) -> np.ndarray:
        """(m,): kinetic and potential, of the free variables."""
        return np.einsum("mi,mij,mj->m", ud, self._inertia_u(u), ud) / 2 + self.potential(u)

    def friction(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        """(m, n): torques of friction and offsets at speeds v of q."""
        G = self.G(u)
        ud = _apply(G, v)
        total = 0.0 * ud + self._constant()
        for slopes, inner in self._motors():
            y = (ud @ slopes)[:, None]
            sign = np.tanh(y / self.width) if self.width else np.sign(y.real)
            f = inner["Fv"] * y + inner["Fs"] * sign + inner.get("Off", 0.0)
            f = f + inner.get("Fva", 0.0) * y * sign
            if inner.get("shape"):
                vs, d = (inner["shape"][k] for k in ("vs", "d"))
                f = f + inner["Fst"] * np.exp(-((y * sign / vs) ** d)) * sign
            total = total + f * slopes
        return np.einsum("mfn,mf->mn", G, total)

    def torques(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
        """(m, n): by Newton and Euler; the motion of every link, its wrench, virtual power."""
        u = np.atleast_2d(u)
        G, udd = self.G(u), self.accelerations(u, qd, qdd)
        ud = _apply(G, qd)
        frames, motion = self.frames(u), self.motion(u, ud, udd)
        total = 0.0 * (ud + udd) - self._constant()
        for row in self.robot.moving_joints:
            ten = np.array([self.value(f"{x}{row.name}") for x in INERTIAL])
            total = total + _powers(frames[row.name], motion[row.name], self.gravity) @ ten
        for slopes, specific in self._motors():
            total = total + specific["Ia"] * np.outer(udd @ slopes, slopes)
        return np.einsum("mfn,mf->mn", G, total) + self.friction(u, qd)

    def regressor(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> dict[str, np.ndarray]:
        """{"XX1": (m, n), ...}: torques that each inertial parameter of a row asks for."""
        u = np.atleast_2d(u)
        G = self.G(u)
        frames = self.frames(u)
        motion = self.motion(u, _apply(G, qd), self.accelerations(u, qd, qdd))
        answer = {}
        for row in self.robot.moving_joints:
            powers = _powers(frames[row.name], motion[row.name], self.gravity)
            torques = np.einsum("mfn,mfk->kmn", G, powers)
            answer |= {f"{x}{row.name}": t for x, t in zip(INERTIAL, torques, strict=True)}
        return answer

    # What a controller calls, at one posture.

    def inertia(self, u):
        return self.M(u)[0]

    def gravity_torques(self, u):
        return self.slopes(self.potential, u)

    def coriolis_matrix(self, u, qd):
        """C_ij = sum_k (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i) qd_k / 2."""
        dM = self.slopes(self.M, u)
        return (
            np.einsum("kij,k->ij", dM, qd)
            + np.einsum("jik,k->ij", dM, qd)
            - np.einsum("ijk,k->ij", dM, qd)
        ) / 2

    def coriolis_transpose(self, u, qd):
        """dT/dq."""
        return self.slopes(lambda x: np.einsum("mij,i,j->m", self.M(x), qd, qd) / 2, u)

    def momentum(self, u, qd):
        return self.inertia(u) @ qd

    def energy(self, u, qd):
        return (qd @ self.inertia(u) @ qd) / 2 + self.potential(u)[0]

    def inverse_dynamics(self, u, qd, qdd):
        """By Lagrange: another way than `torques`."""
        return self.slotine_li(u, qd, qd, qdd)

    def slotine_li(self, u, qd, v, a):
        M, C = self.inertia(u), self.coriolis_matrix(u, qd)
        return M @ a + C @ v + self.gravity_torques(u) + self.friction(u, v)[0]

    def momentum_rest(self, u, qd):
        """tau - dp/dt."""
        rest = self.gravity_torques(u) + self.friction(u, qd)[0]
        return rest - self.coriolis_transpose(u, qd)

    def lost_power(self, u, qd):
        """tau.qd - d/dt of the energy."""
        return self.friction(u, qd)[0] @ qd

    def inverse_derivatives(self, u, qd, qdd):
        """(2, n, n): d tau/dq, d tau/dqd; [k, i, j] of tau_i by j."""
        by_q = self.slopes(lambda x: self.torques(x, qd, qdd), u).T
        steps = qd + 1j * STEP * np.eye(self.n)
        many = np.tile(u + 0j, (self.n, 1))
        return np.array([by_q, (self.torques(many, steps, qdd).imag / STEP).T])

    def _forward(self, u, qd, tau):
        rest = self.torques(u, qd, np.zeros(self.n))
        return np.linalg.solve(self.M(u), (tau - rest)[:, :, None])[:, :, 0]

    def forward_dynamics(self, u, qd, tau):
        return self._forward(u, qd, tau)[0]

    def forward_derivatives(self, u, qd, tau):
        """(3, n, n): d qdd/dq, /dqd, /dtau."""
        by_q = self.slopes(lambda x: self._forward(x, qd, tau), u)
        many, steps = np.tile(u + 0j, (self.n, 1)), 1j * STEP * np.eye(self.n)
        by_qd = self._forward(many, qd + steps, tau).imag / STEP
        by_tau = self._forward(many, qd, tau + steps).imag / STEP
        return np.array([by_q.T, by_qd.T, by_tau.T])

    # Frames.

    def _placed(self, frame: LinkFrame | None, row: str | None) -> tuple[str, np.ndarray]:
        """(row, pose on it)."""
        if frame is None:
            last = self.robot.platform or [joint.name for joint in self.robot.joints]
            return row or last[-1], np.eye(4)
        x = [e.evaluate(self.symbols) for e in frame.position]
        roll, pitch, yaw = (e.evaluate(self.symbols) for e in frame.angles)
        T = _moved(rotation(2, yaw) @ rotation(1, pitch) @ rotation(0, roll), x)
        return frame.row, (self._placed(frame.on, None)[1] if frame.on else np.eye(4)) @ T

    def _frame(self, u, name: str | None) -> tuple:
        """(row, R, p, J by u) of the tool, or of a named frame."""
        robot = self.robot
        known = robot.tool if name is None else robot.frames.get(name)
        row, T = self._placed(known, name)
        R, p, Jv, Jw = self.frames(u)[row]
        way = R @ T[:3, 3]
        J = np.concatenate([Jv + np.cross(Jw, way[:, :, None], axis=1), Jw], axis=1)
        return row, R @ T[:3, :3], p + way, J

    def pose(self, u, name=None):
        _, R, p, _ = self._frame(u, name)
        return np.concatenate([R[0], p[0][:, None]], axis=1)

    def _jacobian(self, u, name=None):
        return self._frame(u, name)[3] @ self.G(u)

    def jacobian(self, u, name=None):
        return self._jacobian(u, name)[0]

    def jacobian_dot_qd(self, u, qd, name=None):
        return np.einsum("kij,k,j->i", self.slopes(lambda x: self._jacobian(x, name), u), qd, qd)

    def twist(self, u, qd, name=None):
        R = self._frame(u, name)[1][0]
        V = self.jacobian(u, name) @ qd
        return np.concatenate([R.T @ V[:3], R.T @ V[3:]])

    def forward_kinematics(self, u):
        frames = self.frames(u)
        return np.array(
            [
                np.concatenate([frames[r.name][0][0], frames[r.name][1][0][:, None]], axis=1)
                for r in self.robot.moving_joints
            ]
        )

    def operational_inertia(self, u, damping):
        J = self.jacobian(u)
        return np.linalg.inv(J @ np.linalg.solve(self.inertia(u), J.T) + damping**2 * np.eye(6))

    def operational_inverse(self, u, damping):
        J = self.jacobian(u)
        return np.linalg.solve(self.inertia(u), J.T) @ self.operational_inertia(u, damping)


def _powers(frame: tuple, motion: tuple, gravity: np.ndarray) -> np.ndarray:
    """(m, f, 10): what the wrench of each inertial parameter does by each free variable."""
    R, _, Jv, Jw = frame
    w, dw, a = (np.einsum("mji,mj->mi", R, x) for x in (motion[0], motion[2], motion[3] - gravity))
    force = np.zeros((len(w), 3, 10), np.result_type(w, dw, a))
    moment = np.zeros_like(force)
    force[:, :, 6:9] = _skew(dw) + _skew(w) @ _skew(w)
    force[:, :, 9] = a
    moment[:, :, :6] = _inertia_columns(dw) + _skew(w) @ _inertia_columns(w)
    moment[:, :, 6:9] = -_skew(a)
    along, about = (J.transpose(0, 2, 1) @ R for J in (Jv, Jw))
    return along @ force + about @ moment


def _skew(v: np.ndarray) -> np.ndarray:
    """(m, 3, 3): v x."""
    result = np.zeros((len(v), 3, 3), v.dtype)
    result[:, 0, 1], result[:, 0, 2], result[:, 1, 2] = -v[:, 2], v[:, 1], -v[:, 0]
    return result - result.transpose(0, 2, 1)


def _inertia_columns(w: np.ndarray) -> np.ndarray:
    """(m, 3, 6): J w = this @ (XX XY XZ YY YZ ZZ)."""
    x, y, z = w.T
    o = np.zeros_like(x)
    return np.stack([[x, y, z, o, o, o], [o, x, o, y, z, o], [o, o, x, o, y, z]]).transpose(2, 0, 1)


def rotation(axis: int, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    R = np.zeros((3, 3))
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    R[axis, axis] = 1.0
    R[i, i] = R[j, j] = c
    R[i, j], R[j, i] = -s, s
    return R


def _rotations(angle: np.ndarray) -> np.ndarray:
    """(m, 3, 3) about z."""
    c, s = np.cos(angle), np.sin(angle)
    R = np.zeros((len(angle), 3, 3), angle.dtype)
    R[:, 0, 0] = R[:, 1, 1] = c
    R[:, 0, 1], R[:, 1, 0], R[:, 2, 2] = -s, s, 1.0
    return R


def _moved(R: np.ndarray, p) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def _apply(A: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(m, i) of (m, i, j) and (m, j) or (j,)."""
    return np.einsum("mij,...j->mi", A, x) if x.ndim == 1 else np.einsum("mij,mj->mi", A, x)


def _turning(Jw: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(m, 3, f): slopes of a direction x of a frame that turns."""
    return np.cross(Jw, x[:, :, None], axis=1)


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.sum(a * b, axis=1, keepdims=True)


def _across(a: np.ndarray, J: np.ndarray) -> np.ndarray:
    return np.sum(a[:, :, None] * J, axis=1, keepdims=True)


def _second(f, a, b) -> np.ndarray:
    """The second derivative of a bilinear f by time."""
    return f(a[2], b[0]) + 2 * f(a[1], b[1]) + f(a[0], b[2])
