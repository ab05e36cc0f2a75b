"""The table's kinematics and the loops as written, in plain numpy: an oracle for what is closed.

Nothing of the package but the reading of the robot file: frames by the product of elementary
transforms, each loop by what its kind says of the two frames that meet, directions by cross
products (so that axes turned by pi are open), derivatives by differences.
"""

from collections.abc import Sequence

import numpy as np

from modeler.robot import Robot


def _rotation(axis: int, angle: np.ndarray) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    R = np.zeros((*np.shape(angle), 3, 3))
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    R[..., axis, axis] = 1.0
    R[..., i, i] = R[..., j, j] = c
    R[..., i, j], R[..., j, i] = -s, s
    return R


class Table:
    """Frames and loop errors of a robot at free variables u, in the order of `robot.free`."""

    def __init__(self, robot: Robot) -> None:
        self.robot, self.symbols = robot, robot.symbol_values()
        names = [joint.name for joint in robot.free]
        self.given = [names.index(joint.name) for joint in robot.coordinates]
        self.solved = [k for k in range(len(names)) if k not in self.given]
        lengths = [abs(v) for n, v in self.symbols.items() if n != "g"]
        self.size = max(lengths, default=1.0) or 1.0
        self.scale = np.array([1.0 if joint.angular else self.size for joint in robot.free])

    def frames(self, u: np.ndarray) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """{row: (R, p)} of n postures (n, len(u))."""
        n = len(u)
        values = dict(self.symbols) | {
            f"q{joint.name}": u[:, k] for k, joint in enumerate(self.robot.free)
        }
        waiting = dict(self.robot.relations)
        while waiting:
            for name in [k for k, r in waiting.items() if r.names <= values.keys()]:
                values[f"q{name}"] = self._value(waiting.pop(name), values)
        found = {"0": (np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 3)))}
        for row in self.robot.joints:
            R, p = found[row.antecedent]
            e = {
                name: np.broadcast_to(self._value(getattr(row, name), values), n)
                for name in ("gamma", "b", "alpha", "d", "theta", "r")
            }
            R = R @ _rotation(2, e["gamma"])
            p = p + R[:, :, 2] * e["b"][:, None]
            R = R @ _rotation(0, e["alpha"])
            p = p + R[:, :, 0] * e["d"][:, None]
            R = R @ _rotation(2, e["theta"])
            found[row.name] = R, p + R[:, :, 2] * e["r"][:, None]
        return found

    def _value(self, expression, values):
        functions = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "exp": np.exp,
                     "abs": np.abs, "sign": np.sign, "tanh": np.tanh}  # fmt: skip
        return expression.fold(values, functions, np.pi, float)

    def errors(self, u: np.ndarray) -> np.ndarray:
        """(n, e) what is open: lengths in sizes of the robot, directions as differences."""
        frames, found = self.frames(u), []
        for loop in self.robot.loops:
            (A, a), (B, b) = frames[loop.frame], frames[loop.meets]
            way = (b - a) / self.size
            kind = loop.kind
            if kind in ("position", "spherical", "universal", "revolute", "rigid"):
                found.append(way)
            elif kind in ("cylindrical", "prismatic"):
                found.append(np.cross(way, A[:, :, 2]))
            elif kind == "planar":
                found.append(np.sum(way * A[:, :, 2], axis=1, keepdims=True))
            if kind in ("revolute", "cylindrical", "planar", "prismatic", "rigid"):
                found.append(A[:, :, 2] - B[:, :, 2])
            if kind in ("prismatic", "rigid"):
                found.append(A[:, :, 0] - B[:, :, 0])
            if kind == "universal":
                found.append(np.sum(A[:, :, 2] * B[:, :, 2], axis=1, keepdims=True))
        return np.concatenate(found, axis=1)

    def slopes(self, u: np.ndarray, places: Sequence[int]) -> np.ndarray:
        """(n, e, len(places)) derivatives by scaled variables."""
        h, columns = 1e-6, []
        for k in places:
            step = np.zeros(u.shape[1])
            step[k] = h * self.scale[k]
            columns.append((self.errors(u + step) - self.errors(u - step)) / (2 * h))
        return np.stack(columns, axis=2)

    def followed(self, home: np.ndarray, targets: np.ndarray, steps: int) -> tuple:
        """Straight ways of the given variables from home, and how near singularity they came.

        Returns:
            (n, len(u)) postures, NaN where the way ended; (n,) the smallest singular value of the
            solved columns on the way.
        """
        n = len(targets)
        u = np.tile(home, (n, 1))
        nearest = np.full(n, np.inf)
        for k in range(1, steps + 1):
            before = u.copy()
            alive = np.isfinite(u[:, 0])
            if not alive.any():
                break
            J = self.slopes(u[alive], range(u.shape[1]))
            inner = np.linalg.svd(J[:, :, self.solved], compute_uv=False)[:, -1]
            nearest[alive] = np.minimum(nearest[alive], inner)
            q = home[self.given] + (targets[alive] - home[self.given]) * (k / steps)
            v = u[alive]
            change = (q - v[:, self.given]) / self.scale[self.given]
            right = np.einsum("nij,nj->ni", J[:, :, self.given], change)
            along = -np.einsum("nij,nj->ni", np.linalg.pinv(J[:, :, self.solved]), right)
            v[:, self.solved] += along * self.scale[self.solved]
            v[:, self.given] = q
            inverse = np.linalg.pinv(self.slopes(v, self.solved))
            for _ in range(6):
                f = self.errors(v)
                v[:, self.solved] -= np.einsum("nij,nj->ni", inverse, f) * self.scale[self.solved]
            jump = np.max(np.abs(v - before[alive]) / self.scale, axis=1)
            open_ = np.max(np.abs(self.errors(v)), axis=1)
            v[~((open_ < 1e-8) & (jump < 0.3))] = np.nan
            u[alive] = v
        return u, nearest
