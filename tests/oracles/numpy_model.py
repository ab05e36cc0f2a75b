"""A compiled model without a compiler, of any chain, by the oracle: for tests of logs and fits."""

from dataclasses import dataclass, field

import numpy as np

from modeler.core.manifest import FORMAT, BaseSpec, JointSpec, ModuleSpec, ParameterSpec
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import INERTIAL
from modeler.runtime.bind import SampleArrays
from modeler.runtime.fused import NonzeroPattern, reduce_dense_samples
from tests.oracles.complex_step import Oracle


@dataclass
class Row:
    """alpha, d, theta offset, r offset; sigma 0 revolute, 1 prismatic; chain robot."""

    alpha: float = 0.0
    d: float = 0.0
    theta: float = 0.0
    r: float = 0.0
    sigma: int = 0


@dataclass
class NumpyModel:
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

        return reduce_dense_samples(
            self.pattern, evaluate, SampleArrays(q, qd, qdd, tau, s, use, weight), state
        )

    def __post_init__(self):
        n = len(self.rows)
        self._oracle = Oracle(parse_robot_text(self._text(), "numpy_model"))
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
        rest = [k for k in range(len(names)) if abs(R[k, k]) > 1e-9]
        self.kept = rest
        unit = ["N m" if r.sigma == 0 else "N" for r in self.rows]
        standard = tuple(
            ParameterSpec(name, "SI", kind, effect, str(j + 1), None)
            for name, (kind, effect, j) in zip(names, kinds, strict=True)
        )
        joints = []
        for j, row in enumerate(self.rows):
            kind = ("prismatic", "m") if row.sigma else ("revolute", "rad")
            gain = self.gains[j] if self.gains else None
            joints.append(JointSpec(str(j + 1), *kind, unit[j], j not in self.passive, gain))
        self.spec = ModuleSpec(
            robot="numpy_model",
            title="",
            prefix="numpy_model",
            format=FORMAT,
            symbols=(),
            joints=tuple(joints),
            standard=standard,
            base=tuple(
                BaseSpec(names[k], names[k], "SI", kinds[k][0], tuple(range(n)), ()) for k in rest
            ),
            unidentifiable=(),
            functions=(),
        )

    def _text(self) -> str:
        rows = ""
        for j, row in enumerate(self.rows, 1):
            turn, way = ("", f"q{j} + ") if row.sigma else (f"q{j} + ", "")
            rows += f'["{j}", {row.sigma}, {float(row.alpha)}, {float(row.d)}, '
            rows += f'"{turn}{float(row.theta)}", "{way}{float(row.r)}"], '
        return (
            f'name = "numpy_model"\ngravity = {[float(x) for x in self.gravity]}\n[mdh]\n'
            f'columns = ["j", "sigma", "alpha", "d", "theta", "r"]\nrows = [{rows}]\n'
        )

    def regressor(self, q, qd, qdd, s=None):
        out = np.zeros((*q.shape, len(self.names)))
        column = {name: k for k, name in enumerate(self.names)}
        for name, torque in self._oracle.regressor(q, qd, qdd).items():
            out[:, :, column[name]] = torque
        for j in range(q.shape[1]):
            local = {"Ia": qdd[:, j], "Fv": qd[:, j], "Fs": np.sign(qd[:, j]), "Off": 1.0}
            for prefix, values in local.items():
                if f"{prefix}{j + 1}" in column:
                    out[:, j, column[f"{prefix}{j + 1}"]] = values
        for j, E in self.coupling.items():
            E = np.asarray(E)
            for name, v in (("Iam", qdd @ E), ("Fvm", qd @ E), ("Fsm", np.sign(qd @ E))):
                out[:, :, column[f"{name}{j + 1}"]] = v[:, None] * E
        return out

    def base_regressor(self, q, qd, qdd, s=None):
        return self.regressor(q, qd, qdd)[:, :, self.kept]


def slider(gain=None):
    """One prismatic axis: M, Fv, Fs, Off (Ia is the same column as M)."""
    return NumpyModel([Row(sigma=1)], gravity=(0, 0, 0), rotor=False, gains=gain and (gain,))


def rotor(gain=None):
    """One revolute axis without gravity."""
    return NumpyModel([Row()], gravity=(0, 0, 0), rotor=False, gains=gain and (gain,))


def planar_arm(**kw):
    """2R arm in a vertical plane."""
    return NumpyModel([Row(), Row(d=0.5)], gravity=(0, -9.81, 0), **kw)
