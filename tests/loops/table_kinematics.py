"""The table's kinematics and the loops as written, in plain numpy: an oracle for what is closed.

Nothing of the package but the reading of the robot file: frames by the product of elementary
transforms, each loop by what its kind says of the two frames that meet, directions by cross
products (so that axes turned by pi are open), derivatives by differences.
"""

from collections.abc import Sequence

import numpy as np

from modeler.robot.robot import Joint, Robot

CLOSED = 1e-8  # sizes of the robot, or 1
NEWTON = 6  # corrections of a step
LONGEST = 0.3  # step of a variable, in its scale
ROUNDING = 1e-7  # of a posture, in its scale

_TRANSFORMS = ((True, 2), (False, 2), (True, 0), (False, 0), (True, 2), (False, 2))
"""Of gamma, b, alpha, d, theta, r: whether it turns, and about or along which axis."""


def turned(axis: int, angle: np.ndarray) -> np.ndarray:
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
        self._cells = {joint.name: self._constants(joint) for joint in robot.joints}

    def _constants(self, joint: Joint) -> dict:
        """The cells of a row in the order of the transforms, numbers where no variable stands."""
        cells = {name: getattr(joint, name) for name in ("gamma", "b", "alpha", "d", "theta", "r")}
        return {
            name: self._value(cell, self.symbols) if cell.names <= self.symbols.keys() else cell
            for name, cell in cells.items()
        }

    def variables(self, u: np.ndarray) -> dict:
        """{name: value} of symbols and of all moving rows, by the relations as written."""
        values = dict(self.symbols) | {
            f"q{joint.name}": u[:, k] for k, joint in enumerate(self.robot.free)
        }
        waiting = dict(self.robot.relations)
        while waiting:
            for name in [k for k, r in waiting.items() if r.names <= values.keys()]:
                values[f"q{name}"] = self._value(waiting.pop(name), values)
        return values

    def frames(self, u: np.ndarray) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """{row: (R, p)} of n postures (n, len(u))."""
        n, values = len(u), self.variables(u)
        found = {"0": (np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 3)))}
        for row in self.robot.joints:
            R, p = found[row.antecedent]
            cells = self._cells[row.name].values()
            for cell, (turns, axis) in zip(cells, _TRANSFORMS, strict=True):
                if isinstance(cell, float) and cell == 0.0:
                    continue
                value = cell if isinstance(cell, float) else self._value(cell, values)
                value = np.broadcast_to(value, n)
                if turns:
                    R = R @ turned(axis, value)
                else:
                    p = p + R[:, :, axis] * value[:, None]
            found[row.name] = R, p
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
        h, n = 1e-6, len(u)
        steps = np.zeros((len(places), 1, u.shape[1]))
        for i, k in enumerate(places):
            steps[i, 0, k] = h * self.scale[k]
        both = np.concatenate([u + steps, u - steps]).reshape(-1, u.shape[1])
        ahead, behind = self.errors(both).reshape(2, len(places), n, -1)
        return (ahead - behind).transpose(1, 2, 0) / (2 * h)

    def followed(self, home: np.ndarray, targets: np.ndarray, steps: int) -> tuple:
        """Straight ways of the given variables from home, and how near singularity they came.

        A way ends where Newton's method goes further than the tangent does, and where the solved
        columns change their orientation: behind a turning point or a bifurcation.

        Args:
            home: (len(u),) or (n, len(u)) closed postures where the ways start.
            targets: (n, given) where they lead.
            steps: of equal length.

        Returns:
            (n, len(u)) postures, NaN where the way ended; (n,) the smallest singular value of the
            solved columns on the way.
        """
        n = len(targets)
        start = np.broadcast_to(home, (n, len(self.scale)))
        u, nearest, going = start.copy(), np.full(n, np.inf), np.arange(n)
        J = self.slopes(u, range(u.shape[1]))
        for k in range(1, steps + 1):
            q = start[:, self.given] + (targets - start[:, self.given]) * (k / steps)
            v, J_after, good, singular = self._step(u[going], q[going], J)
            nearest[going] = np.minimum(nearest[going], singular)
            u[going] = v
            u[going[~good]] = np.nan
            going, J = going[good], J_after[good]
            if not len(going):
                break
        return u, nearest

    def _step(self, u: np.ndarray, q: np.ndarray, J: np.ndarray) -> tuple:
        """One step to q: postures, all slopes there, who arrived, least singular values."""
        v, scale = u.copy(), self.scale[self.solved]
        change = (q - u[:, self.given]) / self.scale[self.given]
        back = np.linalg.pinv(J[:, :, self.solved])
        along = -np.einsum("nij,njk,nk->ni", back, J[:, :, self.given], change)
        v[:, self.solved] += along * scale
        v[:, self.given] = q
        predicted = v.copy()
        inverse = np.linalg.pinv(self.slopes(v, self.solved))
        for _ in range(NEWTON):
            f = self.errors(v)
            v[:, self.solved] -= np.einsum("nij,nj->ni", inverse, f) * scale
        after = self.slopes(v, range(v.shape[1]))
        turned = np.linalg.det(back @ after[:, :, self.solved])
        bent = np.max(np.abs(v - predicted) / self.scale, axis=1)
        length = np.max(np.abs(predicted - u) / self.scale, axis=1)
        good = (np.max(np.abs(self.errors(v)), axis=1) < CLOSED) & (turned > 0.0)
        good &= (bent < 0.5 * length + ROUNDING) & (length < LONGEST)
        singular = np.linalg.svd(after[:, :, self.solved], compute_uv=False)[:, -1]
        return v, after, good, singular
