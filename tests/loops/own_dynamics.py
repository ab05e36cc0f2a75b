"""Torques of a robot with loops by a dynamics of its own: Taylor series in time, Newton and Euler.

Positions of the passive joints come from `table_kinematics`; their speeds and accelerations from
the loop errors as polynomials of time, which vanish up to the second power; the links' wrenches
are projected on the actuated joints by the velocities that these cause (virtual power). Nothing is
shared with the package but the robot file.
"""

from collections.abc import Callable

import numpy as np

from modeler.robot.robot import INERTIAL, Robot
from tests.loops.table_kinematics import Table, turned

ROUNDS = 4  # of Newton's method, with slopes by differences
STEPS = 60  # of a way
REGULAR = 0.03  # smallest singular value on it
ZERO = 1e-11  # length of a column without effect, of the longest
CERTAIN = 1e-10  # singular value of what torques tell, of the largest

Series = list[np.ndarray]
"""Coefficients of 1, t and t**2, each (n, ...)."""


def times(f: Callable, a: Series, b: Series) -> Series:
    """The bilinear f of two series."""
    return [f(a[0], b[0]), f(a[0], b[1]) + f(a[1], b[0]),
            f(a[0], b[2]) + f(a[1], b[1]) + f(a[2], b[0])]  # fmt: skip


def minus(a: Series, b: Series) -> Series:
    return [x - y for x, y in zip(a, b, strict=True)]


def _turning(axis: int, x: Series) -> Series:
    """The rotation by an angle that is a series."""
    R, ahead = turned(axis, x[0]), turned(axis, x[0] + np.pi / 2)
    fixed = np.zeros((3, 3))
    fixed[axis, axis] = 1.0
    first, across = ahead - fixed, R - fixed
    x1, x2 = (part[:, None, None] for part in x[1:])
    return [R, first * x1, first * x2 - across * x1**2 / 2]


class Dynamics:
    """Regressor of the actuated joints at closed states."""

    def __init__(self, robot: Robot) -> None:
        self.robot, self.table = robot, Table(robot)
        self.gravity = np.array([e.number(self.table.symbols) for e in robot.gravity])

    def closed(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> Series:
        """The free variables as series: postures u, and how the given ones move."""
        table, n = self.table, len(u)
        back = np.linalg.pinv(table.slopes(u, table.solved))
        x = [u, np.zeros_like(u), np.zeros_like(u)]
        x[1][:, table.given], x[2][:, table.given] = qd, qdd / 2
        for power in (1, 2):
            for _ in range(ROUNDS):
                open_ = self.errors(self.frames(x))[power].reshape(n, -1)
                step = np.einsum("nij,nj->ni", back, open_)
                x[power][:, table.solved] -= step * table.scale[table.solved]
        return x

    def frames(self, x: Series) -> dict[str, tuple[Series, Series]]:
        """{row: (R, p)} as series."""
        n = len(x[0])
        values: dict[str, Series] = {
            joint.variable: [part[:, k] for part in x] for k, joint in enumerate(self.robot.free)
        }
        still = np.zeros((n, 3, 3))
        base = [np.tile(np.eye(3), (n, 1, 1)), still, still], [np.zeros((n, 3))] * 3
        found: dict[str, tuple[Series, Series]] = {"0": base}
        for row in self.robot.joints:
            R, p = found[row.antecedent]
            cells = [(getattr(row, c), *how) for c, *how in _TRANSFORMS]
            for cell, turns, axis in cells:
                amount = self._amount(cell, values, n)
                if turns:
                    R = times(np.matmul, R, _turning(axis, amount))
                else:
                    axes = [part[:, :, axis] for part in R]
                    p = [a + b for a, b in zip(p, times(_scaled, axes, amount), strict=True)]
            found[row.name] = R, p
        return found

    def _amount(self, cell, values: dict[str, Series], n: int) -> Series:
        """A cell as a series: a constant, and a joint variable times a rate."""
        names = [name for name in cell.names if name in values]
        known = self.table.symbols | dict.fromkeys(names, 0.0)
        constant = cell.number(known)
        total = [np.full(n, constant), np.zeros(n), np.zeros(n)]
        for name in names:
            rate = cell.number(known | {name: 1.0}) - constant
            total = [a + rate * b for a, b in zip(total, values[name], strict=True)]
        return total

    def errors(self, frames: dict) -> Series:
        """What is open, as in `Table.errors`, by the powers of time; (n, e) each."""
        found: list[Series] = []
        for loop in self.robot.loops:
            (A, a), (B, b) = frames[loop.frame], frames[loop.meets]
            way = [part / self.table.size for part in minus(b, a)]
            z = [part[:, :, 2] for part in A]
            other = [part[:, :, 2] for part in B]
            if loop.kind in ("cylindrical", "prismatic"):
                found.append(times(np.cross, way, z))
            elif loop.kind == "planar":
                found.append(times(_along, way, z))
            else:
                found.append(way)
            if loop.kind in ("revolute", "cylindrical", "planar", "prismatic", "rigid"):
                found.append(minus(z, other))
            if loop.kind in ("prismatic", "rigid"):
                found.append(minus([part[:, :, 0] for part in A], [part[:, :, 0] for part in B]))
            if loop.kind == "universal":
                found.append(times(_along, z, other))
        return [np.concatenate([part[k] for part in found], axis=1) for k in range(3)]

    def regressor(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> dict[str, np.ndarray]:
        """{"XX1": (n, given), ...}: torques that each inertial parameter asks for."""
        frames = self.frames(self.closed(u, qd, qdd))
        count = len(self.table.given)
        unit = np.eye(count)
        partial = []
        for j in range(count):
            speeds = np.tile(unit[j], (len(u), 1))
            partial.append(self.frames(self.closed(u, speeds, np.zeros_like(speeds))))
        found = {}
        for row in self.robot.moving:
            wrench = self._wrench(*frames[row.name])
            R = frames[row.name][0][0]
            for j in range(count):
                other, p = partial[j][row.name]
                w, v = _local(R, _spin(other, 1)), _local(R, p[1])
                for name, (force, moment) in zip(INERTIAL, wrench, strict=True):
                    torque = np.sum(v * force + w * moment, axis=1)
                    found.setdefault(f"{name}{row.name}", np.zeros((len(u), count)))[:, j] = torque
        return found

    def _wrench(self, R: Series, p: Series) -> list[tuple[np.ndarray, np.ndarray]]:
        """(force, moment) about the origin of the frame, in its axes, of each unit parameter."""
        w, dw = _local(R[0], _spin(R, 1)), _local(R[0], _spin(R, 2))
        a = _local(R[0], 2 * p[2] - self.gravity)
        none, found = np.zeros_like(w), []
        for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)):
            J = np.zeros((3, 3))
            J[i, j] = J[j, i] = 1.0
            found.append((none, dw @ J + np.cross(w, w @ J)))
        for i in range(3):
            s = np.broadcast_to(np.eye(3)[i], w.shape)
            force = np.cross(dw, s) + np.cross(w, np.cross(w, s))
            found.append((force, np.cross(s, a)))
        return [*found, (a, none)]


def reached(
    table: Table, home: np.ndarray, count: int, seed: int, reach: float, steps: int = STEPS
) -> np.ndarray:
    """(m, len(u)) closed postures that random ways arrive at, far from singularities.

    Args:
        table: the robot.
        home: a posture that is all but closed.
        count: of the ways.
        seed: of their ends.
        reach: of the longest, rad; of a travel 0.3 sizes of the robot for each.
        steps: of a way.
    """
    rng = np.random.default_rng(seed)
    joints = table.robot.coordinates
    wide = [reach if joint.angular else 0.3 * reach * table.size for joint in joints]
    home = _corrected(table, home[None])[0]
    share = rng.uniform(0.02, 1.0, (count, 1)) ** 2
    targets = home[table.given] + share * rng.uniform(-1, 1, (count, len(wide))) * wide
    u, distance = table.followed(home, targets, steps)
    return _corrected(table, u[np.isfinite(u[:, 0]) & (distance > REGULAR)])


def closed_home(table: Table, home: np.ndarray) -> np.ndarray:
    """The closed posture near a poor home, its given variables as they are."""
    for _ in range(3):
        home = _corrected(table, home[None])[0]
    return home


def _corrected(table: Table, u: np.ndarray) -> np.ndarray:
    """Closed to rounding, the given variables held."""
    u = u.copy()
    for _ in range(ROUNDS):
        back = np.linalg.pinv(table.slopes(u, table.solved))
        step = np.einsum("nij,nj->ni", back, table.errors(u))
        u[:, table.solved] -= step * table.scale[table.solved]
    return u


def rank(W: np.ndarray) -> tuple[int, float, float]:
    """Rank of (rows, columns) scaled to length 1, last singular value kept and first dropped."""
    lengths = np.linalg.norm(W, axis=0)
    W = W[:, lengths > ZERO * lengths.max()]
    singular = np.linalg.svd(W / np.linalg.norm(W, axis=0), compute_uv=False)
    kept = int(np.sum(singular > CERTAIN * singular[0]))
    return kept, singular[kept - 1], singular[kept] if kept < len(singular) else 0.0


def _scaled(axis: np.ndarray, amount: np.ndarray) -> np.ndarray:
    return axis * amount[:, None]


def _along(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.sum(a * b, axis=1, keepdims=True)


def _local(R: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.einsum("nji,nj->ni", R, v)


def _spin(R: Series, order: int) -> np.ndarray:
    """Angular velocity (order 1) or acceleration (2) of a rotation as a series."""
    back = [part.transpose(0, 2, 1) for part in R]
    rate = R[1] @ back[0] if order == 1 else 2 * R[2] @ back[0] + R[1] @ back[1]
    return np.stack([rate[:, 2, 1] - rate[:, 1, 2], rate[:, 0, 2] - rate[:, 2, 0],
                     rate[:, 1, 0] - rate[:, 0, 1]], axis=1) / 2  # fmt: skip


_TRANSFORMS = (
    ("gamma", True, 2), ("b", False, 2), ("alpha", True, 0),
    ("d", False, 0), ("theta", True, 2), ("r", False, 2),
)  # fmt: skip
