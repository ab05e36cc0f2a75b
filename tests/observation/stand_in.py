"""A compiled model without a compiler: plain numpy Newton-Euler, an independent oracle."""

from dataclasses import dataclass, field

import numpy as np

from modeler.core.manifest import FORMAT, BaseSpec, JointSpec, ModuleSpec, ParameterSpec
from modeler.runtime.bind import Samples
from modeler.runtime.fused import NonzeroPattern, of_dense

INERTIAL = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")


def skew(v):
    out = np.zeros((*v.shape[:-1], 3, 3))
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    return out - np.swapaxes(out, -1, -2)


def inertia_columns(w):
    """(n, 3, 6): J w = this @ (XX XY XZ YY YZ ZZ)."""
    x, y, z = w[..., 0], w[..., 1], w[..., 2]
    o = np.zeros_like(x)
    return np.stack(
        [np.stack([x, y, z, o, o, o], -1), np.stack([o, x, o, y, z, o], -1),
         np.stack([o, o, x, o, y, z], -1)], -2)  # fmt: skip


@dataclass
class Row:
    """alpha, d, theta offset, r offset; sigma 0 revolute, 1 prismatic; chain robot."""

    alpha: float = 0.0
    d: float = 0.0
    theta: float = 0.0
    r: float = 0.0
    sigma: int = 0


@dataclass
class StandIn:
    """Same methods as the compiled model."""

    rows: list
    gravity: tuple = (0.0, 0.0, -9.81)
    friction: bool = True
    offsets: tuple | None = None  # rows with one; None: all that have friction
    rotor: bool = True
    coupling: dict = field(default_factory=dict)  # row -> coefficients of qd
    gains: tuple | None = None
    passive: tuple = ()
    seed: int = 7

    @property
    def pattern(self):
        columns = np.arange(len(self.spec.base), dtype=np.intc)
        return NonzeroPattern((columns,) * len(self.rows), len(columns))

    def inertia_matrix(self, q, beta):
        still = np.zeros_like(q)
        return np.stack(
            [
                (self.base_regressor(q, still, still + one) - self.base_regressor(q, still, still))
                @ beta
                for one in np.eye(q.shape[1])
            ],
            axis=2,
        )

    def triangles(self, q, qd, qdd, tau, use=None, s=None, weight=None, state=None):
        def evaluate(w):
            return self.base_regressor(q[w], qd[w], qdd[w]), np.zeros(len(q[w]), dtype=bool)

        return of_dense(self.pattern, evaluate, Samples(q, qd, qdd, tau, s, use, weight), state)

    def __post_init__(self):
        n = len(self.rows)
        names, kinds = [], []
        for j in range(n):
            names += [f"{p}{j + 1}" for p in INERTIAL]
            kinds += [("inertial", "rigid_body", j)] * 10
            if self.rotor:
                names.append(f"Ia{j + 1}")
                kinds.append(("rotor_inertia", "rotor_inertia", j))
            if self.friction:
                names += [f"Fv{j + 1}", f"Fs{j + 1}"]
                kinds += [("friction", "viscous", j), ("friction", "coulomb", j)]
            if self.friction and (self.offsets is None or j in self.offsets):
                names.append(f"Off{j + 1}")
                kinds.append(("offset", "offset", j))
        for j in self.coupling:
            names += [f"Iam{j + 1}", f"Fvm{j + 1}", f"Fsm{j + 1}"]
            kinds += [("rotor_inertia", "coupled_inertia", j)]
            kinds += [("friction", "coupled_friction", j)] * 2
        self.names = names
        random = np.random.default_rng(self.seed)
        self._all = list(range(len(names)))
        q, qd, qdd = random.uniform(-3, 3, (3, 40 * n, n))
        W = self.regressor(q, qd, qdd).reshape(-1, len(names))
        length = np.linalg.norm(W, axis=0)
        W = W / np.where(length > 1e-9, length, np.inf)
        R = np.linalg.qr(W, mode="r")
        kept = [k for k in range(len(names)) if abs(R[k, k]) > 1e-9]
        self.kept = kept
        unit = ["N m" if r.sigma == 0 else "N" for r in self.rows]
        standard = tuple(
            ParameterSpec(name, "SI", kind, effect, str(j + 1), None)
            for name, (kind, effect, j) in zip(names, kinds, strict=True)
        )
        self.spec = ModuleSpec(
            robot="stand_in", title="", prefix="stand_in", format=FORMAT, symbols=(),
            joints=tuple(
                JointSpec(str(j + 1), "prismatic" if r.sigma else "revolute",
                          "m" if r.sigma else "rad", unit[j], j not in self.passive,
                          self.gains[j] if self.gains else None)
                for j, r in enumerate(self.rows)),
            standard=standard,
            base=tuple(BaseSpec(names[k], names[k], "SI", kinds[k][0], tuple(range(n)), ())
                       for k in kept),
            unidentifiable=(), functions=())  # fmt: skip

    def regressor(self, q, qd, qdd, s=None):
        n, J = q.shape
        out = np.zeros((n, J, len(self.names)))
        frames, wrenches = self.wrenches(q, qd, qdd)
        column = {name: k for k, name in enumerate(self.names)}
        for j in range(J):
            X = wrenches[j]
            for i in range(j, -1, -1):
                k = column[f"XX{j + 1}"]
                out[:, i, k : k + 10] = X[:, 5] if self.rows[i].sigma == 0 else X[:, 2]
                R, P = frames[i]
                f = R @ X[:, :3]
                X = np.concatenate([f, R @ X[:, 3:] + skew(P) @ f], axis=1)
            own = {"Ia": qdd[:, j], "Fv": qd[:, j], "Fs": np.sign(qd[:, j]), "Off": 1.0}
            for prefix, values in own.items():
                if f"{prefix}{j + 1}" in column:
                    out[:, j, column[f"{prefix}{j + 1}"]] = values
        for j, E in self.coupling.items():
            E = np.asarray(E)
            for name, v in (("Iam", qdd @ E), ("Fvm", qd @ E), ("Fsm", np.sign(qd @ E))):
                out[:, :, column[f"{name}{j + 1}"]] = v[:, None] * E
        return out

    def wrenches(self, q, qd, qdd):
        """(rotation, position) of each frame in its antecedent, and (n, 6, 10) force and moment."""
        n = len(q)
        w = wd = np.zeros((n, 3))
        a = np.tile(-np.asarray(self.gravity), (n, 1))
        z, o = np.array([0.0, 0.0, 1.0]), np.zeros(n)
        frames, wrenches = [], []
        for j, row in enumerate(self.rows):
            th = row.theta + (q[:, j] if row.sigma == 0 else o)
            r = row.r + (q[:, j] if row.sigma == 1 else o)
            ca, sa, c, s = np.cos(row.alpha), np.sin(row.alpha), np.cos(th), np.sin(th)
            R = np.stack([np.stack([c, -s, o], -1), np.stack([ca * s, ca * c, o - sa], -1),
                          np.stack([sa * s, sa * c, o + ca], -1)], -2)  # fmt: skip
            P = np.stack([o + row.d, -r * sa, r * ca], -1)
            a = a + np.cross(wd, P) + np.cross(w, np.cross(w, P))
            a, w, wd = (np.einsum("nji,nj->ni", R, v) for v in (a, w, wd))
            if row.sigma == 0:
                wd = wd + z * qdd[:, j : j + 1] + np.cross(w, z * qd[:, j : j + 1])
                w = w + z * qd[:, j : j + 1]
            else:
                a = a + z * qdd[:, j : j + 1] + 2 * np.cross(w, z * qd[:, j : j + 1])
            X = np.zeros((n, 6, 10))
            X[:, :3, 6:9] = skew(wd) + skew(w) @ skew(w)
            X[:, :3, 9] = a
            X[:, 3:, :6] = inertia_columns(wd) + skew(w) @ inertia_columns(w)
            X[:, 3:, 6:9] = -skew(a)
            frames.append((R, P))
            wrenches.append(X)
        return frames, wrenches

    def base_regressor(self, q, qd, qdd, s=None):
        return self.regressor(q, qd, qdd)[:, :, self.kept]


def slider(gain=None):
    """One prismatic axis: M, Fv, Fs, Off (Ia is the same column as M)."""
    return StandIn([Row(sigma=1)], gravity=(0, 0, 0), rotor=False, gains=gain and (gain,))


def rotor(gain=None):
    """One revolute axis without gravity."""
    return StandIn([Row()], gravity=(0, 0, 0), rotor=False, gains=gain and (gain,))


def planar_arm(**kw):
    """2R arm in a vertical plane."""
    return StandIn([Row(), Row(d=0.5)], gravity=(0, -9.81, 0), **kw)
