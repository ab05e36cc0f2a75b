"""Closed postures by a kinematics of its own: the table and the loops as they are written.

Nothing is shared with the package but the robot file and its expressions: poses are products of
4 x 4 matrices in floating point, loops are closed by Newton with differences for derivatives.
"""

import numpy as np

from modeler.core.expression import FUNCTIONS
from modeler.robot.robot import JointKind

_NUMPY = {name: getattr(np, name) for name in FUNCTIONS}
_MEETING = {
    # what of (origins, z axes parallel, all axes parallel, z axes one line) coincides
    "rigid": ("origin", "axes"), "revolute": ("origin", "z"), "spherical": ("origin",),
    "position": ("origin",), "universal": ("origin", "square"), "cylindrical": ("line", "z"),
}  # fmt: skip


class Linkage:
    """A robot with loops, as functions of its free variables."""

    def __init__(self, robot):
        self.robot = robot
        self.free = [joint.variable for joint in robot.free]
        self.given = [self.free.index(joint.variable) for joint in robot.coordinates]
        self.solved = [k for k in range(len(self.free)) if k not in self.given]
        self.symbols = robot.symbol_values()
        lengths = [v for n, v in self.symbols.items() if n != "g"]
        self.size = max(map(abs, lengths), default=1.0)

    def variables(self, u):
        """{variable: (n,)} of all moving rows, relations as written."""
        known = {**self.symbols, **dict(zip(self.free, u.T, strict=True))}
        waiting = {f"q{name}": e for name, e in self.robot.relations.items()}
        while waiting:
            for name, expression in list(waiting.items()):
                if expression.names <= known.keys():
                    known[name] = evaluated(expression, known)
                    del waiting[name]
        return known

    def residuals(self, u):
        """(n, equations)."""
        known, n = self.variables(u), len(u)
        poses = {"0": np.tile(np.eye(4), (n, 1, 1))}
        for joint in self.robot.joints:
            cells = {
                c: np.broadcast_to(evaluated(getattr(joint, c), known), (n,))
                for c in ("gamma", "b", "alpha", "d", "theta", "r")
            }
            step = turn(cells["gamma"], 2) @ shift(cells["b"], 2) @ turn(cells["alpha"], 0)
            step = step @ shift(cells["d"], 0) @ turn(cells["theta"], 2) @ shift(cells["r"], 2)
            poses[joint.name] = poses[joint.antecedent] @ step
        parts = [open_by(poses[x.frame], poses[x.meets], x.kind) for x in self.robot.loops]
        return np.concatenate(parts, axis=1)

    def jacobian(self, u):
        """(n, equations, u) by central differences."""
        columns = []
        for k in range(u.shape[1]):
            step = np.zeros(u.shape[1])
            step[k] = 1e-6
            columns.append((self.residuals(u + step) - self.residuals(u - step)) / 2e-6)
        return np.stack(columns, axis=2)

    def walked(self, home, walkers=40, steps=16, reach=1.2, seed=3):
        """(n, u) closed postures away from singularities, on the branch of `home`."""
        rng = np.random.default_rng(seed)
        u = np.tile(home, (walkers, 1))
        way = rng.uniform(-1.0, 1.0, (walkers, len(self.given)))
        angular = np.array([joint.kind is JointKind.REVOLUTE for joint in self.robot.coordinates])
        way *= np.where(angular, reach, 0.3 * self.size) / steps
        for _ in range(steps):
            trial = self.corrected(u, way, 4)
            good = np.all(np.isfinite(trial), axis=1) & (np.max(np.abs(trial - u), axis=1) < 0.5)
            good &= np.max(np.abs(self.residuals(trial)), axis=1) < 1e-6 * self.size
            u[good] = trial[good]
            way[~good] = 0.0
        u = self.corrected(u, np.zeros_like(way), 6)
        inner = self.jacobian(u)[:, :, self.solved]
        smallest = np.linalg.svd(inner, compute_uv=False)[:, len(self.solved) - 1]
        closed = np.max(np.abs(self.residuals(u)), axis=1) < 1e-11 * self.size
        return u[closed & (smallest > 0.02 * smallest.max())]

    def corrected(self, u, way, iterations):
        """Newton with the actuated joints moved by `way`; one derivative serves all iterations."""
        u = u.copy()
        u[:, self.given] += way
        inner = np.linalg.pinv(self.jacobian(u)[:, :, self.solved], rcond=1e-7)
        for _ in range(iterations):
            u[:, self.solved] -= np.einsum("nij,nj->ni", inner, self.residuals(u))
        return u


def evaluated(expression, known):
    """Value of an expression for arrays."""
    return expression.fold(known, _NUMPY, np.pi, float)


def turn(angle, axis):
    """(n, 4, 4) rotations about x (0) or z (2)."""
    T = np.tile(np.eye(4), (len(angle), 1, 1))
    i, j = (1, 2) if axis == 0 else (0, 1)
    T[:, i, i] = T[:, j, j] = np.cos(angle)
    T[:, j, i] = np.sin(angle)
    T[:, i, j] = -np.sin(angle)
    return T


def shift(length, axis):
    """(n, 4, 4) translations along x (0) or z (2)."""
    T = np.tile(np.eye(4), (len(length), 1, 1))
    T[:, axis, 3] = length
    return T


def open_by(a, b, kind):
    """(n, equations) of one loop."""
    between = a[:, :3, 3] - b[:, :3, 3]
    cosines = np.einsum("nki,nkj->nij", a[:, :3, :3], b[:, :3, :3])
    parts = []
    for what in _MEETING[kind]:
        if what == "origin":
            parts.append(between)
        elif what == "line":
            parts.append(np.einsum("nki,nk->ni", a[:, :3, :2], between))
        elif what == "square":
            parts.append(cosines[:, 2, 2][:, None])
        else:
            parts.append(cosines[:, :2, 2])
        if what == "axes":
            parts.append(cosines[:, 0, 1][:, None])
    return np.concatenate(parts, axis=1)
